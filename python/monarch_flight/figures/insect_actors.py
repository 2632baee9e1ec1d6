"""The insect of a run in a scene of VTK: body, abdomen, and its wings by their true outline, coloured by pressure."""
import math

import numpy as np
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from monarch_flight.report import pressure
from monarch_flight.report.model import ACROSS, ALONG, ANGLES
from monarch_flight.report.page import to_world

BODY = (0.22, 0.19, 0.17)


def turned(axis, angle):
    """Rotation matrix about a unit axis [rad]."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * K + (1 - math.cos(angle)) * (K @ K)


def of_quaternion(x, y, z, w):
    angle, sine = 2 * math.atan2(math.sqrt(x * x + y * y + z * z), w), math.sqrt(x * x + y * y + z * z)
    return np.eye(3) if sine == 0 else turned(np.array([x, y, z]) / sine, angle)


def poses(model, columns, row):
    """{link: (rotation, origin)} in world axes (x east, y north, z up) at a row of flight.csv."""
    places, attitudes = to_world(columns, [row])
    found = {"base_link": (of_quaternion(*attitudes[0]), places[0])}
    for joint in model.joints:
        R, origin = found[joint["parent"]]
        roll, pitch, yaw = joint["rpy"]
        here = R @ turned((0, 0, 1), yaw) @ turned((0, 1, 0), pitch) @ turned((1, 0, 0), roll)
        if joint["axis"]:
            here = here @ turned(joint["axis"], columns[ANGLES[joint["name"]]][row])
        found[joint["child"]] = (here, origin + R @ np.array(joint["xyz"]))
    return found


def surface(points, faces):
    data, places, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for point in points:
        places.InsertNextPoint(*map(float, point))
    for face in faces:
        cells.InsertNextCell(len(face))
        for corner in face:
            cells.InsertCellPoint(int(corner))
    data.SetPoints(places)
    data.SetPolys(cells)
    return data


def body_actor(corners, pose):
    R, origin = pose
    points = corners.reshape(-1, 3) @ R.T + origin
    data, normals, merged = surface(points, np.arange(len(points)).reshape(-1, 3)), vtkPolyDataNormals(), vtkCleanPolyData()
    merged.SetInputData(data)
    normals.SetInputConnection(merged.GetOutputPort())
    normals.SplittingOff()
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputConnection(normals.GetOutputPort())
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*BODY)
    actor.GetProperty().SetSpecular(0.15)
    return actor


def faces_of(wings, poses_of, links):
    """{link: facets in the axes of that wing} of the faces in a file of wings, each with the wing whose plane it lies in."""
    corners = np.array([[wings.GetPoint(wings.GetCell(i).GetPointId(k)) for k in range(4)] for i in range(wings.GetNumberOfCells())])
    local = {link: (corners - poses_of[link][1]) @ poses_of[link][0] for link in links}
    nearest = np.argmin([np.abs(local[link][..., 2]).max(axis=1) for link in links], axis=0)
    values = {side: np.array([wings.GetCellData().GetArray(f"Cp_{side}").GetValue(i) for i in range(len(corners))])
              for side in ("dorsal", "ventral")}
    found = {}
    for number, link in enumerate(links):
        mine = nearest == number
        x, y = local[link][mine][..., 0], local[link][mine][..., 1]
        found[link] = dict(x=x.mean(axis=1), y=y.mean(axis=1), dx=np.ptp(x, axis=1), dy=np.ptp(y, axis=1),
                           **{side: value[mine] for side, value in values.items()})
    return found


def wing_surface(points, pose, facets):
    """The outline's surface with point data Cp_dorsal and Cp_ventral; the front of its faces is the ventral side."""
    flat = points.reshape(-1, 2)
    R, origin = pose
    data_points = np.column_stack([flat, np.zeros(len(flat))]) @ R.T + origin
    first = np.arange(ALONG * ACROSS).reshape(ALONG, ACROSS)
    quads = np.stack([first[:-1, :-1], first[:-1, 1:], first[1:, 1:], first[1:, :-1]], axis=-1).reshape(-1, 4)
    left = flat[-1, 1] < 0
    data = surface(data_points, quads[:, ::-1] if left else quads)
    share = pressure.weights(flat, facets)
    for side in ("dorsal", "ventral"):
        array = vtkFloatArray()
        array.SetName("Cp_" + side)
        for value in share @ facets[side]:
            array.InsertNextValue(float(value))
        data.GetPointData().AddArray(array)
    return data


def smooth_wings(model, columns, row, wings):
    """A vtkPolyData for each wing."""
    all_poses = poses(model, columns, row)
    facets = faces_of(wings, all_poses, list(model.wings))
    return [wing_surface(points, all_poses[link], facets[link]) for link, points in model.wings.items() if len(facets[link]["x"])]


def bodies(model, columns, row):
    all_poses = poses(model, columns, row)
    return [body_actor(corners, all_poses[link]) for link, corners in model.solids.items()]
