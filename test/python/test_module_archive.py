"""Archives where Python is: python3 -m mems_stiction.archive is stiction_batch, links keep their
sidecars, interruptions and workers that die cost nothing."""

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
from mems_stiction import archive

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import REPOSITORY, program, rough  # noqa: E402  (the path comes first)
from tiers import evidence  # noqa: E402

EXAMPLES = REPOSITORY / "scripts" / "examples"
CONFIG = (
    "load: {mechanical_load: 1.0e-6}\ndevice: {spring_stiffness: 2.0, travel: 1.0e-6, "
    "contact_area: 1.0e-11, contacts: 4}\ndevice_force: {enabled: false}\n"
)
COUNT = 24


def run(*command, **settings):
    return subprocess.run(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        universal_newlines=True,
        timeout=600,
        **settings,
    )


def rows_in(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


def with_program():
    """The environment in which the examples find the program."""
    return dict(
        os.environ,
        PATH=str(pathlib.Path(archive.program()).parent) + os.pathsep + os.environ["PATH"],
    )


class ArchiveTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Scans in a store under names that say nothing, and links to them with the sidecars beside
        the links."""
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        (cls.folder / "store").mkdir()
        (cls.folder / "links").mkdir()
        (cls.folder / "part.yaml").write_text(CONFIG)
        cls.scans = []
        for number in range(COUNT):
            stored = cls.folder / "store" / ("%x.npy" % (7919 * (number + 1)))
            np.save(str(stored), rough(96, 96, 4e-9, number + 1))
            link = cls.folder / "links" / ("scan_%02d.npy" % number)
            link.symlink_to(stored)
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
        return run(
            sys.executable,
            "-m",
            "mems_stiction.archive",
            "--config",
            cls.folder / "part.yaml",
            *arguments,
        )

    def test_rows_are_the_records_of_predict_scan(self):
        rows = rows_in(self.expected)
        self.assertEqual([row["number"] for row in rows], list(range(1, COUNT + 2)))
        self.assertEqual([row["number"] for row in rows if row["message"]], [4])
        self.assertIn("broken.npy", rows[3]["message"])
        done = run(program(), "--json", "--config", self.folder / "part.yaml", *self.scans)
        records = [json.loads(line) for line in done.stdout.splitlines()]
        for row, record in zip([row for row in rows if not row["message"]], records):
            common = set(row) & set(record) - {"warnings"}
            self.assertGreater(len(common), 50)
            self.assertEqual(
                {name: row[name] for name in common}, {name: record[name] for name in common}
            )
            self.assertEqual(row["warnings"], "; ".join(record["warnings"]))

    def test_several_workers_go_on_behind_half_a_line_and_write_the_rows_of_one(self):
        path = self.folder / "torn.jsonl"
        path.write_text(self.expected.read_text()[: self.expected.stat().st_size // 2])
        settings = ".settings.yaml"
        (self.folder / ("torn.jsonl" + settings)).write_text(
            (self.folder / ("expected.jsonl" + settings)).read_text()
        )
        done = self.archive("-o", path, "--workers", 5, "--inputs-from", self.folder / "scans.txt")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(path.read_text(), self.expected.read_text())
        self.assertRegex(
            done.stdout, r"%d rows, 1\d of them from before, 0 scans failed" % (COUNT + 1)
        )

    def test_there_is_at_least_one_worker(self):
        for workers in ("0", "-1", "two"):
            done = self.archive("-o", self.folder / "none.jsonl", "--workers", workers, *self.scans)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
            self.assertIn("--workers", done.stderr)

    def test_interrupted_it_ends_as_the_program_does(self):
        # A flat scan is predicted at once and has its row. Each of the others takes very many small
        # steps.
        slow = self.folder / "slow_one.yaml"
        slow.write_text(
            CONFIG + "approach: {formulation: paper, max_steps: 10000000}\npaper: {step: 1.0e-14}\n"
        )
        flat = self.folder / "flat.npy"
        np.save(str(flat), np.zeros((16, 16)))
        (self.folder / "flat.npy.yaml").write_text("pitch_x: 20.0e-9\npitch_y: 20.0e-9\n")
        path = self.folder / "interrupted.jsonl"
        process = subprocess.Popen(
            [sys.executable, "-m", "mems_stiction.archive", "--config", str(slow), "-o", str(path)]
            + [str(flat)]
            + [str(scan) for scan in self.scans],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        deadline = time.monotonic() + 300
        while not path.exists() or not path.stat().st_size:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        self.assertEqual(
            (process.communicate(timeout=300)[1], process.returncode), (b"", -signal.SIGINT)
        )

    def test_without_its_program_it_says_where_it_looked(self):
        empty = self.folder / "package" / "mems_stiction"
        empty.mkdir(parents=True)
        for name in ("__init__.py", "archive.py"):
            (empty / name).write_text((pathlib.Path(archive.__file__).parent / name).read_text())
        (empty / "_core.py").write_text("")
        done = run(
            sys.executable,
            "-m",
            "mems_stiction.archive",
            env=dict(os.environ, PYTHONPATH=str(empty.parent)),
        )
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
        self.assertIn(
            "stiction_batch is in none of its places: %s/stiction_batch" % empty, done.stderr
        )

    def test_tasks_of_an_array_have_the_rows_of_one_call(self):
        for task in (1, 2, 3):
            done = run(
                EXAMPLES / "batch_array.sbatch",
                self.folder / "scans.txt",
                self.folder / "part.yaml",
                self.folder / "rows",
                env=dict(
                    with_program(),
                    SLURM_ARRAY_TASK_ID=str(task),
                    SLURM_ARRAY_TASK_COUNT="3",
                    SLURM_CPUS_PER_TASK="2",
                ),
            )
            self.assertEqual(done.returncode, 0, done.stderr)
        one = self.folder / "one.csv"
        self.assertEqual(self.archive("-o", one, *self.scans).returncode, 0)
        joined = self.folder / "joined.csv"
        done = run(
            sys.executable,
            "-m",
            "mems_stiction.archive",
            "--merge",
            "-o",
            joined,
            *(self.folder / "rows").glob("*.csv"),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(joined.read_text(), one.read_text())

    def test_counts_of_the_dask_example_are_above_zero(self):
        for option in ("--workers", "--shards"):
            for value in ("0", "-3", "many"):
                done = run(
                    EXAMPLES / "batch_dask.py",
                    option,
                    value,
                    "-o",
                    self.folder / "none.jsonl",
                    *self.scans,
                )
                self.assertEqual(done.returncode, 2)
                self.assertNotIn("Traceback", done.stderr)
                self.assertIn(
                    "argument %s: '%s' is not allowed, must be a whole number > 0"
                    % (option, value),
                    done.stderr,
                )

    def test_a_worker_that_is_killed_costs_nothing(self):
        """A real cluster: a scheduler and two workers, of which one is killed when it has work and
        some rows are there."""
        try:
            import distributed
        except ImportError:
            self.skipTest("distributed is not installed")
        slow = self.folder / "slow.yaml"
        slow.write_text(
            CONFIG + "approach: {formulation: paper, max_steps: 10000000}\npaper: {step: 2.0e-13}\n"
        )  # seconds
        expected = self.folder / "slow.jsonl"
        self.assertEqual(
            run(
                sys.executable,
                "-m",
                "mems_stiction.archive",
                "--config",
                slow,
                "-o",
                expected,
                *self.scans,
            ).returncode,
            0,
        )
        processes = []

        def start(*command):
            processes.append(
                subprocess.Popen(
                    [str(part) for part in command],
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                    cwd=str(self.folder),
                    env=with_program(),
                )
            )
            return processes[-1]

        def wait_for(condition, what):
            end = time.monotonic() + 300
            while not condition():
                self.assertLess(time.monotonic(), end, what)
                time.sleep(0.01)

        def rows_so_far():
            return sum(
                len(path.read_text().splitlines())
                for path in self.folder.glob("dask.shard_*.jsonl")
            )

        try:
            address_file = self.folder / "scheduler.json"
            start(
                sys.executable,
                "-m",
                "distributed.cli.dask_scheduler",
                "--host",
                "127.0.0.1",
                "--port",
                "0",
                "--no-dashboard",
                "--scheduler-file",
                address_file,
            )
            wait_for(address_file.exists, "no scheduler")
            workers = [
                start(
                    sys.executable,
                    "-m",
                    "distributed.cli.dask_worker",
                    "--scheduler-file",
                    address_file,
                    "--nthreads",
                    "1",
                    "--no-nanny",
                    "--no-dashboard",
                    "--host",
                    "127.0.0.1",
                )
                for _ in range(2)
            ]
            address = json.loads(address_file.read_text())["address"]
            with distributed.Client(address, timeout=300) as client:
                client.wait_for_workers(2, timeout=300)
                output = self.folder / "dask.jsonl"
                call = subprocess.Popen(
                    [
                        sys.executable,
                        str(EXAMPLES / "batch_dask.py"),
                        "--scheduler",
                        address,
                        "--config",
                        str(slow),
                        "--shards",
                        "3",
                        "-o",
                        str(output),
                    ]
                    + [str(path) for path in self.scans],
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    universal_newlines=True,
                    env=with_program(),
                )
                processes.append(call)
                wait_for(lambda: rows_so_far() >= 3, "no rows")
                workers[0].send_signal(signal.SIGKILL)
                done_before = rows_so_far()
                out, err = call.communicate(timeout=600)
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

    @evidence
    def test_workers_of_this_machine(self):
        try:
            import distributed  # noqa: F401
        except ImportError:
            self.skipTest("distributed is not installed")
        path = self.folder / "local.jsonl"
        done = run(
            sys.executable,
            EXAMPLES / "batch_dask.py",
            "--config",
            self.folder / "part.yaml",
            "-o",
            path,
            *self.scans,
            env=with_program(),
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(path.read_text(), self.expected.read_text())


if __name__ == "__main__":
    unittest.main()
