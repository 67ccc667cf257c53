"""The Python module: its bits are those of predict_scan, arrays are not copied, wrong inputs are named, threads and Ctrl-C work."""

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
import warnings

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PITCH = 20e-9
FORMULATIONS = ("consistent", "paper", "printed")
DEVICE = {"spring_stiffness": 2.0, "travel": 1e-6, "contact_area": 1e-11}
CLEANING = {"level": "plane", "spikes": {"enabled": True}, "fill": {"enabled": True, "max_fraction": 0.5}}


def program():
    """predict_scan as built; by the environment where ROS cannot find it."""
    if "MEMS_STICTION_PREDICT_SCAN" in os.environ:
        return os.environ["MEMS_STICTION_PREDICT_SCAN"]
    from roslib.packages import find_node

    return find_node("mems_stiction", "predict_scan")[0]


def rough(rows, columns, rms_height=5e-9, seed=1, length=5):
    """Gaussian heights [m], correlated over `length` pixels."""
    q = np.hypot(np.fft.fftfreq(rows)[:, None], np.fft.rfftfreq(columns)[None, :])
    waves = np.fft.rfft2(np.random.RandomState(seed).standard_normal((rows, columns)))
    heights = np.fft.irfft2(waves * np.exp(-(q * np.pi * length) ** 2 / 2), s=(rows, columns))
    return heights / heights.std() * rms_height


def frames():
    """Smooth to rough, of either type, with holes, with a tilt and a spike."""
    holes = rough(40, 50, 3e-9, 3)
    holes[5:9, 30:40] = np.nan
    dirty = rough(48, 48, 4e-9, 4) + 1e-9 * np.arange(48)
    dirty[7, 9] += 200e-9
    return {"smooth": rough(64, 48, 0.4e-9), "rough": rough(64, 64, 12e-9, 2), "single": rough(33, 61).astype(np.float32),
            "holes": holes, "dirty": dirty}


def without_times(record):
    """What two runs can share."""
    return {name: without_times(value) if isinstance(value, dict) else value for name, value in record.items()
            if name not in ("processing_time", "file", "scan_name", "settings_hash")}


class Topography:
    """What is used of SurfaceTopography's class, for machines that do not have it: the first index is x."""

    def __init__(self, heights, physical_sizes, unit=None):
        self._heights, self.physical_sizes, self.unit = heights, physical_sizes, unit

    def heights(self):
        return self._heights


def topographies():
    """Name and class of each kind of topography: the stand-in, and the real one where it is installed."""
    kinds = [("stand-in", Topography)]
    try:
        from SurfaceTopography import Topography as Real
    except ImportError:
        return kinds
    return kinds + [("SurfaceTopography", Real)]


class BitsTest(unittest.TestCase):
    """A record is equal only if every figure of it is, to the last bit: JSON has the shortest text of each number."""

    @classmethod
    def setUpClass(cls):
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def records(self, settings, *arguments, names=None):
        """predict_scan on each frame with these settings. {name: record}"""
        paths = []
        for name, heights in frames().items():
            if names is None or name in names:
                np.save(str(self.folder / (name + ".npy")), heights)
                paths.append(str(self.folder / (name + ".npy")))
        (self.folder / "settings.yaml").write_text(json.dumps(settings))
        done = subprocess.run([program(), "--json", "--config", str(self.folder / "settings.yaml"), "--pitch", repr(PITCH), *arguments]
                              + paths, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, timeout=250)
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual(len(lines), len(paths))
        return {pathlib.Path(line["file"]).stem: line for line in lines}

    def check(self, settings, names=None, upper=None, ours=None):
        records = self.records(settings, names=names)
        predictor = mems_stiction.Predictor(settings if ours is None else ours)
        for name, record in records.items():
            prediction = predictor.predict(frames()[name], PITCH, upper)
            with self.subTest(frame=name, settings=settings):
                self.assertEqual(without_times(prediction.to_dict()), without_times(record))
                if ours is None and upper is None:
                    self.assertEqual(prediction.to_dict()["settings_hash"], record["settings_hash"])
                for figure in ("pull_off_force", "contact_area", "mean_gap", "flattening_ratio"):
                    value = getattr(prediction, figure)
                    self.assertTrue(value == record[figure] or (np.isnan(value) and record[figure] is None), figure)

    def test_every_formulation(self):
        for formulation in FORMULATIONS:
            self.check({"approach": {"formulation": formulation}})

    def test_loads_device_and_cleaning(self):
        for formulation in FORMULATIONS:
            self.check({"approach": {"formulation": formulation}, "device": DEVICE, "preprocessing": CLEANING,
                        "load": {"voltage": 5.0, "mechanical_load": 1e-6},
                        "interface": {"insulator_thickness": 1e-7, "relative_humidity": 0.4}})

    def test_refined_soft_and_with_an_energy_curve(self):
        self.check({"preprocessing": {"refine": {"factor": 2}}, "lower": {"hardness": 1e9},
                    "output": {"energy_curve": True, "asperities": False, "spatial_roughness": True}}, ("rough", "single"))

    def test_counter_surfaces(self):
        upper = rough(64, 64, 6e-9, 9)
        np.save(str(self.folder / "upper.npy"), upper)
        for facing in ("up", "down"):
            of_file = {"counter_surface": {"type": "file", "file": str(self.folder / "upper.npy"), "facing": facing},
                       "scan": {"pitch_x": PITCH, "pitch_y": PITCH}}
            ours = {"counter_surface": {"facing": facing}}
            self.check(of_file, ("rough",), upper, ours)
        self.check({"counter_surface": {"type": "gaussian", "seed": 4}}, ("rough",))

    def test_half_space(self):
        settings = {"lower": {"youngs_modulus": 1e9}, "upper": {"youngs_modulus": 1e9}, "load": {"mechanical_load": 1e-8}, "device": DEVICE}
        for name, record in self.records(settings, "--half-space", names=("smooth", "holes")).items():
            solved = mems_stiction.half_space(frames()[name], PITCH, settings)
            of_record = record["half_space"]
            curve = [(point["height"], point["force"], ("APPROACH", "RETRACTION").index(point["direction"])) for point in of_record.pop("curve")]
            self.assertEqual([tuple(point) for point in solved.curve.tolist()], curve)
            for figure, value in without_times(of_record).items():
                ours = getattr(solved, figure)
                self.assertTrue(ours == value or (value is None and np.isnan(ours)), (name, figure))
            for figure, ours in vars(solved.verdict).items():
                value = record[figure]
                self.assertTrue(ours == value or (value is None and np.isnan(ours)), (name, figure, ours, value))

    def test_many_frames_on_threads(self):
        settings = {"load": {"mechanical_load": 1e-6}}
        records = self.records(settings)
        for workers in (1, 3):
            predictions = mems_stiction.predict_many(list(frames().values()) * 4, PITCH, settings, workers=workers)
            for name, prediction in zip(list(frames()) * 4, predictions):
                self.assertEqual(without_times(prediction.to_dict()), without_times(records[name]))

    def test_one_scan_under_many_settings(self):
        heights, upper = rough(64, 48, 12e-9, 2), rough(64, 48, 6e-9, 9)
        configs = [{"approach": {"formulation": formulation}, "load": load, "interface": {"work_of_adhesion": work}, "device": DEVICE}
                   for formulation in FORMULATIONS for load in ({}, {"pressure": 1e6}) for work in (0.02, 0.2)]
        for shared in ({}, {"preprocessing": dict(CLEANING, refine={"factor": 2}), "counter_surface": {"facing": "up"}}):
            counter = upper if shared else None
            together = list(mems_stiction.predict_under(heights, PITCH, configs, counter, **shared))
            for config, prediction in zip(configs, together):
                alone = mems_stiction.predict(heights, PITCH, config, counter, **shared)
                self.assertEqual(without_times(prediction.to_dict()), without_times(alone.to_dict()))
                self.assertTrue(np.array_equal(prediction.contact_map, alone.contact_map))
                self.assertEqual(prediction.asperities.tobytes(), alone.asperities.tobytes())

    def test_settings_of_one_scan_may_not_prepare_it_in_two_ways(self):
        for second in ({"preprocessing": {"level": "plane"}}, {"counter_surface": {"type": "gaussian"}}, {"output": {"roughness": False}}):
            found = mems_stiction.predict_under(rough(20, 30), PITCH, [{}, second])
            next(found)
            with self.assertRaisesRegex(mems_stiction.OptionsError, "must be the same"):
                next(found)
        for configs in ({}, "part.yaml", None, mems_stiction.Settings()):
            with self.assertRaisesRegex(mems_stiction.OptionsError, "^configs: "):
                mems_stiction.predict_under(rough(20, 30), PITCH, configs)
        self.assertEqual(list(mems_stiction.predict_under(rough(20, 30), PITCH, [])), [])

    def test_files(self):
        record = self.records({}, names=("rough",))["rough"]
        path = self.folder / "rough.npy"
        for given in (str(path), path, mems_stiction.read(path, pitch=PITCH)):
            pitch = None if isinstance(given, mems_stiction.Scan) else PITCH
            self.assertEqual(without_times(mems_stiction.predict(given, pitch).to_dict()), without_times(record))

    def test_settings_of_a_file_a_dictionary_and_keywords_are_one(self):
        (self.folder / "part.yaml").write_text("load: {mechanical_load: 1.0e-6}\nlower/hardness: 2e9\nupper: {hardness: 3e9}\n")
        heights = frames()["rough"]
        given = [mems_stiction.predict(heights, PITCH, self.folder / "part.yaml"),
                 mems_stiction.predict(heights, PITCH, {"load/mechanical_load": 1e-6, "lower": {"hardness": np.float64(2e9)}, "upper": {"hardness": 3000000000}}),
                 mems_stiction.predict(heights, PITCH, load={"mechanical_load": 1e-6}, lower={"hardness": "2e9"}, upper={"hardness": 3e9})]
        self.assertEqual(len({json.dumps(without_times(one.to_dict())) for one in given}), 1)
        self.assertNotEqual(given[0].contact_area, mems_stiction.predict(heights, PITCH).contact_area)


class ArrayTest(unittest.TestCase):
    def test_what_the_type_allows_is_not_copied(self):
        whole = rough(80, 90)
        read_only = whole.copy()
        read_only.flags.writeable = False
        for heights in (whole, whole.astype(np.float32), read_only, whole[10:50, 20:70], whole[::2]):
            self.assertTrue(np.shares_memory(mems_stiction.predict(heights, PITCH).heights, heights))

    def test_every_layout_predicts_the_same(self):
        heights = rough(40, 50)
        expected = without_times(mems_stiction.predict(heights, PITCH).to_dict())
        wide = np.repeat(np.repeat(heights, 2, 0), 3, 1)
        shifted = np.frombuffer(b"x" + heights.tobytes(), np.uint8)[1:].view(np.float64).reshape(heights.shape)
        for other in (np.asfortranarray(heights), wide[::2, ::3], heights[::-1, ::-1][::-1, ::-1], heights[::-1].copy()[::-1],
                      heights.astype(">f8"), heights.tolist(), np.ma.masked_invalid(heights), shifted):
            self.assertEqual(without_times(mems_stiction.predict(other, PITCH).to_dict()), expected)

    def test_masked_pixels_are_missing(self):
        heights = rough(40, 50)
        mask = heights > np.percentile(heights, 95)
        missing = np.where(mask, np.nan, heights)
        masked = np.ma.masked_array(heights, mask)
        self.assertEqual(without_times(mems_stiction.predict(masked, PITCH).to_dict()),
                         without_times(mems_stiction.predict(missing, PITCH).to_dict()))
        self.assertAlmostEqual(mems_stiction.predict(masked, PITCH).invalid_fraction, mask.mean(), delta=1e-12)  # round-off

    def test_arrays_outlive_the_prediction_and_cannot_be_written(self):
        prediction = mems_stiction.predict(rough(64, 64, 12e-9, 2), PITCH, load={"mechanical_load": 1e-6})
        contact, asperities, curve = prediction.contact_map, prediction.asperities, prediction.curve
        expected = contact.copy(), asperities.copy(), curve.copy()
        area = prediction.contact_area
        del prediction
        for seed in range(20):  # would write over memory that is free
            mems_stiction.predict(rough(64, 64, 12e-9, seed), PITCH)
        for array, copy in zip((contact, asperities, curve), expected):
            self.assertEqual(repr(array.tolist()), repr(copy.tolist()))
            self.assertFalse(array.flags.writeable)
        self.assertAlmostEqual(asperities.area.sum() / area, 1.0, delta=1e-9)  # a sum in another order
        self.assertEqual(set(np.unique(contact)) - {0}, set(asperities.regime))

    def test_maps_have_the_index_order_of_a_topography(self):
        heights = rough(40, 60)
        expected = mems_stiction.predict(heights, (10e-9, 20e-9), load={"mechanical_load": 1e-6})
        for name, kind in topographies():
            with self.subTest(topography=name):
                topography = kind(heights.T * 1e9, (60 * 10.0, 40 * 20.0), unit="nm")
                prediction = mems_stiction.predict(topography, load={"mechanical_load": 1e-6})
                self.assertEqual(prediction.contact_map.shape, topography.heights().shape)
                # nanometres and back cost the last digit of each height
                self.assertAlmostEqual(prediction.pull_off_force / expected.pull_off_force, 1.0, delta=1e-6)
                self.assertTrue(np.allclose(prediction.heights, heights.T, rtol=1e-12, atol=0))
                in_metres = mems_stiction.predict(kind(heights.T, (60 * 10e-9, 40 * 20e-9), unit="m"), load={"mechanical_load": 1e-6})
                self.assertTrue(np.array_equal(in_metres.contact_map, expected.contact_map.T))
                self.assertTrue(np.array_equal(in_metres.asperities.x, expected.asperities.x))
                self.assertIn("<img", in_metres._repr_html_())

    def test_a_scan_goes_to_surface_topography_and_back(self):
        if len(topographies()) < 2:
            self.skipTest("SurfaceTopography is not installed: the stand-in serves above")
        cleaned = mems_stiction.clean(frames()["holes"], PITCH)
        back = mems_stiction.predict(cleaned.topography())
        self.assertEqual(back.pull_off_force, mems_stiction.predict(cleaned).pull_off_force)


class GeneratedTest(unittest.TestCase):
    def test_surfaces_are_those_that_the_counter_surface_is_made_of(self):
        for kind in ("gaussian", "self_affine"):
            settings = {"type": kind, "seed": 3, kind: {"rms_height": 2e-9}}
            scan = mems_stiction.generate((64, 48), PITCH, counter_surface=settings)
            self.assertEqual(scan.heights.shape, (64, 48))
            self.assertAlmostEqual(scan.heights.std() / 2e-9, 1.0, delta=1e-6)  # scaled to it
            self.assertTrue(np.array_equal(scan.heights, mems_stiction.generate((64, 48), PITCH, counter_surface=settings).heights))
            flat = np.zeros((64, 48))
            drawn = mems_stiction.predict(flat, PITCH, counter_surface=settings)
            given = mems_stiction.predict(flat, PITCH, upper=scan, counter_surface={"facing": "up"})
            self.assertEqual(without_times(given.to_dict()), without_times(drawn.to_dict()))

    def test_a_coarser_scan_is_the_mean_over_blocks(self):
        heights = rough(40, 51)
        coarse = mems_stiction.decimate(heights, PITCH, factor=4)
        expected = heights[:, :48].reshape(10, 4, 12, 4).mean((1, 3))
        self.assertTrue(np.allclose(coarse.heights, expected, rtol=0, atol=1e-22))  # sums in another order
        self.assertEqual(coarse.pitch, (4 * PITCH, 4 * PITCH))
        for factor in (0, 1.5, 64):
            with self.assertRaises(mems_stiction.SurfaceError):
                mems_stiction.decimate(heights, PITCH, factor=factor)

    def test_the_spread_is_that_of_the_margin(self):
        settings = {"device": DEVICE, "load": {"mechanical_load": 1e-6}}
        prediction = mems_stiction.predict(rough(64, 64, 12e-9, 2), PITCH, settings)
        spread = prediction.spread(settings)
        self.assertTrue(np.all(np.diff(spread) >= 0))
        lower, upper = 1 / np.quantile(spread, (0.975, 0.025))
        # the margin is interpolated between samples itself, this between their inverses
        self.assertAlmostEqual(prediction.verdict.margin_lower / prediction.verdict.margin / lower, 1.0, delta=0.02)
        self.assertAlmostEqual(prediction.verdict.margin_upper / prediction.verdict.margin / upper, 1.0, delta=0.02)

    def test_what_cannot_be_generated_is_named(self):
        with self.assertRaisesRegex(mems_stiction.OptionsError, "counter_surface/type"):
            mems_stiction.generate((64, 48), PITCH)
        with self.assertRaisesRegex(mems_stiction.SurfaceError, "shape"):
            mems_stiction.generate((0, 48), PITCH, counter_surface={"type": "gaussian"})


class WrongInputTest(unittest.TestCase):
    def test_each_is_named_with_what_is_allowed(self):
        good = rough(20, 30)
        surface, options = mems_stiction.SurfaceError, mems_stiction.OptionsError
        for heights, pitch, kind, words in (
                (good[0], PITCH, surface, "shape \\(30,\\).*two dimensions"), (np.stack([good, good]), PITCH, surface, "two dimensions"),
                (good + 0j, PITCH, surface, "complex128.*real numbers"), (good.astype(object), PITCH, surface, "type object"),
                (good > 0, PITCH, surface, "type bool"), ([["1", "2"]], PITCH, surface, "real numbers"),
                (good[:0], PITCH, surface, "has no pixel"), (good * np.nan, PITCH, surface, "no valid pixel"),
                (good, 0, surface, "pitch: 0 .*> 0 m"), (good, -1e-9, surface, "pitch: -1e-09"), (good, float("nan"), surface, "pitch: nan"),
                (good, "20 nm", surface, "pitch: '20 nm'.*number"), (good, (1e-9, 2e-9, 3e-9), surface, "two of them"),
                (good, None, surface, "pitch"), (Topography(good, (1.0, 1.0), "parsec"), None, surface, "'parsec'.*nm"),
                (Topography(good, (1.0, 1.0)), None, surface, "states no unit"), (Topography(good[0], (1.0,), "m"), None, surface, "two dimensions"),
                (Topography(good, None, "m"), None, surface, "physical_sizes"), (Topography(good, (1, 1), "m"), 1e-9, surface, "leave it out")):
            with self.subTest(words=words):
                with self.assertRaisesRegex(kind, words) as caught:
                    mems_stiction.predict(heights, pitch)
                self.assertIsInstance(caught.exception, ValueError)
                self.assertEqual(len(str(caught.exception).splitlines()), 1)
        with self.assertRaisesRegex(surface, "grid"):
            mems_stiction.predict(good, PITCH, upper=good[:-1])
        with self.assertRaisesRegex(surface, "^upper: .*two dimensions"):
            mems_stiction.predict(good, PITCH, upper=good[0])
        with self.assertRaisesRegex(options, "config: 3 is not allowed"):
            mems_stiction.predict(good, PITCH, 3)
        with self.assertRaisesRegex(mems_stiction.FileError, "missing.yaml: the configuration file cannot be opened"):
            mems_stiction.predict(good, PITCH, "missing.yaml")
        with self.assertRaisesRegex(OSError, "missing.tiff"):
            mems_stiction.read("missing.tiff")

    def test_settings_raise_the_sentences_of_the_reader_of_files(self):
        good = rough(20, 30)
        wrong = {"lower": {"hardnes": 1, "youngs_modulus": -1.0}, "load/voltage": "high", "approach": {"formulation": "none", "max_steps": 1.5},
                 "output": {"roughness": 3, "asperities": [1]}, "preprocessing": 1}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "wrong.yaml")
            pathlib.Path(path).write_text(json.dumps(wrong))
            with self.assertRaises(mems_stiction.OptionsError) as of_file:
                mems_stiction.predict(good, PITCH, path)
            done = subprocess.run([program(), "--config", path, "scan.npy"], stderr=subprocess.PIPE, universal_newlines=True)
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
            prediction = mems_stiction.predict(rough(20, 30), 20.0)
        self.assertIn("pitch", prediction.warnings[0])

    def test_a_frame_that_fails_raises_or_takes_its_place(self):
        given = [rough(20, 30), rough(20, 30)[0], rough(20, 30)]
        with self.assertRaises(mems_stiction.SurfaceError):
            list(mems_stiction.predict_many(given, PITCH))
        first, failed, last = mems_stiction.predict_many(given, PITCH, errors="return")
        self.assertIsInstance(failed, mems_stiction.SurfaceError)
        self.assertEqual(first.pull_off_force, last.pull_off_force)


LONG = """
import mems_stiction, numpy, sys
heights = 5e-9 * numpy.random.default_rng(1).standard_normal((512, 512))
soft = {"youngs_modulus": 1e8}
print("started", flush=True)
try:
    mems_stiction.half_space(heights, 20e-9, lower=soft, upper=soft, load={"mechanical_load": 1e-5})
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


class ThreadTest(unittest.TestCase):
    def test_ctrl_c_stops_a_half_space(self):
        process = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(process.stdout.readline(), "started\n")
        time.sleep(1.0)
        self.assertIsNone(process.poll(), "the frame is too small to be interrupted")
        process.send_signal(signal.SIGINT)
        began = time.monotonic()
        self.assertEqual(process.communicate(timeout=60)[0], "interrupted\n")
        self.assertEqual(process.returncode, 0)
        self.assertLess(time.monotonic() - began, 20)  # the whole solution takes minutes; a busy machine has room

    def test_the_interpreter_goes_on_meanwhile(self):
        heights = rough(700, 700, 12e-9)
        began = time.perf_counter()
        mems_stiction.predict(heights, PITCH)
        alone = time.perf_counter() - began
        ticks = []
        thread = threading.Thread(target=mems_stiction.predict, args=(heights, PITCH))
        thread.start()
        while thread.is_alive():
            ticks.append(time.perf_counter())
            time.sleep(alone / 50)
        self.assertGreater(len(ticks), 5)  # one or two if the lock were held

    def test_a_prediction_goes_to_another_process(self):
        prediction = mems_stiction.predict(rough(40, 50), PITCH, device=DEVICE)
        copy = pickle.loads(pickle.dumps(prediction))
        self.assertEqual(copy.json(), prediction.json())
        self.assertTrue(np.array_equal(copy.contact_map, prediction.contact_map))
        self.assertEqual(copy.asperities.load.tolist(), prediction.asperities.load.tolist())
        self.assertEqual(copy.verdict.sticks, prediction.verdict.sticks)
        for one in (mems_stiction.clean(rough(9, 9), PITCH), mems_stiction.Settings(load={"mechanical_load": 1e-6})):
            self.assertEqual(repr(pickle.loads(pickle.dumps(one))), repr(one))


class StationTest(unittest.TestCase):
    def fields_of(self, message):
        text = (REPOSITORY / "msg" / (message + ".msg")).read_text()
        return re.findall(r"^\w+ (\w+) +#", text, re.MULTILINE)

    def test_records_have_the_fields_of_the_messages(self):
        heights = rough(48, 48)
        sweep = mems_stiction.sweep_loads(heights, PITCH, [0, 5], [0, 1e-7], interface={"insulator_thickness": 1e-7}, device=DEVICE)
        cycles = mems_stiction.cycle_contact(heights, PITCH, 3, load={"mechanical_load": 1e-6}, lower={"hardness": 1e9})
        self.assertEqual(sorted(sweep.points.dtype.names), sorted(self.fields_of("SweepPoint")))
        self.assertEqual(sorted(sweep.summaries.dtype.names), sorted(self.fields_of("SweepSummary")))
        self.assertEqual(sorted(cycles.cycles.dtype.names), sorted(self.fields_of("CyclePoint")))
        self.assertEqual(sweep.points.voltage.tolist(), [0, 5, 0, 0, 5, 0])
        self.assertEqual(cycles.cycles.cycle.tolist(), [1, 2, 3])
        self.assertEqual(cycles.lower.shape, heights.shape)
        first = mems_stiction.predict(heights, PITCH, load={"mechanical_load": 1e-6}, lower={"hardness": 1e9})
        self.assertEqual(cycles.cycles[0].pull_off_force, first.pull_off_force)
        self.assertIn("contact 3", repr(cycles))
        self.assertIn("Pressed with", repr(sweep))

    def test_wrong_requests_are_named(self):
        with self.assertRaisesRegex(mems_stiction.OptionsError, "voltages"):
            mems_stiction.sweep_loads(rough(20, 20), PITCH, [5, 0])
        with self.assertRaisesRegex(mems_stiction.OptionsError, "0"):
            mems_stiction.cycle_contact(rough(20, 20), PITCH, 0)


class TextTest(unittest.TestCase):
    def test_text_and_page(self):
        prediction = mems_stiction.predict(rough(64, 64, 12e-9, 2), PITCH, device=DEVICE)
        self.assertRegex(repr(prediction), r"equilibrium\n  pull-off force [\d.]+ [nu]N on .*\n.*\n  sticks: ")
        page = prediction._repr_html_()
        self.assertIn('<img src="data:image/png;base64,iVBOR', page)
        self.assertIn("does the device stick?", page)
        for formulation in FORMULATIONS:
            bare = mems_stiction.predict(rough(20, 30), PITCH, approach={"formulation": formulation}, output={"contact_map": False, "deformed_surfaces": False})
            self.assertIn("<img", bare._repr_html_())
        soft = {"youngs_modulus": 1e9}
        solved = mems_stiction.half_space(rough(24, 24), PITCH, lower=soft, upper=soft)
        self.assertIn("<img", solved._repr_html_())
        self.assertIn("Half-space: solved", repr(solved))

    def test_a_picture_leaves_the_backend_of_pyplot_alone(self):
        code = ("import matplotlib; matplotlib.use('svg')\nimport mems_stiction, numpy\n"
                "mems_stiction.predict(numpy.eye(20) * 1e-9, 20e-9)._repr_html_()\nprint(matplotlib.get_backend().lower())")
        done = subprocess.run([sys.executable, "-W", "ignore", "-c", code], stdout=subprocess.PIPE, universal_newlines=True, check=True)
        self.assertEqual(done.stdout.strip(), "svg")

    def test_messages_and_pictures_do_not_load_the_core(self):
        code = "import mems_stiction.plots, sys; print('mems_stiction._core' in sys.modules)"
        done = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, universal_newlines=True, check=True)
        self.assertEqual(done.stdout.strip(), "False")

    def test_every_figure_is_annotated_and_explained_with_its_unit(self):
        units = _core.prediction_units()
        of_prediction = dict(units["prediction"], formulation="", regime_flags="")
        for kind, table in ((mems_stiction.Prediction, of_prediction), (mems_stiction.Verdict, units["verdict"]),
                            (mems_stiction.Roughness, _core.roughness_units()), (mems_stiction.HalfSpace, _core.half_space_units())):
            annotated = {name for name in kind.__annotations__ if not name.startswith("_")}
            self.assertEqual(annotated, set(table), kind)
            text = " ".join(kind.__doc__.split())
            for name, unit in table.items():
                # "a, b [N]: ..." gives both their unit
                pattern = r"(?<!\w)%s(?:, \w+)*%s" % (name, r" \[%s\]" % re.escape(unit) if unit else "")
                self.assertRegex(text, pattern)

    def test_every_name_has_a_description(self):
        for name in mems_stiction.__all__:
            self.assertTrue(getattr(mems_stiction, name).__doc__, name)
            self.assertIn(name, dir(mems_stiction))


class TypeTest(unittest.TestCase):
    def test_types_fit(self):
        try:
            import mypy.api
        except ImportError:
            self.skipTest("mypy is not installed")
        files = sorted(str(path) for path in (REPOSITORY / "python" / "mems_stiction").glob("_*.py*"))
        files = [path for path in files if not path.endswith("__init__.py")] + [
            str(REPOSITORY / "python" / "mems_stiction" / "archive.py"), str(REPOSITORY / "test" / "python" / "module_use.py")]
        with tempfile.TemporaryDirectory() as cache:
            out, err, status = mypy.api.run(["--config-file", str(REPOSITORY / "pyproject.toml"), "--cache-dir", cache] + files)
        self.assertEqual(status, 0, out + err)

    def test_the_stub_has_what_the_compiled_part_has(self):
        stub = (REPOSITORY / "python" / "mems_stiction" / "_core.pyi").read_text()
        self.assertEqual(set(re.findall(r"^(?:class|def) (\w+)", stub, re.MULTILINE)),
                         {name for name in dir(_core) if not name.startswith("_")})
        for kind, body in re.findall(r"^class (\w+):\n((?:    .*\n)+)", stub, re.MULTILINE):
            self.assertEqual(set(re.findall(r"^    (?:def )?(\w+)[(:]", body, re.MULTILINE)) - {"__init__"},
                             {name for name in vars(getattr(_core, kind)) if not name.startswith("_")}, kind)


class NotebookTest(unittest.TestCase):
    def test_it_runs(self):
        try:
            import nbclient
            import nbformat
            import ipykernel  # noqa: F401
        except ImportError as missing:
            self.skipTest("%s is not installed" % missing.name)
        for path in sorted((REPOSITORY / "doc" / "notebooks").glob("*.ipynb")):
            notebook = nbformat.read(str(path), as_version=4)
            self.assertTrue(all(not cell.get("outputs") for cell in notebook.cells), "%s holds outputs" % path.name)
            with tempfile.TemporaryDirectory() as folder:
                nbclient.NotebookClient(notebook, timeout=200, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
            shown = [output for cell in notebook.cells for output in cell.get("outputs", []) if "text/html" in output.get("data", {})]
            self.assertGreater(len(shown), 0)


if __name__ == "__main__":
    unittest.main()
