"""Curves of force over height, as `predict_scan --curve` writes them: CSV with a line of names, SI
units.

Whichever model a curve is of, its file has the columns height [m], force [N] (positive attracts)
and direction (APPROACH, RETRACTION), in any order, the points of each direction in the order in
which they were met. It may have those of provenance.py; other columns are left out.
"""

import csv
import math

from mems_stiction.input_file import UnfitFile, is_open_pipe, require_file
from mems_stiction.provenance import FIELDS

import numpy as np

COLUMNS = ("height", "force", "direction")
MOST_BYTES = 100000000  # of a file
DIRECTIONS = ("APPROACH", "RETRACTION")
# A step is a jump if the force changes by this share of all that it spans, so many times as steeply
# as on both sides.
JUMP_SHARE = 0.02
JUMP_STEEPNESS = 4.0
APART_SHARE = 0.5  # of the largest attraction: less is left when the surfaces are apart


class CurveError(Exception):
    """What is wrong with a file, in one line with its name."""


def steep_steps(positions, values):
    """The places of the steps, each from one point to the next, over which the values are not
    continuous."""
    values = np.asarray(values, dtype=float)
    change = np.abs(np.diff(values))
    steepness = change / np.maximum(np.abs(np.diff(np.asarray(positions, dtype=float))), 1e-30)
    found = []
    for place in range(1, len(change) - 1):
        # On each side the flatter of two steps, as another jump may be next to this one.
        around = max(
            steepness[max(0, place - 2) : place].min(), steepness[place + 1 : place + 3].min()
        )
        if (
            change[place] > JUMP_SHARE * np.ptp(values)
            and steepness[place] > JUMP_STEEPNESS * around
        ):
            found.append(place)
    return found


class Way:
    """One way of a curve: heights [m] and forces [N], in the order in which they were met."""

    def __init__(self, points):
        array = np.array(points, dtype=float).reshape(-1, 2)
        self.heights, self.forces = array[:, 0], array[:, 1]

    def __len__(self):
        return len(self.heights)

    def jumps(self):
        """The steps over which the force is not continuous: place i stands for the step from point
        i to i + 1. A file does not say where they are, but a path that is followed in small steps
        is steep nowhere else."""
        return steep_steps(self.heights, self.forces)


class Curve:
    """Approach and retraction; either may be empty."""

    def __init__(self, name, points, pull_off_force=None, origin=None):
        """points: (height, force, direction) in the order in which they were met. pull_off_force
        [N]: as its model states it, where the largest force lies between two points. origin: where
        it comes from, by provenance.FIELDS."""
        self.name = name
        self.pull_off_force = pull_off_force
        self.origin = origin or {}
        self.approach, self.retraction = (
            Way([point[:2] for point in points if point[2] == direction])
            for direction in DIRECTIONS
        )

    def pull_off(self):
        """(height, force) of the largest attraction of the retraction, or the force that is stated;
        None where nothing attracts, or there is none."""
        if not len(self.retraction) or self.retraction.forces.max() <= 0:
            return None
        place = int(np.argmax(self.retraction.forces))
        return float(self.retraction.heights[place]), self.pull_off_force or float(
            self.retraction.forces[place]
        )

    def came_apart(self):
        """Whether the attraction has fallen off: a path that was broken off ends near its
        largest."""
        peak = self.pull_off()
        return peak is not None and self.retraction.forces[-1] < APART_SHARE * peak[1]


def _number(text, where):
    try:
        value = float(text)
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise CurveError("%s: '%s' is not allowed, must be a finite number" % (where, text or ""))
    return value


def read_curve(path, name):
    """The curve in a file. Raises CurveError with file, line and column, and what is allowed
    there."""
    points, origin = [], {}
    try:
        if not is_open_pipe(path):
            require_file(path, "a curve", MOST_BYTES)
        with open(str(path), encoding="utf-8", newline="") as stream:
            reader = csv.DictReader(stream, skipinitialspace=True)
            missing = [column for column in COLUMNS if column not in (reader.fieldnames or ())]
            if missing:
                raise CurveError(
                    "%s: line 1: there is no column %s; must name the columns %s"
                    % (path, ", ".join("'%s'" % column for column in missing), ", ".join(COLUMNS))
                )
            for row in reader:
                where = "%s: line %d: " % (path, reader.line_num)
                direction = row["direction"]
                if direction not in DIRECTIONS:
                    raise CurveError(
                        "%sdirection: '%s' is not allowed, must be one of: %s"
                        % (where, direction or "", ", ".join(DIRECTIONS))
                    )
                origin = origin or {field: row[field] for field in FIELDS if row.get(field)}
                points.append(
                    (
                        _number(row["height"], where + "height"),
                        _number(row["force"], where + "force"),
                        direction,
                    )
                )
    except OSError as error:
        raise CurveError("%s: cannot be read: %s" % (path, error.strerror))
    except UnfitFile as error:
        raise CurveError("%s: %s" % (path, error))
    except (UnicodeDecodeError, csv.Error):
        raise CurveError(
            "%s: is no CSV file; must have the columns %s" % (path, ", ".join(COLUMNS))
        )
    if not points:
        raise CurveError(
            "%s: has no point; must have a line for each height after the line of names" % path
        )
    return Curve(name, points, origin=origin)
