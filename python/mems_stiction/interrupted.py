"""Ctrl-C ends a program with one line at most, and a shell sees the status 130, as of every program that a signal ends. TERM and HUP
(a closed terminal) end it in the same way: a process that they killed would leave its name at the ROS master, and the load that it set.

A program imports this before all that is slow to import. While it loads, Ctrl-C ends it at once: a KeyboardInterrupt would be
printed as a traceback by whoever is being loaded. When main() begins, it calls raise_from_here_on().
"""

import os
import signal
import sys

_show = sys.excepthook


def _say(kind, error, trace):
    if issubclass(kind, KeyboardInterrupt):
        print("%s: interrupted" % os.path.basename(sys.argv[0]), file=sys.stderr)
    else:
        _show(kind, error, trace)


def raise_from_here_on():
    """Each of them is a KeyboardInterrupt from now on, so that what was begun can be put away."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)


def ignore_from_here_on():
    """For the end of a program: a second Ctrl-C does not tear what others still put away, as rospy does."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)


sys.excepthook = _say
if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
