#!/usr/bin/env python3
"""The separation curve beside the half-space on pressed frames, both with flow; studies/trust
--flow calls it.

usage: flow_map.py FOLDER COUNT [--pixels N] [--seeds N,N,...] [--limit S] [--page FILE.md]

FOLDER/pressed.jsonl has a line per frame that the half-space has solved with and without flow, and
is gone on with. Predictions are made anew. The table goes to the standard output, and into its
section of the page. Progress goes to the standard error.
"""

import mems_stiction
import numpy as np

import section_study
import trust_kinds
import trust_run

SEEDS = "61,62,63"
HEADING = "## Pressed frames"
PLASTIC = 3  # of a contact map
BY_FLOW = (
    1.15  # a frame's force goes by flow where the half-space's differs by more with it and without
)


def of_half_space(frame, heights, limit):
    """Figures with flow, the force without; heights that flow has left beside those that there
    were, as the share of the frame's contact."""
    settings = trust_run.settings_of(frame, "separation_curve")
    try:
        with trust_run.time_limit(limit):
            flowed = mems_stiction.half_space(heights, frame["pitch"], settings)
            elastic = mems_stiction.half_space(
                heights,
                frame["pitch"],
                mems_stiction.Settings(settings, half_space={"flow": False}),
            )
    except trust_run.TooLong:
        return {"status": "TOO_LONG"}, None
    status = flowed.status if flowed.status != "SOLVED" else elastic.status
    if status != "SOLVED":
        return {"status": status}, None
    figures = {
        "status": status,
        "pull_off_force": flowed.pull_off_force,
        "elastic_force": elastic.pull_off_force,
        "contact_area": flowed.contact_area,
        "apparent_work_of_adhesion": flowed.apparent_work_of_adhesion,
        "is_resolved": flowed.is_resolved,
        "plastic_share": share_of(flowed.contact_map),
    }
    return figures, lost(heights, flowed)


def share_of(contact_map):
    """Of the contact that has flowed [-]."""
    contact = np.count_nonzero(contact_map)
    return float(np.count_nonzero(contact_map == PLASTIC) / contact) if contact else 0.0


def lost(heights, solution):
    """By which the gap has grown [m]."""
    upper = 0.0 if solution.deformed_upper is None else solution.deformed_upper
    return heights - (solution.deformed_lower - upper)


def line_of(frame, heights, limit):
    solved, by_half_space = of_half_space(frame, heights, limit)
    line = {"frame": frame, "half_space": solved}
    if by_half_space is not None:
        line["lost"] = [round(float(value) * 1e13) for value in by_half_space.ravel()]  # [0.1 pm]
    return line


def predicted(line, heights):
    """What the separation curve says, beside it."""
    frame, there = line["frame"], np.reshape(line["lost"], heights.shape) * 1e-13
    settings = mems_stiction.Settings(
        trust_run.settings_of(frame, "separation_curve"),
        output={"contact_map": True, "deformed_surfaces": True},
    )
    prediction = mems_stiction.predict(heights, frame["pitch"], settings)
    here = lost(heights, prediction)
    scale = float(np.sqrt(np.mean(there**2)))
    reference = line["half_space"]
    return {
        "force": prediction.pull_off_force / reference["pull_off_force"],
        "work": prediction.apparent_work_of_adhesion / reference["apparent_work_of_adhesion"],
        "area": prediction.contact_area / reference["contact_area"],
        "doubt": prediction.model_doubt,
        "share": share_of(prediction.contact_map) - reference["plastic_share"],
        "by_flow": reference["pull_off_force"] / reference["elastic_force"],
        "heights": float(np.sqrt(np.mean((here - there) ** 2))) / scale if scale else None,
        "plastic_share": reference["plastic_share"],
        "frame": frame,
    }


def drawn(number, arguments):
    seeds = [int(seed) for seed in arguments.seeds.split(",")]
    frame, heights = trust_kinds.draw_pressed(
        number // len(seeds), arguments.pixels, seeds[number % len(seeds)]
    )
    frame.update(number=number, seed=seeds[number % len(seeds)])
    return frame, heights.astype(float)


def study(arguments):
    lines = trust_run.solved_lines(
        arguments.folder / "pressed.jsonl",
        arguments.count,
        lambda number: drawn(number, arguments),
        lambda frame, heights: line_of(frame, heights, arguments.limit),
        "pixels and seeds",
    )
    return [
        predicted(line, drawn(line["frame"]["number"], arguments)[1])
        for line in lines
        if line["half_space"].get("is_resolved")
    ]


def within(ratios, factor):
    return "%.1f" % (100 * np.mean(np.abs(np.log(ratios)) < np.log(factor)))


def row_of(name, lines):
    if not lines:
        return "| %s | 0 |%s" % (name, " |" * 7)
    force, work, area = (
        np.array([line[figure] for line in lines]) for figure in ("force", "work", "area")
    )
    cells = [
        name,
        "%d" % len(lines),
        within(force, 1.15),
        within(force, 1.3),
        within(force, 1.6),
        "%.2f" % np.exp(np.abs(np.log(force)).max()),
        within(work, 1.2),
        within(area, 1.3),
        "%.0f" % (100 * np.mean([bool(line["doubt"]) for line in lines])),
    ]
    return "| " + " | ".join(cells) + " |"


def section_of(lines, arguments):
    flowed = [line for line in lines if line["plastic_share"] > 0.02]
    changed = [line for line in lines if abs(np.log(line["by_flow"])) > np.log(BY_FLOW)]
    sure = [line for line in lines if not line["doubt"]]
    text = [
        HEADING,
        "",
        "Written by `studies/trust --flow`: %d frames of %d x %d pixels that the half-space has "
        "solved. Seeds %s; all kinds of `studies/trust_kinds.py` in turn. E* 10 to 200 GPa, "
        "hardness %g to %g GPa of both bodies or of one, %g to %g MPa. Both solvers flow. "
        "*By flow*: the half-space's force differs by more than %g with flow and without; there "
        "its median is %.1f times that without. Shares are in percent."
        % (
            len(lines),
            arguments.pixels,
            arguments.pixels,
            arguments.seeds.replace(",", ", "),
            *(1e-9 * value for value in trust_kinds.PRESSED_HARDNESSES),
            *(1e-6 * value for value in trust_kinds.PRESSED_BY),
            BY_FLOW,
            np.median([line["by_flow"] for line in changed]) if changed else 1.0,
        ),
        "",
        "| frames | number | force within 1.15 | 1.3 | 1.6 | worst | work within 1.2 | area within "
        "1.3 | doubted |",
        "|---|---|---|---|---|---|---|---|---|",
        row_of("all", lines),
        row_of("without a doubt", sure),
        row_of("flowed over 2 % of the contact", flowed),
        row_of("by flow", changed),
        row_of("by flow, without a doubt", [line for line in changed if not line["doubt"]]),
    ]
    if flowed:
        errors = np.array([line["heights"] for line in flowed if line["heights"] is not None])
        text += [
            "",
            "Where they flow, the share of the contact that has flowed is within 0.1 of the "
            "half-space's on %.0f %%. The heights that are lost differ by %.0f %% in the median, "
            "rms, and by up to 20 %% on %.0f %%."
            % (
                100 * np.mean([abs(line["share"]) < 0.1 for line in flowed]),
                100 * np.median(errors),
                100 * np.mean(errors < 0.2),
            ),
        ]
    return "\n".join(text) + "\n"


def main():
    parser = section_study.parser_of(
        __doc__.split("\n\n")[0], 96, 60.0, "the half-spaces of a frame may take"
    )
    parser.add_argument("--seeds", default=SEEDS, help="sets of frames, in turn")
    section_study.run(parser.parse_args(), study, section_of, HEADING)


if __name__ == "__main__":
    main()
