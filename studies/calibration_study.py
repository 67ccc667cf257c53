#!/usr/bin/env python3
"""How often the intervals of calibrate() hold the truth: made measurements of several kinds, the
whole of calibrate(), outliers and all.

usage: calibration_study.py [--draws 200] [--first 0] [--output FOLDER] [CASE...]

A line for each case: draws, share of intervals that hold the work of adhesion the data were made
with, bias, draws of which a sound measurement was left out, draws in which the Hamaker constant was
fitted, too, and processor time. doc/process.md has them.

FOLDER/draws.jsonl has a line for each draw and is gone on with: another calibrate() needs another
folder. The case so far goes to the standard error after each draw.

The cases of parts have ten parts with surfaces of their own (rms height 1 to 4 nm, work of adhesion
20 to 150 mJ/m^2, both drawn for each set), whose forces are known to 15 %.
"""

import argparse
import json
import math
import pathlib
import sys
import time
import warnings

import mems_stiction
import numpy as np

import trust_run

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(REPOSITORY / "test" / "python"))
from module_cases import rough  # noqa: E402  (the path comes first)

PITCH = 10e-9
WORK = 0.031  # [J/m^2]
BEAM = {"thickness": 2e-6, "gap": 1e-6, "modulus": 169e9}
FORCES, WORKS, CRACKS = "pull_off_force", "apparent_work_of_adhesion", "crack_length"
CASES = {  # kind, how many, relative standard uncertainty
    "ten forces": ((FORCES, 10, 0.2),),
    "four forces": ((FORCES, 4, 0.2),),
    "two forces": ((FORCES, 2, 0.2),),
    "ten works": ((WORKS, 10, 0.2),),
    "ten beams": ((CRACKS, 10, 0.05),),
    "mixed": ((FORCES, 4, 0.2), (CRACKS, 3, 0.05), (WORKS, 3, 0.3)),
}


PARTS = {  # pixels along a part's side, scans of it or of others
    "own scans": (128, "own"),  # the scan is what was measured
    "two scans": (128, "two"),  # at other places, for all ten
    "larger, own scans": (256, "own"),
    "larger, two scans": (256, "two"),
}
SCANNED = 128  # pixels along a scan's side
OF_PARTS = 0.15  # relative standard uncertainty
ENDS = ("work_of_adhesion_lower", "work_of_adhesion_upper")
FIGURES = ("work_of_adhesion", *ENDS, "hamaker_constant_lower", "scatter")


def expected(kind, prediction):
    if kind == FORCES:
        return prediction.pull_off_force
    work = prediction.apparent_work_of_adhesion
    # de Boer and Michalske 1999
    return (
        work
        if kind == WORKS
        else (1.5 * BEAM["modulus"] * BEAM["thickness"] ** 3 * BEAM["gap"] ** 2 / work) ** 0.25
    )


def made_data(random, surfaces, predictions, case):
    """Forces, works and lengths of three surfaces, and the work of adhesion that they have."""
    data = []
    for kind, count, share in case:
        for place in range(count):
            value = expected(kind, predictions[place % 3]) * max(
                1.0 + share * random.standard_normal(), 0.05
            )
            beam = BEAM if kind == CRACKS else {}
            data.append(
                dict(
                    beam,
                    kind=kind,
                    value=value,
                    uncertainty=share * value,
                    scans=surfaces[place % 3],
                    pitch=PITCH,
                )
            )
    return WORK, data


def made_parts(random, side, scanned):
    """Forces of ten parts, and the work of adhesion that they have."""
    work, rms_height = 0.02 * 7.5 ** random.uniform(), 1e-9 * 4.0 ** random.uniform()
    parts = [rough(side, side, rms_height, random.randint(2**31 - 1)) for _ in range(10)]
    others = [rough(256, 256, rms_height, random.randint(2**31 - 1)) for _ in range(2)]
    data = []
    for part in parts:
        prediction = mems_stiction.predict(part, PITCH, interface={"work_of_adhesion": work})
        value = prediction.pull_off_force * max(1.0 + OF_PARTS * random.standard_normal(), 0.05)
        seen = [part] if scanned == "own" else others
        data.append(
            {
                "kind": FORCES,
                "value": value,
                "uncertainty": OF_PARTS * value,
                "pitch": PITCH,
                "scans": [scan[:SCANNED, :SCANNED] for scan in seen],
                "area": (side * PITCH) ** 2,
            }
        )
    return work, data


def drawn(random, make):
    """What calibrate() says of a set, and the truth."""
    work, data = make(random)
    begun = time.process_time()
    found = mems_stiction.calibrate(data)
    seconds = time.process_time() - begun
    figures = found.to_dict()
    return {
        "truth": work,
        "seconds": seconds,
        "statements": list(found.statements),
        "left_out": int(found.measurements.is_outlier.sum()),
        **{name: figures[name] for name in FIGURES},
    }


def summary(name, sets):
    told = [one for one in sets if one["work_of_adhesion"] is not None]
    held = sum(one[ENDS[0]] < one["truth"] < one[ENDS[1]] for one in told)
    logs = [math.log(one["work_of_adhesion"] / one["truth"]) for one in told]
    bias = 100.0 * math.expm1(float(np.mean(logs)) if logs else math.nan)
    return (
        "%s: %d draws, %d with a number; %d hold the truth, bias %+.1f %%, %d lost a measurement, "
        "Hamaker constant in %d, %.1f s of the processor each"
        % (
            name,
            len(sets),
            len(told),
            held,
            bias,
            sum(one["left_out"] > 0 for one in told),
            sum(one["hamaker_constant_lower"] is not None for one in told),
            float(np.mean([one["seconds"] for one in sets])),
        )
    )


def study(name, draws, make, path):
    known = {line["draw"]: line for line in trust_run.lines_of(path) if line["case"] == name}
    with open(path, "a") as file:
        for draw in draws:
            if draw in known:
                continue
            random = np.random.RandomState(1000 + draw)
            known[draw] = {"case": name, "draw": draw, **drawn(random, make)}
            file.write(json.dumps(known[draw]) + "\n")
            file.flush()
            print(summary(name, list(known.values())), file=sys.stderr, flush=True)
    print(summary(name, [known[draw] for draw in draws]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument(
        "cases", nargs="*", metavar="CASE", help="of: %s" % ", ".join([*CASES, *PARTS])
    )
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument(
        "--first", type=int, default=0, metavar="DRAW", help="number of the first draw"
    )
    parser.add_argument(
        "--output",
        type=pathlib.Path,
        metavar="FOLDER",
        help="where draws are kept",
        default=REPOSITORY / "out" / "calibration_study",
    )
    arguments = parser.parse_args()
    unknown = [name for name in arguments.cases if name not in CASES and name not in PARTS]
    if unknown:
        parser.error(
            "'%s' is not allowed, must be of: %s" % (unknown[0], ", ".join([*CASES, *PARTS]))
        )
    warnings.simplefilter("ignore")  # frames that are as drawn
    surfaces = [rough(96, 96, 3e-9, seed) for seed in range(3)]
    predictions = [
        mems_stiction.predict(heights, PITCH, interface={"work_of_adhesion": WORK})
        for heights in surfaces
    ]
    arguments.output.mkdir(parents=True, exist_ok=True)
    path = arguments.output / "draws.jsonl"
    draws = range(arguments.first, arguments.first + arguments.draws)
    for name in arguments.cases or [*CASES, *PARTS]:
        if name in PARTS:

            def make(random):
                return made_parts(random, *PARTS[name])
        else:

            def make(random):
                return made_data(random, surfaces, predictions, CASES[name])

        study(name, draws, make, path)


if __name__ == "__main__":
    main()
