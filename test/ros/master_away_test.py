#!/usr/bin/env python3
"""A roscore of the test's own is killed, stopped and started again while the node is asked to change its load, to predict and to end."""

import pathlib
import signal
import subprocess
import threading
import time
import unittest

from own_roscore import Roscore  # isort: skip: before rospy reads ROS_MASTER_URI

import rospy
import rostest
import yaml
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import GetLoad, Predict, SetLoad, SetVoltage
from roslib.packages import find_node
from stiction_client import (SANITIZER, STATION, Collector, Counts, Station, image_message, info_message, rough_surface,
                             wait_until)
from std_srvs.srv import Trigger

LOAD = 1e-6
MB = 1e6
ENDS_WITHIN = 5.0 if SANITIZER is None else 100.0  # seconds; a sanitizer looks for leaks at the end


class Node:
    """A node at the test's own master, with persistent connections to its services, which need no master."""

    running = []

    def __init__(self, **more):
        rospy.delete_param("/stiction_node") if rospy.has_param("/stiction_node") else None
        for key, value in dict(yaml.safe_load(STATION.read_text()), **more).items():
            rospy.set_param("/stiction_node/" + key, value)
        self.process = subprocess.Popen([find_node("mems_stiction", "stiction_node")[0]], stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, universal_newlines=True)
        self.running.append(self.process)
        rospy.wait_for_service("/stiction_node/set_load", timeout=30.0)

    def proxy(self, name, kind):
        return rospy.ServiceProxy("/stiction_node/" + name, kind, persistent=True)

    def resident(self):
        status = pathlib.Path("/proc/%d/status" % self.process.pid).read_text()
        return 1024 * int(status.split("VmRSS:")[1].split()[0])

    def end(self, test, number=signal.SIGTERM):
        """What it wrote. It must end by itself, in time."""
        self.process.send_signal(number)
        start = time.monotonic()
        try:
            said = self.process.communicate(timeout=ENDS_WITHIN)[0]
        finally:
            if self.process.poll() is None:
                self.process.kill()
        test.assertEqual(self.process.returncode, 0, said)
        test.assertLess(time.monotonic() - start, ENDS_WITHIN)
        return said


def in_background(call, *arguments):
    """A thread that has made the call, and when it was answered."""
    answered = []

    def run():
        call(*arguments)
        answered.append(time.monotonic())

    thread = threading.Thread(target=run, daemon=True)
    thread.answered = answered
    thread.start()
    return thread


class MasterAwayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.roscore = Roscore()
        cls.roscore.start()
        rospy.init_node("master_away_test")

    @classmethod
    def tearDownClass(cls):
        cls.roscore.kill()

    def tearDown(self):
        self.roscore.be_there()
        for node in Node.running:
            if node.poll() is None:
                node.kill()
                node.wait()

    def predicts_all(self, station, predictions, count):
        before = len(predictions.messages)
        for number in range(count):
            station.send(rough_surface(number % 5))
            time.sleep(0.02)
        self.assertEqual(len(predictions.wait(before + count)), before + count)

    def test_1_loads_are_set_and_scans_predicted_while_roscore_is_away(self):
        for away in ("stopped", "killed"):  # what a test process has registered, the master that comes next does not know
            node = Node(max_waiting_memory=100 * MB)
            counts = Counts()
            predictions = Collector("prediction", StictionPrediction).connect()
            station = Station()
            set_load = node.proxy("set_load", SetLoad)
            get_load = node.proxy("get_load", GetLoad)
            self.assertTrue(set_load(1.0, LOAD).success)
            get_load()
            self.predicts_all(station, predictions, 10)
            before = node.resident()
            self.roscore.kill() if away == "killed" else self.roscore.stop()
            for voltage in (2.0, 3.0):
                call = in_background(set_load, voltage, LOAD)
                call.join(1.0)
                self.assertTrue(call.answered, away)
            station.height.publish(image_message(rough_surface(1), station.stamp(), encoding="rgb8"))
            station.info.publish(info_message(rospy.Time(1000 + station.count())))  # a warning, too
            self.predicts_all(station, predictions, 20)
            time.sleep(5.0)
            self.predicts_all(station, predictions, 20)
            self.roscore.start() if away == "killed" else self.roscore.go_on()
            self.predicts_all(station, predictions, 100)
            self.assertEqual(get_load().voltage, 3.0)
            # The parameters follow once the master takes them.
            wait_until(lambda: rospy.get_param("/stiction_node/reconfigure/voltage", 0.0) == 3.0, "the mirror of the load")
            counts.wait(predicted=150, rejected=1, dropped=0)
            self.assertLess(node.resident() - before, 100 * MB)
            self.assertNotIn("without having finished", node.end(self), away)

    def test_2_a_signal_ends_the_node_whatever_the_master_does(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for away in ("there", "stopped", "killed"):
                node = Node()
                set_load = node.proxy("set_load", SetLoad)
                set_load(1.0, LOAD)
                if away == "stopped":
                    self.roscore.stop()
                elif away == "killed":
                    self.roscore.kill()
                in_background(set_load, 2.0, LOAD)
                time.sleep(3.0)
                node.end(self, number)
                if away == "stopped":
                    self.roscore.go_on()
                elif away == "killed":
                    self.roscore.start()

    def test_3_a_signal_ends_a_node_that_waits_for_the_master_to_start(self):
        program = find_node("mems_stiction", "stiction_node")[0]
        for away in ("stopped", "killed"):
            self.roscore.kill() if away == "killed" else self.roscore.stop()
            try:
                node = subprocess.Popen([program, "__name:=waiting"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                time.sleep(2.0)
                node.send_signal(signal.SIGTERM)
                try:
                    node.wait(timeout=ENDS_WITHIN)
                finally:
                    node.kill()
            finally:
                self.roscore.start() if away == "killed" else self.roscore.go_on()

    def test_4_calls_that_wait_keep_no_other_waiting(self):
        frame = {"counter_surface/frame": "upper", "counter_surface/transform_timeout": 6.0}
        node = Node(**frame)
        get_load = node.proxy("get_load", GetLoad)
        reset = node.proxy("reset_surface", Trigger)
        set_voltage = node.proxy("set_voltage", SetVoltage)
        get_load(), reset()
        surface = rough_surface(1)
        waiting = [in_background(node.proxy("predict", Predict), image_message(surface, rospy.Time(5)), info_message(rospy.Time(5)),
                                 0.0, LOAD) for _ in range(40)]
        time.sleep(1.0)
        for call in (get_load, reset, lambda: set_voltage(3.0), get_load):
            start = time.monotonic()
            call()
            self.assertLess(time.monotonic() - start, 0.5)
        self.assertFalse(any(call.answered for call in waiting))
        for call in waiting:
            call.join(30.0)
        first, last = min(call.answered[0] for call in waiting), max(call.answered[0] for call in waiting)
        self.assertLess(last - first, 3.0)  # all waited at once, not one after the other
        node.end(self)

    def test_5_long_predictions_keep_no_call_waiting_that_does_not_need_the_core(self):
        node = Node(**{"approach/formulation": "paper", "approach/max_steps": 5000000, "paper/step": 1e-14})
        get_load = node.proxy("get_load", GetLoad)
        get_load()
        surface = rough_surface(2, rows=256, cols=256, rms_height=2e-8)
        waiting = [in_background(node.proxy("predict", Predict), image_message(surface, rospy.Time(5)), info_message(rospy.Time(5)),
                                 0.0, LOAD) for _ in range(3)]
        waiting += [in_background(node.proxy("set_load", SetLoad), 1.0, LOAD) for _ in range(3)]
        time.sleep(1.0)
        self.assertFalse(any(call.answered for call in waiting))
        start = time.monotonic()
        get_load()
        self.assertLess(time.monotonic() - start, 0.5)
        self.assertIn("without having finished", node.end(self))


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "master_away", MasterAwayTest)
