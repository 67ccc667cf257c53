"""A chart of a series: steady ones are called as seldom as said, drifts are found, each rule by its
own run."""

import math
import unittest

import numpy as np

from mems_stiction.drift import ALARMS, BASELINE, RULES, DriftChart

QUIET = [1.0, 1.1, 0.95, 1.05, 0.9, 1.0, 1.1, 0.95, 1.05, 0.9]  # a baseline of ten


def after(values, baseline=QUIET, alarms=ALARMS):
    """States of values that follow the baseline."""
    chart = DriftChart(len(baseline), alarms)
    for value in baseline:
        chart.add(value)
    return [chart.add(value) for value in values]


class SeriesTest(unittest.TestCase):
    def test_of_steady_series_some_twelve_in_a_hundred_are_called(self):
        called = 0
        for seed in range(200):
            values = np.exp(0.2 * np.random.RandomState(seed).standard_normal(BASELINE + 100))
            chart = DriftChart()
            called += any(chart.add(value).is_alarm for value in values)
        self.assertGreaterEqual(called, 10)
        self.assertLessEqual(called, 40)

    def test_a_slow_drift_is_found_on_its_side(self):
        for slope in (0.1, -0.1):
            found = []
            for seed in range(50):
                random = np.random.RandomState(seed)
                states = after(
                    np.exp(0.2 * (slope * np.arange(60) + random.standard_normal(60))),
                    np.exp(0.2 * random.standard_normal(BASELINE)),
                )
                found.append(
                    next(place for place, state in enumerate(states) if "average" in state.broken)
                )
                self.assertTrue(states[-1].is_alarm)
                self.assertEqual(states[-1].rises, slope > 0)
            self.assertLess(np.median(found), 25)

    def test_the_baseline_judges_nothing_and_then_stays(self):
        chart = DriftChart(10)
        states = [chart.add(value) for value in QUIET]
        self.assertTrue(all(math.isnan(state.centre) and not state.broken for state in states))
        self.assertEqual(
            states[3].words("pull-off force"), "baseline of pull-off force: 4 of 10 scans"
        )
        first = chart.add(1.0)
        for value in (1.5, 2.0, 3.0):
            state = chart.add(value)
        self.assertEqual(
            (state.centre, state.lower, state.upper), (first.centre, first.lower, first.upper)
        )
        self.assertEqual(state.count, 14)

    def test_what_is_no_value_is_passed_over(self):
        chart = DriftChart(8)
        self.assertEqual(
            [chart.add(value) for value in (0.0, -1.0, math.nan, math.inf)], [None] * 4
        )
        self.assertEqual(chart.add(1.0).count, 1)

    def test_a_baseline_of_equal_values_lets_equal_ones_pass(self):
        states = after([2.0] * 20 + [2.1], [2.0] * 8)
        self.assertFalse(any(state.is_alarm for state in states[:20]))
        self.assertTrue(states[20].is_alarm)

    def test_a_baseline_is_not_too_short(self):
        with self.assertRaisesRegex(ValueError, "baseline: 7"):
            DriftChart(7)


class RulesTest(unittest.TestCase):
    """Sigma of QUIET's logarithms is 0.113, its centre 0.998."""

    CENTRE = math.exp(np.mean(np.log(QUIET)))
    SIGMA = np.abs(np.diff(np.log(QUIET))).mean() / 1.128

    def broken(self, deviations):
        return [
            set(state.broken)
            for state in after(self.CENTRE * np.exp(self.SIGMA * np.array(deviations)))
        ]

    def test_runs(self):
        for name, run in (
            ("two_of_three", [2.2, 0.1, 2.2]),
            ("four_of_five", [1.2, 1.3, -0.1, 1.2, 1.1]),
            ("nine_on_one_side", [0.3, 0.1] * 4 + [0.2]),
            ("six_in_a_row", [-1.0, -0.6, -0.3, 0.1, 0.4, 0.7]),
        ):
            for sign in (1.0, -1.0):
                broken = self.broken([sign * value for value in run])
                self.assertEqual(
                    [place for place, names in enumerate(broken) if name in names],
                    [len(run) - 1],
                    name,
                )
        self.assertEqual(self.broken([2.2, 0.1, 0.1, 2.2])[-1], set())
        self.assertNotIn("four_of_five", self.broken([1.2, 1.3, 1.2, 1.1, -0.1])[-1])

    def test_one_scan_far_out(self):
        states = after([self.CENTRE * math.exp(-8.0 * self.SIGMA)])
        self.assertIn("outside", states[0].broken)
        self.assertRegex(
            states[0].words("margin"), "^margin is low: .*the scan is beyond the control limits$"
        )

    def test_signs_are_told_without_an_alarm_unless_asked_for(self):
        run = list(self.CENTRE * np.exp(self.SIGMA * np.array([-1.0, -0.6, -0.3, 0.1, 0.4, 0.7])))
        state = after(run)[-1]
        self.assertFalse(state.is_alarm)
        self.assertEqual(
            state.words("margin"),
            "no drift of margin in 16 scans, but a sign: " + RULES["six_in_a_row"],
        )
        asked = after(run, alarms=("six_in_a_row",))[-1]
        self.assertTrue(asked.is_alarm and asked.rises)
        self.assertEqual(asked.words("margin"), "margin is high: " + RULES["six_in_a_row"])


if __name__ == "__main__":
    unittest.main()
