"""A disk that fills up while a batch, a report or a curve is written: one line, a status, and nothing that looks whole."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
from roslib.packages import find_node

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
SCANS = 40


class FullDiskTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(self.disk)], stderr=subprocess.PIPE,
                                 universal_newlines=True)
        if mounted.returncode:
            self.skipTest("no small disk: " + mounted.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "--lazy", str(self.disk)], check=True)
        self.config = self.folder / "config.yaml"
        self.config.write_text("load: {mechanical_load: 1.0e-6}\nscan: {pitch_x: 1.0e-8, pitch_y: 1.0e-8}\n")
        random = np.random.RandomState(1)
        self.scans = [self.folder / ("%02d.txt" % number) for number in range(SCANS)]
        for scan in self.scans:
            np.savetxt(str(scan), random.normal(size=(32, 32)) * 1e-9)

    def leave(self, size):
        """So many bytes are free on the disk, in whole pages."""
        status = os.statvfs(str(self.disk))
        (self.disk / "fill").write_bytes(bytes(max(0, status.f_bavail * status.f_frsize - size)))

    def run_program(self, *command):
        done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              stdin=subprocess.DEVNULL, universal_newlines=True, timeout=120)
        self.assertNotIn("Traceback", done.stderr)
        return done

    def batch(self):
        return self.run_program(find_node("mems_stiction", "stiction_batch")[0], "--config", self.config, "--no-cache", "-o",
                                self.disk / "rows.csv", *self.scans)

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
        kept = written[:written.rfind("\n") + 1]
        self.assertTrue(whole.startswith(kept), kept)

    def test_a_curve_is_whole_or_absent(self):
        self.leave(4096)
        done = self.run_program(find_node("mems_stiction", "predict_scan")[0], "--config", self.config, "--curve",
                                self.disk / "curve.csv", self.scans[0])
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"curve\.csv: cannot be written: No space left on device\n$")
        self.assertEqual([path.name for path in self.disk.iterdir()], ["fill"])

    def test_a_report_is_whole_or_absent(self):
        self.leave(4096)
        done = self.run_program(SCRIPTS / "stiction_report", "--config", self.config, "-o", self.disk / "report.html",
                                self.scans[0])
        self.assertEqual(done.returncode, 2)
        self.assertIn("No space left on device", done.stderr)
        self.assertFalse((self.disk / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
