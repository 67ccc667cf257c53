"""A disk that fills up while a batch, a report or a curve is written: one line, a status, and
nothing that looks whole."""

import importlib.util
import os
import pathlib
import subprocess
import tempfile
import unittest

import mems_stiction
import numpy as np
from mems_stiction.whole_file import CannotWrite, reason_of
from roslib.packages import find_node

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
SCANS = 40


def has(module):
    """Whether a library of others is installed."""
    return importlib.util.find_spec(module) is not None


class FullDiskTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        mounted = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", "size=128k", "tmpfs", str(self.disk)],
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        if mounted.returncode:
            self.skipTest("no small disk: " + mounted.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "--lazy", str(self.disk)], check=True)
        self.config = self.folder / "config.yaml"
        self.config.write_text(
            "load: {mechanical_load: 1.0e-6}\nscan: {pitch_x: 1.0e-8, pitch_y: 1.0e-8}\n"
        )
        random = np.random.RandomState(1)
        self.scans = [self.folder / ("%02d.txt" % number) for number in range(SCANS)]
        for scan in self.scans:
            np.savetxt(str(scan), random.normal(size=(32, 32)) * 1e-9)

    def leave(self, size):
        """So many bytes are free on the disk, in whole pages."""
        status = os.statvfs(str(self.disk))
        (self.disk / "fill").write_bytes(bytes(max(0, status.f_bavail * status.f_frsize - size)))

    def run_program(self, *command):
        done = subprocess.run(
            [str(part) for part in command],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
            timeout=120,
        )
        self.assertNotIn("Traceback", done.stderr)
        return done

    def batch(self):
        return self.run_program(
            find_node("mems_stiction", "stiction_batch")[0],
            "--config",
            self.config,
            "-o",
            self.disk / "rows.csv",
            *self.scans,
        )

    def test_a_batch_says_so_and_goes_on_when_there_is_room(self):
        self.leave(32768)
        done = self.batch()
        self.assertEqual(done.returncode, 2)
        self.assertIn("No space left on device", done.stderr)
        written = (self.disk / "rows.csv").read_text()
        (self.disk / "fill").unlink()
        done = self.batch()
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = (self.disk / "rows.csv").read_text()
        self.assertEqual(len(whole.splitlines()), 1 + SCANS)
        # What had been written whole was kept.
        kept = written[: written.rfind("\n") + 1]
        self.assertTrue(whole.startswith(kept), kept)

    def test_an_output_that_the_caller_closed_is_not_written_into_the_rows(self):
        device = self.folder / "device.yaml"
        device.write_text(
            self.config.read_text()
            + "device: {spring_stiffness: 10.0, travel: 1.0e-6, contact_area: 1.0e-11}\n"
        )
        for number, closed in enumerate((">&-", "2>&-", "<&- 2>&-")):
            rows = self.folder / ("rows_%d.csv" % number)
            subprocess.run(
                ["sh", "-c", 'exec "$@" ' + closed, "sh"]
                + [find_node("mems_stiction", "stiction_batch")[0], "--no-device-force"]
                + ["--config", device, "-o", rows, *self.scans[:2]],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                timeout=120,
            )
            lines = rows.read_text().splitlines()
            self.assertEqual(len(lines), 3, lines)
            self.assertEqual([line.split(",")[0] for line in lines[1:]], ["1", "2"], closed)

    def test_a_curve_is_whole_or_absent(self):
        self.leave(4096)
        done = self.run_program(
            find_node("mems_stiction", "predict_scan")[0],
            "--config",
            self.config,
            "--curve",
            self.disk / "curve.csv",
            self.scans[0],
        )
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"curve\.csv: cannot be written: No space left on device\n$")
        self.assertEqual([path.name for path in self.disk.iterdir()], ["fill"])

    def test_a_report_is_whole_or_absent(self):
        self.leave(4096)
        done = self.run_program(
            SCRIPTS / "stiction_report",
            "--config",
            self.config,
            "-o",
            self.disk / "report.html",
            self.scans[0],
        )
        self.assertEqual(done.returncode, 2)
        self.assertEqual(
            done.stderr.splitlines()[-1],
            "stiction_report: %s: cannot be written: No space left on device"
            % (self.disk / "report.html"),
        )
        self.assertEqual([path.name for path in self.disk.iterdir()], ["fill"])

    def test_a_bag_is_whole_or_absent_wherever_the_disk_is_full(self):
        """At its head, its first scan, a later one, its index."""
        whole = self.folder / "whole.bag"
        command = [find_node("mems_stiction", "make_scan_bag")[0], "--pitch", "1e-8", "-o"]
        self.assertEqual(self.run_program(*command, whole, *self.scans[:2]).returncode, 0)
        page = os.sysconf("SC_PAGE_SIZE")
        for size in range(0, whole.stat().st_size, page):
            self.leave(size)
            done = self.run_program(*command, self.disk / "scans.bag", *self.scans[:2])
            self.assertEqual(
                (done.returncode, done.stderr),
                (
                    2,
                    "make_scan_bag: %s: cannot be written: No space left on device\n"
                    % (self.disk / "scans.bag"),
                ),
                size,
            )
            self.assertEqual([path.name for path in self.disk.iterdir()], ["fill"], size)
            (self.disk / "fill").unlink()

    def test_a_sweep_or_cycles_are_whole_or_absent(self):
        from mems_stiction.long_run import write_points
        from mems_stiction.msg import CycleContactResult, CyclePoint
        from mems_stiction.station_figures import save_cycles

        result = CycleContactResult(
            cycles=[CyclePoint(cycle=cycle, pull_off_force=cycle / 7) for cycle in range(1000)]
        )
        self.leave(4096)
        writers = {
            "cycles.csv": lambda path: write_points(result.cycles, path, result),
            "cycles.png": lambda path: save_cycles(result, path),
        }
        if has("pyarrow"):
            writers["cycles.parquet"] = writers["cycles.csv"]
        for name, write in writers.items():
            path = str(self.disk / name)
            with self.assertRaises(CannotWrite) as caught:
                write(path)
            self.assertEqual(
                reason_of(caught.exception), path + ": cannot be written: No space left on device"
            )
            self.assertEqual([one.name for one in self.disk.iterdir()], ["fill"])

    def test_maps_are_whole_or_absent(self):
        if not has("h5py"):
            self.skipTest("not installed: h5py")
        prediction = mems_stiction.predict(
            np.random.RandomState(1).normal(size=(64, 64)) * 1e-9,
            1e-8,
            output={"deformed_surfaces": True},
        )
        for size in (0, 4096, 32768):
            self.leave(size)
            with self.assertRaises(CannotWrite) as caught:
                prediction.save_maps(self.disk / "maps.h5")
            self.assertIn("maps.h5: cannot be written: ", reason_of(caught.exception))
            self.assertEqual([one.name for one in self.disk.iterdir()], ["fill"])
            (self.disk / "fill").unlink()

    def test_a_recording_is_whole_or_absent(self):
        if not has("mcap_ros2"):
            self.skipTest("not installed: mcap_ros2")
        bag = self.folder / "scans.bag"
        self.assertEqual(
            self.run_program(
                find_node("mems_stiction", "make_scan_bag")[0],
                "--pitch",
                "1e-8",
                "-o",
                bag,
                *self.scans,
            ).returncode,
            0,
        )
        for size in (0, 4096, 32768):
            self.leave(size)
            done = self.run_program(SCRIPTS / "bag_to_mcap", "-o", self.disk / "scans.mcap", bag)
            self.assertEqual(
                (done.returncode, done.stderr),
                (
                    2,
                    "bag_to_mcap: %s: cannot be written: No space left on device\n"
                    % (self.disk / "scans.mcap"),
                ),
                size,
            )
            self.assertEqual([path.name for path in self.disk.iterdir()], ["fill"], size)
            (self.disk / "fill").unlink()

    def test_what_is_printed_to_a_full_disk_is_said_so(self):
        with self.assertRaises(OSError) as caught, open("/dev/full", "w") as full:
            full.write("x")
            full.flush()
        self.assertEqual(
            reason_of(caught.exception),
            "what is printed cannot be written: No space left on device",
        )


if __name__ == "__main__":
    unittest.main()
