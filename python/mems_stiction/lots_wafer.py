"""One wafer: the trend over it, and places that do not belong to it."""

from __future__ import annotations

import math
from typing import Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from mems_stiction.lots_data import RMS_HEIGHT, Place

FEWEST_SITES = 6  # for a trend: three constants, and what is left
ROUNDS = 30  # of weights
TUNING = 4.685  # of Tukey's biweight: 95 % efficient
MAD_TO_SIGMA = 1.4826
EFFICIENCY = (
    0.37  # of the median deviation: as uncertain as the standard deviation of so many fewer values
)
# that one of the places of a sound wafer is taken for bad, or that it is said to have a trend
CHANCE = 0.05
LEAST_SPREAD = 1e-6  # of logarithms: below is round-off
LEAST_SPAN = 0.05  # of the colours of a map, as a share of its values
MOST_RATIO = 30.0  # of values whose colours are linear
MIDDLE = (
    2.5,
    97.5,
)  # percent of the values that colours tell apart: what is far off would take all of them


class Trend(NamedTuple):
    """A plane through the logarithms: its steepest rise."""

    lot: str
    wafer: str
    places: int
    gradient_x: float  # of ln [1/m]
    gradient_x_lower: float
    gradient_x_upper: float
    gradient_y: float
    gradient_y_lower: float
    gradient_y_upper: float
    factor: float  # from end to end of the sites along the steepest rise
    factor_lower: float
    factor_upper: float
    extent: float  # of the sites along it [m]
    direction: float  # [rad] from x towards y
    chance: float  # that a wafer without a trend shows as much


class BadPlace(NamedTuple):
    """Further from the trend of its wafer than the others."""

    place: Place
    figure: str
    value: float
    expected: float
    deviations: float  # in robust standard deviations
    limit: float


def design_of(places: Sequence[Place]) -> np.ndarray:
    """Constant, x, y; the constant alone where sites do not span a plane, or are few."""
    constant = np.ones((len(places), 1))
    if len(places) < FEWEST_SITES or not all(place.has_site() for place in places):
        return constant
    sites = np.array([(place.x, place.y) for place in places])
    centred = (sites - sites.mean(axis=0)) / max(float(np.ptp(sites)), 1e-300)
    return (
        np.hstack([constant, centred])
        if np.linalg.matrix_rank(centred, tol=1e-3) == 2
        else constant
    )


def figures_of(figure: str, force: str, places: Sequence[Place]) -> Dict[str, List[float]]:
    """What a wafer is looked at by: what is compared, the force (once, if that is it) and the rms
    height, with their values."""
    return {
        figure: [place.value for place in places],
        force: [place.force for place in places],
        RMS_HEIGHT: [place.rms_height for place in places],
    }


def bad_places(places: Sequence[Place], figure: str, values: Sequence[float]) -> List[BadPlace]:
    """By a plane that outliers do not move (Tukey's biweight), and a spread that they do not widen
    (median deviation).

    The limit is Student's t of as many degrees of freedom as that spread has, so that one of twenty
    sound wafers loses a place.
    """
    known = [index for index, value in enumerate(values) if 0.0 < value < math.inf]
    if len(known) < FEWEST_SITES:
        return []
    from scipy.stats import t

    sites = [places[index] for index in known]
    logs = np.log([values[index] for index in known])
    design = design_of(sites)
    free = len(known) - design.shape[1]
    fitted = _robust(design, logs)
    residuals = logs - fitted
    spread = max(
        MAD_TO_SIGMA * float(np.median(np.abs(residuals))) * math.sqrt(len(known) / free),
        LEAST_SPREAD,
    )
    limit = float(t.isf(0.5 * CHANCE / len(known), max(EFFICIENCY * free, 1.0)))
    found = [
        BadPlace(
            sites[index],
            figure,
            float(np.exp(logs[index])),
            float(np.exp(fitted[index])),
            float(residual / spread),
            limit,
        )
        for index, residual in enumerate(residuals)
        if abs(residual) > limit * spread
    ]
    return sorted(found, key=lambda bad: -abs(bad.deviations))


def _robust(design: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Least absolute deviations first, by weights; then the biweight."""
    weights = np.ones(len(values))
    fitted = values
    for step in range(2 * ROUNDS):
        root = np.sqrt(weights)
        fitted = design @ np.linalg.lstsq(design * root[:, None], values * root, rcond=None)[0]
        distances = np.abs(values - fitted)
        scale = max(MAD_TO_SIGMA * float(np.median(distances)), LEAST_SPREAD)
        weights = (
            1.0 / np.maximum(distances, 1e-3 * scale)
            if step < ROUNDS
            else np.maximum(1.0 - (distances / (TUNING * scale)) ** 2, 0.0) ** 2
        )
    return fitted


def trend_of(places: Sequence[Place]) -> Optional[Trend]:
    """Ordinary least squares over places that belong; None where sites do not show one."""
    known = [place for place in places if 0.0 < place.value < math.inf]
    design = design_of(known)
    if design.shape[1] < 3:
        return None
    from scipy.stats import f, t

    sites = np.array([(place.x, place.y) for place in known])
    size = max(float(np.ptp(sites)), 1e-300)
    logs = np.log([place.value for place in known])
    solution = np.linalg.lstsq(design, logs, rcond=None)[0]
    free = len(known) - 3
    if float(np.ptp(logs)) < LEAST_SPREAD:
        return None
    variance = float(((logs - design @ solution) ** 2).sum()) / free
    covariance = np.linalg.inv(design.T @ design)[1:, 1:] * variance / size**2
    slopes = solution[1:] / size
    steepness = math.hypot(*slopes)
    along = slopes / steepness if steepness > 0.0 else np.array([1.0, 0.0])
    reach = float(t.isf(0.025, free))
    extent = float(np.ptp(sites @ along))
    half = reach * math.sqrt(float(along @ covariance @ along))
    margins = reach * np.sqrt(np.diag(covariance))
    statistic = (
        float(slopes @ np.linalg.solve(covariance, slopes)) / 2.0 if variance > 0.0 else math.inf
    )
    return Trend(
        known[0].lot,
        known[0].wafer,
        len(known),
        slopes[0],
        slopes[0] - margins[0],
        slopes[0] + margins[0],
        slopes[1],
        slopes[1] - margins[1],
        slopes[1] + margins[1],
        math.exp(steepness * extent),
        math.exp((steepness - half) * extent),
        math.exp((steepness + half) * extent),
        extent,
        math.atan2(along[1], along[0]),
        float(f.sf(statistic, 2, free)),
    )


def is_steep(trend: Trend) -> bool:
    return trend.chance < CHANCE


def colour_range(values: np.ndarray) -> Tuple[float, float, bool]:
    """From which to which value > 0 the colours of a map go, and whether by ratios."""
    low, high = (float(end) for end in np.percentile(values, MIDDLE))
    if high - low < LEAST_SPAN * high:
        low, high = low - 0.5 * LEAST_SPAN * high, high + 0.5 * LEAST_SPAN * high
    return low, high, low > 0.0 and high > MOST_RATIO * low


def missing_sites(own: Sequence[Place], others: Sequence[Place]) -> List[Tuple[float, float]]:
    """Where other wafers have a site and this one has none, or no value."""
    known = {(place.x, place.y) for place in own if place.is_known() and place.has_site()}
    return sorted({(place.x, place.y) for place in others if place.has_site()} - known)
