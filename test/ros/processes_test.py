#!/usr/bin/env python3
"""What befalls the processes around a scan: the node is killed and started again."""

import unittest

import rospy
import rostest
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import GetLoad, SetLoad
from stiction_client import Collector, Counts, OwnNode, Station, Traffic, rough_surface, wait_until

LOAD = 1e-6


class ProcessesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("processes_test")

    def test_1_a_node_that_is_killed_and_started_again_goes_on_and_says_which_load_is_lost(self):
        with OwnNode("killed") as node:
            predictions = Collector("/killed/prediction", StictionPrediction).connect()
            station = Station("/killed/")
            self.assertTrue(rospy.ServiceProxy("/killed/node/set_load", SetLoad)(3.0, 2 * LOAD).success)
            with Traffic(station, [rough_surface(1), rough_surface(2)]) as traffic:
                wait_until(lambda: len(traffic.sent) > 50, "some scans")
                node.kill()
                stamps_before = [message.header.stamp for message in predictions.messages]
                with node:
                    counts = Counts("killed/node")
                    wait_until(lambda: len(predictions.messages) > len(stamps_before) + 50, "scans to be predicted again")
                    rospy.sleep(0.5)
                    traffic.__exit__()
                    sent = sorted(traffic.sent)
                    wait_until(lambda: predictions.messages[-1].header.stamp == sent[-1], "the last scan")
                    # In the order of sending, none twice; what is missing lies between the two runs.
                    stamps = [message.header.stamp for message in predictions.messages]
                    self.assertEqual(stamps, sorted(set(stamps)))
                    first = stamps[len(stamps_before)]
                    self.assertEqual(stamps[len(stamps_before):], sent[sent.index(first):])
                    counts.wait(predicted=len(stamps) - len(stamps_before), dropped=0, waiting=0)
                    self.assertEqual([message.mechanical_load for message in predictions.messages],
                                     [2 * LOAD] * len(stamps_before) + [LOAD] * (len(stamps) - len(stamps_before)))
                    self.assertEqual(rospy.ServiceProxy("/killed/node/get_load", GetLoad)().voltage, 0.0)
                    wait_until(counts.reasons, "what is lost")
                    self.assertIn("mechanical_load was 2e-06 and is 1e-06", counts.reasons()[-1])
                    self.assertIn("voltage was 3 and is 0", counts.reasons()[-1])
                    self.assertTrue(rospy.ServiceProxy("/killed/node/set_load", SetLoad)(3.0, 2 * LOAD).success)
                    wait_until(lambda: counts.level() == 0, "the end of the warning")


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "processes", ProcessesTest)
