"""The scene of monarch render-field: vortices, the insect, and paths, drawn by VTK."""
import os

import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401 (VTK chooses its implementations by what is imported)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import (vtkCellDataToPointData, vtkContourFilter, vtkPolyDataConnectivityFilter, vtkReverseSense,
                                       vtkTubeFilter, vtkWindowedSincPolyDataFilter)
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLStructuredGridReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkActor2D, vtkColorTransferFunction, vtkPolyDataMapper, vtkPolyDataMapper2D,
                                         vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from monarch_flight.figures import insect_actors
from monarch_flight.film import scene
from monarch_flight.report.pressure import rounded_up

# Ends of the two scales, both told apart by eyes that see no red or no green.
BLUE, RED = (0.13, 0.29, 0.74), (0.73, 0.10, 0.13)
TEAL, ORANGE = (0.00, 0.45, 0.45), (0.90, 0.45, 0.00)


def diverging(limit, left, right):
    """Colours from `left` over near white to `right`, on [-limit, limit]."""
    scale = vtkColorTransferFunction()
    scale.SetColorSpaceToLab()
    scale.AddRGBPoint(0, 0.93, 0.93, 0.93)
    scale.AddRGBPoint(-limit, *left)
    scale.AddRGBPoint(limit, *right)
    return scale


def actor_of(data, array, scale, cells):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarModeToUseCellFieldData() if cells else mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(array)
    mapper.SetLookupTable(scale)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


COARSE = 0.15  # spans: where a cell is longer, a surface would only show the cells


def fade(grid, span):
    """Takes Q away from where cells are coarse, so that surfaces close before they tear."""
    shape = grid.GetDimensions()[::-1]
    points = vtk_to_numpy(grid.GetPoints().GetData()).reshape(*shape, 3)
    longest = np.zeros(shape)
    for axis in range(3):
        steps = np.linalg.norm(np.diff(points, axis=axis), axis=-1)
        ends = [(1, 0) if k == axis else (0, 0) for k in range(3)]
        longest = np.maximum(longest, np.maximum(np.pad(steps, ends), np.pad(steps, [pair[::-1] for pair in ends])))
    share = np.clip(2.0 - longest / (0.5 * COARSE * span), 0.0, 1.0).ravel()
    q = vtk_to_numpy(grid.GetPointData().GetArray("Q"))
    faded = numpy_to_vtk(q * share, deep=True)
    faded.SetName("Q shown")
    grid.GetPointData().AddArray(faded)
    grid.GetPointData().SetActiveScalars("Q shown")


def vortices(flow, q, span):
    to_points = vtkCellDataToPointData()
    to_points.SetInputData(flow)
    to_points.Update()
    grid = to_points.GetOutput()
    fade(grid, span)
    contour = vtkContourFilter()
    contour.SetInputData(grid)
    contour.SetValue(0, q)
    contour.ComputeScalarsOff()
    contour.ComputeNormalsOff()
    smooth = vtkWindowedSincPolyDataFilter()
    smooth.SetInputConnection(contour.GetOutputPort())
    smooth.SetNumberOfIterations(30)
    smooth.SetPassBand(0.05)
    smooth.NonManifoldSmoothingOn()
    smooth.NormalizeCoordinatesOn()
    smooth.Update()
    return with_normals(without_crumbs(smooth.GetOutput()))


def with_normals(data):
    normals = insect_actors.vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()


CRUMB = 150  # points: less is noise of a few cells


def without_crumbs(data):
    regions = vtkPolyDataConnectivityFilter()
    regions.SetInputData(data)
    regions.SetExtractionModeToAllRegions()
    regions.Update()
    sizes = vtk_to_numpy(regions.GetRegionSizes()) if regions.GetNumberOfExtractedRegions() else []
    regions.SetExtractionModeToSpecifiedRegions()
    for number, size in enumerate(sizes):
        if size >= CRUMB:
            regions.AddSpecifiedRegion(number)
    regions.Update()
    return regions.GetOutput()


def mirrored(data, east):
    """The image in the plane of symmetry of a longitudinal flight, x = east."""
    reflection = vtkTransform()
    reflection.Translate(2 * east, 0, 0)
    reflection.Scale(-1, 1, 1)
    image = vtkTransformPolyDataFilter()
    image.SetInputData(data)
    image.SetTransform(reflection)
    outside = vtkReverseSense()  # a reflection turns the surface inside out
    outside.SetInputConnection(image.GetOutputPort())
    outside.ReverseCellsOn()
    outside.ReverseNormalsOff()
    outside.Update()
    return outside.GetOutput()


def path(points, radius, colour):
    line = vtkPolyData()
    places, cells = vtkPoints(), vtkCellArray()
    for p in points:
        places.InsertNextPoint(p)
    cells.InsertNextCell(len(points))
    for i in range(len(points)):
        cells.InsertCellPoint(i)
    line.SetPoints(places)
    line.SetLines(cells)
    tube = vtkTubeFilter()
    tube.SetInputData(line)
    tube.SetRadius(radius)
    tube.SetNumberOfSides(12)
    tube.Update()
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(tube.GetOutput())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    return actor


def wing_actors(surfaces, limit):
    """Both sides, each by its own pressure: the front side of every face is the ventral one."""
    scale, actors = diverging(limit, BLUE, RED), []
    for wings in surfaces:
        dorsal, ventral = actor_of(wings, "Cp_dorsal", scale, False), actor_of(wings, "Cp_ventral", scale, False)
        dorsal.GetProperty().FrontfaceCullingOn()
        ventral.GetProperty().BackfaceCullingOn()
        for actor in (dorsal, ventral):
            actor.GetProperty().LightingOff()
            actors.append(actor)
    return actors, scale


STRIP = 0.14  # of the height: below the scene, where its measures stand


def scale_bar(renderer, size):
    """A bar of a round length at the right of the strip; the projection is parallel, so it holds everywhere."""
    seen = 2 * renderer.GetActiveCamera().GetParallelScale() / (1 - STRIP)  # m in the height of the picture
    power = 10.0 ** np.floor(np.log10(0.25 * seen))
    length = max(step * power for step in (1, 2, 5) if step * power <= 0.25 * seen)
    pixels, right, low = length / seen * size[1], size[0] - 60, 60
    line, places, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    for x, y in ((right - pixels, low + 10), (right - pixels, low), (right, low), (right, low + 10)):
        places.InsertNextPoint(x, y, 0)
    cells.InsertNextCell(4)
    for i in range(4):
        cells.InsertCellPoint(i)
    line.SetPoints(places)
    line.SetLines(cells)
    mapper, actor = vtkPolyDataMapper2D(), vtkActor2D()
    mapper.SetInputData(line)
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0, 0, 0)
    actor.GetProperty().SetLineWidth(3)
    text = vtkTextActor()
    text.SetInput(f"{1e3 * length:g} mm" if length < 0.01 else f"{1e2 * length:g} cm" if length < 1 else f"{length:g} m")
    text.GetTextProperty().SetFontSize(30)
    text.GetTextProperty().SetColor(0, 0, 0)
    text.GetTextProperty().SetJustificationToCentered()
    text.SetPosition(right - pixels / 2, low + 16)
    return actor, text


FLOWN, MEASURED = (0.80, 0.10, 0.12), (0.1, 0.1, 0.1)


def draw(flow_file, wing_file, insect, paths, direction, keys):
    """Writes the picture keys["picture"]. `insect`: model, columns of flight.csv and the row of this time; `paths`: flown, and
    measured where there is one."""
    readers = vtkXMLStructuredGridReader(), vtkXMLPolyDataReader()
    for reader, name in zip(readers, (flow_file, wing_file)):
        reader.SetFileName(name)
        reader.Update()
    flow, wings = (reader.GetOutput() for reader in readers)
    if flow.GetNumberOfCells() == 0 or wings.GetNumberOfCells() == 0:
        raise SystemExit("render_field: %s or %s holds nothing" % (flow_file, wing_file))
    q = keys["q"] or flow.GetFieldData().GetArray("Q_threshold").GetTuple1(0)
    body = flow.GetFieldData().GetArray("body").GetTuple3(0)
    sides = 2 if wings.GetBounds()[0] < body[0] < wings.GetBounds()[1] else 1  # a bare wing stands alone
    span = insect[0].span

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(0, STRIP, 1, 1)
    surface = vortices(flow, q, span)
    vorticity_scale = diverging(keys["vorticity"] or rounded_up(4 * q ** 0.5), TEAL, ORANGE)
    left_file = os.path.join(os.path.dirname(flow_file), "flow_left_" + os.path.basename(flow_file).split("_", 1)[1])
    if os.path.exists(left_file):  # both wings are solved
        left_reader = vtkXMLStructuredGridReader()
        left_reader.SetFileName(left_file)
        left_reader.Update()
        surfaces = [surface, vortices(left_reader.GetOutput(), q, span)]
    else:
        surfaces = [surface, mirrored(surface, body[0])][:sides]
    for data in surfaces:
        actor = actor_of(data, "spanwise_vorticity", vorticity_scale, False)
        actor.GetProperty().SetOpacity(0.5)
        actor.GetProperty().SetAmbient(0.35)
        actor.GetProperty().SetDiffuse(0.75)
        renderer.AddActor(actor)
    actors, pressure_scale = wing_actors(insect_actors.smooth_wings(*insect, wings), keys["cp"] or 1.0)
    for actor in actors + insect_actors.bodies(*insect):
        renderer.AddActor(actor)
    shown = renderer.ComputeVisiblePropBounds()  # the path may run out of the picture
    for points, colour in zip(paths, (FLOWN, MEASURED)):
        if len(points) > 1:
            renderer.AddActor(path(points, 0.012 * span, colour))

    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*body)
    camera.SetPosition(*(b + 10 * span * d for b, d in zip(body, direction)))
    camera.SetViewUp(*((0, 1, 0) if direction[2] > 0.9 else (0, 0, 1)))
    renderer.ResetCamera(shown)
    camera.Zoom(1.25)
    renderer.ResetCameraClippingRange()
    size = [int(n) for n in keys["size"].split("x")]
    save(renderer, strip(renderer, size, vorticity_scale, pressure_scale), size, keys["picture"])


def strip(renderer, size, vorticity_scale, pressure_scale):
    """What the scene is measured by, below it."""
    below = vtkRenderer()
    below.SetBackground(1, 1, 1)
    below.SetViewport(0, 0, 1, STRIP)
    for scale, title, x in (vorticity_scale, "spanwise vorticity [1/s]", 0.03), (pressure_scale, "wing Cp", 0.33):
        below.AddActor2D(scene.bar(scale, title, (0, 0, 0), (x, 0.02, 0.24, 0.96), size[1]))
    for one in scale_bar(renderer, size):
        below.AddActor2D(one)
    return below


def save(renderer, below, size, name):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*size)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    renderer.SetUseDepthPeeling(1)
    renderer.SetMaximumNumberOfPeels(8)
    window.AddRenderer(renderer)
    window.AddRenderer(below)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(name)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
