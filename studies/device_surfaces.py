"""The large surfaces of the study of devices: each drawn by its kind, number and seed alone, in
metres on square pixels."""

import numpy as np
import scipy.ndimage

import trust_frames

KINDS = (
    "gaussian",
    "self-affine",
    "two scales",
    "skewed",
    "polished",
    "plateaus",
    "grains",
    "grooves",
)


def rms(heights, wanted):
    heights = heights - heights.mean()
    return heights * (wanted / heights.std())


def grooved_surface(side, pitch, length, stretch, random):
    """Correlation length along the columns is so much longer."""
    qx = 2 * np.pi * np.fft.rfftfreq(side, pitch)[None, :]
    qy = 2 * np.pi * np.fft.fftfreq(side, pitch)[:, None]
    waves = np.fft.rfft2(random.standard_normal((side, side)))
    waves *= np.exp(-(length**2) * (qx**2 + (stretch * qy) ** 2) / 8)
    waves[0, 0] = 0
    return np.fft.irfft2(waves, s=(side, side))


def grain_surface(side, pitch, size, random):
    """Domes over the cells of Voronoi's tessellation, their tops of normally distributed height."""
    count = max(4, int((side * pitch / size) ** 2))
    seeds = np.zeros((side, side), dtype=np.int32)
    places = random.integers(0, side, size=(count, 2))
    seeds[places[:, 0], places[:, 1]] = np.arange(1, count + 1)
    distance, nearest = scipy.ndimage.distance_transform_edt(seeds == 0, return_indices=True)
    owner = seeds[nearest[0], nearest[1]]
    tops = np.concatenate([[0.0], 0.1 * size * random.standard_normal(count)])
    return tops[owner] - (distance * pitch) ** 2 / (2 * size)


def draw(kind, number, seed, side, pitch):
    """({what it is}, heights [m] as float32)"""
    random = np.random.default_rng([seed, KINDS.index(kind), number])
    length = trust_frames.log_uniform(random, 50e-9, 300e-9)
    height = trust_frames.log_uniform(random, 1e-9, 10e-9)
    what = {"kind": kind, "number": number, "rms": height}

    def of_spectrum(psd):
        return trust_frames.spectrum_surface(side, pitch, psd, random)

    if kind == "self-affine":
        rolloff, hurst = (
            trust_frames.log_uniform(random, 0.5e-6, side * pitch / 2),
            random.uniform(0.5, 0.9),
        )
        what.update(rolloff=rolloff, hurst=hurst)
        heights = of_spectrum(trust_frames.self_affine(rolloff, pitch, hurst))
    elif kind == "grooves":
        stretch = random.uniform(2, 6)
        what.update(length=length, stretch=stretch)
        heights = grooved_surface(side, pitch, length, stretch, random)
    elif kind == "grains":
        size = 3 * length
        what.update(size=size)
        heights = grain_surface(side, pitch, size, random)
        height = heights.std() * min(1.0, height / heights.std())
    else:
        heights = of_spectrum(trust_frames.gaussian_spectrum(length))
        what.update(length=length)
        if kind == "two scales":
            ratio, share = random.uniform(5, 20), random.uniform(0.3, 1.0)
            what.update(ratio=ratio, share=share)
            heights = heights + of_spectrum(trust_frames.gaussian_spectrum(ratio * length)) / share
        elif kind == "skewed":
            skew = random.uniform(0.15, 0.4) * random.choice((-1, 1))
            what.update(skew=skew)
            heights = np.sign(skew) * np.exp(skew * heights)
        elif kind == "polished":  # the tops are worn down to a tenth of their height
            level = random.uniform(-0.5, 0.5)
            what.update(level=level)
            heights = np.where(heights > level, level + 0.1 * (heights - level), heights)
            heights += 0.03 * of_spectrum(trust_frames.gaussian_spectrum(length / 2))
        elif kind == "plateaus":  # etched islands with fine roughness
            heights = np.tanh(3 * heights) + 0.05 * of_spectrum(
                trust_frames.gaussian_spectrum(length / 2)
            )
    return what, rms(heights, height).astype(np.float32)


def part(heights, row, col, side):
    return np.ascontiguousarray(heights[row : row + side, col : col + side])


def coarse(heights, factor):
    """As an instrument with larger pixels sees it: means over blocks."""
    rows, cols = heights.shape[0] // factor, heights.shape[1] // factor
    return (
        heights[: rows * factor, : cols * factor]
        .reshape(rows, factor, cols, factor)
        .mean(axis=(1, 3))
        .astype(np.float32)
    )
