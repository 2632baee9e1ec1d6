"""The scene of a film, drawn by VTK: insect, vortices, path, ground, colour bars, caption."""
import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401 (VTK chooses its implementations by what is imported)
import vtkmodules.vtkRenderingFreeType  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersCore import (vtkCleanPolyData, vtkFlyingEdges3D, vtkPolyDataNormals, vtkTubeFilter,
                                       vtkWindowedSincPolyDataFilter)
from vtkmodules.vtkFiltersHybrid import vtkDepthSortPolyData
from vtkmodules.vtkFiltersSources import vtkLineSource
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkTextActor, vtkWindowToImageFilter)

from monarch_flight.film import wings as wing_data
from monarch_flight.report.pressure import weights

# Stops at equal distances, as src/viz/colours.cpp has them.
PRESSURE = ((0.13, 0.40, 0.67), (0.40, 0.66, 0.81), (0.82, 0.90, 0.94), (0.97, 0.97, 0.97), (0.99, 0.86, 0.78),
            (0.94, 0.54, 0.38), (0.70, 0.09, 0.17))
VORTICITY = ((0.00, 0.40, 0.37), (0.21, 0.59, 0.56), (0.60, 0.82, 0.78), (0.93, 0.93, 0.90), (0.98, 0.82, 0.52),
             (0.95, 0.60, 0.20), (0.80, 0.36, 0.03))
THEMES = {  # below, above, lines of the ground, path, words
    "dark": ((0.16, 0.18, 0.22), (0.06, 0.07, 0.09), (0.45, 0.50, 0.56), (0.45, 0.85, 0.60), (0.92, 0.93, 0.95)),
    "light": ((0.98, 0.98, 0.97), (0.86, 0.90, 0.95), (0.55, 0.60, 0.66), (0.10, 0.50, 0.28), (0.12, 0.13, 0.15))}


def table(stops, limit):
    at, fine = np.linspace(-1, 1, len(stops)), np.linspace(-1, 1, 256)
    out = vtkLookupTable()
    out.SetNumberOfTableValues(256)
    for i, value in enumerate(fine):
        out.SetTableValue(i, *(float(np.interp(value, at, [stop[c] for stop in stops])) for c in range(3)), 1.0)
    out.SetTableRange(-limit, limit)
    return out


def actor_of(data, lookup=None):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    if lookup is not None:
        mapper.SetLookupTable(lookup)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def place(actor, pose):
    m = vtkMatrix4x4()
    m.DeepCopy(pose.ravel())
    actor.SetUserMatrix(m)


def body(marker):
    """A part of the body, smooth."""
    clean = vtkCleanPolyData()
    clean.SetInputData(wing_data.triangles(wing_data.corners(marker)))
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(clean.GetOutputPort())
    normals.SplittingOff()
    normals.ConsistencyOn()
    normals.AutoOrientNormalsOn()
    normals.Update()
    actor = actor_of(normals.GetOutput())
    look = actor.GetProperty()
    look.SetColor(marker.color.r, marker.color.g, marker.color.b)
    look.SetAmbient(0.25)
    look.SetSpecular(0.35)
    look.SetSpecularPower(18)
    return actor


class Wing:
    """A wing in its own pattern, or in the colours of its pressure."""

    def __init__(self, marker, name, lookup, lift):
        self.name, self.lookup = name, lookup
        self.pattern = actor_of(wing_data.triangles(wing_data.corners(marker), wing_data.colours(marker)))
        self.sheet = wing_data.sheet(marker)
        self.points = wing_data.points_of(self.sheet)
        self.sides = [self.side(dorsal, lift) for dorsal in (True, False)]
        self.share = self.facets = None
        for actor in self.actors():
            actor.GetProperty().SetAmbient(0.62)
            actor.GetProperty().SetDiffuse(0.42)
            actor.GetProperty().SetInterpolationToFlat()

    def side(self, dorsal, lift):
        data = vtkPolyData()
        data.DeepCopy(self.sheet)
        wing_data.points_of(data)[:, 2] = -lift if dorsal else lift
        return actor_of(data, self.lookup)

    def actors(self):
        return [self.pattern, *self.sides]

    def show(self, pose, facets, per_pascal):
        for actor in self.actors():
            place(actor, pose)
        pressed = facets is not None
        self.pattern.SetVisibility(not pressed)
        for actor, column in zip(self.sides, (4, 5)):
            actor.SetVisibility(pressed)
            if pressed:
                self.colour(actor, facets, facets[:, column] * per_pascal)

    def colour(self, actor, facets, values):
        if self.share is None or not np.array_equal(facets[:, :4], self.facets):
            self.facets = facets[:, :4]
            places = dict(zip(("x", "y", "dx", "dy"), self.facets.T))
            self.share = weights(self.points, places).astype(np.float32)
        data = actor.GetMapper().GetInput()
        data.GetPointData().SetScalars(numpy_to_vtk(self.share @ values.astype(np.float32), deep=True))


class Vortices:
    """The surface of one Q around a wing. Its triangles are sorted by their distance from the camera: with depth peeling,
    by a processor alone, a frame would take twice as long."""

    def __init__(self, lookup, opacity, camera):
        self.image, self.edges = vtkImageData(), vtkFlyingEdges3D()
        self.edges.SetInputData(self.image)
        self.edges.ComputeNormalsOff()
        self.edges.ComputeScalarsOff()
        self.edges.InterpolateAttributesOn()
        smooth = vtkWindowedSincPolyDataFilter()
        smooth.SetInputConnection(self.edges.GetOutputPort())
        smooth.SetNumberOfIterations(12)
        smooth.SetPassBand(0.08)
        normals = vtkPolyDataNormals()
        normals.SetInputConnection(smooth.GetOutputPort())
        normals.SplittingOff()
        self.actor = vtkActor()
        self.actor.SetVisibility(False)
        farthest_first = vtkDepthSortPolyData()
        farthest_first.SetInputConnection(normals.GetOutputPort())
        farthest_first.SetProp3D(self.actor)
        farthest_first.SetCamera(camera)
        farthest_first.SetDirectionToBackToFront()
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(farthest_first.GetOutputPort())
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("omega")
        mapper.SetLookupTable(lookup)
        mapper.UseLookupTableScalarRangeOn()
        self.actor.SetMapper(mapper)
        look = self.actor.GetProperty()
        look.SetOpacity(opacity)
        look.SetAmbient(0.22)
        look.SetDiffuse(0.80)
        look.SetSpecular(0.30)
        look.SetSpecularPower(24)

    def show(self, pose, found, q):
        self.actor.SetVisibility(found is not None)
        if found is None:
            return
        self.image.SetDimensions(*found.size)
        self.image.SetOrigin(*found.origin)
        self.image.SetSpacing(*3 * (found.spacing,))
        for name, values in (("q_root", found.q_root), ("omega", found.omega)):
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            self.image.GetPointData().AddArray(array)
        self.image.GetPointData().SetActiveScalars("q_root")
        self.image.Modified()
        self.edges.SetValue(0, q**0.5)
        place(self.actor, pose)


def tube(points, radius, colour):
    line = vtkLineSource()
    data = wing_data.vtkPoints()
    for p in points:
        data.InsertNextPoint(*p)
    line.SetPoints(data)
    round_line = vtkTubeFilter()
    round_line.SetInputConnection(line.GetOutputPort())
    round_line.SetRadius(radius)
    round_line.SetNumberOfSides(10)
    round_line.CappingOn()
    round_line.Update()
    actor = actor_of(round_line.GetOutput())
    actor.GetMapper().ScalarVisibilityOff()
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetAmbient(0.5)
    return actor


def ground(centre, half, spacing, colour):
    """Lines every `spacing` [m] in a plane, fading to all sides, around `centre`."""
    n = int(half / spacing)
    middle = np.round(np.array(centre[:2]) / spacing) * spacing
    ends, shades = [], []
    pieces = np.linspace(-half, half, 33)
    for along in (0, 1):
        for i in range(-n, n + 1):
            for a, b in zip(pieces[:-1], pieces[1:]):
                for t in (a, b):
                    p = np.zeros(3)
                    p[along], p[1 - along], p[2] = middle[along] + t, middle[1 - along] + i * spacing, centre[2]
                    ends.append(p)
                    shades.append((*colour, 0.75 * max(0.0, 1.0 - np.hypot(t, i * spacing) / half)))
    data = wing_data.triangles(np.zeros((0, 3)))
    points = wing_data.vtkPoints()
    points.SetData(numpy_to_vtk(np.array(ends, dtype=np.float32), deep=True))
    cells = wing_data.vtkCellArray()
    cells.SetData(2, numpy_to_vtk(np.arange(len(ends), dtype=np.int64), deep=True, array_type=12))
    data.SetPoints(points)
    data.SetLines(cells)
    data.GetPointData().SetScalars(numpy_to_vtk((255 * np.array(shades)).astype(np.uint8), deep=True))
    actor = actor_of(data)
    actor.GetProperty().SetLighting(False)
    return actor


def words(text, size, colour, x, y, right=False):
    actor = vtkTextActor()
    actor.SetInput(text)
    look = actor.GetTextProperty()
    look.SetFontSize(size)
    look.SetColor(*colour)
    look.SetJustificationToRight() if right else look.SetJustificationToLeft()
    actor.SetPosition(x, y)
    return actor


def bar(lookup, title, colour, box, height):
    """A colour bar within `box`: left, low, width, height as shares of the view; `height` of the picture in pixels."""
    legend = vtkScalarBarActor()
    legend.SetLookupTable(lookup)
    legend.SetTitle("\n" + title)  # away from the numbers
    legend.GetTitleTextProperty().SetLineSpacing(0.45)
    legend.SetOrientationToHorizontal()
    legend.SetNumberOfLabels(3)
    legend.SetLabelFormat("%.4g")
    legend.SetPosition(*box[:2])
    legend.SetWidth(box[2])
    legend.SetHeight(box[3])
    legend.SetBarRatio(0.16)
    legend.SetVerticalTitleSeparation(int(0.012 * height))
    legend.SetTextPad(int(0.005 * height))
    legend.SetTextPositionToPrecedeScalarBar()
    legend.UnconstrainedFontSizeOn()
    for text, size in ((legend.GetTitleTextProperty(), 0.027), (legend.GetLabelTextProperty(), 0.023)):
        text.SetColor(*colour)
        text.SetFontSize(max(9, int(size * height)))
        text.BoldOff()
        text.ItalicOff()
        text.ShadowOff()
    return legend


class Stage:
    """A window without a screen; frames are drawn twice as large, and made smooth by that."""

    def __init__(self, size, theme, flat, sharp=2):
        self.size, self.sharp = size, sharp
        self.renderer, self.window = vtkRenderer(), vtkRenderWindow()
        self.renderer.SetGradientBackground(not flat)
        self.renderer.SetBackground(*theme[0])
        self.renderer.SetBackground2(*theme[1])
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetAlphaBitPlanes(1)
        self.window.SetSize(sharp * size[0], sharp * size[1])
        self.window.AddRenderer(self.renderer)
        self.renderer.AutomaticLightCreationOff()
        for toward, strength in (((0.4, 0.5, 1.0), 0.85), ((-0.8, -0.6, 0.3), 0.30)):
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(*toward)
            light.SetFocalPoint(0, 0, 0)
            light.SetIntensity(strength)
            self.renderer.AddLight(light)

    @property
    def camera(self):
        return self.renderer.GetActiveCamera()

    def look(self, focus, position, up, clear):
        """From there; `clear`: actors that are seen through, of which the farthest must be drawn first."""
        camera = self.camera
        camera.SetViewAngle(26)
        camera.SetFocalPoint(*focus)
        camera.SetPosition(*position)
        camera.SetViewUp(*up)
        self.renderer.ResetCameraClippingRange()
        for actor in sorted(clear, key=lambda a: -np.linalg.norm(np.subtract(a.GetCenter(), position))):
            self.renderer.RemoveActor(actor)
            self.renderer.AddActor(actor)

    def frame(self):
        """RGB, 8 bit, first row on top."""
        self.window.Render()
        image = vtkWindowToImageFilter()
        image.SetInput(self.window)
        image.ReadFrontBufferOff()
        image.ShouldRerenderOff()
        image.Update()
        width, height, _ = image.GetOutput().GetDimensions()
        pixels = vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3]
        n = self.sharp
        rows = sum(pixels[i::n].astype(np.uint16) for i in range(n))
        total = sum(rows[:, i::n] for i in range(n))
        return ((total + n * n // 2) // (n * n)).astype(np.uint8)
