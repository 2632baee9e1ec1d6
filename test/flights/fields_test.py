#!/usr/bin/python3
"""Files of the flow from one process and from nodes with two processes of the fluid: the same; and a picture of them."""
import importlib.util
import os
import re
import shutil
import subprocess
import unittest

import flying

WANTED = ["fields.pvd"] + [kind % step for kind in ("flow_%08d.vts", "wing_%08d.vtp") for step in (2, 4)]


def has_vtk():
    """Whether this build can write them."""
    with open(os.path.join(flying.BUILD, "CMakeCache.txt")) as f:
        return re.search(r"^VTK_DIR:PATH=/", f.read(), re.M) is not None


@unittest.skipUnless(has_vtk(), "built without VTK")
class Fields(flying.FlightTest):
    def flown(self, name, *keys):
        with open(os.path.join(flying.ROOT, "config", "cases", "tethered_fwuav.yaml")) as f:
            head, rest = f.read().split("\ngrid:\n")
        case = os.path.join(self.folder, "small.yaml")
        with open(case, "w") as f:
            f.write(head + "\ngrid:\n  cells_per_chord: 6\n  far_field: 3\n" + rest)
        code, output = self.fly("case:=" + case, "flaps:=0.01", "steps_per_flap:=400", "fields_every:=2", "record:=false",
                                "out:=" + self.out(name), *keys)
        self.assertEqual(code, 0, output)
        folder = os.path.join(self.out(name), "fields")
        self.assertEqual(sorted(os.listdir(folder)), sorted(WANTED))
        return folder

    def test_nodes_on_two_processes_write_what_one_process_writes(self):
        alone, nodes = self.flown("alone", "in_process:=true"), self.flown("nodes", "ranks:=2")
        with open(alone + "/fields.pvd") as a, open(nodes + "/fields.pvd") as b:
            self.assertEqual(a.read(), b.read())
        self.compare(alone, nodes)
        self.render()

    def compare(self, alone, nodes):
        if importlib.util.find_spec("vtkmodules") is None:
            self.skipTest("python3-vtk9 is not installed")
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLStructuredGridReader
        values = []
        for folder in (alone, nodes):
            reader = vtkXMLStructuredGridReader()
            reader.SetFileName(folder + "/flow_00000004.vts")
            reader.Update()
            grid = reader.GetOutput()
            data = grid.GetCellData()
            values.append([vtk_to_numpy(grid.GetPoints().GetData()).copy()]
                          + [vtk_to_numpy(data.GetArray(name)).copy() for name in ("velocity", "pressure", "vorticity", "Q")])
        for one, two in zip(*values):  # single precision of fields that agree to 1e-10
            self.assertGreater(abs(one).max(), 0)
            self.assertLess(abs(one - two).max(), 1e-6 * abs(one).max())

    def render(self):
        if shutil.which("Xvfb") is None:
            self.skipTest("Xvfb is not installed")
        picture = self.out("flow.png")
        done = subprocess.run([flying.MONARCH, "render-field", self.out("alone"), picture, "size:=400x300"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("t/T = 0.010", done.stdout)
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOImage import vtkPNGReader
        reader = vtkPNGReader()
        reader.SetFileName(picture)
        reader.Update()
        self.assertEqual(reader.GetOutput().GetDimensions()[:2], (400, 300))
        colours = {tuple(c) for c in vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())}
        self.assertGreater(len(colours), 200)  # more than background and legends


if __name__ == "__main__":
    unittest.main()
