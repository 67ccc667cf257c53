"""Predictions (mems_stiction/StictionPrediction) in words: one aligned line each, and the difference of two."""

import math

from mems_stiction.quantities import area, percent, ratio, with_unit

STATUS_NAMES = {0: "equilibrium", 1: "bonded", 2: "no equilibrium"}
STICKS_NAMES = {0: "no", 1: "marginal", 2: "yes", 3: "unknown"}

_COLUMNS = "%-18s  %-14s %8s %11s %9s %8s %6s %8s %9s %7s %8s"
_VERDICT = " %9s  %-8s"


def has_verdict(prediction):
    """Whether a device is stated as far as a margin or a peel number needs it."""
    return not (math.isnan(prediction.margin) and math.isnan(prediction.peel_number))


def table_header(with_verdict=False):
    """Two lines; the columns are those of table_line()."""
    top = _COLUMNS % ("", "", "rms", "pull-off", "contact", "", "contacts", "", "vdW share", "", "")
    bottom = _COLUMNS % ("scan", "status", "height", "force", "fraction", "elastic", "mixed", "plastic", "of force", "voltage", "time")
    if with_verdict:
        bottom += _VERDICT % ("margin", "sticks")
    return top.rstrip() + "\n" + bottom.rstrip()


def shortened(name, width=18):
    """The end of a long name tells more than its beginning."""
    return name if len(name) <= width else "..." + name[3 - width:]


def table_line(name, prediction, with_verdict=False):
    """Rms height, pull-off force, contact, contacts per regime, van der Waals share of the pull-off force, load and time of
    one scan, then the device's margin, or its peel number, and whether it sticks. A bonded surface's force is a lower
    bound and marked so."""
    bound = ">= " if prediction.status == 1 else ""
    force = prediction.pull_off_force
    share = percent(prediction.van_der_waals_force / force) if force else "-"
    line = _COLUMNS % (shortened(name), STATUS_NAMES.get(prediction.status, "?"), with_unit(prediction.rms_height, "m"),
                       bound + with_unit(force, "N"), percent(prediction.contact_fraction), prediction.elastic_count,
                       prediction.elasto_plastic_count, prediction.plastic_count, share,
                       with_unit(prediction.voltage, "V"), with_unit(prediction.processing_time, "s"))
    if with_verdict:
        figure = prediction.peel_number if math.isnan(prediction.margin) else prediction.margin
        line += _VERDICT % (ratio(figure), STICKS_NAMES.get(prediction.sticks, "?"))
    return line


def load_effect(before, after):
    """What another load did to the same scan, in sentences. `before` and `after` are its predictions."""
    sentences = ["Electrostatic force %s, before %s; normal load %s, before %s." % (
        with_unit(after.electrostatic_force, "N"), with_unit(before.electrostatic_force, "N"),
        with_unit(after.normal_load, "N"), with_unit(before.normal_load, "N"))]
    for what, unit, old, new in (
            ("contact area", "m^2", before.contact_area, after.contact_area),
            ("pull-off force", "N", before.pull_off_force, after.pull_off_force)):
        sentences.append("The %s %s." % (what, _change(unit, old, new)))
    if before.status != after.status:
        sentences.append("The state went from %s to %s." % (STATUS_NAMES[before.status], STATUS_NAMES[after.status]))
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
