"""Ctrl-C ends a program with one line at most, and a shell sees the status 130, as of every program that a signal ends.

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
    """Ctrl-C is a KeyboardInterrupt again, so that what was begun can be put away."""
    if signal.getsignal(signal.SIGINT) == signal.SIG_DFL:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def ignore_from_here_on():
    """For the end of a program: a second Ctrl-C does not tear what others still put away, as rospy does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


sys.excepthook = _say
if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
