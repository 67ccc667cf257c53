"""The force of a device from Python: scans of every dress, their pitches, what comes out, and
Ctrl-C."""

import hashlib
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import warnings

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from module_cases import Topography, program, rough  # noqa: E402  (the path comes first)

PITCH = 10e-9
AREA = 1e-11
QUICK = {"device_force": {"realisations": 3, "max_cells": 1e4}}
SPRING = {"device": {"spring_stiffness": 100.0, "travel": 1e-6}}


def scans():
    return [rough(64, 64, 2e-9, 1), rough(64, 64, 2e-9, 2)]


def device_program():
    if "MEMS_STICTION_PREDICT_DEVICE" in os.environ:
        return os.environ["MEMS_STICTION_PREDICT_DEVICE"]
    return str(pathlib.Path(program()).with_name("predict_device"))


def predicted(given, area, pitch=None, contacts=None, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        return mems_stiction.predict_device(
            given, pitch, area=area, contacts=contacts, **dict(QUICK, **settings)
        )


class DeviceTest(unittest.TestCase):
    def test_result_has_what_its_table_says(self):
        device = predicted(scans(), AREA, PITCH)
        self.assertEqual(device.area, AREA)
        self.assertEqual(device.pitch, PITCH)
        self.assertLess(device.pull_off_force_lower, device.pull_off_force)
        self.assertGreater(device.pull_off_force_upper, device.pull_off_force)
        self.assertGreater(device.apparent_work_of_adhesion, 0.0)
        self.assertGreater(device.linear_pull_off_force, 0.0)
        self.assertEqual(len(device.realisations), 3)
        self.assertAlmostEqual(
            float(np.median(device.realisations.pull_off_force)) / device.pull_off_force,
            1.0,
            delta=1e-9,
        )
        self.assertGreaterEqual(len(device.parts_of_scans), 2)
        self.assertTrue((device.spectrum.wavelength > 0).all())
        self.assertIsNone(device.verdict)
        self.assertEqual(device.scans, ("scan 1", "scan 2"))
        self.assertIn("pull-off force", repr(device))
        record = json.loads(device.json())
        self.assertEqual(record, device.to_dict())
        for name in (
            "pull_off_force",
            "pull_off_force_lower",
            "pull_off_force_upper",
            "apparent_work_of_adhesion",
            "linear_pull_off_force",
            "contacts",
        ):
            self.assertEqual(record[name], getattr(device, name), name)
        again = pickle.loads(pickle.dumps(device))
        self.assertEqual(
            (again.json(), again.realisations.tolist()),
            (device.json(), device.realisations.tolist()),
        )

    def test_it_says_which_files_it_is_of_and_what_they_state_alike(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [pathlib.Path(folder) / name for name in ("a.npy", "b.npy")]
            for path, heights, site in zip(paths, scans(), (0.0, 1e-3)):
                np.save(str(path), heights)
                path.with_name(path.name + ".yaml").write_text(
                    "pitch_x: 1.0e-8\npitch_y: 1.0e-8\nwafer_id: W3\npart_id: %s\nsite_x: "
                    "%r\nsite_y: 0.0\n" % (path.stem, site)
                )
            sums = ["sha256:" + hashlib.sha256(path.read_bytes()).hexdigest() for path in paths]
            both = predicted([str(path) for path in paths], AREA, part={"lot": "L7"}).to_dict()
            self.assertEqual(
                (both["wafer_id"], both["lot_id"], both["scan_checksums"]), ("W3", "L7", sums)
            )
            self.assertEqual(
                [name for name in ("part_id", "site_x", "checksum", "scan_name") if name in both],
                [],
            )
            one = predicted(str(paths[1]), AREA).to_dict()
            self.assertEqual(
                (one["part_id"], one["site_x"], one["checksum"], one["scan_checksums"]),
                ("b", 1e-3, sums[1], sums[1:]),
            )
        self.assertNotIn("scan_checksums", predicted(scans(), AREA, PITCH).to_dict())

    def test_it_is_the_programs_to_the_last_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for place, heights in enumerate(scans()):
                paths.append("%s/%d.npy" % (folder, place))
                np.save(paths[-1], heights)
            device = predicted(paths, AREA, PITCH, **SPRING)
            settings = pathlib.Path(folder, "part.yaml")
            settings.write_text(
                "device: {spring_stiffness: 100, travel: 1e-6}\n"
                "device_force: {realisations: 3, max_cells: 1e4}\n"
            )
            done = subprocess.run(
                [
                    device_program(),
                    "--json",
                    "--config",
                    str(settings),
                    "--area",
                    str(AREA),
                    "--pitch",
                    str(PITCH),
                ]
                + paths,
                stdout=subprocess.PIPE,
                check=True,
            )
        self.assertEqual(json.loads(done.stdout.decode()), device.to_dict())
        self.assertGreater(device.verdict.margin_lower, 1.0)
        self.assertAlmostEqual(
            device.verdict.margin * device.pull_off_force / 1e-4, 1.0, delta=1e-9
        )

    def test_scans_of_every_dress_say_the_same(self):
        first, second = scans()
        wanted = predicted([first, second], AREA, PITCH).pull_off_force
        dressed = Topography(second.T, (64 * PITCH, 64 * PITCH), "m")
        self.assertEqual(predicted([first, dressed], AREA, PITCH).pull_off_force, wanted)
        self.assertEqual(
            predicted((mems_stiction.clean(first, PITCH), dressed), AREA).pull_off_force, wanted
        )
        self.assertEqual(predicted(np.array([first, second]), AREA, PITCH).pull_off_force, wanted)
        with tempfile.TemporaryDirectory() as folder:
            np.save(folder + "/first.npy", first)
            self.assertEqual(
                predicted([folder + "/first.npy", dressed], AREA, [PITCH, None]).pull_off_force,
                wanted,
            )
            self.assertEqual(
                predicted(
                    [mems_stiction.read(folder + "/first.npy", pitch=PITCH), second], AREA, PITCH
                ).pull_off_force,
                wanted,
            )
        alone = predicted(first, AREA, PITCH).pull_off_force
        self.assertNotEqual(alone, wanted)
        self.assertEqual(predicted([first], AREA, PITCH).pull_off_force, alone)
        self.assertEqual(predicted(first.tolist(), AREA, PITCH).pull_off_force, alone)

    def test_pitches(self):
        given = scans()
        wanted = predicted(given, AREA, PITCH).pull_off_force
        for pitch in ((PITCH, PITCH), [PITCH, PITCH], [(PITCH, PITCH), PITCH], np.array(PITCH)):
            self.assertEqual(predicted(given, AREA, pitch).pull_off_force, wanted, pitch)
        apart = predicted(given, AREA, [PITCH, 4 * PITCH])
        self.assertNotEqual(apart.pull_off_force, wanted)
        self.assertEqual(apart.pitch, PITCH)
        self.assertEqual(
            apart.pull_off_force,
            predicted(given, AREA, [PITCH, (4 * PITCH, 4 * PITCH)]).pull_off_force,
        )
        oblong = predicted(given, AREA, (PITCH, 2 * PITCH)).pull_off_force
        self.assertNotEqual(oblong, wanted)
        with self.assertRaisesRegex(mems_stiction.SurfaceError, "^pitch: 3 are given for 2 scans"):
            predicted(given, AREA, [PITCH] * 3)
        for wrong in ("10e-9", -1.0, (PITCH, 0.0), [PITCH, "x"]):
            with self.assertRaisesRegex(mems_stiction.SurfaceError, "^pitch: .* is not allowed"):
                predicted(given, AREA, wrong)
        with self.assertRaisesRegex(
            mems_stiction.SurfaceError, "^pitch: an array says nothing of it"
        ):
            predicted(given, AREA)

    def test_a_dictionary_has_files_with_their_pitches_which_are_shown(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [os.path.join(folder, name) for name in ("fine.npy", "wide.npy")]
            for path, heights in zip(paths, scans()):
                np.save(path, heights)
            pitches = [PITCH, (2 * PITCH, 4 * PITCH)]
            found = predicted(dict(zip(paths, pitches)), AREA)
            self.assertEqual(found.pull_off_force, predicted(paths, AREA, pitches).pull_off_force)
            with self.assertRaisesRegex(mems_stiction.SurfaceError, "^pitch: .* dictionary"):
                predicted({paths[0]: PITCH}, AREA, PITCH)
        self.assertEqual(found.pitches, ((PITCH, PITCH), pitches[1]))
        self.assertIn("fine.npy: pixels of 10.0 nm\n", repr(found))
        self.assertIn("wide.npy: pixels of 20.0 nm x 40.0 nm\n", repr(found))

    def test_area_and_contacts_by_argument_or_settings(self):
        given = scans()
        stated = predicted(given, None, PITCH, device={"contact_area": AREA, "contacts": 2})
        self.assertEqual(stated.area, AREA)
        self.assertEqual(
            stated.json().split("settings_hash")[1],
            predicted(given, AREA, PITCH, 2).json().split("settings_hash")[1],
        )
        for area, words in (
            (None, "device/contact_area"),
            (-1.0, "device/contact_area"),
            (0.0, "device/contact_area"),
        ):
            with self.assertRaisesRegex(mems_stiction.OptionsError, words):
                predicted(given, area, PITCH)

    def test_a_scan_that_is_given_twice_counts_once(self):
        given = scans()
        wanted = predicted(given, AREA, PITCH)
        twice = predicted(given + [given[0].copy()], AREA, PITCH)
        self.assertEqual(
            (twice.pull_off_force, twice.pull_off_force_upper),
            (wanted.pull_off_force, wanted.pull_off_force_upper),
        )
        self.assertRegex(
            " ".join(twice.warnings), "shows the heights of .* again; both count as one scan"
        )

    def test_missing_pixels_of_the_wide_scan_are_filled_and_told(self):
        wide = rough(64, 64, 2e-9, 3)
        wide[20, 30] = np.nan
        given = scans() + [wide]
        found = predicted(given, AREA, [PITCH, PITCH, 8 * PITCH])
        self.assertTrue(np.isfinite(found.pull_off_force))
        self.assertRegex(" ".join(found.warnings), "1 of 4096 pixels are missing")
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            surface = mems_stiction.MadeSurface(
                given, [PITCH, PITCH, 8 * PITCH], area=(64 * 8 * PITCH) ** 2
            )
        self.assertTrue(np.isfinite(surface.heights(0, 0, 50, 50)).all())
        self.assertRegex(
            " ".join(str(warning.message) for warning in told), "1 of 4096 pixels are missing"
        )

    def test_settings_that_serve_do_not_warn(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error", mems_stiction.SettingsWarning)
            predicted(scans(), AREA, PITCH)
        with self.assertWarnsRegex(
            mems_stiction.SettingsWarning, "device_force/realisations 3 has no effect"
        ):
            mems_stiction.predict(rough(20, 20), PITCH, **QUICK)

    def test_slips_are_named(self):
        with self.assertRaisesRegex(mems_stiction.SurfaceError, r"scans\[1\].*two dimensions"):
            predicted([rough(20, 20), np.zeros((2, 3, 4))], AREA, PITCH)
        with self.assertRaisesRegex(mems_stiction.SurfaceError, "^scans: an empty list"):
            predicted([], AREA, PITCH)
        with self.assertRaises(mems_stiction.FileError):
            predicted(["/nowhere/scan.gwy"], AREA)

    def test_counter_surface(self):
        given = scans()
        with self.assertRaisesRegex(mems_stiction.OptionsError, "counter_surface/facing"):
            predicted(given[:1], AREA, PITCH, upper=given[1])
        both = predicted(given[:1], AREA, PITCH, upper=given[1], counter_surface={"facing": "up"})
        self.assertEqual(both.to_dict()["counter_surface"], ["counter-surface 1"])

    def test_a_picture(self):
        device = predicted(scans(), AREA, PITCH)
        with tempfile.TemporaryDirectory() as folder:
            for save, name in ((device.save_picture, "a.png"), (device.picture, "b.png")):
                save(pathlib.Path(folder, name))
                self.assertEqual(pathlib.Path(folder, name).read_bytes()[:4], b"\x89PNG")


class VerdictTest(unittest.TestCase):
    def test_a_prediction_is_judged_by_the_devices_own_force(self):
        heights = rough(64, 64, 2e-9, 1)
        device = dict(SPRING["device"], contact_area=AREA)
        prediction = mems_stiction.predict(heights, PITCH, device=device, **QUICK)
        alone = predicted(heights, AREA, PITCH, **SPRING)
        self.assertEqual(prediction.device_force["pull_off_force"], alone.pull_off_force)
        self.assertEqual(prediction.verdict.device_pull_off_force, alone.pull_off_force)
        self.assertEqual(prediction.verdict.margin, alone.verdict.margin)
        self.assertEqual(prediction.to_dict()["device_force"]["contacts"], alone.contacts)

    def test_without_it_nothing_is_scaled_by_area(self):
        heights = rough(64, 64, 2e-9, 1)
        device = dict(SPRING["device"], contact_area=AREA)
        prediction = mems_stiction.predict(
            heights, PITCH, device=device, device_force={"enabled": False}
        )
        self.assertEqual(prediction.verdict.sticks, "unknown")
        self.assertTrue(np.isnan(prediction.verdict.margin))
        self.assertIn("device_force/enabled", prediction.verdict.reason)
        self.assertIsNone(prediction.device_force)

    def test_sweeps_and_cycles_follow_the_frame(self):
        heights = rough(64, 64, 2e-9, 1)
        settings = dict(QUICK, device=dict(SPRING["device"], contact_area=AREA))
        prediction = mems_stiction.predict(heights, PITCH, **settings)
        sweep = mems_stiction.sweep_loads(
            heights, PITCH, voltages=[0.0], mechanical_loads=[0.0, 1e-7], **settings
        )
        self.assertAlmostEqual(sweep.points.margin[0] / prediction.verdict.margin, 1.0, delta=1e-9)
        ratios = sweep.points.margin * sweep.points.pull_off_force
        self.assertAlmostEqual(ratios.max() / ratios.min(), 1.0, delta=1e-9)
        cycles = mems_stiction.cycle_contact(heights, PITCH, count=2, **settings).cycles
        self.assertAlmostEqual(cycles.margin[0] / prediction.verdict.margin, 1.0, delta=1e-9)


LONG = """
import mems_stiction, numpy
heights = 2e-9 * numpy.random.default_rng(1).standard_normal((64, 64))
print("started", flush=True)
try:
    mems_stiction.predict_device(heights, 10e-9, area=1e-8, device_force={"realisations": 1000, "max_cells": 2e5})
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""  # noqa: E501


class InterruptionTest(unittest.TestCase):
    def test_ctrl_c_stops_it(self):
        process = subprocess.Popen(
            [sys.executable, "-W", "ignore", "-c", LONG],
            stdout=subprocess.PIPE,
            universal_newlines=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "started\n")
        time.sleep(1.0)
        self.assertIsNone(process.poll(), "the device is too small to be interrupted")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate(timeout=120)[0], "interrupted\n")
        self.assertEqual(process.returncode, 0)


if __name__ == "__main__":
    unittest.main()
