#!/usr/bin/env python3
"""The separation curve beside the half-space with native oxide, a contact potential and water;
studies/trust --effects calls it.

usage: effects_map.py FOLDER COUNT [--pixels N] [--seed N] [--limit S] [--page FILE.md]

Each frame is solved as it is and with each of the effects. FOLDER/effects.jsonl has a line per
frame that the half-space has solved, and is gone on with. Predictions are made anew. The table goes
to the standard output, and into its section of the page. Progress goes to the standard error.
"""

import mems_stiction
import numpy as np

import section_study
import trust_frames
import trust_run
from flow_map import within

SEED = 52
HEADING = "## Oxide, water, contact potential"
PIXELS_PER_LENGTH = 10.0
LOAD_EVERY = 3
PRESSURES = 1e5, 1e8  # [Pa]
RANGES = {
    "length": (15e-9, 120e-9),  # [m]
    "rms": (0.2e-9, 8e-9),  # [m]
    "modulus": (3e9, 100e9),  # [Pa]
    "work": (0.02, 0.1),  # [J/m^2]
}
HAMAKER = 65e-21  # [J]
FILM = {"film_thickness": 2e-9, "hamaker_constant": 261e-21}  # native oxide over silicon
WATER = {"relative_humidity": 0.3}
PLAIN = "without an effect"
EFFECTS = {
    PLAIN: {},
    "native oxide": {"lower": FILM, "upper": FILM, "interface": {"retardation_length": 20e-9}},
    "0.2 V": {"interface": {"insulator_thickness": 4e-9}, "load": {"contact_potential": 0.2}},
    "30 % humidity": {"interface": WATER},
    "30 % humidity, water films": {"interface": dict(WATER, water_film=0.8e-9)},
}
FIGURES = "pull_off_force", "apparent_work_of_adhesion"


def drawn(number, pixels, seed):
    """(what the frame is, heights [m]): Gaussian and self-affine in turns, a third of them
    pressed."""
    random = np.random.default_rng([seed, number])
    while True:
        frame = {name: trust_frames.log_uniform(random, *ends) for name, ends in RANGES.items()}
        frame.update(hamaker=HAMAKER, pitch=frame["length"] / PIXELS_PER_LENGTH)
        frame["cohesive_length"] = trust_frames.cohesive_length(
            frame["modulus"], frame["work"], HAMAKER
        )
        if frame["rms"] < frame["length"] / 8 and frame["cohesive_length"] > 2 * frame["pitch"]:
            break
    is_gaussian = number % 2 == 0
    spectrum = (
        trust_frames.gaussian_spectrum(frame["length"])
        if is_gaussian
        else trust_frames.self_affine(2 * frame["length"], frame["pitch"], 0.8)
    )
    is_pressed = number % LOAD_EVERY == LOAD_EVERY - 1
    frame.update(
        number=number,
        pixels=pixels,
        kind="gaussian" if is_gaussian else "self-affine",
        pressure=trust_frames.log_uniform(random, *PRESSURES) if is_pressed else 0.0,
    )
    heights = trust_frames.spectrum_surface(pixels, frame["pitch"], spectrum, random)
    return frame, (frame["rms"] * heights).astype(np.float32)


def settings_of(frame, effect):
    return mems_stiction.Settings(
        trust_run.settings_of(frame, "separation_curve"), **EFFECTS[effect]
    )


def of_half_space(frame, heights, effect, limit):
    """Its figures, or why there are none."""
    try:
        with trust_run.time_limit(limit):
            solved = mems_stiction.half_space(heights, frame["pitch"], settings_of(frame, effect))
    except trust_run.TooLong:
        return {"status": "TOO_LONG"}
    if solved.status != "SOLVED":
        return {"status": solved.status}
    return {
        "status": solved.status,
        "is_resolved": solved.is_resolved,
        "half_space": [getattr(solved, figure) for figure in FIGURES],
    }


def predicted(line, heights):
    """With what the separation curve says beside each of the half-spaces."""
    found = {}
    for effect, solved in line["found"].items():
        found[effect] = dict(solved)
        if solved["status"] == "SOLVED":
            curve = mems_stiction.predict(
                heights, line["frame"]["pitch"], settings_of(line["frame"], effect)
            )
            found[effect].update(
                doubt=curve.model_doubt, curve=[getattr(curve, figure) for figure in FIGURES]
            )
    return dict(line, found=found)


def study(arguments):
    def drawn_here(number):
        return drawn(number, arguments.pixels, arguments.seed)

    def line_of(frame, heights):
        found = {name: of_half_space(frame, heights, name, arguments.limit) for name in EFFECTS}
        return {"frame": frame, "found": found}

    lines = trust_run.solved_lines(
        arguments.folder / "effects.jsonl", arguments.count, drawn_here, line_of, "pixels and seed"
    )
    return [predicted(line, drawn_here(line["frame"]["number"])[1]) for line in lines]


def holds(line, effect):
    """Whether the half-space judges this frame with this effect."""
    found = line["found"][effect]
    return (
        found["status"] == "SOLVED"
        and found["is_resolved"]
        and min(found["half_space"] + found["curve"]) > 0.0
    )


def figures_of(lines, effect, solver, figure):
    """Of half_space or curve; figure: its place in FIGURES."""
    return np.array([line["found"][effect][solver][figure] for line in lines])


def row_of(effect, lines):
    of_effect = [line for line in lines if holds(line, effect)]
    if not of_effect:
        return "| %s | 0 |%s" % (effect, " |" * 11)
    force, work = (
        figures_of(of_effect, effect, "curve", figure)
        / figures_of(of_effect, effect, "half_space", figure)
        for figure in range(len(FIGURES))
    )
    is_sure = np.array([not line["found"][effect]["doubt"] for line in of_effect])
    cells = [
        effect,
        "%d" % len(of_effect),
        within(force, 1.15),
        within(force, 1.3),
        within(work, 1.2),
        "%.0f" % (100 * np.mean(~is_sure)),
    ]
    cells += (
        [
            within(force[is_sure], 1.15),
            within(force[is_sure], 1.3),
            "%.2f" % np.exp(np.abs(np.log(force[is_sure])).max()),
        ]
        if is_sure.any()
        else [""] * 3
    )
    return "| " + " | ".join(cells + changes_of(effect, lines)) + " |"


def changes_of(effect, lines):
    """By which factor the effect changes the half-space's work, and how far the curve's factor is
    from that."""
    both = [line for line in lines if holds(line, effect) and holds(line, PLAIN)]
    if effect == PLAIN or not both:
        return [""] * 3
    by_half_space, by_curve = (
        np.log(figures_of(both, effect, solver, 1) / figures_of(both, PLAIN, solver, 1))
        for solver in ("half_space", "curve")
    )
    differences = np.abs(by_curve - by_half_space)
    return [
        "%.2f" % np.exp(np.median(by_half_space)),
        "%.1f" % (100 * np.median(differences)),
        "%.1f" % (100 * np.quantile(differences, 0.95)),
    ]


def section_of(lines, arguments):
    text = [
        HEADING,
        "",
        "Written by `studies/trust --effects`: %d frames of %d x %d pixels, seed %d, Gaussian and "
        "self-affine in turns; rms heights of %g to %g nm, correlation lengths of %g to %g nm, "
        "contact moduli of %g to %g GPa, works of adhesion of %g to %g mJ/m^2; a third is pressed "
        "with %g to %g MPa. *Native oxide*: 2 nm over silicon, retarded (S3a). *0.2 V*: a contact "
        "potential over 4 nm of oxide. *Water films*: 0.8 nm on each face. Only frames that the "
        "half-space solved within %g s and whose pixels resolve the cohesive length count. Shares "
        "are in percent. *Work*: the factor by which the effect changes the half-space's work, "
        "its median; and how far the curve's factor differs from that, its median and 95 %% "
        "quantile [%%]."
        % (
            len(lines),
            arguments.pixels,
            arguments.pixels,
            arguments.seed,
            *(1e9 * value for value in RANGES["rms"]),
            *(1e9 * value for value in RANGES["length"]),
            *(1e-9 * value for value in RANGES["modulus"]),
            *(1e3 * value for value in RANGES["work"]),
            *(1e-6 * value for value in PRESSURES),
            arguments.limit,
        ),
        "",
        "| effect | frames | force within 1.15 | 1.3 | work within 1.2 | doubted | others: force "
        "within 1.15 | 1.3 | worst | work | differs | 95 % |",
        "|---|" + "---|" * 11,
    ]
    text += [row_of(effect, lines) for effect in EFFECTS]
    return "\n".join(text) + "\n"


def main():
    parser = section_study.parser_of(__doc__.split("\n\n")[0], 64, 10.0, "a half-space may take")
    parser.add_argument("--seed", type=int, default=SEED)
    section_study.run(parser.parse_args(), study, section_of, HEADING)


if __name__ == "__main__":
    main()
