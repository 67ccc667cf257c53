"""Runs one of the node's long actions for a person at a terminal: progress, and Ctrl-C that cancels
and keeps what is done."""

import argparse
import math
import re
import sys
import time

import actionlib
import rospy
from actionlib import CommState, TerminalState
from mems_stiction.arguments import is_lost
from mems_stiction.interrupted import Waiting
from mems_stiction.provenance import FIELDS as PROVENANCE
from mems_stiction.row_table import units_of, write_rows
from mems_stiction.srv import GetPrediction
from mems_stiction.station_node import CannotRun, no_node
from mems_stiction.station_text import why_no_margin

DONE, CANCELLED, NOT_RUN = 0, 1, 2  # exit statuses
MOST_NUMBERS = 1000000  # of a range; the node takes no more
SILENCE = 5.0  # after which a node counts as gone [s]


class NoNumbers(argparse.ArgumentTypeError, ValueError):
    """Numbers that cannot be read; argparse shows the text."""


def run(action, kind, goal, timeout):
    """The result, and whether it is complete. Needs rospy.init_node(..., disable_signals=True)."""
    from tqdm import tqdm

    # Not the simple client: it may miss the end of a goal that is refused at once.
    client = actionlib.ActionClient(action, kind)
    if not client.wait_for_server(rospy.Duration(timeout)):
        raise CannotRun(no_node("action", action, timeout))
    with tqdm(
        desc=action.split("/")[-1], unit="", leave=False, disable=None, file=sys.stderr
    ) as bar:

        def show(_, feedback):
            bar.total = feedback.total
            bar.update(feedback.done - bar.n)

        waiting = (
            Waiting()
        )  # the node may be at work before send_goal() has said which goal is to be cancelled
        try:
            handle = client.send_goal(goal, feedback_cb=show)
        except Exception:
            waiting.end()
            raise
        try:
            waiting.end()
            _wait(client, handle, action)
        except KeyboardInterrupt:
            handle.cancel()
            _wait(client, handle, action)
    result, state = handle.get_result(), handle.get_terminal_state()
    if state in (TerminalState.ABORTED, TerminalState.REJECTED, TerminalState.LOST):
        raise CannotRun(result.message if result else "the node has lost the goal")
    return result, state == TerminalState.SUCCEEDED


def _wait(client, handle, action):
    """Until the goal has ended, in wall time."""
    seen = time.monotonic()
    while handle.get_comm_state() != CommState.DONE:
        time.sleep(0.05)
        if client.wait_for_server(rospy.Duration(0.01)):
            seen = time.monotonic()
        elif time.monotonic() - seen > SILENCE:
            raise CannotRun("the node of %s has gone" % action)


def why_no_margin_of(node, stamp):
    """Why the scan of this stamp has no margin, as the node says of its last scan; empty if that is
    another one, or has a margin."""
    try:
        answer = rospy.ServiceProxy(node + "/get_prediction", GetPrediction)()
    except (rospy.ServiceException, rospy.ROSException):
        return ""
    is_of_scan = answer.success and answer.prediction.header.stamp == stamp
    return why_no_margin(answer.prediction) if is_of_scan else ""


def spread(items, most):
    """At most so many, evenly spread, the first and the last among them."""
    if len(items) <= most:
        return items
    return [items[round(place * (len(items) - 1) / (most - 1))] for place in range(most)]


def numbers(text):
    """ "0,5,10" or FIRST:LAST:STEP, as in "0:30:2.5", the last one included."""
    parts = text.split(":" if ":" in text else ",")
    if any(re.match(r"[+-]?0\d", part.strip()) for part in parts):
        raise NoNumbers(
            "'%s' is not allowed: commas stand between numbers, the decimal sign is a point" % text
        )
    try:
        values = [float(part) for part in parts]
    except ValueError:
        values = []
    if not values or not all(map(math.isfinite, values)) or (":" in text and len(values) != 3):
        raise NoNumbers(
            "'%s' is not allowed, must be numbers with commas between, or FIRST:LAST:STEP" % text
        )
    for part, value in zip(parts, values):
        if is_lost(part, value):
            raise NoNumbers("'%s' is not allowed: %s is too near to 0 for a number" % (text, part))
    if ":" not in text:
        return values
    first, last, step = values
    if not step > 0:
        raise NoNumbers("'%s' is not allowed, the step must be > 0" % text)
    if first > last:
        raise NoNumbers(
            "'%s' is not allowed: nothing lies from %g up to %g; the way down follows by itself"
            % (text, first, last)
        )
    if (last - first) / step > MOST_NUMBERS:
        raise NoNumbers("'%s' is not allowed: more than %d numbers" % (text, MOST_NUMBERS))
    count = int((last - first) / step * (1 + 1e-12) + 1e-9) + 1
    return [first + index * step for index in range(count)]


def write_points(messages, path, result):
    """A CSV, or Parquet, with one line for each message, its field names, and what the result says
    of where it comes from."""
    names = messages[0].__slots__ if messages else []
    known = {name: getattr(result, name) for name in PROVENANCE}
    origin = {
        name: None if isinstance(value, float) and math.isnan(value) else value
        for name, value in known.items()
    }
    rows = [
        dict({name: getattr(message, name) for name in names}, **origin) for message in messages
    ]
    units = dict(units_of(type(messages[0])) if messages else {}, site_x="m", site_y="m")
    write_rows(path, list(names) + list(PROVENANCE), rows, units, origin)


def left_out(all_items, most, what):
    """What to say below a table that does not show all."""
    if len(all_items) <= most:
        return ""
    return "%d of %d %s are shown, evenly spread; --csv writes all." % (most, len(all_items), what)
