#!/usr/bin/env python3
"""The half-space in its usual steps against a quarter of them, on frames of all kinds;
studies/trust --half-space-steps calls it.

usage: half_space_steps.py FOLDER COUNT [--pixels N] [--seed N] [--limit S] [--page FILE.md]

Frames are those of the error map and those that processes make, in turns; half of them are pressed.
FOLDER/steps.jsonl has a line per frame and is gone on with: after a change of the solver it is to
be removed. The table goes to the standard output, and into its section of the page. Progress goes
to the standard error.
"""

import math
import time

import mems_stiction
import numpy as np
import yaml
from mems_stiction.curve import Way, steep_steps

import section_study
import trust_frames
import trust_kinds
import trust_run

SEED = 32
QUARTER = 0.25
PRESSURES = 1e5, 1e8  # [Pa]
HEADING = "## What finer steps say"
FIGURES = (
    "status",
    "is_resolved",
    "is_converged",
    "is_step_converged",
    "pull_off_force",
    "apparent_work_of_adhesion",
    "contact_area",
    "jumps",
    "state_count",
    "iterations",
)
# Of which figure, how close [-], and what it is called.
COMPARED = {
    "pull_off_force": (0.005, "pull-off force"),
    "contact_area": (0.005, "contact area at rest"),
    "apparent_work_of_adhesion": (0.01, "work of adhesion"),
}
# A jump counts from this share of the pull-off force on, where the bodies carry less than so many
# times that force.
COUNTED_JUMP, COUNTED_LOAD = 0.05, 2.0


def drawn(number, pixels, seed):
    """(what the frame is, heights [m])"""
    if number % 2 == 0:
        frame, heights = trust_frames.draw(number // 2, pixels, trust_frames.Scans(None), seed)
    else:
        frame, heights = trust_kinds.draw(number // 2, pixels, seed)
    random = np.random.default_rng([seed, number, 1])
    pressure = trust_frames.log_uniform(random, *PRESSURES) if random.random() < 0.5 else 0.0
    frame.update(number=number, of_processes=number % 2 == 1, pressure=pressure)
    return frame, heights


def range_of(frame):
    """z0 [m]"""
    return math.sqrt(frame["hamaker"] / (16 * math.pi * frame["work"]))


def usual_step():
    """half_space/step, of z0."""
    return float(yaml.safe_load(mems_stiction.Settings().yaml())["half_space"]["step"])


def solved(frame, heights, step, limit):
    """Its figures and the heights and forces of both ways, or why there are none."""
    settings = mems_stiction.Settings(
        trust_run.settings_of(frame, "separation_curve"), half_space={"step": step}
    )
    begin = time.process_time()
    try:
        with trust_run.time_limit(limit):
            solution = mems_stiction.half_space(heights, frame["pitch"], settings)
    except trust_run.TooLong:
        return {"status": "TOO_LONG"}, []
    figures = dict(
        {name: getattr(solution, name) for name in FIGURES}, seconds=time.process_time() - begin
    )
    curve = solution.curve
    ways = [
        Way(np.column_stack([curve.height, curve.force])[curve.direction == direction])
        for direction in (0, 1)
    ]
    return {name: None if value != value else value for name, value in figures.items()}, ways


def light_part(way, is_approach, force):
    """Where the bodies carry less than this force."""
    heavy = np.flatnonzero(way.forces < -force)
    if not len(heavy):
        return way.heights, way.forces
    part = slice(0, heavy[0]) if is_approach else slice(heavy[-1] + 1, None)
    return way.heights[part], way.forces[part]


def passes(heights, forces, place, step):
    """Whether a curve goes over a jump (both heights and both forces) within a step of it."""
    (h_before, h_after), (f_before, f_after) = place
    direction = np.sign(h_after - h_before)
    along, ends = (
        direction * heights,
        direction * np.array([h_before, h_after]) + np.array([-step, step]),
    )
    inside = np.concatenate(
        [
            [np.interp(ends[0], along, forces)],
            forces[(along > ends[0]) & (along < ends[1])],
            [np.interp(ends[1], along, forces)],
        ]
    )
    middle, sense = 0.5 * (f_before + f_after), np.sign(f_after - f_before)
    is_beyond = sense * (inside - middle) >= 0
    return bool((~is_beyond).any() and is_beyond[int(np.argmin(is_beyond)) :].any())


def jumps_of(ways, reference, pull_off, step):
    """Jumps that the reference has, and how many of them these ways have within a step."""
    count = met = 0
    for is_approach, way, other in zip((True, False), ways, reference):
        heights, forces = light_part(other, is_approach, COUNTED_LOAD * pull_off)
        if len(heights) < 3 or not len(way):
            continue
        for place in steep_steps(heights, forces):
            pair = slice(place, place + 2)
            if abs(np.diff(forces[pair])[0]) >= COUNTED_JUMP * pull_off:
                count += 1
                met += passes(way.heights, way.forces, (heights[pair], forces[pair]), step)
    return count, met


def line_of(frame, heights, limit):
    step = usual_step()
    usual, ways = solved(frame, heights, step, limit)
    line = {"frame": frame, "usual": usual, "fine": None, "jumps": None}
    if usual["status"] == "SOLVED":
        line["fine"], reference = solved(frame, heights, QUARTER * step, limit / QUARTER)
        if line["fine"]["status"] == "SOLVED":
            line["jumps"] = jumps_of(
                ways, reference, line["fine"]["pull_off_force"], step * range_of(frame)
            )
    return line


def study(arguments):
    return trust_run.solved_lines(
        arguments.folder / "steps.jsonl",
        arguments.count,
        lambda number: drawn(number, arguments.pixels, arguments.seed),
        lambda frame, heights: line_of(frame, heights, arguments.limit),
        "pixels and seed",
    )


def deviation(line, name):
    """Of the usual steps from the fine ones [-]; within a cell an area is the same."""
    usual, fine = line["usual"][name], line["fine"][name]
    if name == "contact_area" and abs(usual - fine) < 1.5 * line["frame"]["pitch"] ** 2:
        return 0.0
    return usual / fine - 1 if fine else (0.0 if usual == fine else math.inf)


def is_out(line):
    return any(abs(deviation(line, name)) > limit for name, (limit, _) in COMPARED.items())


def percent(share):
    return "%.1f" % (100 * share)


def row_of(name, lines):
    """Of a group of frames that both steps solved."""
    cells = [name, "%d" % len(lines)]
    for figure, (limit, _) in COMPARED.items():
        found = np.array([abs(deviation(line, figure)) for line in lines])
        cells += (
            [percent(np.mean(found <= limit)), percent(found.max())] if len(lines) else ["", ""]
        )
    count, met = (sum(line["jumps"][i] for line in lines) for i in (0, 1))
    cells += [
        "%d of %d" % (met, count),
        percent(
            sum(line["usual"]["seconds"] for line in lines)
            / max(1e-9, sum(line["fine"]["seconds"] for line in lines))
        ),
    ]
    return "| " + " | ".join(cells) + " |"


def section_of(lines, arguments):
    both = [line for line in lines if line["fine"] and line["fine"]["status"] == "SOLVED"]
    resolved = [line for line in both if line["usual"]["is_resolved"]]
    others = {}
    for line in lines:
        for which in ("usual", "fine"):
            if line[which] and line[which]["status"] != "SOLVED":
                others.setdefault((which, line[which]["status"]), []).append(
                    line["frame"]["number"]
                )
    text = [
        HEADING,
        "",
        "Written by `studies/trust --half-space-steps`: %d frames of %d x %d pixels, seed %d, "
        "alternately of the [map's](trust.md) kinds and of those that [processes](trust_kinds.md) "
        "make. Half of them are under %.2g to %.0f MPa; nothing flows. Each frame is solved with "
        "the default `half_space/step` of %g and with a quarter of it. Shares are of the frames "
        "that both solved, in percent, as deviations and times are; an area may differ by a cell. "
        "Jumps of at least %g %% of the pull-off force count. *Time* is the processor time of the "
        "usual steps over that of the fine ones."
        % (
            len(lines),
            arguments.pixels,
            arguments.pixels,
            arguments.seed,
            1e-6 * PRESSURES[0],
            1e-6 * PRESSURES[1],
            usual_step(),
            100 * COUNTED_JUMP,
        ),
        "",
        "| frames | number | "
        + " | ".join(
            "%s within %g %% | worst" % (name, 100 * limit) for limit, name in COMPARED.values()
        )
        + " | jumps met | time |",
        "|---|---|" + "---|---|" * len(COMPARED) + "---|---|",
    ]
    text += [
        row_of("all", both),
        row_of("resolved", resolved),
        row_of(
            "resolved, not pressed", [line for line in resolved if not line["frame"]["pressure"]]
        ),
        row_of("resolved, pressed", [line for line in resolved if line["frame"]["pressure"]]),
    ]
    text += [
        "",
        "Resolved frames of which a figure is out: %d of %d."
        % (sum(is_out(line) for line in resolved), len(resolved)),
    ]
    unsolved = [
        "%s in %s steps: %d"
        % (status, {"usual": "the usual", "fine": "the fine"}[which], len(numbers))
        for (which, status), numbers in sorted(others.items())
    ]
    text[-1] += " Not solved: %s." % "; ".join(unsolved) if unsolved else " All were solved."
    return "\n".join(text) + "\n"


def main():
    parser = section_study.parser_of(
        __doc__.split("\n\n")[0],
        96,
        30.0,
        "the usual steps may take; the fine ones four times as many",
    )
    parser.add_argument("--seed", type=int, default=SEED)
    section_study.run(parser.parse_args(), study, section_of, HEADING)


if __name__ == "__main__":
    main()
