"""stiction_batch --half-space and the report on it: the record's figures for many scans, and why
where there are none."""

import csv
import json
import pathlib
import re
import signal
import subprocess
import tempfile
import time
import unittest

import numpy as np
from mems_stiction.half_space_figure import contact_groups, pull_off_ratio
from roslib.packages import find_node

CONFIG = "scan: {pitch_x: 2.0e-9, pitch_y: 2.0e-9}\n"
FIGURES = (
    "status",
    "pull_off_force",
    "contact_area",
    "contact_fraction",
    "mean_gap",
    "apparent_work_of_adhesion",
    "adhesion_hysteresis",
    "is_converged",
    "is_resolved",
    "iterations",
    "contact_stiffness",
)


def program(name):
    return find_node("mems_stiction", name)[0]


def run(command):
    return subprocess.run(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        universal_newlines=True,
        timeout=300,
    )


def sphere(pixels, radius=100e-9, pitch=2e-9):
    offset = (np.arange(pixels) - (pixels - 1) / 2) * pitch
    return -(offset[:, None] ** 2 + offset[None, :] ** 2) / (2 * radius)


def rough(pixels, rms_height):
    """Smoothed noise [m]; 0.45 nm are near bonding on pixels of 10 nm."""
    noise = np.random.RandomState(1).normal(size=(pixels, pixels))
    ky, kx = np.meshgrid(np.fft.fftfreq(pixels), np.fft.rfftfreq(pixels), indexing="ij")
    smooth = np.fft.irfft2(
        np.fft.rfft2(noise) * np.exp(-(kx**2 + ky**2) * 200.0), s=(pixels, pixels)
    )
    return smooth * rms_height / smooth.std()


class HalfSpaceBatchTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.config = self.folder / "c.yaml"
        self.config.write_text(CONFIG)
        self.small = self.folder / "small.txt"
        np.savetxt(str(self.small), sphere(32))
        self.large = self.folder / "large.txt"
        np.savetxt(str(self.large), sphere(48))

    def batch(self, rows, *arguments, **changes):
        done = run(
            [program("stiction_batch"), "-c", self.config, "-o", self.folder / rows]
            + list(arguments)
            + list(changes.get("inputs", [self.small, self.large]))
        )
        self.assertEqual(done.returncode, changes.get("status", 0), done.stderr)
        return done

    def rows(self, name):
        with open(str(self.folder / name), newline="") as stream:
            return list(csv.DictReader(stream))

    def test_the_figures_are_those_of_predict_scan_to_the_last_bit(self):
        self.batch("rows.jsonl", "--half-space")
        done = run(
            [
                program("predict_scan"),
                "--half-space",
                "--json",
                "-c",
                self.config,
                self.small,
                self.large,
            ]
        )
        records = [json.loads(line) for line in done.stdout.splitlines()]
        rows = [json.loads(line) for line in (self.folder / "rows.jsonl").read_text().splitlines()]
        for row, record in zip(rows, records):
            self.assertEqual(
                {name: row["half_space_" + name] for name in FIGURES},
                {name: record["half_space"][name] for name in FIGURES},
            )
            self.assertEqual((row["half_space_status"], row["half_space_message"]), ("SOLVED", ""))
            self.assertEqual(row["pull_off_force"], record["pull_off_force"])
            self.assertNotIn("half_space_processing_time", row)
        self.assertEqual(len(rows), 2)

    def test_without_it_rows_are_what_they_were(self):
        self.batch("plain.csv")
        self.batch("more.csv", "--half-space")
        self.assertFalse(
            [name for name in self.rows("plain.csv")[0] if name.startswith("half_space")]
        )
        for plain, more in zip(self.rows("plain.csv"), self.rows("more.csv")):
            self.assertEqual(
                dict(plain, settings_hash=""),
                dict({name: more[name] for name in plain}, settings_hash=""),
            )

    def test_what_has_no_solution_has_its_reason_and_its_prediction(self):
        self.config.write_text(CONFIG + "half_space: {max_pixels: 1500}\n")
        done = self.batch(
            "rows.csv", "--half-space", inputs=[self.small, self.large, self.folder / "none.txt"]
        )
        solved, refused, missing = self.rows("rows.csv")
        self.assertEqual(
            (solved["half_space_status"], solved["half_space_message"]), ("SOLVED", "")
        )
        self.assertIn("half_space/max_pixels = 1500", refused["half_space_message"])
        self.assertEqual(refused["message"], "")
        self.assertGreater(float(refused["pull_off_force"]), 0.0)
        self.assertEqual({refused["half_space_" + name] for name in FIGURES}, {""})
        self.assertIn("no such file", missing["message"])
        self.assertEqual({missing["half_space_" + name] for name in FIGURES + ("message",)}, {""})
        self.assertIn("1 scan failed in this run, half-space not solved for 1 other\n", done.stdout)

    def test_a_path_that_is_given_up_is_nan_never_a_number(self):
        self.config.write_text(CONFIG + "half_space: {max_states: 10}\n")
        done = self.batch("rows.csv", "--half-space", inputs=[self.small])
        self.assertIn("half-space not solved for 1 other\n", done.stdout)
        row = self.rows("rows.csv")[0]
        self.assertEqual(
            (row["half_space_status"], row["half_space_is_converged"]), ("TOO_MANY_STATES", "false")
        )
        self.assertEqual({row["half_space_" + name] for name in FIGURES[1:7]}, {"nan"})
        self.assertIn("half_space/max_states = 10", row["half_space_message"])

    def test_rows_with_and_without_it_do_not_mix_and_shards_join(self):
        done = self.batch("one.csv", "--half-space")
        self.assertIn("0 scans failed in this run\n", done.stdout)  # all others are solved
        self.assertIn("other inputs, settings", self.batch("one.csv", status=2).stderr)
        for index in (1, 2):
            self.batch("part%d.csv" % index, "--half-space", "--shard", "%d/2" % index)
        done = run(
            [
                program("stiction_batch"),
                "--merge",
                "-o",
                self.folder / "all.csv",
                self.folder / "part2.csv",
                self.folder / "part1.csv",
            ]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            (self.folder / "all.csv").read_bytes(), (self.folder / "one.csv").read_bytes()
        )

    def test_interrupted_in_a_solution_it_ends_soon_and_goes_on_with_that_scan(self):
        # A minute of work for the second scan, so that it is interrupted in the middle.
        np.savetxt(str(self.large), sphere(700, radius=10e-6, pitch=5e-9), fmt="%.9g")
        self.config.write_text(
            "scan: {pitch_x: 5.0e-9, pitch_y: 5.0e-9}\nhalf_space: {step: 0.01, max_states: "
            "1000000}\n"
        )
        path = self.folder / "rows.csv"
        command = [
            str(part)
            for part in (
                program("stiction_batch"),
                "-c",
                self.config,
                "--half-space",
                "-o",
                path,
                self.small,
                self.large,
            )
        ]
        for _ in range(2):
            process = subprocess.Popen(
                command,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            )
            deadline = time.monotonic() + 300
            while process.poll() is None and (
                not path.exists() or path.read_bytes().count(b"\n") < 2
            ):
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.01)
            time.sleep(0.5)
            began = time.monotonic()
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(timeout=300), -signal.SIGINT)
            self.assertLess(
                time.monotonic() - began, 20.0
            )  # at once; the rest is for busy machines
            rows = self.rows("rows.csv")
            self.assertEqual([row["half_space_status"] for row in rows], ["SOLVED"])

    def test_the_folder_of_a_scan_has_curve_and_maps_at_rest(self):
        self.batch(
            "rows.jsonl", "--half-space", "--dump", self.folder / "dump", inputs=[self.small]
        )
        folder = self.folder / "dump/000001"
        result = json.loads((folder / "result.json").read_text())
        pressure, gap, deformed, before = (
            np.load(str(folder / (name + ".npy")))
            for name in ("half_space_pressure", "half_space_gap", "half_space_deformed", "heights")
        )
        self.assertEqual({pressure.shape, gap.shape, deformed.shape}, {(32, 32)})
        self.assertAlmostEqual(
            (pressure > 0).sum() * 4e-18 / result["half_space_contact_area"], 1.0, places=12
        )
        self.assertAlmostEqual(
            gap.mean(dtype=float) / result["half_space_mean_gap"], 1.0, places=5
        )  # single precision
        self.assertTrue((deformed <= before).all())
        curve = result["half_space_curve"]
        retraction = [
            force for force, way in zip(curve["force"], curve["direction"]) if way == "RETRACTION"
        ]
        self.assertEqual(max(retraction), result["half_space_pull_off_force"])
        self.assertEqual(len(curve["height"]), len(curve["force"]))

    def test_with_a_device_the_row_says_who_judged(self):
        self.config.write_text(
            CONFIG + "half_space: {max_pixels: 1500}\n"
            "device: {spring_stiffness: 1.0e-3, travel: 1.0e-6, contact_area: "
            "4.096e-15}\ndevice_force: {enabled: false}\n"
        )
        self.batch("rows.csv", "--half-space")
        self.batch("plain.csv")
        solved, refused = self.rows("rows.csv")
        plain = self.rows("plain.csv")
        done = run(
            [program("predict_scan"), "--half-space", "--json", "-c", self.config, self.small]
        )
        record = json.loads(done.stdout)
        self.assertEqual((solved["verdict_by"], record["verdict_by"]), ("half_space", "half_space"))
        self.assertEqual((solved["sticks"], solved["reason"]), (record["sticks"], record["reason"]))
        self.assertEqual(
            [float(solved[name]) for name in ("margin", "margin_lower", "margin_upper")],
            [record[name] for name in ("margin", "margin_lower", "margin_upper")],
        )
        self.assertTrue(solved["reason"].startswith("by the half-space: "))
        self.assertEqual(refused["verdict_by"], "prediction")
        self.assertEqual(
            {name: refused[name] for name in ("sticks", "margin", "margin_lower")},
            {name: plain[1][name] for name in ("sticks", "margin", "margin_lower")},
        )
        self.assertIn("the half-space does not count: ", refused["reason"])
        self.assertIn("half_space/max_pixels = 1500", refused["reason"])
        self.assertEqual(
            (plain[0]["verdict_by"], plain[0]["half_space_message"]),
            ("prediction", "no flag asks for it"),
        )
        done = run(
            [
                program("stiction_report"),
                "--half-space",
                "-c",
                self.config,
                "-o",
                self.folder / "r.html",
                self.small,
            ]
        )
        self.assertEqual(done.returncode, 0)
        self.assertRegex(
            done.stderr,
            r"\Astiction_batch: warning: device/contact_area 4\.096e-15 m\^2 is outside the usual "
            r".*\n\Z",
        )
        plain_text = re.sub(
            r"<[^>]+>",
            " ",
            re.sub(r'src="[^"]*"', "", (self.folder / "r.html").read_text(encoding="utf-8")),
        )
        self.assertIn("By the half-space: margin", plain_text)
        self.assertIn("(half-space)", plain_text)

    def test_scans_whose_flags_ask_for_it_are_solved_by_themselves(self):
        surfaces = {"smooth": 4.5e-10, "rough": 5e-9, "large": 4.5e-10}
        for name, rms_height in surfaces.items():
            np.savetxt(
                str(self.folder / (name + ".txt")), rough(72 if name == "large" else 64, rms_height)
            )
        inputs = [self.folder / (name + ".txt") for name in surfaces]
        self.config.write_text(
            "scan: {pitch_x: 1.0e-8, pitch_y: 1.0e-8}\nhalf_space: {max_flagged_pixels: 4096}\n"
            "device: {spring_stiffness: 1.0, travel: 1.0e-6, contact_area: "
            "4.096e-13}\ndevice_force: {enabled: false}\n"
        )
        done = self.batch("rows.csv", "--parts", self.folder / "parts.csv", inputs=inputs)
        self.assertIn("half-space not solved for 1 other\n", done.stdout)
        smooth, unflagged, large = self.rows("rows.csv")
        done = run([program("predict_scan"), "--json", "-c", self.config] + inputs[:1])
        record = json.loads(done.stdout)
        self.assertEqual(
            (smooth["half_space_status"], smooth["half_space_message"], smooth["verdict_by"]),
            ("SOLVED", "", "half_space"),
        )
        self.assertTrue(
            smooth["reason"].startswith("by the half-space, as near_bonding asks for it: "),
            smooth["reason"],
        )
        self.assertEqual(
            (float(smooth["margin"]), smooth["reason"]), (record["margin"], record["reason"])
        )
        self.assertEqual(
            (
                unflagged["half_space_status"],
                unflagged["half_space_message"],
                unflagged["verdict_by"],
            ),
            ("", "no flag asks for it", "prediction"),
        )
        self.assertNotIn("half-space", unflagged["reason"])
        self.assertEqual((large["half_space_status"], large["verdict_by"]), ("", "prediction"))
        self.assertIn(
            "a frame of 72 x 72 pixels is larger than half_space/max_flagged_pixels = 4096",
            large["half_space_message"],
        )
        self.assertIn(
            "near_bonding asks for the half-space, which does not count: a frame of 72 x 72",
            large["reason"],
        )
        # the setting is one of those that rows are made with
        self.config.write_text(
            self.config.read_text().replace("half_space: {", "half_space: {enabled: false, ")
        )
        self.assertIn(
            "other inputs, settings", self.batch("rows.csv", inputs=inputs, status=2).stderr
        )
        self.batch("plain.csv", inputs=inputs)
        self.assertFalse(
            [name for name in self.rows("plain.csv")[0] if name.startswith("half_space")]
        )

    def test_a_report_shows_what_flags_asked_for(self):
        for name, rms_height in (("smooth", 4.5e-10), ("rough", 5e-9)):
            np.savetxt(str(self.folder / (name + ".txt")), rough(64, rms_height))
        self.config.write_text(
            "scan: {pitch_x: 1.0e-8, pitch_y: 1.0e-8}\n"
            "device: {spring_stiffness: 1.0, travel: 1.0e-6, contact_area: "
            "4.096e-13}\ndevice_force: {enabled: false}\n"
        )
        done = run(
            [
                program("stiction_report"),
                "-c",
                self.config,
                "-o",
                self.folder / "r.html",
                self.folder / "smooth.txt",
                self.folder / "rough.txt",
            ]
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, "^stiction_batch: 2 scans state no part_id[^\n]*\n$")
        text = (self.folder / "r.html").read_text(encoding="utf-8")
        plain = re.sub(r"<[^>]+>", " ", re.sub(r'src="[^"]*"', "", text))
        self.assertIn("as near_bonding asks for it", plain)
        self.assertIn("not asked", plain)
        self.assertEqual(plain.count("The whole surface as one elastic half-space"), 1)

    def test_the_report_shows_both_forces_their_ratio_and_what_was_not_solved(self):
        self.config.write_text(CONFIG + "half_space: {max_pixels: 1500}\n")
        done = run(
            [
                program("stiction_report"),
                "--half-space",
                "-c",
                self.config,
                "-o",
                self.folder / "r.html",
                self.small,
                self.large,
            ]
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = (self.folder / "r.html").read_text(encoding="utf-8")
        self.assertEqual(
            text.count("data:image/png;base64,"), 2 * 3 + 1 + 1
        )  # three a scan, one of a half-space, the trends
        plain = re.sub(r"<[^>]+>", " ", re.sub(r'src="[^"]*"', "", text))
        for expected in (
            "Converged: every state is an equilibrium.",
            "esolved: pixels are",
            "pull-off force, half-space",
            "prediction / half-space",
            "Not solved: ",
            "half_space/max_pixels = 1500",
            "not solved",
        ):
            self.assertIn(expected, plain)
        row = self.rows("r.csv")[0]
        ratio = float(row["pull_off_force"]) / float(row["half_space_pull_off_force"])
        self.assertIn("(%.3g)" % ratio, plain)
        self.assertEqual(len(json.loads((self.folder / "r.json").read_text())["scans"]), 2)

    def test_a_report_without_it_does_not_speak_of_it(self):
        run(
            [
                program("stiction_report"),
                "-c",
                self.config,
                "-o",
                self.folder / "r.html",
                self.small,
            ]
        )
        text = (self.folder / "r.html").read_text(encoding="utf-8")
        self.assertNotIn("of the half-space", text)
        self.assertEqual(text.count("data:image/png;base64,"), 3)


class HalfSpaceFigureTest(unittest.TestCase):
    def test_cells_that_share_a_side_are_one_group(self):
        contact = np.array([[1, 1, 0, 0], [0, 1, 0, 1], [1, 0, 0, 1]], dtype=bool)
        groups = sorted(sorted(group) for group in contact_groups(contact))
        self.assertEqual(groups, [[(0, 0), (0, 1), (1, 1)], [(1, 3), (2, 3)], [(2, 0)]])

    def test_without_a_force_there_is_no_ratio(self):
        self.assertEqual(
            pull_off_ratio({"pull_off_force": 6.0, "half_space_pull_off_force": 2.0}), 3.0
        )
        for row in (
            {"pull_off_force": 6.0},
            {"pull_off_force": 6.0, "half_space_pull_off_force": None},
            {"pull_off_force": 6.0, "half_space_pull_off_force": 0.0},
        ):
            self.assertTrue(np.isnan(pull_off_ratio(row)))


if __name__ == "__main__":
    unittest.main()
