#!/usr/bin/env python3
"""Compares two builds of predict_scan, the vectorised and the portable one: both must print the
same figures and write the same surfaces after contact, byte for byte, on generated scans of every
kind. Where contacts flow, figures may differ by the round-off of the transforms, which are FFTW's
in single precision or OpenCV's.

usage: compare_builds.py VECTORIZED-PREDICT_SCAN PORTABLE-PREDICT_SCAN

Prints whether this processor takes the vectorised functions, and what was compared. Exit status: 0
the same, 1 not.
"""

import argparse
import collections
import json
import math
import operator
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

import numpy as np

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
SHAPE = (259, 301)  # no multiple of any vector's length
PITCH = 10e-9  # [m]
FIELDS_SHOWN = 3  # of a prediction that differs
ROUND_OFF = 1e-4  # of figures where contacts flow, as a ratio: exponents are small differences
OFFSET = 1e-3  # [m]: so far up, a surface after contact is written in double precision
CLEANING = {
    "offset": {"enabled": True},
    "lines": {"method": "median"},
    "spikes": {"enabled": True},
    "fill": {"enabled": True},
    "level": "plane",
}
ROUGH = {
    "type": "gaussian",
    "gaussian": {"rms_height": 3e-9, "correlation_length_x": 60e-9, "correlation_length_y": 90e-9},
}
SETTINGS = {
    "default": {},
    "pressed": {"load": {"mechanical_load": 2e-5}},
    "voltage": {
        "load": {"voltage": 20.0, "mechanical_load": 1e-6},
        "interface": {"insulator_thickness": 50e-9},
    },
    "soft": {"lower": {"hardness": 1e9}, "load": {"mechanical_load": 1e-5}},
    "neighbours of 8": {"approach": {"connectivity": 8}, "load": {"mechanical_load": 2e-6}},
    "as printed": {"approach": {"formulation": "printed"}, "load": {"mechanical_load": 2e-6}},
    "elastic": {"approach": {"deformation": "elastic"}, "load": {"mechanical_load": 2e-6}},
    "humid": {"interface": {"relative_humidity": 0.5}},
    "rough counter-surface": {"counter_surface": ROUGH, "load": {"mechanical_load": 1e-6}},
    "cleaned": {"preprocessing": CLEANING, "output": {"spatial_roughness": True}},
    "cleaned, refined, rough counter-surface": {
        "preprocessing": dict(CLEANING, refine={"factor": 2}),
        "counter_surface": ROUGH,
    },
}

# A program finds the library of its own build only where none comes before it.
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}


def rough_surface(random, rms_height, correlation_length):
    """Gaussian heights and autocorrelation [m]."""
    squares = sum(
        (2 * np.pi * frequencies) ** 2
        for frequencies in np.meshgrid(
            *(np.fft.fftfreq(size, PITCH) for size in SHAPE), indexing="ij"
        )
    )
    heights = np.fft.ifft2(
        np.fft.fft2(random.standard_normal(SHAPE)) * np.exp(-squares * correlation_length**2 / 8)
    ).real
    return (heights - heights.mean()) * (rms_height / heights.std())


def with_holes(random, heights):
    heights = heights.copy()
    heights[random.random_sample(heights.shape) < 1e-3] = np.nan
    heights[40:52, 70:79] = np.nan
    return heights


def write_tiff(path, heights):
    """One strip of float32 or float64."""
    pixels, (rows, cols) = heights.tobytes(), heights.shape
    width, length, strip = (256, 4, cols), (257, 4, rows), (273, 4, 8)
    tags = [
        width,
        length,
        (258, 3, 8 * heights.itemsize),
        (259, 3, 1),
        (262, 3, 1),
        strip,
        (277, 3, 1),
        (278, 4, rows),
        (279, 4, len(pixels)),
        (339, 3, 3),
    ]  # bits, uncompressed, black is zero, one sample, ..., floating point
    entries = b"".join(
        struct.pack("<HHI", tag, kind, 1) + struct.pack("<I", value) for tag, kind, value in tags
    )
    path.write_bytes(
        struct.pack("<2sHI", b"II", 42, 8 + len(pixels))
        + pixels
        + struct.pack("<H", len(tags))
        + entries
        + bytes(4)
    )


def make_scans(folder):
    """Names of scan files in the folder."""
    random = np.random.RandomState(1)
    gaussian = rough_surface(random, 3e-9, 80e-9)
    scans = {
        "float32.tiff": gaussian.astype("<f4"),
        "float32_steps.tiff": (np.round(gaussian / 0.05e-9) * 0.05e-9).astype(
            "<f4"
        ),  # many cells of one height
        "float32_smooth.tiff": rough_surface(random, 0.2e-9, 100e-9).astype("<f4"),
        "float64_holes.tiff": with_holes(random, rough_surface(random, 8e-9, 60e-9)).astype("<f8"),
        "float64_offset.tiff": rough_surface(random, 5e-9, 40e-9).astype("<f8") + OFFSET,
    }
    for name, heights in scans.items():
        write_tiff(folder / name, heights)
    subprocess.run(
        [
            sys.executable,
            str(REPOSITORY / "scripts" / "examples" / "make_afm_scan"),
            str(folder / "afm.txt"),
        ],
        check=True,
    )
    (folder / "afm.txt.yaml").write_text("height_scale: 1.0e-9\n")
    return [*scans, "afm.txt"]


def predict(program, folder, scan, config):
    """What the program printed, without the time that it took, and the surface after contact that
    it wrote."""
    deformed = folder / "deformed.tiff"
    if deformed.exists():
        deformed.unlink()
    done = subprocess.run(
        [
            str(program),
            "--json",
            "--config",
            config,
            "--pitch",
            "%g" % PITCH,
            "--deformed",
            deformed.name,
            scan,
        ],
        cwd=str(folder),
        env=ENVIRONMENT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
    )
    if done.returncode:
        sys.exit(
            "%s, %s: exit status %d: %s" % (program, scan, done.returncode, done.stderr.strip())
        )
    return re.sub(r'"processing_time":[^,}]*,', "", done.stdout), deformed.read_bytes()


def are_alike(one, other):
    """Numbers to round-off, all else to the letter; in lists and records, too."""
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(are_alike(one[key], other[key]) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(are_alike, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=ROUND_OFF)
    return one == other


def heights_of(tiff):
    """Of the one strip that predict_scan writes [m]; it lies between header and tags."""
    (directory,) = struct.unpack_from("<I", tiff, 4)
    (bits,) = struct.unpack_from("<I", tiff, directory + 2 + 2 * 12 + 8)  # of the third tag
    return np.frombuffer(tiff[8:directory], "<f%d" % (bits // 8))


def are_alike_surfaces(one, other):
    """To round-off of their range."""
    heights, others = heights_of(one), heights_of(other)
    if heights.dtype != others.dtype or heights.shape != others.shape:
        return False
    spread = np.nanmax(heights) - np.nanmin(heights)
    return np.allclose(heights, others, rtol=0.0, atol=ROUND_OFF * spread, equal_nan=True)


def difference(one, other):
    """In words; None if there is none."""
    if one == other:
        return None
    fields, others = (json.loads(text) for text, _ in (one, other))
    has_flowed = fields["elasto_plastic_count"] + fields["plastic_count"] > 0
    same, same_surfaces = (
        (are_alike, are_alike_surfaces) if has_flowed else (operator.eq, operator.eq)
    )
    names = sorted(
        name for name in set(fields) | set(others) if not same(fields.get(name), others.get(name))
    )
    shown = [
        "%s %s, portable %s" % (name, str(fields.get(name))[:60], str(others.get(name))[:60])
        for name in names[:FIELDS_SHOWN]
    ]
    shown += ["%d more" % (len(names) - len(shown))] * (len(names) > len(shown))
    if not same_surfaces(one[1], other[1]):
        shown.append("the surfaces after contact differ")
    return "; ".join(shown) or None


def library_of(program):
    """The text of the core library that the program loads."""
    loaded = subprocess.run(
        ["ldd", str(program)],
        env=ENVIRONMENT,
        stdout=subprocess.PIPE,
        check=True,
        universal_newlines=True,
    ).stdout
    return pathlib.Path(
        re.search(r"libmems_stiction\.so\S* => (\S+)", loaded).group(1)
    ).read_bytes()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("vectorized", type=pathlib.Path, metavar="VECTORIZED-PREDICT_SCAN")
    parser.add_argument("portable", type=pathlib.Path, metavar="PORTABLE-PREDICT_SCAN")
    arguments = parser.parse_args()
    programs = [arguments.vectorized.resolve(), arguments.portable.resolve()]

    processor = pathlib.Path("/proc/cpuinfo")
    takes_avx2 = processor.exists() and re.search(r"\bavx2\b", processor.read_text())
    print(
        "this processor has AVX2: %s"
        % ("yes" if takes_avx2 else "no, so both builds run the same instructions")
    )
    # GCC names the versions of a function by their target.
    has_avx2 = [b".avx2" in library_of(program) for program in programs]
    print(
        "functions compiled for AVX2: %s in the vectorised build"
        % ("some" if has_avx2[0] else "none")
    )
    if has_avx2[1]:
        sys.exit("the portable build has functions for AVX2")

    different, count, statuses, contacts = [], 0, collections.Counter(), collections.Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scans = make_scans(folder)
        for title, settings in SETTINGS.items():
            (folder / "config.yaml").write_text(
                json.dumps(
                    dict(settings, output=dict(settings.get("output", {}), energy_curve=True))
                )
            )
            for scan in scans:
                vectorized, portable = (
                    predict(program, folder, scan, "config.yaml") for program in programs
                )
                count += 1
                found = difference(vectorized, portable)
                if found:
                    different.append("%s, %s: %s" % (scan, title, found))
                record = json.loads(vectorized[0])
                statuses[record["status"]] += 1
                for regime in ("elastic_count", "elasto_plastic_count", "plastic_count"):
                    contacts[regime] += record[regime]
    print(
        "%d predictions compared: %s"
        % (
            count,
            ", ".join("%d %s" % (number, status) for status, number in sorted(statuses.items())),
        )
    )
    print(
        "contacts: %s"
        % ", ".join(
            "%d %s" % (number, regime[: -len("_count")]) for regime, number in contacts.items()
        )
    )
    if min(contacts.values()) == 0 or len(statuses) < 2:
        different.append("the scans leave out a regime or a status: they compare too little")
    same = "all the same: byte for byte, or to round-off where contacts flow"
    print("\n".join(different) if different else same)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
