#!/usr/bin/python3
"""monarch identify finds the hinge of a flight again from the wing pitch that it recorded."""
import os
import subprocess
import unittest

import flying
import yaml

HIDDEN = {"insect/wing/kappa": 7.3e-5, "insect/wing/theta_0": -0.12, "insect/wing/planform/hinge": 0.06}
STUDY = """
name: found
case: {case}
unknown:
  insect/wing/kappa: {{start: 9.0e-5, range: [4.0e-5, 2.0e-4]}}
  insect/wing/theta_0: {{start: 0.05, range: [-0.4, 0.4]}}
  insect/wing/planform/hinge: {{start: 0.1, range: [-0.1, 0.3]}}
measured: {{angle: theta_R, file: {measured}}}
compare: [1, 2]
stages:
  - {{name: again, fluid: quasi_steady, steps_per_flap: 120}}
"""


class Identify(flying.FlightTest):
    def identify(self, *words):
        done = subprocess.run([flying.MONARCH, "identify", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              env=self.environment())
        return done.returncode, done.stdout

    def study(self, text):
        path = self.out("study.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_a_known_hinge_is_found_again(self):
        from monarch_flight import case_files
        from monarch_flight.identification.study import place
        case = case_files.read(case_files.path_of("passive_pitch"))
        for key, value in HIDDEN.items():
            place(case, key, value)
        hidden = self.out("hidden.yaml")
        with open(hidden, "w", encoding="utf-8") as file:
            file.write(case_files.text(case))
        code, output = self.fly("case:=" + hidden, "in_process:=true", "record:=false", "flaps:=2", "steps_per_flap:=120",
                                "out:=" + self.out("flown"))
        self.assertEqual(code, 0, output)
        path = self.study(STUDY.format(case="passive_pitch", measured=os.path.join(self.out("flown"), "flight.csv")))
        code, output = self.identify(path, "out:=" + self.out("found"))
        self.assertEqual(code, 0, output)
        with open(self.out("found/identification.yaml"), encoding="utf-8") as file:
            found = yaml.safe_load(file)
        for key, value in HIDDEN.items():
            self.assertAlmostEqual(found["unknowns"][key]["value"], value, delta=1e-3 * abs(value), msg=output)
        self.assertLess(found["stages"][-1]["rms_deg"], 0.01)
        self.assertTrue(os.path.getsize(self.out("found/residual.png")) > 10000)
        code, output = self.fly("case:=" + self.out("found/found.yaml"), "in_process:=true", "record:=false", "flaps:=0.1",
                                "out:=" + self.out("flown_again"))
        self.assertEqual(code, 0, output)
        code, output = self.identify(path, "out:=" + self.out("found"))
        self.assertEqual(code, 0, output)
        self.assertIn("\n0 flights flown", output)

    def test_a_flight_that_is_refused(self):
        text = STUDY.format(case="passive_pitch", measured="measured.csv").replace("wing/kappa", "wing/kapa")
        with open(self.out("measured.csv"), "w", encoding="utf-8") as file:
            file.write("t,theta_R\n" + "".join("%g,0\n" % (0.04 * i) for i in range(10)))
        code, output = self.identify(self.study(text), "out:=" + self.out("found"))
        self.assertEqual(code, 2, output)
        self.assertIn("insect/wing/kapa", output)
        self.assertIn("a flight of the study was refused", output)


if __name__ == "__main__":
    unittest.main()
