"""Surfaces as processes make them, for the error map: polished, ground, etched, coated, worn.

Each is drawn by a generator of random numbers alone and is periodic; heights have the rms 1,
`length` is the lateral scale of the process [m].
"""

import numpy as np
import scipy.ndimage
from device_surfaces import grain_surface, grooved_surface
from trust_frames import (
    LEAST_PITCH,
    LOAD_EVERY,
    cohesive_length,
    gaussian_spectrum,
    log_uniform,
    self_affine,
    spectrum_surface,
)

SEED = 19  # of the page that judges
PRESSED_HARDNESSES = 0.3e9, 13e9  # of frames that are pressed [Pa]
PRESSED_BY = 1e6, 300e6  # [Pa]


def gaussian(pixels, pitch, length, random):
    return spectrum_surface(pixels, pitch, gaussian_spectrum(length), random)


def fine(pixels, pitch, length, random):
    """Roughness on top of something larger."""
    return gaussian(pixels, pitch, max(length / 5, 3 * pitch), random)


def distances(pixels, row, col):
    """Of each pixel from a place, around the edges [pixels]: along the rows, along the columns."""
    index = np.arange(pixels)
    along = [(index - place + pixels / 2) % pixels - pixels / 2 for place in (row, col)]
    return along[0][:, None], along[1][None, :]


def features(pixels, pitch, length, random, coverage):
    """Rows, columns and radii [pixels] of features that cover so much of the frame."""
    radii = []
    while len(radii) < 500 and np.pi * np.sum(np.square(radii)) < coverage * pixels**2:
        radii.append(random.uniform(0.3, 0.8) * length / pitch)
    return [(random.uniform(0, pixels), random.uniform(0, pixels), radius) for radius in radii]


def gaussian_or_affine(pixels, pitch, length, random):
    if random.random() < 0.5:
        return gaussian(pixels, pitch, length, random)
    return spectrum_surface(
        pixels, pitch, self_affine(length, pitch, random.uniform(0.5, 0.9)), random
    )


def polished(pixels, pitch, length, random):
    """Tops are worn down and rounded off, valleys stay."""
    heights, level = gaussian(pixels, pitch, length, random), random.uniform(-0.7, 0.7)
    return -np.logaddexp(0, -(heights - level) * random.uniform(3, 10)) + random.uniform(
        0, 0.05
    ) * fine(pixels, pitch, length, random)


def lapped(pixels, pitch, length, random):
    """Tops are cut off, and have fine roughness of their own."""
    heights, level = gaussian(pixels, pitch, length, random), random.uniform(-0.5, 1.0)
    return np.minimum(heights, level) + random.uniform(0.01, 0.1) * fine(
        pixels, pitch, length, random
    )


def ground(pixels, pitch, length, random):
    return grooved_surface(pixels, pitch, length / 2, random.uniform(1.5, 4), random)


def islands(pixels, pitch, length, random):
    """Of one height on a film, with fine roughness."""
    steep = random.uniform(3, 8)
    return np.tanh(
        steep * (gaussian(pixels, pitch, length, random) - random.uniform(0, 1))
    ) + random.uniform(0.02, 0.2) * fine(pixels, pitch, length, random)


def long_tailed(pixels, pitch, length, random):
    """Heights of a log-normal distribution."""
    return np.exp(random.uniform(0.5, 1.2) * gaussian(pixels, pitch, length, random))


def scratched(pixels, pitch, length, random):
    """Scratches with ridges beside them, along whole rows so that the frame repeats itself."""
    heights = random.uniform(0.1, 0.4) * gaussian(pixels, pitch, length, random)
    for _ in range(random.integers(1, 6)):
        across = (
            distances(pixels, random.uniform(0, pixels), 0)[0]
            * pitch
            / (random.uniform(0.15, 0.5) * length)
        )
        heights = heights - random.uniform(0.5, 2) * (1 - across**2) * np.exp(
            -(across**2) / 2
        ) * np.ones((1, pixels))
    return heights


def bumps(pixels, pitch, length, random):
    """Dimples that stand out, with fine roughness."""
    heights = np.zeros((pixels, pixels))
    for row, col, radius in features(pixels, pitch, length, random, random.uniform(0.1, 0.4)):
        rows, cols = distances(pixels, row, col)
        heights = np.maximum(
            heights,
            np.sqrt(np.maximum(0, 1 - (rows**2 + cols**2) / radius**2)) * random.uniform(0.9, 1.1),
        )
    return heights + random.uniform(0.01, 0.1) * fine(pixels, pitch, length, random)


def grains(pixels, pitch, length, random):
    return grain_surface(pixels, pitch, max(length, pixels * pitch / 20), random)


def steps(pixels, pitch, length, random):
    """Terraces one atom apart, with little roughness."""
    return np.round(
        random.uniform(1, 2.5) * gaussian(pixels, pitch, length, random)
    ) + random.uniform(0.03, 0.2) * fine(pixels, pitch, length, random)


def pitted(pixels, pitch, length, random):
    heights = random.uniform(0.05, 0.3) * gaussian(pixels, pitch, length, random)
    for row, col, radius in features(pixels, pitch, length, random, random.uniform(0.05, 0.4)):
        rows, cols = distances(pixels, row, col)
        heights = heights - random.uniform(0.5, 2) * np.exp(-(rows**2 + cols**2) / radius**2)
    return heights


def with_particles(pixels, pitch, length, random):
    """Spherical caps on a rough surface."""
    heights = random.uniform(0.1, 0.5) * gaussian(pixels, pitch, length, random)
    for row, col, radius in features(pixels, pitch, length, random, random.uniform(0.005, 0.05))[
        :20
    ]:
        rows, cols = distances(pixels, row, col)
        heights = heights + random.uniform(0.5, 2) * np.sqrt(
            np.maximum(0, 1 - (rows**2 + cols**2) / radius**2)
        )
    return heights


def two_processes(pixels, pitch, length, random):
    """Honed: what a fine process left of the tops of a coarse one."""
    plateau = random.uniform(0.03, 0.2) * fine(pixels, pitch, length, random)
    return np.minimum(plateau, gaussian(pixels, pitch, length, random) + random.uniform(0.3, 1.5))


def sawn(pixels, pitch, length, random):
    """Wire-sawn or printed: lines with roughness."""
    count = max(1, round(pixels * pitch / (4 * length)))
    lines = np.sin(2 * np.pi * count * np.arange(pixels) / pixels + random.uniform(0, 2 * np.pi))[
        :, None
    ]
    return lines * np.ones((1, pixels)) + random.uniform(0.1, 0.5) * gaussian(
        pixels, pitch, length, random
    )


def places(pixels, pitch, length, random):
    """1 in a part of the frame, 0 in the others, with edges of some pixels."""
    share, form = random.uniform(0.05, 0.6), random.integers(3)
    if form == 0:
        field = gaussian(pixels, pitch, min(3 * length, pixels * pitch / 3), random)
    elif form == 1:
        field = np.hypot(*distances(pixels, random.uniform(0, pixels), random.uniform(0, pixels)))
    else:
        field = np.abs(distances(pixels, random.uniform(0, pixels), 0)[0]) * np.ones((1, pixels))
    inside = (field < np.quantile(field, share)).astype(float)
    return scipy.ndimage.gaussian_filter(inside, random.uniform(0.5, 5), mode="wrap")


def smooth_places(pixels, pitch, length, random):
    """A smooth part beside a rough one: at its mean height, or as high as some of its tops; or a
    rough part in a smooth surface."""
    rough, inside = (
        gaussian_or_affine(pixels, pitch, length, random),
        places(pixels, pitch, length, random),
    )
    if random.random() < 0.3:
        inside = 1 - inside
    level = 0.0 if random.random() < 0.5 else np.quantile(rough, random.uniform(0.5, 1))
    smooth = log_uniform(random, 0.005, 0.3) * gaussian_or_affine(pixels, pitch, length, random)
    return (1 - inside) * rough + inside * (level + smooth)


def changing(pixels, pitch, length, random):
    """Roughness whose height changes from place to place, over all lengths from the roughness's own
    to the frame's."""
    change, wave = random.uniform(0.3, 1.0), pixels * pitch / 2
    logarithm = np.zeros((pixels, pixels))
    while wave > length:
        logarithm += change * gaussian(pixels, pitch, wave, random)
        wave /= 2
    return np.exp(logarithm) * gaussian_or_affine(pixels, pitch, length, random)


DRAWS = {
    "Gaussian, self-affine": gaussian_or_affine,
    "polished": polished,
    "lapped": lapped,
    "ground": ground,
    "islands": islands,
    "long-tailed": long_tailed,
    "scratched": scratched,
    "bumps": bumps,
    "grains": grains,
    "steps": steps,
    "pitted": pitted,
    "particles": with_particles,
    "two processes": two_processes,
    "sawn": sawn,
}
ALIKE = tuple(DRAWS)  # of one texture everywhere
ALIKE_COUNT = 504  # frames of these, before those whose texture changes from place to place
CHANGING = {"smooth places": smooth_places, "changing": changing}
DRAWS.update(CHANGING)
KINDS = tuple(DRAWS)


def kind_of(number):
    """The kinds in turn: ALIKE_COUNT frames of one texture, and then those of changing texture."""
    return (
        ALIKE[number % len(ALIKE)]
        if number < ALIKE_COUNT
        else tuple(CHANGING)[number % len(CHANGING)]
    )


def surface(kind, pixels, pitch, length, random):
    """Periodic heights of this kind, their rms 1."""
    heights = DRAWS[kind](pixels, pitch, length, random)
    heights = scipy.ndimage.gaussian_filter(
        heights, 1.0, mode="wrap"
    )  # what an instrument's point rounds off
    return (heights - heights.mean()) / heights.std()


def drawn(random, number, kind, pixels, moduli, works, hamaker_constants):
    """A frame of its kind, with heights [m], whose pixels resolve what holds; each constant from
    its range."""
    while True:
        modulus, work = log_uniform(random, *moduli), log_uniform(random, *works)
        hamaker = log_uniform(random, *hamaker_constants)
        length, rms = log_uniform(random, 15e-9, 200e-9), log_uniform(random, 0.1e-9, 10e-9)
        longest = min(length / 8, cohesive_length(modulus, work, hamaker) / 2)
        shortest = max(3 * length / pixels, LEAST_PITCH)
        if length / 500 < rms < length / 8 and shortest < longest:
            break
    pitch = log_uniform(random, shortest, longest)
    heights = rms * surface(kind, pixels, pitch, length, random)
    frame = {
        "number": number,
        "pixels": pixels,
        "kind": kind,
        "pitch": pitch,
        "length": length,
        "rms": rms,
        "hurst": None,
        "modulus": modulus,
        "work": work,
        "hamaker": hamaker,
        "cohesive_length": cohesive_length(modulus, work, hamaker),
    }
    return frame, heights.astype(np.float32)


def draw(number, pixels, seed=SEED):
    """As trust_frames.draw(): the kinds in turn."""
    random = np.random.default_rng([seed, number])
    frame, heights = drawn(
        random, number, kind_of(number), pixels, (2e9, 200e9), (0.01, 0.12), (40e-21, 150e-21)
    )
    frame["pressure"] = log_uniform(random, 1e5, 1e8) if random.random() < 1 / LOAD_EVERY else 0.0
    return frame, heights


def draw_pressed(number, pixels, seed):
    """As draw(), of all kinds in turn: stiffer, softer against the load, and pressed. Of every
    other frame one body alone flows."""
    random = np.random.default_rng([seed, number, 2])
    frame, heights = drawn(
        random,
        number,
        KINDS[number % len(KINDS)],
        pixels,
        (10e9, 200e9),
        (0.02, 0.12),
        (40e-21, 400e-21),
    )
    hardness = log_uniform(random, *PRESSED_HARDNESSES)
    frame.update(
        pressure=log_uniform(random, *PRESSED_BY),
        hardness=hardness,
        upper_hardness=hardness if number // len(KINDS) % 2 == 0 else 10 * hardness,
    )
    return frame, heights
