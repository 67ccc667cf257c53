"""Archives through the Python module: rows are those of predict_scan, links keep their sidecars, interruptions and workers that
die cost nothing."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import REPOSITORY, program, rough  # noqa: E402  (the path comes first)

EXAMPLES = REPOSITORY / "scripts" / "examples"
CONFIG = "load: {mechanical_load: 1.0e-6}\ndevice: {spring_stiffness: 2.0, travel: 1.0e-6, contact_area: 1.0e-11, contacts: 8}\n"
COUNT = 24


def run(*command, **settings):
    return subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                          universal_newlines=True, timeout=200, **settings)


def rows_in(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


class ArchiveTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Scans in a store under names that say nothing, and links to them with the sidecars beside the links."""
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        (cls.folder / "store").mkdir()
        (cls.folder / "links").mkdir()
        (cls.folder / "part.yaml").write_text(CONFIG)
        cls.scans = []
        for number in range(COUNT):
            kept = cls.folder / "store" / ("%x.npy" % (7919 * (number + 1)))
            np.save(str(kept), rough(96, 96, 4e-9, number + 1))
            link = cls.folder / "links" / ("scan_%02d.npy" % number)
            link.symlink_to(kept)
            (link.parent / (link.name + ".yaml")).write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
            cls.scans.append(link)
        (cls.folder / "links" / "broken.npy").write_text("no array")
        cls.scans.insert(3, cls.folder / "links" / "broken.npy")
        (cls.folder / "scans.txt").write_text("".join("%s\n" % path for path in cls.scans))
        cls.expected = cls.folder / "expected.jsonl"
        done = cls.archive("-o", cls.expected, *cls.scans)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    @classmethod
    def archive(cls, *arguments):
        return run(sys.executable, "-m", "mems_stiction.archive", "--config", cls.folder / "part.yaml", *arguments)

    def test_rows_are_the_records_of_predict_scan(self):
        rows = rows_in(self.expected)
        self.assertEqual([row["number"] for row in rows], list(range(1, COUNT + 2)))
        self.assertEqual([row["number"] for row in rows if row["reason"]], [4])
        self.assertIn("broken.npy", rows[3]["reason"])
        done = run(program(), "--json", "--config", self.folder / "part.yaml", *self.scans)
        records = [json.loads(line) for line in done.stdout.splitlines()]
        for row, record in zip([row for row in rows if not row["reason"]], records):
            common = set(row) & set(record) - {"reason", "warnings"}
            self.assertGreater(len(common), 50)
            self.assertEqual({name: row[name] for name in common}, {name: record[name] for name in common})
            self.assertEqual((row["verdict_reason"], row["warnings"]), (record["reason"], "; ".join(record["warnings"])))

    def test_a_row_is_not_kept_for_a_file_that_was_measured_anew(self):
        scans = [self.folder / ("anew_%d.npy" % number) for number in range(3)]
        for number, scan in enumerate(scans):
            np.save(str(scan), rough(64, 64, 4e-9, number))
            (scan.parent / (scan.name + ".yaml")).write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        path = self.folder / "anew.jsonl"
        self.assertEqual(self.archive("-o", path, *scans).returncode, 0)
        before = rows_in(path)
        status = os.stat(str(scans[1]))
        np.save(str(scans[1]), rough(64, 64, 4e-9, 77))  # of the same size and time
        os.utime(str(scans[1]), ns=(status.st_atime_ns, status.st_mtime_ns))
        (self.folder / (scans[2].name + ".yaml")).write_text("pitch_x: 30.0e-9\npitch_y: 30.0e-9\n")
        done = self.archive("-o", path, *scans)
        self.assertIn("%s: has changed since its row 2 was written, predicted again: file_checksum" % scans[1], done.stderr)
        self.assertIn("%s: has changed since its row 3 was written, predicted again: sidecar_checksum" % scans[2], done.stderr)
        after = rows_in(path)
        self.assertEqual([old == new for old, new in zip(before, after)], [True, False, False])
        self.archive("-o", self.folder / "anew_fresh.jsonl", *scans)
        self.assertEqual(after, rows_in(self.folder / "anew_fresh.jsonl"))
        os.remove(str(scans[0]))
        self.assertEqual(self.archive("-o", path, *scans).stderr, "")  # its row is all that is left of it
        row = rows_in(path)[0]
        del row["file_checksum"]
        path.write_text(json.dumps(row) + "\n")
        done = self.archive("-o", path, *scans)
        self.assertEqual(done.returncode, 2)
        self.assertIn("does not say which state of its file it is of", done.stderr)

    def test_a_call_goes_on_behind_half_a_line(self):
        path = self.folder / "torn.jsonl"
        self.archive("-o", path, *self.scans)
        text = path.read_text()
        path.write_text(text[:len(text) // 2])
        done = self.archive("-o", path, "--workers", 2, "--inputs-from", self.folder / "scans.txt")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(path.read_text(), self.expected.read_text())
        self.assertIn("%d rows, 1 of them" % (COUNT + 1), done.stdout)

    def test_a_list_without_end_is_refused(self):
        pipe = self.folder / "pipe.txt"
        os.mkfifo(str(pipe))
        hole = self.folder / "hole.txt"
        with hole.open("wb") as stream:
            stream.truncate(100 << 30)
        for name, words in ((pipe, "is a pipe, a socket or a device"), ("/dev/zero", "is a pipe, a socket or a device"),
                            (hole, "has 107374182400 bytes, more than the 100000000 of a list of scans")):
            done = self.archive("-o", self.folder / "none.jsonl", "--inputs-from", name)
            self.assertEqual(done.returncode, 2)
            self.assertIn("%s: %s" % (name, words), done.stderr)

    def test_other_settings_or_scans_are_refused(self):
        path = self.folder / "refused.jsonl"
        self.archive("-o", path, *self.scans[:2])
        for arguments, words in ((self.scans[1:3], "row 1 is of"), (["--config", os.devnull] + self.scans[:2], "other settings")):
            done = self.archive("-o", path, *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)

    def test_tasks_of_an_array_have_the_rows_of_one_call(self):
        for task in (1, 2, 3):
            done = run(EXAMPLES / "predict_array.sbatch", self.folder / "scans.txt", self.folder / "part.yaml", self.folder / "rows",
                       env=dict(os.environ, SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT="3", SLURM_CPUS_PER_TASK="2"))
            self.assertEqual(done.returncode, 0, done.stderr)
        lines = [line for path in (self.folder / "rows").glob("*.jsonl") for line in path.read_text().splitlines()]
        self.assertEqual(sorted(lines), sorted(self.expected.read_text().splitlines()))

    def test_a_worker_that_is_killed_costs_nothing(self):
        """A real cluster: a scheduler and two workers, of which one is killed when it has work and some rows are there."""
        try:
            import distributed
        except ImportError:
            self.skipTest("distributed is not installed")
        slow = self.folder / "slow.yaml"
        slow.write_text(CONFIG + "preprocessing: {refine: {factor: 8}}\n")
        expected = self.folder / "slow.jsonl"
        self.assertEqual(run(sys.executable, "-m", "mems_stiction.archive", "--config", slow, "-o", expected, *self.scans).returncode, 0)
        processes = []

        def start(*command):
            processes.append(subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                              cwd=str(self.folder)))
            return processes[-1]

        def wait_for(condition, what):
            end = time.monotonic() + 60
            while not condition():
                self.assertLess(time.monotonic(), end, what)
                time.sleep(0.01)

        try:
            address_file = self.folder / "scheduler.json"
            start(sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
                  "--scheduler-file", address_file)
            wait_for(address_file.exists, "no scheduler")
            workers = [start(sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", address_file, "--nthreads", "1",
                             "--no-nanny", "--no-dashboard", "--host", "127.0.0.1") for _ in range(2)]
            address = json.loads(address_file.read_text())["address"]
            with distributed.Client(address, timeout=60) as client:
                client.wait_for_workers(2, timeout=60)
                output = self.folder / "dask.jsonl"
                call = subprocess.Popen([sys.executable, str(EXAMPLES / "predict_dask.py"), "--scheduler", address, "--config", str(slow),
                                         "--part", "1", "-o", str(output)] + [str(path) for path in self.scans],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
                processes.append(call)
                wait_for(lambda: output.exists() and len(output.read_text().splitlines()) >= 3, "no rows")
                workers[0].send_signal(signal.SIGKILL)
                done_before = len(output.read_text().splitlines())
                out, err = call.communicate(timeout=150)
                self.assertEqual(call.returncode, 0, err)
                self.assertLess(done_before, COUNT)
                self.assertEqual(len(client.scheduler_info()["workers"]), 1)
            self.assertEqual(workers[0].wait(), -signal.SIGKILL)
            self.assertEqual(output.read_text(), expected.read_text())
        finally:
            for process in processes:
                if process.poll() is None:
                    process.terminate()
                    process.wait()

    def test_workers_of_this_machine(self):
        try:
            import distributed  # noqa: F401
        except ImportError:
            self.skipTest("distributed is not installed")
        path = self.folder / "local.jsonl"
        done = run(EXAMPLES / "predict_dask.py", "--config", self.folder / "part.yaml", "-o", path, *self.scans)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(path.read_text(), self.expected.read_text())


if __name__ == "__main__":
    unittest.main()
