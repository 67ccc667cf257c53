#!/usr/bin/env python3
"""A bag of 20 scans through the node: 20 predictions, in order, with the scans' stamps; twice the
same."""

import os
import tempfile
import unittest

import numpy as np
import rosbag
import rospy
import rostest
from mems_stiction.msg import AsperityArray, StictionPrediction
from sensor_msgs.msg import Image
from stiction_client import Collector, Counts, figures, make_bag, play_bag, predict_scan, unlike

COUNT = 20
ROWS, COLS = 60, 80


KINDS = {"32FC1": np.float32, "64FC1": np.float64, "mono8": np.uint8}


def pixels(message):
    return np.frombuffer(message.data, dtype=KINDS[message.encoding]).reshape(
        message.height, message.width
    )


class ReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("replay_test")
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = os.path.join(cls.folder.name, "scans.bag")
        make_bag(
            cls.path,
            "--count",
            str(COUNT),
            "--rows",
            str(ROWS),
            "--cols",
            str(COLS),
            "--rate",
            "40",
            "--rms-height",
            "1e-9",
            "8e-9",
            "--seed",
            "5",
        )
        with rosbag.Bag(cls.path) as bag:
            cls.scans = [message for _, message, _ in bag.read_messages(topics=["/height"])]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_scan_is_predicted_in_order_and_again_the_same(self):
        self.assertEqual(len(self.scans), COUNT)
        counts = Counts()
        predictions = Collector("prediction", StictionPrediction).connect()
        play_bag(self.path)
        first = list(predictions.wait(COUNT))
        counts.wait(
            received=COUNT, predicted=COUNT, dropped=0, rejected=0, waiting=0, missing_by_sequence=0
        )
        self.assertEqual([p.header.stamp for p in first], [s.header.stamp for s in self.scans])
        self.assertEqual([p.header.frame_id for p in first], ["scan"] * COUNT)
        for prediction, scan in zip(first, self.scans):
            self.assertEqual(unlike(prediction, predict_scan(pixels(scan), 1e-6)), [])
        # From 1 nm to 8 nm rms height the area in contact falls.
        self.assertLess(first[-1].contact_fraction, first[0].contact_fraction)

        # Now with every output asked for: the figures stay, bit for bit.
        deformed = Collector("deformed_height", Image).connect()
        counter = Collector("deformed_counter_height", Image).connect()
        contact_maps = Collector("contact_map", Image).connect()
        asperities = Collector("asperities", AsperityArray).connect()
        play_bag(self.path)
        second = predictions.wait(2 * COUNT)[COUNT:]
        self.assertEqual([figures(p) for p in second], [figures(p) for p in first])
        counts.wait(received=2 * COUNT, predicted=2 * COUNT, rejected=0, dropped=0)

        for maps in (deformed, counter, contact_maps, asperities):
            self.assertEqual(
                [m.header.stamp for m in maps.wait(COUNT)], [s.header.stamp for s in self.scans]
            )
        for index, prediction in enumerate(second):
            scan = pixels(self.scans[index]).astype(np.float32)  # as the deformed surface is sent
            after = pixels(deformed.messages[index])
            contact = pixels(contact_maps.messages[index])
            self.assertEqual(deformed.messages[index].encoding, "32FC1")
            self.assertEqual(contact_maps.messages[index].encoding, "mono8")
            self.assertEqual(after.shape, (ROWS, COLS))
            self.assertEqual(contact.shape, (ROWS, COLS))
            self.assertLessEqual(contact.max(), 3)
            # Whole cells stand for the real area, contact by contact.
            self.assertAlmostEqual(
                np.count_nonzero(contact),
                prediction.contact_area / (10e-9 * 10e-9),
                delta=prediction.asperity_count + 0.3 * np.count_nonzero(contact),
            )
            # Only cells in contact change, and they are pressed down.
            self.assertTrue(np.array_equal(after[contact == 0], scan[contact == 0]))
            self.assertLessEqual((after - scan).max(), 0.0)
            self.assertEqual(len(asperities.messages[index].asperities), prediction.asperity_count)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "replay", ReplayTest)
