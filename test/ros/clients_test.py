#!/usr/bin/env python3
"""The programs that doc/ros_api.md shows: both are taken from the page, compiled and run.
Longer than ten seconds: a compiler at work."""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rospkg
import rospy
import rostest
from stiction_client import PITCH, TIMEOUT, rough_surface

REPOSITORY = pathlib.Path(rospkg.RosPack().get_path("mems_stiction"))
ANSWER = r"die 7: does it stick\? (no|marginal|yes|unknown): .+"


def shown(language):
    """The only block of a language on the page."""
    page = (REPOSITORY / "doc" / "ros_api.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```%s\n(.*?)```" % language, page, re.DOTALL)
    return block


def headers():
    """The folders of the messages' headers: beside the Python modules of the messages."""
    import mems_stiction.msg

    module = pathlib.Path(mems_stiction.msg.__file__)
    return [
        "-I%s" % (folder / "include") for folder in module.parents if (folder / "include").is_dir()
    ]


class ClientsTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def start(self, *command):
        program = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True
        )
        self.addCleanup(program.stdout.close)
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        return program

    def listener(self):
        """The C++ program, at work."""
        (self.folder / "listener.cpp").write_text(shown("cpp"))
        flags = subprocess.run(
            ["pkg-config", "--cflags", "--libs", "roscpp"],
            check=True,
            stdout=subprocess.PIPE,
            universal_newlines=True,
        ).stdout.split()
        program = str(self.folder / "listener")
        subprocess.run(
            ["c++", "-std=c++17", "-Wall", "-Wextra", "-Werror", str(self.folder / "listener.cpp")]
            + headers()
            + flags
            + ["-o", program],
            check=True,
            timeout=TIMEOUT,
        )
        return self.start("stdbuf", "-oL", program)

    def test_the_driver_sends_a_scan_and_both_print_its_verdict(self):
        listener = self.listener()
        np.save(str(self.folder / "scan.npy"), rough_surface(1).astype(float))
        (self.folder / "send_scan.py").write_text(shown("python"))
        driver = self.start(
            sys.executable,
            str(self.folder / "send_scan.py"),
            str(self.folder / "scan.npy"),
            repr(PITCH),
            "die 7",
        )
        told, _ = driver.communicate(timeout=TIMEOUT)
        self.assertEqual(driver.returncode, 0, told)
        *_, change, answer = told.splitlines()
        self.assertIn("voltage stays at 0 V", change)
        self.assertRegex(answer, "^%s$" % ANSWER)
        line = ""
        while "does it stick?" not in line:  # latched: it may have come before the scan
            line = listener.stdout.readline()
            self.assertNotEqual(line, "", "the listener ended")
        self.assertIn(answer, line)


if __name__ == "__main__":
    rospy.init_node("clients_test")
    rostest.rosrun("mems_stiction", "clients", ClientsTest)
