#!/usr/bin/env python3
"""The example station script as a station runs it: a bag, steps of voltage, an exit status."""

import os
import signal
import subprocess
import tempfile
import unittest

import dynamic_reconfigure.client
import rosbag
import rosnode
import rospy
import rostest
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import GetLoad
from roslib.packages import find_node
from std_msgs.msg import String
from stiction_client import TIMEOUT, make_bag

PASS, FAIL, NOT_MADE = 0, 1, 2


class StationCheckTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("station_check_test")
        rospy.wait_for_service("stiction_node/get_load", timeout=TIMEOUT)
        cls.folder = tempfile.TemporaryDirectory()
        cls.bag = os.path.join(cls.folder.name, "scans.bag")
        make_bag(cls.bag, "--count", "2", "--rows", "128", "--cols", "128", "--rms-height", "5e-9")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_check(self, *arguments, **changes):
        command = [
            find_node("mems_stiction", "station_check")[0],
            "--bag",
            changes.get("bag", self.bag),
        ]
        return subprocess.run(
            command + list(arguments),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
            timeout=TIMEOUT,
        )

    def assert_load_is_put_back(self):
        load = rospy.ServiceProxy("stiction_node/get_load", GetLoad)()
        self.assertEqual((load.voltage, load.mechanical_load), (0.0, 1e-6))

    def test_a_device_within_its_limits_passes_with_a_line_for_each_step(self):
        done = self.run_check("--voltages", "0,10,20", "--max-pull-off-force", "1e-3")
        self.assertEqual(done.returncode, PASS, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 6, done.stdout)
        self.assertEqual(
            [line.split("  ")[0] for line in lines],
            ["scan 1", "scan 2", "0 V", "10.0 V", "20.0 V", "PASS"],
        )
        self.assertTrue(all(line.endswith("  ok") for line in lines[:-1]), done.stdout)
        self.assert_load_is_put_back()

    def test_a_device_that_holds_too_strongly_fails_and_the_line_says_why(self):
        done = self.run_check("--voltages", "0,20", "--max-pull-off-force", "1e-12")
        self.assertEqual(done.returncode, FAIL, done.stderr)
        self.assertIn("FAIL: pull-off force above 1.00 pN", done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], "FAIL")
        self.assert_load_is_put_back()

    def test_predictions_of_an_earlier_run_decide_nothing(self):
        recorded = os.path.join(self.folder.name, "recorded.bag")
        with rosbag.Bag(self.bag) as scans, rosbag.Bag(recorded, "w") as bag:
            for topic, message, when in scans.read_messages():
                bag.write(topic, message, when)
                if topic == "/height":
                    bag.write(
                        "/prediction",
                        StictionPrediction(header=message.header, status=StictionPrediction.BONDED),
                        when,
                    )
        done = self.run_check("--max-pull-off-force", "1e-3", bag=recorded)
        self.assertEqual(done.returncode, PASS, done.stdout + done.stderr)
        self.assertNotIn("bond", done.stdout)

    def test_scans_of_one_stamp_and_in_a_burst_are_scans_of_their_own(self):
        odd = os.path.join(self.folder.name, "odd.bag")
        with rosbag.Bag(self.bag) as scans, rosbag.Bag(odd, "w") as bag:
            found = list(scans.read_messages())
            for topic, message, when in found:  # all images, then all scan_info
                bag.write(
                    topic, message, when + rospy.Duration(5.0 if topic == "/scan_info" else 0.0)
                )
            for topic, message, when in found:
                message.header.stamp = rospy.Time(0)
                bag.write(topic, message, when + rospy.Duration(10.0))
        done = self.run_check("--max-pull-off-force", "1e-3", bag=odd)
        self.assertEqual(done.returncode, PASS, done.stdout + done.stderr)
        forces = [
            line.split("force")[1].split("contact")[0] for line in done.stdout.splitlines()[:4]
        ]
        self.assertEqual(forces[:2], forces[2:], done.stdout)
        self.assertNotEqual(forces[0], forces[1])

    def test_the_verdict_on_the_device_decides(self):
        done = self.run_check("--verdict")
        self.assertEqual(done.returncode, FAIL, done.stderr)
        self.assertIn("FAIL: sticks: unknown, ", done.stdout)  # no device is stated
        settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)
        device = dict(spring_stiffness=160.0, travel=1e-6, contact_area=1.6e-12)
        smooth = os.path.join(
            self.folder.name, "smooth.bag"
        )  # so smooth that more than ten contacts hold at the pull-off
        make_bag(smooth, "--count", "5", "--rows", "128", "--cols", "128", "--rms-height", "5e-10")
        for change, status, line in (
            (device, PASS, "PASS"),
            (dict(spring_stiffness=1e-6), FAIL, "FAIL: sticks: yes, margin "),
        ):
            settings.update_configuration(change)
            done = self.run_check("--verdict", bag=smooth)
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
            self.assertIn(line, done.stdout)
            # No scan states a part: each has a device of its own, however long that takes, and the
            # last one once more under the voltage.
            self.assertEqual(
                [text.split("  ")[0] for text in done.stdout.splitlines()[0:12:2]],
                ["scan %d" % number for number in range(1, 6)] + ["0 V"],
            )
            self.assertTrue(
                all(
                    text.startswith("  the device ") and ", by 1 scan together  " in text
                    for text in done.stdout.splitlines()[1:12:2]
                ),
                done.stdout,
            )
        settings.update_configuration(device)
        part = os.path.join(self.folder.name, "part.bag")
        make_bag(
            part,
            "--count",
            "3",
            "--rows",
            "128",
            "--cols",
            "128",
            "--rms-height",
            "5e-10",
            "--part-id",
            "lot 3",
            "--seed",
            "7",
        )
        done = self.run_check("--verdict", bag=part)
        self.assertEqual(done.returncode, PASS, done.stdout + done.stderr)
        self.assertEqual(done.stdout.count("by 3 scans together  ok"), 2, done.stdout)
        # Surfaces that take longer than anybody waits for them are no verdict.
        settings.update_configuration(
            dict(contact_area=1e-8)
        )  # as many pixels as the launch file allows
        done = self.run_check("--verdict", "--device-timeout", "1e-9", bag=part)
        self.assertEqual(done.returncode, NOT_MADE, done.stdout)
        self.assertIn(
            "did not come on the topic device_force for 1e-09 s (--device-timeout)", done.stderr
        )
        self.assert_load_is_put_back()
        settings.update_configuration({name: 0.0 for name in device})

    def test_limits_that_no_device_has_are_refused(self):
        for arguments in (
            ["--max-pull-off-force=-1e-9"],
            ["--max-pull-off-force=nan"],
            ["--max-pull-off-force=inf"],
            ["--max-contact-fraction=-0.1"],
            ["--max-contact-fraction=40"],
            ["--verdict", "--load=-1e-6"],
            ["--verdict", "--timeout=0"],
        ):
            done = self.run_check(*arguments)
            self.assertEqual(done.returncode, NOT_MADE, done.stdout)
            self.assertIn("is not allowed, must be", done.stderr)

    def test_no_dead_node_stays_at_the_master_however_it_ends(self):
        def ours():
            return [
                name
                for name in rosnode.get_node_names()
                if name.startswith("/station_check") and name != rospy.get_name()
            ]

        long_bag = os.path.join(self.folder.name, "long.bag")
        make_bag(long_bag, "--count", "100", "--rows", "64", "--cols", "64")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            check = subprocess.Popen(
                [
                    find_node("mems_stiction", "station_check")[0],
                    "--bag",
                    long_bag,
                    "--voltages",
                    "5",
                    "--max-contact-fraction",
                    "1",
                ],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
            )
            check.stdout.readline()
            check.send_signal(number)
            error = check.communicate(timeout=TIMEOUT)[1]
            self.assertIn("station_check: interrupted", error)
            self.assertEqual(ours(), [], number)
            self.assert_load_is_put_back()
        self.run_check("--max-contact-fraction", "0.9")
        self.assertEqual(ours(), [])

    def test_what_cannot_be_checked_neither_passes_nor_fails(self):
        other, damaged = (
            os.path.join(self.folder.name, name) for name in ("other.bag", "damaged.bag")
        )
        with rosbag.Bag(other, "w") as bag:
            bag.write("height", String("no scan"))
        long_text = os.path.join(self.folder.name, "long_text.bag")
        with open(self.bag, "rb") as stream:
            whole = stream.read()
        with rosbag.Bag(self.bag) as bag:
            encoding = next(
                message for _, message, _ in bag.read_messages(topics=["/height"])
            ).encoding.encode()
        for name, place, byte in (
            (damaged, whole.rindex(b"op=\x02") + 3, 0x7F),  # the kind of its last message
            (long_text, whole.rindex(encoding) - 1, 0x7F),
        ):  # a length of 2 GB
            with open(name, "wb") as copy:
                copy.write(whole[:place] + bytes([byte]) + whole[place + 1 :])
        for arguments, changes, reason in [
            (
                ["--timeout", "1"],
                {"bag": other},
                "nobody takes the topic /height of the bag, type std_msgs/String",
            ),
            ([], {"bag": damaged}, "damaged.bag cannot be read: "),
            ([], {"bag": long_text}, "long_text.bag cannot be read: a message in it is damaged ("),
            (["--voltages", "0,99"], {}, "99 V was refused"),
            ([], {"bag": "/no/such.bag"}, "/no/such.bag cannot be read"),
            (["--node", "nobody", "--timeout", "0.5"], {}, "no service nobody/set_load"),
        ]:
            done = self.run_check("--max-contact-fraction", "0.9", *arguments, **changes)
            self.assertEqual(done.returncode, NOT_MADE, done.stdout)
            self.assertIn(reason, done.stderr)
            self.assert_load_is_put_back()

    def test_an_output_that_is_closed_or_full_neither_passes_nor_fails(self):
        call = [
            find_node("mems_stiction", "station_check")[0],
            "--bag",
            self.bag,
            "--max-contact-fraction",
            "0.9",
        ]
        for output in (">&-", ">/dev/full"):
            done = subprocess.run(
                ["sh", "-c", 'exec "$@" ' + output, "sh"] + call,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                stdin=subprocess.DEVNULL,
                universal_newlines=True,
                timeout=TIMEOUT,
            )
            self.assertEqual(done.returncode, NOT_MADE, done.stderr)
            self.assertRegex(
                done.stderr,
                "^station_check: not decided: what is .*(closed|No space left on device)\n$",
            )
            self.assert_load_is_put_back()

    def test_ctrl_c_puts_the_load_back_too(self):
        voltages = ",".join("%g" % (0.001 * step) for step in range(1, 20001))
        process = subprocess.Popen(
            [
                find_node("mems_stiction", "station_check")[0],
                "--bag",
                self.bag,
                "--voltages",
                voltages,
                "--load",
                "2e-6",
                "--max-pull-off-force",
                "1e-3",
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
        )
        self.addCleanup(process.kill)
        lines = [process.stdout.readline() for _ in range(5)]
        self.assertRegex(lines[-1], r"V .*  ok\n$")
        load = rospy.ServiceProxy("stiction_node/get_load", GetLoad)()
        self.assertGreater(load.voltage, 0.0)
        self.assertEqual(load.mechanical_load, 2e-6)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=TIMEOUT)
        self.assertEqual(
            (process.returncode, errors), (-signal.SIGINT, "station_check: interrupted\n")
        )
        self.assertNotIn("PASS", output)
        self.assert_load_is_put_back()

    def test_a_check_without_a_limit_is_refused(self):
        done = self.run_check()
        self.assertEqual(done.returncode, NOT_MADE)
        self.assertIn("no limit", done.stderr)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "station_check", StationCheckTest)
