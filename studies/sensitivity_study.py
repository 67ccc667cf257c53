#!/usr/bin/env python3
"""How much does each numerical setting move a prediction? Prints JSON for sensitivity_page.py;
studies/sensitivity calls it.

usage: sensitivity_study.py [SCAN...] [--config FILE.yaml] [--scans N] [--pixels N] [--pressure PA]

Surfaces are generated, or scan files, each cut into quarters. One setting is changed at a time;
places are predicted side by side on all processors. Progress goes to the standard error.
"""

import argparse
import json
import math
import os
import statistics
import sys
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor

import mems_stiction
import numpy as np
import yaml
from mems_stiction import _core

SCAN_PITCH = 10e-9  # [m], a usual one of an AFM on a frame of 10 um
SCAN_FACTOR = 2  # generated places are so many times as fine as their scans
SMALLEST_SIDE = 64
STEPS_PER_RMS_HEIGHT = 50  # of the automatic step, paper/step: 0
FIGURES = [
    name
    for name in _core.figures["PredictionFigures"]
    if name not in ("formulation", "regime_flags", "processing_time")
]
SAMPLES, SEEDS = (50, 200, 1000, 5000), range(1, 41)


def text_of(value):
    """As the configuration file has it: 1.65e-10, 0.5, 1."""
    if isinstance(value, float):
        return repr(value)[:-2] if repr(value).endswith(".0") else repr(value)
    return str(value).lower() if isinstance(value, bool) else str(value)


class Configuration:
    """What everything else is set to."""

    def __init__(self, settings):
        tree = yaml.safe_load(settings.yaml())
        tree["paper"]["step"] = 0.0  # the automatic one, which the others are compared with
        self.settings = mems_stiction.Settings(tree)
        self.tree = yaml.safe_load(self.settings.yaml())

    def value(self, key):
        section, _, name = key.partition("/")
        return self.tree[section][name]

    def changed(self, case, pressure, scan, composite_rms_height):
        """For one case on a scan, which is clean."""
        rows, columns = scan.heights.shape
        load = pressure * (scan.pitch[0] * scan.pitch[1]) * float(rows) * columns
        refine = {
            name: value
            for name, value in self.tree["preprocessing"].items()
            if name.startswith("refine/")
        }
        settings = mems_stiction.Settings({**self.tree, "preprocessing": refine}, **case.changes)
        step = (
            {"paper/step": composite_rms_height / case.steps_per_rms} if case.steps_per_rms else {}
        )
        return mems_stiction.Settings(
            settings,
            output={
                "deformed_surfaces": False,
                "contact_map": False,
                "asperities": True,
                "roughness": False,
                "energy_curve": False,
            },
            load={
                "max_mechanical_load": max(self.value("load/max_mechanical_load"), load),
                "mechanical_load": load,
            },
            **step,
        )


class Case:
    """One setting changed. key: of the configuration, or "pitch"; value: as people read it; kind:
    numerical (how the model is computed), model (which equations) or physical (a constant changed
    by its standard uncertainty: a yardstick)."""

    def __init__(self, key, value, kind, is_default, changes, steps_per_rms=0, pitch_factor=1.0):
        self.key, self.value, self.kind, self.is_default = key, value, kind, is_default
        self.changes, self.steps_per_rms, self.pitch_factor = changes, steps_per_rms, pitch_factor


def cases_of_key(configuration, key, values, kind="numerical"):
    """One per value; the configured one is the default, and is added if it is not among them."""
    configured = text_of(configuration.value(key))
    if configured not in values:
        values = (configured,) + values
    return [
        Case(key, value, kind, value == configured, {} if value == configured else {key: value})
        for value in values
    ]


def physical_case(configuration, name, keys, uncertainty):
    """A constant, larger by its relative standard uncertainty; with a key for each body, of
    both."""
    changes = {key: float(configuration.value(key)) * (1 + uncertainty) for key in keys}
    return Case(name, "+%.0f %%" % (100 * uncertainty), "physical", False, changes)


def all_cases(configuration, has_finer):
    # The pitch is the scan's: refinement is what a configuration can do about it.
    cases = [
        Case("pitch", "", "numerical", factor == 1, {}, 0, factor)
        for factor in (0.5, 1.0, 2.0, 4.0)
        if factor >= 1 or has_finer
    ]
    cases += [
        Case(
            "pitch",
            "refined by %d" % factor,
            "numerical",
            False,
            {"preprocessing/refine/factor": factor},
            0,
            float(factor),
        )
        for factor in (2, 4)
    ]
    for divisor in (5, 10, 25, 50, 100, 200, 500):
        is_default = divisor == STEPS_PER_RMS_HEIGHT
        cases.append(
            Case(
                "paper/step",
                "sigma/%d" % divisor,
                "numerical",
                is_default,
                {},
                0 if is_default else divisor,
            )
        )
    for key, values in (
        ("approach/max_steps", ("100", "1000", "10000", "100000")),
        ("approach/connectivity", ("4", "8")),
        ("approach/max_contact_fraction", ("0.1", "0.3", "0.5", "0.7", "1")),
        ("paper/cutoff_distance", ("1.4e-10", "1.65e-10", "2e-10", "3e-10")),
        ("interface/equilibrium_distance", ("1.65e-10", "2e-10", "3e-10")),
        ("preprocessing/refine/factor", ("1", "2", "4")),
    ):
        cases += cases_of_key(configuration, key, values)
    key = "preprocessing/refine/interpolation"
    cases += [
        Case(
            key,
            value,
            "numerical",
            value == configuration.value(key),
            {"preprocessing/refine/factor": 2, key: value},
        )
        for value in ("cubic", "lanczos")
    ]
    cases += cases_of_key(
        configuration, "approach/formulation", ("separation_curve", "paper", "printed"), "model"
    )
    cases += cases_of_key(
        configuration, "approach/deformation", ("three_regimes", "elastic"), "model"
    )
    known = configuration.tree["uncertainty"]
    return cases + [
        physical_case(
            configuration,
            "interface/work_of_adhesion",
            ("interface/work_of_adhesion",),
            known["work_of_adhesion"],
        ),
        physical_case(
            configuration, "hardness", ("lower/hardness", "upper/hardness"), known["hardness"]
        ),
        physical_case(
            configuration,
            "youngs_modulus",
            ("lower/youngs_modulus", "upper/youngs_modulus"),
            known["youngs_modulus"],
        ),
    ]


class Surface:
    """count places of one kind; place(index) gives fine heights, and how many times as fine as the
    scan they are."""

    def __init__(self, name, description, count, place):
        self.name, self.description, self.count, self.place = name, description, count, place


def generated_surface(name, description, scans, pixels, kind, lengths):
    side = SCAN_FACTOR * pixels

    def place(index):
        return mems_stiction.generate(
            (side, side),
            SCAN_PITCH / SCAN_FACTOR,
            counter_surface={"type": kind, "seed": index + 1, kind: lengths},
        ), SCAN_FACTOR

    return Surface(name, description, scans, place)


def gaussian(name, rms_height, length, scans, pixels):
    return generated_surface(
        name,
        "Gaussian, rms height %g nm, correlation length %g nm" % (1e9 * rms_height, 1e9 * length),
        scans,
        pixels,
        "gaussian",
        {"rms_height": rms_height, "correlation_length_x": length, "correlation_length_y": length},
    )


def generated_surfaces(scans, pixels):
    defaults = yaml.safe_load(mems_stiction.Settings().yaml())["counter_surface"]
    described = "Hurst exponent %g between %g nm and %g nm, rms height 6 nm" % (
        defaults["self_affine/hurst_exponent"],
        1e9 * defaults["self_affine/cutoff_wavelength"],
        1e9 * defaults["self_affine/rolloff_wavelength"],
    )
    return [
        gaussian("smooth", 1.5e-9, 80e-9, scans, pixels),
        gaussian("rough", 12e-9, 100e-9, scans, pixels),
        generated_surface(
            "self-affine", described, scans, pixels, "self_affine", {"rms_height": 6e-9}
        ),
    ]


def surfaces_near_bonding(scans, pixels):
    return [
        gaussian("%g nm" % (1e9 * rms_height), rms_height, 80e-9, scans, pixels)
        for rms_height in (0.3e-9, 0.6e-9, 0.9e-9, 1.2e-9, 1.5e-9, 2e-9)
    ]


def surface_of_file(path, configuration):
    scan = mems_stiction.clean(
        mems_stiction.read(path, config=configuration.settings),
        None,
        configuration.settings,
        **{"preprocessing/refine/factor": 1},
    )
    heights = scan.heights.astype(float)
    rows, columns = (side // 2 for side in heights.shape)
    if min(heights.shape) < SMALLEST_SIDE:
        raise mems_stiction.SurfaceError(
            "%s: %d x %d pixels are too few to be cut into quarters; must have %d x %d or more"
            % (path, heights.shape[1], heights.shape[0], SMALLEST_SIDE, SMALLEST_SIDE)
        )

    def place(index):
        row, column = index // 2 * rows, index % 2 * columns
        return mems_stiction.clean(
            heights[row : row + rows, column : column + columns], scan.pitch
        ), 1

    return Surface(os.path.basename(path), "quarters of the scan", 4, place)


def scan_of(place, pitch_factor):
    """The scan of a place with pixels of `pitch_factor` times its pitch."""
    fine, factor = place
    factor = round(factor * pitch_factor)
    return fine if factor == 1 else mems_stiction.decimate(fine, factor=factor)


def figures_of(case, configuration, pressure, place):
    scan = scan_of(place, case.pitch_factor)
    composite_rms_height = 0.0
    if case.steps_per_rms:
        unchanged = Case("", "", "", True, {})
        composite_rms_height = mems_stiction.predict(
            scan, None, configuration.changed(unchanged, pressure, scan, 0)
        ).composite_rms_height
    prediction = mems_stiction.predict(
        scan, None, configuration.changed(case, pressure, scan, composite_rms_height)
    )
    values = {name: getattr(prediction, name) for name in FIGURES}
    figures = {
        name: None if isinstance(value, float) and not math.isfinite(value) else value
        for name, value in values.items()
    }
    figures["pitch"] = scan.pitch[0]
    return figures


def interval_rows(configuration, pressure, place):
    """How far the ends of the interval move with the seed of its samples."""
    scan = scan_of(place, 1.0)
    settings = configuration.changed(Case("", "", "", True, {}), pressure, scan, 0)
    prediction = mems_stiction.predict(scan, None, settings)
    rows = []
    for samples in SAMPLES:
        ends = [
            np.quantile(
                prediction.spread(settings, uncertainty={"samples": samples, "seed": seed}),
                (0.025, 0.975),
            )
            for seed in SEEDS
        ]
        lower, upper = zip(*ends)
        rows.append(
            {
                "samples": samples,
                "lower": statistics.mean(lower),
                "upper": statistics.mean(upper),
                "lower_scatter": statistics.stdev(lower) / statistics.mean(lower),
                "upper_scatter": statistics.stdev(upper) / statistics.mean(upper),
            }
        )
    return rows


class Study:
    """Runs cases on surfaces, place by place on a pool of threads."""

    def __init__(self, configuration, pool):
        self.configuration, self.pool = configuration, pool
        self.lock, self.done, self.total = threading.Lock(), 0, 0

    def start(self, surface, cases, pressure):
        """One future for each place: the figures of each case."""
        self.total += len(cases) * surface.count
        return (
            surface,
            cases,
            [
                self.pool.submit(self._place, surface, index, cases, pressure)
                for index in range(surface.count)
            ],
        )

    def _place(self, surface, index, cases, pressure):
        place = surface.place(index)
        figures = []
        for case in cases:
            figures.append(figures_of(case, self.configuration, pressure, place))
            with self.lock:
                self.done += 1
                print("done %d of %d" % (self.done, self.total), file=sys.stderr, flush=True)
        return figures

    @staticmethod
    def finish(started):
        surface, cases, futures = started
        places = [future.result() for future in futures]
        return {
            "name": surface.name,
            "description": surface.description,
            "cases": [
                {
                    "key": case.key,
                    "value": case.value,
                    "kind": case.kind,
                    "is_default": case.is_default,
                    "pitch_factor": case.pitch_factor,
                    "outcomes": [place[number] for place in places],
                }
                for number, case in enumerate(cases)
            ],
        }


def run(arguments):
    settings = mems_stiction.Settings(
        arguments.config,
        **(
            {}
            if arguments.config
            else {"preprocessing/level": "plane" if arguments.scan_files else "none"}
        ),
    )
    configuration = Configuration(settings)
    surfaces = [
        surface_of_file(path, configuration) for path in arguments.scan_files
    ] or generated_surfaces(arguments.scans, arguments.pixels)
    cases = all_cases(configuration, not arguments.scan_files)
    limits = [case for case in cases if case.key == "approach/max_contact_fraction"]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        study = Study(configuration, pool)
        started, near_bonding, intervals = [], [], []
        try:
            started = [study.start(surface, cases, arguments.pressure) for surface in surfaces]
            near_bonding = [
                study.start(surface, limits, 0.0)
                for surface in surfaces_near_bonding(arguments.scans, arguments.pixels // 2)
            ]
            intervals = [
                pool.submit(
                    lambda each: interval_rows(configuration, arguments.pressure, each.place(0)),
                    surface,
                )
                for surface in surfaces
            ]
            record = {
                "pressure": arguments.pressure,
                "pixels": arguments.pixels,
                "steps_per_rms_height": STEPS_PER_RMS_HEIGHT,
                "min_contact_pixels": configuration.value("resolution/min_contact_pixels"),
                "samples": configuration.value("uncertainty/samples"),
                "surfaces": [study.finish(one) for one in started],
                "near_bonding": [study.finish(one) for one in near_bonding],
                "intervals": [
                    {"name": surface.name, "rows": rows.result()}
                    for surface, rows in zip(surfaces, intervals)
                ],
            }
        except BaseException:
            for future in [
                future for one in started + near_bonding for future in one[2]
            ] + intervals:
                future.cancel()
            raise
    print(json.dumps(record, indent=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("scan_files", nargs="*", metavar="SCAN")
    parser.add_argument("--config", metavar="FILE.yaml", help="what everything else is set to")
    parser.add_argument("--scans", type=int, default=12, help="of each generated surface (12)")
    parser.add_argument(
        "--pixels", type=int, default=1024, help="of a side of each generated scan (1024)"
    )
    parser.add_argument(
        "--pressure",
        type=float,
        default=10e6,
        help="mechanical load over the scanned area [Pa] (10e6)",
    )
    arguments = parser.parse_args()
    for name, value, lowest in (
        ("--scans", arguments.scans, 2),
        ("--pixels", arguments.pixels, 64),
        ("--pressure", arguments.pressure, 0),
    ):
        if not value >= lowest:
            parser.error("%s: %s is not allowed, must be >= %s" % (name, value, lowest))
    warnings.simplefilter("ignore", mems_stiction.ScanWarning)
    try:
        run(arguments)
    except mems_stiction.Error as error:
        print("sensitivity_study: %s" % " ".join(str(error).split()), file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
