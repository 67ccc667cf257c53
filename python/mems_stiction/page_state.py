"""What the station's page shows, in one place: newest scan, trend, maps, sweeps, cycles,
diagnostics. No ROS here.

Callbacks of topics write, the server reads; both may come from any thread. What grows is bounded.
"""

import collections
import re
import threading
import time

from mems_stiction.control_chart import control_limits, of_newest_settings
from mems_stiction.page_maps import require_map
from mems_stiction.page_places import SCAN, Wafers, is_of_scan, scan_of
from mems_stiction.page_words import (
    AWAITED,
    NO_EQUILIBRIUM,
    SOURCE_STATUS,
    awaits_device,
    curve_of,
    device_of,
    all_finite,
    diagnostics_of,
    figures_of,
    finite,
    flags_of,
    half_space_of,
    part_of,
    provisional_of,
    ratio_of,
    sentence,
    source_of,
    thinned_points,
    trace_of,
    verdict_of,
    with_unit,
)
from mems_stiction.provenance import provenance_words
from mems_stiction.message_rows import flattened
from mems_stiction.prediction_text import contact_area_of, ratio_name, ratio_value
from mems_stiction.quantities import typeset
from mems_stiction.row_table import Stamp
from mems_stiction.station_text import (
    area_label,
    cycle_sentences,
    safe_voltage_words,
    sweep_sentences,
    why_no_margin,
)
from mems_stiction.sweep_jumps import jumps_of

MOST_SCANS = 300  # of the trend
MOST_LOSSES = 50  # with their reasons
MOST_PARTS = 100  # whose newest verdicts are kept, as many as the node keeps
MOST_ANSWERS = 100  # of the node on its scans, as many as it may still change
MOST_DIAGNOSTICS = 30  # statuses of the node, by their names
MOST_POINTS = (
    20000  # of a sweep or of cycles: more are beyond any that was seen, and keep browsers busy
)
MOST_PERIODS = 9  # between scans, by which their rate is known
STALE_UNTIL_KNOWN = (
    30.0  # without a scan for so long, what is shown is old, while the scans' rate is not known [s]
)
STALE_PERIODS, SHORTEST_STALE = 3.0, 5.0  # so many usual periods, and at least so long [s]
SILENT_SOURCE = 10.0  # without its diagnostics for so long, a source is perhaps gone [s]
UP = 0  # SweepPoint.UP


def stamp_of_reason(reason):
    """ "rejected the scan of stamp 1001.500000000: ..." -> 1001500000000 [ns]; None where there is
    no stamp."""
    match = re.search(r"of stamp (\d+)\.(\d{9}):", reason)
    return int(match.group(1)) * 10**9 + int(match.group(2)) if match else None


def count_of(text):
    """A number of scans as diagnostics tell it; None for anything else."""
    return int(text) if re.fullmatch(r"[0-9]{1,18}", text) else None


def _told_of(prediction):
    """What the page says of a prediction, whatever comes after it."""
    return {
        "name": prediction.scan_name or prediction.header.frame_id,
        "verdict": verdict_of(prediction),
        "ratio": ratio_of(prediction),
        "flags": flags_of(prediction),
        "warnings": [typeset(text) for text in prediction.warnings],
        "figures": figures_of(prediction),
        "trace": trace_of(prediction),
        "origin": provenance_words(prediction),
        "curve": curve_of(prediction),
        "preprocessing": [typeset(text) for text in prediction.preprocessing],
    }


def _jumps_of(result):
    """The jumps of a sweep as plots of it number them: where they are, and why."""
    jumps = [
        (load, jump)
        for load in sorted({point.mechanical_load for point in result.points})
        for jump in jumps_of(result.points, load, result.pull_in_voltage)
    ]
    return [
        {
            "number": number,
            "load": load,
            "voltage": 0.5 * (jump.before.voltage + jump.after.voltage),
            "area": 0.5 * (contact_area_of(jump.before) + contact_area_of(jump.after)),
            "words": typeset(jump.words()),
        }
        for number, (load, jump) in enumerate(jumps, 1)
    ]


class PageState:
    """The newest of everything. `version` grows with each change."""

    def __init__(self, clock=time.monotonic):
        self._clock = clock
        self._lock = threading.RLock()
        self.version = 1
        self._link = {"level": "error", "text": "Starting."}
        self._count = 0  # scans, with those that were lost
        self._lost = 0
        self._node_losses = None  # as the node counts them
        self._trend = collections.deque(maxlen=MOST_SCANS)
        self._losses = collections.deque(maxlen=MOST_LOSSES)
        self._latest = None  # (number, stamp, prediction, what the page says of it)
        self._broken = {}  # part of the page: why it cannot be shown
        self._loss_is_newest = False
        self._heard = None  # when the last scan was predicted
        self._periods = collections.deque(maxlen=MOST_PERIODS)  # between predictions [s]
        self._half_space = None
        self._device = None
        self._answers = collections.OrderedDict()  # scan -> newest DeviceVerdict on it
        self._judged = None  # (number, verdict, ratio) of the newest scan that a device judged
        self._part = None
        # newest last: (part, serial number) -> (what the page shows, message, when)
        self._parts = {}
        self._wafers = Wafers()
        self._maps = {}
        self._map_notes = {}  # why the newest map of a name is not among them
        self._diagnostics = {}
        self._runs = {}

    def _changed(self):
        self.version += 1

    def set_link(self, level, text):
        """How the page hears of the node: "ok", "warn" or "error", and a sentence."""
        with self._lock:
            if self._link != {"level": level, "text": text}:
                self._link = {"level": level, "text": text}
                self._changed()

    def add_prediction(self, stamp, prediction):
        """stamp: of the scan [ns]."""
        name, told = (
            ratio_name(prediction),
            _told_of(prediction),
        )  # before anything changes: what cannot be told is not shown
        device_force = prediction.device_pull_off_force
        with self._lock:
            self._count += 1
            self._trend.append(
                {
                    "number": self._count,
                    **scan_of(stamp, prediction),
                    "force": finite(prediction.pull_off_force),
                    "device_force": finite(device_force),
                    "restoring_force": finite(prediction.restoring_force),
                    "ratio": finite(getattr(prediction, name)),
                    "lower": finite(getattr(prediction, name + "_lower")),
                    "upper": finite(getattr(prediction, name + "_upper")),
                    "level": told["verdict"]["level"],
                    "settings": prediction.settings_hash,
                    "is_usable": prediction.status != NO_EQUILIBRIUM,
                }
            )
            self._wafers.add(stamp, prediction)
            self._latest = (self._count, stamp, prediction, told)
            self._loss_is_newest = False
            if self._heard is not None:
                self._periods.append(self._clock() - self._heard)
            self._heard = self._clock()
            self._changed()

    def add_diagnostics(self, status):
        """One status of the node. Scans that it rejected or dropped since its last one become part
        of the trend."""
        entry = diagnostics_of(status)
        values = dict(entry["values"])
        with self._lock:
            _, before, _ = self._diagnostics.pop(entry["name"], (None, self._clock(), None))
            now = self._clock()
            self._diagnostics[entry["name"]] = (entry, now, now - before)
            while len(self._diagnostics) > MOST_DIAGNOSTICS:
                del self._diagnostics[next(iter(self._diagnostics))]
            counts = [count_of(values.get(name, "")) for name in ("rejected", "dropped")]
            if None not in counts:
                losses = sum(counts)
                before, self._node_losses = self._node_losses, losses
                if (
                    before is not None
                ):  # those before the first look were not ours; a node that restarts counts from 0
                    self._lose(
                        losses - before if losses >= before else losses,
                        values.get("last_reason", ""),
                    )
            self._changed()

    def _lose(self, count, reason):
        for _ in range(min(count, MOST_SCANS)):
            self._count += 1
            self._lost += 1
            self._trend.append({"number": self._count, "lost": reason})
        if count > 0:
            self._losses.append({"number": self._count, "count": count, "reason": sentence(reason)})
            stamp = stamp_of_reason(reason)
            self._loss_is_newest = self._latest is None or stamp is None or stamp > self._latest[1]

    def add_half_space(self, stamp, solution):
        with self._lock:
            self._half_space = dict(half_space_of(solution), **scan_of(stamp, solution))
            self._changed()

    def add_device(self, stamp, device):
        """The force of the whole device, by the scan of this stamp [ns] and those of its part
        before."""
        with self._lock:
            scan = scan_of(stamp, device)
            shown = dict(device_of(device), **scan)
            if not self._is_earlier(scan, self._device):
                self._device = shown
            if shown["is_found"]:
                self._wafers.judge(stamp, device)
                number = self._number_of(scan)
                if number is not None and (self._judged is None or number >= self._judged[0]):
                    self._judged = (number, shown["verdict"], shown["ratio"])
                ratio = shown["ratio"] or dict.fromkeys(("value", "lower", "upper"))
                for row in self._trend:
                    if is_of_scan(row, scan):
                        row.update(
                            device_force=shown["force"],
                            restoring_force=shown["restoring_force"],
                            ratio=ratio["value"],
                            lower=ratio["lower"],
                            upper=ratio["upper"],
                            level=shown["verdict"]["level"],
                        )
            self._changed()

    def add_answer(self, stamp, answer):
        """What the node says by now of the device of this scan [ns], and what that waits for."""
        with self._lock:
            scan = tuple(scan_of(stamp, answer).values())
            self._answers.pop(scan, None)
            self._answers[scan] = answer
            while len(self._answers) > MOST_ANSWERS:
                self._answers.popitem(last=False)
            self._changed()

    def add_part(self, stamp, part):
        """What all scans of a part say together. stamp: of its last scan [ns]."""
        with self._lock:
            scan = scan_of(stamp, part)
            shown = dict(part_of(part), **scan)
            if not self._is_earlier(scan, self._part):
                self._part = shown
            self._parts.pop((part.part_id, part.serial_id), None)
            self._parts[part.part_id, part.serial_id] = (shown, part, self._clock())
            while len(self._parts) > MOST_PARTS:
                del self._parts[next(iter(self._parts))]
            self._changed()

    def scan_row(self):
        """The newest prediction as a row, {column: cell} with the names of its message; None before
        the first."""
        with self._lock:
            return self._latest and dict(
                number=self._latest[0],
                stamp=str(Stamp(self._latest[1])),
                **flattened(self._latest[2]),
            )

    def part_rows(self):
        """The newest verdict on each part as a row, with the names of PartVerdict; the part that
        was heard of last comes last."""
        with self._lock:
            return [flattened(message) for _, message, _ in self._parts.values()]

    def wafers(self):
        """What page_wafers.told takes; the same object until a place changes."""
        with self._lock:
            return self._wafers.rows_and_counts()

    def stale_after(self):
        """For how long nothing may come before what is shown is old [s]: three times as long as it
        usually takes."""
        with self._lock:
            if not self._periods:
                return STALE_UNTIL_KNOWN
            usual = sorted(self._periods)[len(self._periods) // 2]
            return max(SHORTEST_STALE, STALE_PERIODS * usual)

    def set_map(self, name, stamp, image, size=None):
        """An image message that is drawn when a browser asks for it. size: (width, height) of the
        scan [m], if known."""
        try:
            require_map(name, image)
            note = None
        except ValueError as error:
            note = "The newest map of %s cannot be shown: %s." % (name, error)
        with self._lock:
            self._map_notes.pop(name, None)
            if note is None:
                self._maps[name] = (stamp, image, size)
            else:
                self._map_notes[name] = note
            self._changed()

    def map_of(self, name):
        """(stamp, image message), or None."""
        with self._lock:
            found = self._maps.get(name)
            return found and found[:2]

    def size_of(self, name):
        """(width, height) [m] of what a map shows; None where it is not known."""
        with self._lock:
            return self._maps[name][2]

    def add_progress(self, kind, goal, done, total):
        """Of the sweep or the cycles that run. Progress of a goal that has ended comes too late:
        topics do not wait for each other."""
        with self._lock:
            run = self._runs.setdefault(kind, {})
            if run.get("goal") != goal:
                run["progress"] = [done, total]
                self._changed()

    def add_sweep(self, goal, result):
        del result.points[MOST_POINTS:]
        points = [
            {
                "way": "up" if point.direction == UP else "down",
                "load": point.mechanical_load,
                "load_text": with_unit(point.mechanical_load, "N"),
                "voltage": point.voltage,
                "margin": finite(ratio_value(point)),
                "lower": finite(ratio_value(point, "_lower")),
                "upper": finite(ratio_value(point, "_upper")),
                "held": finite(point.holding_margin),
                "force": finite(point.pull_off_force),
                "force_lower": finite(point.pull_off_force_lower),
                "force_upper": finite(point.pull_off_force_upper),
                "area": finite(contact_area_of(point)),
                "is_open": bool(point.is_open),
            }
            for point in result.points
            if finite(point.voltage) is not None
        ]
        points = thinned_points(points)
        safe = [
            {
                "load": summary.mechanical_load,
                "load_text": with_unit(summary.mechanical_load, "N"),
                "voltage": finite(summary.highest_safe_voltage),
                "words": typeset(safe_voltage_words(summary, result.points)),
            }
            for summary in result.summaries
        ]
        self._end(
            "sweep",
            goal,
            points,
            sweep_sentences(result, width=None, why=self._why_no_margin(result)) if points else [],
            result.message,
            safe=safe,
            jumps=_jumps_of(result) if points else [],
            area_label=area_label(result.points),
            pull_in=finite(result.pull_in_voltage),
        )

    def add_cycles(self, goal, result):
        del result.cycles[MOST_POINTS:]
        points = [
            {
                "cycle": cycle.cycle,
                "force": finite(cycle.pull_off_force),
                "margin": finite(ratio_value(cycle)),
                "lower": finite(ratio_value(cycle, "_lower")),
                "plastic": cycle.plastic_count,
            }
            for cycle in result.cycles
        ]
        sentences = cycle_sentences(result, width=None, why=self._why_no_margin(result))
        self._end("cycles", goal, thinned_points(points), sentences, result.message)

    def _why_no_margin(self, result):
        """Of the scan of a run, if that is the newest one; else empty."""
        with self._lock:
            is_of_newest = self._latest and self._latest[1] == result.header.stamp.to_nsec()
            return why_no_margin(self._latest[2]) if is_of_newest else ""

    def _end(self, kind, goal, points, sentences, message, **more):
        with self._lock:
            self._runs[kind] = dict(
                more,
                goal=goal,
                points=points,
                sentences=[typeset(text) for text in sentences],
                message=message,
                ended=self._clock(),
            )
            self._changed()

    def snapshot(self):
        """All of it, as JSON can have it; ages in seconds."""
        with self._lock:
            now = self._clock()
            self._broken = {}
            parts = {
                "losses": (lambda: list(self._losses), []),
                "scan": (self._scan, None),
                "trend": (lambda: list(self._trend), []),
                "control": (self._control, None),
                "part": (self._shown_part, None),
                "parts": (
                    lambda: [
                        dict(shown, number=self._number_of_shown(shown), age=now - heard)
                        for shown, _, heard in self._parts.values()
                    ],
                    [],
                ),
                "half_space": (lambda: self._with_number(self._half_space), None),
                "device": (lambda: self._with_number(self._device), None),
                "maps": (self._shown_maps, {}),
                "diagnostics": (
                    lambda: [
                        dict(entry, age=now - heard)
                        for _, (entry, heard, _) in sorted(self._diagnostics.items())
                    ],
                    [],
                ),
                "sources": (
                    lambda: [
                        dict(
                            source_of(entry),
                            age=now - heard,
                            silent_after=max(SILENT_SOURCE, STALE_PERIODS * period),
                        )
                        for name, (entry, heard, period) in sorted(self._diagnostics.items())
                        if name.endswith(": " + SOURCE_STATUS)
                    ],
                    [],
                ),
                "runs": (
                    lambda: {kind: self._run(run, now) for kind, run in self._runs.items()},
                    {},
                ),
            }
            shown = {
                name: self._part_or_empty(name, make, empty)
                for name, (make, empty) in parts.items()
            }
            return all_finite(
                dict(
                    shown,
                    version=self.version,
                    link=self._link,
                    age=None if self._heard is None else now - self._heard,
                    count=self._count,
                    lost=self._lost,
                    loss_is_newest=self._loss_is_newest,
                    stale_after=self.stale_after(),
                    wafers=self._wafers.version,
                    map_notes=list(self._map_notes.values()),
                    broken=list(self._broken.values()),
                )
            )

    def _part_or_empty(self, name, make, empty):
        """One part of the page never hides the others."""
        try:
            return make()
        except Exception as error:
            self._broken[name] = "%s cannot be shown (%s: %s)" % (name, type(error).__name__, error)
            return empty

    def _scan(self):
        if self._latest is None:
            return None
        number, stamp, prediction, told = self._latest
        verdict, ratio, warnings, figures = (
            told["verdict"],
            told["ratio"],
            told["warnings"],
            told["figures"],
        )
        device = self._device_of_newest()
        if self._is_awaiting():
            verdict, ratio = provisional_of(prediction, self._answer_of_newest(), self._judged)
        elif device is not None and not device["is_found"] and AWAITED in prediction.reason:
            verdict = dict(verdict, reason=device["message"])
        elif device is not None and device["is_found"]:
            verdict, ratio = dict(device["verdict"]), device["ratio"]
            if device["settings_hash"] != prediction.settings_hash:
                verdict["reason"] += " Judged again, under the settings of now."
            warnings = warnings + device["warnings"]
            figures = [figure for figure in figures if figure["name"] != "device_pull_off_force"]
        return dict(
            told,
            number=number,
            stamp="%d.%03d" % divmod((stamp + 500000) // 10**6, 1000),
            verdict=verdict,
            ratio=ratio,
            warnings=warnings,
            figures=figures,
        )

    def _device_of_newest(self):
        """What is told of the device by the newest scan; None before that is told."""
        return self._device if self._is_of_newest(self._device) else None

    def _is_of_newest(self, shown):
        return bool(shown and self._latest and is_of_scan(shown, scan_of(*self._latest[1:3])))

    def _answer_of_newest(self):
        return self._answers.get(tuple(scan_of(*self._latest[1:3]).values()))

    def _is_awaiting(self):
        """Whether the force of the whole device that will judge the newest scan is on its way."""
        if self._latest is None or self._device_of_newest() is not None:
            return False
        prediction = self._latest[2]
        return prediction.status != NO_EQUILIBRIUM and awaits_device(
            prediction, self._answer_of_newest()
        )

    def _control(self):
        """Control limits of the forces in the trend, as plot_trend draws them: of which figure,
        from the first to the last scan that they are of, and the numbers of those outside; None
        where too few scans have the settings of the newest."""
        rows = [row for row in self._trend if row.get("is_usable")]
        name = "force" if all(row["device_force"] is None for row in rows) else "device_force"
        series = of_newest_settings([(row["number"], row[name], row["settings"]) for row in rows])
        limits = control_limits([value for _, value in series])
        if limits is None:
            return None
        return {
            "of": name,
            "first": series[0][0],
            "last": series[-1][0],
            "lower": limits.lower,
            "centre": limits.centre,
            "upper": limits.upper,
            "outside": [
                number for number, value in series if value is not None and limits.is_outside(value)
            ],
        }

    def _shown_part(self):
        """is_newest: whether the newest scan is one of its own; is_provisional: whether what will
        judge that scan is on its way."""
        is_newest = self._is_of_newest(self._part)
        return self._part and dict(
            self._part, is_newest=is_newest, is_provisional=is_newest and self._is_awaiting()
        )

    def _with_number(self, of_scan):
        return of_scan and dict(of_scan, number=self._number_of_shown(of_scan))

    def _is_earlier(self, scan, shown):
        """Whether what comes is of a scan before that of what is shown: when that was solved as a
        half-space it is judged again, and hides no later one. By the order in which scans came,
        since a bag brings the stamps of its day."""
        number, other = self._number_of(scan), shown and self._number_of_shown(shown)
        return number is not None and other is not None and number < other

    def _number_of(self, scan):
        return next((row["number"] for row in reversed(self._trend) if is_of_scan(row, scan)), None)

    def _number_of_shown(self, shown):
        return self._number_of({name: shown[name] for name in SCAN})

    def _shown_maps(self):
        return {
            name: {
                "id": str(stamp),
                "number": self._number_of({"stamp": stamp}),  # an image names no part
                "columns": image.width,
                "rows": image.height,
                "size": size,
            }
            for name, (stamp, image, size) in self._maps.items()
        }

    def _run(self, run, now):
        shown = {key: value for key, value in run.items() if key != "ended"}
        if "ended" in run:
            shown["age"] = now - run["ended"]
        return shown
