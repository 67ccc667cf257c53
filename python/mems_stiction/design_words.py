"""Where a design surely releases, in sentences."""

from __future__ import annotations

import math
import re
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

from mems_stiction.design_axes import OF_THE_SPRING, Axis
from mems_stiction.quantities import area, ratio, with_unit

DIGITS = 3
LARGEST = 1e300  # stands for an infinite margin


class Crossing(NamedTuple):
    """Where a margin is 1 between two values of an axis. rises: it is above 1 beyond."""

    value: float
    rises: bool
    below: float  # neighbours on the axis
    above: float


def text_of(value: float, unit: str) -> str:
    if not unit:
        return ratio(value)
    return area(value) if unit == "m^2" else re.sub(r"\.0+ ", " ", with_unit(value, unit))


def crossings(values: Sequence[float], margins: Sequence[float]) -> List[Crossing]:
    """ln margin is a straight line between values of the axis: over their logarithms, where all are
    > 0."""
    is_by_ratio = values[0] > 0
    x = [math.log(value) if is_by_ratio else value for value in values]
    y = [
        math.log(min(max(margin, 1.0 / LARGEST), LARGEST)) if not math.isnan(margin) else math.nan
        for margin in margins
    ]
    found = []
    for place in range(len(x) - 1):
        if math.isnan(y[place]) or math.isnan(y[place + 1]) or (y[place] > 0) == (y[place + 1] > 0):
            continue
        at = x[place] + (x[place + 1] - x[place]) * y[place] / (y[place] - y[place + 1])
        found.append(
            Crossing(
                math.exp(at) if is_by_ratio else at,
                y[place + 1] > 0,
                values[place],
                values[place + 1],
            )
        )
    return found


def told_once(texts: Sequence[str]) -> List[str]:
    """Warnings of many points: those that differ in their figures alone by the first of them."""
    alike: Dict[str, List[str]] = {}
    for text in texts:
        alike.setdefault(re.sub(r"\d+(\.\d+)?(e[+-]?\d+)?", "#", text), []).append(text)
    return [
        found[0] + ("" if len(set(found)) == 1 else " (the figures of other points differ)")
        for found in alike.values()
    ]


def sought_first(axes: List[Axis]) -> List[Axis]:
    """The axis whose limit is sought comes first: the spring's, where there is one."""
    return sorted(axes, key=lambda axis: axis.name not in OF_THE_SPRING)


def statements_of(axes: List[Axis], rows: List[Dict[str, Any]]) -> Tuple[str, ...]:
    """One for each value of the second axis."""
    ordered = sought_first(axes)
    sought = ordered[0]
    if len(ordered) == 1:
        return (_sentence(sought, rows),)
    other = ordered[1]
    return tuple(
        "at %s %s: %s"
        % (
            other.word,
            text_of(value, other.unit),
            _sentence(sought, [row for row in rows if row[other.name] == value]),
        )
        for value in other.values
    )


def _surely(row: Dict[str, Any]) -> float:
    """The least margin that the interval allows."""
    lowest = min(row["margin_lower"], row["margin_transition"])
    return (
        math.nan
        if math.isnan(row["margin_lower"]) or math.isnan(row["margin_transition"])
        else lowest
    )


def _sentence(axis: Axis, rows: List[Dict[str, Any]]) -> str:
    rows = sorted(rows, key=lambda row: row[axis.name])
    lowest = [_surely(row) for row in rows]
    return _limit(axis, rows, lowest) + _doubt(axis, rows)


def _limit(axis: Axis, rows: List[Dict[str, Any]], lowest: List[float]) -> str:
    ends = "%s to %s" % (text_of(axis.values[0], axis.unit), text_of(axis.values[-1], axis.unit))
    if all(math.isnan(value) for value in lowest):
        return "no margin is known for any %s of %s" % (axis.word, ends)
    if any(math.isnan(value) for value in lowest):
        return "no margin is known for some %s of %s, and no limit can be told" % (axis.word, ends)
    if not any(value > 1.0 for value in lowest):
        return _none(axis, ends, lowest)
    if all(value > 1.0 for value in lowest):
        return "every %s of %s releases surely" % (axis.word, ends)
    sure = crossings(axis.values, lowest)
    if len(sure) > 1:
        return "%s releases surely %s" % (axis.word, " and ".join(_stretches(axis, lowest, sure)))
    limit = sure[0]
    text = "%s %s that releases surely: %s" % (
        "smallest" if limit.rises else "largest",
        axis.word,
        safe_text(limit, axis.unit),
    )
    notes = []
    even = crossings(axis.values, [row["margin"] for row in rows])
    if len(even) == 1:
        notes.append("the margin is 1 at %s" % text_of(even[0].value, axis.unit))
    if axis.name not in OF_THE_SPRING:
        notes.append(
            "interpolated between %s and %s"
            % (text_of(limit.below, axis.unit), text_of(limit.above, axis.unit))
        )
    return text + (" (%s)" % "; ".join(notes) if notes else "")


def _none(axis: Axis, ends: str, lowest: List[float]) -> str:
    place = max(range(len(lowest)), key=lambda index: lowest[index])
    text = "no %s of %s releases surely: the lower end of the margin is at most %s, at %s" % (
        axis.word,
        ends,
        ratio(lowest[place]),
        text_of(axis.values[place], axis.unit),
    )
    if axis.name in OF_THE_SPRING and lowest[-1] > 0:
        wanted = Crossing(axis.values[-1] / lowest[-1], True, 0.0, math.inf)
        text += "; the margin goes in proportion, so %s would" % safe_text(wanted, axis.unit)
    return text


def safe_text(crossing: Crossing, unit: str) -> str:
    """Rounded to where the margin is larger."""
    step = (
        10.0 ** (math.floor(math.log10(abs(crossing.value))) - DIGITS + 1)
        if crossing.value
        else 1.0
    )
    steps = crossing.value / step
    if abs(steps - round(steps)) > 1e-9 * abs(steps):
        steps = math.ceil(steps) if crossing.rises else math.floor(steps)
    return text_of(steps * step, unit)


def _stretches(axis: Axis, lowest: List[float], sure: List[Crossing]) -> List[str]:
    texts, start = [], "from %s" % text_of(axis.values[0], axis.unit) if lowest[0] > 1.0 else ""
    for crossing in sure:
        if crossing.rises:
            start = "from %s" % safe_text(crossing, axis.unit)
        else:
            texts.append("%s to %s" % (start, safe_text(crossing, axis.unit)))
            start = ""
    return texts + (["%s to %s" % (start, text_of(axis.values[-1], axis.unit))] if start else [])


def _doubt(axis: Axis, rows: List[Dict[str, Any]]) -> str:
    """What stands against a verdict where the margin alone would say "no"; what to do about it is
    in the rows."""
    doubted: Optional[Dict[str, Any]] = next(
        (row for row in rows if row["doubt"] and _surely(row) > 1.0), None
    )
    if doubted is None:
        return ""
    return "; but at %s the verdict stays unknown: %s" % (
        text_of(doubted[axis.name], axis.unit),
        doubted["doubt"].partition(": ")[0],
    )
