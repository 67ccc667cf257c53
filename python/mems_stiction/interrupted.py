"""Ctrl-C ends a program with one line at most, and a shell sees the status 130, as of every program that a signal ends. TERM and HUP
(a closed terminal) end it in the same way: a process that they killed would leave its name at the ROS master, and the load that it set.

A program imports this before all that is slow to import. While it loads, Ctrl-C ends it at once: a KeyboardInterrupt would be
printed as a traceback by whoever is being loaded. When main() begins, it calls raise_from_here_on().

Python drops a KeyboardInterrupt that falls into a finalizer or a callback of a weak reference, and prints its traceback. Here it comes once
more a moment later. A library that turns it into an error of its own (an import that failed) is told apart by the error's context.
"""

import atexit
import contextlib
import os
import pathlib
import shutil
import signal
import sys
import tempfile

AGAIN_AFTER = 0.02  # [s]
ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGALRM)

_show = sys.excepthook
_show_dropped = sys.unraisablehook


def _is_interrupted(error):
    """Whether a KeyboardInterrupt is this error, or led to it."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _say(kind, error, trace):
    if not _is_interrupted(error):
        _show(kind, error, trace)
        return
    print("%s: interrupted" % os.path.basename(sys.argv[0]), file=sys.stderr)
    if not issubclass(kind, KeyboardInterrupt):  # Python ends by the signal only for that
        atexit._run_exitfuncs()
        sys.stderr.flush()
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)


def _raise_again(dropped):
    if not issubclass(dropped.exc_type, KeyboardInterrupt):
        _show_dropped(dropped)
        return
    signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, AGAIN_AFTER)


def raise_from_here_on():
    """Each of them is a KeyboardInterrupt from now on, so that what was begun can be put away."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, signal.default_int_handler)


def ignore_from_here_on():
    """For the end of a program: a second Ctrl-C does not tear what others still put away, as rospy does."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)


class _Waiting:
    """Interruptions wait from here on, to end(). A mask of the process would not do: Python notes signals that other threads get."""

    def __init__(self):
        self._has_come = False
        self._before = {}
        for number in ENDINGS:
            if signal.getsignal(number) == signal.default_int_handler:
                self._before[number] = signal.signal(number, self._note)

    def _note(self, *_):
        self._has_come = True

    def end(self):
        for number, handler in self._before.items():
            signal.signal(number, handler)
        if self._has_come:
            raise KeyboardInterrupt


@contextlib.contextmanager
def temporary_folder(prefix):
    """A folder that goes afterwards, wherever an interruption falls: one that comes while it is made or removed waits."""
    waiting = _Waiting()
    try:
        folder = pathlib.Path(tempfile.mkdtemp(prefix=prefix))
    except OSError:
        waiting.end()
        raise
    try:
        waiting.end()
        yield folder
    finally:
        try:
            waiting = _Waiting()
        finally:
            shutil.rmtree(str(folder), ignore_errors=True)
        waiting.end()


sys.excepthook = _say
sys.unraisablehook = _raise_again
if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
