"""Messages as rows of a table: a cell for each field, by its name."""

import genpy

from mems_stiction.row_table import units_of

WITHOUT = ("header", "curve")


def flattened(message, prefix=""):
    """{name: cell} of a message, parts of nested ones as part/field; the names of today's message
    are those of its slots."""
    cells = {}
    for name in message.__slots__:
        if not prefix and name in WITHOUT:
            continue
        value = getattr(message, name)
        if hasattr(value, "__slots__"):
            cells.update(flattened(value, prefix + name + "/"))
        elif isinstance(value, (list, tuple)):
            cells[prefix + name] = "; ".join(str(part) for part in value)
        else:
            cells[prefix + name] = value
    return cells


def units_of_fields(message, prefix=""):
    """{name: unit} of what flattened() gives of a message of today's definition."""
    units = units_of(type(message), prefix)
    for name in message.__slots__:
        value = getattr(message, name)
        if isinstance(value, genpy.Message):
            units.update(units_of_fields(value, prefix + name + "/"))
    return units
