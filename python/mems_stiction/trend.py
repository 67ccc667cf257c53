"""What a station saw so far, scan by scan: predicted, lost, or still waiting. No ROS here."""

MOST_SCANS = 10000  # that are kept: some 5 kB each
MOST_EARLY = 100  # verdicts on devices that wait for the prediction of their scan
NOTHING_FOUND = 2  # DeviceAdhesion.REFUSED
# What the force of a device, which comes later, says anew of a scan: the field of its prediction,
# and that of the force
OF_DEVICE = {
    **{"device_pull_off_force" + end: "pull_off_force" + end for end in ("", "_lower", "_upper")},
    "device_apparent_work_of_adhesion": "apparent_work_of_adhesion",
    **{name: name for name in ("sticks", "reason", "governed_by", "restoring_force")},
    **{
        name + end: name + end
        for name in ("margin", "peel_number")
        for end in ("", "_lower", "_upper")
    },
}


def said_of_device(device):
    """{field of a prediction: value} of OF_DEVICE; what older recordings do not state is left
    out."""
    said = {name: getattr(device, field, None) for name, field in OF_DEVICE.items()}
    return {name: value for name, value in said.items() if value is not None}


class Scan:
    """One scan. `prediction` is its message, or None while there is none; `is_lost`: there will be
    none."""

    def __init__(self, stamp):
        self.stamp = stamp
        self.prediction = None
        self.is_lost = False
        self.has_arrived = False  # its image; the prediction of a small scan may be here first


class Trend:
    """The scans in the order in which they were made.

    Scans are predicted in this order, so that one without a prediction is lost once a later one has
    its own, or once the node counts a loss. The oldest are forgotten beyond `most`; their numbers
    stay.
    """

    def __init__(self, most=MOST_SCANS):
        self.scans = []
        self._most = most
        self._forgotten = 0
        self._forgotten_losses = 0
        self._uncounted = 0  # scans seen to be lost before the node's count said so
        self._early = {}  # verdicts on devices by the stamps of scans that are not predicted yet

    def add_scan(self, stamp):
        """An image has arrived."""
        place = len(self.scans)
        while (
            place > 0
            and not self.scans[place - 1].has_arrived
            and self.scans[place - 1].stamp >= stamp
        ):
            place -= 1
        if place == len(self.scans) or self.scans[place].stamp != stamp:
            self.scans.insert(place, Scan(stamp))
        self.scans[place].has_arrived = True
        if any(scan.prediction is not None for scan in self.scans[place + 1 :]):
            self._lose(self.scans[place : place + 1])
        self._forget()

    def add_prediction(self, stamp, prediction):
        """A replay brings the same stamps again: the first scan that waits is meant."""
        waiting = [scan for scan in self.scans if scan.stamp == stamp and scan.prediction is None]
        if not waiting:
            waiting = [Scan(stamp)]
            self.scans += waiting
        scan = waiting[0]
        scan.prediction, scan.is_lost = prediction, False
        if stamp in self._early:
            self.judge(stamp, self._early.pop(stamp))
        self._lose(self.scans[: self.scans.index(scan)])
        self._forget()

    def judge(self, stamp, device):
        """The verdict on the whole device (a DeviceAdhesion) takes the place of the prediction's,
        whose settings it has: the newest scan of the stamp is meant. What was judged under other
        settings belongs to no scan here."""
        predicted = [
            scan.prediction
            for scan in self.scans
            if scan.stamp == stamp and scan.prediction is not None
        ]
        if not predicted:
            self._early[stamp] = device
            while len(self._early) > MOST_EARLY:
                del self._early[next(iter(self._early))]
            return
        prediction = predicted[-1]
        if device.status == NOTHING_FOUND or device.settings_hash != prediction.settings_hash:
            return
        for name, value in said_of_device(device).items():
            setattr(prediction, name, value)

    def _lose(self, scans):
        """A later one is predicted already."""
        for scan in scans:
            if scan.prediction is None and not scan.is_lost:
                scan.is_lost = True
                self._uncounted += 1

    def add_losses(self, count):
        """The node has rejected or dropped so many more: they are the first that wait."""
        waiting = [scan for scan in self.scans if scan.prediction is None and not scan.is_lost]
        already_seen = min(count, self._uncounted)
        self._uncounted -= already_seen
        for scan in waiting[: count - already_seen]:
            scan.is_lost = True

    def _forget(self):
        old = self.scans[: max(0, len(self.scans) - self._most)]
        self._forgotten += len(old)
        self._forgotten_losses += sum(scan.is_lost for scan in old)
        del self.scans[: len(old)]

    def decided(self):
        """(number from 1, scan) of all that are kept, but those that wait."""
        return [
            (number, scan)
            for number, scan in enumerate(self.scans, 1 + self._forgotten)
            if scan.prediction is not None or scan.is_lost
        ]

    def decided_count(self):
        """With those that are forgotten."""
        return self._forgotten + len(self.decided())

    def lost_count(self):
        """With those that are forgotten."""
        return self._forgotten_losses + sum(scan.is_lost for scan in self.scans)
