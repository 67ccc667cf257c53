"""What scripts/soak does to a running node: soak.py PID MINUTES SEED."""

from mems_stiction import interrupted  # before what is slow to import

import os
import random
import sys
import threading
import time

import actionlib
import numpy as np
import rospy
from dynamic_reconfigure import DynamicReconfigureCallbackException
from dynamic_reconfigure.client import Client
from mems_stiction.msg import (
    CycleContactAction,
    CycleContactGoal,
    ScanInfo,
    StictionPrediction,
    SweepLoadAction,
    SweepLoadGoal,
)
from mems_stiction.srv import GetLoad, Predict, SetLoad, SolveHalfSpace
from sensor_msgs.msg import Image
from std_srvs.srv import Trigger
from stiction_client import Counts, image_message, info_message, wait_until

LARGEST_SIDE = 700
ENCODINGS = {"32FC1": np.float32, "64FC1": np.float64, "16UC1": np.uint16, "mono8": np.uint8}
SHARE_OF_GROWTH = (
    1.25  # of the memory after a third of the time, which the largest frames have had by then
)
MORE_HANDLES = 8  # connections of our own that come and go


class Process:
    """What the system says of a process."""

    def __init__(self, pid):
        self._folder = "/proc/%d/" % pid

    def memory(self):
        """Resident [MB]."""
        with open(self._folder + "status") as status:
            return next(int(line.split()[1]) / 1024 for line in status if line.startswith("VmRSS"))

    def handles(self):
        return len(os.listdir(self._folder + "fd"))

    def threads(self):
        return len(os.listdir(self._folder + "task"))


def random_heights(chance, side):
    """Rough, noisy, quantised or level, of an encoding's type."""
    rows, cols = (max(1, int(side ** chance.random())) for _ in range(2))
    encoding = chance.choice(list(ENCODINGS))
    random_numbers = np.random.RandomState(chance.randrange(2**31))
    heights = random_numbers.normal(size=(rows, cols))
    if chance.random() < 0.6:
        heights = np.cumsum(np.cumsum(heights, 0), 1) / max(rows, cols)
    if chance.random() < 0.2:
        heights = np.round(heights)
    if encoding.startswith(("16", "mono")):
        return encoding, np.clip(100 + 10 * heights, 0, 255).astype(ENCODINGS[encoding])
    heights = 5e-9 * heights
    if chance.random() < 0.1:
        heights[random_numbers.random_sample(heights.shape) < 0.05] = np.nan
    return encoding, heights.astype(ENCODINGS[encoding])


class Scans:
    """Sends images with and without their other half, whole and broken, and counts them."""

    def __init__(self, chance):
        self._chance = chance
        self._height = rospy.Publisher("height", Image, queue_size=100)
        self._info = rospy.Publisher("scan_info", ScanInfo, queue_size=100)
        wait_until(
            lambda: self._height.get_num_connections() and self._info.get_num_connections(),
            "the node to subscribe",
        )
        self._second = 1000
        self.sent = 0

    def message(self, side=LARGEST_SIDE):
        self._second += 1
        encoding, heights = random_heights(self._chance, side)
        image = image_message(heights, rospy.Time(self._second), encoding)
        info = info_message(image.header.stamp)
        if encoding.startswith(("16", "mono")):
            info.height_scale = 1e-10
        return image, info

    def send(self):
        image, info = self.message()
        trouble = self._chance.random()
        if trouble < 0.03:
            image.step += 1
        elif trouble < 0.06:
            image.encoding = self._chance.choice(["rgb8", "", "32FC7"])
        elif trouble < 0.08:
            info.pitch_x = self._chance.choice([-1.0, float("nan"), 1e150])
        self._height.publish(image)
        self.sent += 1
        if trouble < 0.97:
            self._info.publish(info)


class Callers:
    """One random service or action after the other."""

    def __init__(self, chance, scans, is_first):
        node = "stiction_node/"
        self._chance = chance
        self._scans = scans
        self._is_first = is_first
        rospy.wait_for_service(node + "set_load", timeout=60.0)
        self._set_load = rospy.ServiceProxy(node + "set_load", SetLoad)
        self._get_load = rospy.ServiceProxy(node + "get_load", GetLoad)
        self._predict = rospy.ServiceProxy(node + "predict", Predict)
        self._solve = rospy.ServiceProxy(node + "solve_half_space", SolveHalfSpace)
        self._reset = rospy.ServiceProxy(node + "reset_surface", Trigger)
        self._sweep = actionlib.SimpleActionClient(node + "sweep_load", SweepLoadAction)
        self._cycle = actionlib.SimpleActionClient(node + "cycle_contact", CycleContactAction)
        self._settings = Client("stiction_node", timeout=60.0)
        for action in (self._sweep, self._cycle):
            assert action.wait_for_server(rospy.Duration(60)), "no action server"
        self.calls = 0
        self.failed = 0

    def one(self):
        self.calls += 1
        # a new goal ends the one before it, so each kind has one caller
        chosen = self._chance.choice(
            [
                self._load,
                self._one_scan,
                self._half_space,
                self._get_load,
                self._reset,
                self._sweep_load if self._is_first else self._cycle_contact,
                self._reconfigure,
                self._listen,
            ]
        )
        try:
            chosen()
        except (
            rospy.ServiceException,
            rospy.ROSException,
            DynamicReconfigureCallbackException,
        ):  # no answer, or none any more
            self.failed += 1

    def _load(self):
        self._set_load(
            self._chance.uniform(-60.0, 60.0),
            self._chance.choice([0.0, 1e-6, 1e-4, 1.0, float("nan")]),
        )

    def _one_scan(self):
        self._predict(*self._scans.message(300), self._chance.uniform(0.0, 50.0), 1e-6)

    def _half_space(self):
        image, info = self._scans.message(48)
        self._solve(image, info, float("nan"), float("nan"))

    def _run(self, client, goal):
        client.send_goal(goal)
        if not client.wait_for_result(rospy.Duration(self._chance.uniform(0.05, 3.0))):
            client.cancel_goal()
            client.wait_for_result(rospy.Duration(30.0))

    def _sweep_load(self):
        self._run(
            self._sweep,
            SweepLoadGoal(voltages=list(np.linspace(0.0, 40.0, self._chance.randrange(1, 20)))),
        )

    def _cycle_contact(self):
        self._run(self._cycle, CycleContactGoal(count=self._chance.randrange(0, 20)))

    def _reconfigure(self):
        self._settings.update_configuration({"voltage": self._chance.uniform(0.0, 50.0)})

    def _listen(self):
        """Maps and lists are made only while somebody listens."""
        topic, kind = self._chance.choice(
            [("deformed_height", Image), ("contact_map", Image), ("preview", Image)]
        )
        listener = rospy.Subscriber(topic, kind, lambda _: None)
        time.sleep(self._chance.uniform(0.0, 2.0))
        listener.unregister()


def begin():
    """What the node counts, and the stamps of its predictions, as they come."""
    rospy.init_node("soak", disable_signals=True)
    counts = Counts()
    published = []
    rospy.Subscriber(
        "prediction",
        StictionPrediction,
        lambda message: published.append(message.header.stamp),
        queue_size=1000,
    )
    return counts, published


def end_with(wrong):
    """Says what was wrong; the exit status."""
    print("; ".join(wrong) if wrong else "all is well")
    return 1 if wrong else 0


def main(pid, minutes, seed):
    counts, published = begin()
    process = Process(pid)
    scans = Scans(random.Random(seed))
    callers = [
        Callers(
            random.Random(seed + 1 + number), Scans(random.Random(seed + 100 + number)), number == 0
        )
        for number in range(2)
    ]
    end = time.monotonic() + 60.0 * minutes

    def call(caller):
        while time.monotonic() < end:
            caller.one()

    threads = [threading.Thread(target=call, args=(caller,), daemon=True) for caller in callers]
    for thread in threads:
        thread.start()

    def line():
        received = {
            key: counts[key] for key in ("received", "predicted", "rejected", "dropped", "waiting")
        }
        return process.memory(), process.handles(), process.threads(), received

    print("minute  memory [MB]  handles  threads    sent  calls  counts")
    pace = random.Random(seed + 50)
    samples = []
    next_sample = time.monotonic()
    while time.monotonic() < end:
        scans.send()
        time.sleep(pace.choice([0.0, 0.01, 0.05, 0.2]))
        if time.monotonic() >= next_sample:
            next_sample += 10.0
            samples.append(line())
            memory, handles, count, received = samples[-1]
            if len(samples) % 6 == 1:
                print(
                    "%6.1f %12.0f %8d %8d %7d %6d  %s"
                    % (
                        minutes - (end - time.monotonic()) / 60.0,
                        memory,
                        handles,
                        count,
                        scans.sent,
                        sum(caller.calls for caller in callers),
                        received,
                    ),
                    flush=True,
                )
    for thread in threads:
        thread.join(timeout=120.0)
    alive = [thread for thread in threads if thread.is_alive()]
    wait_until(
        lambda: (
            counts["waiting"] == "0"
            and counts["waiting_for_partner"] == "0"
            and counts["received"] == str(scans.sent)
        ),
        "the end of the scans: %d were sent, %s counted" % (scans.sent, counts["received"]),
        120.0,
    )
    figures = {
        key: int(counts[key])
        for key in ("received", "predicted", "rejected", "dropped", "missing_by_sequence")
    }
    wait_until(lambda: len(published) >= figures["predicted"], "the predictions")
    last = line()
    early = max(sample[0] for sample in samples[: max(1, len(samples) // 3)])
    late = max(sample[0] for sample in samples[-max(1, len(samples) // 3) :])
    handles = [sample[1] for sample in samples]
    print(
        "sent %d, counted %s; %d calls, %d of them without an answer"
        % (
            scans.sent,
            figures,
            sum(caller.calls for caller in callers),
            sum(caller.failed for caller in callers),
        )
    )
    print(
        "memory: largest in the first third %.0f MB, in the last third %.0f MB; handles %d to %d, "
        "%d in the end; threads %d" % (early, late, min(handles), max(handles), last[1], last[2])
    )
    wrong = []
    if figures["predicted"] + figures["rejected"] + figures["dropped"] != scans.sent:
        wrong.append("not every image was counted once")
    if len(published) != figures["predicted"]:
        wrong.append("%d predictions were published" % len(published))
    if late > SHARE_OF_GROWTH * early:
        wrong.append("memory has grown")
    if last[1] > samples[min(6, len(samples) - 1)][1] + MORE_HANDLES:
        wrong.append("handles have grown")
    if alive:
        wrong.append("%d callers got no answer" % len(alive))
    return end_with(wrong)


if __name__ == "__main__":
    interrupted.raise_from_here_on()
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])))
