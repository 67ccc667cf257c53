"""Slips of a test engineer at programs and scripts: each is one sentence with what is allowed, no
traceback, and no file is lost."""

import base64
import csv
import hashlib
import io
import json
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np
import rosbag
from mems_stiction.msg import StictionPrediction
from roslib.packages import find_node

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from one_process import run_in_one_process  # noqa: E402  (the path comes first)
from tiers import times  # noqa: E402

BAD_INPUT = 2
WIPED = b"\r\x1b[K"
LONGEST_SILENCE = 300.0  # of a program [s]; a work that lasts says so each second


def rough(size=24):
    waves = np.sin(np.arange(size) / 2.0)
    return 1e-9 * np.outer(waves, np.cos(np.arange(size) / 3.0))


class Terminal:
    """A program whose standard error is a terminal of the test's own, for as long as the block
    runs. has_output: the standard output is the same terminal."""

    def __init__(self, folder, name, *arguments, has_output=False, **environment):
        try:
            self._ours, theirs = pty.openpty()
        except OSError as error:
            raise unittest.SkipTest("there is no pseudo-terminal here: %s" % error)
        self.shown = b""
        try:
            # what it ignores in the background, a terminal's program does not
            self.process = subprocess.Popen(
                [find_node("mems_stiction", name)[0]] + list(arguments),
                cwd=str(folder),
                stdout=theirs if has_output else subprocess.DEVNULL,
                stderr=theirs,
                env=dict(os.environ, **dict({"TERM": "xterm"}, **environment)),
                stdin=subprocess.DEVNULL,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
            )
        finally:
            os.close(theirs)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        os.close(self._ours)

    def read(self):
        """Whether there was more."""
        if not select.select([self._ours], [], [], LONGEST_SILENCE)[0]:
            raise AssertionError("nothing more after %r" % self.shown)
        try:
            part = os.read(self._ours, 4096)
        except OSError:  # the other end is closed
            part = b""
        self.shown += part
        return bool(part)

    def until(self, words):
        while words not in self.shown:
            if not self.read():
                raise AssertionError("it ended with %r" % self.shown)

    def until_it_ends(self, status):
        """All that it has written."""
        while self.read():
            pass
        ended = self.process.wait(timeout=LONGEST_SILENCE)
        assert ended == status, (ended, self.shown)
        return self.shown


class SlipTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        np.save(str(self.folder / "scan.npy"), rough())
        (self.folder / "scan.npy.yaml").write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        (self.folder / "folder.bag").mkdir()
        (self.folder / "empty.bag").write_text("")
        (self.folder / "text.bag").write_text("no bag at all, but some words")

    def run_it(self, name, *arguments, master="http://localhost:1"):
        program = find_node("mems_stiction", name)[0]
        environment = dict(os.environ, ROS_MASTER_URI=master)
        return subprocess.run(
            [program] + [str(part) for part in arguments],
            cwd=str(self.folder),
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
            timeout=300,
        )

    def assert_refused(self, expected, name, *arguments, status=BAD_INPUT):
        done = self.run_it(name, *arguments)
        with self.subTest(call=(name,) + arguments):
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
            self.assertIn(expected, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertNotIn("basic_filebuf", done.stderr)
            self.assertEqual(done.stderr.rstrip().splitlines()[-1].split(":")[0], name)

    def test_every_program_says_its_version(self):
        """Those that are installed, by the list of the build."""
        lists = (pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt").read_text()
        scripts = re.findall(
            r"scripts/(\w+)(?=[\s)])",
            re.search(r"catkin_install_python\(PROGRAMS(.*?)DESTINATION", lists, re.DOTALL).group(1)
            + " ",
        )
        programs = re.search(r"set\(core_programs ([^)]*)\)", lists).group(1).split() + [
            "stiction_node",
            "make_scan_bag",
        ]
        self.assertGreater(len(scripts) + len(programs), 20)
        for name in programs:
            done = self.run_it(name, "--version")
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertRegex(done.stdout, r"^%s of mems_stiction \d+\.\d+\.\d+\n$" % name)
        answers = run_in_one_process(
            [find_node("mems_stiction", name)[0], "--version"] for name in scripts
        )
        for name, (status, out, err) in zip(scripts, answers):
            self.assertEqual((status, err), (0, ""), name)
            self.assertRegex(out, r"^%s of mems_stiction \d+\.\d+\.\d+\n$" % name)

    def test_every_script_says_its_version(self):
        folder = pathlib.Path(__file__).resolve().parents[2] / "scripts"
        scripts = [
            script
            for script in folder.iterdir()
            if script.is_file() and script.read_bytes().startswith(b"#!/usr/bin/env bash")
        ]
        self.assertGreater(len(scripts), 10)
        for script in scripts:
            done = subprocess.run(
                [str(script), "--version"], capture_output=True, text=True, timeout=60
            )
            self.assertEqual((done.returncode, done.stderr), (0, ""), script.name)
            self.assertRegex(done.stdout, r"^%s of mems_stiction \d+\.\d+\.\d+\n$" % script.name)

    def test_bags_are_written_to_bags_alone_and_not_without_a_scan(self):
        before = (self.folder / "scan.npy").read_bytes()
        self.assert_refused("must end in .bag", "make_scan_bag", "-o", "scan.npy", "scan.npy")
        self.assertEqual((self.folder / "scan.npy").read_bytes(), before)
        self.assertEqual(self.run_it("make_scan_bag", "-o", "good.bag", "scan.npy").returncode, 0)
        before = (self.folder / "good.bag").read_bytes()
        self.assert_refused(
            "good.bag: not written: there is no scan for it",
            "make_scan_bag",
            "-o",
            "good.bag",
            "nowhere.npy",
        )
        self.assert_refused("not written", "make_scan_bag", "-o", "new.bag", "good.bag")
        self.assertEqual((self.folder / "good.bag").read_bytes(), before)
        self.assertFalse((self.folder / "new.bag").exists())
        self.assert_refused("there is no folder 'none'", "make_scan_bag", "-o", "none/a.bag")
        for option, value, expected in (
            ("--rate", "0", "'0' is not allowed, must be > 0"),
            ("--pitch", "-1e-9", "must be > 0"),
            ("--rms-height", "5nm", "'5nm' is not allowed, must be a number"),
            ("--ros", "3", "did you mean --rows"),
            ("--count", "0", "not in range"),
        ):
            self.assert_refused(expected, "make_scan_bag", "-o", "a.bag", option, value)

    def test_a_bag_is_never_written_through_a_link_that_lies_beside_it(self):
        victim = self.folder / "victim"
        victim.write_text("kept")
        # the name that was predictable: that of the bag with the number of the process, which is
        # the shell's
        call = 'ln -s victim "guess.bag.$$"; exec "$0" -o guess.bag --pitch 1e-8 scan.npy'
        subprocess.run(
            ["sh", "-c", call, find_node("mems_stiction", "make_scan_bag")[0]],
            cwd=str(self.folder),
            check=True,
            timeout=300,
            stdout=subprocess.DEVNULL,
        )
        self.assertEqual(victim.read_text(), "kept")
        self.assertTrue((self.folder / "guess.bag").read_bytes().startswith(b"#ROSBAG V2.0"))
        self.assertFalse((self.folder / "guess.bag").is_symlink())

    def test_generated_surfaces_in_a_wrong_unit_are_warned_of(self):
        done = self.run_it(
            "make_scan_bag",
            "-o",
            "a.bag",
            "--rows",
            16,
            "--cols",
            16,
            "--pitch",
            "10",
            "--correlation-length",
            "20",
        )
        self.assertEqual(done.returncode, 0)
        self.assertIn("warning: pitch_x 10 m", done.stderr)

    def test_what_is_no_bag_is_a_row_that_says_so_and_a_line(self):
        for name, expected in (
            ("folder.bag", "is a folder, not a bag"),
            ("empty.bag", "is empty"),
            ("text.bag", "is not a bag, whatever its name says"),
            ("nowhere.bag", "no such file"),
        ):
            done = self.run_it("stiction_batch", "-o", name + ".csv", name)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stderr, "stiction_batch: %s: %s\n" % (name, expected))
            with (self.folder / (name + ".csv")).open(newline="") as stream:
                self.assertEqual(
                    [row["message"] for row in csv.DictReader(stream)],
                    ["%s: %s" % (name, expected)],
                )
        done = self.run_it(
            "stiction_batch", "-o", "many.csv", "nowhere.bag", "scan.npy", "empty.bag"
        )
        self.assertEqual(done.returncode, 0)
        self.assertIn("stiction_batch: the first of 2: nowhere.bag: no such file\n", done.stderr)

    def test_a_refused_scan_is_named(self):
        np.save(str(self.folder / "high.npy"), 1e9 * rough())
        (self.folder / "high.npy.yaml").write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        for name in ("stiction_batch -o rows.csv", "predict_scan"):
            program, *options = name.split()
            done = self.run_it(program, *options, "high.npy")
            self.assertRegex(
                done.stderr, "^%s: high.npy: implausible: heights range [^\n]*\n$" % program
            )
        done = self.run_it("stiction_report", "-o", "page.html", "high.npy", "scan.npy", "high.npy")
        self.assertIn("stiction_report: not predicted: high.npy: implausible", done.stderr)
        for options, status in (((), 0), (("--strict",), 1)):
            done = self.run_it(
                *("stiction_report", "--accept-implausible", "--steps", "0", *options),
                *("-o", "page.html", "high.npy"),
            )
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertTrue((self.folder / "page.html").exists())

    def test_batch_refuses_what_it_cannot_write(self):
        (self.folder / "folder.csv").mkdir()
        self.assert_refused("--output is required", "stiction_batch", "scan.npy")
        self.assert_refused(
            "must end in .csv or .jsonl", "stiction_batch", "-o", "rows.txt", "scan.npy"
        )
        self.assert_refused("folder.csv: ", "stiction_batch", "-o", "folder.csv", "scan.npy")
        self.assert_refused(
            "as in 1/4", "stiction_batch", "-o", "rows.csv", "--shard", "2", "scan.npy"
        )
        self.assert_refused(
            "--load: '1uN' is not allowed",
            "stiction_batch",
            "-o",
            "rows.csv",
            "--load",
            "1uN",
            "scan.npy",
        )

    def make_hole(self, name, begin=""):
        """A file of 100 GB that takes no disk."""
        with (self.folder / name).open("wb") as stream:
            stream.write(begin.encode())
            stream.truncate(100 << 30)

    def test_a_batch_reads_nothing_that_has_no_end(self):
        os.mkfifo(str(self.folder / "pipe.txt"))
        os.mkfifo(str(self.folder / "pipe.bag"))
        self.make_hole("hole.txt")
        not_a_file = "is a pipe, a socket or a device, not a file"
        too_large = "has 107374182400 bytes, more than the "
        for name, expected in (
            ("/dev/zero", not_a_file),
            ("pipe.txt", not_a_file),
            ("hole.txt", too_large + "100000000 of a list of inputs"),
        ):
            self.assert_refused(
                "%s: %s" % (name, expected), "stiction_batch", "-o", "q.csv", "--inputs-from", name
            )
        (self.folder / "picture.txt").write_bytes(bytes(1000))
        self.assert_refused(
            "picture.txt: is no list with an INPUT on each line",
            "stiction_batch",
            "-o",
            "q.csv",
            "--inputs-from",
            "picture.txt",
        )
        self.assertIn(
            "pipe.bag: " + not_a_file,
            self.run_it("stiction_batch", "-o", "bag.csv", "pipe.bag").stderr,
        )
        for rows in ("q.csv", "q.jsonl"):
            self.assertEqual(self.run_it("stiction_batch", "-o", rows, "scan.npy").returncode, 0)
            begin = (self.folder / rows).read_text()
            self.make_hole(rows, begin)
            self.assert_refused(
                "%s: %s4294967296 of a table of rows" % (rows, too_large),
                "stiction_batch",
                "-o",
                rows,
                "scan.npy",
            )
            self.assert_refused(
                "%s: %s4294967296 of a table of rows" % (rows, too_large),
                "stiction_batch",
                "--merge",
                "-o",
                "all" + rows[1:],
                rows,
            )
            (self.folder / rows).write_text("x" + begin)
            self.assert_refused(rows + ": line 1 ", "stiction_batch", "-o", rows, "scan.npy")
            self.make_hole(rows + ".settings.yaml")
            self.assert_refused(
                "%s.settings.yaml: %s268435456 of the settings" % (rows, too_large),
                "stiction_batch",
                "-o",
                rows,
                "scan.npy",
            )

    def test_no_output_waits_for_a_reader(self):
        for name in ("pipe.csv", "pipe.html", "pipe.png", "rows.csv.settings.yaml"):
            os.mkfifo(str(self.folder / name))
        expected = "is a pipe or a socket, must be a file"
        for call in (
            ("stiction_batch", "-o", "pipe.csv", "scan.npy"),
            ("stiction_batch", "-o", "rows.csv", "scan.npy"),
            ("stiction_batch", "-o", "q.csv", "--parts", "pipe.csv", "scan.npy"),
            ("sweep_load", "--voltages", "0", "--csv", "pipe.csv"),
            ("cycle_contact", "--count", "2", "--plot", "pipe.png"),
            ("export_predictions", "-o", "pipe.csv", "text.bag"),
            ("stiction_report", "-o", "pipe.html", "scan.npy"),
        ):
            self.assert_refused(expected, *call)

    def test_rows_may_go_nowhere(self):
        (self.folder / "null.csv").symlink_to("/dev/null")
        self.assertEqual(self.run_it("stiction_batch", "-o", "null.csv", "scan.npy").returncode, 0)

    def test_a_list_may_come_from_a_pipe_of_the_shell(self):
        done = subprocess.run(
            [
                find_node("mems_stiction", "stiction_batch")[0],
                "-o",
                "q.csv",
                "--inputs-from",
                "/dev/stdin",
            ],
            cwd=str(self.folder),
            input=b"scan.npy\n",
            stdout=subprocess.PIPE,
            timeout=300,
        )
        self.assertEqual(done.returncode, 0)

    def test_a_list_may_have_a_byte_order_mark_and_lines_of_windows(self):
        (self.folder / "list.txt").write_bytes(b"\xef\xbb\xbfscan.npy\r\n\r\n \t\r\n")
        done = self.run_it("stiction_batch", "-o", "list.csv", "--inputs-from", "list.txt")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len((self.folder / "list.csv").read_text().splitlines()), 2)

    def test_scripts_name_numbers_and_places_before_they_run(self):
        self.assert_refused("the decimal sign is a point", "sweep_load", "--voltages", "0,05")
        self.assert_refused("more than 1000000 numbers", "sweep_load", "--voltages", "0:30:1e-9")
        self.assert_refused("must be numbers", "sweep_load", "--voltages", "0:nan:5")
        self.assert_refused(
            "must end in .png, .pdf or .svg", "sweep_load", "--voltages", "0", "--plot", "out.jpg"
        )
        self.assert_refused(
            "must end in .png, .pdf or .svg", "cycle_contact", "--count", "2", "--plot", "out"
        )
        for count in ("0", "4294967296", "1099511627776"):
            self.assert_refused(
                "--count: %s is not allowed, must be in [1, 2147483647]" % count,
                "cycle_contact",
                "--count",
                count,
            )
        self.assert_refused(
            "'20V' is not allowed, must be a number", "set_load", "--voltage", "20V"
        )
        self.assert_refused(
            "'0,05' is not allowed, must be a number",
            "stiction_report",
            "-o",
            "r.html",
            "--voltage",
            "0,05",
            "scan.npy",
        )
        self.assert_refused(
            "the decimal sign is a point",
            "station_check",
            "--bag",
            "a.bag",
            "--verdict",
            "--voltages",
            "0,05",
        )
        self.assert_refused(
            "cannot be made", "plot_scan", "--output", "scan.npy", "--timeout", "0.3"
        )
        self.assert_refused(
            "no ROS master", "plot_scan", "--output", "pictures", "--timeout", "0.3", status=1
        )

    def test_an_address_of_the_master_that_is_none_is_named(self):
        addresses = (
            "localhost:11311",
            "http://localhost",
            "http://localhost:port",
            "https://localhost:11311",
        )
        calls = (
            ("set_load", "--voltage", "1"),
            ("sweep_load", "--voltages", "0"),
            ("print_predictions",),
            ("plot_trend",),
            ("station_page", "--port", "0"),
        )
        for number, call in enumerate(calls):  # one function reads the address for all of them
            for address in addresses[: times(1, 4)] if number else addresses:
                done = self.run_it(*call, master=address)
                with self.subTest(call=call, address=address):
                    self.assertIn(done.returncode, (1, BAD_INPUT))
                    self.assertEqual(
                        done.stderr,
                        "%s: ROS_MASTER_URI: '%s' is not allowed, must be an address as "
                        "http://localhost:11311\n" % (call[0], address),
                    )

    def test_an_output_that_is_closed_is_one_line(self):
        node = (
            "import rosgraph, rospy; from mems_stiction.station_node import become_node, "
            "run_program\n"
            "rosgraph.is_master_online = lambda: True\n"
            "rospy.init_node = lambda *_, **__: None\n"
            "def main():\n    become_node('a_node', 1.0)\n    print('a line', flush=True)\n    "
            "return 0\n"
            "run_program('a_node', main, 2)\n"
        )
        for output in (">&-", ">/dev/full"):
            done = subprocess.run(
                ["sh", "-c", 'exec python3 -c "$0" ' + output, node],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
                timeout=300,
            )
            with self.subTest(output=output):
                self.assertEqual(done.returncode, 2)
                self.assertRegex(
                    done.stderr,
                    "^a_node: what is (to be printed goes to an output that is closed|printed "
                    "cannot be written: No space left on device)\n$",
                )

    def test_a_long_wait_for_a_master_is_told(self):
        process = subprocess.Popen(
            [find_node("mems_stiction", "print_predictions")[0]],
            env=dict(os.environ, ROS_MASTER_URI="http://localhost:1"),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(
            process.stderr.readline(),
            "print_predictions: waits for a ROS master at http://localhost:1 (roscore or "
            "roslaunch)\n",
        )

    def test_too_few_open_files_are_said_at_the_start(self):
        for name in ("stiction_node", "scan_source", "station_page"):
            process = subprocess.Popen(
                ["sh", "-c", 'ulimit -n 64; exec "$0"', find_node("mems_stiction", name)[0]],
                env=dict(os.environ, ROS_MASTER_URI="http://localhost:1"),
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                universal_newlines=True,
            )
            self.addCleanup(process.stderr.close)
            self.addCleanup(process.wait)
            self.addCleanup(process.kill)
            self.assertRegex(
                process.stderr.readline(),
                "^%s: no more than 64 files and connections may be open .*ulimit -n" % name,
            )

    def test_bags_that_are_none_are_named_before_anybody_waits(self):
        self.assertEqual(self.run_it("make_scan_bag", "-o", "good.bag", "scan.npy").returncode, 0)
        good = (self.folder / "good.bag").read_bytes()
        (self.folder / "cut.bag").write_bytes(good[:5000])
        (self.folder / "index.bag").write_bytes(good[:-20])
        place = good.find(b"index_pos=") + 10
        index = int.from_bytes(good[place : place + 8], "little")
        for bag, expected in (
            ("folder.bag", "folder.bag cannot be read: is a folder, not a bag"),
            ("nowhere.bag", "nowhere.bag cannot be read: no such file"),
            (
                "cut.bag",
                "cut.bag cannot be read: was cut off, or is still being recorded; rosbag reindex "
                "cut.bag mends it",
            ),
            (
                "index.bag",
                "index.bag cannot be read: was cut off inside its index; truncate -s %d index.bag "
                "and then rosbag reindex index.bag mend it" % index,
            ),
        ):
            self.assert_refused(expected, "export_predictions", "-o", "a.csv", bag)
        self.assert_refused(
            "not decided: " + expected, "station_check", "--bag", bag, "--verdict"
        )  # reads it by the same function
        self.assertFalse((self.folder / "a.csv").exists())

    def test_bags_and_curves_without_end_are_named_before_they_are_read(self):
        os.mkfifo(str(self.folder / "pipe"))
        self.make_hole("hole")
        self.make_hole("begun", "#ROSBAG V2.0\n")
        not_a_file = "is a pipe, a socket or a device, not a file"
        for bag, expected in (
            ("pipe", not_a_file),
            ("/dev/zero", not_a_file),
            ("hole", "is not a bag"),
            ("empty.bag", "is empty"),
            ("begun", ""),
        ):
            self.assert_refused(
                "%s cannot be read: %s" % (bag, expected), "export_predictions", "-o", "a.csv", bag
            )
        self.assert_refused(
            "not decided: pipe cannot be read: " + not_a_file,
            "station_check",
            "--bag",
            "pipe",
            "--verdict",
        )
        for curve, expected in (
            ("pipe", not_a_file),
            ("/dev/zero", not_a_file),
            ("hole", "has 107374182400 bytes, more than the 100000000 of a curve"),
        ):
            self.assert_refused("%s: %s" % (curve, expected), "plot_curve", "-o", "a.png", curve)

    def test_a_curve_may_come_from_a_pipe_of_the_shell(self):
        done = subprocess.run(
            [find_node("mems_stiction", "plot_curve")[0], "-o", "a.png", "/dev/stdin"],
            cwd=str(self.folder),
            input=b"height,force,direction\n1e-9,2e-9,APPROACH\n0,3e-9,APPROACH\n",
            timeout=300,
        )
        self.assertEqual(done.returncode, 0)

    def test_an_export_names_the_topics_that_there_are(self):
        with rosbag.Bag(str(self.folder / "day.bag"), "w") as bag:
            bag.write("/left/prediction", StictionPrediction())
        self.assert_refused(
            "--topic: no prediction on '/left/predicton'; they are on /left/prediction",
            "export_predictions",
            "-o",
            "a.csv",
            "--topic",
            "/left/predicton",
            "day.bag",
        )
        self.assert_refused(
            "--output: /dev/full cannot be written: No space left on device",
            "export_predictions",
            "-o",
            "/dev/full",
            "day.bag",
        )

    def test_settings_that_are_no_yaml_say_what_they_are(self):
        (self.folder / "tab.yaml").write_text("interface:\n\twork_of_adhesion: 0.05\n")
        self.assert_refused(
            "tab.yaml: not valid YAML: line 2 begins with a tab; must be spaces (",
            "predict_scan",
            "-c",
            "tab.yaml",
            "scan.npy",
        )
        self.assert_refused(
            "scan.npy: is not a text, so no file of settings",
            "predict_scan",
            "-c",
            "scan.npy",
            "scan.npy",
        )
        (self.folder / "scan.npy.yaml").write_text("pitch_x: 20.0e-9\n\tpitch_y: 20.0e-9\n")
        self.assert_refused(
            "scan.npy.yaml: not valid YAML: line 2 begins with a tab", "predict_scan", "scan.npy"
        )
        (self.folder / "scan.npy.yaml").write_text("pitch_x: 20.0e-9\n")
        self.assert_refused(
            "scan.npy: its pitch_y is not stated, only the other pitch", "predict_scan", "scan.npy"
        )

    def test_settings_are_no_scan_and_rows_of_something_else_no_shard(self):
        (self.folder / "part.yaml").write_text("interface: {work_of_adhesion: 0.05}\n")
        self.assertEqual(
            self.run_it("stiction_batch", "-o", "rows.csv", "part.yaml").stderr,
            "stiction_batch: part.yaml: is a file of settings, not a scan\n",
        )
        self.assert_refused(
            "nowhere.csv: there is no such file",
            "stiction_batch",
            "--merge",
            "-o",
            "all.csv",
            "nowhere.csv",
        )
        (self.folder / "sweep.csv").write_text("voltage\n0\n")
        self.assert_refused(
            "sweep.csv: no rows of stiction_batch: there is no sweep.csv.settings.yaml",
            "stiction_batch",
            "--merge",
            "-o",
            "all.csv",
            "sweep.csv",
        )

    def test_a_mask_that_is_none_is_named_once(self):
        (self.folder / "mask.yaml").write_text(
            "preprocessing: {region: {mask_file: nowhere.png}}\n"
        )
        self.assert_refused(
            "nowhere.png: there is no such file", "predict_scan", "-c", "mask.yaml", "scan.npy"
        )

    def test_a_tiff_has_the_name_of_one(self):
        for option in (
            ("--deformed",),
            ("--half-space", "--half-space-pressure"),
            ("--half-space", "--half-space-deformed"),
        ):
            self.assert_refused(
                option[-1] + ": 'out.jpg' is not allowed, must end in .tiff or .tif",
                "predict_scan",
                *option,
                "out.jpg",
                "scan.npy",
            )
        self.assertFalse((self.folder / "out.jpg").exists())

    def test_no_size_is_one_fault_and_not_two(self):
        self.assert_refused(
            "gaussian/rows: 0 is not allowed", "make_scan_bag", "-o", "a.bag", "--rows", "0"
        )
        self.assertNotIn(
            "(0, 0]", self.run_it("make_scan_bag", "-o", "a.bag", "--rows", "0").stderr
        )

    def test_a_device_that_is_stated_in_part_says_what_is_missing(self):
        (self.folder / "device.yaml").write_text(
            "device: {spring_stiffness: 1.0, travel: 1.0e-6}\n"
        )
        record = self.run_it("predict_scan", "-c", "device.yaml", "scan.npy").stdout
        self.assertIn(
            "Does it stick? Not known: the device is not stated in full: device/contact_area must "
            "be > 0.\n",
            record,
        )

    def test_a_bag_names_the_part_of_its_scans(self):
        self.assertEqual(
            self.run_it(
                "make_scan_bag",
                "-o",
                "a.bag",
                "--part-id",
                "lot 3",
                "--serial-id",
                "0012",
                "--lot-id",
                "L7",
                "--wafer-id",
                "W3",
                "scan.npy",
            ).returncode,
            0,
        )
        with rosbag.Bag(str(self.folder / "a.bag")) as bag:
            (info,) = [message for _, message, _ in bag.read_messages(topics=["/scan_info"])]
        self.assertEqual(
            (info.part_id, info.serial_id, info.lot_id, info.wafer_id, info.has_site),
            ("lot 3", "0012", "L7", "W3", False),
        )
        self.assertEqual(
            info.checksum,
            "sha256:" + hashlib.sha256((self.folder / "scan.npy").read_bytes()).hexdigest(),
        )

    def test_a_name_that_is_no_utf8_is_spelled_out(self):
        name = "h\udcf6he.npy"
        (self.folder / name).write_bytes((self.folder / "scan.npy").read_bytes())
        (self.folder / (name + ".yaml")).write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        done = self.run_it(
            "stiction_batch", "-o", "q\udcff.csv", name, "none\udcf6.npy"
        )  # run_it() reads UTF-8
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "stiction_batch: none\\xf6.npy: there is no such file\n")
        self.assertTrue(done.stdout.startswith("q\\xff.csv: 2 rows"), done.stdout)
        with (self.folder / "q\udcff.csv").open(newline="", encoding="utf-8") as stream:
            self.assertEqual(
                [row["file"] for row in csv.DictReader(stream)], ["h\\xf6he.npy", "none\\xf6.npy"]
            )
        (self.folder / "q\udcff.csv.settings.yaml").read_text(encoding="utf-8")
        for form in ((), ("--json",)):
            done = self.run_it("predict_scan", *form, name, "none\udcf6.npy")
            self.assertIn("predict_scan: none\\xf6.npy: there is no such file", done.stderr)

    def test_a_folder_is_no_curve(self):
        self.assert_refused(".: is a folder, not a curve", "plot_curve", ".")

    def test_an_export_keeps_the_bag(self):
        before = (self.folder / "text.bag").read_bytes()
        self.assert_refused(
            "is what is read, which would be lost",
            "export_predictions",
            "-o",
            "text.bag",
            "text.bag",
        )
        self.assert_refused(
            "cannot be written", "export_predictions", "-o", "none/a.csv", "text.bag"
        )
        self.assertEqual((self.folder / "text.bag").read_bytes(), before)

    def test_a_picture_is_not_exported(self):
        (self.folder / "scan.tiff").write_bytes(b"II*\0\x90\x90\x90\x90\x90\n")
        self.assert_refused(
            "scan.tiff cannot be read: is not a bag",
            "export_predictions",
            "-o",
            "a.csv",
            "scan.tiff",
        )

    def long_work(self, size, steps=10000000, **more):
        """Arguments of a prediction that takes seconds on a fast machine, too: many steps, so small
        that none is the last."""
        np.save(
            str(self.folder / "large.npy"),
            np.random.RandomState(1).normal(0.0, 2e-9, (size, size)).astype(np.float32),
        )
        settings = dict(
            approach={"formulation": "paper", "max_steps": steps},
            paper={"step": 1e-21},
            load={"mechanical_load": 1e-3},
            **more,
        )
        (self.folder / "long.yaml").write_text(json.dumps(settings))
        return "--config", "long.yaml", "--pitch", "20e-9", "large.npy"

    def test_on_a_terminal_a_long_work_says_what_it_is_at_until_it_ends(self):
        with Terminal(
            self.folder, "predict_scan", *self.long_work(256, limits={"max_time": 3.0})
        ) as terminal:
            shown = terminal.until_it_ends(BAD_INPUT)
        line, sentence = shown.split(WIPED)[-2:]
        self.assertIn(b"large.npy: predicting, ", line)
        self.assertTrue(
            sentence.startswith(
                b"predict_scan: large.npy: the scan was given up after 3 s (limits/max_time)"
            ),
            sentence,
        )
        self.assertEqual(sentence.count(b"\n"), 1)

    def test_on_a_terminal_a_batch_of_one_scan_counts_one(self):
        self.long_work(256, limits={"max_time": 1.0})
        (self.folder / "large.npy.yaml").write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        with Terminal(
            self.folder, "stiction_batch", "-c", "long.yaml", "-o", "rows.csv", "large.npy"
        ) as terminal:
            terminal.until(b"0 of 1 scan")
            self.assertNotIn(b"1 scans", terminal.until_it_ends(1))

    def test_on_a_terminal_ctrl_c_wipes_what_a_long_work_says(self):
        with Terminal(
            self.folder, "predict_scan", "--cleanings", *self.long_work(64, steps=2000000)
        ) as terminal:
            terminal.until(b"large.npy: predicting under each cleaning, ")
            terminal.process.send_signal(signal.SIGINT)
            shown = terminal.until_it_ends(-signal.SIGINT)
        self.assertTrue(shown.endswith(WIPED), shown[-60:])  # nothing is left on the line

    def test_on_a_terminal_a_half_space_speaks_while_one_height_takes_long_and_ctrl_c_ends_it(self):
        random = np.random.RandomState(1)
        np.save(
            str(self.folder / "fine.npy"),
            random.normal(size=(512, 512)).cumsum(0).cumsum(1) * 1e-12,
        )
        with Terminal(
            self.folder,
            "predict_scan",
            "--pitch",
            "20e-9",
            "--load",
            "1e-4",
            "--half-space",
            "fine.npy",
        ) as terminal:
            terminal.until(b"half-space: ")
            while True:  # two lines of one height
                said = re.findall(rb"(half-space: [^\r\x1b]*), \d+ s", terminal.shown)
                if len(said) > len(set(said)):
                    break
                self.assertTrue(terminal.read(), terminal.shown)
            terminal.process.send_signal(signal.SIGINT)
            shown = terminal.until_it_ends(-signal.SIGINT)
        self.assertTrue(shown.endswith(WIPED), shown[-60:])

    def test_on_a_terminal_a_short_work_leaves_nothing(self):
        with Terminal(self.folder, "predict_scan", "scan.npy") as terminal:
            shown = terminal.until_it_ends(0)
        left = shown.split(WIPED)[-1]  # a machine that stood still may have shown what it was at
        self.assertTrue(left == b"" or left.endswith(b"\n"), shown)

    def test_on_a_terminal_the_answer_has_colours_and_says_each_warning_once(self):
        (self.folder / "device.yaml").write_text(
            "device: {spring_stiffness: 1.0, travel: 1.0e-6}\nload: {mechanical_load: 1.0}\n"
        )
        call = ("predict_scan", "-c", "device.yaml", "scan.npy")
        warning = b"the mechanical load of 1 N"
        shown = {}
        for name, environment in (
            ("colours", {"NO_COLOR": ""}),
            ("none", {"NO_COLOR": "1"}),
            ("dumb", {"TERM": "dumb"}),
        ):
            with Terminal(self.folder, *call, has_output=True, **environment) as terminal:
                shown[name] = terminal.until_it_ends(0).split(WIPED)[-1]
            self.assertEqual(shown[name].count(warning), 1, shown[name])
        self.assertIn(b"\x1b[1;35mDoes it stick? Not known\x1b[0m: ", shown["colours"])
        plain = re.sub(rb"\x1b\[[0-9;]*m", b"", shown["colours"])
        self.assertEqual((shown["none"], shown["dumb"]), (plain, plain))
        with Terminal(self.folder, *call) as terminal:  # the output is a file's
            self.assertEqual(terminal.until_it_ends(0).count(warning), 1)

    def test_on_a_terminal_a_pdf_says_that_it_is_being_written(self):
        with Terminal(
            self.folder, "stiction_report", "--pdf", "--steps", "0", "-o", "r.html", "scan.npy"
        ) as terminal:
            self.assertIn(b"writing r.pdf: ", terminal.until_it_ends(0))

    def test_a_picture_of_one_cleaning_step_is_not_blown_up(self):
        (self.folder / "clean.yaml").write_text("preprocessing: {level: plane}\n")
        done = self.run_it("stiction_report", "-c", "clean.yaml", "-o", "r.html", "scan.npy")
        self.assertEqual(done.returncode, 0, done.stderr)
        width, png = re.search(
            r'what the step changed" style="max-width: (\d+)px" '
            r'src="data:image/png;base64,([^"]+)"',
            (self.folder / "r.html").read_text(),
        ).groups()
        self.assertEqual(
            int(width), matplotlib.image.imread(io.BytesIO(base64.b64decode(png))).shape[1]
        )


if __name__ == "__main__":
    unittest.main()
