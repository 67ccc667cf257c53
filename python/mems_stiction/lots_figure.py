"""Lots, wafers and parts side by side as a picture: where differences lie, each unit with its
interval, the share that sticks.

Takes the record that compare_lots --json prints, as a dictionary.
"""

import textwrap

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from mems_stiction.lots_data import RELEASING, UNITS, WORDS
from mems_stiction.plots import name_ticks, plt, save, statement_lines
from mems_stiction.provenance import sign
from mems_stiction.quantities import literal, prefix_for, ratio, typeset

COLOURS = (
    "#0b4f9e",
    "#d17a00",
    "#1b7f4d",
    "#7a3ea1",
    "#8a6d3b",
    "#2a9d9d",
)  # of lots or wafers, in turn
ONE = "#b3261e"
MOST_UNITS = 80  # side by side; more would overlap
MOST_NAMES = 40
LINE = 0.165  # height of a line of text [inches]
LETTERS = 160
MOST_LINES = 24
LEAST_SHARE = 1e-6  # that a picture shows
WORDS_OF_METHOD = {"normal": "normal distribution", "counted": "counted", "bound": "bound"}
MARKERS = {"normal": "o", "counted": "s", "bound": "v"}


def save_comparison(record, path):
    """Writes PNG, PDF or SVG, by the ending of the path."""
    save(comparison_figure(record), path)


def comparison_figure(record, has_statements=True):
    """The figure; the caller saves it. has_statements: the sentences stand below the panels."""
    statements = record["statements"] if has_statements else []
    lines = statement_lines(
        statements, lambda sentence: textwrap.wrap(sentence, LETTERS), MOST_LINES
    )
    below = 0.35 + LINE * len(lines)
    height = 7.6 + below
    figure = plt.figure(figsize=(11.0, height))
    grid = figure.add_gridspec(
        2,
        2,
        height_ratios=(1.0, 1.35),
        left=0.12,
        right=0.97,
        top=1.0 - 0.75 / height,
        bottom=(below + 1.15) / height,
        hspace=0.6,
        wspace=0.28,
    )
    _draw_components(figure.add_subplot(grid[0, 0]), record["components"])
    _draw_shares(figure.add_subplot(grid[0, 1]), record)
    _draw_units(figure.add_subplot(grid[1, :]), record)
    figure.suptitle(
        "Lots, wafers and parts by their %s" % WORDS[record["figure"]],
        fontsize=13,
        y=1.0 - 0.2 / height,
    )
    figure.text(
        0.04,
        (0.3 + LINE * len(lines)) / height,
        literal("\n".join(lines)),
        fontsize=9,
        va="top",
        color="#333333",
    )
    sign(figure, {"version": record["version"]})
    return figure


def _empty(axes, text):
    axes.set_xticks([])
    axes.set_yticks([])
    axes.text(
        0.5,
        0.5,
        text,
        transform=axes.transAxes,
        ha="center",
        va="center",
        color="#777777",
        wrap=True,
    )


def _draw_components(axes, rows):
    """Standard deviations as factors, with their 95 % intervals."""
    axes.set_title("How far they differ (one standard deviation)", fontsize=11)
    if not rows:
        _empty(axes, "one row")
        return
    places = np.arange(len(rows))[::-1]
    factors = {
        key: np.exp([row[key] for row in rows])
        for key in ("deviation", "deviation_lower", "deviation_upper")
    }
    best = factors["deviation"]
    axes.barh(places, best - 1.0, left=1.0, color="#9bb8d9", height=0.55)
    axes.errorbar(
        best,
        places,
        xerr=[best - factors["deviation_lower"], factors["deviation_upper"] - best],
        fmt="o",
        markersize=4,
        color="#0b4f9e",
        capsize=4,
    )
    axes.set_yticks(places)
    axes.set_yticklabels(
        [textwrap.fill("%s (%d)" % (row["level"], row["units"]), 18) for row in rows], fontsize=9
    )
    axes.set_ylim(-0.6, len(rows) - 0.4)
    most = min(float(factors["deviation_upper"].max()), 8.0 * float(best.max()))
    axes.set_xlim(1.0, 1.0 + 1.12 * max(most - 1.0, 1e-3))
    cut = [place for place, end in zip(places, factors["deviation_upper"]) if end > most]
    for place in cut:
        axes.text(
            0.985,
            place + 0.12,
            "→",
            transform=axes.get_yaxis_transform(),
            ha="right",
            color="#0b4f9e",
            fontsize=12,
        )
    axes.set_xlabel("factor, with its 95 % interval")
    axes.grid(axis="x", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_shares(axes, record):
    axes.set_title("Expected to stick", fontsize=11)
    rows = record["shares"]
    if not rows:
        _empty(axes, "no margin is known")
        return
    if record["against"]:
        along = np.array([row["at"] for row in rows])
        axes.set_xlabel(_label(record["against"]))
    else:
        along = np.zeros(len(rows))
        axes.set_xlim(-1.0, 1.0)
        axes.set_xticks([])
    for method in MARKERS:
        chosen = [place for place, row in enumerate(rows) if row["method"] == method]
        if not chosen:
            continue
        best, lower, upper = (
            100.0 * np.array([rows[place][key] for place in chosen])
            for key in ("share", "lower", "upper")
        )
        shown = np.maximum(upper if method == "bound" else best, 100.0 * LEAST_SHARE)
        if method == "bound" and any(rows[place]["share"] > 0.5 for place in chosen):
            shown = np.where(best > 50.0, lower, upper)
        axes.errorbar(
            along[chosen],
            shown,
            yerr=[
                np.maximum(shown - np.maximum(lower, 100.0 * LEAST_SHARE), 0.0),
                np.maximum(upper - shown, 0.0),
            ],
            fmt=MARKERS[method],
            color=COLOURS[0],
            capsize=4,
            label="%s, 95 %%" % WORDS_OF_METHOD[method],
        )
    tails = [
        (at, row["tail"])
        for at, row in zip(along, rows)
        if row["tail"] is not None and row["method"] != "normal" and row["tail"] > LEAST_SHARE
    ]
    if tails:
        axes.scatter(
            *zip(*[(at, 100.0 * tail) for at, tail in tails]),
            marker="_",
            color=ONE,
            label="tail of a normal distribution",
        )
    highest = max(row["upper"] for row in rows)
    lowest = min(
        (row[key] for row in rows for key in ("lower", "share") if row[key] > LEAST_SHARE),
        default=1.0,
    )
    if highest > 30.0 * lowest:
        axes.set_yscale("log")
        axes.set_ylim(100.0 * LEAST_SHARE if lowest < 10.0 * LEAST_SHARE else 50.0 * lowest, 200.0)
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: ratio(value)))
    else:
        axes.set_ylim(0.0, min(100.0, 125.0 * highest) if highest > 0 else 1.0)
    axes.set_ylabel("share of places [%]")
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.legend(
        fontsize=8.5,
        loc="upper center",
        ncol=4,
        bbox_to_anchor=(0.5, -0.22 if record["against"] else -0.06),
        frameon=False,
    )


def _label(column):
    unit = UNITS.get(column, "")
    return "%s%s" % (literal(WORDS.get(column, column)), " [%s]" % unit if unit else "")


def _draw_units(axes, record):
    """Those of the smallest kind that fit: parts, wafers, or lots."""
    levels = list(dict.fromkeys(row["level"] for row in record["units"]))
    counts = {level: sum(row["level"] == level for row in record["units"]) for level in levels}
    fitting = [level for level in levels if 1 < counts[level] <= MOST_UNITS] or [
        level for level in levels if counts[level] <= MOST_UNITS
    ]
    if not fitting:
        _empty(
            axes,
            "rows name no lot, wafer or part"
            if not levels
            else "more than %d %s" % (MOST_UNITS, levels[-1]),
        )
        return
    rows = [row for row in record["units"] if row["level"] == fitting[-1]]
    groups = list(dict.fromkeys(_group(row) for row in rows))
    exponent, prefix = (
        prefix_for(float(np.median([row["value"] for row in rows])))
        if UNITS[record["figure"]]
        else (0, "")
    )
    scale = 10.0**-exponent
    for number, group in enumerate(groups):
        own = [place for place, row in enumerate(rows) if _group(row) == group]
        value, lower, upper = (
            scale
            * np.array([rows[place]["value" if rows[place][key] is None else key] for place in own])
            for key in ("value", "lower", "upper")
        )
        axes.errorbar(
            own,
            value,
            yerr=[value - lower, upper - value],
            fmt="o",
            markersize=5,
            color=COLOURS[number % len(COLOURS)],
            capsize=3,
            label=literal(group) if len(groups) <= 2 * len(COLOURS) else None,
        )
    values = [
        scale * row[key]
        for row in rows
        for key in ("value", "lower", "upper")
        if row[key] is not None
    ]
    if record["figure"] in RELEASING:
        axes.axhline(1.0, color=ONE, linewidth=1.4, linestyle="--", label="1: sticks below")
        values.append(1.0)
    if max(values) > 8.0 * min(values):
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: ratio(value)))
        axes.yaxis.set_minor_formatter(NullFormatter())
    unit = typeset("1 " + prefix + UNITS[record["figure"]])[2:]
    axes.set_ylabel(WORDS[record["figure"]] + (" [%s]" % unit if unit else ""))
    axes.set_title(
        "%s side by side: geometric mean and 95 %% interval" % fitting[-1].capitalize(), fontsize=11
    )
    axes.set_xlim(-0.6, len(rows) - 0.4)
    if len(rows) <= MOST_NAMES:
        name_ticks(axes, [_name(row) for row in rows], 8, fontsize=9)
    else:
        axes.set_xticks([])
    axes.grid(axis="y", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    handles, labels = axes.get_legend_handles_labels()
    if any(labels):
        axes.legend(
            handles,
            labels,
            fontsize=8.5,
            ncol=min(len(labels), 6),
            loc="upper center",
            bbox_to_anchor=(0.5, -0.12 if len(rows) <= 8 else -0.2),
            frameon=False,
        )


def _group(row):
    """What it stands in, and has its colour from."""
    pairs = (("lot", row["lot_id"]), ("wafer", row["wafer_id"]))[
        : {"lots": 0, "wafers": 1, "parts": 2}[row["level"]]
    ]
    return ", ".join("%s %s" % pair for pair in pairs if pair[1])


def _name(row):
    return {"lots": row["lot_id"], "wafers": row["wafer_id"], "parts": row["part"]}[
        row["level"]
    ] or "not named"
