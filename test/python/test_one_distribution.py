"""Margin and force are two faces of one distribution, in every program that states them, whatever
the settings: restoring force over force, quantile by quantile; of beams the beam's own work over
that of adhesion. One scan has one word in all of them. It takes long since each of eleven programs
and functions finds the force of the device anew. Messages: test/ros/one_distribution_test.cpp."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import mems_stiction
import numpy as np
from roslib.packages import find_node

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import rough  # noqa: E402  (the path comes first)
from tiers import times  # noqa: E402

PITCH = 10e-9
SCAN = rough(96, 96, 3e-9, 1, 12)
SPRING = {"spring_stiffness": 0.5, "travel": 1e-6, "contact_area": 1e-12}
SHORT = {
    "beam_type": "cantilever",
    "beam_length": 3e-4,
    "beam_width": 2e-5,
    "beam_thickness": 2e-6,
    "beam_gap": 2e-6,
    "beam_modulus": 160e9,
    "contact_area": 1e-12,
}
LONG = dict(
    SHORT, beam_type="doubly_clamped", beam_length=5e-4, beam_thickness=1e-6, contact_area=2e-9
)
DEVICES = {"spring": SPRING, "force": SHORT, "peeling": LONG}
RATIOS = [name + end for name in ("margin", "peel_number") for end in ("", "_lower", "_upper")]
WORDS = ("no", "marginal", "yes", "unknown")


def settings_of(kind):
    """Drawn, but for the device's kind."""
    draw = np.random.RandomState(sorted(DEVICES).index(kind))
    device = dict(DEVICES[kind])
    if "spring_stiffness" in device:
        device["spring_stiffness"] *= float(np.exp(draw.uniform(-1.0, 1.0)))
    return {
        "device": device,
        "device_force": {"realisations": 4, "max_cells": 1e4, "seed": int(draw.randint(1000))},
        "interface": {"work_of_adhesion": 0.05 * float(np.exp(draw.uniform(-0.5, 0.5)))},
        "uncertainty": {
            "work_of_adhesion": float(draw.uniform(0.0, 0.6)),
            "youngs_modulus": float(draw.uniform(0.0, 0.1)),
            "samples": int(draw.randint(20, 400)),
            "seed": int(draw.randint(1000)),
        },
    }


def word_of(figures):
    """sticks, by its name or by its number."""
    sticks = figures["sticks"]
    return sticks if isinstance(sticks, str) else WORDS[int(sticks)]


class FacesTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        np.save(str(self.folder / "scan.npy"), SCAN)
        (self.folder / "scan.npy.yaml").write_text(
            "pitch_x: %r\npitch_y: %r\npart_id: A\n" % (PITCH, PITCH)
        )

    def run_program(self, name, *arguments):
        done = subprocess.run(
            [find_node("mems_stiction", name)[0], "--config", "device.yaml"] + list(arguments),
            cwd=str(self.folder),
            check=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=200,
        )
        return done.stdout

    def faces(self, settings):
        """{who says it: its figures} of one scan."""
        (self.folder / "device.yaml").write_text(json.dumps(settings))
        found = {
            "predict_scan": json.loads(self.run_program("predict_scan", "--json", "scan.npy")),
            "predict_device": json.loads(self.run_program("predict_device", "--json", "scan.npy")),
        }
        self.run_program("stiction_batch", "-o", "rows.jsonl", "scan.npy")
        self.run_program(
            "stiction_batch", "-o", "of_part.jsonl", "--parts", "parts.jsonl", "scan.npy"
        )
        for name, path in (("batch", "rows.jsonl"), ("part", "parts.jsonl")):
            found[name] = json.loads((self.folder / path).read_text().splitlines()[0])
        self.run_program("stiction_report", "--steps", "0", "-o", "report.html", "scan.npy")
        report = json.loads((self.folder / "report.json").read_text())
        found["report"], found["part of the report"] = report["scans"][0], report["parts"][0]
        for path in ("rows.jsonl", "of_part.jsonl", "parts.jsonl"):
            for left in self.folder.glob(path + "*"):
                os.unlink(str(left))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found["predict"] = mems_stiction.predict(SCAN, PITCH, **settings).to_dict()
            found["predict_device()"] = mems_stiction.predict_device(
                [SCAN], pitch=PITCH, **settings
            ).to_dict()
            sweep = mems_stiction.sweep_loads(SCAN, PITCH, voltages=[0.0], **settings).points
            cycles = mems_stiction.cycle_contact(SCAN, PITCH, count=1, **settings).cycles
            designs = None
            if "spring_stiffness" in settings["device"]:
                stiffness = [settings["device"]["spring_stiffness"]]
                designs = mems_stiction.design_sweep(
                    SCAN, PITCH, axes={"device/spring_stiffness": stiffness}, workers=1, **settings
                ).rows
        for name, points in (("sweep", sweep), ("cycles", cycles), ("design", designs)):
            if points is not None:
                found[name] = {column: points[0][column] for column in points.dtype.names}
        return found

    def test_every_program_states_one_margin_by_one_distribution(self):
        for kind in times(("spring", "peeling"), DEVICES):
            found = self.faces(settings_of(kind))
            first = found["predict_scan"]
            governed = first["governed_by"]
            self.assertEqual(governed, "" if kind == "spring" else kind)
            decides = "peel_number" if governed == "peeling" else "margin"
            for name, figures in found.items():
                said = figures.get("verdict", figures)
                if "part" in name:
                    self.assertEqual(said["governed_by"], governed, "%s: %s" % (kind, name))
                self.assertEqual(word_of(said), word_of(first), "%s: %s" % (kind, name))
                for ratio in (
                    RATIOS
                    if name != "design"
                    else [decides + end for end in ("", "_lower", "_upper")]
                ):
                    value, expected = said[ratio], first[ratio]
                    where = "%s of %s: %s" % (ratio, kind, name)
                    if expected is None:
                        self.assertTrue(value is None or math.isnan(value), where)
                    else:
                        self.assertAlmostEqual(value / expected, 1.0, delta=1e-9, msg=where)
                if said.get("device_pull_off_force") is None or said["margin"] is None:
                    continue
                for ratio, force in (
                    ("margin", ""),
                    ("margin_lower", "_upper"),
                    ("margin_upper", "_lower"),
                ):
                    product = said[ratio] * said["device_pull_off_force" + force]
                    self.assertAlmostEqual(
                        product / said["restoring_force"],
                        1.0,
                        delta=1e-9,
                        msg="%s of %s: %s" % (ratio, kind, name),
                    )
            force = first["device_force"]
            for end in ("", "_lower", "_upper"):
                self.assertAlmostEqual(
                    first["device_pull_off_force" + end] / force["pull_off_force" + end],
                    1.0,
                    delta=1e-9,
                )
            if kind != "spring":
                self.assertAlmostEqual(
                    first["peel_number_lower"]
                    * force["apparent_work_of_adhesion_upper"]
                    / (first["peel_number_upper"] * force["apparent_work_of_adhesion_lower"]),
                    1.0,
                    delta=1e-9,
                )


if __name__ == "__main__":
    unittest.main()
