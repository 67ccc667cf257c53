"""Ctrl-C ends a program with one line at most, and a shell sees the status 130, as of every program
that this signal ends. TERM and HUP (a closed terminal) end it in the same way: a process that they
killed would leave its name at the ROS master, and the load that it set.
Then the program exits with the status 130 itself, whoever started it: "killed by SIGINT" would be
false, since nobody sent that signal.

A program imports this before all that is slow to import. While it loads, Ctrl-C ends it at once: a
KeyboardInterrupt would be printed as a traceback by whoever is being loaded. When main() begins, it
calls raise_from_here_on().

Python drops a KeyboardInterrupt that falls into a finalizer or a callback of a weak reference, and
prints its traceback. Here it comes once more a moment later. A library that turns it into an error
of its own (an import that failed) is told apart by the error's context; for one that excepts
everything and says nothing there is raise_if_swallowed(). In the last moments of a process, when
Python takes its modules apart and neither hook of this one is left, Ctrl-C ends it without a word.

A program whose output nobody reads any more (`| head`) ends without a word, too, with the status
that a shell gives one that SIGPIPE ends. That signal itself would also end it for a closed socket.
Where the output cannot be written for another reason (a full disk), one line says so. Python keeps
what is printed in a buffer, and drops what its own flush at the end of a script raises: here that
is remembered.

Names of files and texts in them may contain control characters, which would move a terminal's
cursor: there they are written out.
"""

import atexit
import contextlib
import errno
import io
import os
import pathlib
import shutil
import signal
import sys
import tempfile

from mems_stiction.quantities import visible

AGAIN_AFTER = 0.02  # [s]
STATUS = 130  # after TERM and HUP
UNREAD = 128 + signal.SIGPIPE
NOT_PRINTED = 120  # as of Python itself, where the rest of the output cannot be written at the end
OTHERS = (signal.SIGTERM, signal.SIGHUP)
ENDINGS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGALRM)

_show = sys.excepthook
_show_dropped = sys.unraisablehook
_has_come = False  # an interruption, whoever heard of it
_is_of_others = False  # it was TERM or HUP
_output = None  # the standard output, once main() has begun
_not_printed = None  # why the rest of the output could not be written at the end


def _raise(number=signal.SIGINT, *_):
    """The handler of a program whose main() has begun."""
    global _has_come, _is_of_others
    _has_come = True
    _is_of_others = _is_of_others or number in OTHERS
    raise KeyboardInterrupt


def _end_now(*_):
    """The handler of TERM and HUP before main() begins."""
    os._exit(STATUS)


def raise_if_swallowed():
    """For a program between two steps of its own, since rospy, which closes a connection, excepts
    whatever falls into that, and goes on."""
    if _has_come:
        raise KeyboardInterrupt


def _is_interrupted(error):
    """Whether a KeyboardInterrupt is this error, or led to it."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _say(kind, error, trace):
    global _not_printed
    if isinstance(error, CannotPrint):
        _not_printed = error  # the end of the program says it
        return
    if not _is_interrupted(error):
        _show(kind, error, trace)
        return
    print("%s: interrupted" % os.path.basename(sys.argv[0]), file=sys.stderr)
    if _is_of_others:
        atexit._run_exitfuncs()
        for stream in (sys.stdout, sys.stderr):
            with contextlib.suppress(OSError, ValueError):  # a pipe that nobody reads any more
                stream.flush()
        os._exit(STATUS)
    if not issubclass(kind, KeyboardInterrupt):  # Python ends by the signal only for that
        atexit._run_exitfuncs()
        sys.stderr.flush()
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)


def _raise_again(dropped):
    if not issubclass(dropped.exc_type, KeyboardInterrupt):
        _show_dropped(dropped)
        return
    signal.signal(signal.SIGALRM, _raise)
    signal.setitimer(signal.ITIMER_REAL, AGAIN_AFTER)


class CannotPrint(OSError):
    """The standard output cannot be written; one that is not caught ends the program with one
    line."""


class _Printed(io.FileIO):
    """The standard output. The first write that fails is the last one; the rest is dropped. One
    that nobody reads ends the program."""

    def write(self, data):
        global _not_printed
        try:
            return super().write(data)
        except OSError as error:
            if sys._getframe().f_back is None:  # Python flushes: no caller hears of the error
                _not_printed = error
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self.fileno())
            os.close(nowhere)
            if isinstance(error, BrokenPipeError):
                raise SystemExit(UNREAD) from None
            raise CannotPrint(error.errno, error.strerror) from None


class _Terminal(io.TextIOWrapper):
    def write(self, text):
        return super().write(visible(text))


def _onto(raw, before):
    """A stream of text in place of another one."""
    kind = _Terminal if before.isatty() else io.TextIOWrapper
    return kind(
        raw if before.write_through else io.BufferedWriter(raw),
        before.encoding,
        "backslashreplace" if before.errors == "strict" else before.errors,
        line_buffering=before.line_buffering,
        write_through=before.write_through,
    )


def _print_the_rest():
    """At the end of a program."""
    if _has_come:
        return
    error = _not_printed
    try:
        if _output is not None and not _output.closed:
            _output.flush()
    except SystemExit:
        os._exit(UNREAD)
    except OSError as caught:
        error = caught
    if error is None:
        return
    if isinstance(error, BrokenPipeError):
        os._exit(UNREAD)
    is_closed = error.errno == errno.EBADF
    print(
        "%s: %s%s"
        % (
            os.path.basename(sys.argv[0]),
            "" if is_closed else "what is printed cannot be written: ",
            error.strerror,
        ),
        file=sys.stderr,
        flush=True,
    )
    os._exit(NOT_PRINTED)


def _end_with_the_reader():
    """Of what is printed from now on."""
    global _output
    before = sys.stdout
    if not isinstance(before, io.TextIOWrapper) or before is not sys.__stdout__:
        return
    before.flush()
    sys.stdout = _output = _onto(_Printed(before.fileno(), "wb", closefd=False), before)


class Closed:
    """In place of the standard output where the caller has closed it, and Python has none: to write
    there fails, as on a full disk."""

    closed = False
    encoding = "utf-8"

    def write(self, text):
        raise CannotPrint(errno.EBADF, "what is to be printed goes to an output that is closed")

    def flush(self):
        pass

    def isatty(self):
        return False


def _hold_standard_streams():
    """What is opened next would take the descriptor of one that the caller has closed, and whatever
    is printed would be written into that file."""
    for number, flags in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, flags)  # the lowest that is free: this one
    if sys.stdout is None:
        sys.stdout = Closed()
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w")


def raise_from_here_on():
    """Each of them is a KeyboardInterrupt from now on, so that what was begun can be put away."""
    _hold_standard_streams()
    _end_with_the_reader()
    if isinstance(sys.stderr, io.TextIOWrapper) and sys.stderr.isatty():
        sys.stderr = _onto(io.FileIO(sys.stderr.fileno(), "wb", closefd=False), sys.stderr)
    for number in (signal.SIGINT,) + OTHERS:
        if signal.getsignal(number) in (signal.SIG_DFL, _end_now):
            signal.signal(number, _raise)


def ignore_from_here_on():
    """For the end of a program: a second Ctrl-C does not tear what others still put away, as rospy
    does."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)


class Waiting:
    """Interruptions wait from here on, to end(). A mask of the process would not do: Python notes
    signals that other threads get."""

    def __init__(self):
        self._has_come = None  # the number of the signal
        self._before = {}
        for number in ENDINGS:
            if signal.getsignal(number) == _raise:
                self._before[number] = signal.signal(number, self._note)

    def _note(self, number, *_):
        self._has_come = number

    def end(self):
        for number, handler in self._before.items():
            signal.signal(number, handler)
        if self._has_come:
            _raise(self._has_come)


@contextlib.contextmanager
def temporary_folder(prefix):
    """A folder that goes afterwards, wherever an interruption falls: one that comes while it is
    made or removed waits."""
    waiting = Waiting()
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
            waiting = Waiting()
        finally:
            shutil.rmtree(str(folder), ignore_errors=True)
        waiting.end()


def _end_at_once_from_here_on():
    """The last of what Python calls before it takes itself apart. What an interruption that was
    dropped is to raise again ends the process."""
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    _print_the_rest()
    ours = [number for number in ENDINGS if signal.getsignal(number) == _raise]
    for number in ours:
        signal.signal(
            number, signal.SIG_IGN if number in OTHERS else signal.SIG_DFL
        )  # what is done has its own status
    if signal.SIGALRM in ours:
        if _is_of_others:
            os._exit(STATUS)
        os.kill(os.getpid(), signal.SIGINT)


atexit.register(
    _end_at_once_from_here_on
)  # the first that is registered is the last that is called
sys.excepthook = _say
sys.unraisablehook = _raise_again
if signal.getsignal(signal.SIGINT) == signal.default_int_handler:
    signal.signal(signal.SIGINT, signal.SIG_DFL)
for _number in OTHERS:
    if signal.getsignal(_number) == signal.SIG_DFL:  # nohup stays
        signal.signal(_number, _end_now)
