#!/usr/bin/env python3
"""A roscore of the test's own is killed and started again on the same port: while a bag is played
to the node, and as soon as the node answers."""

import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

from own_roscore import Roscore  # isort: skip: before rospy reads ROS_MASTER_URI

import rosgraph
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import GetLoad, SetLoad
from rosgraph_msgs.msg import Log
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    Station,
    make_bag,
    predict_scan,
    rough_surface,
    wait_for_listener,
    wait_until,
)

CONFIG = pathlib.Path(__file__).parent / "station.yaml"
NODELET = "true" in sys.argv
PROCESS = "/stiction_node_manager" if NODELET else "/stiction_node"
LOAD = 1e-6
SCANS = 60


def launch_node():
    return subprocess.Popen(
        [
            "roslaunch",
            "mems_stiction",
            "stiction.launch",
            "config:=%s" % CONFIG,
            "nodelet:=%s" % str(NODELET).lower(),
            "--wait",
        ]
    )


def wait_for_bond():
    """Until the program that loaded the nodelet and the manager hear each other. Without a master
    they would not find each other any more, and the manager would unload the nodelet."""
    statuses = Collector(PROCESS + "/bond", rospy.AnyMsg)

    def speakers():
        names = [message._connection_header["callerid"] for message in statuses.messages]
        return [name for name in set(names) if names.count(name) > 2]

    wait_until(lambda: len(speakers()) == 2, "the bond of loader and manager")


def services_of(process):
    return sorted(
        name
        for name, nodes in rosgraph.Master("/master_test").getSystemState()[2]
        if process in nodes
    )


class MasterTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.roscore = Roscore()
        cls.roscore.start()
        cls.launch = launch_node()
        rospy.init_node("master_test")

    @classmethod
    def tearDownClass(cls):
        cls.launch.send_signal(signal.SIGINT)
        cls.launch.wait(timeout=TIMEOUT)
        cls.roscore.kill()

    def master_reports(self, word=""):
        return [
            status
            for message in self.diagnostics.messages
            for status in message.status
            if status.name == "stiction_node: master" and word in status.message
        ]

    def last_report(self):
        return "one registration, after %d reports, the last: %s" % (
            len(self.master_reports()),
            self.master_reports()[-1],
        )

    def test_a_node_outlives_its_master_and_is_found_at_the_next(self):
        rospy.wait_for_service("/stiction_node/set_load", timeout=TIMEOUT)
        counts = Counts()
        predictions = Collector("prediction", StictionPrediction).connect()
        self.diagnostics = Collector("/diagnostics", DiagnosticArray).connect()
        log = Collector("/rosout", Log)
        station = Station()
        set_load = rospy.ServiceProxy("/stiction_node/set_load", SetLoad, persistent=True)
        self.assertTrue(set_load(3.0, 2 * LOAD).success)
        wait_until(
            lambda: rospy.get_param("/stiction_node/reconfigure/voltage") == 3.0,
            "the mirror of the load",
        )
        stated = rospy.get_param("/stiction_node")
        with_first_master = rosgraph.Master("/master_test").getSystemState()

        with tempfile.TemporaryDirectory() as folder:
            bag = folder + "/scans.bag"
            make_bag(bag, "-n", str(SCANS), "--rate", "5", "--rows", "48", "--cols", "64")
            play = subprocess.Popen(
                ["rosbag", "play", "--quiet", "--wait-for-subscribers", bag],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
            )
            try:
                predictions.wait(5)
                self.roscore.kill()
                wait_until(
                    lambda: self.master_reports("does not answer"),
                    "a report that the master is gone",
                )
                self.assertTrue(set_load(3.0, 2 * LOAD).success)
                # Scans go on without a master. How many are left for the next one depends on the
                # machine.
                predictions.wait(min(len(predictions.messages) + 5, SCANS))
                self.roscore.start()
                rospy.wait_for_service("/stiction_node/get_load", timeout=TIMEOUT)
                play.wait(timeout=TIMEOUT)
            finally:
                if play.poll() is None:
                    play.kill()
        # Every scan of the bag, also those of the time without a master; one prediction each.
        counts.wait(received=SCANS, predicted=SCANS, rejected=0, dropped=0, waiting=0)
        self.assertEqual(len(predictions.wait(SCANS)), SCANS)
        wait_until(
            lambda: self.master_reports("knows this node")[-1].values[0].value == "1",
            self.last_report,
        )
        self.assertTrue([line for line in log.messages if "does not answer" in line.msg])

        # What the master holds is what the first one held.
        def ours(state):
            return [sorted(name for name, nodes in kind if PROCESS in nodes) for kind in state]

        wait_until(
            lambda: (
                ours(rosgraph.Master("/master_test").getSystemState()) == ours(with_first_master)
            ),
            "all registrations",
        )
        self.assertEqual(rospy.get_param("/stiction_node"), stated)
        # Whoever comes now finds the services and the topics, with the load that was set.
        load = rospy.ServiceProxy("/stiction_node/get_load", GetLoad)()
        self.assertEqual((load.voltage, load.mechanical_load), (3.0, 2 * LOAD))
        newcomer = subprocess.Popen(
            ["rostopic", "echo", "-n", "1", "/prediction/pull_off_force"],
            stdout=subprocess.PIPE,
            universal_newlines=True,
        )
        surface = rough_surface(7)
        wait_for_listener("/prediction", "/rostopic")
        stamp = station.send(surface)
        echoed = newcomer.communicate(timeout=TIMEOUT)[0].split()[0]
        record = predict_scan(surface, 2 * LOAD, voltage=3.0)
        last = predictions.wait(SCANS + 1)[-1]
        self.assertEqual(last.header.stamp, stamp)
        self.assertEqual(last.pull_off_force, record["pull_off_force"])
        self.assertEqual(float(echoed), record["pull_off_force"])

    def test_a_node_that_loses_its_master_at_its_first_answer_is_found_with_all_services_at_the_next(  # noqa: E501
        self,
    ):
        cls = type(self)
        cls.launch.send_signal(signal.SIGINT)
        cls.launch.wait(timeout=TIMEOUT)
        cls.launch = launch_node()
        rospy.wait_for_service("/stiction_node/set_load", timeout=TIMEOUT)
        # A service answers only once the node has started: before its first regular look at the
        # master.
        self.assertTrue(rospy.ServiceProxy("/stiction_node/set_load", SetLoad)(2.0, LOAD).success)
        if NODELET:
            wait_for_bond()
        services = services_of(PROCESS)
        self.assertIn("/stiction_node/get_load", services)
        self.roscore.kill()
        self.roscore.start()
        wait_until(lambda: services_of(PROCESS) == services, "all services at the next master")
        load = rospy.ServiceProxy("/stiction_node/get_load", GetLoad)()
        self.assertEqual((load.voltage, load.mechanical_load), (2.0, LOAD))


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "master", MasterTest)
