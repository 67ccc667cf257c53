"""Sweeps and cycles in words, and what the command lines read."""

import math
import unittest
from types import SimpleNamespace

from mems_stiction.long_run import NoNumbers, numbers, spread
from mems_stiction.station_text import (
    cycle_header,
    cycle_line,
    cycle_sentences,
    sweep_header,
    sweep_line,
    sweep_sentences,
    widest_gap,
)

NAN = math.nan


def point(voltage, direction=0, **changes):
    values = dict(
        direction=direction,
        voltage=voltage,
        mechanical_load=1e-6,
        status=0,
        is_open=False,
        pull_off_force=2e-7,
        electrostatic_force=3e-6,
        contact_fraction=1e-4,
        is_lower_bound=False,
        contact_area_jkr=2e-15,
        contact_area=4e-15,
        margin=12.0,
        margin_lower=6.0,
        holding_margin=0.5,
        sticks=0,
    )
    values.update(changes)
    return SimpleNamespace(**values)


PEELED = dict(
    is_peeled=True,
    peel_number=15.0,
    peel_number_lower=5.0,
    peel_number_upper=40.0,
    margin=2.0,
    lands=1,
)


def summary(**changes):
    values = dict(
        mechanical_load=1e-6,
        highest_releasing_voltage=20.0,
        highest_safe_voltage=NAN,
        lowest_sticking_voltage=30.0,
        opening_voltage=NAN,
    )
    values.update(changes)
    return SimpleNamespace(**values)


def cycle(number, **changes):
    values = dict(
        cycle=number,
        status=0,
        pull_off_force=1e-7 * number,
        contact_fraction=1e-4,
        is_lower_bound=False,
        contact_area_jkr=2e-15,
        asperity_count=3,
        plastic_count=1,
        rms_height=5e-9,
        largest_change=1e-10,
        sticks=0,
        margin=4.0 / number,
    )
    values.update(changes)
    return SimpleNamespace(**values)


class ArgumentsTest(unittest.TestCase):
    def test_numbers_are_a_list_or_a_range_with_its_end(self):
        self.assertEqual(numbers("0,5,1e1"), [0.0, 5.0, 10.0])
        self.assertEqual(numbers("0:30:10"), [0.0, 10.0, 20.0, 30.0])
        self.assertEqual(len(numbers("0:1:0.1")), 11)  # 0.1 has no exact form
        self.assertEqual(numbers("0:25:10"), [0.0, 10.0, 20.0])
        for wrong in (
            "0:30",
            "0:30:0",
            "a,b",
            "",
            "10:0:5",
            "0:nan:5",
            "inf",
            "0:30:1e-9",
            "0,05",
            "1:2:3:4",
            "0,1e-400",
        ):
            self.assertRaises(ValueError, numbers, wrong)
        self.assertEqual(numbers("0e-400,-0.0"), [0.0, 0.0])
        with self.assertRaisesRegex(NoNumbers, "the decimal sign is a point"):
            numbers("0,05")

    def test_long_tables_keep_both_ends(self):
        self.assertEqual(spread([1, 2, 3], 3), [1, 2, 3])
        self.assertEqual(spread(list(range(101)), 3), [0, 50, 100])


class SweepTextTest(unittest.TestCase):
    def test_columns_stand_below_their_names(self):
        header = sweep_header().splitlines()[1]
        for line in (
            sweep_line(point(20.0)),
            sweep_line(point(0.0, status=1, margin=NAN, sticks=3)),
            sweep_line(point(5.0, **PEELED)),
        ):
            self.assertEqual(line.index(line.split()[-1]), header.index("sticks"), line)
        self.assertIn(">= 200 nN", sweep_line(point(0.0, status=1, is_lower_bound=True)))
        for sticks, word in ((0, "no"), (1, "marginal")):
            words = sweep_line(point(0.0, 1, is_open=True, sticks=sticks)).split()
            self.assertEqual((words[6], words[-1]), ("open", word))

    def test_what_is_not_among_the_voltages_is_said(self):
        points = [
            point(0.0, sticks=1),
            point(20.0, contact_area_jkr=9e-15, sticks=1),
            point(0.0, 1, contact_area_jkr=8e-15),
        ]
        text = "\n".join(
            sweep_sentences(
                SimpleNamespace(points=points, summaries=[summary()], pull_in_voltage=NAN)
            )
        )
        self.assertIn("  margin at least 1 after voltages up to: 20.0 V", text)
        self.assertIn("surely (95 %) releases after voltages up to: none of the sweep", text)
        self.assertIn("the margin is below 1: 30.0 V", text)
        self.assertIn("  sticks, after voltages of: marginal 0 V to 20.0 V", text)
        self.assertIn("opens on the way down at: none of the sweep", text)
        self.assertIn(
            "hysteresis, widest at 0 V: JKR contact area 2000 nm^2 on the way up, 8000 nm^2 on the "
            "way down",
            text,
        )
        self.assertIn("Pull-in voltage: not stated", text)

    def test_what_surely_releases_is_what_the_rows_say(self):
        def text(verdicts, safe):
            points = [
                point(20.0 * place, sticks=sticks) for place, sticks in enumerate(verdicts)
            ] + [point(0.0, 1, sticks=0)]
            return "\n".join(
                sweep_sentences(
                    SimpleNamespace(
                        points=points,
                        summaries=[summary(highest_safe_voltage=safe)],
                        pull_in_voltage=NAN,
                    )
                )
            )

        unknown_below = text([3, 3, 3, 3, 3, 0], NAN)
        self.assertIn("surely (95 %) releases after voltages of: 100 V only", unknown_below)
        self.assertIn("  sticks, after voltages of: unknown 0 V to 80.0 V; no 100 V", unknown_below)
        self.assertIn(
            "surely (95 %) releases after voltages of: 20.0 V to 60.0 V only",
            text([1, 0, 0, 0], NAN),
        )
        self.assertIn(
            "surely (95 %) releases after voltages up to: 20.0 V", text([0, 0, 1, 0], 20.0)
        )
        self.assertIn(
            "  sticks, after voltages of: no 0 V to 20.0 V; marginal 40.0 V; no 60.0 V",
            text([0, 0, 1, 0], 20.0),
        )
        self.assertIn(
            "surely (95 %) releases after voltages up to: none of the sweep", text([3, 1, 2], NAN)
        )

    def test_a_formulation_without_jkr_contacts_shows_the_area_itself(self):
        points = [
            point(0.0, contact_area_jkr=NAN, status=1),
            point(20.0, contact_area_jkr=NAN, contact_area=9e-15),
            point(0.0, 1, contact_area_jkr=NAN, contact_area=8e-15),
        ]
        line = sweep_line(points[0])
        self.assertIn("4000 nm^2", line)
        self.assertNotIn(">=", line)
        text = "\n".join(
            sweep_sentences(
                SimpleNamespace(points=points, summaries=[summary()], pull_in_voltage=NAN)
            )
        )
        self.assertIn(
            "widest at 0 V: contact area 4000 nm^2 on the way up, 8000 nm^2 on the way down", text
        )
        self.assertNotIn("nan", text + line)

    def test_a_beam_has_its_peel_number_and_its_landing(self):
        points = [
            point(0.0, **dict(PEELED, lands=0)),
            point(20.0, **PEELED),
            point(0.0, 1, is_open=True, lands=0),
        ]
        self.assertEqual([sweep_line(one).split()[5] for one in points], ["no", "yes", "no"])
        self.assertIn("  peel 15  ", sweep_line(points[0]))
        text = "\n".join(
            sweep_sentences(
                SimpleNamespace(points=points, summaries=[summary()], pull_in_voltage=14.6)
            )
        )
        self.assertIn("  first voltage that closes it by itself: 20.0 V", text)
        self.assertIn("Peel: the peel number of a beam that is peeled", text)
        self.assertNotIn("There is no margin", text)
        of_work = [point(0.0, margin=NAN, peel_number=15.0)]
        self.assertNotIn(
            "There is no margin",
            "\n".join(
                sweep_sentences(
                    SimpleNamespace(points=of_work, summaries=[summary()], pull_in_voltage=NAN)
                )
            ),
        )
        nothing = [point(0.0, margin=NAN, peel_number=NAN)]
        self.assertIn(
            "There is no margin: it needs device/spring_stiffness, travel and contact_area, or a "
            "beam.",
            sweep_sentences(SimpleNamespace(points=nothing, summaries=[], pull_in_voltage=NAN)),
        )
        why = "the scan does not show what holds"
        judged = SimpleNamespace(
            points=nothing, summaries=[], pull_in_voltage=NAN, why_no_margin=why
        )
        said = "There is no margin: %s." % why
        self.assertIn(said, sweep_sentences(judged))
        judged.why_no_margin = ""
        self.assertIn(said, sweep_sentences(judged, why=why))

    def test_no_difference_is_no_hysteresis(self):
        self.assertIsNone(widest_gap([point(0.0), point(20.0), point(0.0, 1)], 1e-6))
        self.assertIsNone(widest_gap([point(0.0)], 1e-6))


class CycleTextTest(unittest.TestCase):
    def test_columns_stand_below_their_names(self):
        header = cycle_header().splitlines()[1]
        line = cycle_line(cycle(2))
        self.assertEqual(line.index("no"), header.index("sticks"))

    def test_growth_rest_and_failure_are_said(self):
        result = SimpleNamespace(
            cycles=[cycle(1), cycle(2, sticks=2), cycle(3, sticks=2, largest_change=0.0)],
            first_sticking_cycle=2,
        )
        text = "\n".join(cycle_sentences(result))
        self.assertIn("from 100 nN to 300 nN (+200 %)", text)
        self.assertIn("From contact 3 on nothing flows any more.", text)
        self.assertIn("from contact 2 on it sticks", text)
        result.cycles[2].sticks = 1
        self.assertIn(
            "it sticks after contact 2, but not surely after each later one",
            "\n".join(cycle_sentences(result)),
        )
        result.cycles[2].sticks, result.cycles[2].margin = (
            3,
            NAN,
        )  # an ended search: the device is stated all the same
        self.assertIn(
            "it sticks after contact 2, but not surely", "\n".join(cycle_sentences(result))
        )
        result.cycles[2].sticks, result.cycles[2].margin = 2, 4.0 / 3
        result.cycles[2].pull_off_force = result.cycles[0].pull_off_force * (1 + 1e-15)
        self.assertIn("the pull-off force stays at 100 nN", cycle_sentences(result)[0])
        result.first_sticking_cycle = 0
        self.assertIn("the lowest margin is 1.33", "\n".join(cycle_sentences(result)))
        self.assertIn(
            "Whether the device releases: it is not known after 2 of these contacts, first after "
            "contact 2",
            cycle_sentences(result)[-1],
        )
        for one in result.cycles:
            one.sticks = 1
        self.assertIn(
            "Whether the device releases: it is marginal after any of these contacts",
            cycle_sentences(result)[-1],
        )
        for one in result.cycles:
            one.sticks = 0
        self.assertEqual(
            "The device releases after each of these contacts; the lowest margin is 1.33.",
            cycle_sentences(result)[-1],
        )
        for one in result.cycles:
            one.__dict__.update(PEELED)
        self.assertEqual(
            "The device releases after each of these contacts; the lowest peel number is 15 (5 to "
            "40).",
            cycle_sentences(result)[-1],
        )
        for one in result.cycles:
            one.margin, one.is_peeled, one.peel_number = NAN, False, NAN
        self.assertIn(
            "There is no margin: it needs device/spring_stiffness",
            "\n".join(cycle_sentences(result)),
        )


if __name__ == "__main__":
    unittest.main()
