#!/usr/bin/env python3
"""Solves and predicts the frames of the error map; studies/trust calls it.

usage: trust_run.py FOLDER COUNT [--kinds] [--pixels N] [--seed N] [--scans FOLDER] [--limit S]

FOLDER/half_space.jsonl has a line per solved frame and is gone on with: it is the part that takes
long and does not depend on the formulations. FOLDER/predictions.jsonl is written anew. Progress
goes to the standard error.
"""

import argparse
import contextlib
import json
import pathlib
import signal
import sys
import warnings

import mems_stiction
import yaml

import trust_frames
import trust_kinds

FORMULATIONS = ("separation_curve", "paper", "printed")
HALF_SPACE_FIGURES = (
    "status",
    "pull_off_force",
    "apparent_work_of_adhesion",
    "contact_area",
    "contact_count",
    "is_resolved",
    "processing_time",
)
FIGURES = (
    "status",
    "pull_off_force",
    "apparent_work_of_adhesion",
    "contact_area",
    "nominal_area",
    "flattening_ratio",
    "is_conforming",
    "regime_flag_names",
    "asperity_count",
    "median_contact_pixels",
    "processing_time",
)


class TooLong(Exception):
    """A solution takes longer than it may."""


@contextlib.contextmanager
def time_limit(seconds):
    """Raises TooLong after so many seconds of processor time; Ctrl-C goes the same way."""

    def stop(*_):
        raise TooLong

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def settings_of(frame, formulation):
    return mems_stiction.Settings(
        yaml.safe_load(trust_frames.configuration(frame, formulation)),
        load={"mechanical_load": trust_frames.load_of(frame)},
    )


def half_space_of(frame, heights, limit):
    """Its figures, or why there are none."""
    try:
        with time_limit(limit):
            solved = mems_stiction.half_space(
                heights, frame["pitch"], settings_of(frame, "separation_curve")
            )
    except TooLong:
        return {"status": "TOO_LONG"}
    return {
        name: None if value != value else value
        for name, value in vars(solved).items()
        if name in HALF_SPACE_FIGURES
    }


def lines_of(path):
    """Whole lines only: an interrupted run may have left half of one."""
    if not path.exists():
        return []
    text = path.read_text()
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        path.write_text(whole)
    return [json.loads(line) for line in whole.splitlines()]


def solved_lines(path, count, drawn, line_of, same):
    """A line for each frame, by its number: as the file has it, else found now and added to it.

    drawn(number): (what the frame is, heights). line_of(frame, heights). same: what frames depend
    on, in words.
    """
    known = {line["frame"]["number"]: line for line in lines_of(path)}
    with open(path, "a") as file:
        for number in range(count):
            frame, heights = drawn(number)
            if number in known:
                if known[number]["frame"] != json.loads(json.dumps(frame)):
                    sys.exit(
                        "%s holds other frames than these: give another folder, or the same %s"
                        % (path, same)
                    )
                continue
            known[number] = line_of(frame, heights)
            file.write(json.dumps(known[number]) + "\n")
            file.flush()
            print("solved %d of %d" % (number + 1, count), file=sys.stderr, flush=True)
    return [known[number] for number in range(count)]


def chosen(record, names):
    return {name: record.get(name) for name in names}


def drawn(number, arguments, scans):
    if arguments.kinds:
        return trust_kinds.draw(number, arguments.pixels, arguments.seed)
    return trust_frames.draw(number, arguments.pixels, scans, arguments.seed)


def solve(arguments, scans):
    def line_of(frame, heights):
        solved = half_space_of(frame, heights, arguments.limit)
        return {"frame": frame, "half_space": chosen(solved, HALF_SPACE_FIGURES)}

    return solved_lines(
        arguments.folder / "half_space.jsonl",
        arguments.count,
        lambda number: drawn(number, arguments, scans),
        line_of,
        "scans, pixels and seed",
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument(
        "--kinds",
        action="store_true",
        help="of the surfaces that processes make, in place of the map's",
    )
    parser.add_argument("--pixels", type=int, default=128)
    parser.add_argument(
        "--seed", type=int, help="of the frames; another one draws frames that no rule was set on"
    )
    parser.add_argument("--scans", help="folder of imported scans")
    parser.add_argument(
        "--limit",
        type=float,
        default=90.0,
        help="seconds of processor time that one half-space may take",
    )
    arguments = parser.parse_args()
    if arguments.seed is None:
        arguments.seed = trust_kinds.SEED if arguments.kinds else trust_frames.SEED
    warnings.simplefilter("ignore", mems_stiction.ScanWarning)  # of heights that are as drawn
    scans = trust_frames.Scans(arguments.scans)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    solved = solve(arguments, scans)
    with open(arguments.folder / "predictions.jsonl", "w") as file:
        for line in solved:
            if line["half_space"]["status"] == "SOLVED":
                frame, heights = drawn(line["frame"]["number"], arguments, scans)
                line["rigid"] = trust_frames.rigid_pull_off(heights, frame)
                for formulation in FORMULATIONS:
                    prediction = mems_stiction.predict(
                        heights, frame["pitch"], settings_of(frame, formulation)
                    )
                    line[formulation] = chosen(prediction.to_dict(), FIGURES)
            file.write(json.dumps(line) + "\n")
            print(
                "predicted %d of %d" % (line["frame"]["number"] + 1, arguments.count),
                file=sys.stderr,
                flush=True,
            )


if __name__ == "__main__":
    main()
