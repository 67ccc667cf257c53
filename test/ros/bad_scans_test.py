#!/usr/bin/env python3
"""Bad scans between good ones: each is counted with its reason, and the good ones go on."""

import struct
import time
import unittest

import numpy as np
import rospy
import rostest
from dynamic_reconfigure.srv import Reconfigure
from mems_stiction.msg import ScanInfo, StictionPrediction
from mems_stiction.srv import Predict, PredictRequest
from rosgraph_msgs.msg import Log
from rospy.msg import AnyMsg
from sensor_msgs.msg import Image
from stiction_client import (
    BytesPublisher,
    Collector,
    Counts,
    Station,
    bytes_of,
    figures,
    image_message,
    info_message,
    peak_memory,
    process_of,
    rough_surface,
    stating,
    wait_until,
)


class BytesRequest(AnyMsg):
    """Bytes as a hostile client sends them."""

    def __init__(self, data=b""):
        super().__init__()
        self._buff = data


class BytesPredict(Predict):
    _request_class = BytesRequest


class BytesReconfigure(Reconfigure):
    _request_class = BytesRequest


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
            (
                lambda: broken(wrong_encoding),
                "encoding 'rgb8' does not carry heights; accepted: 32FC1",
            ),
            (lambda: broken(cut_off), "data has"),
            (lambda: broken(short_step), "step 8"),
            (lambda: broken(no_pixels), "at least one pixel"),
            (lambda: station.send(np.full_like(surface, np.nan)), "no valid pixel: each is NaN"),
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
            counts.wait(
                received=2 * index + 1, predicted=index + 1, rejected=index, dropped=0, waiting=0
            )
            self.assertIn(reason, counts["last_reason"])
        self.assertTrue(any("rgb8" in text for text in counts.reasons()), counts.reasons())

        # The timeout tells.
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
        self.assertAlmostEqual(
            prediction.nominal_area / ((surface.size - invalid) * 1e-16), 1.0, delta=1e-9
        )

    def test_3_a_sequence_number_that_was_skipped_is_counted(self):
        counts = Counts()
        station = Station()
        missing = int(counts.fresh()["missing_by_sequence"])
        for second, lost in ((6000, 0), (6001, 0), (6002, 3)):
            # rospy numbers what it publishes: numbers that are never sent are scans that a network
            # has lost.
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
            image.data = image.data[: -4 * number]
            station.height.publish(image)
            station.info.publish(info_message(image.header.stamp))
            counts.wait(rejected=rejected + number)
        time.sleep(0.5)
        self.assertLessEqual(
            len([message for message in log.messages if "data has" in message.msg]), 1
        )

    def test_5_messages_that_state_more_than_they_hold_are_counted_and_take_no_memory(self):
        def image(stamp):
            """43 bytes: an image without frame, encoding and pixels."""
            message = Image()
            message.header.stamp = stamp
            return message

        place = len(bytes_of(Image())) - 4  # of the pixels
        counts = Counts()
        predictions = Collector("prediction", StictionPrediction).connect()
        station = Station()
        surface = rough_surface(1)
        process = process_of("prediction")
        before = peak_memory(process)
        hostile = BytesPublisher("height", Image)
        hostile_info = BytesPublisher("scan_info", ScanInfo)
        rejected = int(counts.fresh()["rejected"])
        begin = time.monotonic()
        for second in range(8000, 8005):
            hostile.publish(stating(2**32 - 1, bytes_of(image(rospy.Time(second))), place))
            station.info.publish(info_message(rospy.Time(second)))
        counts.wait(rejected=rejected + 5, waiting=0)
        self.assertIn("states 4294967295 elements", counts["last_reason"])
        hostile_info.publish(bytes_of(info_message(rospy.Time(8005)))[:-1])
        station.height.publish(image_message(surface, rospy.Time(8005)))
        counts.wait(rejected=rejected + 6, waiting=0)
        station.send(surface, rospy.Time(8010))
        self.assertEqual(predictions.of(rospy.Time(8010)).header.stamp, rospy.Time(8010))
        request = PredictRequest(image(rospy.Time(8011)), info_message(rospy.Time(8011)), 0.0, 1e-6)
        refused = rospy.ServiceProxy("stiction_node/predict", BytesPredict)(
            BytesRequest(stating(2**32 - 1, bytes_of(request), place))
        )
        self.assertFalse(refused.success)
        self.assertIn("states 4294967295 elements", refused.message)
        shown = rospy.ServiceProxy("stiction_node/set_parameters", BytesReconfigure)(
            BytesRequest(struct.pack("<I", 10**8) + bytes(16))  # a hundred million flags
        )
        self.assertIn("voltage", [entry.name for entry in shown.config.doubles])
        request.height = image_message(surface, rospy.Time(8011))
        answer = rospy.ServiceProxy("stiction_node/predict", Predict)(request)
        self.assertTrue(answer.success, answer.message)
        self.assertLess(time.monotonic() - begin, 10.0)  # one of them took 13 s and 4.26 GB
        self.assertLess(peak_memory(process) - before, 2**28)
        hostile.end()
        hostile_info.end()


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "bad_scans", BadScansTest)
