#!/usr/bin/env python3
"""Every entrance of the node gives the figures of predict_scan and of the Python module, to the
bit, while scans come in and settings change."""

import pathlib
import unittest
import warnings

import actionlib
import dynamic_reconfigure.client
import mems_stiction
import numpy as np
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from mems_stiction.msg import (
    AsperityArray,
    CycleContactAction,
    CycleContactGoal,
    StictionPrediction,
    SweepLoadAction,
    SweepLoadGoal,
)
from mems_stiction.srv import Predict, SetLoad, SetMechanicalLoad, SetVoltage
from sensor_msgs.msg import Image
from stiction_client import (
    PITCH,
    TIMEOUT,
    Collector,
    Counts,
    OwnNode,
    Station,
    Traffic,
    image_message,
    info_message,
    needs_module,
    predict_scan,
    rough_surface,
    settings_of,
    unlike,
    wait_until,
)

LOAD = 1e-6
DEVICE_STATION = pathlib.Path(__file__).with_name("device_station.yaml")
SETTINGS = settings_of(DEVICE_STATION)
# Of each setting that changes while the node runs another value than that of device_station.yaml.
CHANGED = {
    "load/voltage": 7.0,
    "load/contact_potential": 3.0,
    "load/mechanical_load": 3e-6,
    "load/max_voltage": 40.0,
    "load/max_mechanical_load": 2e-3,
    "interface/work_of_adhesion": 0.02,
    "interface/hamaker_constant": 3e-20,
    "interface/retardation_length": 3e-8,
    "paper/cutoff_distance": 0.3e-9,
    "paper/step": 1e-10,
    "interface/equilibrium_distance": 0.25e-9,
    "interface/insulator_thickness": 50e-9,
    "interface/insulator_relative_permittivity": 7.0,
    "interface/hardness_ratio_limit": 0.6,
    "interface/relative_humidity": 0.4,
    "interface/surface_tension": 0.03,
    "interface/contact_angle": 0.5,
    "interface/temperature": 350.0,
    "interface/molar_volume": 3e-5,
    "interface/water_film": 5e-10,
    "device/spring_stiffness": 5.0,
    "device/travel": 2e-6,
    "device/contact_area": 2e-12,
    "device/contacts": 3,
    "device/electrode_area": 2e-8,
    "device/electrode_gap": 3e-6,
    "device/electrode_start": 1e-5,
    "device/beam_residual_stress": 1e6,
    "device/apparent_work_of_adhesion": 1e-3,
    "device/guidance": "free",
}
BEAM = {
    "device/beam_type": "cantilever",
    "device/beam_length": 100e-6,
    "device/beam_thickness": 2e-6,
    "device/beam_gap": 2e-6,
    "device/beam_modulus": 160e9,
    "device/beam_width": 2e-5,
    "device/electrode_length": 5e-5,
}
CASES = [{key: value} for key, value in CHANGED.items()] + [
    {"load/mechanical_load": 0.0, "load/pressure": 5e6},
    {"load/mechanical_load": 0.0, "load/device_force": 2e-5},
    {"load/mechanical_load": 0.0, "load/device_force": 2e-5, "device/contact_area": 3e-12},
    BEAM,
    dict(BEAM, **{"device/beam_residual_stress": 1e6}),
]


def record(surface, load=LOAD, voltage=0.0, changes=None, counter=None):
    return predict_scan(
        surface, load, voltage, counter, ["--record-curve"], settings_of(DEVICE_STATION, changes)
    )


def rows_of(messages):
    """Every figure of sweep points, summaries or cycles, or of the Python module's records of them,
    NaN as None."""

    def plain(value):
        value = value.item() if hasattr(value, "item") else value
        return None if value != value else value

    return [
        {
            name: plain(getattr(message, name))
            for name in getattr(message, "__slots__", None) or message.dtype.names
        }
        for message in messages
    ]


class FiguresTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("figures_test")
        rospy.wait_for_service("stiction_node/predict", timeout=TIMEOUT)
        cls.counts = Counts()
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)
        cls.predict = rospy.ServiceProxy("stiction_node/predict", Predict)
        cls.set_load = rospy.ServiceProxy("stiction_node/set_load", SetLoad)
        cls.surfaces = [
            rough_surface(seed, rms_height=rms) for seed, rms in ((1, 2e-9), (2, 4e-9), (3, 8e-9))
        ]
        cls.surfaces[2][3:9, 5] = np.nan

    def setUp(self):
        self.counts.wait(
            received=self.station.count(), waiting=0
        )  # what the test before has sent is through

    def assert_same(self, message, expected, leaving_out=()):
        self.assertEqual(unlike(message, expected, leaving_out), [])

    def live(self, surface, station=None, predictions=None, encoding="32FC1", **info):
        """The prediction of a scan that is sent."""
        station, predictions = station or self.station, predictions or self.predictions
        count = len(predictions.messages)
        stamp = station.stamp()
        station.height.publish(image_message(surface, stamp, encoding))
        message = info_message(stamp)
        for name, value in info.items():
            setattr(message, name, value)
        station.info.publish(message)
        prediction = predictions.wait(count + 1)[count]
        self.assertEqual(prediction.header.stamp, stamp)
        return prediction

    def test_1_the_topic_in_every_encoding(self):
        heights = self.surfaces[0].astype(float)
        self.assert_same(self.live(self.surfaces[0]), record(self.surfaces[0]))
        self.assert_same(self.live(heights, encoding="64FC1"), record(heights))
        with_quality = np.dstack([self.surfaces[1], np.ones_like(self.surfaces[1])]).astype(
            np.float32
        )
        count = len(self.predictions.messages)
        stamp = self.station.stamp()
        image = image_message(self.surfaces[1], stamp, "32FC2")
        image.step, image.data = 8 * image.width, with_quality.tobytes()
        self.station.height.publish(image)
        self.station.info.publish(info_message(stamp))
        self.assert_same(self.predictions.wait(count + 1)[count], record(self.surfaces[1]))
        # A row with something behind it, the other order of bytes, counts with a scale.
        for change in ("step", "order"):
            count, stamp = len(self.predictions.messages), self.station.stamp()
            image = image_message(self.surfaces[1], stamp)
            if change == "step":
                rows = np.hstack([self.surfaces[1], np.full((48, 3), 1e-6, np.float32)])
                image.step, image.data = 4 * rows.shape[1], rows.tobytes()
            else:
                image.is_bigendian, image.data = 1, self.surfaces[1].byteswap().tobytes()
            self.station.height.publish(image)
            self.station.info.publish(info_message(stamp))
            self.assert_same(self.predictions.wait(count + 1)[count], record(self.surfaces[1]))
        low, scale = heights.min(), 1e-11
        for kind, encoding in (
            (np.uint16, "16UC1"),
            (np.uint16, "mono16"),
            (np.int16, "16SC1"),
            (np.uint8, "mono8"),
            (np.uint8, "8UC1"),
        ):
            step = scale if kind is not np.uint8 else 2e-10
            counts = np.round((heights - low) / step).clip(0, np.iinfo(kind).max).astype(kind)
            prediction = self.live(counts, encoding=encoding, height_scale=step, height_offset=low)
            self.assert_same(prediction, record(counts * step + low))
        self.counts.wait(rejected=0, dropped=0)

    @needs_module
    def test_2_the_pitch_along_columns_is_not_that_along_rows_and_warnings_are_the_same(self):
        prediction = self.live(self.surfaces[0], pitch_x=2e-8, pitch_y=1e-8)
        config = settings_of(DEVICE_STATION)
        expected = mems_stiction.predict(self.surfaces[0], pitch=(2e-8, 1e-8), config=config)
        for name in ("pull_off_force", "contact_area", "approach", "nominal_area", "rms_height"):
            self.assertEqual(getattr(prediction, name), getattr(expected, name), name)
        self.assertEqual(prediction.roughness.sdq, expected.roughness.sdq)
        answer = self.predict(
            image_message(self.surfaces[0], rospy.Time(7)), info_message(rospy.Time(7)), 0.0, 1e-3
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            expected = mems_stiction.predict(
                self.surfaces[0],
                PITCH,
                config=settings_of(DEVICE_STATION, {"load/mechanical_load": 1e-3}),
            )
        self.assertTrue(
            any("more than the hardness" in text for text in expected.warnings), expected.warnings
        )
        self.assertEqual(
            answer.prediction.warnings, [text.replace(",", ";") for text in expected.warnings]
        )
        self.assertEqual(answer.message, "; ".join(expected.warnings))

    def test_3_services_under_traffic(self):
        loads = [(0.0, LOAD), (5.0, 2e-6), (-3.0, 0.0)]
        expected = {
            (index, load): record(surface, load[1], load[0])
            for index, surface in enumerate(self.surfaces)
            for load in loads
        }
        set_voltage = rospy.ServiceProxy("stiction_node/set_voltage", SetVoltage)
        set_mechanical_load = rospy.ServiceProxy(
            "stiction_node/set_mechanical_load", SetMechanicalLoad
        )
        info = info_message(rospy.Time(7))
        first = len(self.predictions.messages)
        answers = []
        with Traffic(
            self.station, self.surfaces, period=0.01, predictions=self.predictions
        ) as traffic:
            for voltage, load in loads * 3:
                answers.append(set_voltage(voltage))
                answers.append(set_mechanical_load(load))
                self.assertEqual(
                    (answers[-1].prediction.voltage, answers[-1].prediction.mechanical_load),
                    (voltage, load),
                )
                self.predictions.wait(len(self.predictions.messages) + 3)
                for index, asked in expected:  # whatever load is set
                    answer = self.predict(
                        image_message(self.surfaces[index], rospy.Time(7)), info, *asked
                    )
                    self.assertTrue(answer.success, answer.message)
                    self.assertEqual(answer.prediction.header.stamp, rospy.Time(7))
                    self.assert_same(answer.prediction, expected[index, asked])
                answers.append(self.set_load(voltage, load))
        self.set_load(0.0, LOAD)
        wait_until(
            lambda: self.predictions.messages[-1].header.stamp == max(traffic.sent),
            "the last prediction",
        )
        live = self.predictions.messages[first:]
        self.assertEqual([message.header.stamp for message in live], sorted(traffic.sent))
        seen = set()
        for message in live + [answer.prediction for answer in answers if answer.success]:
            leaving_out = () if message.curve else ("curve",)  # answers to loads
            index = [
                surface is traffic.sent[message.header.stamp] for surface in self.surfaces
            ].index(True)
            load = (message.voltage, message.mechanical_load)
            if (index, load) not in expected:  # between two calls
                expected[index, load] = record(self.surfaces[index], load[1], load[0])
            self.assert_same(message, expected[index, load], leaving_out)
            seen.add(load)
        self.assertTrue(all(message.curve for message in live))
        self.assertLessEqual(set(loads), seen)
        self.assertTrue(all(answer.success for answer in answers))

    def test_4_every_setting_that_reconfigure_changes(self):
        names = {entry["name"] for entry in self.settings.get_parameter_descriptions()}
        self.assertEqual({key.split("/")[1] for changes in CASES for key in changes}, names)
        default = self.settings.get_configuration()
        expected = {}
        first = len(self.predictions.messages)
        with Traffic(
            self.station, self.surfaces[:1], period=0.01, predictions=self.predictions
        ) as traffic:
            for changes in CASES:
                self.settings.update_configuration(
                    {key.split("/")[1]: value for key, value in changes.items()}
                )
                before = traffic.newest
                one = record(self.surfaces[0], None, None, changes)
                expected[one["settings_hash"]] = one
                wait_until(
                    lambda: self.predictions.messages[-1].header.stamp > before,
                    "a scan that was sent afterwards",
                )
                self.assert_same(self.predictions.messages[-1], one)
                self.settings.update_configuration(
                    {name: default[name] for name in (key.split("/")[1] for key in changes)}
                )
        one = record(self.surfaces[0])
        expected[one["settings_hash"]] = one
        wait_until(
            lambda: self.predictions.messages[-1].header.stamp == max(traffic.sent),
            "the last prediction",
        )
        sent = self.predictions.messages[first:]
        self.assertEqual(len(sent), len(traffic.sent))
        for message in sent:  # settings change between two scans, and all of a case at once
            self.assert_same(message, expected[message.settings_hash])
        self.assertEqual({message.settings_hash for message in sent}, set(expected))
        self.assertEqual(len(expected), len(CASES) + 1)

    @needs_module
    def test_5_every_figure_of_both_actions_under_traffic(self):
        sweep = actionlib.SimpleActionClient("stiction_node/sweep_load", SweepLoadAction)
        cycle = actionlib.SimpleActionClient("stiction_node/cycle_contact", CycleContactAction)
        self.assertTrue(
            sweep.wait_for_server(rospy.Duration(TIMEOUT))
            and cycle.wait_for_server(rospy.Duration(TIMEOUT))
        )
        voltages, loads = [0.0, 4.0, 9.0], [LOAD, 4e-6]
        config = settings_of(DEVICE_STATION)
        swept, cycled = [], []
        for surface in self.surfaces:
            swept.append(
                mems_stiction.sweep_loads(
                    surface, PITCH, config, voltages=voltages, mechanical_loads=loads
                )
            )
            cycled.append(mems_stiction.cycle_contact(surface, PITCH, config, count=4))

        def run(client, goal):
            client.send_goal(goal)
            self.assertTrue(client.wait_for_result(rospy.Duration(TIMEOUT)), "no answer")
            self.assertEqual(client.get_state(), GoalStatus.SUCCEEDED, client.get_result().message)
            return client.get_result()

        with Traffic(
            self.station, self.surfaces, period=0.01, predictions=self.predictions
        ) as traffic:
            for given in [0, 1, 2, None, None, None]:
                goal = (
                    {}
                    if given is None
                    else dict(
                        height=image_message(self.surfaces[given], rospy.Time(9)),
                        scan_info=info_message(rospy.Time(9)),
                    )
                )
                result = run(
                    sweep, SweepLoadGoal(voltages=voltages, mechanical_loads=loads, **goal)
                )
                index = self.index_of(result, given, traffic)
                self.assertEqual(rows_of(result.points), rows_of(swept[index].points))
                self.assertEqual(rows_of(result.summaries), rows_of(swept[index].summaries))
                self.assertEqual(result.pull_in_voltage, swept[index].pull_in_voltage)
                result = run(cycle, CycleContactGoal(count=4, **goal))
                index = self.index_of(result, given, traffic)
                self.assertEqual(rows_of(result.cycles), rows_of(cycled[index].cycles))
                self.assertEqual(result.first_sticking_cycle, cycled[index].first_sticking_cycle)

    def index_of(self, result, given, traffic):
        if given is not None:
            self.assertEqual(result.header.stamp, rospy.Time(9))
            return given
        return [surface is traffic.sent[result.header.stamp] for surface in self.surfaces].index(
            True
        )

    @needs_module
    def test_6_maps_and_contacts(self):
        maps = {
            name: Collector(name, kind).connect()
            for name, kind in (
                ("deformed_height", Image),
                ("deformed_counter_height", Image),
                ("contact_map", Image),
                ("asperities", AsperityArray),
            )
        }
        for number, surface in enumerate(self.surfaces, start=1):
            message = self.live(surface)
            self.assert_same(message, record(surface))
            expected = mems_stiction.predict(surface, PITCH, config=settings_of(DEVICE_STATION))
            for name, array in (
                ("deformed_height", expected.deformed_lower),
                ("deformed_counter_height", expected.deformed_upper),
            ):
                image = maps[name].wait(number)[-1]
                self.assertEqual(
                    (image.header.stamp, image.encoding, image.height, image.width),
                    (message.header.stamp, "32FC1") + surface.shape,
                )
                self.assertEqual(bytes(image.data), array.astype(np.float32).tobytes(), name)
            image = maps["contact_map"].wait(number)[-1]
            self.assertEqual(
                (image.header.stamp, bytes(image.data)),
                (message.header.stamp, expected.contact_map.tobytes()),
            )
            contacts = maps["asperities"].wait(number)[-1].asperities
            rows = [dict(row) for row in rows_of(expected.asperities)]
            for row in rows:
                del row["is_at_border"]  # the core's own
            self.assertEqual(rows_of(contacts), rows)

    def test_6b_the_other_formulations_with_and_without_a_device(self):
        for formulation in ("paper", "printed"):
            for without_device in (False, True):
                changes = {"approach/formulation": formulation}
                if without_device:
                    changes.update({"device/spring_stiffness": 0.0})
                settings = settings_of(DEVICE_STATION, changes)
                name = formulation + ("_alone" if without_device else "")
                with OwnNode(name, **settings):
                    station, predictions = (
                        Station("/%s/" % name),
                        Collector("/%s/prediction" % name, StictionPrediction).connect(),
                    )
                    for surface in self.surfaces:
                        self.assert_same(
                            self.live(surface, station, predictions),
                            predict_scan(surface, LOAD, settings=settings),
                        )

    def test_7_a_counter_surface_and_a_node_without_scan_info(self):
        counters = [rough_surface(seed) for seed in (11, 12)]
        with OwnNode(
            "counter",
            **dict(SETTINGS, **{"counter_surface/type": "topic", "counter_surface/facing": "down"}),
        ):
            predictions = Collector("/counter/prediction", StictionPrediction).connect()
            station, counter_station = Station("/counter/"), Station("/counter/counter_")
            counts = Counts("counter/node")
            for number, counter in enumerate(counters, start=1):
                counter_station.send(counter)
                counts.wait(counter_surfaces=number)
                self.assert_same(
                    self.live(self.surfaces[0], station, predictions),
                    record(self.surfaces[0], counter=counter),
                    ["settings_hash"],
                )  # of a file's name
        single = dict(
            SETTINGS, **{"use_scan_info": False, "scan/pitch_x": PITCH, "scan/pitch_y": PITCH}
        )
        with OwnNode("single", **single):
            predictions = Collector("/single/prediction", StictionPrediction).connect()
            height = rospy.Publisher("/single/height", Image, queue_size=100)
            wait_until(height.get_num_connections, "the node to subscribe")
            scans = self.surfaces * 5
            for number, surface in enumerate(scans, start=1):
                height.publish(image_message(surface, rospy.Time(number)))
            expected = [
                record(surface, changes={"scan/pitch_x": PITCH, "scan/pitch_y": PITCH})
                for surface in self.surfaces
            ]
            for number, message in enumerate(predictions.wait(len(scans))):
                self.assertEqual(message.header.stamp, rospy.Time(number + 1))
                self.assert_same(message, expected[number % 3])


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "figures", FiguresTest)
