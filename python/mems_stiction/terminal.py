"""What programs say beside their answer, on the standard error: how far they are, and what looks
wrong."""

import contextlib
import sys
import warnings

from mems_stiction.quantities import counted

STRICT = 1  # exit status


def progress_of(program):
    """A function of the share that is done; it draws one line, on terminals alone."""

    def show(share):
        if sys.stderr.isatty():
            end = "\n" if share >= 1.0 else ""
            print(
                "\r%s: %3.0f %%%s" % (program, 100 * share, end),
                end="",
                file=sys.stderr,
                flush=True,
            )

    return show


@contextlib.contextmanager
def warnings_said_once(program):
    """Warnings of what runs within are lines, each once, when it ends well. Gives the list that
    they are in then."""
    said = []
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        yield said
    said += dict.fromkeys(str(warning.message) for warning in told)
    for text in said:
        print("%s: warning: %s" % (program, text), file=sys.stderr)


def strict_status(program, is_strict, said):
    """The exit status of a program that has ended well: with --strict and a warning STRICT."""
    if not is_strict or not said:
        return 0
    print(
        "%s: %s, and --strict takes none" % (program, counted(len(said), "warning")),
        file=sys.stderr,
    )
    return STRICT
