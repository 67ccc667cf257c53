#!/usr/bin/env python3
"""An areal sensor whose driver publishes a whole field in each PointCloud2, imitated message for
message: each leads to one prediction, or is named."""

import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

import genpy.dynamic
import numpy as np
import rosbag
import rospy
import rostest
import yaml
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped
from mems_stiction.msg import ScanInfo, StictionPrediction
from roslib.packages import find_node, get_pkg_dir
from sensor_msgs.msg import Image, PointCloud2, PointField
from std_msgs.msg import Float32MultiArray, Header, MultiArrayDimension, MultiArrayLayout, String
from stiction_client import STATION, TIMEOUT, Collector, Counts, wait_until
from tf2_msgs.msg import TFMessage

ROWS, COLS = 48, 64
PITCH = 20e-6  # [m]
FRAME = "gocator_3100_optical_frame"
INVALID = np.finfo(np.float32).min


def surface(seed):
    """ROWS x COLS float32 [m]: a cap on a tilted plane, off the middle, with micrometres of noise;
    row 0 has the largest y, x grows along columns."""
    y, x = np.mgrid[0:ROWS, 0:COLS] * PITCH
    cap = np.maximum(0.0, 2e-5 - ((x - 3e-4) ** 2 + (y - 7e-4) ** 2) / 4e-3)
    return (
        0.01 * x - 0.02 * y + cap + np.random.RandomState(seed).normal(scale=1e-6, size=x.shape)
    ).astype(np.float32)


def snapshot(heights, stamp, frame=FRAME):
    """As the driver of the Gocator 3100 fills it: PCL's PointXYZ in 16 bytes, rows and columns, x
    falls along the columns."""
    points = np.zeros(
        heights.shape, dtype=[("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("padding", "<f4")]
    )
    rows, cols = heights.shape
    points["x"] = ((cols // 2 - np.arange(cols)) * PITCH)[None, :]
    points["y"] = ((rows // 2 - np.arange(rows)) * PITCH)[:, None]
    points["z"] = np.where(np.isnan(heights), INVALID, heights)[:, ::-1]
    message = PointCloud2(
        height=rows,
        width=cols,
        is_bigendian=False,
        point_step=16,
        row_step=16 * cols,
        is_dense=True,
        data=points.tobytes(),
    )
    message.header.stamp, message.header.frame_id = stamp, frame
    message.fields = [
        PointField(name=name, offset=4 * place, datatype=PointField.FLOAT32, count=1)
        for place, name in enumerate("xyz")
    ]
    return message


# The fields of grid_map_msgs/GridMap (ANYbotics, package grid_map, BSD licence): with those of the
# messages in it they give the definition's checksum, which is all that names it on the wire.
GRID_MAP = """grid_map_msgs/GridMapInfo info
string[] layers
string[] basic_layers
std_msgs/Float32MultiArray[] data
uint16 outer_start_index
uint16 inner_start_index
"""
GRID_MAP_INFO = """std_msgs/Header header
float64 resolution
float64 length_x
float64 length_y
geometry_msgs/Pose pose
"""


KINDS = (Header, Float32MultiArray, MultiArrayLayout, MultiArrayDimension, Pose, Point, Quaternion)
TEXTS = dict(
    {"grid_map_msgs/GridMapInfo": GRID_MAP_INFO},
    **{kind._type: kind._full_text.split("=" * 80)[0] for kind in KINDS},
)
GridMap = genpy.dynamic.generate_dynamic(
    "grid_map_msgs/GridMap",  # its text and those of all messages in it, as a bag keeps them
    GRID_MAP + "".join("=" * 80 + "\nMSG: %s\n%s\n" % part for part in TEXTS.items()),
)["grid_map_msgs/GridMap"]


def grid_map(heights, stamp, start=(0, 0)):
    """As grid_map's converter fills it: by columns, x falls along rows and y along columns, from
    where the circular buffer begins."""
    cells = np.roll(heights[:, ::-1].T, start, axis=(0, 1))
    rows, cols = cells.shape
    message = GridMap(layers=["elevation"], basic_layers=["elevation"])
    message.info.header.stamp, message.info.header.frame_id = stamp, "map"
    message.info.resolution = PITCH
    message.info.length_x, message.info.length_y = rows * PITCH, cols * PITCH
    message.info.pose.orientation.w = 1.0
    layer = Float32MultiArray(data=cells.T.ravel())
    layer.layout.dim = [
        MultiArrayDimension("column_index", cols, rows * cols),
        MultiArrayDimension("row_index", rows, rows),
    ]
    message.data = [layer]
    message.outer_start_index, message.inner_start_index = start
    return message


def heights_of(message):
    kind = {"32FC1": np.float32, "64FC1": np.float64}[message.encoding]
    return np.frombuffer(message.data, kind).reshape(message.height, message.width)


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
        cls.counts = Counts("scan_source")
        cls.counts._name = "scan_source: scan_source"
        cls.sensor = rospy.Publisher("/gocator_snapshot", PointCloud2, queue_size=100)
        wait_until(cls.sensor.get_num_connections, "the source to listen")
        cls.counts.wait(waiting=0, found=0)
        wait_until(lambda: not cls.counts["hindered_by"], "the node to listen")

    @classmethod
    def stop(cls):
        if cls.station.poll() is None:
            cls.station.send_signal(signal.SIGINT)
            cls.station.wait(timeout=TIMEOUT)

    def test_1_a_snapshot_of_the_driver_leads_to_a_prediction_of_its_heights(self):
        heights = surface(1)
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
        bad = snapshot(surface(2), rospy.Time(1001))
        bad.data = bad.data[:-1]
        self.sensor.publish(bad)
        nothing = snapshot(np.full((ROWS, COLS), np.nan, np.float32), rospy.Time(1002))
        self.sensor.publish(nothing)
        self.sensor.publish(snapshot(surface(3), rospy.Time(1003)))
        self.predictions.of(rospy.Time(1003))
        told = [message.data for message in self.refused.wait(2)]
        self.assertRegex(told[0], "1001.*data")
        self.assertRegex(told[1], "1002.*measured")
        self.counts.wait(found=4, published=2, refused=2, waiting=0)

    def test_3_a_burst_leads_to_one_prediction_each_in_order(self):
        stamps = [rospy.Time(1100 + number) for number in range(8)]
        for number, stamp in enumerate(stamps):
            self.sensor.publish(snapshot(surface(10 + number), stamp))
        self.predictions.of(stamps[-1])
        found = [
            message.header.stamp
            for message in self.predictions.messages
            if message.header.stamp >= stamps[0]
        ]
        self.assertEqual(found, stamps)
        self.assertEqual(self.counts.fresh()["missing_by_sequence"], "0")

    def test_4_heights_are_taken_in_a_frame_once_its_transform_is_there(self):
        for key, value in dict(
            source="cloud", frame="stage", transform_timeout=3.0, diagnostic_period=0.1
        ).items():
            rospy.set_param("/tf/source/" + key, value)
        source = subprocess.Popen(
            [find_node("mems_stiction", "scan_source")[0], "__name:=source"],
            env=dict(os.environ, ROS_NAMESPACE="/tf"),
        )
        self.addCleanup(source.terminate)
        heights, infos = Collector("/tf/height", Image), Collector("/tf/scan_info", ScanInfo)
        refused = Collector("/tf/source/refused", String).connect()
        counts = Counts()
        counts._name = "tf/source: scan_source"
        sensor = rospy.Publisher("/tf/points", PointCloud2, queue_size=10)
        frames = rospy.Publisher("/tf", TFMessage, queue_size=10)
        wait_until(
            lambda: sensor.get_num_connections() and frames.get_num_connections(),
            "the source to listen",
        )
        wait_until(lambda: counts["found"] == "0" and not counts["hindered_by"], "listeners")
        stamp = rospy.Time(2000)
        sensor.publish(snapshot(surface(4), stamp))
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
            0.25 - surface(4)[::-1, :].astype(float),
            rtol=0,
            atol=1e-12,
        )
        self.assertEqual(len(infos.wait(1)), 1)
        sensor.publish(snapshot(surface(5), rospy.Time(3000), "nowhere"))
        self.assertIn("nowhere", refused.wait(1)[0].data)
        counts.wait(found=2, published=1, refused=1, waiting=0)

    def test_5_a_layer_of_a_grid_map_becomes_a_scan(self):
        for key, value in dict(source="grid_map", diagnostic_period=0.1).items():
            rospy.set_param("/map/source/" + key, value)
        source = subprocess.Popen(
            [find_node("mems_stiction", "scan_source")[0], "__name:=source"],
            env=dict(os.environ, ROS_NAMESPACE="/map"),
        )
        self.addCleanup(source.terminate)
        heights, infos = Collector("/map/height", Image), Collector("/map/scan_info", ScanInfo)
        refused = Collector("/map/source/refused", String).connect()
        counts = Counts()
        counts._name = "map/source: scan_source"
        maps = rospy.Publisher("/map/grid_map", GridMap, queue_size=10)
        wait_until(maps.get_num_connections, "the source to listen")
        wait_until(lambda: counts["found"] == "0" and not counts["hindered_by"], "listeners")
        expected = surface(6)
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

    def test_6_the_recording_has_each_cloud_that_became_a_scan(self):
        sent = {message.header.stamp for message in self.predictions.messages}
        self.stop()
        (bag,) = self.top.glob("day*.bag")
        with rosbag.Bag(str(bag)) as recording:
            stamps = {
                topic: {message.header.stamp for _, message, _ in recording.read_messages([topic])}
                for topic in ("/height", "/prediction")
            }
        self.assertEqual(stamps["/prediction"], stamps["/height"])
        self.assertLessEqual(sent, stamps["/prediction"])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "cloud_source", CloudTest)
