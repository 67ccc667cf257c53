#!/usr/bin/env python3
"""The services: what they set, what they refuse, and that their predictions are the topic's."""

import math
import subprocess
import unittest

import numpy as np
import rospy
import rosservice
import rostest
import yaml
from mems_stiction.msg import ScanInfo, StictionPrediction
from mems_stiction.srv import (
    GetLoad,
    GetPrediction,
    Predict,
    SetLoad,
    SetMechanicalLoad,
    SetVoltage,
)
from roscpp.srv import GetLoggers, SetLoggerLevel
from rosgraph_msgs.msg import Log
from std_msgs.msg import String
from std_srvs.srv import Trigger
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    Station,
    figures,
    image_message,
    info_message,
    rough_surface,
    wait_until,
)

LOAD = 1e-6


class ServicesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("services_test")
        cls.counts = Counts()
        cls.log = Collector("/rosout", Log)
        for name in ("set_load", "get_load", "predict", "reset_surface"):
            rospy.wait_for_service("stiction_node/" + name, timeout=TIMEOUT)
        cls.set_load = rospy.ServiceProxy("stiction_node/set_load", SetLoad)
        cls.set_voltage = rospy.ServiceProxy("stiction_node/set_voltage", SetVoltage)
        cls.set_mechanical_load = rospy.ServiceProxy(
            "stiction_node/set_mechanical_load", SetMechanicalLoad
        )
        cls.get_load = rospy.ServiceProxy("stiction_node/get_load", GetLoad)
        cls.get_prediction = rospy.ServiceProxy("stiction_node/get_prediction", GetPrediction)
        cls.predict = rospy.ServiceProxy("stiction_node/predict", Predict)
        cls.reset_surface = rospy.ServiceProxy("stiction_node/reset_surface", Trigger)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()

    def setUp(self):
        self.assertTrue(self.set_load(0.0, LOAD).success)

    def send(self, heights):
        """Sends one scan and returns its prediction."""
        before = len(self.predictions.messages)
        stamp = self.station.send(heights)
        prediction = self.predictions.wait(before + 1)[before]
        self.assertEqual(prediction.header.stamp, stamp)
        return prediction

    def assert_load(self, voltage, mechanical_load):
        load = self.get_load()
        self.assertEqual((load.voltage, load.mechanical_load), (voltage, mechanical_load))
        self.assertEqual((load.max_voltage, load.max_mechanical_load), (50.0, 1e-3))

    def test_1_set_load_before_any_scan_sets_and_says_that_there_is_no_prediction(self):
        self.assert_load(0.0, LOAD)
        answer = self.set_load(1.0, LOAD)
        self.assertTrue(answer.success)
        self.assertIn("no scan yet", answer.message)
        self.assertEqual(answer.prediction.status, StictionPrediction.NO_EQUILIBRIUM)
        self.assert_load(1.0, LOAD)
        answer = self.get_prediction()
        self.assertEqual(
            (answer.success, answer.message, len(answer.prediction.curve)),
            (False, "no scan yet", 0),
        )

    def test_1b_who_asks_for_loggers_again_and_again_does_not_end_the_node(self):
        process = "stiction_node"
        if "/stiction_node_manager/get_loggers" in rosservice.get_service_list():
            process = "stiction_node_manager"  # of the nodelet
        get_loggers = rospy.ServiceProxy(process + "/get_loggers", GetLoggers)
        set_level = rospy.ServiceProxy(process + "/set_logger_level", SetLoggerLevel)
        for _ in range(5):
            loggers = {logger.name: logger.level for logger in get_loggers().loggers}
            self.assertEqual(loggers["ros.mems_stiction"], "info")
        set_level("ros.mems_stiction", "warn")
        levels = {logger.name: logger.level for logger in get_loggers().loggers}
        self.assertEqual((levels["ros.mems_stiction"], levels["ros"]), ("warn", "info"))
        set_level("ros.mems_stiction", "info")

    def test_2_set_load_predicts_the_last_scan_and_the_force_goes_with_the_square_of_the_voltage(
        self,
    ):
        surface = rough_surface(2)
        at_rest = self.send(surface)
        self.assertEqual(at_rest.electrostatic_force, 0.0)
        published = len(self.predictions.messages)
        # So small that the surfaces do not come nearer: only the voltage differs.
        once, twice = (self.set_load(voltage, LOAD).prediction for voltage in (1e-3, 2e-3))
        self.assertEqual(once.header.stamp, at_rest.header.stamp)
        self.assertEqual(once.voltage, 1e-3)
        self.assertGreater(once.electrostatic_force, 0.0)
        self.assertAlmostEqual(
            twice.electrostatic_force / once.electrostatic_force, 4.0, delta=1e-9
        )
        # The closed form for a gap that is small against the insulator: eps0 A U^2 / (2 (t /
        # eps_r)^2).
        plates = 8.8541878128e-12 * once.nominal_area * once.voltage**2 / (2 * (100e-9 / 3.9) ** 2)
        self.assertLess(once.electrostatic_force, plates)
        self.assertGreater(once.electrostatic_force, 0.2 * plates)
        # A voltage that counts never takes them apart.
        strong = self.set_load(50.0, LOAD).prediction
        strong.curve = self.get_prediction().prediction.curve
        self.assertGreater(strong.electrostatic_force, LOAD)
        self.assertAlmostEqual(
            strong.normal_load,
            strong.electrostatic_force + strong.van_der_waals_force + LOAD,
            delta=1e-9 * strong.normal_load,
        )
        self.assertGreater(strong.contact_area, at_rest.contact_area)
        # The next scan is predicted with it, the same to the last bit.
        self.assertEqual(len(self.predictions.messages), published)
        live = self.send(surface)
        live.header = strong.header
        self.assertEqual(figures(live), figures(strong))

    def test_3_a_refused_value_changes_nothing(self):
        surface = rough_surface(3)
        before = self.send(surface)
        refused = [
            (51.0, LOAD, "voltage"),
            (-51.0, LOAD, "voltage"),
            (math.nan, LOAD, "voltage"),
            (math.inf, LOAD, "voltage"),
            (1.0, -1e-9, "mechanical_load"),
            (1.0, 2e-3, "mechanical_load"),
            (1.0, math.nan, "mechanical_load"),
        ]
        for voltage, load, name in refused:
            answer = self.set_load(voltage, load)
            self.assertFalse(answer.success, (voltage, load))
            self.assertIn(name, answer.message)
            self.assert_load(0.0, LOAD)
        after = self.send(surface)
        after.header = before.header
        self.assertEqual(figures(after), figures(before))

    def test_3b_one_load_alone_leaves_the_other_and_says_what_it_changes(self):
        self.send(rough_surface(3))
        answer = self.set_voltage(10.0)
        self.assertTrue(answer.success)
        self.assert_load(10.0, LOAD)
        for words in (
            "voltage from 0 V to 10 V",
            "mechanical load stays at 1e-06 N",
            "electrostatic force from 0 N to",
        ):
            self.assertIn(words, answer.message)
        self.assertTrue(self.set_mechanical_load(2e-6).success)
        self.assert_load(10.0, 2e-6)
        self.assertEqual(self.set_mechanical_load(2e-6).prediction.voltage, 10.0)
        self.assertIn("~set_voltage leaves it", self.set_load(5.0, 0.0).message)
        for answer, name in (
            (self.set_voltage(51.0), "voltage"),
            (self.set_mechanical_load(math.nan), "mechanical_load"),
        ):
            self.assertFalse(answer.success)
            self.assertIn(name, answer.message)
        self.assert_load(5.0, 0.0)

    def test_3b_answers_to_loads_are_short_and_the_curve_has_a_call_of_its_own(self):
        live = self.send(rough_surface(3))
        self.assertGreater(len(live.curve), 0)
        answer = self.get_prediction()
        self.assertTrue(answer.success, answer.message)
        answer.prediction.header.seq = live.header.seq
        self.assertEqual(figures(answer.prediction), figures(live))
        for answer in (
            self.set_load(0.0, LOAD),
            self.set_voltage(0.0),
            self.set_mechanical_load(LOAD),
        ):
            self.assertEqual(len(answer.prediction.curve), 0)
            answer.prediction.curve = live.curve
            self.assertEqual(figures(answer.prediction), figures(live))
        self.set_voltage(10.0)
        answer = self.get_prediction()
        self.assertEqual(answer.prediction.voltage, 10.0)
        self.assertGreater(len(answer.prediction.curve), 0)
        shown = subprocess.run(
            ["rosservice", "call", "/stiction_node/set_voltage", "10"],
            stdout=subprocess.PIPE,
            universal_newlines=True,
            timeout=TIMEOUT,
            check=True,
        ).stdout
        self.assertLess(len(shown.splitlines()), 200)

    def test_3b_a_summary_is_one_line_for_each_scan(self):
        summaries = Collector("summary", String).connect()
        prediction = self.send(rough_surface(3))
        line = summaries.wait(1)[0].data
        self.assertRegex(
            line,
            "^scan: sticks unknown \\(.*\\); pull-off force [0-9.e-]+ N; %d contacts?;"
            % prediction.asperity_count,
        )
        self.assertAlmostEqual(
            float(line.split("pull-off force ")[1].split(" N")[0]) / prediction.pull_off_force,
            1.0,
            delta=0.006,
        )
        for flag in prediction.flags:
            self.assertIn("; " + flag, line)
        self.assertNotIn("\n", line)

    def test_3b_what_rosservice_leaves_out_is_said_and_set_alone_elsewhere(self):
        def call(service, request):
            answer = subprocess.run(
                ["rosservice", "call", "/stiction_node/" + service, request],
                stdout=subprocess.PIPE,
                universal_newlines=True,
                timeout=TIMEOUT,
                check=True,
            ).stdout
            return yaml.safe_load(answer.split("\nprediction:")[0])["message"]

        self.send(rough_surface(3))
        answer = call("set_load", "voltage: 20")
        self.assertIn("voltage from 0 V to 20 V; mechanical load from 1e-06 N to 0 N;", answer)
        self.assertIn(
            "; warning: the mechanical load was set to 0, as whatever a call of ~set_load leaves "
            "out (~set_voltage leaves it as it is)",
            answer,
        )
        self.assert_load(20.0, 0.0)
        answer = call("set_load", "mechanical_load: 1.0e-6")
        self.assertIn("voltage from 20 V to 0 V; mechanical load from 0 N to 1e-06 N;", answer)
        self.assertIn("(~set_mechanical_load leaves it as it is)", answer)
        answer = call("set_voltage", "voltage: 20")
        self.assertIn("voltage from 0 V to 20 V; mechanical load stays at 1e-06 N", answer)
        self.assert_load(20.0, LOAD)

    def test_3c_no_text_breaks_the_columns_of_rostopic_echo(self):
        prediction = self.send(rough_surface(3))
        texts = (
            [prediction.reason] + prediction.preprocessing + prediction.warnings + prediction.flags
        )
        self.assertFalse([text for text in texts if "," in text])
        self.assertEqual(prediction.scan_name, "scan")
        self.assertRegex(prediction.settings_hash, "^[0-9a-f]{16}$")

    def test_3d_what_was_scanned_and_slips_of_units_are_in_the_answer(self):
        info = info_message(rospy.Time(4))
        info.scan_name, info.part_id, info.serial_id = "place 2", "lot 3", "0012"
        info.lot_id, info.wafer_id, info.site_y, info.operator_name = "L7", "W3", -5e-3, "ann"
        answer = self.predict(image_message(rough_surface(4), info.header.stamp), info, 0.0, LOAD)
        self.assertEqual(answer.message, "")
        prediction = answer.prediction
        self.assertEqual(
            (prediction.scan_name, prediction.part_id, prediction.serial_id),
            ("place 2", "lot 3", "0012"),
        )
        self.assertEqual(
            (
                prediction.lot_id,
                prediction.wafer_id,
                prediction.site_x,
                prediction.site_y,
                prediction.operator_name,
            ),
            ("L7", "W3", 0.0, -5e-3, "ann"),
        )
        info.site_x = math.nan
        refused = self.predict(image_message(rough_surface(4), info.header.stamp), info, 0.0, LOAD)
        self.assertFalse(refused.success)
        self.assertIn("scan_info.site_y: -0.005 is stated without site_x", refused.message)
        info.site_x = 0.0
        counts = (
            (np.arange(48 * 64) % 251).astype(np.uint8).reshape(48, 64)
        )  # counts that pass for metres
        refused = self.predict(image_message(counts, info.header.stamp, "mono8"), info, 0.0, LOAD)
        self.assertFalse(refused.success)
        self.assertIn("taken for metres", refused.message)
        self.assertIn("limits/accept_implausible", refused.message)
        flat = rough_surface(4, rms_height=1e-14)  # too smooth for any instrument
        answer = self.predict(image_message(flat, info.header.stamp), info, 0.0, LOAD)
        self.assertTrue(answer.success)
        self.assertIn("is unusual", answer.message)
        self.assertTrue(any("is unusual" in text for text in answer.prediction.warnings))
        # A live one has the same in its message, and in the log; one that is implausible is
        # rejected.
        rejected = self.station.stamp()
        self.station.height.publish(image_message(counts, rejected, "mono8"))
        self.station.info.publish(info_message(rejected))
        stamp = self.station.stamp()
        self.station.height.publish(image_message(flat, stamp))
        self.station.info.publish(info_message(stamp))
        wait_until(lambda: self.predictions.messages[-1].header.stamp == stamp, "the prediction")
        self.assertEqual(self.predictions.messages[-1].warnings, answer.prediction.warnings)
        self.assertNotIn(rejected, [message.header.stamp for message in self.predictions.messages])
        for said, words in ((stamp, "is unusual"), (rejected, "taken for metres")):
            wait_until(
                lambda: any(
                    message.level == Log.WARN
                    and "stamp %d.000000000" % said.secs in message.msg
                    and words in message.msg
                    for message in self.log.messages
                ),
                "a warning in the log",
            )

    def test_4_predict_equals_the_topic_bit_for_bit_and_leaves_no_trace(self):
        surface = rough_surface(4)
        live = self.send(surface)
        published = len(self.predictions.messages)
        image = image_message(surface, live.header.stamp)
        info = info_message(live.header.stamp)
        answer = self.predict(image, info, 0.0, LOAD)
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(figures(answer.prediction), figures(live))

        other = self.predict(image_message(rough_surface(5), rospy.Time(5)), info, 10.0, 2e-6)
        self.assertTrue(other.success, other.message)
        self.assertEqual(other.prediction.voltage, 10.0)
        self.assert_load(0.0, LOAD)
        self.assertEqual(figures(self.get_prediction().prediction), figures(live))
        self.assertEqual(len(self.predictions.messages), published)

    def test_5_predict_refuses_with_a_reason(self):
        surface = rough_surface(6)
        info = info_message(rospy.Time(6))
        for image, scan_info, voltage, reason in [
            (image_message(surface, rospy.Time(6), "rgb8"), info, 0.0, "32FC1"),
            (image_message(surface, rospy.Time(6)), ScanInfo(), 0.0, "pitch"),
            (image_message(np.full_like(surface, np.nan), rospy.Time(6)), info, 0.0, "valid"),
            (image_message(surface, rospy.Time(6)), info, 51.0, "voltage"),
        ]:
            answer = self.predict(image, scan_info, voltage, LOAD)
            self.assertFalse(answer.success)
            self.assertIn(reason, answer.message)
        self.counts.wait(rejected=1)  # the implausible one of the topic

    def test_6_reset_surface_answers(self):
        self.assertTrue(self.reset_surface().success)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "services", ServicesTest)
