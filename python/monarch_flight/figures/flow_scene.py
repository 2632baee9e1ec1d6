"""The scene of monarch render-field: vortices, wings and path, drawn by VTK."""
import os

import vtkmodules.vtkInteractionStyle  # noqa: F401 (VTK chooses its implementations by what is imported)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData, vtkContourFilter, vtkReverseSense, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLStructuredGridReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkWindowToImageFilter)

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


def vortices(flow, q):
    to_points = vtkCellDataToPointData()
    to_points.SetInputData(flow)
    to_points.Update()
    grid = to_points.GetOutput()
    grid.GetPointData().SetActiveScalars("Q")
    contour = vtkContourFilter()
    contour.SetInputData(grid)
    contour.SetValue(0, q)
    contour.ComputeScalarsOff()
    contour.Update()
    return contour.GetOutput()


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


def path(points, radius):
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
    actor.GetProperty().SetColor(0.15, 0.15, 0.15)
    return actor


def bar(scale, title, x):
    legend = vtkScalarBarActor()
    legend.SetLookupTable(scale)
    legend.SetTitle(title)
    legend.SetNumberOfLabels(5)
    legend.SetPosition(x, 0.05)
    legend.SetWidth(0.12)
    legend.SetBarRatio(0.2)
    legend.SetHeight(0.36)
    legend.SetLabelFormat("%.3g")
    legend.UnconstrainedFontSizeOn()
    for text, size in ((legend.GetTitleTextProperty(), 26), (legend.GetLabelTextProperty(), 22)):
        text.SetColor(0, 0, 0)
        text.SetFontSize(size)
        text.BoldOff()
        text.ItalicOff()
        text.ShadowOff()
    return legend


def wing_actors(wings, limit):
    """Both sides, each by its own pressure: the front side of every face is the ventral one."""
    scale = diverging(limit, BLUE, RED)
    dorsal, ventral = actor_of(wings, "Cp_dorsal", scale, True), actor_of(wings, "Cp_ventral", scale, True)
    dorsal.GetProperty().FrontfaceCullingOn()
    ventral.GetProperty().BackfaceCullingOn()
    for actor in (dorsal, ventral):
        actor.GetProperty().LightingOff()
    return [dorsal, ventral], scale


def draw(flow_file, wing_file, points, direction, keys):
    """Writes the picture keys["picture"]."""
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
    bounds = wings.GetBounds()
    span = max(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    surface = vortices(flow, q)
    vorticity_scale = diverging(keys["vorticity"] or 4 * q ** 0.5, TEAL, ORANGE)
    left_file = os.path.join(os.path.dirname(flow_file), "flow_left_" + os.path.basename(flow_file).split("_", 1)[1])
    if os.path.exists(left_file):  # both wings are solved
        left_reader = vtkXMLStructuredGridReader()
        left_reader.SetFileName(left_file)
        left_reader.Update()
        surfaces = [surface, vortices(left_reader.GetOutput(), q)]
    else:
        surfaces = [surface, mirrored(surface, body[0])][:sides]
    for data in surfaces:
        actor = actor_of(data, "spanwise_vorticity", vorticity_scale, False)
        actor.GetProperty().SetOpacity(0.6)
        actor.GetProperty().SetAmbient(0.35)
        actor.GetProperty().SetDiffuse(0.75)
        renderer.AddActor(actor)
    actors, pressure_scale = wing_actors(wings, keys["cp"] or 1.0)
    for actor in actors:
        renderer.AddActor(actor)
    shown = renderer.ComputeVisiblePropBounds()  # the path may run out of the picture
    if len(points) > 1:
        renderer.AddActor(path(points, 0.006 * span))
    renderer.AddActor2D(bar(vorticity_scale, "spanwise\nvorticity [1/s]", 0.01))
    renderer.AddActor2D(bar(pressure_scale, "wing\nCp", 0.14))

    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*body)
    camera.SetPosition(*(b + 10 * span * d for b, d in zip(body, direction)))
    camera.SetViewUp(*((0, 1, 0) if direction[2] > 0.9 else (0, 0, 1)))
    renderer.ResetCamera(shown)
    camera.Zoom(1.25)
    renderer.ResetCameraClippingRange()
    save(renderer, [int(n) for n in keys["size"].split("x")], keys["picture"])


def save(renderer, size, name):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*size)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    renderer.SetUseDepthPeeling(1)
    renderer.SetMaximumNumberOfPeels(8)
    window.AddRenderer(renderer)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(name)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
