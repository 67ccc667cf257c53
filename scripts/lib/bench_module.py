#!/usr/bin/env python3
"""How long do many small frames take through the Python module, and how long by a call of
predict_scan for each?

usage: bench_module.py PREDICT_SCAN [--frames N] [--pixels N]

Prints a row for each way: wall time, and the processors' time of this process and its children,
which other programs on the machine disturb less. Frames are Gaussian; every way must give the same
forces.
"""

import argparse
import json
import os
import resource
import subprocess
import tempfile
import time

import mems_stiction
import numpy as np

PITCH = 20e-9  # [m]
ROUGHNESS = {
    "type": "gaussian",
    "gaussian": {"rms_height": 5e-9, "correlation_length_x": 1e-7, "correlation_length_y": 1e-7},
}


def processor_seconds():
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def by_program(program, frames):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "frame.npy")
        for frame in frames:
            np.save(path, frame)
            done = subprocess.run(
                [program, "--json", "--pitch", repr(PITCH), path],
                stdout=subprocess.PIPE,
                check=True,
            )
            yield json.loads(done.stdout.decode())["pull_off_force"]


def by_predictor(frames):
    predictor = mems_stiction.Predictor()
    return [predictor.predict(frame, PITCH).pull_off_force for frame in frames]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("program", metavar="PREDICT_SCAN")
    parser.add_argument("--frames", type=int, default=1000, metavar="N")
    parser.add_argument("--pixels", type=int, default=128, metavar="N", help="of a side")
    arguments = parser.parse_args()
    frames = [
        mems_stiction.generate(
            (arguments.pixels,) * 2, PITCH, counter_surface={**ROUGHNESS, "seed": seed}
        ).heights
        for seed in range(1, arguments.frames + 1)
    ]
    ways = (
        ("predict_scan, a process for each", lambda: list(by_program(arguments.program, frames))),
        (
            "predict()",
            lambda: [mems_stiction.predict(frame, PITCH).pull_off_force for frame in frames],
        ),
        ("Predictor.predict()", lambda: by_predictor(frames)),
        (
            "predict_many()",
            lambda: [one.pull_off_force for one in mems_stiction.predict_many(frames, PITCH)],
        ),
    )
    first = None
    print(
        "%-34s %10s %16s %14s"
        % (
            "%d frames of %d x %d" % (arguments.frames, arguments.pixels, arguments.pixels),
            "wall [s]",
            "processors [s]",
            "times as fast",
        )
    )
    for name, run in ways:
        wall, used = time.perf_counter(), processor_seconds()
        forces = run()
        wall, used = time.perf_counter() - wall, processor_seconds() - used
        first = first or (forces, wall, used)
        if forces != first[0]:
            raise SystemExit("%s: other forces than predict_scan" % name)
        print(
            "%-34s %10.2f %16.2f %14s"
            % (name, wall, used, "%.0f, %.0f" % (first[1] / wall, first[2] / used)),
            flush=True,
        )


if __name__ == "__main__":
    main()
