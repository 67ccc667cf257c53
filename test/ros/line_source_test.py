#!/usr/bin/env python3
"""Line scanners on a stage, whose drivers publish a line in each PointCloud2, imitated message for
message: by tf, joint, speed and count."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rospy
import rostest
import yaml
from instrument_drivers import (
    LINE_PITCH,
    LINES,
    POINT_PITCH,
    POINTS,
    heights_of,
    line,
    lines_of,
    stage_at,
)
from mems_stiction.msg import DeviceVerdict, ScanInfo, StictionPrediction
from roslib.packages import find_node, get_pkg_dir
from sensor_msgs.msg import Image, JointState, PointCloud2
from std_msgs.msg import Bool, String
from std_srvs.srv import Trigger
from stiction_client import TIMEOUT, Collector, settings_of, source_counts, wait_until
from tf2_msgs.msg import TFMessage

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))

from tiers import evidence  # noqa: E402  (the path comes first)


class Scanner:
    """A scan_source in a namespace of its own, with the sensor and stage that the test imitates."""

    def __init__(self, test, name, **parameters):
        for key, value in dict(
            source="lines", diagnostic_period=0.1, transform_timeout=3.0, **parameters
        ).items():
            rospy.set_param("/%s/source/%s" % (name, key), value)
        self.log = tempfile.TemporaryFile("w+")  # of warnings
        test.addCleanup(self.log.close)
        self.process = subprocess.Popen(
            [find_node("mems_stiction", "scan_source")[0], "__name:=source"],
            env=dict(os.environ, ROS_NAMESPACE="/" + name),
            stderr=self.log,
        )
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.terminate)
        self.heights, self.infos = (
            Collector("/%s/height" % name, Image),
            Collector("/%s/scan_info" % name, ScanInfo),
        )
        self.refused = Collector("/%s/source/refused" % name, String).connect()
        self.counts = source_counts(name + "/source")
        self.sensor = rospy.Publisher("/%s/points" % name, PointCloud2, queue_size=1000)
        self.trigger = rospy.Publisher("/%s/trigger" % name, Bool, queue_size=10)
        self.joints = rospy.Publisher("/%s/joint_states" % name, JointState, queue_size=1000)
        self.frames = rospy.Publisher("/tf", TFMessage, queue_size=1000)
        self.begin, self.end = (
            rospy.ServiceProxy("/%s/source/%s_scan" % (name, what), Trigger)
            for what in ("begin", "end")
        )
        used = [self.sensor, self.trigger] + {"joint": [self.joints], "tf": [self.frames]}.get(
            parameters["motion"], []
        )
        wait_until(lambda: all(one.get_num_connections() for one in used), "the source to listen")
        self.counts.wait_for_listeners()

    def send(self, rows, first=1000.0, period=0.01, **how):
        """The lines of the map, from the lowest y up, as the stage moves along y; 40 are one
        scan."""
        for number, heights in enumerate(rows[::-1]):
            self.sensor.publish(line(heights, rospy.Time.from_sec(first + number * period), **how))


class LinesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("line_source_test")

    def check(self, scanner, expected, number=1, tolerance=0.0):
        height = scanner.heights.wait(number)[-1]
        np.testing.assert_allclose(heights_of(height), expected, rtol=0, atol=tolerance)
        info = scanner.infos.of(height.header.stamp)
        np.testing.assert_allclose(
            [info.pitch_x, info.pitch_y], [POINT_PITCH, LINE_PITCH], rtol=1e-4
        )

    def test_1_counted_lines_between_the_services_are_a_scan(self):
        scanner = Scanner(self, "count", motion="count", line_pitch=LINE_PITCH)
        scanner.send(lines_of()[:3])  # before the scan
        scanner.counts.wait(lines_outside=3)
        self.assertFalse(scanner.end().success)
        self.assertTrue(scanner.begin().success)
        expected = lines_of()
        expected[7, 4:9] = np.nan
        scanner.send(expected)
        scanner.counts.wait(lines_of_this_scan=LINES, waiting=1)
        self.assertTrue(scanner.end().success)
        self.check(scanner, expected)
        scanner.counts.wait(found=1, published=1, waiting=0, lines=LINES)
        scanner.begin()
        scanner.send(expected[-25:])
        scanner.sensor.impl.seq = 0  # the driver begins anew
        scanner.send(expected[:-25], first=1001.0)
        scanner.counts.wait(lines_of_this_scan=LINES)
        scanner.end()
        self.check(scanner, expected, number=2)

    @evidence
    def test_1_a_scan_that_never_ends_is_refused_before_the_memory_does(self):
        scanner = Scanner(self, "endless", motion="count", line_pitch=LINE_PITCH)
        scanner.begin()
        message = line(np.zeros(1000000), rospy.Time.from_sec(1000.0))
        for number in range(1, 102):
            scanner.sensor.publish(message)
            scanner.counts.wait(lines=number)
        self.assertRegex(scanner.refused.wait(1)[0].data, "100000000 points.*max_lines")
        scanner.send(lines_of())
        scanner.counts.wait(lines_of_this_scan=LINES)
        scanner.end()
        self.check(scanner, lines_of())
        scanner.counts.wait(found=2, published=1, refused=1, waiting=0)

    def test_2_a_speed_and_a_number_of_lines_make_one_scan_after_the_other(self):
        scanner = Scanner(self, "speed", motion="speed", speed=LINE_PITCH / 0.01, max_lines=LINES)
        scanner.send(lines_of(1), first=1000.0, size=32, missing=np.inf)
        scanner.send(lines_of(2), first=2000.0, size=32, missing=np.inf)
        self.check(scanner, lines_of(2), number=2, tolerance=1e-11)
        scanner.counts.wait(found=2, published=2, waiting=0)
        # Once the trigger has said when, lines behind its end are outside.
        scanner.trigger.publish(True)
        scanner.trigger.publish(False)
        scanner.counts.wait(scan_is_open="false")
        scanner.send(lines_of(3), first=3000.0)
        scanner.counts.wait(found=2, waiting=0, lines_outside=LINES)

    def test_3_a_joint_that_turns_back_and_lines_that_are_lost_or_doubled(self):
        scanner = Scanner(
            self,
            "joint",
            motion="joint",
            joint="stage",
            joint_scale=1e-3,
            line_pitch=LINE_PITCH,
            end_at_turn=True,
            backlash=0.3 * LINE_PITCH,  # counts in one scan of both ways alone
            pause=1.0,
        )
        expected = lines_of(3)
        order = list(range(LINES))
        lost = 20
        order.remove(lost)
        order.insert(10, 9)  # one comes twice
        lowest = expected[::-1]

        def joint(stamp, place):
            scanner.joints.publish(
                JointState(
                    header=rospy.Header(stamp=stamp),
                    name=["other", "stage"],
                    position=[9.0, 1e3 * place],
                )
            )

        way = order + list(range(LINES - 2, -1, -1))
        noise = np.random.RandomState(1).normal(scale=1e-9, size=300)
        for number, row in enumerate(way):
            stamp = rospy.Time.from_sec(1000.0 + 0.01 * number)
            scanner.sensor.publish(line(lowest[row], stamp))
            joint(stamp, 0.02 + row * LINE_PITCH)
        # The stage stands, and lines go on.
        for number, more in enumerate(noise, len(way)):
            stamp = rospy.Time.from_sec(1000.0 + 0.01 * number)
            scanner.sensor.publish(line(lowest[0], stamp))
            joint(stamp, 0.02 + more)
            rospy.sleep(0.01)
        first, second = scanner.heights.wait(2)
        whole = expected.astype(float)
        whole[LINES - 1 - lost] = np.nan
        np.testing.assert_allclose(heights_of(first), whole, rtol=0, atol=1e-10)
        self.assertEqual(np.isnan(heights_of(second)).sum(), 0)
        np.testing.assert_allclose(heights_of(second), expected[-(LINES - 1) :], rtol=0, atol=1e-9)
        wait_until(lambda: scanner.counts.total("lines_outside") > 0, "a stand that is no scan")
        scanner.counts.wait(lines_lost_by_position=1, found=2, published=2, refused=0, waiting=0)

    def test_4_tf_places_the_lines_and_the_trigger_says_when(self):
        scanner = Scanner(self, "moved", motion="tf", frame="stage", line_pitch=LINE_PITCH)
        expected = lines_of(4)
        scanner.trigger.publish(True)
        scanner.counts.wait(scan_is_open="true")

        for number, heights in enumerate(expected[::-1]):
            stamp = rospy.Time.from_sec(5000.0 + 0.01 * number)
            scanner.sensor.publish(line(heights, stamp, size=32, missing=np.inf))
            scanner.frames.publish(
                TFMessage([stage_at(stamp, number * LINE_PITCH)])
            )  # it comes late
        scanner.counts.wait(lines_of_this_scan=LINES)
        scanner.sensor.publish(
            line(expected[0], rospy.Time(9000))
        )  # a line of which tf knows nothing
        scanner.counts.wait(lines_without_place=1)
        scanner.trigger.publish(False)
        self.check(scanner, expected, tolerance=1e-11)
        scanner.counts.wait(found=1, published=1, waiting=0)
        for _ in range(2):
            scanner.trigger.publish(True)
            scanner.counts.wait(scan_is_open="true")
            self.assertTrue(scanner.end().success)
            scanner.counts.wait(scan_is_open="false")

    def test_5_what_is_no_scan_is_refused_and_the_next_goes_on(self):
        scanner = Scanner(self, "bad", motion="count", line_pitch=LINE_PITCH, max_lines=LINES)
        scanner.send(np.full((LINES, POINTS), np.nan, np.float32))
        self.assertIn("measured", scanner.refused.wait(1)[0].data)
        broken = line(lines_of()[0], rospy.Time(1))
        broken.fields.pop()
        scanner.sensor.publish(broken)
        scanner.counts.wait(lines_refused=1)
        scanner.send(lines_of(5))
        self.check(scanner, lines_of(5))
        scanner.counts.wait(found=2, published=1, refused=1, waiting=0, lines_lost_by_sequence=0)

    def test_5_the_lines_of_a_scan_that_does_not_end_are_discarded_aloud(self):
        scanner = Scanner(self, "open", motion="count", line_pitch=LINE_PITCH)
        scanner.begin()
        scanner.send(lines_of())
        scanner.counts.wait(lines_of_this_scan=LINES)
        scanner.process.send_signal(signal.SIGINT)
        self.assertEqual(scanner.process.wait(timeout=TIMEOUT), 0)
        scanner.log.seek(0)
        self.assertRegex(scanner.log.read(), "discarded with its %d lines" % LINES)

    def test_6_the_verdict_on_a_line_scanner_alone_is_unknown(self):
        with tempfile.TemporaryDirectory() as name:
            top = pathlib.Path(name)
            settings = yaml.safe_load(
                pathlib.Path(
                    get_pkg_dir("mems_stiction"), "config", "source_lines.yaml"
                ).read_text()
            )
            settings.update(motion="speed", speed=LINE_PITCH / 0.01, max_lines=LINES)
            (top / "source.yaml").write_text(yaml.safe_dump(settings))
            # No other rule makes it unknown: a strong spring, and a contact as large as the scan.
            area = LINES * POINTS * LINE_PITCH * POINT_PITCH
            device = dict(spring_stiffness=1e6, travel=1e-6, contact_area=area)
            (top / "device.yaml").write_text(
                yaml.safe_dump(
                    settings_of(
                        preprocessing=dict(level="plane"),
                        device=device,
                        device_force=dict(enabled=False),
                    )
                )
            )
            station = subprocess.Popen(
                [
                    "roslaunch",
                    get_pkg_dir("mems_stiction") + "/launch/station.launch",
                    "config:=%s/device.yaml" % top,
                    "points:=/profiles",
                    "source_config:=%s/source.yaml" % top,
                    "page:=false",
                    "record:=false",
                ],
                env=dict(os.environ, ROS_HOME=name),
            )
            try:
                predictions = Collector("prediction", StictionPrediction).connect()
                verdicts = Collector("verdict", DeviceVerdict)
                counts = source_counts()
                sensor = rospy.Publisher("/profiles", PointCloud2, queue_size=1000)
                wait_until(sensor.get_num_connections, "the source to listen")
                counts.wait_for_listeners()
                for number, heights in enumerate(lines_of(6)[::-1]):
                    sensor.publish(line(heights, rospy.Time.from_sec(1000.0 + 0.01 * number)))
                prediction = predictions.wait(1)[0]
                self.assertEqual(prediction.header.stamp, rospy.Time(1000))
                self.assertTrue(prediction.regime_flags & StictionPrediction.FLAG_UNRESOLVED)
                self.assertGreater(prediction.unresolved_height, prediction.unresolved_limit)
                self.assertLess(prediction.needed_pitch, 0.1 * POINT_PITCH)
                verdict = verdicts.of(prediction.header.stamp)
                for one in (prediction, verdict):
                    self.assertEqual(one.sticks, StictionPrediction.STICKS_UNKNOWN)
                    self.assertIn("pixels", one.reason)
            finally:
                station.send_signal(signal.SIGINT)
                station.wait(timeout=TIMEOUT)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "line_source", LinesTest)
