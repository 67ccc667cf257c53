"""A made surface in strips: of any order and cut, on other processes, and on a Dask cluster that
loses a worker."""

import json
import pathlib
import pickle
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from module_cases import REPOSITORY, rough  # noqa: E402  (the path comes first)
from tiers import evidence  # noqa: E402

PITCH = 10e-9
SIDE = 700  # pixels: a tile and a part of one
AREA = (SIDE * PITCH) ** 2
LARGE = 2300  # so many that not every cell is told
EXAMPLE = REPOSITORY / "scripts/examples/device_on_dask.py"
# Faces and interface of config/polysilicon_oxide.yaml come from the defaults: contacts are few.
SCANS = [rough(128, 128, 6e-9, 1), rough(128, 128, 6e-9, 2)]


def made(area=AREA, given=SCANS, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        return mems_stiction.MadeSurface(given, PITCH, area=area, **settings)


def adhesion(surface, cuts):
    """By strips that end at these rows, in an order by lot."""
    ends = [0] + sorted(cuts) + [surface.rows]
    strips = list(zip(ends, ends[1:]))
    random.Random(len(cuts)).shuffle(strips)
    return surface.adhesion(surface.cells(first, end - first) for first, end in strips)


def predicted(area=AREA, given=SCANS, seed=1, **settings):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mems_stiction.ScanWarning)
        return mems_stiction.predict_device(
            given,
            PITCH,
            area=area,
            device_force={"realisations": 3, "max_cells": 1e8, "seed": seed},
            **settings,
        )


class MadeSurfaceTest(unittest.TestCase):
    def test_it_is_the_realisation_of_predict_device(self):
        device = predicted(seed=5)
        for realisation in range(2):
            surface = made(seed=5, realisation=realisation)
            self.assertEqual((surface.rows, surface.cols, surface.pitch), (SIDE, SIDE, PITCH))
            self.assertEqual(
                adhesion(surface, []).tolist(), device.realisations[realisation].tolist()
            )
        self.assertNotEqual(device.realisations[0].tolist(), device.realisations[1].tolist())
        self.assertEqual(made(device_force={"seed": 5}).cells(0, 4), made(seed=5).cells(0, 4))

    def test_strips_of_any_cut_and_order_are_the_whole(self):
        surface = made()
        whole = adhesion(surface, [])
        for cuts in ([1], [350], [511, 512, 513], list(range(50, SIDE, 50)), [SIDE - 1]):
            self.assertEqual(adhesion(surface, cuts).tolist(), whole.tolist(), cuts)
        self.assertEqual(
            surface.adhesion(
                [surface.cells(first, rows) for first, rows in surface.strips(7)]
            ).tolist(),
            whole.tolist(),
        )

    def test_a_large_surface_tells_few_cells_and_the_same_force(self):
        area = (LARGE * PITCH) ** 2
        surface = made(area)
        parts = [surface.cells(first, rows) for first, rows in surface.strips(4)]
        self.assertEqual([first for first, _ in surface.strips(4)][0], 0)
        self.assertEqual(sum(rows for _, rows in surface.strips(4)), LARGE)
        self.assertEqual(
            surface.adhesion(reversed(parts)).tolist(), predicted(area).realisations[0].tolist()
        )
        self.assertLess(sum(len(part) for part in parts), 0.2 * 4 * LARGE**2)

    def test_contacts_and_a_counter_surface(self):
        settings = {
            "contacts": 3,
            "upper": rough(128, 128, 2e-9, 3),
            "counter_surface": {"facing": "up"},
        }
        surface = made(given=SCANS[:1], **settings)
        self.assertEqual(surface.rows, 3 * surface.cols)
        device = predicted(given=SCANS[:1], **settings)
        for cuts in ([], [surface.cols], [7, surface.cols + 100, 2 * surface.cols + 3]):
            self.assertEqual(
                adhesion(surface, cuts).tolist(), device.realisations[0].tolist(), cuts
            )

    def test_heights_do_not_depend_on_the_part(self):
        surface = made(contacts=2)
        self.assertEqual(surface.strips(9), [(0, surface.cols), (surface.cols, surface.cols)])
        heights = surface.heights()
        self.assertEqual((heights.shape, heights.dtype), ((surface.rows, surface.cols), np.float32))
        self.assertAlmostEqual(float(heights.std()) / 6e-9, 1.0, delta=0.2)
        seam = surface.cols
        for row, col, rows, cols in (
            (0, 0, 1, 1),
            (seam - 3, 100, 8, 50),
            (surface.rows - 1, 0, 1, surface.cols),
        ):
            np.testing.assert_array_equal(
                surface.heights(row, col, rows, cols), heights[row : row + rows, col : col + cols]
            )
        for wrong in (
            (-1, 0, 2, 2),
            (0, 0, surface.rows + 1, 2),
            (0, surface.cols, 1, 1),
            (0, 0, 0, 1),
        ):
            with self.assertRaisesRegex(mems_stiction.SurfaceError, "must lie in the surface"):
                surface.heights(*wrong)

    def test_what_is_wrong_with_parts_is_said(self):
        surface = made()
        lower, upper = surface.cells(0, 300), surface.cells(300, SIDE - 300)
        for parts, words in (
            ([lower], "missing: rows 300 to 699 of the 700 rows"),
            ([], "missing: rows 0 to 699"),
            ([surface.cells(1, 3), surface.cells(9, 1)], "missing: row 0 and 2 other gaps"),
            ([lower, upper, lower], "^rows 0 to 299 of the surface came twice"),
            ([upper, surface.cells(200, 101)], "^row 300 of the surface came twice"),
            ([lower, made(seed=2).cells(300, SIDE - 300)], "of another surface"),
            ([made(1.01 * AREA).cells(0, 300)], "of another surface"),
            ([made(given=[1.001 * scan for scan in SCANS]).cells(0, 300)], "of another surface"),
            ([lower[:-1]], "cut off or changed"),
            ([b"rows"], "are no strip"),
        ):
            with self.assertRaisesRegex(mems_stiction.SurfaceError, words):
                surface.adhesion(parts)
        for wrong in ((-1, 2), (0, 0), (0, SIDE + 1), (SIDE, 1)):
            with self.assertRaisesRegex(mems_stiction.SurfaceError, "must lie in the 700 rows"):
                surface.cells(*wrong)
        with self.assertRaisesRegex(mems_stiction.SurfaceError, "^realisation: -1"):
            made(realisation=-1)
        with self.assertRaisesRegex(mems_stiction.OptionsError, "device/contact_area"):
            made(None)
        with self.assertRaisesRegex(mems_stiction.OptionsError, "^depth: 0"):
            made(depth=0.0)

    def test_cells_that_are_not_deep_enough_say_which_depth_is(self):
        whole = adhesion(made(), []).tolist()
        surface = made(depth=1e-10)
        with self.assertRaisesRegex(
            mems_stiction.SurfaceError, "with a depth of [0-9.e-]+ m"
        ) as raised:
            adhesion(surface, [300])
        depth = float(str(raised.exception).split("a depth of ")[1].split(" m")[0])
        self.assertEqual(adhesion(made(depth=depth), [300]).tolist(), whole)

    def test_pickled_it_is_made_again_elsewhere(self):
        surface = made(seed=3)
        text = pickle.dumps(surface)
        self.assertLess(len(text), 1000000)
        program = (
            "import pickle, sys; surface = pickle.load(sys.stdin.buffer); "
            "sys.stdout.buffer.write(surface.cells(100, 600))"
        )
        part = subprocess.run(
            [sys.executable, "-c", program], input=text, stdout=subprocess.PIPE, check=True
        ).stdout
        self.assertEqual(part, surface.cells(100, 600))
        self.assertEqual(
            surface.adhesion([part, surface.cells(0, 100)]).tolist(), adhesion(surface, []).tolist()
        )

    def test_threads_share_one(self):
        surface = made()
        parts = {}

        def make(first):
            parts[first] = surface.cells(first, 100)

        threads = [threading.Thread(target=make, args=(first,)) for first in range(0, SIDE, 100)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(surface.adhesion(parts.values()).tolist(), adhesion(surface, []).tolist())


class DaskTest(unittest.TestCase):
    """A real cluster: a scheduler and two workers."""

    def setUp(self):
        try:
            import distributed
        except ImportError:
            self.skipTest("distributed is not installed")
        self.distributed = distributed
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scans = []
        for place, heights in enumerate(SCANS):
            self.scans.append(str(self.folder / ("%d.npy" % place)))
            np.save(self.scans[-1], heights)

    def start(self, *command):
        process = subprocess.Popen(
            [str(part) for part in command],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=str(self.folder),
        )
        self.addCleanup(self.end, process)
        return process

    @staticmethod
    def end(process):
        if process.poll() is None:
            process.kill()
        process.wait()

    def example(self, *arguments):
        return (
            [
                sys.executable,
                "-W",
                "ignore",
                str(EXAMPLE),
                "--area",
                repr((LARGE * PITCH) ** 2),
                "--pitch",
                repr(PITCH),
                "--seed",
                "7",
            ]
            + [str(argument) for argument in arguments]
            + self.scans
        )

    def assert_found(self, text, **settings):
        """What one process finds."""
        found = json.loads(text)
        surface = made((LARGE * PITCH) ** 2, seed=7, **settings)
        self.assertEqual(
            (found["rows"], found["cols"], found["pitch"]), (surface.rows, surface.cols, PITCH)
        )
        self.assertEqual(
            tuple(
                found[name]
                for name in (
                    "pull_off_force",
                    "apparent_work_of_adhesion",
                    "contacts",
                    "separation_at_rest",
                )
            ),
            adhesion(surface, []).tolist(),
        )

    def test_workers_of_this_machine(self):
        done = subprocess.run(
            self.example("--workers", 2, "--strips", 4),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_found(done.stdout)

    @evidence
    def test_a_worker_that_is_killed_costs_nothing(self):
        address_file = self.folder / "scheduler.json"
        self.start(
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
        end = time.monotonic() + 300
        while not address_file.exists():
            self.assertLess(time.monotonic(), end, "no scheduler")
            time.sleep(0.01)
        workers = [
            self.start(
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
        with self.distributed.Client(address, timeout=300) as client:
            client.wait_for_workers(2, timeout=300)
            call = subprocess.Popen(
                self.example("--scheduler", address, "--contacts", 16, "--strips", 40),
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                universal_newlines=True,
            )
            self.addCleanup(self.end, call)
            self.assertEqual(call.stderr.readline(), "1 of 16 strips\n")
            workers[0].send_signal(signal.SIGKILL)
            out, err = call.communicate(timeout=600)
            self.assertEqual(call.returncode, 0, err)
            self.assertEqual(len(client.scheduler_info()["workers"]), 1)
        self.assertEqual(workers[0].wait(), -signal.SIGKILL)
        self.assert_found(out, contacts=16)

    def test_what_is_wrong_is_one_line(self):
        done = subprocess.run(
            [sys.executable, str(EXAMPLE), "--area", "1e-11", str(self.folder / "none.npy")],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"^device_on_dask: .*none\.npy")
        self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
