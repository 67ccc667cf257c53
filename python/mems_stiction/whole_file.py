"""Files that are whole or absent, whatever happens while they are written: Ctrl-C, a full disk."""

import contextlib
import errno
import os
import pathlib
import shutil


def part_of(path):
    """The place beside a file where it is written, with its ending, which says to others what is in it."""
    return path.with_name(".%s.part%s" % (path.stem, path.suffix))


def refuse_pipe(path):
    """Raises OSError for a pipe, which would wait for somebody who reads it, or a socket."""
    if path.is_fifo() or path.is_socket():
        raise OSError(errno.EINVAL, "is a pipe or a socket, must be a file", str(path))


@contextlib.contextmanager
def whole(path):
    """A place to write to; what was written there takes the file's name when it is whole.

    A link stays a link, and a device is written to as it is.
    """
    path = pathlib.Path(os.path.realpath(str(path)))
    refuse_pipe(path)
    if path.exists() and not path.is_file():
        yield path
        return
    part = part_of(path)
    try:
        yield part
        if path.exists():
            shutil.copymode(str(path), str(part))
        os.replace(str(part), str(path))
    except BaseException:
        with contextlib.suppress(OSError):
            part.unlink()
        raise


def check_writable(path):
    """Raises OSError if a file cannot be written there by whole()."""
    path = pathlib.Path(os.path.realpath(str(path)))
    refuse_pipe(path)
    if path.exists():
        with open(str(path), "ab"):
            pass
        if not path.is_file():
            return
    part = part_of(path)
    with open(str(part), "wb"):
        pass
    part.unlink()
