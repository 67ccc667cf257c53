"""Thin bodies under the half-space of the Python module, against a solution of the same contact by
Numpy alone.

The other solution is Polonsky and Keer's (Wear 231 (1999) 206): conjugate gradients over the cells
in contact, which carry pressure and have no gap. Its stiffness of a wave is written down here as
others have: Carbone and Mangialardi (2008), equation A.30, which ContactMechanics takes for
`thickness`, and Filon (1903) for a plate.
"""

import json
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
from module_cases import program, rough  # noqa: E402  (the path comes first)

SIZE, PITCH = 64, 5e-9
YOUNG, POISSON = 90e9, 0.3
RIGID = {"youngs_modulus": 1e30}
WALL = {"range": 1e-11, "attraction": False, "flow": False, "step": 2.0, "tolerance": 1e-5}


def half_space_share(s):
    return np.ones_like(s)


def plate_share(s):
    """Stiffness of a wave over that of a half-space, s = q t: a plate with a free back."""
    return (np.sinh(s) ** 2 - s**2) / (np.sinh(s) * np.cosh(s) + s)


def film_share(s):
    """The same of a film on something rigid."""
    g = 3 - 4 * POISSON
    return (g * np.cosh(2 * s) + 2 * s**2 + 4 * POISSON * (2 * POISSON - 3) + 5) / (
        g * np.sinh(2 * s) - 2 * s
    )


def pressures(heights, thickness, share, mean_pressure):
    """Pressure of each cell [Pa] of the surface on something rigid and flat."""
    q = (
        2
        * np.pi
        * np.hypot(np.fft.fftfreq(SIZE, PITCH)[:, None], np.fft.rfftfreq(SIZE, PITCH)[None, :])
    )
    q[0, 0] = 1.0
    compliance = 2 / (YOUNG / (1 - POISSON**2) * q * share(np.minimum(q * thickness, 300.0)))
    compliance[0, 0] = 0.0  # the mean displacement is the height of the body

    def displaced(pressure):
        return np.fft.irfft2(compliance * np.fft.rfft2(pressure), s=heights.shape)

    pressure = np.full_like(heights, mean_pressure)
    direction, last, turns = np.zeros_like(heights), 1.0, False
    for _ in range(20000):
        gap = displaced(pressure) - heights
        touches = pressure > 0
        gap -= gap[touches].mean()
        norm = (gap[touches] ** 2).sum()
        direction = np.where(touches, gap + (norm / last * direction if turns else 0.0), 0.0)
        last = norm
        along = displaced(direction)
        along -= along[touches].mean()
        length = (gap * direction)[touches].sum() / (along * direction)[touches].sum()
        before = pressure
        pressure = np.where(touches, np.maximum(pressure - length * direction, 0.0), 0.0)
        overlaps = (pressure == 0) & (gap < 0)
        pressure[overlaps] -= length * gap[overlaps]
        turns = not overlaps.any()
        pressure *= mean_pressure / pressure.mean()
        if np.abs(pressure - before).max() < 1e-9 * pressure.max():
            return pressure
    raise AssertionError("no convergence")


def plate_frame(seed):
    """Heights [m], pitch [m] and settings of a self-affine frame of a free plate under something
    rigid, whose pixels show what holds."""
    random = np.random.default_rng(seed)

    def between(low, high):
        return np.exp(random.uniform(np.log(low), np.log(high)))

    modulus, work, hamaker = between(5e9, 150e9), between(0.01, 0.12), 65e-21
    z0 = np.sqrt(hamaker / (16 * np.pi * work))
    pitch = min(modulus * z0**2 / work, 50e-9) * between(0.15, 0.8)
    thickness = SIZE * pitch / between(3, 50)
    q = 2 * np.pi * np.hypot(np.fft.fftfreq(SIZE)[:, None], np.fft.rfftfreq(SIZE)[None])
    roll_off = 2 * np.pi / (SIZE * between(0.12, 1))
    amplitude = np.maximum(q, roll_off) ** (-1 - random.uniform(0.5, 0.95))
    amplitude[(q > 2 * np.pi / 6) | (q == 0)] = 0.0
    waves = np.fft.rfft2(random.normal(size=(SIZE, SIZE))) * amplitude
    heights = np.fft.irfft2(waves, s=(SIZE, SIZE))
    heights *= z0 * between(0.7, 12) / heights.std()
    stiff = {"upper/youngs_modulus": 1e17, "upper/hardness": 1e14, "lower/hardness": 1e14}
    poisson = {"upper/poisson_ratio": 0.0, "lower/poisson_ratio": 0.0}
    return (
        heights,
        pitch,
        {
            "interface/work_of_adhesion": work,
            "interface/hamaker_constant": hamaker,
            "lower/youngs_modulus": modulus,
            "lower/thickness": thickness,
            "limits/accept_implausible": True,
            "half_space/flow": False,
            **stiff,
            **poisson,
        },
    )


class PlatesAndFilmsTest(unittest.TestCase):
    def setUp(self):
        self.heights = rough(SIZE, SIZE, 1e-9, 7, 12)
        self.heights -= self.heights.max()

    def solve(self, mean_pressure, **lower):
        settings = {
            "lower": dict(lower, youngs_modulus=YOUNG, poisson_ratio=POISSON),
            "upper": RIGID,
            "half_space": WALL,
            "limits": {"accept_implausible": True},
            "load": {"mechanical_load": mean_pressure * (SIZE * PITCH) ** 2},
        }
        with warnings.catch_warnings():  # something rigid is no usual material
            warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
            return mems_stiction.half_space(self.heights, PITCH, settings)

    def test_rough_frames_carry_what_another_solution_says(self):
        length = SIZE * PITCH
        for share, backing, thickness, mean_pressure in (
            (half_space_share, "free", 0.0, 2e8),
            (plate_share, "free", length / 3, 1e8),
            (plate_share, "free", length / 12, 2e7),
            (film_share, "bonded", length / 3, 2e8),
            (film_share, "bonded", length / 25, 4e8),
        ):
            expected = pressures(self.heights, thickness, share, mean_pressure)
            found = self.solve(mean_pressure, thickness=thickness, backing=backing)
            self.assertEqual(found.status, "SOLVED", found.message)
            touching = np.count_nonzero(expected)
            what = "%s of %g m: %d cells" % (backing, thickness, touching)
            self.assertTrue(0.02 * SIZE**2 < touching < 0.9 * SIZE**2, what)
            self.assertAlmostEqual(
                found.contact_fraction * SIZE**2 / touching,
                1.0,
                delta=max(0.01, 1 / touching),
                msg=what,
            )
            self.assertLess(
                np.linalg.norm(found.pressure - expected), 0.01 * np.linalg.norm(expected), what
            )

    def test_a_plate_that_rests_on_many_places_is_doubted(self):
        """22 thicknesses wide, it holds some five times as much as the thick body for which the
        curve takes it."""
        heights, pitch, settings = plate_frame(1077)
        force = {}
        for thickness in (0.0, settings["lower/thickness"]):
            settings["lower/thickness"] = thickness
            with warnings.catch_warnings():  # something rigid is no usual material
                warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
                curve = mems_stiction.predict(heights, pitch, **settings)
                solution = mems_stiction.half_space(heights, pitch, **settings)
            self.assertEqual(solution.status, "SOLVED", solution.message)
            self.assertEqual("thin" in curve.model_doubt, thickness > 0.0, curve.model_doubt)
            force[thickness] = solution.pull_off_force
            if thickness == 0.0:
                self.assertLess(abs(np.log(curve.pull_off_force / force[0.0])), np.log(1.1))
        self.assertTrue(4.0 < force[settings["lower/thickness"]] / force[0.0] < 6.0, force)

    def test_predict_scan_finds_the_same_of_the_same_settings(self):
        lower = {
            "youngs_modulus": YOUNG,
            "backing": "bonded",
            "substrate": {"youngs_modulus": 5e9, "poisson_ratio": 0.4},
        }
        figures = {}
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
            scan, config = pathlib.Path(folder) / "scan.npy", pathlib.Path(folder) / "config.yaml"
            np.save(str(scan), self.heights)
            for thickness in (0.0, 30e-9):
                lower["thickness"] = thickness
                config.write_text(json.dumps({"lower": lower}))
                command = [
                    program(),
                    "--half-space",
                    "--json",
                    "--pitch",
                    str(PITCH),
                    "-c",
                    str(config),
                    str(scan),
                ]
                record = json.loads(
                    subprocess.run(
                        command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
                    ).stdout.decode()
                )
                found = mems_stiction.half_space(self.heights, PITCH, {"lower": lower})
                figures[thickness] = record["half_space"]["pull_off_force"]
                self.assertEqual(found.pull_off_force, figures[thickness])
        self.assertGreater(abs(figures[30e-9] / figures[0.0] - 1), 0.005)

    def test_settings_that_make_no_sense_are_named(self):
        for lower, words in (
            ({"thickness": -1e-6}, "lower/thickness: -1e-06 m"),
            ({"backing": "glued"}, "lower/backing: 'glued'.*free, bonded"),
            (
                {"thickness": 1e-6, "substrate": {"youngs_modulus": 7e10}},
                "lower/substrate/youngs_modulus: 7e\\+10 Pa with lower/backing free",
            ),
            (
                {"thickness": 1e-6, "backing": "bonded", "substrate": {"poisson_ratio": 0.6}},
                "lower/substrate/poisson_ratio: 0.6",
            ),
        ):
            with self.assertRaisesRegex(mems_stiction.OptionsError, words):
                mems_stiction.half_space(self.heights, PITCH, lower=lower)
        with (
            warnings.catch_warnings(),
            self.assertRaisesRegex(
                mems_stiction.OptionsError, "lower/thickness: 1e-06 m with half_space/boundary free"
            ),
        ):
            warnings.simplefilter("ignore", mems_stiction.SettingsWarning)
            mems_stiction.half_space(
                self.heights, PITCH, lower={"thickness": 1e-6}, half_space={"boundary": "free"}
            )


if __name__ == "__main__":
    unittest.main()
