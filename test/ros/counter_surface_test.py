#!/usr/bin/env python3
"""counter_surface/type topic: the latest counter-surface is kept; without one scans are
rejected."""

import unittest

import actionlib
import numpy as np
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from mems_stiction.msg import StictionPrediction, SweepLoadAction, SweepLoadGoal
from sensor_msgs.msg import Image
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    Station,
    Traffic,
    figures,
    image_message,
    info_message,
    predict_scan,
    rough_surface,
    unlike,
    wait_until,
)

LOAD = 1e-6


class CounterSurfaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("counter_surface_test")

    def test_1_the_latest_counter_surface_is_kept(self):
        counts = Counts()
        predictions = Collector("prediction", StictionPrediction).connect()
        deformed = Collector("deformed_counter_height", Image).connect()
        station = Station()
        counter = Station("counter_")
        surface = rough_surface(1)

        station.send(surface)
        counts.wait(received=1, rejected=1, predicted=0)
        self.assertIn("no counter-surface", counts["last_reason"])

        # Against itself, two equal surfaces touch everywhere: as flat against flat, bonded.
        counter.send(surface)
        counts.wait(counter_surfaces=1)
        station.send(surface)
        mated = predictions.wait(1)[0]
        self.assertEqual(mated.status, StictionPrediction.BONDED)
        self.assertEqual(np.frombuffer(deformed.wait(1)[0].data, np.float32).size, surface.size)

        counter.send(rough_surface(2))
        counts.wait(counter_surfaces=2)
        station.send(surface)
        rough = predictions.wait(2)[1]
        self.assertEqual(rough.status, StictionPrediction.EQUILIBRIUM)
        self.assertLess(rough.contact_fraction, mated.contact_fraction)
        for prediction, other in ((mated, surface), (rough, rough_surface(2))):
            self.assertEqual(
                unlike(prediction, predict_scan(surface, LOAD, counter=other), ["settings_hash"]),
                [],
            )
        self.assertAlmostEqual(rough.composite_rms_height, 5e-9 * np.sqrt(2.0), delta=1e-11)

        # A bad one is counted by itself and leaves the good one where it is.
        counter.send(surface, pitch=-1.0)
        counts.wait(counter_surfaces=2, counter_surfaces_rejected=1)
        stamp = station.send(surface)
        again = predictions.wait(3)[2]
        self.assertEqual(again.header.stamp, stamp)
        again.header = rough.header
        self.assertEqual(figures(again), figures(rough))

        # One of another size fits no scan.
        counter.send(rough_surface(2, rows=32, cols=32))
        counts.wait(counter_surfaces=3)
        station.send(surface)
        counts.wait(received=5, predicted=3, rejected=2)
        # Their numbers and stamps are a sequence of their own.
        counts.wait(missing_by_sequence=0, stamps_not_increasing=0)
        # Half of one is no counter-surface, and that is said too.
        counter.height.publish(image_message(surface, counter.stamp()))
        counts.wait(counter_surfaces=3, counter_surfaces_rejected=2, received=5)
        self.assertIn("rejected the counter-surface", counts["last_reason"])
        self.assertIn("no scan_info with the stamp of the scan came", counts.reasons()[-1])

    def test_2_a_sweep_keeps_its_counter_surface_while_others_arrive(self):
        sweep = actionlib.SimpleActionClient("stiction_node/sweep_load", SweepLoadAction)
        self.assertTrue(sweep.wait_for_server(rospy.Duration(TIMEOUT)))
        surface, counters = rough_surface(11), [rough_surface(12), rough_surface(13)]
        expected = [
            predict_scan(surface, LOAD, counter=counter)["pull_off_force"] for counter in counters
        ]
        self.assertNotEqual(expected[0], expected[1])
        stamp = rospy.Time(3)
        goal = SweepLoadGoal(
            voltages=[0.0], height=image_message(surface, stamp), scan_info=info_message(stamp)
        )
        live = rough_surface(14)
        records = [predict_scan(live, LOAD, counter=counter) for counter in counters]
        predictions = Collector("prediction", StictionPrediction).connect()
        with (
            Traffic(Station("counter_"), counters),
            Traffic(Station(), [live], predictions=predictions),
        ):
            for _ in range(30):
                sweep.send_goal(goal)
                self.assertTrue(sweep.wait_for_result(rospy.Duration(TIMEOUT)), "no answer")
                self.assertEqual(
                    sweep.get_state(), GoalStatus.SUCCEEDED, sweep.get_result().message
                )
                self.assertIn(sweep.get_result().points[0].pull_off_force, expected)
            forces = {record["pull_off_force"] for record in records}
            wait_until(
                lambda: (
                    forces
                    <= {prediction.pull_off_force for prediction in list(predictions.messages)}
                ),
                "scans against either",
            )
        met = [
            [unlike(prediction, record, ["settings_hash"]) == [] for record in records]
            for prediction in predictions.messages
        ]
        met = met[
            next(index for index, one in enumerate(met) if any(one)) :
        ]  # the first may have met that of the test before
        self.assertEqual(
            {sum(one) for one in met}, {1}, "each prediction is that of one of the two"
        )
        self.assertEqual([any(column) for column in zip(*met)], [True, True])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "counter_surface", CounterSurfaceTest)
