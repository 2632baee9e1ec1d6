"""Measures speed, stage by stage (monarch bench, docs/performance.md)."""
import json
import os
import re
import shutil
import statistics
import subprocess
import sys

from monarch_flight import places

ROOT = places.source()
BUILD = os.environ.get("MONARCH_BENCH_BUILD", os.path.join(ROOT, "build", "bench"))
SIZES = (0.2e6, 0.65e6, 2.5e6, 5e6)
ENVIRONMENT = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                   OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1")


def fail(text):
    sys.exit("bench: " + text)


def run(command, **options):
    done = subprocess.run(command, env=ENVIRONMENT, stdout=subprocess.PIPE, text=True, **options)
    if done.returncode != 0:
        fail("failed (exit code %d): %s" % (done.returncode, " ".join(map(str, command))))
    return done.stdout


def program(name):
    return os.path.join(BUILD, "devel/lib", places.PACKAGE, "bench_" + name)


class Table:
    """The measured values; `bar` is the bound that a value must meet, None: for information. Each stage ends with `save`:
    rows of the same name are renewed in bench.json, others stay."""

    def __init__(self, path):
        self.path, self.rows = path, []

    def add(self, name, value, unit, bar=None, at_least=False, bound="", doubt=""):
        """`bound`: '>=' or '<=' where the value is only a bound of the true one. `doubt`: why the value proves nothing; it
        then meets no bar, nor does a bound on the wrong side."""
        if bar is not None and bound == ("<=" if at_least else ">="):
            doubt = doubt or "only a bound"
        good = None if bar is None else bool(not doubt and (value >= bar if at_least else value <= bar))
        self.rows.append({"name": name, "value": value, "unit": unit, "bar": bar, "at_least": at_least, "pass": good,
                          **({"bound": bound} if bound else {}), **({"doubt": doubt} if doubt else {})})
        shown = value if isinstance(value, str) else (bound + " %.5g" % value).strip()
        asked = "" if bar is None else ("%s %g" % (">=" if at_least else "<=", bar))
        verdict = {None: "", True: "ok", False: "MISSED" + (doubt and ": " + doubt)}[good]
        print("%-42s %12s %-12s %-10s %s" % (name, shown, unit, asked, verdict), flush=True)

    def all(self):
        kept = []
        if os.path.isfile(self.path):
            with open(self.path) as f:
                kept = json.load(f)
        new = {r["name"] for r in self.rows}
        return [r for r in kept if r["name"] not in new] + self.rows

    def save(self):
        rows = self.all()
        with open(self.path + ".active", "w") as f:
            json.dump(rows, f, indent=1)
        os.replace(self.path + ".active", self.path)


def build(targets):
    run(["cmake", "-S", ROOT, "-B", BUILD, "-DMONARCH_ROS=OFF", "-DMONARCH_TESTS=OFF", "-DMONARCH_NATIVE=ON",
         "-DMONARCH_BENCH=ON"])
    with open(os.path.join(BUILD, "build.log"), "w") as log:
        done = subprocess.run(["make", "-C", BUILD, "-j2"] + ["monarch_bench_" + t for t in targets], stdout=log, stderr=log)
    if done.returncode != 0:
        fail("the build failed, see " + log.name)


def whole_steps(table, repeats):
    full = {}
    for cells in SIZES:
        r = json.loads(run([program("flow"), str(cells), str(repeats)]))
        at = "at_%gM" % (cells / 1e6)
        full[cells] = r["full_ns"]["best"]
        table.add("ns_per_cell_full_solve_" + at, r["full_ns"]["best"], "ns")
        table.add("ns_per_cell_full_solve_median_" + at, r["full_ns"]["median"], "ns")
        table.add("ns_per_cell_repeated_evaluate_" + at, r["repeated_ns"]["best"], "ns")
        coupled = r["full_ns"]["best"] + r["repeated_ns"]["best"]
        table.add("coupled_step_by_full_solve_" + at, coupled / r["full_ns"]["best"], "", {0.65e6: 1.3}.get(cells))
        table.add("ns_per_cell_commit_" + at, r["commit_ns"]["best"], "ns")
        table.add("operator_by_full_solve_" + at, r["operator_s"] / (1e-9 * r["full_ns"]["best"] * r["cells"]), "", 0.01)
        for name, ns in r["kernel_ns"].items():
            table.add("profile_%s_%s" % (name, at), ns, "ns/cell")
        table.add("courant_" + at, r["courant"], "")
        table.add("setup_" + at, r["setup_s"], "s", {0.65e6: 10, 5e6: 60}.get(cells))
        table.add("memory_per_cell_" + at, r["bytes_per_cell"], "bytes", {0.65e6: 300}.get(cells))
        table.add("memory_by_plan_" + at, r["bytes_per_cell"] / r["planned_bytes_per_cell"], "")
        table.add("setup_by_plan_" + at, r["setup_s"] / r["planned_setup_s"], "")
    table.add("cost_per_cell_largest_by_smallest", max(full.values()) / min(full.values()), "", 1.25)


def kernels(table, cells):
    at = "at_%gM" % (cells / 1e6)
    out = json.loads(run(["env", "BENCH_CELLS=%g" % cells, program("kernels"), "--benchmark_format=json",
                          "--benchmark_min_time=0.3"], stderr=subprocess.DEVNULL))
    total = 0
    for b in out["benchmarks"]:
        if b["name"] == "triad":
            table.add("triad_" + at, b["GB/s"], "GB/s")
        elif b["name"] == "dgemm":
            table.add("dgemm_" + at, b["GFLOP/s"], "GFLOP/s")
        else:
            ns = b["ns_per_cell"]
            total += ns * (2 if b["name"] == "rotation" else 1)
            table.add("kernel_%s_%s" % (b["name"], at), ns, "ns/cell")
            if b["GB/s"]:
                table.add("kernel_%s_bandwidth_%s" % (b["name"], at), b["GB/s"], "GB/s")
                table.add("kernel_%s_rate_%s" % (b["name"], at), b["GFLOP/s"], "GFLOP/s")
    table.add("kernels_sum_" + at, total, "ns/cell")


def threads(table, repeats):
    """Two threads of one process against one, wall times, in turns."""
    for cells in (0.65e6, 2.5e6):
        times = {1: [], 2: []}
        for _ in range(3):
            for count, walls in times.items():
                r = json.loads(run([program("flow"), str(cells), str(repeats), str(count)]))
                walls.append(r["full_ns"]["wall_best"])
        table.add("threads_2_speedup_at_%gM" % (cells / 1e6), min(times[1]) / min(times[2]), "", 1.75, at_least=True)


def bytes_worth(table):
    """ns a cell times what the memory moves in a ns: the same program's figure on any machine."""
    values = {row["name"]: row["value"] for row in table.all()}
    at = "_at_0.65M"
    if "triad" + at in values and "ns_per_cell_full_solve" + at in values:
        table.add("bytes_worth_of_a_cell" + at, values["ns_per_cell_full_solve" + at] * values["triad" + at], "bytes", 2000)


def processor():
    with open("/proc/cpuinfo") as f:
        text = f.read()
    name = re.search(r"model name\s*: (.*)", text).group(1)
    flags = text.split()
    return name + next((" with " + told for flag, told in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in flags), "")


def ranks(table, repeats):
    one, two = [], []
    command = [program("flow"), "2.5e6", str(repeats)]
    for _ in range(3):  # in turns
        one.append(json.loads(run(command)))
        two.append(json.loads(run(["mpirun", "--oversubscribe", "--bind-to", "none", "-np", "2"] + command)))
    best = lambda results: min(r["full_ns"]["wall_best"] for r in results)
    table.add("ranks_2_speedup", best(one) / best(two), "", 1.75, at_least=True)
    planes = two[0]["doubles_sent_per_step"] / (two[0]["size"][0] * two[0]["size"][1])
    table.add("ranks_2_doubles_sent_per_step", two[0]["doubles_sent_per_step"], "")
    table.add("ranks_2_planes_sent_per_step", planes, "")
    table.add("ranks_load_average", os.getloadavg()[0], "")


def coupling(table, out):
    """A flight over topics: quasi-steady air for the chain of a sub-iteration alone, the standard grid for its share."""
    from monarch_flight.trials.exchange_times import step_times
    flights = {"chain": ["fluid:=quasi_steady", "flaps:=1", "steps_per_flap:=500"],
               "standard": ["grid:=standard", "flaps:=0.08", "steps_per_flap:=500"]}
    times = {}
    for name, keys in flights.items():
        folder = os.path.join(out, "coupling_" + name)
        shutil.rmtree(folder, ignore_errors=True)
        run([*places.monarch(), "fly", "case:=climb_printed", "out:=" + folder, "rviz:=false", "report:=false"] + keys)
        times[name] = step_times(folder)
    chains = [t.exchange / (t.sub_iterations + 1) for t in times["chain"]]  # and the COMMIT's chain
    table.add("sub_iteration_chain_median", 1e3 * statistics.median(chains), "ms", 0.6)
    table.add("sub_iteration_chain_p95", 1e3 * sorted(chains)[int(0.95 * len(chains))], "ms")
    shares = [(t.exchange + t.coupling) / t.total for t in times["standard"]]
    table.add("exchange_and_coordination_share_at_standard", statistics.median(shares), "", 0.03)
    table.add("coupling_load_average", os.getloadavg()[0], "")


def hypre(table, sizes):
    for cells in sizes:
        r = json.loads(run([program("hypre"), str(cells)]).splitlines()[-1])
        at = "at_%gM" % (cells / 1e6)
        if r["difference"] > 1e-5:
            fail("hypre and the direct solver disagree by %g" % r["difference"])
        ratio = r["hypre_s"] / r["direct_s"]
        if cells == 0.65e6:
            table.add("hypre_ratio", ratio, "", 50, at_least=True)
        table.add("hypre_ratio_" + at, ratio, "", 50, at_least=True)
        table.add("hypre_pcg_" + at, r["hypre_s"], "s")
        table.add("hypre_iterations_" + at, r["hypre_iterations"], "")
        table.add("pressure_solve_" + at, r["direct_s"], "s")


def foam(folder, command):
    text = ". /usr/share/openfoam/etc/bashrc >/dev/null 2>&1; %s >log.run 2>&1" % command
    if subprocess.run(["bash", "-c", text], cwd=folder, env=ENVIRONMENT).returncode != 0:
        fail("OpenFOAM failed, see %s/log.run" % folder)
    with open(os.path.join(folder, "log.run")) as log:
        return log.read()


def set_entry(folder, key, value, name="system/controlDict"):
    path = os.path.join(folder, name)
    with open(path) as f:
        text = f.read()
    with open(path, "w") as f:
        f.write(re.sub(r"(?m)^%s .*?;" % key, "%s %.12g;" % (key, value), text))


def openfoam_case(out, cells, steps):
    """(folder, cells, time step [s]) of the peer's case."""
    case = os.path.join(out, "openfoam")
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(os.path.join(ROOT, "bench", "openfoam"), case)
    os.makedirs(os.path.join(case, "constant", "polyMesh"))
    count, dt = run([program("openfoam_case"), str(cells), case]).split()
    set_entry(case, "deltaT", float(dt))
    set_entry(case, "writeInterval", steps)
    return case, int(count), float(dt)


def openfoam_steps(case, end, cores):
    """Times of a step [s] from where the case stands to `end`: computing time of one core, or wall time of some, whose
    processes wait busily."""
    set_entry(case, "endTime", end)
    if cores > 1 and not os.path.isdir(os.path.join(case, "processor0")):
        set_entry(case, "numberOfSubdomains", cores, "system/decomposeParDict")
        foam(case, "decomposePar")
    log = foam(case, "pimpleFoam" if cores == 1 else "mpirun --oversubscribe -np %d pimpleFoam -parallel" % cores)
    times = [float(t) for t in re.findall(r"ExecutionTime = (\S+) s", log)]
    return [b - a for a, b in zip(times, times[1:])]  # the first one holds the start


def openfoam(table, out, cells, rounds, steps):
    """Rounds of some steps of OpenFOAM and of ours, in turns: on a core each, and on all of them."""
    for cores, time, name in ((1, "median", "cpu"), (os.cpu_count(), "wall_median", "wall")):
        case, count, dt = openfoam_case(out, cells, steps)
        theirs, ours = [], []
        for n in range(rounds):
            theirs += openfoam_steps(case, (n + 1) * steps * dt, cores)
            r = json.loads(run([program("flow"), str(cells), "10", str(cores)]))
            ours.append(r["full_ns"][time] * r["cells"] * 1e-9)
            if r["cells"] != count:
                fail("the two grids differ: %d and %d cells" % (count, r["cells"]))
        table.add("openfoam_%s_ratio" % name, statistics.median(theirs) / statistics.median(ours), "", 85, at_least=True)
        table.add("openfoam_%s_per_step" % name, statistics.median(theirs), "s")
        table.add("monarch_%s_per_step" % name, statistics.median(ours), "s")
    table.add("openfoam_cells", count, "")


PROGRAMS = {"steps": ["flow"], "kernels": ["kernels"], "ranks": ["flow"], "threads": ["flow"], "hypre": ["hypre"],
            "openfoam": ["flow", "openfoam_case"], "accuracy": ["plate"], "coupling": []}


def accuracy(table, out):
    from monarch_flight.figures import error_against_cost
    from monarch_flight.trials import accuracy as stage
    error_against_cost.draw(stage.measure(table, out), os.path.join(out, "bench_accuracy.png"))


def measure(stages, out, given):
    """Exit code: whether every bar is met. `given`: repeats, rounds, cells, hypre_cells."""
    os.makedirs(out, exist_ok=True)
    targets = sorted({program for stage in stages for program in PROGRAMS[stage]})
    if targets:
        build(targets)
    table = Table(os.path.join(out, "bench.json"))
    table.add("processor", processor(), "")
    table.add("cores", os.cpu_count(), "")
    table.add("load_average", os.getloadavg()[0], "")
    work = {"steps": lambda: whole_steps(table, given.repeats),
            "kernels": lambda: [kernels(table, cells) for cells in (0.65e6, 2.5e6)],
            "threads": lambda: threads(table, given.repeats),
            "ranks": lambda: ranks(table, given.repeats),
            "coupling": lambda: coupling(table, out),
            "hypre": lambda: hypre(table, given.hypre_cells or [0.65e6]),
            "openfoam": lambda: openfoam(table, out, given.cells, given.rounds, 4),
            "accuracy": lambda: accuracy(table, out)}
    for stage, measured in work.items():
        if stage in stages:
            measured()
            table.save()
    bytes_worth(table)
    table.save()
    missed = [r["name"] for r in table.rows if r["pass"] is False]
    print("bench: %s; values in %s/bench.json" % ("missed: " + ", ".join(missed) if missed else "all bars met", out))
    return 1 if missed else 0
