"""The report's picture of a surface by itself: height histogram, material ratio (bearing) curve and
spectrum.

Heights are rows x columns [m], NaN where nothing was measured. The core has the field parameters of
ISO 25178-2 (Sq, Sdq ...); those of the material ratio curve are found here, with NumPy, from the
curve that is drawn.
"""

import math

import numpy as np
from scipy import signal

from mems_stiction.plots import plt, with_unit
from mems_stiction.quantities import length_scale
from mems_stiction.report_figures import png_of

BLUE, ORANGE, GREY = "#0b4f9e", "#e07b00", "#555555"
CORE_WINDOW = 0.4  # of the material ratio: the flattest part of the curve is the core, ISO 13565-2
CURVE_POINTS = 1001
SHOWN_SHARE = 0.001  # of the heights on either side may leave the picture


class MaterialRatioCurve:
    """Height over the areal material ratio, and its parameters by ISO 25178-2 with the core of ISO
    13565-2, where the equivalent straight line is that of the
    40 % of the curve that fall least.

    ratios [-] from 0 to 1; heights [m], falling. sk, spk, svk [m]; smr1, smr2 [-]. A surface of one
    height has 0 and the whole range.
    """

    def __init__(self, heights):
        finite = heights[np.isfinite(heights)]
        self.ratios = np.linspace(0.0, 1.0, CURVE_POINTS)
        self.heights = np.quantile(finite, 1.0 - self.ratios) - finite.mean()
        width = int(round(CORE_WINDOW * (CURVE_POINTS - 1)))
        start = int(np.argmin(self.heights[:-width] - self.heights[width:]))
        core = slice(start, start + width + 1)
        self.slope, self.top = np.polyfit(
            self.ratios[core], self.heights[core], 1
        )  # of the line, and its height at 0
        self.bottom = self.top + self.slope
        self.sk = self.top - self.bottom
        self.smr1 = float(np.mean(self.heights > self.top))
        self.smr2 = float(np.mean(self.heights >= self.bottom))
        peaks = np.trapz(np.maximum(self.heights - self.top, 0.0), self.ratios)
        valleys = np.trapz(np.maximum(self.bottom - self.heights, 0.0), self.ratios)
        # the triangles of the same areas over the same ratios
        self.spk = 2.0 * peaks / self.smr1 if self.smr1 > 0 else 0.0
        self.svk = 2.0 * valleys / (1.0 - self.smr2) if self.smr2 < 1 else 0.0


def profile_spectrum(heights, pitch):
    """Spatial frequencies [1/m] and the mean power spectral density [m^3] of the rows, each less
    its line, under a Hann window; and how many rows have no missing pixel, which alone are taken.
    Its integral is the rows' mean variance."""
    rows = heights[np.isfinite(heights).all(axis=1)]
    if len(rows) < 1 or rows.shape[1] < 8:
        return np.empty(0), np.empty(0), len(rows)
    frequencies, densities = signal.periodogram(
        rows, fs=1.0 / pitch, window="hann", detrend="linear", axis=1
    )
    return frequencies[1:], densities.mean(axis=0)[1:], len(rows)


def surface_figure(heights, pitch_x, pitch_y, tip_limit=None):
    """A PNG as bytes of the three panels."""
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.3), dpi=100)
    figure.subplots_adjust(left=0.066, right=0.985, top=0.9, bottom=0.14, wspace=0.27)
    curve = MaterialRatioCurve(heights)
    scale, unit = length_scale(float(curve.heights[0] - curve.heights[-1]))
    low, high = np.quantile(curve.heights, [SHOWN_SHARE, 1 - SHOWN_SHARE])
    low, high = min(low, curve.bottom), max(high, curve.top)
    room = 0.08 * (high - low) or 1e-9  # one height
    limits = (low - room) * scale, (high + room) * scale
    _draw_histogram(axes[0], heights, scale, unit, limits)
    _draw_material_ratio(axes[1], curve, scale, unit, limits)
    _draw_spectrum(axes[2], heights, pitch_x, pitch_y, tip_limit)
    return png_of(figure)


def surface_figures_of(heights):
    """Pairs of label and text: the parameters of the material ratio curve."""
    curve = MaterialRatioCurve(heights)
    return [
        ("core height Sk", with_unit(curve.sk, "m")),
        ("reduced peak height Spk", with_unit(curve.spk, "m")),
        ("reduced dale height Svk", with_unit(curve.svk, "m")),
        ("material ratios Smr1, Smr2", "%.1f %%, %.1f %%" % (100 * curve.smr1, 100 * curve.smr2)),
    ]


def _finish(axes, title):
    axes.set_title(title, fontsize=11)
    axes.grid(color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)


def _draw_histogram(axes, heights, scale, unit, limits):
    finite = heights[np.isfinite(heights)]
    shown = (finite - finite.mean()) * scale
    deviation = shown.std()
    bins = np.linspace(limits[0], limits[1], 81)
    axes.hist(shown, bins=bins, density=True, color="#9db7d5")
    if deviation > 0:
        axes.plot(
            bins,
            np.exp(-0.5 * (bins / deviation) ** 2) / (deviation * math.sqrt(2 * math.pi)),
            color=BLUE,
            linewidth=1.4,
            label="Gaussian of the same Sq, %s" % with_unit(deviation / scale, "m"),
        )
        axes.set_ylim(0, 1.18 * axes.get_ylim()[1])
        axes.legend(fontsize=8.5, frameon=False, loc="upper left")
    axes.set_xlim(*limits)
    axes.set_xlabel("height above mean [%s]" % unit)
    axes.set_ylabel("density [1/%s]" % unit)
    _finish(axes, "Heights")


def _draw_material_ratio(axes, curve, scale, unit, limits):
    axes.plot(100 * curve.ratios, curve.heights * scale, color=BLUE, linewidth=2)
    axes.plot(
        [0, 100],
        [curve.top * scale, curve.bottom * scale],
        color=ORANGE,
        linewidth=1.3,
        linestyle="--",
        label="equivalent line of the core",
    )
    for height, ratio in ((curve.top, curve.smr1), (curve.bottom, curve.smr2)):
        axes.plot([0, 100], [height * scale] * 2, color=GREY, linewidth=0.8, linestyle=":")
        axes.plot(100 * ratio, height * scale, "o", color=ORANGE, markersize=5)
    axes.text(
        0.975,
        0.965,
        "Spk %s\nSk %s\nSvk %s\nSmr1 %.1f %%, Smr2 %.1f %%"
        % (
            with_unit(curve.spk, "m"),
            with_unit(curve.sk, "m"),
            with_unit(curve.svk, "m"),
            100 * curve.smr1,
            100 * curve.smr2,
        ),
        transform=axes.transAxes,
        ha="right",
        va="top",
        fontsize=9,
        linespacing=1.4,
        bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 2},
    )
    axes.legend(fontsize=8.5, frameon=False, loc="lower left")
    axes.set_xlim(0, 100)
    axes.set_ylim(*limits)
    axes.set_xlabel("areal material ratio [%]")
    axes.set_ylabel("height above mean [%s]" % unit)
    _finish(axes, "Material ratio (bearing) curve")


def _draw_spectrum(axes, heights, pitch_x, pitch_y, tip_limit):
    drawn = False
    for rows, pitch, colour, label in (
        (heights, pitch_x, BLUE, "along x"),
        (heights.T, pitch_y, ORANGE, "along y"),
    ):
        frequencies, densities, count = profile_spectrum(rows, pitch)
        use = densities > 0
        if not use.any():
            continue
        drawn = True
        missing = "" if count == len(rows) else ", %d of %d lines" % (count, len(rows))
        axes.loglog(
            frequencies[use] * 1e-6,
            densities[use] * 1e27,
            color=colour,
            linewidth=1.4,
            label=label + missing,
        )
    if not drawn:
        axes.set_axis_off()
        axes.text(
            0.5,
            0.5,
            "no spectrum: flat, or no line without missing pixels",
            ha="center",
            va="center",
            transform=axes.transAxes,
            color=GREY,
        )
        return
    if tip_limit and np.isfinite(tip_limit):
        axes.axvspan(
            1e-6 / tip_limit,
            max(axes.get_xlim()[1], 1e-6 / tip_limit),
            color=GREY,
            alpha=0.25,
            linewidth=0,
            label="drawn by the tip, below %s" % with_unit(tip_limit, "m"),
        )
    axes.set_xlabel("spatial frequency [1/µm]; lines end at two pixels")
    axes.set_ylabel("profile PSD [nm³]")
    axes.legend(fontsize=8.5, frameon=False, loc="lower left")
    _finish(axes, "Power spectral density of profiles")
