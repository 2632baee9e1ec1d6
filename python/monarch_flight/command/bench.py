"""Measures speed, stage by stage: steps (whole steps of the flow solver on four grids), kernels (beside triad and
dgemm), threads and ranks (two threads, two processes against one), coupling (exchanges over topics), and beside peers: hypre, openfoam,
accuracy (error against cost of two plates, 16 minutes of OpenFOAM) (docs/performance.md).

A peer is installed with apt when it is asked for. CPU times of one core; the quieter the machine, the better they
repeat. Without a stage: steps, kernels, threads, ranks, and the peers given."""
import os

from monarch_flight import keys, preparing
from monarch_flight.keys import Key, Table

STAGES = ("steps", "kernels", "threads", "ranks", "coupling", "hypre", "openfoam", "accuracy")
PEERS = ("hypre", "openfoam")
KEYS = Table([Key("out", "path", "folder of bench.json", default="bench_results")])


def add_arguments(parser):
    parser.add_argument("words", nargs="*", metavar="STAGE | key:=value")
    parser.add_argument("--peer", action="append", default=[], choices=PEERS)
    parser.add_argument("--hypre-cells", type=float, action="append", help="of the comparison with hypre (0.65e6)")
    parser.add_argument("--repeats", type=int, default=10, help="steps that are measured (10)")
    parser.add_argument("--rounds", type=int, default=3, help="of four steps each, beside OpenFOAM (3)")
    parser.add_argument("--cells", type=float, default=0.65e6, help="of the comparison with OpenFOAM (0.65e6)")
    parser.add_argument("--document", metavar="FILE",
                        help="measure nothing; put the figures of bench.json into this document (docs/performance.md), "
                        "with the stage accuracy those of accuracy.json and the picture beside it")
    parser.epilog = KEYS.help()


def run(arguments):
    values, stages, faults = KEYS.read(arguments.words, plain=True)
    faults += [f"'{name}': must be out:=DIR or one of {', '.join(STAGES)}{keys.nearest(name, STAGES)}"
               for name in stages if name not in STAGES]
    if faults:
        raise keys.Refused(*faults)
    if arguments.document:
        return document(arguments.document, values.get("out", "bench_results"), stages)
    stages = (stages or ["steps", "kernels", "threads", "ranks"]) + arguments.peer
    root = preparing.source_only("bench")
    peers = [name for name in PEERS if name in stages or (name == "openfoam" and "accuracy" in stages)]
    peers += ["figures"] if "accuracy" in stages else []
    preparing.installed("fly", "bench", *peers)
    from monarch_flight.trials import bench
    return bench.measure(stages, os.path.abspath(values.get("out", root / "bench_results")), arguments)


def document(path, folder, stages):
    from monarch_flight.trials import accuracy_table, bench_table
    try:
        if "accuracy" in stages:
            accuracy_table.renew(path, folder)
        else:
            bench_table.renew(path, os.path.join(folder, "bench.json"))
    except (OSError, ValueError) as error:
        raise keys.Refused(str(error)) from error
    return 0
