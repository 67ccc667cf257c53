"""Pictures for a station's screen: curves of prediction and half-space, both contact maps."""

import math
import unittest
from types import SimpleNamespace

import numpy as np
from matplotlib.colors import to_rgb
from mems_stiction.plots import REGIMES
from mems_stiction.screen_pictures import (
    APART,
    MOST_CELLS,
    contact_maps_picture,
    force_curve_picture,
    half_space_curve_picture,
    map_colours,
    nothing_yet,
    pixels_of,
)

LOADS = dict(mechanical_load=1e-6, voltage=0.0)
Z0 = 2e-10


def force(height):
    x = Z0 / height
    return 2e-7 * x * x * (3.0 - 2.0 * x)


HEIGHTS = np.linspace(1.5e-10, 1e-9, 60)


def prediction(**changes):
    values = dict(
        LOADS,
        formulation="separation_curve",
        pull_off_force=2.02e-7,
        apparent_work_of_adhesion=1e-3,
        contact_fraction=0.01,
        asperity_count=3,
        regime_flags=0,
        model_doubt="",
        curve=[
            SimpleNamespace(displacement=Z0 - height, force=force(height), is_separation=is_out)
            for is_out, heights in ((False, HEIGHTS[::-1]), (True, HEIGHTS))
            for height in heights
        ],
    )
    values.update(changes)
    return SimpleNamespace(**values)


def solution(**changes):
    values = dict(
        LOADS,
        status=0,
        message="",
        range=Z0,
        pull_off_force=2.1e-7,
        apparent_work_of_adhesion=1e-3,
        contact_fraction=0.01,
        contact_count=1,
        is_resolved=True,
        curve=[
            SimpleNamespace(height=height, force=force(height), direction=direction)
            for direction, heights in ((0, HEIGHTS[::-1]), (1, HEIGHTS))
            for height in heights
        ],
    )
    values.update(changes)
    return SimpleNamespace(**values)


def texts_of(figure):
    found = [text.get_text() for text in figure.texts]
    for axes in figure.axes:
        found += [axes.get_title(), axes.get_xlabel()] + [text.get_text() for text in axes.texts]
        legend = axes.get_legend()
        found += [text.get_text() for text in legend.get_texts()] if legend else []
    return "\n".join(found)


class CurvesTest(unittest.TestCase):
    def drawn(self, figure):
        """{label: heights less z0 [pm], forces} of the lines with a name."""
        lines = figure.axes[0].get_lines() if figure.axes else []
        return {
            line.get_label(): line.get_xydata()
            for line in lines
            if not line.get_label().startswith("_")
        }

    def test_the_prediction_has_both_ways_and_its_stated_force(self):
        figure = force_curve_picture(prediction())
        lines = self.drawn(figure)
        for way in ("approach", "retraction"):
            heights, _ = lines[way].T
            self.assertAlmostEqual(np.nanmin(heights) * 1e-12, HEIGHTS[0] - Z0, delta=1e-13)
            self.assertAlmostEqual(np.nanmax(heights) * 1e-12, HEIGHTS[-1] - Z0, delta=1e-13)
        self.assertIn(
            "pull-off 202 nN, apparent work 1.00 mJ/m^2, 1 % in 3 contacts", texts_of(figure)
        )
        self.assertEqual(pixels_of(figure).shape, (600, 1000, 3))

    def test_a_way_out_that_is_the_way_in_is_drawn_too(self):
        points = prediction().curve[: len(HEIGHTS)]
        lines = self.drawn(force_curve_picture(prediction(curve=points)))
        self.assertEqual(
            sorted(map(tuple, lines["approach"])), sorted(map(tuple, lines["retraction"]))
        )

    def test_flags_are_named(self):
        text = texts_of(force_curve_picture(prediction(regime_flags=32)))
        self.assertIn("few contacts", text)

    def test_a_formulation_without_a_curve_says_so(self):
        figure = force_curve_picture(prediction(formulation="paper", curve=[]))
        self.assertEqual(figure.axes, [])
        self.assertIn("formulation paper does not follow", texts_of(figure))

    def test_the_prediction_lies_under_the_half_space_at_the_same_heights(self):
        self.assertNotIn(
            "separation_curve, approach", self.drawn(half_space_curve_picture(solution()))
        )
        lines = self.drawn(half_space_curve_picture(solution(), prediction()))
        for way in ("approach", "retraction"):
            np.testing.assert_allclose(
                lines["half-space, " + way], lines["separation_curve, " + way], rtol=1e-9, atol=1e-9
            )

    def test_what_was_not_solved_says_why(self):
        nothing = dict(status=5, message="no valid pixel", pull_off_force=math.nan, curve=[])
        figure = half_space_curve_picture(solution(**nothing))
        self.assertEqual(figure.axes, [])
        self.assertIn("no valid pixel", texts_of(figure))
        self.assertIn(
            "pixels are too coarse", texts_of(half_space_curve_picture(solution(is_resolved=False)))
        )

    def test_names_of_any_length_are_drawn(self):
        long = {name: 1000 * "W" for name in ("scan_name", "part_id", "serial_id", "lot_id")}
        pixels_of(force_curve_picture(prediction(**long)))

    def test_all_say_where_they_come_from(self):
        origin = dict(scan_name="wafer 3", version="1.2.3")
        for figure in (
            force_curve_picture(prediction(**origin)),
            half_space_curve_picture(solution(**origin)),
            contact_maps_picture(solution(**origin)),
        ):
            self.assertIn("scan wafer 3, mems_stiction 1.2.3", texts_of(figure))


class MapsTest(unittest.TestCase):
    def test_both_stand_side_by_side(self):
        model, half_space = np.zeros((40, 80), np.uint8), np.zeros((40, 80), np.uint8)
        model[:, :20], half_space[:, :40] = 2, 1
        figure = contact_maps_picture(solution(), model, half_space)
        left, right = (axes.get_images()[0].get_array() for axes in figure.axes)
        colours = [to_rgb(APART)] + [to_rgb(colour) for _, _, colour in REGIMES]
        self.assertEqual((left == colours[2]).all(axis=2).sum(), 40 * 20)
        self.assertEqual((right == colours[1]).all(axis=2).sum(), 40 * 40)
        self.assertIn("prediction: 800 pixels in contact", texts_of(figure))

    def test_a_map_that_is_missing_says_so(self):
        text = texts_of(contact_maps_picture(solution(), None, None))
        self.assertIn("comes with the next scan", text)
        self.assertIn("no state at rest", text)

    def test_a_contact_of_one_pixel_of_a_large_scan_is_seen(self):
        cells = np.zeros((2048, 2047), np.uint8)
        cells[1023, 701] = 3
        colours = map_colours(cells)
        self.assertLessEqual(max(colours.shape), MOST_CELLS)
        self.assertEqual((colours == to_rgb(REGIMES[2][2])).all(axis=2).sum(), 1)

    def test_nothing_yet_is_dark(self):
        pixels = pixels_of(nothing_yet("preview: none yet"))
        self.assertLess(np.median(pixels), 64)
        self.assertGreater(pixels.max(), 128)  # its words


if __name__ == "__main__":
    unittest.main()
