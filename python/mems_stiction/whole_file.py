"""Files that are whole or absent, whatever happens while they are written: Ctrl-C, a full disk."""

import contextlib
import errno
import os
import pathlib
import secrets
import shutil
import sys
import tempfile

from mems_stiction.input_file import is_open_file


class CannotWrite(OSError):
    """A file that could not be written; the text is one sentence with its name."""

    def __init__(self, path, error):
        super().__init__(error.errno, error.strerror or str(error))
        self._path = path

    def __str__(self):
        return "%s: cannot be written: %s" % (self._path, self.strerror)


def reason_of(error):
    """An OSError in words, without its number: "a.csv: No such file or directory"."""
    if isinstance(error, CannotWrite) or not error.strerror:
        return str(error)
    if error.filename:
        return "%s: %s" % (error.filename, error.strerror)
    is_disk = error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
    return ("what is printed cannot be written: " if is_disk else "") + error.strerror


def new_part_of(path):
    """A new, empty file beside a file, with its ending, which says to others what is in it.

    Nobody can guess the name, and what stands there already, as a link that somebody laid, is never
    written to.
    """
    while True:
        part = path.with_name(".%s.part-%s%s" % (path.stem, secrets.token_hex(6), path.suffix))
        with contextlib.suppress(FileExistsError):
            os.close(
                os.open(
                    str(part),
                    os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_CLOEXEC", 0),
                    0o666,
                )
            )
            return part


def refuse_pipe(path):
    """Raises OSError for a pipe, which would wait for somebody who reads it, or a socket."""
    if path.is_fifo() or path.is_socket():
        raise OSError(errno.EINVAL, "is a pipe or a socket, must be a file", str(path))


@contextlib.contextmanager
def _behind(path):
    """A file of its own, whose bytes go behind what was written to an open file before."""
    with tempfile.TemporaryDirectory() as folder:
        part = pathlib.Path(folder, "part" + pathlib.Path(path).suffix)
        yield part
        sys.stdout.flush()
        number = {"stdin": 0, "stdout": 1, "stderr": 2}.get(path.name)
        try:
            with (
                open(str(part), "rb") as source,
                os.fdopen(os.dup(int(path.name) if number is None else number), "wb") as stream,
            ):
                shutil.copyfileobj(source, stream)
        except OSError as error:
            raise CannotWrite(path, error) from error


@contextlib.contextmanager
def whole(path):
    """A place to write to; what was written there takes the file's name when it is whole.

    A link stays a link, and a device is written to as it is; what is written to /dev/stdout goes
    behind what stands there. Raises CannotWrite where that fails.
    """
    asked = path
    if is_open_file(path):
        with _behind(pathlib.Path(path)) as part:
            yield part
        return
    path = pathlib.Path(os.path.realpath(str(path)))
    refuse_pipe(path)
    is_device = path.exists() and not path.is_file()
    try:
        part = path if is_device else new_part_of(path)
    except OSError as error:
        raise CannotWrite(asked, error) from error
    try:
        yield part
        if is_device:
            return
        if path.exists():
            shutil.copymode(str(path), str(part))
        os.replace(str(part), str(path))
    except BaseException as error:
        if not is_device:
            with contextlib.suppress(OSError):
                part.unlink()
        if (
            isinstance(error, OSError)
            and not isinstance(error, CannotWrite)
            and error.filename in (None, str(part), part)
        ):
            raise CannotWrite(asked, error) from error
        raise


def check_writable(path):
    """Raises OSError if a file cannot be written there by whole(); CannotWrite where the place
    beside it, which nobody has named, is why."""
    if is_open_file(path):
        return
    asked = path
    path = pathlib.Path(os.path.realpath(str(path)))
    refuse_pipe(path)
    if path.exists():
        with open(str(path), "ab"):
            pass
        if not path.is_file():
            return
    try:
        new_part_of(path).unlink()
    except OSError as error:
        raise CannotWrite(asked, error) from error
