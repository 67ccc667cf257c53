"""A surface that a stylus profile may be of: grooves, or random and alike in all directions."""

from __future__ import annotations

import math
import warnings
from typing import Any, Optional, Tuple

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import Surface, pitch_of
from mems_stiction._scans import Scan, shape_of
from mems_stiction._settings import SurfaceError
from mems_stiction._warnings import ScanWarning
from mems_stiction.other_packages import require_package

KINDS = ("isotropic", "grooves")
FEWEST_POINTS = 64
MOST_ROWS = 512  # of a surface whose shape is not asked for
RINGS_PER_DECADE = 8  # of the spectrum; finer ones take the noise of one line for waves
FITS = 5
WARNED_SKEWNESS = 0.5  # a Gaussian surface of 64 correlation lengths reaches 0.3 by chance


def surface_of_profile(
    heights: Any, pitch: float, kind: str, *, shape: Optional[Tuple[int, int]] = None, seed: int = 0
) -> Scan:
    """Heights over an area from a profile, a line of heights, as a stylus measures.

        surface = mems_stiction.surface_of_profile(line, 50e-9, "isotropic", seed=1)
        mems_stiction.predict(surface)

    heights: along the line [m]; at least 64, all of them measured. pitch: between them [m].
    kind: "grooves" repeats the line, as for ground or turned parts. "isotropic" makes a Gaussian
    random surface whose lines have the spectrum of the profile, in all directions: each seed gives
    another one, and predictions for several seeds show what this leaves open.
    shape: (rows, columns); 512 x 512 or as many as the line has points where these are fewer;
    grooves have all columns of the line.

    A profile does not say which of both the part is. Its spectrum C1 is that of the surface C2 seen
    along a line, C1(q) = 1/pi int_q^inf C2(k) k/sqrt(k^2 - q^2) dk (Nayak, J. Lubr. Technol. 93
    (1971) 398); rings of constant C2 >= 0 fit C1 by least squares. Waves shorter than two points
    and longer than the line are missing. Warns of skewed heights, which a Gaussian surface does not
    have.
    Raises SurfaceError for what is no such line, kind or shape.
    """
    line = _checked_line(heights)
    pitch_x, pitch_y = pitch_of(pitch)
    if pitch_x != pitch_y:
        raise SurfaceError("pitch: %r is not allowed, must be one number > 0 m" % (pitch,))
    if kind not in KINDS:
        raise SurfaceError(
            "kind: %r is not allowed, must be one of %s" % (kind, ", ".join(map(repr, KINDS)))
        )
    columns = len(line) if kind == "grooves" else min(len(line), MOST_ROWS)
    usual = (min(len(line), MOST_ROWS), columns)
    rows, columns = usual if shape is None else shape_of(shape, range(8, 2**15), "from 8 to 32767")
    if kind == "grooves":
        if columns > len(line):
            raise SurfaceError(
                "shape: %d columns are not allowed, the profile has %d points"
                % (columns, len(line))
            )
        made = np.tile(line[:columns], (rows, 1))
    else:
        made = _isotropic(line, pitch_x, rows, columns, seed)
    core = _core.height_map(made, pitch_x, pitch_x, _core.Configuration())
    return Scan(Surface(core, "%s surface of a profile" % kind, False))


def _checked_line(heights: Any) -> np.ndarray:
    try:
        line = np.squeeze(np.array(heights, dtype=float))
    except (TypeError, ValueError):
        raise SurfaceError("heights: must be numbers [m] along a line") from None
    if line.ndim != 1 or len(line) < FEWEST_POINTS:
        raise SurfaceError(
            "heights: an array of shape %s is not allowed, must be one line of at least %d points"
            % (np.shape(heights), FEWEST_POINTS)
        )
    missing = int(np.count_nonzero(~np.isfinite(line)))
    if missing:
        raise SurfaceError(
            "heights: %d of %d points are not measured; fill them, or cut the line there"
            % (missing, len(line))
        )
    return line


def _isotropic(line: np.ndarray, pitch: float, rows: int, columns: int, seed: int) -> np.ndarray:
    place = np.arange(len(line)) - 0.5 * (len(line) - 1)
    level = line - np.polyval(np.polyfit(place, line, 1), place)
    deviation = float(np.std(level))
    if not deviation > 1e-9 * float(np.ptp(line)):
        raise SurfaceError("heights: the profile is a straight line, without any roughness")
    skewness = float(np.mean(level**3)) / deviation**3
    if abs(skewness) > WARNED_SKEWNESS:
        warnings.warn(
            "the profile's heights are skewed (%.2g), the made surface's are not: it has %s summits"
            % (skewness, "too low" if skewness > 0 else "too high"),
            ScanWarning,
            stacklevel=4,
        )
    edges, densities = _rings(level, pitch)
    waves_x = 2.0 * math.pi * np.fft.rfftfreq(columns, pitch)
    waves_y = 2.0 * math.pi * np.fft.fftfreq(rows, pitch)
    waves = np.hypot(waves_y[:, None], waves_x[None, :])
    ring = np.searchsorted(edges, waves, side="right") - 1
    inside = (ring >= 0) & (ring < len(densities)) & (waves > 0.0)
    density = np.where(inside, densities[np.clip(ring, 0, len(densities) - 1)], 0.0)
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((rows, columns)))
    return np.fft.irfft2(noise * np.sqrt(density) / pitch, s=(rows, columns))


def _rings(level: np.ndarray, pitch: float) -> Tuple[np.ndarray, np.ndarray]:
    """Edges of rings of waves [1/m] and the surface's density in each [m^4]."""
    require_package("scipy", "surface_of_profile")
    import scipy.optimize

    count = len(level)
    window = np.hanning(count + 1)[:count]
    windowed = np.fft.rfft(window * level)[1:]
    of_line = np.abs(windowed) ** 2 * pitch / np.sum(window**2)  # two-sided [m^3]
    waves = 2.0 * math.pi * np.fft.rfftfreq(count, pitch)[1:]
    half = 0.5 * waves[0]
    decades = math.log10((waves[-1] + half) / half)
    ends = np.geomspace(half, waves[-1] + half, max(int(RINGS_PER_DECADE * decades), 4) + 1)
    # each ring needs a wave of its own
    place = np.unique(np.append(np.searchsorted(waves, ends[:-1]), len(waves)))
    edges = np.append(waves[place[:-1]] - half, waves[-1] + half)
    means = np.add.reduceat(of_line, place[:-1]) / np.diff(place)
    chords = np.sqrt(np.maximum(edges[None, :] ** 2 - waves[:, None] ** 2, 0.0))
    share = np.diff(chords, axis=1) / math.pi
    matrix = np.add.reduceat(share, place[:-1], axis=0) / np.diff(place)[:, None]
    # The error of a mean goes with what is expected, which the fit itself says: a measured mean as
    # weight would favour the low ones.
    expected = means
    for _ in range(FITS):
        weights = np.sqrt(np.diff(place)) / np.maximum(expected, 1e-9 * means.max())
        densities, _ = scipy.optimize.nnls(matrix * weights[:, None], means * weights)
        expected = matrix @ densities
    return edges, densities
