"""What a search found, as a case file, as data, and as a table to read."""
import numpy as np
import yaml

from monarch_flight import case_files, places


def described(stage):
    """Air, grid and steps of a stage in words."""
    changes = stage.changes
    grid = changes.get("grid", {})
    size = f"{grid['cells_per_chord']:g} cells a chord" if "cells_per_chord" in grid else f"{grid['level']} grid" if "level" in grid else ""
    air = changes.get("fluid/solver", "").replace("_", "-")
    words = [air + " air" if air else "", "" if air == "quasi-steady" else size,
             f"{changes['time/steps_per_flap']} steps a flap" if "time/steps_per_flap" in changes else ""]
    return ", ".join(filter(None, words)) or "as in the case"


def flaps(study):
    return ("flap " if len(study.flaps) == 1 else "flaps ") + ", ".join(map(str, study.flaps))


def measured_words(study):
    """The angles and where they were measured, in words."""
    by_source = {}
    for one in study.measured:
        by_source.setdefault(one.source, []).append(one.angle + ("" if one.weight == 1 else f" (weight {one.weight:g})"))
    return " and ".join(f"{', '.join(angles)} of {source}" for source, angles in by_source.items())


def deviations(study, known):
    """Standard deviations in the units of the case."""
    return [float(share) * (unknown.high - unknown.low) for share, unknown in zip(known.deviations, study.unknowns)]


def ends(found):
    return {-1: " (low end of its range)", 0: "", 1: " (high end of its range)"}, found.active


def case(study, found, known):
    """The case of the last stage with what was found; each fitted key says so."""
    last = found[-1]
    comments, heading = case_files.comments(study.origin)
    comments |= {key: "status: set by the study" for key in study.set}
    names = " and ".join(unknown.key for unknown in study.unknowns)
    fitted = {}
    for unknown, deviation in zip(study.unknowns, deviations(study, known)):
        above, _, place = unknown.key.rpartition("/")
        key, which = (above, f"place {place}, ") if place.isdecimal() else (unknown.key, "")
        fitted.setdefault(key, []).append(f"status: {which}fitted within {unknown.low:g} to {unknown.high:g}, standard deviation {deviation:.2g}")
    comments |= {key: "\n".join(lines) for key, lines in fitted.items()}
    origin = study.origin.relative_to(places.share()) if study.origin.is_relative_to(places.share()) else study.origin.name
    made = (f"# Made by monarch identify (docs/identification.md) from {origin}: {names}\n"
            f"# fitted together to {measured_words(study)}, {flaps(study)}; {described(last.stage)}.\n")
    for one in last.comparisons.angles:
        ratio, ahead = one.fundamental()
        made += f"# {one.angle}: rms {one.rms:.2f} deg, fundamental {ratio:.3f} of the measured one, {ahead:+.1f} deg ahead.\n"
    content = study.content(last.stage, last.values)
    content["name"] = study.name
    content["time"]["flaps"] = max(study.flaps)
    return made + heading + case_files.text(content, comments)


def rounded(values, digits=6):
    return [float(f"{value:.{digits}g}") for value in np.asarray(values, float)]


def angle_record(one):
    ratio, ahead = one.fundamental()
    return dict(rms_deg=round(one.rms, 4), amplitude_ratio=round(ratio, 4), ahead_deg=round(ahead, 3), repeats_deg=round(one.repeats, 4),
                mean_deg=round(float(one.flown.mean()), 3), swing_deg=round(float(np.ptp(one.flown)), 3))


def stage_record(study, one):
    return dict(name=one.stage.name, case=dict(one.stage.changes), rms_deg=round(one.comparisons.rms, 4), ended=one.ended,
                angles={comparison.angle: angle_record(comparison) for comparison in one.comparisons.angles},
                values={unknown.key: value for unknown, value in zip(study.unknowns, one.values)})


def record(study, found, known):
    """identification.yaml"""
    last = found[-1]
    unknowns = {unknown.key: dict(value=value, standard_deviation=float(f"{deviation:.4g}"), range=[unknown.low, unknown.high],
                                  at_end={-1: "low", 0: "none", 1: "high"}[int(end)])
                for unknown, value, deviation, end in zip(study.unknowns, last.values, deviations(study, known), last.active)}
    combinations = [dict(standard_deviation=float(f"{deviation:.4g}"), change_deg=float(f"{value:.4g}"), determined=bool(sure),
                         direction=rounded(direction, 4))
                    for deviation, value, sure, direction in zip(known.combination_deviations, known.singular_values, known.determined,
                                                                 known.combinations)]
    measured = {told.angle: dict(source=told.source, weight=told.weight, mean_deg=round(float(one.measured.mean()), 3),
                                 swing_deg=round(float(np.ptp(one.measured)), 3))
                for told, one in zip(study.measured, last.comparisons.angles)}
    content = dict(case=str(study.case.get("name")), measured=measured, flaps=list(study.flaps), stages=[stage_record(study, one) for one in found],
                   unknowns=unknowns, independent_residuals=float(f"{known.independent:.4g}"),
                   correlation=[rounded(row, 4) for row in known.correlation], combinations=combinations)
    return ("# Written by monarch identify; docs/identification.md says what each number means. Standard deviations of combinations\n"
            "# are in shares of the ranges, directions in the order of the unknowns.\n"
            + yaml.safe_dump(content, sort_keys=False, default_flow_style=None, width=120))


def text(study, found, known):
    """identification.txt: stages, values with their confidence, what is determined."""
    last, names = found[-1], [unknown.short for unknown in study.unknowns]
    width = max(map(len, names)) + 2
    lines = [f"{measured_words(study)} against {study.case.get('name')}, {flaps(study)}", "",
             f"{'stage':26s}{'angle':>8s}{'rms deg':>9s}{'ratio':>8s}{'ahead deg':>11s}{'repeats deg':>13s}{'mean deg':>10s}{'swing deg':>11s}"]
    for one in found:
        for comparison in one.comparisons.angles:
            ratio, ahead = comparison.fundamental()
            lines.append(f"{one.stage.name[:25]:26s}{comparison.angle:>8s}{comparison.rms:9.3f}{ratio:8.3f}{ahead:11.1f}{comparison.repeats:13.2f}"
                         f"{comparison.flown.mean():10.2f}{np.ptp(comparison.flown):11.2f}")
    for comparison in last.comparisons.angles:
        lines.append(f"{'measured':26s}{comparison.angle:>8s}{'':41s}{comparison.measured.mean():10.2f}{np.ptp(comparison.measured):11.2f}")
    lines += ["", f"{'stage':26s}" + "".join(f"{name:>{max(12, len(name) + 2)}s}" for name in names)]
    for one in found:
        lines.append(f"{one.stage.name[:25]:26s}" + "".join(f"{value:>{max(12, len(name) + 2)}.5g}" for name, value in zip(names, one.values)))
    lines += [f"the search of {one.stage.name} was stopped behind its most points; call it again with a larger most" for one in found if not one.ended]
    lines += ["", f"{'unknown'.ljust(width)}{'value':>13s}{'deviation':>12s}{'low':>11s}{'high':>11s}  correlation"]
    told, ends_ = ends(last)
    for i, unknown in enumerate(study.unknowns):
        row = " ".join(f"{value:+.2f}" for value in known.correlation[i])
        lines.append(f"{names[i].ljust(width)}{last.values[i]:13.6g}{deviations(study, known)[i]:12.2g}{unknown.low:11.4g}{unknown.high:11.4g}  "
                     f"{row}{told[int(ends_[i])]}")
    lines += ["", f"combinations, in shares of the ranges (deviations as if {known.independent:.3g} of the {len(last.comparisons.residuals)} residuals were "
              "independent)"]
    for deviation, value, sure, direction in zip(known.combination_deviations, known.singular_values, known.determined, known.combinations):
        combination = " ".join(f"{part:+.2f} {name}" for part, name in zip(direction, names))
        lines.append(f"  {'determined' if sure else 'NOT determined':15s} deviation {deviation:<8.2g} moves the angle by {value:.3g} deg rms over a range: "
                     f"{combination}")
    return "\n".join(lines)
