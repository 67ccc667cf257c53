"""Bags that were recorded with an earlier definition of the prediction: rosbag finds the rule and brings them up to date."""

import contextlib
import io
import json
import math
import pathlib
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree

import genpy.dynamic
import numpy as np
import rosbag
import rospy
from genpy.message import get_message_class
from mems_stiction.msg import (CycleContactActionResult, CyclePoint, HalfSpacePoint, HalfSpaceSolution, ScanInfo, SeparationPoint, StictionPrediction,
                               SweepLoadActionGoal, SweepLoadActionResult, SweepPoint, SweepSummary)
from roslib.packages import find_node
from rosbag.migration import MessageMigrator, MessageUpdateRule, checkbag, fixbag2
from sensor_msgs.msg import Image

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
BETWEEN = "=" * 80 + "\n"  # the messages of a definition


def rule_files():
    """As rosbag finds them: in the package's export."""
    exports = xml.etree.ElementTree.parse(str(REPOSITORY / "package.xml")).findall("export/rosbag")
    return [str(REPOSITORY / export.get("migration_rule_file")) for export in exports]


def old_classes():
    """The definitions that the rules take, by what they call themselves."""
    found = []
    for path in rule_files():
        names = {"MessageUpdateRule": MessageUpdateRule}
        exec(pathlib.Path(path).read_text(encoding="utf-8"), names)
        found += [value for value in names.values() if isinstance(value, type) and issubclass(value, MessageUpdateRule)
                  and value is not MessageUpdateRule]
    return [genpy.dynamic.generate_dynamic(rule.old_type, rule.old_full_text)[rule.old_type] for rule in found]


def action_before(action, part):
    """The message of an action's topic, "Goal" or "Result", as it was before it named lot, wafer and who measured: what it has in it is the newest that the
    rules take."""
    name = "mems_stiction/%sAction%s" % (action, part)
    changed = "mems_stiction/%sResult" % action if part == "Result" else "mems_stiction/ScanInfo"
    old = [kind for kind in old_classes() if kind._type == changed][-1]._full_text.strip().split(BETWEEN)[0]
    first, *others = get_message_class(name)._full_text.split(BETWEEN)
    texts = [first] + ["MSG: %s\n%s\n" % (changed, old) if text.startswith("MSG: %s\n" % changed) else text for text in others]
    kind = genpy.dynamic.generate_dynamic(name, BETWEEN.join(texts))[name]
    assert kind._md5sum != get_message_class(name)._md5sum
    return kind


def old_predictions():
    return [kind for kind in old_classes() if kind._type == "mems_stiction/StictionPrediction"]


class MigrationTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.bag = str(self.folder / "old.bag")
        self.fixed = str(self.folder / "new.bag")

    def record(self, old_class):
        message = old_class()
        message.header.frame_id = "scan 7"
        message.header.stamp = rospy.Time(12, 34)
        message.status = StictionPrediction.BONDED
        message.pull_off_force = 2e-7
        message.roughness.sq = 3e-9
        message.spatial_roughness.hurst = 0.8
        message.preprocessing = ["level (shape=plane)"]
        message.regime_flags = 5
        if "pull_off_contact_count" in message.__slots__:
            message.pull_off_contact_count = 12
        if "curve" in message.__slots__:
            message.formulation, message.warnings = "separation_curve", ["a stage offset"]
            message.curve = [SeparationPoint(displacement=1e-9, force=2e-7)]
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("prediction", message, rospy.Time(12, 50))

    def migrator(self):
        return MessageMigrator(rule_files(), plugins=False)

    def test_what_was_recorded_stays_and_what_was_not_known_is_nan(self):
        self.assertEqual(len(old_predictions()), 4)
        for old_class in old_predictions():
            self.record(old_class)
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
            with rosbag.Bag(self.fixed) as bag:
                messages = list(bag.read_messages())
            self.assertEqual(len(messages), 1)
            message = messages[0].message
            self.assertEqual(message._md5sum, StictionPrediction._md5sum)
            self.assertEqual(messages[0].timestamp, rospy.Time(12, 50))
            self.assertEqual((message.header.frame_id, message.header.stamp), ("scan 7", rospy.Time(12, 34)))
            self.assertEqual((message.status, message.pull_off_force), (StictionPrediction.BONDED, 2e-7))
            self.assertEqual((message.roughness.sq, message.spatial_roughness.hurst), (3e-9, 0.8))
            self.assertEqual((message.preprocessing, message.regime_flags), (["level (shape=plane)"], 5))
            self.assertEqual((message.version, message.settings_hash, message.part_id, message.flags), ("", "", "", []))
            self.assertEqual(message.pull_off_contact_count, 12 if "pull_off_contact_count" in old_class.__slots__ else -1)
            self.assertTrue(math.isnan(message.tip_limit))
            self.assert_no_site_and_nobody(message)
            self.assertEqual(message.below_tip_count, -1)
            if "curve" in old_class.__slots__:
                self.assertEqual((message.formulation, message.warnings), ("separation_curve", ["a stage offset"]))
                self.assertEqual([(point.displacement, point.force) for point in message.curve], [(1e-9, 2e-7)])
            else:
                self.assertEqual((message.formulation, message.warnings, message.curve), ("", [], []))
                self.assertTrue(math.isnan(message.flattening_ratio) and math.isnan(message.contact_stiffness))

    def of_today(self, *messages):
        """What becomes of recorded (topic, message) pairs."""
        with rosbag.Bag(self.bag, "w") as bag:
            for topic, message in messages:
                bag.write(topic, message, rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            return [message for _, message, _ in bag.read_messages()]

    def test_results_of_sweeps_and_cycles_keep_what_they_had(self):
        points = dict(scan_name="place 3", part_id="lot 3", message="ended early")
        sweep, cycles = action_before("SweepLoad", "Result")(), action_before("CycleContact", "Result")()
        for recorded in (sweep, cycles):
            recorded.status.goal_id.id = "goal 1"
            recorded.result.header.stamp = rospy.Time(12, 34)
            for name, value in points.items():
                setattr(recorded.result, name, value)
        sweep.result.points = [SweepPoint(voltage=20.0, margin=1.5, pull_off_force_upper=3e-7), SweepPoint(direction=SweepPoint.DOWN)]
        sweep.result.summaries = [SweepSummary(mechanical_load=1e-6, highest_safe_voltage=20.0)]
        cycles.result.cycles = [CyclePoint(cycle=1, pull_off_force=2e-7), CyclePoint(cycle=2, sticks=2)]
        cycles.result.first_sticking_cycle = 2
        new_sweep, new_cycles = self.of_today(("sweep_load/result", sweep), ("cycle_contact/result", cycles))
        self.assertEqual((new_sweep._md5sum, new_cycles._md5sum), (SweepLoadActionResult._md5sum, CycleContactActionResult._md5sum))
        for new in (new_sweep, new_cycles):
            self.assertEqual((new.status.goal_id.id, new.result.header.stamp), ("goal 1", rospy.Time(12, 34)))
            self.assertEqual({name: getattr(new.result, name) for name in points}, points)
            self.assert_no_site_and_nobody(new.result)
        self.assertEqual([(point.voltage, point.margin, point.pull_off_force_upper, point.direction) for point in new_sweep.result.points],
                         [(20.0, 1.5, 3e-7, SweepPoint.UP), (0.0, 0.0, 0.0, SweepPoint.DOWN)])
        self.assertEqual([(one.mechanical_load, one.highest_safe_voltage) for one in new_sweep.result.summaries], [(1e-6, 20.0)])
        self.assertEqual([(one.cycle, one.pull_off_force, one.sticks) for one in new_cycles.result.cycles], [(1, 2e-7, 0), (2, 0.0, 2)])
        self.assertEqual(new_cycles.result.first_sticking_cycle, 2)

    def test_the_scan_of_a_recorded_goal_keeps_its_calibration(self):
        goal = action_before("SweepLoad", "Goal")()
        goal.goal.voltages = [0.0, 20.0]
        goal.goal.scan_info.pitch_x, goal.goal.scan_info.part_id = 1e-8, "lot 3"
        new, = self.of_today(("sweep_load/goal", goal))
        self.assertEqual(new._md5sum, SweepLoadActionGoal._md5sum)
        self.assertEqual((list(new.goal.voltages), new.goal.scan_info.pitch_x, new.goal.scan_info.part_id), ([0.0, 20.0], 1e-8, "lot 3"))
        self.assert_no_site_and_nobody(new.goal.scan_info)

    def test_the_calibration_of_an_earlier_scan_stays(self):
        old = [kind for kind in old_classes() if kind._type == "mems_stiction/ScanInfo"]
        self.assertEqual(len(old), 2)
        message = old[0](pitch_x=1e-8, pitch_y=2e-8, height_scale=1e-9, invalid_value=-1.0, has_invalid_value=True)
        message.header.stamp = rospy.Time(12, 34)
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("/scan_info", message, rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            (_, new, _), = bag.read_messages()
        self.assertEqual(new._md5sum, ScanInfo._md5sum)
        self.assertEqual((new.header.stamp, new.pitch_x, new.pitch_y), (rospy.Time(12, 34), 1e-8, 2e-8))
        self.assertEqual((new.height_scale, new.invalid_value, new.has_invalid_value), (1e-9, -1.0, True))
        self.assertEqual((new.scan_name, new.part_id, new.serial_id), ("", "", ""))
        self.assert_no_site_and_nobody(new)

    def test_the_names_of_an_earlier_scan_stay(self):
        old = [kind for kind in old_classes() if kind._type == "mems_stiction/ScanInfo"][1]
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("/scan_info", old(pitch_x=1e-8, scan_name="place 3", part_id="lot 3", serial_id="0012"), rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            (_, new, _), = bag.read_messages()
        self.assertEqual(new._md5sum, ScanInfo._md5sum)
        self.assertEqual((new.pitch_x, new.scan_name, new.part_id, new.serial_id), (1e-8, "place 3", "lot 3", "0012"))
        self.assert_no_site_and_nobody(new)

    def assert_no_site_and_nobody(self, message):
        self.assertTrue(math.isnan(message.site_x) and math.isnan(message.site_y))
        self.assertFalse(getattr(message, "has_site", False))
        self.assertEqual((message.lot_id, message.wafer_id, message.acquisition_time, message.instrument, message.operator_name, message.checksum), ("",) * 6)

    def test_a_half_space_that_was_recorded_before_it_judged_has_no_verdict(self):
        old, judged, *_ = (kind for kind in old_classes() if kind._type == "mems_stiction/HalfSpaceSolution")
        self.assertNotIn("sticks", old.__slots__)
        self.assertIn("sticks", judged.__slots__)
        message = old(status=HalfSpaceSolution.TOO_MANY_STATES, message="a sentence", pull_off_force=2e-7, contact_count=-1,
                      is_resolved=True, jumps=4, processing_time=0.5)
        message.header.stamp = rospy.Time(12, 34)
        message.curve = [HalfSpacePoint(height=1e-9, force=2e-7, direction=HalfSpacePoint.RETRACTION)]
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("half_space", message, rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            (_, new, _), = bag.read_messages()
        self.assertEqual(new._md5sum, HalfSpaceSolution._md5sum)
        self.assertEqual((new.header.stamp, new.status, new.message), (rospy.Time(12, 34), message.status, "a sentence"))
        self.assertEqual((new.pull_off_force, new.contact_count, new.is_resolved), (2e-7, -1, True))
        self.assertEqual(new.pull_off_force_under_voltage, 2e-7)
        self.assertEqual((new.jumps, new.processing_time), (4, 0.5))
        point, = new.curve
        self.assertEqual((point.height, point.force, point.direction), (1e-9, 2e-7, HalfSpacePoint.RETRACTION))
        self.assertEqual((new.sticks, new.verdict_reason, new.verdict_by), (StictionPrediction.STICKS_UNKNOWN, "", ""))
        self.assertTrue(all(math.isnan(value) for value in (new.margin, new.margin_upper, new.peel_number)))

    def test_a_half_space_that_was_recorded_before_it_named_its_scan_keeps_its_verdict(self):
        _, old, *_ = (kind for kind in old_classes() if kind._type == "mems_stiction/HalfSpaceSolution")
        message = old(pull_off_force=2e-7, sticks=StictionPrediction.STICKS_NO, verdict_reason="why", verdict_by="half_space", margin=2.0)
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("half_space", message, rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            (_, new, _), = bag.read_messages()
        self.assertEqual(new._md5sum, HalfSpaceSolution._md5sum)
        self.assertEqual((new.pull_off_force, new.sticks, new.verdict_reason, new.verdict_by, new.margin), (2e-7, 0, "why", "half_space", 2.0))
        self.assertEqual((new.version, new.settings_hash, new.scan_name, new.part_id, new.serial_id), ("", "", "", "", ""))
        self.assert_no_site_and_nobody(new)

    def test_a_half_space_that_was_recorded_before_wafers_keeps_all_it_had(self):
        *_, old = (kind for kind in old_classes() if kind._type == "mems_stiction/HalfSpaceSolution")
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("half_space", old(voltage=20.0, pull_off_force=2e-7, pull_off_force_under_voltage=3e-7, verdict_by="half_space", sticks=2,
                                        part_id="lot 3"), rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            (_, new, _), = bag.read_messages()
        self.assertEqual(new._md5sum, HalfSpaceSolution._md5sum)
        self.assertEqual((new.pull_off_force, new.pull_off_force_under_voltage, new.sticks, new.part_id), (2e-7, 3e-7, 2, "lot 3"))
        self.assert_no_site_and_nobody(new)

    def test_a_half_space_that_was_held_by_its_voltage_says_so_and_judges_no_more(self):
        _, _, old, _ = (kind for kind in old_classes() if kind._type == "mems_stiction/HalfSpaceSolution")
        with rosbag.Bag(self.bag, "w") as bag:
            for voltage, judge in ((20.0, "half_space"), (20.0, "prediction"), (0.0, "half_space")):
                bag.write("half_space", old(voltage=voltage, pull_off_force=2e-5, sticks=2, verdict_reason="why", verdict_by=judge, margin=0.1,
                                            scan_name="wafer"), rospy.Time(12, 50))
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(fixbag2(self.migrator(), self.bag, self.fixed), [])
        with rosbag.Bag(self.fixed) as bag:
            held, predicted, plain = (message for _, message, _ in bag.read_messages())
        self.assertEqual([one.pull_off_force_under_voltage for one in (held, predicted, plain)], [2e-5] * 3)
        self.assertTrue(math.isnan(held.pull_off_force) and math.isnan(predicted.pull_off_force) and math.isnan(held.margin))
        self.assertEqual((held.sticks, held.scan_name), (StictionPrediction.STICKS_UNKNOWN, "wafer"))
        self.assertIn("voltage on", held.verdict_reason)
        self.assertEqual((predicted.sticks, predicted.verdict_reason, predicted.margin), (2, "why", 0.1))
        self.assertEqual((plain.sticks, plain.pull_off_force, plain.margin), (2, 2e-5, 0.1))

    def test_the_batch_reads_scans_that_were_recorded_before(self):
        unnamed, named = (kind for kind in old_classes() if kind._type == "mems_stiction/ScanInfo")
        heights = np.random.RandomState(1).normal(scale=1e-9, size=(32, 48)).astype(np.float32)
        rows = {}
        for name, kind in (("unnamed", unnamed), ("named", named), ("new", ScanInfo)):
            image = Image(height=32, width=48, encoding="32FC1", step=4 * 48, data=heights.tobytes())
            info = kind(pitch_x=1e-8, pitch_y=2e-8, height_scale=2.0)
            if kind is not unnamed:
                info.scan_name, info.part_id, info.serial_id = "place 3", "lot 3", "0012"
            image.header.stamp = info.header.stamp = rospy.Time(12, 34)
            bag_path = self.folder / (name + ".bag")
            with rosbag.Bag(str(bag_path), "w") as bag:
                bag.write("/height", image, rospy.Time(12, 50))
                bag.write("/scan_info", info, rospy.Time(12, 50))
            subprocess.run([find_node("mems_stiction", "stiction_batch")[0], "-o", str(self.folder / (name + ".jsonl")), str(bag_path)],
                           check=True, timeout=300, stdout=subprocess.DEVNULL)
            rows[name] = json.loads((self.folder / (name + ".jsonl")).read_text())
            for of_the_file in ("file", "file_size", "file_time", "file_checksum"):
                rows[name].pop(of_the_file)
        self.assertEqual(rows["new"]["pitch_y"], 2e-8)
        self.assertEqual((rows["new"]["scan_name"], rows["new"]["part_id"], rows["new"]["serial_id"]), ("place 3", "lot 3", "0012"))
        self.assertEqual(rows["named"], rows["new"])
        of_today = ("scan_name", "part_id", "serial_id")
        self.assertEqual(rows["unnamed"], dict(rows["new"], **dict.fromkeys(of_today, "")))

    def test_without_the_rule_the_bag_does_not_play(self):
        for old_class in old_predictions():
            self.record(old_class)
            for migrator, plays in ((MessageMigrator([], plugins=False), False), (self.migrator(), True)):
                invalid_rules = [invalid for _, invalid in checkbag(migrator, self.bag)]
                self.assertEqual(invalid_rules == [[]], plays)


if __name__ == "__main__":
    unittest.main()
