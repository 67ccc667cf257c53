"""What the rostests share: scans to send, predictions to wait for, diagnostics to read."""

import collections
import contextlib
import io
import json
import math
import os
import pathlib
import struct
import subprocess
import tempfile
import threading
import time
import unittest
import xmlrpc.client

import numpy as np
import rosbag
import rosgraph
import rospy
import yaml
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import ScanInfo, StictionPrediction
from roslib.packages import find_node
from rospy.msg import AnyMsg
from sensor_msgs.msg import Image

PITCH = 10e-9
NODE_KEYS = (
    "diagnostic_period",
    "pairing_timeout",
)  # of station.yaml, which the command line does not have
SANITIZER = os.environ.get(
    "MEMS_STICTION_SANITIZER"
)  # of scripts/sanitize: memory that is freed stays, and all takes longer
TIMEOUT = (
    120.0 if SANITIZER is None else 300.0
)  # for what is certain to come, on a busy machine, too [s]
STATION = pathlib.Path(__file__).with_name("station.yaml")
# The words of a record's enumerations as the message has them: NON_BONDING is REGIME_NON_BONDING.
WORDS = {
    "status": "",
    "bonding_regime": "REGIME_",
    "contact_theory": "THEORY_",
    "sticks": "STICKS_",
}
# Of a record alone: its file. And of both, what is not the surface's.
NOT_COMPARED = (
    "file",
    "rows",
    "cols",
    "pitch_x",
    "pitch_y",
    "regime_flag_names",
    "processing_time",
)

try:
    from mems_stiction import _core  # noqa: F401

    HAS_MODULE = True
except ImportError:
    HAS_MODULE = False
needs_module = unittest.skipUnless(
    HAS_MODULE, "the Python module is not built: MEMS_STICTION_WITH_PYTHON is off"
)


def wait_until(condition, what, timeout=TIMEOUT):
    """Polls in wall time; raises AssertionError when the time is over, with what, a text or a
    function that returns one."""
    end = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > end:
            text = what() if callable(what) else what
            raise AssertionError("waited %g s in vain for %s" % (timeout, text))
        time.sleep(0.005)


def rough_surface(seed, rows=48, cols=64, rms_height=5e-9):
    """Smoothed noise, rows x cols float32 [m]."""
    noise = np.random.RandomState(seed).normal(size=(rows, cols))
    spectrum = np.fft.rfft2(noise)
    ky, kx = np.meshgrid(np.fft.fftfreq(rows), np.fft.rfftfreq(cols), indexing="ij")
    smooth = np.fft.irfft2(spectrum * np.exp(-(kx**2 + ky**2) * 200.0), s=(rows, cols))
    return (smooth * rms_height / smooth.std()).astype(np.float32)


def image_message(heights, stamp, encoding="32FC1"):
    message = Image()
    message.header.stamp = stamp
    message.header.frame_id = "scan"
    message.height, message.width = heights.shape
    message.encoding = encoding
    message.step = heights.shape[1] * heights.dtype.itemsize
    message.data = heights.tobytes()
    return message


def info_message(stamp, pitch=PITCH):
    message = ScanInfo()
    message.header.stamp = stamp
    message.pitch_x = message.pitch_y = pitch
    return message


def figures(prediction):
    """Every field as it was sent, bit for bit, but the wall time and header.seq, which is the
    publisher's."""
    import io

    copy_of = StictionPrediction()
    buffer = io.BytesIO()
    prediction.serialize(buffer)
    copy_of.deserialize(buffer.getvalue())
    copy_of.processing_time = 0.0
    copy_of.header.seq = 0
    buffer = io.BytesIO()
    copy_of.serialize(buffer)
    return buffer.getvalue()


def listeners(topic):
    """Names of the nodes that the publishers of a topic send its messages to, as these say
    themselves."""
    topic = rospy.resolve_name(topic)
    master = rosgraph.Master(rospy.get_name())
    found = set()
    for name in next(
        (nodes for published, nodes in master.getSystemState()[0] if published == topic), []
    ):
        if name == rospy.get_name():
            continue
        try:
            _, _, connections = xmlrpc.client.ServerProxy(master.lookupNode(name)).getBusInfo(
                rospy.get_name()
            )
        except (OSError, rosgraph.MasterError, xmlrpc.client.Fault):  # a node that goes or has gone
            continue
        found.update(one[1] for one in connections if one[2] == "o" and one[4] == topic)
    return found


def wait_for_listener(topic, node):
    """Until a publisher of the topic has counted the node, whose name may begin so, as a
    listener."""
    wait_until(
        lambda: any(name.startswith(node) for name in listeners(topic)),
        "%s to listen to %s" % (node, topic),
    )


class Collector:
    """Keeps every message of a topic in the order of arrival."""

    open = collections.Counter()  # of this process, by topic: they share one connection

    def __init__(self, topic, kind):
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=1000)
        self._topic = rospy.resolve_name(topic)
        self.open[self._topic] += 1

    def connect(self):
        wait_until(
            lambda: self._subscriber.get_num_connections() > 0, "a publisher of " + self._topic
        )
        wait_for_listener(
            self._topic, rospy.get_name()
        )  # roscpp answers a listener before it counts it
        return self

    def close(self):
        """Once the publisher has heard of it: the next scan takes another way to the node."""
        self._subscriber.unregister()
        self.open[self._topic] -= 1
        if not self.open[self._topic]:
            wait_until(
                lambda: rospy.get_name() not in listeners(self._topic),
                "the publisher of %s to hear of the end" % self._topic,
            )

    def of(self, stamp):
        """The newest message of this stamp; topics do not wait for each other."""
        found = []

        def comes():
            found[:] = [message for message in list(self.messages) if message.header.stamp == stamp]
            return found

        wait_until(comes, "a message of %s for the scan of stamp %s" % (self._topic, stamp))
        return found[-1]

    def wait(self, count):
        wait_until(
            lambda: len(self.messages) >= count,
            "message %d of %s, got %d" % (count, self._topic, len(self.messages)),
        )
        return self.messages


class Counts:
    """The newest figures of a node on /diagnostics."""

    def __init__(self, node="stiction_node", status="scans"):
        self._name = "%s: %s" % (node, status)
        self._lock = threading.Lock()
        self._values = {}
        self._reports = []
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._take, queue_size=100)

    def _take(self, message):
        for status in message.status:
            if status.name == self._name:
                with self._lock:
                    self._values = {entry.key: entry.value for entry in status.values}
                    self._reports.append((status.level, status.message))

    def __getitem__(self, key):
        with self._lock:
            return self._values.get(key, "")

    def total(self, *keys):
        """Their sum; one that was not reported yet is 0."""
        return sum(int(self[key] or 0) for key in keys)

    def reasons(self):
        with self._lock:
            return [message for level, message in self._reports if level > 0]

    def level(self):
        with self._lock:
            return self._reports[-1][0]

    def fresh(self):
        """The figures of a report that was made after this call."""
        before = len(self._reports)
        wait_until(lambda: len(self._reports) > before + 1, "two more reports")
        return self

    def wait(self, **expected):
        def reached():
            return all(self[key] == str(value) for key, value in expected.items())

        try:
            wait_until(reached, "the counts %s" % expected)
        except AssertionError as error:
            raise AssertionError("%s; they are %s" % (error, self._values))


class SourceCounts(Counts):
    """The books of a scan_source."""

    def wait_for_listeners(self):
        wait_until(
            lambda: self["found"] and not self["hindered_by"], "whoever listens to the source"
        )


def source_counts(node="scan_source"):
    return SourceCounts(node, "scan_source")


def connected(publisher):
    """Names of the nodes that a publisher of this process is connected to."""
    return {one[1] for one in publisher.impl.get_stats_info()}


class Station:
    """Sends scans as a camera driver does: height and scan_info with one stamp."""

    def __init__(self, prefix=""):
        self.height = rospy.Publisher(prefix + "height", Image, queue_size=1000)
        self.info = rospy.Publisher(prefix + "scan_info", ScanInfo, queue_size=1000)
        wait_until(
            lambda: connected(self.height) & connected(self.info), "the node to subscribe to both"
        )
        self._second = 1000

    def stamp(self):
        self._second += 1
        return rospy.Time(self._second)

    def count(self):
        """How many stamps were given."""
        return self._second - 1000

    def send(self, heights, stamp=None, **info):
        stamp = stamp or self.stamp()
        self.height.publish(image_message(heights, stamp))
        self.info.publish(info_message(stamp, **info))
        return stamp


def write_grid(path, heights):
    """A text grid from which every height comes back to the bit."""
    path.write_text(
        "".join(" ".join(repr(float(height)) for height in row) + "\n" for row in heights)
    )


def settings_of(station=STATION, changes=None, **more):
    """The settings of a rostest's node as the command line takes them, with others in their place.

    changes: values by their whole keys, "device/travel"; more: whole sections.
    """
    settings = {
        key: value
        for key, value in yaml.safe_load(station.read_text()).items()
        if key not in NODE_KEYS
    }
    settings.update(more)
    for key, value in (changes or {}).items():
        section, name = key.split("/")
        settings.setdefault(section, {})[name] = value
    return settings


def predict_scan(heights, load, voltage=0.0, counter=None, arguments=(), settings=None):
    """The record of the command line for the same heights [m], at the settings of station.yaml or
    those that are given, counter-surface [m] or none. Loads that are None are those of the
    settings.
    """
    program = find_node("mems_stiction", "predict_scan")[0]
    settings = dict(settings_of() if settings is None else settings)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_grid(folder / "scan.txt", heights)
        if counter is not None:
            write_grid(folder / "counter.txt", counter)
            settings.update(
                counter_surface={
                    "type": "file",
                    "file": str(folder / "counter.txt"),
                    "facing": "down",
                },
                scan={"pitch_x": PITCH, "pitch_y": PITCH},
            )
        (folder / "config.yaml").write_text(yaml.safe_dump(settings))
        given = [] if load is None else ["--load", repr(load)]
        given += [] if voltage is None else ["--voltage", repr(voltage)]
        done = subprocess.run(
            [
                program,
                "--json",
                "--config",
                folder / "config.yaml",
                "--pitch",
                repr(PITCH),
                *given,
                *arguments,
                folder / "scan.txt",
            ],
            check=True,
            timeout=TIMEOUT,
            stdout=subprocess.PIPE,
        )
    return dict(json.loads(done.stdout), checksum="")  # heights of a message come from no file


def unlike(message, record, leaving_out=()):
    """Names, figures of a StictionPrediction and figures of predict_scan's record wherever the two
    differ in any bit."""
    found = []

    def compare(name, value, expected):
        if isinstance(expected, dict):
            for key, inner in expected.items():
                compare(key, getattr(value, key), inner)
            return
        if name in WORDS:
            expected = getattr(StictionPrediction, WORDS[name] + expected.upper())
        elif name == "curve":
            value = [
                (point.displacement, point.force, bool(point.is_separation)) for point in value
            ]
            expected = [
                (point["displacement"], point["force"], point["is_separation"])
                for point in expected
            ]
        elif isinstance(expected, str):
            expected = expected.replace(
                ",", ";"
            )  # no text of a message breaks the columns of rostopic echo
        elif isinstance(expected, list):
            expected = [
                text.replace(",", ";") if isinstance(text, str) else text for text in expected
            ]
        if not (
            not math.isfinite(value) if expected is None else value == expected
        ):  # JSON has neither NaN nor infinity
            found.append((name, value, expected))

    for name, expected in record.items():
        if name not in NOT_COMPARED and name not in leaving_out:
            compare(name, getattr(message, name), expected)
    return found


def resident_bytes(process):
    """Memory of a process."""
    return 1024 * _status_of(process, "VmRSS")


def thread_count(process):
    return _status_of(process, "Threads")


def _status_of(process, name):
    return int(
        pathlib.Path("/proc/%d/status" % process.pid).read_text().split(name + ":")[1].split()[0]
    )


def _computed_seconds(stat):
    fields = stat.read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def processor_seconds(process):
    """What the process has computed so far."""
    return _computed_seconds(pathlib.Path("/proc/%d/stat" % process.pid))


def bytes_of(message):
    """The message as publishers send it."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def stating(count, data, place):
    """The bytes with an array at a place that states so many elements."""
    return data[:place] + struct.pack("<I", count) + data[place + 4 :]


class BytesPublisher:
    """Publishes bytes as a hostile program may, under the name of a type."""

    def __init__(self, topic, kind):
        self._type = type(
            "Bytes",
            (AnyMsg,),
            dict(_md5sum=kind._md5sum, _type=kind._type, _full_text=kind._full_text),
        )
        self._publisher = rospy.Publisher(topic, self._type, queue_size=100)
        wait_until(self._publisher.get_num_connections, "somebody to listen to %s" % topic)

    def publish(self, data):
        message = self._type()
        message._buff = data
        self._publisher.publish(message)

    def end(self):
        self._publisher.unregister()


def peak_memory(process):
    """What a process, by its number, has held at most so far [bytes]."""
    return 1024 * int(
        pathlib.Path("/proc/%d/status" % process).read_text().split("VmHWM:")[1].split()[0]
    )


def process_of(topic):
    """Number of the process that publishes this topic."""
    master = rosgraph.Master(rospy.get_name())
    publishers = next(
        nodes for name, nodes in master.getSystemState()[0] if name == rospy.resolve_name(topic)
    )
    return xmlrpc.client.ServerProxy(master.lookupNode(publishers[0])).getPid(rospy.get_name())[2]


def thread_seconds(pid):
    """{thread: what it has computed so far [s]} of the process."""
    seconds = {}
    for stat in pathlib.Path("/proc/%d/task" % pid).glob("*/stat"):
        with contextlib.suppress(OSError):  # one that ended meanwhile
            seconds[stat.parent.name] = _computed_seconds(stat)
    return seconds


class OwnNode:
    """A node beside that of the launch file, in a namespace of its name, for as long as the block
    runs."""

    def __init__(self, name, **more):
        self.name = name
        for key, value in dict(yaml.safe_load(STATION.read_text()), **more).items():
            rospy.set_param("/%s/node/%s" % (name, key), value)

    def __enter__(self):
        self.process = subprocess.Popen(
            [find_node("mems_stiction", "stiction_node")[0], "__name:=node"],
            env=dict(os.environ, ROS_NAMESPACE="/" + self.name),
        )
        rospy.wait_for_service("/%s/node/predict" % self.name, timeout=TIMEOUT)
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(timeout=TIMEOUT)
            except subprocess.TimeoutExpired:
                self.process.kill()
                raise

    def kill(self):
        self.process.kill()
        self.process.wait()

    def resident(self):
        return resident_bytes(self.process)


class Traffic:
    """Sends scans one after the other, on a thread of its own, for as long as the block runs.

    predictions: a Collector; the scans then run no further ahead of what it gets than LEAD, however
    slow the node is.
    """

    LEAD = 50

    def __init__(self, station, surfaces, period=0.02, predictions=None):
        self.surfaces = surfaces
        self.sent = {}  # stamp: heights; from before a scan is sent
        self.newest = None  # of the stamps
        self._predictions = predictions
        self._before = len(predictions.messages) if predictions else 0
        # The thread sanitizer has one processor, on which scans that come as fast as ever would
        # leave nothing for others.
        self._station, self._period = station, period * (50 if SANITIZER == "thread" else 1)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def _run(self):
        number = 0
        while not self._stop.is_set():
            if (
                self._predictions is None
                or number - (len(self._predictions.messages) - self._before) < self.LEAD
            ):
                surface, stamp = self.surfaces[number % len(self.surfaces)], self._station.stamp()
                self.sent[stamp], self.newest = surface, stamp
                self._station.send(surface, stamp)
                number += 1
            time.sleep(self._period)

    def __enter__(self):
        self._thread.start()
        wait_until(lambda: len(self.sent) > 3, "traffic")
        return self

    def __exit__(self, *_):
        self._stop.set()
        self._thread.join()


def make_bag(path, *arguments):
    # rosrun looks into no folder called build below the package.
    program = find_node("mems_stiction", "make_scan_bag")[0]
    subprocess.run([program, "-o", path] + list(arguments), check=True, timeout=300)


def recorded_stamps(folder, *topics):
    """Of the messages on each topic in the folder's recording of a day."""
    (bag,) = folder.glob("day*.bag")
    with rosbag.Bag(str(bag)) as recording:
        return {
            topic: {message.header.stamp for _, message, _ in recording.read_messages([topic])}
            for topic in topics
        }


def play_bag(path):
    """As the documentation tells users to replay without loss."""
    subprocess.run(
        ["rosbag", "play", "--quiet", "--wait-for-subscribers", path],
        check=True,
        timeout=300,
        stdin=subprocess.DEVNULL,
    )
