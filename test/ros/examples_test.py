#!/usr/bin/env python3
"""The three ready-made stations, from what the instrument gives to the verdict on the page and the
row of the recording: an AFM's folder, an areal sensor, a line scanner on a stage.
Longer than ten seconds: a station and a browser start for each."""

import csv
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import browser
import numpy as np
import rosbag
import rospy
import rostest
import yaml
from instrument_drivers import (
    COLS,
    LINE_PITCH,
    LINES,
    PITCH,
    POINT_PITCH,
    POINTS,
    ROWS,
    field,
    line,
    lines_of,
    snapshot,
    stage_at,
)
from mems_stiction.msg import DeviceVerdict, StictionPrediction
from mems_stiction.page_words import VERDICTS
from roslib.packages import find_node, get_pkg_dir
from sensor_msgs.msg import JointState, PointCloud2
from std_msgs.msg import Bool
from stiction_client import (
    STATION,
    TIMEOUT,
    Collector,
    rough_surface,
    settings_of,
    source_counts,
    wait_until,
)
from stiction_client import PITCH as AFM_PITCH
from tf2_msgs.msg import TFMessage

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))

from tiers import evidence  # noqa: E402  (the path comes first)

LINE_AREA = LINES * POINTS * POINT_PITCH * LINE_PITCH  # [m^2]


def afm_file(heights):
    """Bytes of a Gwyddion Simple Field, which states pitch and units."""
    rows, cols = heights.shape
    header = (
        "Gwyddion Simple Field 1.0\nXRes = %d\nYRes = %d\nXReal = %r\nYReal = %r\n"
        "XYUnits = m\nZUnits = m\n" % (cols, rows, cols * AFM_PITCH, rows * AFM_PITCH)
    ).encode()
    return header + b"\0" * (4 - len(header) % 4) + heights.astype("<f4").tobytes()


class Example:
    """A launch file as a user starts it, with a device whose contact is as large as a scan, and a
    browser that looks at its page."""

    def __init__(self, test, name, scanned_area, old_files=None, **arguments):
        temporary = tempfile.TemporaryDirectory()
        test.addCleanup(temporary.cleanup)
        self.top = pathlib.Path(temporary.name)
        self.folder = self.top / "scans"
        self.folder.mkdir()
        for old, content in (old_files or {}).items():
            (self.folder / old).write_bytes(content)
        settings = settings_of(
            STATION,
            preprocessing=dict(level="plane"),
            device=dict(spring_stiffness=1000.0, travel=1e-6, contact_area=scanned_area),
            device_force=dict(realisations=3, max_cells=10000),
        )
        (self.top / "device.yaml").write_text(yaml.safe_dump(settings))
        given = dict(
            config=self.top / "device.yaml", port=0, bag_prefix=self.top / "day", **arguments
        )
        told = self.top / "told.txt"
        with open(told, "w") as stream:
            self._process = subprocess.Popen(
                ["roslaunch", "%s/launch/%s.launch" % (get_pkg_dir("mems_stiction"), name)]
                + ["%s:=%s" % (key, str(value).format(self)) for key, value in given.items()],
                env=dict(os.environ, ROS_HOME=str(self.top)),
                stdout=stream,
            )
        test.addCleanup(self.end)
        self.predictions = Collector("prediction", StictionPrediction)
        self.verdicts = Collector("verdict", DeviceVerdict)
        self.counts = source_counts()
        address = re.compile(r"station_page: (http://\S+) shows")
        wait_until(lambda: address.search(told.read_text()), "the page")
        self.page = browser.Browser()
        test.addCleanup(self.page.close)
        self.page.open(address.search(told.read_text()).group(1))
        self.page.wait("state && state.link.level === 'ok'")
        self.counts.wait_for_listeners()

    def end(self):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            self._process.wait(timeout=TIMEOUT)

    def verdict(self, count):
        """Of the scan of this number, once nothing may change it and the page shows it; with its
        prediction."""
        prediction = self.predictions.wait(count)[count - 1]
        stamp = prediction.header.stamp
        wait_until(lambda: self.verdicts.of(stamp).is_final, "the final verdict")
        verdict = self.verdicts.of(stamp)
        self.page.wait("state.scan && state.scan.stamp === '%.3f'" % stamp.to_sec())
        self.page.wait("document.querySelector('#word').innerText === '%s'" % shown(verdict))
        return verdict, prediction

    def rows(self):
        """What the recording has of each scan, by its stamp [s]: the row of export_predictions,
        and the last verdict."""
        self.end()
        (bag,) = self.top.glob("day*.bag")
        rows = self.top / "rows.csv"
        subprocess.run(
            [find_node("mems_stiction", "export_predictions")[0], "-o", str(rows), str(bag)],
            check=True,
            timeout=TIMEOUT,
        )
        with rosbag.Bag(str(bag)) as recording:
            words = {
                "%.9f" % message.header.stamp.to_sec(): message.word
                for _, message, _ in recording.read_messages(["/verdict"])
            }
        with open(rows, newline="") as stream:
            return {
                row["stamp"]: dict(row, word=words.get("%.9f" % float(row["stamp"])))
                for row in csv.DictReader(stream)
            }


def shown(verdict):
    """The word of the page for a verdict."""
    return VERDICTS[verdict.sticks][1]


@unittest.skipUnless(browser.program(), "no browser is installed: scripts/setup does")
class ExamplesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("examples_test")

    def assert_recorded(self, example, verdicts):
        rows = example.rows()
        self.assertEqual(len(rows), len(verdicts))
        for row, verdict in zip(rows.values(), verdicts):
            self.assertAlmostEqual(float(row["stamp"]), verdict.header.stamp.to_sec(), places=6)
            self.assertEqual(row["word"], verdict.word)

    def assert_too_coarse(self, verdict, prediction):
        """Whatever the figures: pixels of micrometres do not show what holds."""
        self.assertEqual(verdict.sticks, StictionPrediction.STICKS_UNKNOWN)
        self.assertTrue(prediction.regime_flags & StictionPrediction.FLAG_UNRESOLVED)
        self.assertLess(prediction.needed_pitch, POINT_PITCH)

    def test_1_an_afm_whose_program_saves_files(self):
        example = Example(
            self,
            "afm_folder",
            48 * 64 * AFM_PITCH**2,
            old_files={"beam 0.gsf": afm_file(rough_surface(3, rms_height=5e-10))},
            folder="{0.folder}",
        )
        old, _ = example.verdict(1)  # what lay there is for page and recorder, too
        self.assertEqual(old.scan_name, "beam 0")
        content = afm_file(rough_surface(2, rms_height=5e-10))
        with open(example.folder / "beam 1.gsf", "wb", buffering=0) as stream:  # as it grows
            for piece in range(4):
                stream.write(content[piece * len(content) // 4 : (piece + 1) * len(content) // 4])
                time.sleep(0.5)
        verdict, prediction = example.verdict(2)
        self.assertEqual(verdict.scan_name, "beam 1")
        self.assertEqual(shown(verdict), "RELEASES")
        verdicts = [old, verdict]
        scans = os.environ.get("MEMS_STICTION_SCANS")
        for path in sorted(pathlib.Path(scans).glob("*.di")) if scans else []:
            (example.folder / path.name).write_bytes(path.read_bytes())
            verdicts.append(example.verdict(len(verdicts) + 1)[0])
        example.counts.wait(found=len(verdicts), published=len(verdicts), refused=0, waiting=0)
        self.assertEqual(example.page.value("state.count"), len(verdicts))
        example.page.wait(
            "document.querySelector('#sources-text').textContent.startsWith("
            "'Source: %d of %d scans published')" % (len(verdicts), len(verdicts))
        )
        self.assert_recorded(example, verdicts)

    def test_2_an_areal_sensor_whose_driver_publishes_fields(self):
        example = Example(self, "areal_sensor", ROWS * COLS * PITCH**2)
        sensor = rospy.Publisher("/gocator_snapshot", PointCloud2, queue_size=10)
        wait_until(sensor.get_num_connections, "the source to listen")
        heights = field(1)
        heights[3, 5:9] = np.nan
        sensor.publish(snapshot(heights, rospy.Time(1000, 5)))
        verdict, prediction = example.verdict(1)
        self.assert_too_coarse(verdict, prediction)
        example.counts.wait(found=1, published=1, refused=0, waiting=0)
        self.assert_recorded(example, [verdict])

    def scan_lines(self, example, moves, move):
        """Runs the scanner over the stage by the trigger, with a line lost and one doubled, until
        the verdict is there.

        moves: publisher of what tells where the stage is; move: its message by stamp and way.
        """
        sensor = rospy.Publisher("/profiles", PointCloud2, queue_size=1000)
        trigger = rospy.Publisher("/trigger", Bool, queue_size=10)
        for publisher in (sensor, moves, trigger):
            wait_until(publisher.get_num_connections, "the source to listen")
        trigger.publish(True)
        example.counts.wait(scan_is_open="true")
        lowest = lines_of(4)[::-1]
        numbers = list(range(LINES))
        numbers.remove(20)
        numbers.insert(11, 10)
        for number in numbers:
            stamp = rospy.Time.from_sec(2000.0 + 0.01 * number)
            moves.publish(move(stamp, number * LINE_PITCH))
            sensor.publish(line(lowest[number], stamp, size=32, missing=np.inf))
        example.counts.wait(lines_of_this_scan=len(numbers))
        trigger.publish(False)
        verdict, prediction = example.verdict(1)
        self.assert_too_coarse(verdict, prediction)
        self.assertAlmostEqual(prediction.invalid_fraction, 1 / LINES)
        example.counts.wait(
            found=1, published=1, waiting=0, lines_lost_by_position=1, lines_doubled=1
        )
        self.assert_recorded(example, [verdict])

    def test_3_a_line_scanner_on_a_stage_that_tf_follows(self):
        example = Example(self, "line_scanner", LINE_AREA)
        self.scan_lines(
            example,
            rospy.Publisher("/tf", TFMessage, queue_size=1000),
            lambda stamp, way: TFMessage([stage_at(stamp, way)]),
        )

    @evidence
    def test_4_a_line_scanner_on_a_stage_with_a_joint(self):
        source = yaml.safe_load(
            pathlib.Path(get_pkg_dir("mems_stiction"), "config", "source_lines.yaml").read_text()
        )
        source.update(motion="joint", joint="stage_y")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "lines.yaml"
            path.write_text(yaml.safe_dump(source))
            example = Example(self, "line_scanner", LINE_AREA, source_config=path)
            self.scan_lines(
                example,
                rospy.Publisher("/joint_states", JointState, queue_size=1000),
                lambda stamp, way: JointState(
                    header=rospy.Header(stamp=stamp), name=["stage_y"], position=[way]
                ),
            )


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "examples", ExamplesTest)
