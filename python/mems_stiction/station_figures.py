"""Pictures of a load sweep and of contact cycles."""

import math
import textwrap

from mems_stiction.plots import plt, save, widen, with_unit
from mems_stiction.prediction_text import contact_area_of, ratio_name, ratio_value
from mems_stiction.provenance import sign
from mems_stiction.quantities import literal, prefix_for, typeset
from mems_stiction.station_text import area_label, safe_voltage_words
from mems_stiction.sweep_jumps import UP, jumps_of, ways_of

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

COLOURS = ("#0b4f9e", "#d17a00", "#1b7a3d", "#8a3fa0", "#7a5230", "#5a5f66")
MOST_JUMPS = 8  # that are numbered in a picture, the largest
LINE = 0.2  # height of a line of text below the panels [inches]


def save_sweep(result, path):
    """Contact, pull-off force and margins against the voltage, up and down, a colour for each
    mechanical load; what is known of force and margin as bands, the safe voltage, and the jumps
    with their causes."""
    loads = sorted({point.mechanical_load for point in result.points})
    has_margin = any(math.isfinite(ratio_value(point)) for point in result.points)
    jumps = _largest(
        jump for load in loads for jump in jumps_of(result.points, load, result.pull_in_voltage)
    )
    texts = [
        line
        for number, jump in enumerate(jumps, 1)
        for line in _numbered(number, typeset(jump.words()), 190 if has_margin else 125)
    ]
    keys = _sweep_keys(result, loads, has_margin)
    columns = 4 if has_margin else 3
    below = (
        0.95 + 0.22 * math.ceil(len(keys) / columns) + LINE * (len(texts) + (1 if texts else 0))
    )  # inches
    width, height = (17.0 if has_margin else 11.8), 4.6 + below
    figure, axes = plt.subplots(1, 3 if has_margin else 2, figsize=(width, height), dpi=100)
    figure.subplots_adjust(
        left=0.9 / width,
        right=1 - 0.2 / width,
        top=1 - 0.4 / height,
        bottom=below / height,
        wspace=0.22,
    )
    _draw_loops(axes[0], result, loads, contact_area_of, area_label(result.points), "m²")
    axes[0].set_title("Contact: hysteresis between up and down", fontsize=11)
    _draw_loops(
        axes[1],
        result,
        loads,
        lambda point: point.pull_off_force,
        "pull-off force",
        "N",
        ("pull_off_force_lower", "pull_off_force_upper"),
    )
    axes[1].set_title("Pull-off force once the load is gone", fontsize=11)
    if has_margin:
        _draw_margins(axes[2], result, loads)
    if math.isfinite(result.pull_in_voltage) and result.pull_in_voltage <= 1.2 * max(
        point.voltage for point in result.points
    ):
        for each in axes:
            each.axvline(result.pull_in_voltage, color="#666666", linewidth=1, linestyle="-.")
    _number_jumps(axes[0], result, jumps)
    lines = "Jumps:\n" + "\n".join(texts) if texts else ""
    figure.text(
        0.3 / width,
        0.25 / height,
        literal(lines),
        fontsize=9,
        va="bottom",
        ha="left",
        color="#333333",
        linespacing=1.25,
    )
    figure.legend(
        handles=keys,
        loc="lower center",
        ncol=columns,
        fontsize=9.5,
        frameon=False,
        bbox_to_anchor=(0.5, (0.27 + LINE * (len(texts) + (1 if texts else 0))) / height),
    )
    sign(figure, result)
    save(figure, path)


def _largest(jumps):
    """At most so many, in the order in which they came."""
    jumps = list(jumps)
    most = sorted(jumps, key=lambda jump: -jump.share)[:MOST_JUMPS]
    return [jump for jump in jumps if jump in most]


def _numbered(number, words, width):
    return textwrap.wrap("%d  %s" % (number, words), width, subsequent_indent="    ")


def _sweep_keys(result, loads, has_margin):
    def line(label, **style):
        return plt.Line2D([], [], label=label, **dict({"color": "#333333"}, **style))

    keys = [
        line("pressed with %s" % with_unit(load, "N"), color=colour, linewidth=4)
        for load, colour in zip(loads, _colours(loads))
    ]
    keys += [
        line("voltage up", marker="^", markersize=5),
        line("voltage down", linestyle="--", marker="v", markersize=5),
        plt.Rectangle(
            (0, 0), 1, 1, color="#333333", alpha=0.2, linewidth=0, label="95 % lie within"
        ),
    ]
    if has_margin:
        keys += [
            line("margin once the load is gone", linestyle=":", marker="x", markersize=5),
            line("margin while the load holds", marker="^", markersize=5),
            line("1: the device stays closed below", color="#b3201d", linestyle="--"),
        ]
        for summary, colour in zip(result.summaries, _colours(result.summaries)):
            load = (
                "pressed with %s: " % with_unit(summary.mechanical_load, "N")
                if len(result.summaries) > 1
                else ""
            )
            keys.append(
                line(
                    load + safe_voltage_words(summary, result.points),
                    color=colour,
                    linewidth=2.2,
                    linestyle="" if math.isnan(summary.highest_safe_voltage) else (0, (1, 1)),
                )
            )
    if math.isfinite(result.pull_in_voltage):
        keys.append(
            line(
                "pull-in, %s" % with_unit(result.pull_in_voltage, "V"),
                color="#666666",
                linestyle="-.",
            )
        )
    return keys


def _draw_margins(axes, result, loads):
    _draw_loops(axes, result, loads, lambda point: point.holding_margin, "margin", "-")
    axes.set_title("Margin: the device stays closed below 1", fontsize=11)
    shown = [1.0]
    for load, colour in zip(loads, _colours(loads)):
        up = ways_of(result.points, load)[0]
        voltages = [point.voltage for point in up]
        axes.plot(
            voltages,
            [ratio_value(point) for point in up],
            color=colour,
            linewidth=1.2,
            linestyle=":",
            marker="x",
            markersize=5,
        )
        _draw_band(axes, up, "_lower", "_upper", 1.0, colour, ratio_value)
    for summary, colour in zip(result.summaries, _colours(result.summaries)):
        if math.isfinite(summary.highest_safe_voltage):
            axes.axvline(
                summary.highest_safe_voltage,
                color=colour,
                linewidth=2.2,
                linestyle=(0, (1, 1)),
                zorder=1,
            )
    axes.axhline(1.0, color="#b3201d", linewidth=1.2, linestyle="--")
    shown += [
        value
        for point in result.points
        if not point.is_open
        for value in [point.holding_margin]
        + [ratio_value(point, end) for end in ("", "_lower", "_upper")]
    ]
    _scale_ratio(axes, shown)


def _draw_band(axes, points, lower, upper, factor, colour, value_of=getattr):
    """Of the way up: the contact of the highest voltage is held on the way down. lower, upper: what
    value_of() is asked for."""
    voltages = np.array([point.voltage for point in points])
    ends = np.array(
        [[value_of(point, name) * factor for name in (lower, upper)] for point in points]
    )
    if len(points) == 1:
        axes.vlines(voltages, ends[:, 0], ends[:, 1], color=colour, alpha=0.3, linewidth=6)
    axes.fill_between(
        voltages, ends[:, 0], ends[:, 1], color=colour, alpha=0.17, linewidth=0, zorder=1
    )


def _number_jumps(axes, result, jumps):
    """A number beside the middle of each jump, those of one voltage above each other."""
    factor = _factor_and_unit([contact_area_of(point) for point in result.points], "m²")[0]
    used = []
    for number, jump in enumerate(jumps, 1):
        voltage = 0.5 * (jump.before.voltage + jump.after.voltage)
        place = voltage, 0.5 * factor * (contact_area_of(jump.before) + contact_area_of(jump.after))
        direction = 1 if jump.after.direction == UP else -1
        offset = direction * (13 + 19 * used.count((voltage, direction)))
        used.append((voltage, direction))
        axes.annotate(
            str(number),
            place,
            xytext=(0, offset),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=8.5,
            bbox={
                "boxstyle": "circle,pad=0.2",
                "facecolor": "white",
                "edgecolor": "#333333",
                "linewidth": 0.8,
            },
            zorder=6,
        )


def _scale_ratio(axes, values):
    """Logarithmic where 1 would else be lost at the bottom."""
    positive = [value for value in values if math.isfinite(value) and value > 0] + [1.0]
    if max(positive) > 30 * min(positive):
        axes.set_yscale("log")
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: "%g" % value))
    else:
        axes.set_ylim(bottom=0)


def _colours(loads):
    return [COLOURS[place % len(COLOURS)] for place in range(len(loads))]


def _draw_loops(axes, result, loads, value_of, label, unit, band=()):
    """Both ways of each load. band: the fields of the ends of what 95 % lie within."""
    values = [value_of(point) for point in result.points if not point.is_open]
    ends = [getattr(point, name) for point in result.points for name in band if not point.is_open]
    factor, shown_unit = _factor_and_unit(values + ends, unit)
    for load, colour in zip(loads, _colours(loads)):
        ways = ways_of(result.points, load)
        for points, style, marker in zip(ways, ("-", "--"), ("^", "v")):
            axes.plot(
                [point.voltage for point in points],
                [value_of(point) * factor for point in points],
                color=colour,
                linestyle=style,
                marker=marker,
                markersize=5,
                linewidth=1.6,
            )
        if band:
            _draw_band(axes, ways[0], *band, factor, colour)
    widen(axes, [value * factor for value in values])
    axes.set_xlabel("voltage [V]")
    axes.set_ylabel("%s [%s]" % (label, shown_unit))
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


def _factor_and_unit(values, unit):
    """For an axis on which the values [unit] are read."""
    largest = max((abs(value) for value in values if math.isfinite(value)), default=0.0)
    if unit == "m²":
        return (1e18, "nm²") if largest < 1e-14 else (1e12, "µm²")
    if unit == "-":
        return 1.0, unit
    exponent, letter = prefix_for(largest)
    return 10.0**-exponent, letter.replace("u", "µ") + unit


def save_cycles(result, path):
    """Pull-off force, contact fraction, rms height and margin, or what decides in its place,
    against the cycle."""
    cycles = result.cycles
    judged = ratio_name(cycles[0])
    panels = [
        ("pull_off_force", "pull-off force", "N"),
        ("contact_fraction", "contact fraction", "%"),
        ("rms_height", "rms height of the scan", "m"),
        (judged, judged.replace("_", " "), "-"),
    ]
    if all(math.isnan(getattr(cycle, judged)) for cycle in cycles):
        panels = panels[:3]
    figure, all_axes = plt.subplots(1, len(panels), figsize=(4.2 * len(panels), 4.4), dpi=100)
    figure.subplots_adjust(
        left=0.24 / len(panels), right=0.985, top=0.91, bottom=0.175, wspace=0.36
    )
    for axes, (name, label, unit) in zip(all_axes, panels):
        band = [name + end for end in ("_lower", "_upper") if hasattr(cycles[0], name + end)]
        columns = np.array(
            [[getattr(cycle, column) for column in [name] + band] for cycle in cycles], dtype=float
        ).T
        if unit == "%":
            columns = 100 * columns
        else:
            factor, unit = _factor_and_unit(columns.flat, unit)
            columns = columns * factor
        values = columns[0]
        if band:
            axes.fill_between(
                [cycle.cycle for cycle in cycles],
                columns[1],
                columns[2],
                color=COLOURS[0],
                alpha=0.17,
                linewidth=0,
                label="95 % lie within",
            )
        axes.plot(
            [cycle.cycle for cycle in cycles],
            values,
            color=COLOURS[0],
            marker="o",
            markersize=4,
            linewidth=1.3,
        )
        if name == judged:
            axes.axhline(
                1.0, color="#b3201d", linewidth=1.2, linestyle="--", label="1: sticks below"
            )
            _scale_ratio(axes, list(columns.flat))
            low, high = axes.get_ylim()  # room for the legend above all lines
            axes.set_ylim(
                low,
                high * (high / low) ** 0.25
                if axes.get_yscale() == "log"
                else low + 1.3 * (high - low),
            )
            axes.legend(fontsize=9, framealpha=0.85, edgecolor="none", loc="upper left")
        axes.set_title(label[0].upper() + label[1:], fontsize=11)
        axes.set_ylabel("%s [%s]" % (label, unit))
        axes.set_xlabel("number of the contact")
        if axes.get_yscale() == "linear":
            widen(axes, values)
            axes.ticklabel_format(axis="y", useOffset=False)
            if band and np.isfinite(columns[1:]).any() and name != judged:
                axes.legend(fontsize=9, framealpha=0.85, edgecolor="none", loc="best")
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
    sign(figure, result)
    save(figure, path)
