"""What people read: numbers with prefixes, table lines, the effect of a load."""

import io
import math
import pathlib
import re
import unittest
from types import SimpleNamespace

from mems_stiction.csv_text import csv_cell
from mems_stiction.prediction_text import (
    FLAGS,
    device_line,
    flag_names,
    flag_words,
    has_verdict,
    load_effect,
    table_header,
    table_line,
)
from mems_stiction.quantities import length_scale, percent, ratio, with_interval, with_unit


def prediction(**changes):
    values = dict(
        status=0,
        pull_off_force=2.3e-6,
        van_der_waals_force=0.23e-6,
        electrostatic_force=0.0,
        normal_load=1e-6,
        rms_height=9.96e-9,
        voltage=0.0,
        mechanical_load=0.0,
        contact_area=1e-14,
        contact_fraction=0.00123,
        contact_area_jkr=1e-15,
        is_lower_bound=False,
        regime_flags=0,
        warnings=[],
        elastic_count=2,
        elasto_plastic_count=3,
        plastic_count=4,
        processing_time=0.0345,
    )
    values.update(changes)
    return SimpleNamespace(**values)


class ForeignTextTest(unittest.TestCase):
    def test_no_control_character_reaches_the_terminal(self):
        line = table_line("a\x1b[2J\x9b2Jb", prediction(warnings=["c\rd"]))
        self.assertTrue(line.isprintable(), repr(line))
        self.assertIn("\\x1b[2J", line)

    def test_nor_by_anything_else_that_a_script_of_the_station_prints(self):
        try:
            from mems_stiction.station_node import Printable
        except ImportError:
            self.skipTest("no ROS")
        stream = io.StringIO()
        print("reason: a\x1b]0;b\x07\x9b2J\rc\u202ed", "e\tf", file=Printable(stream), flush=True)
        self.assertEqual(stream.getvalue(), "reason: a\\x1b]0;b\\x07\\x9b2J\\x0dc\\x202ed e\tf\n")

    def test_a_spreadsheet_takes_no_text_for_a_formula(self):
        for text in ("=1+1", "+A1", "-A1", "@sum", "\t=1"):
            self.assertEqual(csv_cell(text), "'" + text)
        for value in ("plain", "-1.5e-9", "", -2.0, None, "\u00b5m\u00a0a\tb"):
            self.assertEqual(csv_cell(value), value)

    def test_no_cell_moves_the_cursor_of_a_terminal(self):
        self.assertEqual(
            csv_cell("a\x1b]0;b\x07\x9b2J\rc\u202ed"), "a\\x1b]0;b\\x07\\x9b2J\\x0dc\\x202ed"
        )
        self.assertEqual(csv_cell("\x1b=1"), "\\x1b=1")


class QuantitiesTest(unittest.TestCase):
    def test_three_significant_digits_and_a_prefix(self):
        self.assertEqual(with_unit(1.234e-7, "N"), "123 nN")
        self.assertEqual(with_unit(1.234e-6, "N"), "1.23 uN")
        self.assertEqual(with_unit(-2e-3, "m"), "-2.00 mm")
        self.assertEqual(with_unit(0.0, "V"), "0 V")

    def test_rounding_up_changes_the_prefix(self):
        self.assertEqual(with_unit(999.6e-9, "N"), "1.00 uN")
        self.assertEqual(with_unit(99.96e-9, "N"), "100 nN")

    def test_what_is_not_finite_stays_visible(self):
        self.assertEqual(with_unit(math.inf, "N"), "inf N")
        self.assertEqual(percent(math.nan), "nan %")

    def test_what_is_known_decides_how_many_digits_are_shown(self):
        self.assertEqual(with_unit(2.58e-7, "N", 2), "260 nN")
        self.assertEqual(with_unit(9.96e-7, "N", 2), "1.0 uN")
        self.assertEqual(with_interval(2.123e-6, 1.512e-6, 2.949e-6, "N"), "2.1 uN (1.5 to 2.9)")
        self.assertEqual(with_interval(2.58e-7, 4.53e-8, 1.8e-6, "N"), "260 nN (45 to 1800)")
        self.assertEqual(with_interval(3.2456, 3.2, 3.29), "3.25 (3.2 to 3.29)")
        self.assertEqual(with_interval(3.2456, math.nan, math.nan), "3.25")
        self.assertEqual(with_interval(math.nan, math.nan, math.nan), "-")
        device = prediction(
            margin=12.34, margin_lower=6.0, margin_upper=30.0, peel_number=math.nan, sticks=0
        )
        self.assertEqual(table_line("a", device, True).split()[-2:], ["12", "no"])

    def test_ratios_do_without_exponents_up_to_a_million(self):
        self.assertEqual(
            [
                ratio(value)
                for value in (0.02994, 16.04, 1236.0, 136468.0, 2.5e6, math.inf, math.nan)
            ],
            ["0.0299", "16", "1240", "136000", "2.5e+06", "inf", "-"],
        )

    def test_percent(self):
        self.assertEqual(percent(0.1234), "12.3 %")
        self.assertEqual(percent(1.234e-5), "0.00123 %")
        self.assertEqual(percent(1.0), "100 %")

    def test_axes_are_in_nanometers_or_micrometers(self):
        self.assertEqual(length_scale(1e-6), (1e9, "nm"))
        self.assertEqual(length_scale(1e-5), (1e6, "µm"))


class PredictionTextTest(unittest.TestCase):
    def test_columns_stay_aligned(self):
        plain = table_line("a", prediction())
        bonded = table_line(
            "/a/very/long/path/to/some/scan.tiff",
            prediction(status=1, voltage=12.5, is_lower_bound=True),
        )
        self.assertEqual(len(plain), len(bonded))
        self.assertEqual(len(plain), len(table_header().splitlines()[1]))
        self.assertIn("0.123 %", plain)

    def test_a_device_adds_margin_and_verdict(self):
        device = prediction(margin=12.34, peel_number=math.nan, sticks=0)
        beam = prediction(margin=math.nan, peel_number=0.5, sticks=2)
        unstated = prediction(margin=math.nan, peel_number=math.nan, sticks=3)
        self.assertEqual(
            [has_verdict(one) for one in (device, beam, unstated)], [True, True, False]
        )
        self.assertTrue(table_line("a", device, True).endswith("      12.3  no      "))
        self.assertTrue(table_line("a", beam, True).rstrip().endswith("0.5  yes"))
        self.assertTrue(table_line("a", unstated, True).rstrip().endswith("-  unknown"))
        self.assertTrue(table_header(True).endswith("   margin  sticks"))

    def test_the_device_has_a_line_of_its_own(self):
        known = dict(
            status=0,
            message="",
            scan_count=3,
            pull_off_force=2.1234e-6,
            pull_off_force_lower=1.5e-6,
            pull_off_force_upper=3e-6,
            margin=4.71,
            margin_lower=3.3,
            margin_upper=6.7,
            peel_number=math.nan,
            sticks=0,
            verdict_by="prediction",
        )

        def line(**changes):
            return device_line("7 scan", SimpleNamespace(**dict(known, **changes)))

        self.assertEqual(
            line(),
            "7 scan              device: pull-off force 2.1 uN (1.5 to 3) by 3 scans, margin 4.7, "
            "sticks: no",
        )
        self.assertTrue(
            line(scan_count=1, verdict_by="half_space").endswith(
                " by 1 scan, margin 4.7, sticks: no, by the half-space"
            )
        )
        self.assertTrue(
            line(margin=math.nan, peel_number=0.5, sticks=2).endswith(
                " by 3 scans, peel number 0.5, sticks: yes"
            )
        )
        self.assertTrue(line(margin=math.nan).endswith(" by 3 scans"))
        self.assertEqual(
            line(status=2, message="too\x1b few"),
            "7 scan              device: no force: too\\x1b few",
        )

    def test_a_force_that_is_a_lower_bound_is_marked_so(self):
        self.assertIn(">= 2.30 uN", table_line("a", prediction(status=1, is_lower_bound=True)))

    def test_a_force_that_was_followed_is_no_lower_bound_and_has_no_shares(self):
        line = table_line("a", prediction(status=1, contact_area_jkr=math.nan))
        self.assertIn(" 2.30 uN", line)
        self.assertNotIn(">=", line)
        self.assertNotIn("nan", line)

    def test_flags_and_warnings_stand_at_the_end_of_a_line_without_a_device_too(self):
        line = table_line("a", prediction(regime_flags=32 + 256, warnings=["rows jump"]))
        self.assertTrue(line.endswith("  few_contacts, one_pixel, warning: rows jump"), line)
        self.assertEqual(flag_words(flag_names(0)), "")
        self.assertIn("contacts of one pixel", flag_words(flag_names(256)))
        self.assertIn("1.3 (it tears); ", flag_words(flag_names(64 + 256), "it tears"))
        self.assertEqual(flag_words(["newer"]), "newer")

    def test_the_flags_are_those_of_the_message(self):
        source = (
            pathlib.Path(__file__).resolve().parents[2] / "msg/StictionPrediction.msg"
        ).read_text(encoding="utf-8")
        of_message = {
            int(value): name.lower()
            for name, value in re.findall(r"uint32 FLAG_(\w+) = (\d+)", source)
        }
        self.assertEqual({bit: name for bit, (name, _) in FLAGS.items()}, of_message)

    def test_load_effect_says_what_grew(self):
        text = "\n".join(
            load_effect(
                prediction(),
                prediction(voltage=5.0, electrostatic_force=1e-6, contact_area=2e-14, status=1),
            )
        )
        self.assertIn("Electrostatic force 1.00 uN, before 0 N", text)
        self.assertIn("contact area grows", text)
        self.assertIn("pull-off force stays", text)
        self.assertIn("from equilibrium to bonded", text)


if __name__ == "__main__":
    unittest.main()
