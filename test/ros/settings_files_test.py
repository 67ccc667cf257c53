#!/usr/bin/env python3
"""The node takes what its configuration file states, whatever ran before under its name, and
refuses what is ambiguous."""

import pathlib
import signal
import subprocess
import tempfile
import unittest

import rospy
import rosservice
import rostest
from mems_stiction.srv import Predict
from roslib.packages import find_node
from stiction_client import (
    TIMEOUT,
    image_message,
    info_message,
    predict_scan,
    rough_surface,
    settings_of,
    unlike,
    wait_until,
)

NODE = "settings_node"
STATION = pathlib.Path(__file__).with_name("station.yaml")
LOAD = 1e-6


class SettingsFilesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("settings_files_test")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.launched = None
        self.addCleanup(self.stop)

    def launch(self, text, *arguments):
        path = self.folder / "part.yaml"
        path.write_text(text)
        self.log = open(str(self.folder / "log"), "w+")
        self.launched = subprocess.Popen(
            [
                "roslaunch",
                "--wait",
                "mems_stiction",
                "stiction.launch",
                "config:=%s" % path,
                "name:=" + NODE,
            ]
            + list(arguments),
            stdout=self.log,
            stderr=subprocess.STDOUT,
            stdin=subprocess.DEVNULL,
        )

    def said(self):
        self.log.flush()
        return (self.folder / "log").read_text()

    def stop(self):
        if self.launched is not None and self.launched.poll() is None:
            self.launched.send_signal(signal.SIGINT)
            self.launched.wait(timeout=TIMEOUT)
        if self.launched is not None:
            self.log.close()
        self.launched = None

    def prediction(self):
        rospy.wait_for_service(NODE + "/predict", timeout=TIMEOUT)
        stamp = rospy.Time(1)
        answer = rospy.ServiceProxy(NODE + "/predict", Predict)(
            image_message(rough_surface(1), stamp), info_message(stamp), 0.0, LOAD
        )
        self.assertTrue(answer.success, answer.message)
        return answer.prediction

    def test_nothing_of_an_earlier_launch_acts(self):
        plain = STATION.read_text()
        self.launch(
            plain + "preprocessing: {level: plane, low_pass: {cutoff_wavelength: 2.0e-7}}\n"
        )
        smoothed = self.prediction()
        self.stop()
        self.launch(plain)
        prediction = self.prediction()
        self.assertEqual(prediction.preprocessing, [])
        cleaning = {"level": "plane", "low_pass": {"cutoff_wavelength": 2e-7}}
        self.assertEqual(
            unlike(
                smoothed,
                predict_scan(rough_surface(1), LOAD, settings=settings_of(preprocessing=cleaning)),
                ["preprocessing"],
            ),
            [],
        )
        self.assertEqual(unlike(prediction, predict_scan(rough_surface(1), LOAD)), [])

    def test_what_the_file_states_lies_beside_the_node_for_scripts(self):
        self.launch(STATION.read_text())
        self.prediction()
        self.assertEqual(rospy.get_param(NODE + "/interface/insulator_thickness"), 100e-9)
        self.assertEqual(rospy.get_param(NODE + "/load/max_voltage"), 50.0)

    def test_a_section_that_stands_twice_ends_the_node(self):
        self.launch(
            "preprocessing: {level: plane}\nload: {max_voltage: 5}\npreprocessing: {fill: "
            "{enabled: true}}\n"
        )
        wait_until(
            lambda: "preprocessing: given in line 3 and before in line 1" in self.said(),
            "the refusal",
        )

    def test_keys_that_rosparam_loaded_for_an_earlier_run_are_named(self):
        def started(text):
            """What it says and its status once it has ended by itself, or None for the status once
            it serves."""
            (self.folder / "part.yaml").write_text(text)
            subprocess.run(
                ["rosparam", "load", str(self.folder / "part.yaml"), "/loaded_node"],
                check=True,
                timeout=TIMEOUT,
            )
            node = subprocess.Popen(
                [find_node("mems_stiction", "stiction_node")[0], "__name:=loaded_node"],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                universal_newlines=True,
            )
            wait_until(
                lambda: (
                    node.poll() is not None
                    or "/loaded_node/get_load" in rosservice.get_service_list()
                ),
                "the node",
            )
            if node.poll() is not None:
                return node.communicate()[0], node.returncode
            node.send_signal(signal.SIGINT)
            return node.communicate(timeout=TIMEOUT)[0], None

        self.assertIsNone(started("load: {mechanical_load: 1.0e-6, max_voltage: 5.0}")[1])
        said, status = started("load: {max_voltage: 6.0}")
        self.assertEqual(status, 1, said)
        self.assertIn("load/mechanical_load", said)
        self.assertIn("rosparam delete", said)
        rospy.delete_param("/loaded_node")
        self.assertIsNone(started("load: {max_voltage: 6.0}")[1])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "settings_files", SettingsFilesTest)
