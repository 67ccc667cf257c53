"""Tables of rows as people keep them: CSV, or Parquet with the unit of each column and where the
rows come from."""

import csv
import decimal
import re

from mems_stiction.csv_text import ESCAPED, csv_cell
from mems_stiction.json_text import read_json
from mems_stiction.version import version
from mems_stiction.whole_file import whole

PARQUET = ".parquet"
NEEDS = "Parquet needs the Python package pyarrow (pip install pyarrow; with NumPy 1 pyarrow 17)"
FEW_LEVELS = 100  # of lists and maps in one another, which every reader bears
STAMP = "stamp"  # the column with the time of a scan
_UNIT = re.compile(r"\[(-|[A-Za-z][\w/^]*)\]")
_FIELD = re.compile(r"[\w/]+(?:\[\d*\])?\s+(\w+)\s*(?:#(.*))?$")


class Stamp(int):
    """A time in nanoseconds: seconds with all their digits in a CSV, a time stamp in Parquet."""

    @classmethod
    def of(cls, text):
        """ "1000000000.1" in seconds."""
        return cls(decimal.Decimal(text).scaleb(9))

    def __str__(self):
        return "%d.%09d" % divmod(int(self), 10**9)


def units_of(message_class, prefix=""):
    """{field: unit} by the comments of a message's definition; "-" for a ratio or a count."""
    units = {}
    name = None
    for line in message_class._full_text.split("\n" + "=" * 80)[0].splitlines():
        field = _FIELD.match(line)
        comment = (
            field.group(2)
            if field
            else line
            if line.lstrip().startswith("#") and line != line.lstrip()
            else None
        )
        name = field.group(1) if field else name if comment else None
        unit = _UNIT.search(comment or "")
        if name and unit:
            units.setdefault(prefix + name, unit.group(1))
    return units


def is_parquet(path):
    return str(path).endswith(PARQUET)


def require_parquet(option, path):
    """Before the work, not after it: raises OSError where a table cannot be written for want of a
    library."""
    if not path or not is_parquet(path):
        return
    try:
        import pyarrow.parquet  # noqa: F401
    except ImportError:
        raise OSError("%s: %s cannot be written: %s" % (option, path, NEEDS))


def write_rows(path, names, rows, units, origin=None, is_for_excel=False):
    """A table of dictionaries, whole or not at all; its kind goes by the ending of the path.

    names: of the columns; a row may lack some. units: {name: unit}, SI. origin: {word: text} of all
    rows together. Both are left out of a CSV.
    """
    if is_parquet(path):
        write_table(path, _table_of(names, rows, units), units, origin or {})
        return
    with whole(path) as part, open(str(part), "w", encoding="utf-8", newline="") as stream:
        write_csv(stream, names, rows, is_for_excel)


def write_csv(stream, names, rows, is_for_excel=False):
    """The rows as text; columns that a row lacks are empty there.

    is_for_excel: as spreadsheets of most of Europe read them: semicolons between cells, a comma in
    numbers, and a mark of UTF-8 before all.
    """
    if is_for_excel:
        stream.write("\ufeff")
    writer = csv.writer(stream, delimiter=";" if is_for_excel else ",", lineterminator="\n")
    writer.writerow(names)
    cell = _excel_cell if is_for_excel else _cell
    writer.writerows([cell(row.get(name)) for name in names] for row in rows)


def _excel_cell(value):
    text = _cell(value)
    return str(text).replace(".", ",") if isinstance(value, (float, Stamp)) else text


def _cell(value):
    if value is None:
        return ""
    if isinstance(value, float):
        return repr(value)
    return int(value) if isinstance(value, bool) else csv_cell(value)


def _table_of(names, rows, units):
    import pyarrow

    columns = [[row.get(name) for row in rows] for name in names]
    kinds = [_kind_of(column, name in units, pyarrow) for name, column in zip(names, columns)]
    return pyarrow.Table.from_arrays(
        [
            pyarrow.array(_of_kind(column, kind, pyarrow), kind)
            for column, kind in zip(columns, kinds)
        ],
        names=list(names),
    )


def _kind_of(column, has_unit, pyarrow):
    """The type of a column, by its values; what has a unit is a number, even if no row knows it."""
    values = [value for value in column if value is not None]
    if not values:
        return pyarrow.float64() if has_unit else pyarrow.string()
    if all(isinstance(value, Stamp) for value in values):
        return _time(pyarrow)
    if all(isinstance(value, bool) for value in values):
        return pyarrow.bool_()
    if all(isinstance(value, int) for value in values):
        return (
            pyarrow.int64()
            if all(-(2**63) <= value < 2**63 for value in values)
            else pyarrow.float64()
        )
    return (
        pyarrow.float64()
        if all(isinstance(value, (int, float)) for value in values)
        else pyarrow.string()
    )


def _time(pyarrow):
    return pyarrow.timestamp("ns", tz="UTC")


def _of_kind(column, kind, pyarrow):
    if kind == pyarrow.string():
        return [value if value is None else str(value) for value in column]
    return (
        [float(value) for value in column]
        if kind == pyarrow.float64() and None not in column
        else column
    )


def _check_levels(lines):
    """pyarrow's process dies of lists in lists in lists."""
    for line in lines:
        if line.count("[") + line.count("{") > FEW_LEVELS:
            read_json(line)


def converted(path, units, kinds, is_text):
    """The rows of a CSV or of JSON lines as a table of pyarrow. A figure has the same type in every
    file, known or not. pyarrow gets open files, since its own names of them are UTF-8.

    kinds: {name: "float", "int", "bool" or "str"} of what is declared; what else has a unit is a
    number. is_text: whether another column is a text, whatever it looks like (a part 0012, a hash
    12e4); the rest goes by its values. Raises OSError, and ValueError for what are no rows.
    """
    import pyarrow
    import pyarrow.compute
    import pyarrow.csv
    import pyarrow.json

    of_word = {
        "float": pyarrow.float64(),
        "int": pyarrow.int64(),
        "bool": pyarrow.bool_(),
        "str": pyarrow.string(),
    }
    is_csv = str(path).endswith(".csv")
    with open(str(path), encoding="utf-8-sig", newline="") as stream:
        names = next(csv.reader(stream), []) if is_csv else read_json(stream.readline() or "{}")
        if not is_csv:
            _check_levels(stream)
    if not isinstance(names, (list, dict)) or isinstance(names, list) != is_csv:
        raise ValueError("the first line is no record")
    declared = {name: pyarrow.string() for name in names if name == STAMP or is_text(name)}
    declared.update({name: pyarrow.float64() for name in names if name in units})
    declared.update({name: of_word[kinds[name]] for name in names if name in kinds})
    if is_csv:
        options = pyarrow.csv.ConvertOptions(
            column_types=declared, strings_can_be_null=True, null_values=[""]
        )
        with open(str(path), "rb") as stream:
            table = pyarrow.csv.read_csv(
                stream,
                parse_options=pyarrow.csv.ParseOptions(newlines_in_values=True),
                convert_options=options,
            )
    else:
        options = pyarrow.json.ParseOptions(explicit_schema=pyarrow.schema(list(declared.items())))
        with open(str(path), "rb") as stream:
            table = pyarrow.json.read_json(stream, parse_options=options)
    columns = []
    for name, column in zip(table.column_names, table.columns):
        if pyarrow.types.is_null(column.type):
            column = column.cast(pyarrow.string())
        if name == STAMP:
            times = [Stamp.of(text) if text else None for text in column.to_pylist()]
            column = pyarrow.chunked_array([pyarrow.array(times, _time(pyarrow))])
        elif is_csv and pyarrow.types.is_string(column.type):
            column = pyarrow.compute.replace_substring_regex(column, ESCAPED, r"\1")
        columns.append(column)
    return pyarrow.Table.from_arrays(columns, names=table.column_names)


def write_table(path, table, units, origin):
    """A table of pyarrow with units and origin, whole or not at all."""
    import pyarrow
    import pyarrow.parquet

    fields = [
        field.with_metadata({"unit": units[field.name]}) if field.name in units else field
        for field in table.schema
    ]
    told = {
        "mems_stiction." + word: str(text)
        for word, text in dict({"version": version()}, **origin).items()
        if text is not None
    }
    # Not by its name: pyarrow removes what it cannot write, be it a device.
    with whole(path) as part, open(str(part), "wb") as stream:
        pyarrow.parquet.write_table(
            table.cast(pyarrow.schema(fields, told)), stream, compression="zstd"
        )
