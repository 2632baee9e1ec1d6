#!/usr/bin/python3
"""The page of a flight: its numbers are those of the run; it is drawn and plays in a browser, alone and without a network."""
import base64
import json
import os
import pathlib
import re
import secrets
import signal
import subprocess
import unittest

import numpy as np

import flying
from monarch_flight.report import page, pressure, provenance
from monarch_flight.keys import Refused
from monarch_flight.runs import watched

QUICK = ("fluid:=quasi_steady", "in_process:=true", "checkpoint_every:=0")
BROWSER, DRIVER = "/usr/bin/chromium-headless-shell", "/usr/bin/chromedriver"


def array(packed):
    return np.frombuffer(base64.b64decode(packed["data"]), packed["type"]).reshape(packed["shape"])


def data_of(path):
    """What the page holds for its scripts."""
    text = pathlib.Path(path).read_text(encoding="utf-8")
    return json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', text, re.S)[1])


def curve(run, title, name):
    chart = next(chart for chart in run["charts"] if chart["title"] == title)
    return array(next(curve for curve in chart["curves"] if curve["name"] == name)["y"])


def columns(folder):
    names, rows = flying.table(folder, "flight.csv")
    return dict(zip(names, np.array(rows).T))


class Report(flying.FlightTest):
    def flown(self, name, *words):
        code, output = self.fly(*QUICK, *words, "out:=" + self.out(name))
        self.assertEqual(code, 0, output)
        return pathlib.Path(self.out(name)), output

    def page_of(self, *folders):
        """The data of the page that monarch report writes of these runs."""
        out = self.out("page.html")
        done = subprocess.run([flying.MONARCH, "report", *map(str, folders), "out:=" + out], env=self.environment(), text=True,
                              capture_output=True, check=False)
        self.assertEqual((done.returncode, done.stdout.strip()), (0, out), done.stderr)
        return data_of(out)

    def test_numbers_are_those_of_the_run(self):
        folder, output = self.flown("run", "flaps:=0.5", "report:=true")
        self.assertTrue(output.rstrip().endswith(f"see the flight in a browser: {folder}/report.html"), output)
        run, c = data_of(folder / "report.html")["runs"][0], columns(folder)
        for (title, name), wanted in {
                ("Body pitch", "pitch"): np.degrees(c["theta_B"]), ("Wing pitch", "pitch"): np.degrees(c["theta_R"]),
                ("Wingbeat and abdomen", "flapping"): np.degrees(c["phi"]), ("Air force on both wings", "up"): -1e3 * c["FZ"],
                ("Sub-iterations of a step", "sub-iterations"): c["sub_iterations"]}.items():
            np.testing.assert_allclose(curve(run, title, name), wanted, rtol=1e-6, atol=1e-6, err_msg=title)
        np.testing.assert_allclose(array(run["t"]), 10.2 * c["t"], rtol=1e-6, atol=1e-7)
        place = array(run["frames"]["place"])
        np.testing.assert_allclose(place[-1], [c["y"][-1] - c["y"][0], c["x"][-1] - c["x"][0], c["z"][0] - c["z"][-1]], atol=1e-6)
        self.assertLess(os.path.getsize(folder / "report.html"), 5e6)
        self.assertEqual(array(run["pressure"]["right_wing"]).shape[1:], (2, 360))
        self.assertIsNotNone(run["measured"])

    def test_without_a_bag_two_wings_and_a_bare_one(self):
        folders = [self.flown("plain", "flaps:=0.2", "record:=false")[0], self.flown("bare", "case:=hinge", "flaps:=0.2")[0],
                   self.flown("two", "case:=climb_turning", "flaps:=0.1")[0]]
        self.assertFalse((folders[0] / "report.html").exists())  # report:=false
        plain, bare, two = self.page_of(*folders)["runs"]
        self.assertIsNone(plain["pressure"])
        self.assertEqual((set(bare["wings"]), bare["solids"], bare["measured"]), ({"right_wing"}, {}, None))
        self.assertEqual(set(two["pressure"]), {"t", "right_wing", "left_wing"})
        np.testing.assert_allclose(curve(two, "Wing pitch", "left"), np.degrees(columns(folders[2])["theta_L"]), rtol=1e-6, atol=1e-5)

    def test_what_is_missing_is_named(self):
        done = subprocess.run([flying.MONARCH, "report", self.folder], env=self.environment(), text=True, capture_output=True,
                              check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("flight.csv: does not exist", done.stderr)
        libraries, page.LIBRARIES = page.LIBRARIES, "/nowhere"
        self.addCleanup(setattr, page, "LIBRARIES", libraries)
        with self.assertRaisesRegex(Refused, "scripts/install report"):
            page.page([pathlib.Path(self.folder)])

    @unittest.skipUnless(os.access(BROWSER, os.X_OK) and os.access(DRIVER, os.X_OK),
                         "no chromium-headless-shell here: scripts/install page")
    def test_drawn_and_played_in_a_browser(self):
        try:
            from selenium import webdriver
        except ModuleNotFoundError:
            self.skipTest("no selenium here: scripts/install page")
        folder, _ = self.flown("run", "flaps:=0.5", "report:=true")
        options = webdriver.ChromeOptions()
        options.binary_location = BROWSER
        for word in ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--window-size=420,600"):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        os.environ[watched.MARK] = mark = secrets.token_hex(8)  # the browser may outlive its driver
        self.addCleanup(lambda: watched.send(watched.marked(mark), signal.SIGKILL))
        browser = webdriver.Chrome(service=webdriver.chrome.service.Service(DRIVER), options=options)
        self.addCleanup(browser.quit)
        browser.set_script_timeout(60)
        browser.get(f"file://{folder}/report.html#still")
        clock = "return monarchReport.clock.t"
        self.assertEqual(browser.execute_script(clock), 0)
        colours = browser.execute_script(
            "const c = document.getElementById('view'), p = document.createElement('canvas'); p.width = p.height = 64;"
            "const d = p.getContext('2d'); d.drawImage(c, 0, 0, 64, 64);"
            "const a = d.getImageData(0, 0, 64, 64).data; return new Set(Array.from({length: 4096}, (_, i) =>"
            "a[4 * i] << 16 | a[4 * i + 1] << 8 | a[4 * i + 2])).size")
        self.assertGreater(colours, 20)  # a blank view has one
        browser.find_element("id", "play").click()
        self.wait_for(lambda: browser.execute_script(clock) > 0.01, 60, "time to go on")
        browser.find_element("id", "play").click()
        browser.execute_script("const s = document.getElementById('scrub'); s.value = 500; s.dispatchEvent(new Event('input'))")
        self.assertAlmostEqual(browser.execute_script(clock), 0.25, 6)
        self.assertIn("0.25 flaps", browser.find_element("id", "time").text)
        self.assertLessEqual(browser.execute_script("return document.documentElement.scrollWidth - innerWidth"), 0)
        self.assertEqual([entry["message"] for entry in browser.get_log("browser") if entry["level"] == "SEVERE"], [])
        asked = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
        urls = [one["params"]["request"]["url"] for one in asked if one["method"] == "Network.requestWillBeSent"]
        self.assertEqual([url for url in urls if not url.startswith(("file:", "data:", "blob:"))], [])


class Parts(unittest.TestCase):
    def test_pressure_of_one_value_stays_it(self):
        facets = np.zeros(6, [(name, "<f4") for name in pressure.FIELDS])
        facets["x"], facets["y"], facets["dx"], facets["dy"] = [0, 1, 2, 0, 1, 2], [0, 0, 0, 1, 1, 1], 1, 1
        share = pressure.weights(np.array([[0.5, 0.5], [9.0, -4.0], [2.0, 0.0]]), facets)
        np.testing.assert_allclose(share.sum(axis=1), 1)
        np.testing.assert_allclose(share[0, [0, 1, 3, 4]], share[0, 0])  # in the middle of four
        self.assertEqual(share[1].argmax(), 2)  # far outside: the nearest one
        self.assertEqual(share[2].argmax(), 2)

    def test_scale_of_colours_is_round_and_covers(self):
        self.assertEqual(pressure.limit([np.array([-1.7, 0.2])]), 2)
        self.assertEqual(pressure.limit([np.array([0.031] * 500), np.array([9.0])]), 10)
        self.assertEqual(pressure.limit([np.array([0.031] * 500)]), 0.05)

    def test_comments_belong_to_the_key_below(self):
        text = "a:\n  # Mass; status: given\n  b: 1\n\n  c: 2\n# two\n# lines; status: assumed, as x\nd: {e: 1}\n"
        found = dict(provenance.commented(text))
        self.assertEqual(found, {"a/b": "Mass; status: given", "d": "two lines; status: assumed, as x"})
        self.assertEqual([provenance.kind(comment) for comment in found.values()], ["given", "assumed"])


if __name__ == "__main__":
    unittest.main()
