#!/usr/bin/env python3
"""Writes the tables and the picture of doc/device.md from what device_study.py and device_scans.py
found.

usage: device_page.py RESULTS.jsonl PAGE.md FIGURE.png
       device_page.py --scans RESULTS.jsonl PAGE.md

The page keeps its text: what stands between two marks is written anew.
"""

import json
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import numpy as np  # noqa: E402

import device_surfaces  # noqa: E402

MARKS = "<!-- %s: begin -->", "<!-- %s: end -->"
PITCH = 0.01  # um
COLUMNS = (
    "| {} | surfaces | bias | spread | within 1.3 | 1.5 | 2 | 2.5 | interval covers | linear "
    "rule |\n|---|---|---|---|---|---|---|---|---|---|"
)
CASES = {
    "k1": "1 scan",
    "k4": "4 scans",
    "k16": "16 scans",
    "k1+wide": "1 scan and a wide one",
    "k4+wide": "4 scans and a wide one",
}


def logs(rows, figure="force"):
    return np.array([math.log(row[figure] / row["truth"]) for row in rows])


def covered(row):
    """By what the scans leave open; constants and model are the same on both sides."""
    return row["surface_lower"] <= row["truth"] <= row["surface_upper"]


def line(title, rows):
    found = logs(rows)
    shares = [
        "%.0f" % (100 * np.mean(np.abs(found) <= math.log(limit))) for limit in (1.3, 1.5, 2, 2.5)
    ]
    return "| %s | %d | %.2f | %.2f | %s | %.0f | %.2g |" % (
        title,
        len(rows),
        math.exp(found.mean()),
        found.std(),
        " | ".join(shares),
        100 * np.mean([covered(row) for row in rows]),
        math.exp(logs(rows, "linear").mean()),
    )


def groups(rows):
    """(case, side, rows) of each table. Surfaces that bond all over go with area: nothing is asked
    of them."""
    asked = [row for row in rows if not row["is_conforming"]]
    for case in CASES:
        for side in sorted({row["side"] for row in asked if row["case"] == case}, reverse=True):
            yield case, side, [row for row in asked if (row["case"], row["side"]) == (case, side)]


def bias_of(rows):
    """The geometric mean of the ratio; a star where the interval of a surface misses the truth."""
    if not rows:
        return "-"
    return "%.2f%s" % (
        math.exp(logs(rows).mean()),
        "" if all(covered(row) for row in rows) else " *",
    )


def tables(rows):
    """One row for each case, then the bias by kind."""
    found = list(groups(rows))
    parts = [COLUMNS.format("scans; side of the surfaces")]
    for case, side, of_case in found:
        parts.append(line("%s; %d pixels" % (CASES[case], side), of_case))
    titles = ["%s; %d pixels" % (CASES[case], side) for case, side, _ in found]
    kinds = {
        kind: kind for kind in device_surfaces.KINDS if any(row["kind"] == kind for row in rows)
    }
    return "\n".join(
        parts
        + [
            "",
            *bias_table("kind", kinds, dict(zip(titles, (of_case for _, _, of_case in found)))),
            "",
        ]
    )


def bias_table(name, titles, groups_of_rows):
    """A line for each value of the field, with its title, and a column for each group of rows."""
    parts = [
        "| bias, by %s | %s |" % (name, " | ".join(groups_of_rows)),
        "|---" * (len(groups_of_rows) + 1) + "|",
    ]
    for value, title in titles.items():
        cells = [
            bias_of([row for row in group if row[name] == value])
            for group in groups_of_rows.values()
        ]
        parts.append("| %s | %s |" % (title, " | ".join(cells)))
    return parts


def scan_tables(rows):
    """As tables(), by scan."""
    asked = [row for row in rows if not row["is_conforming"]]
    found = {CASES[case]: [row for row in asked if row["case"] == case] for case in CASES}
    found = {title: group for title, group in found.items() if group}
    parts = [COLUMNS.format("scans").replace("surfaces", "draws")] + [
        line(title, group) for title, group in found.items()
    ]
    scans = {
        row["scan"]: "`%s`, %d pixels of %.3g nm" % (row["scan"], row["side"], 1e9 * row["pitch"])
        for row in asked
    }
    parts += ["", *bias_table("scan", scans, found), ""]
    conforming = sorted({row["scan"] for row in rows if row["is_conforming"]})
    if conforming:
        parts.append(
            "%s bond all over: their force is proportional to area, so they are left out.\n"
            % ", ".join("`%s`" % scan for scan in conforming)
        )
    return "\n".join(parts)


def figure(rows, path):
    found = list(groups(rows))
    kinds = [kind for kind in device_surfaces.KINDS if any(row["kind"] == kind for row in rows)]
    drawing, axes = plt.subplots(
        len(found), 1, figsize=(8.5, 0.7 + 2.3 * len(found)), sharex=True, squeeze=False
    )
    for axis, (case, side, of_case) in zip(axes[:, 0], found):
        for place, kind in enumerate(kinds):
            of_kind = [row for row in of_case if row["kind"] == kind]
            if not of_kind:
                continue
            x = place + 0.16 * (np.arange(len(of_kind)) - (len(of_kind) - 1) / 2)
            truth = np.array([row["truth"] for row in of_kind])
            ratio = np.array([row["force"] for row in of_kind]) / truth
            ends = np.array(
                [
                    [row["force"] - row["surface_lower"], row["surface_upper"] - row["force"]]
                    for row in of_kind
                ]
            ).T
            axis.errorbar(x, ratio, ends / truth, fmt="o", ms=4, lw=1.2, color="#2f7fd1")
            axis.plot(x, [row["linear"] for row in of_kind] / truth, "x", ms=5, color="#d1322f")
        axis.axhspan(1 / 1.5, 1.5, color="0.92", zorder=0)
        axis.axhline(1.0, color="0.3", lw=0.8, zorder=1)
        axis.set_yscale("log")
        axis.set_ylim(0.05, 200)
        axis.set_yticks([0.1, 1, 10, 100])
        axis.set_yticklabels(["0.1", "1", "10", "100"])
        axis.set_title(
            "%s; surfaces of %d x %d pixels" % (CASES[case], side, side), fontsize=10, loc="left"
        )
    axes[-1][0].set_xticks(range(len(kinds)))
    axes[-1][0].set_xticklabels(kinds)
    axes[-1][0].set_xlim(-0.5, len(kinds) - 0.5)
    drawing.supylabel("force said over that of the large surface [-]", fontsize=10)
    said = axes[0][0].plot([], [], "o", color="#2f7fd1", label="predict_device, 95 % by the scans")
    linear = axes[0][0].plot([], [], "x", color="#d1322f", label="the scans' force by area")
    drawing.legend(handles=said + linear, loc="lower center", ncol=2, fontsize=9, frameon=False)
    drawing.tight_layout(rect=(0, 0.03 + 0.03 / len(found), 1, 1))
    drawing.savefig(path, dpi=110)


def read(path):
    return [json.loads(text) for text in pathlib.Path(path).read_text().splitlines()]


def rewrite(page, name, text):
    """What stands between the marks of this name."""
    begin, end = (mark % name for mark in MARKS)
    before, rest = page.read_text().split(begin)
    _, after = rest.split(end)
    page.write_text("%s%s\n\n%s\n%s%s" % (before, begin, text, end, after))


def main():
    if sys.argv[1] == "--scans":
        rewrite(pathlib.Path(sys.argv[3]), "scans", scan_tables(read(sys.argv[2])))
        return
    results, page, picture = sys.argv[1:]
    rows = read(results)
    figure(rows, picture)
    sizes = ", ".join(
        "%d x %d (%.0f um)" % (side, side, side * PITCH)
        for side in sorted({row["side"] for row in rows}, reverse=True)
    )
    head = (
        "Surfaces of %s pixels of 10 nm, %d of them, drawn by kind and\nnumber (seed %s). Scans "
        "have 512 x 512 pixels at random places; the wide scan covers the whole with\npixels of 80 "
        "nm. *Bias* is the geometric mean of the ratio to the force of the whole "
        "surface,\n*spread* the standard deviation of its logarithm. Shares are in percent. The "
        "interval is that of\nthe scans alone, since constants and model are the same on both "
        "sides; a star marks a kind of which\nan interval misses the truth. Surfaces that bond all "
        "over are left out.\n"
        % (
            sizes,
            len({(row["kind"], row["number"], row["seed"], row["side"]) for row in rows}),
            ", ".join(sorted({str(row["seed"]) for row in rows})),
        )
    )
    rewrite(
        pathlib.Path(page),
        "study",
        "%s\n![force of devices](images/device.png)\n\n%s" % (head, tables(rows)),
    )


if __name__ == "__main__":
    main()
