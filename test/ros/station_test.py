#!/usr/bin/env python3
"""The test station's part: actions with progress and cancel beside live scans, and settings that
change in one place."""

import math
import threading
import time
import unittest

import actionlib
import dynamic_reconfigure.client
import rospy
import rostest
from actionlib_msgs.msg import GoalID, GoalStatus
from dynamic_reconfigure.msg import Config, DoubleParameter, IntParameter
from dynamic_reconfigure.srv import Reconfigure
from mems_stiction.msg import (
    CycleContactAction,
    CycleContactGoal,
    StictionPrediction,
    SweepLoadAction,
    SweepLoadActionGoal,
    SweepLoadActionResult,
    SweepLoadGoal,
    SweepPoint,
)
from mems_stiction.srv import GetLoad, SetLoad
from rosgraph_msgs.msg import Log
from stiction_client import (
    TIMEOUT,
    BytesPublisher,
    Collector,
    Counts,
    Station,
    Traffic,
    bytes_of,
    image_message,
    info_message,
    peak_memory,
    predict_scan,
    process_of,
    rough_surface,
    stating,
    wait_until,
)

LOAD = 1e-6
DEVICE = dict(spring_stiffness=1.0, travel=1e-6, contact_area=48 * 64 * 1e-16, electrode_area=1e-8)


class StationTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("station_test")
        cls.counts = Counts()
        cls.set_load = rospy.ServiceProxy("stiction_node/set_load", SetLoad)
        cls.get_load = rospy.ServiceProxy("stiction_node/get_load", GetLoad)
        rospy.wait_for_service("stiction_node/set_load", timeout=TIMEOUT)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()
        cls.sweep = actionlib.SimpleActionClient("stiction_node/sweep_load", SweepLoadAction)
        cls.cycle = actionlib.SimpleActionClient("stiction_node/cycle_contact", CycleContactAction)
        assert cls.sweep.wait_for_server(rospy.Duration(TIMEOUT)) and cls.cycle.wait_for_server(
            rospy.Duration(TIMEOUT)
        )
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)

    def live(self, surface):
        count = len(self.predictions.messages)
        self.station.send(surface)
        return self.predictions.wait(count + 1)[count]

    def cleaned(self):
        """How many scans were cleaned until the last prediction."""
        self.counts.wait(predicted=len(self.predictions.messages))
        return int(self.counts["cleaned"])

    def run_goal(self, client, goal):
        """The state in the end, the result and all feedback."""
        feedback = []
        client.send_goal(goal, feedback_cb=feedback.append)
        self.assertTrue(client.wait_for_result(rospy.Duration(TIMEOUT)), "no answer")
        return client.get_state(), client.get_result(), feedback

    def assert_progress(self, feedback, total):
        # Feedback and result travel on topics of their own: of a short goal the last ones may come
        # too late.
        done = [message.done for message in feedback]
        self.assertEqual(done, sorted(set(done)))
        self.assertTrue(
            all(1 <= message.done <= message.total == total for message in feedback), feedback
        )

    def assert_first_contacts(self, points, surface, loads, counter=None):
        """The first contact at each load is what the command line predicts for this surface, to the
        bit."""
        first = {}
        for point in points:
            first.setdefault(point.mechanical_load, point)
        self.assertEqual(list(first), loads)
        for load, point in first.items():
            expected = predict_scan(surface, load, point.voltage, counter)
            for field in ("pull_off_force", "van_der_waals_force", "contact_area", "approach"):
                self.assertEqual(getattr(point, field), expected[field], (field, load))

    def test_1_an_action_before_any_scan_says_so(self):
        state, result, _ = self.run_goal(self.sweep, SweepLoadGoal(voltages=[0.0]))
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertIn("no scan yet", result.message)
        state, result, _ = self.run_goal(self.cycle, CycleContactGoal(count=2))
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertIn("no scan yet", result.message)

    def test_2_reconfigure_sets_the_device_and_the_verdict_follows(self):
        surface = rough_surface(1)
        before = self.live(surface)
        self.assertEqual(before.sticks, StictionPrediction.STICKS_UNKNOWN)
        self.assertIn("not stated", before.reason)
        self.assertTrue(math.isnan(before.margin))
        self.settings.update_configuration(DEVICE)
        after = self.live(surface)
        self.assertNotIn("not stated", after.reason)
        self.assertAlmostEqual(after.margin * after.pull_off_force / 1e-6, 1.0, delta=1e-9)
        self.assertLess(after.margin_lower, after.margin)
        self.assertEqual(after.pull_off_force, before.pull_off_force)
        self.settings.update_configuration({"work_of_adhesion": 0.1})
        self.assertGreater(self.live(surface).pull_off_force, after.pull_off_force)
        self.settings.update_configuration({"work_of_adhesion": 0.05})
        self.assertEqual(self.live(surface).pull_off_force, after.pull_off_force)

    def test_3_services_and_reconfigure_share_one_setter(self):
        answer = self.settings.update_configuration({"voltage": 12.0})
        self.assertEqual((answer["voltage"], self.get_load().voltage), (12.0, 12.0))
        self.assertTrue(self.set_load(3.0, LOAD).success)
        wait_until(
            lambda: self.settings.get_configuration()["voltage"] == 3.0,
            "reconfigure to show the service's change",
        )
        # A contact potential is not theirs to change.
        self.settings.update_configuration({"contact_potential": 2.0})
        answer = self.set_load(0.0, LOAD)
        self.assertTrue(answer.success)
        self.assertGreater(answer.prediction.electrostatic_force, 0.0)
        self.assertEqual(self.settings.get_configuration()["contact_potential"], 2.0)
        self.settings.update_configuration({"contact_potential": 0.0})
        self.assertEqual(self.set_load(0.0, LOAD).prediction.electrostatic_force, 0.0)
        self.assertTrue(self.set_load(3.0, LOAD).success)
        # A refused value takes the whole request back, the client sees what is set, and a warning
        # says why.
        log = Collector("/rosout", Log).connect()
        for refused, reason in (
            ({"voltage": 51.0}, "load/voltage: 51 V is not allowed, must be in [-50, 50] V"),
            ({"insulator_thickness": 0.0}, "interface/insulator_thickness"),
            (
                {"work_of_adhesion": -1.0},
                "interface/work_of_adhesion: -1 J/m^2 is not allowed, must be >= 0",
            ),
            (
                {"travel": 2e-6, "electrode_gap": 1e-7},
                "device/travel: 2e-06 m is not allowed, must not exceed",
            ),
            ({"beam_type": "cantilever"}, "device/beam_length: 0 is not allowed"),
            (
                {"beam_type": "bridge"},
                "device/beam_type: 'bridge' is not allowed, must be one of none cantilever",
            ),
            ({"mechanical_load": math.nan}, "load/mechanical_load: nan N is not allowed"),
        ):
            asked = dict(refused, hamaker_constant=1e-20)
            del log.messages[:]
            before = self.settings.get_configuration()
            answer = self.settings.update_configuration(asked)
            wait_until(
                lambda: any(
                    message.level == Log.WARN
                    and message.msg.startswith("reconfigure refused, nothing changed: ")
                    and reason in message.msg
                    for message in log.messages
                ),
                "a warning with '%s'; there are %s"
                % (reason, [message.msg for message in log.messages]),
            )
            self.assertEqual(answer, before, refused)
            self.assertEqual(answer["hamaker_constant"], 65e-21, refused)
        # So does a name that is none, one of another type, and one that comes twice: no client of
        # dynamic_reconfigure sends these.
        raw = rospy.ServiceProxy("stiction_node/set_parameters", Reconfigure)
        for doubles, ints, reason in (
            ({"nosuch": 1.0}, {}, "'nosuch' is no setting"),
            ({}, {"travel": 5}, "'travel' is given as an int"),
        ):
            del log.messages[:]
            wanted = Config()
            wanted.doubles = [DoubleParameter(*item) for item in doubles.items()]
            wanted.doubles.append(DoubleParameter("voltage", 12.0))
            wanted.ints = [IntParameter(*item) for item in ints.items()]
            raw(wanted)
            wait_until(
                lambda reason=reason: any(reason in message.msg for message in log.messages),
                "a warning with '%s'" % reason,
            )
            self.assertEqual(self.settings.get_configuration()["voltage"], 3.0)
            self.assertFalse(any("__fromMessage__" in message.msg for message in log.messages))
        load = self.get_load()
        self.assertEqual((load.voltage, load.mechanical_load), (3.0, LOAD))
        self.assertTrue(self.set_load(0.0, LOAD).success)

    def test_3b_a_load_that_is_set_meanwhile_takes_no_other_setting_back(self):
        self.live(rough_surface(1, rows=256, cols=256))  # predicted twice for each new load
        is_over = threading.Event()

        def set_loads():
            load = 0
            while not is_over.is_set():
                load += 1
                self.assertTrue(self.set_load(0.0, LOAD + 1e-12 * (load % 7)).success)

        setter = threading.Thread(target=set_loads)
        setter.start()
        try:
            for number in range(40):
                work = 0.05 + 0.001 * (number % 5 + 1)
                self.assertEqual(
                    self.settings.update_configuration({"work_of_adhesion": work})[
                        "work_of_adhesion"
                    ],
                    work,
                )
                time.sleep(0.01)
                self.assertEqual(
                    self.settings.update_configuration({"hamaker_constant": 65e-21})[
                        "work_of_adhesion"
                    ],
                    work,
                )
        finally:
            is_over.set()
            setter.join()
        self.settings.update_configuration({"work_of_adhesion": 0.05})
        self.assertTrue(self.set_load(0.0, LOAD).success)

    def test_4_a_sweep_of_the_last_scan(self):
        surface = rough_surface(2)
        self.assertEqual(self.get_load().voltage, 0.0)
        live = self.live(surface)
        cleaned = self.cleaned()
        state, result, feedback = self.run_goal(
            self.sweep, SweepLoadGoal(voltages=[0.0, 10.0, 20.0])
        )
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        self.assertEqual(result.header.stamp, live.header.stamp)
        self.assertEqual([point.voltage for point in result.points], [0.0, 10.0, 20.0, 10.0, 0.0])
        self.assertEqual(
            [point.direction for point in result.points],
            [SweepPoint.UP] * 3 + [SweepPoint.DOWN] * 2,
        )
        self.assertEqual(result.points[0].pull_off_force, live.pull_off_force)
        self.assertEqual(len(result.summaries), 1)
        self.assertGreater(result.pull_in_voltage, 0.0)
        self.assert_progress(feedback, 5)
        # A given scan, and the sweep leaves no trace.
        other = image_message(rough_surface(3), rospy.Time(5))
        state, given, _ = self.run_goal(
            self.sweep,
            SweepLoadGoal(
                voltages=[0.0],
                mechanical_loads=[LOAD, 2 * LOAD],
                height=other,
                scan_info=info_message(rospy.Time(5)),
            ),
        )
        self.assertEqual(state, GoalStatus.SUCCEEDED, given.message)
        self.assertEqual(len(given.points), 2)
        self.assertEqual(given.header.stamp, rospy.Time(5))
        self.assert_first_contacts(given.points, rough_surface(3), [LOAD, 2 * LOAD])
        self.assertEqual(self.set_load(0.0, LOAD).prediction.pull_off_force, live.pull_off_force)
        # Cleaned: the given scan and the next one; the last one was when it came.
        self.live(surface)
        self.assertEqual(self.cleaned(), cleaned + 2)

    def test_4b_a_sweep_of_a_beam_says_where_it_lands_and_opens(self):
        surface = rough_surface(2)
        beam = dict(
            beam_type="cantilever",
            beam_length=1e-4,
            beam_width=2e-5,
            beam_thickness=2e-6,
            beam_gap=1e-6,
            beam_modulus=160e9,
            electrode_start=2e-5,
            electrode_length=8e-5,
        )
        self.settings.update_configuration(
            dict(beam, spring_stiffness=0.0, travel=0.0, electrode_area=0.0)
        )
        try:
            self.assertGreater(self.live(surface).peel_number, 0.0)
            state, result, _ = self.run_goal(
                self.sweep, SweepLoadGoal(voltages=[0.0, 10.0, 40.0], mechanical_loads=[0.0, LOAD])
            )
            self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
            self.assertEqual(result.pull_in_reason, "")
            self.assertTrue(10.0 < result.pull_in_voltage < 40.0, result.pull_in_voltage)
            self.assertEqual(
                [point.lands for point in result.points[:3]],
                [SweepPoint.LANDS_NO, SweepPoint.LANDS_NO, SweepPoint.LANDS_YES],
            )
            pressed = result.points[5]
            self.assertEqual(pressed.mechanical_load, LOAD)
            self.assertTrue(pressed.margin > 1.0 and pressed.peel_number > 1.0, pressed)
            last = result.points[4]
            self.assertTrue(
                last.is_open,
                "nothing but adhesion holds at 0 V, and the beam is stronger: margin %g, peel "
                "number %g" % (last.margin, last.peel_number),
            )
            self.assertEqual(
                (last.lands, result.summaries[0].opening_voltage),
                (
                    SweepPoint.LANDS_NO,
                    max(point.voltage for point in result.points[:5] if point.is_open),
                ),
            )
            self.settings.update_configuration({"electrode_area": 1e-8})
            self.assertEqual(
                self.settings.get_configuration()["electrode_area"],
                0.0,
                "refused: the beam's electrode is stated otherwise",
            )
            self.settings.update_configuration({"electrode_length": 0.0})
            state, result, _ = self.run_goal(self.sweep, SweepLoadGoal(voltages=[0.0]))
            self.assertEqual(
                (state, result.pull_in_reason), (GoalStatus.SUCCEEDED, "device/electrode_length")
            )
            self.assertEqual(result.points[0].lands, SweepPoint.LANDS_UNKNOWN)
        finally:
            self.settings.update_configuration(dict(DEVICE, beam_type="none"))

    def test_5_refused_goals_say_why(self):
        for goal, reason in (
            (SweepLoadGoal(), "voltages"),
            (SweepLoadGoal(voltages=[51.0]), "voltage"),
            (SweepLoadGoal(voltages=[2.0, 1.0]), "voltages"),
        ):
            state, result, _ = self.run_goal(self.sweep, goal)
            self.assertEqual(state, GoalStatus.ABORTED)
            self.assertIn(reason, result.message)
            self.assertNotIn("\n", result.message)
        state, result, _ = self.run_goal(self.sweep, SweepLoadGoal(voltages=1000000 * [5.0]))
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertIn(
            "must ascend (and 999998 more such values)", result.message
        )  # the answer had 53 MB
        self.assertLess(len(result.message), 500)
        state, result, _ = self.run_goal(self.cycle, CycleContactGoal(count=0))
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertIn("count", result.message)

    def test_5_refused_goals_reach_a_client_that_is_slow_to_take_its_handle(self):
        send_goal = self.sweep.action_client.send_goal

        def send_slowly(*arguments):
            handle = send_goal(*arguments)
            time.sleep(0.03)  # on a busy machine; the simple client misses what comes meanwhile
            return handle

        self.sweep.action_client.send_goal = send_slowly
        try:
            self.assertEqual(self.run_goal(self.sweep, SweepLoadGoal())[0], GoalStatus.ABORTED)
        finally:
            self.sweep.action_client.send_goal = send_goal

    def test_5_a_goal_that_states_more_than_it_holds_is_rejected(self):
        goal = SweepLoadActionGoal()
        goal.goal_id.id = "hostile"
        process = process_of("prediction")
        before = peak_memory(process)
        results = Collector("stiction_node/sweep_load/result", SweepLoadActionResult).connect()
        hostile = BytesPublisher("stiction_node/sweep_load/goal", SweepLoadActionGoal)
        hostile.publish(
            stating(
                2**29 - 1, bytes_of(goal), len(bytes_of(goal.header)) + len(bytes_of(goal.goal_id))
            )
        )
        status = results.wait(1)[0].status
        self.assertEqual((status.goal_id.id, status.status), ("hostile", GoalStatus.REJECTED))
        self.assertIn("states 536870911 elements", status.text)
        self.assertLess(peak_memory(process) - before, 2**28)
        hostile.end()

    def test_6_cycles_of_the_last_scan(self):
        live = self.live(rough_surface(2))
        state, result, feedback = self.run_goal(self.cycle, CycleContactGoal(count=4))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        self.assertEqual([cycle.cycle for cycle in result.cycles], [1, 2, 3, 4])
        self.assertEqual(result.cycles[0].pull_off_force, live.pull_off_force)
        self.assert_progress(feedback, 4)

    def test_7_scans_go_on_beside_an_action_and_it_can_be_cancelled(self):
        surface = rough_surface(4, rows=128, cols=128)
        self.live(surface)
        predicted = len(self.predictions.messages)
        for client, goal in (
            (self.cycle, CycleContactGoal(count=1000000)),
            (self.sweep, SweepLoadGoal(voltages=[i * 1e-4 for i in range(200000)])),
        ):
            feedback = []
            client.send_goal(goal, feedback_cb=feedback.append)
            wait_until(lambda: len(feedback) > 1, "progress")
            for _ in range(5):
                self.station.send(surface)
            self.predictions.wait(predicted + 5)
            predicted += 5
            self.assertEqual(client.get_state(), GoalStatus.ACTIVE)
            begin = time.monotonic()
            client.cancel_goal()
            self.assertTrue(client.wait_for_result(rospy.Duration(TIMEOUT)))
            self.assertLess(time.monotonic() - begin, 30.0)  # hours of work otherwise
            self.assertEqual(client.get_state(), GoalStatus.PREEMPTED)
            result = client.get_result()
            self.assertEqual(result.message, "cancelled")
            self.assertGreater(len(getattr(result, "cycles", None) or result.points), 0)
        self.counts.wait(predicted=predicted, dropped=0, rejected=0)

    def test_7_the_figures_of_an_action_are_those_of_the_command_line_under_traffic(self):
        # 64FC1 and 32FC1 are shown, not copied: nothing may change or go while an action works on
        # them
        self.set_load(0.0, LOAD)
        surfaces = [rough_surface(seed, rows=96, cols=128) for seed in range(20, 24)]
        surfaces[2:] = [surface.astype(float) for surface in surfaces[2:]]
        expected = [predict_scan(surface, LOAD) for surface in surfaces]
        encodings = {"float32": "32FC1", "float64": "64FC1"}
        stamp = rospy.Time(7)
        goals = []
        for surface in surfaces:
            given = dict(
                height=image_message(surface, stamp, encodings[str(surface.dtype)]),
                scan_info=info_message(stamp),
            )
            goals.append(
                (SweepLoadGoal(voltages=[0.0, 5.0], **given), CycleContactGoal(count=3, **given))
            )
        quiet = [self.run_goal(self.cycle, cycle)[1].cycles for _, cycle in goals]
        with Traffic(self.station, surfaces[:2], predictions=self.predictions) as traffic:
            for (sweep, cycle), record, alone in list(zip(goals, expected, quiet)) * 3:
                state, swept, _ = self.run_goal(self.sweep, sweep)
                self.assertEqual(state, GoalStatus.SUCCEEDED, swept.message)
                self.assertEqual(swept.points[0].pull_off_force, record["pull_off_force"])
                self.assertEqual(swept.points[0].contact_area, record["contact_area"])
                state, cycled, _ = self.run_goal(self.cycle, cycle)
                self.assertEqual(state, GoalStatus.SUCCEEDED, cycled.message)
                self.assertEqual(cycled.cycles[0].pull_off_force, record["pull_off_force"])
                self.assertEqual(
                    str(cycled.cycles), str(alone)
                )  # NaN differs from itself, its digits do not
            for _ in range(6):  # the last scan, whichever that is
                state, swept, _ = self.run_goal(self.sweep, SweepLoadGoal(voltages=[0.0, 5.0]))
                self.assertEqual(state, GoalStatus.SUCCEEDED, swept.message)
                self.assert_first_contacts(swept.points, traffic.sent[swept.header.stamp], [LOAD])
                state, cycled, _ = self.run_goal(self.cycle, CycleContactGoal(count=2))
                self.assertEqual(state, GoalStatus.SUCCEEDED, cycled.message)
                record = predict_scan(traffic.sent[cycled.header.stamp], LOAD)
                self.assertEqual(cycled.cycles[0].pull_off_force, record["pull_off_force"])
        self.counts.wait(dropped=0)

    def test_8_a_new_goal_takes_the_place_of_the_one_that_runs(self):
        self.cycle.send_goal(CycleContactGoal(count=1000000))
        other = actionlib.SimpleActionClient("stiction_node/cycle_contact", CycleContactAction)
        self.assertTrue(other.wait_for_server(rospy.Duration(TIMEOUT)))
        state, result, _ = self.run_goal(other, CycleContactGoal(count=2))
        self.assertEqual(state, GoalStatus.SUCCEEDED, result.message)
        self.assertEqual(len(result.cycles), 2)

    def test_8_a_cancel_of_a_wild_stamp_ends_what_runs_and_no_later_goal(self):
        goal = SweepLoadGoal(voltages=[0.0, 1.0], mechanical_loads=[LOAD])
        self.live(rough_surface(1))
        log = Collector("/rosout", Log)
        cancel = rospy.Publisher("stiction_node/sweep_load/cancel", GoalID, queue_size=1)
        wait_until(cancel.get_num_connections, "the node to listen to cancels")
        cancel.publish(GoalID(stamp=rospy.Time(2**32 - 1)))
        wait_until(
            lambda: any(
                "a cancel of sweep_load has a stamp that is yet to come" in message.msg
                for message in log.messages
            ),
            "the warning",
        )
        self.assertEqual(self.run_goal(self.sweep, goal)[0], GoalStatus.SUCCEEDED)
        # a goal of such a stamp is not for ever newer than those that follow
        wild = SweepLoadActionGoal(goal=goal)
        wild.goal_id.id, wild.goal_id.stamp = "wild", rospy.Time(2**32 - 1)
        results = Collector("stiction_node/sweep_load/result", SweepLoadActionResult).connect()
        self.sweep.action_client.pub_goal.publish(wild)
        self.assertEqual(results.wait(1)[0].status.status, GoalStatus.SUCCEEDED)
        self.assertEqual(self.run_goal(self.sweep, goal)[0], GoalStatus.SUCCEEDED)
        # one of the time of a goal that runs cancels it, as ever
        self.sweep.send_goal(
            SweepLoadGoal(voltages=[0.001 * step for step in range(10000)], mechanical_loads=[LOAD])
        )
        wait_until(lambda: self.sweep.get_state() == GoalStatus.ACTIVE, "the goal to run")
        cancel.publish(GoalID(stamp=rospy.Time.now()))
        self.assertTrue(self.sweep.wait_for_result(rospy.Duration(TIMEOUT)))
        self.assertEqual(self.sweep.get_state(), GoalStatus.PREEMPTED)
        self.assertEqual(self.run_goal(self.sweep, goal)[0], GoalStatus.SUCCEEDED)

    def test_9_the_node_ends_while_an_action_runs(self):
        import rosnode

        feedback = []
        self.cycle.send_goal(CycleContactGoal(count=1000000), feedback_cb=feedback.append)
        wait_until(lambda: feedback, "progress")
        manager = "/stiction_node_manager"
        name = manager if manager in rosnode.get_node_names() else "/stiction_node"
        rosnode.kill_nodes([name])
        wait_until(lambda: name not in rosnode.get_node_names(), "%s to end" % name)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "station", StationTest)
