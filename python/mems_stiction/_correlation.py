"""How far two scanned surfaces fit each other, by bands of their waves."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import Pitch, ReadOnly, array_of
from mems_stiction._inputs import inputs_of
from mems_stiction._settings import Config, SurfaceError
from mems_stiction._types import Heights, Upper
from mems_stiction.confidence import NORMAL_95

FIELDS = "wavelength shortest longest correlation correlation_lower correlation_upper".split()
FIELDS += ["rms_lower", "rms_upper", "waves"]


class Correlation(ReadOnly):
    """Correlation of two surfaces as they lie on each other: 1 fit, 0 have nothing in common.

    bands: an array with named fields, longest waves first: wavelength (middle), shortest, longest
    [m]; correlation with correlation_lower and correlation_upper (95 %) [-]; rms_lower and
    rms_upper [m] of both surfaces in the band; waves: independent ones that say it.
    correlation, correlation_lower, correlation_upper: of all waves together.
    """

    def __init__(self, bands: np.recarray, whole: Tuple[float, float, float]) -> None:
        bands.flags.writeable = False
        self.bands: np.recarray
        self.correlation: float
        self.correlation_lower: float
        self.correlation_upper: float
        names = ("correlation", "correlation_lower", "correlation_upper")
        self.__dict__.update(zip(names, whole), bands=bands)

    def longer_than(self, length: float) -> Tuple[float, float, float]:
        """Correlation of the waves of the bands beyond a length [m], and its 95 % interval: what
        counter_surface/correlation wants beside counter_surface/correlation_length.
        Raises SurfaceError if no band is so long."""
        chosen = self.bands[self.bands.shortest >= length * (1.0 - 1e-9)]
        if not len(chosen):
            raise SurfaceError(
                "length: no band of waves beyond %g m; must be <= %g m"
                % (length, self.bands.shortest.max())
            )
        return _together(chosen)

    def __repr__(self) -> str:
        return "Correlation(%.2f, 95 %%: %.2f to %.2f, %d bands)" % (
            self.correlation,
            self.correlation_lower,
            self.correlation_upper,
            len(self.bands),
        )


def correlation(
    lower: Heights,
    upper: Optional[Upper] = None,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    *,
    bands_per_octave: float = 2.0,
    **settings: Any,
) -> Correlation:
    """How far two surfaces fit each other, by bands of wavelengths: what
    counter_surface/correlation wants.

        found = mems_stiction.correlation("lower.gwy", "upper.gwy",
            counter_surface={"facing": "up"}, preprocessing={"level": "plane"})
        found.bands.wavelength, found.bands.correlation
        rho, at_least, at_most = found.longer_than(200e-9)

    lower, upper, pitch, config, settings: as of predict(), which cleans, mounts (facing) and lines
    up (counter_surface/pose) the same pair. Both must show one place: a shift of a quarter of a
    wave leaves nothing of its correlation. upper None: the configured counter-surface.
    Noise of either scan counts as roughness of its own: correlations are too small where it is
    not small against the heights of the band.

    Estimator: cross-spectrum Z1 Z2* of both levelled height maps under one Hann window, its real
    part summed over the waves of a band and divided by the root of the product of both powers: the
    signed root of the ordinary coherence for surfaces that are not shifted. Interval by Fisher's z,
    atanh(rho) +- 1.96/sqrt(n - 2), for n real waves; a Hann window over both axes leaves 1/3.78 of
    them independent. Sources: Bendat and Piersol, Random Data (4th ed., 2010), chapters 5 and 9;
    Fisher, Metron 1 (1921) 3; Harris, Proc. IEEE 66 (1978) 51 for the window. All recalled.

    Raises as predict(), and SurfaceError where one of both is a plane.
    """
    if not bands_per_octave > 0 or not np.isfinite(bands_per_octave):
        raise SurfaceError("bands_per_octave: %r is not allowed, must be > 0" % (bands_per_octave,))
    _, surface, prepared = inputs_of(lower, pitch, config, upper, settings)
    return _of_pair(prepared, bands_per_octave, surface.is_periodic)


def _of_pair(
    prepared: _core.PreparedScan, bands_per_octave: float, is_periodic: bool
) -> Correlation:
    if prepared.upper is None:
        raise SurfaceError(
            "upper: a plane fits nothing; must be a counter-surface, here or by "
            "counter_surface/type"
        )
    pair = [np.array(array_of(one.pixels), dtype=float) for one in (prepared.lower, prepared.upper)]
    pitch = prepared.lower.pitch
    if pair[0].shape != pair[1].shape or not np.allclose(pitch, prepared.upper.pitch, rtol=1e-9):
        raise SurfaceError(
            "upper: %d x %d pixels of %g m x %g m beside %d x %d of %g m x %g m; both must have "
            "one grid" % (pair[1].shape + prepared.upper.pitch + pair[0].shape + pitch)
        )
    is_known = np.isfinite(pair[0]) & np.isfinite(pair[1])
    window = _window(is_known, is_periodic)
    lower, upper = (_waves(heights, is_known, window, is_periodic) for heights in pair)
    rows, columns = pair[0].shape
    q_x = np.fft.rfftfreq(columns, pitch[0])[None, :]
    q_y = np.fft.fftfreq(rows, pitch[1])[:, None]
    frequency = np.hypot(q_x, q_y)
    # a wave and its mirror image are one: the transform has those along rows of 0 and of the
    # shortest waves twice
    weight = np.full(frequency.shape, 2.0)
    weight[:, 0] = 1.0
    if columns % 2 == 0:
        weight[:, -1] = 1.0
    longest = 1.0 / frequency[frequency > 0].min()
    band = np.floor(bands_per_octave * np.log2(np.maximum(frequency * longest, 1.0) * (1 + 1e-12)))
    # beyond the shortest wave along the coarser axis not all directions are there
    band[(frequency == 0) | (frequency > 0.5 / max(pitch))] = -1
    found = []
    for place in range(int(band.max()) + 1):
        waves = band == place
        powers = [float(np.sum((weight * np.abs(one) ** 2)[waves])) for one in (lower, upper)]
        if not waves.any() or not min(powers) > 0:
            continue
        cross = float(np.sum((weight * (lower * upper.conj()).real)[waves]))
        # a wave of both halves of the plane has a real and an imaginary part
        count = _even_waves(frequency[waves], weight[waves], np.abs(lower * upper)[waves])
        count /= 1.0 if is_periodic else _SPREAD
        rho = float(np.clip(cross / np.sqrt(powers[0] * powers[1]), -1.0, 1.0))
        ends = [longest * 2.0 ** (-(place + end) / bands_per_octave) for end in (0, 1)]
        found.append(
            (np.sqrt(ends[0] * ends[1]), ends[1], ends[0], rho)
            + _interval(rho, count)
            + (np.sqrt(powers[0]), np.sqrt(powers[1]), count)
        )
    if not found:
        raise SurfaceError("lower, upper: surfaces without relief fit nothing")
    layout = np.dtype([(name, float) for name in FIELDS])
    bands = np.array(found, dtype=layout).view(np.recarray)
    return Correlation(bands, _together(bands))


_SPREAD = (35.0 / 18.0) ** 2  # waves that a Hann window over both axes makes one of


def _window(is_known: np.ndarray, is_periodic: bool) -> np.ndarray:
    rows, columns = is_known.shape
    if is_periodic:
        window = np.ones(is_known.shape)
    else:
        window = np.outer(*(np.sin(np.pi * (np.arange(n) + 0.5) / n) ** 2 for n in (rows, columns)))
    return np.where(is_known, window, 0.0)


def _even_waves(frequency: np.ndarray, weight: np.ndarray, power: np.ndarray) -> float:
    """How many waves of one power say as much as those of a band, along which it falls."""
    known = power > 0
    x, y = np.log(frequency[known]), np.log(power[known])
    slope = 0.0
    if np.ptp(x) > 0:
        slope = float(np.polyfit(x, y, 1, w=np.sqrt(weight[known]))[0])
    smooth = (frequency / frequency.min()) ** slope
    return float(np.sum(weight * smooth) ** 2 / np.sum(weight * smooth**2))


def _waves(
    heights: np.ndarray, is_known: np.ndarray, window: np.ndarray, is_periodic: bool
) -> np.ndarray:
    """Of the heights without their mean plane, or mean; powers add up to their mean square."""
    rows, columns = np.nonzero(is_known)
    if len(rows) < 3:
        raise SurfaceError("lower, upper: no three pixels that both surfaces have")
    base = np.stack([np.ones(len(rows)), rows - rows.mean(), columns - columns.mean()], axis=1)
    base = base[:, :1] if is_periodic else base
    values = heights[is_known]
    flat = np.zeros(heights.shape)
    flat[is_known] = values - base @ np.linalg.lstsq(base, values, rcond=None)[0]
    scale = np.sqrt(heights.size * np.sum(window**2))
    return np.fft.rfft2(flat * window) / scale


def _interval(rho: float, count: float) -> Tuple[float, float]:
    if not count > 3:
        return -1.0, 1.0
    reach = NORMAL_95 / np.sqrt(count - 2)
    middle = np.arctanh(np.clip(rho, -1 + 1e-15, 1 - 1e-15))
    return float(np.tanh(middle - reach)), float(np.tanh(middle + reach))


def _together(bands: np.recarray) -> Tuple[float, float, float]:
    powers = bands.rms_lower**2, bands.rms_upper**2
    roots = bands.rms_lower * bands.rms_upper
    rho = float(np.sum(bands.correlation * roots) / np.sqrt(powers[0].sum() * powers[1].sum()))
    # few waves that have most of the power say it
    shares = roots / roots.sum()
    count = 1.0 / float(np.sum(shares**2 / bands.waves))
    return (rho,) + _interval(rho, count)
