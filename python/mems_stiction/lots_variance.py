"""How far lots, wafers, parts and places differ: components of variance of logarithms, for any
numbers of each.

Estimates are those of restricted likelihood (statsmodels' MixedLM). Intervals are generalised
confidence intervals (Weerahandi 1993; for nested levels
Burdick, Borror and Montgomery, Design and Analysis of Gauge R&R Studies, 2005): each mean square is
its expectation times chi^2 over its degrees of freedom, and the components follow from the mean
squares. Mean squares of unweighted means have exact expectations for unequal numbers, too; their
distribution is exact for equal ones. Two wafers have one degree of freedom, and an interval that
says so.
"""

from __future__ import annotations

import warnings
from typing import Any, List, NamedTuple, Sequence, Tuple

import numpy as np

from mems_stiction.lots_data import Place

DRAWS = 20000
SEED = 20260101  # the same rows have the same interval
LEVELS = ("lots", "wafers", "parts", "places")
LEAST_SHARE = 1e-6  # of the variance
METHODS = ("bfgs", "powell")  # of the likelihood: the better end of the two
MOST_CELLS = 20000  # values times units in one group, in whose matrices MixedLM's time goes
MOST_VALUES = 5000  # in all
NOT_INSTALLED = "statsmodels is not installed (apt-get install python3-statsmodels)"
TOO_MANY = "restricted likelihood would take minutes for so many rows"
NO_END = "restricted likelihood has no maximum here that was found"


class Level(NamedTuple):
    """One level at which values differ."""

    word: str
    units: np.ndarray  # of each value: the number of its unit


class Hierarchy(NamedTuple):
    """Levels that can be told apart, the coarsest first; what is left is within the units of the
    last."""

    levels: Tuple[Level, ...]
    rest: str  # what differs within them
    merged: Tuple[str, ...]  # sentences on levels that are one
    single: Tuple[str, ...]  # words of levels with one unit, from which nothing follows on others


class MeanSquare(NamedTuple):
    value: float
    freedom: int
    coefficients: np.ndarray  # of the components in its expectation; the last is the rest's


class Components(NamedTuple):
    """Of the logarithms."""

    words: Tuple[str, ...]
    counts: Tuple[int, ...]  # units of each
    freedoms: Tuple[int, ...]
    variances: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    mean: float
    mean_draws: np.ndarray
    total_draws: np.ndarray
    mean_squares: Tuple[MeanSquare, ...]
    # why estimates are those of mean squares; empty where they are of restricted likelihood
    why_squares: str

    def total(self) -> float:
        return float(self.variances.sum())


def hierarchy_of(places: Sequence[Place]) -> Hierarchy:
    """Lots have wafers, wafers have parts, parts have places."""
    names: List[Tuple[Any, ...]] = [
        (place.lot, place.wafer, place.part, (place.x, place.y) if place.has_site() else "")
        for place in places
    ]
    levels: List[Level] = []
    merged: List[str] = []
    single: List[str] = []
    above = 1  # units
    for depth, word in enumerate(LEVELS):
        if not any(name[depth] for name in names):
            continue
        known: dict[Any, int] = {}
        units = np.array([known.setdefault(name[: depth + 1], len(known)) for name in names])
        if len(known) == above:
            if above == 1:
                single.append(word)
            else:
                merged.append(
                    "each of the %s has one of the %s: they cannot be told apart"
                    % (levels[-1].word, word)
                )
                levels[-1] = Level("%s and their %s" % (levels[-1].word, word), levels[-1].units)
            continue
        if len(known) == len(names):
            if depth < 2:
                merged.append(
                    "each of the %s has one row: what differs within them is in their difference"
                    % word
                )
            return Hierarchy(tuple(levels), word, tuple(merged), tuple(single))
        levels.append(Level(word, units))
        above = len(known)
    return Hierarchy(tuple(levels), "scans", tuple(merged), tuple(single))


def mean_squares(
    values: np.ndarray, levels: Sequence[np.ndarray]
) -> Tuple[List[MeanSquare], float, np.ndarray]:
    """Of unweighted means, from the coarsest level to the rest; the mean, and the coefficients of
    the components in its variance."""
    count = len(levels) + 1
    means, below = values, np.zeros((len(values), count))
    below[:, -1] = 1.0
    found: List[MeanSquare] = []
    for depth in range(count - 1, -1, -1):
        # those of this depth, by the unit of the level above that they are in
        parents = levels[depth - 1] if depth > 0 else np.zeros(len(values), int)
        if depth < count - 1:
            first = np.unique(levels[depth], return_index=True)[1]
            parents = parents[first]
        _, inverse, sizes = np.unique(parents, return_inverse=True, return_counts=True)
        centres = np.bincount(inverse, means) / sizes
        freedom = len(means) - len(sizes)
        weights = 1.0 - 1.0 / sizes[inverse]
        square = float(((means - centres[inverse]) ** 2).sum())
        found.insert(
            0,
            MeanSquare(square / freedom, freedom, (weights[:, None] * below).sum(axis=0) / freedom),
        )
        above = np.zeros((len(sizes), count))
        np.add.at(above, inverse, below / sizes[inverse][:, None] ** 2)
        if depth > 0:
            above[:, depth - 1] += 1.0
        means, below = centres, above
    return found, float(means[0]), below[0]


def components_of(
    values: np.ndarray, hierarchy: Hierarchy, by_likelihood: bool = True
) -> Components:
    """Needs two values. by_likelihood: else estimates, too, are those of mean squares, in no
    time."""
    levels = [_numbered(level.units) for level in hierarchy.levels]
    squares, mean, spread_of_mean = mean_squares(values, levels)
    count = len(squares)
    random = np.random.RandomState(SEED)
    draws = np.empty((count, DRAWS))
    by_squares = np.empty(count)
    for place in range(count - 1, -1, -1):
        square = squares[place]
        drawn = square.value * square.freedom / random.chisquare(square.freedom, DRAWS)
        draws[place] = (
            drawn - square.coefficients[place + 1 :] @ draws[place + 1 :]
        ) / square.coefficients[place]
        by_squares[place] = (
            square.value - square.coefficients[place + 1 :] @ by_squares[place + 1 :]
        ) / square.coefficients[place]
    mean_draws = mean + random.standard_normal(DRAWS) * np.sqrt(
        np.maximum(spread_of_mean @ draws, 0.0)
    )
    clipped = np.maximum(draws, 0.0)
    found, why = _of_likelihood(values, levels) if by_likelihood and levels else (by_squares, "")
    variances = np.maximum(by_squares if why else found, 0.0)
    variances[variances < LEAST_SHARE * variances.sum()] = 0.0  # the optimiser ends near it
    ends = np.percentile(clipped, (2.5, 97.5), axis=1)
    return Components(
        tuple(level.word for level in hierarchy.levels) + (hierarchy.rest,),
        tuple(int(level.max()) + 1 for level in levels) + (len(values),),
        tuple(square.freedom for square in squares),
        variances,
        np.minimum(ends[0], variances),
        np.maximum(ends[1], variances),
        mean,
        mean_draws,
        clipped.sum(axis=0),
        tuple(squares),
        why,
    )


def _numbered(units: np.ndarray) -> np.ndarray:
    return np.unique(units, return_inverse=True)[1]


def has_likelihood() -> bool:
    try:
        import statsmodels.regression.mixed_linear_model  # noqa: F401
    except ImportError:
        return False
    return True


def _of_likelihood(values: np.ndarray, levels: Sequence[np.ndarray]) -> Tuple[np.ndarray, str]:
    """Variances by restricted likelihood, those of the levels first; none of them, and why not."""
    if not has_likelihood():
        return np.empty(0), NOT_INSTALLED
    if len(values) > MOST_VALUES:
        return np.empty(0), TOO_MANY
    from statsmodels.regression.mixed_linear_model import MixedLM, VCSpec

    scale = float(values.std()) or 1.0  # the optimiser's steps are absolute
    names, matrices, columns = [], [], []
    groups = levels[0]
    for place, level in enumerate(levels[1:]):
        inside = [_numbered(level[groups == group]) for group in range(groups.max() + 1)]
        if max(len(units) * (units.max() + 1) for units in inside) > MOST_CELLS:
            return np.empty(0), TOO_MANY
        names.append("level %d" % place)
        matrices.append([np.eye(units.max() + 1)[units] for units in inside])
        columns.append([["%d" % unit for unit in range(units.max() + 1)] for units in inside])
    order = np.argsort(groups, kind="stable")  # MixedLM takes the matrices group by group
    sorted_groups = groups[order]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of components that are 0, at the end of their range
        model = MixedLM(
            (values[order] - values.mean()) / scale,
            np.ones((len(values), 1)),
            sorted_groups,
            exog_re=np.ones((len(values), 1)),
            exog_vc=VCSpec(names, columns, matrices) if names else None,
        )
        fits = [fit for fit in (_fit(model, method) for method in METHODS) if fit is not None]
    if not fits:
        return np.empty(0), NO_END
    best = max(fits, key=lambda fit: fit.llf)
    return np.concatenate([np.ravel(best.cov_re), best.vcomp, [best.scale]]) * scale**2, ""


def _fit(model: Any, method: str) -> Any:
    """None where it ends at a singular matrix, with an infinite likelihood."""
    try:
        fit = model.fit(reml=True, method=[method])
    except (np.linalg.LinAlgError, ValueError):
        return None
    return fit if np.isfinite(fit.llf) and np.isfinite(fit.scale) else None
