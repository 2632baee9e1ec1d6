#!/usr/bin/python3
"""The layouts for PlotJuggler and Foxglove hang together; that of Foxglove names topics and fields that there are."""
import json
import pathlib
import re
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
LAYOUTS = ROOT / "config/layouts"


def fields(message):
    """(type, name) of a message of this package."""
    text = (ROOT / "msg" / f"{message}.msg").read_text(encoding="utf-8")
    return {name: kind for kind, name in re.findall(r"(?m)^([A-Za-z_/0-9]+) +([a-z_0-9]+) *(?:#.*)?$", text)}


class Layouts(unittest.TestCase):
    def test_plotjuggler(self):
        """That its curves are columns of a flown flight.csv: test/flights/tutorials_test.py."""
        root = xml.etree.ElementTree.parse(LAYOUTS / "plotjuggler.xml").getroot()
        self.assertGreater(len(list(root.iter("curve"))), 5)
        for splitter in root.iter("DockSplitter"):
            self.assertEqual(int(splitter.get("count")), len(splitter))
            self.assertEqual(len(splitter.get("sizes").split(";")), len(splitter))

    def test_foxglove_shows_topics_and_fields(self):
        layout = json.loads((LAYOUTS / "foxglove.json").read_text(encoding="utf-8"))
        topics = (ROOT / "docs/topics.md").read_text(encoding="utf-8")
        for panel in layout["configById"].values():
            for topic in panel.get("topics", {}):
                self.assertIn(f"`{topic}`", topics)
            for path in panel.get("paths", []):
                topic, *names = path["value"].split(".")
                self.assertEqual(topic, "/monarch_flight/state")
                self.resolve("FlightState", names)

    def resolve(self, message, names):
        """A path of fields ends at a number."""
        kind = message
        for name in names:
            if kind.startswith("geometry_msgs/"):
                self.assertIn(name, "xyzw")
                kind = "float64"
                continue
            known = fields(kind)
            self.assertIn(name, known, kind)
            kind = known[name]
        self.assertEqual(kind, "float64")

    def test_every_panel_has_its_place(self):
        layout = json.loads((LAYOUTS / "foxglove.json").read_text(encoding="utf-8"))
        placed = re.findall(r'"(?:first|second)": "([^"]+)"', json.dumps(layout["layout"]))
        self.assertEqual(sorted(placed), sorted(layout["configById"]))


if __name__ == "__main__":
    unittest.main()
