#!/usr/bin/python3
"""A short flight in Navier-Stokes air: pictures of the flow do not touch it, and a film is made of them."""
import importlib.util
import json
import os
import shutil
import subprocess
import unittest

import flying


def hash_of(folder):
    with open(os.path.join(folder, "summary.json")) as f:
        return json.load(f)["state_sha256"]


class Film(flying.FlightTest):
    def flown(self, name, output, *keys):
        with open(os.path.join(flying.ROOT, "config", "cases", "tethered_fwuav.yaml")) as f:
            head, rest = f.read().split("\ngrid:\n")
        case = os.path.join(self.folder, name + ".yaml")
        with open(case, "w") as f:
            f.write(head + "\ngrid:\n  cells_per_chord: 6\n  far_field: 3\n" + rest + "\noutput: {" + output + "}\n")
        code, told = self.fly("case:=" + case, "flaps:=0.02", "steps_per_flap:=400", "out:=" + self.out(name), *keys)
        self.assertEqual(code, 0, told)
        return self.out(name)

    def test_a_film_of_a_flight_that_its_pictures_do_not_touch(self):
        seen = self.flown("seen", "flow_every: 2, surface_every: 2, flow_points: 5000", "ranks:=2")
        unseen = self.flown("unseen", "flow_every: 0, surface_every: 0", "ranks:=2")
        self.assertEqual(hash_of(seen), hash_of(unseen))
        self.look(seen)

    def look(self, folder):
        if importlib.util.find_spec("vtkmodules") is None or not (shutil.which("Xvfb") and shutil.which("ffprobe")):
            self.skipTest("python3-vtk9, xvfb or ffmpeg is not installed (scripts/install film)")
        for name, most in ("film.mp4", 1 << 24), ("film.gif", 256):  # colours that the format has
            film = self.out(name)
            done = subprocess.run([flying.MONARCH, "film", folder, film, "size:=160x120", "slow:=100", "fps:=20"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200)
            self.assertEqual(done.returncode, 0, done.stdout)
            told = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                   "stream=width,height,nb_read_frames", "-of", "json", film],
                                  capture_output=True, text=True, check=True).stdout
            stream = json.loads(told)["streams"][0]
            self.assertEqual((160, 120), (stream["width"], stream["height"]))
            # 0.02 flaps, a hundred times slower, 20 frames a second.
            self.assertAlmostEqual(float(stream["nb_read_frames"]), 0.02 / self.frequency(folder) * 100 * 20, delta=1)
            self.assertGreater(len(self.colours(film)), min(300, 0.6 * most))  # more than ground and words
        self.assertEqual([], [name for name in os.listdir(self.folder) if "partial" in name])

    def frequency(self, folder):
        import yaml
        with open(os.path.join(folder, "case.yaml")) as f:
            return yaml.safe_load(f)["motion"]["frequency"]

    def colours(self, film):
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", film, "-frames:v", "1", "-f", "rawvideo", "-pix_fmt",
                              "rgb24", "-"], capture_output=True, check=True).stdout
        return {raw[i:i + 3] for i in range(0, len(raw), 3)}


if __name__ == "__main__":
    unittest.main()
