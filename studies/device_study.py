#!/usr/bin/env python3
"""How far is the force that mems_stiction says of a device from that of large surfaces that are
known? studies/device calls it.

usage: device_study.py RESULTS.jsonl COUNT [--side N] [--seed N] [--kinds A,B] [--cases
k4+wide,k1,...] [--settings FILE]

Of each surface, parts of SCAN x SCAN pixels and, for "+wide", the whole at pixels eight times as
large are given to predict_device. A line for each surface and case; those that are there are not
done again.
"""

import argparse
import json
import math
import pathlib
import sys
import time

import numpy as np
import scipy.stats

import device_surfaces
import mems_stiction

PITCH = 10e-9
SCAN = 512
COARSER = 8
PREPROCESSING = {"level": "plane"}


def parts_of(heights, count, random):
    last = heights.shape[0] - SCAN
    return [
        device_surfaces.part(
            heights, int(random.integers(last + 1)), int(random.integers(last + 1)), SCAN
        )
        for _ in range(count)
    ]


def case_of(name):
    """ "k4+wide": (4, True)."""
    count, _, wide = name.partition("+")
    return int(count[1:]), bool(wide)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("count", type=int, help="surfaces of each kind")
    parser.add_argument("--side", type=int, default=4096)
    parser.add_argument("--seed", type=int, default=21)
    parser.add_argument("--kinds", default=",".join(device_surfaces.KINDS))
    parser.add_argument("--cases", default="k4+wide,k1+wide,k1,k4,k16")
    parser.add_argument("--settings")
    arguments = parser.parse_args()
    settings = (
        mems_stiction.Settings(arguments.settings)
        if arguments.settings
        else mems_stiction.Settings()
    )
    done = set()
    if arguments.results.exists():
        for line in arguments.results.read_text().splitlines():
            row = json.loads(line)
            done.add((row["seed"], row["side"], row["kind"], row["number"], row["case"]))
    kinds, cases = arguments.kinds.split(","), arguments.cases.split(",")
    total, count = arguments.count * len(kinds), 0
    with arguments.results.open("a") as out:
        for number in range(arguments.count):
            for kind in kinds:
                count += 1
                missing = [
                    case
                    for case in cases
                    if (arguments.seed, arguments.side, kind, number, case) not in done
                ]
                if not missing:
                    continue
                what, heights = device_surfaces.draw(
                    kind, number, arguments.seed, arguments.side, PITCH
                )
                truth = mems_stiction.predict(heights, PITCH, settings)
                for case in missing:
                    scans, wide = case_of(case)
                    random = np.random.default_rng([arguments.seed, number, scans])
                    given = parts_of(heights, scans, random)
                    pitches = [PITCH] * scans
                    if wide:
                        given.append(device_surfaces.coarse(heights, COARSER))
                        pitches.append(PITCH * COARSER)
                    start = time.monotonic()
                    found = mems_stiction.predict_device(
                        given,
                        area=(arguments.side * PITCH) ** 2,
                        pitch=pitches,
                        config=settings,
                        preprocessing=PREPROCESSING,
                    )
                    # Student's distribution, as the program has it, for what the scans leave open
                    # alone
                    reach = math.exp(
                        scipy.stats.t.ppf(0.975, len(found.realisations) - 1)
                        * found.force_deviation
                    )
                    ends = found.pull_off_force / reach, found.pull_off_force * reach
                    row = dict(
                        what,
                        seed=arguments.seed,
                        side=arguments.side,
                        case=case,
                        truth=truth.pull_off_force,
                        true_work=truth.apparent_work_of_adhesion,
                        is_conforming=truth.is_conforming,
                        force=found.pull_off_force,
                        lower=found.pull_off_force_lower,
                        upper=found.pull_off_force_upper,
                        deviation=found.force_deviation,
                        surface_lower=ends[0],
                        surface_upper=ends[1],
                        work=found.apparent_work_of_adhesion,
                        linear=found.linear_pull_off_force,
                        warnings=list(found.warnings),
                        time=time.monotonic() - start,
                    )
                    out.write(json.dumps(row) + "\n")
                    out.flush()
                print("surface %d of %d" % (count, total), file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
