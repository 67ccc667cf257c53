"""The report's figures beside plots.py: energy, forces, distributions and trends. Each function
returns a PNG as bytes.

`result` is the dictionary of a result.json that stiction_batch --dump writes; SI units.
"""

import io
import math

from mems_stiction.control_chart import control_limits
from mems_stiction.curve import Curve
from mems_stiction.curve_figure import draw_curves
from mems_stiction.plots import REGIMES, plt, widen, with_unit
from mems_stiction.quantities import prefix_for

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

ELASTIC_LIMIT, PLASTIC_LIMIT = 0.6, 1.1  # of the plasticity index
FEWEST = 5  # contacts of which a distribution is drawn
GREY = "#555555"
LAST_STEPS = 30  # of the approach, around the equilibrium
STEEP_SHARE = 0.15  # of the approach: may leave the picture of the energies
SUM = "#5b6675"  # of bars that are sums: a black one outshouts what it is made of
PRESSING = (
    ("van der Waals", "van_der_waals_force", "#4c78a8"),
    ("electrostatic", "electrostatic_force", "#f2a33c"),
    ("mechanical", "mechanical_load", "#7f7f7f"),
    ("capillary", "capillary_force", "#54a89e"),
)
HOLDING = (
    ("contacts (JKR)", "pull_off_force_jkr", "#b0413e"),
    ("van der Waals", "van_der_waals_force", "#4c78a8"),
    ("capillary", "capillary_force", "#54a89e"),
)
TRENDS = (
    ("pull_off_force", "pull-off force", "N"),
    ("contact_fraction", "contact fraction", "%"),
    ("rms_height", "rms height", "m"),
    ("margin", "margin: restoring / pull-off force", ""),
    ("peel_number", "peel number: the beam's own work / adhesion", ""),
)
RATIOS = ("margin", "peel_number")  # the verdict rests on
CONTROLLED = ("pull_off_force",)  # have control limits


def png_of(figure):
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    plt.close(figure)
    return stream.getvalue()


def number(value):
    """JSON's null stands for what is not finite."""
    return math.nan if value is None else float(value)


def curves_of(result):
    """The curves that a result has: that of its formulation, and that of the half-space."""
    named = (
        (result["formulation"], result["force_curve"], result["pull_off_force"]),
        ("half-space", result.get("half_space_curve"), result.get("half_space_pull_off_force")),
    )
    return [
        Curve(name, list(zip(columns["height"], columns["force"], columns["direction"])), force)
        for name, columns, force in named
        if columns
    ]


def scaled(values, unit):
    """The values in a unit with prefix in which the largest has one to three digits, and that
    unit."""
    array = np.array([number(value) for value in values])
    finite = np.abs(array[np.isfinite(array)])
    if not unit:
        return array, ""
    if unit == "%":
        return 100 * array, unit
    exponent, letter = prefix_for(float(finite.max()) if finite.size else 0.0)
    return array / 10.0**exponent, letter.replace("u", "µ") + unit


def scan_figure(result):
    """Force over height, or energy over approach where the formulation has that, with what is
    around its equilibrium; force budget, distributions of loads and of plasticity indices where
    there are a handful of contacts."""
    # The forces stand in the right column, where there is room for their long names.
    if result["force_curve"]:
        panels = (_draw_curve, _draw_forces, _draw_loads, _draw_plasticity)
    else:
        panels = (_draw_energy, draw_energy_at_rest, _draw_loads, _draw_forces, _draw_plasticity)
    if len(result["asperities"]["load"]) < FEWEST:
        panels = tuple(draw for draw in panels if draw not in (_draw_loads, _draw_plasticity))
    rows = (len(panels) + 1) // 2
    figure, all_axes = plt.subplots(rows, 2, figsize=(13, 4.2 * rows), dpi=100, squeeze=False)
    figure.subplots_adjust(
        left=0.065, right=0.985, top=1 - 0.1 / rows, bottom=0.15 / rows, hspace=0.34, wspace=0.38
    )
    for draw, axes in zip(panels, all_axes.flat):
        draw(axes, result)
    for axes in list(all_axes.flat)[len(panels) :]:
        axes.set_axis_off()
    return png_of(figure)


def _draw_curve(axes, result):
    axes.set_title("Force over height", fontsize=11)
    draw_curves(axes, curves_of(result)[:1])  # the half-space has a picture of its own


def _draw_energy(axes, result):
    curve = result["energy_curve"]
    axes.set_title("Energy on the approach", fontsize=11)
    if not curve:
        return _say(axes, "no step was taken")
    approach = curve["approach"] + [result["approach"]]
    if not any(
        number(value) > 0 for value in approach
    ):  # the first cells that touch carry the load
        return _say(
            axes,
            "The equilibrium is at first touch, D = 0 m,\nso that there is no approach to draw: "
            "$E_t$ = %s" % with_unit(number(result["total_energy"]), "J"),
        )
    order = np.argsort([number(value) for value in approach], kind="stable")
    names = ("total_energy", "mechanical_energy", "surface_energy", "elastic_energy")
    everything = [value for name in names for value in curve[name] + [result[name]]]
    _, energy_unit = scaled(everything, "J")
    factor = _factor(everything)
    x, length_unit = scaled(approach, "m")
    for name, label, style in zip(
        names,
        ("total $E_t = E_m + E_s - E_e$", "mechanical $E_m$", "surface $E_s$", "elastic $E_e$"),
        (
            dict(color="black", linewidth=2.2),
            dict(color="#7f7f7f"),
            dict(color="#4c78a8"),
            dict(color="#b0413e"),
        ),
    ):
        y = np.array([number(value) for value in curve[name] + [result[name]]]) * factor
        axes.plot(x[order], y[order], label=label, **style)
    ends = {"EQUILIBRIUM": "equilibrium", "BONDED": "bonded: contact fraction limit reached"}
    axes.plot(
        x[-1],
        number(result["total_energy"]) * factor,
        "o",
        color="#d1322f",
        markersize=9,
        zorder=5,
        markeredgecolor="white",
        label="%s, D = %s"
        % (
            ends.get(result["status"], "end of the search"),
            with_unit(number(result["approach"]), "m"),
        ),
    )
    axes.axvline(x[-1], color="#d1322f", linewidth=0.8, linestyle=":")
    axes.margins(x=0.04)
    _leave_out_steep_beginning(
        axes,
        x,
        factor
        * np.array([[number(value) for value in curve[name] + [result[name]]] for name in names]),
    )
    axes.set_xlabel("approach D from first touch [%s]" % length_unit)
    axes.set_ylabel("energy [%s]" % energy_unit)
    axes.grid(color="#dddddd", linewidth=0.6)
    clipped = axes.get_ylim()[1] < axes.dataLim.y1
    axes.legend(
        fontsize=8.5, framealpha=0.8, edgecolor="none", loc="upper right" if clipped else "best"
    )


def draw_energy_at_rest(axes, result):
    """The total energy alone, over the last steps before the equilibrium: there its extremum is
    seen, which the whole approach dwarfs."""
    axes.set_title("Total energy around the equilibrium", fontsize=11)
    curve = result["energy_curve"]
    approach, energy = (
        np.array([number(value) for value in curve.get(name, []) + [result[end]]])
        for name, end in (("approach", "approach"), ("total_energy", "total_energy"))
    )
    order = np.argsort(approach, kind="stable")[-LAST_STEPS:]
    if len(order) < 4:
        return _say(axes, "the search took too few steps")
    x, x_unit = scaled(approach, "m")
    y, y_unit = scaled(energy, "J")
    axes.plot(
        x[order],
        y[order],
        ".-",
        color="black",
        linewidth=1.5,
        markersize=7,
        label="total $E_t$, step by step",
    )
    inside = order[1:-1]
    extrema = [
        place
        for before, place, after in zip(order, inside, order[2:])
        if (y[place] - y[before]) * (y[after] - y[place]) < 0
    ]
    if extrema:
        last = extrema[-1]
        axes.plot(
            x[last],
            y[last],
            "D",
            color="#f2b705",
            markersize=9,
            markeredgecolor="black",
            zorder=4,
            label="extremum, D = %s" % with_unit(float(approach[last]), "m"),
        )
    axes.plot(
        x[-1],
        y[-1],
        "o",
        color="#d1322f",
        markersize=9,
        zorder=5,
        markeredgecolor="white",
        label="where the search ended, D = %s" % with_unit(float(approach[-1]), "m"),
    )
    widen(axes, y[order])
    axes.margins(x=0.06)
    axes.set_xlabel("approach D from first touch [%s]" % x_unit)
    axes.set_ylabel("total energy [%s]" % y_unit)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.legend(fontsize=8.5, framealpha=0.8, edgecolor="none", loc="best")


def _leave_out_steep_beginning(axes, x, energies):
    """While nothing touches, moving together sets energy free that dwarfs what happens around the
    equilibrium."""
    later = energies[:, x >= STEEP_SHARE * x[-1]]
    low, high = np.nanmin(later), np.nanmax(later)
    if np.nanmax(energies) > 3 * max(high, 0.0) and high > low:
        axes.set_ylim(min(low, 0.0) - 0.06 * (high - low), high + 0.75 * (high - low))
        axes.set_title("Energy on the approach (its beginning leaves the picture)", fontsize=11)


def _factor(values):
    finite = [abs(number(value)) for value in values if math.isfinite(number(value))]
    return 10.0 ** -prefix_for(max(finite, default=0.0))[0]


def _draw_forces(axes, result):
    axes.set_title("Forces on the scanned area", fontsize=11)
    bound = "at least " if result["is_lower_bound"] else ""
    rows = [(label, number(result[name]), colour) for label, name, colour in PRESSING]
    if result["force_curve"]:
        rows[0] = ("adhesion at rest",) + rows[0][1:]
    rows.append(("normal load, their sum", number(result["normal_load"]), SUM))
    if result["force_curve"]:  # adhesion is followed as a whole
        rows.append(("pull-off force, the largest", number(result["pull_off_force"]), SUM))
    else:
        rows += [(label, number(result.get(name)), colour) for label, name, colour in HOLDING]
        rows.append(("pull-off force, their sum", number(result["pull_off_force"]), SUM))
    places = [place + (place > len(PRESSING)) for place in range(len(rows))]
    widths, unit = scaled([value for _, value, _ in rows], "N")
    axes.barh(places, widths, color=[colour for _, _, colour in rows], height=0.72)
    longest = max(float(np.nanmax(widths)), 1e-300)
    for place, width, (label, value, _) in zip(places, widths, rows):
        axes.text(
            width + 0.012 * longest,
            place,
            (bound if "pull-off" in label else "") + with_unit(value, "N"),
            va="center",
            fontsize=9,
        )
    axes.set_yticks(places)
    axes.set_yticklabels([label for label, _, _ in rows], fontsize=9)
    axes.set_ylim(places[-1] + 0.6, -1.3)
    for place, text in (
        (-0.85, "press the surfaces together"),
        (5.15, "hold them together when the load is gone"),
    ):
        axes.text(0.004 * longest, place, text, va="center", fontsize=9, style="italic", color=GREY)
    axes.set_xlim(0, 1.3 * longest)
    axes.set_xlabel("force [%s]" % unit)
    axes.grid(axis="x", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


def _by_regime(result, name):
    values = np.array([number(value) for value in result["asperities"][name]])
    regimes = np.array(result["asperities"]["regime"])
    return [values[regimes == value] for value, _, _ in REGIMES]


def _histogram(axes, groups, bins):
    labels = ["%s (%d)" % (label, len(group)) for (_, label, _), group in zip(REGIMES, groups)]
    axes.hist(
        groups,
        bins=bins,
        stacked=True,
        color=[colour for _, _, colour in REGIMES],
        label=labels,
        edgecolor="white",
        linewidth=0.4,
    )
    axes.set_ylabel("number of contacts")
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    low, high = axes.get_ylim()
    axes.set_ylim(low, 1.25 * high)
    axes.legend(fontsize=8.5, frameon=False, loc="upper left", ncol=3)
    axes.grid(axis="y", color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_loads(axes, result):
    axes.set_title("Load of each contact", fontsize=11)
    groups = [group[np.isfinite(group) & (group > 0)] for group in _by_regime(result, "load")]
    loads = np.concatenate(groups)
    if not loads.size:
        return _say(axes, "no contact carries load")
    low, high = np.log10(loads.min()), np.log10(loads.max())
    low, high = (low - 0.3, high + 0.3) if high - low < 0.2 else (low, high)
    axes.set_xscale("log")
    _histogram(axes, groups, np.logspace(low, high * (1 + 1e-12) + 1e-9, 25))
    # Few decades have few labels: then the steps between have them too.
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: with_unit(value, "N", 1)))
    if high - low < 1.5:
        axes.xaxis.set_minor_formatter(
            FuncFormatter(
                lambda value, _: (
                    with_unit(value, "N", 1)
                    if "%.0e" % value in _steps(value, high - low < 0.8)
                    else ""
                )
            )
        )
        axes.tick_params(
            axis="x",
            which="minor",
            labelsize=plt.rcParams["xtick.labelsize"],
            length=plt.rcParams["xtick.major.size"],
            pad=plt.rcParams["xtick.major.pad"],
        )
    axes.set_xlabel("load of the contact [N], logarithmic")


def _steps(value, has_room):
    """Which steps between two decades are labelled."""
    exponent = math.floor(math.log10(value) + 1e-9)
    return [
        "%.0e" % (digit * 10.0**exponent) for digit in ((2, 3, 4, 5, 7) if has_room else (2, 5))
    ]


def _draw_plasticity(axes, result):
    axes.set_title("Plasticity index of each contact", fontsize=11)
    groups = [group[np.isfinite(group)] for group in _by_regime(result, "plasticity_index")]
    indices = np.concatenate(groups)
    if not indices.size:
        return _say(axes, "no contact")
    _histogram(axes, groups, np.linspace(0, max(1.3, float(indices.max())) * 1.02, 31))
    top = axes.get_ylim()[1]
    wide = indices.max() > 10  # no room for two numbers
    for limit, text in (
        (ELASTIC_LIMIT, "" if wide else "0.6"),
        (PLASTIC_LIMIT, "" if wide else "1.1"),
    ):
        axes.plot([limit, limit], [0, 0.82 * top], color=GREY, linestyle="--", linewidth=1)
        axes.text(limit, 0.83 * top, text, fontsize=8.5, color=GREY, ha="center")
    axes.set_xlim(left=0)
    # the paper's formulations tell regimes by the index, the others by the pressure that a contact
    # comes to carry
    axes.set_xlabel(
        "plasticity index [-]; "
        + (
            "colours: by the pressure that is carried"
            if result["force_curve"]
            else "elastic below 0.6, plastic above 1.1"
        )
    )


def _say(axes, text):
    axes.set_axis_off()
    axes.text(0.5, 0.5, text, ha="center", va="center", transform=axes.transAxes, color=GREY)


def trend_figure(rows):
    """Figures over the number of the scan. `rows` are those of predicted scans; the margin has a
    panel where some device is stated."""
    trends = [
        trend for trend in TRENDS if any(math.isfinite(number(row.get(trend[0]))) for row in rows)
    ]
    figure, all_axes = plt.subplots(
        (len(trends) + 1) // 2,
        2,
        figsize=(13, 3.6 * ((len(trends) + 1) // 2)),
        dpi=100,
        squeeze=False,
    )
    figure.subplots_adjust(
        left=0.075,
        right=0.985,
        top=0.94,
        bottom=0.19 / ((len(trends) + 1) // 2) + 0.01,
        hspace=0.42,
        wspace=0.2,
    )
    bonded_text = "bonded" + (
        ": a lower bound" if any(row["is_lower_bound"] for row in rows) else ""
    )
    for axes, (name, label, unit) in zip(all_axes.flat, trends):
        numbers = np.array([row["number"] for row in rows])
        values, shown_unit = scaled([row.get(name) for row in rows], unit)
        bonded = np.array([row["status"] == "BONDED" for row in rows])
        lost = np.array([row["status"] == "NO_EQUILIBRIUM" for row in rows])
        axes.plot(numbers, values, color="#9db7d5", linewidth=1.2, zorder=1)
        for use, marker, colour, text in (
            (~bonded & ~lost, "o", "#0b4f9e", "equilibrium"),
            (bonded, "^", "#d1322f", bonded_text),
            (lost, "x", "#7f7f7f", "no equilibrium: not to be used"),
        ):
            if use.any():
                axes.scatter(
                    numbers[use],
                    values[use],
                    marker=marker,
                    color=colour,
                    s=26,
                    zorder=2,
                    label=text,
                )
        if name in RATIOS:
            low, high = (
                np.array([number(row.get("%s_%s" % (name, end))) for row in rows])
                for end in ("lower", "upper")
            )
            axes.fill_between(
                numbers, low, high, color="#0b4f9e", alpha=0.14, label="95 % interval"
            )
            axes.axhline(1.0, color="#d1322f", linewidth=1, linestyle="--", label="1: sticks below")
        drawn = np.concatenate([values, low, high]) if name in RATIOS else values
        if name in CONTROLLED:
            drawn = np.concatenate([drawn, _draw_control(axes, numbers, values, ~lost)])
        if name in RATIOS:  # the line that they are judged by is seen too
            drawn = np.append(drawn, 1.0)
        is_logarithmic = _scale_trend(
            axes, np.append(values, 1.0) if name in RATIOS else values, drawn[np.isfinite(drawn)]
        )
        axes.set_title(label[0].upper() + label[1:], fontsize=11)
        if is_logarithmic and unit not in ("", "%"):  # over many decades one prefix does not do
            step = max(
                number(row.get(name)) for row in rows if number(row.get(name)) > 0
            ) / np.nanmax(values)
            axes.yaxis.set_major_formatter(
                FuncFormatter(
                    lambda value, _, step=step, unit=unit: with_unit(value * step, unit, 1)
                )
            )
            shown_unit = unit
        axes.set_ylabel("%s [%s]" % (label.split(":")[0], shown_unit or "-"))
        axes.set_xlabel("number of the scan")
        axes.set_xlim(
            numbers[0] - 0.5, numbers[-1] + 0.5
        )  # of all panels, however few scans a figure is known of
        axes.xaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(color="#dddddd", linewidth=0.6)
        axes.legend(fontsize=8.5, framealpha=0.8, edgecolor="none", loc="upper left", ncol=3)
    for axes in list(all_axes.flat)[len(trends) :]:
        axes.set_axis_off()
    return png_of(figure)


def _draw_control(axes, numbers, values, use):
    """Control limits of those of the values that are to be used, and a ring around each that is
    outside; the limits' values, if there are any."""
    limits = control_limits(list(values[use]))
    if limits is None:
        return np.array([])
    for place, value in enumerate((limits.lower, limits.upper)):
        axes.axhline(
            value,
            color="#7a3db8",
            linewidth=1.2,
            linestyle=":",
            label=None if place else "control limits",
        )
    axes.axhline(limits.centre, color="#7a3db8", linewidth=0.8, alpha=0.6)
    outside = [
        (place, value)
        for place, value in zip(numbers[use], values[use])
        if limits.is_outside(value)
    ]
    if outside:
        axes.scatter(
            *zip(*outside),
            facecolors="none",
            edgecolors="#7a3db8",
            linewidths=1.6,
            s=95,
            zorder=3,
            label="outside (%d)" % len(outside),
        )
    return np.array([limits.lower, limits.upper])


def _scale_trend(axes, values, drawn):
    """Logarithmic where the values span more than a factor of thirty, and whether it is; with room
    for the legend above all that is drawn."""
    finite = values[np.isfinite(values)]
    if not drawn.size:
        return False
    if finite.size and finite.min() > 0 and finite.max() > 30 * finite.min() and drawn.min() > 0:
        axes.set_yscale("log")
        axes.set_ylim(drawn.min() / 1.5, drawn.max() * (drawn.max() / drawn.min()) ** 0.25)
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: "%g" % value))
        return True
    axes.set_ylim(0, 1.3 * drawn.max() if drawn.max() > 0 else 1.0)
    return False
