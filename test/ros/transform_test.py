#!/usr/bin/env python3
"""counter_surface/frame: the transform at the scan's stamp does what the same pose does as
parameters; a scan without transform is rejected with that reason, and nobody overtakes a scan that
waits."""

import math
import struct
import time
import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import TransformStamped
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import Predict, SetLoad
from stiction_client import (
    TIMEOUT,
    BytesPublisher,
    Collector,
    Counts,
    OwnNode,
    Station,
    image_message,
    info_message,
    peak_memory,
    predict_scan,
    process_of,
    rough_surface,
    settings_of,
    unlike,
    wait_until,
)
from tf2_msgs.msg import TFMessage

FIRST = dict(offset_x=4.0e-8, offset_y=-2.5e-8, rotation=0.4, tilt_x=0.002, tilt_y=-0.001)
FIGURES = ("pull_off_force", "normal_load", "contact_area", "approach", "mean_gap", "total_energy")


def multiplied(a, b):
    """Quaternions (x, y, z, w)."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def tilt_and_rotation(tilt_x, tilt_y, rotation):
    """The shortest turn of z to the plane's normal, after a turn about z."""
    normal = np.array([-math.tan(tilt_x), -math.tan(tilt_y), 1.0])
    normal /= np.linalg.norm(normal)
    axis = np.cross([0.0, 0.0, 1.0], normal)
    angle = math.asin(np.linalg.norm(axis))
    axis = axis / np.linalg.norm(axis) * math.sin(0.5 * angle)
    return multiplied(
        (axis[0], axis[1], axis[2], math.cos(0.5 * angle)),
        (0.0, 0.0, math.sin(0.5 * rotation), math.cos(0.5 * rotation)),
    )


def transform(parent, child, stamp, x, y, turn):
    message = TransformStamped()
    message.header.stamp = stamp
    message.header.frame_id = parent
    message.child_frame_id = child
    message.transform.translation.x, message.transform.translation.y = x, y
    message.transform.translation.z = 5e-6  # does not matter: the surfaces are brought together
    q = message.transform.rotation
    q.x, q.y, q.z, q.w = turn
    return message


class TransformTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("transform_test")
        cls.counts = Counts()
        cls.moving = rospy.Publisher("/tf", TFMessage, queue_size=100)
        cls.static = rospy.Publisher("/tf_static", TFMessage, queue_size=10, latch=True)
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.station = Station()
        cls.references = []
        for name in ("first/", "second/"):
            cls.references.append(
                (Station(name), Collector(name + "prediction", StictionPrediction).connect())
            )
        # The stage moves in the scan's frame; the counter-surface sits on it, tilted and turned.
        turn = tilt_and_rotation(FIRST["tilt_x"], FIRST["tilt_y"], FIRST["rotation"])
        cls.static.publish(
            TFMessage(
                [
                    transform("stage", "counter", rospy.Time(0), 0.0, FIRST["offset_y"], turn),
                    transform("stage", "fixed", rospy.Time(0), 0.0, 0.0, (0.0, 0.0, 0.0, 1.0)),
                ]
            )
        )
        wait_until(cls.moving.get_num_connections, "the node to listen to /tf")

    def wait_until_moved(self, node):
        """It hears of places only that are said once it listens."""
        wait_until(
            lambda: (
                node
                in [connection.endpoint_id for connection in list(self.moving.impl.connections)]
            ),
            node + " to listen to /tf",
        )

    def move(self, stamp, x):
        self.moving.publish(
            TFMessage([transform("scan", "stage", stamp, x, 0.0, (0.0, 0.0, 0.0, 1.0))])
        )

    def reference(self, index, surface):
        station, predictions = self.references[index]
        count = len(predictions.messages)
        station.send(surface)
        return predictions.wait(count + 1)[count]

    def assert_same(self, left, right):
        for name in FIGURES:
            a, b = getattr(left, name), getattr(right, name)
            self.assertAlmostEqual(a / b, 1.0, delta=1e-6, msg=name)

    def test_1_a_scan_without_transform_is_rejected_with_that_reason(self):
        begin = time.monotonic()
        self.station.send(rough_surface(1))
        self.counts.wait(received=1, rejected=1, predicted=0)
        self.assertGreater(time.monotonic() - begin, 4.9)
        self.assertIn(
            "no transform from the scan's frame 'scan' to counter_surface/frame counter",
            self.counts["last_reason"],
        )
        self.assertEqual(self.predictions.messages, [])

    def test_2_the_transform_at_the_stamp_is_the_pose_by_parameters(self):
        surface = rough_surface(2)
        # The stage moves on; each scan takes the place at its own stamp, between two transforms.
        for second in range(1000, 1021, 2):
            self.move(rospy.Time(second), 4.0e-9 * (second - 1000))
        count = len(self.predictions.messages)
        self.station._second = 1009
        self.assertEqual(self.station.send(surface), rospy.Time(1010))
        self.station._second = 1018
        self.station.send(surface)  # 1019: interpolated
        self.station.send(surface)  # 1020
        answers = self.predictions.wait(count + 3)[count:]
        first, second = self.reference(0, surface), self.reference(1, surface)
        self.assertNotEqual(first.pull_off_force, second.pull_off_force)
        self.assert_same(answers[0], first)
        self.assert_same(answers[2], second)
        self.assertNotEqual(answers[1].pull_off_force, answers[2].pull_off_force)

        # The same scan by call, and again after a change of load: at its own pose.
        predict = rospy.ServiceProxy("stiction_node/predict", Predict)
        called = predict(
            image_message(surface, rospy.Time(1010)), info_message(rospy.Time(1010)), 0.0, 1e-6
        )
        self.assertTrue(called.success, called.message)
        self.assert_same(called.prediction, first)
        again = rospy.ServiceProxy("stiction_node/set_load", SetLoad)(0.0, 1e-6)
        self.assert_same(again.prediction, second)
        missing = predict(
            image_message(surface, rospy.Time(2000)), info_message(rospy.Time(2000)), 0.0, 1e-6
        )
        self.assertFalse(missing.success)
        self.assertIn("no transform", missing.message)

    def test_3_a_scan_waits_for_its_transform_and_nobody_overtakes_it(self):
        surface = rough_surface(3)
        count = len(self.predictions.messages)
        self.station._second = 1021
        self.station.send(surface)  # 1022: no transform yet
        fixed = image_message(
            surface, self.station.stamp()
        )  # 1023: its transform is there at all times
        fixed.header.frame_id = "fixed"
        self.station.height.publish(fixed)
        self.station.info.publish(info_message(fixed.header.stamp))
        time.sleep(0.3)
        self.assertEqual(len(self.predictions.messages), count)
        # Services do not wait with it.
        self.assertTrue(rospy.ServiceProxy("stiction_node/set_load", SetLoad)(0.0, 1e-6).success)
        self.assertEqual(len(self.predictions.messages), count)
        self.move(rospy.Time(1022), 0.0)
        stamps = [message.header.stamp.secs for message in self.predictions.wait(count + 2)[count:]]
        self.assertEqual(stamps, [1022, 1023])

    def test_4_a_transform_that_is_too_old_rejects_and_the_next_scan_goes_on(self):
        surface = rough_surface(4)
        rejected, predicted = int(self.counts["rejected"]), len(self.predictions.messages)
        self.station._second = 1499
        self.station.send(surface)
        self.counts.wait(rejected=rejected + 1)
        self.move(rospy.Time(1501), 0.0)
        self.station.send(surface)
        self.predictions.wait(predicted + 1)
        self.assertEqual(self.predictions.messages[predicted].header.stamp.secs, 1501)
        self.assertIn("at the scan's stamp", self.counts["last_reason"])

    def test_5_a_scan_without_stamp_or_frame_is_rejected_at_once(self):
        rejected = int(self.counts["rejected"])
        for stamp, frame in ((rospy.Time(0), "scan"), (rospy.Time(1012), "")):
            image = image_message(rough_surface(5), stamp)
            image.header.frame_id = frame
            info = info_message(stamp)
            self.station.height.publish(image)
            self.station.info.publish(info)
            rejected += 1
            self.counts.wait(rejected=rejected)
            self.assertIn("no frame_id" if not frame else "no stamp", self.counts["last_reason"])

    def test_6_a_place_that_tf_states_is_that_of_the_command_line_to_the_bit(self):
        surface = rough_surface(6)
        with OwnNode(
            "placed", **{"counter_surface/type": "gaussian", "counter_surface/frame": "placed"}
        ):
            predictions = Collector("/placed/prediction", StictionPrediction).connect()
            station = Station("/placed/")
            self.wait_until_moved("/placed/node")
            for second, x, y in ((3001, 37e-9, -12e-9), (3002, -5e-9, 0.0)):
                self.moving.publish(
                    TFMessage(
                        [
                            transform(
                                "scan", "placed", rospy.Time(second), x, y, (0.0, 0.0, 0.0, 1.0)
                            )
                        ]
                    )
                )
                station._second = second - 1
                station.send(surface)
                expected = predict_scan(
                    surface,
                    1e-6,
                    settings=settings_of(
                        counter_surface={"type": "gaussian", "pose": {"offset_x": x, "offset_y": y}}
                    ),
                )
                self.assertEqual(unlike(predictions.wait(second - 3000)[-1], expected), [])

    def test_7_a_counter_surface_comes_behind_the_scan_that_waits(self):
        surface, counters = rough_surface(7), [rough_surface(8), rough_surface(9)]
        with OwnNode(
            "behind",
            **{
                "counter_surface/type": "topic",
                "counter_surface/facing": "down",
                "counter_surface/frame": "behind",
                "counter_surface/transform_timeout": TIMEOUT,
            },
        ):
            counts = Counts("behind/node")
            self.wait_until_moved("/behind/node")
            predictions = Collector("/behind/prediction", StictionPrediction).connect()
            station, counter_station = Station("/behind/"), Station("/behind/counter_")
            counter_station.send(counters[0])
            counts.wait(counter_surfaces=1)
            station._second = 4000
            station.send(surface)  # 4001 and 4002, which have no transform yet
            station.send(surface)
            counts.wait(waiting_for_transform=2)
            counter_station.send(counters[1])
            counts.wait(waiting_for_transform=3, counter_surfaces=1)
            station.send(surface)
            counts.wait(waiting_for_transform=4)
            for second in (4001, 4002, 4003):
                self.moving.publish(
                    TFMessage(
                        [
                            transform(
                                "scan", "behind", rospy.Time(second), 0.0, 0.0, (0.0, 0.0, 0.0, 1.0)
                            )
                        ]
                    )
                )
            for prediction, counter in zip(
                predictions.wait(3), (counters[0], counters[0], counters[1])
            ):
                self.assertEqual(
                    unlike(
                        prediction, predict_scan(surface, 1e-6, counter=counter), ["settings_hash"]
                    ),
                    [],
                )
            counts.wait(counter_surfaces=2, waiting_for_transform=0, received=3, predicted=3)

    def test_8_a_wild_stamp_is_rejected_and_blocks_no_later_scan(self):
        surface = rough_surface(10)
        with OwnNode(
            "wild",
            **{
                "counter_surface/type": "gaussian",
                "counter_surface/frame": "wild",
                "counter_surface/transform_timeout": 20.0,
            },
        ):
            counts = Counts("wild/node")
            self.wait_until_moved("/wild/node")
            predictions = Collector("/wild/prediction", StictionPrediction).connect()
            station = Station("/wild/")

            def place(second):
                self.moving.publish(
                    TFMessage(
                        [
                            transform(
                                "scan", "wild", rospy.Time(second), 0.0, 0.0, (0.0, 0.0, 0.0, 1.0)
                            )
                        ]
                    )
                )

            for second in (5001, 5003):
                place(second)
            station.send(surface, rospy.Time(5002))
            predictions.wait(1)
            beyond = rospy.Time(5003 + 2**31)  # tf2 cannot subtract the two
            station.send(surface, beyond)
            station.send(surface, rospy.Time(5003))
            self.assertEqual(predictions.wait(2)[1].header.stamp, rospy.Time(5003))
            counts.wait(received=3, predicted=2, rejected=1, waiting_for_transform=0)
            self.assertIn("too far from those of the transforms", counts["last_reason"])
            called = rospy.ServiceProxy("/wild/node/predict", Predict)(
                image_message(surface, beyond), info_message(beyond), 0.0, 1e-6
            )
            self.assertFalse(called.success)
            self.assertIn("too far from those of the transforms", called.message)
            # what states more transforms than it holds takes no memory
            process = process_of("/wild/prediction")
            before = peak_memory(process)
            hostile = BytesPublisher("/tf", TFMessage)
            hostile.publish(struct.pack("<I", 20000000))
            place(5003)
            station.send(surface, rospy.Time(5002))
            predictions.wait(3)
            counts.wait(received=4, predicted=3, waiting=0)
            self.assertLess(peak_memory(process) - before, 2**28)
            # a clock that is as far off states transforms, too
            for second in (2**32 - 5, 2**32 - 1):
                place(second)
            station.send(surface, rospy.Time(2**32 - 3))
            station.send(surface, rospy.Time(5004))
            counts.wait(
                received=6, predicted=3, rejected=3, waiting=0
            )  # the last once its time is up: tf has forgotten its place


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "transform", TransformTest)
