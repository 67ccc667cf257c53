#!/usr/bin/env python3
"""Drivers whose stamps do not tell their scans apart: no scan gets the scan_info of another in
silence, and each counts once."""

import time
import unittest

import rospy
import rostest
from mems_stiction.msg import ScanInfo, StictionPrediction
from sensor_msgs.msg import Image
from stiction_client import (
    Collector,
    Counts,
    OwnNode,
    Station,
    image_message,
    info_message,
    rough_surface,
    wait_until,
)

SCANS = 60


class Driver:
    """Names its scans in both halves: the image's frame, and the name that the prediction bears."""

    def __init__(self, prefix, stamps):
        self.station = Station(prefix)
        self.stamps = stamps
        self.surface = rough_surface(1)

    def send(self, number, name, with_image=True, with_info=True):
        stamp = self.stamps(number)
        image, info = image_message(self.surface, stamp), info_message(stamp)
        image.header.frame_id, info.scan_name = name, name
        if with_image:
            self.station.height.publish(image)
        if with_info:
            self.station.info.publish(info)


def without_stamps(_):
    return rospy.Time(0)


class PairingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("pairing_test")

    def check(self, name, stamps, names, lost=(None, None), period=0.05):
        """Sends the scans; gives the predictions and the counts, each prediction with the scan_info
        of its image."""
        with OwnNode(name):
            counts = Counts(name + "/node")
            predictions = Collector("/%s/prediction" % name, StictionPrediction).connect()
            driver = Driver("/%s/" % name, stamps)
            time.sleep(0.5)
            for number in range(SCANS):
                driver.send(number, names(number), number != lost[0], number != lost[1])
                time.sleep(period)
            wait_until(
                lambda: (
                    counts["waiting_for_partner"] == "0"
                    and counts["waiting"] == "0"
                    and counts.total("predicted", "rejected") >= SCANS
                ),
                "the end of the scans",
            )
            time.sleep(4.0)  # whatever were counted twice would be by now
            crossed = [m for m in predictions.messages if m.header.frame_id != m.scan_name]
            self.assertEqual(crossed, [])
            figures = {
                key: int(counts[key]) for key in ("received", "predicted", "rejected", "dropped")
            }
            self.assertEqual(figures["predicted"] + figures["rejected"], SCANS, figures)
            self.assertEqual(figures["received"], SCANS, figures)
            return figures, counts.reasons()

    def test_without_stamps_a_lost_half_crosses_no_scans(self):
        for case, lost in (("image", (10, None)), ("first_image", (0, None)), ("info", (None, 10))):
            figures, reasons = self.check("lost_" + case, without_stamps, str, lost)
            self.assertTrue(any("header.stamp of its own" in reason for reason in reasons), reasons)

    def test_a_stamp_that_was_seen_is_rejected_with_what_to_do(self):
        figures, reasons = self.check("same", lambda _: rospy.Time(1000), lambda _: "one")
        self.assertEqual(figures["predicted"], 1)
        self.assertTrue(any("set use_scan_info to false" in reason for reason in reasons), reasons)

    def test_a_stamp_of_its_own_is_enough_whatever_is_lost(self):
        figures, _ = self.check("stamped", lambda number: rospy.Time(1000 + number), str, (10, 20))
        self.assertEqual(figures["predicted"], SCANS - 2)

    def test_two_publishers_with_one_stamp_are_not_crossed(self):
        with OwnNode("two"):
            counts = Counts("two/node")
            predictions = Collector("/two/prediction", StictionPrediction).connect()
            driver = Driver("/two/", without_stamps)
            time.sleep(0.5)
            for number in range(SCANS):  # the halves of two stations, one among the other
                driver.send(number, "a%d" % number, with_info=False)
                driver.send(number, "b%d" % number, with_info=False)
                driver.send(number, "b%d" % number, with_image=False)
                driver.send(number, "a%d" % number, with_image=False)
                time.sleep(0.02)
            wait_until(
                lambda: counts["waiting_for_partner"] == "0" and int(counts["rejected"] or 0) > 0,
                "the end of the scans",
            )
            counts.wait(received=2 * SCANS, rejected=2 * SCANS, predicted=0)
            self.assertEqual(predictions.messages, [])

    def test_a_half_that_comes_after_ten_timeouts_is_no_scan_of_its_own(self):
        with OwnNode("late", pairing_timeout=0.2):
            counts = Counts("late/node")
            height = rospy.Publisher("/late/height", Image, queue_size=10)
            info = rospy.Publisher("/late/scan_info", ScanInfo, queue_size=10)
            wait_until(
                lambda: height.get_num_connections() and info.get_num_connections(),
                "the node to subscribe",
            )
            stamp = rospy.Time(1000)
            height.publish(image_message(rough_surface(1), stamp))
            counts.wait(received=1, rejected=1)
            time.sleep(3.0)
            info.publish(info_message(stamp))
            counts.wait(waiting_for_partner=0)
            time.sleep(2.0)
            counts.wait(received=1, rejected=1, waiting_for_partner=0)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "pairing", PairingTest)
