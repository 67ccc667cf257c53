#!/usr/bin/env python3
"""Predicts what others measured on rough surfaces and writes the page; studies/measured calls it.

usage: measured.py PAGE.md [--seeds N] [--quick]
"""

import argparse
import math
import os
import pathlib
import statistics
import warnings
from concurrent.futures import ThreadPoolExecutor

import mems_stiction
from tqdm import tqdm

import measured_cases as cases
import trust_run

UNITS = {
    "work": (1e6, " uJ/m^2"),
    "pressure": (1e-3, " kPa"),
    "ratio": (1.0, ""),
    "force ratio": (1.0, ""),
}
CHECKED_RMS = (1e-9, 2e-9, 5e-9, 10e-9)


class Study:
    """Predictions of frames by `separation_curve`, those of the seeds side by side; seeds are drawn
    alike for all settings, so that differences are those of the settings."""

    def __init__(self, seeds, is_quick, pool):
        self.seeds, self.is_quick, self.pool = range(1, seeds + 1), is_quick, pool

    def records(self, case, variation, rms_height):
        pixels = min(case.pixels, 96) if self.is_quick else case.pixels

        def record(seed):
            frame, heights = cases.surface(case, variation, rms_height, seed, pixels)
            return mems_stiction.predict(
                heights,
                frame["pitch"],
                trust_run.settings_of(frame, "separation_curve"),
                **variation.stated,
            ).to_dict()

        return list(self.pool.map(record, self.seeds))

    def values(self, case, variation):
        """For each measured value, one prediction a seed."""
        rows = [self.records(case, variation, rms_height) for rms_height in case.rms_heights]
        if case.quantity == "pressure":
            return [
                [record["pull_off_force"] / record["nominal_area"] for record in row]
                for row in rows
            ]
        figure = "pull_off_force" if case.quantity == "force ratio" else "apparent_work_of_adhesion"
        found = [[record[figure] for record in row] for row in rows]
        return (
            found
            if case.quantity == "work"
            else [[first / second for first, second in zip(*found)]]
        )


def number(value):
    """Two digits: more than such a value bears."""
    return "%.2g" % value if abs(value) < 100 else "%.0f" % value


def rms_text(case, place):
    heights = case.rms_heights if "ratio" in case.quantity else case.rms_heights[place : place + 1]
    return " over ".join("%g nm" % round(height * 1e9, 3) for height in heights)


def result_rows(study, results):
    for case in cases.CASES:
        scale, unit = UNITS[case.quantity]
        for place, (measured, values) in enumerate(
            zip(case.measured, results[case.key, cases.AS_ASSUMED.name])
        ):
            median = statistics.median(values)
            yield "| %s | %s | %s%s (%s) | %s | %s ... %s | %s |" % (
                case.key,
                rms_text(case, place),
                number(measured * scale),
                unit,
                case.known,
                number(median * scale),
                number(min(values) * scale),
                number(max(values) * scale),
                number(median / measured),
            )


def moved_by(results, case, variation):
    """The variation's median over that of the assumed settings, geometric mean over the rms heights
    of a case."""
    pairs = zip(results[case.key, variation.name], results[case.key, cases.AS_ASSUMED.name])
    return math.exp(
        statistics.mean(
            math.log(statistics.median(changed) / statistics.median(values))
            for changed, values in pairs
        )
    )


def factors_of(results, case, variation):
    """Predicted medians over what was measured."""
    return [
        statistics.median(values) / measured
        for measured, values in zip(case.measured, results[case.key, variation.name])
    ]


def effects_section(results):
    """What measured parts have and the assumed ones have not, over what was measured."""
    shown = (cases.AS_ASSUMED,) + cases.EFFECTS
    text = [
        "## Effects that were left out",
        "",
        "Predicted median over measured value. *native oxide*: 2 nm over silicon, retarded "
        "(`config/polysilicon_native_oxide.yaml`). *humidity*: with water films of 0.8 and 1.1 nm "
        "on each face (assumed). *correlation*: surfaces of equal roughness that fit each other "
        "in all waves. *0.1 V*: a contact potential across 4 nm of oxide.",
        "",
        "| case | rms height | %s |" % " | ".join(variation.name for variation in shown),
        "|---|---|%s" % ("---|" * len(shown)),
    ]
    for case in map(case_of, cases.OF_EFFECTS):
        factors = [factors_of(results, case, variation) for variation in shown]
        for place, row in enumerate(zip(*factors)):
            text.append(
                "| %s | %s | %s |"
                % (case.key, rms_text(case, place), " | ".join(number(factor) for factor in row))
            )
    return text + [""]


def separation_rows(study):
    """DelRio's own check: the work beside that of two planes at the mean separation, H/(12 pi
    D_ave^2)."""
    case = cases.CASES[0]
    for rms_height in CHECKED_RMS:
        records = study.records(case, cases.AS_ASSUMED, rms_height)
        gaps = [record["mean_gap"] for record in records]
        works = [record["apparent_work_of_adhesion"] for record in records]
        planes = [case.settings["hamaker"] / (12 * math.pi * gap**2) for gap in gaps]
        median = statistics.median
        yield (
            median(gaps),
            median(works),
            "| %g nm | %s nm | %s | %s | %.2f |"
            % (
                rms_height * 1e9,
                number(median(gaps) * 1e9),
                number(median(works) * 1e6),
                number(median(planes) * 1e6),
                median([work / plane for work, plane in zip(works, planes)]),
            ),
        )


def case_of(key):
    return next(case for case in cases.CASES if case.key == key)


def device(study, case, rms_height, area, **settings):
    """What a whole area holds, by predict_device() from some frames of its surface."""
    pixels = min(case.pixels, 96) if study.is_quick else case.pixels
    made = [
        cases.surface(case, cases.AS_ASSUMED, rms_height, seed, pixels)
        for seed in range(1, cases.PLATE_SCANS + 1)
    ]
    options = {"realisations": 3, "max_cells": 1e4} if study.is_quick else {}
    frame = made[0][0]
    return mems_stiction.predict_device(
        [heights for _, heights in made],
        frame["pitch"],
        area=area,
        config=trust_run.settings_of(frame, "separation_curve"),
        device_force=options,
        **settings,
    )


def micro(value):
    return number(value * 1e6)


def device_section(study):
    """What a plate holds as a whole, and how that goes with its area."""
    case = case_of("plates")
    plates = {
        (rms_height, share): device(study, case, rms_height, share * cases.PLATE_AREA)
        for rms_height in case.rms_heights
        for share in cases.AREA_SHARES
    }
    text = [
        "## The plates as a whole",
        "",
        "A frame of 12.8 um is an eighth of such a plate. [The force of the device](device.md) is "
        "that of its whole area: one plate that comes to rest on its highest summits. From %d "
        "frames each, beside what the frames' force by area would say:" % cases.PLATE_SCANS,
        "",
        "| rms height | measured [uN] | the device [uN] | 95 % interval | the frames by area [uN] "
        "| factor |",
        "|---|---|---|---|---|---|",
    ]
    for rms_height in case.rms_heights:
        found = plates[rms_height, 1.0]
        text.append(
            "| %g nm | %s (read) | %s | %s ... %s | %s | %s |"
            % (
                round(rms_height * 1e9, 3),
                number(cases.PLATE_FORCE * 1e6),
                micro(found.pull_off_force),
                micro(found.pull_off_force_lower),
                micro(found.pull_off_force_upper),
                micro(found.linear_pull_off_force),
                number(found.pull_off_force / cases.PLATE_FORCE),
            )
        )
    inside = [
        rms_height
        for rms_height in case.rms_heights
        if plates[rms_height, 1.0].pull_off_force_lower
        <= cases.PLATE_FORCE
        <= plates[rms_height, 1.0].pull_off_force_upper
    ]
    text += [
        "",
        "%s. The frames' force by area ignores that the whole plate "
        "rests on few summits."
        % (
            "Of the rms heights that were tried, the measured force lies within the 95 %% interval "
            "of the whole plate at %s alone"
            % " and ".join("%g nm" % round(rms_height * 1e9, 3) for rms_height in inside)
            if inside
            else "The measured force lies outside of the 95 % interval of the whole plate for each "
            "of these rms heights"
        ),
        "",
        "## Force over area",
        "",
        "%s: %s (%s). Predicted, for plates as above:"
        % (
            sentence(cases.CLAMPED_BEAMS.name),
            within_sentence(cases.CLAMPED_BEAMS.says),
            cases.CLAMPED_BEAMS.where,
        ),
        "",
        "| rms height | %s | goes with the area to the power of |"
        % " | ".join("%g of the area [uN]" % share for share in cases.AREA_SHARES),
        "|---|%s---|" % ("---|" * len(cases.AREA_SHARES)),
    ]
    for rms_height in case.rms_heights:
        forces = [plates[rms_height, share].pull_off_force for share in cases.AREA_SHARES]
        power = math.log(forces[-1] / forces[0]) / math.log(
            cases.AREA_SHARES[-1] / cases.AREA_SHARES[0]
        )
        text.append(
            "| %g nm | %s | %.2f |"
            % (round(rms_height * 1e9, 3), " | ".join(micro(force) for force in forces), power)
        )
    text += [""]
    return text


def sentence(text):
    return text[0].upper() + text[1:]


def within_sentence(text):
    return text[0].lower() + text[1:]


def beams_section(study, results):
    """The work with which a beam holds, of the whole area that rests beside that of a frame, and
    the crack length that follows."""
    case = case_of("beams")
    beam = cases.BEAM
    text = [
        "## The beams as a whole",
        "",
        "A beam measures the work of the area that rests, by the length that stands free. Assumed: "
        "a cantilever %g um thick, %g um above the ground, of %g GPa, of which %g um^2 rest. From "
        "%d frames each:"
        % (
            beam["beam_thickness"] * 1e6,
            beam["beam_gap"] * 1e6,
            beam["beam_modulus"] * 1e-9,
            cases.BEAM_AREA * 1e12,
            cases.PLATE_SCANS,
        ),
        "",
        "| rms height | measured [uJ/m^2] | the area that rests [uJ/m^2] | 95 % interval | a frame "
        "[uJ/m^2] | factor | crack length [um] |",
        "|---|---|---|---|---|---|---|",
    ]
    frames = results[case.key, cases.AS_ASSUMED.name]
    for rms_height, measured, values in zip(case.rms_heights, case.measured, frames):
        found = device(study, case, rms_height, cases.BEAM_AREA, device=beam)
        text.append(
            "| %g nm | %s (%s) | %s | %s ... %s | %s | %s | %s |"
            % (
                round(rms_height * 1e9, 3),
                micro(measured),
                case.known,
                micro(found.apparent_work_of_adhesion),
                micro(found.apparent_work_of_adhesion_lower),
                micro(found.apparent_work_of_adhesion_upper),
                micro(statistics.median(values)),
                number(found.apparent_work_of_adhesion / measured),
                "%.0f" % (found.to_dict()["unstuck_length"] * 1e6),
            )
        )
    return text + [
        "",
        "A larger area rests on higher summits, so its work is below that of a "
        "frame. A beam shorter than its crack length comes off.",
        "",
    ]


def exponent(rows):
    """Of the work over the mean separation, between the ends."""
    (first_gap, first_work, _), (last_gap, last_work, _) = rows[0], rows[-1]
    return math.log(last_work / first_work) / math.log(last_gap / first_gap)


def page(study):
    wanted = [
        (case, variation)
        for case in cases.CASES
        for variation in (cases.AS_ASSUMED,) + cases.VARIATIONS
    ] + [(case_of(key), variation) for key in cases.OF_EFFECTS for variation in cases.EFFECTS]
    results = {
        (case.key, variation.name): study.values(case, variation)
        for case, variation in tqdm(wanted, desc="predicting", unit="", leave=False, disable=None)
    }
    separations = list(separation_rows(study))
    text = [
        "# Against measurement",
        "",
        "Published measurements on rough surfaces, beside predictions by `approach/formulation: "
        "separation_curve` for surfaces with the same statistics. Written by `studies/measured`.",
        "",
        "**This page shows an order of magnitude and a trend, no more.** A prediction needs "
        "roughness, correlation length, work of adhesion, Hamaker constant, humidity and area. No "
        "available source gives all of them, and most were read as abstracts. Missing values are "
        "assumed; [a table](#what-the-assumptions-move) shows the effect of each assumption.",
        "",
        "## Measured and predicted",
        "",
        "%d Gaussian surfaces each; median, lowest and highest. *factor*: predicted median over "
        "measured. *recalled*: not checked against the source." % len(study.seeds),
        "",
        "| case | rms height | measured | predicted | over seeds | factor |",
        "|---|---|---|---|---|---|",
    ]
    text += list(result_rows(study, results))
    text += ["", "| case | source | says | assumed |", "|---|---|---|---|"]
    text += [
        "| %s | %s (%s) | %s | %s |"
        % (case.key, case.source.name, case.source.where, case.source.says, case.assumed)
        for case in cases.CASES
    ]
    text += [
        "",
        "A ratio compares the apparent works of two rough planes; for the flat tips it "
        "compares their pull-off forces. The ratio of works stands for the forces of a large"
        " sphere: by Derjaguin, the pull-off force of a sphere is 2 pi R times the work of "
        "the planes from rest on.",
        "",
        "If springs tear a plate off, it peels, so the prediction is an upper bound.",
        "",
    ]
    text += effects_section(results) + device_section(study) + beams_section(study, results)
    text += [
        "## The separation law",
        "",
        "At small roughness the work is that of planes at the average separation, H/(12 pi "
        "D_ave^2); at large roughness contacts take over. Predicted, for the beams' settings:",
        "",
        "| rms height | D_ave | work [uJ/m^2] | H/(12 pi D_ave^2) [uJ/m^2] | ratio |",
        "|---|---|---|---|---|",
    ]
    text += [row for _, _, row in separations]
    text += [
        "",
        "The work goes with D_ave to the power of %.2f." % exponent(separations),
        "",
        "## What the assumptions move",
        "",
        "Median with the change over the median without; geometric mean over the rms heights of a "
        "case. Where the correlation length changes, pixels and frame change with it.",
        "",
        "| | %s |" % " | ".join(case.key for case in cases.CASES),
        "|---|%s" % ("---|" * len(cases.CASES)),
    ]
    text += [
        "| %s | %s |"
        % (
            variation.name,
            " | ".join(number(moved_by(results, case, variation)) for case in cases.CASES),
        )
        for variation in cases.VARIATIONS
    ]
    text += [
        "",
        "The rms height is that of both surfaces together: a source that gives one surface "
        "leaves a factor open. Surfaces grown on each other fit each other, so their composite "
        "roughness is smaller than either's (DelRio et al. 2005).",
        "",
        "## Found, but not predicted",
        "",
        "Of %d other sources the available text lacks the roughness, or the force: `FOUND` in "
        "`studies/measured_cases.py`. Whoever has the full texts, or a beam and its AFM scan, can "
        "replace an assumption there and run `studies/measured` again." % len(cases.FOUND),
        "",
    ]
    return "\n".join(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=12)
    parser.add_argument(
        "--quick", action="store_true", help="frames of 96 x 96 pixels at most, 2 seeds"
    )
    arguments = parser.parse_args()
    warnings.simplefilter("ignore", mems_stiction.ScanWarning)  # of heights that are as drawn
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        arguments.page.write_text(
            page(Study(2 if arguments.quick else arguments.seeds, arguments.quick, pool)),
            encoding="utf-8",
        )


if __name__ == "__main__":
    main()
