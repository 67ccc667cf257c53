"""The force of a whole device, from all scans of its surfaces."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import (
    Pitch,
    ReadOnly,
    Surface,
    array_of,
    copied,
    explained,
    records_of,
    surface_of,
)
from mems_stiction._inputs import brings_pitch, section_or_surface
from mems_stiction._prediction import Verdict
from mems_stiction._settings import Config, Settings, SurfaceError, settings_with
from mems_stiction._types import Scans, UpperScans
from mems_stiction._warnings import ScanWarning, warn
from mems_stiction.other_packages import require_package
from mems_stiction.quantities import area as area_text
from mems_stiction.quantities import counted, with_interval, with_unit

Pitches = Union[Pitch, Sequence[Optional[Pitch]]]


@explained
class DeviceForce(_core.DeviceForceFigures, ReadOnly):
    """What holds a device, by all scans of its surfaces; NaN: not known.

    realisations: a record for each made surface: pull_off_force [N], apparent_work_of_adhesion
    [J/m^2], contacts, separation_at_rest [m]. parts_of_scans: area [m^2] and pull_off_force [N] of
    what was measured. spectrum: a record for each band of waves: wavelength [m], density,
    density_lower, density_upper [m^4], rms_height [m], rms_slope, rms_curvature [1/m], is_measured.
    verdict: a Verdict, or None where the settings state no spring and no beam. scans: their names.
    pitches: (along columns, along rows) of each [m], as it was taken.
    warnings: about scans, settings, and what the scans do not show.
    """

    def __init__(self, core: _core.DevicePrediction, scans: List[Surface]) -> None:
        self.__dict__.update(core.figures)
        verdict = core.verdict
        self.verdict: Optional[Verdict]
        self.scans: Tuple[str, ...]
        self.pitches: Tuple[Tuple[float, float], ...]
        self.warnings: Tuple[str, ...]
        self.realisations: np.recarray
        self.parts_of_scans: np.recarray
        self.spectrum: np.recarray
        self.__dict__.update(
            verdict=None if verdict is None else Verdict(verdict),
            scans=tuple(core.scans),
            pitches=tuple(tuple(scan.core.pitch) for scan in scans),
            warnings=tuple(core.warnings),
            realisations=records_of(core.realisations),
            parts_of_scans=records_of(core.parts_of_scans),
            spectrum=records_of(core.spectrum),
        )
        surface = core.made_surface
        self._made_surface = (
            None
            if surface.pixels is None
            else (np.array(array_of(surface.pixels)), surface.pitch[0])
        )
        self._json = core.json()
        self._work_deviation = core.work_deviation  # as force_deviation; of ln work

    def json(self) -> str:
        """The record that predict_device --json prints, one line."""
        return self._json

    def to_dict(self) -> Dict[str, Any]:
        """The same as a dictionary. None stands for what is not finite."""
        return json.loads(self._json)

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG, PDF or SVG: the spectrum with its 95 % range, roughness against scale, a made
        surface, force against area."""
        require_package("matplotlib", "a picture")
        from mems_stiction import device_figure

        device_figure.save_device(self.to_dict(), path, self._made_surface)

    picture = save_picture

    def __getstate__(self) -> Dict[str, Any]:
        return {name: copied(value) for name, value in self.__dict__.items()}

    def __repr__(self) -> str:
        lines = ["Device of %s, by %s" % (area_text(self.area), counted(len(self.scans), "scan"))]
        lines += [
            "  %s: pixels of %s" % (name or "scan %d" % (place + 1), _pitch_text(pitch))
            for place, (name, pitch) in enumerate(zip(self.scans, self.pitches))
        ]
        lines.append(
            "  pull-off force %s; the scans' force by area would say %s"
            % (
                with_interval(
                    self.pull_off_force, self.pull_off_force_lower, self.pull_off_force_upper, "N"
                ),
                with_unit(self.linear_pull_off_force, "N", 2),
            )
        )
        lines.append(
            "  apparent work of adhesion %s; held at %s"
            % (
                with_interval(
                    self.apparent_work_of_adhesion,
                    self.apparent_work_of_adhesion_lower,
                    self.apparent_work_of_adhesion_upper,
                    "J/m^2",
                ),
                counted(round(self.contacts), "place"),
            )
        )
        if self.verdict is not None:
            lines.append("  sticks: %s" % self.verdict.summary)
        lines += ["  warning: " + text for text in self.warnings]
        return "\n".join(lines)


def _pitch_text(pitch: Tuple[float, float]) -> str:
    x, y = (with_unit(value, "m") for value in pitch)
    return x if x == y else "%s x %s" % (x, y)


def _is_one(scans: Any) -> bool:
    """Whether it is one scan, not several: rows of numbers are one."""
    if isinstance(scans, Surface) or brings_pitch(scans):
        return True
    if isinstance(scans, np.ndarray):
        return scans.ndim != 3 and scans.dtype.kind != "O"
    if not isinstance(scans, (list, tuple)):
        return not hasattr(scans, "__iter__")
    first = scans[0] if len(scans) else None
    return not brings_pitch(first) and np.ndim(first) < 2 and len(scans) > 0


def _listed(scans: Any, what: str) -> List[Any]:
    listed = [scans] if _is_one(scans) else list(scans)
    if not listed:
        raise SurfaceError("%s: an empty list is not allowed, must hold one scan at least" % what)
    return listed


def _is_number(pitch: Any) -> bool:
    """Or nothing; what is neither a number nor a list is refused as one of these."""
    if isinstance(pitch, np.ndarray):
        return pitch.ndim == 0
    return isinstance(pitch, (str, bytes)) or not hasattr(pitch, "__len__")


def _is_pair(pitch: Any, count: int) -> bool:
    """Whether two numbers are one pitch (x, y), and not that of each of two scans, which is a
    list."""
    return (
        len(pitch) == 2
        and all(_is_number(value) for value in pitch)
        and (not isinstance(pitch, list) or count == 1)
    )


def _pitches_of(pitch: Any, scans: List[Any]) -> List[Optional[Pitch]]:
    """One for each scan; None where it brings its own."""
    if _is_number(pitch) or _is_pair(pitch, len(scans)):
        all_bring = all(isinstance(scan, (str, os.PathLike)) for scan in scans)
        return [pitch if all_bring or not brings_pitch(scan) else None for scan in scans]
    if len(pitch) != len(scans):
        raise SurfaceError(
            "pitch: %d are given for %s; must be one, or one for each; a pair (x, y) of all is a "
            "tuple" % (len(pitch), counted(len(scans), "scan"))
        )
    return [value if _is_number(value) else tuple(value) for value in pitch]


def with_pitches(
    scans: Mapping, pitch: Optional[Pitches]
) -> Tuple[List[Any], List[Optional[Pitch]]]:
    """Paths and pitches of {path: pitch}."""
    if pitch is not None:
        raise SurfaceError(
            "pitch: %r is given, but scans is a dictionary with that of each; leave it out"
            % (pitch,)
        )
    return list(scans), list(scans.values())


def _surfaces(
    scans: List[Any], pitches: List[Optional[Pitch]], settings: Settings, what: str
) -> List[Surface]:
    return [
        surface_of(scan, pitch, settings, what if len(scans) == 1 else "%s[%d]" % (what, place))
        for place, (scan, pitch) in enumerate(zip(scans, pitches))
    ]


def scans_of_device(
    scans: Any,
    area: Optional[float],
    pitch: Optional[Pitches],
    contacts: Optional[int],
    config: Optional[Config],
    upper: Any,
    settings: Dict[str, Any],
    stated: Dict[str, Any],
) -> Tuple[List[Surface], List[Surface], Settings]:
    """Scans of the lower surface, those of the upper one, and the settings with what goes before
    them unless it is None."""
    upper = section_or_surface(upper, settings)
    stated = dict(
        stated,
        **{"device/contact_area": area, "device/contacts": contacts, "device_force/enabled": True},
    )
    checked = settings_with(
        config, settings, {name: value for name, value in stated.items() if value is not None}
    )
    if isinstance(scans, Mapping):
        scans, pitch = with_pitches(scans, pitch)
    lower = _listed(scans, "scans")
    surfaces = _surfaces(lower, _pitches_of(pitch, lower), checked, "scans")
    if upper is None:
        return surfaces, [], checked
    above = _listed(upper, "upper")
    common = pitch if _is_number(pitch) or _is_pair(pitch, len(lower)) else None
    return surfaces, _surfaces(above, _pitches_of(common, above), checked, "upper"), checked


def core_scans(surfaces: List[Surface]) -> List[_core.DeviceScan]:
    return [
        _core.DeviceScan(surface.name, surface.core, list(surface.notes), surface.identity)
        for surface in surfaces
    ]


def predict_device_under(
    scans: Any, area: float, contacts: Optional[int], settings: List[Settings], upper: Any = None
) -> List[DeviceForce]:
    """What predict_device() says under each of several settings that differ in their constants
    alone, without verdicts: force, work and realisations are the same to the last bit. The surfaces
    are made once, which is most of the work. Other arguments as there."""
    lower, above, checked = scans_of_device(scans, area, None, contacts, settings[0], upper, {}, {})
    predicted = _core.predict_device_under(
        core_scans(lower),
        core_scans(above),
        checked._configuration,
        [one._configuration for one in settings],
    )
    warn(list(predicted[0].scan_warnings) + list(predicted[0].force_warnings), ScanWarning)
    return [DeviceForce(one, lower) for one in predicted]


def predict_device(
    scans: Scans,
    pitch: Optional[Pitches] = None,
    config: Optional[Config] = None,
    *,
    area: Optional[float] = None,
    contacts: Optional[int] = None,
    upper: Optional[UpperScans] = None,
    **settings: Any,
) -> DeviceForce:
    """Which force holds a device of this area, larger or smaller than the scans of its surface?

        predict_device(["afm_1.gwy", "afm_2.gwy", "wide.gwy"], area=1e-8,
        config="part.yaml").pull_off_force

    scans: whatever predict() takes (arrays, topographies, Scans, paths), one or a list, of any
    pitch, size and instrument; or a dictionary {path: pitch}.
    pitch: of the scans that bring none [m]: a number, a pair (x, y), or a list of them with one for
    each scan; in a list None stands for the scan's own.
    area: nominal, of all contacts together [m^2]; None: device/contact_area. contacts: that share
    it; None: device/contacts, which is 1 unless stated.
    upper: scans of the surface that meets it, in the same forms, in place of the configured
    counter-surface; counter_surface/facing must say which way they face.
    config, settings: as of predict(); device_force/... say how many surfaces are made and how
    large.

    The interpreter's lock is released; Ctrl-C stops it. Raises OptionsError, SurfaceError and
    FileError, which name the scan.
    """
    lower, above, checked = scans_of_device(
        scans, area, pitch, contacts, config, upper, settings, {}
    )
    predicted = _core.predict_device(core_scans(lower), core_scans(above), checked._configuration)
    warn(list(predicted.scan_warnings) + list(predicted.force_warnings), ScanWarning)
    return DeviceForce(predicted, lower)
