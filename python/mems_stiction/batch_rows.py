"""Rows of stiction_batch (CSV or JSON lines), read back with their types, units and origin."""

import csv

from mems_stiction.csv_text import plain_text
from mems_stiction.input_file import UnfitFile, require_file
from mems_stiction.json_text import json_records
from mems_stiction.row_table import STAMP, Stamp

ENDINGS = (".csv", ".jsonl", ".ndjson")
HALF_SPACE = "half_space_"  # before the figures of one in a row
COUNTS = {
    "number": "int",
    "scan": "int",
    "rows": "int",
    "cols": "int",
    "file_size": "int",
    "regime_flags": "int",
    "place_deviation": "float",
}
_TYPES = {"float": float, "int": int, "bool": {"true": True, "false": False}.__getitem__}


class UnfitRows(Exception):
    """Why a file holds no rows, as a sentence with its name."""


def said_beside(path):
    """Units and origin of rows, by the settings beside them; both are empty for a table of another
    program. Raises UnfitRows."""
    from mems_stiction.yaml_text import UnfitYaml, read_yaml

    settings = path.with_name(path.name + ".settings.yaml")
    if not settings.is_file():
        return {}, {}
    text = settings.read_text(encoding="utf-8")
    try:
        said = read_yaml(text)
        return dict(said["units"]), {"version": said["version"], "settings": text}
    except UnfitYaml as error:
        raise UnfitRows("%s: %s" % (settings, error))
    except (KeyError, TypeError):
        raise UnfitRows("%s: has no units and version, as stiction_batch writes them" % settings)


def declared():
    """{name: kind} and {name: unit} of the figures that the core declares alike for all results."""
    from mems_stiction import _core

    kinds, units = {}, {}
    for result, figures in _core.figures.items():
        for name, (kind, unit, _) in figures.items():
            for column in (name, HALF_SPACE + name) if result == "HalfSpaceFigures" else (name,):
                kinds.setdefault(column, set()).add(kind)
                units.setdefault(column, set()).add(unit)
    return (
        dict(COUNTS, **{name: found.pop() for name, found in kinds.items() if len(found) == 1}),
        {name: found.pop() for name, found in units.items() if len(found) == 1 and "" not in found},
    )


def batch_rows(path):
    """The rows of a file as dictionaries in the order of its columns; None: the row does not know
    it, or it is no number. Raises UnfitRows, OSError."""
    kinds, units = declared()
    kinds = dict({name: "float" for name in {**units, **said_beside(path)[0]}}, **kinds)
    rows = []
    try:
        require_file(path, "a table of rows")
        with open(str(path), encoding="utf-8-sig", newline="") as stream:
            if path.suffix == ".csv":
                for row in csv.DictReader(stream, strict=True):
                    rows.append({name: _typed(text, kinds.get(name)) for name, text in row.items()})
            else:
                rows = list(json_records(stream))
    except UnfitFile as error:
        raise UnfitRows("%s cannot be read: %s" % (path, error))
    except (ValueError, TypeError, KeyError, AttributeError, csv.Error) as error:
        raise UnfitRows("%s: holds no rows: %s" % (path, error))
    if not rows or not all("number" in row for row in rows):
        raise UnfitRows("%s: holds no rows of stiction_batch" % path)
    for row in rows:
        row[STAMP] = Stamp.of(row[STAMP]) if row.get(STAMP) else None
    return rows


def _typed(text, kind):
    if text in ("", "nan") or text is None:
        return None
    return _TYPES[kind](text) if kind in _TYPES else plain_text(text)
