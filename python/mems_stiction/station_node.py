"""How a command line becomes a node: without a master it gives up in time, what it is to write can
be written, and what others say reaches no terminal as a control character."""

import logging
import sys
import time
import urllib.parse

import rosgraph
import rospy
from mems_stiction import interrupted
from mems_stiction.prediction_text import printable
from mems_stiction.whole_file import check_writable, reason_of


class Printable:
    """A stream that spells out control characters but line ends and tabs: names, frames and reasons
    come from anybody in the network, and none moves the cursor of a terminal."""

    def __init__(self, stream):
        self._stream = stream

    def write(self, text):
        return self._stream.write(
            "".join(letter if letter in "\n\t" else printable(letter) for letter in text)
        )

    def writelines(self, lines):
        for line in lines:
            self.write(line)

    def __getattr__(self, name):
        return getattr(self._stream, name)


PATIENCE = 30.0  # for a master, of a program that runs until it is stopped [s]
SILENT = 2.0  # of a wait that nobody is told of [s]


class CannotRun(Exception):
    """There is no master, no node, no place to write to, or the node has refused the goal; the text
    says why."""


def check_master_address():
    """Raises CannotRun where ROS_MASTER_URI is no address, at which rospy would end in a
    traceback."""
    address = rosgraph.get_master_uri()
    parts = urllib.parse.urlsplit(address)
    try:
        is_address = parts.scheme == "http" and bool(parts.hostname) and parts.port is not None
    except ValueError:  # of the port
        is_address = False
    if not is_address:
        raise CannotRun(
            "ROS_MASTER_URI: '%s' is not allowed, must be an address as http://localhost:11311"
            % address
        )


def become_node(name, timeout, **options):
    """rospy.init_node() for a node of its own name, which alone would wait for a master for ever,
    and say nothing."""
    check_master_address()
    begin = time.monotonic()
    is_told = False
    while not rosgraph.is_master_online():
        waited = time.monotonic() - begin
        if waited > timeout:
            raise CannotRun(
                "no ROS master at %s for %g s: is roscore or roslaunch running?"
                % (rosgraph.get_master_uri(), timeout)
            )
        if waited > SILENT and not is_told:
            print(
                "%s: waits for a ROS master at %s (roscore or roslaunch)"
                % (name, rosgraph.get_master_uri()),
                file=sys.stderr,
                flush=True,
            )
            is_told = True
        time.sleep(0.1)
    sys.stdout, sys.stderr = Printable(sys.stdout), Printable(sys.stderr)
    logging.raiseExceptions = False  # a full disk under ROS_HOME is no matter of the answer
    try:
        rospy.init_node(name, anonymous=True, **options)
    except rospy.ROSInitException:
        if rospy.is_shutdown():
            raise KeyboardInterrupt
        raise


def no_node(what, name, timeout):
    """The sentence on a service or an action "NODE/NAME" that did not come: under which names nodes
    of this package run instead."""
    try:
        services = [service for service, _ in rosgraph.Master(rospy.get_name()).getSystemState()[2]]
    except (OSError, rosgraph.MasterError):
        services = []
    nodes = sorted(
        service.rsplit("/", 1)[0] for service in services if service.endswith("/solve_half_space")
    )
    found = " There is %s (--node)" % ", ".join(nodes) if nodes else ""
    return "no %s %s for %g s: is the node running under that name?%s" % (
        what,
        name,
        timeout,
        found,
    )


def require_writable(option, path):
    """Before a long run, not after it."""
    if not path:
        return
    try:
        check_writable(path)
    except OSError as error:
        raise CannotRun("%s: %s cannot be written: %s" % (option, path, error.strerror or error))


def run_program(program, main, status):
    """The whole of a script: main(), its exit status, and one line for what goes wrong on the
    way."""
    try:
        interrupted.raise_from_here_on()
        result = main()
    except KeyboardInterrupt:
        interrupted.ignore_from_here_on()
        raise
    except (CannotRun, OSError) as error:
        text = reason_of(error) if isinstance(error, OSError) else str(error)
        print("%s: %s" % (program, " ".join(text.split())), file=sys.stderr)
        sys.exit(status)
    interrupted.ignore_from_here_on()
    sys.exit(result)
