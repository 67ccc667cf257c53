"""Where a result comes from, in one line: scan, part, serial number, lot, wafer, settings,
version."""

from mems_stiction.quantities import literal, shortened

LONGEST_NAME = 70  # letters of one in a picture

# of every result, as the messages name them
FIELDS = (
    "version",
    "settings_hash",
    "scan_name",
    "part_id",
    "serial_id",
    "lot_id",
    "wafer_id",
    "site_x",
    "site_y",
    "acquisition_time",
    "instrument",
    "operator_name",
    "checksum",
)
_WORDS = (
    ("scan", "scan_name"),
    ("part", "part_id"),
    ("serial number", "serial_id"),
    ("lot", "lot_id"),
    ("wafer", "wafer_id"),
    ("settings", "settings_hash"),
    ("mems_stiction", "version"),
)


def provenance_words(source, leave_out=(), longest=None):
    """What is known of these; source: a message, a record or a row with the fields, or with some of
    them. longest: letters of one, the rest of which is cut."""

    def value_of(name):
        return source.get(name, "") if isinstance(source, dict) else getattr(source, name, "")

    known = [
        (word, value_of(name)) for word, name in _WORDS if name not in leave_out and value_of(name)
    ]
    words = [
        value if value.startswith(word) else "%s %s" % (word, value) for word, value in known
    ]  # "scan_7" says what it is
    return ", ".join(shortened(one, longest) if longest else one for one in words)


def sign(figure, source, colour="#666666", leave_out=()):
    """Writes it into the lower right corner of a picture of matplotlib. Returns whether there was
    anything to write."""
    text = provenance_words(source, leave_out, LONGEST_NAME)
    if text:
        figure.text(
            1 - 0.05 / figure.get_figwidth(),
            0.04 / figure.get_figheight(),
            literal(text),
            ha="right",
            va="bottom",
            fontsize=7.5,
            color=colour,
        )
    return bool(text)
