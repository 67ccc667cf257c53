"""Where a load sweep jumps, and why: what jumps between two neighbouring voltages, in
words."""

import math

from mems_stiction.curve import steep_steps
from mems_stiction.prediction_text import contact_area_of
from mems_stiction.quantities import area, with_unit

UP = 0  # SweepPoint.UP
BONDED, NO_EQUILIBRIUM = 1, 2  # SweepPoint.status
LEAST_SHARE = 0.1  # of what area or force spans: a smaller step is that of pixels that meet
_STATES = {BONDED: "the surfaces bond", NO_EQUILIBRIUM: "the search finds no equilibrium any more"}


class Jump:
    """From one point of a way to the next. cause: in words; height: how much of the range of area
    or force it spans [-]."""

    def __init__(self, before, after, cause, share):
        self.before, self.after, self.cause, self.share = before, after, cause, share

    def words(self):
        way = "up" if self.after.direction == UP else "down"
        return "from %s to %s on the way %s%s: %s" % (
            with_unit(self.before.voltage, "V"),
            with_unit(self.after.voltage, "V"),
            way,
            _changes(self.before, self.after),
            self.cause,
        )


def ways_of(points, mechanical_load):
    """The points of both ways of one load; the way down begins where the way up has ended."""
    of_load = [point for point in points if point.mechanical_load == mechanical_load]
    up = [point for point in of_load if point.direction == UP]
    return up, up[-1:] + [point for point in of_load if point.direction != UP]


def jumps_of(points, mechanical_load, pull_in_voltage):
    """All jumps of both ways of one load, in the order of the sweep."""
    found = []
    for way in ways_of(points, mechanical_load):
        shares = _leaps(way)
        for place, (before, after) in enumerate(zip(way, way[1:])):
            causes = _causes(before, after, place in shares, pull_in_voltage)
            if causes:
                found.append(Jump(before, after, "; ".join(causes), shares.get(place, 1.0)))
    return found


def _leaps(way):
    """{place of a step: its share} of those over which contact area or pull-off force is not
    continuous. Both go with the field, and that with the square of the voltage."""
    closed = [point for point in way if not point.is_open]
    squares = [point.voltage**2 for point in closed]
    shares = {}
    for value_of in (contact_area_of, lambda point: point.pull_off_force):
        values = [value_of(point) for point in closed]
        if len(values) < 2 or not all(math.isfinite(value) for value in values):
            continue
        span = max(values) - min(values)
        for place in steep_steps(squares, values):
            share = abs(values[place + 1] - values[place]) / span
            if share >= LEAST_SHARE:
                shares[place] = max(shares.get(place, 0.0), share)
    return shares


def _causes(before, after, is_leap, pull_in_voltage):
    causes = []
    if after.is_open and not before.is_open:
        return ["the device opens, what pulls it open overcomes all that holds"]
    if after.is_open:
        return []
    if before.voltage < pull_in_voltage <= after.voltage:
        causes.append(
            "pull-in at %s, the field closes the device by itself" % with_unit(pull_in_voltage, "V")
        )
    if after.status != before.status and after.status in _STATES:
        causes.append(_STATES[after.status])
    elif is_leap:
        causes.append(_contacts(before, after))
    return causes


def _contacts(before, after):
    more = after.asperity_count - before.asperity_count
    if after.contact_area < before.contact_area:
        if more < 0:
            return "%d contact%s let%s go" % (-more, *(("", "s") if more == -1 else ("s", "")))
        if more > 0:
            return "contacts come apart, %d to %d" % (before.asperity_count, after.asperity_count)
        return "the same contacts shrink at once"
    if more > 0:
        return "%d new contact%s snap%s in" % (
            more,
            "" if more == 1 else "s",
            "s" if more == 1 else "",
        )
    if more < 0:
        return "contacts grow together, %d to %d" % (before.asperity_count, after.asperity_count)
    return "the same contacts spread at once"


def _changes(before, after):
    if after.is_open:
        return ""
    texts = []
    for what, value_of, text in (
        ("contact area", contact_area_of, area),
        ("pull-off force", lambda point: point.pull_off_force, _force),
    ):
        old, new = text(value_of(before)), text(value_of(after))
        if old != new:
            texts.append("%s %s to %s" % (what, old, new))
    return " (%s)" % "; ".join(texts) if texts else ""


def _force(value):
    return with_unit(value, "N")
