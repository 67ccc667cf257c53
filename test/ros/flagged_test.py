#!/usr/bin/env python3
"""half_space/enabled by default: scans whose flags ask for a half-space are solved by themselves,
and their device is judged by it."""

import math
import unittest

import actionlib
import rospy
import rostest
from mems_stiction.msg import (
    DeviceAdhesion,
    DeviceVerdict,
    HalfSpaceAction,
    HalfSpaceGoal,
    HalfSpaceSolution,
    PartVerdict,
    StictionPrediction,
)
from mems_stiction.srv import SetMechanicalLoad, SolveHalfSpace, SolveHalfSpaceRequest
from stiction_client import (
    TIMEOUT,
    Collector,
    Station,
    image_message,
    info_message,
    rough_surface,
    wait_until,
)

SMALL = 64  # pixels of a side, as many as the launch file allows
# a comma would end a field of rostopic echo -p
BY_HALF_SPACE = "by the half-space; as near_bonding asks for it: "
VERDICT = ("sticks", "margin", "margin_lower", "margin_upper", "reason", "verdict_by")


def smooth(seed, rows=SMALL):
    """Bonded, and parting by cracks: that flag has a doubt."""
    return rough_surface(seed, rows=rows, cols=SMALL, rms_height=2e-10)


def rough(seed):
    return rough_surface(seed, rows=SMALL, cols=SMALL, rms_height=2e-9)


class FlaggedTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("flagged_test")
        rospy.wait_for_service("stiction_node/solve_half_space", timeout=TIMEOUT)
        cls.solve = rospy.ServiceProxy("stiction_node/solve_half_space", SolveHalfSpace)
        cls.set_load = rospy.ServiceProxy("stiction_node/set_mechanical_load", SetMechanicalLoad)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.solutions = Collector("half_space", HalfSpaceSolution).connect()
        cls.parts = Collector("part_verdict", PartVerdict).connect()
        cls.devices = Collector("device_force", DeviceAdhesion).connect()
        cls.verdicts = Collector("verdict", DeviceVerdict).connect()
        cls.station = Station()

    def send(self, heights, serial=""):
        """Its stamp and prediction."""
        count, stamp = len(self.predictions.messages), self.station.stamp()
        info = info_message(stamp)
        info.part_id, info.serial_id = ("lot 3", serial) if serial else ("", "")
        self.station.height.publish(image_message(heights, stamp))
        self.station.info.publish(info)
        prediction = self.predictions.wait(count + 1)[count]
        self.assertEqual(prediction.header.stamp, stamp)
        return stamp, prediction

    def of(self, collector, stamp, what, accepts=lambda message: True):
        """The message of the scan that is accepted, once it is there."""
        found = []

        def is_there():
            found[:] = [
                message
                for message in collector.messages
                if message.header.stamp == stamp and accepts(message)
            ]
            return found

        wait_until(is_there, what)
        return found[-1]

    def judged_by_half_space(self, collector, stamp, what):
        return self.of(collector, stamp, what, lambda message: message.verdict_by == "half_space")

    def test_1_a_flagged_scan_is_solved_and_judges_device_and_part(self):
        stamp, prediction = self.send(smooth(1), "0012")
        self.assertTrue(prediction.regime_flags & StictionPrediction.FLAG_NEAR_BONDING)
        self.assertIn(
            "near_bonding asks for the half-space: it follows on the topic half_space",
            prediction.reason,
        )
        solution = self.of(self.solutions, stamp, "the half-space")
        self.assertEqual(solution.status, HalfSpaceSolution.SOLVED, solution.message)
        for name in ("version", "settings_hash", "part_id", "serial_id"):
            self.assertEqual(getattr(solution, name), getattr(prediction, name), name)
        device = self.judged_by_half_space(self.devices, stamp, "the device by the half-space")
        self.assertTrue(device.reason.startswith(BY_HALF_SPACE), device.reason)
        for end, other in (("", ""), ("_lower", "_upper"), ("_upper", "_lower")):
            product = getattr(device, "margin" + end) * getattr(device, "pull_off_force" + other)
            self.assertAlmostEqual(product / device.restoring_force, 1.0, places=12, msg=end)
        by_area = solution.pull_off_force * device.area / prediction.nominal_area
        self.assertAlmostEqual(device.linear_pull_off_force / by_area, 1.0, places=9)
        part = self.of(
            self.parts, stamp, "the part", lambda message: message.margin == device.margin
        )
        self.assertEqual(
            (part.sticks, part.margin_lower, part.scan_count),
            (device.sticks, device.margin_lower, 1),
        )
        verdict = self.of(
            self.verdicts, stamp, "the final verdict", lambda message: message.is_final
        )
        self.assertEqual(
            (verdict.verdict_by, verdict.by_device_force, verdict.margin),
            ("half_space", True, device.margin),
        )
        first = next(message for message in self.verdicts.messages if message.header.stamp == stamp)
        self.assertEqual((first.is_final, first.waits_for), (False, "device_force half_space"))

    def test_1b_the_half_space_of_the_finest_scan_judges_whichever_came_last(self):
        """Of scans with the same pixels the largest comes first; the small one has no flag."""
        scans = {"smooth": smooth(11), "rough": rough(11)[: SMALL // 2, : SMALL // 2].copy()}
        found = {}
        for order in (("smooth", "rough"), ("rough", "smooth")):
            stamps = {name: self.send(scans[name], " then ".join(order))[0] for name in order}
            self.of(self.solutions, stamps["smooth"], "the half-space")
            found[order] = self.judged_by_half_space(
                self.devices, stamps[order[-1]], "the device by the half-space"
            )
            final = self.of(
                self.verdicts,
                stamps[order[-1]],
                "the final verdict",
                lambda message: message.is_final and message.verdict_by == "half_space",
            )
            self.assertEqual(final.margin, found[order].margin)
        first, second = found.values()
        for name in VERDICT:
            self.assertEqual(getattr(first, name), getattr(second, name), name)

    def test_1c_the_half_space_of_the_finest_scan_judges_after_those_of_many_others(self):
        first, _ = self.send(smooth(20), "many")
        device = self.judged_by_half_space(self.devices, first, "the device by the half-space")
        for seeds in (range(21, 26), range(26, 31)):
            stamps = [self.send(smooth(seed, rows=SMALL - 8), "many")[0] for seed in seeds]
            for stamp in stamps:
                self.of(self.solutions, stamp, "the half-space")
        last = self.of(self.verdicts, stamp, "the final verdict", lambda message: message.is_final)
        self.assertEqual((last.verdict_by, device.verdict_by), ("half_space", "half_space"))

    def test_2_other_scans_are_not_solved(self):
        first, prediction = self.send(rough(1))
        self.assertFalse(prediction.regime_flags & StictionPrediction.FLAG_NEAR_BONDING)
        self.assertNotIn("half-space", prediction.reason)
        second, _ = self.send(smooth(2))
        self.of(self.solutions, second, "the half-space")
        self.assertNotIn(first, [solution.header.stamp for solution in self.solutions.messages])

    def test_3_several_in_a_row_are_all_answered(self):
        stamps = [self.send(smooth(seed))[0] for seed in range(3, 7)]
        for stamp in stamps:
            self.of(self.solutions, stamp, "the half-space")

    def test_3b_a_part_has_one_final_answer_on_its_newest_scan(self):
        """The half-space of its first scan, the finest, comes late: others are before its turn."""
        first, _ = self.send(smooth(12), "late")
        middle, _ = self.send(smooth(13), "late")
        between = [self.send(smooth(seed))[0] for seed in range(14, 17)]
        newest, _ = self.send(rough(12)[: SMALL // 2, : SMALL // 2].copy(), "late")
        for stamp in [first, middle] + between:
            self.of(self.solutions, stamp, "the half-space")
        self.of(
            self.verdicts, newest, "the final verdict of the part", lambda message: message.is_final
        )
        last, _ = self.send(smooth(17))  # whatever was found before has been said by then
        self.of(
            self.verdicts,
            last,
            "the final verdict of the last scan",
            lambda message: message.is_final and message.verdict_by == "half_space",
        )
        said = [message for message in self.verdicts.messages if message.serial_id == "late"]
        final = [(message.header.stamp, message.verdict_by) for message in said if message.is_final]
        self.assertEqual(final, [(newest, "half_space")])

    def test_4_one_that_is_too_large_is_left_out_with_a_sentence(self):
        stamp, prediction = self.send(smooth(8, rows=SMALL + 1))
        self.assertTrue(prediction.regime_flags & StictionPrediction.FLAG_NEAR_BONDING)
        self.assertIn(
            "near_bonding asks for the half-space; which does not count: a frame of 65 x 64 pixels "
            "is larger than half_space/max_flagged_pixels = 4096",
            prediction.reason,
        )
        device = self.of(self.devices, stamp, "the device")
        self.assertEqual(device.verdict_by, "prediction")
        answer = self.solve(
            SolveHalfSpaceRequest(voltage=math.nan, mechanical_load=math.nan)
        )  # who asks gets it
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.solution.header.stamp, stamp)
        self.assertNotIn(stamp, [solution.header.stamp for solution in self.solutions.messages])

    def test_5_service_and_action_know_the_device(self):
        stamp, prediction = self.send(smooth(9))
        device = self.judged_by_half_space(self.devices, stamp, "the device by the half-space")
        answer = self.solve(
            SolveHalfSpaceRequest(voltage=math.nan, mechanical_load=math.nan)
        ).solution
        action = actionlib.SimpleActionClient("stiction_node/half_space", HalfSpaceAction)
        self.assertTrue(action.wait_for_server(rospy.Duration(TIMEOUT)))
        action.send_goal(HalfSpaceGoal(voltage=math.nan, mechanical_load=math.nan))
        self.assertTrue(action.wait_for_result(rospy.Duration(TIMEOUT)))
        for name in VERDICT:
            self.assertEqual(
                getattr(answer, name), getattr(action.get_result().solution, name), name
            )
        self.assertEqual(answer.verdict_by, "half_space")
        self.assertNotEqual(answer.sticks, StictionPrediction.STICKS_UNKNOWN)
        for name in ("sticks", "margin", "margin_lower", "margin_upper"):
            self.assertEqual(getattr(answer, name), getattr(device, name), name)
        # The device is known under its own load alone.
        other = self.solve(
            SolveHalfSpaceRequest(
                voltage=math.nan, mechanical_load=2.0 * prediction.mechanical_load
            )
        ).solution
        self.assertEqual(
            (other.sticks, math.isnan(other.margin)), (StictionPrediction.STICKS_UNKNOWN, True)
        )
        self.assertIn("device_force", other.reason)

    def test_6_after_another_load_the_last_scan_is_solved_again(self):
        stamp, prediction = self.send(smooth(10))
        self.judged_by_half_space(self.devices, stamp, "the device by the half-space")
        load = 2.0 * prediction.mechanical_load
        self.assertTrue(self.set_load(load).success)
        try:
            solution = self.of(
                self.solutions,
                stamp,
                "the half-space under the load",
                lambda one: one.mechanical_load == load,
            )
            self.assertEqual(solution.status, HalfSpaceSolution.SOLVED, solution.message)
            device = self.of(
                self.devices,
                stamp,
                "the device under the load",
                lambda one: one.mechanical_load == load and one.verdict_by == "half_space",
            )
            self.assertEqual(device.status, DeviceAdhesion.JUDGED_AGAIN)
        finally:
            self.set_load(prediction.mechanical_load)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "flagged", FlaggedTest)
