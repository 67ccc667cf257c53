"""What a sweep of a design is made of: its axes, checked, and the force that holds the device at
one of its points.

Stiffness and travel of the spring change what pulls, not what holds: they are left out of a point,
and its margins go with their product.
"""

from __future__ import annotations

import hashlib
import itertools
import math
import re
import warnings
from collections.abc import Mapping
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

import mems_stiction
from mems_stiction import _core
from mems_stiction._arrays import Surface
from mems_stiction._settings import OptionsError, Settings, values_of
from mems_stiction._warnings import SettingsWarning
from mems_stiction.design_axes import (
    AREA,
    BEAM,
    BY_RATIO,
    ETCH,
    OF_BOTH_BODIES,
    OF_THE_SPRING,
    OF_THE_SURFACE,
    POLISH,
    SCALE,
    STIFFNESS,
    TRAVEL,
    Axis,
    settings_named,
)

GAP, POTENTIAL = "device/electrode_gap", "load/contact_potential"
LOW_PASS, TIP = "preprocessing/low_pass/cutoff_wavelength", "preprocessing/tip/radius"
OF_BEAMS = (
    "device/beam_",
    "device/electrode_start",
    "device/electrode_length",
    "device/apparent_work_of_adhesion",
)  # settings that only the verdict on a beam reads
NO_EFFECT = " has no effect: "  # of a warning
MOST_AXES = 2
MOST_VALUES = 10000  # of an axis
MOST_WHOLE = 1e9  # that a setting counts
# A spring that opens whatever holds: the verdict on it tells whether anything but the margin stands
# against a "no".
SURE_SPRING: Dict[str, Any] = {
    STIFFNESS: 1e6,
    TRAVEL: 1e-2,
    BEAM: "none",
}  # the strongest that is taken: 10 kN


def sure_spring(values: Dict[str, Any]) -> Dict[str, Any]:
    """As settings, with the gap that the device leaves between its electrodes when it is closed.

    values: of the settings, by names.
    """
    if not float(values[GAP]) > 0.0:
        return SURE_SPRING
    left = float(values[GAP]) - float(values[TRAVEL])
    return dict(SURE_SPRING, **{GAP: SURE_SPRING[TRAVEL], TRAVEL: SURE_SPRING[TRAVEL] - left})


class Hold(NamedTuple):
    """What holds the device at a point, and how the margin spreads."""

    force: float  # [N]
    force_lower: float
    force_upper: float
    shares: Tuple[
        float, float, float
    ]  # margin_lower, margin_upper, margin_transition over the margin [-]
    doubt: str  # why the verdict is unknown whatever the spring; else empty
    is_bound: bool  # the surfaces bond, and hold at least so much

    def margins(self, restoring_force: float) -> Tuple[float, float, float, float]:
        """The margin, its 95 % interval, and what it is with the prefactors of the JKR-DMT
        transition [-]."""
        if self.force == 0.0:
            return (math.inf,) * 4
        margin = restoring_force / self.force
        return (margin,) + tuple(margin * share for share in self.shares)  # type: ignore[return-value]

    def word(self, restoring_force: float) -> str:
        """As the verdict has it: no, marginal, yes or unknown."""
        _, lower, upper, transition = self.margins(restoring_force)
        if upper < 1.0:
            return "yes"
        if self.is_bound or math.isnan(lower) or math.isnan(upper):
            return "unknown"
        if min(lower, transition) > 1.0:
            return "unknown" if self.doubt else "no"
        return "marginal"


Found = Tuple[Hold, Tuple[str, ...]]  # with warnings


def axes_of(given: Any, settings: Settings) -> List[Axis]:
    """One or two axes, the ends of each checked by themselves. Raises OptionsError."""
    if not isinstance(given, Mapping) or not 1 <= len(given) <= MOST_AXES:
        raise OptionsError(
            "axes: %s is not allowed, must be a dictionary with one or two names of settings, each "
            "with its values"
            % ("a dictionary of %d" % len(given) if isinstance(given, Mapping) else repr(given))
        )
    known = values_of(settings)
    comments = _comments_of(settings)
    axes = []
    for name in given:
        if isinstance(name, str) and name in known and name.startswith(OF_BEAMS):
            raise OptionsError(
                "axes: %s is not allowed: a sweep judges springs, not beams; call "
                "predict_device() for each design of a beam" % name
            )
    for name, values in given.items():
        setting = settings_named(name)[0] if isinstance(name, str) else name
        if name not in OF_THE_SURFACE and setting not in known:
            raise OptionsError(
                "axes: there is no setting '%s'%s; must be one of doc/parameters.md, or %s"
                % (name, _meant(name, settings), ", ".join([*OF_BOTH_BODIES, *OF_THE_SURFACE]))
            )
        if setting in known and (
            isinstance(known[setting], bool) or not isinstance(known[setting], (int, float))
        ):
            raise OptionsError("axes: %s is no number, and cannot be swept" % name)
        comment = comments.get(setting, "")
        unit = OF_THE_SURFACE.get(
            name, comment[1:].partition("]")[0] if comment.startswith("[") else ""
        )
        is_whole = "an integer" in comment
        axis = Axis(str(name), unit, _values(name, values, is_whole), is_whole)
        _check(axis, known, settings)
        axes.append(axis)
    return axes


def _meant(name: Any, settings: Settings) -> str:
    """ " (did you mean ...?)", by the reader of settings; empty where it knows none."""
    try:
        Settings(settings, **{str(name): 0.0})
    except OptionsError as error:
        found = re.search(r" \(did you mean [^)]*\)", str(error))
        return found.group() if found else ""
    return ""


def _values(name: str, given: Any, whole: bool) -> Tuple[float, ...]:
    wrong = "axes: %s: %r is not allowed, must be numbers: a list of them, or (from, to, count)" % (
        name,
        given,
    )
    if isinstance(given, (str, bytes)):
        raise OptionsError(wrong)
    try:
        numbers = [float(value) for value in (given if hasattr(given, "__iter__") else [given])]
    except (TypeError, ValueError):
        raise OptionsError(wrong) from None
    if not numbers or not all(map(math.isfinite, numbers)):
        raise OptionsError(wrong)
    if isinstance(given, tuple) and len(given) == 3:
        first, last, count = numbers[0], numbers[1], int(numbers[2])
        if not first < last or count != numbers[2] or not 2 <= count <= MOST_VALUES:
            raise OptionsError(
                "axes: %s: %r is not allowed, must be (from, to, count) with from < to and a count "
                "of 2 to %d; a list holds the values themselves" % (name, given, MOST_VALUES)
            )
        is_by_ratio = first > 0 and last >= BY_RATIO * first
        filled = (
            np.geomspace(first, last, count) if is_by_ratio else np.linspace(first, last, count)
        )
        numbers = [first, *(float("%.12g" % value) for value in filled[1:-1]), last]
    elif whole:
        for number in numbers:
            if number != round(number):
                raise OptionsError(
                    "axes: %s: %g is not allowed, must be whole numbers" % (name, number)
                )
    if len(numbers) > MOST_VALUES:
        raise OptionsError(
            "axes: %s: %d values are not allowed, at most %d" % (name, len(numbers), MOST_VALUES)
        )
    return tuple(sorted({float(round(number)) if whole else number for number in numbers}))


def _check(axis: Axis, known: Dict[str, Any], settings: Settings) -> None:
    if axis.name in OF_THE_SURFACE:
        if axis.values[0] < 0 or axis.values[0] == 0 and axis.name != POLISH:
            raise OptionsError(
                "axes: %s: %g is not allowed, must be %s 0"
                % (axis.name, axis.values[0], ">=" if axis.name == POLISH else ">")
            )
        if axis.name != POLISH and known[TIP] > 0:
            raise OptionsError(
                "axes: %s is not allowed with %s, which is not the tip's on changed heights; "
                "clean() the scans first" % (axis.name, TIP)
            )
        return
    if axis.name in OF_THE_SPRING + (AREA,) and axis.values[0] <= 0:
        raise OptionsError("axes: %s: %g is not allowed, must be > 0" % (axis.name, axis.values[0]))
    for value in (axis.values[0], axis.values[-1]):  # what lies between is allowed where they are
        Settings(settings, **{name: setting_value(value) for name in settings_named(axis.name)})


def settings_at(settings: Settings, point: Dict[str, float]) -> Settings:
    """Those of a point of the sweep."""
    stated = {
        name: setting_value(value)
        for axis, value in point.items()
        if axis not in OF_THE_SURFACE
        for name in settings_named(axis)
    }
    if point.get(POLISH):
        stated[LOW_PASS] = max(point[POLISH], float(values_of(settings)[LOW_PASS]))
    return Settings(settings, **stated)


def warnings_of(axes: List[Axis], settings: Settings) -> List[str]:
    """What looks wrong at an end of the axes. That a setting has no effect is said where it has
    none at any value of the other axes."""
    ends = [
        {axis.name: value for axis, value in zip(axes, values)}
        for values in itertools.product(*({axis.values[0], axis.values[-1]} for axis in axes))
    ]
    said = []
    for point in ends:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            settings_at(settings, point)
        said.append((point, [str(warning.message) for warning in told]))
    return list(
        dict.fromkeys(
            text
            for point, texts in said
            for text in texts
            if NO_EFFECT not in text
            or all(
                text in others
                for other, others in said
                if all(other[name] == point[name] for name in _axes_named(text, axes))
            )
        )
    )


def _axes_named(text: str, axes: List[Axis]) -> List[str]:
    """That state the setting that a warning begins with."""
    setting = text.partition(" ")[0]
    return [axis.name for axis in axes if setting in settings_named(axis.name)]


def setting_value(value: float) -> Any:
    """Settings that are whole numbers take no others."""
    return int(value) if value == round(value) and abs(value) < MOST_WHOLE else value


def _comments_of(settings: Settings) -> Dict[str, str]:
    """Of each setting: its unit in brackets, what it is, what is allowed."""
    section, comments = "", {}
    for line in settings.yaml().splitlines():
        name, _, comment = line.partition("  # ")
        if line.startswith(" "):
            comments["%s/%s" % (section, name.partition(":")[0].strip())] = comment
        else:
            section = line.partition(":")[0]
    return comments


class Holding:
    """A device by its scans and settings: what holds it at point after point. Goes to other
    processes."""

    def __init__(
        self,
        scans: List[Surface],
        upper: List[Surface],
        settings: Settings,
        etch_wavelength: Optional[float],
    ) -> None:
        self.scans = [mems_stiction.Scan(surface) for surface in scans]
        self.upper = [mems_stiction.Scan(surface) for surface in upper]
        self.settings, self.etch_wavelength = settings, etch_wavelength

    def fingerprint(self, axes: List[Axis]) -> str:
        """Of scans, settings and axes: sweeps with the same one have the same rows."""
        from mems_stiction.version import version

        digest = hashlib.sha256(
            repr((version(), axes, self.etch_wavelength)).encode() + self.settings.yaml().encode()
        )
        for scan in self.scans + [None] + self.upper:  # type: ignore[list-item,operator]
            if scan is None:
                digest.update(b"upper")
                continue
            digest.update(repr((scan.heights.shape, scan.pitch)).encode())
            digest.update(np.ascontiguousarray(scan.heights, dtype=np.float64).tobytes())
        return digest.hexdigest()[:16]

    def at(self, point: Dict[str, float]) -> Found:
        """point: values of all axes but those of the spring."""
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            warnings.simplefilter("ignore", SettingsWarning)  # said of the axes
            settings = settings_at(self.settings, point)
            values = values_of(settings)
            scans = [self._changed(scan, point) for scan in self.scans]
            found = mems_stiction.predict_device(
                scans, config=Settings(settings, **sure_spring(values)), upper=self.upper or None
            )
        verdict = found.verdict
        assert verdict is not None
        shares = tuple(
            value / verdict.margin
            for value in (verdict.margin_lower, verdict.margin_upper, verdict.margin_transition)
        )
        if values["device/electrode_area"] > 0 and values[POTENTIAL] != 0:
            # the device's own interval is of its surfaces alone
            ends = verdict.device_pull_off_force_lower, verdict.device_pull_off_force_upper
        else:
            ends = found.pull_off_force_lower, found.pull_off_force_upper
        is_unknown = verdict.sticks != "no"
        hold = Hold(
            verdict.device_pull_off_force,
            *ends,
            shares,  # type: ignore[arg-type]
            verdict.reason.partition("; but ")[2] or verdict.reason if is_unknown else "",
            is_unknown and not verdict.reason.startswith("margin "),
        )
        return hold, tuple(str(warning.message) for warning in told)

    def _changed(self, scan: Any, point: Dict[str, float]) -> Any:
        scale, etch = point.get(SCALE, 1.0), point.get(ETCH, 1.0)
        if scale == 1.0 and etch == 1.0:
            return scan
        heights = scan.heights
        if etch != 1.0:
            smooth = mems_stiction.clean(scan, None, {LOW_PASS: self.etch_wavelength}).heights
            heights = heights + (etch - 1.0) * (heights - smooth)
        pixels = np.array(scale * heights, dtype=np.float64, order="C")
        return mems_stiction.Scan(
            scan._surface._replace(
                core=_core.height_map(pixels, scan.pitch[0], scan.pitch[1], _core.Configuration())
            )
        )
