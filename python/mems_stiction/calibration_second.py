"""Which constant is fitted beside the work of adhesion, and whether the measurements tell it."""

from __future__ import annotations

import math
from typing import Any, Callable, Dict, List, Sequence, Tuple

import numpy as np

from mems_stiction.calibration_constants import (
    FILM,
    HAMAKER,
    NORMAL_95,
    POTENTIAL,
    RANGE,
    TELLING,
    WORK,
    AngleAxis,
    Axis,
    PotentialAxis,
    configured,
)
from mems_stiction.calibration_data import Measurement
from mems_stiction.calibration_search import Found, Search

STEPS_FOR_SLOPES = (1.0 / 1.15, 1.15)
FEWEST_FOR_SECOND = 3
LEAST_DEVIATION = 1e-3  # of a constant that is exact
MOST_WIDENING = 1.5  # of the interval of the work of adhesion, by a second constant
BETTER = 6.635  # of the deviance, by one constant more: chi^2 at 1 %


def with_second(
    data: List[Measurement], values: Dict[str, Any], found: Found, on_step: Callable[[], None]
) -> Tuple[Found, List[str]]:
    """With a second constant where the measurements tell one, and a sentence about each that they
    may tell."""
    around = float(found.fit.parameters[0]) if found.axes[0].tells(found.intervals[0]) else None
    first, statements = found, []
    for axis, may_be_told in _second_axes(data, values, found):
        if len(found.axes) > 1:
            statements.append(axis.left())
            continue
        both = Search(data, first.axes + [axis], on_step).run(around) if may_be_told else None
        # a second constant must not cost the work of adhesion, unless its configured value is wrong
        if (
            both is not None
            and axis.tells(both.intervals[1])
            and (around is None or _keeps_work(both, first) or _fits_better(both, first))
        ):
            found = both
            statements.append(axis.told(both.fit.parameters[1], both.intervals[1]))
        else:
            statements.append(axis.not_told())
    return found, statements


def _second_axes(
    data: List[Measurement], values: Dict[str, Any], found: Found
) -> List[Tuple[Axis, bool]]:
    """Constants that measurements of this kind may tell, the first choice first; whether these
    measurements are worth a search for it."""
    voltages = [datum.place.voltage for datum in data]
    axes: List[Tuple[Axis, bool]] = []
    if len(set(voltages)) > 1:
        axes.append((PotentialAxis(values, max(abs(voltage) for voltage in voltages)), True))
    elif configured(POTENTIAL, values) != 0.0:
        axes.append((PotentialAxis(values), False))
    if len({datum.place.humidity for datum in data}) > 1:
        axes.append((AngleAxis(values), True))
    if any(may_be_told for _, may_be_told in axes):
        return axes
    if configured(FILM, values) > 0.0:
        # what is known of the Hamaker constant leaves the thickness as open
        known = math.sqrt(math.log1p(float(values["uncertainty/hamaker_constant"]) ** 2))
        is_told = _may_be_told(data, values, found, [FILM, HAMAKER], [known])
        axes.append((Axis(FILM, values), is_told))
    if configured(HAMAKER, values) > 0.0:
        axes.append((Axis(HAMAKER, values), _may_be_told(data, values, found, [HAMAKER])))
    return axes


def _may_be_told(
    data: List[Measurement],
    values: Dict[str, Any],
    found: Found,
    names: Sequence[str],
    known: Sequence[float] = (),
) -> bool:
    """Whether the slopes of the measurements promise the first constant a narrow interval.

    known: standard deviations of the others' logarithms, as they are known from elsewhere.
    """
    if len(data) < FEWEST_FOR_SECOND:
        return False
    here = {WORK: found.axes[0].value(found.fit.parameters[0])}
    here.update({name: configured(name, values) for name in names})
    slopes = np.array([[_slope(datum, here, name) for name in here] for datum in data])
    widths = np.array([math.log(RANGE[name][1] / RANGE[name][0]) for name in here])
    # what measurements leave open of a constant ends with its range
    priors = 12.0 / widths**2
    priors[len(priors) - len(known) :] = 1.0 / np.maximum(known, LEAST_DEVIATION) ** 2
    information = found.whole.information(slopes, found.fit) + np.diag(priors)
    return math.sqrt(np.linalg.inv(information)[1, 1]) * NORMAL_95 <= 1.5 * math.log(TELLING)


def _slope(datum: Measurement, here: Dict[str, float], name: str) -> float:
    """d ln value/d ln constant."""
    ends = []
    for factor in STEPS_FOR_SLOPES:
        value = datum.expected_of_scan(dict(here, **{name: factor * here[name]}))
        if not 0.0 < value < math.inf:
            return 0.0
        ends.append(math.log(value))
    return (ends[1] - ends[0]) / math.log(STEPS_FOR_SLOPES[1] / STEPS_FOR_SLOPES[0])


def _keeps_work(both: Found, found: Found) -> bool:
    """Whether the work of adhesion stays told: beside a Hamaker constant or a film nearly as well.

    Optical spectra tell these, and nothing but measurements the angle of a liquid or a potential.
    """
    widths = [one.intervals[0].upper - one.intervals[0].lower for one in (both, found)]
    is_as_narrow = both.axes[1].is_free or widths[0] < MOST_WIDENING * widths[1]
    return both.axes[0].tells(both.intervals[0]) and is_as_narrow


def _fits_better(both: Found, found: Found) -> bool:
    """Whether measurements contradict the second constant as configured: a misfit, which it
    mends."""
    is_misfit = found.fit.widening > 1.0 and both.outliers == found.outliers
    return is_misfit and found.fit.deviance - both.fit.deviance > BETTER
