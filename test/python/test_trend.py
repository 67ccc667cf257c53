"""The plot of a station's screen: which scan is where, what is lost, what the picture says."""

import math
import unittest
from types import SimpleNamespace

import numpy as np
from mems_stiction.control_chart import control_limits
from mems_stiction.plots import plt
from mems_stiction.trend import Trend
from mems_stiction.trend_figure import trend_picture

NAN = math.nan


def prediction(force=2e-7, sticks=3, margin=NAN, **changes):
    """As the node publishes it; without a margin neither spring nor beam is stated."""
    values = dict(
        status=0,
        pull_off_force=force,
        sticks=sticks,
        reason="the reason",
        margin=margin,
        margin_lower=0.5 * margin,
        margin_upper=2 * margin,
        device_pull_off_force=10 * force if margin == margin else NAN,
        restoring_force=10 * force * margin,
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        is_lower_bound=False,
        regime_flags=0,
        model_doubt="",
        warnings=[],
        settings_hash="00ff",
    )
    values.update(changes)
    return SimpleNamespace(**values)


def device(margin, sticks=1, **changes):
    """The force of the whole device, as the node publishes it."""
    values = dict(
        status=0,
        sticks=sticks,
        reason="of the device",
        pull_off_force=2e-6 / margin,
        apparent_work_of_adhesion=1e-4,
        restoring_force=2e-6,
        margin=margin,
        margin_lower=0.5 * margin,
        margin_upper=2 * margin,
        peel_number=NAN,
        peel_number_lower=NAN,
        peel_number_upper=NAN,
        governed_by="",
        settings_hash="00ff",
    )
    values.update(changes)
    return SimpleNamespace(**values)


def states(trend):
    return "".join(
        "p" if scan.prediction is not None else "x" if scan.is_lost else "." for scan in trend.scans
    )


class TrendTest(unittest.TestCase):
    def setUp(self):
        self.trend = Trend()

    def scans(self, *stamps):
        for stamp in stamps:
            self.trend.add_scan(stamp)

    def predictions(self, *stamps):
        for stamp in stamps:
            self.trend.add_prediction(stamp, prediction())

    def test_a_scan_is_lost_once_a_later_one_is_predicted(self):
        self.scans(1, 2, 3, 4)
        self.predictions(1, 3)
        self.assertEqual(states(self.trend), "pxp.")
        self.assertEqual([number for number, _ in self.trend.decided()], [1, 2, 3])

    def test_the_nodes_count_decides_on_the_latest_scans(self):
        self.scans(1, 2)
        self.predictions(1)
        self.trend.add_losses(1)
        self.assertEqual(states(self.trend), "px")
        self.scans(3)
        self.predictions(3)
        self.assertEqual(states(self.trend), "pxp")

    def test_a_loss_that_was_seen_is_not_counted_again(self):
        self.scans(1, 2, 3)
        self.predictions(2)
        self.trend.add_losses(1)
        self.assertEqual(states(self.trend), "xp.")

    def test_a_prediction_that_comes_after_all_counts(self):
        self.scans(1)
        self.trend.add_losses(1)  # of a scan_info without a scan
        self.assertEqual(states(self.trend), "x")
        self.predictions(1)
        self.assertEqual(states(self.trend), "p")

    def test_a_prediction_may_overtake_its_scan(self):
        self.predictions(1, 3)
        self.scans(1, 2, 3)
        self.assertEqual([scan.stamp for scan in self.trend.scans], [1, 2, 3])
        self.assertEqual(states(self.trend), "pxp")
        self.predictions(4)
        self.scans(4)
        self.assertEqual(states(self.trend), "pxpp")

    def test_the_verdict_on_the_device_takes_the_place_of_the_predictions(self):
        for stamp in (1, 2):
            self.trend.add_prediction(stamp, prediction(sticks=3))
        self.trend.judge(1, device(margin=0.5, sticks=2))
        first, second = [scan.prediction for scan in self.trend.scans]
        self.assertEqual(
            (first.margin, first.margin_lower, first.sticks, first.reason),
            (0.5, 0.25, 2, "of the device"),
        )
        self.assertEqual((first.device_pull_off_force, first.restoring_force), (4e-6, 2e-6))
        self.assertEqual(first.device_apparent_work_of_adhesion, 1e-4)
        self.assertTrue(math.isnan(second.margin))
        self.trend.judge(
            1, device(margin=2.0, sticks=0)
        )  # once more, as after another load and back
        self.assertEqual((first.margin, first.sticks), (2.0, 0))

    def test_a_verdict_without_a_force_or_under_other_settings_changes_nothing(self):
        self.trend.add_prediction(1, prediction(sticks=3))
        self.trend.judge(1, device(margin=0.5, settings_hash="11ff"))
        self.trend.judge(1, device(margin=0.5, status=2))
        self.assertEqual(self.trend.scans[0].prediction.reason, "the reason")
        self.trend.judge(7, device(margin=0.5))
        self.assertEqual(len(self.trend.scans), 1)

    def test_a_verdict_may_overtake_its_prediction(self):
        self.scans(1)
        self.trend.judge(1, device(margin=0.5, sticks=2))
        self.assertEqual(states(self.trend), ".")
        self.trend.add_prediction(1, prediction(sticks=3))
        self.assertEqual(self.trend.scans[0].prediction.sticks, 2)
        for stamp in range(1000, 2000):
            self.trend.judge(stamp, device(margin=0.5))
        self.trend.add_prediction(1000, prediction(sticks=3))  # only the newest wait
        self.trend.add_prediction(1999, prediction(sticks=3))
        self.assertEqual([scan.prediction.sticks for scan in self.trend.scans], [2, 3, 1])

    def test_of_a_replay_the_newest_scan_is_judged(self):
        for _ in range(2):
            self.trend.add_prediction(1, prediction(sticks=3))
        self.trend.judge(1, device(margin=0.5, sticks=2))
        self.assertEqual([scan.prediction.sticks for scan in self.trend.scans], [3, 2])

    def test_a_replay_of_the_same_stamps_is_a_new_series(self):
        for _ in range(2):
            self.scans(1, 2)
            self.predictions(1, 2)
        self.assertEqual(states(self.trend), "pppp")

    def test_predictions_alone_are_enough(self):
        self.predictions(1, 2)
        self.assertEqual(states(self.trend), "pp")

    def test_the_oldest_are_forgotten_and_still_counted(self):
        self.trend = Trend(most=3)
        self.scans(1, 2)
        self.predictions(2)  # so that the first is lost
        for stamp in (3, 4, 5):
            self.scans(stamp)
            self.predictions(stamp)
        self.assertEqual([scan.stamp for scan in self.trend.scans], [3, 4, 5])
        self.assertEqual([number for number, _ in self.trend.decided()], [3, 4, 5])
        self.assertEqual((self.trend.decided_count(), self.trend.lost_count()), (5, 1))
        figure = trend_picture(self.trend)
        self.addCleanup(plt.close, figure)
        said = " | ".join(text.get_text() for text in figure.texts)
        self.assertIn("5 scans, 1 not predicted, 2 older not shown", said)
        self.assertIn("Scan 5: ", said)


class ControlLimitsTest(unittest.TestCase):
    def test_limits_are_2_66_moving_ranges_about_the_mean_of_the_logarithms(self):
        values = [math.exp(x) for x in (0, 1, 0, 1, 0, 1, 0, 1)]  # mean 0.5, every moving range 1
        limits = control_limits(values)
        self.assertAlmostEqual(limits.centre, math.exp(0.5))
        self.assertAlmostEqual(math.log(limits.upper), 0.5 + 3 / 1.128)
        self.assertAlmostEqual(math.log(limits.lower), 0.5 - 3 / 1.128)

    def test_montgomerys_table_of_a_normal_process(self):
        # of independent normal values 3 sigma: one in 370 outside
        random = np.random.RandomState(3)
        values = np.exp(random.normal(1.0, 0.2, 20000))
        limits = control_limits(list(values))
        self.assertAlmostEqual(math.log(limits.upper) - 1.0, 0.6, delta=0.02)  # 1.5 % by the sample
        share = np.mean([limits.is_outside(value) for value in values])
        self.assertTrue(
            0.0015 < share < 0.0045, share
        )  # 0.0027; 54 of 20000 are known to 14 %, and the limits to 1 %

    def test_what_is_missing_is_left_out_and_few_values_have_no_limits(self):
        values = [2.0, 3.0] * 4
        self.assertIsNone(control_limits(values[:7]))
        for missing in (NAN, None, 0.0, math.inf):
            limits = control_limits(values[:4] + [missing] + values[4:])
            self.assertAlmostEqual(limits.upper, control_limits(values).upper)
            self.assertFalse(limits.is_outside(missing or 0.0))
        self.assertTrue(control_limits(values).is_outside(1e3))
        self.assertTrue(control_limits(values).is_outside(1e-3))

    def test_scans_that_are_all_the_same_are_not_outside(self):
        for value in np.random.RandomState(1).lognormal(-16.0, 3.0, 100):
            self.assertFalse(control_limits([value] * 20).is_outside(value), value)


class TrendPictureTest(unittest.TestCase):
    def picture(self, *predictions, **settings):
        """None stands for a scan without a prediction."""
        trend = Trend()
        for stamp, given in enumerate(predictions):
            trend.add_scan(stamp)
            if given is not None:
                trend.add_prediction(stamp, given)
        trend.add_losses(sum(given is None for given in predictions))
        figure = trend_picture(trend, **settings)
        self.addCleanup(plt.close, figure)
        return figure

    def texts(self, figure):
        return " | ".join(text.get_text() for text in figure.texts)

    def test_forces_are_in_newtons_and_a_lost_scan_breaks_the_line(self):
        figure = self.picture(prediction(2e-7), None, prediction(4e-7))
        (axes,) = figure.axes  # no device: no margin
        self.assertEqual(axes.get_ylabel(), "pull-off force\nof the scan [nN]")
        line = axes.lines[0]
        self.assertEqual(list(line.get_xdata()), [1, 2, 3])
        values = line.get_ydata()
        self.assertAlmostEqual(values[0], 200)
        self.assertTrue(math.isnan(values[1]))
        self.assertIn("not predicted (1)", axes.get_legend_handles_labels()[1])
        self.assertIn("3 scans, 1 not predicted", self.texts(figure))
        self.assertIn(
            "Scan 3: pull-off force 400 nN | the reason", self.texts(figure)
        )  # why there is no verdict

    def test_a_device_brings_its_restoring_force_the_margin_and_the_verdict(self):
        figure = self.picture(
            prediction(2e-7, 0, 4.0), prediction(2e-7, 1, 1.2), prediction(2e-7, 2, 0.2)
        )
        force, margin = figure.axes
        self.assertEqual(force.get_ylabel(), "pull-off force\nof the device [µN]")
        self.assertIn("restoring force of its spring", force.get_legend_handles_labels()[1])
        for shown, expected in zip(force.lines[1].get_ydata(), (8.0, 2.4, 0.4)):
            self.assertAlmostEqual(shown, expected)
        self.assertEqual(margin.get_ylabel(), "margin [-]")
        self.assertEqual(
            margin.get_legend_handles_labels()[1],
            ["95 % interval", "releases", "marginal", "sticks", "1: sticks below"],
        )
        self.assertIn("Scan 3: STICKS | the reason", self.texts(figure))

    def test_a_beam_has_its_peel_number(self):
        figure = self.picture(
            prediction(2e-7, 0, peel_number=3.0, peel_number_lower=2.0, peel_number_upper=4.0)
        )
        self.assertEqual(figure.axes[1].get_ylabel(), "peel number [-]")
        self.assertIn("Scan 1: RELEASES", self.texts(figure))

    def test_what_no_axis_can_hold_is_left_out(self):
        for changes in (
            dict(margin_upper=1e308),
            dict(margin_lower=5e-324),
            dict(restoring_force=1.7e308, device_pull_off_force=5e-324),
        ):
            figure = self.picture(prediction(2e-7, 0, 3.0), prediction(1e308, 0, 3.0, **changes))
            figure.canvas.draw()

    def test_decades_of_force_are_logarithmic_with_a_unit_at_each_step(self):
        axes = self.picture(prediction(1e-9), prediction(1e-6)).axes[0]
        self.assertEqual(
            (axes.get_yscale(), axes.get_ylabel()), ("log", "pull-off force\nof the scan [N]")
        )
        self.assertEqual(
            axes.yaxis.get_major_formatter()(0.01), "10 nN"
        )  # the axis itself counts in micronewtons

    def test_control_limits_and_what_is_outside_of_them(self):
        series = [prediction(force) for force in (2.0e-7, 2.1e-7) * 5] + [prediction(4e-7)]
        axes = self.picture(*series).axes[0]
        labels = axes.get_legend_handles_labels()[1]
        self.assertIn("control limits", labels)
        self.assertIn("outside (1)", labels)
        (ring,) = [
            collection for collection in axes.collections if collection.get_label() == "outside (1)"
        ]
        self.assertEqual([round(place) for place in ring.get_offsets()[0]], [11, 400])
        few = self.picture(*series[:7]).axes[0]
        self.assertNotIn("control limits", few.get_legend_handles_labels()[1])

    def test_other_settings_and_forces_that_do_not_count_are_no_part_of_the_limits(self):
        before = [prediction(1e-5, settings_hash="1111")] * 5
        series = [prediction(force) for force in (2.0e-7, 2.1e-7) * 5]
        lost = [prediction(5e-5, status=2)]
        wanted = control_limits([one.pull_off_force for one in series])
        axes = self.picture(*(before + series + lost)).axes[0]
        (lines,) = [
            collection
            for collection in axes.collections
            if collection.get_label() == "control limits"
        ]
        segments = lines.get_segments()
        factor = 1e6  # the axis counts in micronewtons
        for segment, value in zip(segments, (wanted.lower, wanted.upper)):
            self.assertAlmostEqual(segment[0][1], value * factor)
            self.assertEqual([segment[0][0], segment[1][0]], [5.5, 15.5])
        self.assertNotIn("outside (1)", axes.get_legend_handles_labels()[1])

    def test_flags_and_warnings_are_marked_under_their_scan(self):
        axes = self.picture(
            prediction(), prediction(regime_flags=32), prediction(warnings=["odd"])
        ).axes[0]
        (marks,) = [
            collection
            for collection in axes.collections
            if collection.get_label() == "flags or warnings (2)"
        ]
        self.assertEqual([place[0] for place in marks.get_offsets()], [2, 3])

    def test_lower_bounds_lost_scans_and_an_empty_station_say_so(self):
        self.assertIn(
            "at least 200 nN", self.texts(self.picture(prediction(2e-7, is_lower_bound=True)))
        )
        self.assertIn(
            "Scan 1: no equilibrium", self.texts(self.picture(prediction(2e-7, status=2)))
        )
        self.assertIn("Scan 2: not predicted", self.texts(self.picture(prediction(), None)))
        self.assertIn("no scan yet", self.texts(self.picture()))

    def test_the_last_scans_alone_are_shown_when_asked_for(self):
        figure = self.picture(*[prediction()] * 30, last=10)
        self.assertEqual(list(figure.axes[0].lines[0].get_xdata()), list(range(21, 31)))
        self.assertIn("20 older not shown", self.texts(figure))


if __name__ == "__main__":
    unittest.main()
