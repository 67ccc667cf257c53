#!/usr/bin/env python3
"""Plays a bag through a running node and adds one row of latencies to a JSON file.

usage: replay_latency.py --bag BAG --rate HZ --shell NAME --output latency.json

Latency is the time from the arrival of a scan at a listener to that of its prediction at the same
listener: serialization and transport of the scan to the node run beside those to the listener. The
node's own share, from its callback to its publish call over the core's time, is read from
/diagnostics.
"""

import argparse
import json
import pathlib
import statistics
import struct
import subprocess
import sys
import threading
import time

import rosbag
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import StictionPrediction


class Listener:
    """Notes when each scan and each prediction arrives, by stamp, and what the diagnostics say."""

    def __init__(self):
        self.lock = threading.Lock()
        self.scans, self.predictions, self.core_ms, self.ratios = {}, {}, [], []
        self.subscribers = [
            rospy.Subscriber("height", rospy.AnyMsg, self.on_scan, queue_size=None),
            rospy.Subscriber("prediction", StictionPrediction, self.on_prediction, queue_size=None),
            rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics, queue_size=None),
        ]

    def on_scan(self, message):
        arrival = time.monotonic()
        seconds, nanoseconds = struct.unpack_from("<II", message._buff, 4)  # the header: seq, stamp
        with self.lock:
            self.scans[(seconds, nanoseconds)] = arrival

    def on_prediction(self, prediction):
        arrival = time.monotonic()
        with self.lock:
            self.predictions[(prediction.header.stamp.secs, prediction.header.stamp.nsecs)] = (
                arrival
            )
            self.core_ms.append(1e3 * prediction.processing_time)

    def on_diagnostics(self, array):
        for status in array.status:
            values = {pair.key: pair.value for pair in status.values}
            core = float(values.get("last_processing_time [s]", 0) or 0)
            if core > 0:
                with self.lock:
                    self.ratios.append(float(values["last_latency [s]"]) / core)


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--bag", required=True)
    parser.add_argument("--rate", type=float, required=True, help="scans per second")
    parser.add_argument("--shell", required=True, help="name of the row: node or nodelet")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    arguments = parser.parse_args()

    with rosbag.Bag(arguments.bag) as bag:
        stamps = [
            message.header.stamp.to_sec() for _, message, _ in bag.read_messages("/scan_info")
        ]
    if len(stamps) < 2:
        sys.exit("%s holds fewer than two scans" % arguments.bag)
    recorded_rate = (len(stamps) - 1) / (stamps[-1] - stamps[0])

    rospy.init_node("replay_latency", anonymous=True)
    listener = Listener()
    deadline = time.monotonic() + 60
    while listener.subscribers[1].get_num_connections() == 0:
        if time.monotonic() > deadline:
            sys.exit("no node publishes predictions")
        time.sleep(0.1)
    subprocess.run(
        [
            "rosbag",
            "play",
            "--quiet",
            "--wait-for-subscribers",
            "-r",
            str(arguments.rate / recorded_rate),
            arguments.bag,
        ],
        check=True,
        stdout=subprocess.DEVNULL,
    )
    deadline = time.monotonic() + 30
    while len(listener.predictions) < len(stamps) and time.monotonic() < deadline:
        time.sleep(0.1)
    time.sleep(1.5)  # the last diagnostics

    with listener.lock:
        latencies = [
            1e3 * (listener.predictions[stamp] - arrival)
            for stamp, arrival in listener.scans.items()
            if stamp in listener.predictions
        ]
        if not latencies:
            sys.exit("no prediction arrived")
        row = {
            "shell": arguments.shell,
            "rate": arguments.rate,
            "scans": len(stamps),
            "p50_ms": percentile(latencies, 0.5),
            "p99_ms": percentile(latencies, 0.99),
            "dropped": len(stamps) - len(listener.predictions),
            "core_p50_ms": percentile(listener.core_ms, 0.5),
            "callback_to_publish_over_core": statistics.median(listener.ratios)
            if listener.ratios
            else float("nan"),
        }
    rows = json.loads(arguments.output.read_text()) if arguments.output.exists() else []
    arguments.output.write_text(json.dumps(rows + [row], indent=1) + "\n")


if __name__ == "__main__":
    main()
