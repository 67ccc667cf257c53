#!/usr/bin/env python3
"""Bad scans between good ones: each is counted with its reason, and the good ones go on."""

import time
import unittest

import numpy as np
import rospy
import rostest
from mems_stiction.msg import StictionPrediction
from rosgraph_msgs.msg import Log
from stiction_client import Collector, Counts, Station, figures, image_message, info_message, rough_surface, wait_until


class BadScansTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("bad_scans_test")

    def test_1_bad_scans_are_counted_and_good_ones_go_on(self):
        counts = Counts()
        predictions = Collector("prediction", StictionPrediction).connect()
        station = Station()
        surface = rough_surface(1)
        counts.wait(received=0)

        def broken(change):
            """A scan whose image was tampered with."""
            stamp = station.stamp()
            image = image_message(surface, stamp)
            change(image)
            station.height.publish(image)
            station.info.publish(info_message(stamp))

        def wrong_encoding(image):
            image.encoding = "rgb8"

        def cut_off(image):
            image.data = image.data[:-4]

        def short_step(image):
            image.step = 8

        def no_pixels(image):
            image.height = image.width = image.step = 0
            image.data = b""

        def lone_image():
            station.height.publish(image_message(surface, station.stamp()))

        def lone_info():
            station.info.publish(info_message(station.stamp()))

        cases = [
            (lambda: broken(wrong_encoding), "encoding 'rgb8' does not carry heights; accepted: 32FC1"),
            (lambda: broken(cut_off), "data has"),
            (lambda: broken(short_step), "step 8"),
            (lambda: broken(no_pixels), "at least one pixel"),
            (lambda: station.send(np.full_like(surface, np.nan)), "no valid pixel"),
            (lambda: station.send(surface, pitch=-1e-9), "scan_info.pitch_x"),
            (lambda: station.send(surface, pitch=float("nan")), "scan_info.pitch_x"),
            (lambda: station.send(surface, pitch=0.0), "pitch"),
            (lone_image, "no scan_info with the stamp"),
            (lone_info, "no scan with the stamp"),
        ]
        expected = [station.send(surface)]
        predictions.wait(1)
        for index, (send_bad, reason) in enumerate(cases, start=1):
            send_bad()
            expected.append(station.send(surface))
            predictions.wait(index + 1)
            counts.wait(received=2 * index + 1, predicted=index + 1, rejected=index, dropped=0, waiting=0)
            self.assertIn(reason, counts["last_reason"])
        self.assertTrue(any("rgb8" in text for text in counts.reasons()), counts.reasons())

        # Without a newer pair, the timeout tells.
        lone_image()
        counts.wait(rejected=len(cases) + 1, waiting=0)
        self.assertIn("within 3 s", counts["last_reason"])

        self.assertEqual([p.header.stamp for p in predictions.messages], expected)
        for prediction in predictions.messages:
            prediction.header = predictions.messages[0].header
        self.assertEqual(len({figures(p) for p in predictions.messages}), 1)

    def test_2_invalid_pixels_are_left_out_and_their_share_is_published(self):
        predictions = Collector("prediction", StictionPrediction).connect()
        station = Station()
        surface = rough_surface(1)
        surface[:12, :] = np.nan
        surface[12, 0] = np.inf
        stamp = rospy.Time(5000)
        station.height.publish(image_message(surface, stamp))
        station.info.publish(info_message(stamp))
        prediction = predictions.wait(1)[0]
        invalid = 12 * surface.shape[1] + 1
        self.assertAlmostEqual(prediction.invalid_fraction, invalid / surface.size, delta=1e-12)
        self.assertAlmostEqual(prediction.nominal_area / ((surface.size - invalid) * 1e-16), 1.0, delta=1e-9)

    def test_3_a_sequence_number_that_was_skipped_is_counted(self):
        counts = Counts()
        station = Station()
        missing = int(counts.fresh()["missing_by_sequence"])
        for second, lost in ((6000, 0), (6001, 0), (6002, 3)):
            # rospy numbers what it publishes: numbers that are never sent are scans that a network has lost.
            station.height.impl.seq += lost
            predicted = int(counts.fresh()["predicted"])
            station.height.publish(image_message(rough_surface(1), rospy.Time(second)))
            station.info.publish(info_message(rospy.Time(second)))
            wait_until(lambda: int(counts["predicted"]) > predicted, "the prediction")
            if second == 6000:
                missing = int(counts["missing_by_sequence"])  # a new publisher counts anew
        self.assertEqual(int(counts["missing_by_sequence"]), missing + 3)

    def test_4_warnings_that_differ_in_their_figures_are_of_one_kind(self):
        log = Collector("/rosout", Log)
        counts = Counts()
        station = Station()
        rejected = int(counts.fresh()["rejected"])
        for number in range(1, 4):
            image = image_message(rough_surface(1), rospy.Time(7000 + number))
            image.data = image.data[:-4 * number]
            station.height.publish(image)
            station.info.publish(info_message(image.header.stamp))
            counts.wait(rejected=rejected + number)
        time.sleep(0.5)
        self.assertLessEqual(len([message for message in log.messages if "data has" in message.msg]), 1)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "bad_scans", BadScansTest)
