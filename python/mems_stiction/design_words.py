"""Where a design surely releases, in sentences."""

from __future__ import annotations

import itertools
import math
import re
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

from mems_stiction.design_axes import OF_THE_SPRING, Axis
from mems_stiction.quantities import area, ratio, with_unit

DIGITS = 3
UNKNOWN = "unknown"  # of a row's words: no verdict
LARGEST = 1e300  # stands for an infinite margin


class Crossing(NamedTuple):
    """Where a margin is 1 between two values of an axis. rises: it is above 1 beyond."""

    value: float
    rises: bool
    below: float  # neighbours on the axis
    above: float


class Stretch(NamedTuple):
    """Of values on an axis for which something holds."""

    first: float
    last: float
    start: Optional[Crossing]  # where it begins before the first; None: with it
    end: Optional[Crossing]

    def text(self, axis: Axis) -> str:
        return _between(
            safe_text(self.start, axis) if self.start else _on(axis, self.first),
            safe_text(self.end, axis) if self.end else _on(axis, self.last),
        )


def text_of(value: float, unit: str) -> str:
    if not unit:
        return ratio(value)
    return area(value) if unit == "m^2" else re.sub(r"\.0+ ", " ", with_unit(value, unit))


def _on(axis: Axis, value: float) -> str:
    """A value of an axis."""
    return "%d" % value if axis.is_whole and not axis.unit else text_of(value, axis.unit)


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


def _between(first: str, last: str) -> str:
    return "at " + first if first == last else "from %s to %s" % (first, last)


def _listed(texts: Sequence[str]) -> str:
    return " and ".join(filter(None, [", ".join(texts[:-1]), texts[-1]]))


def _runs(holds: Sequence[bool]) -> List[Tuple[int, int]]:
    """First and last place of each run of places where it holds."""
    runs = []
    for is_run, places in itertools.groupby(range(len(holds)), lambda place: holds[place]):
        if is_run:
            run = list(places)
            runs.append((run[0], run[-1]))
    return runs


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
            _on(other, value),
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
    ends = "%s to %s" % (_on(axis, axis.values[0]), _on(axis, axis.values[-1]))
    unknown = [row["sticks"] == UNKNOWN for row in rows]
    why = _reasons([row["doubt"] for row in rows if row["sticks"] == UNKNOWN])
    if all(unknown):
        what = "margin" if all(math.isnan(value) for value in lowest) else "verdict"
        return "no %s is known for any %s of %s%s" % (what, axis.word, ends, why)
    text = _limit(axis, rows, lowest, ends)
    if not any(unknown):
        return text
    places = [
        place
        for first, last in _runs(unknown)
        for place in (
            [_between(*(_on(axis, axis.values[end]) for end in (first, last)))]
            if last > first + 1
            else ["at " + _on(axis, value) for value in axis.values[first : last + 1]]
        )
    ]
    return "%s; the verdict is unknown %s%s" % (text, _listed(places), why)


def _reasons(doubts: Sequence[str]) -> str:
    """Behind what is unknown, each once; what to do about them is in the rows."""
    reasons = told_once([doubt.partition(": ")[0] for doubt in doubts if doubt])
    return ": " + "; ".join(reasons) if reasons else ""


def _limit(axis: Axis, rows: List[Dict[str, Any]], lowest: List[float], ends: str) -> str:
    if any(math.isnan(value) for value in lowest):
        return "no margin is known for some %s of %s, and no limit can be told" % (axis.word, ends)
    if not any(value > 1.0 for value in lowest):
        return _none(axis, ends, rows, lowest)
    words = [row["sticks"] for row in rows]
    sure = _stretches(axis, words, lowest, [word == "no" for word in words])
    if not sure:
        above = _stretches(axis, words, lowest, [value > 1.0 for value in lowest])
        return "no %s of %s releases surely, though the lower end of the margin is above 1 %s" % (
            axis.word,
            ends,
            _listed([stretch.text(axis) for stretch in above]),
        )
    alternates = axis.name not in OF_THE_SPRING and _alternates(words)
    if alternates:
        # no further than the first value that is not sure
        chosen = sure[:1] if words[0] == "no" or words[-1] != "no" else sure[-1:]
    else:
        chosen = sure
    is_first, is_last = chosen[0].first == axis.values[0], chosen[-1].last == axis.values[-1]
    if is_first and is_last and len(chosen) == 1:
        return "every %s of %s releases surely" % (axis.word, ends)
    limit = chosen[0].end if is_first else chosen[0].start if is_last else None
    more = (
        "; values %s are sure, too, but not those between: the scatter of the generated surfaces "
        "may decide there, and a larger device_force/realisations makes it surer"
        % _listed([stretch.text(axis) for stretch in sure if stretch not in chosen])
        if alternates
        else ""
    )
    if len(chosen) > 1 or limit is None:
        return (
            "%s releases surely %s" % (axis.word, _listed([one.text(axis) for one in chosen]))
        ) + more
    text = "%s %s that releases surely: %s" % (
        "smallest" if limit.rises else "largest",
        axis.word,
        safe_text(limit, axis),
    )
    notes = []
    even = crossings(axis.values, [row["margin"] for row in rows])
    if len(even) == 1:
        notes.append(
            "the margin is 1 between %d and %d"
            % (math.floor(even[0].value), math.floor(even[0].value) + 1)
            if axis.is_whole
            else "the margin is 1 at %s" % _on(axis, even[0].value)
        )
    if axis.name not in OF_THE_SPRING:
        notes.append(
            "interpolated between %s and %s" % (_on(axis, limit.below), _on(axis, limit.above))
        )
    return text + (" (%s)" % "; ".join(notes) if notes else "") + more


def _alternates(words: Sequence[str]) -> bool:
    """Whether values that are not sure, for another reason than an unknown verdict, lie between
    sure ones."""
    runs = _runs([word == "no" for word in words])
    return any(
        set(words[before[1] + 1 : behind[0]]) != {UNKNOWN} for before, behind in zip(runs, runs[1:])
    )


def _none(axis: Axis, ends: str, rows: List[Dict[str, Any]], lowest: List[float]) -> str:
    place = max(range(len(lowest)), key=lambda index: lowest[index])
    text = "no %s of %s releases surely: the lower end of the margin is at most %s, at %s" % (
        axis.word,
        ends,
        ratio(lowest[place]),
        _on(axis, axis.values[place]),
    )
    if axis.name in OF_THE_SPRING and rows[-1]["sticks"] != UNKNOWN and lowest[-1] > 0:
        wanted = Crossing(axis.values[-1] / lowest[-1], True, 0.0, math.inf)
        doubt = rows[-1]["doubt"]
        text += "; the margin goes in proportion, " + (
            "but from %s on the verdict would be unknown" if doubt else "so %s would"
        ) % safe_text(wanted, axis)
        text += _reasons([doubt])
    return text


def safe_text(crossing: Crossing, axis: Axis) -> str:
    """Rounded to where the margin is larger."""
    step = (
        10.0 ** (math.floor(math.log10(abs(crossing.value))) - DIGITS + 1)
        if crossing.value and not axis.is_whole
        else 1.0
    )
    steps = crossing.value / step
    if abs(steps - round(steps)) > 1e-9 * abs(steps):
        steps = math.ceil(steps) if crossing.rises else math.floor(steps)
    return _on(axis, steps * step)


def _stretches(
    axis: Axis, words: Sequence[str], lowest: Sequence[float], holds: Sequence[bool]
) -> List[Stretch]:
    """Between values where it holds, to where the margin is 1; not towards an unknown verdict."""
    limits = {limit.below: limit for limit in crossings(axis.values, lowest)}
    found = []
    for first, last in _runs(holds):
        is_before = first > 0 and words[first - 1] != UNKNOWN
        is_behind = last + 1 < len(words) and words[last + 1] != UNKNOWN
        found.append(
            Stretch(
                axis.values[first],
                axis.values[last],
                limits.get(axis.values[first - 1]) if is_before else None,
                limits.get(axis.values[last]) if is_behind else None,
            )
        )
    return found
