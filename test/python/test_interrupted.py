"""Ctrl-C in the middle of each program: no traceback, the status of a signal, no file that only
looks whole, what was there before stays."""

import contextlib
import importlib.util
import os
import pathlib
import pty
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

import numpy as np
from roslib.packages import find_node

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from tiers import times  # noqa: E402  (the path comes first)

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
OLD = "what was there before"


# Python drops what is raised in a finalizer; a library may make an error of its own of it
DROPS_IT = """
from mems_stiction import interrupted
import time
class Slow:
    def __del__(self):
        print("in the finalizer", flush=True)
        time.sleep(60)
interrupted.raise_from_here_on()
slow = Slow()
del slow
time.sleep(60)
"""
HIDES_IT = """
from mems_stiction import interrupted
import time
interrupted.raise_from_here_on()
try:
    print("loading", flush=True)
    time.sleep(60)
except KeyboardInterrupt:
    raise ImportError("not loaded")
"""
SWALLOWS_IT = """
from mems_stiction import interrupted
import time
interrupted.raise_from_here_on()
try:
    print("closing", flush=True)
    time.sleep(60)
except:
    pass
interrupted.raise_if_swallowed()
time.sleep(60)
"""
LOADS_IT = """
from mems_stiction import interrupted
import time
print("loading", flush=True)
time.sleep(60)
"""
PRINTS_IT = """
from mems_stiction import interrupted
import sys
interrupted.raise_from_here_on()
try:
    print("a\\n" * int(sys.argv[1]))
except OSError as error:
    print("caught", error, file=sys.stderr)
"""
# An interruption of each moment in which a folder is made or removed
LEAVES_NO_FOLDER = """
from mems_stiction import interrupted
import os, signal, sys, tempfile, threading, time
interrupted.raise_from_here_on()
tempfile.tempdir = sys.argv[1]
threading.Timer(float(sys.argv[2]), os.kill, (os.getpid(), signal.SIGINT)).start()
while True:
    with interrupted.temporary_folder("passing_") as folder:
        for number in range(20):
            (folder / str(number)).touch()
"""


def program(name):
    return find_node("mems_stiction", name)[0]


class InterruptedTest(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        cls.doClassCleanups()  # nose knows nothing of them

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.inputs = pathlib.Path(folder.name)
        cls.config = cls.inputs / "config.yaml"
        cls.config.write_text(
            "load: {mechanical_load: 1.0e-6}\nscan: {pitch_x: 1.0e-8, pitch_y: 1.0e-8}\n"
        )
        random = np.random.RandomState(1)
        cls.scans = [cls.inputs / ("%d.npy" % number) for number in range(4)]
        for scan in cls.scans:  # a large frame with relief of every length
            np.save(
                str(scan),
                (random.normal(size=(2048, 2048)).cumsum(0).cumsum(1) * 1e-12).astype(np.float32),
            )

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def ends_of(self, command, output):
        """Status and errors of a program, whose output Python buffers, and does not."""
        for unbuffered in ("", "1"):  # empty as if not set
            run = subprocess.run(
                command,
                stdout=output,
                stderr=subprocess.PIPE,
                env=dict(os.environ, PYTHONUNBUFFERED=unbuffered),
                timeout=120,
            )
            yield run.returncode, run.stderr.decode()

    def test_where_nobody_reads_any_more_a_program_ends_without_a_word(self):
        for command in (
            [sys.executable, "-c", PRINTS_IT, "1"],  # at the end of the program
            [sys.executable, "-c", PRINTS_IT, "1000000"],  # before
            [program("compare_lots"), "--help"],
            [program("watch_drift"), "--help"],
        ):
            unread, written = os.pipe()
            os.close(unread)
            with os.fdopen(written, "wb") as stream:
                for end in self.ends_of(command, stream):
                    self.assertEqual(end, (128 + signal.SIGPIPE, ""), command)

    def test_an_output_that_cannot_be_written_is_one_line(self):
        for name in ("compare_lots", "plot_curve", "station_check", "watch_drift"):
            with open("/dev/full", "wb") as stream:
                for status, errors in self.ends_of([program(name), "--help"], stream):
                    self.assertGreater(status, 0, name)
                    self.assertEqual(
                        errors,
                        name + ": what is printed cannot be written: No space left on device\n",
                    )

    def test_control_characters_of_a_name_do_not_reach_a_terminal(self):
        ours, theirs = pty.openpty()
        name = "none\x1b[2J\x9b.csv"
        command = [program("plot_curve"), name]
        subprocess.run(command, stdout=theirs, stderr=theirs, timeout=120)
        os.close(theirs)
        said = b""
        with os.fdopen(ours, "rb", buffering=0) as stream, contextlib.suppress(OSError):
            while True:  # a terminal that nobody holds any more ends with an error
                said += stream.read(4096)
        self.assertRegex(said.decode(), r"plot_curve: none\\x1b\[2J\\x9b.csv: [^\x1b\x9b]*$")
        errors = subprocess.run(command, stderr=subprocess.PIPE, timeout=120).stderr
        self.assertIn(name.encode(), errors)  # a file takes the name as it is

    def lines_of(self, name):
        """Of a file that may not be there yet."""
        path = self.folder / name
        return path.read_bytes().count(b"\n") if path.exists() else 0

    def interrupted(self, command, moment):
        """Status, output, errors of a program that gets Ctrl-C, as its whole group does from a
        terminal, after so many seconds or once the condition holds, and how long it took to end
        [s]."""
        if not callable(moment):
            end = time.monotonic() + moment
            return self.interrupted(command, lambda: time.monotonic() >= end)
        process = subprocess.Popen(
            [str(part) for part in command],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        while process.poll() is None and not moment():
            time.sleep(0.002)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        begin = time.monotonic()
        output, errors = process.communicate(timeout=300)
        # but for Python itself, which may be starting just then, before any line of the project
        before, starting, _ = errors.partition("Fatal Python error: init")
        self.assertNotIn("Traceback", before, errors)
        status = -signal.SIGINT if starting else process.returncode
        return status, output, errors, time.monotonic() - begin

    def whole_run(self, command):
        """How long it takes when nobody interrupts it [s], and what it leaves behind, by name."""
        begin = time.monotonic()
        subprocess.run(
            [str(part) for part in command],
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            stdin=subprocess.DEVNULL,
            timeout=1000,
        )
        seconds = time.monotonic() - begin
        return seconds, {path.name: path.read_bytes() for path in self.folder.iterdir()}

    def try_all_over(self, command, same_bytes=True):
        """Interrupts a program all over its run; whatever carries a name of the whole run's files
        is one of them, or the one before."""
        seconds, expected = self.whole_run(command)
        interruptions, shares = 0, times([0.5], list(np.linspace(0.1, 0.95, 6)))
        while shares:
            share = shares.pop(0)
            for name in expected:
                (self.folder / name).write_text(OLD)
            begin = time.monotonic()
            status, _, errors, _ = self.interrupted(command, share * seconds)
            self.assertIn(status, (-signal.SIGINT, 0), errors)
            interruptions += status != 0
            if status == 0:  # the machine is less busy than it was
                seconds = min(seconds, time.monotonic() - begin)
                if share < 0.7:
                    shares.append(share)
            found = {path.name: path.read_bytes() for path in self.folder.iterdir()}
            self.assertEqual(set(found), set(expected), "share %g" % share)
            for name, content in found.items():
                if content != OLD.encode():
                    self.assertEqual(
                        content if same_bytes else len(content),
                        expected[name] if same_bytes else len(expected[name]),
                        name,
                    )
        self.assertGreaterEqual(interruptions, times(1, 3))
        return errors

    def test_a_prediction_of_a_large_frame(self):
        self.try_all_over(
            [
                program("predict_scan"),
                "-c",
                self.config,
                "--curve",
                self.folder / "curve.csv",
                "-d",
                self.folder / "deformed.tiff",
                self.scans[0],
            ]
        )

    def test_a_half_space(self):
        """A minute of work."""
        config = self.inputs / "fine.yaml"
        config.write_text(
            self.config.read_text() + "half_space: {step: 0.01, max_states: 1000000}\n"
        )
        small = self.inputs / "small.npy"
        np.save(str(small), np.load(str(self.scans[0]))[:512, :512])
        for seconds in (0.3, 1.0, 3.5):
            status, output, errors, took = self.interrupted(
                [
                    program("predict_scan"),
                    "-c",
                    config,
                    "--half-space",
                    "--half-space-pressure",
                    self.folder / "pressure.tiff",
                    "--curve",
                    self.folder / "curve.csv",
                    small,
                ],
                seconds,
            )
            self.assertEqual((status, output), (-signal.SIGINT, ""), errors)
            self.assertLess(took, 30.0)
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_bag_of_scans(self):
        self.try_all_over(
            [
                program("make_scan_bag"),
                "-o",
                self.folder / "scans.bag",
                "--pitch",
                "1e-8",
                *self.scans,
            ]
        )

    def test_a_recording_as_mcap(self):
        if importlib.util.find_spec("mcap_ros2") is None:
            self.skipTest("not installed: mcap_ros2")
        bag = self.inputs / "scans.bag"
        subprocess.run(
            [program("make_scan_bag"), "-o", str(bag), "--pitch", "1e-8"]
            + list(map(str, self.scans)),
            check=True,
            stdout=subprocess.DEVNULL,
        )
        self.try_all_over([SCRIPTS / "bag_to_mcap", "-o", self.folder / "scans.mcap", bag])

    def test_a_batch_goes_on_with_nothing_lost_or_twice(self):
        small = []
        for number, scan in enumerate(self.scans * 5):
            small.append(self.inputs / ("batch%02d.npy" % number))
            np.save(str(small[-1]), np.load(str(scan))[number : number + 256, :256])
        for name in ("rows.csv", "rows.jsonl"):
            command = [
                program("stiction_batch"),
                "-c",
                self.config,
                "-o",
                self.folder / name,
                *small,
            ]
            _, expected = self.whole_run(command)
            for path in self.folder.iterdir():
                path.unlink()
            interruptions = 0
            for _ in range(times(2, 4)):  # each once three more rows are there, of twenty
                before = self.lines_of(name)
                status, _, errors, _ = self.interrupted(
                    command, lambda: self.lines_of(name) >= before + 3
                )
                self.assertIn(status, (-signal.SIGINT, 0), errors)
                interruptions += status != 0
                rows = (self.folder / name).read_bytes() if (self.folder / name).exists() else b""
                self.assertTrue(expected[name].startswith(rows))
            self.assertGreaterEqual(interruptions, times(1, 2))
            self.whole_run(command)
            self.assertEqual(
                {path.name: path.read_bytes() for path in self.folder.iterdir()}, expected
            )
            for path in self.folder.iterdir():
                path.unlink()

    def test_a_report(self):
        scan = self.inputs / "report.npy"
        np.save(str(scan), np.load(str(self.scans[0]))[:128, :128])
        larger = self.inputs / "larger.npy"
        np.save(str(larger), np.load(str(self.scans[1]))[:512, :512])
        with tempfile.TemporaryDirectory() as own:  # other tests make reports beside this one
            with unittest.mock.patch.dict(os.environ, TMPDIR=own):
                errors = self.try_all_over(
                    [
                        SCRIPTS / "stiction_report",
                        "-c",
                        self.config,
                        "-o",
                        self.folder / "report.html",
                        scan,
                        larger,
                    ],
                    same_bytes=False,
                )
            left = [name for name in os.listdir(own) if name.startswith("stiction_report_")]
        self.assertEqual(left, [])
        if errors:
            self.assertEqual(errors.splitlines()[-1], "stiction_report: interrupted")

    def test_an_interruption_that_python_drops_or_a_library_hides_or_swallows(self):
        for text in (DROPS_IT, HIDES_IT, SWALLOWS_IT):
            process = subprocess.Popen(
                [sys.executable, "-c", text],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
            )
            process.stdout.readline()
            process.send_signal(signal.SIGINT)
            _, errors = process.communicate(timeout=120)
            self.assertEqual((process.returncode, errors), (-signal.SIGINT, "-c: interrupted\n"))

    def test_term_and_hup_always_end_in_the_status_130(self):
        for number in (signal.SIGTERM, signal.SIGHUP):
            for text, said in (
                (DROPS_IT, "-c: interrupted\n"),
                (HIDES_IT, "-c: interrupted\n"),
                (SWALLOWS_IT, "-c: interrupted\n"),
                (LOADS_IT, ""),
            ):
                process = subprocess.Popen(
                    [sys.executable, "-c", text],
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    universal_newlines=True,
                )
                process.stdout.readline()
                process.send_signal(number)
                _, errors = process.communicate(timeout=120)
                self.assertEqual((process.returncode, errors), (130, said), (number, text))

    def test_a_calibration_that_is_told_to_end(self):
        """At moments all over its run, from that on at which the first line of the project has been
        run."""
        np.save(str(self.inputs / "part.npy"), np.load(str(self.scans[0]))[:256, :256])
        measurements = self.folder / "measurements.yaml"
        measurements.write_text(
            "".join(
                "- {kind: pull_off_force, value: %ge-7, uncertainty: 1.0e-8, scans: [%s]}\n"
                % (number + 1, self.inputs / "part.npy")
                for number in range(3)
            )
        )
        output = self.folder / "calibrated.yaml"
        command = [
            str(SCRIPTS / "calibrate"),
            "-c",
            str(self.config),
            "-o",
            str(output),
            str(measurements),
        ]
        begin = time.monotonic()
        own = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300
        ).returncode
        duration = time.monotonic() - begin
        self.assertFalse(
            output.exists(), "these three values contradict each other: there is nothing to write"
        )
        ended = 0
        for number in (signal.SIGTERM, signal.SIGHUP):
            for moment in np.linspace(0.0, duration, times(2, 6), endpoint=False):
                process = subprocess.Popen(
                    command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True
                )
                caught = pathlib.Path("/proc/%d/status" % process.pid)
                while (
                    process.poll() is None
                    and not int(caught.read_text().split("SigCgt:")[1].split()[0], 16)
                    >> (number - 1)
                    & 1
                ):
                    time.sleep(0.001)
                time.sleep(moment)
                process.send_signal(number)
                _, errors = process.communicate(timeout=300)
                self.assertIn(
                    process.returncode, (130, own), errors
                )  # its own, once its work was done
                self.assertNotIn("Traceback", errors)
                self.assertFalse(output.exists())
                ended += process.returncode == 130
        self.assertGreaterEqual(ended, times(2, 6))

    def test_a_folder_goes_whenever_the_interruption_comes(self):
        for delay in np.linspace(0.05, 0.06, times(6, 25)):
            done = subprocess.run(
                [sys.executable, "-c", LEAVES_NO_FOLDER, str(self.folder), "%g" % delay],
                stderr=subprocess.PIPE,
                universal_newlines=True,
                timeout=120,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
            )
            self.assertEqual((done.returncode, done.stderr), (-signal.SIGINT, "-c: interrupted\n"))
            self.assertEqual(os.listdir(str(self.folder)), [])

    def test_a_page_that_runs_until_it_is_stopped(self):
        process = subprocess.Popen(
            [str(SCRIPTS / "station_page"), "--port", "0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            env=dict(os.environ, ROS_MASTER_URI="http://localhost:1"),
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        self.assertIn("Ctrl-C ends it", process.stdout.readline())
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=120)
        self.assertEqual((process.returncode, errors), (0, ""))

    def test_a_soak(self):
        build = pathlib.Path(program("stiction_node")).parents[3]
        environment = dict(os.environ, MEMS_STICTION_BUILD=str(build))
        for seconds in (3.0, 10.0)[: times(1, 2)]:
            process = subprocess.Popen(
                [str(SCRIPTS / "soak"), "1"],
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
                start_new_session=True,
                env=environment,
                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
            )
            time.sleep(seconds)
            os.killpg(process.pid, signal.SIGINT)
            _, errors = process.communicate(
                timeout=300
            )  # with the pipes of node and master closed too
            self.assertEqual(process.returncode, 130, errors)
            # but for Python itself, which may be starting just then, before any line of the project
            self.assertNotIn("Traceback", errors.split("Fatal Python error: init")[0])


if __name__ == "__main__":
    unittest.main()
