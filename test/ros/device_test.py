#!/usr/bin/env python3
"""The force of a device on its topic: that of the core for the same scans, with its verdict, beside
predictions that go on."""

import json
import math
import pathlib
import subprocess
import tempfile
import time
import unittest

import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import DeviceAdhesion, DeviceVerdict, PartVerdict, StictionPrediction
from mems_stiction.prediction_text import device_line
from mems_stiction.srv import SetMechanicalLoad
from roslib.packages import find_node
from stiction_client import (
    PITCH,
    Collector,
    OwnNode,
    Station,
    Traffic,
    image_message,
    info_message,
    rough_surface,
    settings_of,
    wait_for_listener,
    wait_until,
    write_grid,
)

CONFIG = pathlib.Path(__file__).with_name("device_part.yaml")
SMALL = 64  # pixels of a side
FIGURES = (
    "pull_off_force",
    "pull_off_force_lower",
    "pull_off_force_upper",
    "apparent_work_of_adhesion",
    "apparent_work_of_adhesion_lower",
    "apparent_work_of_adhesion_upper",
    "linear_pull_off_force",
    "contacts",
    "separation_at_rest",
    "is_conforming",
    "area",
    "pitch",
    "force_deviation",
)
STICKS = {"no": 0, "marginal": 1, "yes": 2, "unknown": 3}


def surface(seed, rms_height=2e-9):
    return rough_surface(seed, rows=SMALL, cols=SMALL, rms_height=rms_height)


def force_of(surfaces):
    """The record of predict_device for heights [m] in their order."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = [folder / ("%d.txt" % number) for number in range(len(surfaces))]
        for file, heights in zip(files, surfaces):
            write_grid(file, heights)
        (folder / "config.yaml").write_text(yaml.safe_dump(settings_of(CONFIG)))
        program = find_node("mems_stiction", "predict_device")[0]
        done = subprocess.run(
            [program, "--json", "--config", folder / "config.yaml", "--pitch", repr(PITCH), *files],
            check=True,
            timeout=60,
            stdout=subprocess.PIPE,
        )
    return json.loads(done.stdout)


class DeviceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("device_test")
        cls.reports = Collector("/diagnostics", DiagnosticArray)
        rospy.wait_for_service("stiction_node/set_mechanical_load", timeout=30.0)
        cls.set_load = rospy.ServiceProxy("stiction_node/set_mechanical_load", SetMechanicalLoad)
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=30.0)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.parts = Collector("part_verdict", PartVerdict).connect()
        cls.devices = Collector("device_force", DeviceAdhesion).connect()
        cls.verdicts = Collector("verdict", DeviceVerdict).connect()
        cls.station = Station()

    def counts(self, node="stiction_node"):
        """Values of the newest status, with its level and message."""
        for array in reversed(self.reports.messages):
            for status in array.status:
                if status.name == node + ": device_force":
                    return dict(
                        {entry.key: entry.value for entry in status.values},
                        level=status.level,
                        message=status.message,
                    )
        return {}

    def newest_counts(self):
        """Of a report that was made after this call."""
        self.reports.wait(len(self.reports.messages) + 2)
        return self.counts()

    def send(self, heights, part=("", "")):
        """Prediction and device of one scan, once both are there."""
        scans, devices = len(self.predictions.messages), len(self.devices.messages)
        stamp = self.station.stamp()
        info = info_message(stamp)
        info.part_id, info.serial_id = part
        self.station.height.publish(image_message(heights, stamp))
        self.station.info.publish(info)
        prediction, device = (
            self.predictions.wait(scans + 1)[scans],
            self.devices.wait(devices + 1)[devices],
        )
        self.assertEqual((prediction.header.stamp, device.header.stamp), (stamp, stamp))
        return prediction, device

    def verdicts_until_the_final_one(self, stamp):
        """Of the scan of this stamp; those of others may come between, as a half-space that took
        long."""

        def said():
            return [message for message in self.verdicts.messages if message.header.stamp == stamp]

        wait_until(lambda: said() and said()[-1].is_final, "the final verdict")
        return said()

    def assert_one_answer(self, prediction, device, scan_count):
        """The topic verdict has a provisional answer with the prediction, and a final one with the
        device's force."""

        said = self.verdicts_until_the_final_one(prediction.header.stamp)
        first, last = said[0], said[-1]
        self.assertEqual(
            (first.is_final, first.waits_for, first.word, first.by_device_force),
            (False, "device_force", "unknown", False),
        )
        self.assertEqual(
            (last.waits_for, last.by_device_force, last.scan_count), ("", True, scan_count)
        )
        self.assertEqual(
            (last.part_id, last.serial_id, last.scan_name),
            (prediction.part_id, prediction.serial_id, prediction.scan_name),
        )
        self.assertEqual((last.sticks, STICKS[last.word]), (device.sticks, device.sticks))
        for name in ("margin", "margin_lower", "margin_upper", "settings_hash", "version"):
            self.assertEqual(getattr(last, name), getattr(device, name), name)

    def assert_is_force_of(self, device, surfaces):
        self.assertEqual(
            (device.status, device.message, device.scan_count),
            (DeviceAdhesion.FOUND, "", len(surfaces)),
        )
        expected = force_of(surfaces)
        self.assertEqual(
            list(device.realisations), [made["pull_off_force"] for made in expected["realisations"]]
        )
        for name in FIGURES:
            self.assertEqual(getattr(device, name), expected[name], name)
        for name in ("margin", "margin_lower", "margin_upper", "restoring_force"):
            self.assertEqual(getattr(device, name), expected[name], name)
        self.assertEqual(device.sticks, STICKS[expected["sticks"]], device.reason)
        self.assertTrue(
            device.pull_off_force_lower < device.pull_off_force < device.pull_off_force_upper
        )

    def assert_judged(self, device):
        self.assertEqual(device.margin, device.restoring_force / device.pull_off_force)
        self.assertTrue(device.margin_lower < device.margin < device.margin_upper)
        for end, other in (("_lower", "_upper"), ("_upper", "_lower")):
            product = getattr(device, "margin" + end) * getattr(device, "pull_off_force" + other)
            self.assertAlmostEqual(product / device.restoring_force, 1.0, places=12)
        self.assertNotEqual(device.reason, "")

    def assert_refused(self, device):
        self.assertEqual(device.status, DeviceAdhesion.REFUSED)
        self.assertNotEqual(device.message, "")
        self.assertEqual(
            (device.sticks, device.reason, device.verdict_by),
            (StictionPrediction.STICKS_UNKNOWN, "", ""),
        )
        self.assertTrue(math.isnan(device.pull_off_force) and math.isnan(device.margin))
        self.assertEqual(list(device.realisations), [])

    def test_1_before_any_scan_it_says_so(self):
        wait_until(lambda: "no scan" in self.counts().get("message", ""), "the status")
        self.assertEqual(self.counts()["offered"], "0")

    def test_2_the_scans_of_a_part_together_judge_it_with_the_cores_figures(self):
        surfaces = [surface(seed) for seed in (1, 2, 3)]
        for count in range(1, 4):
            parts = len(self.parts.messages)
            prediction, device = self.send(surfaces[count - 1], ("lot 3", "0012"))
            self.assert_is_force_of(device, surfaces[:count])
            self.assert_judged(device)
            self.assert_one_answer(prediction, device, count)
            for name in ("version", "settings_hash", "scan_name", "part_id", "serial_id"):
                self.assertEqual(getattr(device, name), getattr(prediction, name), name)
            self.assertEqual(
                (device.voltage, device.mechanical_load),
                (prediction.voltage, prediction.mechanical_load),
            )
            # The frame alone makes no statement on a device of another size, and says where one
            # comes from.
            self.assertEqual(prediction.sticks, StictionPrediction.STICKS_UNKNOWN)
            self.assertIn("device_force", prediction.reason)
            before, after = self.parts.wait(parts + 2)[parts:]
            self.assertEqual(
                (before.sticks, before.scan_count), (StictionPrediction.STICKS_UNKNOWN, count)
            )
            self.assertEqual(
                (after.header.stamp, after.scan_count, after.settings_hash),
                (prediction.header.stamp, count, prediction.settings_hash),
            )
            for name in ("sticks", "margin", "margin_lower", "margin_upper"):
                self.assertEqual(getattr(after, name), getattr(device, name), name)
        # Another part, and scans of none, have their own surfaces.
        self.assert_is_force_of(self.send(surfaces[1], ("lot 3", "0013"))[1], surfaces[1:2])
        parts = len(self.parts.messages)
        for scan in surfaces[:2]:
            prediction, device = self.send(scan)
            self.assert_is_force_of(device, [scan])
            self.assert_one_answer(prediction, device, 1)
        self.assert_is_force_of(
            self.send(surfaces[0], ("lot 3", "0013"))[1], [surfaces[1], surfaces[0]]
        )
        self.parts.wait(parts + 2)
        self.assertEqual(len(self.parts.messages), parts + 2)  # none of the scans without a part

    def test_2b_of_parts_that_come_faster_than_forces_the_newest_is_next_and_none_is_left_out(self):
        devices = len(self.devices.messages)
        scans = [surface(20 + number) for number in range(12)]
        stamps = []
        for number, scan in enumerate(scans):
            stamps.append(self.station.stamp())
            info = info_message(stamps[-1])
            info.part_id, info.serial_id = "fast", str(number)
            self.station.info.publish(info)
            self.station.height.publish(image_message(scan, stamps[-1]))
        wait_until(
            lambda: any(
                message.header.stamp == stamps[-1] for message in self.predictions.messages
            ),
            "the newest prediction",
        )
        found_before = len(self.devices.messages)
        self.devices.wait(devices + len(scans))
        found = [message.header.stamp for message in self.devices.messages[devices:]]
        self.assertEqual(sorted(found), stamps)
        # one was at hand when the newest came, and its prediction may be seen before it is offered
        self.assertLessEqual(found.index(stamps[-1]) - (found_before - devices), 2)
        self.assertLess(
            found_before - devices, len(scans) - 3, "forces came as fast as scans: nothing waited"
        )
        for stamp in stamps:
            self.assertTrue(self.verdicts_until_the_final_one(stamp)[-1].by_device_force)
        late = Collector("verdict", DeviceVerdict)
        # between the last answer on an earlier scan and the newest one's again lies a moment
        wait_until(
            lambda: late.messages and late.messages[-1].header.stamp == stamps[-1],
            "the latched verdict to be that on the newest scan",
        )
        late.close()

    def test_3_who_comes_late_finds_the_newest(self):
        late = Collector("device_force", DeviceAdhesion)
        self.assertEqual(late.wait(1)[0].header.stamp, self.devices.messages[-1].header.stamp)
        late.close()
        late = Collector("verdict", DeviceVerdict)
        found, newest = late.wait(1)[0], self.verdicts.messages[-1]
        self.assertEqual(
            (found.header.stamp, found.is_final, found.margin),
            (newest.header.stamp, newest.is_final, newest.margin),
        )
        late.close()

    def test_3b_the_terminal_has_a_line_for_the_device(self):
        process = subprocess.Popen(
            [find_node("mems_stiction", "print_predictions")[0]],
            stdout=subprocess.PIPE,
            universal_newlines=True,
        )
        try:
            wait_for_listener("prediction", "/print_predictions")
            wait_for_listener("device_force", "/print_predictions")
            self.settings.update_configuration({"spring_stiffness": 0.0})
            self.station.send(surface(10))
            plain = [process.stdout.readline() for _ in range(3)]  # two of the head
            self.settings.update_configuration({"spring_stiffness": 10.0})
            again = process.stdout.readline()
            _, device = self.send(surface(11))
            lines = [process.stdout.readline()]
            while "device: " not in lines[-1]:
                lines.append(process.stdout.readline())
        finally:
            process.terminate()
            process.communicate()
        self.assertNotIn("sticks", plain[1])
        self.assertTrue(plain[2].startswith("1 scan  "), plain)
        self.assertTrue(again.startswith("1 scan "), again)
        self.assertEqual(len(lines), 4, lines)
        self.assertTrue(lines[1].rstrip().endswith("margin  sticks"), lines)
        self.assertTrue(lines[2].startswith("2 scan  "), lines)
        self.assertEqual(lines[2][lines[1].index("sticks") :].split()[0], "unknown", lines)
        self.assertEqual(
            lines[3].rstrip("\n"), device_line("2 scan", device)
        )  # not that of the scan before, which is latched

    def test_4_under_another_load_it_is_found_and_else_judged_again(self):
        prediction, device = self.send(surface(4), ("lot 4", ""))
        made = int(self.newest_counts()["found"])

        def answered(status, change):
            devices, parts = len(self.devices.messages), len(self.parts.messages)
            answer = change()
            again = self.devices.wait(devices + 1)[devices]
            part = self.parts.wait(parts + 1)[parts]
            self.assertEqual(
                (again.status, again.scan_count, again.header.stamp),
                (status, 1, prediction.header.stamp),
            )
            self.assertEqual(
                (part.settings_hash, part.margin, part.sticks),
                (again.settings_hash, again.margin, again.sticks),
            )
            self.assert_judged(again)
            return again, answer

        loaded, answer = answered(DeviceAdhesion.FOUND, lambda: self.set_load(5e-5))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.prediction.header.stamp, prediction.header.stamp)
        self.assertEqual(
            (loaded.mechanical_load, loaded.settings_hash), (5e-5, answer.prediction.settings_hash)
        )
        self.assertNotEqual(loaded.settings_hash, device.settings_hash)
        # summits that have flowed hold more strongly
        self.assertGreater(answer.prediction.pull_off_force, 1.05 * prediction.pull_off_force)
        self.assertGreater(loaded.pull_off_force, device.pull_off_force)
        back, _ = answered(DeviceAdhesion.FOUND, lambda: self.set_load(1e-6))
        self.assertEqual(
            (back.pull_off_force, back.margin, back.settings_hash),
            (device.pull_off_force, device.margin, device.settings_hash),
        )
        stronger, _ = answered(
            DeviceAdhesion.JUDGED_AGAIN,
            lambda: self.settings.update_configuration({"spring_stiffness": 20.0}),
        )
        self.assertEqual(
            (stronger.pull_off_force, stronger.restoring_force),
            (device.pull_off_force, 2.0 * device.restoring_force),
        )
        self.assertEqual(stronger.margin, 2.0 * device.margin)
        answered(
            DeviceAdhesion.JUDGED_AGAIN,
            lambda: self.settings.update_configuration({"spring_stiffness": 10.0}),
        )
        shown = self.newest_counts()
        self.assertEqual((int(shown["found"]), int(shown["judged_again"])), (made + 2, 2))

    def test_5_a_scan_without_a_force_is_said_and_the_next_one_has_one(self):
        refused = self.send(rough_surface(5, rows=4, cols=4))[1]
        self.assert_refused(refused)
        shown = self.newest_counts()
        self.assertEqual(
            (shown["failed"], shown["last_failure"].replace(",", ";")), ("1", refused.message)
        )
        last = self.verdicts_until_the_final_one(refused.header.stamp)[-1]
        self.assertEqual((last.word, last.by_device_force), ("unknown", False))
        self.assert_is_force_of(self.send(surface(6))[1], [surface(6)])

    def test_5b_a_scan_that_does_not_show_what_holds_is_unknown_until_its_part_has_one_that_does(
        self,
    ):
        coarse = (
            np.random.RandomState(8).normal(scale=5e-9, size=(SMALL, SMALL)).astype(np.float32)
        )  # no pixel knows its neighbour
        prediction, device = self.send(coarse, ("plate", "8"))
        self.assertIn("unresolved", prediction.flags)
        self.assertTrue(
            prediction.regime_flags & StictionPrediction.FLAG_UNRESOLVED
            and prediction.needed_pitch < PITCH
        )
        self.assertTrue(
            any("missing is AFM" in warning for warning in prediction.warnings), prediction.warnings
        )
        self.assertEqual(device.sticks, StictionPrediction.STICKS_UNKNOWN)
        said = self.verdicts_until_the_final_one(prediction.header.stamp)
        self.assertEqual({message.word for message in said}, {"unknown"})
        self.assertIn("the scan does not show what holds", said[-1].reason)
        prediction, device = self.send(surface(9), ("plate", "8"))
        self.assertNotIn("unresolved", prediction.flags)
        self.assertEqual(device.scan_count, 2)
        self.assert_judged(device)
        self.assertNotEqual(
            self.verdicts_until_the_final_one(prediction.header.stamp)[-1].word, "unknown"
        )

    def test_5c_the_order_of_the_scans_does_not_change_the_word(self):
        fine = surface(9, 4e-9)
        coarse = np.random.RandomState(8).normal(scale=2e-9, size=(32, 32)).astype(np.float32)
        for serial, scans in enumerate(([coarse, fine], [fine, coarse])):
            for scan in scans:
                prediction, device = self.send(scan, ("order", str(serial)))
            flags = prediction.regime_flags & StictionPrediction.FLAG_ONE_PIXEL
            self.assertEqual(flags != 0, scan is coarse)
            self.assert_is_force_of(device, scans)
            last = self.verdicts_until_the_final_one(prediction.header.stamp)[-1]
            self.assertEqual((last.word, last.by_device_force), ("no", True), last.reason)

    def test_6_without_a_contact_area_nothing_is_made(self):
        self.settings.update_configuration({"contact_area": 0.0})
        offered = self.newest_counts()["offered"]
        scans = len(self.predictions.messages)
        self.station.send(surface(7))
        self.assertNotIn("device_force", self.predictions.wait(scans + 1)[scans].reason)
        self.assertEqual(self.newest_counts()["offered"], offered)
        self.settings.update_configuration({"contact_area": 4e-12})

    def test_7_scans_are_predicted_while_surfaces_are_made_and_every_one_is_counted(self):
        settings = yaml.safe_load(CONFIG.read_text())
        settings["device"]["contact_area"] = 1e-8
        settings["device_force"] = {
            "realisations": 1000,
            "max_cells": 4.0e6,
        }  # beyond the patience of any test
        with OwnNode("busy", **settings) as node:
            predictions = Collector("/busy/prediction", StictionPrediction).connect()
            devices = Collector("/busy/device_force", DeviceAdhesion).connect()
            station = Station("/busy/")
            with Traffic(station, [surface(seed) for seed in (8, 9)]) as traffic:
                wait_until(
                    lambda: self.counts("busy/node").get("time_so_far [s]", "0") != "0",
                    "surfaces that are made",
                )
                count = len(predictions.messages)
                predictions.wait(count + 20)
            predictions.wait(len(traffic.sent))
            self.assertIn("makes surfaces", self.counts("busy/node")["message"])
            wait_until(
                lambda: int(self.counts("busy/node")["offered"]) == len(traffic.sent),
                "every scan to be counted",
            )
            shown = self.counts(
                "busy/node"
            )  # one at hand, the newest waits, and those between had newer ones
            self.assertEqual(
                [
                    int(shown[key])
                    for key in ("found", "judged_again", "failed", "waiting", "skipped")
                ],
                [0, 0, 0, 1, len(traffic.sent) - 2],
            )
            begin = time.monotonic()
            node.process.terminate()
            node.process.wait(timeout=30)
            self.assertLess(time.monotonic() - begin, 5.0)  # as promised of a signal
            self.assertEqual((node.process.returncode, devices.messages), (0, []))


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "device", DeviceTest)
