"""Load sweeps and contact cycles (mems_stiction/SweepLoadResult, CycleContactResult) in words."""

import math
import textwrap

from mems_stiction.prediction_text import (
    STATUS_NAMES,
    STICKS_NAMES,
    bound_of,
    contact_area_of,
    digits_of,
    has_verdict,
    ratio_name,
    ratio_value,
)
from mems_stiction.quantities import area, percent, ratio, with_interval, with_unit
from mems_stiction.sweep_jumps import UP, jumps_of

NO, MARGINAL, YES = 0, 1, 2  # StictionPrediction.STICKS_...
LANDS_NO, LANDS_YES, LANDS_UNKNOWN = 0, 1, 2  # SweepPoint.LANDS_...
LANDS_NAMES = {LANDS_NO: "no", LANDS_YES: "yes"}
NO_RATIO = (
    "There is no margin: it needs device/spring_stiffness, travel and contact_area, or a beam."
)
PEELED = "Peel: the peel number of a beam that is peeled, in the margin's place."
WIDTH = 130  # of a sentence, letters
ROUND_OFF = 1e-9  # of sums over a million cells, with room
_SWEEP = "%-4s %10s %10s  %-5s  %-14s %11s %11s %10s %12s %9s %9s  %s"
_CYCLE = "%6s  %-14s %11s %10s %9s %9s %11s %12s %9s  %s"


def sweep_header():
    top = _SWEEP % (
        "",
        "",
        "",
        "",
        "",
        "pull-off",
        "electro-",
        "contact",
        "contact",
        "",
        "while",
        "",
    )
    bottom = _SWEEP % (
        "way",
        "voltage",
        "load",
        "lands",
        "status",
        "force",
        "static",
        "fraction",
        "area",
        "margin",
        "held",
        "sticks",
    )
    return top.rstrip() + "\n" + bottom


def sweep_line(point):
    """Lands: by the voltage alone. Margin: once the load is taken away; while held: with it. Below
    1 the device stays closed."""
    way = "up" if point.direction == UP else "down"
    lands = LANDS_NAMES.get(getattr(point, "lands", LANDS_UNKNOWN), "-")
    if point.is_open:
        return (
            _SWEEP
            % (
                way,
                with_unit(point.voltage, "V"),
                with_unit(point.mechanical_load, "N"),
                lands,
                "open",
                "-",
                "-",
                "-",
                "-",
                "-",
                "-",
                STICKS_NAMES.get(point.sticks, "?"),
            )
        ).rstrip()
    bound, digits = bound_of(point), digits_of(point)
    return _SWEEP % (
        way,
        with_unit(point.voltage, "V"),
        with_unit(point.mechanical_load, "N"),
        lands,
        STATUS_NAMES.get(point.status, "?"),
        bound + with_unit(point.pull_off_force, "N", digits),
        with_unit(point.electrostatic_force, "N"),
        percent(point.contact_fraction),
        area(contact_area_of(point)),
        _ratio(point, digits),
        ratio(point.holding_margin, digits),
        STICKS_NAMES.get(point.sticks, "?"),
    )


def _ratio(point, digits):
    """Of a beam that is peeled "peel 15"."""
    return ("peel " if ratio_name(point) == "peel_number" else "") + ratio(
        ratio_value(point), digits
    )


def has_ratio(points):
    """Whether one of them has a margin or a peel number."""
    return any(
        not math.isnan(ratio_value(point))
        for point in points
        if not getattr(point, "is_open", False)
    )


def why_no_margin(prediction):
    """The reason of a verdict that has neither margin nor peel number; else empty."""
    return "" if has_verdict(prediction) else prediction.reason


def _no_ratio(result, why, width):
    """why: there is none; empty: as the result says, of the Python module."""
    why = why or getattr(result, "why_no_margin", "")
    return textwrap.wrap("There is no margin: %s." % why, width or math.inf) if why else [NO_RATIO]


def sweep_sentences(result, width=WIDTH, why=""):
    """What the loop says: where it releases, where it sticks, where it opens, pull-in, and the
    hysteresis. width: letters of a line; None: each sentence is one. why: there is no margin, if
    it is known."""
    sentences = []
    for summary in result.summaries:
        sentences.append("Pressed with %s:" % with_unit(summary.mechanical_load, "N"))
        spans = _safe_spans(summary, result.points)
        for text, words in (
            (
                "margin at least 1 after voltages up to",
                _voltage_words(summary.highest_releasing_voltage),
            ),
            (
                "surely (95 %) releases after voltages of"
                if spans
                else "surely (95 %) releases after voltages up to",
                spans or _voltage_words(summary.highest_safe_voltage),
            ),
            (
                "first voltage after which the margin is below 1",
                _voltage_words(summary.lowest_sticking_voltage),
            ),
            ("opens on the way down at", _voltage_words(summary.opening_voltage)),
        ):
            sentences.append("  %s: %s" % (text, words))
        sentences += _landing(result.points, summary.mechanical_load)
        sentences += _verdicts(summary, result.points)
        for jump in jumps_of(result.points, summary.mechanical_load, result.pull_in_voltage):
            sentences += textwrap.wrap(
                "jump " + jump.words(),
                width or math.inf,
                initial_indent="  ",
                subsequent_indent="    ",
            )
        sentences += _first_force(result.points, summary.mechanical_load)
        gap = widest_gap(result.points, summary.mechanical_load)
        if gap is None:
            sentences.append("  no hysteresis: the way down is the way up")
        else:
            voltage, up, down = gap
            sentences.append(
                "  hysteresis, widest at %s: %s %s on the way up, %s on the way down"
                % (
                    with_unit(voltage, "V"),
                    area_label(result.points),
                    area(up),
                    area(down) if down else "0, open",
                )
            )
    if math.isnan(result.pull_in_voltage):
        reason = getattr(result, "pull_in_reason", "")
        sentences.append("Pull-in voltage: not stated" + (" (%s)" % reason if reason else ""))
    else:
        sentences.append("Pull-in voltage: %s" % with_unit(result.pull_in_voltage, "V"))
    if not has_ratio(result.points):
        return sentences + _no_ratio(result, why, width)
    sentences.append(
        "Margin: restoring force over pull-off force, once the load is gone; above 1 the device "
        "opens."
    )
    if any(ratio_name(point) == "peel_number" for point in result.points):
        sentences.append(PEELED)
    sentences.append(
        "While held: what opens the device over all that holds it while the load acts."
    )
    return sentences


def _landing(points, mechanical_load):
    """From which voltage of the way up the field alone closes the device, if its pull-in voltage is
    known."""
    up = [
        point
        for point in points
        if point.mechanical_load == mechanical_load and point.direction == UP
    ]
    if all(getattr(point, "lands", LANDS_UNKNOWN) == LANDS_UNKNOWN for point in up):
        return []
    first = next((point.voltage for point in up if point.lands == LANDS_YES), math.nan)
    return ["  first voltage that closes it by itself: " + _voltage_words(first)]


def _first_force(points, mechanical_load):
    """The pull-off force of the lowest voltage with its interval, if that is known."""
    first = next((point for point in points if point.mechanical_load == mechanical_load), None)
    if first is None or not math.isfinite(getattr(first, "pull_off_force_upper", math.nan)):
        return []
    return [
        "  pull-off force after %s: %s, 95 %% in brackets"
        % (
            with_unit(first.voltage, "V"),
            with_interval(
                first.pull_off_force, first.pull_off_force_lower, first.pull_off_force_upper, "N"
            ),
        )
    ]


def verdict_runs(points, mechanical_load):
    """[verdict, first voltage, last voltage]: after which voltages of the way up each verdict
    holds."""
    runs = []
    for point in points:
        if point.mechanical_load != mechanical_load or point.direction != UP:
            continue
        if runs and runs[-1][0] == point.sticks:
            runs[-1][2] = point.voltage
        else:
            runs.append([point.sticks, point.voltage, point.voltage])
    return runs


def _span(first, last):
    return (
        with_unit(first, "V")
        if first == last
        else "%s to %s" % (with_unit(first, "V"), with_unit(last, "V"))
    )


def _voltage_words(voltage):
    return "none of the sweep" if math.isnan(voltage) else with_unit(voltage, "V")


def _safe_spans(summary, points):
    """ "10.0 V to 40.0 V only": where the verdict is no, if it is not after the lowest voltage.
    Empty if it is, or nowhere."""
    if not math.isnan(summary.highest_safe_voltage):
        return ""
    spans = [
        _span(first, last)
        for word, first, last in verdict_runs(points, summary.mechanical_load)
        if word == NO
    ]
    return ", ".join(spans) + " only" if spans else ""


def _verdicts(summary, points):
    """The rows' verdicts, if there is a device."""
    if not has_ratio(points):
        return []
    runs = verdict_runs(points, summary.mechanical_load)
    return [
        "  sticks, after voltages of: "
        + "; ".join(
            "%s %s" % (STICKS_NAMES.get(word, "?"), _span(first, last))
            for word, first, last in runs
        )
    ]


def safe_voltage_words(summary, points):
    """The largest voltage after which the verdict with its interval still releases."""
    if math.isnan(summary.highest_safe_voltage):
        spans = _safe_spans(summary, points)
        return (
            "safe (95 %%) at %s" % spans
            if spans
            else "no voltage of the sweep is surely safe (95 %)"
        )
    of_load = [
        point.voltage for point in points if point.mechanical_load == summary.mechanical_load
    ]
    is_last = summary.highest_safe_voltage == max(of_load, default=math.inf)
    return "safe (95 %%) up to %s%s" % (
        with_unit(summary.highest_safe_voltage, "V"),
        ", the highest of the sweep" if is_last else "",
    )


def area_label(points):
    """What contact_area_of() is of these points."""
    return (
        "contact area"
        if any(math.isnan(point.contact_area_jkr) for point in points)
        else "JKR contact area"
    )


def widest_gap(points, mechanical_load):
    """(voltage, area up, area down) where the contact areas [m^2] of both ways differ most; None if
    they do not."""
    of_load = [point for point in points if point.mechanical_load == mechanical_load]
    up = {point.voltage: contact_area_of(point) for point in of_load if point.direction == UP}
    gaps = [
        (point.voltage, up[point.voltage], contact_area_of(point))
        for point in of_load
        if point.direction != UP
    ]
    widest = max(gaps, key=lambda gap: abs(gap[2] - gap[1]), default=None)
    return widest if widest and widest[1] != widest[2] else None


def cycle_header():
    top = _CYCLE % ("", "", "pull-off", "contact", "", "", "rms", "largest", "", "")
    bottom = _CYCLE % (
        "cycle",
        "status",
        "force",
        "fraction",
        "contacts",
        "plastic",
        "height",
        "change",
        "margin",
        "sticks",
    )
    return top.rstrip() + "\n" + bottom


def cycle_line(cycle):
    """`largest change` of either surface's height in this contact."""
    bound, digits = bound_of(cycle), digits_of(cycle)
    return _CYCLE % (
        cycle.cycle,
        STATUS_NAMES.get(cycle.status, "?"),
        bound + with_unit(cycle.pull_off_force, "N", digits),
        percent(cycle.contact_fraction),
        cycle.asperity_count,
        cycle.plastic_count,
        with_unit(cycle.rms_height, "m"),
        with_unit(cycle.largest_change, "m"),
        _ratio(cycle, digits),
        STICKS_NAMES.get(cycle.sticks, "?"),
    )


def cycle_sentences(result, width=WIDTH, why=""):
    """How the force goes, and whether the device comes off. width, why: as of sweep_sentences()."""
    if not len(result.cycles):
        return []
    first, last = result.cycles[0], result.cycles[-1]
    growth = last.pull_off_force / first.pull_off_force - 1 if first.pull_off_force else 0.0
    if abs(growth) < ROUND_OFF:
        change = "stays at %s" % with_unit(first.pull_off_force, "N")
    else:
        change = "goes from %s to %s (%+.3g %%)" % (
            with_unit(first.pull_off_force, "N"),
            with_unit(last.pull_off_force, "N"),
            100 * growth,
        )
    sentences = [
        "From contact %d to contact %d the pull-off force %s." % (first.cycle, last.cycle, change)
    ]
    settled = [cycle.cycle for cycle in result.cycles if cycle.largest_change == 0.0]
    if settled:
        sentences.append("From contact %d on nothing flows any more." % settled[0])
    judged = [cycle for cycle in result.cycles if not math.isnan(ratio_value(cycle))]
    if not judged:
        sentences += _no_ratio(result, why, width)
    elif result.first_sticking_cycle:
        sticks_on = all(
            cycle.sticks == YES
            for cycle in result.cycles
            if cycle.cycle >= result.first_sticking_cycle
        )
        sentences.append(
            (
                "The device fails: from contact %d on it sticks."
                if sticks_on
                else "The device fails: it sticks after contact %d, but not surely after each "
                "later one."
            )
            % result.first_sticking_cycle
        )
    else:
        lowest = min(judged, key=ratio_value)
        sentences.append(
            "%s; the lowest %s is %s."
            % (
                _release_after(result.cycles),
                ratio_name(lowest).replace("_", " "),
                _ratio_with_interval(lowest),
            )
        )
    return sentences


def _ratio_with_interval(cycle):
    return with_interval(*[ratio_value(cycle, end) for end in ("", "_lower", "_upper")])


def _release_after(cycles):
    """Whether the device comes off after every contact, in words: plainly where no verdict leaves a
    doubt."""
    doubts = [cycle for cycle in cycles if cycle.sticks != NO]
    if not doubts:
        return "The device releases after each of these contacts"
    words = (
        "it is marginal" if any(cycle.sticks == MARGINAL for cycle in doubts) else "it is not known"
    )
    which = (
        "any of these contacts"
        if len(doubts) == len(cycles)
        else "%d of these contacts, first after contact %d" % (len(doubts), doubts[0].cycle)
    )
    return "Whether the device releases: %s after %s" % (words, which)
