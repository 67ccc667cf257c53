"""Scans: from files, cleaned, and their roughness."""

from __future__ import annotations

import operator
import os
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import (
    Pitch,
    ReadOnly,
    Surface,
    array_of,
    explained,
    name_of,
    pitch_of,
    pixels_of,
)
from mems_stiction._inputs import odd_in, scan_of, warn_about
from mems_stiction._settings import Config, Settings, SurfaceError, changed_lines
from mems_stiction._types import Heights
from mems_stiction._warnings import ScanWarning, SettingsWarning, warn
from mems_stiction.quantities import with_unit

NOT_CLEANED = (
    "preprocessing has no effect: roughness() takes the heights as they are, and clean() cleans "
    "them"
)


@explained
class Scan(_core.ScanIdentityFigures):
    """Heights in metres with their pitch; every function of this package takes it in place of an
    array.

    heights: rows x columns [m], read-only, NaN where nothing was measured; row 0 is the top,
    columns go along x.
    pitch: (along columns, along rows) [m]. physical_sizes: (width, height) [m]. unit: always "m".
    channel: which of the file's; empty where it has one only. notes: what to know of how the file
    was read. warnings: these, and what does not look like a scan, as the programs say it. The other
    attributes are what the file and its sidecar state; empty or NaN where they do not.
    """

    unit = "m"

    def __init__(self, surface: Surface, channel: str = "") -> None:
        self._surface = surface
        self.channel = channel
        self.__dict__.update(surface.identity.figures)

    @property
    def notes(self) -> Tuple[str, ...]:
        return self._surface.notes

    @property
    def warnings(self) -> Tuple[str, ...]:
        return tuple(odd_in(self._surface))

    @property
    def heights(self) -> np.ndarray:
        heights = array_of(self._surface.core.pixels)
        assert heights is not None
        return self._surface.back(heights)

    @property
    def pitch(self) -> Tuple[float, float]:
        return self._surface.core.pitch

    @property
    def physical_sizes(self) -> Tuple[float, float]:
        heights = array_of(self._surface.core.pixels)
        assert heights is not None
        return heights.shape[1] * self.pitch[0], heights.shape[0] * self.pitch[1]

    def topography(self) -> Any:
        """The same for SurfaceTopography, whose first index is x; needs that package."""
        from SurfaceTopography import Topography

        heights = array_of(self._surface.core.pixels)
        assert heights is not None
        return Topography(
            np.ma.masked_invalid(heights.T) if np.isnan(heights).any() else heights.T,
            self.physical_sizes,
            periodic=self._surface.is_periodic,
            unit="m",
        )

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> np.ndarray:
        return (
            np.array(self.heights, dtype=dtype) if copy else np.asarray(self.heights, dtype=dtype)
        )

    def __repr__(self) -> str:
        rows, columns = self.heights.shape
        width, height = self.physical_sizes
        name = " of %s" % self._surface.name if self._surface.name else ""
        return "%s%s: %d x %d pixels, %s x %s%s" % (
            type(self).__name__,
            name,
            rows,
            columns,
            with_unit(width, "m"),
            with_unit(height, "m"),
            ", " + self.channel if self.channel else "",
        )

    def __reduce__(self) -> Any:
        return _scan_of, (
            type(self),
            np.array(array_of(self._surface.core.pixels)),
            self.pitch,
            self._surface[1:],
            self.__getstate__(),
        )

    def __getstate__(self) -> Dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_surface"}


def _scan_of(
    kind: Any, heights: np.ndarray, pitch: Tuple[float, float], rest: Any, state: Dict[str, Any]
) -> Scan:
    scan = kind.__new__(kind)
    scan.__dict__.update(state)
    # pickled elsewhere than in a file (Dask), pixels may lie at odd addresses
    scan._surface = Surface(
        _core.height_map(pixels_of(heights), pitch[0], pitch[1], _core.Configuration()), *rest
    )
    return scan


class Cleaned(Scan):
    """A scan after its cleaning.

    steps: what each step did, in order: step, parameters, rms_change [m], changed_pixels,
    invalid_pixels.
    """

    steps: List[Dict[str, Any]]


@explained
class Roughness(_core.RoughnessFigures, ReadOnly):
    """Roughness of ISO 25178-2 over the valid pixels; the caller levels. Figures from sal on are
    NaN unless asked for."""

    def __init__(self, figures: Dict[Any, float]) -> None:
        self.__dict__.update(figures)

    def __repr__(self) -> Any:
        declared = _core.figures["RoughnessFigures"]
        return "Roughness(%s)" % ", ".join(
            "%s=%.4g%s" % (name, value, " " + declared[name][1] if declared[name][1] else "")
            for name, value in self.__dict__.items()
            if not np.isnan(value)
        )


def read(
    path: Union[str, "os.PathLike[str]"],
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    *,
    channel: str = "",
    ignore_mask: bool = False,
    **settings: Any,
) -> Scan:
    """A scan from a file of any kind that predict_scan reads (doc/scans.md lists them).

    pitch: distance of pixels [m], a number or (x, y); goes before what the file says. Settings
    scan/... serve where a file states nothing. channel: title or number, of a file with several;
    the likeliest heights if empty. channels() lists them. ignore_mask: pixels under the mask of a
    .gwy file are heights as the others.
    Raises FileError in one line with file and cause, OptionsError for a bad sidecar. Warns
    (ScanWarning) of what the programs warn about: how the file was read, and what looks like a
    wrong unit.
    """
    x, y = (0.0, 0.0) if pitch is None else pitch_of(pitch)
    core, chosen, notes, identity = _core.read(
        os.fsencode(path),
        Settings(config, **settings)._configuration,
        x,
        y,
        str(channel),
        ignore_mask,
    )
    surface = Surface(core, name_of(path), False, chosen, tuple(notes), identity)
    warn_about(surface, odd_in(surface))
    return Scan(surface, chosen)


def channels(
    path: Union[str, "os.PathLike[str]"], config: Optional[Config] = None, **settings: Any
) -> List[Dict[str, Any]]:
    """Every channel of a file, heights or not: name, shape, pitch, unit_xy, unit_z, is_chosen (by
    read())."""
    return _core.channels(os.fsencode(path), Settings(config, **settings)._configuration)


def clean(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    **settings: Any,
) -> Cleaned:
    """The surface after the steps that preprocessing/... switches on, in the order of doc/scans.md;
    without any it is the scan itself, and shares its memory. predict() does the same by itself.

        clean(heights, 20e-9, preprocessing={"level": "plane", "spikes/enabled": True}).heights

    Raises OptionsError, SurfaceError. Warns (ScanWarning) where the steps hardly did what was
    meant: tall features that pulled the levelling aslant, a filter longer than the scan.
    """
    checked = Settings(config, **settings)
    surface = scan_of(heights, pitch, checked)
    core, steps, oddities = _core.clean(surface.core, checked._configuration)
    warn_about(surface, oddities)
    cleaned = Cleaned(surface._replace(core=core), surface.channel)
    cleaned.steps = steps
    return cleaned


def shape_of(shape: Any, allowed: range, words: str) -> Tuple[int, int]:
    """(rows, columns), both allowed. Raises SurfaceError that says so by these words."""
    try:
        rows, columns = (operator.index(count) for count in shape)
        if rows in allowed and columns in allowed:
            return rows, columns
    except (TypeError, ValueError):
        pass
    raise SurfaceError(
        "shape: %r is not allowed, must be (rows, columns), both integers %s" % (shape, words)
    )


def generate(
    shape: Tuple[int, int], pitch: Pitch, config: Optional[Config] = None, **settings: Any
) -> Scan:
    """Random heights of the kind that counter_surface/... describes, as a probe would see them,
    asperities up.

        generate((256, 256), 10e-9, counter_surface={"type": "self_affine", "seed": 2,
        "self_affine": {"rms_height": 3e-9}})

    shape: (rows, columns). The same shape, settings and seed give the same surface.
    Raises OptionsError for another type than gaussian or self_affine, SurfaceError for lengths that
    the grid cannot have.
    """
    rows, columns = shape_of(shape, range(1, 2**31), ">= 1")
    checked = Settings(config, **settings)
    return Scan(
        Surface(_core.generate(rows, columns, *pitch_of(pitch), checked._configuration), "", False)
    )


def decimate(heights: Heights, pitch: Optional[Pitch] = None, *, factor: int) -> Scan:
    """A coarser scan, as an instrument with larger pixels would see it: means over factor x factor
    pixels. A block with fewer than half of its pixels measured is missing; rows and columns beyond
    the last whole block are left out.
    Raises SurfaceError if there is no whole block.
    """
    if not isinstance(factor, (int, np.integer)) or factor < 1:
        raise SurfaceError("factor: %r is not allowed, must be an integer >= 1" % (factor,))
    surface = scan_of(heights, pitch, Settings())
    core = _core.decimate(surface.core, int(factor))
    is_whole = all(count % factor == 0 for count in np.asarray(surface.core.pixels).shape)
    return Scan(
        surface._replace(core=core, is_periodic=surface.is_periodic and is_whole), surface.channel
    )


def roughness(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    *,
    spatial: bool = True,
    **settings: Any,
) -> Roughness:
    """Figures of ISO 25178-2, spectrum and summits of a surface as it is given.

    spatial: also those that reach sideways (sal to hurst), which take twice as long as a
    prediction. They wrap around a topography that is_periodic. Spectra fill missing pixels
    (doc/theory.md, 13), with a ScanWarning. A cleaning that the settings state is not done, with a
    SettingsWarning.
    Raises SurfaceError without a valid pixel.
    """
    checked = Settings(config, **settings)
    is_stated = config is not None or settings
    if is_stated and any(line.startswith("preprocessing/") for line in changed_lines(checked)):
        warn([NOT_CLEANED], SettingsWarning)
    surface = scan_of(heights, pitch, checked)
    figures, warnings = _core.roughness(
        surface.core, checked._configuration, spatial, surface.is_periodic
    )
    warn(warnings, ScanWarning)
    return Roughness(figures)
