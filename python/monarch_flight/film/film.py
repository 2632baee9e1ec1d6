"""A film of a recorded flight, frame by frame."""
import time

import numpy as np

from monarch_flight.film import scene, wings
from monarch_flight.film.encode import Encoder
from monarch_flight.film.flight import Block, Flight, pressure
from monarch_flight.film.views import Camera
from monarch_flight.report.pressure import rounded_up
from monarch_flight.telling import say

WINGS = ("right_wing", "left_wing")
AIR = 0.5  # of rho U^2 / 2
BARS = ((0.765, 0.82, 0.21, 0.16), (0.765, 0.69, 0.21, 0.16))  # left, low, width, height, as shares of the picture


class Scales:
    """Of a flight: what its colours and surfaces are measured by."""

    def __init__(self, flight, level):
        outline = np.concatenate([[(p.x, p.y) for p in m.points] for m in flight.model[:1]])
        self.span = np.ptp(outline[:, 1])
        self.speed = self.tip_speed(flight, outline)
        self.per_pascal = 1.0 / (AIR * flight.case["fluid"]["density"] * self.speed**2)
        self.q = level * (self.speed / self.chord(flight)) ** 2
        self.cp, self.omega = self.largest_cp(flight), self.largest_omega(flight)

    def chord(self, flight):
        """Mean chord [m]: of the ground of the recorded wing."""
        ground = wings.ground(flight.model[0])
        sides = ground[:, 1] - ground[:, 0], ground[:, 2] - ground[:, 0]
        return 0.5 * np.abs(np.cross(*sides)[:, 2]).sum() / self.span

    @staticmethod
    def tip_speed(flight, outline):
        """Largest speed of the wing's outline in the first flap [m/s]."""
        times = [t for t in flight.poses.times if t <= (flight.period or flight.duration)]
        rim = outline[np.unique([outline[:, 0].argmax(), outline[:, 0].argmin(), outline[:, 1].argmax()])]
        rim = np.column_stack([rim, np.zeros(len(rim)), np.ones(len(rim))])
        places = np.array([(flight.pose("right_wing", t) @ rim.T)[:3].T for t in times])
        steps = np.linalg.norm(np.diff(places, axis=0), axis=2)
        return float((steps / np.diff(times)[:, None]).max())

    def largest_cp(self, flight):
        values = [np.abs(pressure(m)[:, 4:]).ravel() for s in flight.pressure.values() for m in s.messages[1:]]
        return rounded_up(self.per_pascal * np.percentile(np.concatenate(values), 96)) if values else None

    def largest_omega(self, flight):
        found = []
        for series in flight.flow.values():
            for message in series.messages[:: max(1, len(series) // 20)]:
                block = Block(message)
                found.append(np.abs(block.omega[block.q_root > self.q**0.5]))
        found = np.concatenate(found) if found else np.zeros(0)
        return rounded_up(np.percentile(found, 80)) if len(found) else None


class Film:
    """The scene of a flight at any time of it."""

    def __init__(self, flight, wanted):
        self.flight, self.wanted = flight, wanted
        self.scales = Scales(flight, wanted["q"])
        self.theme = scene.THEMES[wanted["theme"]]
        self.stage = scene.Stage(wanted["size"], self.theme, wanted["flat"])
        self.renderer = self.stage.renderer
        self.camera = Camera(flight, wanted["view"], wanted["distance"] * self.scales.span)
        self.build()

    def build(self):
        scales, flight = self.scales, self.flight
        cp = scene.table(scene.PRESSURE, scales.cp or 1.0)
        omega = scene.table(scene.VORTICITY, scales.omega or 1.0)
        self.wings, self.bodies, self.vortices, self.path = {}, [], {}, None
        for marker in flight.model:
            frame = marker.header.frame_id[len(flight.prefix):]
            if frame in WINGS:
                self.wings[frame] = scene.Wing(marker, frame, cp, 0.002 * scales.span)
                self.vortices[frame] = scene.Vortices(omega, self.wanted["opacity"], self.stage.camera)
            else:
                self.bodies.append((frame, scene.body(marker)))
        actors = [a for wing in self.wings.values() for a in wing.actors()] + [a for _, a in self.bodies]
        self.add_ground()  # first: it is seen through the vortices
        for actor in actors + [v.actor for v in self.vortices.values()]:
            self.renderer.AddActor(actor)
        self.add_legends(cp, omega)
        self.stage.frame()  # the colour bars find the places of their words while they are drawn first

    def add_ground(self):
        spacing = 0.02 if self.scales.span < 0.2 else 0.1 * self.scales.span
        low = self.camera.path[:, 2].min() - 1.1 * self.scales.span
        centre = (*self.camera.path[:, :2].mean(axis=0), low)
        reach = np.ptp(self.camera.path[:, :2], axis=0).max() / 2 + 4 * self.scales.span
        self.renderer.AddActor(scene.ground(centre, reach, spacing, self.theme[2]))
        self.grid = spacing

    def add_legends(self, cp, omega):
        _, height = (self.stage.sharp * n for n in self.wanted["size"])
        shown = []
        if self.flight.pressure and self.wanted["wings"] == "pressure":
            shown.append((cp, "pressure coefficient"))
        if self.flight.flow:
            shown.append((omega, "vorticity along the span [1/s]"))
        for (colours, title), box in zip(shown, BARS):
            self.renderer.AddActor2D(scene.bar(colours, title, self.theme[4], box, height))
        self.caption = scene.words("", int(0.034 * height), self.theme[4], 0.03 * height, 0.94 * height)
        self.renderer.AddActor2D(self.caption)
        note = scene.words(f"grid {1000 * self.grid:g} mm", int(0.024 * height), self.theme[4],
                           self.stage.sharp * self.wanted["size"][0] - 0.03 * height, 0.04 * height, right=True)
        self.renderer.AddActor2D(note)

    def frame(self, t):
        flight, scales = self.flight, self.scales
        for name, wing in self.wings.items():
            pose = flight.pose(name, t)
            facets = flight.facets(name, t) if self.wanted["wings"] == "pressure" else None
            wing.show(pose, facets, scales.per_pascal)
            self.vortices[name].show(pose, flight.block(name, t), scales.q)
        for frame, actor in self.bodies:
            scene.place(actor, flight.pose(frame, t))
        self.show_path(t)
        flaps = f"   flap {t / flight.period:.2f}" if flight.period else ""
        self.caption.SetInput(f"t = {1000 * t:.0f} ms{flaps}")
        seen = [v.actor for v in self.vortices.values() if v.actor.GetVisibility()]
        self.stage.look(*self.camera.at(t), seen)
        return self.stage.frame()

    def show_path(self, t):
        if self.path is not None:
            self.renderer.RemoveActor(self.path)
        times = [u for u in self.flight.poses.times if u <= t][::8]
        if len(times) < 2:
            self.path = None
            return
        points = [self.flight.pose("base_link", u)[:3, 3] for u in times]
        self.path = scene.tube(points, 0.006 * self.scales.span, self.theme[3])
        self.renderer.AddActor(self.path)


def frame_times(flight, wanted):
    """Times of the flight [s] that the frames show."""
    unit = flight.period or 1.0
    begin = wanted["from"] * unit
    end = min(flight.duration, wanted["to"] * unit if wanted["to"] else flight.duration)
    count = max(1, int(round((end - begin) * wanted["slow"] * wanted["fps"])))
    return begin + np.arange(count) * (end - begin) / count


def make(bag, out, wanted):
    """Writes the film of a bag."""
    began = time.monotonic()
    flight = Flight(bag)
    film = Film(flight, wanted)
    times = frame_times(flight, wanted)
    say(f"{len(times)} frames", "film")
    with Encoder(out, wanted["size"], wanted["fps"]) as encoder:
        for i, t in enumerate(times):
            encoder.add(film.frame(t))
            if i % 25 == 24:
                say(f"frame {i + 1} of {len(times)}, {time.monotonic() - began:.0f} s", "film")
    say(f"{out}, {time.monotonic() - began:.0f} s", "film")
