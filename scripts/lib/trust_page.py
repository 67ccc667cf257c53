#!/usr/bin/env python3
"""Writes the error map from what trust_run.py found.

usage: trust_page.py PREDICTIONS.jsonl PAGE.md FIGURE.png
"""

import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import matplotlib.ticker  # noqa: E402
import numpy as np  # noqa: E402
import trust_kinds  # noqa: E402

CONFORMING, NEAR_BONDING = "conforming", "near bonding"
SPARSE = "sparse"
FEW_CONTACTS = 10
WARNING_FLAGS = {"near_bonding", "resolution"}
COLOURS = {CONFORMING: "#d1322f", NEAR_BONDING: "#f2b705", SPARSE: "#2f7fd1"}
NORMAL_95 = 1.96
OF_THE_MAP = ("rms heights of 0.03 to 12 nm, correlation lengths of 10 to 300 nm, contact moduli of 0.1 to 100 GPa, works of adhesion of 5 to 150 mJ/m^2, "
              "Hamaker constants of 65 and 200 zJ.")
SETS = ("**Three sets.** Rules were set on the frames of seed 5 and looked at on those of seed 6; this page, of seed 7, judges: nobody looked at these frames while a "
        "rule was made. `scripts/trust --kinds --seed N` draws others.")
OF_PROCESSES = ["in equal shares as processes make them (`scripts/lib/trust_kinds.py`): " + ", ".join(trust_kinds.KINDS),
                "rms heights of 0.1 to 10 nm, lateral scales of 15 to 200 nm, contact moduli of 2 to 200 GPa, works of adhesion of 10 to 120 mJ/m^2, Hamaker "
                "constants of 40 to 150 zJ."]


def regime(frame):
    if frame["separation_curve"]["is_conforming"]:
        return CONFORMING
    return NEAR_BONDING if "near_bonding" in flags_of(frame) else SPARSE


def flags_of(frame):
    return set(frame["separation_curve"]["regime_flag_names"].split(", "))


def ratios(frames, value, reference):
    """Logarithms of value/reference; NaN where either says nothing."""
    found = []
    for frame in frames:
        a, b = value(frame), reference(frame)
        found.append(math.log(a / b) if a and b and a > 0 and b > 0 else math.nan)
    return np.array(found)


def pull_off(name):
    return lambda frame: frame[name]["pull_off_force"]


def work(name):
    return lambda frame: frame[name]["apparent_work_of_adhesion"]


def area(name):
    return lambda frame: frame[name]["contact_area"]


def row(title, logs):
    logs = logs[np.isfinite(logs)]
    if logs.size == 0:
        return "| %s | 0 | | | | | | |" % title
    within = ["%.0f %%" % (100 * np.mean(np.abs(logs) < math.log(limit))) for limit in (1.1, 1.15, 1.3)]
    return "| %s | %d | %.3g | %.2g | %s | %.3g |" % (title, logs.size, math.exp(logs.mean()), logs.std(), " | ".join(within),
                                                    math.exp(np.abs(logs).max()))


def table(title, rows):
    return ["| %s | frames | bias | spread | within 1.1 | 1.15 | 1.3 | worst |" % title, "|---|---|---|---|---|---|---|---|"] + rows + [""]


def deviation(logs):
    """Their root mean square, or more, if the 95 % interval holds 95 % of them only then: bias and tails count."""
    logs = logs[np.isfinite(logs)]
    if logs.size == 0:
        return math.nan
    return max(float(np.sqrt(np.mean(logs ** 2))), float(np.quantile(np.abs(logs), 0.95)) / NORMAL_95)


def rounded_up(value):
    return math.ceil(value * 100 - 1e-9) / 100 if math.isfinite(value) else math.nan


def coverage_rows(frames):
    """Deviations of the frames with even numbers, and how many of the others they cover."""
    lines = ["| regime | set by | pull-off force | work | judged by | covered, pull-off force | covered, work |", "|---|---|---|---|---|---|---|"]
    hits, total = np.zeros(2), np.zeros(2)
    for name in (CONFORMING, NEAR_BONDING, SPARSE):
        of_regime = [frame for frame in frames if regime(frame) == name]
        made = [frame for frame in of_regime if frame["frame"]["number"] % 2 == 0]
        judged = [frame for frame in of_regime if frame["frame"]["number"] % 2 == 1]
        cells = []
        for i, quantity in enumerate((pull_off, work)):
            sigma = rounded_up(deviation(ratios(made, quantity("separation_curve"), quantity("half_space"))))
            logs = ratios(judged, quantity("separation_curve"), quantity("half_space"))
            logs = logs[np.isfinite(logs)]
            inside = np.abs(logs) <= NORMAL_95 * sigma
            hits[i] += inside.sum()
            total[i] += inside.size
            cells.append((sigma, 100 * inside.mean() if inside.size else math.nan))
        lines.append("| %s | %d | %.2f | %.2f | %d | %.0f %% | %.0f %% |" % (name, len(made), cells[0][0], cells[1][0], len(judged), cells[0][1], cells[1][1]))
    lines.append("| all | | | | %d | %.0f %% | %.0f %% |" % (total[0], *(100 * hits / np.maximum(total, 1))))
    return lines + [""]


def draw(frames, figure):
    plot, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for name, colour in COLOURS.items():
        chosen = [frame for frame in frames if regime(frame) == name]
        if chosen:
            axes[0].loglog([frame["separation_curve"]["flattening_ratio"] for frame in chosen],
                           np.exp(ratios(chosen, pull_off("separation_curve"), pull_off("half_space"))), ".", color=colour, label=name)
    axes[0].axhspan(1 / 1.15, 1.15, color="#dddddd", zorder=0)
    axes[0].set(xlabel="flattening energy / work of adhesion", ylabel="separation curve / half-space", title="pull-off force, resolved frames")
    axes[0].yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 1.5, 2, 3, 5, 7)))
    axes[0].yaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axes[0].yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes[0].legend()
    for name, colour in (("separation_curve", "#2f7fd1"), ("paper", "#d1322f"), ("printed", "#f2b705"), ("rigid", "#7a7a7a")):
        value = (lambda frame: frame["rigid"]) if name == "rigid" else pull_off(name)
        logs = ratios(frames, value, pull_off("half_space"))
        logs = np.sort(np.abs(logs[np.isfinite(logs)]))
        axes[1].semilogx(np.exp(logs), 100 * (np.arange(logs.size) + 1) / max(logs.size, 1), color=colour, label=name)
    axes[1].set(xlabel="off by this factor at most", ylabel="share of frames [%]", xlim=(1, 100), title="pull-off force, all formulations")
    axes[1].legend()
    for axis in axes:
        axis.grid(alpha=0.3)
    plot.tight_layout()
    plot.savefig(figure, dpi=110)


def page(lines, figure):
    solved = [line for line in lines if line["half_space"]["status"] == "SOLVED"]
    resolved = [line for line in solved if line["half_space"]["is_resolved"]]
    unresolved = [line for line in solved if not line["half_space"]["is_resolved"]]
    reference = pull_off("half_space")
    ours = pull_off("separation_curve")
    size = lines[0]["frame"]["pixels"]
    loaded = [line for line in resolved if line["frame"]["pressure"] > 0]
    few = [line for line in resolved if line["separation_curve"]["asperity_count"] < FEW_CONTACTS]
    many = [line for line in resolved if line["separation_curve"]["asperity_count"] >= FEW_CONTACTS]
    rigid = ratios(resolved, lambda frame: frame["rigid"], reference)
    of_kinds = sorted({line["frame"]["kind"] for line in resolved})
    is_of_processes = bool(set(of_kinds) & set(trust_kinds.KINDS))
    frames = OF_PROCESSES if is_of_processes else ["Gaussian, skewed, self-affine (H 0.5 to 0.9), arrays of spheres" + (
        ", parts of measured scans" if "scan" in of_kinds else ""), OF_THE_MAP]
    text = [
        "# Error map" + (" of other kinds" if is_of_processes else ""), "",
        "How far each formulation lies from the [adhesive half-space](half_space.md), over a wide field of surfaces. Written by `scripts/trust%s`."
        % (" --kinds" if is_of_processes else ""), "",
        "- **Frames.** %d of %d x %d pixels: %s. Nothing flows." % (len(lines), size, size, frames[0]),
        "- **Drawn from** %s A third is pressed with 0.1 to 100 MPa." % frames[1],
        "- **Judges.** The half-space solved %d in the time given. In %d of these its pixels resolve the cohesive length E z0^2/Gamma, and only those judge." % (len(solved), len(resolved)),
        "- **Figures** are ratios to the half-space's: *bias* is their geometric mean, *spread* the standard deviation of their logarithm.", "",
        "![error of the pull-off force](images/%s)" % pathlib.Path(figure).name, "",
        "## Formulations", ""]
    text += table("pull-off force", [row("`separation_curve`", ratios(resolved, ours, reference)), row("`paper`", ratios(resolved, pull_off("paper"), reference)),
                                     row("`printed`", ratios(resolved, pull_off("printed"), reference)), row("rigid, at first touch", rigid)])
    text += ["## Where `separation_curve` is right", "", "*conforming*: its own branch; *near bonding*: other frames with the flag NEAR_BONDING; *sparse*: the rest.", ""]
    for title, quantity in (("pull-off force", pull_off), ("apparent work of adhesion", work), ("contact area at rest", area)):
        rows = [row("all", ratios(resolved, quantity("separation_curve"), quantity("half_space")))]
        for name in (SPARSE, NEAR_BONDING, CONFORMING):
            rows.append(row(name, ratios([line for line in resolved if regime(line) == name], quantity("separation_curve"), quantity("half_space"))))
        text += table(title, rows)
    rows = [row(kind, ratios([line for line in resolved if line["frame"]["kind"] == kind], ours, reference)) for kind in of_kinds]
    rows += [row("under load", ratios(loaded, ours, reference)), row("fewer than %d contacts" % FEW_CONTACTS, ratios(few, ours, reference)),
             row("more contacts", ratios(many, ours, reference)), row("not resolved", ratios(unresolved, ours, reference))]
    text += table("pull-off force, by kind of frame", rows)
    rows = [row("neither NEAR_BONDING nor RESOLUTION", ratios([line for line in resolved if not flags_of(line) & WARNING_FLAGS], ours, reference)),
            row("RESOLUTION alone", ratios([line for line in resolved if flags_of(line) & WARNING_FLAGS == {"resolution"}], ours, reference)),
            row("NEAR_BONDING", ratios([line for line in resolved if "near_bonding" in flags_of(line)], ours, reference))]
    text += table("pull-off force, by [flags](validity.md#the-flags)", rows)
    text += ["The contact area hangs on a definition: cells that repel each other, and a pixel more or less at each rim changes it. Frames that are not resolved "
             "show what the lattice does to the half-space, not how far the curve is off.", ""]
    if is_of_processes:
        return "\n".join(text + [SETS, ""])
    text += [
             "## The interval of the margin", "",
             "The margin's interval contains the error of the model beside that of the constants (`uncertainty/...`). For each regime it is a standard deviation of the logarithm. "
             "One half of the frames sets it, the other half judges it.", "",
             "- *Set by* the frames with even numbers: the root mean square of their deviations. Where less than 95 % of them would lie within 1.96 times that, it is the value within "
             "1.96 times of which 95 % do lie. It is rounded up.",
             "- *Judged by* the frames with odd numbers: the share of them that the model's part of the 95 % interval covers by itself.", ""]
    text += coverage_rows(resolved)
    return "\n".join(text)


def main():
    source, target, figure = sys.argv[1:]
    lines = [json.loads(line) for line in pathlib.Path(source).read_text().splitlines()]
    solved = [line for line in lines if line["half_space"]["status"] == "SOLVED" and line["half_space"]["is_resolved"]]
    pathlib.Path(target).write_text(page(lines, figure), encoding="utf-8")
    draw(solved, figure)


if __name__ == "__main__":
    main()
