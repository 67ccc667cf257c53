"""What a calibration is made from: measurements, each checked with its place in the list, and what
a model expects them to be.

A measurement is a dictionary. The tables below have its keys; doc/process.md explains them.
"""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Mapping
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

import mems_stiction
from mems_stiction import _core
from mems_stiction._arrays import surface_of
from mems_stiction._device import _listed, _pitches_of, with_pitches
from mems_stiction._settings import OptionsError, Settings, settings_with, values_of
from mems_stiction.calibration_constants import POTENTIAL
from mems_stiction.calibration_places import Figures, Place, digest_of
from mems_stiction.calibration_words import UNITS

BEAMS: Dict[str, Callable[..., float]] = {
    "detachment_length": _core.detachment_length,
    "crack_length": _core.crack_length,
}
COMMON = (
    "kind",
    "value",
    "uncertainty",
    "scans",
    "pitch",
    "upper",
    "area",
    "contacts",
    "relative_humidity",
    "water_film",
    "voltage",
    "mechanical_load",
    "name",
)
OF_FORCES = ("radius",)
OF_BEAMS = ("beam_type", "thickness", "gap", "modulus", "residual_stress")
MOST_CONTACTS = 1000000  # as device/contacts has it
POSITIVE = ("value", "uncertainty", "area", "radius", "thickness", "gap", "modulus")
NUMBERS = (
    *POSITIVE,
    "relative_humidity",
    "water_film",
    "voltage",
    "mechanical_load",
    "residual_stress",
)

OF_OTHERS = 8  # degrees of freedom of what other places say of a place's scatter
FEWEST_REPEATED = 3  # values of one place, before it is asked whether it is one
FALSE_OTHERS = 0.05  # probability that values of one place are taken for those of several


class Measurement(NamedTuple):
    """One datum, checked. kind, value and uncertainty as given; what it was measured on is a
    Place."""

    name: str
    kind: str
    value: float
    uncertainty: float
    place: "Place"
    beam: Tuple[Any, ...]

    def expected(self, constants: Dict[str, float]) -> float:
        """The value by these constants [its unit]. Raises OptionsError and SurfaceError, which name
        the measurement."""
        with _named(self.name):
            return self._value(self.place.figures(constants))

    def expected_of_scan(self, constants: Dict[str, float]) -> float:
        """As expected(), by the place's first scan alone where surfaces are made: for slopes."""
        with _named(self.name):
            return self._value(self.place.figures_of_scan(constants))

    def _value(self, figures: Figures) -> float:
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
        """Standard deviation of ln value that is the same at all places of the surfaces: their
        scans are a sample [-]."""
        figures = self.place.figures_near(constants)
        return self._of_value(figures.force_common, figures.work_common)

    def _of_value(self, of_force: float, of_work: float) -> float:
        if self.kind == "pull_off_force":
            return of_force
        return of_work / (4.0 if self.beam else 1.0)  # lengths go with the fourth root


class _Reader:
    """Scans that are read once, and places that measurements share."""

    def __init__(self, base: Settings) -> None:
        self.base = base
        self.scans: Dict[Any, Any] = {}
        self.digests: Dict[int, str] = {}
        self.places: Dict[Any, Place] = {}
        self.settings: Dict[Any, Tuple[Settings, Dict[str, Any]]] = {}

    def settings_with(self, stated: Dict[str, Any]) -> Tuple[Settings, Dict[str, Any]]:
        """Settings, and their values by names."""
        key = tuple(stated.items())
        if key not in self.settings:
            settings = settings_with(self.base, {}, stated)
            self.settings[key] = settings, values_of(settings)
        return self.settings[key]

    def surfaces(self, given: Any, pitch: Any, settings: Settings, what: str) -> List[Any]:
        if isinstance(given, Mapping):
            given, pitch = with_pitches(given, pitch)
        scans = _listed(given, what)
        names = [
            what if len(scans) == 1 else "%s[%d]" % (what, place) for place in range(len(scans))
        ]
        return [
            self._scan(scan, own, settings, name)
            for scan, own, name in zip(scans, _pitches_of(pitch, scans), names)
        ]

    def _scan(self, given: Any, pitch: Any, settings: Settings, name: str) -> Any:
        key = _identity(given), _identity(pitch)
        if key not in self.scans:
            scan = mems_stiction.Scan(surface_of(given, pitch, settings, name))
            self.scans[key] = scan, given  # which keeps its id
        return self.scans[key][0]

    def digest(self, scan: Any) -> str:
        """Of a scan that surfaces() gave."""
        if id(scan) not in self.digests:
            self.digests[id(scan)] = digest_of(scan)
        return self.digests[id(scan)]


def measurements_of(given: Any, config: Any, settings: Dict[str, Any]) -> List[Measurement]:
    """Checked measurements; those with the same scans, area and surroundings share a Place. Raises
    OptionsError, SurfaceError."""
    if (
        isinstance(given, Mapping)
        or not hasattr(given, "__iter__")
        or isinstance(given, (str, bytes))
    ):
        raise OptionsError(
            "measurements: %r is not allowed, must be a list of dictionaries" % (given,)
        )
    listed = list(given)
    if not listed:
        raise OptionsError(
            "measurements: an empty list is not allowed, must hold one measurement at least"
        )
    reader = _Reader(Settings(config, **settings))
    data = [
        _measurement(datum, "measurements[%d]" % place, reader)
        for place, datum in enumerate(listed)
    ]
    _settle(data)
    return data


def shared_scans(data: Sequence[Measurement]) -> np.ndarray:
    """Correlation of what the scans leave open of each measurement's surfaces [-].

    Scans that differ are independent, the same scan is common: |A and B|/sqrt(|A| |B|) of the sets.
    """
    sets = [set(datum.place.digests) for datum in data]
    found = np.eye(len(data))
    for row, one in enumerate(sets):
        for col, other in enumerate(sets):
            if one and other:
                found[row, col] = len(one & other) / math.sqrt(len(one) * len(other))
    return found


def pooled(deviations: Sequence[float], data: Sequence[Measurement]) -> List[float]:
    """Standard deviations of measurements, each with what those of the other places say of it.

    Few realisations hardly tell how made surfaces scatter. All places where surfaces are made tell
    it
    together: the variance of each is averaged with their mean, which counts as OF_OTHERS degrees of
    freedom.
    """
    own: Dict[Any, List[float]] = {}
    for deviation, datum in zip(deviations, data):
        own.setdefault((datum.place.is_made, bool(datum.beam)), []).append(deviation**2)
    found = []
    for deviation, datum in zip(deviations, data):
        if datum.place.is_made:
            freedom = datum.place.realisations - 1
            mean = float(np.mean(own[True, bool(datum.beam)]))
            total = freedom * deviation**2 + OF_OTHERS * mean
            deviation = math.sqrt(total / (freedom + OF_OTHERS))
        found.append(deviation)
    return found


def _settle(data: Sequence[Measurement]) -> None:
    """What a place depends on the other measurements for."""
    if _differ_too_much(data):
        for datum in data:
            if datum.place.is_frame and datum.place.area is not None:
                datum.place.stand_for_others()
    places = list({id(datum.place): datum.place for datum in data}.values())
    made = sum(place.is_made for place in places)
    for place in places:
        values = sum(bool(set(datum.place.digests) & set(place.digests)) for datum in data)
        with _named(next(datum.name for datum in data if datum.place is place)):
            place.settle(values > 1, made)


def _differ_too_much(data: Sequence[Measurement]) -> bool:
    """Whether values on one scan's area are of several places: they differ by too much.

    The worst value of each place has no say, since one that does not belong is another matter. No
    constant is needed for this: all values of one place have one expectation.
    """
    import scipy.stats

    chi_square, freedom = 0.0, 0
    for place, kind in {(id(datum.place), datum.kind) for datum in data}:
        members = [datum for datum in data if (id(datum.place), datum.kind) == (place, kind)]
        shared = members[0].place
        if not shared.is_frame or shared.area is None or len(members) < FEWEST_REPEATED:
            continue
        logs = np.log([datum.value for datum in members])
        shares = np.array([datum.uncertainty / datum.value for datum in members])
        chosen = np.argsort(np.abs(logs - np.median(logs)) / shares)[:-1]
        weights = 1.0 / shares[chosen] ** 2
        mean = float(np.sum(weights * logs[chosen]) / np.sum(weights))
        chi_square += float(np.sum(weights * (logs[chosen] - mean) ** 2))
        freedom += len(chosen) - 1
    return freedom > 0 and float(scipy.stats.chi2.sf(chi_square, freedom)) < FALSE_OTHERS


def _measurement(datum: Any, what: str, reader: _Reader) -> Measurement:
    if not isinstance(datum, Mapping):
        raise OptionsError("%s: %r is not allowed, must be a dictionary" % (what, datum))
    kind = datum.get("kind")
    if not isinstance(kind, str) or kind not in UNITS:
        raise OptionsError(
            "%s/kind: %s, must be one of %s"
            % (
                what,
                "is missing" if kind is None else "%r is not allowed" % (kind,),
                ", ".join(UNITS),
            )
        )
    allowed = COMMON + (
        OF_FORCES if kind == "pull_off_force" else OF_BEAMS if kind in BEAMS else ()
    )
    for key in datum:
        if key not in allowed:
            raise OptionsError(
                "%s/%s: there is no such key for %s, must be one of %s"
                % (what, key, kind, ", ".join(allowed))
            )
    if not isinstance(datum.get("name") or "", str):
        # YAML makes 15 of 0017
        raise OptionsError(
            "%s/name: %r is not allowed, must be a text: quote it" % (what, datum["name"])
        )
    numbers = {
        key: _number(datum[key], "%s/%s" % (what, key), key)
        for key in datum
        if key in NUMBERS and datum[key] is not None
    }
    required = ("value", "uncertainty") + (("thickness", "gap", "modulus") if kind in BEAMS else ())
    for key in required:
        if key not in numbers:
            raise OptionsError("%s/%s: is missing, must be a number > 0" % (what, key))
    return Measurement(
        str(datum.get("name") or what),
        kind,
        numbers["value"],
        numbers["uncertainty"],
        _place(datum, numbers, what, reader),
        _beam(datum, numbers, kind),
    )


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
    beam = (
        str(datum.get("beam_type") or "cantilever"),
        numbers["thickness"],
        numbers["gap"],
        numbers["modulus"],
        numbers.get("residual_stress", 0.0),
    )
    BEAMS[kind](*beam, 1.0)  # refuses another type
    return beam


def _place(datum: Mapping, numbers: Dict[str, float], what: str, reader: _Reader) -> Place:
    scans, upper, pitch = datum.get("scans"), datum.get("upper"), datum.get("pitch")
    radius = numbers.get("radius")
    if scans is None and radius is None:
        raise OptionsError(
            "%s/scans: are missing, must be scans of the surface that it was measured on" % what
        )
    if radius is not None and (numbers.get("area") is not None or upper is not None):
        raise OptionsError(
            "%s/radius: is not allowed with area or upper: the probe is the counter-surface" % what
        )
    contacts = _contacts(datum, "%s/contacts" % what)
    stated = {
        "interface/relative_humidity": numbers.get("relative_humidity"),
        "interface/water_film": numbers.get("water_film"),
        POTENTIAL: _potential(numbers, reader),
        "load/mechanical_load": numbers.get("mechanical_load"),
        "counter_surface/facing": "down" if radius is not None and scans is not None else None,
    }
    area = numbers.get("area")
    with _named(str(datum.get("name") or what)):
        given = {name: value for name, value in stated.items() if value is not None}
        settings, values = reader.settings_with(given)
        surfaces = [] if scans is None else reader.surfaces(scans, pitch, settings, "scans")
        above = None if upper is None else reader.surfaces(upper, pitch, settings, "upper")
        digests = [reader.digest(scan) for scan in surfaces]
        key = (
            tuple(digests),
            tuple(map(reader.digest, above or ())),
            area,
            contacts,
            radius,
            tuple(given.items()),
        )
        if key not in reader.places:
            reader.places[key] = Place(
                surfaces,
                above,
                area,
                contacts,
                radius,
                settings,
                values,
                digests,
                numbers.get("voltage", 0.0),
            )
    return reader.places[key]


def _potential(numbers: Dict[str, float], reader: _Reader) -> Optional[float]:
    """Of a place whose voltage stays on while it is drawn apart, as the contact potential does."""
    if "voltage" not in numbers:
        return None
    return float(reader.settings_with({})[1][POTENTIAL]) + numbers["voltage"]


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
    if (
        isinstance(given, bool)
        or not isinstance(given, (int, np.integer))
        or not 1 <= given <= MOST_CONTACTS
    ):
        raise OptionsError(
            "%s: %r is not allowed, must be an integer in [1, %d]" % (what, given, MOST_CONTACTS)
        )
    return int(given)


def _identity(given: Any) -> Any:
    """By which the same scans are known again: paths by their text, other things as objects."""
    if isinstance(given, (list, tuple)):
        return tuple(_identity(item) for item in given)
    return (
        given
        if given is None or isinstance(given, (str, int, float))
        else os.fspath(given)
        if isinstance(given, os.PathLike)
        else id(given)
    )
