"""What every function on a pair of surfaces takes: heights, their counter-surface, settings."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Dict, Iterable, List, Optional, Tuple

from mems_stiction import _core
from mems_stiction._arrays import Pitch, Surface, is_data_array, pixels_of, surface_of
from mems_stiction._settings import Config, Settings, values_of
from mems_stiction._warnings import ScanWarning, warn


def brings_pitch(heights: Any) -> bool:
    """Whether it says itself how far apart its pixels are: a file, a Scan, a topography, an array
    with coordinates."""
    if is_data_array(heights):
        return "x" in heights.coords or "y" in heights.coords
    return isinstance(heights, (str, os.PathLike)) or hasattr(heights, "heights")


def warn_about(surface: Surface, texts: Iterable[str]) -> None:
    """What looks wrong in a scan, with the name of its file."""
    warn([(surface.name + ": " if surface.name else "") + text for text in texts], ScanWarning)


def odd_in(surface: Surface) -> List[str]:
    """What the programs warn about when they read such a scan, in words."""
    return list(surface.notes) + _core.scan_warnings(surface.core)


def scan_of(heights: Any, pitch: Optional[Pitch], settings: Settings) -> Surface:
    """A scan by itself, without a counter-surface. Warns about one that does not look like a
    scan."""
    surface = surface_of(heights, pitch, settings)
    warn_about(surface, odd_in(surface))
    return surface


def section_or_surface(upper: Any, settings: Dict[str, Any]) -> Any:
    """`upper` is a counter-surface, and a section of the settings; a dictionary is the latter, and
    goes there."""
    if not isinstance(upper, Mapping):
        return upper
    settings["upper"] = upper
    return None


def counter_of(upper: Any, surface: Surface, settings: Settings) -> Optional[_core.HeightMap]:
    """The counter-surface that was measured beside the scan; an array is on its grid, in its index
    order. None if there is none."""
    if upper is None:
        return None
    if brings_pitch(upper):
        counter = surface_of(upper, None, settings, "upper")
        warn_about(counter, counter.notes)
        return counter.core
    return surface_of(
        surface.back(pixels_of(upper, "upper")), surface.core.pitch, settings, "upper"
    ).core


def boundary_of(surface: Surface, settings: Settings) -> Settings:
    """What a topography says of itself goes before the settings: a periodic one has copies of it
    beyond its frame."""
    if not surface.is_periodic or values_of(settings)["half_space/boundary"] == "periodic":
        return settings
    warn_about(surface, ["the topography is periodic: half_space/boundary free does not count"])
    return Settings(settings, **{"half_space/boundary": "periodic"})


def inputs_of(
    heights: Any,
    pitch: Optional[Pitch],
    config: Optional[Config],
    upper: Any,
    settings: Dict[str, Any],
) -> Tuple[Settings, Surface, _core.PreparedScan]:
    """Settings, the scan, and it with its counter-surface, ready for the model. Warns about what
    does not look like a scan."""
    upper = section_or_surface(upper, settings)
    checked = Settings(config, **settings)
    surface = surface_of(heights, pitch, checked)
    checked = boundary_of(surface, checked)
    prepared = _core.prepare(
        surface.core, counter_of(upper, surface, checked), checked._configuration
    )
    warn_about(surface, list(surface.notes) + prepared.warnings)
    return checked, surface, prepared
