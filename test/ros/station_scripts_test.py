#!/usr/bin/env python3
"""sweep_load and cycle_contact as a tester calls them: a table, sentences, files, Ctrl-C, an exit
status."""

import csv
import os
import signal
import subprocess
import tempfile
import time
import unittest

import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
from mems_stiction.msg import (
    CycleContactActionFeedback,
    StictionPrediction,
    SweepLoadActionFeedback,
)
from roslib.packages import find_node
from stiction_client import TIMEOUT, Collector, Station, rough_surface, wait_until

DONE, CANCELLED, NOT_RUN = 0, 1, 2
PNG = b"\x89PNG"


def start(program, *arguments):
    return subprocess.Popen(
        [find_node("mems_stiction", program)[0]] + list(arguments),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        universal_newlines=True,
    )


def run(program, *arguments):
    process = start(program, *arguments)
    output, errors = process.communicate(timeout=TIMEOUT)
    return process.returncode, output, errors


class StationScriptsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("station_scripts_test")
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()
        cls.folder = tempfile.TemporaryDirectory()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def rows(self, name):
        with open(self.path(name), newline="") as stream:
            return list(csv.DictReader(stream))

    def assert_picture(self, name):
        with open(self.path(name), "rb") as stream:
            self.assertEqual(stream.read(4), PNG)

    def test_1_what_is_refused_is_said_in_one_line(self):
        for program, arguments, reason in (
            ("sweep_load", ["--voltages", "0"], "sweep_load: no scan yet"),
            ("sweep_load", ["--voltages", "0:10:0"], "--voltages"),
            ("cycle_contact", ["--count", "2"], "cycle_contact: no scan yet"),
            ("cycle_contact", ["--count", "0"], "--count: 0 is not allowed"),
            (
                "cycle_contact",
                ["--count", "1", "--node", "nobody", "--timeout", "0.5"],
                "no action nobody/cycle_contact",
            ),
        ):
            status, output, errors = run(program, *arguments)
            self.assertEqual((status, output), (NOT_RUN, ""))
            self.assertIn(reason, errors)
            self.assertNotIn("Traceback", errors)
            self.assertNotIn("[ERROR]", errors)

    def test_2_a_sweep_shows_both_ways_and_what_they_say(self):
        self.station.send(rough_surface(1))
        prediction = self.predictions.wait(1)[0]
        status, output, errors = run("sweep_load", "--voltages", "10,5")
        self.assertEqual(
            (status, errors),
            (NOT_RUN, "sweep_load: voltages: 5 V after 10 V is not allowed, must ascend\n"),
        )
        status, output, errors = run(
            "sweep_load",
            "--voltages",
            "0:20:5",
            "--csv",
            self.path("sweep.csv"),
            "--plot",
            self.path("sweep.png"),
        )
        self.assertEqual(status, DONE, errors)
        lines = output.splitlines()
        self.assertEqual(
            [line.split()[:3] for line in lines[2:11]],
            [
                ["up", "0", "V"],
                ["up", "5.00", "V"],
                ["up", "10.0", "V"],
                ["up", "15.0", "V"],
                ["up", "20.0", "V"],
                ["down", "15.0", "V"],
                ["down", "10.0", "V"],
                ["down", "5.00", "V"],
                ["down", "0", "V"],
            ],
        )
        self.assertTrue(all(len(line) <= 140 for line in lines))
        for sentence in (
            "margin at least 1 after voltages up to: ",
            "sticks, after voltages of: ",
            "opens on the way down at: ",
            "hysteresis, widest at",
            "Pull-in voltage: ",
        ):
            self.assertIn(sentence, output)
        rows = self.rows("sweep.csv")
        self.assertEqual(len(rows), 9)
        self.assertEqual(float(rows[0]["pull_off_force"]), prediction.pull_off_force)
        self.assertEqual(float(rows[0]["margin"]), prediction.margin)
        # At the same voltage the flattened contact is no smaller on the way down.
        up = {row["voltage"]: float(row["contact_area"]) for row in rows[:5]}
        closed = [row for row in rows[5:] if row["is_open"] == "0"]
        self.assertTrue(closed)
        for row in closed:
            self.assertGreaterEqual(float(row["contact_area"]), up[row["voltage"]])
        self.assert_picture("sweep.png")

    def test_3_cycles_show_what_the_contacts_leave(self):
        status, output, errors = run(
            "cycle_contact",
            "--count",
            "4",
            "--csv",
            self.path("cycles.csv"),
            "--plot",
            self.path("cycles.png"),
        )
        self.assertEqual(status, DONE, errors)
        self.assertEqual(
            [line.split()[0] for line in output.splitlines()[2:6]], ["1", "2", "3", "4"]
        )
        self.assertIn("From contact 1 to contact 4 the pull-off force stays at", output)
        self.assertIn("From contact 2 on nothing flows any more", output)
        self.assertIn("the lowest margin is", output)
        rows = self.rows("cycles.csv")
        self.assertEqual([row["cycle"] for row in rows], ["1", "2", "3", "4"])
        self.assertEqual(
            float(rows[0]["pull_off_force"]), self.predictions.messages[-1].pull_off_force
        )
        self.assertGreater(float(rows[0]["largest_change"]), 0.0)
        self.assert_picture("cycles.png")

    def test_3b_a_long_table_says_what_it_does_not_show(self):
        status, output, errors = run(
            "cycle_contact", "--count", "45", "--csv", self.path("many.csv")
        )
        self.assertEqual(status, DONE, errors)
        self.assertIn("40 of 45 contacts are shown", output)
        rows = self.rows("many.csv")
        self.assertEqual(len(rows), 45)
        self.assertRegex(rows[0]["settings_hash"], "^[0-9a-f]{16}$")
        self.assertEqual(rows[0]["settings_hash"], self.predictions.messages[-1].settings_hash)

    def test_3b2_why_there_is_no_margin_is_said(self):
        scans = len(self.predictions.messages)
        coarse = np.random.RandomState(8).normal(scale=5e-9, size=(64, 64)).astype(np.float32)
        self.station.send(coarse)
        prediction = self.predictions.wait(scans + 1)[scans]
        self.assertIn("the scan does not show what holds", prediction.reason)
        for program, arguments in (
            ("sweep_load", ["--voltages", "0,5"]),
            ("cycle_contact", ["--count", "2"]),
        ):
            status, output, errors = run(program, *arguments)
            self.assertEqual(status, DONE, errors)
            self.assertIn("There is no margin: the scan does not show what holds", output)
            self.assertNotIn("it needs device/spring_stiffness", output)

    def test_3c_what_pull_in_lacks_is_named(self):
        settings = rospy.get_param("stiction_node/device/electrode_area")
        client = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)
        client.update_configuration({"electrode_area": 0.0})
        status, output, errors = run("sweep_load", "--voltages", "0")
        client.update_configuration({"electrode_area": settings})
        self.assertEqual(status, DONE, errors)
        self.assertIn("Pull-in voltage: not stated (device/electrode_area)", output)

    def test_3d_a_file_that_cannot_be_written_is_said_before_the_run(self):
        for option in ("--csv", "--plot"):
            status, output, errors = run(
                "sweep_load", "--voltages", "0", option, self.path("nowhere/out.png")
            )
            self.assertEqual((status, output), (NOT_RUN, ""))
            self.assertRegex(errors, r"^sweep_load: %s: \S+ cannot be written: .*\n$" % option)

    def test_3e_without_a_master_the_timeout_holds(self):
        environment = dict(os.environ, ROS_MASTER_URI="http://localhost:1")
        for call, status in (
            (["sweep_load", "--voltages", "0"], NOT_RUN),
            (["cycle_contact", "--count", "1"], NOT_RUN),
            (["set_load", "--voltage", "1"], 1),
            (["print_predictions"], 1),
        ):
            begin = time.monotonic()
            done = subprocess.run(
                [find_node("mems_stiction", call[0])[0]] + call[1:] + ["--timeout", "0.5"],
                env=environment,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
                timeout=TIMEOUT,
            )
            self.assertEqual(done.returncode, status)
            self.assertIn("no ROS master at http://localhost:1", done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertLess(time.monotonic() - begin, 60.0)  # a loaded machine starts Python slowly

    def test_3f_set_load_says_what_it_changes(self):
        status, output, errors = run("set_load", "--voltage", "10")
        self.assertEqual(status, DONE, errors)
        for words in (
            "10.0 V and 1.00 uN from here on, before 0 V and 1.00 uN",
            "Electrostatic force",
            "The contact area",
            "The pull-off force",
        ):
            self.assertIn(words, output)
        self.assertEqual(run("set_load", "--voltage", "0")[0], DONE)

    def test_4_ctrl_c_ends_early_and_keeps_what_is_done(self):
        self.station.send(rough_surface(2, rows=128, cols=128))
        self.predictions.wait(2)
        feedback = {
            "sweep_load": Collector(
                "stiction_node/sweep_load/feedback", SweepLoadActionFeedback
            ).connect(),
            "cycle_contact": Collector(
                "stiction_node/cycle_contact/feedback", CycleContactActionFeedback
            ).connect(),
        }
        for program, arguments in (
            ("sweep_load", ["--voltages", "0:40:0.0001"]),
            ("cycle_contact", ["--count", "1000000"]),
        ):
            process = start(program, *(arguments + ["--csv", self.path(program + ".csv")]))
            del feedback[program].messages[:]
            feedback[program].wait(3)
            process.send_signal(signal.SIGINT)
            output, errors = process.communicate(timeout=TIMEOUT)
            self.assertEqual(process.returncode, CANCELLED, errors)
            self.assertIn("%s: ended early: cancelled" % program, errors)
            self.assertNotIn("Traceback", errors)
            count = len(self.rows(program + ".csv"))
            self.assertGreater(count, 0)
            self.assertLess(count, 800000)
            self.assertLess(len(output.splitlines()), 120)

    def wait_until_it_loads(self, process):
        """Python itself has begun and takes SIGINT; then the program says what becomes of it, and
        loads the rest."""

        def has(field, number):
            with open("/proc/%d/status" % process.pid) as stream:
                signals = [line for line in stream if line.startswith(field)]
            return bool(signals) and bool(int(signals[0].split()[1], 16) >> (number - 1) & 1)

        looks = []

        def says_what_becomes_of_it():
            # Python ignores SIGPIPE first and then takes SIGINT, at once; a few looks in a row lie
            # behind both.
            looks.append(has("SigIgn", signal.SIGPIPE) and not has("SigCgt", signal.SIGINT))
            return len(looks) > 3 and all(looks[-4:])

        wait_until(lambda: process.poll() is not None or says_what_becomes_of_it(), "the program")

    def test_5_ctrl_c_all_over_a_program_leaves_one_line_and_no_half_file(self):
        """While it loads, while it runs, and a second time while it ends."""
        cases = [
            (
                "sweep_load",
                [
                    "--voltages",
                    "0:40:0.001",
                    "--csv",
                    self.path("cut.csv"),
                    "--plot",
                    self.path("cut.png"),
                ],
            ),
            ("cycle_contact", ["--count", "1000000", "--csv", self.path("cut.csv")]),
            ("print_predictions", []),
            ("plot_trend", ["--output", self.path("cut.png")]),
            ("plot_scan", ["--output", self.folder.name]),
            ("set_load", ["--voltage", "0"]),
        ]
        for program, arguments in cases:
            for begin, pause in (
                ((0.0, None), (3.0, 0.01), (3.0, 0.5))
                if program == "cycle_contact"
                else ((0.0, None), (3.0, 0.3))
            ):
                self.interrupt(program, arguments, (begin, pause))

    def interrupt(self, program, arguments, pauses):
        """Presses Ctrl-C after each of the pauses [s] (None: not), and looks at what is left."""
        case = "%s, Ctrl-C after %s s" % (program, pauses)
        process = start(program, *arguments)
        self.wait_until_it_loads(process)
        for seconds in pauses:
            if seconds is not None and process.poll() is None:
                time.sleep(seconds)
                process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=TIMEOUT)
        self.assertNotIn("Traceback", errors, case)
        self.assertIn(
            process.returncode, (-signal.SIGINT, DONE, CANCELLED), "%s: %s" % (case, errors)
        )
        if errors and process.returncode == -signal.SIGINT:
            self.assertEqual(errors.splitlines()[-1], program + ": interrupted", case)
        self.assertEqual(
            [name for name in os.listdir(self.folder.name) if ".part" in name], [], case
        )
        if os.path.exists(self.path("cut.csv")):
            with open(self.path("cut.csv")) as stream:
                lines = stream.read().split("\n")
            self.assertEqual(lines[-1], "", case)
            self.assertEqual({line.count(",") for line in lines[:-1]}, {lines[0].count(",")}, case)
            os.remove(self.path("cut.csv"))
        if os.path.exists(self.path("cut.png")):
            with open(self.path("cut.png"), "rb") as stream:
                self.assertTrue(stream.read().endswith(b"IEND\xaeB`\x82"), case)
            os.remove(self.path("cut.png"))


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "station_scripts", StationScriptsTest)
