#!/usr/bin/env python3
"""Clocks that jump an hour to and fro, the system's and that of a simulation: source and node lose
no scan, diagnostics go on, and no time is negative."""

import os
import pathlib
import subprocess
import tempfile
import threading
import time
import unittest

import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import ScanInfo, StictionPrediction
from roslib.packages import find_node
from rosgraph_msgs.msg import Clock
from stiction_client import (
    PITCH,
    STATION,
    TIMEOUT,
    Collector,
    Counts,
    rough_surface,
    source_counts,
    wait_until,
    write_grid,
)

HOUR = 3600
JUMPS = (0, HOUR, 0, -HOUR, 0)  # [s] beside the time that it is
FILES = 3  # at each time
# Loaded before a program, it gives that program another time of day (Debian's libfaketime).
FAKETIME = pathlib.Path("/usr/lib/x86_64-linux-gnu/faketime/libfaketimeMT.so.1")


class Pair:
    """A scan_source on a folder of its own, and the node that predicts what it publishes."""

    def __init__(self, name, top, **environment):
        self.name, self.folder = name, top / name
        self.folder.mkdir()
        settings = dict(yaml.safe_load(STATION.read_text()), diagnostic_period=0.2)
        source = dict(folder=str(self.folder), settle_time=0.1, poll_period=0.2)
        # else it is content with the test's own Collector on scan_info
        source.update(diagnostic_period=0.2, old_files="all", listener="stiction_node")
        self.processes = []
        for program, own in (("stiction_node", settings), ("scan_source", source)):
            for key, value in own.items():
                rospy.set_param("/%s/%s/%s" % (name, program, key), value)
            self.processes.append(
                subprocess.Popen(
                    [find_node("mems_stiction", program)[0], "__name:=" + program],
                    env=dict(
                        os.environ,
                        ROS_NAMESPACE="/" + name,
                        ROS_HOME=str(top / "home"),
                        MEMS_STICTION_SCAN_FOLDERS=str(top),
                        **environment,
                    ),
                )
            )
        self.predictions = Collector("/%s/prediction" % name, StictionPrediction)
        self.infos = Collector("/%s/scan_info" % name, ScanInfo)
        self.scans = Counts(name + "/stiction_node")
        self.files = source_counts(name + "/scan_source")
        self.reports = Collector("/diagnostics", DiagnosticArray)
        self.written = 0

    def stamps(self):
        """Of the newest reports of both [s]."""
        found = {}
        for message in list(self.reports.messages):
            for status in message.status:
                if status.name.startswith(self.name + "/"):
                    found[status.name.split(":")[0]] = message.header.stamp.to_sec()
        return found

    def end(self):
        for process in self.processes:
            process.terminate()
            process.wait(timeout=TIMEOUT)

    def write(self, shift=0.0):
        """A scan whose file has the time that the clock shows."""
        self.written += 1
        path = self.folder / ("scan_%02d.txt" % self.written)
        pathlib.Path(str(path) + ".yaml").write_text("pitch_x: %r\npitch_y: %r\n" % (PITCH, PITCH))
        write_grid(path, rough_surface(self.written, 24, 32))
        os.utime(str(path), (time.time() + shift,) * 2)

    def times(self):
        """Every figure of both that is in seconds."""
        return {
            (counts._name, key): float(value)
            for counts in (self.scans, self.files)
            for key, value in list(counts._values.items())
            if key.endswith("[s]") and value not in ("", "-", "nan")
        }


class ClockTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("clock_test")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.top = pathlib.Path(folder.name)

    def check_jumps(self, pair, jump_to, now):
        """jump_to(shift) sets the clock of the pair, now() tells what it shows [s]."""
        self.addCleanup(pair.end)
        for shift in JUMPS:
            jump_to(shift)
            for _ in range(FILES):
                pair.write(shift)
            pair.files.wait(found=pair.written, published=pair.written, refused=0, waiting=0)
            pair.scans.wait(received=pair.written, predicted=pair.written, dropped=0, rejected=0)
            for counts in (pair.scans, pair.files):
                counts.fresh()  # reports go on
            for name, stamp in pair.stamps().items():
                self.assertLess(abs(stamp - now()), HOUR / 2, (name, shift))
            for name, seconds in pair.times().items():
                self.assertTrue(0.0 <= seconds < HOUR / 2, (name, seconds, shift))
        predictions = pair.predictions.wait(pair.written)
        self.assertEqual(
            sorted(message.scan_name for message in predictions),
            ["scan_%02d" % number for number in range(1, pair.written + 1)],
        )
        for message in predictions:
            self.assertTrue(0.0 <= message.processing_time < TIMEOUT, message.processing_time)
        stamps = [message.header.stamp for message in pair.infos.messages]
        self.assertEqual(len(set(stamps)), pair.written)
        self.assertEqual([process.poll() for process in pair.processes], [None, None])

    @unittest.skipUnless(FAKETIME.exists(), "libfaketime is not installed (scripts/setup)")
    def test_the_time_of_day_jumps(self):
        beside = self.top / "beside the time that it is"
        beside_now = [0]

        def jump_to(shift):
            (self.top / "next").write_text("%+d" % shift)
            (self.top / "next").rename(beside)
            beside_now[0] = shift

        jump_to(0)
        pair = Pair(
            "day",
            self.top,
            LD_PRELOAD=str(FAKETIME),
            FAKETIME_TIMESTAMP_FILE=str(beside),
            FAKETIME_NO_CACHE="1",
            FAKETIME_DONT_FAKE_MONOTONIC="1",
            NO_FAKE_STAT="1",
        )
        self.check_jumps(pair, jump_to, lambda: time.time() + beside_now[0])

    def test_the_clock_of_a_simulation_jumps(self):
        rospy.set_param("/use_sim_time", True)
        try:
            pair = Pair("simulation", self.top)
            for counts in (pair.scans, pair.files):  # diagnostics do not wait for the first /clock
                counts.fresh()
        finally:
            rospy.delete_param("/use_sim_time")
        clock = rospy.Publisher("/clock", Clock, queue_size=10)
        wait_until(lambda: clock.get_num_connections() == 2, "both to listen to the clock")
        shown = [0.0]
        ended = threading.Event()
        self.addCleanup(ended.set)

        def run():
            while not ended.wait(0.02):
                shown[0] += 0.02
                clock.publish(Clock(rospy.Time.from_sec(shown[0])))

        threading.Thread(target=run, daemon=True).start()

        def jump_to(shift):
            shown[0] = 2.0 * HOUR + shift

        self.check_jumps(pair, jump_to, lambda: shown[0])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "clock", ClockTest)
