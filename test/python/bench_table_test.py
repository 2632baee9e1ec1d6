"""Figures of bench.json in a document."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from monarch_flight.trials import bench_table  # noqa: E402

ROWS = [{"name": "processor", "value": "one of mine", "unit": "", "bar": None, "at_least": False, "pass": None},
        {"name": "ns_per_cell_full_solve_at_0.65M", "value": 51.25, "unit": "ns", "bar": None, "at_least": False, "pass": None},
        {"name": "threads_2_speedup_at_2.5M", "value": 1.5, "unit": "", "bar": 1.75, "at_least": True, "pass": False},
        {"name": "accuracy_heaving_mean_cost_ratio", "value": 57, "unit": "", "bar": 100, "at_least": True, "pass": False}]


def renewed(document):
    """The text of a document after the figures of ROWS were put into it."""
    with tempfile.TemporaryDirectory() as folder:
        results, path = pathlib.Path(folder, "bench.json"), pathlib.Path(folder, "speed.md")
        results.write_text(json.dumps(ROWS), encoding="utf-8")
        path.write_text(document, encoding="utf-8")
        bench_table.renew(path, results)
        return path.read_text(encoding="utf-8")


class Figures(unittest.TestCase):
    def test_of_the_run_replace_those_before(self):
        text = renewed("before\n" + bench_table.BEGIN + "old\n" + bench_table.END + "after\n")
        self.assertTrue(text.startswith("before\n") and text.endswith("after\n"), text)
        self.assertNotIn("old", text)
        for line in ("Processor: one of mine", "| full solve, best | - | 51.2 | - | - |",
                     "| `threads_2_speedup_at_2.5M` | 1.5 | >= 1.75, missed |"):
            self.assertIn(line, text)
        self.assertNotIn("accuracy", text)  # stands in the section made from accuracy.json

    def test_of_other_processors_stay(self):
        text = renewed("before\n" + bench_table.BEGIN + "Processor: another one, 2 cores\n\nits table\n\nProcessor: one of mine, 2 cores\n\n"
                       "old\n" + bench_table.END + "after\n")
        self.assertIn("Processor: another one, 2 cores\n\nits table\n\nProcessor: one of mine, - cores", text)
        self.assertNotIn("old", text)

    def test_need_a_place(self):
        with self.assertRaisesRegex(ValueError, "no place for the figures"):
            renewed("nothing\n")


if __name__ == "__main__":
    unittest.main()
