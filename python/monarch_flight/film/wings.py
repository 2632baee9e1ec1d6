"""The wings of the recorded model as meshes."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def triangles(corners, colours=None):
    """Triangles from a row a corner; colours likewise, RGBA 0 to 1."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(corners, dtype=np.float32), deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtk(np.arange(len(corners) // 3 * 3, dtype=np.int64), deep=True, array_type=12))
    out = vtkPolyData()
    out.SetPoints(points)
    out.SetPolys(cells)
    if colours is not None:
        array = numpy_to_vtk(np.ascontiguousarray(255 * colours, dtype=np.uint8), deep=True)
        array.SetName("colour")
        out.GetPointData().SetScalars(array)
    return out


def corners(marker):
    return np.array([(p.x, p.y, p.z) for p in marker.points])


def colours(marker):
    return np.array([(c.r, c.g, c.b, c.a) for c in marker.colors]) if marker.colors else None


def ground(marker):
    """The triangles of a wing itself, without what is drawn on it: a row a triangle, three corners."""
    flat = corners(marker).reshape(-1, 3, 3)
    return flat[np.all(flat[:, :, 2] == 0.0, axis=1)]


def finer(soup):
    """Each triangle in four."""
    a, b, c = soup[:, 0], soup[:, 1], soup[:, 2]
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    return np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])


def sheet(marker):
    """The ground of a wing in triangles small enough for smooth colours; corners are shared."""
    soup = finer(finer(ground(marker)))
    points, places = np.unique(np.round(soup.reshape(-1, 3), 9), axis=0, return_inverse=True)
    out = triangles(points)
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtk(places.astype(np.int64), deep=True, array_type=12))
    out.SetPolys(cells)
    return out


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())
