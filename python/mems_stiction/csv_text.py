"""Cells of CSV files that a spreadsheet takes for text, and that a terminal can show, whoever wrote
them."""

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
