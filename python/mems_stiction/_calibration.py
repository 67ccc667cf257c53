"""The constants of a process from what was measured on its parts: forces, beams, works, each with
the scans of its surfaces."""

from __future__ import annotations

import json
import math
import os
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from mems_stiction._arrays import ReadOnly, plain_value
from mems_stiction._settings import Config, OptionsError, Settings, values_of
from mems_stiction.calibration_constants import SECOND, WORK, Axis, configured, settings_of, word_of
from mems_stiction.calibration_data import Measurement, measurements_of
from mems_stiction.calibration_search import Found, Search
from mems_stiction.calibration_second import with_second
from mems_stiction.calibration_statements import (
    of_doubts,
    of_high_work,
    of_misfit,
    of_other_places,
    of_outliers,
    of_radii,
    of_units,
    open_end,
)
from mems_stiction.calibration_words import UNITS
from mems_stiction.other_packages import require_package
from mems_stiction.quantities import counted, with_interval, with_unit

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
            "Calibration by %s: work of adhesion %s"
            % (counted(len(self.measurements), "measurement"), self._work_text())
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
    found = Search(data, [Axis(WORK, values)], progress.step).run()
    found, statements = with_second(data, values, found, progress.step)
    progress.end()
    return _calibration(data, base, values, found, statements)


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


def _calibration(
    data: List[Measurement],
    base: Settings,
    values: Dict[str, Any],
    found: Found,
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
    fitted = {axis.name: axis.value(value) for axis, value in zip(found.axes, fit.parameters)}
    statements = (
        of_other_places(data)
        + of_outliers(data, found)
        + of_misfit(found)
        + of_doubts(data, fitted)
        + statements
    )
    is_told = found.axes[0].tells(found.intervals[0])
    least = fit.parameters[0] if is_told else found.intervals[0].lower
    statements[:0] = of_radii(data) + of_high_work(found, least)
    if not is_told:
        statements[:0] = [open_end(found)] + of_units(data, found)
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
