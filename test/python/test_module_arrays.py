"""Arrays of the Python module: none is copied that need not be, topographies keep their order,
surfaces can be generated."""

import pathlib
import sys
import unittest

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from module_cases import DEVICE, PITCH, Topography, frames, rough, topographies, without_times  # noqa: E402  (the path comes first)


class ArrayTest(unittest.TestCase):
    def test_what_the_type_allows_is_not_copied(self):
        whole = rough(80, 90)
        read_only = whole.copy()
        read_only.flags.writeable = False
        for heights in (
            whole,
            whole.astype(np.float32),
            read_only,
            whole[10:50, 20:70],
            whole[::2],
        ):
            self.assertTrue(
                np.shares_memory(mems_stiction.predict(heights, PITCH).heights, heights)
            )

    def test_every_layout_predicts_the_same(self):
        heights = rough(40, 50)
        expected = without_times(mems_stiction.predict(heights, PITCH).to_dict())
        wide = np.repeat(np.repeat(heights, 2, 0), 3, 1)
        shifted = (
            np.frombuffer(b"x" + heights.tobytes(), np.uint8)[1:]
            .view(np.float64)
            .reshape(heights.shape)
        )
        for other in (
            np.asfortranarray(heights),
            wide[::2, ::3],
            heights[::-1, ::-1][::-1, ::-1],
            heights[::-1].copy()[::-1],
            heights.astype(">f8"),
            heights.tolist(),
            np.ma.masked_invalid(heights),
            shifted,
        ):
            self.assertEqual(without_times(mems_stiction.predict(other, PITCH).to_dict()), expected)

    def test_masked_pixels_are_missing(self):
        heights = rough(40, 50)
        mask = heights > np.percentile(heights, 95)
        missing = np.where(mask, np.nan, heights)
        masked = np.ma.masked_array(heights, mask)
        self.assertEqual(
            without_times(mems_stiction.predict(masked, PITCH).to_dict()),
            without_times(mems_stiction.predict(missing, PITCH).to_dict()),
        )
        self.assertAlmostEqual(
            mems_stiction.predict(masked, PITCH).invalid_fraction, mask.mean(), delta=1e-12
        )  # round-off

    def test_numbers_beyond_a_height_are_missing(self):
        heights = rough(40, 50)
        missing = heights.copy()
        heights[5, 5], heights[6, 7] = 1e21, -1e38
        missing[5, 5] = missing[6, 7] = np.nan
        for kind in (np.float32, np.float64):
            self.assertEqual(
                without_times(mems_stiction.predict(heights.astype(kind), PITCH).to_dict()),
                without_times(mems_stiction.predict(missing.astype(kind), PITCH).to_dict()),
            )

    def test_arrays_outlive_the_prediction_and_cannot_be_written(self):
        prediction = mems_stiction.predict(
            rough(64, 64, 12e-9, 2), PITCH, load={"mechanical_load": 1e-6}
        )
        contact, asperities, curve = prediction.contact_map, prediction.asperities, prediction.curve
        expected = contact.copy(), asperities.copy(), curve.copy()
        area = prediction.contact_area
        del prediction
        for seed in range(20):  # would write over memory that is free
            mems_stiction.predict(rough(64, 64, 12e-9, seed), PITCH)
        for array, copy in zip((contact, asperities, curve), expected):
            self.assertEqual(repr(array.tolist()), repr(copy.tolist()))
            self.assertFalse(array.flags.writeable)
        self.assertAlmostEqual(
            asperities.area.sum() / area, 1.0, delta=1e-9
        )  # a sum in another order
        self.assertEqual(set(np.unique(contact)) - {0}, set(asperities.regime))

    def test_maps_have_the_index_order_of_a_topography(self):
        heights = rough(40, 60)
        expected = mems_stiction.predict(heights, (10e-9, 20e-9), load={"mechanical_load": 1e-6})
        for name, kind in topographies():
            with self.subTest(topography=name):
                topography = kind(heights.T * 1e9, (60 * 10.0, 40 * 20.0), unit="nm")
                prediction = mems_stiction.predict(topography, load={"mechanical_load": 1e-6})
                self.assertEqual(prediction.contact_map.shape, topography.heights().shape)
                # nanometres and back cost the last digit of each height
                self.assertAlmostEqual(
                    prediction.pull_off_force / expected.pull_off_force, 1.0, delta=1e-6
                )
                self.assertTrue(np.allclose(prediction.heights, heights.T, rtol=1e-12, atol=0))
                in_metres = mems_stiction.predict(
                    kind(heights.T, (60 * 10e-9, 40 * 20e-9), unit="m"),
                    load={"mechanical_load": 1e-6},
                )
                self.assertTrue(np.array_equal(in_metres.contact_map, expected.contact_map.T))
                self.assertTrue(np.array_equal(in_metres.asperities.x, expected.asperities.x))
                self.assertIn("<img", in_metres._repr_html_())

    def test_a_periodic_topography_looks_the_same_wherever_its_frame_begins(self):
        made = mems_stiction.generate(
            (64, 64), PITCH, counter_surface={"type": "gaussian", "gaussian": {"rms_height": 2e-9}}
        ).heights.copy()
        made[0, 0] = 8e-9  # a summit that only a frame that goes on can tell
        rolled = np.roll(made, (20, 11), (0, 1))
        figures = ("sal", "str", "m0", "m2", "m4", "summit_density", "mean_summit_radius", "hurst")
        for name, kind in topographies():
            with self.subTest(topography=name):
                one, other = (
                    mems_stiction.roughness(
                        kind(heights.T, (64 * PITCH, 64 * PITCH), periodic=True, unit="m")
                    )
                    for heights in (made, rolled)
                )
                for figure in figures:
                    self.assertAlmostEqual(
                        getattr(one, figure) / getattr(other, figure), 1.0, delta=1e-9, msg=figure
                    )  # sums in another order
                cut = mems_stiction.roughness(kind(made.T, (64 * PITCH, 64 * PITCH), unit="m"))
                self.assertNotAlmostEqual(cut.m0 / one.m0, 1.0, delta=1e-3)  # a window
                self.assertAlmostEqual(one.m0 / np.var(made), 1.0, delta=1e-9)  # Parseval

    def test_a_periodic_topography_is_a_periodic_half_space_whatever_the_settings_say(self):
        heights = mems_stiction.generate(
            (24, 24), PITCH, counter_surface={"type": "gaussian", "gaussian": {"rms_height": 1e-9}}
        ).heights
        settings = {"half_space": {"path": "rest"}, "load": {"mechanical_load": 1e-7}}
        pitch = 24 * PITCH / 24  # as a topography has it, to the bit
        expected = mems_stiction.half_space(heights, pitch, settings)
        free = mems_stiction.half_space(heights, pitch, settings, **{"half_space/boundary": "free"})
        self.assertNotEqual(free.mean_gap, expected.mean_gap)
        for name, kind in topographies():
            with self.subTest(topography=name):
                topography = kind(heights.T, (24 * PITCH, 24 * PITCH), periodic=True, unit="m")
                with self.assertWarnsRegex(
                    mems_stiction.ScanWarning,
                    "the topography is periodic: half_space/boundary free does not count",
                ):
                    found = mems_stiction.half_space(
                        topography, None, settings, **{"half_space/boundary": "free"}
                    )
                self.assertEqual(
                    (found.mean_gap, found.contact_count),
                    (expected.mean_gap, expected.contact_count),
                )
                with self.assertWarns(mems_stiction.ScanWarning):
                    predicted = mems_stiction.predict(
                        topography, None, settings, half_space={"enabled": True, "boundary": "free"}
                    )
                self.assertEqual(predicted.half_space["mean_gap"], expected.mean_gap)

    def test_what_comes_of_a_periodic_topography_is_one_as_long_as_its_frame_is_whole(self):
        topography = Topography(rough(64, 48).T, (48 * PITCH, 64 * PITCH), periodic=True, unit="m")
        figures = {
            factor: mems_stiction.roughness(mems_stiction.decimate(topography, factor=factor)).m0
            for factor in (2, 5)
        }
        for factor, m0 in figures.items():
            variance = np.var(mems_stiction.decimate(topography, factor=factor).heights)
            (self.assertAlmostEqual if factor == 2 else self.assertNotAlmostEqual)(
                m0 / variance, 1.0, delta=1e-6
            )

    def test_a_scan_goes_to_surface_topography_and_back(self):
        if len(topographies()) < 2:
            self.skipTest("SurfaceTopography is not installed: the stand-in serves above")
        cleaned = mems_stiction.clean(frames()["holes"], PITCH)
        back = mems_stiction.predict(cleaned.topography())
        self.assertEqual(back.pull_off_force, mems_stiction.predict(cleaned).pull_off_force)


class GeneratedTest(unittest.TestCase):
    def test_surfaces_are_those_that_the_counter_surface_is_made_of(self):
        for kind in ("gaussian", "self_affine"):
            settings = {"type": kind, "seed": 3, kind: {"rms_height": 2e-9}}
            scan = mems_stiction.generate((64, 48), PITCH, counter_surface=settings)
            self.assertEqual(scan.heights.shape, (64, 48))
            self.assertAlmostEqual(scan.heights.std() / 2e-9, 1.0, delta=1e-6)  # scaled to it
            self.assertTrue(
                np.array_equal(
                    scan.heights,
                    mems_stiction.generate((64, 48), PITCH, counter_surface=settings).heights,
                )
            )
            flat = np.zeros((64, 48))
            drawn = mems_stiction.predict(flat, PITCH, counter_surface=settings)
            given = mems_stiction.predict(flat, PITCH, upper=scan, counter_surface={"facing": "up"})
            self.assertEqual(without_times(given.to_dict()), without_times(drawn.to_dict()))

    def test_a_coarser_scan_is_the_mean_over_blocks(self):
        heights = rough(40, 51)
        coarse = mems_stiction.decimate(heights, PITCH, factor=4)
        expected = heights[:, :48].reshape(10, 4, 12, 4).mean((1, 3))
        self.assertTrue(
            np.allclose(coarse.heights, expected, rtol=0, atol=1e-22)
        )  # sums in another order
        self.assertEqual(coarse.pitch, (4 * PITCH, 4 * PITCH))
        for factor in (0, 1.5, 64):
            with self.assertRaises(mems_stiction.SurfaceError):
                mems_stiction.decimate(heights, PITCH, factor=factor)

    def test_the_spread_is_that_of_the_margin(self):
        settings = {
            "device": dict(DEVICE, contact_area=(64 * PITCH) ** 2),
            "device_force": {"enabled": False},
            "load": {"mechanical_load": 1e-6},
        }
        prediction = mems_stiction.predict(rough(64, 64, 12e-9, 2, length=12), PITCH, settings)
        spread = prediction.spread(settings)
        self.assertTrue(np.all(np.diff(spread) >= 0))
        lower, upper = 1 / np.quantile(spread, (0.975, 0.025))
        # the margin is interpolated between samples itself, this between their inverses
        self.assertAlmostEqual(
            prediction.verdict.margin_lower / prediction.verdict.margin / lower, 1.0, delta=0.02
        )
        self.assertAlmostEqual(
            prediction.verdict.margin_upper / prediction.verdict.margin / upper, 1.0, delta=0.02
        )

    def test_what_cannot_be_generated_is_named(self):
        with self.assertRaisesRegex(mems_stiction.OptionsError, "counter_surface/type"):
            mems_stiction.generate((64, 48), PITCH)
        with self.assertRaisesRegex(mems_stiction.SurfaceError, "shape"):
            mems_stiction.generate((0, 48), PITCH, counter_surface={"type": "gaussian"})


if __name__ == "__main__":
    unittest.main()
