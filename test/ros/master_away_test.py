#!/usr/bin/env python3
"""A roscore of the test's own is killed, stopped and started again while the node is asked to
change its load, to predict and to end."""

import signal
import subprocess
import threading
import time
import unittest

from own_roscore import Roscore  # isort: skip: before rospy reads ROS_MASTER_URI

import numpy as np
import rospy
import rostest
import yaml
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import GetLoad, Predict, SetLoad, SetVoltage
from roslib.packages import find_node
from stiction_client import (
    SANITIZER,
    STATION,
    TIMEOUT,
    Collector,
    Counts,
    Station,
    image_message,
    info_message,
    processor_seconds,
    resident_bytes,
    rough_surface,
    thread_count,
    wait_until,
)
from std_srvs.srv import Trigger

LOAD = 1e-6
IDLE = 2  # threads at most that wait for calls at rest
MB = 1e6
# The node gives itself 4 s; the rest is for busy machines, and for a sanitizer that looks for leaks
# at the end.
ENDS_WITHIN = 60.0 if SANITIZER is None else 200.0


class Node:
    """A node at the test's own master, with persistent connections to its services, which need no
    master."""

    running = []

    def __init__(self, **more):
        rospy.delete_param("/stiction_node") if rospy.has_param("/stiction_node") else None
        for key, value in dict(yaml.safe_load(STATION.read_text()), **more).items():
            rospy.set_param("/stiction_node/" + key, value)
        self.process = subprocess.Popen(
            [find_node("mems_stiction", "stiction_node")[0]],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            universal_newlines=True,
        )
        self.running.append(self.process)
        rospy.wait_for_service("/stiction_node/set_load", timeout=TIMEOUT)

    def proxy(self, name, kind):
        return rospy.ServiceProxy("/stiction_node/" + name, kind, persistent=True)

    def resident(self):
        return resident_bytes(self.process)

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


class Background(threading.Thread):
    """Makes a call, and keeps what it was answered, and when."""

    def __init__(self, call, *arguments):
        super().__init__(daemon=True)
        self._call, self._arguments = call, arguments
        self.answer = self.answered = None
        self.start()

    def run(self):
        try:
            self.answer = self._call(*self._arguments)
        except (
            Exception
        ) as error:  # for who asks what became of it: a node that ends leaves it unanswered
            self.answer = error
        self.answered = time.monotonic()

    def __repr__(self):
        if self.answered is None:
            return "waits"
        return "answered: %s %s" % (
            type(self.answer).__name__,
            getattr(self.answer, "message", self.answer),
        )


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
        for away in (
            "stopped",
            "killed",
        ):  # what a test process has registered, the master that comes next does not know
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
                call = Background(set_load, voltage, LOAD)
                call.join(TIMEOUT)  # a call that waits for this master waits for ever
                self.assertTrue(call.answered and call.answer.success, "%s: %r" % (away, call))
            station.height.publish(
                image_message(rough_surface(1), station.stamp(), encoding="rgb8")
            )
            station.info.publish(info_message(rospy.Time(1000 + station.count())))  # a warning, too
            self.predicts_all(station, predictions, 20)
            time.sleep(5.0)
            self.predicts_all(station, predictions, 20)
            self.roscore.start() if away == "killed" else self.roscore.go_on()
            self.predicts_all(station, predictions, 100)
            self.assertEqual(get_load().voltage, 3.0)
            # The parameters follow once the master takes them.
            wait_until(
                lambda: rospy.get_param("/stiction_node/reconfigure/voltage", 0.0) == 3.0,
                "the mirror of the load",
            )
            counts.wait(predicted=150, rejected=1, dropped=0)
            self.assertLess(node.resident() - before, 100 * MB)
            self.assertNotIn("without having finished", node.end(self), away)

    def test_2_a_signal_ends_the_node_whatever_the_master_does(self):
        # each signal with each state of the master once or more: they meet in one handler
        for number, away in (
            (signal.SIGINT, "there"),
            (signal.SIGINT, "stopped"),
            (signal.SIGINT, "killed"),
            (signal.SIGTERM, "stopped"),
            (signal.SIGHUP, "killed"),
        ):
            node = Node()
            set_load = node.proxy("set_load", SetLoad)
            set_load(1.0, LOAD)
            if away == "stopped":
                self.roscore.stop()
            elif away == "killed":
                self.roscore.kill()
            Background(set_load, 2.0, LOAD).join(1.0)  # on its way to the master, or done
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
                node = subprocess.Popen(
                    [program, "__name:=waiting"],
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                )
                time.sleep(2.0)
                node.send_signal(signal.SIGTERM)
                try:
                    node.wait(timeout=ENDS_WITHIN)
                finally:
                    node.kill()
            finally:
                self.roscore.start() if away == "killed" else self.roscore.go_on()

    def test_4_calls_that_wait_keep_no_other_waiting(self):
        timeout = 15.0
        node = Node(
            **{"counter_surface/frame": "upper", "counter_surface/transform_timeout": timeout}
        )
        get_load = node.proxy("get_load", GetLoad)
        reset = node.proxy("reset_surface", Trigger)
        set_voltage = node.proxy("set_voltage", SetVoltage)
        get_load_too = node.proxy("get_load", GetLoad)
        get_load(), get_load_too(), reset()
        surface = rough_surface(1)
        threads = thread_count(node.process)
        waiting = [
            Background(
                node.proxy("predict", Predict),
                image_message(surface, rospy.Time(5)),
                info_message(rospy.Time(5)),
                0.0,
                LOAD,
            )
            for _ in range(40)
        ]
        wait_until(
            lambda: thread_count(node.process) >= threads + len(waiting) - IDLE,
            "a thread of the node for each call",
        )
        # each by its own connection: two threads on one would take each other's answers
        others = [
            Background(call) for call in (get_load, reset, lambda: set_voltage(3.0), get_load_too)
        ]
        for call in others:
            call.join(TIMEOUT)
        for call in waiting:
            call.join(2 * timeout + TIMEOUT)
        first, last = min(call.answered for call in waiting), max(call.answered for call in waiting)
        self.assertLess(
            max(call.answered for call in others), first, others
        )  # before any that waits for its transform
        self.assertLess(last - first, timeout)  # all waited at once, not one after the other
        self.assertEqual(
            [call for call in waiting if "no transform" not in call.answer.message], []
        )
        node.end(self)

    def test_5_long_predictions_keep_no_call_waiting_that_does_not_need_the_core(self):
        # as many steps as there may be, so small that none is the last: a minute of work
        node = Node(
            **{"approach/formulation": "paper", "approach/max_steps": 10000000, "paper/step": 1e-21}
        )
        get_load = node.proxy("get_load", GetLoad)
        get_load()
        surface = np.random.RandomState(1).normal(0.0, 2e-9, (1024, 1024)).astype(np.float32)
        before, threads = processor_seconds(node.process), thread_count(node.process)

        def predicted():
            return Background(
                node.proxy("predict", Predict),
                image_message(surface, rospy.Time(5)),
                info_message(rospy.Time(5)),
                0.0,
                1e-3,
            )

        waiting = [predicted()]
        wait_until(
            lambda: waiting[0].answered or processor_seconds(node.process) > before + 0.5,
            "the core to be at it",
        )
        waiting += [predicted() for _ in range(2)]
        waiting += [Background(node.proxy("set_load", SetLoad), 1.0, LOAD) for _ in range(3)]
        wait_until(
            lambda: (
                thread_count(node.process) >= threads + len(waiting) - IDLE
                or any(call.answered for call in waiting)
            ),
            "a thread of the node for each call",
        )
        get_load()
        self.assertEqual(
            [call for call in waiting if call.answered],
            [],
            "calls were answered before the prediction at hand had ended",
        )
        self.assertIn("without having finished", node.end(self))


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "master_away", MasterAwayTest)
