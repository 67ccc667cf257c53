"""Which columns a table of predictions gets: named groups of them, single ones, or all that some
row has a value for."""

import difflib
import math
import re

ALL = "all"
#: (name, what it is for, pattern of its columns); a column is of the first group that it fits.
GROUPS = (
    (
        "origin",
        "which scan of what, when and by whom",
        r"time|stamp|bag|topic|frame_id|number|file|scan|name|channel|scan_name|\w+_id|site_[xy]|"
        r"acquisition_time|instrument|operator_name|checksum|file_\w+|\w+_checksum|scan_count",
    ),
    ("half_space", "the surface as one elastic half-space", r"half_space_\w+"),
    (
        "verdict",
        "does the device stick",
        r"sticks|reason|verdict_\w+|margin\w*|peel_number\w*|restoring_force|device_pull_off_force\w*|"
        r"detachment_length|unstuck_length|pull_in_voltage\w*|governed_by|is_peeled|place_deviation",
    ),
    (
        "doubts",
        "flags and warnings",
        r"\w*flags|regime_flag_names|model_doubt|warnings|is_\w+|below_tip_count|tip_\w+|message|unresolved_\w+|needed_pitch",
    ),
    (
        "settings",
        "what was predicted with",
        r"version|settings_hash|formulation|voltage|mechanical_load|preprocessing|steps|"
        r"processing_time|realisations|cells|pitch\w*|area|rows|cols",
    ),
    (
        "roughness",
        "of the surface, ISO 25178-2",
        r"roughness/\w+|spatial_roughness/\w+|composite_rms_height|rms_height|invalid_fraction|"
        r"s[aqpvz]|ssk|sku|sdq|sdr|sal|str|m[024]|nayak|hurst|summit_density|mean_summit_radius",
    ),
    (
        "energy",
        "energies and bonding",
        r"\w+_energy|plastic_work|bonding_\w+|adhesion_parameter|flattening_ratio",
    ),
    (
        "contact",
        "where the surfaces touch",
        r"status|separation_at_rest|contact_(area\w*|fraction|theory)|nominal_area|approach|mean_gap|max_tilt|median_\w+|"
        r"\w*(asperity|elastic|plastic|contact)_count|contacts\w*",
    ),
    ("forces", "forces and works", r"\w*(force|load|stiffness|adhesion|exponent)(_\w+)?"),
    ("other", "the rest", r".*"),
)


class UnknownColumn(ValueError):
    """A name that is neither a group nor a column; the text is one sentence."""


def group_of(column):
    """The name of the group of a column."""
    return next(name for name, _, pattern in GROUPS if re.fullmatch(pattern, column))


def groups_text():
    """A line for each group, for --help."""
    return "; ".join("%s: %s" % (name, what) for name, what, _ in GROUPS)


def _has_value(value):
    return (
        value is not None and value != "" and not (isinstance(value, float) and math.isnan(value))
    )


def chosen_columns(names, rows, wanted=None):
    """Those of the names that a table gets, in the order of the names; of single ones in the order
    in which they are wanted.

    wanted: groups and columns with commas between, "all", or None for all that some row has a value
    for: what a formulation does not know is left out. Raises UnknownColumn.
    """
    known = [name for name in names if any(_has_value(row.get(name)) for row in rows)]
    if wanted is None:
        return known
    chosen = []
    for word in (part.strip() for part in wanted.split(",")):
        if word == ALL:
            found = list(names)
        elif word in names:
            found = [word]
        elif word in [group for group, _, _ in GROUPS]:
            found = [name for name in known if group_of(name) == word]
        else:
            choices = [ALL] + [group for group, _, _ in GROUPS] + list(names)
            near = difflib.get_close_matches(word, choices, 1)
            raise UnknownColumn(
                "'%s' is neither a column nor a group%s; groups are %s, and %s"
                % (
                    word,
                    ": did you mean %s?" % near[0] if near else "",
                    ", ".join(group for group, _, _ in GROUPS),
                    ALL,
                )
            )
        chosen += [name for name in found if name not in chosen]
    return chosen
