#!/usr/bin/env python3
"""Bad parameters: the node exits with 1 and names every key; the nodelet names them and stays idle
in its manager."""

import os
import pathlib
import resource
import subprocess
import tempfile
import threading
import unittest

import rospy
import rosservice
import rostest
from roslib.packages import find_node
from stiction_client import SANITIZER, TIMEOUT, wait_until

BAD = {"queue_sise": 5, "lower": {"hardness": -1.0}, "drop_policy": "newest"}
KEYS = ("queue_sise", "lower/hardness", "drop_policy", "newest")


def processor_time_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class BadParametersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("bad_parameters_test")

    def test_the_node_exits_and_names_every_key(self):
        rospy.set_param("/bad_node", BAD)
        ended = subprocess.run(
            [find_node("mems_stiction", "stiction_node")[0], "__name:=bad_node"],
            timeout=TIMEOUT,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            universal_newlines=True,
        )
        self.assertEqual(ended.returncode, 1, ended.stdout)
        for key in KEYS:
            self.assertIn(key, ended.stdout)

    def start(self, name, parameters, **environment):
        """What the node of this name says that refuses its parameters, and its processor time
        [s]."""
        rospy.set_param("/" + name, parameters)
        before = processor_time_of_children()
        ended = subprocess.run(
            [find_node("mems_stiction", "stiction_node")[0], "__name:=" + name],
            timeout=TIMEOUT,
            env=dict(os.environ, **environment),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
        )
        rospy.delete_param("/" + name)
        self.assertEqual(ended.returncode, 1, ended.stdout[:1000])
        return ended.stdout, processor_time_of_children() - before

    def test_letters_beyond_ascii_are_written_as_they_are_in_every_locale(self):
        for locale in ("C", "C.UTF-8"):
            self.assertIn(
                "Härte: '1' is given", self.start("umlaut_node", {"Härte": 1.0}, LC_ALL=locale)[0]
            )

    def test_what_is_long_or_much_is_refused_soon_and_in_short(self):
        for number, (parameters, words) in enumerate(
            (
                (
                    {"drop_policy": 100000 * "a"},
                    ("~drop_policy: 'aaaa", "... (100000 bytes)' is not allowed"),
                ),
                (
                    {100000 * "k": 100000 * "a"},
                    ("kkk... (100000 bytes): 'aaaa", "there is no such setting"),
                ),
                (
                    {"part": {"id": 5000000 * "p"}},
                    ("~part/id: a text of 5000000 bytes is not allowed",),
                ),
                (
                    {"unknown_%d" % number: number for number in range(10000)},
                    ("unknown_1: '1'", "9900 more keys are given"),
                ),
            )
        ):
            said, seconds = self.start("long_node_%d" % number, parameters)
            for word in words:
                self.assertTrue(word in said, "%s is not in %s" % (word, said[:1000]))
            self.assertLess(len(said), 50000)
            self.assertLess(seconds, 5.0)  # 10,000 unknown ones had taken 12 s

    def test_no_word_of_a_file_reaches_the_log(self):
        with tempfile.TemporaryDirectory() as folder:
            secret = pathlib.Path(folder, "secret.txt")
            secret.write_text("hunter2 hunter2\n")
            for path, reason in (
                (str(secret), "cannot be used"),
                ("/etc/passwd", "must lie below"),
            ):
                rospy.set_param(
                    "/curious_node",
                    {"counter_surface": {"type": "file", "facing": "up", "file": path}},
                )
                ended = subprocess.run(
                    [find_node("mems_stiction", "stiction_node")[0], "__name:=curious_node"],
                    timeout=TIMEOUT,
                    env=dict(os.environ, MEMS_STICTION_SCAN_FOLDERS=folder),
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    universal_newlines=True,
                )
                self.assertEqual(ended.returncode, 1, ended.stdout)
                self.assertIn("counter_surface/file: %s" % path, ended.stdout)
                self.assertIn(reason, ended.stdout)
                for word in ("hunter2", "root"):
                    self.assertNotIn(word, ended.stdout.replace(str(pathlib.Path.home()), ""))

    @unittest.skipIf(
        SANITIZER, "the manager of nodelets has no sanitizer in it, and cannot load what has"
    )
    def test_the_nodelet_names_every_key_and_its_manager_lives(self):
        rospy.set_param("/bad_nodelet", BAD)
        manager = subprocess.Popen(
            ["rosrun", "nodelet", "nodelet", "manager", "__name:=bad_manager"],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            universal_newlines=True,
        )
        try:
            rospy.wait_for_service("/bad_manager/load_nodelet", timeout=TIMEOUT)
            loader = subprocess.Popen(
                [
                    "rosrun",
                    "nodelet",
                    "nodelet",
                    "load",
                    "mems_stiction/StictionNodelet",
                    "bad_manager",
                    "__name:=bad_nodelet",
                ],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            said = []
            reader = threading.Thread(
                target=lambda: said.extend(iter(manager.stdout.readline, "")), daemon=True
            )
            reader.start()
            wait_until(
                lambda: all(key in "".join(said) for key in KEYS),
                "the name of every key in %s" % said,
            )
            self.assertIsNone(manager.poll())
            self.assertNotIn("/bad_nodelet/set_load", rosservice.get_service_list())
            loader.terminate()
            loader.wait(timeout=TIMEOUT)
        finally:
            manager.terminate()
            manager.wait(timeout=TIMEOUT)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "bad_parameters", BadParametersTest)
