"""What programs say beside their answer, on the standard error: how far they are, and what looks
wrong."""

import contextlib
import sys
import warnings


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
    """Warnings of what runs within are lines, each once, when it ends well."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        yield
    for text in dict.fromkeys(str(warning.message) for warning in told):
        print("%s: warning: %s" % (program, text), file=sys.stderr)
