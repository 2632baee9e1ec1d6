"""The measured values of bench.json as the tables of docs/performance.md."""
import json
import re

BEGIN = "<!-- figures, made from bench.json by: monarch bench --document FILE -->\n"
END = "<!-- end of figures -->\n"
SIZES = ("0.2", "0.65", "2.5", "5")
KERNELS = ("turning", "momentum_x_y", "momentum_z", "net_outflow", "transforms", "columns", "capacitance", "loads",
           "projection")


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def figures(measured):
    """Markdown of the rows of bench.json; what was not measured is left out, and those of accuracy, which have tables of
    their own (accuracy_table.py)."""
    measured = [row for row in measured if not row["name"].startswith("accuracy_")]
    values = {row["name"]: row["value"] for row in measured}

    def shown(name, form="%.3g"):
        value = values.get(name)
        return "-" if value is None else value if isinstance(value, str) else form % value

    def by_size(label, name, form="%.1f"):
        return [label] + [shown(f"{name}_at_{size}M", form) for size in SIZES]

    text = f"Processor: {shown('processor')}, {shown('cores', '%d')} cores, load average {shown('load_average', '%.1f')}.\n\n"
    text += table(["one thread, ns a cell"] + [size + " M cells" for size in SIZES],
                  [by_size("full solve, best", "ns_per_cell_full_solve"),
                   by_size("full solve, median", "ns_per_cell_full_solve_median"),
                   by_size("repeated evaluate", "ns_per_cell_repeated_evaluate"),
                   by_size("commit", "ns_per_cell_commit")]
                  + [by_size(f"of the full solve `{kernel}`", "profile_" + kernel) for kernel in KERNELS]
                  + [by_size("memory, bytes a cell", "memory_per_cell", "%.0f"),
                     by_size("set-up, s of computing", "setup", "%.2f")])
    bars = [row for row in measured if row["bar"] is not None]
    text += "\n" + table(["figure", "measured", "bar"],
                         [[f"`{row['name']}`", (shown(row["name"], "%.4g") + " " + row["unit"]).strip(),
                           f"{'>=' if row['at_least'] else '<='} {row['bar']:g}{'' if row['pass'] else ', missed'}"]
                          for row in bars])
    other = [name for name in ("triad_at_0.65M", "dgemm_at_0.65M", "openfoam_cpu_per_step", "monarch_cpu_per_step")
             if name in values]
    units = {row["name"]: row["unit"] for row in measured}
    return text + ("\n" + table(["beside them", "measured"], [[f"`{n}`", f"{shown(n)} {units[n]}"] for n in other])
                   if other else "")


def parts(document, begin, end):
    """Text of a document before, between and behind two lines."""
    with open(document, encoding="utf-8") as file:
        text = file.read()
    if begin not in text or end not in text:
        raise ValueError(f"{document}: has no place for the figures; it needs the lines\n{begin}{end}")
    head, _, rest = text.partition(begin)
    shown, _, tail = rest.partition(end)
    return head, shown, tail


def renew(document, results):
    """Writes the tables of `results` (bench.json) between the marks of the document: in place of those of the same
    processor, beside those of others."""
    with open(results, encoding="utf-8") as file:
        text = figures(json.load(file))
    head, shown, tail = parts(document, BEGIN, END)
    ours = text[:text.index(",")]
    others = [block.rstrip() + "\n" for block in re.split("(?m)^(?=Processor: )", shown)
              if block.startswith("Processor: ") and not block.startswith(ours + ",")]
    with open(document, "w", encoding="utf-8") as file:
        file.write(head + BEGIN + "\n".join(others + [text]) + END + tail)
