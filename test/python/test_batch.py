"""stiction_batch and what drives it: one row per scan, whatever happens in between."""

import csv
import hashlib
import itertools
import json
import os
import pathlib
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import genpy.dynamic
import numpy as np
import rosbag
import rospy
from mems_stiction import report
from mems_stiction.msg import DeviceAdhesion, ScanInfo, StictionPrediction
from roslib.packages import find_node
from sensor_msgs.msg import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import rough  # noqa: E402  (the path comes first)
from tiers import times  # noqa: E402

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
CONFIG = """
load: {mechanical_load: 1.0e-6}
device: {spring_stiffness: 2.0, travel: 1.0e-6, contact_area: 1.0e-11, contacts: 8}
device_force: {enabled: false}
"""
OWN_FORCE = CONFIG.replace("{enabled: false}", "{realisations: 3, max_cells: 1.0e+4}").replace(
    "contacts: 8", "contacts: 1"
)


def program(name):
    return find_node("mems_stiction", name)[0]


def run(command, **settings):
    return subprocess.run(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        universal_newlines=True,
        timeout=120,
        **settings,
    )


def first_fields(kind, count):
    """The message when it had so many fields, as a bag of then has it."""
    fields = "".join(
        "%s %s\n" % field for field in list(zip(kind._slot_types, kind.__slots__))[:count]
    )
    between = "=" * 80 + "\n"
    text = between.join([fields] + kind._full_text.split(between)[1:])
    return genpy.dynamic.generate_dynamic(kind._type, text)[kind._type]


class BatchTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.inputs = pathlib.Path(cls._folder.name)
        cls.batch = program("stiction_batch")
        cls.make_bag(cls.inputs / "a.bag", "--count", 5, "--rms-height", "1e-9", "8e-9")
        cls.make_bag(cls.inputs / "b.bag", "--count", 3, "--seed", 40, "--rms-height", "4e-9")
        (cls.inputs / "broken.tiff").write_text("no picture")
        (cls.inputs / "grid.txt").write_text("0 1e-9\n0 0\n")
        (cls.inputs / "device.yaml").write_text(CONFIG)
        cls.everything = [
            cls.inputs / name
            for name in ("a.bag", "broken.tiff", "b.bag", "grid.txt", "missing.bag")
        ]

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    @classmethod
    def make_bag(cls, path, *arguments):
        done = run(
            [program("make_scan_bag"), "-o", path, "--rows", 96, "--cols", 128] + list(arguments)
        )
        assert done.returncode == 0, done.stderr

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def predict(self, rows, *arguments, **changes):
        config = [] if "--config" in arguments else ["--config", self.inputs / "device.yaml"]
        done = run(
            [self.batch, "-o", self.folder / rows]
            + config
            + list(arguments)
            + list(changes.get("inputs", self.everything))
        )
        self.assertEqual(done.returncode, changes.get("status", 0), done.stderr)
        return done

    def rows(self, name):
        with open(str(self.folder / name), newline="") as stream:
            return list(csv.DictReader(stream))

    def test_one_row_per_scan_and_a_failed_scan_is_a_row_with_its_reason(self):
        self.predict("rows.csv")
        rows = self.rows("rows.csv")
        self.assertEqual([int(row["number"]) for row in rows], list(range(1, 12)))
        reasons = {int(row["number"]): row["message"] for row in rows if row["message"]}
        self.assertEqual(sorted(reasons), [6, 10, 11])
        for number, name in ((6, "broken.tiff"), (10, "grid.txt"), (11, "missing.bag")):
            self.assertIn(name, reasons[number])
        self.assertIn("pitch", reasons[10])
        self.assertTrue(all(row["pull_off_force"] == "" for row in rows if row["message"]))
        self.assertTrue(all(row["sticks"] for row in rows if not row["message"]))

    def test_a_spreadsheet_takes_no_name_for_a_formula(self):
        self.predict("rows.csv", inputs=["=1+1.bag", "@sum.bag"], status=1)
        self.assertEqual([row["file"] for row in self.rows("rows.csv")], ["'=1+1.bag", "'@sum.bag"])

    def table(self, name, delimiter=","):
        with open(str(self.folder / name), newline="", encoding="utf-8-sig") as stream:
            return list(csv.DictReader(stream, delimiter=delimiter))

    def exported(self, rows, *options):
        """What export_predictions makes of whole rows with the same words."""
        done = run(
            [program("export_predictions"), "-o", self.folder / "by_export.csv", *options]
            + [self.folder / rows]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.table("by_export.csv", ";" if "--excel" in options else ",")

    def test_columns_are_chosen_by_the_words_of_export_predictions(self):
        self.predict("whole.csv")
        for options in (
            ["--columns", "file, verdict,pull_off_force,sq"],
            ["--columns=forces,number,doubts", "--excel"],
            ["--excel"],
        ):
            self.predict("table.csv", *options)
            delimiter = ";" if "--excel" in options else ","
            table = self.table("table.csv", delimiter)
            self.assertEqual(len(table), 11)
            expected = self.exported("whole.csv", *options)
            self.assertEqual(list(table[0]), list(expected[0]))
            for row, other in zip(table, expected):
                for name in row:
                    # flags are words in rows and counts in exports of Python
                    here, there = row[name], other[name]
                    if delimiter == ",":
                        here = {"true": "1", "false": "0", "nan": ""}.get(here, here)
                    self.assertEqual(here, there, name)
            # the rows beside it are those of a call without a table
            self.assertEqual(
                (self.folder / "table.csv.rows.csv").read_bytes(),
                (self.folder / "whole.csv").read_bytes(),
            )
            again = self.predict("table.csv", *options)
            self.assertIn("11 of them from before", again.stdout)
            self.assertEqual(self.table("table.csv", delimiter), table)
        self.predict("lines.jsonl", "--columns", "pull_off_force,number,message")
        lines = [json.loads(line) for line in (self.folder / "lines.jsonl").open()]
        self.assertEqual(list(lines[0]), ["pull_off_force", "number", "message"])
        self.assertEqual(
            lines[0]["pull_off_force"], float(self.rows("whole.csv")[0]["pull_off_force"])
        )
        self.assertEqual(list(lines[5]), ["number", "message"])  # could not be predicted

    def test_shards_with_tables_are_merged_by_the_rows_beside_them(self):
        for index in (1, 2):
            self.predict("part%d.csv" % index, "--shard=%d/2" % index, "--columns=verdict")
        self.predict("whole.csv")
        shards = [self.folder / ("part%d.csv" % index) for index in (1, 2)]
        done = run(
            [self.batch, "--merge", "--excel", "--columns=number,forces", "-o"]
            + [self.folder / "all.csv"]
            + shards
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            self.table("all.csv", ";"),
            self.exported("whole.csv", "--excel", "--columns=number,forces"),
        )
        done = run([self.batch, "--merge", "-o", self.folder / "joined.csv"] + shards)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            (self.folder / "joined.csv").read_bytes(), (self.folder / "whole.csv").read_bytes()
        )

    def test_a_table_is_refused_before_the_work_and_replaces_nothing_else(self):
        scan = [self.inputs / "b.bag"]
        for told, name, options in (
            ("did you mean verdict?", "a.csv", ["--columns=vredict"]),
            ("is no CSV", "a.jsonl", ["--excel"]),
            ("must end in .csv or .jsonl", "a.txt", ["--excel"]),
        ):
            done = self.predict(name, *options, inputs=scan, status=2)
            self.assertIn(told, done.stderr)
            self.assertEqual(list(self.folder.iterdir()), [])
        self.predict("whole.csv", inputs=scan)
        before = (self.folder / "whole.csv").read_bytes()
        done = self.predict("whole.csv", "--excel", inputs=scan, status=2)
        self.assertIn("has whole rows", done.stderr)
        self.assertEqual((self.folder / "whole.csv").read_bytes(), before)
        (self.folder / "notes.csv").write_text("mine")
        done = self.predict("notes.csv", "--columns=verdict", inputs=scan, status=2)
        self.assertIn("write another file", done.stderr)
        self.assertEqual((self.folder / "notes.csv").read_text(), "mine")

    def test_the_figures_are_those_of_predict_scan_to_the_last_bit(self):
        self.predict("rows.jsonl", "--dump", self.folder / "dump", inputs=[self.inputs / "b.bag"])
        heights = np.load(str(self.folder / "dump/000001/heights.npy"))
        self.assertEqual(heights.shape, (96, 128))
        np.savetxt(str(self.folder / "scan.txt"), heights, fmt="%.17g")
        done = run(
            [
                program("predict_scan"),
                "--json",
                "--config",
                self.inputs / "device.yaml",
                "--pitch",
                "10e-9",
                self.folder / "scan.txt",
            ]
        )
        record = json.loads(done.stdout)
        row = json.loads((self.folder / "rows.jsonl").read_text().splitlines()[0])
        self.assertEqual(row["warnings"], "; ".join(record["warnings"]))
        # a bag has no sum of a file
        common = set(row) & set(record) - {"file", "checksum", "warnings"}
        self.assertIn("reason", common)
        self.assertGreater(len(common), 30)
        self.assertEqual(
            {name: row[name] for name in common}, {name: record[name] for name in common}
        )

    def test_the_verdict_does_not_depend_on_what_is_output(self):
        (self.folder / "silent.yaml").write_text(
            CONFIG + "output: {asperities: false, roughness: false}\n"
        )
        self.predict("one.csv", inputs=[self.inputs / "a.bag"])
        self.predict(
            "silent.csv", "--config", self.folder / "silent.yaml", inputs=[self.inputs / "a.bag"]
        )
        self.assertEqual(
            (self.folder / "silent.csv").read_bytes(), (self.folder / "one.csv").read_bytes()
        )
        for row in self.rows("silent.csv"):
            self.assertLess(float(row["margin_lower"]), float(row["margin_upper"]))

    def test_merged_shards_are_one_run_byte_for_byte(self):
        for kind in ("csv", "jsonl"):
            self.predict("one." + kind)
            shards = ["shard%d.%s" % (index, kind) for index in (1, 2, 3)]
            for index, shard in enumerate(shards, 1):
                self.predict(shard, "--shard", "%d/3" % index)
            paths = [self.folder / shard for shard in reversed(shards)]
            done = run([self.batch, "--merge", "-o", self.folder / ("all." + kind)] + paths)
            self.assertEqual(done.returncode, 0, done.stderr)
            for end in ("", ".settings.yaml"):
                self.assertEqual(
                    (self.folder / ("all." + kind + end)).read_bytes(),
                    (self.folder / ("one." + kind + end)).read_bytes(),
                )
            done = run([self.batch, "--merge", "-o", self.folder / ("less." + kind)] + paths[:2])
            self.assertEqual(done.returncode, 2)
            self.assertIn("rows are missing", done.stderr)

    def scan(self, name, seed):
        np.savetxt(
            str(self.folder / name),
            1e-9 * np.random.RandomState(seed).standard_normal((64, 64)),
            fmt="%.17g",
        )
        (self.folder / (name + ".yaml")).write_text("pitch_x: 2.0e-8\npitch_y: 2.0e-8\n")
        return self.folder / name

    def test_a_row_is_not_kept_for_a_file_that_was_measured_anew(self):
        for kind in ("csv", "jsonl"):
            rows = "rows." + kind
            scans = [self.scan("%s_%d.txt" % (kind, number), number) for number in range(4)]
            self.predict(rows, inputs=scans)
            before = (self.folder / rows).read_text().splitlines()
            status = os.stat(str(scans[1]))
            text = scans[1].read_text()
            scans[1].write_text(
                text.replace(text[:6], "9.1234" if text[0] != "-" else "-9.123", 1)[: len(text)]
            )  # of the same size ...
            os.utime(str(scans[1]), ns=(status.st_atime_ns, status.st_mtime_ns))  # ... and time
            os.utime(str(scans[2]))  # touched alone
            (self.folder / (scans[3].name + ".yaml")).write_text(
                "pitch_x: 3.0e-8\npitch_y: 3.0e-8\n"
            )
            done = self.predict(rows, inputs=scans)
            self.assertIn(
                "%s: has changed since its row 2 was written, predicted again" % scans[1],
                done.stderr,
            )
            self.assertIn(
                "%s: has changed since its row 4 was written, predicted again: the settings beside "
                "it" % scans[3],
                done.stderr,
            )
            self.assertNotIn(str(scans[2]), done.stderr)
            self.assertIn("4 rows, 2 of them from before", done.stdout)
            after = (self.folder / rows).read_text().splitlines()
            first = 1 if kind == "csv" else 0
            changed = [
                number
                for number, (old, new) in enumerate(zip(before[first:], after[first:]), 1)
                if old != new
            ]
            self.assertEqual(changed, [2, 4])
            self.predict("fresh." + kind, inputs=scans)
            kept = (self.folder / ("fresh." + kind)).read_text().splitlines()
            self.assertEqual(
                after[: first + 2] + after[first + 3 :], kept[: first + 2] + kept[first + 3 :]
            )  # but the time of the touched one
            os.remove(str(scans[0]))
            self.assertEqual(
                self.predict(rows, inputs=scans).stderr.splitlines()[0],
                "stiction_batch: %s: is no longer there; its row 1 stays as it was" % scans[0],
            )
            self.assertEqual((self.folder / rows).read_text().splitlines(), after)

    def test_a_bag_that_was_recorded_anew_is_predicted_again(self):
        self.make_bag(self.folder / "day.bag", "--count", 3)
        self.predict("rows.csv", inputs=[self.folder / "day.bag"])
        before = self.rows("rows.csv")
        self.make_bag(self.folder / "day.bag", "--count", 3, "--seed", 9)
        self.predict("rows.csv", inputs=[self.folder / "day.bag"])
        for old, new in zip(before, self.rows("rows.csv")):
            self.assertNotEqual(old["pull_off_force"], new["pull_off_force"])

    def test_another_counter_surface_under_its_name_is_another_prediction(self):
        counter = self.scan("counter.txt", 7)
        scans = [self.scan("a.txt", 1), self.scan("b.txt", 2)]
        (self.folder / "pair.yaml").write_text(
            "counter_surface: {type: file, file: %s, facing: up}\n" % counter
        )
        config = ["--config", self.folder / "pair.yaml"]
        for shard in (1, 2):
            self.predict("shard%d.csv" % shard, "--shard", "%d/2" % shard, *config, inputs=scans)
        self.scan("counter.txt", 8)
        done = self.predict("shard1.csv", "--shard", "1/2", *config, inputs=scans)
        self.assertIn("a file that the settings name is another", done.stderr)
        hashes = [
            re.search(
                'settings_hash: "(.*)"',
                (self.folder / ("shard%d.csv.settings.yaml" % shard)).read_text(),
            ).group(1)
            for shard in (1, 2)
        ]
        self.assertNotEqual(*hashes)
        self.assertEqual({row["settings_hash"] for row in self.rows("shard1.csv")}, {hashes[0]})
        done = run(
            [
                self.batch,
                "--merge",
                "-o",
                self.folder / "all.csv",
                self.folder / "shard1.csv",
                self.folder / "shard2.csv",
            ]
        )
        self.assertEqual(done.returncode, 2)
        self.assertIn("is of another state of the files that the settings name", done.stderr)
        self.predict("shard2.csv", "--shard", "2/2", *config, inputs=scans)
        self.assertEqual(
            run(
                [
                    self.batch,
                    "--merge",
                    "-o",
                    self.folder / "all.csv",
                    self.folder / "shard1.csv",
                    self.folder / "shard2.csv",
                ]
            ).returncode,
            0,
        )

    def test_a_batch_goes_on_where_its_configuration_has_moved(self):
        scans = [self.scan("a.txt", 1), self.scan("b.txt", 2)]
        for place in ("one", "two"):
            (self.folder / place).mkdir()
            self.scan("%s/counter.txt" % place, 7)
            (self.folder / place / "pair.yaml").write_text(
                "counter_surface: {type: file, file: counter.txt, facing: up}\n"
            )
        self.predict("rows.csv", "--config", self.folder / "one" / "pair.yaml", inputs=scans)
        before = (self.folder / "rows.csv").read_bytes()
        done = self.predict("rows.csv", "--config", self.folder / "two" / "pair.yaml", inputs=scans)
        self.assertIn("2 rows, 2 of them from before", done.stdout)
        self.assertEqual((self.folder / "rows.csv").read_bytes(), before)
        (self.folder / "two" / "counter.txt").unlink()
        done = self.predict(
            "other.csv", "--config", self.folder / "two" / "pair.yaml", inputs=scans, status=2
        )
        self.assertIn(
            "%s: there is no such file" % (self.folder / "two" / "counter.txt"), done.stderr
        )

    def test_shards_of_files_that_have_changed_are_not_merged(self):
        scans = [self.scan("a.txt", 1), self.scan("b.txt", 2)]
        for shard in (1, 2):
            self.predict("shard%d.jsonl" % shard, "--shard", "%d/2" % shard, inputs=scans)
        merge = [
            self.batch,
            "--merge",
            "-o",
            self.folder / "all.jsonl",
            self.folder / "shard1.jsonl",
            self.folder / "shard2.jsonl",
        ]
        self.scan("b.txt", 3)
        done = run(merge)
        self.assertEqual(done.returncode, 2)
        self.assertIn(
            "shard2.jsonl: %s has changed since its row 2 was written" % scans[1], done.stderr
        )
        os.remove(str(scans[1]))
        done = run(merge)
        self.assertEqual(
            (done.returncode, done.stderr),
            (0, "stiction_batch: %s: is no longer there; its rows stay as they were\n" % scans[1]),
        )

    def test_killed_while_it_predicts_again_no_row_is_lost(self):
        scans = [self.scan("%d.txt" % number, number) for number in range(40)]
        self.predict("rows.jsonl", inputs=scans)
        for number in range(40):
            self.scan("%d.txt" % number, 100 + number)
        path = self.folder / "rows.jsonl"
        size = path.stat().st_size
        process = subprocess.Popen(
            [
                str(part)
                for part in [self.batch, "-o", path, "--config", self.inputs / "device.yaml"]
                + scans
            ],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        while process.poll() is None and path.stat().st_size < size + size // 10:
            time.sleep(0.001)
        process.kill()
        process.wait()
        self.predict("rows.jsonl", inputs=scans)
        self.predict("fresh.jsonl", inputs=scans)
        self.assertEqual(path.read_bytes(), (self.folder / "fresh.jsonl").read_bytes())

    def test_scans_that_were_recorded_before_they_named_part_or_wafer_are_read(self):
        heights = np.random.RandomState(1).normal(scale=1e-9, size=(32, 48)).astype(np.float32)
        rows = {}
        for name, kind in (
            ("unnamed", first_fields(ScanInfo, 7)),
            ("named", first_fields(ScanInfo, 10)),
            ("new", ScanInfo),
        ):
            image = Image(
                height=32, width=48, encoding="32FC1", step=4 * 48, data=heights.tobytes()
            )
            info = kind(pitch_x=1e-8, pitch_y=2e-8, height_scale=2.0)
            if name != "unnamed":
                info.scan_name, info.part_id, info.serial_id = "place 3", "lot 3", "0012"
            image.header.stamp = info.header.stamp = rospy.Time(12, 34)
            with rosbag.Bag(str(self.folder / (name + ".bag")), "w") as bag:
                bag.write("/height", image, rospy.Time(12, 50))
                bag.write("/scan_info", info, rospy.Time(12, 50))
            self.predict(name + ".jsonl", inputs=[self.folder / (name + ".bag")])
            row = json.loads((self.folder / (name + ".jsonl")).read_text())
            rows[name] = {key: value for key, value in row.items() if not key.startswith("file")}
        self.assertEqual(rows["new"]["pitch_y"], 2e-8)
        self.assertEqual(
            (rows["new"]["scan_name"], rows["new"]["part_id"], rows["new"]["serial_id"]),
            ("place 3", "lot 3", "0012"),
        )
        self.assertEqual(rows["named"], rows["new"])
        self.assertEqual(rows["unnamed"], dict(rows["new"], scan_name="", part_id="", serial_id=""))

    def test_rows_of_an_earlier_version_are_refused(self):
        scans = [self.scan("a.txt", 1)]
        self.predict("rows.jsonl", inputs=scans)
        path = self.folder / "rows.jsonl"
        row = json.loads(path.read_text())
        for name in [name for name in row if name.startswith("file_")]:
            del row[name]
        path.write_text(json.dumps(row, separators=(",", ":")) + "\n")
        done = self.predict("rows.jsonl", inputs=scans, status=2)
        self.assertIn("row 1 does not say which state of its file it is of", done.stderr)
        self.assertIn("write another file", done.stderr)

    def test_killed_in_the_middle_it_goes_on_without_loss_or_repetition(self):
        self.make_bag(
            self.folder / "long.bag", "--count", times(60, 150), "--rms-height", "1e-9", "8e-9"
        )
        inputs = [self.folder / "long.bag"]
        slow = self.folder / "slow.yaml"  # seconds, so that a busy test is in time
        slow.write_text(
            CONFIG + "approach: {formulation: paper, max_steps: 10000000}\npaper: {step: 1.0e-12}\n"
        )
        self.predict("one.csv", "--config", slow, inputs=inputs)
        expected = (self.folder / "one.csv").read_bytes()
        path = self.folder / "killed.csv"
        kills = 0
        for _ in range(times(2, 4)):
            before = path.stat().st_size if path.exists() else 0
            process = subprocess.Popen(
                [self.batch, "--config", str(slow), "-o", str(path)]
                + [str(name) for name in inputs],
                stdout=subprocess.DEVNULL,
            )
            while process.poll() is None and (
                not path.exists() or path.stat().st_size < before + 10000
            ):
                time.sleep(0.001)
            process.send_signal(signal.SIGKILL)
            kills += process.wait() == -signal.SIGKILL
            self.assertTrue(expected.startswith(path.read_bytes()))
        self.assertGreater(kills, 0)
        self.predict("killed.csv", "--config", slow, inputs=inputs)
        self.assertEqual(path.read_bytes(), expected)

    def test_a_scan_that_ends_the_program_gets_a_row_and_the_others_theirs(self):
        scans = [self.scan("%d.txt" % number, number) for number in range(6)]
        rough = 1e-9 * np.random.RandomState(2).standard_normal((2048, 2048))
        np.save(str(self.folder / "large.npy"), rough)
        (self.folder / "large.npy.yaml").write_text("pitch_x: 2.0e-8\npitch_y: 2.0e-8\n")
        scans.insert(2, self.folder / "large.npy")

        def few_seconds():
            """Of the processor, until the kernel ends the program: more than the small scans take,
            less than the large one."""
            resource.setrlimit(resource.RLIMIT_CPU, (3, 3))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        command = [self.batch, "--half-space", "-o", self.folder / "rows.csv"] + scans
        killed = run(command, preexec_fn=few_seconds)
        self.assertIn(killed.returncode, (-signal.SIGXCPU, -signal.SIGKILL))
        self.assertTrue((self.folder / "rows.csv.in_hand").exists())
        done = run(command, preexec_fn=few_seconds)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows("rows.csv")
        self.assertEqual([bool(row["message"]) for row in rows], [False, False, True] + 4 * [False])
        self.assertRegex(
            rows[2]["message"],
            "^ended an earlier call, and ends the program by signal (24|9) .*: passed over$",
        )
        self.assertEqual(rows[2]["file"], str(scans[2]))
        self.assertFalse((self.folder / "rows.csv.in_hand").exists())
        before = (self.folder / "rows.csv").read_bytes()
        self.assertEqual(run(command, preexec_fn=few_seconds).returncode, 0)
        self.assertEqual((self.folder / "rows.csv").read_bytes(), before)

    def test_a_batch_that_was_killed_from_outside_loses_no_row(self):
        scans = [self.scan("%d.txt" % number, number) for number in range(3)]
        (self.folder / "rows.csv.in_hand").write_text("5\n")
        (self.folder / "rows.csv").write_text("")
        self.predict("rows.csv", inputs=scans)
        self.assertEqual([row["message"] for row in self.rows("rows.csv")], ["", "", ""])
        self.assertFalse((self.folder / "rows.csv.in_hand").exists())

    def test_a_line_torn_anywhere_is_mended(self):
        self.predict("one.csv")
        expected = (self.folder / "one.csv").read_bytes()
        generator = random.Random(1)
        for length in [0, 1, 10] + [generator.randrange(len(expected)) for _ in range(6)]:
            missing = self.rows("one.csv")[max(expected[:length].count(b"\n") - 1, 0) :]
            (self.folder / "one.csv").write_bytes(expected[:length])
            predicts_nothing = bool(missing) and all(
                row["message"] for row in missing
            )  # grid.txt has no pitch, missing.bag is none
            self.predict("one.csv", status=int(predicts_nothing))
            self.assertEqual((self.folder / "one.csv").read_bytes(), expected)

    def test_rows_of_other_settings_or_shards_do_not_mix(self):
        self.predict("one.csv", "--shard", "1/2")
        before = (self.folder / "one.csv").read_bytes()
        self.assertIn(
            "other inputs, settings",
            self.predict("one.csv", "--shard", "1/2", "--load", "2e-6", status=2).stderr,
        )
        self.assertIn(
            "not a row of this shard", self.predict("one.csv", "--shard", "2/2", status=2).stderr
        )
        self.assertIn("--shard", self.predict("two.csv", "--shard", "3/2", status=2).stderr)
        self.assertIn("--output", self.predict("rows.xls", status=2).stderr)
        settings = self.folder / "one.csv.settings.yaml"
        settings.write_text(
            re.sub('readers: "[0-9a-f]{16}"', 'readers: "0123456789abcdef"', settings.read_text())
        )
        self.assertIn("another version", self.predict("one.csv", "--shard", "1/2", status=2).stderr)
        self.assertEqual((self.folder / "one.csv").read_bytes(), before)

    def test_of_a_bag_that_was_cut_off_the_scans_before_the_cut_are_predicted(self):
        whole = self.folder / "whole.bag"
        self.make_bag(whole, "--count", 40, "--rms-height", "3e-9")
        cut = self.folder / "cut.bag"
        cut.write_bytes(whole.read_bytes()[: int(whole.stat().st_size * 0.7)])
        self.predict("rows.csv", inputs=[cut, self.inputs / "b.bag"])
        self.predict("whole.csv", inputs=[whole])
        rows = self.rows("rows.csv")
        of_cut = [row for row in rows if row["file"].endswith("cut.bag")]
        self.assertTrue(10 < len(of_cut) < 40, len(of_cut))
        self.assertIn("cut off", of_cut[-1]["message"])
        sound = [row["pull_off_force"] for row in self.rows("whole.csv")]
        predicted = [row["pull_off_force"] for row in of_cut if not row["message"]]
        # The cut may part the last scan from its scan_info.
        self.assertIn(len(of_cut) - len(predicted), (1, 2))
        self.assertEqual(predicted, sound[: len(predicted)])
        self.assertEqual(len(rows) - len(of_cut), 3)

    def test_where_memory_ends_the_scan_is_named_and_the_others_go_on(self):
        if "MEMS_STICTION_SANITIZER" in os.environ:
            self.skipTest("sanitizers reserve more address space than is left here")
        np.save(str(self.folder / "large.npy"), np.zeros((9000, 9000)))
        np.save(str(self.folder / "small.npy"), rough(48, 48))
        settings = self.folder / "settings.yaml"
        settings.write_text("scan: {pitch_x: 1e-8, pitch_y: 1e-8}\n")
        done = run(
            ["sh", "-c", 'ulimit -v 1200000; exec "$0" "$@"', self.batch, "--workers", "2"]
            + ["-c", settings, "-o", self.folder / "rows.csv"]
            + [self.folder / "large.npy", self.folder / "small.npy"]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        large, small = self.rows("rows.csv")
        reason = "large.npy: there is not enough memory for a scan of this size"
        self.assertTrue(large["message"].endswith(reason), large["message"])
        self.assertEqual(small["message"], "")

    def test_of_a_bag_that_was_cut_off_in_its_index_all_scans_are_predicted(self):
        whole = self.folder / "whole.bag"
        self.make_bag(whole, "--count", 3)
        self.predict("whole.csv", inputs=[whole])
        content = whole.read_bytes()
        place = content.find(b"index_pos=") + 10
        index = int.from_bytes(content[place : place + 8], "little")
        cut = self.folder / "cut.bag"
        for length in (index, index + 200, (index + len(content)) // 2, len(content) - 1):
            cut.write_bytes(content[:length])
            self.predict("rows%d.csv" % length, inputs=[cut])
            rows = self.rows("rows%d.csv" % length)
            self.assertEqual(len(rows), 4, length)
            self.assertIn("cut off", rows[-1]["message"])
            self.assertEqual(
                [row["pull_off_force"] for row in rows[:-1]],
                [row["pull_off_force"] for row in self.rows("whole.csv")],
            )

    def test_a_message_of_another_definition_is_named_so(self):
        bag = self.folder / "other.bag"
        self.make_bag(bag, "--count", 2)
        content = bag.read_bytes()
        image = b"060021388200f6f0f447d0fcd9c64743"  # md5 sum of sensor_msgs/Image
        self.assertIn(image, content)
        bag.write_bytes(content.replace(image, image[::-1]))
        self.predict("rows.csv", inputs=[bag], status=1)
        message = self.rows("rows.csv")[0]["message"]
        self.assertIn("sensor_msgs/Image of another definition (md5 sum 3474", message)

    def test_of_a_bag_whose_scans_share_a_stamp_none_gets_the_scan_info_of_another(self):
        def without_stamps(path, differ):
            """The scans of a.bag, of which one has lost its scan_info."""
            lost = 0
            with rosbag.Bag(str(path), "w") as copy:
                for topic, message, when in rosbag.Bag(str(self.inputs / "a.bag")).read_messages():
                    message.header.stamp = rospy.Time()
                    if topic.endswith("scan_info"):
                        lost += 1
                        if lost == 3:
                            continue
                        message.scan_name = "scan %d" % lost if differ else "scan"
                    copy.write(topic, message, when)

        for differ in (True, False):
            without_stamps(self.folder / "unset.bag", differ)
            self.predict("rows.csv", inputs=[self.folder / "unset.bag"], status=1 if differ else 0)
            rows = self.rows("rows.csv")
            self.assertEqual(len(rows), 5)
            for row in rows:
                self.assertEqual(
                    "give each scan a header.stamp of its own" in row["message"], differ, row
                )

    def test_a_bag_that_cannot_be_written_leaves_the_one_before(self):
        def full():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))

        bag = self.folder / "full.bag"
        bag.write_bytes(b"before")
        done = run(
            [program("make_scan_bag"), "-o", bag, "--rows", 400, "--cols", 400], preexec_fn=full
        )
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
        self.assertIn("full.bag: cannot be written", done.stderr)
        self.assertEqual(bag.read_bytes(), b"before")
        self.assertEqual([path.name for path in self.folder.glob("full.bag*")], ["full.bag"])
        done = run([program("make_scan_bag"), "-o", "/dev/full"])
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)

    def test_a_bag_without_the_topic_is_a_row_that_names_what_the_bag_has(self):
        self.predict("rows.csv", "--topic", "other", inputs=[self.inputs / "b.bag"], status=1)
        self.assertIn(
            "no message on topic 'other'; the bag has /height, /scan_info",
            self.rows("rows.csv")[0]["message"],
        )

    def test_names_of_topics_are_absolute_for_those_who_filter_bags(self):
        with rosbag.Bag(str(self.inputs / "b.bag")) as bag:
            self.assertEqual(
                sorted(bag.get_type_and_topic_info().topics), ["/height", "/scan_info"]
            )
            self.assertEqual(len(list(bag.read_messages(topics=["/height"]))), 3)

    def test_when_no_scan_can_be_predicted_the_status_says_so(self):
        self.predict(
            "none.csv", inputs=[self.inputs / "broken.tiff", self.inputs / "missing.bag"], status=1
        )
        self.assertEqual(len(self.rows("none.csv")), 2)
        self.predict(
            "one.csv", inputs=[self.inputs / "broken.tiff", self.inputs / "b.bag"], status=0
        )

    def test_a_row_says_what_it_was_made_of_and_with(self):
        (self.folder / "part.yaml").write_text(CONFIG + "part: {id: lot 3, serial: 0012}\n")
        self.predict(
            "part.csv", "--config", self.folder / "part.yaml", inputs=[self.inputs / "b.bag"]
        )
        self.predict("plain.csv", inputs=[self.inputs / "b.bag"])
        row, plain = self.rows("part.csv")[0], self.rows("plain.csv")[0]
        self.assertEqual(
            (row["part_id"], row["serial_id"], row["scan_name"]), ("lot 3", "0012", "scan")
        )
        self.assertRegex(row["version"], r"^\d+\.\d+\.\d+$")
        self.assertEqual(
            row["settings_hash"], plain["settings_hash"]
        )  # who the part is changes no figure
        self.predict(
            "other.csv", "--voltage", "0", "--load", "2e-6", inputs=[self.inputs / "b.bag"]
        )
        self.assertNotEqual(self.rows("other.csv")[0]["settings_hash"], plain["settings_hash"])

    def test_a_row_says_which_place_of_which_wafer_it_is_and_who_measured_it(self):
        scan = self.folder / "place.txt"
        scan.write_text("0 1e-9 0\n0 0 2e-9\n0 0 0\n")
        sidecar = self.folder / "place.txt.yaml"
        sidecar.write_text(
            "pitch_x: 1e-8\npitch_y: 1e-8\npart_id: die 4\nserial_id: 0012\nlot_id: L7\nwafer_id: "
            "W3\nsite_x: -5.0e-3\nsite_y: 0.0\n"
            'acquisition_time: 2026-03-01T14:05:00+01:00\ninstrument: "AFM\\e[31m '
            '2"\noperator_name: =ann\n'
        )
        expected = {
            "scan_name": "place",
            "part_id": "die 4",
            "serial_id": "0012",
            "lot_id": "L7",
            "wafer_id": "W3",
            "site_x": -5e-3,
            "site_y": 0.0,
            "acquisition_time": "2026-03-01T14:05:00+01:00",
            "instrument": "AFM\\x1b[31m 2",
            "operator_name": "=ann",
            "checksum": "sha256:" + hashlib.sha256(scan.read_bytes()).hexdigest(),
        }
        self.predict("place.jsonl", inputs=[scan])
        self.assertEqual(
            {
                name: value
                for name, value in json.loads((self.folder / "place.jsonl").read_text()).items()
                if name in expected
            },
            expected,
        )
        self.predict("place.csv", inputs=[scan])
        row = self.rows("place.csv")[0]
        self.assertEqual(
            [row[name] for name in ("lot_id", "wafer_id", "part_id", "serial_id")],
            ["L7", "W3", "die 4", "0012"],
        )
        self.assertEqual(
            (float(row["site_x"]), float(row["site_y"]), row["operator_name"]),
            (-5e-3, 0.0, "'=ann"),
        )

        bag = self.folder / "place.bag"
        self.assertEqual(
            run([program("make_scan_bag"), "-o", bag, "--wafer-id", "W4", scan]).returncode, 0
        )
        self.predict("bag.jsonl", inputs=[bag])
        of_bag = {
            name: value
            for name, value in json.loads((self.folder / "bag.jsonl").read_text()).items()
            if name in expected
        }
        self.assertEqual(of_bag, dict(expected, wafer_id="W4"))

        (self.folder / "wafer.yaml").write_text(CONFIG + "part: {lot: L8, wafer: W9}\n")
        sidecar.write_text("pitch_x: 1e-8\npitch_y: 1e-8\nlot_id: L7\n")
        self.predict("other.jsonl", "--config", self.folder / "wafer.yaml", inputs=[scan])
        other = json.loads((self.folder / "other.jsonl").read_text())
        self.assertEqual(
            (other["lot_id"], other["wafer_id"], other["site_x"], other["operator_name"]),
            ("L7", "W9", None, ""),
        )
        sidecar.write_text("pitch_x: 1e-8\npitch_y: 1e-8\nsite_y: 1e-3\n")
        self.predict("half.jsonl", inputs=[scan], status=1)
        self.assertIn(
            "site_y: 0.001 is stated without site_x",
            json.loads((self.folder / "half.jsonl").read_text())["message"],
        )

    def test_a_report_says_once_what_cannot_be_read(self):
        (self.folder / "bad.di").write_text("x\n")
        (self.folder / "worse.di").write_text("y\n")
        both = [self.folder / "bad.di", self.folder / "worse.di"]
        done = run([program("stiction_report"), "-o", self.folder / "both.html", *both])
        self.assertEqual([done.stderr.count(path.name) for path in both], [1, 1], done.stderr)
        done = run(
            [program("stiction_report"), "-o", self.folder / "bad.html", self.folder / "bad.di"]
        )
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("bad.di"), 1, done.stderr)
        self.assertIn("1 scan, 0 predicted", done.stdout)
        self.assertIn("1 scan, 0 of them predicted", (self.folder / "bad.html").read_text("utf-8"))

    def test_recorded_predictions_come_out_as_a_table(self):
        bag_path = self.folder / "day.bag"
        with rosbag.Bag(str(bag_path), "w") as bag:
            for second, force in ((1, 1e-7 / 3), (2, 2e-7)):
                message = StictionPrediction(
                    pull_off_force=force,
                    reason="a; b",
                    flags=["border", "one_pixel"],
                    is_conforming=True,
                )
                message.header.stamp = rospy.Time(second)
                message.roughness.sq = 3e-9
                bag.write("/line1/prediction", message, rospy.Time(second + 10))
        done = run([program("export_predictions"), "-o", self.folder / "day.csv", bag_path])
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows("day.csv")
        self.assertEqual([float(row["pull_off_force"]) for row in rows], [1e-7 / 3, 2e-7])
        self.assertEqual((float(rows[0]["time"]), float(rows[0]["stamp"])), (11.0, 1.0))
        self.assertEqual(
            (rows[0]["flags"], rows[0]["is_conforming"], rows[0]["roughness/sq"]),
            ("border; one_pixel", "1", "3e-09"),
        )
        done = run(
            [
                program("export_predictions"),
                "--device-force",
                "-o",
                self.folder / "none.csv",
                bag_path,
            ]
        )
        self.assertEqual(done.returncode, 2)
        self.assertIn("no force of a device in", done.stderr)
        with rosbag.Bag(str(bag_path), "a") as bag:
            bag.write(
                "/line1/device_force",
                DeviceAdhesion(pull_off_force=3e-7, realisations=[2e-7, 4e-7], scan_count=2),
                rospy.Time(13),
            )
        done = run(
            [
                program("export_predictions"),
                "--device-force",
                "-o",
                self.folder / "devices.csv",
                bag_path,
            ]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 device force of 1 bag", done.stdout)
        (row,) = self.rows("devices.csv")
        self.assertEqual(
            (float(row["pull_off_force"]), row["realisations"], row["scan_count"]),
            (3e-7, "2e-07; 4e-07", "2"),
        )
        for bags, output in (
            ([self.inputs / "b.bag"], "none.csv"),
            ([self.inputs / "missing.bag"], "none.csv"),
            ([bag_path], "no/where.csv"),
        ):
            done = run([program("export_predictions"), "-o", self.folder / output] + bags)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertRegex(done.stderr, r"^export_predictions: .*\n$")

    def test_an_exported_verdict_is_that_of_the_device_whose_force_was_recorded(self):
        bag_path = self.folder / "station.bag"
        with rosbag.Bag(str(bag_path), "w") as bag:
            for second, part in ((1, "P"), (1, "Q"), (2, "P")):
                message = StictionPrediction(
                    sticks=StictionPrediction.STICKS_MARGINAL,
                    reason="margin 0.8; it waits on device_force",
                    margin=0.8,
                    part_id=part,
                )
                message.header.stamp = rospy.Time(second)
                bag.write("/line1/prediction", message, rospy.Time(second + 10))
            for part, margin, status in (("P", 4.0, 0), ("Q", 0.1, 2), ("P", 5.0, 1)):
                device = DeviceAdhesion(
                    sticks=StictionPrediction.STICKS_NO,
                    reason="margin",
                    margin=margin,
                    pull_off_force=2e-7,
                    apparent_work_of_adhesion=3e-5,
                    part_id=part,
                    status=status,
                )
                device.header.stamp = rospy.Time(1)
                bag.write("/line1/device_force", device, rospy.Time(14))
        done = run([program("export_predictions"), "-o", self.folder / "day.csv", bag_path])
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = self.rows("day.csv")
        self.assertEqual(
            [(row["sticks"], float(row["margin"]), row["is_final"]) for row in rows],
            [("0", 5.0, "1"), ("1", 0.8, "0"), ("1", 0.8, "0")],
        )
        self.assertEqual(float(rows[0]["device_pull_off_force"]), 2e-7)
        self.assertEqual(float(rows[0]["device_apparent_work_of_adhesion"]), 3e-5)
        self.assertEqual(float(rows[0]["pull_off_force"]), 0.0)

    def test_scans_of_a_bag_have_the_stamps_that_were_asked_for(self):
        path = self.folder / "late.bag"
        options = ["--first-stamp", "2e9", "--rate", "2", "--count", "2", "--rows", "16"]
        done = run([program("make_scan_bag"), "-o", path] + options)
        self.assertEqual(done.returncode, 0, done.stderr)
        with rosbag.Bag(str(path)) as bag:
            stamps = [scan.header.stamp.to_sec() for _, scan, _ in bag.read_messages(["/height"])]
        self.assertEqual(stamps, [2e9, 2e9 + 0.5])

    def test_a_disk_that_is_full_is_one_line(self):
        for call in (
            [program("make_scan_bag"), "-o", "/dev/full"],
            [program("make_scan_bag"), "-o", self.folder / "nowhere" / "a.bag"],
        ):
            done = run(call)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(
                done.stderr,
                r"^make_scan_bag: \S+: (cannot be written: |is a folder, a pipe or a device; "
                r").*\n$",
            )

    def rewritten(self, name, rename):
        """b.bag with other topics: rename(topic) gives the names that a message is written
        under."""
        path = self.folder / name
        with rosbag.Bag(str(path), "w") as target, rosbag.Bag(str(self.inputs / "b.bag")) as source:
            for topic, message, stamp in source.read_messages():
                for new_topic in rename(topic):
                    target.write(new_topic, message, stamp)
        return path

    def test_a_bag_without_scan_info_takes_the_pitch_of_the_configuration(self):
        bag = self.rewritten(
            "bare.bag", lambda topic: ["/line1/height"] if topic == "/height" else []
        )
        (self.folder / "pitch.yaml").write_text(
            CONFIG + "scan: {pitch_x: 10.0e-9, pitch_y: 10.0e-9}\n"
        )
        for config, reason, status in (
            (self.inputs / "device.yaml", "pitch", 1),
            (self.folder / "pitch.yaml", "", 0),
        ):
            rows = "%s.csv" % config.stem
            self.predict(
                rows, "--config", config, "--topic", "line1/height", inputs=[bag], status=status
            )
            self.assertTrue(all(reason in row["message"] for row in self.rows(rows)))
        self.predict("whole.csv", inputs=[self.inputs / "b.bag"])
        self.assertEqual(
            [row["pull_off_force"] for row in self.rows("pitch.csv")],
            [row["pull_off_force"] for row in self.rows("whole.csv")],
        )

    def test_a_scan_of_a_bag_is_predicted_to_the_bits_of_its_file(self):
        heights = 3e-9 * np.random.RandomState(5).standard_normal((48, 64))
        slow = 2e-9 * np.sin(np.arange(64) / 5.0)[None, :] * np.cos(np.arange(48) / 4.0)[:, None]
        scans = {
            "double.npy": heights + slow,
            "offset.npy": slow + 0.0763,
            "single.npy": (heights + slow).astype(np.float32),
        }
        for name, array in scans.items():
            np.save(str(self.folder / name), array)
        paths = [self.folder / name for name in scans]
        done = run(
            [program("make_scan_bag"), "-o", self.folder / "all.bag", "--pitch", "10e-9"] + paths
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        with rosbag.Bag(str(self.folder / "all.bag")) as bag:
            encodings = [
                message.encoding for _, message, _ in bag.read_messages(topics=["/height"])
            ]
        self.assertEqual(encodings, ["64FC1", "64FC1", "32FC1"])
        self.predict("bag.jsonl", inputs=[self.folder / "all.bag"])
        done = run(
            [
                program("predict_scan"),
                "--json",
                "--config",
                self.inputs / "device.yaml",
                "--pitch",
                "10e-9",
            ]
            + paths
        )
        rows = [json.loads(line) for line in (self.folder / "bag.jsonl").read_text().splitlines()]
        records = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([len(rows), len(records)], [len(scans)] * 2)
        for row, record in zip(rows, records):
            for name in (
                "pull_off_force",
                "contact_area",
                "mean_gap",
                "composite_rms_height",
                "margin",
                "margin_lower",
            ):
                self.assertEqual(row[name], record[name], (record["file"], name))

    def test_a_recorded_counter_surface_is_met(self):
        bag = self.rewritten("counter.bag", lambda topic: ["/counter_" + topic.strip("/"), topic])
        (self.folder / "topic.yaml").write_text(
            CONFIG + "counter_surface: {type: topic, facing: up}\n"
        )
        self.predict(
            "rows.csv", "--config", self.folder / "topic.yaml", inputs=[bag, self.inputs / "b.bag"]
        )
        rows = self.rows("rows.csv")
        self.assertEqual([row["message"] for row in rows[:3]], [""] * 3)
        for row in rows[:3]:  # two of the same roughness
            self.assertAlmostEqual(
                float(row["composite_rms_height"]) / float(row["rms_height"]), 2**0.5, places=6
            )
        self.assertIn("no counter-surface was recorded before the scan", rows[3]["message"])

    def test_the_dask_example_on_two_workers_gives_the_rows_of_one_run(self):
        self.predict("one.csv")
        environment = dict(
            os.environ, PATH=str(pathlib.Path(self.batch).parent) + os.pathsep + os.environ["PATH"]
        )
        done = run(
            [
                sys.executable,
                SCRIPTS / "examples/batch_dask.py",
                "--workers",
                2,
                "--shards",
                3,
                "--config",
                self.inputs / "device.yaml",
                "-o",
                self.folder / "dask.csv",
            ]
            + self.everything,
            env=environment,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            (self.folder / "dask.csv").read_bytes(), (self.folder / "one.csv").read_bytes()
        )

    def test_the_dask_example_finds_what_lies_beside_a_link(self):
        (self.folder / "store").mkdir()
        np.savetxt(
            str(self.folder / "store/1f3a.txt"),
            1e-9 * np.random.RandomState(1).standard_normal((32, 32)),
        )
        (self.folder / "scan.txt").symlink_to(self.folder / "store/1f3a.txt")
        (self.folder / "scan.txt.yaml").write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        environment = dict(
            os.environ, PATH=str(pathlib.Path(self.batch).parent) + os.pathsep + os.environ["PATH"]
        )
        done = run(
            [
                sys.executable,
                SCRIPTS / "examples/batch_dask.py",
                "--shards",
                1,
                "-o",
                self.folder / "dask.csv",
                self.folder / "scan.txt",
            ],
            env=environment,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([row["message"] for row in self.rows("dask.csv")], [""])

    def test_the_array_example_gives_the_rows_of_one_run(self):
        self.predict("one.csv")
        (self.folder / "inputs.txt").write_text("".join("%s\n" % path for path in self.everything))
        path = str(pathlib.Path(self.batch).parent) + os.pathsep + os.environ["PATH"]
        for task in (1, 2):
            done = run(
                [
                    SCRIPTS / "examples/batch_array.sbatch",
                    self.folder / "inputs.txt",
                    self.inputs / "device.yaml",
                    self.folder / "rows",
                ],
                env=dict(
                    os.environ, PATH=path, SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT="2"
                ),
            )
            self.assertEqual(done.returncode, 0, done.stderr)
        run(
            [self.batch, "--merge", "-o", self.folder / "all.csv"]
            + sorted((self.folder / "rows").glob("*.csv"))
        )
        self.assertEqual(
            (self.folder / "all.csv").read_bytes(), (self.folder / "one.csv").read_bytes()
        )

    def bag_of_parts(self):
        """a.bag twice over, with other stamps: scans 1 to 3 of one part, then of another, which has
        a comma and a formula in its name."""
        path = self.folder / "parts.bag"
        ids = {}
        with rosbag.Bag(str(path), "w") as target, rosbag.Bag(str(self.inputs / "a.bag")) as source:
            for topic, message, stamp in source.read_messages():
                stamp = message.header.stamp
                place = ids.setdefault(stamp, len(ids))
                if topic == "/scan_info":
                    message.part_id, message.serial_id = (
                        ("lot 3", "0012") if place < 3 else ('=lot "4", left', "")
                    )
                target.write(topic, message, stamp)
        return path

    @staticmethod
    def pooled(rows):
        """Geometric mean of the margins and its interval, written down once more: normal quantiles,
        since these scans scatter less or little more than their contacts explain, or Student's by
        scipy."""
        from scipy.stats import t

        reach = 1.959963985
        logs = np.log([float(row["margin"]) for row in rows])
        down = np.log([float(row["margin"]) / float(row["margin_lower"]) for row in rows]) / reach
        up = np.log([float(row["margin_upper"]) / float(row["margin"]) for row in rows]) / reach
        place = np.minimum([float(row["place_deviation"]) for row in rows], np.minimum(down, up))
        count, within = len(rows), np.mean(place**2)
        excess = max(0.0, np.var(logs, ddof=1) - within)
        ends = []
        for side in (down, up):
            variance = np.mean(np.sqrt(side**2 - place**2)) ** 2 + (within + excess) / count
            freedom = (count - 1) * (variance / (excess / count)) ** 2 if excess else np.inf
            ends.append(t.ppf(0.975, freedom) * np.sqrt(variance))
        return np.exp([np.mean(logs), np.mean(logs) - ends[0], np.mean(logs) + ends[1]])

    def test_the_scans_of_a_part_are_pooled(self):
        bag = self.bag_of_parts()
        self.predict(
            "rows.csv",
            "--parts",
            self.folder / "parts.csv",
            inputs=[bag, self.inputs / "broken.tiff", self.inputs / "b.bag"],
        )
        rows, parts = self.rows("rows.csv"), self.rows("parts.csv")
        self.assertEqual(
            [(part["part_id"], part["serial_id"], part["scan_count"]) for part in parts],
            [("lot 3", "0012", "3"), ('\'=lot "4", left', "", "2")],
        )
        for part, of_part in zip(parts, (rows[:3], rows[3:5])):
            self.assertEqual({row["sticks"] for row in of_part} & {"unknown"}, set())
            self.assertEqual(part["counted_scans"], str(len(of_part)))
            np.testing.assert_allclose(
                [float(part[name]) for name in ("margin", "margin_lower", "margin_upper")],
                self.pooled(of_part),
                rtol=1e-7,
            )
            worst = min(of_part, key=lambda row: float(row["margin"]))
            self.assertEqual(part["worst_margin"], worst["margin"])
            self.assertEqual(part["worst_margin_scan"], "scan (%s)" % worst["number"])
            self.assertEqual(part["settings_hash"], of_part[0]["settings_hash"])

    def test_a_row_says_of_the_device_what_predict_scan_says(self):
        config = self.folder / "own.yaml"
        config.write_text(OWN_FORCE)
        self.predict(
            "plain.jsonl", "--config", config, "--no-device-force", inputs=[self.inputs / "b.bag"]
        )
        plain = json.loads((self.folder / "plain.jsonl").read_text().splitlines()[0])
        self.assertEqual((plain["sticks"], plain["margin"]), ("unknown", None))
        self.assertIn("--device-force", plain["reason"])
        self.predict(
            "rows.jsonl",
            "--config",
            config,
            "--dump",
            self.folder / "dump",
            inputs=[self.inputs / "b.bag"],
        )
        row = json.loads((self.folder / "rows.jsonl").read_text().splitlines()[0])
        np.savetxt(
            str(self.folder / "scan.txt"),
            np.load(str(self.folder / "dump/000001/heights.npy")),
            fmt="%.17g",
        )
        done = run(
            [
                program("predict_scan"),
                "--json",
                "--config",
                config,
                "--pitch",
                "10e-9",
                self.folder / "scan.txt",
            ]
        )
        record = json.loads(done.stdout)
        self.assertEqual(record["device_force"]["pull_off_force"], row["device_pull_off_force"])
        self.assertIn("device_force/max_cells", row["warnings"])
        self.assertEqual(row["warnings"], "; ".join(record["warnings"]))
        self.assertEqual(
            [row[name] for name in ("margin", "margin_lower", "margin_upper", "sticks")],
            [record[name] for name in ("margin", "margin_lower", "margin_upper", "sticks")],
        )
        again = run(
            [
                self.batch,
                "-o",
                self.folder / "rows.jsonl",
                "--config",
                config,
                "--no-device-force",
                self.inputs / "b.bag",
            ]
        )
        self.assertEqual(again.returncode, 2, "rows with and without it do not mix")

    def test_a_part_is_judged_by_the_devices_own_force_of_all_its_scans(self):
        config = self.folder / "own.yaml"
        config.write_text(OWN_FORCE)
        inputs = [self.bag_of_parts(), self.inputs / "b.bag"]
        self.predict(
            "rows.csv", "--config", config, "--parts", self.folder / "parts.csv", inputs=inputs
        )
        rows, parts = self.rows("rows.csv"), self.rows("parts.csv")
        self.assertEqual(
            {row["sticks"] for row in rows if not row["message"]},
            {"unknown"},
            "a scan has not the size of the contact",
        )
        for row in rows:
            if not row["message"]:
                self.assertIn("the part's row in the file of --parts has", row["reason"])
                self.assertNotIn("--parts finds it", row["reason"], "the user has given it")
        for part, count in zip(parts, ("3", "2")):
            self.assertEqual(
                (part["scan_count"], part["counted_scans"], part["verdict_by"]),
                (count, count, "prediction"),
            )
            self.assertIn(part["sticks"], ("no", "marginal", "yes"))
            self.assertLess(float(part["margin_lower"]), float(part["margin"]))
            self.assertGreater(float(part["margin_upper"]), float(part["margin"]))
            self.assertIn(count + " scans together", part["reason"])
        self.assertNotEqual(parts[0]["margin"], parts[1]["margin"])
        for index in (1, 2):
            self.predict(
                "shard%d.csv" % index,
                "--config",
                config,
                "--no-device-force",
                "--shard",
                "%d/2" % index,
                inputs=inputs,
            )
        reasons = [row["reason"] for row in self.rows("shard1.csv") if not row["message"]]
        self.assertIn("--parts finds it for each part", reasons[0])
        done = run(
            [
                self.batch,
                "--merge",
                "--parts",
                self.folder / "merged_parts.csv",
                "-o",
                self.folder / "merged.csv",
            ]
            + [self.folder / ("shard%d.csv" % index) for index in (1, 2)]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            (self.folder / "merged_parts.csv").read_text(), (self.folder / "parts.csv").read_text()
        )

    def test_the_order_of_scans_does_not_change_the_verdict_on_their_part(self):
        config = self.folder / "own.yaml"
        config.write_text("part: {id: lot 5}\n" + OWN_FORCE)
        scans = []
        for name, pitch in (("a", 10e-9), ("b", 10e-9), ("wide", 40e-9)):
            scans.append(self.folder / (name + ".npy"))
            np.save(str(scans[-1]), rough(64, 64, 2e-9, len(scans)))
            (self.folder / (name + ".npy.yaml")).write_text(
                "pitch_x: %r\npitch_y: %r\n" % (pitch, pitch)
            )
        found = set()
        for inputs in itertools.permutations(scans):
            for rows in self.folder.glob("rows.csv*"):
                rows.unlink()
            self.predict(
                "rows.csv", "--config", config, "--parts", self.folder / "parts.csv", inputs=inputs
            )
            (part,) = self.rows("parts.csv")
            self.assertEqual(part["counted_scans"], "3", part)
            found.add(
                tuple(part[name] for name in ("sticks", "margin", "margin_lower", "margin_upper"))
            )
        self.assertEqual(len(found), 1)
        self.assertNotIn("nan", found.pop())

    def test_a_part_whose_scans_are_gone_says_so(self):
        config = self.folder / "own.yaml"
        config.write_text("part: {id: lot 5}\n" + OWN_FORCE)
        scan = self.folder / "scan.npy"
        np.save(str(scan), np.random.RandomState(1).standard_normal((40, 40)) * 1e-9)
        (self.folder / "scan.npy.yaml").write_text("pitch_x: 10e-9\npitch_y: 10e-9\n")
        self.predict(
            "rows.csv", "--config", config, "--parts", self.folder / "parts.csv", inputs=[scan]
        )
        self.assertNotEqual(self.rows("parts.csv")[0]["margin"], "")
        scan.unlink()
        self.predict(
            "rows.csv", "--config", config, "--parts", self.folder / "parts.csv", inputs=[scan]
        )
        part = self.rows("parts.csv")[0]
        self.assertEqual((part["sticks"], part["margin"]), ("unknown", "nan"))
        self.assertIn("the device's own force has not been found: ", part["warnings"])
        self.assertIn("scan.npy", part["warnings"])

    def test_parts_do_not_depend_on_how_their_rows_were_written(self):
        inputs = [self.bag_of_parts(), self.inputs / "b.bag"]
        self.predict("one.csv", "--parts", self.folder / "one_parts.jsonl", inputs=inputs)
        self.predict("one.jsonl", "--parts", self.folder / "two_parts.jsonl", inputs=inputs)
        for index in (1, 2):
            self.predict("shard%d.csv" % index, "--shard", "%d/2" % index, inputs=inputs)
        done = run(
            [
                self.batch,
                "--merge",
                "--parts",
                self.folder / "merged_parts.jsonl",
                "-o",
                self.folder / "merged.csv",
            ]
            + [self.folder / ("shard%d.csv" % index) for index in (1, 2)]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        texts = [(self.folder / (name + "_parts.jsonl")).read_text() for name in ("one", "merged")]
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(len(texts[0].splitlines()), 2)
        of_csv, of_json = (
            [
                json.loads(line)
                for line in (self.folder / (name + "_parts.jsonl")).read_text().splitlines()
            ]
            for name in ("one", "two")
        )
        for part in of_csv:  # in CSV it stands as the spreadsheet takes it
            part["part_id"] = part["part_id"].lstrip("'")
        self.assertEqual(of_csv, of_json)

    def test_parts_without_a_device_and_bad_names_of_their_file(self):
        (self.folder / "bare.yaml").write_text("load: {mechanical_load: 1.0e-6}\n")
        self.predict(
            "rows.csv",
            "--config",
            self.folder / "bare.yaml",
            "--parts",
            self.folder / "parts.csv",
            inputs=[self.bag_of_parts()],
        )
        part = self.rows("parts.csv")[0]
        self.assertEqual((part["sticks"], part["counted_scans"]), ("unknown", "0"))
        self.assertIn("the device is not stated", part["reason"])
        done = self.predict(
            "other.csv", "--parts", "parts.txt", inputs=[self.inputs / "b.bag"], status=2
        )
        self.assertIn(
            "--parts: 'parts.txt' is not allowed, must end in .csv or .jsonl", done.stderr
        )
        done = self.predict(
            "other.csv",
            "--parts",
            self.folder / "other.csv",
            inputs=[self.inputs / "b.bag"],
            status=2,
        )
        self.assertIn("--parts: must be another file", done.stderr)
        self.assertFalse((self.folder / "other.csv").exists())

    def scans_of_one_surface(self):
        """Two fine scans of a self-affine surface (H 0.8, roll-off 2 um, rms height 4 nm), and one
        of as coarse pixels as light has."""
        paths = []
        for seed, (name, side, pitch) in enumerate(
            (("fine_1", 160, 5e-9), ("fine_2", 160, 5e-9), ("light", 160, 160e-9))
        ):
            frequency = np.hypot(
                np.fft.fftfreq(side, pitch)[:, None], np.fft.rfftfreq(side, pitch)[None, :]
            )
            gains = np.maximum(2e-6 * frequency, 1.0) ** -1.8  # flat below the roll-off
            gains[0, 0] = 0.0
            waves = np.fft.rfft2(np.random.RandomState(seed).standard_normal((side, side)))
            np.save(
                str(self.folder / (name + ".npy")),
                np.fft.irfft2(waves * gains, s=(side, side))
                * 4e-9
                * 2e-6
                / np.sqrt(2.25 * np.pi)
                / pitch,
            )
            (self.folder / (name + ".npy.yaml")).write_text(
                "pitch_x: %g\npitch_y: %g\n" % (pitch, pitch)
            )
            paths.append(self.folder / (name + ".npy"))
        return paths

    def test_a_scan_that_does_not_show_what_holds_is_unknown_and_serves_its_part_as_a_wide_one(
        self,
    ):
        config = self.folder / "own.yaml"
        config.write_text(OWN_FORCE.replace("1.0e-11", "1.0e-12"))
        scans = self.scans_of_one_surface()
        for way in ((), ("--no-device-force",)):
            rows, parts = "rows%d.csv" % len(way), "parts%d.csv" % len(way)
            self.predict(
                rows,
                "--config",
                config,
                "--part",
                "plate",
                "--parts",
                self.folder / parts,
                *way,
                inputs=scans,
            )
            *fine, light = self.rows(rows)
            self.assertEqual((light["sticks"], light["margin"]), ("unknown", "nan"))
            self.assertIn("unresolved", light["regime_flag_names"])
            self.assertIn("missing is AFM", light["reason"])
            self.assertIn("missing is AFM", light["warnings"])
            self.assertFalse(any("unresolved" in row["regime_flag_names"] for row in fine))
            [part] = self.rows(parts)
            self.assertEqual((part["part_id"], part["scan_count"]), ("plate", "3"))
            self.assertIn(part["sticks"], ("no", "marginal", "yes"), part["reason"])
        self.predict(
            "light.csv",
            "--config",
            config,
            "--part",
            "plate",
            "--parts",
            self.folder / "light_parts.csv",
            inputs=scans[2:],
        )
        [part] = self.rows("light_parts.csv")
        self.assertEqual(part["sticks"], "unknown")
        self.assertIn("the scan does not show what holds", part["reason"])

        page = self.folder / "report.html"
        done = run(
            [
                program("stiction_report"),
                "--config",
                config,
                "--part",
                "plate",
                "--most",
                1,
                "--steps",
                0,
                "-o",
                page,
            ]
            + scans
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        cells = re.findall(
            '<td class="(no|marginal|yes|unknown)">([^<]*)</td>', page.read_text(encoding="utf-8")
        )
        self.assertEqual(cells.count(("unknown", "not known")), 1, cells)
        self.assertNotIn("state no part", page.read_text(encoding="utf-8"))

    def test_scans_without_a_part_are_asked_for_theirs(self):
        inputs = [self.inputs / "b.bag"]
        said = "3 scans state no part_id, and each is judged alone"
        self.assertIn(said, self.predict("rows.csv", inputs=inputs).stderr)
        self.assertNotIn(said, self.predict("named.csv", "--part", "plate", inputs=inputs).stderr)
        self.assertEqual({row["part_id"] for row in self.rows("named.csv")}, {"plate"})
        self.assertNotIn(
            "state no part_id",
            self.predict("stated.csv", "--part", "plate", inputs=[self.bag_of_parts()]).stderr,
        )
        self.assertEqual(
            {row["part_id"] for row in self.rows("stated.csv")},
            {"lot 3", '\'=lot "4", left'},
            "what a scan states stays",
        )
        (self.folder / "bare.yaml").write_text("load: {mechanical_load: 1.0e-6}\n")
        self.assertNotIn(
            said,
            self.predict("bare.csv", "--config", self.folder / "bare.yaml", inputs=inputs).stderr,
        )
        page = self.folder / "report.html"
        done = run(
            [
                program("stiction_report"),
                "--config",
                self.inputs / "device.yaml",
                "--most",
                1,
                "--steps",
                0,
                "-o",
                page,
            ]
            + inputs
        )
        self.assertIn(said, done.stderr)
        self.assertIn(
            "3 scans state no part, and each is judged alone", page.read_text(encoding="utf-8")
        )

    def test_the_report_has_a_verdict_for_each_part(self):
        page = self.folder / "report.html"
        done = run(
            [
                program("stiction_report"),
                "--config",
                self.inputs / "device.yaml",
                "--most",
                1,
                "--steps",
                0,
                "-o",
                page,
                self.bag_of_parts(),
            ]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        table = re.search(
            '<table class="overview" id="parts">.*?</table>',
            page.read_text(encoding="utf-8"),
            re.DOTALL,
        ).group(0)
        self.assertIn("0012", table)
        self.assertIn("=lot &#34;4&#34;, left", table)
        parts = json.loads((self.folder / "report.json").read_text())["parts"]
        self.assertEqual(len(parts), 2)
        for part in parts:
            self.assertIn(
                '<td class="%s">%s</td>' % (part["sticks"], report.verdict_word(part["sticks"])),
                table,
            )
            self.assertIn("%d of %d" % (part["counted_scans"], part["scan_count"]), table)
            self.assertIsNone(part["device_pull_off_force"])
        self.assertIn("pooled: the geometric mean", page.read_text(encoding="utf-8"))
        own = [dict(part, device_pull_off_force=1e-7) for part in parts]
        self.assertRegex(report.parts_caption(own), "^Judged by the device's own force, [^:]*$")
        self.assertRegex(
            report.parts_caption(own[:1] + parts[1:]),
            "^1 of 2 parts: by the device's own force, .* The others: the scans of one part",
        )
        run(
            [
                program("stiction_report"),
                "--config",
                self.inputs / "device.yaml",
                "--most",
                1,
                "--steps",
                0,
                "-o",
                page,
                self.inputs / "b.bag",
            ]
        )
        self.assertNotIn('id="parts"', page.read_text(encoding="utf-8"))

    def test_the_report_is_one_page_with_everything_in_it(self):
        page = self.folder / "report.html"
        done = run(
            [
                program("stiction_report"),
                "--config",
                self.inputs / "device.yaml",
                "--pdf",
                "--most",
                2,
                "-o",
                page,
                self.inputs / "a.bag",
                self.inputs / "broken.tiff",
            ]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        text = page.read_text(encoding="utf-8")
        # Nothing from elsewhere: every address is data or a place on the page.
        self.assertEqual(
            [
                a
                for a in re.findall(r'(?:src|href)="([^"]{0,40})', text)
                if not a.startswith(("data:", "#"))
            ],
            [],
        )
        self.assertEqual(text.count('class="scan"'), 2)
        self.assertEqual(text.count("data:image/png;base64,"), 2 * 3 + 1)  # no cleaning step is on
        for expected in (
            "6 scans, 5 of them predicted",
            "not predicted: ",
            "work_of_adhesion",
            "Johnson, Kendall",
        ):
            self.assertIn(expected, text)
        self.assertEqual((self.folder / "report.pdf").read_bytes()[:5], b"%PDF-")
        self.assertEqual(len(self.rows("report.csv")), 6)
        scans = json.loads((self.folder / "report.json").read_text())["scans"]
        self.assertEqual(
            [row["pull_off_force"] for row in scans[:5]],
            [float(row["pull_off_force"]) for row in self.rows("report.csv")[:5]],
        )

    def test_a_report_on_nothing_says_so(self):
        done = run(
            [
                program("stiction_report"),
                "-o",
                self.folder / "report.html",
                self.inputs / "broken.tiff",
            ]
        )
        self.assertEqual(done.returncode, 2)
        self.assertIn("broken.tiff", done.stderr)
        done = run(
            [program("stiction_report"), "-o", self.folder / "report.txt", self.inputs / "a.bag"]
        )
        self.assertEqual(done.returncode, 2)
        self.assertIn("must end in .html", done.stderr)


class OriginTest(unittest.TestCase):
    def test_a_report_says_of_a_scan_what_is_stated_and_nothing_else(self):
        row = {
            "part_id": "die 4",
            "serial_id": "",
            "wafer_id": "W3",
            "site_x": -5e-3,
            "site_y": 0.0,
            "acquisition_time": "2026-03-01T14:05:00",
            "instrument": "AFM 2",
            "operator_name": "ann",
            "checksum": "sha256:00",
            "settings_hash": "00ff",
            "version": "1.2.3",
        }
        self.assertEqual(
            report.origin_of(row),
            "part die 4, wafer W3, site -5.00 mm, 0 m, measured 2026-03-01T14:05:00, with AFM 2, "
            "by ann, file sha256:00, settings 00ff, version 1.2.3",
        )
        self.assertEqual(
            report.origin_of({"site_x": None, "site_y": None, "part_id": "", "version": "1.2.3"}),
            "version 1.2.3",
        )


class TableRowTest(unittest.TestCase):
    def test_a_beam_without_a_spring_is_judged_by_its_peel_number(self):
        beam = {
            "margin": None,
            "peel_number": 3.21,
            "peel_number_lower": 1.234,
            "peel_number_upper": 1234.5,
        }
        self.assertEqual(report.judged_by(beam), "peel_number")
        self.assertEqual(report.judged_by(dict(beam, margin=2.0)), "margin")
        self.assertEqual(
            report.judged_by(dict(beam, margin=2.0, governed_by="peeling")), "peel_number"
        )
        self.assertEqual(report.judged_by(dict(beam, margin=2.0, governed_by="force")), "margin")
        self.assertEqual(report.judged_by({}), "margin")
        row = dict(
            beam,
            number=1,
            file="a.tiff",
            scan=0,
            name="",
            channel="",
            message="",
            status="EQUILIBRIUM",
            pull_off_force=1e-7,
            contact_fraction=0.01,
            asperity_count=3,
            elastic_count=1,
            elasto_plastic_count=1,
            plastic_count=1,
            is_lower_bound=False,
            rms_height=1e-9,
            sticks="no",
        )
        self.assertEqual(report.table_row(row, set())["ratio"], "3.2 (1.2 to 1200)")
        self.assertEqual(
            report.table_row(dict(row, margin=2.0, governed_by="peeling"), set())["ratio"],
            "3.2 (1.2 to 1200)",
        )
        self.assertEqual(report.table_row(dict(row, peel_number=None), set())["ratio"], "-")

    def test_lower_bounds_and_limits_are_said_with_the_words_of_the_model_that_has_them(self):
        row = {
            "status": "BONDED",
            "is_lower_bound": True,
            "pull_off_force": 2e-7,
            "contact_fraction": 0.1,
            "asperity_count": 3,
            "elastic_count": 3,
            "elasto_plastic_count": 0,
            "plastic_count": 0,
            "rms_height": 1e-9,
            "number": 1,
            "file": "a.txt",
            "scan": None,
            "name": "",
            "channel": "",
            "message": "",
            "regime_flag_names": "few_contacts, border",
            "warnings": "odd",
        }
        self.assertEqual(report.table_row(row, set())["pull_off"], "≥ 200 nN")
        followed = report.table_row(dict(row, is_lower_bound=False), set())
        self.assertEqual(followed["pull_off"], "200 nN")
        self.assertEqual(
            followed["limits"],
            "few contacts: another place of the surface may differ much; most of the adhesion is "
            "of contacts at the frame's border: their summits may lie outside; odd",
        )


class ChosenTest(unittest.TestCase):
    def test_pictures_are_spread_evenly_with_both_ends(self):
        rows = [{"number": number} for number in range(1, 101)]
        self.assertEqual(report.chosen(rows, 3), [1, 50, 100])
        self.assertEqual(report.chosen(rows[:3], 3), [1, 2, 3])
        self.assertEqual(report.chosen(rows, 1), [1])


if __name__ == "__main__":
    unittest.main()
