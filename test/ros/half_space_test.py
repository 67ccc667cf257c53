#!/usr/bin/env python3
"""The half-space on topic, service and action: the command line's figures, under traffic,
cancelled, and with bad input."""

import math
import subprocess
import threading
import time
import unittest

import actionlib
import dynamic_reconfigure.client
import mems_stiction
import numpy as np
import rosgraph
import rosnode
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import (
    HalfSpaceAction,
    HalfSpaceFeedback,
    HalfSpaceGoal,
    HalfSpacePoint,
    HalfSpaceSolution,
    PartVerdict,
    ScanInfo,
    StictionPrediction,
)
from mems_stiction.srv import SetLoad, SolveHalfSpace, SolveHalfSpaceRequest
from roslib.packages import find_node
from sensor_msgs.msg import Image
from stiction_client import (
    PITCH,
    TIMEOUT,
    Collector,
    Station,
    Traffic,
    image_message,
    info_message,
    needs_module,
    predict_scan,
    rough_surface,
    settings_of,
    wait_for_listener,
    wait_until,
)

LOAD = 1e-6
SOON = 10.0  # a second is meant; the rest is for busy machines, and the work takes more [s]
WORDS = {
    getattr(HalfSpaceSolution, word): word
    for word in (
        "SOLVED",
        "LOAD_NOT_REACHED",
        "NOT_CONVERGED",
        "TOO_MANY_STATES",
        "CANCELLED",
        "REFUSED",
    )
}
WAYS = {HalfSpacePoint.APPROACH: "APPROACH", HalfSpacePoint.RETRACTION: "RETRACTION"}
# As in the launch file.
DEVICE = dict(
    spring_stiffness=1.0,
    travel=1e-6,
    contact_area=4e-13,
    beam_type="cantilever",
    beam_length=100e-6,
    beam_thickness=2e-6,
    beam_gap=2e-6,
    beam_modulus=160e9,
)
STICKS = {
    "no": StictionPrediction.STICKS_NO,
    "marginal": StictionPrediction.STICKS_MARGINAL,
    "yes": StictionPrediction.STICKS_YES,
    "unknown": StictionPrediction.STICKS_UNKNOWN,
}
VERDICT = (
    "margin",
    "margin_lower",
    "margin_upper",
    "peel_number",
    "peel_number_lower",
    "peel_number_upper",
)
FIGURES = [
    name
    for name, kind in zip(HalfSpaceSolution.__slots__, HalfSpaceSolution._slot_types)
    if kind == "float64" and name not in ("voltage", "mechanical_load")
]


def slow_surface():
    """Near bonding, with as many pixels as the launch file allows: several times SOON."""
    return rough_surface(1, rows=1024, cols=1024, rms_height=5e-10)


def record_of(surface, load=LOAD, voltage=0.0):
    """The half-space's figures, and under "verdict" the verdict."""
    record = predict_scan(
        surface,
        load,
        voltage,
        arguments=["--half-space"],
        settings=settings_of(device=DEVICE, device_force={"enabled": False}),
    )
    return dict(
        record["half_space"],
        verdict={name: record[name] for name in VERDICT + ("sticks", "reason", "verdict_by")},
    )


class HalfSpaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("half_space_test")
        cls.reports = Collector("/diagnostics", DiagnosticArray)
        rospy.wait_for_service("stiction_node/solve_half_space", timeout=TIMEOUT)
        cls.solve = rospy.ServiceProxy("stiction_node/solve_half_space", SolveHalfSpace)
        cls.set_load = rospy.ServiceProxy("stiction_node/set_load", SetLoad)
        cls.action = actionlib.SimpleActionClient("stiction_node/half_space", HalfSpaceAction)
        assert cls.action.wait_for_server(rospy.Duration(TIMEOUT))
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.solutions = Collector("half_space", HalfSpaceSolution).connect()
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)
        cls.station = Station()

    def asked(self, kind, surface, voltage=math.nan, mechanical_load=math.nan, stamp=rospy.Time(7)):
        encodings = {"float32": "32FC1", "float64": "64FC1"}
        return kind(
            height=image_message(surface, stamp, encodings[str(surface.dtype)]),
            scan_info=info_message(stamp),
            voltage=voltage,
            mechanical_load=mechanical_load,
        )

    def run_goal(self, goal):
        feedback = []
        self.action.send_goal(goal, feedback_cb=feedback.append)
        self.assertTrue(self.action.wait_for_result(rospy.Duration(TIMEOUT)), "no answer")
        return self.action.get_state(), self.action.get_result(), feedback

    def live(self, surface):
        """The scan's solution on the topic, once its prediction is there, too."""
        count = len(self.solutions.messages)
        stamp = self.station.send(surface)
        solution = self.solutions.wait(count + 1)[count]
        self.assertEqual(solution.header.stamp, stamp)
        self.predictions.of(stamp)
        return solution

    def counts(self):
        """Of the newest report."""
        for message in reversed(self.reports.messages):
            for status in message.status:
                if status.name == "stiction_node: half_space":
                    return {entry.key: entry.value for entry in status.values}, status
        return {}, None

    def count(self, key):
        return int(self.counts()[0].get(key, -1))

    def assert_solved_as(self, solution, record):
        """Every figure that the command line prints, to the bit; of these only the time is
        another."""
        self.assertEqual(solution.status, HalfSpaceSolution.SOLVED, solution.message)
        for name, expected in record.items():
            if name not in (
                "curve",
                "status",
                "processing_time",
                "verdict",
                "contact_stiffness",
            ):  # the last is not in the message
                self.assertEqual(getattr(solution, name), expected, name)
        self.assertEqual(WORDS[solution.status], record["status"])
        verdict = record["verdict"]
        for name in VERDICT:
            self.assertEqual(getattr(solution, name), verdict[name], name)
        self.assertEqual(
            (solution.sticks, solution.reason, solution.verdict_by),
            (STICKS[verdict["sticks"]], verdict["reason"].replace(",", ";"), verdict["verdict_by"]),
        )  # for rostopic echo -p
        self.assertIn("half-space", solution.reason)
        self.assertEqual(
            [(point.height, point.force, WAYS[point.direction]) for point in solution.curve],
            [(point["height"], point["force"], point["direction"]) for point in record["curve"]],
        )
        self.assertGreater(solution.processing_time, 0.0)

    def assert_refused(self, solution, reason):
        self.assertEqual(solution.status, HalfSpaceSolution.REFUSED)
        self.assertIn(reason, solution.message)
        self.assertNotIn("\n", solution.message)
        for name in FIGURES:
            self.assertTrue(math.isnan(getattr(solution, name)), name)
        self.assertEqual((solution.contact_count, len(solution.curve)), (-1, 0))
        self.assertEqual(
            (solution.sticks, solution.reason, solution.verdict_by),
            (StictionPrediction.STICKS_UNKNOWN, "", ""),
        )

    def test_1_without_a_scan_everybody_says_so(self):
        answer = self.solve(SolveHalfSpaceRequest())
        self.assertFalse(answer.success)
        self.assertIn("no scan yet", answer.message)
        self.assert_refused(answer.solution, "no scan yet")
        state, result, _ = self.run_goal(HalfSpaceGoal())
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertIn("no scan yet", result.message)
        self.assert_refused(result.solution, "no scan yet")

    def test_2_service_action_and_topic_have_the_figures_of_the_command_line(self):
        surface = rough_surface(1, rows=64, cols=64)
        expected = record_of(surface)
        answer = self.solve(self.asked(SolveHalfSpaceRequest, surface))
        self.assertTrue(answer.success, answer.message)
        self.assert_solved_as(answer.solution, expected)
        self.assertEqual(answer.solution.header.stamp, rospy.Time(7))
        self.assertEqual((answer.solution.voltage, answer.solution.mechanical_load), (0.0, LOAD))
        state, result, feedback = self.run_goal(self.asked(HalfSpaceGoal, surface))
        self.assertEqual((state, result.message), (GoalStatus.SUCCEEDED, ""))
        self.assert_solved_as(result.solution, expected)
        self.assert_solved_as(self.live(surface), expected)

        # The last scan, at a load of its own that nobody else gets to feel; zero is a load.
        for voltage, load in ((5.0, 2e-6), (0.0, 0.0)):
            request = SolveHalfSpaceRequest(voltage=voltage, mechanical_load=load)
            answer = self.solve(request)
            self.assert_solved_as(answer.solution, record_of(surface, load, voltage))
            self.assertEqual(
                (answer.solution.voltage, answer.solution.mechanical_load), (voltage, load)
            )
            self.assertEqual(
                answer.solution.header.stamp, self.predictions.messages[-1].header.stamp
            )
        self.assert_solved_as(self.live(surface), expected)

        # Beside it the other scan of a call is forgotten.
        other = rough_surface(2, rows=48, cols=64).astype(float)
        self.assert_solved_as(
            self.solve(self.asked(SolveHalfSpaceRequest, other)).solution, record_of(other)
        )
        last = self.solve(SolveHalfSpaceRequest(voltage=math.nan, mechanical_load=math.nan))
        self.assert_solved_as(last.solution, expected)

    def test_2b_a_solution_says_where_it_comes_from_and_judges_for_the_part(self):
        parts = Collector("part_verdict", PartVerdict).connect()
        for place in (1, 2):
            stamp = self.station.stamp()
            info = info_message(stamp)
            info.scan_name, info.part_id, info.serial_id = "place %d" % place, "lot 3", "0012"
            count, solved = len(parts.messages), len(self.solutions.messages)
            surface = rough_surface(
                place, rows=64, cols=64, rms_height=2e-9
            )  # whose contact is more than a pixel, so that it counts
            self.station.height.publish(image_message(surface, stamp))
            self.station.info.publish(info)
            solution = self.solutions.wait(solved + 1)[solved]
            before, after = parts.wait(count + 2)[count:]
            prediction = self.predictions.of(stamp)
            for name in ("version", "settings_hash", "scan_name", "part_id", "serial_id"):
                self.assertEqual(getattr(solution, name), getattr(prediction, name), name)
            self.assertEqual(solution.scan_name, "place %d" % place)
            self.assertEqual(
                (before.header.stamp, after.header.stamp, after.scan_count), (stamp, stamp, place)
            )
            self.assertEqual(after.verdict_by, "half_space")
            self.assertEqual(
                before.verdict_by, "prediction" if place == 1 else "prediction and half_space"
            )
            if place == 1:
                self.assertEqual(
                    (after.margin, after.margin_lower, after.sticks),
                    (solution.margin, solution.margin_lower, solution.sticks),
                )
        answer = self.solve(
            SolveHalfSpaceRequest(voltage=math.nan, mechanical_load=math.nan)
        ).solution
        self.assertEqual(
            (answer.scan_name, answer.part_id, answer.settings_hash),
            ("place 2", "lot 3", prediction.settings_hash),
        )
        parts.close()

    def test_3_under_traffic_each_solution_belongs_to_the_prediction_of_its_stamp(self):
        surfaces = [rough_surface(seed, rows=64, cols=64) for seed in range(3, 6)]
        loads = (LOAD, 3e-6)
        expected = {
            (index, load): record_of(surface, load)
            for index, surface in enumerate(surfaces)
            for load in loads
        }
        first = len(self.solutions.messages)
        solved_by_calls = []
        with Traffic(self.station, surfaces, period=0.005, predictions=self.predictions) as traffic:
            for load in loads * 3:
                self.assertTrue(self.set_load(0.0, load).success)
                count = len(self.solutions.messages)
                self.solutions.wait(count + 4)
                given = len(solved_by_calls) % len(surfaces)
                state, result, _ = self.run_goal(
                    self.asked(HalfSpaceGoal, surfaces[given], mechanical_load=load)
                )
                self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
                self.assert_solved_as(result.solution, expected[given, load])
                state, result, _ = self.run_goal(
                    HalfSpaceGoal(voltage=math.nan, mechanical_load=load)
                )
                self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
                answer = self.solve(SolveHalfSpaceRequest(voltage=math.nan, mechanical_load=load))
                self.assertTrue(answer.success, answer.message)
                solved_by_calls += [result.solution, answer.solution]
        self.assertTrue(self.set_load(0.0, LOAD).success)
        wait_until(
            lambda: (
                len(self.predictions.messages)
                and self.predictions.messages[-1].header.stamp == max(traffic.sent)
            ),
            "the last prediction",
        )
        wait_until(
            lambda: self.solutions.messages[-1].header.stamp == max(traffic.sent),
            "the solution of the newest scan",
        )
        predictions = {
            prediction.header.stamp: prediction for prediction in self.predictions.messages
        }
        solutions = self.solutions.messages[first:]
        stamps = [solution.header.stamp for solution in solutions]
        self.assertEqual(stamps, sorted(set(stamps)))
        for solution in solutions:
            prediction = predictions[solution.header.stamp]
            self.assertEqual(solution.mechanical_load, prediction.mechanical_load)
            self.assertEqual(solution.header.frame_id, prediction.header.frame_id)
        for solution in solutions + solved_by_calls:
            index = [sent is traffic.sent[solution.header.stamp] for sent in surfaces].index(True)
            self.assert_solved_as(solution, expected[index, solution.mechanical_load])
        self.assertEqual({solution.mechanical_load for solution in solutions}, set(loads))
        solved = len(self.solutions.messages)
        wait_until(
            lambda: (
                (self.count("offered"), self.count("solved"), self.count("failed"))
                == (len(predictions), solved, 0)
            ),
            "the count of every scan",
        )
        self.assertEqual(self.count("skipped"), len(predictions) - solved)

    def test_4_bad_input_gets_a_sentence_and_the_node_goes_on(self):
        surface = rough_surface(6, rows=64, cols=64)
        large = np.zeros((1025, 1024), np.float32)
        cases = [
            (self.asked(SolveHalfSpaceRequest, np.full_like(surface, np.nan)), "valid"),
            (self.asked(SolveHalfSpaceRequest, large), "half_space/max_pixels = 1048576"),
            (self.asked(SolveHalfSpaceRequest, surface, voltage=math.inf), "load/voltage"),
            (self.asked(SolveHalfSpaceRequest, surface, voltage=51.0), "load/voltage"),
            (
                self.asked(SolveHalfSpaceRequest, surface, mechanical_load=-1e-9),
                "load/mechanical_load",
            ),
        ]
        request = self.asked(SolveHalfSpaceRequest, surface)
        request.scan_info = ScanInfo()
        cases.append((request, "pitch"))
        request = self.asked(SolveHalfSpaceRequest, surface)
        request.height.encoding = "rgb8"
        cases.append((request, "rgb8"))
        for request, reason in cases:
            answer = self.solve(request)
            self.assertFalse(answer.success)
            self.assertIn(reason, answer.message)
            self.assert_refused(answer.solution, reason)
            goal = HalfSpaceGoal(
                request.height, request.scan_info, request.voltage, request.mechanical_load
            )
            state, result, _ = self.run_goal(goal)
            self.assertEqual(state, GoalStatus.ABORTED)
            self.assertIn(reason, result.message)
            self.assert_refused(result.solution, reason)
        # Scans that the model predicts and the half-space cannot.
        failed = self.count("failed")
        self.assert_refused(self.live(large), "half_space/max_pixels")
        self.settings.update_configuration({"work_of_adhesion": 0.0})
        refused = self.live(surface)
        self.settings.update_configuration({"work_of_adhesion": 0.05})
        self.assert_refused(refused, "interface/work_of_adhesion: 0 is not allowed")
        self.assertEqual(self.predictions.messages[-1].header.stamp, refused.header.stamp)
        wait_until(lambda: self.count("failed") == failed + 2, "the count of failures")
        self.assertIn("work_of_adhesion", self.counts()[0]["last_failure"])
        self.assertEqual(self.live(surface).status, HalfSpaceSolution.SOLVED)

    @needs_module
    def test_5_the_contact_map_is_there_for_listeners(self):
        maps = Collector("half_space_contact_map", Image).connect()
        surface = rough_surface(7, rows=48, cols=64)
        solution = self.live(surface)
        single = maps.wait(1)[0]
        self.assertEqual(single.header.stamp, solution.header.stamp)
        self.assertEqual((single.encoding, single.height, single.width), ("mono8", 48, 64))
        expected = mems_stiction.half_space(surface, PITCH, config=settings_of(device=DEVICE))
        self.assertEqual(bytes(single.data), expected.contact_map.tobytes())

    @needs_module
    def test_5b_the_screen_shows_curves_and_maps(self):
        screen = subprocess.Popen([find_node("mems_stiction", "plot_trend")[0]])
        self.addCleanup(screen.wait)
        self.addCleanup(screen.terminate)
        pictures = {
            topic: Collector(topic, Image).connect()
            for topic in ("force_curve", "half_space_curve", "contact_maps")
        }
        for picture in pictures.values():
            self.assertLess(np.median(np.frombuffer(picture.wait(1)[0].data, np.uint8)), 64)
        for topic in ("prediction", "half_space", "contact_map", "half_space_contact_map"):
            wait_for_listener(topic, "/plot_trend")
        stamp = self.live(rough_surface(8, rows=48, cols=64)).header.stamp
        for topic, picture in pictures.items():
            wait_until(lambda: picture.messages[-1].header.stamp == stamp, topic)
            message = picture.messages[-1]
            self.assertEqual((message.encoding, message.height, message.width), ("rgb8", 600, 1000))
        # both maps have come: neither panel has a sentence in place of one
        maps = pictures["contact_maps"]

        def panels():
            picture = np.frombuffer(maps.messages[-1].data, np.uint8).reshape(600, 1000, 3)
            return picture[250, [250, 750]]

        wait_until(lambda: (panels() != 255).any(axis=1).all(), "both maps")

    def test_6_an_action_is_cancelled_soon_while_scans_go_on(self):
        surface = rough_surface(8, rows=64, cols=64)
        feedback = []
        self.action.send_goal(
            self.asked(HalfSpaceGoal, slow_surface()), feedback_cb=feedback.append
        )
        wait_until(lambda: len(feedback) > 3, "progress")
        self.assertEqual(self.live(surface).status, HalfSpaceSolution.SOLVED)
        self.assertTrue(self.solve(self.asked(SolveHalfSpaceRequest, surface)).success)
        self.assertEqual(self.action.get_state(), GoalStatus.ACTIVE)
        begin = time.monotonic()
        self.action.cancel_goal()
        self.assertTrue(self.action.wait_for_result(rospy.Duration(TIMEOUT)))
        self.assertLess(time.monotonic() - begin, SOON)
        self.assertEqual(self.action.get_state(), GoalStatus.PREEMPTED)
        result = self.action.get_result()
        self.assertEqual(
            (result.message, result.solution.status), ("cancelled", HalfSpaceSolution.CANCELLED)
        )
        self.assertTrue(math.isnan(result.solution.pull_off_force))
        self.assertGreater(len(result.solution.curve), 0)
        shares = [message.progress for message in feedback]
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(all(0.0 <= share <= 1.0 for share in shares), shares)
        self.assertEqual(feedback[0].phase, HalfSpaceFeedback.APPROACH)
        # A new goal takes the place of one that runs.
        self.action.send_goal(
            self.asked(HalfSpaceGoal, slow_surface()), feedback_cb=feedback.append
        )
        wait_until(lambda: len(feedback) > len(shares), "progress")
        state, result, _ = self.run_goal(self.asked(HalfSpaceGoal, surface))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)

    def test_7_the_node_ends_soon_while_everything_solves(self):
        feedback = []
        slow = slow_surface()
        predicted = len(self.predictions.messages)
        self.station.send(slow)
        self.predictions.wait(predicted + 1)
        self.action.send_goal(self.asked(HalfSpaceGoal, slow), feedback_cb=feedback.append)
        answers = []

        def call():
            try:
                answers.append(
                    self.solve(SolveHalfSpaceRequest(voltage=math.nan, mechanical_load=math.nan))
                )
            except rospy.ServiceException as error:  # the connection may go before the answer
                answers.append(error)

        caller = threading.Thread(target=call)
        caller.start()
        wait_until(lambda: len(feedback) > 1, "progress")
        solved = len(self.solutions.messages)
        master = rosgraph.Master("half_space_test")
        begin = time.monotonic()
        rosnode.kill_nodes(["/stiction_node"])  # of a nodelet this is the loader, which unloads it
        wait_until(
            lambda: (
                "/stiction_node/solve_half_space"
                not in [name for name, _ in master.getSystemState()[2]]
            ),
            "the node to end",
        )
        self.assertLess(time.monotonic() - begin, SOON)
        caller.join(TIMEOUT)
        self.assertFalse(caller.is_alive())
        self.assertEqual(len(self.solutions.messages), solved)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "half_space", HalfSpaceTest)
