"""correlation() of made pairs: of a known rho, by band, with an interval that contains it; and of a
counter-surface that the settings make fit."""

import pathlib
import sys
import unittest
import warnings

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import PITCH, Topography, rough  # noqa: E402  (the path comes first)

DOWN = {"counter_surface": {"facing": "down"}}
SIDE = 128


def pair(rho, seed=1, length=None, rms=(5e-9, 3e-9)):
    """Two cuts of periodic surfaces, so that their frames are none; waves longer than `length` [m]
    are correlated, or all."""
    own = [rough(2 * SIDE, 2 * SIDE, 1.0, 2 * seed + i, length=8) for i in (0, 1)]
    waves = [np.fft.rfft2(one) for one in own]
    q = np.hypot(np.fft.fftfreq(2 * SIDE)[:, None], np.fft.rfftfreq(2 * SIDE)[None, :])
    shared = rho * (q <= PITCH / length if length else np.ones(q.shape, dtype=bool))
    upper = np.fft.irfft2(shared * waves[0] + np.sqrt(1 - shared**2) * waves[1], s=own[0].shape)
    return rms[0] * own[0][:SIDE, :SIDE], rms[1] * upper[:SIDE, :SIDE]


class CorrelationTest(unittest.TestCase):
    def test_bands_have_the_correlation_that_was_made(self):
        for rho in (0.0, 0.5, 0.9):
            inside, count, wholes = 0, 0, []
            for seed in range(12):
                lower, upper = pair(rho, seed)
                found = mems_stiction.correlation(lower, upper, PITCH, **DOWN)
                bands = found.bands[found.bands.wavelength > 6 * PITCH]
                inside += np.sum(
                    (bands.correlation_lower <= rho) & (rho <= bands.correlation_upper)
                )
                count += len(bands)
                wholes.append(found.correlation)
                self.assertLess(found.correlation_lower, found.correlation)
                self.assertLess(found.correlation, found.correlation_upper)
            self.assertGreater(inside, 0.9 * count, rho)
            self.assertLess(abs(np.mean(wholes) - rho), 0.06, rho)

    def test_what_is_between_follows_from_it(self):
        lower, upper = pair(0.8, 3)
        found = mems_stiction.correlation(lower, upper, PITCH, **DOWN)
        between = mems_stiction.correlation(lower, lower - upper, PITCH, **DOWN).bands
        expected = (
            found.bands.rms_lower**2
            + found.bands.rms_upper**2
            - 2 * found.bands.correlation * found.bands.rms_lower * found.bands.rms_upper
        )
        np.testing.assert_allclose(between.rms_upper, np.sqrt(expected), rtol=1e-9)

    def test_long_waves_alone_may_be_shared(self):
        length = 25 * PITCH
        lower, upper = pair(0.9, 5, length)
        found = mems_stiction.correlation(lower, upper, PITCH, **DOWN)
        rho, at_least, at_most = found.longer_than(length)
        self.assertTrue(at_least <= 0.9 <= at_most, (at_least, at_most))
        # waves that are hardly there are what the window leaks of longer ones
        is_short = (found.bands.longest < 0.7 * length) & (found.bands.wavelength > 8 * PITCH)
        short = found.bands[is_short]
        self.assertGreater(len(short), 1)
        self.assertLess(np.abs(short.correlation).max(), 0.4)
        self.assertRaisesRegex(
            mems_stiction.SurfaceError, "no band of waves beyond", found.longer_than, 1.0
        )

    def test_counter_surfaces_that_are_made_to_fit_do(self):
        scan = rough(SIDE, SIDE, 4e-9, 9, length=8)
        fit = {"type": "gaussian", "correlation": 0.8, "correlation_length": 400e-9}
        fit["gaussian"] = {"correlation_length_x": 100e-9, "correlation_length_y": 100e-9}
        found = mems_stiction.correlation(scan, pitch=PITCH, counter_surface=fit)
        rho, at_least, at_most = found.longer_than(400e-9)
        self.assertTrue(at_least < 0.8 < at_most, (at_least, rho, at_most))
        plain = dict(fit, correlation=0.0, correlation_length=0.0)
        apart = mems_stiction.predict(scan, PITCH, counter_surface=plain)
        near = mems_stiction.predict(scan, PITCH, counter_surface=fit)
        self.assertLess(near.mean_gap, 0.9 * apart.mean_gap)
        self.assertGreater(near.pull_off_force, apart.pull_off_force)

    def test_facing_pose_holes_and_topographies_are_those_of_predict(self):
        lower, upper = pair(0.7, 2)
        down = mems_stiction.correlation(lower, upper, PITCH, **DOWN)
        up = mems_stiction.correlation(
            lower, -upper[:, ::-1], PITCH, counter_surface={"facing": "up"}
        )
        np.testing.assert_array_equal(up.bands, down.bands)
        self.assertRaisesRegex(
            mems_stiction.OptionsError, "facing", mems_stiction.correlation, lower, upper, PITCH
        )
        moved = mems_stiction.correlation(
            lower, upper, PITCH, counter_surface={"facing": "down", "pose": {"offset_x": 4 * PITCH}}
        )
        self.assertLess(moved.correlation, 0.8 * down.correlation)
        holes = lower.copy()
        holes[20:26, 30:60] = np.nan
        masked = mems_stiction.correlation(holes, upper, PITCH, **DOWN)
        self.assertLess(abs(masked.correlation - down.correlation), 0.05)
        sizes = (SIDE * PITCH, SIDE * PITCH)
        topography = mems_stiction.correlation(
            Topography(lower.T, sizes, "m"), Topography(upper.T, sizes, "m"), **DOWN
        )
        np.testing.assert_array_equal(topography.bands, down.bands)

    def test_what_fits_nothing_is_refused(self):
        lower, upper = pair(0.5)
        for wrong, words in (
            (dict(), "a plane fits nothing"),
            (dict(upper=upper, bands_per_octave=0, **DOWN), "bands_per_octave: 0"),
            (dict(upper=upper[:100], **DOWN), "grid|size|rows"),
            (dict(upper=np.zeros(upper.shape), **DOWN), "without relief"),
        ):
            with (
                warnings.catch_warnings(),
                self.assertRaisesRegex(mems_stiction.SurfaceError, words),
            ):
                warnings.simplefilter("ignore")  # a flat one looks like none
                mems_stiction.correlation(lower, pitch=PITCH, **wrong)
        found = mems_stiction.correlation(lower, upper, PITCH, **DOWN)
        with self.assertRaisesRegex(AttributeError, "cannot be changed"):
            found.correlation = 1.0
        with self.assertRaises(ValueError):
            found.bands.correlation[0] = 1.0


if __name__ == "__main__":
    unittest.main()
