"""Which columns a table of predictions gets: named groups of them, single ones, or all that some
row has a value for. The core has the groups and chooses, as it does for stiction_batch."""

import math

from mems_stiction import _core

OptionsError = _core.OptionsError
#: (name, what it is for); a column is of the first group that it fits.
GROUPS = tuple(_core.column_groups())


def groups_text():
    """All groups with their meanings, for --help."""
    return "; ".join("%s: %s" % group for group in GROUPS)


def _has_value(value):
    return (
        value is not None and value != "" and not (isinstance(value, float) and math.isnan(value))
    )


def chosen_columns(names, rows, wanted=None):
    """Those of the names that a table gets, in the order of the names; of what is wanted in the
    order in which it is wanted.

    wanted: groups and columns with commas between, "all", or None for all that some row has a value
    for: what a formulation does not know is left out. Raises OptionsError naming --columns.
    """
    known = [name for name in names if any(_has_value(row.get(name)) for row in rows)]
    return _core.chosen_columns(list(names), known, wanted)
