#!/usr/bin/env python3
"""How often the intervals of calibrate() hold the truth: made measurements of several kinds, the whole of calibrate(), outliers and all.

usage: calibration_study.py [--draws 200] [CASE...]

A line for each case: draws, share of intervals that hold the work of adhesion the data were made with, bias, draws of which a sound measurement was left
out, draws in which the Hamaker constant was fitted, too. doc/process.md has them.
"""

import argparse
import math
import pathlib
import sys
import warnings

import mems_stiction
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "test" / "python"))
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


def expected(kind, prediction):
    if kind == FORCES:
        return prediction.pull_off_force
    work = prediction.apparent_work_of_adhesion
    # de Boer and Michalske 1999
    return work if kind == WORKS else (1.5 * BEAM["modulus"] * BEAM["thickness"] ** 3 * BEAM["gap"] ** 2 / work) ** 0.25


def study(name, draws, surfaces, predictions):
    held, logs, outliers, hamaker = 0, [], 0, 0
    for draw in range(draws):
        random = np.random.RandomState(1000 + draw)
        data = []
        for kind, count, share in CASES[name]:
            for place in range(count):
                value = expected(kind, predictions[place % 3]) * max(1.0 + share * random.standard_normal(), 0.05)
                data.append(dict(BEAM if kind == CRACKS else {}, kind=kind, value=value, uncertainty=share * value, scans=surfaces[place % 3], pitch=PITCH))
        found = mems_stiction.calibrate(data)
        if math.isnan(found.work_of_adhesion):
            continue
        held += found.work_of_adhesion_lower < WORK < found.work_of_adhesion_upper
        logs.append(math.log(found.work_of_adhesion / WORK))
        outliers += bool(found.measurements.is_outlier.any())
        hamaker += not math.isnan(found.hamaker_constant_lower)
    told = max(len(logs), 1)
    print("%s: %d draws, %d with a number; %.1f %% hold the truth, bias %+.1f %%, %d lost a measurement, Hamaker constant in %d" % (
        name, draws, len(logs), 100.0 * held / told, 100.0 * math.expm1(float(np.mean(logs)) if logs else math.nan), outliers, hamaker), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", metavar="CASE", help="of: %s" % ", ".join(CASES))
    parser.add_argument("--draws", type=int, default=200)
    arguments = parser.parse_args()
    unknown = [name for name in arguments.cases if name not in CASES]
    if unknown:
        parser.error("'%s' is not allowed, must be of: %s" % (unknown[0], ", ".join(CASES)))
    warnings.simplefilter("ignore")  # frames that are as drawn
    surfaces = [rough(96, 96, 3e-9, seed) for seed in range(3)]
    predictions = [mems_stiction.predict(heights, PITCH, interface={"work_of_adhesion": WORK}) for heights in surfaces]
    for name in arguments.cases or CASES:
        study(name, arguments.draws, surfaces, predictions)


if __name__ == "__main__":
    main()
