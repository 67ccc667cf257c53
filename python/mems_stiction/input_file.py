"""Files that a script reads, asked before they are opened: a pipe would wait for its writer, a
device has no end."""

import os
import pathlib
import re
import stat
from typing import Optional, Union

_OPEN = re.compile(r"/dev/(stdin|stdout|stderr|fd/\d+)|/proc/self/fd/\d+")  # of this process


class UnfitFile(Exception):
    """Why a file is not read, without its name."""


def require_file(path: Union[str, pathlib.Path], what: str, most: Optional[int] = None) -> None:
    """Raises UnfitFile for what is no file or has more than so many bytes, OSError where there is
    none.

    what: as what it is read, with its article, as in "a bag".
    """
    status = os.stat(str(path))
    if stat.S_ISDIR(status.st_mode):
        raise UnfitFile("is a folder, not %s" % what)
    if not stat.S_ISREG(status.st_mode):
        raise UnfitFile("is a pipe, a socket or a device, not a file")
    if most is not None and status.st_size > most:
        raise UnfitFile("has %d bytes, more than the %d of %s" % (status.st_size, most, what))


def is_open_file(path: Union[str, pathlib.Path]) -> bool:
    """Whether a path names what this process was given, as /dev/stdout does: a pipe, a terminal or
    a file that others write to as well."""
    return _OPEN.fullmatch(str(path)) is not None


def is_open_pipe(path: Union[str, pathlib.Path]) -> bool:
    """Whether it is a pipe that the shell has opened, as by <(...): its writer is there."""
    return is_open_file(path) and stat.S_ISFIFO(os.stat(str(path)).st_mode)
