"""Ctrl-C ends a program with one line, and a shell sees the status 130, as of every program that a signal ends.

A program imports this before all that is slow to import, and does no more with it.
"""

import os
import sys

_show = sys.excepthook


def _say(kind, error, trace):
    if issubclass(kind, KeyboardInterrupt):
        print("%s: interrupted" % os.path.basename(sys.argv[0]), file=sys.stderr)
    else:
        _show(kind, error, trace)


sys.excepthook = _say
