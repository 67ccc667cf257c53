"""Curves of force over height as a picture: both ways, jumps, the pull-off force. For plot_curve
and the report."""

import numpy as np

from mems_stiction.plots import plt, with_unit
from mems_stiction.provenance import FIELDS, sign
from mems_stiction.quantities import literal, prefix_for

COLOURS = ("#0b4f9e", "#d1322f", "#3d8c40", "#8e5bb5", "#b86a00", "#4f4f4f")
PRESSED_SHARE = 1.5  # of the largest attraction: deeper repulsion leaves the picture


def curve_picture(curves, title):
    """A figure of all curves over each other."""
    figure, axes = plt.subplots(figsize=(9, 5.8), dpi=110)
    figure.subplots_adjust(left=0.1, right=0.975, top=0.92, bottom=0.135)
    axes.set_title(literal(title), fontsize=12, loc="left", fontweight="bold")
    draw_curves(axes, curves)
    sign(figure, origin_of(curves))
    return figure


def origin_of(curves):
    """What all of them have in common; of scans and parts that differ, all names."""
    return {
        field: "; ".join(
            dict.fromkeys(curve.origin[field] for curve in curves if field in curve.origin)
        )
        for field in FIELDS
    }


def _scale(values, unit):
    """Factor and unit with prefix in which the largest of the values [unit] has one to three
    digits."""
    exponent, letter = prefix_for(float(np.max(np.abs(values))) if len(values) else 0.0)
    return 10.0**-exponent, letter.replace("u", "µ") + unit


def draw_curves(axes, curves, over="height over first touch"):
    """Retraction as a line over a broad, pale one for the approach, a dot for each state, jumps
    dotted, the pull-off force with its value. over: what the heights are."""
    ways = [way for curve in curves for way in (curve.approach, curve.retraction) if len(way)]
    heights = np.concatenate([way.heights for way in ways])
    forces = np.concatenate([way.forces for way in ways])
    low, high = _force_limits(forces)
    x_scale, x_unit = _scale(heights, "m")
    y_scale, y_unit = _scale(forces[(forces >= low) & (forces <= high)], "N")
    axes.axhline(0.0, color="#555555", linewidth=0.8, zorder=1)
    several = len(curves) > 1
    for place, curve in enumerate(curves):
        ahead = curve.name + ", " if several else ""
        colour = COLOURS[place % len(COLOURS)]
        broad = {"color": colour if several else "#e07b00", "linewidth": 4.0, "alpha": 0.4}
        _draw_way(axes, curve.approach, x_scale, y_scale, broad, ahead + "approach")
        _draw_way(
            axes,
            curve.retraction,
            x_scale,
            y_scale,
            {"color": colour, "linewidth": 1.5},
            ahead + "retraction",
        )
        peak = curve.pull_off()
        if peak:
            kind = "pull-off" if curve.came_apart() else "broken off; pull-off at least"
            axes.plot(
                peak[0] * x_scale,
                peak[1] * y_scale,
                "v",
                color=colour,
                markersize=9,
                markeredgecolor="white",
                zorder=6,
                label="%s%s %s at %s"
                % (ahead, kind, with_unit(peak[1], "N"), with_unit(peak[0], "m")),
            )
    if any(way.jumps() for way in ways):
        axes.plot([], [], color="#555555", linewidth=1.3, linestyle=":", label="jump")
    if low > forces.min():
        axes.plot([], [], " ", label="pressed further, to %s" % with_unit(float(forces.min()), "N"))
    shown = heights[forces >= low] * x_scale
    room = 0.03 * np.ptp(shown) or 0.03 * abs(shown[0]) or 0.03
    axes.set_xlim(shown.min() - room, shown.max() + room)
    axes.set_ylim((low - 0.05 * (high - low)) * y_scale, (high + 0.08 * (high - low)) * y_scale)
    axes.set_xlabel("%s [%s]; below 0 pressed in" % (over, x_unit))
    axes.set_ylabel("force [%s]; above 0 attraction" % y_unit)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.legend(fontsize=8.5, framealpha=0.85, edgecolor="none", loc="best")


def _force_limits(forces):
    """All forces, but no more repulsion than leaves the attraction to be seen."""
    low, high = float(forces.min()), float(forces.max())
    if high > 0:
        low = max(low, -PRESSED_SHARE * high)
    return (low, high) if high > low else (low - 1e-30, high + 1e-30)


def _draw_way(axes, way, x_scale, y_scale, style, label):
    if not len(way):
        return
    x, y = way.heights * x_scale, way.forces * y_scale
    jumps = way.jumps()
    gaps = [place + 1 for place in jumps]
    axes.plot(
        np.insert(x, gaps, np.nan),
        np.insert(y, gaps, np.nan),
        label=label,
        zorder=3,
        solid_capstyle="butt",
        **style,
    )
    axes.plot(x, y, ".", color=style["color"], markersize=3.2, zorder=4)
    for place in jumps:
        axes.plot(
            x[place : place + 2],
            y[place : place + 2],
            color=style["color"],
            linewidth=1.3,
            linestyle=":",
            zorder=3,
        )
