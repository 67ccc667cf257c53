"""Bags that were recorded with an earlier definition of the prediction: rosbag finds the rule and brings them up to date."""

import contextlib
import io
import math
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree

import genpy.dynamic
import rosbag
import rospy
from mems_stiction.msg import StictionPrediction
from rosbag.migration import MessageMigrator, MessageUpdateRule, checkbag, fixbag2

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]


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


class MigrationTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.bag = str(pathlib.Path(folder.name) / "old.bag")
        self.fixed = str(pathlib.Path(folder.name) / "new.bag")

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
        with rosbag.Bag(self.bag, "w") as bag:
            bag.write("prediction", message, rospy.Time(12, 50))

    def migrator(self):
        return MessageMigrator(rule_files(), plugins=False)

    def test_what_was_recorded_stays_and_what_was_not_known_is_nan(self):
        self.assertEqual(len(old_classes()), 1)
        for old_class in old_classes():
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
            self.assertEqual((message.formulation, message.warnings, message.curve), ("", [], []))
            self.assertTrue(math.isnan(message.flattening_ratio) and math.isnan(message.contact_stiffness))

    def test_without_the_rule_the_bag_does_not_play(self):
        for old_class in old_classes():
            self.record(old_class)
            for migrator, plays in ((MessageMigrator([], plugins=False), False), (self.migrator(), True)):
                invalid_rules = [invalid for _, invalid in checkbag(migrator, self.bag)]
                self.assertEqual(invalid_rules == [[]], plays)


if __name__ == "__main__":
    unittest.main()
