"""From the node's topics to a PageState. Starts without a master, says what it waits for, and
follows a master that is started anew."""

import threading
import time

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from mems_stiction.msg import (
    CycleContactActionFeedback,
    CycleContactActionResult,
    DeviceAdhesion,
    DeviceVerdict,
    HalfSpaceSolution,
    PartVerdict,
    ScanInfo,
    StictionPrediction,
    SweepLoadActionFeedback,
    SweepLoadActionResult,
)
from mems_stiction.page_words import SOURCE_STATUS
from sensor_msgs.msg import Image

LOOK_PERIOD = 1.0  # [s]
JOIN_PERIOD = 0.05  # of looks for the node, until scan_info is heard [s]
MAPS = ("height", "contacts")
SMALLEST_PITCH, LARGEST_PITCH = 1e-12, 1e-3  # of a size that is shown [m]
MAP_BUFFER = 2**28  # bytes: the newest map alone is kept


class PageListener:
    """Subscribes as soon as there is a master; `follow` is a thread of its own."""

    def __init__(self, state, node):
        self._state, self._node = state, node
        self._subscribers = []
        self._infos_of = None
        self._infos = {}
        self._pairing = threading.Lock()  # of maps and infos: either may come first

    def start(self):
        threading.Thread(target=self.follow, daemon=True).start()

    def follow(self):
        master = rosgraph.Master(rospy.get_name())
        while not rospy.is_shutdown() and not master.is_online():
            self._state.set_link(
                "error",
                "No ROS master at %s: start roscore or a launch file. This page waits."
                % rosgraph.get_master_uri(),
            )
            time.sleep(LOOK_PERIOD)
        rospy.init_node("station_page", anonymous=True, disable_signals=True)
        self._subscribe()
        while not rospy.is_shutdown():
            self._look(rosgraph.Master(rospy.get_name()))
            looks_again = time.monotonic() + LOOK_PERIOD
            while not self._hears_scans() and time.monotonic() < looks_again:
                time.sleep(JOIN_PERIOD)
            time.sleep(max(0.0, looks_again - time.monotonic()))

    def _look(self, master):
        try:
            master.lookupNode(rospy.get_name())
        except (
            rosgraph.MasterError
        ):  # another one, which knows nothing of this node: rospy does not notice
            for subscriber in self._subscribers:
                subscriber.unregister()
            return self._subscribe()
        except OSError:
            return self._state.set_link(
                "error", "The ROS master at %s is gone." % rosgraph.get_master_uri()
            )
        if self._subscribers[0].get_num_connections():
            return self._state.set_link("ok", "Connected to the node.")
        self._state.set_link(
            "error",
            "No node publishes %s: nothing is predicted. roslaunch mems_stiction stiction.launch "
            "starts one." % self._subscribers[0].resolved_name,
        )

    def _hears_scans(self):
        """Subscribes to scan_info once the node's predictions are heard: a source starts when its
        audience has done so, and its first prediction would come too early."""
        is_heard = self._subscribers[0].get_num_connections() > 0
        if self._infos_of is not None and not is_heard:  # the node has ended
            self._subscribers.remove(self._infos_of)
            self._infos_of.unregister()
            self._infos_of = None
        if self._infos_of is None and is_heard:
            self._infos_of = rospy.Subscriber("scan_info", ScanInfo, self._on_info, queue_size=100)
            self._subscribers.append(self._infos_of)
        return self._infos_of is not None

    def _subscribe(self):
        self._infos_of = None
        topics = [
            ("prediction", StictionPrediction, self._on_prediction, None, dict(queue_size=1000)),
            ("part_verdict", PartVerdict, self._on_part, None, dict(queue_size=10)),
            (
                "deformed_height",
                Image,
                self._on_map,
                "height",
                dict(queue_size=1, buff_size=MAP_BUFFER),
            ),
            (
                "contact_map",
                Image,
                self._on_map,
                "contacts",
                dict(queue_size=1, buff_size=MAP_BUFFER),
            ),
            ("device_force", DeviceAdhesion, self._on_device, None, dict(queue_size=10)),
            ("verdict", DeviceVerdict, self._on_answer, None, dict(queue_size=100)),
            ("half_space", HalfSpaceSolution, self._on_half_space, None, dict(queue_size=10)),
            ("/diagnostics", DiagnosticArray, self._on_diagnostics, None, dict(queue_size=100)),
        ]
        for action, kind, feedback, result, take in (
            (
                "sweep_load",
                "sweep",
                SweepLoadActionFeedback,
                SweepLoadActionResult,
                self._state.add_sweep,
            ),
            (
                "cycle_contact",
                "cycles",
                CycleContactActionFeedback,
                CycleContactActionResult,
                self._state.add_cycles,
            ),
        ):
            topics += [
                (
                    "%s/%s/feedback" % (self._node, action),
                    feedback,
                    self._on_feedback,
                    kind,
                    dict(queue_size=10),
                ),
                (
                    "%s/%s/result" % (self._node, action),
                    result,
                    self._on_result,
                    take,
                    dict(queue_size=10),
                ),
            ]
        self._subscribers = [
            rospy.Subscriber(name, kind, callback, argument, **settings)
            for name, kind, callback, argument, settings in topics
        ]

    def _on_prediction(self, prediction):
        self._state.add_prediction(prediction.header.stamp.to_nsec(), prediction)

    def _on_part(self, part):
        self._state.add_part(part.header.stamp.to_nsec(), part)

    def _on_info(self, info):
        stamp = info.header.stamp.to_nsec()
        with self._pairing:
            self._infos[stamp] = (info.pitch_x, info.pitch_y)
            while len(self._infos) > 100:
                del self._infos[next(iter(self._infos))]
            for name in MAPS:
                found = self._state.map_of(name)
                if found and found[0] == stamp:
                    self._state.set_map(name, *found, self._size(*found))

    def _on_map(self, image, name):
        stamp = image.header.stamp.to_nsec()
        with self._pairing:
            self._state.set_map(name, stamp, image, self._size(stamp, image))

    def _size(self, stamp, image):
        """Width and height of the scan [m] by the pitch that its scan_info or the parameters state;
        None if neither does."""
        pitch = self._infos.get(stamp, (0.0, 0.0))
        if min(pitch) <= 0:
            pitch = [
                rospy.get_param_cached(self._node + "/scan/pitch_" + axis, 0.0) for axis in "xy"
            ]
        is_known = all(
            isinstance(one, (int, float)) and SMALLEST_PITCH <= one <= LARGEST_PITCH
            for one in pitch
        )
        return (image.width * pitch[0], image.height * pitch[1]) if is_known else None

    def _on_device(self, device):
        self._state.add_device(device.header.stamp.to_nsec(), device)

    def _on_answer(self, answer):
        self._state.add_answer(answer.header.stamp.to_nsec(), answer)

    def _on_half_space(self, solution):
        self._state.add_half_space(solution.header.stamp.to_nsec(), solution)

    def _on_diagnostics(self, message):
        for status in message.status:
            node, _, what = status.name.partition(": ")
            own, other = self._node.strip("/"), node.strip("/")
            is_our_source = (
                what == SOURCE_STATUS and own.rpartition("/")[0] == other.rpartition("/")[0]
            )
            if other == own or is_our_source:
                self._state.add_diagnostics(status)

    def _on_feedback(self, message, kind):
        self._state.add_progress(
            kind, message.status.goal_id.id, message.feedback.done, message.feedback.total
        )

    def _on_result(self, message, take):
        take(message.status.goal_id.id, message.result)
