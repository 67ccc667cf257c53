"""Predictions (mems_stiction/StictionPrediction) in words: one aligned line each, and the
difference of two."""

import math

from mems_stiction.quantities import area, known_digits, percent, ratio, with_interval, with_unit

STATUS_NAMES = {0: "equilibrium", 1: "bonded", 2: "no equilibrium"}
STICKS_NAMES = {0: "no", 1: "marginal", 2: "yes", 3: "unknown"}
NOTHING_FOUND = 2  # DeviceAdhesion.REFUSED
# Bits of regime_flags: name, and what it means.
FLAGS = {
    1: ("bonded", "the surfaces bond"),
    2: ("no_equilibrium", "the search ended before the equilibrium"),
    4: ("tabor", "JKR is not the theory for these asperities"),
    8: ("plasticity", "most of the adhesion is of contacts that flow"),
    16: ("resolution", "most of the adhesion is of contacts of few pixels"),
    32: ("few_contacts", "few contacts: another place of the surface may differ much"),
    64: ("near_bonding", "the pull-off force may be out by more than 1.3"),
    128: (
        "border",
        "most of the adhesion is of contacts at the frame's border: their summits may lie outside",
    ),
    256: ("one_pixel", "most of the adhesion is of contacts of one pixel"),
    512: ("unresolved", "the scan does not show what holds: its pixels or its tip are too coarse"),
}

_COLUMNS = "%-18s  %-14s %8s %11s %9s %8s %6s %8s %7s %8s"
_VERDICT = " %9s  %-8s"


def bound_of(result, mark=">= "):
    """The mark before a pull-off force that is a lower bound."""
    return mark if result.is_lower_bound else ""


def flag_names(flags):
    """The names of the bits that are set, in their order."""
    return [name for bit, (name, _) in sorted(FLAGS.items()) if flags & bit]


def flag_words(names, model_doubt=""):
    """What the flags of these names mean, as one text; a name that is not known stands for itself.
    near_bonding has the model's own reason behind it."""
    meanings = dict(FLAGS.values())
    if model_doubt:
        meanings["near_bonding"] += " (%s)" % model_doubt
    return "; ".join(meanings.get(name, name) for name in names)


def limits_of(prediction):
    """What speaks against relying on the prediction, in one line: its flags in words, and the
    warnings about its scan."""
    flags = flag_words(flag_names(prediction.regime_flags), prediction.model_doubt)
    return "; ".join(
        (["outside the model's range: " + flags] if flags else [])
        + ["warning: " + text for text in prediction.warnings]
    )


def contact_area_of(result):
    """Area [m^2] by the contacts' own theory: of the paper's formulations the JKR contacts, else
    the area itself."""
    return result.contact_area if math.isnan(result.contact_area_jkr) else result.contact_area_jkr


def judge_words(verdict_by):
    """Who has judged, in words: "half_space" is "the half-space"; of a part, scans may differ in
    that."""
    judges = ["the " + judge.replace("_", "-") for judge in verdict_by.split(" and ") if judge]
    return (
        " and ".join(
            judge + scans for judge, scans in zip(judges, (" of some scans", " of others"))
        )
        if len(judges) > 1
        else "".join(judges)
    )


def ratio_name(result):
    """ "margin" or "peel_number": which of them decides whether the device sticks. Where that is
    not said, the margin, if there is one."""
    if getattr(result, "is_peeled", False) or getattr(result, "governed_by", "") == "peeling":
        return "peel_number"
    has_peel_number = not math.isnan(getattr(result, "peel_number", math.nan))
    return "peel_number" if has_peel_number and math.isnan(result.margin) else "margin"


def ratio_value(result, end=""):
    """Its value, or with "_lower" or "_upper" an end of its 95 % interval; NaN where it is not
    known."""
    return getattr(result, ratio_name(result) + end, math.nan)


def digits_of(result):
    """How many digits of forces and ratios are worth showing, by the interval of the pull-off
    force, the margin or the peel number; three where none is known."""
    for name in ("pull_off_force", "margin", "peel_number"):
        ends = [getattr(result, name + end, math.nan) for end in ("", "_lower", "_upper")]
        if all(map(math.isfinite, ends)):
            return known_digits(*ends)
    return 3


def has_verdict(prediction):
    """Whether a device is stated as far as a margin or a peel number needs it. Of a DeviceAdhesion,
    too."""
    return not (math.isnan(prediction.margin) and math.isnan(prediction.peel_number))


def has_device(prediction):
    """Whether a spring or a beam is stated at all; where the whole device's force is on its way,
    the frame has no figure of them."""
    return "device_force" in prediction.reason or not (
        math.isnan(prediction.restoring_force) and math.isnan(prediction.peel_number)
    )


def table_header(with_verdict=False):
    """Two lines; the columns are those of table_line()."""
    top = _COLUMNS % ("", "", "rms", "pull-off", "contact", "", "contacts", "", "", "")
    bottom = _COLUMNS % (
        "scan",
        "status",
        "height",
        "force",
        "fraction",
        "elastic",
        "mixed",
        "plastic",
        "voltage",
        "time",
    )
    if with_verdict:
        bottom += _VERDICT % ("margin", "sticks")
    return top.rstrip() + "\n" + bottom.rstrip()


def shortened(name, width=18):
    """The end of a long name tells more than its beginning."""
    return name if len(name) <= width else "..." + name[3 - width :]


def printable(text):
    """The text with its control characters spelled out: none reaches a terminal."""
    return "".join(letter if letter.isprintable() else "\\x%02x" % ord(letter) for letter in text)


def table_line(name, prediction, with_verdict=False):
    """Rms height, pull-off force, contact, contacts per regime, load and time of one scan, then the
    device's margin, or its peel number, and whether it sticks, and the names of its flags and its
    warnings. A force that is a lower bound is marked so."""
    bound = bound_of(prediction)
    force = prediction.pull_off_force
    line = _COLUMNS % (
        shortened(name),
        STATUS_NAMES.get(prediction.status, "?"),
        with_unit(prediction.rms_height, "m"),
        bound + with_unit(force, "N", digits_of(prediction)),
        percent(prediction.contact_fraction),
        prediction.elastic_count,
        prediction.elasto_plastic_count,
        prediction.plastic_count,
        with_unit(prediction.voltage, "V"),
        with_unit(prediction.processing_time, "s"),
    )
    if with_verdict:
        line += _VERDICT % (
            ratio(ratio_value(prediction), digits_of(prediction)),
            STICKS_NAMES.get(prediction.sticks, "?"),
        )
    limits = flag_names(prediction.regime_flags) + [
        "warning: " + text for text in prediction.warnings
    ]
    return printable(line + ("  " + ", ".join(limits) if limits else ""))


def device_line(name, device):
    """What a DeviceAdhesion says of the device that a scan is of: force with its interval, by how
    many scans, margin or peel number, whether it sticks and who says so; or why there is none."""
    if device.status == NOTHING_FOUND:
        return printable("%-18s  device: no force: %s" % (shortened(name), device.message))
    line = "%-18s  device: pull-off force %s by %d scan%s" % (
        shortened(name),
        with_interval(
            device.pull_off_force, device.pull_off_force_lower, device.pull_off_force_upper, "N"
        ),
        device.scan_count,
        "" if device.scan_count == 1 else "s",
    )
    if has_verdict(device):
        line += ", %s %s, sticks: %s" % (
            ratio_name(device).replace("_", " "),
            ratio(ratio_value(device), digits_of(device)),
            STICKS_NAMES.get(device.sticks, "?"),
        )
    return printable(line + (", by the half-space" if device.verdict_by == "half_space" else ""))


def load_effect(before, after):
    """What another load did to the same scan, in sentences. `before` and `after` are its
    predictions."""
    sentences = [
        "Electrostatic force %s, before %s; normal load %s, before %s."
        % (
            with_unit(after.electrostatic_force, "N"),
            with_unit(before.electrostatic_force, "N"),
            with_unit(after.normal_load, "N"),
            with_unit(before.normal_load, "N"),
        )
    ]
    for what, unit, old, new in (
        ("contact area", "m^2", before.contact_area, after.contact_area),
        ("pull-off force", "N", before.pull_off_force, after.pull_off_force),
    ):
        sentences.append("The %s %s." % (what, _change(unit, old, new)))
    if before.status != after.status:
        sentences.append(
            "The state went from %s to %s."
            % (STATUS_NAMES[before.status], STATUS_NAMES[after.status])
        )
    return sentences


def _change(unit, old, new):
    text = area if unit == "m^2" else (lambda value: with_unit(value, unit))
    if old == new:
        return "stays at %s" % text(old)
    verb = "grows" if new > old else "falls"
    if not old:
        return "%s from 0 to %s" % (verb, text(new))
    growth = new / old
    factor = "%+.3g %%" % (100 * (growth - 1)) if growth < 3 else "%.3g times" % growth
    return "%s from %s to %s (%s)" % (verb, text(old), text(new), factor)
