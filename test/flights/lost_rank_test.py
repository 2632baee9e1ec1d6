#!/usr/bin/python3
"""A process of the fluid (ranks:=2) that is lost or hangs ends the run: soon, by name, with a non-zero exit code."""
import glob
import os
import signal
import unittest

import flying

LIMIT = 60.0  # seconds
# The coordinator leaves when the fluid is lost, and may be gone before mpirun is.
NODE_DIED = "fly: the node monarch_flight/(fluid|coordinator) (died|ended with exit code)"


def processes_of(folder, program):
    """{rank: process id} of a program that mpirun started for the run whose logs go to this folder."""
    found = {}
    for path in glob.glob("/proc/[0-9]*/environ"):
        try:
            with open(path, "rb") as f:
                environment = dict(item.split("=", 1) for item in f.read().decode().split("\0") if "=" in item)
            with open(os.path.dirname(path) + "/cmdline", "rb") as f:
                command = f.read().decode().split("\0")[0]
        except (OSError, UnicodeDecodeError):
            continue  # gone already, or not ours
        if environment.get("ROS_LOG_DIR") == os.path.join(folder, "log") and os.path.basename(command) == program:
            rank = environment.get("OMPI_COMM_WORLD_RANK")
            if rank is not None:
                found[int(rank)] = int(path.split("/")[2])
    return found


def running(pid):
    """False for a process that has ended, also where nobody has asked for its exit code yet."""
    try:
        with open("/proc/%d/stat" % pid) as f:
            return f.read().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class LostRank(flying.FlightTest):
    def airborne(self, program, *keys, watchdog=60.0):
        with open(os.path.join(flying.ROOT, "config", "cases", "tethered_fwuav.yaml")) as f:
            text = f.read()
        self.assertEqual(text.count("\ngrid:"), 1)
        case = os.path.join(self.folder, "small.yaml")
        head, rest = text.split("\ngrid:\n")
        with open(case, "w") as f:  # a grid that two processes fly in no time
            f.write(head + "\ngrid:\n  cells_per_chord: 6\n  far_field: 3\n" + rest + "\nwatchdog_s: %g\n" % watchdog)
        process = self.start("case:=" + case, "flaps:=100", "ranks:=2", "out:=" + self.out(), *keys)
        table = os.path.join(self.out(), "flight.csv.active")
        self.wait_for(lambda: os.path.exists(table) and os.path.getsize(table) > 5000, 120,
                      "the flight to begin; so far: " + self.output(process))
        ranks = processes_of(self.folder, program)
        self.assertEqual(set(ranks), {0, 1}, self.output(process))
        return process, ranks

    def assert_all_gone(self, ranks):
        for rank, pid in ranks.items():
            self.wait_for(lambda: not running(pid), 20, "the end of rank %d" % rank)

    def test_nodes(self):
        process, ranks = self.airborne("fluid")
        os.kill(ranks[1], signal.SIGKILL)
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)
        self.assertRegex(output, NODE_DIED)
        summary = flying.summary(self.out())
        self.assertEqual(summary["status"], "failed")
        self.assertIn("the fluid node", summary["failure"])
        self.assertRegex(output, "process rank 1 .* exited on signal 9")  # mpirun's own words
        self.assert_all_gone(ranks)

    def test_in_process(self):
        process, ranks = self.airborne("fly_in_process", "in_process:=true")
        os.kill(ranks[1], signal.SIGKILL)
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)
        self.assertRegex(output, "process rank 1 .* exited on signal 9")
        self.assertIn("fly: a process was lost, which ended the run", output)
        self.assertFalse(os.path.exists(self.out() + "/summary.json"))
        self.assert_all_gone(ranks)

    def hang(self, program, rank, *keys):
        """Stops this process of a run; the other one must say so."""
        process, ranks = self.airborne(program, *keys, watchdog=10.0)
        os.kill(ranks[rank], signal.SIGSTOP)
        code, output = self.finish(process, LIMIT)
        self.assertNotIn(code, (0, 130), output)
        self.assertIn("process %d of the flow has waited in vain for process %d, which hangs" % (1 - rank, rank), output)
        self.assert_all_gone(ranks)

    def test_hung_in_nodes(self):
        self.hang("fluid", 1)  # mpirun takes its time, so any node may be the first that is gone
        self.assertIn("the fluid node", flying.summary(self.out())["failure"])

    def test_hung_in_process(self):
        self.hang("fly_in_process", 1, "in_process:=true")

    def test_hung_head_in_process(self):
        self.hang("fly_in_process", 0, "in_process:=true")


if __name__ == "__main__":
    unittest.main()
