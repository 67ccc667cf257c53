#!/usr/bin/env python3
"""A folder that another program writes into, as AFMs and microscopes do: each content leads to one
prediction, whatever happens to files and processes.
Longer than ten seconds: settle times are waited for, as instruments make one wait."""

import hashlib
import os
import pathlib
import random
import signal
import subprocess
import tempfile
import time
import unittest

import numpy as np
import rospy
import rostest
import yaml
from mems_stiction.msg import ScanInfo, StictionPrediction
from roslib.packages import find_node, get_pkg_dir
from sensor_msgs.msg import Image
from std_msgs.msg import String
from stiction_client import (
    PITCH,
    SANITIZER,
    STATION,
    TIMEOUT,
    Collector,
    predict_scan,
    process_of,
    recorded_stamps,
    rough_surface,
    source_counts,
    thread_seconds,
    unlike,
    wait_until,
    write_grid,
)

SETTLE = 0.5  # [s]
SIDECAR = "pitch_x: %r\npitch_y: %r\n" % (PITCH, PITCH)
OF_THE_FILE = (
    "scan_name",
    "part_id",
    "serial_id",
    "lot_id",
    "acquisition_time",
    "checksum",
    "instrument",
)


def grid_bytes(seed, rows=48, cols=64):
    """A text grid of heights, which needs a sidecar."""
    with tempfile.TemporaryDirectory() as name:
        path = pathlib.Path(name) / "scan.txt"
        write_grid(path, rough_surface(seed, rows, cols))
        return path.read_bytes()


def checksum(content):
    return "sha256:" + hashlib.sha256(content).hexdigest()


def slowly(path, content, pieces=10, pause=0.1):
    """As an instrument writes: the file stays open and grows, for longer than the settle time."""
    with open(path, "wb", buffering=0) as stream:
        for piece in range(pieces):
            stream.write(
                content[piece * len(content) // pieces : (piece + 1) * len(content) // pieces]
            )
            time.sleep(pause)


STARTED = []  # processes

# Starts a program to which the system tells nothing of changes (inotify), as on a network share.
UNTOLD = ["unshare", "--user", "--map-root-user", "sh", "-c"] + [
    'echo 0 > /proc/sys/user/max_inotify_instances && exec "$@"',
    "sh",
]
CAN_BE_UNTOLD = subprocess.run(UNTOLD + ["true"], stderr=subprocess.DEVNULL).returncode == 0


class Source:
    """A scan_source of a namespace of its own, with nobody but the test to listen."""

    def __init__(self, name, folder, home, **parameters):
        self.name = name
        self._environment = dict(
            os.environ,
            ROS_NAMESPACE="/" + name,
            ROS_HOME=str(home),
            MEMS_STICTION_SCAN_FOLDERS=str(folder),
        )
        for key, value in dict(
            folder=str(folder),
            settle_time=0.1,
            diagnostic_period=0.1,
            poll_period=0.5,
            **parameters,
        ).items():
            rospy.set_param("/%s/source/%s" % (name, key), value)

    def start(self, by=()):
        self.process = subprocess.Popen(
            [*by, find_node("mems_stiction", "scan_source")[0], "__name:=source"],
            env=self._environment,
        )
        STARTED.append(self.process)
        return self

    def end(self, number=signal.SIGTERM):
        self.process.send_signal(number)
        self.process.wait(timeout=TIMEOUT)

    def state(self, home):
        (path,) = (home / "scan_source").glob("*.seen")
        return path.read_text()


class FolderTest(unittest.TestCase):
    def tearDown(self):
        while STARTED:  # what a case that failed has left
            STARTED.pop().kill()

    @classmethod
    def setUpClass(cls):
        rospy.init_node("folder_source_test")
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.top = pathlib.Path(temporary.name)
        cls.folder = cls.top / "AFM Messung ä"
        cls.home = cls.top / "home"
        cls.folder.mkdir()
        cls.home.mkdir()
        (cls.top / "source.yaml").write_text(
            yaml.safe_dump(
                dict(
                    source="folder",
                    settle_time=SETTLE,
                    diagnostic_period=0.2,
                    name_pattern=r"(?<part_id>[A-Z]+)_(?<serial_id>\d+)",
                    recursive=True,
                )
            )
        )
        cls.station = subprocess.Popen(
            [
                "roslaunch",
                get_pkg_dir("mems_stiction") + "/launch/station.launch",
                "config:=%s" % STATION,
                "folder:=%s" % cls.folder,
                "source_config:=%s/source.yaml" % cls.top,
                "page:=false",
                "bag_prefix:=%s/day" % cls.top,
            ],
            env=dict(os.environ, ROS_HOME=str(cls.home)),
        )
        cls.addClassCleanup(cls.stop)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.infos = Collector("scan_info", ScanInfo).connect()
        cls.refused = Collector("scan_source/refused", String).connect()
        cls.counts = source_counts()
        # who writes to a file that was begun before is not told
        wait_until(lambda: cls.counts["told_by"].startswith("the system"), "the first look")

    @classmethod
    def stop(cls):
        if cls.station.poll() is None:
            cls.station.send_signal(signal.SIGINT)
            cls.station.wait(timeout=TIMEOUT)

    def put(self, name, content, sidecar=SIDECAR):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        if sidecar:
            pathlib.Path(str(path) + ".yaml").write_text(sidecar)
        path.write_bytes(content)
        return path

    def of_content(self, content):
        """Predictions of this content."""
        return [one for one in list(self.predictions.messages) if one.checksum == checksum(content)]

    def wait_for(self, content):
        wait_until(lambda: self.of_content(content), "a prediction of the content")
        return self.of_content(content)[-1]

    def assert_books(self):
        found, published, refused, waiting = (
            int(self.counts.fresh()[key]) for key in ("found", "published", "refused", "waiting")
        )
        self.assertEqual(found, published + refused + waiting)

    def test_1_a_file_that_grows_slowly_leads_to_one_prediction_the_command_lines_to_the_bit(self):
        content = grid_bytes(1)
        (self.folder / "BEAM_0042 top.txt.yaml").write_text(SIDECAR)
        slowly(self.folder / "BEAM_0042 top.txt", content, pieces=5, pause=1.5 * SETTLE)
        prediction = self.wait_for(content)
        self.assertEqual(
            (prediction.part_id, prediction.serial_id, prediction.scan_name),
            ("BEAM", "0042", "BEAM_0042 top"),
        )
        self.assertEqual(
            unlike(prediction, predict_scan(rough_surface(1), None, None), leaving_out=OF_THE_FILE),
            [],
        )
        self.assertEqual(self.infos.of(prediction.header.stamp).part_id, "BEAM")
        self.counts.wait(published=1, refused=0, waiting=0, found=1)

    def test_2_renamed_and_overwritten_files_are_new_scans_and_copies_are_not(self):
        first, second = grid_bytes(2), grid_bytes(3)
        temporary = self.put("B_1.txt.tmp", first, None)
        (self.folder / "B_1.txt.yaml").write_text(SIDECAR)
        temporary.rename(self.folder / "B_1.txt")
        self.wait_for(first)
        self.put("B_1.txt", second)
        self.wait_for(second)
        before = int(self.counts["repeated"])
        self.put("below/C_1.txt", first)
        self.counts.wait(repeated=before + 1, waiting=0)
        self.assertEqual([len(self.of_content(one)) for one in (first, second)], [1, 1])
        (self.folder / "B_1.txt.yaml").write_text(
            SIDECAR + "serial_id: '77'\n"
        )  # another sidecar makes another scan
        wait_until(lambda: len(self.of_content(second)) == 2, "the scan of the changed sidecar")
        self.assertEqual([one.serial_id for one in self.of_content(second)], ["1", "77"])
        self.assert_books()

    def test_3_what_cannot_be_read_is_named_once_and_the_next_file_goes_on(self):
        before = int(self.counts.fresh()["refused"])
        told_before = len(self.refused.messages)
        self.put("notes of today.docx", b"PK\x03\x04 no scan", None)
        self.put("lonely.txt", grid_bytes(4), None)
        wait_until(lambda: len(self.refused.messages) >= told_before + 2, "both refusals")
        self.counts.wait(refused=before + 2, waiting=0)
        told = " ".join(message.data for message in self.refused.messages)
        self.assertIn("notes of today.docx", told)
        self.assertRegex(told, "lonely.txt.*pitch")
        self.assertTrue(any("refused" in reason for reason in self.counts.reasons()))
        content = grid_bytes(5)
        self.put("D_1.txt", content)
        self.wait_for(content)
        (self.folder / "lonely.txt.yaml").write_text(SIDECAR)  # what it lacked
        self.wait_for(grid_bytes(4))
        self.assertEqual(len(self.refused.messages), told_before + 2)
        self.assert_books()

    def test_4_many_at_once_lead_to_one_prediction_each(self):
        contents = [grid_bytes(100 + seed, 24, 32) for seed in range(60)]
        for number, content in enumerate(contents):
            self.put("many/E_%03d.txt" % number, content)
        wait_until(
            lambda: all(self.of_content(content) for content in contents), "a prediction of each"
        )
        self.assertEqual({len(self.of_content(content)) for content in contents}, {1})
        stamps = [prediction.header.stamp for prediction in self.predictions.messages]
        self.assertEqual(len(set(stamps)), len(stamps))
        self.assert_books()

    @unittest.skipIf(SANITIZER, "sanitizers take their time")
    def test_5_how_long_a_file_takes_to_its_prediction_is_printed_and_costs_little(self):
        def seconds_of(topic):
            return sum(thread_seconds(process_of(topic)).values())

        sent, predicted = [], []
        before = sum(seconds_of(topic) for topic in ("height", "prediction"))
        for seed in range(5):
            path = self.top / "whole.npy"
            np.save(str(path), rough_surface(50 + seed, 512, 512))
            content = path.read_bytes()
            (self.folder / ("F_%d.npy.yaml" % seed)).write_text(SIDECAR)
            time.sleep(0.1)
            begin = time.monotonic()
            path.rename(self.folder / ("F_%d.npy" % seed))
            wait_until(
                lambda: (
                    checksum(content) in {message.checksum for message in list(self.infos.messages)}
                ),
                "the scan",
            )
            sent.append(time.monotonic() - begin)
            self.wait_for(content)
            predicted.append(time.monotonic() - begin)
        print(
            "from file to scan %s s, to prediction %s s, of which %g s settle"
            % (*[", ".join("%.2f" % one for one in all) for all in (sent, predicted)], SETTLE)
        )
        computed = sum(seconds_of(topic) for topic in ("height", "prediction")) - before
        print("both programs computed %.2f s for each" % (computed / len(sent)))
        self.assertLess(computed / len(sent), 0.5)

    def test_6_files_of_makers_copied_slowly_are_predicted_or_named(self):
        scans = os.environ.get("MEMS_STICTION_SCANS")
        if not scans:
            self.skipTest("MEMS_STICTION_SCANS is not set")
        files = sorted(
            path
            for path in pathlib.Path(scans).iterdir()
            if path.suffix in (".al3d", ".di", ".opd", ".tiff", ".top", ".x3p")
        )
        self.assertGreater(len(files), 2)
        refused = len(self.refused.messages)
        for path in files:
            slowly(self.folder / path.name, path.read_bytes(), pieces=3)
        contents = {path.name: path.read_bytes() for path in files}

        def ended(name):
            return self.of_content(contents[name]) or any(
                name in message.data for message in self.refused.messages[refused:]
            )

        wait_until(lambda: all(map(ended, contents)), "an end of each")
        predicted = [name for name in contents if self.of_content(contents[name])]
        print(
            "predicted: %s; refused: %s"
            % (predicted, [message.data for message in self.refused.messages[refused:]])
        )
        self.assertGreater(len(predicted), 2)
        self.assertEqual({len(self.of_content(contents[name])) for name in predicted}, {1})
        self.assert_books()

    def test_7_killed_between_files_each_content_comes_once(self):
        folder, home = self.top / "kill", self.top / "kill home"
        folder.mkdir()
        source = Source("kill", folder, home).start()
        infos, heights = Collector("/kill/scan_info", ScanInfo), Collector("/kill/height", Image)
        contents = [grid_bytes(200 + number, 24, 32) for number in range(20)]
        for number, content in enumerate(contents):
            path = folder / ("%d.txt" % number)
            pathlib.Path(str(path) + ".yaml").write_text(SIDECAR)
            path.write_bytes(content)
            infos.wait(number + 1)
            if number % 4 == 1:
                wait_until(
                    lambda: "published " + checksum(content) in source.state(home), "its note"
                )
                source.end(signal.SIGKILL)
                source.start()
        heights.wait(len(contents))
        source.end()
        source.start()
        counts = source_counts("kill/source")
        counts.wait(waiting=0, published=0)
        counts.fresh()
        source.end()
        self.assertEqual(
            [message.checksum for message in infos.messages],
            [checksum(content) for content in contents],
        )
        self.assertEqual(
            [message.header.stamp for message in heights.messages],
            [message.header.stamp for message in infos.messages],
        )

    def test_8_killed_at_any_moment_none_is_lost_and_one_that_comes_again_has_its_stamp(self):
        folder, home = self.top / "any", self.top / "any home"
        folder.mkdir()
        source = Source("any", folder, home, max_ahead=0).start()
        infos = Collector("/any/scan_info", ScanInfo)
        heights = Collector("/any/height", Image)
        contents = [grid_bytes(300 + number, 24, 32) for number in range(60)]
        for number, content in enumerate(contents):
            path = folder / ("%d.txt" % number)
            pathlib.Path(str(path) + ".yaml").write_text(SIDECAR)
            path.write_bytes(content)
        random.seed(1)
        for _ in range(4):
            count = len(heights.messages)
            wait_until(lambda: len(heights.messages) > count, "the next scan")
            time.sleep(random.uniform(0.0, 0.05))
            source.end(signal.SIGKILL)
            source.start()
        expected = {checksum(content) for content in contents}
        wait_until(
            lambda: {message.checksum for message in infos.messages} == expected, "every content"
        )
        source.end()
        stamps = {}
        for message in infos.messages:
            stamps.setdefault(message.checksum, set()).add(message.header.stamp)
        self.assertEqual({len(of_one) for of_one in stamps.values()}, {1})

    def test_9_without_a_listener_files_wait_and_old_ones_may_be_passed_over(self):
        folder, home = self.top / "old", self.top / "old home"
        folder.mkdir()
        for number in range(3):
            path = folder / ("%d.txt" % number)
            pathlib.Path(str(path) + ".yaml").write_text(SIDECAR)
            path.write_bytes(grid_bytes(400 + number, 24, 32))
            os.utime(str(path), (1.5e9 + number, 1.5e9 + number))
        source = Source("old", folder, home, old_files="newest", patterns=["*.txt", "*.di"]).start()
        counts = source_counts("old/source")
        counts.wait(waiting=1, published=0, found=1)
        wait_until(lambda: "listens" in counts["hindered_by"], "what it waits for")
        infos, _ = Collector("/old/scan_info", ScanInfo), Collector("/old/height", Image)
        infos.wait(1)
        self.assertEqual(
            [(message.scan_name, message.header.stamp.to_sec()) for message in infos.messages],
            [("2", 1.5e9 + 2)],
        )
        counts.wait(waiting=0, published=1)
        source.end()

    @unittest.skipUnless(CAN_BE_UNTOLD, "this user may have no namespace of his own")
    def test_9b_on_a_share_looks_find_each_content_once(self):
        folder, home = self.top / "share", self.top / "share home"
        folder.mkdir()
        source = Source("share", folder, home).start(by=UNTOLD)
        infos, _ = Collector("/share/scan_info", ScanInfo), Collector("/share/height", Image)
        counts = source_counts("share/source")
        wait_until(lambda: counts["told_by"] == "looks", "how it is told")
        contents = [grid_bytes(500 + number, 24, 32) for number in range(4)]

        def expect(count):
            infos.wait(count)
            counts.wait(waiting=0, published=count)

        for name in ("grows", "moved", "written over", "copy"):
            (folder / (name + ".txt.yaml")).write_text(SIDECAR)
        slowly(folder / "grows.txt", contents[0], pieces=40, pause=0.05)
        expect(1)
        (folder / "moved.txt.part").write_bytes(contents[1])
        (folder / "moved.txt.part").rename(folder / "moved.txt")
        (folder / "written over.txt").write_bytes(contents[2])
        expect(3)
        (folder / "written over.txt").write_bytes(contents[3])
        (folder / "copy.txt").write_bytes(contents[1])
        (folder / "moved.txt").unlink()
        expect(4)
        counts.wait(repeated=1)
        wait_until(
            lambda: all("published " + checksum(one) in source.state(home) for one in contents),
            "their notes",
        )
        source.end(signal.SIGKILL)
        source.start(by=UNTOLD)
        counts.wait(waiting=0, found=0, repeated=1)  # the copy
        counts.fresh()
        source.end()
        self.assertEqual(
            sorted(message.checksum for message in infos.messages), sorted(map(checksum, contents))
        )

    def test_a_bad_parameters_are_refused_with_their_names(self):
        for name, value, words in (
            ("folder", "/no/such/folder", "folder"),
            ("folder", "/etc", "must lie below"),
            ("name_pattern", "(?<x>.)", "part_id"),
            ("settle_time", -1.0, "settle_time"),
            ("sauce", 1, "sauce"),
            ("state_file", "/etc/passwd", "state_file"),
        ):
            parameters = dict(folder=str(self.folder))
            parameters[name] = value
            for key, one in parameters.items():
                rospy.set_param("/bad/source/" + key, one)
            done = subprocess.run(
                [find_node("mems_stiction", "scan_source")[0], "__name:=source"],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                universal_newlines=True,
                timeout=TIMEOUT,
                env=dict(
                    os.environ,
                    ROS_NAMESPACE="/bad",
                    ROS_HOME=str(self.home),
                    MEMS_STICTION_SCAN_FOLDERS=str(self.top),
                ),
            )
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn(words, done.stdout)
            rospy.delete_param("/bad/source")

    def test_b_the_recording_has_each_scan_and_its_prediction(self):
        sent = {prediction.header.stamp for prediction in self.predictions.messages}
        self.stop()
        stamps = recorded_stamps(self.top, "/height", "/scan_info", "/prediction")
        self.assertEqual(stamps["/height"], stamps["/scan_info"])
        self.assertEqual(stamps["/prediction"], stamps["/height"])
        self.assertLessEqual(sent, stamps["/prediction"])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "folder_source", FolderTest)
