"""A wafer as maps: each site's margin, force and rms height, where no value is known, and places
that do not belong."""

import math

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, MaxNLocator

from mems_stiction.lots_data import UNITS, WORDS, wafer_word
from mems_stiction.lots_wafer import colour_range, figures_of, is_steep
from mems_stiction.lots_words import text_of
from mems_stiction.plots import plt
from mems_stiction.provenance import sign
from mems_stiction.quantities import length_scale, literal, prefix_for, ratio, typeset
from mems_stiction.version import version

BAD = "#e0007a"
EXTENDED = {
    (False, False): "neither",
    (True, False): "min",
    (False, True): "max",
    (True, True): "both",
}


def map_figure(figures, places, missing, others, bad, trend):
    """The figure; the caller saves it.

    figures: what is compared, and the column of the forces; places: of one wafer; missing: (x, y)
    of sites where others have one;
    others: places of all wafers, for one range of colours; bad: records of bad places; trend: its
    record or None."""
    figure = figures[0]
    panels = [
        (name, values) for name, values in _panels(figures, places) if _on_the_map(values, places)
    ]
    drawn = plt.figure(figsize=(max(4.6 * len(panels), 7.0), 5.2))
    grid = drawn.add_gridspec(
        1, len(panels), left=0.07, right=0.96, top=0.82, bottom=0.2, wspace=0.42
    )
    ranges = dict(_panels(figures, others))
    sites = np.array([(place.x, place.y) for place in places if place.has_site()] + list(missing))
    scale, unit = length_scale(float(np.ptp(sites, axis=0).max()) or 1e-3)
    for number, (name, values) in enumerate(panels):
        axes = drawn.add_subplot(grid[0, number])
        shown = _on_the_map(values, places)
        _draw_sites(
            drawn,
            axes,
            name,
            sites * scale,
            np.array([(places[place].x, places[place].y) for place in shown]) * scale,
            values[shown],
            ranges[name],
        )
        drawn_at = {(places[place].x, places[place].y) for place in shown}
        absent = set(missing) - drawn_at | {
            (place.x, place.y)
            for place, value in zip(places, values)
            if place.has_site() and not math.isfinite(value)
        }
        if absent:
            axes.scatter(
                *zip(*[(scale * x, scale * y) for x, y in sorted(absent)]),
                marker="x",
                color="#777777",
                s=_size(sites) * 0.35,
                linewidths=1.3,
            )
        outlying = [row for row in bad if row.figure == name]
        if outlying:
            axes.scatter(
                [scale * row.site_x for row in outlying],
                [scale * row.site_y for row in outlying],
                facecolors="none",
                edgecolors=BAD,
                linewidths=2.2,
                s=_size(sites) * 2.0,
                zorder=4,
            )
        if trend is not None and name == figure and is_steep(trend):
            _draw_trend(axes, trend, sites * scale)
        axes.set_xlabel("x [%s]" % unit)
        if number == 0:
            axes.set_ylabel("y [%s]" % unit)
    _head(drawn, figure, places, missing, bad, trend)
    drawn.legend(
        handles=_legend(bad, missing, places, trend),
        loc="lower center",
        ncol=3,
        fontsize=9,
        frameon=False,
        bbox_to_anchor=(0.5, 0.02),
    )
    sign(drawn, {"version": version()})
    return drawn


def has_map(figures, places):
    """Whether a place of the wafer has a site and a value."""
    return any(_on_the_map(values, places) for _, values in _panels(figures, places))


def _on_the_map(values, places):
    return [
        number
        for number, value in enumerate(values)
        if math.isfinite(value) and places[number].has_site()
    ]


def _panels(figures, places):
    return [
        (name, np.where(np.array(listed) > 0.0, listed, math.nan))
        for name, listed in figures_of(*figures, places).items()
    ]


def _size(sites):
    """Of a mark [points^2], by how close sites are."""
    return float(np.clip(9000.0 / max(len(np.unique(sites, axis=0)), 1), 25.0, 260.0))


def _draw_sites(drawn, axes, name, all_sites, sites, values, everywhere):
    finite = everywhere[np.isfinite(everywhere)]
    low, high, is_by_ratio = colour_range(finite)
    is_cut = finite.min() < low, finite.max() > high
    exponent, prefix = prefix_for(float(np.median(finite))) if UNITS[name] else (0, "")
    factor = 10.0**-exponent
    shown = np.log10(values * factor) if is_by_ratio else values * factor
    ends = [math.log10(end * factor) if is_by_ratio else end * factor for end in (low, high)]
    image = axes.scatter(
        sites[:, 0],
        sites[:, 1],
        c=shown,
        cmap="viridis",
        vmin=ends[0],
        vmax=ends[1],
        s=_size(all_sites),
        marker="s",
        edgecolors="#333333",
        linewidths=0.4,
    )
    unit = typeset("1 " + prefix + UNITS[name])[2:]
    bar = drawn.colorbar(image, ax=axes, pad=0.03, fraction=0.05, extend=EXTENDED[is_cut])
    bar.ax.set_title(unit or "-", fontsize=9)
    if is_by_ratio:
        bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: ratio(10.0**value, 2)))
    axes.set_title(WORDS[name][0].upper() + WORDS[name][1:], fontsize=11)
    axes.set_aspect("equal")
    for axis, along in ((axes.xaxis, 0), (axes.yaxis, 1)):
        span = float(np.ptp(all_sites, axis=0).max()) or 1.0
        middle = 0.5 * (all_sites[:, along].min() + all_sites[:, along].max())
        (axes.set_xlim if along == 0 else axes.set_ylim)(middle - 0.58 * span, middle + 0.58 * span)
        axis.set_major_locator(MaxNLocator(5))
    axes.grid(color="#e4e4e4", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_trend(axes, trend, sites):
    """An arrow up the steepest rise, through the middle."""
    middle = 0.5 * (sites.min(axis=0) + sites.max(axis=0))
    half = (
        0.35
        * float(np.ptp(sites, axis=0).max())
        * np.array([math.cos(trend.direction), math.sin(trend.direction)])
    )
    axes.annotate(
        "",
        xy=middle + half,
        xytext=middle - half,
        arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 1.6},
        zorder=5,
    )


def _head(drawn, figure, places, missing, bad, trend):
    """What the maps show, in two lines."""
    known = sum(place.is_known() for place in places)
    title = wafer_word(places[0].lot, places[0].wafer) or "wafer without a name"
    absent = len({(place.x, place.y) for place in places if not place.is_known()} | set(missing))
    worst = list({(row.site_x, row.site_y): row for row in reversed(bad)}.values())[::-1]
    drawn.suptitle(
        "%s: %d places%s, %d bad"
        % (
            literal(title[0].upper() + title[1:]),
            known,
            ", %d missing" % absent if absent else "",
            len(worst),
        ),
        fontsize=13,
        y=0.985,
    )
    lines = [
        "bad at (%.4g, %.4g) mm: %s %s, expected %s"
        % (
            1e3 * row.site_x,
            1e3 * row.site_y,
            WORDS[row.figure],
            text_of(row.value, row.figure),
            text_of(row.expected, row.figure),
        )
        for row in worst[:2]
    ]
    lines += ["and %d more" % (len(worst) - 2)] if len(worst) > 2 else []
    if trend is not None and is_steep(trend):
        lines.insert(
            0,
            "grows by a factor of %s (%s to %s) along the arrow"
            % (ratio(trend.factor), ratio(max(trend.factor_lower, 1.0)), ratio(trend.factor_upper)),
        )
    drawn.text(0.5, 0.905, typeset("; ".join(lines)), ha="center", fontsize=9, color="#333333")


def _legend(bad, missing, places, trend):
    handles = []
    if len(bad):
        handles.append(
            Line2D(
                [],
                [],
                marker="o",
                markerfacecolor="none",
                markeredgecolor=BAD,
                markeredgewidth=2.2,
                markersize=11,
                linestyle="",
                label="bad: far from the wafer's trend",
            )
        )
    if missing or any(not place.is_known() for place in places):
        handles.append(
            Line2D([], [], marker="x", color="#777777", linestyle="", label="missing: no value")
        )
    if trend is not None and is_steep(trend):
        handles.append(Line2D([], [], color="black", marker=">", label="steepest rise"))
    return handles
