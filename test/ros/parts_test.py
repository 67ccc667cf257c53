#!/usr/bin/env python3
"""A recording of scans of two parts through the node: what part_verdict says is what stiction_batch
pools of the same scans, to the bit."""

import json
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import rosbag
import rospy
import rostest
from mems_stiction.msg import PartVerdict, StictionPrediction
from mems_stiction.srv import SetMechanicalLoad
from roslib.packages import find_node
from stiction_client import NODE_KEYS, TIMEOUT, Collector, Counts, make_bag, play_bag

# of each scan; the first part comes back after the second, and the last scan states none
IDS = [
    ("lot 3", "0012"),
    ("lot 3", "0012"),
    ("lot 3", "0013"),
    ("lot 3", "0012"),
    ("lot 3", "0013"),
    ("lot 3", "0012"),
    ("", ""),
]
FIGURES = ["scan_count", "counted_scans", "regime_flags"] + [
    name % ratio
    for ratio in ("margin", "peel_number")
    for name in ("%s", "%s_lower", "%s_upper", "%s_spread", "%s_place_spread", "worst_%s")
]
STICKS = {"no": 0, "marginal": 1, "yes": 2, "unknown": 3}


class PartsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("parts_test")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.bag = str(cls.folder / "parts.bag")
        plain = str(cls.folder / "scans.bag")
        make_bag(
            plain,
            "--count",
            str(len(IDS)),
            "--rows",
            "96",
            "--cols",
            "96",
            "--rate",
            "20",
            "--rms-height",
            "3e-9",
            "6e-9",
            "--seed",
            "5",
        )
        with rosbag.Bag(cls.bag, "w") as target, rosbag.Bag(plain) as source:
            places = {}
            for topic, message, stamp in source.read_messages():
                place = places.setdefault(message.header.stamp, len(places))
                if topic == "/scan_info":
                    message.part_id, message.serial_id = IDS[place]
                    message.scan_name = "place %d" % (place + 1)
                target.write(topic, message, stamp)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.parts = Collector("part_verdict", PartVerdict).connect()
        cls.counts = Counts()

    def batch(self, load):
        """Rows of the parts by stiction_batch, by serial number."""
        config = (pathlib.Path(__file__).parent / "device_station.yaml").read_text()
        config = "".join(
            line + "\n" for line in config.splitlines() if line.split(":")[0] not in NODE_KEYS
        )
        (self.folder / "config.yaml").write_text(config)
        rows, parts = (
            str(self.folder / ("%s%g.jsonl" % (name, load))) for name in ("rows", "parts")
        )
        subprocess.run(
            [
                find_node("mems_stiction", "stiction_batch")[0],
                "-c",
                str(self.folder / "config.yaml"),
                "--load",
                repr(load),
                "-o",
                rows,
                "--parts",
                parts,
                self.bag,
            ],
            check=True,
            timeout=TIMEOUT,
            stdout=subprocess.DEVNULL,
        )
        with open(parts) as stream:
            return {row["serial_id"]: row for row in map(json.loads, stream)}

    def play(self):
        """The recording once: its messages on part_verdict."""
        scans, before = len(self.predictions.messages), len(self.parts.messages)
        play_bag(self.bag)
        self.predictions.wait(scans + len(IDS))
        return self.parts.wait(before + len(IDS) - 1)[before:]

    def assert_same(self, message, row):
        for name in FIGURES:
            value = getattr(message, name)
            self.assertEqual(None if np.isnan(value) else value, row[name], name)
        self.assertEqual(message.sticks, STICKS[row["sticks"]])
        self.assertEqual(message.settings_hash, row["settings_hash"])
        self.assertEqual(message.verdict_by, row["verdict_by"])
        self.assertEqual(", ".join(message.flags), row["regime_flag_names"])
        # the rows have their number behind the name
        self.assertEqual(message.worst_margin_scan, row["worst_margin_scan"].rsplit(" (", 1)[0])

    def test_1_each_scan_of_a_part_brings_its_verdict_and_that_is_the_batchs_to_the_bit(self):
        messages = self.play()
        stamps = [prediction.header.stamp for prediction in self.predictions.messages]
        self.assertEqual([message.header.stamp for message in messages], stamps[:-1])
        self.assertEqual([(message.part_id, message.serial_id) for message in messages], IDS[:-1])
        self.assertEqual([message.scan_count for message in messages], [1, 2, 1, 3, 2, 4])
        expected = self.batch(1e-6)
        self.assertEqual(sorted(expected), ["0012", "0013"])
        for message in (messages[5], messages[4]):
            self.assert_same(message, expected[message.serial_id])
        self.assertTrue(messages[5].margin_lower < messages[5].margin < messages[5].margin_upper)
        self.assertGreater(messages[5].margin_spread, 0.0)

        first = self.predictions.messages[0]  # one scan says what it says itself
        for name in (
            "margin",
            "margin_lower",
            "margin_upper",
            "sticks",
            "reason",
            "regime_flags",
            "settings_hash",
            "version",
            "scan_name",
        ):
            self.assertEqual(getattr(messages[0], name), getattr(first, name), name)

    def test_2_who_comes_late_finds_the_last_and_a_recording_that_is_played_again_counts_once(self):
        late = Collector("part_verdict", PartVerdict)
        last = late.wait(1)[0]
        self.assertEqual((last.serial_id, last.scan_count), ("0012", 4))
        late.close()
        again = self.play()
        self.assertEqual([message.scan_count for message in again], [4, 4, 2, 4, 2, 4])
        self.assertEqual([again[5].margin, again[5].margin_lower], [last.margin, last.margin_lower])

    def test_3_other_settings_are_another_pool(self):
        before = self.parts.messages[-1].settings_hash
        set_load = rospy.ServiceProxy("stiction_node/set_mechanical_load", SetMechanicalLoad)
        self.assertTrue(set_load(2e-6).success)
        messages = self.play()
        self.assertEqual([message.scan_count for message in messages], [1, 2, 1, 3, 2, 4])
        self.assertNotEqual(messages[5].settings_hash, before)
        self.assert_same(messages[5], self.batch(2e-6)["0012"])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "parts", PartsTest)
