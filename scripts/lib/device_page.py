#!/usr/bin/env python3
"""Writes the tables and the picture of doc/device.md from what device_study.py found.

usage: device_page.py RESULTS.jsonl PAGE.md FIGURE.png

The page keeps its text: what stands between the two marks is written anew.
"""

import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402

BEGIN, END = "<!-- study: begin -->", "<!-- study: end -->"
COLUMNS = "| {} | surfaces | bias | spread | within 1.3 | 1.5 | 2 | 2.5 | interval covers | linear rule |\n|---|---|---|---|---|---|---|---|---|---|"
LONG_WAVES = "measure a field"
CASES = {"k1": "1 scan", "k4": "4 scans", "k16": "16 scans", "k1+wide": "1 scan and a wide one", "k4+wide": "4 scans and a wide one"}


def logs(rows, figure="force"):
    return np.array([math.log(row[figure] / row["truth"]) for row in rows])


def covered(row):
    """By what the scans leave open; constants and model are the same on both sides."""
    return row["surface_lower"] <= row["truth"] <= row["surface_upper"]


def line(title, rows):
    found = logs(rows)
    shares = ["%.0f %%" % (100 * np.mean(np.abs(found) <= math.log(limit))) for limit in (1.3, 1.5, 2, 2.5)]
    return "| %s | %d | %.2f | %.2f | %s | %.0f %% | %.2g |" % (
        title, len(rows), math.exp(found.mean()), found.std(), " | ".join(shares), 100 * np.mean([covered(row) for row in rows]),
        math.exp(logs(rows, "linear").mean()))


def tables(rows):
    parts = []
    for case in [case for case in CASES if any(row["case"] == case for row in rows)]:
        of_case = [row for row in rows if row["case"] == case and not row["is_conforming"]]
        warned = [row for row in of_case if any(LONG_WAVES in warning for warning in row["warnings"])]
        parts += ["### %s" % CASES[case].capitalize(), "", COLUMNS.format("kind")]
        for kind in dict.fromkeys(row["kind"] for row in of_case):
            parts.append(line(kind, [row for row in of_case if row["kind"] == kind]))
        parts.append(line("all", of_case))
        if warned and len(warned) < len(of_case):
            parts.append(line("with the warning that long waves are missing", warned))
            parts.append(line("without it", [row for row in of_case if row not in warned]))
        parts.append("")
    return "\n".join(parts)


def figure(rows, path):
    cases = [case for case in CASES if any(row["case"] == case for row in rows)]
    kinds = list(dict.fromkeys(row["kind"] for row in rows))
    drawing, axes = plt.subplots(1, len(cases), figsize=(1.5 + 3.1 * len(cases), 4.2), sharey=True, squeeze=False)
    for axis, case in zip(axes[0], cases):
        for place, kind in enumerate(kinds):
            of_kind = [row for row in rows if row["case"] == case and row["kind"] == kind and not row["is_conforming"]]
            x = place + np.linspace(-0.25, 0.25, max(len(of_kind), 2))[:len(of_kind)]
            ratio = np.array([row["force"] / row["truth"] for row in of_kind])
            ends = np.array([[row["force"] - row["surface_lower"], row["surface_upper"] - row["force"]] for row in of_kind]).T
            if of_kind:
                axis.errorbar(x, ratio, ends / [row["truth"] for row in of_kind], fmt="o", ms=4, lw=1, color="#2f7fd1")
                axis.plot(x, [row["linear"] / row["truth"] for row in of_kind], "x", ms=4, color="#d1322f")
        axis.axhline(1.0, color="0.3", lw=0.8)
        axis.axhspan(1 / 1.5, 1.5, color="0.92", zorder=0)
        axis.set_yscale("log")
        axis.set_ylim(0.02, 200)
        axis.set_xticks(range(len(kinds)))
        axis.set_xticklabels(kinds, rotation=60, ha="right")
        axis.set_title(CASES[case], fontsize=10)
    axes[0][0].set_ylabel("force said over that of the large surface [-]")
    axes[0][0].plot([], [], "o", color="#2f7fd1", label="predict_device, 95 % by the scans")
    axes[0][0].plot([], [], "x", color="#d1322f", label="scans' force by area")
    axes[0][0].legend(loc="lower left", fontsize=8)
    drawing.tight_layout()
    drawing.savefig(path, dpi=110)


def main():
    results, page, picture = (pathlib.Path(argument) for argument in sys.argv[1:])
    rows = [json.loads(text) for text in results.read_text().splitlines()]
    figure(rows, picture)
    text = page.read_text()
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    side = rows[0]["side"] * 0.01
    head = ("Surfaces of %d x %d pixels of 10 nm (%.0f um), %d of them, drawn by kind and number (seed %s); scans of 512 x 512 pixels at random\n"
            "places, the wide one with pixels of 80 nm over the whole. *Bias* is the geometric mean of the ratio to the force of the whole surface, *spread*\n"
            "the standard deviation of its logarithm; the interval is that of the scans alone, since constants and model are the same on both sides.\n"
            % (rows[0]["side"], rows[0]["side"], side, len({(row["kind"], row["number"], row["seed"]) for row in rows}),
               ", ".join(sorted({str(row["seed"]) for row in rows}))))
    page.write_text("%s%s\n\n%s\n![force of devices](images/device.png)\n\n%s\n%s%s" % (before, BEGIN, head, tables(rows), END, after))


if __name__ == "__main__":
    main()
