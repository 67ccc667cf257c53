"""The picture on a station's screen: pull-off force, margin and verdict against the number of the
scan."""

import math

from mems_stiction.control_chart import control_limits, of_newest_settings
from mems_stiction.plots import plt, with_unit
from mems_stiction.prediction_text import (
    bound_of,
    digits_of,
    flag_names,
    has_verdict,
    limits_of,
    ratio_name,
)
from mems_stiction.provenance import sign
from mems_stiction.quantities import counted, literal, prefix_for, shortened

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

BACKGROUND, TEXT, QUIET, LINE = "#16181d", "#f2f2f2", "#a8adb8", "#7fb2ff"
CONTROL = "#c99bff"
NO, MARGINAL, YES, UNKNOWN = range(4)  # StictionPrediction.STICKS_...
BONDED, NO_EQUILIBRIUM = 1, 2  # StictionPrediction.status
VERDICTS = (
    (NO, "releases", "#35c46a", "o"),
    (MARGINAL, "marginal", "#f2b705", "D"),
    (YES, "sticks", "#ff5a4f", "s"),
    (UNKNOWN, "not known", "#a8adb8", "o"),
)
LARGEST = 1e60  # of what is drawn, and one over it the least: axes overflow further out
LONGEST_LIMITS = 130  # letters of the line about flags and warnings
STATES = (
    ((0,), "equilibrium", LINE, "o"),
    ((BONDED,), "bonded", "#ff5a4f", "^"),
    ((NO_EQUILIBRIUM,), "no equilibrium: do not use", "#a8adb8", "x"),
)
SETTINGS = {
    "text.color": TEXT,
    "axes.labelcolor": TEXT,
    "axes.edgecolor": QUIET,
    "xtick.color": TEXT,
    "ytick.color": TEXT,
    "axes.facecolor": BACKGROUND,
    "figure.facecolor": BACKGROUND,
    "savefig.facecolor": BACKGROUND,
    "legend.labelcolor": TEXT,
    "font.size": 13,
}


def trend_picture(trend, width=1280, height=720, last=0):
    """The figure; the caller saves and closes it. `width` and `height` in pixels at 100 dpi; `last`
    scans are shown, 0: all."""
    decided = trend.decided()
    shown = decided[-last:] if last else decided
    predicted = [(number, scan.prediction) for number, scan in shown if scan.prediction is not None]
    ratio = _ratio(predicted)
    with plt.rc_context(SETTINGS):
        figure = plt.figure(figsize=(width / 100.0, height / 100.0), dpi=100)
        grid = figure.add_gridspec(
            2 if ratio else 1,
            1,
            left=0.1,
            right=0.975,
            top=0.815,
            bottom=0.105,
            hspace=0.12,
            height_ratios=(1.15, 1.0) if ratio else (1.0,),
        )
        force_axes = figure.add_subplot(grid[0])
        axes = [force_axes]
        _draw_force(force_axes, shown, predicted)
        _mark_flags(force_axes, predicted)
        if ratio:
            axes.append(figure.add_subplot(grid[1], sharex=force_axes))
            _draw_ratio(axes[1], shown, predicted, ratio)
            force_axes.tick_params(labelbottom=False)
        _finish(axes, shown)
        _say_latest(figure, trend, decided, trend.decided_count() - len(shown))
    return figure


def _drawn(prediction, name):
    """A figure of a prediction, NaN where it is so far out that no axis can hold it."""
    value = getattr(prediction, name)
    return value if value == 0.0 or 1.0 / LARGEST <= abs(value) <= LARGEST else math.nan


def _ratio(predicted):
    """The figure that the newest verdict rests on: margin, peel number, or none."""
    judged = [prediction for _, prediction in predicted if has_verdict(prediction)]
    name = ratio_name(judged[-1]) if judged else ""
    return (name, name.replace("_", " ")) if judged else None


def _is_device(predicted):
    return any(
        not math.isnan(_drawn(prediction, "device_pull_off_force")) for _, prediction in predicted
    )


def _line(axes, shown, value_of):
    """Through the predicted scans, broken where a scan is lost."""
    values = [
        value_of(scan.prediction) if scan.prediction is not None else math.nan for _, scan in shown
    ]
    axes.plot(
        [number for number, _ in shown], values, color=LINE, linewidth=1.3, alpha=0.65, zorder=2
    )


def _draw_force(axes, shown, predicted):
    if _is_device(predicted):
        name, label = "device_pull_off_force", "pull-off force\nof the device"
        restoring = [_drawn(prediction, "restoring_force") for _, prediction in predicted]
    else:
        name, label, restoring = "pull_off_force", "pull-off force\nof the scan", []
    forces = [_drawn(prediction, name) for _, prediction in predicted]
    finite = [force for force in forces + restoring if math.isfinite(force)]
    exponent, letter = prefix_for(max(finite, default=0.0))
    factor = 10.0**-exponent
    _line(axes, shown, lambda prediction: _drawn(prediction, name) * factor)
    numbers = np.array([number for number, _ in predicted])
    for states, text, colour, marker in STATES:
        use = np.array([prediction.status in states for _, prediction in predicted], dtype=bool)
        if use.any():
            axes.scatter(
                numbers[use],
                np.array(forces)[use] * factor,
                color=colour,
                marker=marker,
                s=46,
                zorder=3,
                label=text,
            )
    limits = _draw_control(axes, shown, name, factor)
    if restoring:
        axes.plot(
            numbers,
            np.array(restoring) * factor,
            color="#35c46a",
            linewidth=2.2,
            linestyle="--",
            label="restoring force of its spring",
        )
    if limits is not None:
        finite += [limits.lower, limits.upper]
    is_logarithmic = _scale(axes, [force * factor for force in finite])
    if is_logarithmic:  # over many decades one prefix does not do
        axes.yaxis.set_major_formatter(
            FuncFormatter(lambda value, _: with_unit(value / factor, "N", 1))
        )
    axes.set_ylabel("%s [%sN]" % (label, "" if is_logarithmic else letter.replace("u", "µ")))


def _draw_control(axes, shown, name, factor):
    """Centre and control limits of the forces that are to be used, as far as their settings are
    those of the newest, and a ring around each that is outside; the limits, or None."""
    usable = [
        (number, scan.prediction)
        for number, scan in shown
        if scan.prediction is not None and scan.prediction.status != NO_EQUILIBRIUM
    ]
    series = of_newest_settings(
        [
            (number, _drawn(prediction, name), prediction.settings_hash)
            for number, prediction in usable
        ]
    )
    limits = control_limits([force for _, force in series])
    if limits is None:
        return None
    ends = series[0][0] - 0.5, series[-1][0] + 0.5
    axes.hlines(
        [limits.lower * factor, limits.upper * factor],
        *ends,
        color=CONTROL,
        linewidth=1.6,
        linestyle=":",
        zorder=1,
        label="control limits",
    )
    axes.hlines(limits.centre * factor, *ends, color=CONTROL, linewidth=1.0, alpha=0.5, zorder=1)
    outside = [(number, force * factor) for number, force in series if limits.is_outside(force)]
    if outside:
        axes.scatter(
            *zip(*outside),
            facecolors="none",
            edgecolors=CONTROL,
            linewidths=2.2,
            s=190,
            zorder=4,
            label="outside (%d)" % len(outside),
        )
    return limits


def _mark_flags(axes, predicted):
    """A small triangle at the lower edge under each scan with flags or warnings: its figures leave
    the model's range."""
    flagged = [
        number for number, prediction in predicted if prediction.regime_flags or prediction.warnings
    ]
    if flagged:
        axes.scatter(
            flagged,
            [0.03] * len(flagged),
            transform=axes.get_xaxis_transform(),
            color="#f2b705",
            marker="^",
            s=30,
            zorder=5,
            clip_on=False,
            label="flags or warnings (%d)" % len(flagged),
        )


def _draw_ratio(axes, shown, predicted, ratio):
    name, label = ratio

    def value_of(prediction):
        return _drawn(prediction, name)

    _line(axes, shown, value_of)
    limits = [
        [
            _drawn(scan.prediction, name + end) if scan.prediction is not None else math.nan
            for _, scan in shown
        ]
        for end in ("_lower", "_upper")
    ]
    axes.vlines(
        [number for number, _ in shown],
        limits[0],
        limits[1],
        color=QUIET,
        linewidth=2.4,
        alpha=0.75,
        zorder=2,
        label="95 % interval",
    )
    for verdict, text, colour, marker in VERDICTS:
        of_verdict = [
            (number, value_of(prediction))
            for number, prediction in predicted
            if prediction.sticks == verdict
        ]
        if of_verdict:
            axes.scatter(*zip(*of_verdict), color=colour, marker=marker, s=46, zorder=3, label=text)
    axes.axhline(
        1.0, color="#ff5a4f", linewidth=1.6, linestyle="--", zorder=1, label="1: sticks below"
    )
    axes.set_ylabel("%s [-]" % label)
    _scale(
        axes, [value_of(prediction) for _, prediction in predicted] + limits[0] + limits[1] + [1.0]
    )


def _scale(axes, values):
    """Logarithmic when the values span more than a factor of thirty; whether it is. Leaves room for
    the legend."""
    finite = [value for value in values if math.isfinite(value)]
    low, high = min(finite, default=0.0), max(finite, default=1.0)
    if low > 0.0 and high > 30.0 * low:
        axes.set_yscale("log")
        axes.set_ylim(low / 1.6, high * (high / low) ** 0.25)
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: "%g" % value))
        return True
    axes.set_ylim(0.0, 1.3 * high if high > 0.0 else 1.0)
    return False


def _finish(axes, shown):
    lost = [number for number, scan in shown if scan.is_lost]
    first, last = (shown[0][0], shown[-1][0]) if shown else (1, 1)
    for each in axes:
        for number in lost:
            each.axvspan(
                number - 0.5,
                number + 0.5,
                color="#ffffff",
                alpha=0.13,
                linewidth=0,
                label="not predicted (%d)" % len(lost)
                if number == lost[0] and each is axes[0]
                else None,
            )
        each.set_xlim(first - 0.7, max(last, first + 9) + 0.7)
        each.xaxis.set_major_locator(MaxNLocator(integer=True))
        each.grid(color="#3a3f4a", linewidth=0.7)
        each.set_axisbelow(True)
        if each.get_legend_handles_labels()[0]:
            each.legend(
                loc="upper left",
                ncol=5,
                fontsize=11.5,
                facecolor=BACKGROUND,
                edgecolor="none",
                framealpha=0.75,
                columnspacing=1.3,
                handletextpad=0.5,
                borderpad=0.2,
            )
    axes[-1].set_xlabel("number of the scan")


def _say_latest(figure, trend, decided, hidden):
    if not decided:
        figure.text(0.5, 0.93, "no scan yet", ha="center", va="center", fontsize=24, color=QUIET)
        return
    number, scan = decided[-1]
    counts = "%s, %d not predicted" % (
        counted(trend.decided_count(), "scan"),
        trend.lost_count(),
    ) + (", %d older not shown" % hidden if hidden else "")
    figure.text(0.975, 0.938, counts, ha="right", va="center", fontsize=13, color=QUIET)
    if scan.is_lost:
        _headline(
            figure,
            number,
            "not predicted",
            UNKNOWN,
            "its reason: the node's warning and /diagnostics",
        )
        return
    prediction = scan.prediction
    sign(figure, prediction, QUIET)
    bound = bound_of(prediction, "at least ")
    force = "pull-off force %s%s" % (
        bound,
        with_unit(prediction.pull_off_force, "N", digits_of(prediction)),
    )
    limits = limits_of(prediction)
    if len(limits) > LONGEST_LIMITS:
        limits = ", ".join(
            flag_names(prediction.regime_flags)
            + ["warning: " + text for text in prediction.warnings]
        )
    if prediction.status == NO_EQUILIBRIUM:
        _headline(
            figure, number, "no equilibrium", UNKNOWN, "the forces are not to be used", limits
        )
    elif math.isnan(prediction.margin) and math.isnan(prediction.peel_number):
        _headline(figure, number, force, None, prediction.reason or "no verdict", limits)
    else:
        word = {NO: "RELEASES", MARGINAL: "MARGINAL", YES: "STICKS"}.get(
            prediction.sticks, "NOT KNOWN"
        )
        _headline(figure, number, word, prediction.sticks, prediction.reason, limits)


def _headline(figure, number, text, verdict, detail, limits=""):
    colours = {value: colour for value, _, colour, _ in VERDICTS}
    figure.text(
        0.1,
        0.945,
        "Scan %d: %s" % (number, text),
        ha="left",
        va="center",
        fontsize=27,
        fontweight="bold",
        color=colours.get(verdict, TEXT),
    )
    _line_of_text(figure, 0.885, detail, TEXT, 14, 92)
    if limits:
        _line_of_text(figure, 0.848, limits, "#f2b705", 11, LONGEST_LIMITS)


def _line_of_text(figure, height, text, colour, size, longest):
    figure.text(
        0.1,
        height,
        literal(shortened(text, longest)),
        ha="left",
        va="center",
        fontsize=size,
        color=colour,
    )
