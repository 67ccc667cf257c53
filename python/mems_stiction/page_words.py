"""What the station's page says of one prediction, of a half-space, and of the node's diagnostics.
No ROS here.

Each function returns what JSON can have: numbers are SI, None where there is none; texts have their
unit.
"""

import math

from mems_stiction import quantities
from mems_stiction.prediction_text import (
    STATUS_NAMES,
    bound_of,
    flag_names,
    flag_words,
    has_device,
    judge_words,
    ratio_name,
)
from mems_stiction.quantities import percent, ratio, typeset

NO_EQUILIBRIUM = 2  # StictionPrediction.status
# StictionPrediction.sticks: the level that gives the colour, and the word that is read from afar.
VERDICTS = {
    0: ("releases", "RELEASES"),
    1: ("marginal", "MARGINAL"),
    2: ("sticks", "STICKS"),
    3: ("unknown", "NOT KNOWN"),
}
AWAITED = "on device_force"  # in the reason of a prediction whose device's force is on its way
ON_ITS_WAY = "provisional: the force of the whole device is on its way"
LEVELS = ("ok", "warn", "error", "stale")  # diagnostic_msgs/DiagnosticStatus.level
SOURCE_STATUS = "scan_source"  # of its diagnostics, behind whatever the name of its node is
DEVICE_REFUSED = 2  # DeviceAdhesion.status
WIDEST_INTERVAL = 1e4  # upper over lower end of a ratio that is shown as a number
LARGEST = 1e30  # of a number that is drawn, as of settings
MOST_ITEMS = 2000  # of a list, and
MOST_LETTERS = 2000  # of a text of a message that browsers get
HALF_SPACE_STATES = (
    "solved",
    "load not reached",
    "not converged",
    "too many states",
    "cancelled",
    "refused",
)


def finite(value):
    """JSON knows neither NaN nor infinity, and no axis reaches to 1e308."""
    return value if abs(value) <= LARGEST else None


def all_finite(value):
    """A copy of lists, dictionaries, numbers and texts as JSON and a browser can have it: what a
    message has too much of is cut."""
    if isinstance(value, dict):
        return {key: all_finite(item) for key, item in list(value.items())[:MOST_ITEMS]}
    if isinstance(value, (list, tuple)):
        return [all_finite(item) for item in value[:MOST_ITEMS]]
    if isinstance(value, str):
        return value if len(value) <= MOST_LETTERS else value[:MOST_LETTERS] + "\u2026"
    return finite(value) if isinstance(value, float) else value


def thinned_points(points):
    """Of many points so many that a browser can draw them, the first and the last among them."""
    every = -(-len(points) // (MOST_ITEMS - 1))
    return points if every <= 1 else points[::every] + points[-1:]


def with_unit(value, unit):
    """As people write it: "1.23 µN", "not known"."""
    return "not known" if math.isnan(value) else typeset(quantities.with_unit(value, unit))


def ratio_text(value):
    """A margin or a peel number: "12.3", "infinite"."""
    return "infinite" if math.isinf(value) else ratio(value)


def verdict_of(prediction):
    """level, word and reason. Without a device there is no verdict, and that is said."""
    if prediction.status == NO_EQUILIBRIUM:
        return {
            "level": "unknown",
            "word": "NO EQUILIBRIUM",
            "reason": "The search ended before the surfaces came to rest: its forces are not to be "
            "used.",
        }
    if not has_device(prediction):
        return {
            "level": "none",
            "word": "NO VERDICT",
            "reason": sentence(prediction.reason or "no device is stated"),
        }
    level, word = VERDICTS.get(prediction.sticks, VERDICTS[3])
    return {"level": level, "word": word, "reason": sentence(prediction.reason)}


def awaits_device(prediction, answer):
    """Whether the force of the whole device, which will judge this scan, is on its way. answer: the
    DeviceVerdict on the scan; None before it came."""
    if answer is not None:
        return "device_force" in answer.waits_for.split()
    return AWAITED in prediction.reason


def provisional_of(prediction, answer, before):
    """Verdict and ratio while the force of the whole device is on its way: what the scans of the
    part before this one say, or else what is known of this scan alone. answer: the DeviceVerdict on
    the scan, or None; before: (number, verdict, ratio) of the newest scan that was judged, or
    None."""
    if answer is not None and answer.sticks in VERDICTS and VERDICTS[answer.sticks][0] != "unknown":
        level, word = VERDICTS[answer.sticks]
        verdict = {"level": level, "word": word, "reason": sentence(answer.reason)}
        return dict(verdict, provisional=ON_ITS_WAY), ratio_of(answer)
    known = ["The pull-off force of this scan is %s" % with_unit(prediction.pull_off_force, "N")]
    if not math.isnan(prediction.restoring_force):
        known.append(
            "the restoring force of the spring %s" % with_unit(prediction.restoring_force, "N")
        )
    reason = ", ".join(known) + "."
    if before is not None:
        number, verdict, ratio_before = before
        reason += " The verdict before, on scan %d: %s" % (number, verdict["word"])
        if ratio_before:
            reason += ", %s %s" % (ratio_before["label"], ratio_before["text"])
        reason += "."
    verdict = {"level": "pending", "word": "COMPUTING", "reason": reason}
    return dict(verdict, provisional=ON_ITS_WAY), None


def sentence(text):
    text = typeset(text)
    return text[:1].upper() + text[1:] + ("" if not text or text.endswith(".") else ".")


def ratio_of(prediction):
    """The margin, or the peel number, with its 95 % interval; None where there is neither."""
    name = ratio_name(prediction)
    value, lower, upper = (getattr(prediction, name + end) for end in ("", "_lower", "_upper"))
    if math.isnan(value):
        return None
    interval = (
        ""
        if math.isnan(lower) or math.isnan(upper)
        else "95 %%: %s to %s" % (ratio_text(lower), ratio_text(upper))
    )
    return {
        "label": name.replace("_", " "),
        "value": finite(value),
        "lower": finite(lower),
        "upper": finite(upper),
        "text": ratio_text(value),
        "interval": interval,
    }


def says_nothing(shown):
    """Whether the interval of a ratio spans so many decades that the number in it is none."""
    lower, upper = shown["lower"], shown["upper"]
    return lower is not None and upper is not None and upper > WIDEST_INTERVAL * lower


def flags_of(prediction):
    """The flags that are set, in words; a part has no doubt of a model's own."""
    return [
        flag_words([name], getattr(prediction, "model_doubt", ""))
        for name in flag_names(prediction.regime_flags)
    ]


def trace_of(prediction):
    """Name of the field, label and text of what the prediction was made of and with; what is not
    stated is left out."""
    rows = [
        ("scan_name", "scan"),
        ("part_id", "part"),
        ("serial_id", "serial number"),
        ("settings_hash", "settings"),
        ("version", "version"),
    ]
    return [
        {"name": name, "label": label, "text": getattr(prediction, name), "value": None}
        for name, label in rows
        if getattr(prediction, name)
    ]


def part_name(message):
    """ "part lot 3, serial number 0012"; either may be missing."""
    return ", ".join(
        "%s %s" % (label, text)
        for label, text in (("part", message.part_id), ("serial number", message.serial_id))
        if text
    )


def part_of(part):
    """What a PartVerdict says: verdict, ratio, how many scans, which is the worst, and what speaks
    against it."""
    name = ratio_name(part)
    level, word = VERDICTS.get(part.sticks, VERDICTS[3])
    if not part.counted_scans and part.reason.startswith("the device is not stated"):
        level, word = "none", "NO VERDICT"
    worst = getattr(part, "worst_" + name)
    shown, reason = ratio_of(part), sentence(part.reason)
    if shown and says_nothing(shown):
        counted = "%d scan%s" % (
            part.counted_scans,
            " says" if part.counted_scans == 1 else "s say",
        )
        shown, reason = None, "%s nothing of the %s yet. %s" % (counted, shown["label"], reason)
    return {
        "name": part_name(part) or "part without a name",
        "part": part.part_id,
        "serial": part.serial_id,
        "level": level,
        "word": word,
        "reason": reason,
        "ratio": shown,
        "verdict_by": judge_words(part.verdict_by),
        "settings_hash": part.settings_hash,
        "scans": "%d scan%s" % (part.scan_count, "" if part.scan_count == 1 else "s")
        + ("" if part.counted_scans == part.scan_count else ", %d count" % part.counted_scans),
        "worst": None
        if math.isnan(worst) or part.counted_scans < 2
        else "lowest %s of %s" % (ratio_text(worst), getattr(part, "worst_%s_scan" % name)),
        "flags": flags_of(part),
        "warnings": [typeset(text) for text in part.warnings],
    }


def figures_of(prediction):
    """Name of the field, label, text and value of what is read beside the verdict."""
    bound = bound_of(prediction, "≥ ")
    rows = [
        ("pull_off_force", "pull-off force of the scan", "N"),
        ("device_pull_off_force", "pull-off force of the device", "N"),
        ("restoring_force", "restoring force of its spring", "N"),
        ("contact_fraction", "contact fraction", "%"),
        ("asperity_count", "contacts", ""),
        ("rms_height", "rms height Sq", "m"),
        ("mechanical_load", "mechanical load", "N"),
        ("voltage", "voltage", "V"),
        ("pull_in_voltage", "pull-in voltage", "V"),
        ("detachment_length", "detachment length", "m"),
        ("apparent_work_of_adhesion", "apparent work of adhesion", "J/m²"),
        ("flattening_ratio", "flattening ratio", "-"),
        ("processing_time", "computed in", "s"),
    ]
    figures = [
        {
            "name": "status",
            "label": "state",
            "text": STATUS_NAMES.get(prediction.status, "?"),
            "value": None,
        }
    ]
    for name, label, unit in rows:
        value = getattr(prediction, name)
        if math.isnan(value):
            continue
        text = {"%": percent, "": str, "-": ratio}.get(
            unit, lambda number: with_unit(number, unit)
        )(value)
        figures.append(
            {
                "name": name,
                "label": label,
                "value": finite(value),
                "text": (bound if name.endswith("pull_off_force") else "") + text,
            }
        )
    return figures


def device_of(device):
    """What a DeviceAdhesion says: verdict and ratio (None where nothing was found), figures, by how
    many scans, what they lack."""
    is_found = device.status != DEVICE_REFUSED
    level, word = VERDICTS.get(device.sticks, VERDICTS[3])
    rows = [
        (
            "device_pull_off_force",
            "pull-off force",
            device.pull_off_force,
            quantities.with_interval(
                device.pull_off_force, device.pull_off_force_lower, device.pull_off_force_upper, "N"
            ),
        ),
        (
            "linear_pull_off_force",
            "the scans' by area",
            device.linear_pull_off_force,
            with_unit(device.linear_pull_off_force, "N"),
        ),
        (
            "device_work_of_adhesion",
            "work of adhesion",
            device.apparent_work_of_adhesion,
            quantities.with_interval(
                device.apparent_work_of_adhesion,
                device.apparent_work_of_adhesion_lower,
                device.apparent_work_of_adhesion_upper,
                "J/m^2",
            ),
        ),
        ("device_contacts", "places that hold", device.contacts, "%.3g" % device.contacts),
    ]
    return {
        "is_found": is_found,
        "message": sentence(device.message),
        "verdict": {"level": level, "word": word, "reason": sentence(device.reason)}
        if is_found
        else None,
        "ratio": ratio_of(device) if is_found else None,
        "scans": "%d scan%s" % (device.scan_count, "" if device.scan_count == 1 else "s"),
        "part": part_name(device),
        "settings_hash": device.settings_hash,
        "force": finite(device.pull_off_force),
        "restoring_force": finite(device.restoring_force),
        "figures": [
            {"name": name, "label": label, "text": typeset(text), "value": finite(value)}
            for name, label, value, text in rows
            if not math.isnan(value)
        ],
        "warnings": [typeset(text) for text in device.warnings],
    }


def curve_of(prediction):
    """Force over displacement past first touch: approach, retraction where it differs; the pull-off
    force where it is largest."""
    drawn = [
        point
        for point in prediction.curve
        if finite(point.displacement) is not None and finite(point.force) is not None
    ]
    way_in = [(point.displacement, point.force) for point in drawn if not point.is_separation]
    way_out = [(point.displacement, point.force) for point in drawn if point.is_separation]
    if not way_in and not way_out:
        return None
    place, force = max(way_out or way_in, key=lambda point: point[1])
    return {
        "in": thinned_points(way_in),
        "out": thinned_points(way_out),
        "formulation": prediction.formulation,
        "peak": [place, force],
        "pull_off_force": finite(prediction.pull_off_force),
        "text": bound_of(prediction, "≥ ") + with_unit(prediction.pull_off_force, "N"),
    }


def half_space_verdict(solution):
    """Word, level, ratio and who has judged; None where no device is stated or nothing was
    solved."""
    if not solution.verdict_by or ratio_of(solution) is None:
        return None
    level, word = VERDICTS.get(solution.sticks, VERDICTS[3])
    return {
        "level": level,
        "word": word,
        "by": judge_words(solution.verdict_by),
        "ratio": ratio_of(solution),
        "reason": sentence(solution.reason),
    }


def half_space_of(solution):
    """State, figures and curve of a HalfSpaceSolution, over the displacement that predictions have:
    its range less its height."""
    ways = {"in": [], "out": []}
    for point in solution.curve:
        displacement = solution.range - point.height
        if finite(displacement) is not None and finite(point.force) is not None:
            ways["out" if point.direction else "in"].append((displacement, point.force))
    is_solved = solution.status == 0
    return {
        "status": HALF_SPACE_STATES[solution.status]
        if solution.status < len(HALF_SPACE_STATES)
        else "?",
        "message": sentence(solution.message),
        "is_solved": is_solved,
        "pull_off_force": finite(solution.pull_off_force),
        "text": with_unit(solution.pull_off_force, "N"),
        "verdict": half_space_verdict(solution),
        "in": thinned_points(ways["in"]),
        "out": thinned_points(ways["out"]),
        "notes": []
        if not is_solved or solution.is_resolved
        else [
            "pixels are too large for the edge of a contact: the force comes out too large as a "
            "rule"
        ],
    }


def diagnostics_of(status):
    """One diagnostic_msgs/DiagnosticStatus."""
    level = (
        int.from_bytes(status.level, "little") if isinstance(status.level, bytes) else status.level
    )
    return {
        "name": status.name,
        "level": LEVELS[level] if 0 <= level < len(LEVELS) else "error",
        "message": status.message,
        "values": [[entry.key, entry.value] for entry in status.values],
    }


def source_of(entry):
    """What a scan_source does by its entry of diagnostics_of(), in sentences: what came last, what
    waits and for what, what was refused and why."""
    values = dict(entry["values"])
    found = values.get("found", "?")
    told = "Source: %s of %s scan%s published" % (
        values.get("published", "?"),
        found,
        "" if found == "1" else "s",
    )
    if values.get("last_published"):
        told += ", the last: " + values["last_published"]
    sentences = [told]
    if values.get("waiting", "0") != "0":
        sentences.append("Waiting: " + values["waiting"])
    if values.get("hindered_by"):
        sentences.append("Hindered: " + values["hindered_by"])
    if values.get("refused", "0") != "0":
        sentences.append(
            "Refused: %s, the last: %s" % (values["refused"], values.get("last_refused", ""))
        )
    return {"level": entry["level"], "text": ". ".join(sentences) + "."}
