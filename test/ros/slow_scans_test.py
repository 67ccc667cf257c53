#!/usr/bin/env python3
"""A scan that takes too long is given up with a sentence, and whoever asks meanwhile is served
after it, before the scans that wait."""

import pathlib
import time
import unittest

import actionlib
import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticStatus
from mems_stiction.msg import (
    HalfSpaceAction,
    HalfSpaceGoal,
    StictionPrediction,
    SweepLoadAction,
    SweepLoadGoal,
)
from mems_stiction.srv import Predict, SetLoad
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    Station,
    image_message,
    info_message,
    predict_scan,
    process_of,
    rough_surface,
    settings_of,
    thread_seconds,
    unlike,
    wait_until,
)

LOAD = 1e-6
LIMIT = 5.0  # of the launch file [s]
SETTINGS = settings_of(
    pathlib.Path(__file__).with_name("device_station.yaml"),
    approach={"formulation": "paper", "max_steps": 10000000},
    paper={"step": 1e-21},
    half_space={"step": 0.01, "max_states": 1000000},
    limits={"max_time": LIMIT},
)
REASON = "the scan was given up after 5 s (limits/max_time)"


class SlowScansTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("slow_scans_test")
        rospy.wait_for_service("stiction_node/set_load", timeout=TIMEOUT)
        cls.counts = Counts()
        cls.set_load = rospy.ServiceProxy("stiction_node/set_load", SetLoad)
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()
        # The rough one takes many times LIMIT: as many steps as there may be, on many pixels.
        cls.flat, cls.rough = (
            np.zeros((48, 64), np.float32),
            np.random.RandomState(1).normal(0.0, 2e-9, (1024, 1024)).astype(np.float32),
        )
        cls.counts.wait(received=0)

    def assert_next_is_predicted(self, load=LOAD):
        count = len(self.predictions.messages)
        stamp = self.station.send(self.flat)
        prediction = self.predictions.wait(count + 1)[count]
        self.assertEqual(prediction.header.stamp, stamp)
        self.assertEqual(unlike(prediction, predict_scan(self.flat, load, settings=SETTINGS)), [])
        self.assertTrue(
            any(
                text.startswith("paper/step 1e-21 m is outside the usual")
                for text in prediction.warnings
            )
        )

    def while_a_scan_is_at_hand(self):
        """Sends one that takes LIMIT and returns when it has certainly begun, which is so late [s
        of monotonic()]."""
        begun = time.monotonic()
        self.station.send(self.rough)
        self.counts.wait(received=self.station.count(), waiting=1, waiting_for_worker=0)
        return begun

    def test_1_it_is_counted_with_its_reason_and_the_next_one_is_predicted(self):
        self.assert_next_is_predicted()
        for rejected in (1, 2):
            stamp = self.station.send(self.rough)
            self.assert_next_is_predicted()
            self.counts.wait(
                received=1 + 2 * rejected,
                predicted=1 + rejected,
                rejected=rejected,
                dropped=0,
                waiting=0,
            )
            self.assertIn(
                "rejected the scan of stamp %d.000000000: %s" % (stamp.secs, REASON),
                self.counts["last_reason"],
            )
        self.assertTrue(any(REASON in reason for reason in self.counts.reasons()))
        wait_until(lambda: self.counts.level() == DiagnosticStatus.OK, "the end of the warning")

    def test_2_calls_get_the_same_sentence_and_leave_the_last_scan_alone(self):
        self.assert_next_is_predicted()
        last = self.predictions.messages[-1].header.stamp
        answer = rospy.ServiceProxy("stiction_node/predict", Predict)(
            image_message(self.rough, rospy.Time(7)), info_message(rospy.Time(7)), 0.0, LOAD
        )
        self.assertFalse(answer.success)
        self.assertIn(REASON, answer.message)
        rejected = int(self.counts.fresh()["rejected"])
        self.station.send(self.rough)
        wait_until(lambda: int(self.counts["rejected"]) > rejected, "the end of the scan")
        answer = self.set_load(0.0, 2 * LOAD)
        self.assertEqual(answer.prediction.header.stamp, last)
        self.assertEqual(
            unlike(answer.prediction, predict_scan(self.flat, 2 * LOAD, settings=SETTINGS)), []
        )
        self.assertTrue(self.set_load(0.0, LOAD).success)

    def test_3_settings_change_between_two_scans_and_before_those_that_wait(self):
        for change in (
            lambda load: self.settings.update_configuration({"mechanical_load": load}),
            lambda load: self.set_load(0.0, load),
        ):
            count = len(self.predictions.messages)
            begun = self.while_a_scan_is_at_hand()
            stamps = [self.station.send(self.flat) for _ in range(3)]
            change(3 * LOAD)
            self.assertGreater(time.monotonic() - begun, 0.9 * LIMIT)  # not beside the scan at hand
            waited = self.predictions.wait(count + 3)[count:]
            self.assertEqual([message.header.stamp for message in waited], stamps)
            expected = predict_scan(self.flat, 3 * LOAD, settings=SETTINGS)
            for message in waited:
                self.assertEqual(unlike(message, expected), [])
            change(LOAD)
            self.counts.wait(received=self.station.count(), waiting=0)
            self.assertGreater(float(self.counts["max_latency [s]"]), 0.5 * LIMIT)
            self.assertLess(float(self.counts["max_latency [s]"]), 10 * LIMIT)
            self.assertLess(float(self.counts["last_processing_time [s]"]), 0.5 * LIMIT)
        self.assert_next_is_predicted()
        self.counts.wait(received=self.station.count(), waiting=0)
        self.assertLess(float(self.counts["last_latency [s]"]), 0.5 * LIMIT)

    def test_4_a_long_run_takes_its_scan_between_two_others(self):
        """The cleaning of a given scan, and the last one, belong to the thread that predicts."""
        sweep = actionlib.SimpleActionClient("stiction_node/sweep_load", SweepLoadAction)
        self.assertTrue(sweep.wait_for_server(rospy.Duration(TIMEOUT)))
        self.assert_next_is_predicted()
        given = dict(
            height=image_message(self.flat, rospy.Time(9)), scan_info=info_message(rospy.Time(9))
        )
        for scan in (given, {}):
            begun = self.while_a_scan_is_at_hand()
            sweep.send_goal(SweepLoadGoal(voltages=[0.0], **scan))
            self.assertTrue(sweep.wait_for_result(rospy.Duration(TIMEOUT)))
            self.assertEqual(sweep.get_state(), GoalStatus.SUCCEEDED, sweep.get_result().message)
            self.assertGreater(time.monotonic() - begun, 0.9 * LIMIT)

    def test_5_a_half_space_rests_while_a_scan_is_predicted(self):
        action = actionlib.SimpleActionClient("stiction_node/half_space", HalfSpaceAction)
        self.assertTrue(action.wait_for_server(rospy.Duration(TIMEOUT)))
        surface = rough_surface(
            1, rows=512, cols=512, rms_height=5e-10
        )  # near bonding, in small steps: much longer than two scans take
        feedback = []
        action.send_goal(
            HalfSpaceGoal(
                height=image_message(surface, rospy.Time(9)),
                scan_info=info_message(rospy.Time(9)),
                voltage=0.0,
                mechanical_load=LOAD,
            ),
            feedback_cb=feedback.append,
        )
        wait_until(lambda: len(feedback) > 1, "progress")
        node = process_of("prediction")
        start = thread_seconds(node)
        begun = time.monotonic()

        def computed():
            return {
                thread: seconds - start.get(thread, 0.0)
                for thread, seconds in thread_seconds(node).items()
            }

        def solving():
            return [thread for thread, seconds in computed().items() if seconds > 0.1 * LIMIT]

        wait_until(solving, "a thread that solves")
        free = {
            thread: seconds / (time.monotonic() - begun) for thread, seconds in computed().items()
        }
        threads = solving()
        begun = self.while_a_scan_is_at_hand()
        rospy.sleep(begun + 0.25 * LIMIT - time.monotonic())
        start, since = thread_seconds(node), time.monotonic()
        rospy.sleep(begun + 0.95 * LIMIT - time.monotonic())
        beside, elapsed = thread_seconds(node), time.monotonic() - since
        shares = [(beside[thread] - start[thread]) / elapsed / free[thread] for thread in threads]
        self.assertLessEqual(
            min(shares), 0.2
        )  # one of them has given way: a tenth of the time stays with it
        before = len(feedback)
        wait_until(lambda: len(feedback) > before, "progress after the scan")
        action.cancel_goal()
        self.assertTrue(action.wait_for_result(rospy.Duration(TIMEOUT)))


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "slow_scans", SlowScansTest)
