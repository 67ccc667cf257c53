"""What scripts/soak --station does: soak_station.py GROUP FOLDER PORT MINUTES SEED.

A station with everything on, as roslaunch started it below GROUP: a folder into which files fall,
good, damaged and equal ones; four tabs of the page; device, half-space, drift and recording.
"""

from mems_stiction import interrupted  # before what is slow to import

import asyncio
import json
import os
import pathlib
import random
import sys
import threading
import time

import numpy as np
import soak
import tornado.websocket
from stiction_client import source_counts, wait_until

TABS = 4
PAUSE = 4.0  # between files [s], so that a device has its force before the next scan
SETTLED = 1.0 / 3.0  # share of the time after which caches and heaps are as large as they become
PROGRAMS = ("stiction_node", "scan_source", "station_page", "watch_drift", "record")


class Program(soak.Process):
    """One of the station."""

    def __init__(self, pid):
        super().__init__(pid)
        self.samples = []

    def sample(self):
        self.samples.append((self.memory(), self.handles(), self.threads()))

    def wrong(self):
        """What has grown, in words."""
        first = max(1, int(SETTLED * len(self.samples)))
        early = np.max(self.samples[:first], axis=0)
        late = np.max(self.samples[-first:], axis=0)
        found = []
        if late[0] > soak.SHARE_OF_GROWTH * early[0] and late[0] > early[0] + 20.0:
            found.append("memory from %.0f to %.0f MB" % (early[0], late[0]))
        for place, name in ((1, "handles"), (2, "threads")):
            if late[place] > early[place] + soak.MORE_HANDLES:
                found.append("%s from %d to %d" % (name, early[place], late[place]))
        return found


def processes_below(group):
    """The programs of the station, by name."""
    parents, names = {}, {}
    for status in pathlib.Path("/proc").glob("[0-9]*/status"):
        try:
            fields = dict(
                line.split(":", 1) for line in status.read_text().splitlines() if ":" in line
            )
            command = (status.parent / "cmdline").read_bytes().split(b"\0")
        except OSError:  # it has just ended
            continue
        pid = int(fields["Pid"])
        parents[pid] = int(fields["PPid"])
        names[pid] = [os.path.basename(part.decode("utf-8", "replace")) for part in command[:2]]
    found = {}
    for pid in parents:
        above = pid
        while above in parents and above != group:
            above = parents[above]
        if above == group:
            for name in PROGRAMS:
                if name in names[pid]:
                    found[name] = Program(pid)
    return found


class Tab(threading.Thread):
    """A browser's tab: takes all states of the page."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self._port = port
        self.states = 0
        self.closed = 0

    def run(self):
        asyncio.run(self._listen())

    async def _listen(self):
        while True:
            try:
                socket = await tornado.websocket.websocket_connect(
                    "ws://127.0.0.1:%d/state" % self._port
                )
            except OSError:  # the page is not there yet
                await asyncio.sleep(0.5)
                continue
            while True:
                await socket.write_message("next")
                text = await socket.read_message()
                if text is None:
                    self.closed += 1
                    break
                json.loads(text)
                self.states += 1
            await asyncio.sleep(1.0)


class Instrument:
    """Writes one file after the other: whole, damaged, or one that was there before."""

    def __init__(self, folder, seed):
        self._folder = folder
        self._chance = random.Random(seed)
        self.good = self.bad = self.equal = 0
        self._last = None

    def write(self):
        number = self.good + self.bad + self.equal
        name = "part%d_scan%06d.npy" % (number // 3, number)
        kind = self._chance.random()
        path, part = self._folder / name, self._folder / ("." + name)
        if kind < 0.05:
            path.write_bytes(b"\x93NUMPY" + os.urandom(200))
            self.bad += 1
        elif kind < 0.1 and self._last is not None:
            path.write_bytes(self._last)
            self.equal += 1
        else:
            side = self._chance.choice((96, 128, 192))
            noise = np.random.RandomState(self._chance.randrange(2**31)).normal(size=(side, side))
            waves = np.hypot(np.fft.fftfreq(side)[:, None], np.fft.fftfreq(side)[None, :])
            smooth = np.fft.ifft2(np.fft.fft2(noise) * np.exp(-((12.0 * waves) ** 2))).real
            with open(str(part), "wb") as file:
                np.save(file, self._chance.uniform(1e-9, 4e-9) / np.std(smooth) * smooth)
            part.rename(path)
            self._last = path.read_bytes()
            self.good += 1


def main(group, folder, port, minutes, seed):
    counts, published = soak.begin()
    source = source_counts()
    wait_until(lambda: len(processes_below(group)) == len(PROGRAMS), "all programs", 120.0)
    wait_until(lambda: source["found"], "the source to report")
    processes = processes_below(group)
    tabs = [Tab(port) for _ in range(TABS)]
    for tab in tabs:
        tab.start()
    instrument = Instrument(pathlib.Path(folder), seed)
    end = time.monotonic() + 60.0 * minutes
    next_sample = time.monotonic()
    print("minute  files  predictions  memory [MB] / handles / threads of each program", flush=True)
    while time.monotonic() < end:
        instrument.write()
        time.sleep(PAUSE)
        if time.monotonic() < next_sample:
            continue
        next_sample += 10.0
        for name, process in processes.items():
            try:
                process.sample()
            except FileNotFoundError:
                print("%s has ended: see its log below %s" % (name, os.environ["ROS_HOME"]))
                return 1
        if len(processes["stiction_node"].samples) % 12 == 1:
            print(
                "%6.1f %6d %12d  %s"
                % (
                    minutes - (end - time.monotonic()) / 60.0,
                    instrument.good + instrument.bad + instrument.equal,
                    len(published),
                    "  ".join(
                        "%s %.0f/%d/%d" % ((name,) + process.samples[-1])
                        for name, process in processes.items()
                    ),
                ),
                flush=True,
            )
    wait_until(lambda: len(published) >= instrument.good, "the last predictions", 120.0)
    wait_until(lambda: source["waiting"] == "0", "the source's last file", 60.0)
    print("source:", {key: source[key] for key in ("found", "published", "refused", "waiting")})
    print(
        "%d good files, %d damaged, %d equal to the one before; tabs took %s states"
        % (instrument.good, instrument.bad, instrument.equal, [tab.states for tab in tabs])
    )
    wrong = [
        "%s: %s" % (name, what) for name, process in processes.items() for what in process.wrong()
    ]
    if len(published) != instrument.good:
        wrong.append("%d predictions of %d files" % (len(published), instrument.good))
    if int(source["refused"]) != instrument.bad:
        wrong.append("%s files refused, %d are damaged" % (source["refused"], instrument.bad))
    if counts["predicted"] != str(instrument.good):
        wrong.append("the node counts %s predictions" % counts["predicted"])
    if min(tab.states for tab in tabs) < instrument.good or any(tab.closed for tab in tabs):
        wrong.append("a tab lost states or its connection")
    return soak.end_with(wrong)


if __name__ == "__main__":
    interrupted.raise_from_here_on()
    sys.exit(main(int(sys.argv[1]), sys.argv[2], *map(int, sys.argv[3:])))
