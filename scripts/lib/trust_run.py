#!/usr/bin/env python3
"""Solves and predicts the frames of the error map; scripts/trust calls it.

usage: trust_run.py PREDICT_SCAN FOLDER COUNT [--pixels N] [--scans FOLDER] [--limit S]

FOLDER/half_space.jsonl has a line per solved frame and is gone on with: it is the part that takes long and does not depend on
the formulations. FOLDER/predictions.jsonl is written anew. Progress goes to the standard error.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import cv2

import trust_frames

FORMULATIONS = ("consistent", "paper", "printed")
HALF_SPACE_FIGURES = ("status", "pull_off_force", "apparent_work_of_adhesion", "contact_area", "contact_count", "is_resolved",
                      "processing_time")
FIGURES = ("status", "pull_off_force", "apparent_work_of_adhesion", "contact_area", "nominal_area", "flattening_ratio",
           "is_conforming", "asperity_count", "median_contact_pixels", "processing_time")


class Predictor:
    """predict_scan on one frame after the other, in a folder that goes away."""

    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)

    def put(self, heights):
        cv2.imwrite(str(self.folder / "frame.tiff"), heights)

    def run(self, frame, formulation, *arguments, limit=None):
        """The record, or why there is none."""
        (self.folder / "settings.yaml").write_text(trust_frames.configuration(frame, formulation))
        command = [self.program, "--config", self.folder / "settings.yaml", "--pitch", repr(frame["pitch"]),
                   "--load", repr(trust_frames.load_of(frame)), "--json", *arguments, self.folder / "frame.tiff"]
        try:
            done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  universal_newlines=True, timeout=limit)
        except subprocess.TimeoutExpired:
            return {"status": "TOO_LONG"}
        if done.returncode != 0:
            sys.exit("frame %d, %s: %s" % (frame["number"], formulation, done.stderr.strip()))
        return json.loads(done.stdout)


def lines_of(path):
    """Whole lines only: an interrupted run may have left half of one."""
    if not path.exists():
        return []
    text = path.read_text()
    whole = text[:text.rfind("\n") + 1]
    if whole != text:
        path.write_text(whole)
    return [json.loads(line) for line in whole.splitlines()]


def chosen(record, names):
    return {name: record.get(name) for name in names}


def solve(predictor, arguments, scans):
    path = arguments.folder / "half_space.jsonl"
    solved = {line["frame"]["number"]: line for line in lines_of(path)}
    with open(path, "a") as file:
        for number in range(arguments.count):
            frame, heights = trust_frames.draw(number, arguments.pixels, scans)
            if number in solved:
                if solved[number]["frame"] != json.loads(json.dumps(frame)):
                    sys.exit("%s holds other frames than these: give another --output, or the same scans and pixels" % path)
                continue
            predictor.put(heights)
            record = predictor.run(frame, "consistent", "--half-space", limit=arguments.limit)
            line = {"frame": frame, "half_space": chosen(record.get("half_space", record), HALF_SPACE_FIGURES)}
            file.write(json.dumps(line) + "\n")
            file.flush()
            solved[number] = line
            print("solved %d of %d" % (number + 1, arguments.count), file=sys.stderr, flush=True)
    return [solved[number] for number in range(arguments.count)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--pixels", type=int, default=128)
    parser.add_argument("--scans", help="folder of imported scans")
    parser.add_argument("--limit", type=float, default=90.0, help="seconds that one half-space may take")
    arguments = parser.parse_args()
    scans = trust_frames.Scans(arguments.scans)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        predictor = Predictor(arguments.program, folder)
        solved = solve(predictor, arguments, scans)
        with open(arguments.folder / "predictions.jsonl", "w") as file:
            for line in solved:
                if line["half_space"]["status"] == "SOLVED":
                    frame, heights = trust_frames.draw(line["frame"]["number"], arguments.pixels, scans)
                    predictor.put(heights)
                    line["rigid"] = trust_frames.rigid_pull_off(heights, frame)
                    for formulation in FORMULATIONS:
                        line[formulation] = chosen(predictor.run(frame, formulation), FIGURES)
                file.write(json.dumps(line) + "\n")
                print("predicted %d of %d" % (line["frame"]["number"] + 1, arguments.count), file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
