"""What looks wrong but is allowed, as warnings of Python that point at the line of the caller."""

from __future__ import annotations

import os
import sys
import warnings
from typing import Iterable, Type

OWN_FOLDER = os.path.dirname(os.path.abspath(__file__)) + os.sep


class ScanWarning(UserWarning):
    """A scan does not look like what it claims to be: a unit, most likely."""


class SettingsWarning(UserWarning):
    """A setting is allowed, but no material, device or instrument is likely to have it (a unit,
    most likely), or it has no effect."""


def warn(texts: Iterable[str], kind: Type[Warning]) -> None:
    """One warning for each text, at the innermost line that is not of this package."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and os.path.abspath(frame.f_code.co_filename).startswith(
        OWN_FOLDER
    ):
        level, frame = level + 1, frame.f_back
    for text in texts:
        warnings.warn(text, kind, stacklevel=level)
