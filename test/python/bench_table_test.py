"""Figures of bench.json in a document."""
import json
import os
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight.trials import bench_table  # noqa: E402

ROWS = [{"name": "processor", "value": "one of mine", "unit": "", "bar": None, "at_least": False, "pass": None},
        {"name": "ns_per_cell_full_solve_at_0.65M", "value": 51.25, "unit": "ns", "bar": None, "at_least": False, "pass": None},
        {"name": "threads_2_speedup_at_2.5M", "value": 1.5, "unit": "", "bar": 1.75, "at_least": True, "pass": False}]


class Figures(unittest.TestCase):
    def test_of_the_run_replace_those_before(self):
        with tempfile.TemporaryDirectory() as folder:
            results, document = os.path.join(folder, "bench.json"), os.path.join(folder, "speed.md")
            with open(results, "w", encoding="utf-8") as file:
                json.dump(ROWS, file)
            with open(document, "w", encoding="utf-8") as file:
                file.write("before\n" + bench_table.BEGIN + "old\n" + bench_table.END + "after\n")
            bench_table.renew(document, results)
            with open(document, encoding="utf-8") as file:
                text = file.read()
        self.assertTrue(text.startswith("before\n") and text.endswith("after\n"), text)
        self.assertNotIn("old", text)
        for line in ("Processor: one of mine", "| full solve, best | - | 51.2 | - | - |",
                     "| `threads_2_speedup_at_2.5M` | 1.5 | >= 1.75, missed |"):
            self.assertIn(line, text)

    def test_need_a_place(self):
        with tempfile.TemporaryDirectory() as folder:
            results, document = os.path.join(folder, "bench.json"), os.path.join(folder, "speed.md")
            with open(results, "w", encoding="utf-8") as file:
                json.dump(ROWS, file)
            with open(document, "w", encoding="utf-8") as file:
                file.write("nothing\n")
            with self.assertRaisesRegex(ValueError, "no place for the figures"):
                bench_table.renew(document, results)


if __name__ == "__main__":
    unittest.main()
