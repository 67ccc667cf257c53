"""What every function on a pair of surfaces takes: heights, their counter-surface, settings."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Dict, Optional, Tuple

from mems_stiction import _core
from mems_stiction._arrays import Pitch, Surface, surface_of
from mems_stiction._scans import warn_about
from mems_stiction._settings import Config, Settings


def brings_pitch(heights: Any) -> bool:
    """Whether it says itself how far apart its pixels are: a file, a Scan, a topography."""
    return isinstance(heights, (str, os.PathLike)) or hasattr(heights, "heights")


def section_or_surface(upper: Any, settings: Dict[str, Any]) -> Any:
    """`upper` is a counter-surface, and a section of the settings; a dictionary is the latter, and goes there."""
    if not isinstance(upper, Mapping):
        return upper
    settings["upper"] = upper
    return None


def counter_of(upper: Any, surface: Surface, settings: Settings) -> Optional[_core.HeightMap]:
    """The counter-surface that was measured beside the scan, on its grid if it is an array; None if there is none."""
    if upper is None:
        return None
    return surface_of(upper, None if brings_pitch(upper) else surface.core.pitch, settings, "upper").core


def inputs_of(heights: Any, pitch: Optional[Pitch], config: Optional[Config], upper: Any,
              settings: Dict[str, Any]) -> Tuple[Settings, Surface, Optional[_core.HeightMap]]:
    """Settings, scan and counter-surface. Warns about a scan that does not look like one."""
    upper = section_or_surface(upper, settings)
    checked = Settings(config, **settings)
    surface = surface_of(heights, pitch, checked)
    warn_about(surface)
    return checked, surface, counter_of(upper, surface, checked)
