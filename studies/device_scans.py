#!/usr/bin/env python3
"""How far is the force that mems_stiction says of a device from that of measured scans that are
large enough to be one? studies/device --scans calls it; lines that are there are not done again.

usage: device_scans.py RESULTS.jsonl FOLDER [--settings FILE] [--seed N]

Of each scan of the folder with square pixels, the largest square is the device. Parts of a quarter
of its side, and the whole with pixels as much larger as makes it 64 of them wide, are given to
predict_device. A line for each scan, draw of places and case.
"""

import argparse
import json
import math
import pathlib
import sys

import numpy as np
import scipy.stats

import device_surfaces
import mems_stiction

LEAST_SIDE = 256
WIDE_PIXELS = 64
PARTS, PLACES = 4, 3
PREPROCESSING = {"level": "plane"}


def square_of(path):
    """(heights, pitch) without missing pixels, or None."""
    try:
        scan = mems_stiction.read(path)
    except mems_stiction.Error:
        return None
    heights, pitch = np.asarray(scan.heights, dtype=float), scan.pitch
    side = min(heights.shape) // 4 * 4
    if side < LEAST_SIDE or abs(pitch[0] / pitch[1] - 1) > 0.01:
        return None
    heights = heights[:side, :side]
    return np.where(np.isnan(heights), np.nanmedian(heights), heights).astype(np.float32), pitch[0]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--settings")
    arguments = parser.parse_args()
    settings = (
        mems_stiction.Settings(arguments.settings)
        if arguments.settings
        else mems_stiction.Settings()
    )
    done = set()
    if arguments.results.exists():
        rows = [json.loads(line) for line in arguments.results.read_text().splitlines()]
        done = {(row["scan"], row["seed"], row["draw"], row["case"]) for row in rows}
    wholes = [
        (path.name, square_of(path))
        for path in sorted(arguments.folder.iterdir())
        if path.is_file()
    ]
    wholes = [(name, whole) for name, whole in wholes if whole is not None]
    with arguments.results.open("a") as out:
        for count in range(PLACES * len(wholes)):
            draw, (name, (heights, pitch)) = count // len(wholes), wholes[count % len(wholes)]
            side, part = heights.shape[0], heights.shape[0] // 4
            coarser = max(2, side // WIDE_PIXELS)
            random = np.random.default_rng([arguments.seed, draw])
            parts = [
                device_surfaces.part(
                    heights,
                    *(int(place) for place in random.integers(side - part + 1, size=2)),
                    part,
                )
                for _ in range(PARTS)
            ]
            for has_wide in (True, False):
                case = "k4+wide" if has_wide else "k4"
                if (name, arguments.seed, draw, case) in done:
                    continue
                truth = mems_stiction.predict(
                    heights, pitch, config=settings, preprocessing=PREPROCESSING
                )
                given = parts + [device_surfaces.coarse(heights, coarser)] * has_wide
                pitches = [pitch] * PARTS + [pitch * coarser] * has_wide
                found = mems_stiction.predict_device(
                    given,
                    area=(side * pitch) ** 2,
                    pitch=pitches,
                    config=settings,
                    preprocessing=PREPROCESSING,
                )
                reach = math.exp(
                    scipy.stats.t.ppf(0.975, len(found.realisations) - 1) * found.force_deviation
                )
                out.write(
                    json.dumps(
                        {
                            "scan": name,
                            "seed": arguments.seed,
                            "draw": draw,
                            "case": case,
                            "side": side,
                            "pitch": pitch,
                            "part": part,
                            "coarser": coarser,
                            "truth": truth.pull_off_force,
                            "is_conforming": truth.is_conforming,
                            "force": found.pull_off_force,
                            "surface_lower": found.pull_off_force / reach,
                            "surface_upper": found.pull_off_force * reach,
                            "deviation": found.force_deviation,
                            "linear": found.linear_pull_off_force,
                            "warnings": list(found.warnings),
                        }
                    )
                    + "\n"
                )
                out.flush()
            print(
                "surface %d of %d" % (count + 1, PLACES * len(wholes)), file=sys.stderr, flush=True
            )


if __name__ == "__main__":
    main()
