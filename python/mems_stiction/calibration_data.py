"""What a calibration is made from: measurements, each checked with its place in the list, and what a model expects them to be.

A measurement is a dictionary. The tables below have its keys; doc/process.md explains them.
"""

from __future__ import annotations

import contextlib
import math
import os
import warnings
from collections.abc import Mapping
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

import mems_stiction
from mems_stiction import _core
from mems_stiction._arrays import surface_of
from mems_stiction._device import _listed, _pitches_of, predict_device_under
from mems_stiction._settings import OptionsError, Settings, settings_with, values_of
from mems_stiction._warnings import ScanWarning, SettingsWarning
from mems_stiction.calibration_words import UNITS

BEAMS: Dict[str, Callable[..., float]] = {"detachment_length": _core.detachment_length, "crack_length": _core.crack_length}
COMMON = ("kind", "value", "uncertainty", "scans", "pitch", "upper", "area", "contacts", "relative_humidity", "mechanical_load", "name")
OF_FORCES = ("radius",)
OF_BEAMS = ("beam_type", "thickness", "gap", "modulus", "residual_stress")
FRAME_ALONE = {"device_force": {"enabled": False}, "half_space": {"enabled": False}}  # neither is looked at
NO_CLEANING = {"preprocessing": {
    "region": {"left": 0.0, "top": 0.0, "width": 0.0, "height": 0.0, "polygon_file": "", "mask_file": ""}, "offset": {"enabled": False},
    "lines": {"method": "none"}, "spikes": {"enabled": False}, "fill": {"enabled": False}, "tip": {"radius": 0.0, "half_angle": 0.0},
    "level": "none", "level_robust": False, "low_pass": {"cutoff_wavelength": 0.0}, "refine": {"factor": 1}}}
MOST_CONTACTS = 1000000  # as device/contacts has it
POSITIVE = ("value", "uncertainty", "area", "radius", "thickness", "gap", "modulus")

PROBE_PIXELS = 256
PROBE_DEPTH = 12e-9  # of a smooth probe's edge below its summit [m]: what lies deeper attracts little
PROBE_CONTACTS = 3.0  # half of a smooth probe's side over its contact radius by JKR, at least
PROBE_PLACES = 3  # on a scan, along each of its sides


class Measurement(NamedTuple):
    """One datum, checked. kind, value and uncertainty as given; what it was measured on is a Place."""

    name: str
    kind: str
    value: float
    uncertainty: float
    place: "Place"
    beam: Tuple[Any, ...]

    def expected(self, constants: Dict[str, float]) -> float:
        """The value by these constants [its unit]. Raises OptionsError and SurfaceError, which name the measurement."""
        with _named(self.name):
            figures = self.place.figures(constants)
        if self.kind == "pull_off_force":
            return figures.force
        return BEAMS[self.kind](*self.beam, figures.work) if self.beam else figures.work

    def prepare(self, constants: Sequence[Dict[str, float]]) -> None:
        """What expected() will be asked for. Raises as it does."""
        with _named(self.name):
            self.place.figures_of(constants)

    def scatter(self, constants: Dict[str, float]) -> float:
        """Standard deviation of ln value from one place of the surfaces to another [-]."""
        figures = self.place.figures_near(constants)
        return self._of_value(figures.force_scatter, figures.work_scatter)

    def common(self, constants: Dict[str, float]) -> float:
        """Standard deviation of ln value that is the same at all places of the surfaces: their scans are a sample [-]."""
        figures = self.place.figures_near(constants)
        return self._of_value(figures.force_common, figures.work_common)

    def _of_value(self, of_force: float, of_work: float) -> float:
        if self.kind == "pull_off_force":
            return of_force
        return of_work / (4.0 if self.beam else 1.0)  # lengths go with the fourth root


class Figures(NamedTuple):
    force: float  # [N]
    work: float  # per area [J/m^2]
    force_scatter: float  # of ln force, from place to place [-]
    work_scatter: float
    force_common: float = 0.0  # of ln force, at all places: other scans of the surfaces would give another [-]
    work_common: float = 0.0


class Place:
    """Surfaces that one or more measurements were made on, and what holds them by the constants of the interface."""

    def __init__(self, scans: List[Any], upper: Any, area: Optional[float], contacts: Optional[int], radius: Optional[float],
                 settings: Settings, surfaces: Any = None) -> None:
        self.scans, self.upper, self.area, self.contacts, self.radius, self.settings = scans, upper, area, contacts, radius, settings
        self.surfaces = surfaces  # the same for the same scans
        self._known: Dict[Tuple[Tuple[str, float], ...], Figures] = {}
        self._clean_scans: Optional[List[Any]] = None

    @property
    def humidity(self) -> float:
        return float(values_of(self.settings)["interface/relative_humidity"])

    def figures(self, constants: Dict[str, float]) -> Figures:
        return self.figures_of([constants])[0]

    def figures_of(self, constants: Sequence[Dict[str, float]]) -> List[Figures]:
        """Of each of several constants: together they take little longer than one, where surfaces are made."""
        keys = [tuple(sorted(one.items())) for one in constants]
        missing = {key: one for key, one in zip(keys, constants) if key not in self._known}
        if missing:
            with warnings.catch_warnings():
                if self._known:  # scans and area are the same each time
                    warnings.simplefilter("ignore", ScanWarning)
                warnings.simplefilter("ignore", SettingsWarning)
                found = self._find([Settings(self.settings, **one) for one in missing.values()])
            self._known.update(zip(missing, found))
        return [self._known[key] for key in keys]

    def figures_near(self, constants: Dict[str, float]) -> Figures:
        """For what hardly goes with the constants: of made surfaces those of the nearest that are known."""
        near = [key for key in self._known if {name for name, _ in key} == set(constants)]
        if self.area is None or not near:
            return self.figures(constants)
        return self._known[min(near, key=lambda key: sum(abs(value - constants[name]) / (abs(value) + abs(constants[name]) or 1.0) for name, value in key))]

    def fingerprint(self) -> str:
        """SHA-256 of the heights [m] as they are predicted, one after the other."""
        import hashlib

        digest = hashlib.sha256()
        for scan in self.scans:
            digest.update(np.ascontiguousarray(scan.heights, dtype=np.float64).tobytes())
            digest.update(np.array(scan.pitch, dtype=np.float64).tobytes())
        return digest.hexdigest()

    def _find(self, settings: List[Settings]) -> List[Figures]:
        if self.area is None:
            return [self._of_frame(one) for one in settings]
        return [_of_device(found) for found in predict_device_under(self.scans, self.area, self.contacts, settings, self.upper)]

    def _of_frame(self, settings: Settings) -> Figures:
        if self.radius is None:
            predictor = mems_stiction.Predictor(settings, **FRAME_ALONE)
            return _of_several([predictor.predict(scan, None, self.upper) for scan in self.scans])
        predictor = mems_stiction.Predictor(settings, **FRAME_ALONE, **NO_CLEANING)
        if not self.scans:
            heights, pitch = _probe_alone(self.radius, settings)
            return _of_several([predictor.predict(heights, pitch)])
        return _of_several([predictor.predict(scan, None, probe) for scan in self._cleaned() for probe in _probes_over(scan, self.radius)])

    def _cleaned(self) -> List[Any]:
        """The scans as their surface is predicted: cleaning would take a probe over them for its tilt and bow."""
        if self._clean_scans is None:
            self._clean_scans = [mems_stiction.clean(scan, None, self.settings) for scan in self.scans]
        return self._clean_scans


def _scatter(values: Any) -> float:
    positive = np.asarray(values)[np.asarray(values) > 0]
    if len(positive) < 2:
        return 0.0
    return float(np.std(np.log(positive), ddof=1) * math.sqrt(1.0 + 1.0 / len(positive)))


def _of_device(found: Any) -> Figures:
    """What the deviations of the device have beyond those of its realisations is common to all places."""
    force, work = _scatter(found.realisations.pull_off_force), _scatter(found.realisations.apparent_work_of_adhesion)
    return Figures(found.pull_off_force, found.apparent_work_of_adhesion, force, work, math.sqrt(max(found.force_deviation ** 2 - force ** 2, 0.0)),
                   math.sqrt(max(found._work_deviation ** 2 - work ** 2, 0.0)))


def _of_several(predictions: List[Any]) -> Figures:
    """The median place, and how places differ."""
    forces = np.array([prediction.pull_off_force for prediction in predictions])
    works = np.array([prediction.apparent_work_of_adhesion for prediction in predictions])
    return Figures(float(np.median(forces)), float(np.median(works)), _scatter(forces), _scatter(works))


def _probe_alone(radius: float, settings: Settings) -> Tuple[np.ndarray, float]:
    """A smooth paraboloid that meets a plane: heights [m], pitch [m]."""
    stated = values_of(settings)
    compliance = sum((1.0 - stated[body + "/poisson_ratio"] ** 2) / stated[body + "/youngs_modulus"] for body in ("lower", "upper"))
    contact_radius = (6.0 * math.pi * stated["interface/work_of_adhesion"] * radius ** 2 * compliance) ** (1.0 / 3.0)
    half = max(math.sqrt(2.0 * radius * PROBE_DEPTH), PROBE_CONTACTS * contact_radius)
    x = (np.arange(PROBE_PIXELS) + 0.5) / PROBE_PIXELS * 2.0 * half - half
    return -(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius), 2.0 * half / PROBE_PIXELS


def _probes_over(scan: Any, radius: float) -> List[np.ndarray]:
    """The probe, as it is mounted, over places of the scan: heights above its lowest point [m]."""
    rows, cols = scan.heights.shape
    places = (np.arange(PROBE_PLACES) + 1.0) / (PROBE_PLACES + 1.0)
    y = (np.arange(rows)[:, None] - places[None, :] * rows) * scan.pitch[1]
    x = (np.arange(cols)[:, None] - places[None, :] * cols) * scan.pitch[0]
    return [(y[:, [i]] ** 2 + x[:, j][None, :] ** 2) / (2.0 * radius) for i in range(PROBE_PLACES) for j in range(PROBE_PLACES)]


def measurements_of(given: Any, config: Any, settings: Dict[str, Any]) -> List[Measurement]:
    """Checked measurements; those with the same scans, area and surroundings share a Place. Raises OptionsError, SurfaceError."""
    if isinstance(given, Mapping) or not hasattr(given, "__iter__") or isinstance(given, (str, bytes)):
        raise OptionsError("measurements: %r is not allowed, must be a list of dictionaries" % (given,))
    listed = list(given)
    if not listed:
        raise OptionsError("measurements: an empty list is not allowed, must hold one measurement at least")
    base = Settings(config, **settings)
    places: Dict[Any, Place] = {}
    return [_measurement(datum, "measurements[%d]" % place, base, places) for place, datum in enumerate(listed)]


def _measurement(datum: Any, what: str, base: Settings, places: Dict[Any, Place]) -> Measurement:
    if not isinstance(datum, Mapping):
        raise OptionsError("%s: %r is not allowed, must be a dictionary" % (what, datum))
    kind = datum.get("kind")
    if not isinstance(kind, str) or kind not in UNITS:
        raise OptionsError("%s/kind: %s, must be one of %s" % (what, "is missing" if kind is None else "%r is not allowed" % (kind,), ", ".join(UNITS)))
    allowed = COMMON + (OF_FORCES if kind == "pull_off_force" else OF_BEAMS if kind in BEAMS else ())
    for key in datum:
        if key not in allowed:
            raise OptionsError("%s/%s: there is no such key for %s, must be one of %s" % (what, key, kind, ", ".join(allowed)))
    numbers = {key: _number(datum[key], "%s/%s" % (what, key), key) for key in datum
               if key in POSITIVE + ("relative_humidity", "mechanical_load", "residual_stress") and datum[key] is not None}
    required = ("value", "uncertainty") + (("thickness", "gap", "modulus") if kind in BEAMS else ())
    for key in required:
        if key not in numbers:
            raise OptionsError("%s/%s: is missing, must be a number > 0" % (what, key))
    return Measurement(str(datum.get("name") or what), kind, numbers["value"], numbers["uncertainty"],
                       _place(datum, numbers, what, base, places), _beam(datum, numbers, kind))


def _number(value: Any, what: str, key: str) -> float:
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        number = float(value)
    except (TypeError, ValueError):
        raise OptionsError("%s: %r is not allowed, must be a number" % (what, value)) from None
    if key in POSITIVE and not 0.0 < number < math.inf:
        raise OptionsError("%s: %r is not allowed, must be a number > 0" % (what, value))
    if not math.isfinite(number):
        raise OptionsError("%s: %r is not allowed, must be a finite number" % (what, value))
    return number


def _beam(datum: Mapping, numbers: Dict[str, float], kind: str) -> Tuple[Any, ...]:
    if kind not in BEAMS:
        return ()
    beam = (str(datum.get("beam_type") or "cantilever"), numbers["thickness"], numbers["gap"], numbers["modulus"],
            numbers.get("residual_stress", 0.0))
    BEAMS[kind](*beam, 1.0)  # refuses another type
    return beam


def _place(datum: Mapping, numbers: Dict[str, float], what: str, base: Settings, places: Dict[Any, Place]) -> Place:
    scans, upper, pitch = datum.get("scans"), datum.get("upper"), datum.get("pitch")
    radius = numbers.get("radius")
    if scans is None and radius is None:
        raise OptionsError("%s/scans: are missing, must be scans of the surface that it was measured on" % what)
    if radius is not None and (numbers.get("area") is not None or upper is not None):
        raise OptionsError("%s/radius: is not allowed with area or upper: the probe is the counter-surface" % what)
    contacts = _contacts(datum, "%s/contacts" % what)
    key = (_identity(scans), _identity(upper), _identity(pitch), numbers.get("area"), contacts, radius,
           numbers.get("relative_humidity"), numbers.get("mechanical_load"))
    if key not in places:
        stated = {"interface/relative_humidity": numbers.get("relative_humidity"), "load/mechanical_load": numbers.get("mechanical_load"),
                  "counter_surface/facing": "down" if radius is not None and scans is not None else None}
        with _named(str(datum.get("name") or what)):
            settings = settings_with(base, {}, {name: value for name, value in stated.items() if value is not None})
            surfaces = [] if scans is None else _surfaces_of(scans, pitch, settings, "scans")
            above = None if upper is None else _surfaces_of(upper, pitch, settings, "upper")
        if above is not None and numbers.get("area") is None:
            above = above[0]
        places[key] = Place(surfaces, above, numbers.get("area"), contacts, radius, settings, key[:3])
    return places[key]


@contextlib.contextmanager
def _named(name: str) -> Iterator[None]:
    """What is wrong with its scans or settings begins with the measurement's name."""
    try:
        yield
    except mems_stiction.Error as error:
        raise type(error)("%s: %s" % (name, error)) from None


def _contacts(datum: Mapping, what: str) -> Optional[int]:
    given = datum.get("contacts")
    if given is None:
        return None
    if datum.get("area") is None:
        raise OptionsError("%s: is not allowed without area, which they share" % what)
    if isinstance(given, bool) or not isinstance(given, (int, np.integer)) or not 1 <= given <= MOST_CONTACTS:
        raise OptionsError("%s: %r is not allowed, must be an integer in [1, %d]" % (what, given, MOST_CONTACTS))
    return int(given)


def _identity(given: Any) -> Any:
    """By which the same scans are known again: paths by their text, other things as objects."""
    if isinstance(given, (list, tuple)):
        return tuple(_identity(item) for item in given)
    return given if given is None or isinstance(given, (str, int, float)) else os.fspath(given) if isinstance(given, os.PathLike) else id(given)


def _surfaces_of(given: Any, pitch: Any, settings: Settings, what: str) -> List[Any]:
    """Each read once."""
    scans = _listed(given, what)
    names = [what if len(scans) == 1 else "%s[%d]" % (what, place) for place in range(len(scans))]
    return [mems_stiction.Scan(surface_of(scan, own, settings, name)) for scan, own, name in zip(scans, _pitches_of(pitch, scans), names)]
