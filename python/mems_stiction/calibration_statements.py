"""What a calibration says of its measurements, in sentences: misfits, outliers, wrong units, why
they do not tell the work of adhesion."""

from __future__ import annotations

import math
import warnings
from typing import Dict, List

import numpy as np

from mems_stiction._settings import Settings
from mems_stiction.calibration_constants import RANGE, WORK
from mems_stiction.calibration_data import Measurement
from mems_stiction.calibration_search import COARSE_NODES, Found
from mems_stiction.calibration_words import UNITS
from mems_stiction.quantities import ratio, with_unit

# Between what both ends of the range of a constant give: less hardly depends on it.
DEPENDING = 2.0
FAR_OFF = 3.0  # factor from a measured value to the nearest one that the constants give
HIGH_WORK = 0.5 * RANGE[WORK][1]  # [J/m^2]
LENSES = 1e-3, 0.1  # radii of a surface force apparatus [m]
TIP_RADIUS = "preprocessing/tip/radius"  # whose usual values are those of a probe
MOST_ASKED = 3  # values that are asked for their unit


def of_other_places(data: List[Measurement]) -> List[str]:
    """Of values on one scan that are not of its place alone."""
    if not any(datum.place.stands_for_others for datum in data):
        return []
    return [
        "values on one scan's area differ by more than their uncertainties say: they were taken "
        "for other places of the surface"
    ]


def of_doubts(data: List[Measurement], constants: Dict[str, float]) -> List[str]:
    """Of predictions that may be out by more than the interval says."""
    names: Dict[str, List[str]] = {}
    for datum in data:
        doubt = datum.place.figures_of_scan(constants).doubt
        if doubt:
            names.setdefault(doubt, []).append(datum.name)
    return [
        "what is predicted for %s may be out by more than 1.3, and the work of adhesion with it: %s"
        % (", ".join(of_doubt[:MOST_ASKED]) + (" and others" * (len(of_doubt) > MOST_ASKED)), doubt)
        for doubt, of_doubt in names.items()
    ]


def of_outliers(data: List[Measurement], found: Found) -> List[str]:
    if not found.outliers:
        return []
    expected = found.whole.model(found.fit.parameters)
    with_all = found.axes[0].value(found.whole.fit().parameters[0])
    return [
        "%s does not belong to the others and was left out: %s was measured, %s is expected; with "
        "all measurements the work of adhesion would be %s"
        % (
            data[place].name,
            with_unit(data[place].value, UNITS[data[place].kind]),
            with_unit(float(expected[place]), UNITS[data[place].kind]),
            with_unit(with_all, "J/m^2"),
        )
        for place in found.outliers
    ]


def open_end(found: Found) -> str:
    """What is still said of a work of adhesion that has no interval."""
    interval, axis = found.intervals[0], found.axes[0]
    low, high = (with_unit(axis.value(end), "J/m^2") for end in (interval.lower, interval.upper))
    if interval.is_closed:
        return "these measurements hardly tell the work of adhesion: it lies between %s and %s" % (
            low,
            high,
        )
    if interval.has_lower:
        return (
            "these measurements do not tell the work of adhesion: it is at least %s, and may be "
            "anything above" % low
        )
    if interval.has_upper:
        return (
            "these measurements do not tell the work of adhesion: it is at most %s, and may be "
            "anything below" % high
        )
    ends = [np.concatenate([[bound], found.fit.parameters[1:]]) for bound in axis.bounds]
    if np.abs(np.log(found.whole.model(ends[1]) / found.whole.model(ends[0]))).max() > math.log(
        DEPENDING
    ):
        return (
            "these measurements do not tell the work of adhesion: their uncertainties leave it "
            "open from %s to %s" % (low, high)
        )
    return (
        "these surfaces do not tell the work of adhesion: what holds them hardly depends on it "
        "(rough, stiff, or far apart)"
    )


def of_units(data: List[Measurement], found: Found) -> List[str]:
    """Of values far from all that the range of the work of adhesion gives: mostly another unit, or
    another area."""
    works = np.linspace(*found.axes[0].bounds, COARSE_NODES)
    given = np.array(
        [found.whole.model(np.concatenate([[work], found.fit.parameters[1:]])) for work in works]
    )
    said = []
    for datum, low, high in zip(data, given.min(axis=0), given.max(axis=0)):
        nearest = float(min(max(datum.value, low), high))
        if abs(math.log(datum.value / nearest)) > math.log(FAR_OFF):
            said.append(
                "%s: %s was measured, and the nearest that any work of adhesion gives is %s: is it "
                "in SI units, and of these surfaces and this area?"
                % (
                    datum.name,
                    with_unit(datum.value, UNITS[datum.kind]),
                    with_unit(nearest, UNITS[datum.kind]),
                )
            )
    return said[:MOST_ASKED]


def of_radii(data: List[Measurement]) -> List[str]:
    """Of what is neither a probe nor a lens: mostly in another unit."""
    said = []
    for datum in data:
        radius = datum.place.radius
        if radius is None or LENSES[0] <= radius < LENSES[1]:
            continue
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            Settings(**{TIP_RADIUS: radius, "limits/accept_implausible": True})
        if told:
            said.append(
                "%s: a radius of %s is stated, which no probe has: is it in SI units?"
                % (datum.name, with_unit(radius, "m"))
            )
    return said[:MOST_ASKED]


def of_high_work(found: Found, parameter: float) -> List[str]:
    """parameter: of the work of adhesion, or the lower end of its interval."""
    work = found.axes[0].value(parameter)
    if work < HIGH_WORK:
        return []
    return [
        "hardly any solids have a work of adhesion of %s: are all values in SI units?"
        % with_unit(work, "J/m^2")
    ]


def of_misfit(found: Found) -> List[str]:
    fit, said = found.fit, []
    if fit.widening > 1.0:
        said.append(
            "the measurements scatter %s times as much as their uncertainties say (chi^2 %s of "
            "%d); the interval was widened by that"
            % (ratio(fit.widening), ratio(fit.chi_square), fit.freedom)
        )
    if found.likelihood.has_scatter and fit.scatter > 0.5:
        said.append(
            "much of the scatter is that of surfaces from place to place: more parts tell more, "
            "more precise ones do not"
        )
    return said
