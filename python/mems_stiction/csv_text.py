"""Cells of CSV files that a spreadsheet takes for text, whoever wrote it."""

_STARTS_A_FORMULA = ("=", "+", "-", "@", "\t")


def csv_cell(value):
    """The value, or a text with an apostrophe before what a spreadsheet would take for the beginning of a formula."""
    if not isinstance(value, str) or not value.startswith(_STARTS_A_FORMULA):
        return value
    try:
        float(value)
    except ValueError:
        return "'" + value
    return value
