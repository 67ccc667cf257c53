#!/usr/bin/env python3
"""A run of the node, recorded by rosbag with all its topics: what bag_to_mcap makes of it reads
back, with the library of ROS 2's side."""

import collections
import importlib.util
import pathlib
import signal
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from mems_stiction.msg import AsperityArray, StictionPrediction
from mems_stiction.ros2_messages import as_ros2, schema_name
from mems_stiction.srv import SetLoad
from roslib.packages import find_node
from sensor_msgs.msg import Image
from stiction_client import (
    TIMEOUT,
    Collector,
    Station,
    rough_surface,
    wait_for_listener,
    wait_until,
)

COUNT = 3
SENT = ("/height", "/scan_info")
RECORDED = SENT + ("/prediction", "/deformed_height", "/asperities")


def same(found, value):
    """A decoded message of ROS 2 against the dictionary that was written."""
    if isinstance(value, dict):
        return all(
            same(getattr(found, name), item) for name, item in value.items() if name != "seq"
        )
    if isinstance(value, (list, tuple, bytes)):
        return len(found) == len(value) and all(same(*pair) for pair in zip(found, value))
    return found == value or (found != found and value != value)


class RecordingTest(unittest.TestCase):
    def record(self, path):
        """What the node does with scans and a change of its load."""
        predictions = Collector("prediction", StictionPrediction).connect()
        outputs = [
            Collector("deformed_height", Image).connect(),
            Collector("asperities", AsperityArray).connect(),
        ]
        station = Station()
        recorder = subprocess.Popen(
            ["rosbag", "record", "--quiet", "-a", "-O", str(path), "__name:=recorder"],
            stdin=subprocess.DEVNULL,
        )
        self.addCleanup(recorder.kill)
        for topic in RECORDED:
            if topic not in SENT:
                wait_for_listener(topic, "/recorder")
        wait_until(
            lambda: all(
                sender.get_num_connections() == 2 for sender in (station.height, station.info)
            ),
            "the recorder to listen to scans",
        )
        for seed in range(COUNT):
            station.send(rough_surface(seed))
        predictions.wait(COUNT)
        self.assertTrue(rospy.ServiceProxy("stiction_node/set_load", SetLoad)(0.0, 3e-6).success)
        for collector in outputs:
            collector.wait(COUNT)
        rospy.sleep(1.5)  # diagnostics come once a second
        recorder.send_signal(signal.SIGINT)
        recorder.wait(TIMEOUT)
        wait_until(
            path.exists, "the bag under its own name"
        )  # the recorder behind rosbag closes it
        return predictions.messages

    @unittest.skipIf(importlib.util.find_spec("mcap_ros2") is None, "not installed: mcap_ros2")
    def test_a_recorded_run_reads_back_from_mcap(self):
        from mcap_ros2.reader import read_ros2_messages

        rospy.init_node("recording_test")
        with tempfile.TemporaryDirectory() as folder:
            bag, recording = pathlib.Path(folder) / "run.bag", pathlib.Path(folder) / "run.mcap"
            live = self.record(bag)
            subprocess.run(
                [find_node("mems_stiction", "bag_to_mcap")[0], "-o", str(recording), str(bag)],
                check=True,
                timeout=TIMEOUT,
                stdout=subprocess.DEVNULL,
            )
            with rosbag.Bag(str(bag)) as content:
                written = list(content.read_messages())
            read = list(read_ros2_messages(str(recording)))
        counts = collections.Counter(topic for topic, _, _ in written)
        self.assertEqual(
            {topic: min(counts[topic], COUNT) for topic in RECORDED}, dict.fromkeys(RECORDED, COUNT)
        )
        for topic in ("/diagnostics", "/rosout", "/stiction_node/parameter_updates"):
            self.assertGreater(counts[topic], 0, topic)
        self.assertEqual(len(read), len(written))
        for found, (topic, message, time) in zip(read, written):
            self.assertEqual(
                (found.channel.topic, found.schema.name, found.log_time_ns),
                (topic, schema_name(message._type), time.to_nsec()),
            )
            self.assertTrue(
                same(found.ros_msg, as_ros2(message)), "%s\n%s" % (found.ros_msg, message)
            )
        forces = [
            found.ros_msg.pull_off_force for found in read if found.channel.topic == "/prediction"
        ]
        self.assertEqual(forces, [prediction.pull_off_force for prediction in live])
        self.assertGreater(min(forces), 0.0)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "recording", RecordingTest)
