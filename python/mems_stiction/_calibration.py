"""The constants of a process from what was measured on its parts: forces, beams, works, each with
the scans of its surfaces."""

from __future__ import annotations

import json
import math
import os
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from mems_stiction._arrays import ReadOnly, plain_value
from mems_stiction._settings import Config, OptionsError, Settings, values_of
from mems_stiction.other_packages import require_package
from mems_stiction.calibration_constants import (
    ANGLE,
    FILM,
    HAMAKER,
    NORMAL_95,
    POTENTIAL,
    RANGE,
    TELLING,
    WORK,
    Axis,
    configured,
    settings_of,
    word_of,
)
from mems_stiction.calibration_data import Measurement, measurements_of, pooled, shared_scans
from mems_stiction.calibration_fit import Fit, Interval, Likelihood
from mems_stiction.calibration_grid import between_nodes
from mems_stiction.calibration_words import UNITS
from mems_stiction.quantities import ratio, with_interval, with_unit

SECOND = (POTENTIAL, ANGLE, FILM, HAMAKER)  # of which one is fitted beside the work of adhesion
COARSE_NODES = 13
COARSE_NODES_MADE = 21  # more nodes at once cost less than surfaces that are made again
FINE_NODES = 9
FINE_NODES_MADE = 4
FINE_NODES_OF_TWO = 5  # where two constants are sought
REACH_AROUND = 2.0  # of ln work of adhesion, where a second constant is sought, too
MOST_REFINEMENTS = 3
STEPS_FOR_SLOPES = (1.0 / 1.15, 1.15)
DEPENDING = (
    2.0  # factor between what both ends of the range of a constant give: less hardly depends on it
)
FAR_OFF = 3.0  # factor from a measured value to the nearest one that the constants give
MOST_ASKED = 3  # values that are asked for their unit
FEWEST_FOR_SECOND = 3
LEAST_DEVIATION = 1e-3  # of a constant that is exact
MOST_WIDENING = 1.5  # of the interval of the work of adhesion, by a second constant
BETTER = 6.635  # of the deviance, by one constant more: chi^2 at 1 %

OnProgress = Callable[[float], None]


class Calibration(ReadOnly):
    """Constants that a process has, by measurements; NaN: they do not tell.

    work_of_adhesion, work_of_adhesion_lower, work_of_adhesion_upper: best fit and 95 % interval
    [J/m^2]. hamaker_constant, ..._lower, ..._upper [J], contact_angle, ... [rad],
    contact_potential, ... [V] and film_thickness, ... [m]: the same where the measurements tell;
    else the configured value, its ends NaN. The intervals are those of the measurements; the
    model's own error comes with each prediction.
    relative_uncertainty: of the work, as uncertainty/work_of_adhesion takes it.
    chi_square, degrees_of_freedom: of the misfit. scatter: share of the surfaces' stated scatter
    from place to place that the measurements show; NaN where none has any.
    measurements: a record of each: name, kind, value, uncertainty, fitted [its unit], deviation
    (standardised), is_outlier: it does not belong to the others, and was left out.
    statements: what the measurements tell and what they cannot. settings: Settings with the fitted
    constants.
    """

    work_of_adhesion: float
    work_of_adhesion_lower: float
    work_of_adhesion_upper: float
    hamaker_constant: float
    hamaker_constant_lower: float
    hamaker_constant_upper: float
    contact_angle: float
    contact_angle_lower: float
    contact_angle_upper: float
    contact_potential: float
    contact_potential_lower: float
    contact_potential_upper: float
    film_thickness: float
    film_thickness_lower: float
    film_thickness_upper: float
    relative_uncertainty: float
    chi_square: float
    degrees_of_freedom: int
    scatter: float
    measurements: np.recarray
    statements: Tuple[str, ...]
    settings: Settings
    version: str

    def __init__(self, figures: Dict[str, Any], fingerprints: Sequence[str]) -> None:
        from mems_stiction.version import version

        self.__dict__.update(figures, version=version())
        self._fingerprints = tuple(fingerprints)

    def to_dict(self) -> Dict[str, Any]:
        """What json() prints. None stands for what is not known."""
        names = [
            name
            for name in type(self).__annotations__
            if name not in ("measurements", "statements", "settings")
        ]
        record: Dict[str, Any] = {name: plain_value(getattr(self, name)) for name in names}
        record["measurements"] = [
            {name: plain_value(row[name]) for name in self.measurements.dtype.names}
            for row in self.measurements
        ]
        record["statements"] = list(self.statements)
        return record

    def json(self) -> str:
        """One line."""
        return json.dumps(self.to_dict())

    def yaml(self) -> str:
        """The settings with these constants, as every program takes them, with what they come from
        in comments.

        What the measurements do not tell stays as configured. Raises OptionsError where they tell
        nothing.
        """
        if not self.is_told:
            raise OptionsError(
                "calibration: %s; there is nothing to configure" % self.statements[0]
            )
        return "".join("# %s\n" % line for line in self._provenance()) + self.settings.yaml()

    @property
    def is_told(self) -> bool:
        """Whether the measurements tell one constant at least."""
        return not all(
            math.isnan(getattr(self, word_of(name) + "_lower")) for name in (WORK, *SECOND)
        )

    def _provenance(self) -> List[str]:
        lines = [
            "Calibrated by mems_stiction %s: work of adhesion %s"
            % (self.version, self._work_text())
        ]
        lines += list(self.statements)
        lines.append(
            "measurement, kind, value, standard uncertainty, fitted, deviation, scans (SHA-256 of "
            "their heights)"
        )
        for row, fingerprint in zip(self.measurements, self._fingerprints):
            lines.append(
                "%s, %s, %.6g, %.3g, %.6g, %.2f, %s%s"
                % (
                    row.name,
                    row.kind,
                    row.value,
                    row.uncertainty,
                    row.fitted,
                    row.deviation,
                    fingerprint,
                    ", left out" if row.is_outlier else "",
                )
            )
        return lines

    def _work_text(self) -> str:
        if math.isnan(self.work_of_adhesion):
            return "not known"
        return with_interval(
            self.work_of_adhesion, self.work_of_adhesion_lower, self.work_of_adhesion_upper, "J/m^2"
        )

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes yaml() to a file."""
        from mems_stiction.whole_file import whole

        text = self.yaml()
        with whole(path) as part:
            part.write_text(text, encoding="utf-8")

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG, PDF or SVG: measured against fitted values with their errors."""
        require_package("matplotlib", "a picture")
        from mems_stiction.calibration_figure import save_calibration

        save_calibration(self.to_dict(), path)

    picture = save_picture

    def __repr__(self) -> str:
        lines = [
            "Calibration by %d measurements: work of adhesion %s"
            % (len(self.measurements), self._work_text())
        ]
        lines += ["  " + statement for statement in self.statements]
        for row in self.measurements:
            lines.append(
                "  %s: %s %s, fitted %s, %+.1f standard deviations%s"
                % (
                    row.name,
                    row.kind,
                    with_unit(row.value, UNITS[row.kind]),
                    with_unit(row.fitted, UNITS[row.kind]),
                    row.deviation,
                    " (left out)" if row.is_outlier else "",
                )
            )
        return "\n".join(lines)


class _Surrogate:
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
        self._prepare([tuple(parameters) for parameters in grid.reshape(-1, len(nodes))])
        values = np.array(
            [self._at(tuple(parameters)) for parameters in grid.reshape(-1, len(nodes))]
        )
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


class _Found(NamedTuple):
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


class _Search:
    """Best constants of a list of axes."""

    def __init__(
        self, measurements: List[Measurement], axes: List[Axis], on_step: Callable[[], None]
    ) -> None:
        self.measurements, self.axes = measurements, axes
        self.surrogate = _Surrogate(measurements, axes, on_step)
        self.shared = shared_scans(measurements)

    def run(self, around: Optional[float] = None) -> "_Found":
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
        return _Found(self.axes, whole, likelihood, fit, intervals, outliers)

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


def calibrate(
    measurements: Sequence[Any],
    config: Optional[Config] = None,
    *,
    on_progress: Optional[OnProgress] = None,
    **settings: Any,
) -> Calibration:
    """Which work of adhesion has this process, by what was measured on its parts?

        found = mems_stiction.calibrate([
            {"kind": "pull_off_force", "value": 210e-9, "uncertainty": 40e-9, "scans":
            "dimple.gwy"},
            {"kind": "detachment_length", "value": 350e-6, "uncertainty": 30e-6, "scans": ["a.gwy",
            "b.gwy"], "area": 4e-9,
             "beam_type": "cantilever", "thickness": 2e-6, "gap": 2e-6, "modulus": 169e9}],
             config="process.yaml")
        found.work_of_adhesion, found.work_of_adhesion_lower, found.work_of_adhesion_upper

    measurements: dictionaries with
        kind: pull_off_force [N], apparent_work_of_adhesion [J/m^2], detachment_length [m] (the
        longest beam that comes off by
            itself) or crack_length [m] (the free arm of a stuck, S-shaped beam);
        value, uncertainty: as measured, and its standard uncertainty in the same unit;
        scans, pitch, upper: of the surfaces that it was measured on, as predict_device() takes
        them; area, contacts: of the contact [m^2], larger or smaller than the scans; without it,
        the scan itself is what touched;
        radius: of a tip or sphere [m] that was pulled off the scanned surface, or off a smooth
        plane without scans; beam_type (cantilever, doubly_clamped), thickness [m], gap [m], modulus
        [Pa], residual_stress [Pa]: of a beam; relative_humidity, water_film [m], mechanical_load
        [N], name: of this measurement; voltage [V], with its sign: on while the surfaces were drawn
        apart.
    config, settings: as of predict(): materials, cleaning, and the constants that are not sought.
    on_progress: called with the share of the work that is done; what it throws ends it.

    Maximum likelihood with profile intervals (doc/process.md). One constant more is fitted where
    the measurements tell it: the contact potential if they were made at several voltages, the angle
    of contact of the liquid if at several humidities, else the thickness of native films, or the
    Hamaker constant. Raises OptionsError and SurfaceError, which name the measurement.
    """
    base = Settings(config, **settings)
    data = measurements_of(measurements, base, {})
    values = values_of(base)
    progress = _Progress(on_progress, len({id(datum.place) for datum in data}))
    found = _Search(data, [Axis(WORK, values)], progress.step).run()
    found, statements = _with_second(data, values, found, progress.step)
    progress.end()
    return _calibration(data, base, values, found, statements)


def _keeps_work(both: _Found, found: _Found) -> bool:
    """Whether the work of adhesion stays told: beside a Hamaker constant or a film nearly as well.

    Optical spectra tell these, and nothing but measurements the angle of a liquid or a potential.
    """
    widths = [one.intervals[0].upper - one.intervals[0].lower for one in (both, found)]
    is_as_narrow = both.axes[1].is_free or widths[0] < MOST_WIDENING * widths[1]
    return both.axes[0].tells(both.intervals[0]) and is_as_narrow


def _fits_better(both: _Found, found: _Found) -> bool:
    """Whether measurements contradict the second constant as configured: a misfit, which it
    mends."""
    is_misfit = found.fit.widening > 1.0 and both.outliers == found.outliers
    return is_misfit and found.fit.deviance - both.fit.deviance > BETTER


class _Progress:
    """A share that only grows, of work whose end is not known before."""

    def __init__(self, on_progress: Optional[OnProgress], places: int) -> None:
        self.on_progress, self.places, self.steps = on_progress, places, 0

    def step(self) -> None:
        self.steps += 1
        if self.on_progress is not None:
            self.on_progress(
                1.0 - 1.0 / (1.0 + self.steps / self.places)
            )  # a half after the first look at all of them

    def end(self) -> None:
        if self.on_progress is not None:
            self.on_progress(1.0)


def _with_second(
    data: List[Measurement], values: Dict[str, Any], found: _Found, on_step: Callable[[], None]
) -> Tuple[_Found, List[str]]:
    """With a second constant where the measurements tell one, and a sentence about each that they
    may tell."""
    around = float(found.fit.parameters[0]) if found.axes[0].tells(found.intervals[0]) else None
    first, statements = found, []
    for axis, may_be_told in _second_axes(data, values, found):
        if len(found.axes) > 1:
            statements.append(axis.left())
            continue
        both = _Search(data, first.axes + [axis], on_step).run(around) if may_be_told else first
        # a second constant must not cost the work of adhesion, unless its configured value is wrong
        if (
            may_be_told
            and axis.tells(both.intervals[1])
            and (around is None or _keeps_work(both, first) or _fits_better(both, first))
        ):
            found = both
            statements.append(axis.told(both.fit.parameters[1], both.intervals[1]))
        else:
            statements.append(axis.not_told())
    return found, statements


def _second_axes(
    data: List[Measurement], values: Dict[str, Any], found: _Found
) -> List[Tuple[Axis, bool]]:
    """Constants that measurements of this kind may tell, the first choice first; whether these
    measurements are worth a search for it."""
    voltages = [datum.place.voltage for datum in data]
    axes = []
    if len(set(voltages)) > 1:
        axes.append((Axis(POTENTIAL, values, max(map(abs, voltages))), True))
    elif configured(POTENTIAL, values) != 0.0:
        axes.append((Axis(POTENTIAL, values), False))
    if len({datum.place.humidity for datum in data}) > 1:
        axes.append((Axis(ANGLE, values), True))
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
    found: _Found,
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


def _calibration(
    data: List[Measurement],
    base: Settings,
    values: Dict[str, Any],
    found: _Found,
    statements: List[str],
) -> Calibration:
    fit = found.fit
    has_places = (found.likelihood.places > 0).any()
    figures: Dict[str, Any] = {
        "chi_square": fit.chi_square,
        "degrees_of_freedom": max(len(fit.values) - len(found.axes), 0),
        "scatter": fit.scatter if has_places else math.nan,
    }
    for name in SECOND:
        word = word_of(name)
        figures.update(
            {word: configured(name, values), word + "_lower": math.nan, word + "_upper": math.nan}
        )
    constants: Dict[str, float] = {}
    for axis, parameter, interval in zip(found.axes, fit.parameters, found.intervals):
        word = word_of(axis.name)
        ends = sorted(axis.value(end) for end in (interval.lower, interval.upper))
        figures.update(
            {word: axis.value(parameter), word + "_lower": ends[0], word + "_upper": ends[1]}
        )
        constants.update(settings_of({axis.name: axis.value(parameter)}, values))
        relative = axis.relative_uncertainty(parameter, interval)
        if relative is not None:
            constants["uncertainty/" + word] = relative
    statements = _of_other_places(data) + _of_outliers(data, found) + _of_misfit(found) + statements
    if not found.axes[0].tells(found.intervals[0]):
        statements[:0] = [_open_end(found)] + _of_units(data, found)
        figures.update(
            work_of_adhesion=math.nan,
            work_of_adhesion_lower=math.nan,
            work_of_adhesion_upper=math.nan,
        )
        constants = {
            name: value
            for name, value in constants.items()
            if not name.endswith("/work_of_adhesion")
        }
        if constants:
            stays = with_unit(found.axes[0].configured, "J/m^2")
            statements.insert(1, "the work of adhesion stays at %s as configured" % stays)
    rows = [
        (
            datum.name,
            datum.kind,
            datum.value,
            datum.uncertainty,
            float(value),
            float(deviation),
            place in found.outliers,
        )
        for place, (datum, value, deviation) in enumerate(
            zip(data, found.whole.model(fit.parameters), found.deviations())
        )
    ]
    table = np.rec.fromrecords(
        rows,
        dtype=[
            ("name", object),
            ("kind", object),
            ("value", float),
            ("uncertainty", float),
            ("fitted", float),
            ("deviation", float),
            ("is_outlier", bool),
        ],
    )
    figures.update(
        relative_uncertainty=constants.get("uncertainty/work_of_adhesion", math.nan),
        measurements=table,
        statements=tuple(statements),
        settings=Settings(base, **constants),
    )
    return Calibration(figures, [datum.place.fingerprint() for datum in data])


def _of_other_places(data: List[Measurement]) -> List[str]:
    """Of values on one scan that are not of its place alone."""
    if not any(datum.place.stands_for_others for datum in data):
        return []
    return [
        "values on one scan's area differ by more than their uncertainties say: they were taken "
        "for other places of the surface"
    ]


def _of_outliers(data: List[Measurement], found: _Found) -> List[str]:
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


def _open_end(found: _Found) -> str:
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


def _of_units(data: List[Measurement], found: _Found) -> List[str]:
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


def _of_misfit(found: _Found) -> List[str]:
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
