"""The constants that a calibration may seek: names, ranges, when an interval tells one, sentences.

A constant is sought by a parameter: the logarithm of its value, the cosine of an angle, or a
potential over a tenth of the largest voltage, in which it changes what holds as fast as others do
in theirs.
"""

from __future__ import annotations

import math
from typing import Any, Dict, Mapping, Optional, Tuple

from mems_stiction.calibration_fit import Interval
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
UNITS = {WORK: "J/m^2", HAMAKER: "J", ANGLE: "rad", POTENTIAL: "V", FILM: "m"}
WIDEST_COSINES = (0.01, 1.0)
POTENTIAL_UNIT = 0.1  # of the largest voltage
WIDEST_POTENTIALS = 2.0  # over the largest voltage, and over the configured potential
TELLING = 2.0  # ends of an interval over the value: wider ones tell nothing
TELLING_WORK = 5.0  # the same of a work of adhesion: uncertainty/work_of_adhesion takes 5.1 at most
TELLING_COSINE = 0.6  # width of an interval of the angle's cosine
TELLING_POTENTIAL = 0.6  # width of an interval of the potential over the largest voltage
COARSE_NODES_SECOND, COARSE_NODES_OF_POTENTIAL = 7, 17
NORMAL_95 = 1.959964


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
    """One constant that is sought: its name, what of it is sought, its range.

    base: values of the settings by names. largest_voltage: of all measurements [V].
    """

    def __init__(self, name: str, base: Mapping[str, Any], largest_voltage: float = 0.0) -> None:
        self.name = name
        self.configured = configured(name, base)
        self.is_cosine = name == ANGLE
        self.is_signed = name == POTENTIAL
        self.largest_voltage = largest_voltage
        self.bounds: Tuple[float, float] = WIDEST_COSINES
        if self.is_signed:
            self.unit = POTENTIAL_UNIT * largest_voltage or 1.0
            reach = WIDEST_POTENTIALS * max(largest_voltage, abs(self.configured)) / self.unit
            self.bounds = -reach, reach
        elif not self.is_cosine:
            self.bounds = math.log(RANGE[name][0]), math.log(RANGE[name][1])

    @property
    def coarse_nodes(self) -> int:
        """Of a second constant, at first: a potential has a least force within its range."""
        return COARSE_NODES_OF_POTENTIAL if self.is_signed else COARSE_NODES_SECOND

    @property
    def is_free(self) -> bool:
        """Whether measurements alone tell it: others have optical spectra, too."""
        return self.is_cosine or self.is_signed

    def value(self, parameter: float) -> float:
        if self.is_signed:
            return float(parameter) * self.unit
        return math.acos(min(max(parameter, 0.0), 1.0)) if self.is_cosine else math.exp(parameter)

    def parameter(self, value: float) -> float:
        if self.is_signed:
            return value / self.unit
        return math.cos(value) if self.is_cosine else math.log(value)

    def tells(self, interval: Interval) -> bool:
        width = interval.upper - interval.lower
        if self.is_cosine:
            return width < TELLING_COSINE
        if self.is_signed:
            return interval.is_closed and width < TELLING_POTENTIAL / POTENTIAL_UNIT
        return interval.is_closed and width < 2.0 * math.log(
            TELLING_WORK if self.name == WORK else TELLING
        )

    def relative_uncertainty(self, parameter: float, interval: Interval) -> Optional[float]:
        """Relative standard deviation with this 95 % interval, as uncertainty/... take it: of a
        lognormal number. None where there is no such setting."""
        if self.is_cosine or self.name == FILM:
            return None
        deviation = (interval.upper - interval.lower) / (2.0 * NORMAL_95)
        if self.is_signed:
            return min(deviation / abs(parameter), 1.0) if parameter != 0.0 else 1.0
        return min(math.sqrt(math.expm1(deviation**2)), 1.0)

    def told(self, parameter: float, interval: Interval) -> str:
        best, low, high = map(self.value, (parameter, interval.lower, interval.upper))
        if self.is_cosine:
            return "the liquid's angle of contact is %s rad (%s to %s)" % (
                ratio(best),
                ratio(min(low, high)),
                ratio(max(low, high)),
            )
        return "the measurements tell the %s, too: %s" % (
            self._words(),
            with_interval(best, low, high, UNITS[self.name]),
        )

    def not_told(self) -> str:
        if self.is_cosine:
            return (
                "these humidities do not tell the liquid's angle of contact; it stays at %s rad as "
                "configured" % ratio(self.configured)
            )
        if self.is_signed:
            return "these %s do not tell the contact potential; %s" % (
                "voltages" if self.largest_voltage else "measurements at one voltage",
                self._stays(),
            )
        return "the measurements do not tell the %s apart from the work of adhesion; %s" % (
            self._words(),
            self._stays(),
        )

    def left(self) -> str:
        """Where another constant was fitted in its place."""
        return "the %s was not fitted beside it; %s" % (self._words(), self._stays())

    def _stays(self) -> str:
        if self.name == HAMAKER:
            return "it stays at %.3g J as configured" % self.configured
        return "it stays at %s as configured" % (
            "%s rad" % ratio(self.configured)
            if self.is_cosine
            else with_unit(self.configured, UNITS[self.name])
        )

    def _words(self) -> str:
        return {
            HAMAKER: "Hamaker constant",
            ANGLE: "liquid's angle of contact",
            POTENTIAL: "contact potential",
            FILM: "thickness of the films",
        }[self.name]
