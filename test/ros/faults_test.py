#!/usr/bin/env python3
"""What a station does to a node: ends it by a signal, lets publishers cross, starts a bag again,
storms its services."""

import signal
import subprocess
import sys
import unittest

import rosgraph
import rospy
import rostest
from mems_stiction.msg import StictionPrediction
from roslib.packages import find_node
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    OwnNode,
    Station,
    image_message,
    info_message,
    rough_surface,
    wait_until,
)

# A process of its own that publishes images, and none at all.
PUBLISHER = """
import sys, rospy
from sensor_msgs.msg import Image
rospy.init_node("publisher", anonymous=True)
images = rospy.Publisher(sys.argv[1], Image, queue_size=1)
while images.get_num_connections() == 0: rospy.sleep(0.01)
print("connected", flush=True)
rospy.spin()
"""


class FaultsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("faults_test")

    def test_a_signal_takes_the_node_and_its_services_off_the_master(self):
        master = rosgraph.Master("/faults_test")

        def registered():
            return [
                name
                for kind in master.getSystemState()
                for name, nodes in kind
                if "/ended_node" in nodes
            ]

        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            node = subprocess.Popen(
                [find_node("mems_stiction", "stiction_node")[0], "__name:=ended_node"]
            )
            try:
                rospy.wait_for_service("/ended_node/predict", timeout=TIMEOUT)
                self.assertIn("/ended_node/predict", registered())
                node.send_signal(number)
                self.assertEqual(node.wait(timeout=TIMEOUT), 0, number)
            finally:
                if node.poll() is None:
                    node.kill()
            self.assertEqual(registered(), [], number)

    def test_scans_of_crossing_publishers_and_bags_in_a_loop_are_predicted_once_each(self):
        counts = Counts()
        predictions = Collector("prediction", StictionPrediction).connect()
        station = Station()
        surface = rough_surface(1)
        halves = []
        for scan in range(40):  # two publishers, the one ahead of the other
            a, b = rospy.Time(2000 + scan), rospy.Time(1000 + scan)
            halves += (
                [(a, "image"), (b, "image"), (a, "info"), (b, "info")]
                if scan % 2
                else [(b, "image"), (a, "image"), (a, "info"), (b, "info")]
            )
        for _ in range(3):  # rounds of one bag, without a pause
            halves += [
                (rospy.Time(100 + scan), kind) for scan in range(10) for kind in ("image", "info")
            ]
        for stamp, kind in halves:
            if kind == "image":
                station.height.publish(image_message(surface, stamp))
            else:
                station.info.publish(info_message(stamp))
            rospy.sleep(0.002)
        sent = len(halves) // 2
        wait_until(
            lambda: (
                counts["waiting"] == "0"
                and counts["waiting_for_partner"] == "0"
                and int(counts["received"]) >= sent
            ),
            "the end of the scans",
        )
        rospy.sleep(4.0)  # pairing_timeout is 3 s: whatever were counted twice would be by now
        counts.fresh()
        figures = {
            key: int(counts[key])
            for key in ("received", "predicted", "rejected", "dropped", "missing_by_sequence")
        }
        self.assertEqual(
            figures["predicted"] + figures["rejected"] + figures["dropped"], sent, figures
        )
        self.assertEqual(figures["missing_by_sequence"], 0, figures)
        # Before any stamp went back, the first that crosses may pass for lost. So may the last of a
        # round, since two topics have no common order: the next round's image can come before it.
        self.assertGreaterEqual(figures["predicted"], sent - 3, figures)
        self.assertEqual(len(predictions.messages), figures["predicted"])

    def test_images_cross_before_any_stamp_goes_back_where_others_publish_too(self):
        with OwnNode("crossing", pairing_timeout=TIMEOUT):
            counts = Counts("crossing/node")
            predictions = Collector("/crossing/prediction", StictionPrediction).connect()
            station = Station("/crossing/")
            other = subprocess.Popen(
                [sys.executable, "-c", PUBLISHER, "/crossing/height"], stdout=subprocess.PIPE
            )
            try:
                self.assertEqual(other.stdout.readline(), b"connected\n")
                surface = rough_surface(1)
                for scan in range(20):
                    stamps = [rospy.Time(1000 + scan), rospy.Time(2000 + scan)]
                    for stamp in stamps:
                        station.height.publish(image_message(surface, stamp))
                    counts.wait(waiting_for_partner=2)
                    for stamp in reversed(
                        stamps
                    ):  # the older image waits on while the newer pair passes
                        station.info.publish(info_message(stamp))
                counts.wait(received=40, predicted=40, rejected=0, dropped=0)
                self.assertEqual(
                    len({message.header.stamp for message in predictions.wait(40)}), 40
                )
            finally:
                other.kill()
                other.wait()


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "faults", FaultsTest)
