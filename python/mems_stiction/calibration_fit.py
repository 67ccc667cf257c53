"""Constants of a process by maximum likelihood: what fits measurements best, how far it is known,
and which measurement does not belong.

Nothing here knows of surfaces: a model is a function from parameters to the values that would be
measured. Errors are independent and normal, but for surfaces that scatter from place to place:
those are lognormal. An uncertainty that is the same share of all values is that share of the true
one: taken of the measured values it would give low ones more weight, and so a constant that is too
low. Its deviance is that of a variance that goes with the square of the mean (Wedderburn,
Biometrika 61 (1974) 439).

Intervals are those of the profile likelihood (Venzon and Moolgavkar, Appl. Stat. 37 (1988) 87), 95
%.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from mems_stiction.other_packages import require_package

require_package("scipy", "calibrate")

import scipy.optimize  # noqa: E402
import scipy.stats  # noqa: E402

QUANTILE_95 = float(scipy.stats.chi2.ppf(0.95, 1))
FEWEST_FOR_SCATTER = 4  # fewer measurements do not tell how much surfaces scatter
FEWEST_FOR_OUTLIERS = 4  # others are needed to tell one that does not belong
FALSE_OUTLIERS = 0.02  # probability that one of sound measurements is taken for one
UNLIKELY = 0.01  # probability of a misfit that is no chance
SAME_SHARE = 1.5  # of the share itself
MOST_SCATTER = 2.0  # over the stated one, which few made surfaces tell
STARTS = 25
STARTS_OF_A_FIT = 3
STEP_OF_SEARCH = 1e-7  # of the range
STEPS_TO_AN_END = 64
HALVINGS = 10
STEP_FOR_SLOPES = 1e-3  # of the range

Model = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Interval:
    """Of one parameter; an end where the range that was searched ends is none."""

    lower: float
    upper: float
    has_lower: bool
    has_upper: bool

    @property
    def is_closed(self) -> bool:
        return self.has_lower and self.has_upper


@dataclass(frozen=True)
class Fit:
    """Best parameters and what they leave.

    values: what the model gives; deviations: standard ones, of each measurement about it; scatter:
    share of the stated scatter of surfaces that the measurements show; chi_square, freedom,
    probability: of the misfit; widening: factor on the intervals where that is no chance (Birge,
    Phys. Rev. 40 (1932) 207).
    """

    parameters: np.ndarray
    values: np.ndarray
    deviations: np.ndarray
    scatter: float
    deviance: float
    chi_square: float
    freedom: int
    probability: float

    @property
    def widening(self) -> float:
        return (
            float(np.sqrt(self.chi_square / self.freedom)) if self.probability < UNLIKELY else 1.0
        )


class Likelihood:
    """Of measurements, under a model.

    values, uncertainties: measured, in the same unit. places: standard deviation of ln value from
    one place of the surfaces to another, which the measurements may show in full or in part; 0
    where the very place is known.
    groups: a word for each measurement: those of one group are of one kind and unit.
    common: standard deviation of ln value that measurements on the same scans share, since these
    are a sample of the surfaces. shared: correlation of that between measurements, n x n: 1 where
    the scans are the same, 0 where all differ.
    model: parameters -> values; bounds: of each parameter.
    """

    def __init__(
        self,
        values: Sequence[float],
        uncertainties: Sequence[float],
        places: Sequence[float],
        groups: Sequence[str],
        model: Model,
        bounds: Sequence[Tuple[float, float]],
        common: Sequence[float] = (),
        shared: Optional[np.ndarray] = None,
    ) -> None:
        self.values = np.asarray(values, float)
        self.uncertainties = np.asarray(uncertainties, float)
        self.places = np.asarray(places, float)
        self.groups = list(groups)
        self.model = model
        self.bounds = list(bounds)
        self.common = np.asarray(common, float) if len(common) else np.zeros(len(self.values))
        self.shared = np.eye(len(self.values)) if shared is None else np.asarray(shared, float)
        self.is_lognormal = (self.places > 0) | (
            self.common > 0
        )  # what is known of the surfaces is a factor
        self.shares = _shares(self.values, self.uncertainties, self.groups)
        self.has_common = bool((self.common > 0).any())
        self.has_scatter = np.count_nonzero(self.places > 0) >= FEWEST_FOR_SCATTER

    def part(self, members: Sequence[int]) -> "Likelihood":
        """Of some of the measurements."""
        chosen = np.array(members, dtype=int)
        return Likelihood(
            self.values[chosen],
            self.uncertainties[chosen],
            self.places[chosen],
            [self.groups[i] for i in chosen],
            lambda parameters: self.model(parameters)[chosen],
            self.bounds,
            self.common[chosen],
            self.shared[np.ix_(chosen, chosen)],
        )

    def deviations(self, fitted: np.ndarray, scatter: float) -> Tuple[np.ndarray, np.ndarray]:
        """Standardised deviations of the measurements from what a model gives, and the variances of
        ln value about it."""
        own = np.where(np.isnan(self.shares), self.uncertainties / fitted, self.shares)
        variances = own**2 + (scatter * self.places) ** 2
        of_places = (
            np.log(self.values / fitted) + own**2 / 2
        )  # a normal error of this share lowers the mean logarithm by that
        return np.where(self.is_lognormal, of_places, self.values / fitted - 1.0) / np.sqrt(
            variances
        ), variances

    def standardised(self, fitted: np.ndarray, scatter: float) -> np.ndarray:
        """Deviations over all that each measurement may be off by, what it shares with others,
        too."""
        deviations, variances = self.deviations(fitted, scatter)
        return deviations / np.sqrt(np.diag(self._covariance(variances)))

    def deviance(self, unknowns: np.ndarray) -> float:
        """-2 ln quasi-likelihood but for a constant; unknowns: parameters, and the scatter where it
        is one."""
        scatter = unknowns[-1] if self.has_scatter else 1.0
        fitted = self.model(unknowns[: len(self.bounds)])
        deviations, variances = self.deviations(fitted, scatter)
        over = self.values / fitted
        normal = deviations**2 + np.where(self.is_lognormal, np.log(variances), 0.0)
        of_shares = 2.0 * (over - 1.0 - np.log(over)) / variances
        found = float(
            np.sum(np.where(self.is_lognormal | np.isnan(self.shares), normal, of_shares))
        )
        if self.has_common:
            covariance = self._covariance(variances)
            found += _squared(deviations, covariance) - float(deviations @ deviations)
            found += float(np.linalg.slogdet(covariance)[1])
        return found if np.isfinite(found) else 1e300

    def _covariance(self, variances: np.ndarray) -> np.ndarray:
        """Of standardised deviations: an own error of variance 1, and what is shared with
        others."""
        over = self.common / np.sqrt(variances)
        return np.eye(len(over)) + self.shared * np.outer(over, over)

    def information(self, slopes: np.ndarray, fit: Fit) -> np.ndarray:
        """Fisher's, of parameters that ln values go with by slopes, measurements x parameters."""
        variances = self.deviations(self.model(fit.parameters), fit.scatter)[1]
        slopes = slopes / np.sqrt(np.maximum(variances, 1e-12))[:, None]
        return slopes.T @ np.linalg.solve(self._covariance(variances), slopes)

    def fit(self, near: Optional[np.ndarray] = None) -> Fit:
        """- near: unknowns that are worth a start"""
        starts = (
            self._starts({})[:STARTS_OF_A_FIT] if near is None else [near] + self._starts({})[:1]
        )
        best = min((self._improved(start, {}) for start in starts), key=lambda found: found[1])
        parameters = best[0][: len(self.bounds)]
        scatter = float(best[0][-1]) if self.has_scatter else 1.0
        fitted = self.model(parameters)
        deviations, variances = self.deviations(fitted, scatter)
        freedom = max(len(self.values) - len(self.bounds), 1)
        chi_square = _squared(deviations, self._covariance(variances))
        probability = (
            float(scipy.stats.chi2.sf(chi_square, freedom))
            if len(self.values) > len(self.bounds)
            else 1.0
        )
        return Fit(
            parameters,
            fitted,
            self.standardised(fitted, scatter),
            scatter,
            best[1],
            chi_square,
            freedom,
            probability,
        )

    def interval(self, fit: Fit, index: int) -> Interval:
        """Of one parameter, 95 %: where the others follow as they fit best."""
        limit = fit.deviance + QUANTILE_95 * fit.widening**2
        ends = [self._end(fit, index, limit, self.bounds[index][side]) for side in (0, 1)]
        return Interval(ends[0][0], ends[1][0], ends[0][1], ends[1][1])

    def _profile(self, index: int, value: float, near: np.ndarray) -> Tuple[float, np.ndarray]:
        """Least deviance where one parameter has this value, and the unknowns there.

        - near: unknowns to start from, as they were at a value close by
        """
        fixed = {index: value}
        free = self._free(fixed)
        if not free:
            unknowns = self._unknowns([], fixed)
            return self.deviance(unknowns), unknowns
        unknowns, least = self._improved(near[free], fixed)
        return least, unknowns

    def outliers(self) -> List[int]:
        """Measurements that the others do not expect, the worst first: at most a fifth of them,
        each against a fit without it."""
        members = list(range(len(self.values)))
        found: List[int] = []
        near: Optional[np.ndarray] = None
        while len(members) >= max(FEWEST_FOR_OUTLIERS, len(self.bounds) + 2) and 5 * (
            len(found) + 1
        ) <= len(self.values):
            if near is None:
                near = self._unknowns_of(self.fit())
            distances = [
                self._distance(place, [other for other in members if other != place], near)
                for place in members
            ]
            # the worst of so many
            if max(distances) < float(scipy.stats.norm.isf(FALSE_OUTLIERS / (2 * len(members)))):
                break
            found.append(members.pop(int(np.argmax(distances))))
        return found

    def _distance(self, place: int, others: List[int], near: Optional[np.ndarray] = None) -> float:
        """Of a measurement from what others expect [standard deviations of this difference]."""
        likelihood = self.part(others)
        fit = likelihood.fit(near if likelihood.has_scatter == self.has_scatter else None)
        # surfaces may scatter as stated, whatever a few of them show
        deviations, variances = self.deviations(self.model(fit.parameters), 1.0)
        return float(
            abs(deviations[place])
            / self._spread(place, others, fit.parameters, np.sqrt(variances))
            / fit.widening
        )

    def _spread(
        self, place: int, others: List[int], parameters: np.ndarray, own: np.ndarray
    ) -> float:
        """Standard deviation of a measurement about what others expect, over its own: they know the
        parameters by generalised least squares.

        A force among lengths has few that it can be told from, however many there are. What others
        leave open of a parameter ends with its range. own: standard deviations of ln value.
        """
        slopes = self._slopes(parameters) / own[:, None]
        covariance = self._covariance(own**2)
        weighted = np.linalg.solve(covariance[np.ix_(others, others)], slopes[others])
        of_ranges = np.array([12.0 / (high - low) ** 2 for low, high in self.bounds])
        pulls = np.linalg.solve(slopes[others].T @ weighted + np.diag(of_ranges), slopes[place])
        contrast = np.zeros(len(own))
        contrast[place], contrast[others] = 1.0, -weighted @ pulls
        return float(np.sqrt(contrast @ covariance @ contrast + pulls**2 @ of_ranges))

    def _slopes(self, parameters: np.ndarray) -> np.ndarray:
        """d ln value/d parameter, of each measurement."""
        slopes = []
        for index, (low, high) in enumerate(self.bounds):
            ends = [np.array(parameters), np.array(parameters)]
            ends[0][index] = max(parameters[index] - STEP_FOR_SLOPES * (high - low), low)
            ends[1][index] = min(parameters[index] + STEP_FOR_SLOPES * (high - low), high)
            slopes.append(
                np.log(self.model(ends[1]) / self.model(ends[0]))
                / (ends[1][index] - ends[0][index])
            )
        return np.stack(slopes, axis=1)

    def _end(self, fit: Fit, index: int, limit: float, bound: float) -> Tuple[float, bool]:
        """Where the profile reaches the limit on the way to the bound; whether it does."""
        near = self._unknowns_of(fit)

        def over(value: float) -> float:
            nonlocal near
            least, near = self._profile(index, value, near)
            return least - limit

        best = before = fit.parameters[index]
        over_before = fit.deviance - limit
        for share in np.linspace(0.0, 1.0, STEPS_TO_AN_END + 1)[1:] ** 2:
            here = best + share * (bound - best)
            over_here = over(here)
            if over_here > 0.0:
                if over_before >= 0.0:
                    return before, True
                return _crossing(over, before, here), True
            before, over_before = here, over_here
        return bound, False

    def _unknowns_of(self, fit: Fit) -> np.ndarray:
        return np.append(fit.parameters, fit.scatter) if self.has_scatter else fit.parameters

    def _all_bounds(self) -> List[Tuple[float, float]]:
        return self.bounds + ([(0.0, MOST_SCATTER)] if self.has_scatter else [])

    def _free(self, fixed: Dict[int, float]) -> List[int]:
        return [i for i in range(len(self._all_bounds())) if i not in fixed]

    def _unknowns(
        self, free: Union[Sequence[float], np.ndarray], fixed: Dict[int, float]
    ) -> np.ndarray:
        unknowns = np.empty(len(self._all_bounds()))
        unknowns[self._free(fixed)] = free
        for index, value in fixed.items():
            unknowns[index] = value
        return unknowns

    def _starts(self, fixed: Dict[int, float]) -> List[np.ndarray]:
        """Places to begin from, the best first: on a grid of the first free parameter, and a few of
        the others."""
        bounds = [self._all_bounds()[i] for i in self._free(fixed)]
        axes = [
            np.linspace(low, high, STARTS if place == 0 and 0 not in fixed else 4)
            for place, (low, high) in enumerate(bounds)
        ]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(axes))
        return sorted(grid, key=lambda start: self.deviance(self._unknowns(start, fixed)))

    def _improved(self, start: np.ndarray, fixed: Dict[int, float]) -> Tuple[np.ndarray, float]:
        bounds = [self._all_bounds()[i] for i in self._free(fixed)]
        widths = np.array([high - low for low, high in bounds])
        low = np.array([low for low, _ in bounds])

        def of_shares(shares: np.ndarray) -> float:
            return self.deviance(self._unknowns(low + np.clip(shares, 0.0, 1.0) * widths, fixed))

        shares = (start - low) / widths
        if len(bounds) == 1:
            reach = 1.0 / (STARTS - 1)
            shares = np.array(
                [
                    scipy.optimize.minimize_scalar(
                        of_shares,
                        bounds=(max(shares[0] - reach, 0.0), min(shares[0] + reach, 1.0)),
                        method="bounded",
                        options={"xatol": 1e-7},
                    ).x
                ]
            )
        else:
            shares = scipy.optimize.minimize(
                of_shares,
                np.clip(shares, 0.0, 1.0),
                method="L-BFGS-B",
                bounds=[(0.0, 1.0)] * len(bounds),
                options={"ftol": 1e-12, "gtol": 1e-4, "eps": STEP_OF_SEARCH},
            ).x
        unknowns = self._unknowns(low + np.clip(shares, 0.0, 1.0) * widths, fixed)
        return unknowns, self.deviance(unknowns)


def _crossing(function: Callable[[float], float], below: float, above: float) -> float:
    """Where a function becomes positive between two places, to 0.1 % of their distance.

    Halving asks for no sign of the function at the ends: a search that goes on from the one before
    may end a little elsewhere the second time.
    """
    for _ in range(HALVINGS):
        middle = 0.5 * (below + above)
        if function(middle) > 0.0:
            above = middle
        else:
            below = middle
    return 0.5 * (below + above)


def _squared(deviations: np.ndarray, covariance: np.ndarray) -> float:
    """Their square in the measure of a covariance: chi^2."""
    return float(deviations @ np.linalg.solve(covariance, deviations))


def _shares(values: np.ndarray, uncertainties: np.ndarray, groups: Sequence[str]) -> np.ndarray:
    """Uncertainty over value where it goes with the value, else NaN: in its group shares differ
    less than uncertainties do.

    Shares that differ by no more than measured values scatter are one share, of the true values.
    """
    shares = np.full(len(values), np.nan)
    for group in set(groups):
        members = np.array([other == group for other in groups])
        own = uncertainties[members] / values[members]
        if np.std(np.log(own)) <= np.std(np.log(uncertainties[members])):
            common = float(np.median(own))
            shares[members] = common if np.std(np.log(own)) < SAME_SHARE * common else own
    return shares
