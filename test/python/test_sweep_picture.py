"""What the picture of a sweep says: the bands, the safe voltage, the jumps with their causes, where
it comes from."""

import io
import math
import unittest
from types import SimpleNamespace
from unittest import mock

from mems_stiction import station_figures
from mems_stiction.provenance import provenance_words
from mems_stiction.station_text import safe_voltage_words, sweep_sentences
from mems_stiction.sweep_jumps import jumps_of

NAN = math.nan
ORIGIN = {
    "version": "1.2.3",
    "settings_hash": "0123456789abcdef",
    "scan_name": "wafer 3",
    "part_id": "die 12",
    "serial_id": "A-33",
}


def point(voltage, direction=0, **changes):
    values = dict(
        direction=direction,
        voltage=voltage,
        mechanical_load=0.0,
        status=0,
        is_open=False,
        pull_off_force=2e-7,
        pull_off_force_lower=1e-7,
        pull_off_force_upper=4e-7,
        is_lower_bound=False,
        contact_area_jkr=NAN,
        contact_area=1e-15 * (1 + voltage**2),
        asperity_count=4,
        margin=6.0,
        margin_lower=3.0,
        margin_upper=12.0,
        holding_margin=5.0,
        sticks=0,
    )
    values.update(changes)
    return SimpleNamespace(**values)


def sweep(points, safe=NAN, pull_in=NAN):
    summary = SimpleNamespace(
        mechanical_load=0.0,
        highest_releasing_voltage=NAN,
        highest_safe_voltage=safe,
        lowest_sticking_voltage=NAN,
        opening_voltage=NAN,
    )
    return SimpleNamespace(points=points, summaries=[summary], pull_in_voltage=pull_in, **ORIGIN)


def texts_of(result):
    """All that is written in the picture, and its bands as (lowest, highest) value of each."""
    drawn = {}

    def keep(figure, _):
        drawn["texts"] = [text.get_text() for text in figure.texts] + [
            text.get_text() for text in figure.legends[0].get_texts()
        ]
        drawn["texts"] += [text.get_text() for axes in figure.axes for text in axes.texts]
        drawn["bands"] = [
            (band.get_paths()[0].vertices[:, 1].min(), band.get_paths()[0].vertices[:, 1].max())
            for axes in figure.axes
            for band in axes.collections
            if band.get_paths() and len(band.get_paths()[0].vertices) > 4
        ]
        drawn["lines"] = [
            line.get_xdata()[0] for line in figure.axes[-1].lines if len(set(line.get_xdata())) == 1
        ]

    with mock.patch("matplotlib.figure.Figure.savefig", autospec=True, side_effect=keep):
        station_figures.save_sweep(result, io.BytesIO())
    return drawn


class JumpTest(unittest.TestCase):
    def causes(self, points, pull_in=NAN):
        return [(jump.after.voltage, jump.cause) for jump in jumps_of(points, 0.0, pull_in)]

    def test_what_grows_with_the_field_does_not_jump(self):
        self.assertEqual(self.causes([point(voltage) for voltage in range(0, 40, 2)]), [])

    def test_each_cause_has_its_words(self):
        def leap(**after):
            return [
                point(
                    v, **({} if v < 20 else dict(contact_area=1e-15 * (1 + v**2) + 4e-13, **after))
                )
                for v in range(0, 40, 2)
            ]

        self.assertEqual(self.causes(leap(asperity_count=7)), [(20, "3 new contacts snap in")])
        self.assertEqual(self.causes(leap(asperity_count=5)), [(20, "1 new contact snaps in")])
        self.assertEqual(
            self.causes(leap(asperity_count=2)), [(20, "contacts grow together, 4 to 2")]
        )
        self.assertEqual(self.causes(leap()), [(20, "the same contacts spread at once")])
        self.assertEqual(
            self.causes([point(0), point(5), point(10, status=1)]), [(10, "the surfaces bond")]
        )
        self.assertEqual(
            self.causes([point(0), point(5, status=2)]),
            [(5, "the search finds no equilibrium any more")],
        )
        self.assertEqual(
            self.causes([point(0), point(5), point(10)], 7.0),
            [(10, "pull-in at 7.00 V, the field closes the device by itself")],
        )
        down = [point(0), point(5), point(0, 1, is_open=True, contact_area=0.0)]
        self.assertEqual(
            self.causes(down),
            [(0, "the device opens, what pulls it open overcomes all that holds")],
        )

    def test_sentences_name_jumps_on_lines_that_fit_a_terminal(self):
        points = [point(0.0), point(5.0), point(10.0, status=1, pull_off_force=3.1e-7)]
        lines = sweep_sentences(sweep(points, pull_in=7.0))
        text = " ".join(" ".join(lines).split())
        self.assertIn("jump from 5.00 V to 10.0 V on the way up", text)
        self.assertIn(
            "pull-in at 7.00 V, the field closes the device by itself; the surfaces bond", text
        )
        self.assertLessEqual(max(map(len, lines)), 140)

    def test_pixels_that_meet_are_no_jump(self):
        points = [
            point(v, contact_area=1e-15 * (1 + v**2) + (2e-14 if v >= 20 else 0.0))
            for v in range(0, 40, 2)
        ]
        self.assertEqual(self.causes(points), [])


class SafeVoltageTest(unittest.TestCase):
    def test_it_is_that_of_the_verdicts(self):
        points = [point(v) for v in (0.0, 5.0, 10.0)]
        self.assertEqual(
            safe_voltage_words(sweep(points, 5.0).summaries[0], points), "safe (95 %) up to 5.00 V"
        )
        self.assertEqual(
            safe_voltage_words(sweep(points, 10.0).summaries[0], points),
            "safe (95 %) up to 10.0 V, the highest of the sweep",
        )
        doubtful = [point(v, sticks=3) for v in (0.0, 5.0, 10.0)]
        self.assertEqual(
            safe_voltage_words(sweep(doubtful).summaries[0], doubtful),
            "no voltage of the sweep is surely safe (95 %)",
        )
        later = [point(0.0, sticks=3), point(5.0), point(10.0)]
        self.assertEqual(
            safe_voltage_words(sweep(later).summaries[0], later),
            "safe (95 %) at 5.00 V to 10.0 V only",
        )


class PictureTest(unittest.TestCase):
    def test_it_shows_bands_safe_voltage_jumps_and_origin(self):
        points = [point(v) for v in (0.0, 5.0, 10.0)] + [
            point(5.0, 1),
            point(0.0, 1, is_open=True, contact_area=0.0, pull_off_force=0.0, margin=NAN),
        ]
        drawn = texts_of(sweep(points, 5.0, 7.0))
        text = "\n".join(drawn["texts"])
        for words in (
            "safe (95 %) up to 5.00 V",
            "95 % lie within",
            "Jumps:",
            "1  from 5.00 V to 10.0 V on the way up",
            "the device opens",
            "scan wafer 3, part die 12, serial number A-33, settings 0123456789abcdef, "
            "mems_stiction 1.2.3",
        ):
            self.assertIn(words, text)
        self.assertIn(5.0, drawn["lines"])
        (force_low, force_high), (low, high) = drawn["bands"]
        self.assertAlmostEqual(force_high / force_low, 4.0, delta=1e-9)  # whatever the prefix
        self.assertEqual((low, high), (3.0, 12.0))

    def test_without_a_device_the_force_has_its_band(self):
        points = [
            point(v, margin=NAN, margin_lower=NAN, margin_upper=NAN, holding_margin=NAN, sticks=3)
            for v in (0.0, 5.0, 10.0)
        ]
        drawn = texts_of(sweep(points))
        self.assertNotIn("safe", "\n".join(drawn["texts"]))
        self.assertEqual(len(drawn["bands"]), 1)

    def test_one_point_and_none_that_is_known_can_be_drawn(self):
        for points in (
            [point(0.0)],
            [point(0.0, margin=NAN, pull_off_force_lower=NAN, pull_off_force_upper=NAN)],
        ):
            self.assertIn("voltage up", texts_of(sweep(points))["texts"])


class OriginTest(unittest.TestCase):
    def test_what_is_not_known_is_left_out(self):
        self.assertEqual(
            provenance_words({"version": "1.2.3", "scan_name": "scan_7"}),
            "scan_7, mems_stiction 1.2.3",
        )
        self.assertEqual(provenance_words(SimpleNamespace()), "")


if __name__ == "__main__":
    unittest.main()
