"""The frames of the error map: surfaces, materials and loads, each drawn by its number alone.

Frame N is the same in every run. Every tenth frame is a part of a measured scan where a folder of
scans is given, every tenth an array of spheres; the others are Gaussian, skewed or self-affine.
Nearly all are resolved: pixels are no longer than the cohesive length E z0^2/Gamma, which limits
how soft a long-waved frame can be.
"""

import math
import pathlib

import cv2
import numpy as np

POISSON_RATIO = 0.22
LEAST_PITCH = 0.1e-9
SCAN_EVERY, ARRAY_EVERY, COARSE_EVERY, LOAD_EVERY = 10, 10, 16, 3
NO_HARDNESS = 1e13


def log_uniform(random, low, high):
    return float(math.exp(random.uniform(math.log(low), math.log(high))))


def spectrum_surface(pixels, pitch, psd_of, random):
    """Periodic heights with this spectrum (a function of the wave number), rms height 1."""
    q = (
        2
        * np.pi
        * np.hypot(np.fft.fftfreq(pixels, pitch)[:, None], np.fft.rfftfreq(pixels, pitch)[None, :])
    )
    waves = np.fft.rfft2(random.standard_normal((pixels, pixels))) * np.sqrt(psd_of(q))
    waves[0, 0] = 0
    heights = np.fft.irfft2(waves, s=(pixels, pixels))
    return heights / heights.std()


def gaussian_spectrum(length):
    return lambda q: np.exp(-((q * length) ** 2) / 4)


def self_affine(length, pitch, hurst):
    roll_off, cut_off = 2 * np.pi / length, 2 * np.pi / (4 * pitch)
    return lambda q: np.where(q <= cut_off, np.maximum(q, roll_off) ** (-2 - 2 * hurst), 0.0)


def spheres(pixels, pitch, radius, tiles, rms_height, random):
    """Equal paraboloids in square tiles, their summits of normally distributed height."""
    width = pixels / tiles
    tile = np.minimum(((np.arange(pixels) + 0.5) / width).astype(int), tiles - 1)
    x = (np.arange(pixels) + 0.5 - (tile + 0.5) * width) * pitch
    tops = rms_height * random.standard_normal((tiles, tiles))
    return tops[np.ix_(tile, tile)] - (x[:, None] ** 2 + x[None, :] ** 2) / (2 * radius)


def levelled(heights):
    """Without plane and row medians."""
    rows, cols = np.indices(heights.shape)
    plane = np.stack([rows.ravel(), cols.ravel(), np.ones(heights.size)], axis=1)
    flat = heights - (plane @ np.linalg.lstsq(plane, heights.ravel(), rcond=None)[0]).reshape(
        heights.shape
    )
    return flat - np.median(flat, axis=1, keepdims=True)


class Scans:
    """Imported scans of a folder: float TIFFs in metres, each with its pitch in a YAML file beside
    it."""

    def __init__(self, folder):
        self.scans = []
        for path in sorted(pathlib.Path(folder).glob("*.tiff")) if folder else []:
            sidecar = path.with_name(path.name + ".yaml").read_text()
            pitch = {
                line.split(":")[0].strip(): line.split(":")[1]
                for line in sidecar.splitlines()
                if ":" in line
            }
            heights = cv2.imread(str(path), cv2.IMREAD_UNCHANGED).astype(float)
            pitches = float(pitch["pitch_x"]), float(pitch["pitch_y"])
            if pitches[0] == pitches[1] and pitches[0] < 50e-9 and np.isfinite(heights).all():
                self.scans.append((path.stem, heights, pitches[0]))

    def part(self, pixels, random):
        name, heights, pitch = self.scans[random.integers(len(self.scans))]
        row = int(random.integers(heights.shape[0] - pixels + 1))
        col = int(random.integers(heights.shape[1] - pixels + 1))
        return name, levelled(heights[row : row + pixels, col : col + pixels]), pitch


def material(random):
    modulus = log_uniform(random, 0.1e9, 100e9)
    work = log_uniform(random, 0.005, 0.15)
    hamaker = 65e-21 if random.random() < 0.7 else 200e-21
    return modulus, work, hamaker


def cohesive_length(modulus, work, hamaker):
    """E z0^2/Gamma [m]."""
    return modulus * hamaker / (16 * math.pi * work**2)


SEED = 20  # of the map


def draw(number, pixels, scans, seed=SEED):
    """(what the frame is, heights [m])"""
    random = np.random.default_rng([seed, number])
    is_coarse = number % COARSE_EVERY == COARSE_EVERY - 1
    frame = {"number": number, "pixels": pixels}
    if scans.scans and number % SCAN_EVERY == 1:
        name, heights, pitch = scans.part(pixels, random)
        for _ in range(1000):
            modulus, work, hamaker = material(random)
            if cohesive_length(modulus, work, hamaker) > pitch:
                break
        frame.update(kind="scan", source=name, pitch=pitch)
    else:
        kind = (
            "spheres"
            if number % ARRAY_EVERY == 3
            else ("gaussian", "self-affine", "skewed")[(0, 0, 1, 1, 2)[number % 5]]
        )
        while True:
            modulus, work, hamaker = material(random)
            length = log_uniform(random, 10e-9, 300e-9)
            rms = log_uniform(random, 0.03e-9, 12e-9)
            longest = length / 8 if kind != "self-affine" else length / 12
            longest = (
                longest if is_coarse else min(longest, cohesive_length(modulus, work, hamaker) / 2)
            )
            shortest = max(3 * length / pixels, LEAST_PITCH)
            if length / 5000 < rms < length / 8 and shortest < longest:
                break
        pitch = log_uniform(random, shortest, longest)
        frame.update(kind=kind, pitch=pitch, length=length, rms=rms)
        if kind == "spheres":
            tiles = max(1, round(pixels * pitch / length))
            radius = length**2 / (8 * max(rms, length / 100))
            heights = spheres(pixels, pitch, radius, tiles, rms / 3, random)
        else:
            hurst = random.uniform(0.5, 0.9)
            frame["hurst"] = hurst if kind == "self-affine" else None
            spectrum = (
                self_affine(length, pitch, hurst)
                if kind == "self-affine"
                else gaussian_spectrum(length)
            )
            heights = spectrum_surface(pixels, pitch, spectrum, random)
            if kind == "skewed":
                skew = random.uniform(0.15, 0.5) * random.choice((-1, 1))
                heights = np.exp(skew * heights)
                heights = (heights - heights.mean()) / heights.std() * np.sign(skew)
            heights = heights * rms
    pressure = log_uniform(random, 1e5, 1e8) if number % LOAD_EVERY == 2 else 0.0
    frame.update(
        modulus=modulus,
        work=work,
        hamaker=hamaker,
        pressure=pressure,
        cohesive_length=cohesive_length(modulus, work, hamaker),
    )
    return frame, heights.astype(np.float32)


def configuration(frame, formulation):
    """As YAML: equal bodies with this contact modulus; they flow only where the frame has a
    hardness."""
    hardness = frame.get("hardness", NO_HARDNESS)
    lower, upper = (
        "{youngs_modulus: %r, poisson_ratio: %r, hardness: %r}"
        % (2 * frame["modulus"] * (1 - POISSON_RATIO**2), POISSON_RATIO, of_body)
        for of_body in (hardness, frame.get("upper_hardness", hardness))
    )
    cut_off = math.sqrt(frame["hamaker"] / (12 * math.pi * frame["work"]))
    return (
        "lower: %s\nupper: %s\napproach: {formulation: %s}\n" % (lower, upper, formulation)
        + "interface: {work_of_adhesion: %r, hamaker_constant: %r}\n"
        % (frame["work"], frame["hamaker"])
        + ("" if formulation == "separation_curve" else "paper: {cutoff_distance: %r}\n" % cut_off)
        + "output: {roughness: false}\nlimits: {accept_implausible: true}\nload: "
        "{max_mechanical_load: 1.0e+3}\n"
        + "half_space: {flow: %s, step: 0.3}\n"
        % str("hardness" in frame).lower()
    )


def load_of(frame):
    """[N] on the frame."""
    return frame["pressure"] * (frame["pixels"] * frame["pitch"]) ** 2


def rigid_pull_off(heights, frame):
    """Of undeformed surfaces at first touch: the law summed over the gap [N]."""
    gap = float(heights.max()) - heights.astype(float)
    z0 = math.sqrt(frame["hamaker"] / (16 * math.pi * frame["work"]))
    cube = (z0 / (gap + z0)) ** 3
    return float(np.sum(8 * frame["work"] / (3 * z0) * (cube - cube**3)) * frame["pitch"] ** 2)
