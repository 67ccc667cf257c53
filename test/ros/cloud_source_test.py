#!/usr/bin/env python3
"""An areal sensor whose driver publishes a whole field in each PointCloud2, imitated message for
message: each leads to one prediction, or is named."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

import numpy as np
import rospy
import rostest
import yaml
from geometry_msgs.msg import TransformStamped
from instrument_drivers import (
    COLS,
    FRAME,
    PITCH,
    ROWS,
    GridMap,
    field,
    grid_map,
    heights_of,
    snapshot,
)
from mems_stiction.msg import ScanInfo, StictionPrediction
from roslib.packages import find_node, get_pkg_dir
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image, PointCloud2
from std_msgs.msg import String
from stiction_client import (
    STATION,
    TIMEOUT,
    BytesPublisher,
    Collector,
    bytes_of,
    peak_memory,
    recorded_stamps,
    source_counts,
    stating,
    wait_until,
)
from tf2_msgs.msg import TFMessage


class CloudTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("cloud_source_test")
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.top = pathlib.Path(temporary.name)
        config = yaml.safe_load(STATION.read_text())
        config["preprocessing"] = dict(level="plane")
        (cls.top / "config.yaml").write_text(yaml.safe_dump(config))
        cls.station = subprocess.Popen(
            [
                "roslaunch",
                get_pkg_dir("mems_stiction") + "/launch/station.launch",
                "config:=%s/config.yaml" % cls.top,
                "points:=/gocator_snapshot",
                "source_config:=%s/config/source_areal.yaml" % get_pkg_dir("mems_stiction"),
                "page:=false",
                "bag_prefix:=%s/day" % cls.top,
            ],
            env=dict(os.environ, ROS_HOME=str(cls.top)),
        )
        cls.addClassCleanup(cls.stop)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.heights = Collector("height", Image).connect()
        cls.infos = Collector("scan_info", ScanInfo).connect()
        cls.refused = Collector("scan_source/refused", String).connect()
        cls.counts = source_counts()
        cls.sensor = rospy.Publisher("/gocator_snapshot", PointCloud2, queue_size=100)
        wait_until(cls.sensor.get_num_connections, "the source to listen")
        cls.counts.wait(waiting=0, found=0)
        cls.counts.wait_for_listeners()

    def own_source(self, name, **parameters):
        """One in a namespace of its own until the test ends: its process and its books."""
        for key, value in dict(parameters, diagnostic_period=0.1).items():
            rospy.set_param("/%s/source/%s" % (name, key), value)
        process = subprocess.Popen(
            [find_node("mems_stiction", "scan_source")[0], "__name:=source"],
            env=dict(os.environ, ROS_NAMESPACE="/" + name),
        )
        self.addCleanup(process.terminate)
        return process, source_counts(name + "/source")

    @classmethod
    def stop(cls):
        if cls.station.poll() is None:
            cls.station.send_signal(signal.SIGINT)
            cls.station.wait(timeout=TIMEOUT)

    def test_1_a_snapshot_of_the_driver_leads_to_a_prediction_of_its_heights(self):
        heights = field(1)
        heights[3, 5:9] = np.nan
        self.sensor.publish(snapshot(heights, rospy.Time(1000, 5)))
        prediction = self.predictions.wait(1)[0]
        self.assertEqual(prediction.header.stamp, rospy.Time(1000, 5))
        self.assertEqual(prediction.header.frame_id, FRAME)
        sent = self.heights.of(prediction.header.stamp)
        self.assertEqual(sent.encoding, "32FC1")
        np.testing.assert_array_equal(heights_of(sent), heights)
        info = self.infos.of(prediction.header.stamp)
        np.testing.assert_allclose([info.pitch_x, info.pitch_y], PITCH, rtol=1e-6)
        self.assertAlmostEqual(prediction.invalid_fraction, 4 / heights.size)
        self.counts.wait(found=1, published=1, refused=0, waiting=0)

    def test_2_what_is_no_cloud_of_heights_is_named_and_the_next_goes_on(self):
        bad = snapshot(field(2), rospy.Time(1001))
        bad.data = bad.data[:-1]
        self.sensor.publish(bad)
        nothing = snapshot(np.full((ROWS, COLS), np.nan, np.float32), rospy.Time(1002))
        self.sensor.publish(nothing)
        self.sensor.publish(snapshot(field(3), rospy.Time(1003)))
        self.predictions.of(rospy.Time(1003))
        told = [message.data for message in self.refused.wait(2)]
        self.assertRegex(told[0], "1001.*data")
        self.assertRegex(told[1], "1002.*measured")
        self.counts.wait(found=4, published=2, refused=2, waiting=0)

    def test_3_a_burst_leads_to_one_prediction_each_in_order(self):
        stamps = [rospy.Time(1100 + number) for number in range(8)]
        for number, stamp in enumerate(stamps):
            self.sensor.publish(snapshot(field(10 + number), stamp))
        self.predictions.of(stamps[-1])
        found = [
            message.header.stamp
            for message in self.predictions.messages
            if message.header.stamp >= stamps[0]
        ]
        self.assertEqual(found, stamps)
        self.assertEqual(self.counts.fresh()["missing_by_sequence"], "0")

    def test_4_heights_are_taken_in_a_frame_once_its_transform_is_there(self):
        _, counts = self.own_source("tf", source="cloud", frame="stage", transform_timeout=3.0)
        heights, infos = Collector("/tf/height", Image), Collector("/tf/scan_info", ScanInfo)
        refused = Collector("/tf/source/refused", String).connect()
        sensor = rospy.Publisher("/tf/points", PointCloud2, queue_size=10)
        frames = rospy.Publisher("/tf", TFMessage, queue_size=10)
        wait_until(
            lambda: sensor.get_num_connections() and frames.get_num_connections(),
            "the source to listen",
        )
        counts.wait_for_listeners()
        stamp = rospy.Time(2000)
        sensor.publish(snapshot(field(4), stamp))
        counts.wait(waiting=1)
        transform = TransformStamped()  # the sensor hangs head down: half a turn about x
        transform.header.stamp, transform.header.frame_id, transform.child_frame_id = (
            stamp,
            "stage",
            FRAME,
        )
        transform.transform.rotation.x = 1.0
        transform.transform.translation.z = 0.25
        frames.publish(TFMessage([transform]))
        self.assertEqual(heights.of(stamp).header.frame_id, "stage")
        np.testing.assert_allclose(
            heights_of(heights.of(stamp)),
            0.25 - field(4)[::-1, :].astype(float),
            rtol=0,
            atol=1e-12,
        )
        self.assertEqual(len(infos.wait(1)), 1)
        sensor.publish(snapshot(field(5), rospy.Time(3000), "nowhere"))
        self.assertIn("nowhere", refused.wait(1)[0].data)
        counts.wait(found=2, published=1, refused=1, waiting=0)

    def test_5_a_layer_of_a_grid_map_becomes_a_scan(self):
        _, counts = self.own_source("map", source="grid_map")
        heights, infos = Collector("/map/height", Image), Collector("/map/scan_info", ScanInfo)
        refused = Collector("/map/source/refused", String).connect()
        maps = rospy.Publisher("/map/grid_map", GridMap, queue_size=10)
        wait_until(maps.get_num_connections, "the source to listen")
        counts.wait_for_listeners()
        expected = field(6)
        expected[4, 7] = np.nan
        maps.publish(grid_map(expected, rospy.Time(4000, 7), start=(5, 17)))
        height = heights.of(rospy.Time(4000, 7))
        np.testing.assert_array_equal(heights_of(height), expected)
        self.assertEqual(height.header.frame_id, "map")
        info = infos.of(height.header.stamp)
        np.testing.assert_allclose([info.pitch_x, info.pitch_y], PITCH, rtol=1e-12)
        bad = grid_map(expected, rospy.Time(4001))
        bad.layers = ["height"]
        maps.publish(bad)
        self.assertRegex(refused.wait(1)[0].data, "grid map of stamp 4001.*'elevation', but height")
        counts.wait(found=2, published=1, refused=1, waiting=0)

    def test_5b_messages_that_state_more_than_they_hold_take_no_memory(self):
        process, counts = self.own_source("hostile", source="cloud")
        heights = Collector("/hostile/height", Image)
        Collector("/hostile/scan_info", ScanInfo)
        log = Collector("/rosout", Log).connect()
        sensor = rospy.Publisher("/hostile/points", PointCloud2, queue_size=10)
        wait_until(sensor.get_num_connections, "the source to listen")
        counts.wait_for_listeners()
        sensor.publish(snapshot(field(7), rospy.Time(5000)))
        heights.of(rospy.Time(5000))
        before = peak_memory(process.pid)
        many = 2**26  # texts, of which each takes 32 bytes once it is made
        empty, one = bytes_of(StictionPrediction()), bytes_of(StictionPrediction(warnings=[""]))
        place = next(at for at, (few, more) in enumerate(zip(empty, one)) if few != more)
        answers = BytesPublisher("/hostile/prediction", StictionPrediction)
        answers.publish(stating(many, empty, place))
        wait_until(
            lambda: any("states %d elements" % many in entry.msg for entry in log.messages),
            "a warning of the answer",
        )
        clouds = BytesPublisher("/hostile/points", PointCloud2)
        cloud = bytes_of(PointCloud2())
        clouds.publish(stating(many, cloud, len(cloud) - 5))  # data, then is_dense
        counts.wait(refused=1)
        sensor.publish(snapshot(field(8), rospy.Time(5001)))
        heights.of(rospy.Time(5001))
        self.assertLess(peak_memory(process.pid) - before, 2**28)
        answers.end()
        clouds.end()

    def test_6_the_recording_has_each_cloud_that_became_a_scan(self):
        sent = {message.header.stamp for message in self.predictions.messages}
        self.stop()
        stamps = recorded_stamps(self.top, "/height", "/prediction")
        self.assertEqual(stamps["/prediction"], stamps["/height"])
        self.assertLessEqual(sent, stamps["/prediction"])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "cloud_source", CloudTest)
