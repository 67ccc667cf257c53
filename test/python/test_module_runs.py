"""The Python module at work: wrong inputs are named, threads and Ctrl-C work, sweeps and cycles
have the messages' fields."""

import json
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mems_stiction._arrays import plain_value  # noqa: E402
from module_cases import DEVICE, FEW, PITCH, REPOSITORY, Topography, program, rough  # noqa: E402  (the path comes first)


class WrongInputTest(unittest.TestCase):
    def test_each_is_named_with_what_is_allowed(self):
        good = rough(20, 30)
        surface, options = mems_stiction.SurfaceError, mems_stiction.OptionsError
        for heights, pitch, kind, words in (
            (good[0], PITCH, surface, "shape \\(30,\\).*two dimensions"),
            (np.stack([good, good]), PITCH, surface, "two dimensions"),
            (good + 0j, PITCH, surface, "complex128.*real numbers"),
            (good.astype(object), PITCH, surface, "type object"),
            (good > 0, PITCH, surface, "type bool"),
            ([["1", "2"]], PITCH, surface, "real numbers"),
            (good[:0], PITCH, surface, "has no pixel"),
            (good * np.nan, PITCH, surface, "no valid pixel"),
            (good, 0, surface, "pitch: 0 .*> 0 m"),
            (good, -1e-9, surface, "pitch: -1e-09"),
            (good, float("nan"), surface, "pitch: nan"),
            (good, "20 nm", surface, "pitch: '20 nm'.*number"),
            (good, (1e-9, 2e-9, 3e-9), surface, "two of them"),
            (good, None, surface, "pitch"),
            (Topography(good, (1.0, 1.0), "parsec"), None, surface, "'parsec'.*nm"),
            (Topography(good, (1.0, 1.0)), None, surface, "states no unit"),
            (Topography(good[0], (1.0,), "m"), None, surface, "two dimensions"),
            (Topography(good, None, "m"), None, surface, "physical_sizes"),
            (Topography(good, (1, 1), "m"), 1e-9, surface, "leave it out"),
        ):
            with self.subTest(words=words):
                with self.assertRaisesRegex(kind, words) as caught:
                    mems_stiction.predict(heights, pitch)
                self.assertIsInstance(caught.exception, ValueError)
                self.assertEqual(len(str(caught.exception).splitlines()), 1)
        with self.assertRaisesRegex(surface, "grid"):
            mems_stiction.predict(good, PITCH, upper=good[:-1], counter_surface={"facing": "up"})
        with self.assertRaisesRegex(surface, "^upper: .*two dimensions"):
            mems_stiction.predict(good, PITCH, upper=good[0])
        with self.assertRaisesRegex(options, "config: 3 is not allowed"):
            mems_stiction.predict(good, PITCH, 3)
        for unfit in ("yes", 1, None, "True"):
            with self.assertRaisesRegex(options, "^half_space: %r is not allowed" % unfit):
                mems_stiction.predict(good, PITCH, half_space=unfit)
        with self.assertRaisesRegex(
            mems_stiction.FileError, "missing.yaml: the configuration file cannot be opened"
        ):
            mems_stiction.predict(good, PITCH, "missing.yaml")
        with self.assertRaisesRegex(OSError, "missing.tiff"):
            mems_stiction.read("missing.tiff")

    def test_settings_raise_the_sentences_of_the_reader_of_files(self):
        good = rough(20, 30)
        wrong = {
            "lower": {"hardnes": 1, "youngs_modulus": -1.0},
            "load/voltage": "high",
            "approach": {"formulation": "none", "max_steps": 1.5},
            "output": {"roughness": 3, "asperities": [1]},
            "preprocessing": 1,
        }
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wrong.yaml")
            pathlib.Path(path).write_text(json.dumps(wrong))
            with self.assertRaises(mems_stiction.OptionsError) as of_file:
                mems_stiction.predict(good, PITCH, path)
            done = subprocess.run(
                [program(), "--config", path, "scan.npy"],
                stderr=subprocess.PIPE,
                universal_newlines=True,
            )
        with self.assertRaises(mems_stiction.OptionsError) as of_dictionary:
            mems_stiction.predict(good, PITCH, wrong)
        with self.assertRaises(mems_stiction.OptionsError) as of_keywords:
            mems_stiction.predict(good, PITCH, **wrong)
        lines = str(of_file.exception).replace(path + ": ", "").splitlines()
        self.assertGreater(len(lines), 6)
        self.assertEqual(str(of_dictionary.exception).splitlines(), lines)
        self.assertEqual(str(of_keywords.exception).splitlines(), lines)
        for line in lines:
            self.assertIn(line, done.stderr)
        self.assertIn("did you mean lower/hardness", lines[-2] + lines[-1] + lines[-3])

    def test_a_wrong_unit_warns(self):
        with self.assertWarnsRegex(mems_stiction.ScanWarning, "pitch"):
            prediction = mems_stiction.predict(rough(20, 30), 20e-6)
        self.assertIn("pitch", prediction.warnings[0])
        with self.assertRaisesRegex(mems_stiction.SurfaceError, "pitch_x 20 m is above 1 mm"):
            mems_stiction.predict(rough(20, 30), 20.0)

    def test_a_frame_that_fails_raises_or_takes_its_place(self):
        given = [rough(20, 30), rough(20, 30)[0], rough(20, 30)]
        with self.assertRaises(mems_stiction.SurfaceError):
            list(mems_stiction.predict_many(given, PITCH))
        first, failed, last = mems_stiction.predict_many(given, PITCH, errors="return")
        self.assertIsInstance(failed, mems_stiction.SurfaceError)
        self.assertEqual(first.pull_off_force, last.pull_off_force)

    def test_a_force_that_is_a_lower_bound_says_so(self):
        smooth = rough(20, 30, 1e-12)
        for formulation, is_bound in (("paper", True), ("separation_curve", False)):
            settings = {"approach": {"formulation": formulation}}
            prediction = mems_stiction.predict(smooth, PITCH, **settings)
            self.assertEqual((prediction.status, prediction.is_lower_bound), ("BONDED", is_bound))
            points = mems_stiction.sweep_loads(smooth, PITCH, voltages=[0], **settings).points
            cycles = mems_stiction.cycle_contact(smooth, PITCH, count=1, **settings)
            self.assertEqual({bool(point.is_lower_bound) for point in points}, {is_bound})
            self.assertEqual(bool(cycles.cycles[0].is_lower_bound), is_bound)
            self.assertEqual(">=" in repr(cycles), is_bound)


BEAM = {
    "beam_type": "cantilever",
    "beam_length": 2e-4,
    "beam_width": 2e-5,
    "beam_thickness": 2e-6,
    "beam_gap": 2e-6,
    "beam_modulus": 160e9,
    "contact_area": 1e-11,
    "electrode_start": 2e-5,
    "electrode_length": 5e-5,
}
WORDS = {
    "direction": ("up", "down"),
    "status": ("EQUILIBRIUM", "BONDED", "NO_EQUILIBRIUM"),
    "sticks": ("no", "marginal", "yes", "unknown"),
    "lands": ("no", "yes", "unknown"),
}  # of the record, where arrays have numbers

LONG = """
import mems_stiction, numpy, sys
heights = 5e-9 * numpy.random.default_rng(1).standard_normal((512, 512))
soft = {"youngs_modulus": 1e8}
print("started", flush=True)
try:
    mems_stiction.%s, lower=soft, upper=soft, load={"mechanical_load": 1e-5})
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


class ThreadTest(unittest.TestCase):
    def test_ctrl_c_stops_a_half_space(self):
        self.interrupt("half_space(heights, 20e-9")

    def test_ctrl_c_stops_a_prediction_with_a_half_space(self):
        self.interrupt("predict(heights, 20e-9, half_space=True")

    def interrupt(self, call):
        process = subprocess.Popen(
            [sys.executable, "-c", LONG % call],
            stdout=subprocess.PIPE,
            universal_newlines=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "started\n")
        time.sleep(1.0)
        self.assertIsNone(process.poll(), "the frame is too small to be interrupted")
        process.send_signal(signal.SIGINT)
        began = time.monotonic()
        self.assertEqual(process.communicate(timeout=300)[0], "interrupted\n")
        self.assertEqual(process.returncode, 0)
        self.assertLess(
            time.monotonic() - began, 30
        )  # the whole solution takes minutes; a busy machine has room

    def test_the_interpreter_goes_on_meanwhile(self):
        heights = rough(700, 700, 12e-9)
        began = time.perf_counter()
        mems_stiction.predict(heights, PITCH)
        alone = time.perf_counter() - began
        for _ in range(5):  # on a busy machine the first may have taken longer
            ticks = []
            thread = threading.Thread(target=mems_stiction.predict, args=(heights, PITCH))
            thread.start()
            while thread.is_alive():
                ticks.append(time.perf_counter())
                time.sleep(alone / 50)
            if len(ticks) > 5:
                break
        self.assertGreater(len(ticks), 5)  # one or two if the lock were held

    def test_daemon_threads_that_predict_do_not_abort_the_exit(self):
        code = """
import threading, time
import numpy as np
import mems_stiction
heights = np.random.RandomState(1).normal(0.0, 3e-9, (96, 96))
begun = threading.Semaphore(0)
def go_on(work):
    while True:
        begun.release()
        work()
for work in (lambda: mems_stiction.predict(heights, 1e-8), lambda: mems_stiction.roughness(heights, 1e-8), lambda: mems_stiction.half_space(heights, 1e-8)):
    threading.Thread(target=go_on, args=(work,), daemon=True).start()
for _ in range(6):
    begun.acquire()
time.sleep(%f)
"""  # noqa: E501
        for turn in range(6):
            ended = subprocess.run(
                [sys.executable, "-c", code % (0.01 * turn)],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                timeout=300,
            )
            self.assertEqual((ended.returncode, ended.stderr), (0, b""))

    def test_static_objects_outlive_daemon_threads(self):
        """What exit() destroys, it would destroy behind threads that the core has objects of."""
        code = """
import ctypes, sys, threading, time
libc = ctypes.CDLL(None)
libc.strdup.restype = ctypes.c_void_p
# Called behind the destructors of what is loaded from here on: dprintf(1, ...).
libc.on_exit(libc.dprintf, ctypes.c_void_p(libc.strdup(b"destroyed\\n")))
import numpy as np
import mems_stiction
heights = np.random.RandomState(1).normal(0.0, 3e-9, (48, 48))
done = threading.Event()
def work():
    mems_stiction.predict(heights, 1e-8)
    done.set()
    time.sleep(1000)
if %r:
    threading.Thread(target=work, daemon=True).start()
    done.wait()
else:
    mems_stiction.predict(heights, 1e-8)
print("told")
sys.exit(1)
"""
        for is_daemon, told in ((True, b"told\n"), (False, b"told\ndestroyed\n")):
            ended = subprocess.run(
                [sys.executable, "-W", "ignore", "-c", code % is_daemon],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                timeout=300,
            )
            self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (1, told, b""))

    def test_a_prediction_goes_to_another_process(self):
        prediction = mems_stiction.predict(rough(40, 50), PITCH, device=DEVICE, device_force=FEW)
        copy = pickle.loads(pickle.dumps(prediction))
        self.assertEqual(copy.json(), prediction.json())
        self.assertTrue(np.array_equal(copy.contact_map, prediction.contact_map))
        self.assertEqual(copy.asperities.load.tolist(), prediction.asperities.load.tolist())
        self.assertEqual(copy.verdict.sticks, prediction.verdict.sticks)
        for one in (
            mems_stiction.clean(rough(9, 9), PITCH),
            mems_stiction.Settings(load={"mechanical_load": 1e-6}),
        ):
            self.assertEqual(repr(pickle.loads(pickle.dumps(one))), repr(one))


class StationTest(unittest.TestCase):
    def fields_of(self, message):
        text = (REPOSITORY / "msg" / (message + ".msg")).read_text()
        return re.findall(r"^\w+ (\w+) +#", text, re.MULTILINE)

    def test_records_have_the_fields_of_the_messages(self):
        heights = rough(48, 48)
        sweep = mems_stiction.sweep_loads(
            heights,
            PITCH,
            voltages=[0, 5],
            mechanical_loads=[0, 1e-7],
            interface={"insulator_thickness": 1e-7},
            device=DEVICE,
            device_force=FEW,
        )
        cycles = mems_stiction.cycle_contact(
            heights, PITCH, count=3, load={"mechanical_load": 1e-6}, lower={"hardness": 1e9}
        )
        self.assertEqual(sorted(sweep.points.dtype.names), sorted(self.fields_of("SweepPoint")))
        self.assertEqual(
            sorted(sweep.summaries.dtype.names), sorted(self.fields_of("SweepSummary"))
        )
        self.assertEqual(sorted(cycles.cycles.dtype.names), sorted(self.fields_of("CyclePoint")))
        self.assertEqual(sweep.points.voltage.tolist(), [0, 5, 0, 0, 5, 0])
        self.assertEqual(cycles.cycles.cycle.tolist(), [1, 2, 3])
        self.assertEqual(cycles.lower.shape, heights.shape)
        first = mems_stiction.predict(
            heights, PITCH, load={"mechanical_load": 1e-6}, lower={"hardness": 1e9}
        )
        self.assertEqual(cycles.cycles[0].pull_off_force, first.pull_off_force)
        self.assertIn("contact 3", repr(cycles))
        self.assertIn("Pressed with", repr(sweep))

    def test_a_refined_scan_is_as_coarse_in_sweeps_and_cycles_as_in_its_prediction(self):
        coarse = np.random.RandomState(1).normal(scale=5e-9, size=(48, 48))
        for own_force in (True, False):
            settings = dict(
                preprocessing={"refine": {"factor": 4}},
                device=dict(DEVICE, spring_stiffness=1e4, contact_area=(48 * PITCH) ** 2),
                device_force=dict(FEW, enabled=own_force),
            )
            found = mems_stiction.predict(coarse, PITCH, **settings)
            self.assertEqual(found.verdict.sticks, "unknown")
            self.assertIn("does not show what holds", found.verdict.reason)
            said = [line for line in found.warnings if "what holds" in line]
            self.assertEqual(len(said), 1, found.warnings)
            sweep = mems_stiction.sweep_loads(
                coarse, PITCH, voltages=[0], mechanical_loads=[0, 1e-7], **settings
            )
            cycles = mems_stiction.cycle_contact(coarse, PITCH, count=2, **settings)
            for run in (sweep, cycles):
                self.assertIn("the scan does not show what holds", run.why_no_margin)
                self.assertIn("There is no margin: the scan does not show what holds", str(run))
            words = sweep.points.sticks.tolist() + cycles.cycles.sticks.tolist()
            self.assertEqual(words, [3] * 4, own_force)

    def test_a_sweep_of_predict_scan_has_the_same_figures_to_the_bit(self):
        heights = rough(48, 48, 3e-9, 1, 12)  # its pixels show what holds: the margins are known
        for device in (
            DEVICE,
            BEAM,
            dict(BEAM, beam_type="doubly_clamped", beam_length=1e-4, contact_area=0.0),
        ):
            settings = dict(
                interface={"insulator_thickness": 1e-7}, device=device, device_force=FEW
            )
            swept = mems_stiction.sweep_loads(
                heights, PITCH, voltages=[0, 10, 20], mechanical_loads=[0, 1e-7], **settings
            )
            with tempfile.TemporaryDirectory() as folder:
                scan, config = os.path.join(folder, "scan.npy"), os.path.join(folder, "config.yaml")
                np.save(scan, heights)
                pathlib.Path(config).write_text(json.dumps(settings))
                call = [
                    program(),
                    "--json",
                    "--pitch",
                    str(PITCH),
                    "--config",
                    config,
                    "--sweep-voltage",
                    "0:20:10",
                    "--sweep-load",
                    "0,1e-7",
                    scan,
                ]
                printed = json.loads(
                    subprocess.run(call, check=True, stdout=subprocess.PIPE).stdout
                )["sweep"]
            self.assertEqual(plain_value(swept.pull_in_voltage), printed["pull_in_voltage"])
            self.assertEqual(swept.pull_in_reason, printed.get("pull_in_reason", ""))
            for found, told in (
                (swept.points, printed["points"]),
                (swept.summaries, printed["summaries"]),
            ):
                self.assertEqual(len(found), len(told))
                # a record leaves out what the formulation does not have; arrays have it as NaN
                left_out = set(found.dtype.names) - set(told[0])
                for name in left_out:
                    # 0 where the device is open
                    self.assertTrue(np.all(np.isnan(found[name]) | (found[name] == 0)), name)
                for name in set(found.dtype.names) - left_out:
                    words = WORDS.get(name)
                    self.assertEqual(
                        [words[value] if words else plain_value(value) for value in found[name]],
                        [row[name] for row in told],
                        (device, name),
                    )
            self.assertFalse(
                np.isnan(
                    swept.points[0].peel_number if "beam_type" in device else swept.points[0].margin
                )
            )

    def test_wrong_requests_are_named(self):
        with self.assertRaisesRegex(mems_stiction.OptionsError, "voltages"):
            mems_stiction.sweep_loads(rough(20, 20), PITCH, voltages=[5, 0])
        with self.assertRaisesRegex(mems_stiction.OptionsError, "0"):
            mems_stiction.cycle_contact(rough(20, 20), PITCH, count=0)


if __name__ == "__main__":
    unittest.main()
