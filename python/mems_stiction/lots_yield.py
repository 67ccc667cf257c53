"""Which share of all places sticks: from the margins of some.

Two things make a share uncertain: few places, wafers and lots were measured; and each margin has an
interval of its own, by constants and model. The latter is one and the same error of all rows: all
margins may be too large together. So both ends of the interval take it with them.

Where the logarithms of the margins are as a normal distribution has them, the share is its tail
below 1. Where they are not, places are counted, and the interval is that of Clopper and Pearson
(1934), of as many independent places as the rows are worth (Korn and Graubard 1998): places of one
wafer are alike. Where none sticks, or all do, there is a bound.
"""

from __future__ import annotations

import math
from typing import NamedTuple, Sequence, Tuple

import numpy as np

from mems_stiction.confidence import NORMAL_95
from mems_stiction.lots_data import Place
from mems_stiction.lots_variance import DRAWS, SEED, Components, Hierarchy, components_of

FEWEST_FOR_SHAPE = 20  # places: fewer do not show whether their distribution is normal
MOST_FOR_SHAPE = 5000  # beyond, the test is none
LEAST_CHANCE = 0.05  # of a shape as odd as this, if the distribution is normal

NORMAL, COUNTED, BOUND = "normal", "counted", "bound"


class Share(NamedTuple):
    """What sticks under one condition."""

    at: float
    places: int
    sticking: int  # of them by their margin
    share: float
    lower: float
    upper: float
    method: str
    tail: float  # what a normal distribution would say; NaN where the margins have another
    worth: float  # as many independent places
    lost: int  # rows without a margin
    without_interval: int  # of the places: their margins come without an interval


def share_of(places: Sequence[Place], hierarchy: Hierarchy, at: float) -> Share:
    """places: with margins, one at least; hierarchy: theirs."""
    known = [place for place in places if place.is_known()]
    values = np.log([place.value for place in known])
    ends = np.log([[place.lower, place.upper] for place in known])
    lacking = np.isnan(ends).any(axis=1)
    ends[lacking] = values[lacking, None] + (
        _usual_reach(values[~lacking], ends[~lacking]) if not lacking.all() else 0.0
    )
    is_finite = bool(np.isfinite(values).all())
    components = components_of(values, hierarchy, False) if is_finite and len(known) > 1 else None
    sticking = int((values < 0.0).sum())
    worth = _worth(len(known), hierarchy, components)
    bounds = _counted(
        int((ends[:, 1] < 0.0).sum()), sticking, int((ends[:, 0] < 0.0).sum()), len(known), worth
    )
    counted = Share(
        at,
        len(known),
        sticking,
        sticking / len(known),
        bounds[0],
        bounds[1],
        BOUND if sticking in (0, len(known)) else COUNTED,
        math.nan,
        worth,
        len(places) - len(known),
        int(lacking.sum()),
    )
    if components is None or not _is_normal(values, hierarchy):
        return counted
    tail = _tail(components.mean, components.total())
    if sticking in (0, len(known)) and min(tail, 1.0 - tail) < 1.0 / worth:
        return counted._replace(tail=tail)
    lower, upper = _normal_interval(components, values, ends)
    return counted._replace(
        share=tail, lower=min(lower, tail), upper=max(upper, tail), method=NORMAL, tail=tail
    )


def _usual_reach(values: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """The ends of an interval, from its value: medians. What nothing holds has none."""
    finite = np.isfinite(values)
    return np.median(ends[finite] - values[finite, None], axis=0) if finite.any() else np.zeros(2)


def _tail(mean: float, variance: float) -> float:
    from scipy.stats import norm

    return float(norm.cdf(-mean / math.sqrt(variance))) if variance > 0.0 else float(mean < 0.0)


def _normal_interval(
    components: Components, values: np.ndarray, ends: np.ndarray
) -> Tuple[float, float]:
    """Draws of mean and spread, with an error that all margins share."""
    from scipy.stats import norm

    random = np.random.RandomState(SEED + 1)
    below, above = (
        np.median(values - ends[:, 0]) / NORMAL_95,
        np.median(ends[:, 1] - values) / NORMAL_95,
    )
    shared = random.standard_normal(DRAWS)
    means = components.mean_draws + shared * np.where(shared > 0.0, above, below)
    drawn = norm.cdf(-means / np.sqrt(np.maximum(components.total_draws, 1e-300)))
    lower, upper = np.percentile(drawn, (2.5, 97.5))
    return float(lower), float(upper)


def _counted(least: int, best: int, most: int, count: int, worth: float) -> Tuple[float, float]:
    """least, most: that stick where all margins are at the ends of their intervals. One-sided 95 %
    where none sticks, or all do."""

    def end(sticking: int, is_upper: bool, chance: float) -> float:
        from scipy.stats import beta

        hits = sticking / count * worth
        if is_upper:
            return (
                1.0
                if sticking == count
                else float(beta.ppf(1.0 - chance, hits + 1.0, worth - hits))
            )
        return 0.0 if sticking == 0 else float(beta.ppf(chance, hits, worth - hits + 1.0))

    chance = 0.05 if best in (0, count) else 0.025
    return end(least, False, chance), end(most, True, chance)


def _worth(count: int, hierarchy: Hierarchy, components: "Components | None") -> float:
    """How many independent places tell as much: places of one unit share what makes units
    differ."""
    if components is None or not hierarchy.levels or components.total() <= 0.0:
        return float(count)
    inflation = 1.0
    for level, variance in zip(hierarchy.levels, components.variances):
        sizes = np.bincount(level.units)
        alike = float((sizes.astype(float) ** 2).sum() / count)
        inflation += (alike - 1.0) * float(variance) / components.total()
    return max(count / inflation, 1.0)


def _is_normal(values: np.ndarray, hierarchy: Hierarchy) -> bool:
    """Whether what differs within the last level looks normal."""
    from scipy.stats import shapiro

    if len(values) < FEWEST_FOR_SHAPE:
        return False
    units = hierarchy.levels[-1].units if hierarchy.levels else np.zeros(len(values), int)
    _, inverse, sizes = np.unique(units, return_inverse=True, return_counts=True)
    centred = values - (np.bincount(inverse, values) / sizes)[inverse]
    scaled = (centred / np.sqrt(np.maximum(1.0 - 1.0 / sizes[inverse], 1e-9)))[sizes[inverse] > 1]
    if len(scaled) < FEWEST_FOR_SHAPE or scaled.std() <= 0.0:
        return False
    return bool(shapiro(scaled[:: 1 + len(scaled) // MOST_FOR_SHAPE]).pvalue >= LEAST_CHANCE)
