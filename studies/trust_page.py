#!/usr/bin/env python3
"""Writes the error map from what trust_run.py found.

usage: trust_page.py PREDICTIONS.jsonl PAGE.md FIGURE.png
"""

import fractions
import json
import math
import pathlib
import re
import sys

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
import matplotlib.ticker  # noqa: E402
import numpy as np  # noqa: E402
import trust_kinds  # noqa: E402

CONFORMING, DOUBTED = "conforming", "doubted"
SPARSE = "sparse"
COLOURS = {CONFORMING: "#d1322f", DOUBTED: "#f2b705", SPARSE: "#2f7fd1"}
NORMAL_95 = 1.96
OF_THE_MAP = (
    "rms heights of 0.03 to 12 nm, correlation lengths of 10 to 300 nm, contact moduli of 0.1 to "
    "100 GPa, works of adhesion of 5 to 150 mJ/m^2, Hamaker constants of 65 and 200 zJ."
)
SETS = (
    "**Sets of frames.** Rules and interval were set on the frames of seeds 5, 6, 8 and 9, the "
    "flag also on those of 7 and 14 to 17. This page uses seed 19, whose frames nobody had "
    "compared before. `studies/trust --kinds --seed N` draws others."
)
INTERVAL = (
    "The margin's interval contains the error of the model beside that of the constants "
    "(`uncertainty/...`): a standard deviation of the logarithm, without a doubt and with one. "
    "It holds for flattening ratios up to 1; above, it falls with the power %s of that ratio. "
    "It was set on [other kinds](trust_kinds.md), so that 95 %% of each third of them lie "
    "within 1.96 times it. *Covered*: share of this page's frames whose deviation lies within the "
    "model's part of the 95 %% interval."
)
INTERVAL_OF_PROCESSES = (
    "As on the [map](trust.md#the-interval-of-the-margin), for this page's frames."
)
CONSTANTS = (
    pathlib.Path(__file__).resolve().parents[1] / "src" / "separation" / "chosen_constants.hpp"
)
ERRORS = {
    "without a doubt": "Sure",
    "contacts with a doubt": "Doubt",
    "bonded with a doubt": "Bonded",
}
OF_PROCESSES = [
    "in equal shares as processes make them (`studies/trust_kinds.py`): "
    + ", ".join(trust_kinds.KINDS),
    "rms heights of 0.1 to 10 nm, lateral scales of 15 to 200 nm, contact moduli of 2 to 200 GPa, "
    "works of adhesion of 10 to 120 mJ/m^2, Hamaker constants of 40 to 150 zJ.",
]


def is_doubted(frame):
    return "near_bonding" in flags_of(frame)


def regime(frame):
    if frame["separation_curve"]["is_conforming"]:
        return CONFORMING
    return DOUBTED if is_doubted(frame) else SPARSE


def error_group(frame):
    """Which of ERRORS the curve states of a frame."""
    if not is_doubted(frame):
        return "without a doubt"
    return (
        "bonded with a doubt"
        if frame["separation_curve"]["is_conforming"]
        else "contacts with a doubt"
    )


def errors_of_code():
    """Deviations of force and work that the curve states, by group, at flattening ratios up to
    1."""
    source = CONSTANTS.read_text(encoding="utf-8")
    found = {
        name: re.search(r"ModelError k%sError\{(0\.\d+), (0\.\d+)\};" % word, source)
        for name, word in ERRORS.items()
    }
    return {name: tuple(map(float, match.groups())) for name, match in found.items()}


def error_power():
    """Of the flattening ratio: how fast these fall where it is above 1."""
    above, below = re.search(
        r"kErrorPower = (\d\.\d) / (\d\.\d);", CONSTANTS.read_text(encoding="utf-8")
    ).groups()
    return float(above) / float(below)


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
        return "| %s | 0 | | | | | |" % title
    within = [share_within(logs, limit) for limit in (1.15, 1.3)]
    return "| %s | %d | %.3g | %.2g | %s | %.3g |" % (
        title,
        logs.size,
        math.exp(logs.mean()),
        logs.std(),
        " | ".join(within),
        math.exp(np.abs(logs).max()),
    )


def table(title, rows):
    return (
        [
            "| %s | frames | bias | spread | within 1.15 | 1.3 | worst |" % title,
            "|---|---|---|---|---|---|---|",
        ]
        + rows
        + [""]
    )


def share_within(logs, limit):
    logs = logs[np.isfinite(logs)]
    if not logs.size:
        return ""
    percent = 100 * np.mean(np.abs(logs) < math.log(limit))
    return ("%.1f" if 99.0 <= percent < 100.0 else "%.0f") % percent


def kind_rows(frames, kinds):
    """Force, work and area by kind, how many the curve doubts, and the same figures where those are
    judged by the half-space."""
    lines = [
        "| kind | frames | force within 1.15 | 1.3 | work within 1.2 | area within 1.3 | doubted | "
        "others: force within 1.3 | judged: force within 1.3 | work 1.2 | area 1.3 |",
        "|---|" + "---|" * 10,
    ]
    for kind in list(kinds) + [None]:
        of_kind = [frame for frame in frames if kind in (None, frame["frame"]["kind"])]
        force, of_work, of_area = (
            ratios(of_kind, quantity("separation_curve"), quantity("half_space"))
            for quantity in (pull_off, work, area)
        )
        is_solved = np.array([is_doubted(frame) for frame in of_kind])
        judged = [np.where(is_solved, 0.0, logs) for logs in (force, of_work, of_area)]
        lines.append(
            "| %s | %d | %s | %s | %s | %s | %.0f | %s | %s |"
            % (
                kind or "all",
                len(of_kind),
                share_within(force, 1.15),
                share_within(force, 1.3),
                share_within(of_work, 1.2),
                share_within(of_area, 1.3),
                100 * np.mean(is_solved),
                share_within(force[~is_solved], 1.3),
                " | ".join(map(share_within, judged, (1.3, 1.2, 1.3))),
            )
        )
    return lines + [
        "",
        "*Judged*: as for a device with `half_space/enabled: flagged`, where doubted frames are "
        "solved as half-spaces.",
        "",
    ]


def coverage_rows(frames):
    """How many of the frames the deviations of the code cover, by the flag."""
    stated, power = errors_of_code(), error_power()

    def reach_of(frame, i):
        return (
            NORMAL_95
            * stated[error_group(frame)][i]
            * max(1.0, frame["separation_curve"]["flattening_ratio"]) ** -power
        )

    def covered(some):
        cells = []
        for i, quantity in enumerate((pull_off, work)):
            logs = ratios(some, quantity("separation_curve"), quantity("half_space"))
            reach = np.array([reach_of(frame, i) for frame in some])
            known = np.isfinite(logs)
            cells.append(
                "%.0f" % (100 * np.mean(np.abs(logs[known]) <= reach[known])) if known.any() else ""
            )
        return tuple(cells)

    lines = [
        "| frames | number | pull-off force | work | covered, pull-off force | covered, work |",
        "|---|---|---|---|---|---|",
    ]
    for name in ERRORS:
        some = [frame for frame in frames if error_group(frame) == name]
        lines.append(
            "| %s | %d | %.3g | %.3g | %s | %s |"
            % ((name, len(some)) + stated[name] + covered(some))
        )
    lines.append("| all | %d | | | %s | %s |" % ((len(frames),) + covered(frames)))
    return lines + [""]


def draw(frames, figure):
    plot, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for name, colour in COLOURS.items():
        chosen = [frame for frame in frames if regime(frame) == name]
        if chosen:
            axes[0].loglog(
                [frame["separation_curve"]["flattening_ratio"] for frame in chosen],
                np.exp(ratios(chosen, pull_off("separation_curve"), pull_off("half_space"))),
                ".",
                color=colour,
                label=name,
            )
    axes[0].axhspan(1 / 1.15, 1.15, color="#dddddd", zorder=0)
    axes[0].set(
        xlabel="flattening energy / work of adhesion",
        ylabel="separation curve / half-space",
        title="pull-off force, resolved frames",
    )
    axes[0].yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 1.5, 2, 3, 5, 7)))
    axes[0].yaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axes[0].yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes[0].legend()
    for name, colour in (
        ("separation_curve", "#2f7fd1"),
        ("paper", "#d1322f"),
        ("printed", "#f2b705"),
        ("rigid", "#7a7a7a"),
    ):
        value = (lambda frame: frame["rigid"]) if name == "rigid" else pull_off(name)
        logs = ratios(frames, value, pull_off("half_space"))
        logs = np.sort(np.abs(logs[np.isfinite(logs)]))
        axes[1].semilogx(
            np.exp(logs),
            100 * (np.arange(logs.size) + 1) / max(logs.size, 1),
            color=colour,
            label=name,
        )
    axes[1].set(
        xlabel="off by this factor at most",
        ylabel="share of frames [%]",
        xlim=(1, 100),
        title="pull-off force, all formulations",
    )
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
    rigid = ratios(resolved, lambda frame: frame["rigid"], reference)
    of_kinds = sorted({line["frame"]["kind"] for line in resolved})
    is_of_processes = bool(set(of_kinds) & set(trust_kinds.KINDS))
    frames = (
        OF_PROCESSES
        if is_of_processes
        else [
            "Gaussian, skewed, self-affine (H 0.5 to 0.9), arrays of spheres"
            + (", parts of measured scans" if "scan" in of_kinds else ""),
            OF_THE_MAP,
        ]
    )
    text = [
        "# Error map" + (" of other kinds" if is_of_processes else ""),
        "",
        "How far each formulation lies from the [adhesive half-space](half_space.md), on random "
        "surfaces of many kinds. Written by "
        "`studies/trust%s`." % (" --kinds" if is_of_processes else ""),
        "",
        "- **Frames.** %d of %d x %d pixels: %s. Nothing flows."
        % (len(lines), size, size, frames[0]),
        "- **Drawn from** %s A third is pressed with 0.1 to 100 MPa." % frames[1],
        "- **Reference.** The half-space solved %d in the time given. Its pixels resolve the "
        "cohesive length E z0^2/Gamma on %d of these, and only those "
        "count." % (len(solved), len(resolved)),
        "- **Figures** as on the [map](trust.md)."
        if is_of_processes
        else "- **Figures** are ratios to the half-space's: *bias* is their geometric mean, "
        "*spread* the standard deviation of their logarithm. Shares of frames are in percent.",
        "",
        "![error of the pull-off force](images/%s)" % pathlib.Path(figure).name,
        "",
        "## Formulations",
        "",
    ]
    text += table(
        "pull-off force",
        [
            row("`separation_curve`", ratios(resolved, ours, reference)),
            row("`paper`", ratios(resolved, pull_off("paper"), reference)),
            row("`printed`", ratios(resolved, pull_off("printed"), reference)),
            row("rigid, at first touch", rigid),
        ],
    )
    text += ["## Where `separation_curve` is right", ""]
    if not is_of_processes:
        text += [
            "*conforming*: frames that are bonded. *doubted*: other frames with the flag "
            "NEAR_BONDING; `model_doubt` gives the reason. *sparse*: the rest.",
            "",
        ]
    rows = [row("pull-off force, all", ratios(resolved, ours, reference))]
    for name in (SPARSE, CONFORMING, DOUBTED):
        of_name = [line for line in resolved if regime(line) == name]
        rows.append(row("pull-off force, " + name, ratios(of_name, ours, reference)))
    rows.append(row("pull-off force, under load", ratios(loaded, ours, reference)))
    if unresolved:
        rows.append(row("pull-off force, not resolved", ratios(unresolved, ours, reference)))
    for title, quantity in (("apparent work of adhesion", work), ("contact area at rest", area)):
        rows.append(
            row(
                title + ", all",
                ratios(resolved, quantity("separation_curve"), quantity("half_space")),
            )
        )
    text += table("figure", rows)
    text += kind_rows(resolved, of_kinds)
    rows = [
        row(
            "without NEAR_BONDING",
            ratios([line for line in resolved if not is_doubted(line)], ours, reference),
        ),
        row(
            "NEAR_BONDING", ratios([line for line in resolved if is_doubted(line)], ours, reference)
        ),
    ]
    text += table("pull-off force, by [flags](validity.md#the-flags)", rows)
    if not is_of_processes:
        text += [
            "The contact area counts cells that repel each other, so a pixel more or less at each "
            "rim changes it. Frames that are not resolved show the effect of the grid on the "
            "half-space, not the error of the curve.",
            "",
        ]
    text += [
        "## The interval of the margin",
        "",
        INTERVAL_OF_PROCESSES
        if is_of_processes
        else INTERVAL % fractions.Fraction(error_power()).limit_denominator(100),
        "",
    ]
    text += coverage_rows(resolved)
    return "\n".join(text + ([SETS, ""] if is_of_processes else []))


def main():
    source, target, figure = sys.argv[1:]
    lines = [json.loads(line) for line in pathlib.Path(source).read_text().splitlines()]
    solved = [
        line
        for line in lines
        if line["half_space"]["status"] == "SOLVED" and line["half_space"]["is_resolved"]
    ]
    pathlib.Path(target).write_text(page(lines, figure), encoding="utf-8")
    draw(solved, figure)


if __name__ == "__main__":
    main()
