"""The Python module against predict_scan: the same figures to the last bit, whatever the settings
and wherever the scan comes from."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import mems_stiction
import numpy as np
import yaml

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import (
    CLEANING,
    DEVICE,
    FEW,
    FORMULATIONS,
    PITCH,
    frames,
    program,
    rough,
    without_times,
)  # noqa: E402  (the path comes first)
from tiers import times  # noqa: E402


class BitsTest(unittest.TestCase):
    """A record is equal only if every figure of it is, to the last bit: JSON has the shortest text
    of each number."""

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
        done = subprocess.run(
            [
                program(),
                "--json",
                "--config",
                str(self.folder / "settings.yaml"),
                "--pitch",
                repr(PITCH),
                *arguments,
            ]
            + paths,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=600,
        )
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
                    self.assertTrue(
                        value == record[figure] or (np.isnan(value) and record[figure] is None),
                        figure,
                    )

    def test_every_formulation(self):
        for formulation in FORMULATIONS:
            self.check({"approach": {"formulation": formulation}})

    def test_loads_device_and_cleaning(self):
        for formulation in FORMULATIONS:
            self.check(
                {
                    "approach": {"formulation": formulation},
                    "device": DEVICE,
                    "device_force": FEW,
                    "preprocessing": CLEANING,
                    "load": {"voltage": 5.0, "mechanical_load": 1e-6},
                    "interface": {"insulator_thickness": 1e-7, "relative_humidity": 0.4},
                }
            )

    def test_refined_soft_and_with_an_energy_curve(self):
        self.check(
            {
                "preprocessing": {"refine": {"factor": 2}},
                "lower": {"hardness": 1e9},
                "output": {"energy_curve": True, "asperities": False, "spatial_roughness": True},
            },
            ("rough", "single"),
        )

    def test_counter_surfaces(self):
        upper = rough(64, 64, 6e-9, 9)
        np.save(str(self.folder / "upper.npy"), upper)
        for facing in ("up", "down"):
            of_file = {
                "counter_surface": {
                    "type": "file",
                    "file": str(self.folder / "upper.npy"),
                    "facing": facing,
                },
                "scan": {"pitch_x": PITCH, "pitch_y": PITCH},
            }
            ours = {"counter_surface": {"facing": facing}}
            self.check(of_file, ("rough",), upper, ours)
        self.check({"counter_surface": {"type": "gaussian", "seed": 4}}, ("rough",))

    def test_half_space(self):
        settings = {
            "lower": {"youngs_modulus": 1e9},
            "upper": {"youngs_modulus": 1e9},
            "load": {"mechanical_load": 1e-8},
            "device": DEVICE,
            "device_force": FEW,
        }
        for name, record in self.records(
            settings, "--half-space", names=("smooth", "holes")
        ).items():
            solved = mems_stiction.half_space(frames()[name], PITCH, settings)
            of_record = record["half_space"]
            curve = [
                (
                    point["height"],
                    point["force"],
                    ("APPROACH", "RETRACTION").index(point["direction"]),
                )
                for point in of_record.pop("curve")
            ]
            self.assertEqual([tuple(point) for point in solved.curve.tolist()], curve)
            for figure, value in without_times(of_record).items():
                ours = getattr(solved, figure)
                self.assertTrue(ours == value or (value is None and np.isnan(ours)), (name, figure))
            for figure, ours in vars(solved.verdict).items():
                value = record[figure]
                self.assertTrue(
                    ours == value or (value is None and np.isnan(ours)), (name, figure, ours, value)
                )

    def test_many_frames_on_threads(self):
        settings = {"load": {"mechanical_load": 1e-6}}
        records = self.records(settings)
        for workers in (1, 3):
            predictions = mems_stiction.predict_many(
                list(frames().values()) * 4, PITCH, settings, workers=workers
            )
            for name, prediction in zip(list(frames()) * 4, predictions):
                self.assertEqual(without_times(prediction.to_dict()), without_times(records[name]))

    def test_one_scan_under_many_settings(self):
        heights, upper = rough(64, 48, 12e-9, 2), rough(64, 48, 6e-9, 9)
        configs = [
            {
                "approach": {"formulation": formulation},
                "load": load,
                "interface": {"work_of_adhesion": work},
                "device": DEVICE,
                "device_force": FEW,
            }
            for formulation in FORMULATIONS
            for load in ({}, {"pressure": 1e6})
            for work in (0.02, 0.2)[: times(1, 2)]
        ]
        for shared in (
            {},
            {
                "preprocessing": dict(CLEANING, refine={"factor": 2}),
                "counter_surface": {"facing": "up"},
            },
        ):
            counter = upper if shared else None
            together = list(mems_stiction.predict_under(heights, PITCH, configs, counter, **shared))
            for config, prediction in zip(configs, together):
                alone = mems_stiction.predict(heights, PITCH, config, counter, **shared)
                self.assertEqual(
                    without_times(prediction.to_dict()), without_times(alone.to_dict())
                )
                self.assertTrue(np.array_equal(prediction.contact_map, alone.contact_map))
                self.assertEqual(prediction.asperities.tobytes(), alone.asperities.tobytes())

    def test_settings_of_one_scan_may_not_prepare_it_in_two_ways(self):
        for second in (
            {"preprocessing": {"level": "plane"}},
            {"counter_surface": {"type": "gaussian"}},
            {"output": {"roughness": False}},
        ):
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
            self.assertEqual(
                without_times(mems_stiction.predict(given, pitch).to_dict()), without_times(record)
            )

    def test_settings_of_a_file_a_dictionary_and_keywords_are_one(self):
        (self.folder / "part.yaml").write_text(
            "load: {mechanical_load: 1.0e-6}\nlower/hardness: 2e9\nupper: {hardness: 3e9}\n"
        )
        heights = frames()["rough"]
        given = [
            mems_stiction.predict(heights, PITCH, self.folder / "part.yaml"),
            mems_stiction.predict(
                heights,
                PITCH,
                {
                    "load/mechanical_load": 1e-6,
                    "lower": {"hardness": np.float64(2e9)},
                    "upper": {"hardness": 3000000000},
                },
            ),
            mems_stiction.predict(
                heights,
                PITCH,
                load={"mechanical_load": 1e-6},
                lower={"hardness": "2e9"},
                upper={"hardness": 3e9},
            ),
        ]
        self.assertEqual(len({json.dumps(without_times(one.to_dict())) for one in given}), 1)
        self.assertNotEqual(
            given[0].contact_area, mems_stiction.predict(heights, PITCH).contact_area
        )

    def test_keywords_go_before_dictionary_and_file_and_both_are_checked_together(self):
        (self.folder / "part.yaml").write_text(
            "load: {voltage: 5.0}\nlower: {youngs_modulus: 1.0e13}\n"
        )
        for config in (
            self.folder / "part.yaml",
            {"load": {"voltage": 5.0}, "lower/youngs_modulus": 1e13},
        ):
            settings = mems_stiction.Settings(
                config, interface={"insulator_thickness": 1e-7}, limits={"accept_implausible": True}
            )
            self.assertEqual(yaml.safe_load(settings.yaml())["lower"]["youngs_modulus"], 1e13)
            mended = mems_stiction.Settings(
                config, **{"load/voltage": 0.0, "lower": {"youngs_modulus": 1e11}}
            )
            self.assertEqual(yaml.safe_load(mended.yaml())["lower"]["youngs_modulus"], 1e11)
            with self.assertRaisesRegex(mems_stiction.OptionsError, "insulator_thickness"):
                mems_stiction.Settings(config, **{"limits/accept_implausible": True})
        with self.assertRaises(mems_stiction.OptionsError) as caught:
            mems_stiction.Settings(
                self.folder / "part.yaml", load={"voltage": "much"}, lower={"youngs_modulus": 1e11}
            )
        self.assertIn("load/voltage", str(caught.exception))
        self.assertNotIn("part.yaml", str(caught.exception).splitlines()[0])


if __name__ == "__main__":
    unittest.main()
