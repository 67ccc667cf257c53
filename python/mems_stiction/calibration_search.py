"""The search for the constants that fit measurements best: what the model expects, at nodes and
between them, and the likelihood's best fit there."""

from __future__ import annotations

from typing import Any, Callable, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from mems_stiction._settings import OptionsError
from mems_stiction.calibration_constants import Axis
from mems_stiction.calibration_data import Measurement, pooled, shared_scans
from mems_stiction.calibration_fit import Fit, Interval, Likelihood
from mems_stiction.calibration_grid import between_nodes

COARSE_NODES = 13
COARSE_NODES_MADE = 21  # more nodes at once cost less than surfaces that are made again
FINE_NODES = 9
FINE_NODES_MADE = 4
FINE_NODES_OF_TWO = 5  # where two constants are sought
REACH_AROUND = 2.0  # of ln work of adhesion, where a second constant is sought, too
MOST_REFINEMENTS = 3


class Surrogate:
    """ln of the expected values at nodes of the constants, and between them."""

    def __init__(
        self, measurements: List[Measurement], axes: List[Axis], on_step: Callable[[], None]
    ) -> None:
        self.measurements, self.axes, self.on_step = measurements, axes, on_step
        self.known: Dict[Tuple[float, ...], np.ndarray] = {}
        self.nodes: List[np.ndarray] = []
        self.interpolation: Any = None

    def take(self, nodes: List[np.ndarray]) -> None:
        from scipy.interpolate import PchipInterpolator

        self.nodes = nodes
        grid = np.stack(np.meshgrid(*nodes, indexing="ij"), axis=-1)
        places = [tuple(parameters) for parameters in grid.reshape(-1, len(nodes))]
        self._prepare(places)
        values = np.array([self._at(parameters) for parameters in places])
        values = values.reshape(grid.shape[:-1] + (len(self.measurements),))
        self.interpolation = (
            PchipInterpolator(nodes[0], values, axis=0)
            if len(nodes) == 1
            else between_nodes(nodes[0], nodes[1], values)
        )

    def expected(self, parameters: np.ndarray) -> np.ndarray:
        inside = [
            min(max(value, nodes[0]), nodes[-1]) for value, nodes in zip(parameters, self.nodes)
        ]
        return np.exp(np.ravel(self.interpolation(inside[0] if len(inside) == 1 else [inside])))

    def bounds(self) -> List[Tuple[float, float]]:
        return [(float(nodes[0]), float(nodes[-1])) for nodes in self.nodes]

    def _constants(self, parameters: Tuple[float, ...]) -> Dict[str, float]:
        return {axis.name: axis.value(value) for axis, value in zip(self.axes, parameters)}

    def _prepare(self, nodes: List[Tuple[float, ...]]) -> None:
        """All that is missing of one place after the other."""
        missing = [
            self._constants(parameters) for parameters in nodes if parameters not in self.known
        ]
        for measurement in (
            {id(measurement.place): measurement for measurement in self.measurements}.values()
            if missing
            else ()
        ):
            measurement.prepare(missing)
            self.on_step()

    def _at(self, parameters: Tuple[float, ...]) -> np.ndarray:
        if parameters not in self.known:
            constants = self._constants(parameters)
            values = [measurement.expected(constants) for measurement in self.measurements]
            for measurement, value in zip(self.measurements, values):
                if not np.isfinite(value):
                    raise OptionsError(
                        "%s: what is expected of it is not known (%r) with %s; are its scans and "
                        "settings those that it was measured with?"
                        % (
                            measurement.name,
                            value,
                            ", ".join("%s = %.3g" % item for item in constants.items()),
                        )
                    )
            self.known[parameters] = np.log(
                np.maximum(values, [1e-12 * measurement.value for measurement in self.measurements])
            )
        return self.known[parameters]


class Found(NamedTuple):
    """What a search found."""

    axes: List[Axis]
    whole: Likelihood  # of all measurements
    likelihood: Likelihood  # without outliers
    fit: Fit
    intervals: List[Interval]
    outliers: List[int]

    def deviations(self) -> np.ndarray:
        """Of all measurements, standardised."""
        return self.whole.standardised(self.whole.model(self.fit.parameters), self.fit.scatter)


class Search:
    """Best constants of a list of axes."""

    def __init__(
        self, measurements: List[Measurement], axes: List[Axis], on_step: Callable[[], None]
    ) -> None:
        self.measurements, self.axes = measurements, axes
        self.surrogate = Surrogate(measurements, axes, on_step)
        self.shared = shared_scans(measurements)

    def run(self, around: Optional[float] = None) -> Found:
        """- around: ln work of adhesion, as it is known from before"""
        has_made = any(measurement.place.is_made for measurement in self.measurements)
        fine = (
            FINE_NODES_MADE if has_made else FINE_NODES_OF_TWO if len(self.axes) > 1 else FINE_NODES
        )
        first = COARSE_NODES_MADE if has_made and len(self.axes) == 1 else COARSE_NODES
        nodes = [
            np.linspace(axis.bounds[0], axis.bounds[1], axis.coarse_nodes if place else first)
            for place, axis in enumerate(self.axes)
        ]
        if around is not None:
            nodes[0] = nodes[0][np.abs(nodes[0] - around) < REACH_AROUND]
        constants = {axis.name: axis.configured for axis in self.axes}
        for _ in range(MOST_REFINEMENTS):
            self.surrogate.take(nodes)
            whole = self._likelihood(constants)
            outliers = whole.outliers()
            likelihood = whole.part(
                [place for place in range(len(self.measurements)) if place not in outliers]
            )
            fit = likelihood.fit()
            intervals = [likelihood.interval(fit, index) for index in range(len(self.axes))]
            constants = {
                axis.name: axis.value(parameter)
                for axis, parameter in zip(self.axes, fit.parameters)
            }
            finer = [_refined(axis, interval, fine) for axis, interval in zip(nodes, intervals)]
            if all(len(one) == len(other) for one, other in zip(finer, nodes)):
                break
            nodes = finer
        return Found(self.axes, whole, likelihood, fit, intervals, outliers)

    def _likelihood(self, constants: Dict[str, float]) -> Likelihood:
        """- constants: those at which surfaces scatter from place to place as they do"""
        data = self.measurements
        return Likelihood(
            [datum.value for datum in data],
            [datum.uncertainty for datum in data],
            pooled([datum.scatter(constants) for datum in data], data),
            [datum.kind for datum in data],
            self.surrogate.expected,
            self.surrogate.bounds(),
            pooled([datum.common(constants) for datum in data], data),
            self.shared,
        )


def _refined(nodes: np.ndarray, interval: Interval, count: int) -> np.ndarray:
    """With so many nodes where the interval lies, unless most of them are there or within 1 %."""
    width = interval.upper - interval.lower
    low, high = (
        max(interval.lower - 0.25 * width, nodes[0]),
        min(interval.upper + 0.25 * width, nodes[-1]),
    )
    inside = nodes[(nodes > low) & (nodes < high)]
    if len(inside) >= count - 2 or high - low < 0.01 * count:
        return nodes
    return np.unique(np.concatenate([nodes, np.linspace(low, high, count)]))
