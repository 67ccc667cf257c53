"""What the report's first page says of the device, its loads and its scans: as stated in the
settings and in the rows."""

from mems_stiction.quantities import ratio, typeset, with_unit

# Room and key of a setting, what it is called, its unit; "" is a number without one, "word" a word.
STATED = (
    ("device/spring_stiffness", "stiffness of the suspension", "N/m"),
    ("device/travel", "travel to contact", "m"),
    ("device/contact_area", "area of its contacts", "m^2"),
    ("device/contacts", "number of its contacts", ""),
    ("device/guidance", "guidance", "word"),
    ("device/electrode_area", "area of the electrodes", "m^2"),
    ("device/electrode_gap", "gap of the electrodes", "m"),
    ("device/beam_type", "beam", "word"),
    ("device/beam_length", "length of the beam", "m"),
    ("device/beam_thickness", "thickness of the beam", "m"),
    ("device/beam_width", "width of the beam", "m"),
    ("device/beam_gap", "height of the beam above the substrate", "m"),
    ("device/beam_modulus", "modulus of the beam", "Pa"),
    ("device/beam_residual_stress", "residual stress of the beam", "Pa"),
    ("device/electrode_start", "electrode from the clamp", "m"),
    ("device/electrode_length", "length of the electrode", "m"),
    ("device/apparent_work_of_adhesion", "work of adhesion, as measured on beams", "J/m^2"),
    ("lower/youngs_modulus", "modulus, lower body", "Pa"),
    ("lower/hardness", "hardness, lower body", "Pa"),
    ("upper/youngs_modulus", "modulus, upper body", "Pa"),
    ("upper/hardness", "hardness, upper body", "Pa"),
    ("interface/work_of_adhesion", "work of adhesion", "J/m^2"),
    ("interface/insulator_thickness", "thickness of the insulator", "m"),
    ("interface/relative_humidity", "relative humidity", ""),
    ("load/voltage", "voltage", "V"),
    ("load/contact_potential", "contact potential", "V"),
    ("load/mechanical_load", "mechanical load on the scan", "N"),
    ("load/pressure", "pressure", "Pa"),
    ("load/device_force", "force on the device", "N"),
)
NOT_STATED = (0, "", "none", "guided")  # values that say nothing of the device
MEASURED = (
    ("acquisition_time", "measured"),
    ("operator_name", "operator"),
    ("instrument", "instrument"),
    ("checksum", "checksum"),
)  # of a scan, where its file says so


def area(value):
    """Squares have no prefixes."""
    if value >= 1e-8:
        return "%.3g mm²" % (value * 1e6)
    return "%.3g µm²" % (value * 1e12) if value >= 1e-15 else "%.3g nm²" % (value * 1e18)


def _text(value, unit):
    if unit == "word" or isinstance(value, str):
        return str(value).replace("_", " ")
    if unit == "m^2":
        return area(value)
    return typeset(with_unit(value, unit)) if unit else ratio(value)


def device_lines(configuration):
    """(label, text) of all that the settings state of the device and of what acts on it; of no
    device its loads and materials alone."""
    stated = {
        name: configuration.get(name.split("/")[0], {}).get(name.split("/")[1], 0)
        for name, _, _ in STATED
    }
    if all(
        stated[name] in NOT_STATED
        for name in stated
        if name.startswith("device/") and name != "device/contacts"
    ):
        stated["device/contacts"] = 0
    lines = [
        (label, _text(stated[name], unit))
        for name, label, unit in STATED
        if stated[name] not in NOT_STATED
    ]
    spring = stated["device/spring_stiffness"] * stated["device/travel"]
    if spring > 0:
        place = next(
            number for number, (label, _) in enumerate(lines) if label == "travel to contact"
        )
        lines.insert(place + 1, ("restoring force", typeset(with_unit(spring, "N"))))
    return lines


def measurements_of(rows):
    """One sentence on all scans: from when to when, by whom, with what; empty where no record says
    so."""
    known = {
        name: sorted({str(row[name]) for row in rows if row.get(name)}) for name, _ in MEASURED
    }
    times = known["acquisition_time"]
    words = []
    if times:
        words.append(
            "Measured %s"
            % (times[0] if len(times) == 1 else "from %s to %s" % (times[0], times[-1]))
        )
    for name, label in MEASURED[1:3]:
        if known[name]:
            words.append("%s: %s" % (label, ", ".join(known[name])))
    text = "; ".join(words)
    lacking = sum(not row.get("acquisition_time") for row in rows)
    if times and lacking:
        text += "; %d of %d scans state no date" % (lacking, len(rows))
    return text[:1].upper() + text[1:] + "." if text else ""
