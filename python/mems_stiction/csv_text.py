"""Cells of CSV files that a spreadsheet takes for text, and that a terminal can show, whoever wrote
them; and tables that were written so or by a spreadsheet, read again."""

import csv
import itertools
import re
import unicodedata

_STARTS_A_FORMULA = ("=", "+", "-", "@", "\t")
_UNSEEN = ("Cc", "Cf", "Cs")  # controls, marks of direction, halves of letters


def _spelled(letter):
    return (
        "\\x%02x" % ord(letter)
        if letter != "\t" and unicodedata.category(letter) in _UNSEEN
        else letter
    )


def csv_cell(value):
    """The value; of a text, control characters are spelled out, and an apostrophe stands before
    what a spreadsheet would take for the beginning of a formula."""
    if not isinstance(value, str):
        return value
    value = "".join(map(_spelled, value))
    if not value.startswith(_STARTS_A_FORMULA):
        return value
    try:
        float(value)
    except ValueError:
        return "'" + value
    return value


ESCAPED = r"^'([=+\-@\t])"  # what csv_cell() has put an apostrophe before


def plain_text(cell):
    """The text of a cell without that apostrophe."""
    return re.sub(ESCAPED, r"\1", cell)


class UnfitCells(Exception):
    """Why a row is none of its table, without the file's name."""


def csv_rows(stream, is_number, is_wanted=lambda name: True):
    """The number of each row's line, and its cells by the names of their columns.

    The table has commas between cells, or semicolons and decimal commas (write_csv()), which become
    points. is_number, is_wanted: by the name of a column. Raises UnfitCells and csv.Error.
    """
    first = stream.readline()
    has_semicolons = ";" in first and "," not in first
    reader = csv.reader(
        itertools.chain([first], stream), delimiter=";" if has_semicolons else ",", strict=True
    )
    names = next(reader, [])
    wanted = [(place, name) for place, name in enumerate(names) if is_wanted(name)]
    commas = [name for _, name in wanted if has_semicolons and is_number(name)]
    for cells in reader:
        if not cells:
            continue
        if len(cells) != len(names):
            raise UnfitCells(
                "line %d: has %d cells, and the header %d%s"
                % (
                    reader.line_num,
                    len(cells),
                    len(names),
                    ""
                    if has_semicolons or len(cells) < len(names)
                    else "; a table with decimal commas needs semicolons between its cells",
                )
            )
        row = {name: cells[place] for place, name in wanted}
        row.update((name, row[name].replace(",", ".")) for name in commas)
        yield reader.line_num, row
