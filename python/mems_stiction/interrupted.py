"""Ctrl-C ends a program with one line, and a shell sees the status 130, as of every program that a signal ends.

A program imports this before all that is slow to import.
"""

import os
import signal
import sys

_show = sys.excepthook


def ignore_interruptions():
    """For the end of a program: a second Ctrl-C does not tear what others still put away, as rospy does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _say(kind, error, trace):
    if issubclass(kind, KeyboardInterrupt):
        ignore_interruptions()
        print("%s: interrupted" % os.path.basename(sys.argv[0]), file=sys.stderr)
    else:
        _show(kind, error, trace)


sys.excepthook = _say
