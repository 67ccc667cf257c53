#!/usr/bin/env python3
"""A series that drifts raises an alarm on its topic and in /diagnostics; one that does not,
none."""

import math
import unittest

import numpy as np
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from mems_stiction.msg import Drift, StictionPrediction
from std_srvs.srv import Trigger
from stiction_client import Collector, wait_until

BASELINE = 20


class DriftTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("drift_test")
        cls.statuses = {}
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls._on_diagnostics, queue_size=100)
        cls.drifts, cls.of_margin = (
            Collector("drift", Drift).connect(),
            Collector("margin_drift", Drift).connect(),
        )
        cls.predictions = rospy.Publisher("prediction", StictionPrediction, queue_size=1000)
        wait_until(
            lambda: cls.predictions.get_num_connections() == 2, "two listeners to predictions"
        )
        cls.sent = 0

    @classmethod
    def _on_diagnostics(cls, message):
        for status in message.status:
            cls.statuses[status.name] = status

    def send(self, force, settings="a", margin=2.0, **fields):
        """What each node says of it."""
        message = StictionPrediction(
            pull_off_force=force, margin=margin, settings_hash=settings, **fields
        )
        message.header.stamp = rospy.Time(1 + self.sent)
        type(self).sent += 1
        count = len(self.drifts.messages)
        self.predictions.publish(message)
        return self.drifts.wait(count + 1)[-1]

    def series(self, seed, drift, count, **fields):
        """Forces that grow by a factor for each scan."""
        random = np.random.RandomState(seed)
        return [
            self.send(1e-7 * math.exp(drift * place + 0.1 * random.standard_normal()), **fields)
            for place in range(count)
        ]

    def level(self, name="watch_drift: drift"):
        return self.statuses[name].level if name in self.statuses else None

    def test_1_a_steady_series_is_none(self):
        found = self.series(3, 0.0, BASELINE + 20)
        self.assertEqual([message.count for message in found], list(range(1, BASELINE + 21)))
        self.assertTrue(math.isnan(found[BASELINE - 1].centre))
        self.assertRegex(
            found[4].message,
            "^baseline of pull-off force: 5 of 20 scans$|^baseline of pull off force: 5 of 20 "
            "scans$",
        )
        self.assertFalse(any(message.is_alarm for message in found))
        newest = found[-1]
        self.assertTrue(
            newest.lower
            < newest.average_lower
            < newest.centre
            < newest.average_upper
            < newest.upper
        )
        self.assertAlmostEqual(newest.centre / 1e-7, 1.0, delta=0.1)
        wait_until(
            lambda: (
                "watch_drift: drift" in self.statuses
                and self.statuses["watch_drift: drift"].message == newest.message
            ),
            "the status",
        )
        self.assertEqual(self.level(), DiagnosticStatus.OK)

    def test_2_a_slow_drift_raises_an_alarm_before_any_scan_is_outside(self):
        found = self.series(4, 0.02, 20)
        alarms = [message for message in found if message.is_alarm]
        self.assertTrue(alarms)
        self.assertEqual(alarms[0].broken_rules[0], "average")
        self.assertNotIn("outside", alarms[0].broken_rules)
        self.assertGreater(alarms[0].average, alarms[0].average_upper)
        self.assertLess(alarms[0].value, alarms[0].upper)
        self.assertIn(
            "is high: the average of the newest scans is beyond its limits", alarms[0].message
        )
        self.assertTrue(found[-1].is_alarm)
        wait_until(lambda: self.level() == DiagnosticStatus.WARN, "the warning")
        values = {entry.key: entry.value for entry in self.statuses["watch_drift: drift"].values}
        self.assertEqual(values["figure"], "pull_off_force")
        self.assertIn("average", values["broken_rules"].split())

    def test_3_a_late_listener_gets_the_newest(self):
        self.assertTrue(Collector("drift", Drift).connect().wait(1)[0].is_alarm)

    def test_4_what_cannot_be_used_is_passed_over(self):
        count = self.drifts.messages[-1].count
        for message in (
            StictionPrediction(
                pull_off_force=1e-9, settings_hash="a", status=StictionPrediction.NO_EQUILIBRIUM
            ),
            StictionPrediction(pull_off_force=math.nan, settings_hash="a"),
            StictionPrediction(pull_off_force=0.0, settings_hash="a"),
        ):
            self.predictions.publish(message)
        self.assertEqual(self.send(1e-7).count, count + 1)

    def test_5_other_settings_and_a_reset_begin_a_baseline(self):
        self.assertEqual(self.send(1e-7, settings="b").count, 1)
        wait_until(lambda: self.level() == DiagnosticStatus.OK, "the end of the warning")
        self.send(1e-7, settings="b")
        count = len(self.drifts.messages)
        answer = rospy.ServiceProxy("/watch_drift/reset", Trigger)()
        self.assertEqual(
            (answer.success, answer.message), (True, "the next 20 scans are the baseline")
        )
        anew = "baseline of pull-off force: 0 of 20 scans"
        self.assertEqual(self.drifts.wait(count + 1)[-1].message, anew)
        (latched,) = (
            Collector("drift", Drift).connect().wait(1)
        )  # whoever joins late hears of no alarm of before
        self.assertEqual(
            (latched.message, latched.count, latched.is_alarm, latched.settings_hash),
            (anew, 0, False, "b"),
        )
        wait_until(lambda: self.statuses["watch_drift: drift"].message == anew, "the status")
        self.assertEqual(self.send(1e-7, settings="b").count, 1)

    def test_6_another_figure_and_other_alarms(self):
        margins = [2.0, 2.2, 1.9, 2.1, 2.0, 2.15, 1.95, 2.05] + [
            1.92 - 0.001 * (place % 2) for place in range(9)
        ]
        for margin in margins:
            self.send(1e-7, settings="c", margin=margin)
        found = []

        def has_all():
            found[:] = [
                message for message in self.of_margin.messages if message.settings_hash == "c"
            ]
            return len(found) == len(margins)

        wait_until(has_all, "what is said of the margins")
        self.assertEqual([message.figure for message in found], ["margin"] * len(margins))
        self.assertEqual(
            [message.is_alarm for message in found], [False] * (len(margins) - 1) + [True]
        )
        self.assertIn("nine_on_one_side", found[-1].broken_rules)
        self.assertIn("margin is low: ", found[-1].message)
        wait_until(
            lambda: self.level("watch_margin: drift") == DiagnosticStatus.WARN, "the warning"
        )


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "drift", DriftTest)
