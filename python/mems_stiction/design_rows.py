"""The rows of a sweep in a CSV file: written as they come, read again by the run that goes on."""

from __future__ import annotations

import csv
import io
import os
import pathlib
from typing import Any, Dict, List, Sequence, Tuple

from mems_stiction._settings import OptionsError
from mems_stiction.csv_text import csv_cell
from mems_stiction.design_axes import OF_THE_SPRING, Axis
from mems_stiction.design_points import Hold
from mems_stiction.whole_file import CannotWrite, refuse_pipe, whole

FIGURES = (
    "restoring_force",
    "pull_off_force",
    "pull_off_force_lower",
    "pull_off_force_upper",
    "margin",
    "margin_lower",
    "margin_upper",
    "margin_transition",
)
WORDS = ("sticks", "doubt", "version", "sweep")
ENDINGS = (".csv",)

Key = Tuple[float, ...]


class Rows:
    """All points of a sweep, one force after the other, with or without a file.

    Raises OptionsError for a file that holds anything but rows of the same sweep, OSError.
    """

    def __init__(
        self, axes: List[Axis], fixed: Dict[str, float], fingerprint: str, path: Any
    ) -> None:
        from mems_stiction.version import version

        self.axes, self.fixed, self.fingerprint, self.version = axes, fixed, fingerprint, version()
        self.names = tuple(axis.name for axis in axes) + FIGURES + WORDS
        self.path = None if path is None else pathlib.Path(os.fspath(path))
        self.rows: Dict[Key, List[Dict[str, Any]]] = {}  # of each force that is known
        if self.path is not None:
            if self.path.suffix not in ENDINGS:
                raise OptionsError("output: '%s' is not allowed, must end in .csv" % self.path)
            refuse_pipe(self.path)
            self._read()
            self.write()

    def key(self, point: Dict[str, float]) -> Key:
        return tuple(point[axis.name] for axis in self.axes if axis.name not in OF_THE_SPRING)

    def add(self, point: Dict[str, float], hold: Hold) -> None:
        key = self.key(point)
        self.rows[key] = self._rows_of(key, hold)
        if self.path is None:
            return
        text = io.StringIO(newline="")
        csv.writer(text, lineterminator="\n").writerows(self._cells(row) for row in self.rows[key])
        try:
            with open(str(self.path), "a", encoding="utf-8", newline="") as stream:
                stream.write(text.getvalue())
        except OSError as error:
            raise CannotWrite(self.path, error) from error

    def write(self) -> None:
        """All that is known, in the order of the axes."""
        if self.path is None:
            return
        with whole(self.path) as part, open(str(part), "w", encoding="utf-8", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(self.names)
            writer.writerows(self._cells(row) for row in self.all_rows())

    def all_rows(self) -> List[Dict[str, Any]]:
        rows = [row for key in self.rows for row in self.rows[key]]
        return sorted(rows, key=lambda row: [row[axis.name] for axis in self.axes])

    def _rows_of(self, key: Key, hold: Hold) -> List[Dict[str, Any]]:
        """A row for each spring of the sweep."""
        rows = self._places_of(key)
        for row in rows:
            force = 1.0
            for name in OF_THE_SPRING:
                force *= row.get(name, self.fixed.get(name, 0.0))
            row.update(
                zip(
                    FIGURES,
                    (force, hold.force, hold.force_lower, hold.force_upper) + hold.margins(force),
                )
            )
            row.update(
                sticks=hold.word(force),
                doubt=hold.doubt,
                version=self.version,
                sweep=self.fingerprint,
            )
        return rows

    def _places_of(self, key: Key) -> List[Dict[str, Any]]:
        """On all axes."""
        places: List[Dict[str, Any]] = [{}]
        rest = iter(key)
        for axis in self.axes:
            values: Sequence[float] = axis.values if axis.name in OF_THE_SPRING else (next(rest),)
            places = [dict(place, **{axis.name: value}) for place in places for value in values]
        return places

    def _cells(self, row: Dict[str, Any]) -> List[Any]:
        return [
            repr(row[name]) if isinstance(row[name], float) else csv_cell(row[name])
            for name in self.names
        ]

    def _read(self) -> None:
        """Forces that an earlier run has found. A last line that was torn off is found again."""
        assert self.path is not None
        try:
            text = self.path.read_text(encoding="utf-8")
        except FileNotFoundError:
            return
        except UnicodeDecodeError:
            raise self._foreign() from None
        lines = text[: text.rfind("\n") + 1].splitlines()
        if not lines:
            if text:
                raise self._foreign()
            return
        table = list(csv.reader(lines))
        if "margin_lower" not in table[0] or table[0][-1] != WORDS[-1]:
            raise self._foreign()
        if tuple(table[0]) != self.names:
            raise self._other()
        found: Dict[Key, List[Dict[str, Any]]] = {}
        for cells in table[1:]:
            row: Dict[str, Any] = dict(zip(self.names, cells))
            if len(cells) != len(self.names) or row["sweep"] != self.fingerprint:
                raise self._other()
            try:
                row.update({name: float(row[name]) for name in self.names if name not in WORDS})
            except ValueError:
                raise self._foreign() from None
            found.setdefault(self.key(row), []).append(row)
        for key, rows in found.items():
            places = [{axis.name: row[axis.name] for axis in self.axes} for row in rows]
            if places == self._places_of(key):  # else an interruption tore them
                self.rows[key] = rows

    def _foreign(self) -> OptionsError:
        return OptionsError(
            "%s: holds no rows of a sweep, and is not written over; remove it, or name another file"
            % self.path
        )

    def _other(self) -> OptionsError:
        return OptionsError(
            "%s: holds rows of another sweep (other scans, settings, axes or version), which this "
            "one cannot continue; remove it, or name another file" % self.path
        )
