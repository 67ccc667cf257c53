"""A calibration as a picture: what was measured over what the fitted constants expect, and how far
each lies off.

Takes the record that calibrate --json prints, as a dictionary.
"""

import textwrap

import numpy as np

from mems_stiction.calibration_words import UNITS
from mems_stiction.plots import name_ticks, plt, save
from mems_stiction.provenance import sign
from mems_stiction.quantities import literal, prefix_for, typeset, with_interval

COLOURS = {
    "pull_off_force": "#0b4f9e",
    "apparent_work_of_adhesion": "#1b7f4d",
    "detachment_length": "#d17a00",
    "crack_length": "#7a3ea1",
}
OUTLIER = "#b3261e"
MOST_NAMES = 40  # below the lower panel; more would overlap
LINE = 0.19  # height of a line of text below the panels [inches]
LETTERS = 120  # of such a line


def save_calibration(record, path):
    """Writes PNG, PDF or SVG, by the ending of the path."""
    lines = [
        line
        for text in record["statements"]
        for line in textwrap.wrap(text[0].upper() + text[1:] + ".", LETTERS)
    ]
    kinds = [kind for kind in UNITS if any(row["kind"] == kind for row in record["measurements"])]
    below = 0.5 + LINE * len(lines)
    height = 7.6 + below
    figure = plt.figure(figsize=(max(9.0, 4.3 * len(kinds)), height))
    grid = figure.add_gridspec(
        2,
        len(kinds),
        height_ratios=(1.5, 1.0),
        left=0.09,
        right=0.97,
        top=1.0 - 0.85 / height,
        bottom=(below + 0.75) / height,
        hspace=0.42,
        wspace=0.3,
    )
    for place, kind in enumerate(kinds):
        _draw_kind(
            figure.add_subplot(grid[0, place]),
            kind,
            [row for row in record["measurements"] if row["kind"] == kind],
        )
    _draw_deviations(figure.add_subplot(grid[1, :]), record["measurements"])
    figure.suptitle(_title(record), fontsize=13, y=1.0 - 0.25 / height)
    figure.text(
        0.09,
        (0.3 + LINE * len(lines)) / height,
        "\n".join(literal(typeset(line)) for line in lines),
        fontsize=9,
        va="top",
        color="#333333",
    )
    sign(figure, {"version": record["version"]})
    save(figure, path)


def _title(record):
    if record["work_of_adhesion"] is None:
        return "The measurements do not tell the work of adhesion"
    return "Work of adhesion " + typeset(
        with_interval(
            record["work_of_adhesion"],
            record["work_of_adhesion_lower"],
            record["work_of_adhesion_upper"],
            "J/m^2",
        )
    )


def _draw_kind(axes, kind, rows):
    """Measured over fitted, with standard uncertainties; on the line both are equal."""
    measured = np.array([row["value"] for row in rows])
    fitted = np.array([row["fitted"] for row in rows])
    errors = np.array([row["uncertainty"] for row in rows])
    exponent, prefix = prefix_for(float(np.median(measured)))
    scale = 10.0**exponent
    colours = [OUTLIER if row["is_outlier"] else COLOURS[kind] for row in rows]
    low = (
        min((measured - errors)[measured - errors > 0].min(initial=measured.min()), fitted.min())
        / scale
    )
    high = max((measured + errors).max(), fitted.max()) / scale
    ends = np.array([low / 1.25, high * 1.25])
    axes.plot(ends, ends, color="#888888", linewidth=1.0, zorder=1)
    for x, y, error, colour in zip(fitted / scale, measured / scale, errors / scale, colours):
        axes.errorbar(
            x,
            y,
            yerr=error,
            fmt="o",
            markersize=5,
            color=colour,
            ecolor=colour,
            elinewidth=1.0,
            capsize=2.5,
            zorder=2,
        )
    if high > 4 * low:
        axes.set_xscale("log")
        axes.set_yscale("log")
    axes.set_xlim(*ends)
    axes.set_ylim(*ends)
    unit = typeset(prefix + UNITS[kind])
    axes.set_title(kind.replace("pull_off", "pull-off").replace("_", " "), fontsize=11)
    axes.set_xlabel("fitted [%s]" % unit)
    axes.set_ylabel("measured [%s]" % unit)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_deviations(axes, rows):
    """Each measurement's distance from what is expected, in standard deviations; two of them are
    shaded."""
    places = np.arange(len(rows))
    axes.axhspan(-2, 2, color="#e9edf2", zorder=0)
    axes.axhline(0, color="#888888", linewidth=1.0)
    colours = [OUTLIER if row["is_outlier"] else COLOURS[row["kind"]] for row in rows]
    axes.scatter(places, [row["deviation"] for row in rows], c=colours, s=28, zorder=2)
    axes.set_ylabel("standard deviations")
    axes.set_xlim(-0.6, len(rows) - 0.4)
    most = max(3.0, max(abs(row["deviation"]) for row in rows) * 1.15)
    axes.set_ylim(-most, most)
    if len(rows) <= MOST_NAMES:
        name_ticks(axes, [row["name"] for row in rows], 6, fontsize=8.5)
    else:
        axes.set_xlabel("number of the measurement")
