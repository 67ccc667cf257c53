"""Surfaces of stylus profiles: a random one has the heights, slopes and curvatures of the surface
that the profile was taken from; grooves are the line; what is no profile is refused."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from module_cases import REPOSITORY  # noqa: E402  (the path comes first)

PROGRAM = str(REPOSITORY / "scripts" / "profile_surface")
PITCH = 10e-9


def surface(hurst, seed):
    return mems_stiction.generate(
        (256, 4096),
        PITCH,
        counter_surface={
            "type": "self_affine",
            "seed": seed,
            "self_affine": {
                "rms_height": 2e-9,
                "hurst_exponent": hurst,
                "rolloff_wavelength": 3e-7,
            },
        },
    ).heights


def moments(heights):
    """Rms height, slope along x and along y, curvature."""
    return np.array(
        [
            np.std(heights),
            np.std(np.diff(heights, axis=1)),
            np.std(np.diff(heights, axis=0)),
            np.std(np.diff(heights, 2, axis=1)),
        ]
    )


class ProfileTest(unittest.TestCase):
    def test_a_random_surface_has_the_statistics_of_the_one_that_was_measured(self):
        for hurst, seed in ((0.8, 1), (0.8, 2), (0.4, 3)):
            measured = surface(hurst, seed)
            made = mems_stiction.surface_of_profile(
                measured[100], PITCH, "isotropic", shape=(256, 2048), seed=seed
            )
            ratios = moments(made.heights) / moments(measured)
            self.assertTrue(np.all(np.abs(ratios - 1.0) < 0.12), (hurst, ratios))

    def test_a_single_wave_becomes_waves_of_that_length_in_all_directions(self):
        length = 40 * PITCH
        line = 2e-9 * np.sin(2 * np.pi * np.arange(4000) * PITCH / length)
        made = mems_stiction.surface_of_profile(line, PITCH, "isotropic", shape=(400, 400)).heights
        power = np.abs(np.fft.fft2(made)) ** 2
        waves = np.hypot(*np.meshgrid(np.fft.fftfreq(400, PITCH), np.fft.fftfreq(400, PITCH)))
        # shorter ones would show in the profile; longer ones are what a ring looks like obliquely
        self.assertLess(power[waves > 1.35 / length].sum(), 0.02 * power.sum())
        self.assertAlmostEqual(np.std(made) / np.std(line), 1.0, delta=0.15)
        along_x = power[:, np.abs(np.fft.fftfreq(400, PITCH)) > 0.8 / length].sum()
        along_y = power[np.abs(np.fft.fftfreq(400, PITCH)) > 0.8 / length, :].sum()
        self.assertTrue(0.5 < along_x / along_y < 2.0, along_x / along_y)  # a few waves

    def test_grooves_are_the_line_and_seeds_are_surfaces_of_their_own(self):
        line = surface(0.8, 4)[0]
        grooves = mems_stiction.surface_of_profile(line, PITCH, "grooves", shape=(32, 300))
        np.testing.assert_array_equal(grooves.heights, np.tile(line[:300], (32, 1)))
        one, same, other = (
            mems_stiction.surface_of_profile(line, PITCH, "isotropic", seed=seed).heights
            for seed in (1, 1, 2)
        )
        np.testing.assert_array_equal(one, same)
        self.assertLess(abs(np.corrcoef(one.ravel(), other.ravel())[0, 1]), 0.2)

    def test_what_is_no_profile_is_refused(self):
        line = surface(0.8, 5)[0]
        missing = line.copy()
        missing[7] = np.nan
        for words, arguments in (
            ("at least 64 points", (line[:63], PITCH, "grooves")),
            ("one line", (np.zeros((70, 70)), PITCH, "grooves")),
            ("1 of 4096 points are not measured", (missing, PITCH, "grooves")),
            ("kind: 'ground'", (line, PITCH, "ground")),
            ("pitch: (1e-08, 2e-08)", (line, (1e-8, 2e-8), "grooves")),
            ("without any roughness", (1e-9 * np.arange(100.0), PITCH, "isotropic")),
        ):
            with self.assertRaises(mems_stiction.SurfaceError) as raised:
                mems_stiction.surface_of_profile(*arguments)
            self.assertIn(words, str(raised.exception))
        with self.assertRaises(mems_stiction.SurfaceError):
            mems_stiction.surface_of_profile(line, PITCH, "grooves", shape=(8, 5000))

    def test_skewed_heights_are_said(self):
        random = np.random.RandomState(1)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            mems_stiction.surface_of_profile(1e-9 * random.exponential(size=500), 1e-8, "isotropic")
        self.assertIn("skewed", str(told[0].message))

    def test_the_program_makes_what_the_function_makes_of_any_text(self):
        line = surface(0.8, 6)[0, :512]
        place = PITCH * np.arange(512)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "stylus 1.txt"
            made = pathlib.Path(folder) / "stylus 1_isotropic.npy"
            micrometres = ["%.4f;%.9f" % pair for pair in zip(1e6 * place, 1e6 * line)]
            for text, options in (
                ("\n".join("%.9e" % height for height in line), ("--pitch", "1e-8")),
                ("x [um]\tz [um]\n" + "\n".join(micrometres), ("--unit", "um")),
                ("Weg;Wert\r\n" + "\r\n".join(micrometres).replace(".", ","), ("--unit", "um")),
                ("\n".join(reversed(micrometres)), ("--unit", "um")),
            ):
                path.write_text(text, encoding="utf-8")
                done = self.run_program(path, "--seed", "3", *options)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn("one of many (--seed)", done.stdout)
                heights = line[::-1] if "reversed" in repr(options) else line
                expected = mems_stiction.surface_of_profile(heights, PITCH, "isotropic", seed=3)
                read = mems_stiction.read(made)
                self.assertAlmostEqual(read.pitch[0], PITCH, delta=1e-6 * PITCH)
                np.testing.assert_allclose(read.heights, expected.heights, atol=1e-13)
                made.unlink()
            for text, words in (
                ("1 2\n2 3\n9 1\n10 1\n", "positions must be even"),
                ("nothing\n", "holds no line"),
                ("1 2 3\n", "has 3 numbers"),
                ("1 2\nx\n", "line 2: 'x' is no number"),
                ("z\n0,6\n1,12\n", "line 2: '0,6' is the number 0.6 with a decimal comma, or"),
                ("1\n2\n\n4\n", "line 3: is empty between heights"),
                ("1,5\n;\n2\n3\n", "line 2: is empty between heights"),
            ):
                path.write_text(text, encoding="utf-8")
                done = self.run_program(path, "--pitch", "1")
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertFalse(made.exists())

    def test_commas_are_decimal_where_the_numbers_say_so(self):
        count = range(64)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.txt"
            for lines, heights in (
                (["-0,%d" % place for place in count], [-float("0.%d" % n) for n in count]),
                (["3,%02d" % place for place in count], [3 + n / 100 for n in count]),
                (["%d,%d" % (n, n % 7 - 3) for n in count], [n % 7 - 3 for n in count]),
                (["%d, %d" % (n, n % 7) for n in count], [n % 7 for n in count]),
                (["%de0,%de-3" % (n, n % 7) for n in count], [1e-3 * (n % 7) for n in count]),
                (["%d,%d," % (n, n % 7) for n in count], [n % 7 for n in count]),
                (["%d,0 %d,2" % (n, n % 7) for n in count], [n % 7 + 0.2 for n in count]),
                (["%d,5" % (n % 7) for n in count] + ["3"], [n % 7 + 0.5 for n in count] + [3]),
                (["%d,5\n" % (n % 7) for n in count] + ["3"], [n % 7 + 0.5 for n in count] + [3]),
            ):
                for heading in ("", "Profile no. 1, 0.5 um/s\n"):
                    path.write_text(heading + "\n".join(lines) + "\n", encoding="utf-8")
                    done = self.run_program("--pitch", "1", "--kind", "grooves", path)
                    self.assertEqual((done.returncode, done.stderr), (0, ""), lines[:2])
                    made = np.load(str(path.with_name("a_grooves.npy")))
                    np.testing.assert_allclose(made[0], heights, atol=1e-12)

    def test_what_is_no_file_is_refused_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = pathlib.Path(folder) / "pipe.txt"
            os.mkfifo(str(pipe))
            large = pathlib.Path(folder) / "large.txt"
            large.touch()
            os.truncate(str(large), 1 << 32)
            for path, words in (
                ("/dev/zero", "is a pipe, a socket or a device, not a file"),
                (pipe, "is a pipe, a socket or a device, not a file"),
                (folder, "is a folder, not a profile"),
                (large, "more than the 50000000 of a profile"),
            ):
                done = self.run_program(path, timeout=60)
                self.assertEqual(done.returncode, 2)
                self.assertIn(words, done.stderr)

    def run_program(self, *arguments, timeout=None):
        return subprocess.run(
            [sys.executable, PROGRAM, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=timeout,
        )


if __name__ == "__main__":
    unittest.main()
