#!/usr/bin/python3
"""packed_divisions_check.py LIBRARY: the eliminations of the flow divide whole vectors, on every processor."""
import re
import subprocess
import sys

# Functions of fluid::momentum whose divisions are those of an elimination: along x, z upwards and downwards, y.
WANTED = (r"eliminateX<false>\(", r"eliminateX<true>\(", r"eliminatePlain<1>\(", r"eliminatePlain<-1>\(",
          r"(solveRows|eliminateY)\(")


def main(library):
    code = subprocess.run(["objdump", "-d", "-C", "--no-show-raw-insn", library], check=True, stdout=subprocess.PIPE,
                          text=True).stdout
    packed = {wanted: 0 for wanted in WANTED}
    for function in re.split(r"\n(?=[0-9a-f]+ <)", code):
        name = function.split("\n", 1)[0]
        for wanted in WANTED:
            if "momentum::" in name and re.search("momentum::.*" + wanted, name):
                packed[wanted] += len(re.findall(r"\bv?divpd\b", function))
    missing = [wanted for wanted, count in packed.items() if count == 0]
    if missing:
        sys.exit(f"{library}: no packed division in {', '.join(missing)}")


if __name__ == "__main__":
    main(sys.argv[1])
