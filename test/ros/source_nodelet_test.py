#!/usr/bin/env python3
"""Node and source as nodelets of one manager: a scan passes from one to the other within one
process, and is what the command line says of it."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

import rospy
import rostest
from mems_stiction.msg import ScanInfo, StictionPrediction
from roslib.packages import get_pkg_dir
from stiction_client import (
    PITCH,
    STATION,
    TIMEOUT,
    Collector,
    predict_scan,
    process_of,
    rough_surface,
    source_counts,
    unlike,
    wait_until,
    write_grid,
)

# What the file and its clock say, and heights alone do not.
OF_THE_FILE = ("scan_name", "acquisition_time", "checksum", "instrument")


class SourceNodeletTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("source_nodelet_test")
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.top = pathlib.Path(temporary.name)
        cls.folder = cls.top / "scans"
        cls.folder.mkdir()

    def start(self, **arguments):
        given = dict(config=STATION, nodelet="true", page="false", record="false", **arguments)
        self.told = self.top / "told.txt"
        with open(self.told, "w") as stream:
            process = subprocess.Popen(
                ["roslaunch", get_pkg_dir("mems_stiction") + "/launch/station.launch"]
                + ["%s:=%s" % one for one in given.items()],
                env=dict(os.environ, ROS_HOME=str(self.top)),
                stdout=stream,
                stderr=subprocess.STDOUT,
            )

        def end():
            process.send_signal(signal.SIGINT)
            process.wait(timeout=TIMEOUT)

        self.addCleanup(end)

    def put(self, name, heights):
        write_grid(self.folder / name, heights)
        (self.folder / (name + ".yaml")).write_text("pitch_x: %r\npitch_y: %r\n" % (PITCH, PITCH))

    def test_1_a_file_is_predicted_in_one_process(self):
        predictions = Collector("prediction", StictionPrediction)
        infos = Collector("scan_info", ScanInfo)
        counts = source_counts()
        self.start(folder=self.folder)
        surfaces = [rough_surface(1), rough_surface(2)]
        for number, heights in enumerate(surfaces, 1):
            self.put("scan %d.txt" % number, heights)
            prediction = predictions.wait(number)[-1]
            self.assertEqual(prediction.scan_name, "scan %d" % number)
            self.assertEqual(unlike(prediction, predict_scan(heights, load=1e-6), OF_THE_FILE), [])
            self.assertEqual(infos.wait(number)[-1].header.stamp, prediction.header.stamp)
        counts.wait(found=2, published=2, refused=0, waiting=0)
        self.assertEqual(process_of("height"), process_of("prediction"))

    def test_2_with_bad_parameters_it_says_so_and_stays_idle(self):
        bad = self.top / "bad.yaml"
        bad.write_text("source: folder\nsettle_time: -1.0\n")
        self.start(folder=self.folder, source_config=bad)
        wait_until(lambda: "stays idle" in self.told.read_text(), "what it says")
        self.assertIn("parameter ~settle_time", self.told.read_text())


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "source_nodelet", SourceNodeletTest)
