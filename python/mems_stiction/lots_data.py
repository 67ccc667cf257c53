"""Rows of stiction_batch as places of parts, wafers and lots: what is compared, and under which
condition each was predicted."""

from __future__ import annotations

import array
import csv
import math
import os
import pathlib
import sys
from typing import (
    Any,
    Dict,
    Iterable,
    Iterator,
    List,
    Mapping,
    NamedTuple,
    Optional,
    Sequence,
    Set,
    Tuple,
)

import numpy as np

from mems_stiction._settings import FileError, OptionsError
from mems_stiction.csv_text import UnfitCells, csv_rows, plain_text
from mems_stiction.input_file import UnfitFile, require_file
from mems_stiction.json_text import json_records
from mems_stiction.row_table import PARQUET

RELEASING = ("margin", "peel_number")  # the device sticks below 1
FORCES = ("device_pull_off_force", "pull_off_force")
FIGURES = RELEASING + FORCES  # in the order in which they are looked for
VOLTAGES = ("voltage", "load/voltage")  # as rows of stiction_batch and of design_sweep name it
WORDS = {
    "margin": "margin",
    "peel_number": "peel number",
    "device_pull_off_force": "pull-off force of the device",
    "pull_off_force": "pull-off force",
    "rms_height": "rms height",
    "voltage": "voltage",
    "load/voltage": "voltage",
}
UNITS = {
    "margin": "",
    "peel_number": "",
    "device_pull_off_force": "N",
    "pull_off_force": "N",
    "rms_height": "m",
    "voltage": "V",
    "load/voltage": "V",
}
MOST_BYTES = 4 << 30
ENDINGS = (".csv", ".jsonl", ".ndjson", PARQUET)
RMS_HEIGHT = "rms_height"
SITES = ("site_x", "site_y")
TEXTS = (
    "lot_id",
    "wafer_id",
    "part_id",
    "serial_id",
    "settings_hash",
    "scan_name",
    "name",
    "file",
    "governed_by",
)
NUMBERS = (
    FIGURES
    + tuple(figure + end for figure in FIGURES for end in ("_lower", "_upper"))
    + VOLTAGES
    + SITES
    + (RMS_HEIGHT,)
)


NOT_NEGATIVE = ("margin",) + FORCES + (RMS_HEIGHT,)  # peel numbers of beams that buckle are
Where = Tuple[str, int]  # "rows.csv, line ", and its number; 0: the number of the row


class Place(NamedTuple):
    """One row, or the rows of one site. Texts are empty and numbers NaN where a row does not
    say."""

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

    def site(self) -> Any:
        """The same for all scans of a site of a part; a row without a site is one by itself."""
        where = (self.x, self.y) if self.has_site() else id(self)
        return self.lot, self.wafer, self.part, self.at, where


class Lots(NamedTuple):
    """All rows, and what of them is compared."""

    figure: str
    force: str  # the column of the forces
    against: str  # a column; empty where no condition varies
    places: Tuple[Place, ...]  # in the order of the rows
    chosen: Tuple[
        Place, ...
    ]  # under one condition: those that lots, wafers and parts are compared by
    at: float  # that condition

    def conditions(self) -> List[float]:
        return sorted({place.at for place in self.places})

    def under(self, at: float) -> List[Place]:
        return [place for place in self.places if place.at == at]


class _Table:
    """What is needed of all rows, by columns: a row of stiction_batch has some hundred cells, and
    there may be millions of rows."""

    def __init__(self, against: Optional[str]) -> None:
        self.count = 0
        self.has_against = False
        self._against = against
        self._texts: Dict[str, List[str]] = {name: [] for name in TEXTS}
        self._numbers = {
            name: array.array("d") for name in NUMBERS + ((against,) if against else ())
        }
        self.columns = {*self._texts, *self._numbers}

    def add(self, row: Mapping[str, Any], where: Where = ("row ", 0)) -> None:
        """where: the file and line of the row; else it is called by its number."""
        self.count += 1
        self.has_against = self.has_against or self._against in row
        for name, texts in self._texts.items():
            texts.append(sys.intern(_text(row.get(name, ""))))
        for name, numbers in self._numbers.items():
            number = _number(row.get(name))
            if number is None or number < 0.0 and name in NOT_NEGATIVE:
                raise OptionsError(
                    "%s: %r in %s%d is not allowed, must be %s, or empty"
                    % (name, row[name], where[0], where[1] or self.count, _allowed(name))
                )
            numbers.append(number)

    def texts(self, name: str) -> List[str]:
        return self._texts[name]

    def numbers(self, name: str) -> np.ndarray:
        return np.frombuffer(self._numbers[name]) if self.count else np.zeros(0)

    def has(self, figure: str) -> bool:
        """Whether a row has a value of it."""
        return bool((self.numbers(figure) > 0.0).any())


def _rows_of(rows: Any, columns: Set[str]) -> Iterator[Tuple[Mapping[str, Any], Where]]:
    """Dictionaries from a path, several, a table of pandas, records of NumPy, or dictionaries; of
    files and tables with these columns alone. Each with where it stands. Raises OptionsError,
    FileError."""
    nowhere: Where = ("row ", 0)
    if isinstance(rows, (str, os.PathLike)):
        yield from _read(pathlib.Path(os.fspath(rows)), columns)
    elif callable(getattr(rows, "to_dict", None)) and hasattr(rows, "columns"):
        names = [name for name in rows.columns if name in columns]
        yield from (
            (dict(zip(names, cells)), nowhere)
            for cells in zip(
                *(
                    rows[name].astype(object).where(rows[name].notna(), None).tolist()
                    for name in names
                )
            )
        )
    elif isinstance(rows, np.ndarray) and rows.dtype.names:
        yield from ((dict(zip(rows.dtype.names, row)), nowhere) for row in rows.tolist())
    elif isinstance(rows, Mapping) or not isinstance(rows, Iterable):
        raise OptionsError(
            "rows: %s is not allowed, must be the path of rows of stiction_batch, a list of "
            "dictionaries, or a table of pandas" % (type(rows).__name__,)
        )
    else:
        for row in rows:
            if isinstance(row, Mapping):
                yield row, nowhere
            elif isinstance(row, (str, os.PathLike)):
                yield from _read(pathlib.Path(os.fspath(row)), columns)
            else:
                raise OptionsError(
                    "rows: an item is %r, must be a dictionary or the path of a file" % (row,)
                )


def _read(path: pathlib.Path, columns: Set[str]) -> Iterator[Tuple[Mapping[str, Any], Where]]:
    if path.suffix not in ENDINGS:
        raise OptionsError(
            "rows: '%s' is not allowed, must end in %s or %s"
            % (path, ", ".join(ENDINGS[:-1]), ENDINGS[-1])
        )
    of_row, of_line = ("%s, %s " % (path, word) for word in ("row", "line"))
    try:
        require_file(path, "rows of stiction_batch", MOST_BYTES)
        if path.suffix == PARQUET:
            for number, row in enumerate(_parquet_rows(path, columns), 1):
                yield row, (of_row, number)
            return
        with open(str(path), encoding="utf-8-sig", newline="") as stream:
            if path.suffix == ".csv":
                for number, cells in csv_rows(
                    stream, lambda name: name not in TEXTS, columns.__contains__
                ):
                    yield cells, (of_line, number)
            else:
                for number, row in enumerate(json_records(stream), 1):
                    yield row, (of_row, number)
    except (UnfitFile, OSError) as error:
        raise FileError("%s: %s" % (path, getattr(error, "strerror", None) or error)) from None
    except UnfitCells as error:
        raise FileError("%s, %s" % (path, error)) from None
    except (ValueError, csv.Error) as error:
        raise FileError("%s: holds no rows: %s" % (path, error)) from None


def _parquet_rows(path: pathlib.Path, columns: Set[str]) -> Iterator[Mapping[str, Any]]:
    try:
        import pyarrow.parquet
    except ImportError:
        raise OptionsError(
            "rows: '%s' needs the Python package pyarrow (pip install pyarrow)" % path
        ) from None
    with open(str(path), "rb") as stream:
        file = pyarrow.parquet.ParquetFile(stream)
        for batch in file.iter_batches(
            columns=[name for name in file.schema_arrow.names if name in columns]
        ):
            yield from batch.to_pylist()


def lots_of(rows: Any, figure: Optional[str] = None, against: Optional[str] = None) -> Lots:
    """Raises OptionsError where nothing can be compared, FileError."""
    if figure is not None and figure not in FIGURES:
        raise OptionsError(
            "figure: %r is not allowed, must be one of: %s" % (figure, ", ".join(FIGURES))
        )
    table = _Table(against)
    for row, where in _rows_of(rows, table.columns):
        table.add(row, where)
    is_peeled = "peeling" in table.texts("governed_by") and "force" not in table.texts(
        "governed_by"
    )
    looked_for = (figure,) if figure else FIGURES[1::-1] + FIGURES[2:] if is_peeled else FIGURES
    chosen = next((name for name in looked_for if table.has(name)), None)
    if not table.count:
        raise OptionsError("rows: there is none, must hold one row at least")
    if chosen is None:
        raise OptionsError(
            "rows: none of %d has a %s > 0"
            % (table.count, " or a ".join((figure,) if figure else FIGURES))
        )
    column = _against(against, table)
    force = (
        chosen
        if chosen in FORCES
        else next((name for name in FORCES if table.has(name)), FORCES[-1])
    )
    places = _places(table, chosen, force, column)
    if column:
        if any(place.is_known() and math.isnan(place.at) for place in places):
            raise OptionsError("%s: some of the rows have no number there; leave them out" % column)
        places = tuple(
            place for place in places if not math.isnan(place.at)
        )  # a scan that was not predicted states no condition
    counts = {
        at: sum(place.is_known() for place in places if place.at == at)
        for at in sorted({place.at for place in places})
    }
    at = max(counts, key=lambda condition: (counts[condition], -condition))
    return Lots(
        chosen, force, column, places, tuple(place for place in places if place.at == at), at
    )


def _against(asked: Optional[str], table: _Table) -> str:
    """The column of the condition."""
    if asked is not None:
        if not table.has_against:
            raise OptionsError(
                "against: the rows have no column '%s'; the model knows no ageing, so what depends "
                "on time must be measured and its column added" % asked
            )
        return asked
    return next((name for name in VOLTAGES if np.unique(_finite(table.numbers(name))).size > 1), "")


def _finite(values: np.ndarray) -> np.ndarray:
    return values[np.isfinite(values)]


def _allowed(name: str) -> str:
    return "a number%s%s" % (
        " in metres" if name in SITES else "",
        " >= 0" if name in NOT_NEGATIVE else "",
    )


def _number(value: Any) -> Optional[float]:
    """NaN where the row does not say; None for what is no number."""
    if value is None or isinstance(value, str) and not value.strip():
        return math.nan
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def _text(value: Any) -> str:
    """An identifier as people write it, whatever a table has made of it: 7.0 is 7, a missing one is
    empty."""
    value = value.item() if hasattr(value, "item") else value
    if value is None or isinstance(value, float) and math.isnan(value):
        return ""
    if isinstance(value, float) and value.is_integer():
        return "%d" % value
    return plain_text(str(value).strip())


def _places(table: _Table, figure: str, force: str, against: str) -> Tuple[Place, ...]:
    values, lower, upper = (table.numbers(figure + end) for end in ("", "_lower", "_upper"))
    ends = [np.where(values == math.inf, math.inf, end) for end in (lower, upper)]
    is_interval = (ends[0] > 0.0) & (ends[0] <= values) & (values <= ends[1])
    parts = [
        "%s no. %s" % (part, serial) if part and serial else part or serial
        for part, serial in zip(table.texts("part_id"), table.texts("serial_id"))
    ]
    names = [
        name or other or file
        for name, other, file in zip(*map(table.texts, ("scan_name", "name", "file")))
    ]
    numbers = [
        column.tolist()
        for column in (
            table.numbers("site_x"),
            table.numbers("site_y"),
            np.where(values > 0.0, values, math.nan),
            np.where(is_interval, ends[0], math.nan),
            np.where(is_interval, ends[1], math.nan),
            table.numbers(force),
            table.numbers(RMS_HEIGHT),
            table.numbers(against) if against else np.zeros(table.count),
        )
    ]
    return tuple(
        Place._make((lot, wafer, part) + of_row + (settings, name))
        for lot, wafer, part, of_row, settings, name in zip(
            table.texts("lot_id"),
            table.texts("wafer_id"),
            parts,
            zip(*numbers),
            table.texts("settings_hash"),
            names,
        )
    )


def at_sites(places: Iterable[Place]) -> List[Place]:
    """One place for each site of a part, whose figures are the geometric means of its scans: scans
    of one site are no independent places. Of what nothing holds on one scan, the others tell; a row
    without a site is a place by itself."""
    groups: Dict[Any, List[Place]] = {}
    for place in places:
        groups.setdefault(place.site(), []).append(place)
    return [_mean_of(scans) if len(scans) > 1 else scans[0] for scans in groups.values()]


def _mean_of(scans: List[Place]) -> Place:
    value = _mean([scan.value for scan in scans])
    lower, upper = (
        value * _mean([getattr(scan, end) / scan.value for scan in scans])
        for end in ("lower", "upper")
    )
    return scans[0]._replace(
        value=value,
        lower=value if math.isinf(value) else lower,
        upper=value if math.isinf(value) else upper,
        force=_mean([scan.force for scan in scans]),
        rms_height=_mean([scan.rms_height for scan in scans]),
        name=", ".join(dict.fromkeys(scan.name for scan in scans if scan.name)),
    )


def _mean(values: Sequence[float]) -> float:
    """Geometric, of those that are finite and > 0; infinite where all that are known are."""
    known = [value for value in values if value > 0.0]
    finite = [math.log(value) for value in known if value < math.inf]
    return math.exp(sum(finite) / len(finite)) if finite else math.inf if known else math.nan


def word_of(place: Place) -> str:
    """Which place, in words."""
    where = (
        "at (%s, %s) mm" % tuple("%.4g" % (1e3 * value + 0.0) for value in (place.x, place.y))
        if place.has_site()
        else place.name
    )
    return (
        " ".join(text for text in (wafer_word(place.lot, place.wafer), where) if text)
        or "a place without a name"
    )


def wafer_word(lot: str, wafer: str) -> str:
    parts = ["wafer %s" % wafer] if wafer else []
    return " of ".join(parts + (["lot %s" % lot] if lot else []))


def by_wafer(places: Iterable[Place]) -> Dict[Tuple[str, str], List[Place]]:
    """In the order in which the wafers come."""
    found: Dict[Tuple[str, str], List[Place]] = {}
    for place in places:
        found.setdefault((place.lot, place.wafer), []).append(place)
    return found
