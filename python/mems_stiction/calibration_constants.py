"""The constants that a calibration may seek: names, ranges, when an interval tells one, sentences.

A constant is sought by a parameter: the logarithm of its value, the cosine of an angle, or a
potential over a tenth of the largest voltage, in which it changes what holds as fast as others do
in theirs.
"""

from __future__ import annotations

import math
from typing import Any, Dict, Mapping, Optional, Tuple

from mems_stiction.calibration_fit import Interval
from mems_stiction.confidence import NORMAL_95
from mems_stiction.quantities import ratio, with_interval, with_unit

WORK, HAMAKER, ANGLE, POTENTIAL, FILM = (
    "interface/work_of_adhesion",
    "interface/hamaker_constant",
    "interface/contact_angle",
    "load/contact_potential",
    "film_thickness",  # of each body that has a film
)
FILMS = ("lower/" + FILM, "upper/" + FILM)
SECOND = (POTENTIAL, ANGLE, FILM, HAMAKER)  # of which one is fitted beside the work of adhesion
RANGE = {WORK: (1e-4, 2.0), HAMAKER: (1e-21, 1e-18), FILM: (0.2e-9, 20e-9)}  # that is searched
UNITS = {HAMAKER: "J", POTENTIAL: "V", FILM: "m"}
WORDS = {
    HAMAKER: "Hamaker constant",
    ANGLE: "liquid's angle of contact",
    POTENTIAL: "contact potential",
    FILM: "thickness of the films",
}
WIDEST_COSINES = (0.01, 1.0)
POTENTIAL_UNIT = 0.1  # of the largest voltage
WIDEST_POTENTIALS = 2.0  # over the largest voltage, and over the configured potential
TELLING = 2.0  # ends of an interval over the value: wider ones tell nothing
TELLING_WORK = 5.0  # the same of a work of adhesion: uncertainty/work_of_adhesion takes 5.1 at most
TELLING_COSINE = 0.6  # width of an interval of the angle's cosine
TELLING_POTENTIAL = 0.6  # width of an interval of the potential over the largest voltage


def word_of(name: str) -> str:
    """By which results have it."""
    return name.rpartition("/")[2]


def configured(name: str, values: Mapping[str, Any]) -> float:
    """0 where there is none."""
    if name == FILM:
        return max(float(values[film]) for film in FILMS)
    return float(values[name])


def settings_of(
    constants: Mapping[str, float], values: Mapping[str, Any], voltage: float = 0.0
) -> Dict[str, float]:
    """As settings, of a place with these values, at a voltage that acts while it is drawn apart: so
    it adds to the contact potential."""
    stated = {name: value for name, value in constants.items() if name not in (POTENTIAL, FILM)}
    if POTENTIAL in constants:
        stated[POTENTIAL] = constants[POTENTIAL] + voltage
    if FILM in constants:
        stated.update({film: constants[FILM] for film in FILMS if float(values[film]) > 0.0})
    return stated


class Axis:
    """One constant that is sought, by the logarithm of its value.

    base: values of the settings by names.
    """

    coarse_nodes = 7  # of a second constant, at first
    is_free = False  # whether measurements alone tell it: others have optical spectra, too

    def __init__(self, name: str, base: Mapping[str, Any]) -> None:
        self.name = name
        self.configured = configured(name, base)

    @property
    def bounds(self) -> Tuple[float, float]:
        """Of its parameter, between which it is sought."""
        low, high = RANGE[self.name]
        return math.log(low), math.log(high)

    def value(self, parameter: float) -> float:
        return math.exp(parameter)

    def tells(self, interval: Interval) -> bool:
        """Whether this interval of its parameter is narrow enough to be an answer."""
        widest = TELLING_WORK if self.name == WORK else TELLING
        return interval.is_closed and interval.upper - interval.lower < 2.0 * math.log(widest)

    def relative_uncertainty(self, parameter: float, interval: Interval) -> Optional[float]:
        """Relative standard deviation with this 95 % interval, as uncertainty/... take it: of a
        lognormal number. None where there is no such setting."""
        if self.name == FILM:
            return None
        return min(math.sqrt(math.expm1(_deviation(interval) ** 2)), 1.0)

    def told(self, parameter: float, interval: Interval) -> str:
        best, low, high = map(self.value, (parameter, interval.lower, interval.upper))
        return "the measurements tell the %s, too: %s" % (
            WORDS[self.name],
            with_interval(best, low, high, UNITS[self.name]),
        )

    def not_told(self) -> str:
        return "the measurements do not tell the %s apart from the work of adhesion; %s" % (
            WORDS[self.name],
            self._stays(),
        )

    def left(self) -> str:
        """Where another constant was fitted in its place."""
        return "the %s was not fitted beside it; %s" % (WORDS[self.name], self._stays())

    def _stays(self) -> str:
        if self.name == HAMAKER:
            return "it stays at %.3g J as configured" % self.configured
        return "it stays at %s as configured" % with_unit(self.configured, UNITS[self.name])


class AngleAxis(Axis):
    """The liquid's angle of contact, by its cosine."""

    is_free = True

    def __init__(self, base: Mapping[str, Any]) -> None:
        super().__init__(ANGLE, base)

    @property
    def bounds(self) -> Tuple[float, float]:
        return WIDEST_COSINES

    def value(self, parameter: float) -> float:
        return math.acos(min(max(parameter, 0.0), 1.0))

    def tells(self, interval: Interval) -> bool:
        return interval.upper - interval.lower < TELLING_COSINE

    def relative_uncertainty(self, parameter: float, interval: Interval) -> Optional[float]:
        return None

    def told(self, parameter: float, interval: Interval) -> str:
        low, high = sorted(map(self.value, (interval.lower, interval.upper)))
        return "the liquid's angle of contact is %s rad (%s to %s)" % (
            ratio(self.value(parameter)),
            ratio(low),
            ratio(high),
        )

    def not_told(self) -> str:
        return "these humidities do not tell the liquid's angle of contact; %s" % self._stays()

    def _stays(self) -> str:
        return "it stays at %s rad as configured" % ratio(self.configured)


class PotentialAxis(Axis):
    """The contact potential, over a tenth of the largest voltage of all measurements [V]."""

    coarse_nodes = 17  # there is a least force within its range
    is_free = True

    def __init__(self, base: Mapping[str, Any], largest_voltage: float = 0.0) -> None:
        super().__init__(POTENTIAL, base)
        self.largest_voltage = largest_voltage
        self.unit = POTENTIAL_UNIT * largest_voltage or 1.0

    @property
    def bounds(self) -> Tuple[float, float]:
        reach = WIDEST_POTENTIALS * max(self.largest_voltage, abs(self.configured)) / self.unit
        return -reach, reach

    def value(self, parameter: float) -> float:
        return float(parameter) * self.unit

    def tells(self, interval: Interval) -> bool:
        width = interval.upper - interval.lower
        return interval.is_closed and width < TELLING_POTENTIAL / POTENTIAL_UNIT

    def relative_uncertainty(self, parameter: float, interval: Interval) -> Optional[float]:
        return min(_deviation(interval) / abs(parameter), 1.0) if parameter != 0.0 else 1.0

    def not_told(self) -> str:
        return "these %s do not tell the contact potential; %s" % (
            "voltages" if self.largest_voltage else "measurements at one voltage",
            self._stays(),
        )


def _deviation(interval: Interval) -> float:
    """Standard deviation of a parameter with this 95 % interval."""
    return (interval.upper - interval.lower) / (2.0 * NORMAL_95)
