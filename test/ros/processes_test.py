#!/usr/bin/env python3
"""What befalls the processes around a scan: killed, stopped and flooded nodes, frozen listeners,
publishers that die."""

import os
import signal
import socket
import struct
import subprocess
import sys
import threading
import unittest
from xmlrpc.server import SimpleXMLRPCServer

import rosgraph
import rospy
import rostest
from actionlib_msgs.msg import GoalID
from geometry_msgs.msg import TransformStamped
from mems_stiction.msg import StictionPrediction
from mems_stiction.srv import GetLoad, SetLoad
from roslib.packages import find_node
from rosgraph_msgs.msg import Clock
from stiction_client import (
    SANITIZER,
    TIMEOUT,
    Collector,
    Counts,
    OwnNode,
    Station,
    Traffic,
    image_message,
    info_message,
    predict_scan,
    rough_surface,
    wait_for_listener,
    wait_until,
)
from tf2_msgs.msg import TFMessage

LOAD = 1e-6
MB = 1e6
OVERLOAD = float(os.environ.get("MEMS_STICTION_OVERLOAD", "4"))  # seconds for each of four nodes
# A process of its own that listens and can be stopped.
LISTENER = """
import sys, rospy
from mems_stiction.msg import StictionPrediction
from sensor_msgs.msg import Image
rospy.init_node("listener", anonymous=True)
kept = [rospy.Subscriber(sys.argv[1] + "/prediction", StictionPrediction, lambda message: None),
        rospy.Subscriber(sys.argv[1] + "/deformed_height", Image, lambda message: None)]
rospy.spin()
"""


class DyingPublisher:
    """Publishes /NAMESPACE/height by the protocol, and goes away in the middle of a message."""

    def __init__(self, topic, announced, sent):
        self._message = struct.pack("<I", announced) + bytes(sent)
        self._listener = socket.create_server(("localhost", 0))
        self._server = SimpleXMLRPCServer(("localhost", 0), logRequests=False)
        self._server.register_function(
            lambda caller, name, protocols: [
                1,
                "",
                ["TCPROS", "localhost", self._listener.getsockname()[1]],
            ],
            "requestTopic",
        )
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()
        self._address = "http://localhost:%d/" % self._server.server_address[1]
        self._topic = topic
        self._master = rosgraph.Master("/dying_publisher")
        self._master.registerPublisher(topic, "sensor_msgs/Image", self._address)

    def die(self):
        connection, _ = self._listener.accept()
        with connection:
            (length,) = struct.unpack("<I", connection.recv(4, socket.MSG_WAITALL))
            connection.recv(length, socket.MSG_WAITALL)
            fields = [
                b"type=sensor_msgs/Image",
                b"md5sum=060021388200f6f0f447d0fcd9c64743",
                b"callerid=/dying_publisher",
            ]
            header = b"".join(struct.pack("<I", len(field)) + field for field in fields)
            connection.sendall(struct.pack("<I", len(header)) + header + self._message)
        self._master.unregisterPublisher(self._topic, self._address)
        self._server.shutdown()
        self._server.server_close()
        self._listener.close()


class ProcessesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("processes_test")

    def test_1_a_node_that_is_killed_and_started_again_goes_on_and_says_which_load_is_lost(self):
        with OwnNode("killed") as node:
            predictions = Collector("/killed/prediction", StictionPrediction).connect()
            station = Station("/killed/")
            self.assertTrue(
                rospy.ServiceProxy("/killed/node/set_load", SetLoad)(3.0, 2 * LOAD).success
            )
            with Traffic(station, [rough_surface(1), rough_surface(2)]) as traffic:
                wait_until(lambda: len(traffic.sent) > 50, "some scans")
                node.kill()

                def of_load(load):
                    return [
                        message
                        for message in list(predictions.messages)
                        if message.mechanical_load == load
                    ]

                with node:
                    counts = Counts("killed/node")
                    wait_until(lambda: len(of_load(LOAD)) > 50, "scans to be predicted again")
                    rospy.sleep(0.5)
                    traffic.__exit__()
                    sent = sorted(traffic.sent)
                    wait_until(
                        lambda: predictions.messages[-1].header.stamp == sent[-1], "the last scan"
                    )
                    before = len(of_load(2 * LOAD))  # what the first run has set is lost
                    # In the order of sending, none twice; what is missing lies between the two
                    # runs.
                    stamps = [message.header.stamp for message in predictions.messages]
                    self.assertEqual(stamps, sorted(set(stamps)))
                    first = stamps[before]
                    self.assertEqual(stamps[before:], sent[sent.index(first) :])
                    counts.wait(predicted=len(stamps) - before, dropped=0, waiting=0)
                    self.assertEqual(
                        [message.mechanical_load for message in predictions.messages],
                        [2 * LOAD] * before + [LOAD] * (len(stamps) - before),
                    )
                    self.assertEqual(
                        rospy.ServiceProxy("/killed/node/get_load", GetLoad)().voltage, 0.0
                    )
                    wait_until(counts.reasons, "what is lost")
                    self.assertIn("mechanical_load was 2e-06 and is 1e-06", counts.reasons()[-1])
                    self.assertIn("voltage was 3 and is 0", counts.reasons()[-1])
                    self.assertTrue(
                        rospy.ServiceProxy("/killed/node/set_load", SetLoad)(3.0, 2 * LOAD).success
                    )
                    wait_until(lambda: counts.level() == 0, "the end of the warning")

    def test_2_a_listener_that_freezes_costs_no_prediction_and_little_memory(self):
        surface = rough_surface(2, rows=256, cols=256)
        with OwnNode("frozen") as node:
            counts = Counts("frozen/node")
            predictions = Collector("/frozen/prediction", StictionPrediction).connect()
            station = Station("/frozen/")
            listener = subprocess.Popen([sys.executable, "-c", LISTENER, "/frozen"])
            try:
                station.send(surface)
                predictions.wait(1)
                wait_for_listener("/frozen/prediction", "/listener")
                wait_for_listener("/frozen/deformed_height", "/listener")
                listener.send_signal(signal.SIGSTOP)
                resident = []
                for burst in range(20):
                    for _ in range(40):
                        station.send(surface)
                    # Not by the counts, which are a second old: scans that wait are no memory of
                    # the listener's.
                    predictions.wait(1 + 40 * (burst + 1))
                    resident.append(node.resident())
                counts.wait(received=801, predicted=801, dropped=0, rejected=0)
                self.assertEqual(len(predictions.wait(801)), 801)
                # The connection holds back 20 maps of 256 kB and 1000 predictions of some kB: the
                # maps, and heaps, are full after some bursts. From there on another 600 maps would
                # be 157 MB.
                if not SANITIZER:
                    self.assertLess(max(resident[5:]) - max(resident[:5]), 40 * MB, resident)
            finally:
                listener.send_signal(signal.SIGCONT)
                listener.kill()
                listener.wait()
            last = station.send(surface)
            self.assertEqual(predictions.wait(802)[-1].header.stamp, last)

    def test_3_a_publisher_that_dies_in_the_middle_of_a_message_is_no_scan(self):
        with OwnNode("dying") as node:
            counts = Counts("dying/node")
            predictions = Collector("/dying/prediction", StictionPrediction).connect()
            station = Station("/dying/")
            before = node.resident()
            for announced, sent in ((10**7, 10**6), (4 * 10**9, 100), (100, 3), (0, 0), (60, 60)):
                DyingPublisher("/dying/height", announced, sent).die()
            surface = rough_surface(3)
            stamp = station.send(surface)
            prediction = predictions.wait(1)[-1]
            self.assertEqual(prediction.header.stamp, stamp)
            self.assertEqual(
                prediction.pull_off_force, predict_scan(surface, LOAD)["pull_off_force"]
            )
            # Two are whole messages and no scan: the empty one, and that without a scan_info, once
            # time is up. They may be lost with their publisher. The others were none.
            wait_until(lambda: counts["waiting_for_partner"] == "0", "the end of waiting")
            counts.wait(predicted=1, waiting=0, dropped=0)
            self.assertLessEqual(int(counts["rejected"]), 2)
            if not SANITIZER:
                self.assertLess(node.resident() - before, 100 * MB)

    def second(self, *arguments, **more):
        return subprocess.run(
            [find_node("mems_stiction", "stiction_node")[0], "__name:=node"] + list(arguments),
            timeout=TIMEOUT,
            env=dict(os.environ, ROS_NAMESPACE="/named"),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            **more,
        )

    def test_3a_a_second_node_of_the_name_is_refused_and_the_first_goes_on(self):
        with OwnNode("named") as node:
            for argument, status, words in (
                ("--help", 0, "--take-over"),
                ("--voltge", 2, "--voltge: there is no such option"),
                ("scan.tiff", 2, "scan.tiff: is not expected here"),
            ):
                done = self.second(argument)
                self.assertEqual(done.returncode, status, done.stderr)
                self.assertIn(words, done.stdout + done.stderr)
            done = self.second()
            self.assertEqual(done.returncode, 1)
            self.assertIn("a node of the name /named/node runs already, at http://", done.stderr)
            self.assertEqual(
                rospy.ServiceProxy("/named/node/get_load", GetLoad)().mechanical_load, LOAD
            )
            self.assertIsNone(node.process.poll())
            node.kill()  # the master still has its name
            with OwnNode("named"):
                pass
        with OwnNode("named") as node:
            other = subprocess.Popen(
                [find_node("mems_stiction", "stiction_node")[0], "__name:=node", "--take-over"],
                env=dict(os.environ, ROS_NAMESPACE="/named"),
            )
            try:
                self.assertEqual(node.process.wait(timeout=TIMEOUT), 0)
                rospy.wait_for_service("/named/node/get_load", TIMEOUT)
                wait_until(
                    lambda: (
                        rospy.ServiceProxy("/named/node/get_load", GetLoad)().mechanical_load
                        == LOAD
                    ),
                    "the other node",
                )
            finally:
                other.terminate()
                other.wait()

    def test_3b_the_first_line_says_what_a_node_runs_with(self):
        rospy.set_param(
            "/named/node",
            {
                "config": {"file": "/parts/left.yaml", "text": "load: {mechanical_load: 1.0e-6}"},
                "queue_size": 3,
            },
        )
        node = subprocess.Popen(
            [find_node("mems_stiction", "stiction_node")[0], "__name:=node"],
            stdout=subprocess.PIPE,
            env=dict(os.environ, ROS_NAMESPACE="/named", ROSCONSOLE_FORMAT="${message}"),
            universal_newlines=True,
        )
        try:
            self.assertRegex(
                node.stdout.readline(), r"configuration: /parts/left\.yaml; settings [0-9a-f]{16}"
            )
        finally:
            node.terminate()
            node.communicate()
            rospy.delete_param("/named/node")

    def test_3c_a_node_that_nobody_sends_scans_says_so_once(self):
        node = subprocess.Popen(
            [find_node("mems_stiction", "stiction_node")[0], "__name:=node"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=dict(os.environ, ROS_NAMESPACE="/lonely", ROSCONSOLE_FORMAT="${message}"),
            universal_newlines=True,
        )
        try:
            self.assertRegex(
                node.stderr.readline(),
                "nobody has published /lonely/height for 10 s: start what gives scans .*, or remap",
            )
        finally:
            node.terminate()
            _, more = node.communicate()
        self.assertNotIn("nobody", more)

    def test_4_a_stopped_node_says_so_when_it_goes_on(self):
        with OwnNode("stopped") as node:
            counts = Counts("stopped/node")
            predictions = Collector("/stopped/prediction", StictionPrediction).connect()
            station = Station("/stopped/")
            surface = rough_surface(4)
            station.send(surface)
            predictions.wait(1)
            node.process.send_signal(signal.SIGSTOP)
            try:
                for _ in range(10):
                    station.send(surface)
                rospy.sleep(3.0)
            finally:
                node.process.send_signal(signal.SIGCONT)
            counts.wait(received=11, predicted=11, dropped=0, rejected=0)
            wait_until(
                lambda: any("stood still for" in reason for reason in counts.reasons()), "a warning"
            )
            self.assertGreater(float(counts["longest_pause [s]"]), 2.5)

    def test_5_a_clock_that_goes_back_stops_nothing(self):
        rospy.set_param("/use_sim_time", True)
        clock = rospy.Publisher("/clock", Clock, queue_size=10)
        try:
            with OwnNode("clock"):
                rospy.set_param("/use_sim_time", False)
                counts = Counts("clock/node")
                predictions = Collector("/clock/prediction", StictionPrediction).connect()
                station = Station("/clock/")
                sent = 0
                for now in (5000, 5001, 100, 101, 0, 7000):
                    clock.publish(Clock(rospy.Time(now)))
                    for _ in range(5):
                        station.send(rough_surface(5))
                        sent += 1
                    counts.wait(received=sent, predicted=sent, dropped=0, rejected=0)
                self.assertEqual(len(predictions.wait(sent)), sent)
        finally:
            rospy.delete_param("/use_sim_time")

    def test_6_more_scans_than_can_be_predicted(self):
        surfaces = [rough_surface(seed, rows=256, cols=256, rms_height=2e-8) for seed in (1, 2)]
        most = 60 * surfaces[0].nbytes
        for policy in ("latest", "all"):
            for half_space in (False, True):
                name = "overload_%s_%s" % (policy, "half_space" if half_space else "alone")
                more = {
                    "drop_policy": policy,
                    "max_waiting_memory": float(most),
                    "queue_size": 5,
                    "approach/formulation": "paper",
                    "approach/max_steps": 20000,
                    "paper/step": 1e-12,
                }
                if half_space:
                    more["half_space/enabled"] = True
                with OwnNode(name, **more) as node:
                    counts = Counts(name + "/node")
                    predictions = Collector("/%s/prediction" % name, StictionPrediction).connect()
                    station = Station("/%s/" % name)
                    for _ in range(3):
                        station.send(surfaces[0])
                    predictions.wait(3)
                    period = float(predictions.messages[-1].processing_time) / 3
                    before = node.resident()
                    with Traffic(station, surfaces, period) as traffic:
                        rospy.sleep(OVERLOAD)
                        last_before_end = traffic.newest
                        newest = predictions.messages[-1].header.stamp
                        waiting = int(counts["waiting"])
                        growth = node.resident() - before
                    sent = len(traffic.sent) + 3
                    wait_until(
                        lambda: int(counts["received"]) == sent and counts["waiting"] == "0",
                        "the end of the scans",
                        5 * TIMEOUT,
                    )
                    figures = {
                        key: int(counts[key])
                        for key in (
                            "received",
                            "predicted",
                            "rejected",
                            "dropped",
                            "missing_by_sequence",
                        )
                    }
                    print(
                        name,
                        figures,
                        "period %.4g s" % period,
                        "waiting",
                        waiting,
                        "growth %.0f MB" % (growth / MB),
                        "behind %d" % (last_before_end - newest).to_sec(),
                        flush=True,
                    )
                    self.assertEqual(figures["predicted"] + figures["dropped"], sent, figures)
                    self.assertEqual(
                        (figures["rejected"], figures["missing_by_sequence"]), (0, 0), name
                    )
                    self.assertEqual(
                        len(predictions.wait(figures["predicted"])), figures["predicted"]
                    )
                    self.assertEqual(
                        predictions.messages[-1].header.stamp, max(traffic.sent)
                    )  # the newest, never dropped
                    if not SANITIZER:  # who sends is too slow then
                        self.assertGreater(
                            figures["dropped"] if policy == "latest" else waiting, 0, name
                        )
                    self.assertLess(
                        growth, most + 150 * MB, name
                    )  # heaps of threads, maps of the half-space
                    if policy == "latest":
                        # Stamps count scans; 5 may wait, and the rest is on its way. Without drops
                        # two thirds would wait.
                        self.assertLess((last_before_end - newest).to_sec(), 5 + sent / 4, name)

    def test_7_stamps_at_the_end_of_time_end_no_node(self):
        """Sums and differences of ros::Time beyond 32 bits throw: in the node's own hands, and in
        the libraries'."""
        far = [rospy.Time(4294967295 - second) for second in range(3)]
        surface = rough_surface(6)
        with OwnNode(
            "far_stamps", **{"counter_surface/frame": "upper", "pairing_timeout": 0.5}
        ) as node:
            counts = Counts("far_stamps/node")
            predictions = Collector("/far_stamps/prediction", StictionPrediction).connect()
            station = Station("/far_stamps/")
            station.height.publish(image_message(surface, far[0]))
            station.info.publish(info_message(rospy.Time(1)))
            counts.wait(rejected=2)
            cancel = rospy.Publisher("/far_stamps/node/sweep_load/cancel", GoalID, queue_size=10)
            frames = rospy.Publisher("/tf", TFMessage, queue_size=10)
            wait_until(
                lambda: cancel.get_num_connections() and frames.get_num_connections(),
                "the node to listen",
            )
            cancel.publish(GoalID(id="nobody", stamp=far[0]))
            for stamp in far:
                frames.publish(TFMessage([self.place(stamp, "elsewhere")]))
            for period in (1e300, -1e10):
                rospy.set_param("/far_stamps/node/diagnostic_period", period)
                rospy.sleep(0.5)
            received = int(counts["received"])
            stamp = station.send(surface)
            frames.publish(TFMessage([self.place(stamp)]))
            prediction = predictions.wait(1)[-1]
            self.assertEqual(
                prediction.pull_off_force, predict_scan(surface, LOAD)["pull_off_force"]
            )
            counts.wait(received=received + 1, predicted=1, waiting=0)  # diagnostics go on, too
            self.assertIsNone(node.process.poll())

    @staticmethod
    def place(stamp, frame="upper"):
        """A frame, of the counter-surface unless another is named, where the scan is."""
        transform = TransformStamped()
        transform.header.stamp, transform.header.frame_id, transform.child_frame_id = (
            stamp,
            "scan",
            frame,
        )
        transform.transform.rotation.w = 1.0
        return transform

    def test_8_whatever_waits_holds_no_more_than_it_may(self):
        frame = rough_surface(7, rows=1024, cols=1024, rms_height=2e-8)
        sent, most = 60, 5 * frame.nbytes - 1  # 4 may wait
        slow = {
            "approach/formulation": "paper",
            "approach/max_steps": 10000000,
            "paper/step": 1e-21,
        }
        # How a scan is sent, what waits, and as what the others count: on a busy machine a scan can
        # be given up before its scan_info has come, which rejects it.
        cases = {
            "partner": (
                {},
                lambda station, height: station.height.publish(
                    image_message(height, station.stamp())
                ),
                "waiting_for_partner",
                ["rejected"],
            ),
            "transform": (
                {"counter_surface/frame": "upper", "counter_surface/transform_timeout": 600.0},
                lambda station, height: station.send(height),
                "waiting_for_transform",
                ["dropped", "rejected"],
            ),
            "worker": (
                dict(slow, **{"counter_surface/type": "topic", "counter_surface/facing": "down"}),
                lambda station, height: counter.send(height),
                None,
                ["counter_surfaces_rejected"],
            ),
        }
        for name, (more, send, waiting, gone) in cases.items():
            with OwnNode(
                "wait_" + name, max_waiting_memory=float(most), pairing_timeout=600.0, **more
            ) as node:
                counts = Counts("wait_%s/node" % name)
                station = Station("/wait_%s/" % name)
                if name == "worker":
                    counter = Station("/wait_worker/counter_")
                    counter.send(0 * frame)
                    counts.wait(counter_surfaces=1)
                    station.send(frame)  # is being predicted for as long as the test takes
                    counts.wait(received=1, waiting=1, waiting_for_worker=0)
                before = node.resident()
                for _ in range(sent):
                    send(station, frame)
                    rospy.sleep(0.02)
                wait_until(
                    lambda: counts.total(*gone) == sent - 4,
                    "%d scans that are gone as %s" % (sent - 4, " or ".join(gone)),
                )
                self.assertTrue(most / 2 < int(counts["waiting_memory [bytes]"]) <= most, name)
                if waiting is not None:
                    counts.wait(predicted=0, **{waiting: 4})
                self.assertTrue(
                    any("max_waiting_memory" in reason for reason in counts.reasons()), name
                )
                if not SANITIZER:
                    # Messages on their way and the scan at hand; all of them would be 250 MB.
                    self.assertLess(node.resident() - before, most + 100 * MB, name)
                node.kill()


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "processes", ProcessesTest)
