#!/usr/bin/env python3
"""The pressed frame of half_space_bench by tamaas (Polonsky and Keer), in the same session;
scripts/bench calls it.

usage: bench_tamaas.py ROWS.json FRAME.f64

Adds rows to ROWS.json: what half_space_bench took of the processor, over what tamaas takes for the
one state at rest, one thread. It has no attraction and a hard wall: areas of contact are compared
where nothing attracts. Needs tamaas and NumPy alone.
"""

import json
import pathlib
import sys
import time

import numpy as np
import tamaas

PITCH = 10e-9  # [m]
MODULUS = 88.8e9  # contact modulus [Pa]
TOLERANCE = 1e-8


def solved(heights, pressure):
    """Processor time [s] and share of the frame that touches, lengths in pixels and pressures in
    MODULUS."""
    shape = list(heights.shape)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, shape, shape)
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.PolonskyKeerRey(model, heights / PITCH, TOLERANCE)
    solver.max_iter = 10000
    begin = time.process_time()
    error = solver.solve(pressure / MODULUS)
    seconds = time.process_time() - begin
    if not error <= TOLERANCE:
        sys.exit("tamaas found no state under %g Pa: its error is %g" % (pressure, error))
    return seconds, tamaas.Statistics2D.contact(model.traction)


def rows_beside(rows, heights):
    states = {}
    for row in rows:
        if "pressure" not in row:
            continue
        if row["pressure"] not in states:
            states[row["pressure"]] = solved(heights, row["pressure"])
        seconds, share = states[row["pressure"]]
        yield {
            "work": row["work"] + " over tamaas",
            "figure": row["seconds"] / seconds,
            "unit": "times",
            "limit": row["limit_of_tamaas"],
            "at_least": False,
        }
        if "without attraction" in row["work"]:
            yield {
                "work": "  its contact area over tamaas'",
                "figure": row["contact_fraction"] / share,
                "unit": "times",
                "limit": None,
            }


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    path = pathlib.Path(sys.argv[1])
    rows = json.loads(path.read_text())
    heights = np.fromfile(sys.argv[2])
    side = round(len(heights) ** 0.5)
    tamaas.set_log_level(tamaas.LogLevel.error)
    path.write_text(
        json.dumps(rows + list(rows_beside(rows, heights.reshape(side, side))), indent=2) + "\n"
    )


if __name__ == "__main__":
    main()
