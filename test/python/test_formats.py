"""What others read: rows as Parquet, maps as HDF5 and NetCDF-4, recordings as MCAP with ROS 2
messages; read back by the libraries of those."""

import csv
import hashlib
import json
import math
import os
import pathlib
import random
import struct
import subprocess
import tempfile
import unittest

import genpy
import mems_stiction
import numpy as np
import rosbag
import roslib.message
import rospy
from mems_stiction.long_run import write_points
from mems_stiction.msg import (
    DeviceAdhesion,
    SeparationPoint,
    StictionPrediction,
    SweepLoadResult,
    SweepPoint,
)
from mems_stiction.provenance import FIELDS
from mems_stiction.ros2_messages import as_ros2, schema_name, schema_of
from mems_stiction.row_columns import GROUPS
from mems_stiction.row_table import Stamp, units_of
from roslib.packages import find_node
from rospkg import RosPack
from std_msgs.msg import Empty, String

SETTINGS = {
    "load": {"mechanical_load": 1e-6},
    "device": {"spring_stiffness": 2.0, "travel": 1e-6, "contact_area": 1e-11, "contacts": 8},
    "device_force": {"enabled": False},
}
MAPS = {"output": {"deformed_surfaces": True, "contact_map": True}}


def needs(*modules):
    """Skips a test where a library of others is missing."""
    missing = []
    for module in modules:
        try:
            __import__(module)
        except ImportError:
            missing.append(module)
    return unittest.skipIf(missing, "not installed: " + ", ".join(missing))


def run(name, *arguments):
    return subprocess.run(
        [find_node("mems_stiction", name)[0]] + [str(part) for part in arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        universal_newlines=True,
        errors="backslashreplace",
        timeout=120,
    )


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def done(self, name, *arguments):
        result = run(name, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def refused(self, sentence, name, *arguments):
        result = run(name, *arguments)
        self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
        self.assertRegex(result.stderr, "^%s: [^\n]*\n$" % name)
        self.assertIn(sentence, result.stderr)

    def scan_bag(self, name="scans.bag", count=3):
        path = self.folder / name
        self.done("make_scan_bag", "-o", path, "--rows", 48, "--cols", 64, "--count", count)
        return path


@needs("pyarrow.parquet")
class ParquetTest(InFolder):
    def table(self, name):
        import pyarrow.parquet

        return pyarrow.parquet.read_table(str(self.folder / name))

    def unit(self, table, name):
        return (table.schema.field(name).metadata or {}).get(b"unit", b"").decode()

    def rows_of_batch(self, ending):
        (self.folder / "part.yaml").write_text(json.dumps(SETTINGS))
        self.done(
            "stiction_batch",
            "--config",
            self.folder / "part.yaml",
            "-o",
            self.folder / ("rows." + ending),
            self.scan_bag(),
            self.folder / "missing.bag",
        )
        self.done(
            "rows_to_parquet",
            "-o",
            self.folder / (ending + ".parquet"),
            self.folder / ("rows." + ending),
        )
        return self.table(ending + ".parquet")

    def test_rows_of_a_batch_keep_every_bit_type_and_unit(self):
        tables = {ending: self.rows_of_batch(ending) for ending in ("csv", "jsonl")}
        with open(str(self.folder / "rows.csv"), newline="") as stream:
            rows = list(csv.DictReader(stream))
        settings = (self.folder / "rows.csv.settings.yaml").read_text()
        for ending, table in tables.items():
            with self.subTest(ending=ending):
                self.assertEqual(
                    table["pull_off_force"].to_pylist(),
                    [float(row["pull_off_force"]) for row in rows[:-1]] + [None],
                )
                self.assertEqual(
                    table["asperity_count"].to_pylist(),
                    [int(row["asperity_count"]) for row in rows[:-1]] + [None],
                )
                self.assertEqual(
                    table["is_conforming"].to_pylist(),
                    [row["is_conforming"] == "true" for row in rows[:-1]] + [None],
                )
                self.assertIn("no such file", table["message"].to_pylist()[-1])
                self.assertEqual(
                    [
                        Stamp(stamp) if stamp is not None else None
                        for stamp in table["stamp"].cast("int64").to_pylist()
                    ],
                    [Stamp.of(row["stamp"]) for row in rows[:-1]] + [None],
                )
                self.assertEqual(
                    [
                        self.unit(table, name)
                        for name in ("pull_off_force", "pitch_x", "asperity_count")
                    ],
                    ["N", "m", ""],
                )
                metadata = table.schema.metadata
                self.assertEqual(
                    metadata[b"mems_stiction.version"].decode(), mems_stiction.__version__
                )
                self.assertEqual(
                    metadata[b"mems_stiction.settings"].decode().split("configuration:")[1],
                    settings.split("configuration:")[1],
                )
        # Whatever is known in a file, a column has one type in all of them.
        for name in tables["jsonl"].column_names:
            self.assertEqual(
                tables["jsonl"].schema.field(name).type, tables["csv"].schema.field(name).type, name
            )

    def test_the_name_of_a_table_may_be_no_utf_8(self):
        for ending in ("csv", "jsonl"):
            expected = self.rows_of_batch(ending)
            rows = self.folder / ("rows." + ending)
            for path in (rows, rows.with_name(rows.name + ".settings.yaml")):
                path.rename(str(path).replace("rows.", "rows\udcff."))
            self.done(
                "rows_to_parquet",
                "-o",
                self.folder / "odd\udcff.parquet",
                self.folder / ("rows\udcff." + ending),
            )
            (self.folder / "odd\udcff.parquet").rename(self.folder / "even.parquet")
            even = self.table("even.parquet")  # as text, in which NaN equals itself
            self.assertEqual(str(even.to_pydict()), str(expected.to_pydict()))

    def test_a_text_that_looks_like_a_number_or_a_formula_stays_what_it_is(self):
        (self.folder / "rows.csv").write_text(
            "number,part_id,serial_id,reason,height\n1,0012,12e4,'=no,nan\n2,0013,,,\n"
        )
        (self.folder / "rows.csv.settings.yaml").write_text(
            "version: 0.1.0\nunits: {height: m}\nconfiguration:\n  scan: {}\n"
        )
        self.done("rows_to_parquet", "-o", self.folder / "a.parquet", self.folder / "rows.csv")
        table = self.table("a.parquet")
        self.assertEqual(table["part_id"].to_pylist(), ["0012", "0013"])
        self.assertEqual(table["serial_id"].to_pylist(), ["12e4", None])
        self.assertEqual(table["reason"].to_pylist(), ["=no", None])
        height = table["height"].to_pylist()
        self.assertTrue(math.isnan(height[0]) and height[1] is None)

    def test_what_holds_no_rows_is_refused_in_one_sentence(self):
        for name, text in (
            ("torn.jsonl", '{"number":1,"fi'),
            ("ragged.csv", "a,b\n1,2,3\n"),
            ("empty.csv", ""),
            ("empty.jsonl", ""),
            ("number.jsonl", "5\n"),
            ("deep.jsonl", "[" * 200000 + "\n"),
            ("deep_below.jsonl", '{"number":1}\n' + '{"a":' * 200000 + "1" + "}" * 200000 + "\n"),
            ("dates.csv", "stamp\n2026-01-01\n"),
        ):
            (self.folder / name).write_text(text)
            self.refused(
                "%s: holds no rows" % name,
                "rows_to_parquet",
                "-o",
                self.folder / "a.parquet",
                self.folder / name,
            )
        (self.folder / "bytes.csv").write_bytes(bytes(range(256)))
        self.refused(
            "bytes.csv: holds no rows",
            "rows_to_parquet",
            "-o",
            self.folder / "a.parquet",
            self.folder / "bytes.csv",
        )
        (self.folder / "rows.csv").write_text("a\n1\n")
        self.refused(
            "must end in .parquet",
            "rows_to_parquet",
            "-o",
            self.folder / "a.csv",
            self.folder / "rows.csv",
        )
        self.refused(
            "must end in .csv",
            "rows_to_parquet",
            "-o",
            self.folder / "a.parquet",
            self.folder / "rows.txt",
        )
        self.refused(
            "No such file",
            "rows_to_parquet",
            "-o",
            self.folder / "a.parquet",
            self.folder / "none.csv",
        )
        (self.folder / "rows.csv.settings.yaml").write_text("[]")
        self.refused(
            "has no units",
            "rows_to_parquet",
            "-o",
            self.folder / "a.parquet",
            self.folder / "rows.csv",
        )
        self.assertFalse((self.folder / "a.parquet").exists())

    def test_exported_predictions_are_those_of_the_csv(self):
        bag = self.folder / "day.bag"
        with rosbag.Bag(str(bag), "w") as recording:
            for number in range(3):
                prediction = StictionPrediction(
                    pull_off_force=1e-7 / (number + 3),
                    flags=["border", "one_pixel"],
                    is_conforming=number == 1,
                    version="0.1.0",
                )
                prediction.header.stamp = rospy.Time(1700000000 + number, 123456789)
                prediction.roughness.sq = 3e-9
                recording.write("/prediction", prediction, rospy.Time(1700000100 + number, 1))
            recording.write("/device_force", DeviceAdhesion(pull_off_force=3e-7), rospy.Time(1))
        for name in ("day.csv", "day.parquet"):
            self.done("export_predictions", "-o", self.folder / name, bag)
        with open(str(self.folder / "day.csv"), newline="") as stream:
            rows = list(csv.DictReader(stream))
        table = self.table("day.parquet")
        self.assertEqual(table.column_names, list(rows[0]))
        self.assertEqual(
            table["pull_off_force"].to_pylist(), [float(row["pull_off_force"]) for row in rows]
        )
        self.assertEqual(
            table["stamp"].cast("int64").to_pylist(),
            [1700000000123456789 + number * 10**9 for number in range(3)],
        )
        self.assertEqual(rows[0]["stamp"], "1700000000.123456789")
        self.assertEqual(table["is_conforming"].to_pylist(), [False, True, False])
        self.assertEqual(table["flags"].to_pylist(), ["border; one_pixel"] * 3)
        self.assertEqual(
            [
                self.unit(table, name)
                for name in ("pull_off_force", "roughness/sq", "contact_fraction")
            ],
            ["N", "m", "-"],
        )
        self.assertEqual(table.schema.metadata[b"mems_stiction.version"], b"0.1.0")
        self.done("export_predictions", "--device-force", "-o", self.folder / "device.parquet", bag)
        self.assertEqual(self.table("device.parquet")["pull_off_force"].to_pylist(), [3e-7])

    def prediction_bag(self, count=2):
        """Of a formulation that has no JKR force and no energy."""
        bag = self.folder / "chosen.bag"
        with rosbag.Bag(str(bag), "w") as recording:
            for number in range(count):
                prediction = StictionPrediction(
                    pull_off_force=1.5e-7 * (number + 1),
                    pull_off_force_jkr=math.nan,
                    surface_energy=math.nan,
                    margin=2.5,
                    reason="above 1",
                    version="0.1.0",
                )
                prediction.header.stamp = rospy.Time(1700000000 + number, 5 * 10**8)
                recording.write("/prediction", prediction, rospy.Time(1700000100 + number))
        return bag

    def exported(self, *arguments, delimiter=","):
        self.done("export_predictions", "-o", self.folder / "chosen.csv", *arguments)
        with open(str(self.folder / "chosen.csv"), newline="", encoding="utf-8-sig") as stream:
            return list(csv.DictReader(stream, delimiter=delimiter))

    def test_columns_without_a_value_are_left_out_and_others_are_chosen_by_group(self):
        bag = self.prediction_bag()
        names = list(self.exported(bag)[0])
        for name in ("pull_off_force", "margin", "rms_height"):
            self.assertIn(name, names)
        for name in ("pull_off_force_jkr", "surface_energy", "scan_name"):
            self.assertNotIn(name, names)
        every = list(self.exported("--columns", "all", bag)[0])
        self.assertIn("surface_energy", every)
        self.assertGreater(len(every), len(names))
        rows = self.exported("--columns", "stamp,verdict,pull_off_force", bag)
        self.assertEqual(list(rows[0])[0], "stamp")
        self.assertEqual(list(rows[0])[-1], "pull_off_force")
        self.assertIn("margin", rows[0])
        self.assertNotIn("contact_area", rows[0])
        # each column belongs to one group
        by_groups = self.exported("--columns", ",".join(name for name, _ in GROUPS), bag)
        self.assertEqual(sorted(by_groups[0]), sorted(names))
        for wanted, told in (("vredict", "did you mean verdict?)"), ("", "groups are origin")):
            self.refused(
                told, "export_predictions", "-o", self.folder / "a.csv", "--columns=" + wanted, bag
            )

    def test_rows_of_a_batch_are_a_table_of_chosen_columns_too(self):
        for ending in ("csv", "jsonl"):
            self.rows_of_batch(ending)
        with open(str(self.folder / "rows.csv"), newline="") as stream:
            of_batch = list(csv.DictReader(stream))
        table = self.exported(self.folder / "rows.csv")
        of_lines = self.exported(self.folder / "rows.jsonl")
        self.assertEqual(  # the bag is written anew for each
            [dict(row, file_time="") for row in table],
            [dict(row, file_time="") for row in of_lines],
        )
        names = list(table[0])
        self.assertEqual(names, [name for name in of_batch[0] if name in names])
        self.assertNotIn("contact_area_jkr", names)  # of the separation curve
        self.assertEqual(
            [float(row["pull_off_force"]) for row in table[:-1]],
            [float(row["pull_off_force"]) for row in of_batch[:-1]],
        )
        self.assertEqual([row["stamp"] for row in table], [row["stamp"] for row in of_batch])
        chosen = self.exported(
            "--excel", "--columns=file,forces", self.folder / "rows.csv", delimiter=";"
        )
        self.assertEqual((list(chosen[0])[0], "sq" in chosen[0]), ("file", False))
        self.assertEqual(chosen[0]["pull_off_force"], table[0]["pull_off_force"].replace(".", ","))
        both = self.exported(self.prediction_bag(), self.folder / "rows.csv")
        self.assertEqual(len(both), 2 + len(table))
        for name, text, told in (
            ("torn.jsonl", '{"number":1,"fi', "holds no rows"),
            ("deep.jsonl", '{"a":' * 200000 + "1" + "}" * 200000, "holds no rows: too many levels"),
            ("other.csv", "a,b\n1,2\n", "holds no rows of stiction_batch"),
            ("none.csv", None, "No such file"),
        ):
            if text is not None:
                (self.folder / name).write_text(text)
            self.refused(
                told, "export_predictions", "-o", self.folder / "a.csv", self.folder / name
            )

    def test_a_table_for_a_spreadsheet_has_semicolons_and_decimal_commas(self):
        bag = self.prediction_bag()
        rows = self.exported("--excel", bag, delimiter=";")
        self.assertEqual(
            [(row["pull_off_force"], row["stamp"], row["margin"], row["reason"]) for row in rows],
            [
                ("1,5e-07", "1700000000,500000000", "2,5", "above 1"),
                ("3e-07", "1700000001,500000000", "2,5", "above 1"),
            ],
        )
        self.assertEqual((self.folder / "chosen.csv").read_bytes()[:3], b"\xef\xbb\xbf")
        self.refused(
            "is no CSV", "export_predictions", "--excel", "-o", self.folder / "a.parquet", bag
        )

    def test_rows_go_to_the_next_program(self):
        bag = self.prediction_bag()
        self.done("export_predictions", "-o", self.folder / "chosen.csv", bag)
        expected = (self.folder / "chosen.csv").read_text()
        for name in ("/dev/stdout", "-", "/dev/fd/1"):
            done = self.done("export_predictions", "-o", name, bag)
            self.assertEqual(done.stdout, expected, name)
            self.assertIn("2 predictions", done.stderr)
        # a file that others write to as well keeps what stands there
        with open(str(self.folder / "both.csv"), "w") as stream:
            stream.write("before\n")
            stream.flush()
            command = [
                find_node("mems_stiction", "export_predictions")[0],
                "-o",
                "/dev/stdout",
                bag,
            ]
            subprocess.run(command, stdout=stream, stderr=subprocess.PIPE, check=True)
        self.assertEqual((self.folder / "both.csv").read_text(), "before\n" + expected)

    def test_units_of_messages_are_those_that_the_core_declares(self):
        declared = {
            name: unit or "-"
            for name, (kind, unit, _) in mems_stiction._core.figures["PredictionFigures"].items()
            if kind == "float"
        }
        stated = units_of(StictionPrediction)
        common = set(declared) & set(stated)
        self.assertGreater(len(common), 30)
        self.assertEqual(
            {name: stated[name] for name in common}, {name: declared[name] for name in common}
        )

    def test_points_of_a_sweep_have_their_units_and_origin(self):
        result = SweepLoadResult(
            version="0.1.0",
            settings_hash="abc",
            scan_name="die",
            serial_id="7",
            site_x=math.nan,
            site_y=math.nan,
        )
        points = [
            SweepPoint(voltage=5.0, pull_off_force=1e-7, is_open=False),
            SweepPoint(voltage=10.0, pull_off_force=math.nan, is_open=True),
        ]
        for ending in ("csv", "parquet"):
            write_points(points, str(self.folder / ("sweep." + ending)), result)
        table = self.table("sweep.parquet")
        with open(str(self.folder / "sweep.csv"), newline="") as stream:
            self.assertEqual([row["is_open"] for row in csv.DictReader(stream)], ["0", "1"])
        self.assertEqual(table["voltage"].to_pylist(), [5.0, 10.0])
        self.assertEqual(table["is_open"].to_pylist(), [False, True])
        self.assertEqual(
            (self.unit(table, "voltage"), self.unit(table, "pull_off_force")), ("V", "N")
        )
        self.assertEqual(table["serial_id"].to_pylist(), ["7", "7"])
        self.assertEqual(table["site_x"].to_pylist(), [None, None])  # not stated
        self.assertEqual(
            (str(table.schema.field("site_x").type), self.unit(table, "site_x")), ("double", "m")
        )
        self.assertEqual(table.schema.metadata[b"mems_stiction.settings_hash"], b"abc")

    def test_a_design_keeps_the_units_of_its_axes(self):
        waves = np.sin(np.arange(64) / 5.0)  # which its pixels show
        heights = np.outer(waves, np.cos(np.arange(64) / 7.0)) * 2e-9
        found = mems_stiction.design_sweep(
            [heights],
            axes={"device/spring_stiffness": [1.0, 2.0]},
            pitch=1e-8,
            workers=1,
            device={"travel": 1e-6, "contact_area": 1e-11},
            device_force={"realisations": 3, "max_cells": 1e4},
        )
        found.save_rows(self.folder / "design.parquet")
        table = self.table("design.parquet")
        self.assertEqual(table["device/spring_stiffness"].to_pylist(), [1.0, 2.0])
        self.assertEqual(table["margin"].to_pylist(), list(found.margin))
        self.assertEqual(
            [
                self.unit(table, name)
                for name in ("device/spring_stiffness", "pull_off_force", "margin")
            ],
            ["N/m", "N", ""],
        )


@needs("h5py")
class MapFileTest(InFolder):
    def setUp(self):
        super().setUp()
        self.heights = np.random.RandomState(2).normal(size=(24, 40)) * 3e-9
        self.heights[3, 5] = np.nan
        self.prediction = mems_stiction.predict(self.heights, (1e-8, 2e-8), SETTINGS, **MAPS)

    def test_h5py_reads_maps_curves_and_their_units(self):
        import h5py

        self.prediction.save_maps(self.folder / "maps.h5")
        with h5py.File(str(self.folder / "maps.h5"), "r") as file:
            np.testing.assert_array_equal(file["heights"][()], self.prediction.heights)
            np.testing.assert_array_equal(file["contact_map"][()], self.prediction.contact_map)
            np.testing.assert_array_equal(
                file["deformed_lower"][()], self.prediction.deformed_lower
            )
            self.assertEqual((file["heights"].attrs["units"], file["x"].attrs["units"]), ("m", "m"))
            self.assertAlmostEqual(file["x"][1], 1e-8)
            self.assertAlmostEqual(file["y"][1], 2e-8)
            np.testing.assert_array_equal(file["curve/force"][()], self.prediction.curve.force)
            np.testing.assert_array_equal(
                file["curve/is_separation"][()], self.prediction.curve.is_separation
            )
            self.assertEqual(file["curve/force"].attrs["units"], "N")
            np.testing.assert_array_equal(
                file["contacts/load"][()], self.prediction.asperities.load
            )
            self.assertEqual(json.loads(file["record"][()].decode()), self.prediction.to_dict())
            self.assertEqual(
                (file.attrs["version"], file.attrs["settings_hash"]),
                (self.prediction.version, self.prediction.settings_hash),
            )

    def test_axes_that_fall_and_marks_of_what_is_missing_are_read_as_they_are_meant(self):
        import h5py

        heights = np.array([[1.0, 2.0, 3.0, 4.0], [5.0, -999.0, 7.0, 8.5]])
        for y in ([0.0, 2.0], [2.0, 0.0]):
            with h5py.File(str(self.folder / "map.nc"), "w") as file:
                for name, values in (("y", y), ("x", [0.0, 1.0, 2.0, 3.0])):
                    file[name] = np.array(values)
                    file[name].attrs["units"] = "um"
                    file[name].make_scale(name)
                file["z"] = heights
                file["z"].attrs.update(units="nm", _FillValue=-999.0)
                file["gone"] = h5py.SoftLink("/nowhere")
                for place, name in enumerate(("y", "x")):
                    file["z"].dims[place].attach_scale(file[name])
            scan = mems_stiction.read(self.folder / "map.nc")
            expected = np.where(heights == -999.0, np.nan, 1e-9 * heights)
            np.testing.assert_allclose(
                scan.heights, expected if y[0] == 0.0 else expected[::-1], rtol=1e-12
            )
            np.testing.assert_allclose(scan.pitch, (1e-6, 2e-6), rtol=1e-12)

    def test_packed_numbers_and_maps_with_x_first_are_read_as_they_are_meant(self):
        import h5py

        counts = np.array([[1, 2, 3, 4], [5, -999, 7, 8]], dtype=np.int16)
        heights = np.where(counts == -999, np.nan, 1e-9 * (0.5 * counts + 10.0))
        for order in (("y", "x"), ("x", "y")):
            with h5py.File(str(self.folder / "map.nc"), "w") as file:
                for name, values in (("y", [0.0, 2.0]), ("x", [0.0, 1.0, 2.0, 3.0])):
                    file[name] = np.array(values)
                    file[name].attrs["units"] = "um"
                    file[name].make_scale(name)
                file["z"] = counts if order[0] == "y" else counts.T
                file["z"].attrs.update(
                    units="nm", _FillValue=np.int16(-999), scale_factor=0.5, add_offset=10.0
                )
                for place, name in enumerate(order):
                    file["z"].dims[place].attach_scale(file[name])
            scan = mems_stiction.read(self.folder / "map.nc")
            np.testing.assert_allclose(scan.heights, heights, rtol=1e-12)
            np.testing.assert_allclose(scan.pitch, (1e-6, 2e-6), rtol=1e-12)

    @needs("xarray")
    def test_a_data_array_brings_coordinates_and_units(self):
        import xarray

        heights = 1e9 * self.heights  # [nm]
        coordinates = {
            "y": ("y", np.arange(24) * 0.02, {"units": "um"}),
            "x": ("x", np.arange(40) * 0.01, {"units": "um"}),
        }
        given = xarray.DataArray(heights, coordinates, ("y", "x"), attrs={"units": "nm"})
        wanted = self.prediction.pull_off_force
        for array in (given, given.T):
            found = mems_stiction.predict(array, None, SETTINGS, **MAPS)
            self.assertAlmostEqual(found.pull_off_force / wanted, 1.0, places=9)
            self.assertEqual(found.contact_map.shape, array.shape)
        plain = xarray.DataArray(self.heights, dims=("y", "x"))
        self.assertEqual(
            mems_stiction.predict(plain, (1e-8, 2e-8), SETTINGS, **MAPS).pull_off_force, wanted
        )
        with_volts = xarray.DataArray(heights, coordinates, ("y", "x"), attrs={"units": "V"})
        packed = xarray.DataArray(heights, coordinates, ("y", "x"), attrs={"scale_factor": 2.0})
        seconds = dict(coordinates, x=("x", np.arange(40.0), {"units": "s"}))
        uneven = dict(coordinates, x=("x", np.arange(40.0) ** 2, {"units": "um"}))
        for wrong, pitch, words in (
            (given, 1e-8, "brings its own"),
            (given.rename(x="time"), None, "must be y and x"),
            (plain, None, "pitch: an array says nothing of it"),
            (with_volts, None, "the unit 'V'"),
            (packed, None, "scale_factor"),
            (xarray.DataArray(heights, seconds, ("y", "x")), None, "the unit 's'"),
            (xarray.DataArray(heights, uneven, ("y", "x")), None, "x: .* even"),
        ):
            with self.assertRaisesRegex(mems_stiction.SurfaceError, words):
                mems_stiction.predict(wrong, pitch, SETTINGS)

    @needs("xarray", "h5netcdf")
    def test_what_save_maps_wrote_comes_back_through_xarray(self):
        import xarray

        self.prediction.save_maps(self.folder / "maps.nc")
        with xarray.open_dataset(str(self.folder / "maps.nc"), engine="h5netcdf") as data:
            found = mems_stiction.predict(data["heights"], None, SETTINGS)
        self.assertAlmostEqual(found.pull_off_force / self.prediction.pull_off_force, 1.0, places=9)

    @needs("xarray", "h5netcdf")
    def test_xarray_reads_it_as_netcdf(self):
        import xarray

        self.prediction.save_maps(self.folder / "maps.nc")
        with xarray.open_dataset(str(self.folder / "maps.nc"), engine="h5netcdf") as data:
            self.assertEqual(data["heights"].dims, ("y", "x"))
            self.assertEqual(data["deformed_lower"].attrs["units"], "m")
            np.testing.assert_array_equal(data["heights"].values, self.prediction.heights)
            np.testing.assert_allclose(data["y"].values, np.arange(24) * 2e-8)
        with xarray.open_dataset(
            str(self.folder / "maps.nc"), engine="h5netcdf", group="curve"
        ) as curve:
            np.testing.assert_array_equal(
                curve["displacement"].values, self.prediction.curve.displacement
            )

    def test_our_own_reader_takes_the_heights_from_it(self):
        self.prediction.save_maps(self.folder / "maps.nc")
        scan = mems_stiction.read(self.folder / "maps.nc", channel="heights")
        self.assertEqual(scan.heights.shape, (24, 40))
        np.testing.assert_allclose(scan.heights, self.prediction.heights)
        np.testing.assert_allclose(scan.pitch, (1e-8, 2e-8))

    def test_x_first_stays_x_first(self):
        import h5py

        class Topography:
            physical_sizes, unit = (24e-8, 80e-8), "m"

            def heights(_):
                return self.heights

        mems_stiction.predict(Topography(), None, SETTINGS, **MAPS).save_maps(
            self.folder / "maps.h5"
        )
        with h5py.File(str(self.folder / "maps.h5"), "r") as file:
            self.assertEqual([file["heights"].dims[axis][0].name for axis in (0, 1)], ["/x", "/y"])
            self.assertAlmostEqual(file["y"][1], 2e-8)

    def test_a_half_space_has_gap_and_pressure(self):
        import h5py

        solved = mems_stiction.half_space(
            np.random.RandomState(3).normal(size=(32, 32)) * 1e-9, 1e-8, SETTINGS
        )
        solved.save_maps(self.folder / "rest.hdf5")
        with h5py.File(str(self.folder / "rest.hdf5"), "r") as file:
            np.testing.assert_array_equal(file["gap"][()], solved.gap)
            self.assertEqual(
                (file["pressure"].attrs["units"], file["curve/height"].attrs["units"]), ("Pa", "m")
            )
            np.testing.assert_array_equal(file["curve/direction"][()], solved.curve.direction)
            self.assertEqual(
                json.loads(file["record"][()].decode())["pull_off_force"], solved.pull_off_force
            )
            self.assertEqual(file.attrs["status"], solved.status)

    def test_maps_of_a_half_space_say_what_was_scanned_as_those_of_a_prediction_do(self):
        import h5py

        path = self.folder / "scan.csv"
        np.savetxt(str(path), np.random.RandomState(3).normal(size=(32, 32)) * 1e-9, delimiter=",")
        (self.folder / "scan.csv.yaml").write_text(
            "part_id: lever\nlot_id: lot 3\nwafer_id: '7'\nsite_x: 1.0e-2\nsite_y: 0.0\n"
        )
        origins = []
        for run in (mems_stiction.half_space, mems_stiction.predict):
            run(path, 1e-8, SETTINGS).save_maps(self.folder / "maps.h5")
            with h5py.File(str(self.folder / "maps.h5"), "r") as file:
                origins.append(
                    {
                        name: file.attrs[name]
                        for name in FIELDS
                        if name in file.attrs and name != "scan_name"
                    }
                )
        self.assertEqual(origins[0], origins[1])
        self.assertEqual(
            (origins[0]["lot_id"], origins[0]["wafer_id"], origins[0]["site_x"]),
            ("lot 3", "7", 1e-2),
        )
        self.assertEqual(
            origins[0]["checksum"], "sha256:" + hashlib.sha256(path.read_bytes()).hexdigest()
        )

    def test_what_cannot_be_written_is_an_error_and_no_file(self):
        with self.assertRaisesRegex(mems_stiction.Error, r"must end in \.h5"):
            self.prediction.save_maps(self.folder / "maps.png")
        with self.assertRaisesRegex(OSError, "nowhere"):
            self.prediction.save_maps(self.folder / "nowhere" / "maps.h5")
        self.assertEqual(os.listdir(str(self.folder)), [])


def messages_of_package():
    folder = pathlib.Path(RosPack().get_path("mems_stiction"))
    names = ["mems_stiction/" + path.stem for path in sorted((folder / "msg").glob("*.msg"))]
    for path in sorted((folder / "action").glob("*.action")):
        names += [
            "mems_stiction/%s%s" % (path.stem, part)
            for part in ("ActionGoal", "ActionFeedback", "ActionResult")
        ]
    return names


def filled(datatype, source):
    """A message with something in every field."""
    message = roslib.message.get_message_class(datatype)()
    for name, kind in zip(message.__slots__, message._slot_types):
        setattr(message, name, filled_field(kind, source))
    return message


def filled_field(kind, source):
    base, is_array, size = parsed(kind)
    if is_array:
        count = size or source.randrange(3)
        if base in ("uint8", "char"):
            return bytes(source.randrange(256) for _ in range(count))
        return [filled_field(base, source) for _ in range(count)]
    if base in ("time", "duration"):
        return (genpy.Time if base == "time" else genpy.Duration)(
            source.randrange(2**31), source.randrange(10**9)
        )
    if base == "string":
        return source.choice(["", "a", 'µm = "nm"', "two\nlines"])
    if base == "bool":
        return source.random() < 0.5
    if base.startswith("float"):
        value = source.choice([0.0, -1.5e-7, math.inf, source.random()])
        return value if base == "float64" else struct.unpack("f", struct.pack("f", value))[0]
    sizes = {"byte": ("int", 8), "char": ("uint", 8)}
    sign, bits = (
        sizes.get(base) or (base.rstrip("0123456789"), int("".join(filter(str.isdigit, base)) or 0))
        if "/" not in base
        else ("", 0)
    )
    if bits:
        return (
            source.randrange(2**bits)
            if sign == "uint"
            else source.randrange(-(2 ** (bits - 1)), 2 ** (bits - 1))
        )
    return filled("std_msgs/Header" if base == "Header" else base, source)


def parsed(kind):
    base, bracket, rest = kind.partition("[")
    return base, bool(bracket), int(rest[:-1] or 0) if bracket else 0


@needs("mcap_ros2.reader")
class McapTest(InFolder):
    def read(self, name):
        from mcap_ros2.reader import read_ros2_messages

        return list(read_ros2_messages(str(self.folder / name)))

    def assert_same(self, found, message, place):
        """A decoded message of ROS 2 against the one of ROS 1 that it was."""
        for name, kind in zip(message.__slots__, message._slot_types):
            if (message._type, name) == ("std_msgs/Header", "seq"):
                self.assertFalse(hasattr(found, "seq"))
                continue
            self.assert_same_value(
                getattr(found, name.lower()), getattr(message, name), "%s/%s" % (place, name)
            )

    def assert_same_value(self, found, value, place):
        if isinstance(value, genpy.TVal):
            self.assertEqual((found.sec, found.nanosec), (value.secs, value.nsecs), place)
        elif isinstance(value, genpy.Message):
            self.assert_same(found, value, place)
        elif isinstance(value, (list, tuple, bytes)):
            self.assertEqual(len(found), len(value), place)
            for one, other in zip(found, value):
                self.assert_same_value(one, other, place)
        else:
            self.assertTrue(
                found == value or found != found and value != value,
                "%s: %r, %r" % (place, found, value),
            )

    def test_every_message_of_the_package_reads_back(self):
        source = random.Random(5)
        names = messages_of_package() + [
            "sensor_msgs/Image",
            "sensor_msgs/CameraInfo",
            "diagnostic_msgs/DiagnosticArray",
            "tf2_msgs/TFMessage",
            "std_msgs/Empty",
            "std_msgs/Byte",
            "std_msgs/Char",
            "std_msgs/Duration",
        ]
        written = []
        with rosbag.Bag(str(self.folder / "all.bag"), "w") as bag:
            for number, name in enumerate(names * 3):
                message = filled(name, source)
                written.append(("/" + name, message, rospy.Time(number + 1, 7)))
                bag.write(*written[-1])
        self.assertGreater(len(names), 24)
        done = self.done("bag_to_mcap", "-o", self.folder / "all.mcap", self.folder / "all.bag")
        self.assertIn("%d messages of 1 bag" % len(written), done.stdout)
        self.assertEqual(done.stderr, "")
        read = self.read("all.mcap")
        self.assertEqual(len(read), len(written))
        for found, (topic, message, time) in zip(read, written):
            self.assertEqual(
                (found.channel.topic, found.schema.name), (topic, schema_name(message._type))
            )
            self.assertEqual(
                (found.channel.message_encoding, found.schema.encoding), ("cdr", "ros2msg")
            )
            self.assertEqual(found.log_time_ns, time.to_nsec())
            self.assert_same(found.ros_msg, message, message._type)

    def test_scans_of_make_scan_bag_read_back_to_the_bit(self):
        bag = self.scan_bag()
        self.done("bag_to_mcap", "-o", self.folder / "scans.mcap", bag)
        with rosbag.Bag(str(bag)) as recording:
            written = list(recording.read_messages())
        read = self.read("scans.mcap")
        self.assertEqual(len(read), 6)
        for found, (topic, message, time) in zip(read, written):
            self.assertEqual((found.channel.topic, found.log_time_ns), (topic, time.to_nsec()))
            self.assert_same(found.ros_msg, message, topic)

    def test_bytes_are_those_of_cdr(self):
        """By hand: encapsulation, then members at multiples of their size, counted behind it."""
        from mcap.reader import make_reader

        with rosbag.Bag(str(self.folder / "one.bag"), "w") as bag:
            bag.write("/point", SeparationPoint(), rospy.Time(1))
            bag.write("/text", String("ab"), rospy.Time(2))
            bag.write("/empty", Empty(), rospy.Time(3))
            prediction = StictionPrediction(status=1, steps=7, voltage=2.5)
            prediction.header.stamp, prediction.header.frame_id, prediction.header.seq = (
                rospy.Time(5, 6),
                "die",
                99,
            )
            bag.write("/prediction", prediction, rospy.Time(4))
        self.done("bag_to_mcap", "-o", self.folder / "one.mcap", self.folder / "one.bag")
        with open(str(self.folder / "one.mcap"), "rb") as stream:
            reader = make_reader(stream)
            self.assertEqual(reader.get_header().profile, "ros2")
            found = {channel.topic: message.data for _, channel, message in reader.iter_messages()}
        start = b"\0\1\0\0"
        self.assertEqual(found["/text"], start + struct.pack("<I", 3) + b"ab\0")
        self.assertEqual(found["/empty"], start + b"\0")
        # stamp, frame_id with its end, status at once, steps at the next multiple of 4, voltage of
        # 8
        expected = struct.pack("<iII4sB3xI", 5, 6, 4, b"die\0", 1, 7) + struct.pack("<d", 2.5)
        self.assertEqual(found["/prediction"][: 4 + len(expected)], start + expected)

    def test_schemas_keep_constants_and_comments(self):
        text = schema_of(
            'Header header  # of it [-]\nstring WORD=a # b "c"\nuint8 UP = 1 # up\nfloat64[9] K # '
            "[m]\ntime[] when\nchar letter\nbyte small\n"
            + "=" * 80
            + "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
        )
        self.assertEqual(
            text.split("\n" + "=" * 80 + "\n"),
            [
                'std_msgs/Header header  # of it [-]\nstring WORD="a # b \\"c\\""\nuint8 UP = 1 # '
                "up\nfloat64[9] k  # [m]\nbuiltin_interfaces/Time[] when\n"
                "uint8 letter\nint8 small",
                "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id",
                "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n",
            ],
        )
        self.assertEqual(as_ros2(String("a")), {"data": "a"})

    def test_a_type_that_ros_2_cannot_have_is_left_out_and_named(self):
        bad = type("Odd", (String,), {"_type": "odd_msgs/Odd_Name"})
        with rosbag.Bag(str(self.folder / "odd.bag"), "w") as bag:
            bag.write("/odd", bad("x"), rospy.Time(1))
            bag.write("/odd", bad("x"), rospy.Time(2))
            bag.write("/good", String("y"), rospy.Time(3))
        done = self.done("bag_to_mcap", "-o", self.folder / "odd.mcap", self.folder / "odd.bag")
        self.assertRegex(
            done.stderr,
            r"^bag_to_mcap: /odd: left out, ROS 2 has no type such as odd_msgs/Odd_Name: [^\n]*\n$",
        )
        self.assertEqual([found.ros_msg.data for found in self.read("odd.mcap")], ["y"])

    def test_slips_are_one_sentence_and_leave_no_file(self):
        bag = self.scan_bag(count=1)
        self.refused("must end in .mcap", "bag_to_mcap", "-o", self.folder / "a.bag", bag)
        self.refused(
            "no message on /hight",
            "bag_to_mcap",
            "-o",
            self.folder / "a.mcap",
            "--topic",
            "/hight",
            bag,
        )
        (self.folder / "text.bag").write_text("no bag")
        self.refused(
            "is not a bag", "bag_to_mcap", "-o", self.folder / "a.mcap", self.folder / "text.bag"
        )
        self.refused(
            "no such file", "bag_to_mcap", "-o", self.folder / "a.mcap", self.folder / "none.bag"
        )
        torn = self.folder / "torn.bag"
        torn.write_bytes(bag.read_bytes()[:5000])
        self.refused("cannot be read", "bag_to_mcap", "-o", self.folder / "a.mcap", torn)
        self.refused("cannot be written", "bag_to_mcap", "-o", self.folder / "no" / "a.mcap", bag)
        os.symlink("/dev/full", str(self.folder / "full.mcap"))
        self.refused(
            "cannot be written: No space left on device",
            "bag_to_mcap",
            "-o",
            self.folder / "full.mcap",
            bag,
        )
        self.assertEqual([path.name for path in self.folder.glob("*a.mcap*")], [])
        self.done("bag_to_mcap", "-o", self.folder / "a.mcap", "--topic", "height", bag)
        self.assertEqual([found.channel.topic for found in self.read("a.mcap")], ["/height"])


if __name__ == "__main__":
    unittest.main()
