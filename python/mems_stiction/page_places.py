"""The newest prediction of each place of a wafer or part, within bounds, for the station's page. No
ROS here, and not the core."""

import math

from mems_stiction.page_words import NO_EQUILIBRIUM, VERDICTS

MOST_WAFERS = 12
MOST_PLACES = 500  # of each wafer
SCAN = ("stamp", "part_id", "serial_id")  # what says which scan a message is of
LARGEST_WAFER = 10.0  # [m]: a site beyond is none
NAMES = ("lot_id", "wafer_id", "part_id", "serial_id")
FORCES = ("margin", "peel_number", "device_pull_off_force", "pull_off_force")
COLUMNS = NAMES + FORCES + ("settings_hash", "scan_name", "site_x", "site_y", "rms_height")


def has_site(row):
    return abs(row["site_x"]) <= LARGEST_WAFER and abs(row["site_y"]) <= LARGEST_WAFER


def scan_of(stamp, message):
    """Which scan a message is of: two parts may have scans of the same stamp [ns]."""
    return {"stamp": stamp, "part_id": message.part_id, "serial_id": message.serial_id}


def is_of_scan(shown, scan):
    """Whether a dictionary with the names of scan_of() is of this scan."""
    return all(shown.get(name) == value for name, value in scan.items())


class Wafers:
    """The newest prediction of each place. Where there are too many, those heard of last are kept,
    and it is said how many went."""

    def __init__(self):
        self.version = 0
        self._wafers = {}  # (lot, wafer) -> {place: row}; what was heard of last comes last in both
        self._lost_wafers, self._lost_places, self._nameless = 0, 0, 0
        self._told = None

    def add(self, stamp, prediction):
        """stamp: of the scan [ns]. One that names no place, wafer or part is counted alone."""
        row = {name: getattr(prediction, name) for name in COLUMNS}
        if prediction.status == NO_EQUILIBRIUM:  # its forces are not to be used
            row.update(dict.fromkeys(FORCES, math.nan))
        row.update(
            stamp=stamp,
            level=VERDICTS.get(prediction.sticks, VERDICTS[3])[0]
            if prediction.status != NO_EQUILIBRIUM
            else "unknown",
        )
        self._change()
        if not has_site(row) and not any(row[name] for name in NAMES):
            self._nameless += 1
            return
        key = row["lot_id"], row["wafer_id"]
        places = self._wafers[key] = self._wafers.pop(key, {})
        # a site of a wafer is one place whoever lies there; one of a part without a wafer is the
        # part's
        place = (
            "" if row["wafer_id"] else (row["part_id"], row["serial_id"]),
            (row["site_x"], row["site_y"]) if has_site(row) else stamp,
        )
        places.pop(place, None)
        places[place] = row
        if len(places) > MOST_PLACES:
            del places[next(iter(places))]
            self._lost_places += 1
        if len(self._wafers) > MOST_WAFERS:
            del self._wafers[next(iter(self._wafers))]
            self._lost_wafers += 1

    def judge(self, stamp, device):
        """The scan of this stamp [ns] and of the device's part is judged by the force of the whole
        device."""
        scan = scan_of(stamp, device)
        for places in self._wafers.values():
            for place, row in places.items():
                if is_of_scan(row, scan):
                    places[place] = dict(
                        row,
                        device_pull_off_force=device.pull_off_force,
                        margin=device.margin,
                        peel_number=device.peel_number,
                        level=VERDICTS.get(device.sticks, VERDICTS[3])[0],
                    )
                    self._change()

    def _change(self):
        self.version += 1
        self._told = None

    def rows_and_counts(self):
        """What page_wafers.told takes; the same object until something changes."""
        if self._told is None:
            rows = tuple(row for places in self._wafers.values() for row in places.values())
            self._told = (
                rows,
                {
                    "version": self.version,
                    "wafers": self._lost_wafers,
                    "places": self._lost_places,
                    "nameless": self._nameless,
                },
            )
        return self._told
