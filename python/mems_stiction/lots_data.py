"""Rows of stiction_batch as places of parts, wafers and lots: what is compared, and under which condition each was predicted."""

from __future__ import annotations

import csv
import json
import math
import os
import pathlib
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from mems_stiction._settings import FileError, OptionsError
from mems_stiction.input_file import UnfitFile, require_file

RELEASING = ("margin", "peel_number")  # the device sticks below 1
FORCES = ("device_pull_off_force", "pull_off_force")
FIGURES = RELEASING + FORCES  # in the order in which they are looked for
VOLTAGES = ("voltage", "load/voltage")  # as rows of stiction_batch and of design_sweep name it
WORDS = {"margin": "margin", "peel_number": "peel number", "device_pull_off_force": "pull-off force of the device", "pull_off_force": "pull-off force",
         "rms_height": "rms height", "voltage": "voltage", "load/voltage": "voltage"}
UNITS = {"margin": "", "peel_number": "", "device_pull_off_force": "N", "pull_off_force": "N", "rms_height": "m", "voltage": "V", "load/voltage": "V"}
MOST_BYTES = 4 << 30
ENDINGS = (".csv", ".jsonl", ".ndjson")


class Place(NamedTuple):
    """One row. Texts are empty and numbers NaN where the row does not say."""

    lot: str
    wafer: str
    part: str  # with its serial number
    x: float  # on the wafer [m]
    y: float
    value: float  # of what is compared
    lower: float  # 95 % interval of this value, by constants and model
    upper: float
    force: float  # [N]
    rms_height: float  # [m]
    at: float  # what the share is asked against; 0 without
    settings: str
    name: str  # of the scan

    def is_known(self) -> bool:
        return self.value > 0.0

    def has_site(self) -> bool:
        return math.isfinite(self.x) and math.isfinite(self.y)


class Lots(NamedTuple):
    """All rows, and what of them is compared."""

    figure: str
    force: str  # the column of the forces
    against: str  # a column; empty where no condition varies
    places: Tuple[Place, ...]  # in the order of the rows
    chosen: Tuple[Place, ...]  # under one condition: those that lots, wafers and parts are compared by
    at: float  # that condition

    def conditions(self) -> List[float]:
        return sorted({place.at for place in self.places})

    def under(self, at: float) -> List[Place]:
        return [place for place in self.places if place.at == at]


def rows_of(rows: Any) -> List[Mapping[str, Any]]:
    """Dictionaries from a path, several, a table of pandas, records of NumPy, or dictionaries. Raises OptionsError, FileError."""
    if isinstance(rows, (str, os.PathLike)):
        return _read(pathlib.Path(os.fspath(rows)))
    if callable(getattr(rows, "to_dict", None)) and hasattr(rows, "columns"):
        return list(rows.to_dict("records"))
    if isinstance(rows, np.ndarray) and rows.dtype.names:
        return [dict(zip(rows.dtype.names, row)) for row in rows.tolist()]
    if isinstance(rows, Mapping) or not isinstance(rows, Iterable):
        raise OptionsError("rows: %s is not allowed, must be the path of rows of stiction_batch, a list of dictionaries, or a table of pandas" % (
            type(rows).__name__,))
    found: List[Mapping[str, Any]] = []
    for row in rows:
        if isinstance(row, Mapping):
            found.append(row)
        elif isinstance(row, (str, os.PathLike)):
            found += _read(pathlib.Path(os.fspath(row)))
        else:
            raise OptionsError("rows: an item is %r, must be a dictionary or the path of a file" % (row,))
    return found


def _read(path: pathlib.Path) -> List[Mapping[str, Any]]:
    if path.suffix not in ENDINGS:
        raise OptionsError("rows: '%s' is not allowed, must end in %s or %s" % (path, ", ".join(ENDINGS[:-1]), ENDINGS[-1]))
    try:
        require_file(path, "rows of stiction_batch", MOST_BYTES)
        with open(str(path), encoding="utf-8-sig", newline="") as stream:
            if path.suffix == ".csv":
                return [dict(row) for row in csv.DictReader(stream)]
            rows = [json.loads(line) for line in stream if line.strip()]
    except (UnfitFile, OSError) as error:
        raise FileError("%s: %s" % (path, getattr(error, "strerror", None) or error)) from None
    except (ValueError, csv.Error) as error:
        raise FileError("%s: holds no rows: %s" % (path, error)) from None
    if not all(isinstance(row, dict) for row in rows):
        raise FileError("%s: holds no rows: a line is no record" % path)
    return rows


def lots_of(rows: Any, figure: Optional[str] = None, against: Optional[str] = None) -> Lots:
    """Raises OptionsError where nothing can be compared, FileError."""
    listed = rows_of(rows)
    names = {name for row in listed for name in row}
    if figure is not None and figure not in FIGURES:
        raise OptionsError("figure: %r is not allowed, must be one of: %s" % (figure, ", ".join(FIGURES)))
    chosen = next((name for name in ((figure,) if figure else FIGURES) if any(_number(row, name) > 0.0 for row in listed)), None)
    if chosen is None:
        raise OptionsError("rows: none of %d has a %s > 0" % (len(listed), " or a ".join((figure,) if figure else FIGURES)))
    column = _against(against, names, listed)
    force = chosen if chosen in FORCES else next((name for name in FORCES if any(_number(row, name) > 0.0 for row in listed)), FORCES[-1])
    places = tuple(_place(row, chosen, force, column) for row in listed)
    if column:
        if any(place.is_known() and math.isnan(place.at) for place in places):
            raise OptionsError("%s: some of the rows have no number there; leave them out" % column)
        places = tuple(place for place in places if not math.isnan(place.at))  # a scan that was not predicted states no condition
    counts = {at: sum(place.is_known() for place in places if place.at == at) for at in sorted({place.at for place in places})}
    at = max(counts, key=lambda condition: (counts[condition], -condition))
    return Lots(chosen, force, column, places, tuple(place for place in places if place.at == at), at)


def _against(asked: Optional[str], names: Iterable[str], rows: Sequence[Mapping[str, Any]]) -> str:
    """The column of the condition."""
    if asked is not None:
        if asked not in names:
            raise OptionsError("against: the rows have no column '%s'; the model knows no ageing, so what depends on time must be measured and its "
                               "column added" % asked)
        return asked
    return next((name for name in VOLTAGES if len({_number(row, name) for row in rows if math.isfinite(_number(row, name))}) > 1), "")


def _number(row: Mapping[str, Any], name: str) -> float:
    try:
        return float(row.get(name, math.nan))  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return math.nan


def _text(row: Mapping[str, Any], name: str) -> str:
    """An identifier as people write it, whatever a table has made of it: 7.0 is 7, a missing one is empty."""
    value = row.get(name, "")
    value = value.item() if hasattr(value, "item") else value
    if value is None or isinstance(value, float) and math.isnan(value):
        return ""
    if isinstance(value, float) and value.is_integer():
        return "%d" % value
    text = str(value).strip()
    return text[1:] if text.startswith("'") and text[1:2] in ("=", "+", "-", "@", "\t") else text  # as csv_text writes it


def _place(row: Mapping[str, Any], figure: str, force: str, against: str) -> Place:
    part, serial = _text(row, "part_id"), _text(row, "serial_id")
    value = _number(row, figure)
    lower, upper = (_number(row, figure + end) for end in ("_lower", "_upper"))
    if value == math.inf:
        lower = upper = math.inf
    is_interval = 0.0 < lower <= value <= upper
    return Place(_text(row, "lot_id"), _text(row, "wafer_id"), "%s no. %s" % (part, serial) if part and serial else part or serial,
                 _number(row, "site_x"), _number(row, "site_y"), value if value > 0.0 else math.nan, lower if is_interval else math.nan,
                 upper if is_interval else math.nan, _number(row, force), _number(row, "rms_height"), _number(row, against) if against else 0.0,
                 _text(row, "settings_hash"), _text(row, "scan_name") or _text(row, "name") or _text(row, "file"))


def word_of(place: Place) -> str:
    """Which place, in words."""
    where = "at (%s, %s) mm" % tuple("%.4g" % (1e3 * value + 0.0) for value in (place.x, place.y)) if place.has_site() else place.name
    return " ".join(text for text in (wafer_word(place.lot, place.wafer), where) if text) or "a place without a name"


def wafer_word(lot: str, wafer: str) -> str:
    parts = ["wafer %s" % wafer] if wafer else []
    return " of ".join(parts + (["lot %s" % lot] if lot else []))


def by_wafer(places: Iterable[Place]) -> Dict[Tuple[str, str], List[Place]]:
    """In the order in which the wafers come."""
    found: Dict[Tuple[str, str], List[Place]] = {}
    for place in places:
        found.setdefault((place.lot, place.wafer), []).append(place)
    return found
