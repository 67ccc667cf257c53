#!/usr/bin/env python3
"""Small frames of the error map's kinds as half-spaces: median and sum of what they take of the
processor; scripts/bench calls it.

usage: bench_half_space_frames.py ROWS.json [--count N] [--pixels N]

Adds rows to ROWS.json, in pairs: a forward and an inverse real transform of such a frame by SciPy,
in the same run.
"""

import argparse
import json
import pathlib
import sys
import time
import warnings

import mems_stiction
import numpy as np
import scipy.fft

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "studies"))
import trust_kinds  # noqa: E402  (the path comes first)
import trust_run  # noqa: E402

REPETITIONS = 41


def pair_seconds(pixels):
    heights = np.random.default_rng(1).standard_normal((pixels, pixels))
    times = []
    for _ in range(REPETITIONS):
        begin = time.process_time()
        scipy.fft.irfft2(scipy.fft.rfft2(heights), s=heights.shape)
        times.append(time.process_time() - begin)
    return float(np.median(times))


def solved(number, pixels):
    """Processor time [s]"""
    frame, heights = trust_kinds.draw(number, pixels)
    settings = trust_run.settings_of(frame, "separation_curve")
    begin = time.process_time()
    solution = mems_stiction.half_space(heights, frame["pitch"], settings)
    if solution.status != "SOLVED":
        sys.exit("frame %d, %s: %s" % (number, frame["kind"], solution.status))
    return time.process_time() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("rows", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=3 * len(trust_kinds.ALIKE))
    parser.add_argument("--pixels", type=int, default=160)
    arguments = parser.parse_args()
    for of_draws in (mems_stiction.ScanWarning, mems_stiction.SettingsWarning):
        warnings.simplefilter("ignore", of_draws)
    rows = json.loads(arguments.rows.read_text())
    pair = pair_seconds(arguments.pixels)
    pairs = np.array([solved(number, arguments.pixels) for number in range(arguments.count)]) / pair
    frames = "%d frames of %d x %d of the error map's kinds" % (
        arguments.count,
        arguments.pixels,
        arguments.pixels,
    )
    for name, figure in (("median", float(np.median(pairs))), ("sum", float(pairs.sum()))):
        rows.append(
            {"work": "%s, %s" % (frames, name), "figure": figure, "unit": "pairs", "limit": None}
        )
    arguments.rows.write_text(json.dumps(rows, indent=2) + "\n")


if __name__ == "__main__":
    main()
