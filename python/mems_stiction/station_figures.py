"""Pictures of a load sweep and of contact cycles."""

import math

from mems_stiction.plots import plt, widen, with_unit
from mems_stiction.prediction_text import contact_area_of
from mems_stiction.quantities import prefix_for
from mems_stiction.station_text import area_label

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

UP = 0  # SweepPoint.UP
COLOURS = ("#0b4f9e", "#d17a00", "#1b7a3d", "#8a3fa0", "#7a5230", "#5a5f66")


def save_sweep(result, path):
    """Contact and margins against the voltage, up and down, a colour for each mechanical load."""
    figure, axes = plt.subplots(1, 2, figsize=(13, 5.8), dpi=100)
    figure.subplots_adjust(left=0.07, right=0.985, top=0.92, bottom=0.215, wspace=0.2)
    loads = sorted({point.mechanical_load for point in result.points})
    _draw_loops(axes[0], result, loads, contact_area_of, area_label(result.points), "m²")
    axes[0].set_title("Contact: hysteresis between the way up and the way down", fontsize=11)
    keys = [plt.Line2D([], [], color=colour, linewidth=4, label="pressed with %s" % with_unit(load, "N"))
            for load, colour in zip(loads, _colours(loads))]
    keys += [plt.Line2D([], [], color="#333333", marker="^", markersize=5, label="voltage up"),
             plt.Line2D([], [], color="#333333", linestyle="--", marker="v", markersize=5, label="voltage down")]
    if _draw_loops(axes[1], result, loads, lambda point: point.holding_margin, "margin", "-"):
        axes[1].set_title("Margin: the device stays closed below 1", fontsize=11)
        for load, colour in zip(loads, _colours(loads)):
            up = [point for point in result.points if point.mechanical_load == load and point.direction == UP]
            axes[1].plot([point.voltage for point in up], [point.margin for point in up], color=colour, linewidth=1.2,
                         linestyle=":", marker="x", markersize=5)
        axes[1].axhline(1.0, color="#b3201d", linewidth=1.2, linestyle="--")
        _scale_ratio(axes[1], [value for point in result.points for value in (point.margin, point.holding_margin)])
        keys.append(plt.Line2D([], [], color="#333333", linestyle=":", marker="x", markersize=5, label="margin once the load is gone"))
        if math.isfinite(result.pull_in_voltage):
            keys.append(plt.Line2D([], [], color="#666666", linestyle="-.", label="pull-in, %s" % with_unit(result.pull_in_voltage, "V")))
            if result.pull_in_voltage <= 1.2 * max(point.voltage for point in result.points):
                for each in axes:
                    each.axvline(result.pull_in_voltage, color="#666666", linewidth=1, linestyle="-.")
    figure.legend(handles=keys, loc="lower center", ncol=5, fontsize=9.5, frameon=False)
    figure.savefig(str(path))
    plt.close(figure)


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


def _draw_loops(axes, result, loads, value_of, label, unit):
    """False if there is nothing to draw."""
    values = [value_of(point) for point in result.points]
    finite = [abs(value) for value in values if math.isfinite(value)]
    if not finite:
        axes.set_axis_off()
        axes.text(0.5, 0.5, "no device is stated", ha="center", va="center", transform=axes.transAxes, color="#555555")
        return False
    factor, shown_unit = _area_unit(max(finite)) if unit == "m²" else (1.0, unit)
    for load, colour in zip(loads, _colours(loads)):
        ways = [[point for point in result.points if point.mechanical_load == load and (point.direction == UP) == is_up]
                for is_up in (True, False)]
        ways[1] = ways[0][-1:] + ways[1]  # the way down starts where the way up has ended
        for points, style, marker in zip(ways, ("-", "--"), ("^", "v")):
            axes.plot([point.voltage for point in points], [value_of(point) * factor for point in points], color=colour,
                      linestyle=style, marker=marker, markersize=5, linewidth=1.6)
    widen(axes, [value * factor for value in values])
    axes.set_xlabel("voltage [V]")
    axes.set_ylabel("%s [%s]" % (label, shown_unit))
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    return True


def _area_unit(largest):
    return (1e18, "nm²") if largest < 1e-14 else (1e12, "µm²")


def save_cycles(result, path):
    """Pull-off force, contact fraction, rms height and margin against the cycle."""
    panels = [("pull_off_force", "pull-off force", "N"), ("contact_fraction", "contact fraction", "%"),
              ("rms_height", "rms height of the scan", "m"), ("margin", "margin", "-")]
    cycles = result.cycles
    if all(math.isnan(cycle.margin) for cycle in cycles):
        panels = panels[:3]
    figure, all_axes = plt.subplots(1, len(panels), figsize=(4.2 * len(panels), 4.2), dpi=100)
    figure.subplots_adjust(left=0.24 / len(panels), right=0.985, top=0.9, bottom=0.14, wspace=0.36)
    for axes, (name, label, unit) in zip(all_axes, panels):
        values = np.array([getattr(cycle, name) for cycle in cycles])
        if unit == "%":
            values = 100 * values
        elif unit != "-":
            exponent, letter = prefix_for(float(np.nanmax(np.abs(values))))
            values, unit = values / 10.0**exponent, letter.replace("u", "µ") + unit
        axes.plot([cycle.cycle for cycle in cycles], values, color=COLOURS[0], marker="o", markersize=4, linewidth=1.3)
        if name == "margin":
            axes.plot([cycle.cycle for cycle in cycles], [cycle.margin_lower for cycle in cycles], color=COLOURS[0], linewidth=1,
                      linestyle=":", label="lower end of the 95 % interval")
            axes.axhline(1.0, color="#b3201d", linewidth=1.2, linestyle="--", label="1: sticks below")
            _scale_ratio(axes, [cycle.margin_lower for cycle in cycles] + list(values))
            low, high = axes.get_ylim()  # room for the legend above all lines
            axes.set_ylim(low, high * (high / low)**0.25 if axes.get_yscale() == "log" else low + 1.3 * (high - low))
            axes.legend(fontsize=9, framealpha=0.85, edgecolor="none", loc="upper left")
        axes.set_title(label[0].upper() + label[1:], fontsize=11)
        axes.set_ylabel("%s [%s]" % (label, unit))
        axes.set_xlabel("number of the contact")
        if axes.get_yscale() == "linear":
            widen(axes, values)
            axes.ticklabel_format(axis="y", useOffset=False)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.set_axisbelow(True)
    figure.savefig(str(path))
    plt.close(figure)
