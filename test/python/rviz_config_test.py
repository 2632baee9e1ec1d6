"""What rviz shows: one source, for themes, namespaces, prefixes of frames, with and without the panel."""
import pathlib
import sys
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))
from monarch_flight import rviz_config  # noqa: E402

SOURCE = yaml.safe_load((ROOT / "rviz/monarch.rviz").read_text(encoding="utf-8"))


def made(**wanted):
    return yaml.safe_load(rviz_config.config(panel=True, **wanted))


def values(config, *keys):
    return [section[key] for section in rviz_config.sections(config) for key in keys if section.get(key)]


class RvizConfig(unittest.TestCase):
    def test_the_dark_one_is_the_source(self):
        self.assertEqual(made(), SOURCE)

    def test_frames_and_topics_of_a_run_in_a_namespace(self):
        config = made(prefix="a/", space="/a/monarch_flight")
        frames = set(values(config, "Reference Frame", "Target Frame", "Fixed Frame"))
        self.assertEqual(frames, {"world", "a/base_link", "a/right_wing"})
        topics = values(config, "Topic", "Marker Topic")
        self.assertGreater(len(topics), 5)
        for topic in topics:
            self.assertTrue(topic.startswith("/a/monarch_flight/"), topic)
        self.assertIn("/a/monarch_flight", values(config, "Namespace"))

    def test_topics_are_relative_to_the_namespace_of_rviz(self):
        for topic in values(made(prefix="a/"), "Topic", "Marker Topic"):
            self.assertTrue(topic.startswith("monarch_flight/"), topic)

    def test_light_differs_in_colours_alone(self):
        light = made(theme="light")
        background = light["Visualization Manager"]["Global Options"].pop("Background Color")
        self.assertGreater(min(map(int, background.split(";"))), 200)
        dark = made()
        dark["Visualization Manager"]["Global Options"].pop("Background Color")
        changed = 0
        for ours, theirs in zip(light["Visualization Manager"]["Displays"], dark["Visualization Manager"]["Displays"]):
            changed += ours.pop("Color", None) != theirs.pop("Color", None)
        self.assertEqual(changed, len(rviz_config.LIGHT_DISPLAYS))
        self.assertEqual(light, dark)

    def test_without_the_panel_there_is_no_place_for_it(self):
        panels = yaml.safe_load(rviz_config.config(panel=False))["Panels"]
        self.assertEqual([one["Class"] for one in panels], ["rviz/Displays"])

    def test_the_size_of_the_window(self):
        window = made(size="1600x900")["Window Geometry"]
        self.assertEqual((window["Width"], window["Height"]), (1600, 900))
        self.assertEqual(window["QMainWindow State"], SOURCE["Window Geometry"]["QMainWindow State"])

    def test_saved_views_follow_the_body(self):
        views = SOURCE["Visualization Manager"]["Views"]["Saved"]
        self.assertEqual([view["Name"] for view in views], ["Oblique", "Side", "Front", "Top", "Chase"])
        self.assertEqual({view["Target Frame"] for view in views}, {"base_link"})


if __name__ == "__main__":
    unittest.main()
