#!/usr/bin/env python3
"""Writes the page of sensitivities from what sensitivity_study printed.

usage: sensitivity_page.py STUDY.json PAGE.md FIGURE.png
"""

import argparse
import json
import os
import pathlib
import re
import statistics

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)

DOCUMENTS = pathlib.Path(__file__).resolve().parents[1] / "doc"
COLOURS = ("#2f7fd1", "#d1322f", "#7a7a7a", "#f2b705", "#3a9d5d")
QUANTITIES = (
    ("pull_off_force", "pull-off force"),
    ("apparent_work_of_adhesion", "work of adhesion"),
    ("contact_area", "contact area"),
    ("mean_gap", "mean gap"),
)
FEWEST_CONTACTS = 10  # as FLAG_FEW_CONTACTS has it
UNTOUCHED = 5e-5  # smaller changes print as 0.0 %

# Why a setting's default is what it is; what else there is to say. Numbers come from the study.
PITCH = (
    "Pixels of the scan; coarser ones are means over blocks, as `predict_scan --convergence` "
    "makes them, or *refined by N* (`preprocessing/refine/factor`).",
    "With coarser pixels the pull-off force is lost first, then the contact area, then the "
    "mean gap: radii need pixels. Aim at {min_contact_pixels:g} pixels in the median "
    "contact, below which `is_resolution_limited` is set.",
)
SETTINGS = {
    "paper/step": (
        "Shorter steps agree well within the scan-to-scan spread; longer ones can miss the rest.",
        "of `formulation: paper`; the separation curve chooses its own steps.",
    ),
    "approach/max_steps": (
        "Far above what a scan needs: it only ends searches with a mistyped step.",
        "",
    ),
    "approach/connectivity": ('The stricter reading of "connected"; hardly matters.', ""),
    "approach/max_contact_fraction": (
        "Matters only [near bonding](#near-bonding), where it separates surfaces that rest from "
        "surfaces that have closed.",
        "",
    ),
    "paper/cutoff_distance": (
        "The usual value; the others tried are also in use.",
        "the separation curve does not use it. Under `formulation: paper` it moves the pull-off "
        "force more than all other settings together.",
    ),
    "interface/equilibrium_distance": (
        "Middle of the values in use; the separation curve derives z0 from Hamaker constant and "
        "work of adhesion.",
        "",
    ),
    "preprocessing/refine/factor": (
        "Off: it adds no information, costs its square in time, and fine scans do not need it.",
        "moves the result about as far as a scan of half the pitch. It helps where contacts span "
        "some 6 pixels (see *pitch*: it narrows the scatter). At 2 to 4 pixels it makes contacts "
        "too round and forces too large.",
    ),
    "preprocessing/refine/interpolation": (
        "Both agree within the scan-to-scan spread; cubic has no ripples beside steps.",
        "",
    ),
    "approach/formulation": (
        "A choice of model, not of digits: [theory](theory.md#what-differs-from-the-printed-paper) "
        "gives the reasons.",
        "",
    ),
    "approach/deformation": ("A choice of model too: real surfaces flow.", ""),
}
YARDSTICKS = {
    "interface/work_of_adhesion": "work of adhesion",
    "hardness": "hardness of both bodies",
    "youngs_modulus": "Young's modulus of both bodies",
}


def spread(values):
    """Standard deviation over the mean."""
    return statistics.stdev(values) / abs(statistics.mean(values))


def percent(share, sign=True):
    text = "%+.1f" % (100 * share) if sign else "%.1f" % (100 * share)
    return "0" if text in ("+0.0", "-0.0", "0.0") else text.replace("-", "−")


class Surface:
    """One surface of the study: what the default said of each scan, and every case against it."""

    def __init__(self, record):
        self.name, self.description, self.cases = (
            record["name"],
            record["description"],
            record["cases"],
        )
        self.default = next(case for case in self.cases if case["is_default"])["outcomes"]
        self.reference = {
            case["key"]: case["outcomes"] for case in self.cases if case["is_default"]
        }

    def values(self, quantity):
        return [outcome[quantity] for outcome in self.default]

    def changes(self, case, quantity):
        """Relative change of each scan against the default of the same key."""
        reference = self.reference.get(case["key"], self.default)
        return [
            outcome[quantity] / default[quantity] - 1
            for outcome, default in zip(case["outcomes"], reference)
        ]

    def changes_as_text(self, case, quantity):
        if any(outcome[quantity] is None for outcome in case["outcomes"]):
            return "none"  # the formulation does not have it
        changes = self.changes(case, quantity)
        mean, scatter = (
            percent(statistics.mean(changes)),
            percent(statistics.stdev(changes), sign=False),
        )
        return "0" if (mean, scatter) == ("0", "0") else "%s ± %s" % (mean, scatter)

    def spread(self, quantity):
        return spread(self.values(quantity))


class Study:
    def __init__(self, path):
        self.record = json.loads(pathlib.Path(path).read_text())
        self.surfaces = [Surface(record) for record in self.record["surfaces"]]
        self.near_bonding = [Surface(record) for record in self.record["near_bonding"]]

    def cases(self, key):
        """The cases of a key, each as a list with one case per surface."""
        return list(
            zip(
                *(
                    [case for case in surface.cases if case["key"] == key]
                    for surface in self.surfaces
                )
            )
        )

    def label(self, cases):
        if cases[0]["key"] != "pitch":
            return cases[0]["value"]
        pitches = sorted({case["outcomes"][0]["pitch"] for case in cases})
        nanometres = ", ".join("%g nm" % (1e9 * pitch) for pitch in pitches)
        return nanometres + (", " + cases[0]["value"] if cases[0]["value"] else "")

    def largest_shift(self, key, quantity, kinds=("numerical", "model", "physical")):
        """Of the mean over scans, over surfaces and values."""
        shifts = [
            statistics.mean(surface.changes(case, quantity))
            for cases in self.cases(key)
            for surface, case in zip(self.surfaces, cases)
            if case["kind"] in kinds
        ]
        return max(shifts, key=abs)

    def spreads(self, quantity):
        return [surface.spread(quantity) for surface in self.surfaces]


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def surfaces_table(study):
    rows = []
    for surface in study.surfaces:
        mean = {name: statistics.mean(surface.values(name)) for name, _ in QUANTITIES}
        rows.append(
            [
                surface.name,
                surface.description,
                str(len(surface.default)),
                "%.0f" % statistics.mean(surface.values("asperity_count")),
                "%.0f" % statistics.mean(surface.values("median_contact_pixels")),
                "%.3g ± %s %%"
                % (mean["pull_off_force"], percent(surface.spread("pull_off_force"), False)),
                "%.3g ± %s %%"
                % (
                    mean["apparent_work_of_adhesion"],
                    percent(surface.spread("apparent_work_of_adhesion"), False),
                ),
                "%.3g ± %s %%"
                % (mean["contact_area"], percent(surface.spread("contact_area"), False)),
                "%.3g ± %s %%"
                % (1e9 * mean["mean_gap"], percent(surface.spread("mean_gap"), False)),
            ]
        )
    return table(
        [
            "surface",
            "heights",
            "scans",
            "contacts",
            "pixels per contact",
            "pull-off force [N]",
            "work of adhesion [J/m^2]",
            "contact area [m^2]",
            "mean gap [nm]",
        ],
        rows,
    )


def default_of(study, key):
    value = study.label(next(cases for cases in study.cases(key) if cases[0]["is_default"]))
    if key == "paper/step":
        return "0 (automatic: sigma/%g)" % study.record["steps_per_rms_height"]
    return value


def settings_of(study):
    """Keys that have a default, in the order of the study."""
    keys = [
        case["key"]
        for case in study.surfaces[0].cases
        if case["kind"] != "physical" and case["key"] != "pitch"
    ]
    return [key for key in dict.fromkeys(keys) if key in SETTINGS]


def defaults_table(study):
    rows = []
    for key in settings_of(study):
        rows.append(
            [
                "`%s`" % key,
                default_of(study, key),
                percent(study.largest_shift(key, "pull_off_force")),
                percent(study.largest_shift(key, "contact_area")),
                percent(study.largest_shift(key, "mean_gap")),
                SETTINGS[key][0],
            ]
        )
    intervals = [
        row
        for interval in study.record["intervals"]
        for row in interval["rows"]
        if row["samples"] == study.record["samples"]
    ]
    if intervals:
        scatter = max(max(row["lower_scatter"], row["upper_scatter"]) for row in intervals)
        rows.append(
            [
                "`uncertainty/samples`",
                "%d" % study.record["samples"],
                "",
                "",
                "",
                "The ends of the 95 %% interval [scatter](#samples-of-the-interval) by up to %s "
                "%%, little beside its width; it costs nothing that shows."
                % percent(scatter, False),
            ]
        )
    return table(
        ["setting", "default", "pull-off force [%]", "contact area [%]", "mean gap [%]", "why"],
        rows,
    )


def shift_titles(study):
    return ["force of %s [%%]" % surface.name for surface in study.surfaces] + [
        "contact area, largest mean shift [%]"
    ]


def shifts_of(study, cases):
    """Cells of a row: change of the pull-off force on each surface, and the largest mean one of the
    contact area."""
    areas = [
        statistics.mean(surface.changes(case, "contact_area"))
        for surface, case in zip(study.surfaces, cases)
    ]
    return [
        surface.changes_as_text(case, "pull_off_force")
        for surface, case in zip(study.surfaces, cases)
    ] + [percent(max(areas, key=abs))]


def moved_by(study, key):
    """The rows of a key's values, each with its label first, and the labels of those that move
    nothing."""
    rows, unmoved = [], []
    for cases in study.cases(key):
        if cases[0]["is_default"]:
            continue
        label = study.label(cases)
        texts = [
            surface.changes_as_text(case, name)
            for surface, case in zip(study.surfaces, cases)
            for name, _ in QUANTITIES
        ]
        statuses = sorted(
            {outcome["status"] for case in cases for outcome in case["outcomes"]} - {"EQUILIBRIUM"}
        )
        if set(texts) == {"0"}:
            unmoved.append(label)
        else:
            rows.append(
                [label + (" (%s)" % ", ".join(statuses) if statuses else "")]
                + shifts_of(study, cases)
            )
    return rows, unmoved


def pitch_section(study):
    rows, _ = moved_by(study, "pitch")
    lines = ["### pitch", "", PITCH[0], ""] + table(["value"] + shift_titles(study), rows)
    return lines + [PITCH[1].format(**study.record), ""]


def settings_section(study):
    rows, unmoved, notes = [], [], []
    for key in settings_of(study):
        moved, still = moved_by(study, key)
        rows += [["`%s`" % key] + row for row in moved]
        if still:
            unmoved.append("`%s` of %s" % (key, ", ".join(still)))
        if SETTINGS[key][1]:
            notes.append("- `%s`: %s" % (key, SETTINGS[key][1]))
    lines = ["### settings", ""] + table(["setting", "value"] + shift_titles(study), rows)
    if unmoved:
        lines += ["Nothing moves with %s." % "; ".join(unmoved), ""]
    return lines + notes + [""]


def yardstick_table(study):
    rows = [
        ["%s %s" % (title, cases[0]["value"])] + shifts_of(study, cases)
        for key, title in YARDSTICKS.items()
        for cases in study.cases(key)
    ]
    return table(["constant"] + shift_titles(study), rows)


def near_bonding_table(study):
    surfaces = study.near_bonding
    limits = [case["value"] for case in surfaces[0].cases]
    rows = []
    for surface in surfaces:
        row = [
            surface.name,
            "%.2g" % statistics.mean(outcome["pull_off_force"] for outcome in surface.default),
        ]
        for case in surface.cases:
            row.append("%d" % sum(outcome["status"] == "BONDED" for outcome in case["outcomes"]))
        resting = [
            outcome["contact_fraction"]
            for outcome in surface.cases[-1]["outcomes"]
            if outcome["status"] == "EQUILIBRIUM"
        ]
        row.append("%.2g to %.2g" % (min(resting), max(resting)) if resting else "none")
        rows.append(row)
    return table(
        ["rms height", "pull-off force [N]"]
        + ["bonded of %d, limit %s" % (len(surfaces[0].default), limits[0])]
        + limits[1:]
        + ["contact fractions at rest, limit 1"],
        rows,
    )


def intervals_table(study):
    intervals = study.record["intervals"]
    rows = [
        ["%d" % of_samples[0]["samples"]]
        + [
            "%.2f ± %s %% to %.2f ± %s %%"
            % (
                row["lower"],
                percent(row["lower_scatter"], False),
                row["upper"],
                percent(row["upper_scatter"], False),
            )
            for row in of_samples
        ]
        for of_samples in zip(*(interval["rows"] for interval in intervals))
    ]
    return table(["samples"] + [interval["name"] for interval in intervals], rows)


def in_short(study):
    numerical = [
        key
        for key in settings_of(study)
        if study.cases(key)[0][0]["kind"] == "numerical"
        and key not in ("paper/cutoff_distance", "approach/max_steps")
    ]
    spreads = study.spreads("pull_off_force")
    area, gap = study.spreads("contact_area"), study.spreads("mean_gap")
    lines = [
        "- **Another place of the same surface** moves the pull-off force by %s %% (standard "
        "deviation), the contact area by %s %%, the mean gap by %s %%. Smaller digits describe "
        "this scan, not the surface." % (span(spreads), span(area), span(gap))
    ]
    few = [
        surface.name
        for surface in study.surfaces
        if statistics.mean(surface.values("asperity_count")) < FEWEST_CONTACTS
    ]
    if few:
        lines.insert(
            0,
            "- **Too few contacts** on %s (fewer than %d a scan): single contacts come and go, and "
            "the figures say little. Try a higher `--pressure`."
            % (", ".join(few), FEWEST_CONTACTS),
        )
    others = [
        key
        for key in numerical
        if abs(study.largest_shift(key, "pull_off_force")) < max(spreads) / 3
        and key != "paper/step"
    ]
    lines.append(
        "- **Below the scan-to-scan spread** for every value tried: %s."
        % ", ".join("`%s`" % key for key in others)
    )
    return lines + [""]


def span(shares):
    """1.5 to 2.5, in percent; one number if they are all the same."""
    lowest, highest = percent(min(shares), False), percent(max(shares), False)
    return lowest if lowest == highest else "%s to %s" % (lowest, highest)


def linked_from(folder, text):
    """The page's links to other pages, which are written as from doc/, as from another folder."""
    to_documents = os.path.relpath(str(DOCUMENTS), str(folder.resolve()))
    if to_documents == ".":
        return text
    return re.sub(
        r"\]\(([\w./]+\.(?:md|yaml))",
        lambda link: "](" + os.path.normpath(os.path.join(to_documents, link.group(1))),
        text,
    )


def page(study, figure, is_generated):
    pressure = "%g MPa" % (1e-6 * study.record["pressure"])
    lines = [
        "# Sensitivities: which digits mean something",
        "",
        "*Written by `studies/sensitivity`%s; do not edit it by hand.*"
        % ("" if is_generated else " for the scans named below"),
        "",
        "Each numerical setting is changed alone, on every scan. Tables give the mean change "
        "of the prediction and its standard deviation over the scans, in percent. A shift "
        "below the spread from scan to scan cannot be seen in practice. Keys: "
        "[parameters](parameters.md).",
        "",
        "## In short",
        "",
    ]
    lines += in_short(study)
    lines += [
        "![Change of pull-off force and contact area with each setting](%s)" % figure,
        "",
        "*Mean change on each surface; bars: standard deviation over the scans; band: spread from "
        "scan to scan (mean of the surfaces).*",
        "",
        "## What was run",
        "",
        "Scans pressed on a plane with %s of mechanical load over their area, everything else as "
        "[config/stiction.yaml](../config/stiction.yaml) has it. ± is the spread from scan to "
        "scan." % pressure,
        "",
    ]
    lines += surfaces_table(study)
    lines += [
        "## The defaults",
        "",
        "Largest shift of the mean over all values that were tried. "
        + (
            "A test compares the defaults with those of the code."
            if is_generated
            else "The reasons beside them come from the generated surfaces of "
            "[doc/sensitivity.md](sensitivity.md): do they hold here too?"
        ),
        "",
    ]
    lines += defaults_table(study)
    lines += ["## Setting by setting", ""]
    lines += pitch_section(study) + settings_section(study)
    lines += [
        "## Near bonding",
        "",
        "`approach/max_contact_fraction` matters only on surfaces so smooth that their attraction "
        "closes them: Gaussian ones with a correlation length of 80 nm, without mechanical load.",
        "",
    ]
    lines += near_bonding_table(study)
    lines += [
        "## Samples of the interval",
        "",
        "The margin's 95 %% interval is drawn at random. The table gives its ends, as "
        "pull-off force over the predicted one, and their scatter from seed to seed. "
        "With the default of %d they are good to a tenth; take more for figures that are to be "
        "published." % study.record["samples"],
        "",
    ]
    lines += intervals_table(study)
    lines += [
        "## For comparison: the constants",
        "",
        "Each larger by its standard uncertainty (`uncertainty/...`).",
        "",
    ]
    lines += yardstick_table(study)
    return "\n".join(lines).rstrip() + "\n"


def draw(study, path):
    keys = ["pitch"] + settings_of(study) + list(YARDSTICKS)
    rows = [
        (("pitch " if key == "pitch" else key.split("/", 1)[-1] + " ") + study.label(cases), cases)
        for key in keys
        for cases in study.cases(key)
        if not cases[0]["is_default"]
    ]
    rows = [
        row
        for row in rows
        if any(
            abs(change) > UNTOUCHED
            for surface, case in zip(study.surfaces, row[1])
            for name in ("pull_off_force", "contact_area")
            for change in surface.changes(case, name)
        )
    ]
    figure, axes = plt.subplots(1, 2, figsize=(10.5, 1.2 + 0.26 * len(rows)), sharey=True)
    for axis, (name, title) in zip(axes, (QUANTITIES[0], QUANTITIES[2])):
        band = 100 * statistics.mean(study.spreads(name))
        axis.axvspan(-band, band, color="#e8e8e8")
        axis.axvline(0, color="black", linewidth=0.6)
        for index, surface in enumerate(study.surfaces):
            shift = 0.22 * (index - (len(study.surfaces) - 1) / 2)
            changes = [surface.changes(cases[index], name) for _, cases in rows]
            axis.errorbar(
                [100 * statistics.mean(change) for change in changes],
                [place + shift for place in range(len(rows))],
                xerr=[100 * statistics.stdev(change) for change in changes],
                fmt="o",
                markersize=3.5,
                linewidth=0.9,
                color=COLOURS[index % len(COLOURS)],
                label=surface.name,
            )
        axis.set_xlim(-85, 85)
        axis.set_xlabel("change of the %s [%%]" % title)
        axis.grid(axis="x", linewidth=0.3)
    axes[0].set_yticks(range(len(rows)))
    axes[0].set_yticklabels([label for label, _ in rows], fontsize=8)
    axes[0].set_ylim(len(rows) - 0.5, -0.5)
    axes[1].legend(loc="lower right", fontsize=8)
    figure.tight_layout()
    figure.savefig(str(path), dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("study", metavar="STUDY.json")
    parser.add_argument("page", metavar="PAGE.md", type=pathlib.Path)
    parser.add_argument("figure", metavar="FIGURE.png", type=pathlib.Path)
    parser.add_argument(
        "--of-files",
        action="store_true",
        help="the surfaces are given scans, not the generated ones",
    )
    arguments = parser.parse_args()
    study = Study(arguments.study)
    arguments.figure.parent.mkdir(parents=True, exist_ok=True)
    draw(study, arguments.figure)
    figure = os.path.relpath(str(arguments.figure), str(arguments.page.parent))
    text = linked_from(arguments.page.parent, page(study, figure, not arguments.of_files))
    arguments.page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
