#!/usr/bin/env python3
"""Measures the unit of the device's answers: a transform of 4096 x 4096 numbers and its inverse by
numpy, double, one thread.

usage: bench_transform_pair.py OUTPUT.json   {"seconds": processor time, the least of three}
"""

import json
import pathlib
import sys
import time

import numpy as np

SIDE = 4096


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    heights = np.random.default_rng(1).standard_normal((SIDE, SIDE))
    seconds = []
    for _ in range(3):
        start = time.process_time()
        np.fft.irfft2(np.fft.rfft2(heights), heights.shape)
        seconds.append(time.process_time() - start)
    pathlib.Path(sys.argv[1]).write_text(json.dumps({"seconds": min(seconds)}) + "\n")


if __name__ == "__main__":
    main()
