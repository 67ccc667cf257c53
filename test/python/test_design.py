"""design_sweep: its margins are those of predict_device, its limits where they cross 1, its rows go
on after an interruption."""

import concurrent.futures
import contextlib
import json
import math
import multiprocessing
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from unittest import mock

import mems_stiction
import numpy as np
import scipy.ndimage

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from mems_stiction._device import scans_of_device  # noqa: E402
from mems_stiction._settings import Settings, values_of  # noqa: E402
from mems_stiction.design_axes import ETCH, Axis  # noqa: E402
from mems_stiction.design_points import Hold, Holding, axes_of  # noqa: E402
from mems_stiction.design_words import statements_of, told_once  # noqa: E402
from module_cases import REPOSITORY, rough  # noqa: E402  (the path comes first)
from tiers import times  # noqa: E402

PITCH = 10e-9
SCAN = rough(64, 64, 3e-9, 1, 12)  # its contacts have pixels enough
PART = {
    "device": {"spring_stiffness": 0.1, "travel": 1e-6, "contact_area": 2.5e-13},
    "device_force": {"realisations": 3, "max_cells": 1e4},
}
STIFFNESS, TRAVEL, WORK = "device/spring_stiffness", "device/travel", "interface/work_of_adhesion"
CONTACTS = "device/contacts"
DESIGN_SWEEP = str(REPOSITORY / "scripts" / "design_sweep")
MOST_WAITED = 120.0  # for a program under way [s]


def swept(axes, scans=SCAN, workers=1, **others):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return mems_stiction.design_sweep(
            scans,
            PITCH if isinstance(scans, np.ndarray) else None,
            PART,
            axes=axes,
            workers=workers,
            **others,
        )


def verdict_of(heights=SCAN, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return mems_stiction.predict_device(heights, PITCH, PART, **settings).verdict


def held(force=1e-7, lower=0.5, upper=2.0, doubt="", is_bound=False):
    return Hold(force, 0.4 * force, 2.5 * force, (lower, upper, 1.0), doubt, is_bound)


def as_if(force_of):
    """Instead of the device's force: a made one, of each point. Counts the points."""
    return mock.patch.object(
        Holding, "at", autospec=True, side_effect=lambda _, point: (held(force_of(point)), ())
    )


class MarginTest(unittest.TestCase):
    def assertIsOf(self, row, verdict, delta=1e-12):
        for name in (
            "margin",
            "margin_lower",
            "margin_upper",
            "margin_transition",
            "restoring_force",
        ):
            self.assertAlmostEqual(row[name] / getattr(verdict, name), 1.0, delta=delta, msg=name)
        self.assertEqual(row["sticks"], verdict.sticks)

    def test_softer_bodies_that_are_pressed_harder_hold_harder(self):
        found = swept({"hardness": [0.5e9, 12e9], "load/pressure": [0.0, 50e6]})
        force = found.rows["pull_off_force"].reshape(2, 2)
        self.assertGreater(force[0, 1], 1.5 * force[0, 0])
        self.assertGreater(force[0, 1], 1.2 * force[1, 1])
        self.assertEqual(found.to_dict()["units"]["hardness"], "Pa")
        self.assertIsOf(
            found.rows[1],
            verdict_of(
                lower={"hardness": 0.5e9}, upper={"hardness": 0.5e9}, load={"pressure": 50e6}
            ),
        )

    def test_springs_have_the_verdicts_of_predict_device_and_one_force(self):
        forces = []
        at = Holding.at
        with mock.patch.object(
            Holding,
            "at",
            autospec=True,
            side_effect=lambda self, point: forces.append(point) or at(self, point),
        ):
            found = swept({STIFFNESS: [1e-4, 0.04, 10.0], TRAVEL: [1e-6, 2e-6]})
        self.assertEqual(forces, [{}])
        self.assertEqual(found.margin.shape, (3, 2))
        words = set()
        for place in (0, 3, 5):
            row = found.rows[place]
            self.assertIsOf(row, verdict_of(**{STIFFNESS: row[STIFFNESS], TRAVEL: row[TRAVEL]}))
            words.add(row["sticks"])
        # the pad is cut from one scan in which two contacts hold: too few for a plain no, whatever
        # the spring
        self.assertEqual(words, {"yes", "marginal", "unknown"})
        self.assertGreater(found.rows[5]["margin_lower"], 1.0)

    def test_electrodes_keep_their_closed_gap_and_what_a_potential_holds_there(self):
        electrodes = {
            "device/electrode_area": 1e-9,
            "device/electrode_gap": 1.5e-6,
            "load/contact_potential": 20.0,
            "interface/insulator_thickness": 100e-9,
        }
        found = swept({STIFFNESS: [0.04, 0.4]}, **electrodes)
        bare = swept({STIFFNESS: [0.04]}, **dict(electrodes, **{"device/electrode_area": 0.0}))
        plates = 0.5 * 8.8541878128e-12 * 1e-9 * 20.0**2 / (0.5e-6 + 100e-9 / 3.9) ** 2
        held = found.rows["pull_off_force"][0] - bare.rows["pull_off_force"][0]
        self.assertAlmostEqual(held / plates, 1.0, delta=0.1)  # beside the surfaces' mean gap
        for row in found.rows:
            verdict = verdict_of(**dict(electrodes, **{STIFFNESS: row[STIFFNESS]}))
            self.assertIsOf(row, verdict, 1e-9)  # round-off of the gap beside a travel of 1 cm
            ends = row["pull_off_force_lower"], row["pull_off_force_upper"]
            self.assertGreater(ends[0], plates / math.exp(2.0 * 1.96 * 0.3))
            self.assertAlmostEqual(ends[1] / verdict.device_pull_off_force_upper, 1.0, delta=1e-9)
        with self.assertRaisesRegex(
            mems_stiction.OptionsError, "axes: device/travel is not allowed with device/electrode"
        ):
            swept({TRAVEL: [0.5e-6, 1e-6]}, **electrodes)

    def test_the_surface_may_be_scaled_polished_and_etched(self):
        for axes, heights, settings in (
            ({"roughness/scale": [1.5]}, 1.5 * SCAN, {}),
            (
                {"roughness/polish": [100e-9]},
                SCAN,
                {"preprocessing/low_pass/cutoff_wavelength": 100e-9},
            ),
        ):
            self.assertIsOf(swept(axes).rows[0], verdict_of(heights, **settings))
        x = np.arange(256) * PITCH
        long_waves, short_waves = (
            np.tile(height * np.cos(2 * math.pi * x / wave), (256, 1))
            for height, wave in ((3e-9, 1280e-9), (1e-9, 40e-9))
        )
        lower, above, settings = scans_of_device(
            long_waves + short_waves + rough(256, 256, 1e-12), None, PITCH, None, PART, None, {}, {}
        )
        etched = (
            Holding(lower, above, settings, 200e-9)
            ._changed(mems_stiction.Scan(lower[0]), {ETCH: 3.0})
            .heights
        )
        inside = slice(64, -64)
        np.testing.assert_allclose(
            etched[inside, inside], (long_waves + 3.0 * short_waves)[inside, inside], atol=0.15e-9
        )

    def test_a_force_that_is_at_least_so_large_or_doubted_is_no_plain_no(self):
        for hold, words in (
            (held(), ["yes", "marginal", "no"]),
            (held(doubt="one pixel"), ["yes", "marginal", "unknown"]),
            (held(doubt="they bond", is_bound=True), ["yes", "unknown", "unknown"]),
            (held(lower=math.nan, upper=math.nan), ["unknown"] * 3),
        ):
            self.assertEqual([hold.word(force) for force in (4e-8, 1e-7, 3e-7)], words)
        self.assertEqual(held(0.0).word(1e-9), "no")

    def test_a_sure_spring_tells_a_doubt_that_the_verdict_has(self):
        """Contacts of one pixel: the verdict of a strong spring is unknown, that of a weak one is
        what it is."""
        coarse = rough(64, 64, 20e-9, 1, 10)
        row = swept({STIFFNESS: [100.0]}, coarse).rows[0]
        verdict = verdict_of(coarse, **{STIFFNESS: 100.0})
        self.assertEqual(verdict.sticks, "unknown")
        self.assertIsOf(row, verdict)
        self.assertIn(row["doubt"].split(":")[0], verdict.reason)

    def test_a_scan_that_is_refined_is_as_coarse_as_it_was_measured(self):
        coarse = np.random.RandomState(1).normal(scale=5e-9, size=(64, 64))
        refined = {"preprocessing/refine/factor": 4, "device/contact_area": (64 * PITCH) ** 2}
        row = swept({STIFFNESS: [100.0]}, coarse, **refined).rows[0]
        self.assertEqual(row["sticks"], "unknown")
        self.assertIn("does not show what holds", row["doubt"])


class CoverageTest(unittest.TestCase):
    """Devices that are made after the design: pads cut from other surfaces of the same process,
    each with a work of adhesion and a modulus of its own, as far off as uncertainty/... says of
    them. Takes so long because each design finds the force of a device."""

    SIDE = 256  # of the pads [pixels]
    DEVICES = 24  # of each design

    def places(self, seed, side):
        """Four of one wafer, far apart."""
        wafer = rough(1024, 1024, 3e-9, seed, 12)
        return [
            np.ascontiguousarray(wafer[row : row + side, column : column + side])
            for row in (0, 512)
            for column in (0, 512)
        ]

    def forces_of_devices(self, number):
        random = np.random.RandomState(number)
        pads = [
            pad
            for wafer in range(self.DEVICES // 4)
            for pad in self.places(1000 * (number + 1) + wafer, self.SIDE)
        ]
        settings = values_of(Settings())
        spread = {
            name: math.sqrt(math.log1p(settings["uncertainty/" + name] ** 2))
            for name in ("work_of_adhesion", "youngs_modulus")
        }
        forces = []
        for pad in pads:
            factors = {
                name: math.exp(deviation * random.standard_normal())
                for name, deviation in spread.items()
            }
            bodies = {
                "%s/youngs_modulus" % body: factors["youngs_modulus"]
                * settings["%s/youngs_modulus" % body]
                for body in ("lower", "upper")
            }
            forces.append(
                mems_stiction.predict(
                    pad, PITCH, **{WORK: factors["work_of_adhesion"] * settings[WORK]}, **bodies
                ).pull_off_force
            )
        return np.array(forces)

    def test_a_stiffness_that_is_called_sure_opens_95_of_100_devices(self):
        held = {"sure": 0, "even": 0}
        designs = times(2, 20)
        for number in range(designs):
            scans = self.places(number, 128)[:3]
            device = {"travel": 1e-6, "contact_area": (self.SIDE * PITCH) ** 2}
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = mems_stiction.design_sweep(
                    scans,
                    PITCH,
                    {"device": device, "device_force": {"realisations": 4}},
                    axes={STIFFNESS: (1e-4, 1e3, 1000)},
                    workers=1,
                )
                forces = self.forces_of_devices(number)
            row = found.rows[0]
            self.assertAlmostEqual(
                row.margin_lower * row.pull_off_force_upper,
                row.restoring_force,
                delta=1e-9 * row.restoring_force,
            )
            sure = min(
                row[STIFFNESS]
                for row in found.rows
                if min(row.margin_lower, row.margin_transition) > 1.0
            )
            even = min(row[STIFFNESS] for row in found.rows if row.margin > 1.0)
            held["sure"] += int((forces >= sure * 1e-6).sum())
            held["even"] += int((forces >= even * 1e-6).sum())
        made = designs * self.DEVICES
        self.assertLessEqual(held["sure"], 0.05 * made)
        self.assertGreater(held["even"], 0.05 * made, "a margin of 1 is not sure")


class SentenceTest(unittest.TestCase):
    UNITS = {STIFFNESS: "N/m", WORK: "J/m^2", CONTACTS: ""}
    PIXEL, FEW = "one pixel: scan finer ones", "the answer rests on 1 contact: scan more places"

    @staticmethod
    def word(low, doubt):
        if math.isnan(low) or (low > 1.0 and doubt):
            return "unknown"
        return "no" if low > 1.0 else "marginal"

    def sentence(self, values, lowest, name=STIFFNESS, doubts=None):
        rows = [
            {
                name: value,
                "margin": 2.0 * low,
                "margin_lower": low,
                "margin_transition": 2.0 * low,
                "doubt": doubt,
                "sticks": self.word(low, doubt),
            }
            for value, low, doubt in zip(values, lowest, doubts or [""] * len(values))
        ]
        (sentence,) = statements_of(
            [Axis(name, self.UNITS[name], tuple(values), name == CONTACTS)], rows
        )
        return sentence

    def test_the_limit_is_where_the_lower_end_is_1(self):
        self.assertEqual(
            self.sentence([1.0, 100.0], [0.237, 23.7]),
            "smallest spring stiffness that releases surely: 4.22 N/m (the margin is 1 at 2.11 "
            "N/m)",
        )
        self.assertEqual(
            self.sentence([0.01, 0.1], [4.0, 0.4], WORK),
            "largest work of adhesion that releases surely: 40 mJ/m^2 (the margin is 1 at 80 "
            "mJ/m^2; interpolated between 10 mJ/m^2 and 100 mJ/m^2)",
        )

    def test_there_may_be_no_limit(self):
        self.assertEqual(
            self.sentence([1.0, 2.0], [0.2, 0.4]),
            "no spring stiffness of 1 N/m to 2 N/m releases surely: the lower end of the margin is "
            "at most 0.4, at 2 N/m; the margin goes in proportion, so 5 N/m would",
        )
        self.assertNotIn("proportion", self.sentence([0.01, 0.02], [0.4, 0.2], WORK))
        self.assertEqual(
            self.sentence([1.0, 2.0], [1.2, 2.4]),
            "every spring stiffness of 1 N/m to 2 N/m releases surely",
        )
        self.assertIn("no margin is known for some", self.sentence([1.0, 2.0], [math.nan, 2.4]))

    def test_several_stretches(self):
        self.assertEqual(
            self.sentence([0.01, 0.02, 0.04, 0.08], [2.0, 0.5, 2.0, 0.5], WORK),
            "largest work of adhesion that releases surely: 14.1 mJ/m^2 (interpolated between 10 "
            "mJ/m^2 and 20 mJ/m^2); values from 28.3 mJ/m^2 to 56.5 mJ/m^2 are sure, too, but not "
            "those between: the scatter of the generated surfaces may decide there, and a larger "
            "device_force/realisations makes it surer",
        )
        self.assertTrue(
            self.sentence([0.01, 0.02, 0.04, 0.08], [0.5, 2.0, 0.5, 2.0], WORK).startswith(
                "smallest work of adhesion that releases surely: 56.6 mJ/m^2 ("
            )
        )

    def test_limits_of_whole_numbers_are_whole(self):
        self.assertEqual(
            self.sentence([1.0, 8.0, 40.0], [0.3, 0.6, 1.8], CONTACTS),
            "smallest number of contacts that releases surely: 17 (the margin is 1 between 4 and "
            "5; interpolated between 8 and 40)",
        )
        self.assertIn("surely: 18 (", self.sentence([8.0, 40.0], [1.8, 0.6], CONTACTS))

    def test_warnings_of_many_points_are_told_once(self):
        self.assertEqual(
            told_once(["6.2 times as large", "no unit", "1e-07 times as large", "no unit"]),
            ["6.2 times as large (the figures of other points differ)", "no unit"],
        )

    def test_what_no_verdict_is_sure_of_is_not_called_sure(self):
        """As a user met it: no point of the sweep had the word "no"."""
        self.assertEqual(
            self.sentence([0.01, 0.03, 0.1], [2.4, 2.8, 2.8], WORK, [self.FEW] * 3),
            "no verdict is known for any work of adhesion of 10 mJ/m^2 to 100 mJ/m^2: the answer "
            "rests on 1 contact",
        )
        self.assertEqual(
            self.sentence([0.01, 0.03, 0.1], [0.2, 0.5, 2.0], WORK, ["", "", self.FEW]),
            "no work of adhesion of 10 mJ/m^2 to 100 mJ/m^2 releases surely, though the lower end "
            "of the margin is above 1 from 54.8 mJ/m^2 to 100 mJ/m^2; the verdict is unknown at "
            "100 mJ/m^2: the answer rests on 1 contact",
        )

    def test_every_unknown_point_is_told_and_each_reason_once(self):
        self.assertEqual(
            self.sentence(
                [0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07],
                [4.0, 3.0, 3.0, 3.0, 2.0, 0.5, 2.0],
                WORK,
                ["", self.PIXEL, self.FEW, self.PIXEL, "", "", self.FEW],
            ),
            "work of adhesion releases surely at 10 mJ/m^2 and from 50 mJ/m^2 to 54.7 mJ/m^2; the "
            "verdict is unknown from 20 mJ/m^2 to 40 mJ/m^2 and at 70 mJ/m^2: one pixel; the "
            "answer rests on 1 contact",
        )
        self.assertEqual(
            self.sentence([0.01, 0.02], [math.nan, math.nan], WORK, [self.PIXEL] * 2),
            "no margin is known for any work of adhesion of 10 mJ/m^2 to 20 mJ/m^2: one pixel",
        )
        self.assertTrue(
            self.sentence([1.0, 2.0], [0.2, 0.4], doubts=[self.PIXEL] * 2).endswith(
                "goes in proportion, but from 5 N/m on the verdict would be unknown: one pixel"
            )
        )

    def test_a_limit_stays_one_where_what_is_unknown_lies_before_it(self):
        self.assertEqual(
            self.sentence(
                [0.01, 0.02, 0.1, 0.2], [2.0, 0.4, 4.0, 5.0], WORK, [self.FEW, "", "", ""]
            ),
            "smallest work of adhesion that releases surely: 38 mJ/m^2 (interpolated between 20 "
            "mJ/m^2 and 100 mJ/m^2); the verdict is unknown at 10 mJ/m^2: the answer rests on 1 "
            "contact",
        )


class PictureTest(unittest.TestCase):
    """What stands in it, without the file."""

    def labels(self, found):
        """Of the legend. Every text lies within the figure, and none on another."""
        from mems_stiction import design_figure

        with mock.patch.object(design_figure, "save") as save:
            found.save_picture("map.png")
        figure = save.call_args[0][0]
        self.addCleanup(design_figure.plt.close, figure)
        figure.canvas.draw()
        panel = figure.axes[0]
        texts = [text.get_window_extent() for text in figure.texts]
        for box in texts + [panel.get_legend().get_window_extent()]:
            self.assertGreaterEqual(box.x0, 0.0)
            self.assertLessEqual(box.x1, figure.bbox.x1)
        self.assertFalse(panel.get_legend().get_window_extent().overlaps(texts[0]), "the title")
        marks = [line for line in panel.lines if line.get_label() == "verdict unknown"]
        self.marked = sum(len(line.get_xdata()) for line in marks)
        return [text.get_text() for text in panel.get_legend().get_texts()]

    def sweep(self, doubt_of, axes):
        with mock.patch.object(
            Holding,
            "at",
            autospec=True,
            side_effect=lambda _, point: (held(2e-6 * point[WORK], doubt=doubt_of(point)), ()),
        ):
            return swept(axes)

    def test_what_is_unknown_is_marked_and_not_called_sure(self):
        doubt = "the answer rests on 1 contact in all scans, %s: scan more places" % (
            "a word " * 20
        )
        for doubtful, sure in ((0.0, ""), (0.015, ": beyond it releases surely, where known")):
            found = self.sweep(
                lambda point, doubtful=doubtful: doubt if point[WORK] > doubtful else "",
                {WORK: [0.01, 0.02, 0.1], STIFFNESS: [0.01, 0.1, 1.0]},
            )
            labels = self.labels(found)
            self.assertIn("lower end 1" + sure, labels)
            self.assertIn("upper end 1: beyond it sticks surely", labels)
            self.assertIn("verdict unknown", labels)
            self.assertEqual(self.marked, list(found.rows["sticks"]).count("unknown"))
        labels = self.labels(self.sweep(lambda point: doubt, {WORK: [0.01, 0.1]}))
        self.assertIn("lower end 1 at 25 mJ/m²", labels)
        self.assertEqual(self.marked, 1)

    def test_what_is_known_is_called_sure(self):
        labels = self.labels(
            self.sweep(lambda point: "", {WORK: [0.01, 0.02, 0.1], STIFFNESS: [0.01, 0.1, 1.0]})
        )
        self.assertIn("lower end 1: beyond it releases surely", labels)
        self.assertNotIn("verdict unknown", labels)
        labels = self.labels(self.sweep(lambda point: "", {WORK: [0.01, 0.1]}))
        self.assertIn("releases surely below 25 mJ/m²", labels)
        with as_if(lambda point: 1e-8 if point[WORK] in (0.01, 0.04) else 1e-6):
            labels = self.labels(swept({WORK: [0.01, 0.02, 0.04, 0.08], STIFFNESS: [0.1]}))
        self.assertEqual(sum("releases surely below" in label for label in labels), 1, labels)
        self.assertEqual(self.marked, 0)


class RowsTest(unittest.TestCase):
    AXES = {WORK: (0.01, 0.1, 4), STIFFNESS: [0.05, 0.5]}

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    @staticmethod
    def force(point):
        return 1.7e-6 * point[WORK]

    def test_an_interrupted_sweep_goes_on_where_it_was(self):
        whole, torn = self.path / "whole.csv", self.path / "torn.csv"
        shares = []
        with as_if(self.force) as at:
            uninterrupted = swept(self.AXES, output=whole, on_progress=shares.append)
            self.assertEqual((at.call_count, shares), (4, [0.0, 0.25, 0.5, 0.75, 1.0]))

        def stop(share):
            if share == 0.5:
                raise KeyboardInterrupt

        with as_if(self.force) as at, self.assertRaises(KeyboardInterrupt):
            swept(self.AXES, output=torn, on_progress=stop)
        text = torn.read_text()
        self.assertEqual(text.count("\n"), 1 + 2 * 2)
        torn.write_text(text[:-30])  # as if the machine had stopped
        with as_if(self.force) as at:
            resumed = swept(self.AXES, output=torn)
        self.assertEqual(at.call_count, 3)
        self.assertEqual(torn.read_text(), whole.read_text())
        self.assertEqual(resumed.json(), uninterrupted.json())
        with as_if(self.force) as at:
            swept(self.AXES, output=torn)
        self.assertEqual(at.call_count, 0)

    def test_rows_of_another_sweep_and_other_files_stay(self):
        rows = self.path / "rows.csv"
        with as_if(self.force):
            swept(self.AXES, output=rows)
            before = rows.read_text()
            for changed in (
                {"interface": {"hamaker_constant": 5e-20}},
                {"scans": 1.01 * SCAN},
                {"axes": {WORK: (0.01, 0.1, 5), STIFFNESS: [0.05, 0.5]}},
                {"axes": {WORK: [0.01, 0.02]}},
            ):
                with self.assertRaisesRegex(
                    mems_stiction.OptionsError, r"rows\.csv: holds rows of another sweep"
                ):
                    swept(**dict({"axes": self.AXES, "output": rows}, **changed))
            self.assertEqual(rows.read_text(), before)
            for text in ("a,b\n1,2\n", "notes"):
                rows.write_text(text)
                with self.assertRaisesRegex(
                    mems_stiction.OptionsError, r"rows\.csv: holds no rows of a sweep"
                ):
                    swept(self.AXES, output=rows)
                self.assertEqual(rows.read_text(), text)
            with self.assertRaisesRegex(mems_stiction.OptionsError, "must end in .csv"):
                swept(self.AXES, output=self.path / "rows.txt")

    def test_the_limit_of_each_value_of_the_other_axis(self):
        with as_if(self.force):
            statements = swept({WORK: [0.01, 0.02], STIFFNESS: [0.01, 1.0]}).statements
        self.assertEqual(
            statements,
            (
                "at work of adhesion 10 mJ/m^2: smallest spring stiffness that releases surely: 34 "
                "mN/m (the margin is 1 at 17 mN/m)",
                "at work of adhesion 20 mJ/m^2: smallest spring stiffness that releases surely: 68 "
                "mN/m (the margin is 1 at 34 mN/m)",
            ),
        )

    def test_processes_find_what_one_finds(self):
        axes = {WORK: [0.02, 0.08]}
        alone = swept(axes).json()
        self.assertEqual(swept(axes, workers=2).json(), alone)
        with concurrent.futures.ThreadPoolExecutor(1) as executor:
            self.assertEqual(swept(axes, executor=executor).json(), alone)

    def test_no_thread_waits_for_what_an_interruption_left_locked(self):
        threads = []
        swept(
            {WORK: [0.02, 0.04, 0.06, 0.08]},
            workers=2,
            on_progress=lambda share: threads.append(threading.active_count()),
        )
        self.assertEqual(threads, [threading.active_count()] * 5)

    def test_an_error_or_the_end_of_a_process_ends_the_sweep(self):
        with self.assertRaisesRegex(
            mems_stiction.SurfaceError, "the height map has no valid pixel"
        ):
            swept({WORK: [0.02, 0.08]}, np.full((64, 64), np.nan), workers=2)

        def kill(share):
            for process in multiprocessing.active_children():
                process.kill()

        with self.assertRaisesRegex(mems_stiction.Error, "a worker process has ended"):
            swept({WORK: [0.01 * place for place in range(1, 9)]}, workers=2, on_progress=kill)
        self.assertEqual(multiprocessing.active_children(), [])


class HumidityExampleTest(unittest.TestCase):
    def test_the_example_of_the_document_has_its_figures(self):
        text = (REPOSITORY / "doc" / "process.md").read_text(encoding="utf-8")
        section = text.split("### What humidity does\n")[1].split("\n## ")[0]
        code = section.split("```python\n")[1].split("```")[0]
        names = {"numpy": np, "scipy": scipy, "mems_stiction": mems_stiction}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            code = code.replace('"config/', '"%s/' % (REPOSITORY / "config"))
            exec(code.replace("axes=", "workers=1, axes="), names)
        found = names["found"]
        table = re.findall(r"^\| ([0-9.]+) \| ([0-9.]+) \| ([0-9.]+) \|$", section, re.M)
        forces = 1e9 * found.rows["pull_off_force"].reshape(5, 2)
        np.testing.assert_allclose(
            np.column_stack([found.axes["interface/relative_humidity"], forces]),
            np.array(table, float),
            rtol=0.02,
        )
        self.assertTrue((np.diff(forces[:, 0]) > 0.0).all(), "without films it rises throughout")
        self.assertEqual(forces[0, 0], forces[0, 1], "films without humidity are no water")
        self.assertTrue((forces[1:, 1] > 1.5 * forces[1:, 0]).all())
        limits = [
            float(re.search(r"releases surely: 0\.([0-9]{2})", statement).group(1))
            for statement in found.statements
        ]
        stated = "is %d %% without films and %d %% with them" % tuple(limits)
        self.assertIn(stated, " ".join(section.split()))


class AxesTest(unittest.TestCase):
    def test_ranges_are_filled_evenly_or_by_ratio(self):
        settings = mems_stiction.Settings(PART)
        for given, values in (
            ((1, 5, 3), (1, 3, 5)),
            ((1, 100, 3), (1, 10, 100)),
            ([3, 1, 2, 1], (1, 2, 3)),
            (2, (2,)),
        ):
            (axis,) = axes_of({STIFFNESS: given}, settings)
            np.testing.assert_allclose(axis.values, values)
            self.assertEqual(axis.unit, "N/m")
        (axis,) = axes_of({"device/contacts": (1, 8, 4)}, settings)
        self.assertEqual((axis.values, axis.is_whole), ((1.0, 3.0, 6.0, 8.0), True))

    def test_what_has_an_effect_at_a_point_is_not_said_to_have_none(self):
        humidity, temperature = "interface/relative_humidity", "interface/temperature"
        no_effect = "interface/temperature 250 has no effect: interface/relative_humidity is 0"
        for axes, others, is_said in (
            ({temperature: [250.0, 300.0], humidity: [0.4, 0.8]}, {}, False),
            ({temperature: [250.0, 300.0], humidity: [0.0, 0.8]}, {}, False),
            ({humidity: [0.4, 0.8]}, {temperature: 250.0}, False),
            ({temperature: [250.0, 300.0], WORK: [0.1, 0.2]}, {}, True),
            ({humidity: [0.0]}, {temperature: 250.0}, True),
        ):
            with as_if(lambda _: 1e-7), warnings.catch_warnings(record=True) as told:
                warnings.simplefilter("always")
                mems_stiction.design_sweep(SCAN, PITCH, PART, axes=axes, workers=1, **others)
            said = [text for text in (str(one.message) for one in told) if no_effect in text]
            self.assertEqual(bool(said), is_said, axes)

    def test_each_wrong_axis_is_named(self):
        for axes, words in (
            ({}, "must be a dictionary with one or two names"),
            ({"a": 1, "b": 2, "c": 3}, "a dictionary of 3 is not allowed"),
            ({"device/spring": [1]}, "there is no setting 'device/spring'"),
            (
                {"device/spring_stifness": [1]},
                "'device/spring_stifness' (did you mean device/spring_stiffness?); must be",
            ),
            ({"spring_stiffness": [1]}, "(did you mean device/spring_stiffness?)"),
            ({"device/guidance": [1]}, "device/guidance is no number"),
            (
                {"device/beam_length": [1e-4, 2e-4]},
                "axes: device/beam_length is not allowed: a sweep judges springs, not beams; call "
                "predict_device() for each design of a beam",
            ),
            ({WORK: [0.1], "device/electrode_length": [1e-4]}, "device/electrode_length is not"),
            ({"device/apparent_work_of_adhesion": [1e-3]}, "judges springs, not beams"),
            ({STIFFNESS: "1"}, "must be numbers"),
            ({STIFFNESS: []}, "must be numbers"),
            ({STIFFNESS: (3, 1, 5)}, "with from < to"),
            (
                {"device/contacts": [1.5, 3]},
                "device/contacts: 1.5 is not allowed, must be whole numbers",
            ),
            ({STIFFNESS: [0.0]}, "device/spring_stiffness: 0 is not allowed, must be > 0"),
            ({"interface/relative_humidity": [0.5, 1.5]}, "interface/relative_humidity"),
            ({"roughness/scale": [0.0]}, "roughness/scale: 0 is not allowed"),
            ({ETCH: [2.0]}, "etch_wavelength: None is not allowed"),
        ):
            with self.assertRaisesRegex(mems_stiction.OptionsError, re.escape(words)):
                swept(axes)
        with self.assertRaisesRegex(
            mems_stiction.OptionsError, "etch_wavelength: is not allowed without"
        ):
            swept({STIFFNESS: [1.0]}, etch_wavelength=1e-7)
        with self.assertRaisesRegex(mems_stiction.OptionsError, "workers: 0 is not allowed"):
            swept({STIFFNESS: [1.0]}, workers=0)
        with self.assertRaisesRegex(
            mems_stiction.OptionsError,
            "device/travel: is not stated; must be > 0, or one of the axes",
        ):
            swept({STIFFNESS: [1.0]}, device={"travel": 0.0})
        beam = {
            "beam_type": "cantilever",
            "beam_length": 3e-4,
            "beam_thickness": 2e-6,
            "beam_modulus": 1.6e11,
        }
        for spring, advice in (
            (0.1, ", or state none, and its spring is judged alone$"),
            (0.0, "$"),
        ):
            with self.assertRaisesRegex(
                mems_stiction.OptionsError,
                r"^device/beam_type: 'cantilever' is not allowed: a sweep judges springs, not "
                r"beams; call predict_device\(\) for each design of a beam" + advice,
            ):
                swept({WORK: [0.1]}, device=dict(beam, beam_gap=2e-6, spring_stiffness=spring))
        with self.assertRaisesRegex(
            mems_stiction.OptionsError,
            "roughness/scale is not allowed with preprocessing/tip/radius",
        ):
            swept({"roughness/scale": [1.5]}, preprocessing={"tip/radius": 5e-9})


class ProgramTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        np.save(str(self.path / "scan.npy"), SCAN)
        (self.path / "part.yaml").write_text(json.dumps(PART))

    def command(self, *arguments):
        return [
            sys.executable,
            DESIGN_SWEEP,
            "--config",
            str(self.path / "part.yaml"),
            "--pitch",
            str(PITCH),
            *map(str, arguments),
            str(self.path / "scan.npy"),
        ]

    def run_program(self, *arguments):
        return subprocess.run(
            self.command(*arguments),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )

    @staticmethod
    def kill(program):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(program.pid, signal.SIGKILL)
        program.communicate()

    def test_it_writes_rows_a_record_and_a_picture(self):
        rows, picture = self.path / "rows.csv", self.path / "map.png"
        run = self.run_program(
            "--axis",
            STIFFNESS + "=0.01:10:4",
            "--axis",
            WORK + "=0.02,0.05",
            "--workers",
            1,
            "-o",
            rows,
            "--picture",
            picture,
            "--json",
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertNotIn("%", re.sub(r"95 %", "", run.stderr))  # progress is for terminals
        record = json.loads(run.stdout)
        self.assertEqual(len(record["rows"]), 8)
        self.assertEqual(rows.read_text().count("\n"), 9)
        self.assertRegex(
            record["statements"][0],
            "^at work of adhesion 20 mJ/m.2: no spring stiffness of 10 mN/m to 10 N/m releases "
            "surely, though .*; the verdict is unknown at .*10 N/m: ",
        )
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")

    def test_it_takes_what_is_implausible_if_told_to_and_counts_warnings_if_strict(self):
        axis = ("--axis", STIFFNESS + "=1", "--workers", 1)
        self.assertEqual(self.run_program("--strict", *axis).returncode, 0)
        (self.path / "part.yaml").write_text(
            json.dumps(dict(PART, device=dict(PART["device"], beam_length=1000.0)))
        )
        refused = self.run_program(*axis)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--accept-implausible", refused.stderr)
        accepted = self.run_program("--accept-implausible", *axis)
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        self.assertIn("design_sweep: warning: device/beam_length 1000", accepted.stderr)
        strict = self.run_program("--accept-implausible", "--strict", *axis)
        self.assertEqual(strict.returncode, 1)
        self.assertRegex(
            strict.stderr, "\ndesign_sweep: [0-9]+ warnings?, and --strict takes none\n$"
        )

    def test_workers_of_dask_find_the_same_rows(self):
        try:
            import distributed  # noqa: F401
        except ImportError:
            self.skipTest("distributed is not installed")
        options = ["--axis", WORK + "=0.02:0.05:2", "--workers", "1"]
        here, there = self.path / "here.csv", self.path / "there.csv"
        self.assertEqual(self.run_program(*options, "-o", here).returncode, 0)
        command = self.command(*options, "-o", there)
        command[1] = str(REPOSITORY / "scripts" / "examples" / "design_on_dask.py")
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(there.read_text(), here.read_text())
        self.assertRegex(done.stderr, r"(?m)^100 %$")
        command[command.index(WORK + "=0.02:0.05:2")] = "device/spring=1:2:2"
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True
        )
        self.assertEqual(done.returncode, 2)
        self.assertRegex(
            done.stderr, "(?m)^design_on_dask: axes: there is no setting 'device/spring'"
        )

    def test_it_names_what_is_wrong(self):
        for arguments, words in (
            (
                ("--axis", "device/spring=1:2:3"),
                r"^design_sweep: axes: there is no setting 'device/spring'[^\n]*\n$",
            ),
            (("--axis", STIFFNESS), "must be NAME=FROM:TO:COUNT"),
            (("--axis", STIFFNESS + "=1", "--axis", STIFFNESS + "=2"), "twice"),
            (
                ("--axis", STIFFNESS + "=1,2", "-o", self.path / "none" / "rows.csv"),
                r"^design_sweep: [^\n]*none[^\n]*\n$",
            ),
        ):
            run = self.run_program(*arguments)
            self.assertEqual(run.returncode, 2)
            self.assertRegex(run.stderr, words)

    def test_a_script_that_each_process_would_run_anew_is_told_what_it_lacks(self):
        script = self.path / "sweep.py"
        script.write_text(  # scans larger than what a pipe holds
            "import mems_stiction, numpy\n"
            "scan = numpy.random.default_rng(1).normal(0, 1e-9, (192, 192))\n"
            "mems_stiction.design_sweep(scan, %r, %r, axes={%r: [0.01, 0.1]}, workers=2)\n"
            % (PITCH, PART, WORK)
        )
        run = subprocess.run(
            [sys.executable, str(script)],
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=MOST_WAITED,
        )
        self.assertEqual(run.returncode, 1)
        self.assertIn('lacks `if __name__ == "__main__":`', run.stderr)

    def test_ctrl_c_keeps_rows_and_leaves_no_process(self):
        rows = self.path / "rows.csv"
        axis, count = "0.01:0.1:5000", 5000  # more than anybody waits for
        program = subprocess.Popen(
            self.command("--axis", WORK + "=" + axis, "--workers", 2, "-o", rows),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            start_new_session=True,
        )
        self.addCleanup(self.kill, program)
        end = time.monotonic() + MOST_WAITED
        while not (rows.exists() and rows.read_text().count("\n") > 1):
            self.assertIsNone(
                program.poll(), program.stderr.read() if program.poll() is not None else ""
            )
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)
        os.killpg(program.pid, signal.SIGINT)  # as a terminal does
        _, told = program.communicate(timeout=MOST_WAITED)
        self.assertEqual(
            (program.returncode, told), (-signal.SIGINT, "design_sweep: interrupted\n")
        )
        while True:  # its processes are of its group
            try:
                os.killpg(program.pid, 0)
            except ProcessLookupError:
                break
            self.assertLess(time.monotonic(), end)
            time.sleep(0.1)
        done = rows.read_text().count("\n") - 1
        self.assertGreater(done, 0)
        with as_if(lambda point: 1e-7) as at, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = mems_stiction.design_sweep(
                [str(self.path / "scan.npy")],
                PITCH,
                self.path / "part.yaml",
                axes={WORK: (0.01, 0.1, count)},
                output=rows,
                workers=1,
            )
        self.assertEqual(at.call_count, count - done)
        self.assertEqual(len(found.rows), count)


if __name__ == "__main__":
    unittest.main()
