"""The Python module for somebody who has not seen it: slips are named or warned of at the caller's
line, results can be copied and sent."""

import copy
import hashlib
import json
import multiprocessing
import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from module_cases import DEVICE, FEW, PITCH, Topography, program, rough, without_times  # noqa: E402  (the path comes first)

SOFT = {"lower": {"youngs_modulus": 1e9}, "upper": {"youngs_modulus": 1e9}}


def force_of(heights):
    """For another process."""
    return mems_stiction.predict(heights, PITCH).pull_off_force


class SlipTest(unittest.TestCase):
    def named(self, kind, words, call, *arguments, **settings):
        """Raised in one line, as a ValueError."""
        with self.assertRaisesRegex(kind, words) as caught:
            call(*arguments, **settings)
        self.assertIsInstance(caught.exception, ValueError)
        self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_heights(self):
        good = rough(20, 30)
        for heights, words in (
            (good.astype(np.float16), "float16.*float32 or float64"),
            (None, "NoneType.*array, a topography"),
            ({"heights": good}, "dict.*array"),
            ([[1.0, 2.0], [1.0]], "heights: .*inhomogeneous|heights: .*sequence|object"),
            (3.0, "two dimensions"),
            (good.astype("M8[s]"), "real numbers"),
            (np.ma.masked_all((5, 5)), "no valid pixel"),
        ):
            self.named(mems_stiction.SurfaceError, words, mems_stiction.predict, heights, PITCH)
        self.named(
            mems_stiction.SurfaceError,
            "^pitch: an array says nothing of it",
            mems_stiction.predict,
            good,
        )
        for sizes in ((-1.0, 1.0), (1.0,), (1.0, 1.0, 1.0), "ab", 1.0):
            self.named(
                mems_stiction.SurfaceError,
                "^physical_sizes: .*two numbers > 0",
                mems_stiction.predict,
                Topography(good, sizes, "m"),
            )

    def test_a_text_that_is_given_as_a_number(self):
        for value, shown in (
            (0o17, "15"),
            (1e5, "100000"),
            (True, "true"),
            (np.int64(12), "12"),
            (np.float32(0.5), "0.5"),
        ):
            for settings in ({"part": {"id": value}}, {"part/id": value}):
                self.named(
                    mems_stiction.OptionsError,
                    "^part/id: %s came as a number or a flag, must be a text: quote it" % shown,
                    mems_stiction.Settings,
                    settings,
                )
        self.assertIn('id: "0017"', mems_stiction.Settings(part={"id": "0017"}).yaml())
        with tempfile.TemporaryDirectory() as folder:  # a text has it as it is written
            path = pathlib.Path(folder) / "part.yaml"
            path.write_text("part: {id: 0017, serial: 1e5}\n")
            self.assertRegex(
                mems_stiction.Settings(path).yaml(), 'id: "0017"[^\n]*\n  serial: "1e5"'
            )

    def test_files_that_settings_name(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "part.yaml").write_text("preprocessing/region/polygon_file: corners.txt\n")
            (folder / "corners.txt").write_text("0 0\n0 1e-6\n1e-6 1e-6\n1e-6 0\n")
            heights = rough(200, 200)
            before = mems_stiction.predict(heights, PITCH, folder / "part.yaml")
            (folder / "corners.txt").write_text("0 0\n0 1e-6\n2e-6 1e-6\n2e-6 0\n")
            after = mems_stiction.predict(heights, PITCH, folder / "part.yaml")
            self.assertNotEqual(before.nominal_area, after.nominal_area)
            self.assertNotEqual(before.settings_hash, after.settings_hash)
            written = mems_stiction.Settings(folder / "part.yaml").yaml()
            self.assertIn('region/polygon_file: "%s"' % (folder / "corners.txt"), written)
            stated = mems_stiction.Settings(
                preprocessing={"region": {"mask_file": "mask.png"}}
            ).yaml()
            self.assertIn('region/mask_file: "%s"' % (pathlib.Path.cwd() / "mask.png"), stated)
            (folder / "empty.yaml").write_text("")
            with self.assertWarnsRegex(
                mems_stiction.SettingsWarning, "empty.yaml: states nothing, the defaults hold"
            ):
                mems_stiction.Settings(folder / "empty.yaml")

    def test_names_that_are_no_utf_8(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            scan = folder / "a\udcff\x1b.npy"
            np.save(str(scan), rough(32, 32))
            shown = str(folder) + "/a\\xff\x1b.npy"
            (folder / "c\udcff.yaml").write_text("device: {contact_area: 1.0e-12}\n")
            settings = mems_stiction.Settings(folder / "c\udcff.yaml")
            self.assertEqual(len(mems_stiction.channels(scan)), 1)
            self.assertIn(shown, str(mems_stiction.read(scan, PITCH)))
            prediction = mems_stiction.predict(scan, PITCH, settings, half_space=True)
            self.assertEqual(prediction.scan_name, "a\\xff\\x1b")
            self.assertEqual(json.loads(prediction.json())["file"], shown)
            prediction.save_picture(folder / "picture.png")
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of the surface
                device = mems_stiction.predict_device([scan], PITCH, settings)
            self.assertIn("a\\\\xff", device.json())
            for call in (mems_stiction.read, mems_stiction.channels, mems_stiction.Settings):
                with self.assertRaisesRegex(mems_stiction.FileError, r"none\\xff: "):
                    call(folder / "none\udcff")

    def test_settings_that_contain_themselves(self):
        loop = {}
        loop["lower"] = loop
        endless = []
        endless.append(endless)
        bomb = {"hardness": 1e9}
        for _ in range(12):
            bomb = {"k%d" % i: bomb for i in range(10)}
        for settings in (loop, {"lower": {"hardness": endless}}, bomb):
            self.named(
                mems_stiction.OptionsError,
                "do they contain themselves",
                mems_stiction.Settings,
                settings,
            )

    def test_a_scan_says_which_place_of_which_wafer_it_is(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "place.npy"
            np.save(str(path), rough(20, 30))
            path.with_name("place.npy.yaml").write_text(
                "pitch_x: 1.0e-8\npitch_y: 1.0e-8\nwafer_id: W3\nsite_x: -5.0e-3\nsite_y: "
                "0.0\noperator_name: ann\n"
            )
            scan = mems_stiction.read(path)
            prediction = mems_stiction.predict(path, part={"lot": "L7"})
            record = subprocess.run(
                [program(), "--json", str(path)], stdout=subprocess.PIPE, check=True, timeout=60
            ).stdout
            checksum = "sha256:" + hashlib.sha256(path.read_bytes()).hexdigest()
        for one in (
            scan,
            pickle.loads(pickle.dumps(scan)),
            mems_stiction.clean(scan),
            mems_stiction.predict(scan),
            prediction,
            pickle.loads(pickle.dumps(prediction)),
        ):
            self.assertEqual(
                (
                    one.scan_name,
                    one.wafer_id,
                    one.site_x,
                    one.site_y,
                    one.operator_name,
                    one.checksum,
                    one.part_id,
                ),
                ("place", "W3", -5e-3, 0.0, "ann", checksum, ""),
            )
        self.assertEqual((scan.lot_id, prediction.lot_id), ("", "L7"))
        self.assertEqual(next(mems_stiction.predict_under(scan, configs=[{}])).wafer_id, "W3")
        known = ("scan_name", "wafer_id", "site_x", "site_y", "operator_name", "checksum")
        self.assertEqual(
            {name: mems_stiction.predict(scan).to_dict()[name] for name in known},
            {name: json.loads(record)[name] for name in known},
        )
        nobody = mems_stiction.predict(rough(20, 30), PITCH)
        self.assertTrue(np.isnan(nobody.site_x) and nobody.checksum == nobody.wafer_id == "")
        self.assertEqual([name for name in known if name in nobody.to_dict()], [])

    def test_a_line_scan_is_no_surface(self):
        self.named(
            mems_stiction.SurfaceError,
            "two dimensions",
            mems_stiction.predict,
            Topography(rough(1, 30)[0], (1e-6,), "m"),
        )
        for line in (rough(1, 30), rough(30, 1), rough(1, 30)[0]):
            self.named(
                mems_stiction.SurfaceError,
                r"surface_of_profile\(\) makes grooves or a random surface of it",
                mems_stiction.predict,
                line,
                PITCH,
            )

    def test_pitch_of_the_settings_serves(self):
        heights = rough(20, 30)
        self.assertEqual(
            mems_stiction.predict(
                heights, scan={"pitch_x": PITCH, "pitch_y": PITCH}
            ).pull_off_force,
            mems_stiction.predict(heights, PITCH).pull_off_force,
        )

    def test_lists_and_counts(self):
        good = rough(20, 30)
        for voltages in ("5", [[0, 1], [2, 3]], [None], {"from": 0}):
            self.named(
                mems_stiction.OptionsError,
                "^voltages: .*list of numbers",
                mems_stiction.sweep_loads,
                good,
                PITCH,
                voltages=voltages,
            )
        for count in ("3", 3.0, True, 10**12, None):
            self.named(
                mems_stiction.OptionsError,
                "^count: .*integer >= 1",
                mems_stiction.cycle_contact,
                good,
                PITCH,
                count=count,
            )
        for shape in ("ab", 64, (64, 64.0), (10**12, 1), (64,) * 3):
            self.named(
                mems_stiction.SurfaceError,
                "^shape: .*integers >= 1",
                mems_stiction.generate,
                shape,
                PITCH,
            )

    def test_one_frame_is_not_many(self):
        scan = mems_stiction.clean(rough(20, 30), PITCH)
        for frames in ("scan.gwy", scan, None, rough(20, 30)):
            self.named(ValueError, "^frames: ", mems_stiction.predict_many, frames, PITCH)

    def test_what_does_not_fit_into_memory_is_a_memory_error(self):
        with self.assertRaises(MemoryError):
            mems_stiction.generate((10**6, 10**6), PITCH, counter_surface={"type": "gaussian"})

    def test_an_array_beside_a_topography_has_its_index_order(self):
        lower, upper = rough(40, 40), rough(40, 40, 6e-9, 9)
        facing = {"facing": "up"}
        expected = mems_stiction.predict(lower, PITCH, upper=upper, counter_surface=facing)
        topography = Topography(lower.T, (40 * PITCH, 40 * PITCH), "m")
        for given in (upper.T, Topography(upper.T, (40 * PITCH, 40 * PITCH), "m")):
            prediction = mems_stiction.predict(topography, upper=given, counter_surface=facing)
            self.assertEqual(prediction.pull_off_force, expected.pull_off_force)
            self.assertTrue(np.array_equal(prediction.upper_heights, expected.upper_heights.T))


class WarningTest(unittest.TestCase):
    def caught(self, call):
        with warnings.catch_warnings(record=True) as found:
            warnings.simplefilter("always")
            result = call()
        return result, found

    def test_settings_that_look_like_a_wrong_unit_warn_once_at_the_callers_line(self):
        for call in (
            lambda: mems_stiction.predict(
                rough(20, 30), PITCH, interface={"work_of_adhesion": 15.0}
            ),
            lambda: mems_stiction.half_space(
                rough(8, 8, 1e-10), PITCH, interface={"work_of_adhesion": 15.0}
            ),
            lambda: mems_stiction.Predictor({"interface": {"work_of_adhesion": 15.0}}),
            lambda: mems_stiction.Settings(interface={"work_of_adhesion": 15.0}),
        ):
            _, found = self.caught(call)
            self.assertEqual({one.filename for one in found}, {__file__})
            of_settings = [  # so much work asks for smaller pixels, too
                one for one in found if one.category is mems_stiction.SettingsWarning
            ]
            self.assertEqual(len(of_settings), 1)
            self.assertIn("probably 15 mJ/m^2", str(of_settings[0].message))
        settings, _ = self.caught(
            lambda: mems_stiction.Settings(interface={"work_of_adhesion": 15.0})
        )
        prediction, found = self.caught(
            lambda: mems_stiction.predict(rough(20, 30), PITCH, settings)
        )
        self.assertEqual(found, [])
        self.assertIn("probably 15 mJ/m^2", prediction.warnings[0])
        self.assertIn("probably 15 mJ/m^2", repr(prediction))
        self.assertEqual(list(prediction.warnings), prediction.to_dict()["warnings"])

    def test_roughness_says_that_it_does_not_clean(self):
        heights = rough(24, 30)
        for how in (
            {"preprocessing": {"level": "plane"}},
            {"config": {"preprocessing": {"spikes/enabled": True}}},
            {"config": mems_stiction.Settings(**{"preprocessing/level": "plane"})},
        ):
            figures, found = self.caught(lambda: mems_stiction.roughness(heights, PITCH, **how))
            self.assertEqual(
                [(one.category, one.filename) for one in found],
                [(mems_stiction.SettingsWarning, __file__)],
            )
            self.assertIn("roughness() takes the heights as they are", str(found[0].message))
            self.assertIn("clean()", str(found[0].message))
            self.assertEqual(figures.sq, mems_stiction.roughness(heights, PITCH).sq)
        _, found = self.caught(
            lambda: mems_stiction.roughness(heights, PITCH, interface={"work_of_adhesion": 0.03})
        )
        self.assertEqual(found, [])

    def test_scans_warn_at_the_callers_line(self):
        for call in (
            lambda: mems_stiction.predict(rough(20, 30), 20e-6),
            lambda: mems_stiction.Predictor().predict(rough(20, 30), 20e-6),
            lambda: mems_stiction.half_space(rough(8, 8), (20e-6, PITCH)),
            lambda: mems_stiction.sweep_loads(rough(20, 30), 20e-6),
        ):
            _, found = self.caught(call)
            self.assertTrue(found)
            self.assertEqual(
                {(one.category, one.filename) for one in found},
                {(mems_stiction.ScanWarning, __file__)},
            )

    def test_what_is_implausible_is_refused_unless_it_is_meant(self):
        meant = {"accept_implausible": True}
        with self.assertRaisesRegex(
            mems_stiction.SurfaceError, "implausible: pitch_x 20 m .* limits/accept_implausible"
        ):
            mems_stiction.predict(rough(20, 30), 20.0)
        with self.assertRaisesRegex(
            mems_stiction.OptionsError,
            "lower/youngs_modulus 169 Pa is implausible .* probably 169 GPa",
        ):
            mems_stiction.Settings(lower={"youngs_modulus": 169})
        prediction, found = self.caught(
            lambda: mems_stiction.predict(
                rough(20, 30), 20.0, limits=meant, lower={"youngs_modulus": 169}
            )
        )
        self.assertEqual(
            {one.category for one in found},
            {mems_stiction.ScanWarning, mems_stiction.SettingsWarning},
        )
        self.assertTrue(
            any("pitch_x 20 m" in line for line in prediction.warnings), prediction.warnings
        )

    def test_steps_of_a_cleaning_that_hardly_do_what_is_meant_warn(self):
        ridge = rough(64, 64)
        ridge[:, 56:60] += 100e-9
        for preprocessing, expected in (
            ({"level": "plane"}, "tall features have pulled the levelling aslant: "),
            ({"low_pass/cutoff_wavelength": 1.0}, "is longer than the scan's width"),
        ):
            cleaned, found = self.caught(
                lambda: mems_stiction.clean(ridge, PITCH, preprocessing=preprocessing)
            )
            said = [
                str(one.message)
                for one in found
                if one.category is mems_stiction.ScanWarning and one.filename == __file__
            ]
            self.assertEqual(len(said), 1)
            self.assertIn(expected, said[0])
            prediction, _ = self.caught(
                lambda: mems_stiction.predict(ridge, PITCH, preprocessing=preprocessing)
            )
            self.assertIn(said[0], prediction.warnings)
        for preprocessing in ({}, {"level": "plane", "level_robust": True}):
            self.assertEqual(
                self.caught(lambda: mems_stiction.clean(ridge, PITCH, preprocessing=preprocessing))[
                    1
                ],
                [],
            )

    def test_what_the_programs_say_of_a_file_is_said_where_it_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = str(pathlib.Path(folder, "scan.txt"))
            np.savetxt(path, rough(20, 30))
            pathlib.Path(path).write_text(
                pathlib.Path(path).read_text().rstrip()
            )  # no line end: cut off, maybe
            done = subprocess.run(
                [program(), "--json", "--pitch", "20e-6", path],
                check=True,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
            )
            expected = json.loads(done.stdout)["warnings"]
            self.assertEqual(len(expected), 2, expected)
            scan, found = self.caught(lambda: mems_stiction.read(path, pitch=20e-6))
            self.assertEqual(list(scan.warnings), expected)
            self.assertEqual(
                [(one.category, one.filename, str(one.message)) for one in found],
                [(mems_stiction.ScanWarning, __file__, path + ": " + text) for text in expected],
            )
            for call in (
                mems_stiction.predict,
                mems_stiction.clean,
                mems_stiction.roughness,
                mems_stiction.sweep_loads,
            ):
                _, found = self.caught(lambda: call(scan))
                self.assertEqual(
                    [str(one.message) for one in found], [path + ": " + text for text in expected]
                )
            prediction, _ = self.caught(lambda: mems_stiction.predict(path, 20e-6))
            self.assertEqual(
                (list(prediction.warnings), prediction.to_dict()["warnings"]), (expected, expected)
            )

    def test_a_counter_surface_is_looked_at_too(self):
        lower, upper = rough(40, 40), rough(40, 40, seed=2)
        holed = upper.copy()
        holed[10:] = np.nan  # whole lines, which are said apart
        for given, texts in (
            (1e-9 * upper, ["the counter-surface: rms slope"]),
            (
                holed,
                ["the counter-surface: 30 of 40 rows were not measured", "covers 25 % of the scan"],
            ),
        ):
            for call in (mems_stiction.predict, mems_stiction.cycle_contact):
                result, found = self.caught(
                    lambda: call(lower, PITCH, upper=given, counter_surface={"facing": "up"})
                )
                self.assertEqual(len(found), len(texts))
                for one, text in zip(found, texts):
                    self.assertIn(text, str(one.message))
        with self.assertRaisesRegex(
            mems_stiction.OptionsError, "counter_surface/facing: must be stated .*up = .*down = "
        ):
            mems_stiction.predict(lower, PITCH, upper=upper)


class VerdictTest(unittest.TestCase):
    """A frame whose pixels are far smaller than the cohesive length (2.7 nm), as the half-space
    wants them, and one whose are not."""

    def test_rest_alone_has_its_figures_and_no_others(self):
        heights = rough(48, 48, 3e-10, length=12)
        settings = {"load": {"mechanical_load": 1e-6}}
        whole = mems_stiction.half_space(heights, 5e-9, settings)
        rest = mems_stiction.half_space(heights, 5e-9, settings, half_space={"path": "rest"})
        self.assertEqual(rest.status, "SOLVED")
        for name, delta in (
            ("contact_area", 5e-3),
            ("mean_gap", 5e-3),
            ("contact_stiffness", 0.03),
        ):
            self.assertAlmostEqual(
                getattr(rest, name) / getattr(whole, name), 1.0, delta=delta, msg=name
            )
        self.assertLess(rest.iterations, whole.iterations)
        self.assertTrue(np.isnan(rest.pull_off_force) and np.isnan(rest.apparent_work_of_adhesion))
        self.assertEqual({point[2] for point in rest.curve.tolist()}, {0})  # the approach

    def test_a_half_space_of_one_contact_says_one_group(self):
        x, y = np.mgrid[-12:12, -12:12] * 1e-9
        solved = mems_stiction.half_space(
            -(x**2 + y**2) / 1e-7, 1e-9, load={"mechanical_load": 1e-9}
        )
        self.assertEqual(solved.contact_count, 1)
        self.assertIn(" in 1 group; ", repr(solved))

    def test_a_half_space_that_can_judge_does(self):
        heights, pitch = rough(32, 32, 3e-10, length=8), 1e-10
        settings = {
            "lower": {"youngs_modulus": 1e10},
            "upper": {"youngs_modulus": 1e10},
            "device": dict(DEVICE, contact_area=(32 * pitch) ** 2),
            "device_force": FEW,
        }
        solved = mems_stiction.half_space(heights, pitch, settings)
        self.assertTrue(solved.is_resolved)
        self.assertEqual(solved.verdict.verdict_by, "half_space")
        self.assertRegex(solved.verdict.reason, "^by the half-space:")
        self.assertRegex(
            repr(solved), "sticks: %s, margin .* by the half-space" % solved.verdict.sticks
        )
        self.assertIn("by the half-space", solved._repr_html_())
        self.assertAlmostEqual(
            solved.verdict.device_pull_off_force / solved.pull_off_force, 1.0, delta=1e-9
        )  # round-off
        predicted = mems_stiction.predict(heights, pitch, settings, half_space=False)
        self.assertEqual((predicted.verdict.verdict_by, predicted.half_space), ("prediction", None))

    def test_scans_whose_flags_ask_for_it_are_solved_by_themselves(self):
        smooth, pitch = rough(48, 48, 1.5e-10, length=12), 5e-9
        settings = {
            "device": dict(DEVICE, contact_area=(48 * pitch) ** 2),
            "device_force": {"enabled": False},
        }
        solved = mems_stiction.half_space(smooth, pitch, settings)
        for given in ({}, {"half_space": "auto"}, {"half_space": {"enabled": "flagged"}}):
            predicted = mems_stiction.predict(smooth, pitch, settings, **given)
            self.assertIn("near_bonding", predicted.flags)
            self.assertEqual(predicted.half_space["pull_off_force"], solved.pull_off_force)
            self.assertEqual(
                (predicted.verdict.margin, predicted.verdict.verdict_by),
                (solved.verdict.margin, "half_space"),
            )
            self.assertRegex(
                predicted.verdict.reason, "^by the half-space, as near_bonding asks for it: margin"
            )
            self.assertEqual(
                predicted.to_dict()["half_space"]["pull_off_force"], solved.pull_off_force
            )
        [of_many] = mems_stiction.predict_many([smooth], pitch, settings, workers=2)
        [under] = mems_stiction.predict_under(smooth, pitch, [settings])
        for other in (of_many, under):
            self.assertEqual(other.verdict.reason, predicted.verdict.reason)
        for heights, given in (
            (smooth, {"half_space": False}),
            (rough(48, 48, 5e-9, length=12), {}),
        ):
            predicted = mems_stiction.predict(heights, pitch, settings, **given)
            self.assertEqual(
                (predicted.half_space, predicted.verdict.verdict_by), (None, "prediction")
            )
        self.assertIsNone(mems_stiction.predict(smooth, pitch).half_space)  # no device
        self.assertEqual(
            mems_stiction.predict(smooth, pitch, half_space=True).half_space["pull_off_force"],
            solved.pull_off_force,
        )
        large = mems_stiction.predict(
            smooth, pitch, settings, half_space={"max_flagged_pixels": 2000}
        )
        self.assertEqual((large.half_space, large.verdict.verdict_by), (None, "prediction"))
        self.assertIn("half_space/max_flagged_pixels = 2000", large.verdict.reason)
        with self.assertRaisesRegex(
            mems_stiction.OptionsError,
            "half_space: 'maybe' is not allowed, must be True, False, \"auto\"",
        ):
            mems_stiction.predict(smooth, pitch, half_space="maybe")

    def test_it_moves_the_devices_own_force_as_it_moves_that_of_the_frame(self):
        heights, pitch = rough(32, 32, 3e-10, length=8), 1e-10
        settings = {
            "lower": {"youngs_modulus": 1e10},
            "upper": {"youngs_modulus": 1e10},
            "device": dict(DEVICE, contact_area=1e-16),
            "device_force": {"realisations": 3, "max_cells": 1e4},
        }
        solved = mems_stiction.half_space(heights, pitch, settings)
        predicted = mems_stiction.predict(heights, pitch, settings, half_space=False)
        self.assertEqual(solved.verdict.verdict_by, "half_space")
        moved = (
            predicted.device_force["pull_off_force"]
            * solved.pull_off_force
            / predicted.pull_off_force
        )
        self.assertAlmostEqual(solved.verdict.device_pull_off_force / moved, 1.0, delta=1e-9)

    def test_one_that_cannot_leaves_it_to_the_prediction(self):
        solved = mems_stiction.half_space(
            rough(16, 16), PITCH, SOFT, device=DEVICE, device_force=FEW
        )
        self.assertFalse(solved.is_resolved)
        self.assertEqual(solved.verdict.verdict_by, "prediction")
        predicted = mems_stiction.predict(
            rough(16, 16), PITCH, SOFT, device=DEVICE, device_force=FEW, half_space=False
        ).verdict
        self.assertEqual(
            (solved.verdict.sticks, solved.verdict.margin), (predicted.sticks, predicted.margin)
        )
        self.assertIn("the half-space does not count", solved.verdict.reason)

    def test_without_a_device_there_is_none(self):
        self.assertIsNone(mems_stiction.half_space(rough(16, 16), PITCH, SOFT).verdict)


class CopyTest(unittest.TestCase):
    def results(self):
        heights = rough(24, 30)
        topography = Topography(heights.T, (30 * PITCH, 24 * PITCH), "m")
        return [
            mems_stiction.predict(topography, device=DEVICE, device_force=FEW),
            mems_stiction.half_space(rough(12, 12), PITCH, SOFT, device=DEVICE, device_force=FEW),
            mems_stiction.sweep_loads(
                heights, PITCH, voltages=[0, 1], interface={"insulator_thickness": 1e-7}
            ),
            mems_stiction.cycle_contact(heights, PITCH, count=2),
            mems_stiction.clean(heights, PITCH),
            mems_stiction.Settings(SOFT),
            mems_stiction.roughness(heights, PITCH),
        ]

    def test_results_can_be_copied_pickled_and_shown_again(self):
        for result in self.results():
            for again in (
                copy.copy(result),
                copy.deepcopy(result),
                pickle.loads(pickle.dumps(result)),
            ):
                self.assertEqual(repr(again), repr(result))
                if hasattr(result, "_repr_html_"):
                    self.assertEqual(again._repr_html_(), result._repr_html_())
                if hasattr(result, "save_picture"):
                    with tempfile.TemporaryDirectory() as folder:
                        again.save_picture(pathlib.Path(folder) / "picture.png")
                        self.assertEqual(
                            (pathlib.Path(folder) / "picture.png").read_bytes()[1:4], b"PNG"
                        )

    def test_a_result_outlives_the_array_that_it_shows(self):
        heights = rough(64, 64, 12e-9, 2)
        expected = heights.copy()
        prediction = mems_stiction.predict(heights, PITCH)
        shown = prediction.heights
        del heights, prediction
        for seed in range(20):  # would write over memory that is free
            rough(64, 64, 1e-9, seed)
        self.assertTrue(np.array_equal(shown, expected))

    def test_processes_that_are_spawned(self):
        frames = [rough(24, 30, seed=seed) for seed in range(4)]
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            self.assertEqual(pool.map(force_of, frames), [force_of(frame) for frame in frames])

    def test_processes_that_are_forked_after_a_prediction(self):
        force_of(rough(24, 30))
        mems_stiction.half_space(rough(12, 12), PITCH, SOFT, half_space={"threads": 2})
        frames = [rough(24, 30, seed=seed) for seed in range(4)]
        with multiprocessing.get_context("fork").Pool(2) as pool:
            self.assertEqual(
                pool.map_async(force_of, frames).get(timeout=300),
                [force_of(frame) for frame in frames],
            )

    def test_one_predictor_serves_threads(self):
        from concurrent.futures import ThreadPoolExecutor

        predictor = mems_stiction.Predictor(load={"mechanical_load": 1e-6})
        frames = [rough(40, 30 + seed, seed=seed) for seed in range(8)]
        alone = [without_times(predictor.predict(frame, PITCH).to_dict()) for frame in frames]
        with ThreadPoolExecutor(4) as pool:
            together = list(
                pool.map(
                    lambda frame: without_times(predictor.predict(frame, PITCH).to_dict()),
                    frames * 3,
                )
            )
        self.assertEqual(together, alone * 3)


class WithoutOtherPackagesTest(unittest.TestCase):
    """What `pip install .` brings is NumPy alone."""

    CODE = """
import sys
for name in ("matplotlib", "yaml", "cv2", "jinja2", "scipy", "h5py"):
    sys.modules[name] = None  # cannot be imported
import copy, pickle
import mems_stiction, numpy
heights = numpy.random.default_rng(1).standard_normal((24, 30)) * 1e-9
settings = mems_stiction.Settings(load={"mechanical_load": 1e-7}, device={"spring_stiffness": 2.0, "travel": 1e-6, "contact_area": 1e-11})
prediction = mems_stiction.predict(heights, 2e-8, settings)
assert pickle.loads(pickle.dumps(settings)).yaml() == settings.yaml()
assert pickle.loads(pickle.dumps(mems_stiction.Predictor(settings))).predict(heights, 2e-8).pull_off_force == prediction.pull_off_force
assert prediction._repr_html_() is None and "pull-off force" in repr(copy.deepcopy(prediction))
print(mems_stiction.cycle_contact(heights, 2e-8, count=2), mems_stiction.sweep_loads(heights, 2e-8), mems_stiction.roughness(heights, 2e-8))
for needed in (lambda: mems_stiction.compare_lots([{"margin": 2.0}]), lambda: mems_stiction.calibrate([]), lambda: prediction.save_maps("maps.h5")):
    try:
        needed()
    except mems_stiction.Error as missing:
        print(missing)
try:
    prediction.save_picture("picture.png")
except ImportError as missing:
    print(missing)
    assert isinstance(missing, mems_stiction.Error)
"""  # noqa: E501

    def test_all_but_pictures_work(self):
        done = subprocess.run(
            [sys.executable, "-c", self.CODE],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=300,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertIn("the Python package matplotlib", lines[-1])
        self.assertIn('pip install "mems_stiction[pictures]"', lines[-1])
        for line, words in zip(
            lines[-4:-1],
            (
                "compare_lots needs the Python package scipy (apt install python3-scipy, or pip "
                'install "mems_stiction[process]")',
                "calibrate needs the Python package scipy",
                "HDF5 needs the Python package h5py",
            ),
        ):
            self.assertIn(words, line)


class BenchTest(unittest.TestCase):
    def test_every_way_gives_the_same_forces(self):
        script = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "lib" / "bench_module.py"
        done = subprocess.run(
            [sys.executable, str(script), program(), "--frames", "3", "--pixels", "32"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=300,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 5)


if __name__ == "__main__":
    unittest.main()
