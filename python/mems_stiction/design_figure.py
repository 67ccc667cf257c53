"""A sweep of a design as a picture: the margin over its axes, with the line of margin 1 and its 95
% band.

Takes the record that design_sweep --json prints, as a dictionary.
"""

import math

import numpy as np
from matplotlib.colors import TwoSlopeNorm
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from mems_stiction.design_axes import BY_RATIO, Axis
from mems_stiction.design_words import UNKNOWN, crossings, safe_text, text_of
from mems_stiction.plots import lines_within, plt, save, statement_lines
from mems_stiction.provenance import sign
from mems_stiction.quantities import literal, ratio, typeset, unbroken

BAND, LINE, ONE = "#9bb8d9", "#0b4f9e", "#b3261e"
MOST_DECADES = 3.0  # of the margin that colours tell apart, to either side of 1
MOST_LINES = 12  # of statements below the panel
HEIGHT = 0.19  # of a line of text [inches]
FINE = 241  # nodes along each axis of a map
WIDTH = 9.0  # of the figure [inches]
LEFT = 0.05  # of the statements, as a share of it
LETTER = 9  # size of theirs [points]
OPEN = dict(  # points without a verdict
    marker="o",
    color="none",
    markerfacecolor="white",
    markeredgecolor="black",
    markersize=7,
    linestyle="none",
    clip_on=False,
    zorder=5,
    label="verdict unknown",
)


def save_design(record, path):
    """Writes PNG, PDF or SVG, by the ending of the path."""
    lines = statement_lines(record["statements"], _wrapped, MOST_LINES)
    below = 0.75 + HEIGHT * len(lines)
    height = 5.4 + below
    figure = plt.figure(figsize=(WIDTH, height))
    axes = figure.add_axes([0.13, (below + 0.35) / height, 0.83, 4.2 / height])
    spans = [
        (name, np.array(values), record["units"][name])
        for name, values in record["axes"].items()
        if len(values) > 1
    ]
    spans = spans or [
        (name, np.array(values), record["units"][name])
        for name, values in list(record["axes"].items())[:1]
    ]
    margins = {
        name: _grid(record, name, [len(values) for _, values, _ in spans])
        for name in ("margin", "margin_lower", "margin_upper")
    }
    words = np.array([row["sticks"] for row in record["rows"]]).reshape(margins["margin"].shape)
    if len(spans) == 1:
        _draw_line(axes, spans[0], margins, words, spans[0][0] in record["whole"])
    else:
        _draw_map(axes, spans, margins, words)
    figure.suptitle(
        "Margin of the device: what pulls it open over what holds it",
        fontsize=13,
        y=1.0 - 0.15 / height,
    )
    figure.text(
        LEFT,
        (0.3 + HEIGHT * len(lines)) / height,
        literal("\n".join(lines)),
        fontsize=LETTER,
        va="top",
        color="#333333",
    )
    sign(figure, {"version": record["version"]})
    save(figure, path)


def _wrapped(sentence):
    return lines_within(WIDTH * (1.0 - 2.0 * LEFT), unbroken(sentence), LETTER)


def _grid(record, name, shape):
    """ln margin; what is infinite or not known is NaN."""
    values = np.array(
        [math.nan if row[name] is None else row[name] for row in record["rows"]], dtype=float
    ).reshape(shape)
    return np.log10(np.where(values > 0, values, math.nan))


def _surely(label, words, beyond, word, what):
    """A limit is called sure as far as the points beyond have the word."""
    found = set(words[beyond])
    if word not in found:
        return label
    return "%s: beyond it %s surely%s" % (label, what, "" if found == {word} else ", where known")


def _label(axis, name, values, unit):
    """Ticks as people write them, by ratio where the values are."""
    if values[0] > 0 and values[-1] >= BY_RATIO * values[0]:
        (axis.axes.set_xscale if axis.axis_name == "x" else axis.axes.set_yscale)("log")
        few = values[-1] < 300 * values[0]
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
        axis.set_minor_formatter(NullFormatter())
    axis.set_major_formatter(
        FuncFormatter(lambda value, _: typeset(text_of(float("%.6g" % value), unit)))
    )
    axis.set_label_text(Axis(name, unit, tuple(values)).word)


def _legend(axes, handles):
    """In two lines above the panel."""
    axes.legend(
        handles=handles,
        fontsize=LETTER,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncol=(len(handles) + 1) // 2,
        frameon=False,
    )


def _draw_line(axes, span, margins, words, is_whole):
    name, values, unit = span
    margin, lower, upper = (
        10.0 ** margins[key] for key in ("margin", "margin_lower", "margin_upper")
    )
    if len(values) == 1:
        axes.errorbar(
            values,
            margin,
            yerr=[margin - lower, upper - margin],
            fmt="o",
            color=LINE,
            capsize=4,
            label="margin, 95 %",
        )
    else:
        axes.fill_between(values, lower, upper, color=BAND, alpha=0.6, linewidth=0, label="95 %")
        axes.plot(values, margin, color=LINE, marker=".", label="margin")
        for limit in crossings(values, lower):
            beyond = values >= limit.above if limit.rises else values <= limit.below
            is_sure = (words[beyond] == "no").all()
            side = ("above" if limit.rises else "below") if is_sure else "at"
            axes.axvline(
                limit.value,
                color="#444444",
                linewidth=1.2,
                linestyle="--",
                label="%s %s %s"
                % (
                    "releases surely" if is_sure else "lower end 1",
                    side,
                    typeset(safe_text(limit, Axis(name, unit, tuple(values), is_whole))),
                ),
            )
    axes.axhline(1.0, color=ONE, linewidth=1.4, label="margin 1: above it the device opens")
    unknown = words == UNKNOWN
    if unknown.any():
        axes.plot(values[unknown], np.where(np.isfinite(margin), margin, 1.0)[unknown], **OPEN)
    axes.set_yscale("log")
    few = (
        np.nanmax(upper) < 300 * np.nanmin(lower)
        if np.isfinite(upper).any() and np.isfinite(lower).any()
        else True
    )
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: ratio(value)))
    axes.yaxis.set_minor_formatter(NullFormatter())
    _label(axes.xaxis, name, values, unit)
    axes.set_ylabel("margin")
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    _legend(axes, axes.get_legend_handles_labels()[0])


def _along(values):
    """What margins are interpolated over, as in the statements."""
    return np.log(values) if values[0] > 0 else values


def _fine(values):
    between = np.linspace(_along(values)[0], _along(values)[-1], FINE)
    return np.exp(between) if values[0] > 0 else between


def _between(grid, values, fine):
    """Along one axis after the other."""
    for place in range(2):
        at, known = _along(fine[place]), _along(values[place])
        grid = np.apply_along_axis(
            lambda line, at=at, known=known: np.interp(at, known, line), place, grid
        )
    return grid


def _draw_map(axes, spans, margins, words):
    (x_name, x_values, x_unit), (y_name, y_values, y_unit) = spans
    x, y = _fine(x_values), _fine(y_values)
    margin, lower, upper = (
        _between(margins[key], (x_values, y_values), (x, y)).T
        for key in ("margin", "margin_lower", "margin_upper")
    )
    known = margin[np.isfinite(margin)]
    reach = max(min(float(np.abs(known).max(initial=0.0)), MOST_DECADES), 0.3)
    axes.pcolormesh(
        x,
        y,
        np.ma.masked_invalid(margin),
        cmap="RdBu",
        norm=TwoSlopeNorm(0.0, -reach, reach),
        shading="nearest",
        rasterized=True,
        zorder=0,
    )
    image = axes.collections[0]
    _label(axes.xaxis, x_name, x_values, x_unit)
    _label(axes.yaxis, y_name, y_values, y_unit)
    open_to = np.where(
        np.isfinite(lower) & np.isfinite(upper), np.minimum(-lower, upper), math.nan
    )  # > 0 where 1 lies within
    if np.nanmax(open_to, initial=-1.0) > 0:
        with plt.rc_context({"hatch.linewidth": 0.5, "hatch.color": "#555555"}):
            axes.contourf(
                x, y, open_to, levels=[0.0, 1e3], colors="none", hatches=["////"], zorder=1
            )
    handles = [
        Patch(
            facecolor="none",
            edgecolor="#555555",
            hatch="////",
            linewidth=0.5,
            label="1 lies within the 95 % band",
        )
    ]
    releases = _surely("lower end 1", words, margins["margin_lower"] > 0, "no", "releases")
    sticks = _surely("upper end 1", words, margins["margin_upper"] < 0, "yes", "sticks")
    for grid, style, label in (
        (margin, "-", "margin 1"),
        (lower, "--", releases),
        (upper, ":", sticks),
    ):
        finite = grid[np.isfinite(grid)]
        if finite.size and finite.min() < 0 < finite.max():
            axes.contour(
                x,
                y,
                grid,
                levels=[0.0],
                colors="black",
                linestyles=style,
                linewidths=1.8 if style == "-" else 1.3,
                zorder=2,
            )
            handles.append(Line2D([], [], color="black", linestyle=style, label=label))
    if (words == UNKNOWN).any():
        places = np.argwhere(words == UNKNOWN)
        handles += axes.plot(x_values[places[:, 0]], y_values[places[:, 1]], **OPEN)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(y[0], y[-1])
    _legend(axes, handles)
    bar = axes.figure.colorbar(image, ax=axes, pad=0.02, label="margin")
    bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: ratio(10.0**value, 2)))
