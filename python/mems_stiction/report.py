"""The report on many scans: what stiction_batch dumped, as one HTML page with everything in it, CSV
and JSON beside it.

No figure is computed here: all come from the core, by stiction_batch; surface_figures.py has those
of the material ratio curve.
"""

import base64
import csv
import datetime
import io
import json
import math
import pathlib
import platform
import re
from types import SimpleNamespace

import jinja2
import matplotlib
import numpy as np
import yaml

from mems_stiction import _core
from mems_stiction.cleaning_steps import cleaning_figure, rows_of
from mems_stiction.csv_text import csv_cell
from mems_stiction.half_space_figure import half_space_figure, half_space_words, pull_off_ratio
from mems_stiction.plots import ScanPicture, save_picture, with_unit
from mems_stiction.prediction_text import digits_of, flag_words, judge_words, ratio_name
from mems_stiction.quantities import counted, percent, ratio, typeset, unbroken, with_interval
from mems_stiction.report_device import area, device_lines, measurements_of
from mems_stiction.report_figures import number, scan_figure, trend_figure
from mems_stiction.report_lots import lots_section
from mems_stiction.report_template import PAGE
from mems_stiction.surface_figures import surface_figure, surface_figures_of
from mems_stiction.whole_file import whole

STATES = {
    "EQUILIBRIUM": (0, "equilibrium"),
    "BONDED": (1, "bonded"),
    "NO_EQUILIBRIUM": (2, "no equilibrium"),
}
FIGURES = (
    ("formulation", "formulation"),
    ("pull-off force", "pull_off_force"),
    ("of contacts, by JKR", "pull_off_force_jkr"),
    ("of contacts, JKR-DMT transition", "pull_off_force_transition"),
    ("normal load", "normal_load"),
    ("voltage", "voltage"),
    ("mechanical load", "mechanical_load"),
    ("contact fraction", "contact_fraction"),
    ("contact area", "contact_area"),
    ("scanned area", "nominal_area"),
    ("approach", "approach"),
    ("mean gap", "mean_gap"),
    ("bonding energy", "bonding_energy"),
    ("adhesion parameter", "adhesion_parameter"),
    ("bonding regime", "bonding_regime"),
    ("median Tabor parameter", "median_tabor_parameter"),
    ("single-asperity theory", "contact_theory"),
    ("not measured", "invalid_fraction"),
    ("restoring force of the device", "restoring_force"),
    ("pull-off force of the device", "device_pull_off_force"),
    ("margin", "margin"),
    ("margin, 95 % from", "margin_lower"),
    ("margin, 95 % to", "margin_upper"),
    ("pull-in voltage", "pull_in_voltage"),
    ("stiffness of the contact", "contact_stiffness"),
    ("flattening energy / gained by adhesion and water", "flattening_ratio"),
    ("apparent work of adhesion", "apparent_work_of_adhesion"),
    ("apparent work of adhesion, device", "device_apparent_work_of_adhesion"),
    ("peel number", "peel_number"),
    ("peel number, 95 % from", "peel_number_lower"),
    ("peel number, 95 % to", "peel_number_upper"),
    ("detachment length", "detachment_length"),
    ("free length while stuck", "unstuck_length"),
)
SURFACE_FIGURES = (
    ("arithmetical mean height Sa", "sa"),
    ("root mean square height Sq", "sq"),
    ("skewness Ssk", "ssk"),
    ("kurtosis Sku", "sku"),
    ("maximum peak height Sp", "sp"),
    ("maximum pit height Sv", "sv"),
    ("maximum height Sz", "sz"),
    ("root mean square gradient Sdq", "sdq"),
    ("developed interfacial area ratio Sdr", "sdr"),
    ("autocorrelation length Sal", "sal"),
    ("texture aspect ratio Str", "str"),
)
HALF_SPACE_FIGURES = (
    ("pull-off force, prediction", "pull_off_force"),
    ("pull-off force, half-space", "half_space_pull_off_force"),
    ("contact area, prediction", "contact_area"),
    ("contact area, half-space", "half_space_contact_area"),
    ("mean gap, prediction", "mean_gap"),
    ("mean gap, half-space", "half_space_mean_gap"),
    ("apparent work of adhesion, prediction", "apparent_work_of_adhesion"),
    ("apparent work of adhesion, half-space", "half_space_apparent_work_of_adhesion"),
    ("adhesion hysteresis, half-space", "half_space_adhesion_hysteresis"),
    ("time of the solution", "half_space_processing_time"),
)
#: half_space_message of a row whose scan was not to be solved
NOT_FLAGGED = "no flag asks for it"
DECLARED = dict(
    {"half_space_" + name: figure for name, figure in _core.figures["HalfSpaceFigures"].items()},
    **{
        name: figure
        for kind in ("Verdict", "Roughness", "Prediction")
        for name, figure in _core.figures[kind + "Figures"].items()
    },
)
SHARES = ("contact_fraction", "invalid_fraction", "sdr")  # that are read as percent
ROUNDING = 1e-6  # of the work of adhesion: less hysteresis is none
SOURCES = (
    "Adhesion of two rough surfaces, equilibrium, plasticity limits: S. Deladi, G. Krijnen, N. "
    "Tas, M. Elwenspoek, Three dimensional adhesion model for arbitrary rough surfaces (2002); as "
    "implemented, and what differs: doc/theory.md.",
    "Contact of one asperity: Johnson, Kendall and Roberts, Proc. R. Soc. A 324 (1971) 301.",
    "Surface forces: Israelachvili, Intermolecular and Surface Forces (3rd ed., 2011), chapter 13.",
    "Which contact theory applies: Johnson and Greenwood, J. Colloid Interface Sci. 192 (1997) "
    "326; Maugis, J. Colloid Interface Sci. 150 (1992) 243.",
    "Adhesion parameter and its regimes: Gui et al., J. Appl. Phys. 85 (1999) 7448.",
    "Peel numbers of beams: de Boer and Michalske, J. Appl. Phys. 86 (1999) 817; Mastrangelo and "
    "Hsu, J. MEMS 2 (1993) 33 and 44.",
    "Half-space, where it was solved: Muller, Yushchenko, Derjaguin, J. Colloid Interface Sci. 77 "
    "(1980) 91; Persson, Scaraggi, J. Chem. Phys. 141 (2014) 124701; as implemented: "
    "doc/half_space.md.",
    "Roughness: ISO 25178-2.",
    "Scans of one part together: random effects by the method of moments (DerSimonian and Laird, "
    "Controlled Clinical Trials 7 (1986) 177, unweighted), degrees of freedom by JCGM 100:2008, "
    "equation G.2b; doc/theory.md, section 11.",
    "Control limits of the trends: chart of individual values, Shewhart 1931; Montgomery, "
    "Introduction to Statistical Quality Control, section 6.4; ISO 7870-2.",
    "Material constants: the comments of the configuration below; defaults and their sources: "
    "config/stiction.yaml.",
)


ROUNDED = (
    "pull_off_force",
    "device_pull_off_force",
    "margin",
    "peel_number",
)  # what begins so, by the interval of the verdict


def digits_of_row(row):
    """How many digits of these are worth showing; three without a verdict."""
    return digits_of(
        SimpleNamespace(
            **{
                name + end: number(row.get(name + end))
                for name in ("margin", "peel_number")
                for end in ("", "_lower", "_upper")
            }
        )
    )


def text_of(value, unit, digits=3):
    if unit == "word":
        return str(value) if value in ("DMT", "JKR") else str(value).lower().replace("_", "-")
    value = number(value)
    if math.isnan(value):
        return "not stated"
    if unit == "%":
        return percent(value)
    if unit == "m^2":
        return area(value)
    if unit:
        return with_unit(value, unit, digits).replace("^2", "²")
    return ratio(value, digits)


def read_rows(path):
    """The rows of stiction_batch -o ROWS.jsonl."""
    with open(path, encoding="utf-8") as stream:
        return [json.loads(line) for line in stream]


def scan_name(row):
    name = pathlib.PurePath(row["file"]).name
    if row["scan"]:
        name += ", scan %d" % row["scan"]
    parts = [part for part in (row["name"], row["channel"]) if part and part != "scan"]
    return name + (" (%s)" % ", ".join(parts) if parts else "")


def origin_of(row):
    """What was scanned, by whom and when, and what the row was made with, in one line."""
    words = (
        ("part", "part_id"),
        ("serial number", "serial_id"),
        ("lot", "lot_id"),
        ("wafer", "wafer_id"),
        ("site", "site"),
        ("measured", "acquisition_time"),
        ("with", "instrument"),
        ("by", "operator_name"),
        ("file", "checksum"),
        ("settings", "settings_hash"),
        ("version", "version"),
    )
    site = [number(row.get(name)) for name in ("site_x", "site_y")]
    known = (
        row
        if any(map(math.isnan, site))
        else dict(row, site="%s, %s" % tuple(with_unit(value, "m") for value in site))
    )
    return ", ".join("%s %s" % (word, known[key]) for word, key in words if known.get(key))


def chosen(rows, most):
    """The numbers of at most so many rows, evenly spread, the first and the last among them."""
    if len(rows) <= most:
        return [row["number"] for row in rows]
    return [
        rows[place]["number"]
        for place in sorted(set(np.linspace(0, len(rows) - 1, most).astype(int)))
    ]


def picture_of(folder, result, title):
    arrays = {
        name: np.load(str(folder / (name + ".npy")))
        for name in ("heights", "deformed", "counter_deformed", "contact_map")
    }
    columns = result["asperities"]
    asperities = [
        SimpleNamespace(**dict(zip(columns, values))) for values in zip(*columns.values())
    ]
    prediction = SimpleNamespace(
        **{
            key: number(value)
            for key, value in result.items()
            if value is None or isinstance(value, (int, float))
        }
    )
    prediction.status = STATES[result["status"]][0]
    for name in ("elastic_count", "elasto_plastic_count", "plastic_count", "regime_flags"):
        setattr(prediction, name, result[name])
    prediction.model_doubt = result.get("model_doubt", "")
    return ScanPicture(
        title,
        arrays["heights"],
        arrays["deformed"],
        arrays["counter_deformed"],
        arrays["contact_map"],
        asperities,
        prediction,
        result["pitch_x"],
        result["pitch_y"],
    )


def embedded(png):
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")


def scan_section(row, folder, stages=(), why_no_stages=""):
    """What the page shows of one scan. `folder` has its dump; stages: the surfaces between its
    cleaning steps, where they are to be shown, or why they cannot."""
    with open(str(folder / "result.json"), encoding="utf-8") as stream:
        result = json.load(stream)
    stream = io.BytesIO()
    picture = picture_of(folder, result, scan_name(row))
    save_picture(picture, stream, with_caption=False)  # the page says it
    heights = np.load(str(folder / "heights.npy"))
    return {
        "number": row["number"],
        "name": scan_name(row),
        "maps": embedded(stream.getvalue()),
        "details": embedded(scan_figure(result)),
        "figures": _figures(result, FIGURES),
        "half_space": _half_space(picture, result, folder),
        "cleaning": _cleaning(list(stages), result),
        "why_no_cleaning": _sentence(why_no_stages),
        "surface": embedded(
            surface_figure(heights, result["pitch_x"], result["pitch_y"], result.get("tip_limit"))
        ),
        "surface_figures": _figures(result, SURFACE_FIGURES) + surface_figures_of(heights),
        "origin": origin_of(result),
        "warnings": [typeset(row["warnings"])] if row["warnings"] else [],
        "sticks": result.get("sticks"),
        "releases": verdict_word(result.get("sticks")),
        "verdict": _sentence(result.get("reason", "")),
        "flags": _flags(result),
    }


def _cleaning(stages, result):
    """Picture and table of the cleaning steps; None without them."""
    if not stages:
        return None
    rows = [
        dict(
            row,
            rms=text_of(row["rms"], "m"),
            pull_off=text_of(row["pull_off"], "N"),
            change="" if row["change"] is None else text_of(row["change"], "m"),
            changed="" if row["changed"] is None else row["changed"],
        )
        for row in rows_of(stages)
    ]
    png = cleaning_figure(stages, result["pitch_x"], result["pitch_y"])
    width = int.from_bytes(
        png[16:20], "big"
    )  # of its heading; two columns are not blown up to the width of the page
    return {"image": embedded(png), "width": width, "rows": rows}


def verdict_word(sticks):
    """The verdict as a part's answer: "no" to the question whether it sticks is "releases"."""
    return {"no": "releases", "marginal": "marginal", "yes": "sticks"}.get(sticks, "not known")


def unit_of(name):
    """As the core declares it: "N", "" of a ratio, but "%" of a share and "word" of an
    enumeration."""
    kind, unit, _ = DECLARED[name]
    return "%" if name in SHARES else "word" if kind == "str" else unit


def _figures(result, wanted):
    """Pairs of label and text of those that the result has."""
    bound = "≥ " if result["is_lower_bound"] else ""
    known = digits_of_row(result)
    texts = [
        (
            label,
            name,
            text_of(result[name], unit_of(name), known if name.startswith(ROUNDED) else 3),
        )
        for label, name in wanted
        if name in result
    ]
    return [
        (label, (bound if name.startswith("pull_off_force") else "") + text)
        for label, name, text in texts
        if text != "not stated"
    ]


def _half_space(picture, result, folder):
    """What the page shows of the half-space; None if it was not asked for."""
    if not _is_half_space_asked(result):
        return None
    image, path = "", folder / "half_space_pressure.npy"
    if "half_space_curve" in result:
        image = embedded(
            half_space_figure(picture, np.load(str(path)) if path.exists() else None, result)
        )
    work = number(result.get("half_space_apparent_work_of_adhesion"))
    if abs(number(result.get("half_space_adhesion_hysteresis"))) < ROUNDING * work:
        result = dict(result, half_space_adhesion_hysteresis=0.0)
    figures = _figures(result, HALF_SPACE_FIGURES)
    ratio_text = _half_space_ratio(result)
    if ratio_text:
        figures.insert(2, ("prediction / half-space", ratio_text))
    return {"words": half_space_words(result), "image": image, "figures": figures}


def _is_half_space_asked(row):
    """Whether the scan was to be solved as a half-space."""
    return row.get("half_space_message", NOT_FLAGGED) != NOT_FLAGGED


def _half_space_ratio(row):
    value = pull_off_ratio(row)
    return "" if math.isnan(value) else ("≥ " if row["is_lower_bound"] else "") + ratio(value)


def _half_space_cell(row):
    """The pull-off force of the half-space for the table, and how many times as large the
    prediction's is."""
    if not _is_half_space_asked(row):
        return "not asked"
    force = text_of(row.get("half_space_pull_off_force"), "N")
    return "not solved" if force == "not stated" else "%s (%s)" % (force, _half_space_ratio(row))


def _flags(row):
    names = row.get("regime_flag_names", "")
    return flag_words([name for name in names.split(", ") if name], row.get("model_doubt", ""))


def _limits(row):
    """What speaks against relying on a row: flags in words, and warnings."""
    return "; ".join(text for text in (_flags(row), typeset(row.get("warnings") or "")) if text)


def _sentence(text):
    text = typeset(text)
    return text[:1].upper() + text[1:] + ("" if not text or text.endswith(".") else ".")


TOLD_OF_SCANS = ("acquisition_time", "operator_name")  # in the table, where a scan states one


def table_row(row, drawn):
    entry = {
        "number": row["number"],
        "name": scan_name(row),
        "message": row["message"],
        "anchor": row["number"] in drawn,
        "measured": ", ".join(str(row[name]) for name in TOLD_OF_SCANS if row.get(name)),
    }
    if not row["message"]:
        bound = "≥ " if row["is_lower_bound"] else ""
        entry.update(
            status=STATES[row["status"]][1],
            pull_off=bound + text_of(row["pull_off_force"], "N", digits_of_row(row)),
            contact=percent(row["contact_fraction"]),
            contacts=row["asperity_count"],
            regimes="%d / %d / %d"
            % (row["elastic_count"], row["elasto_plastic_count"], row["plastic_count"]),
            rms=text_of(row["rms_height"], "m"),
            sticks=row.get("sticks"),
            ratio=_ratio_with_interval(row),
            releases=verdict_word(row.get("sticks"))
            + (" (half-space)" if row.get("verdict_by") == "half_space" else ""),
            half_space=_half_space_cell(row),
            limits=_limits(row),
        )
    return entry


def judged_by(row):
    """What the verdict of a row rests on: "margin", or "peel_number" of a beam that is peeled, or
    that has no margin."""
    return ratio_name(
        SimpleNamespace(
            margin=number(row.get("margin")),
            peel_number=number(row.get("peel_number")),
            governed_by=row.get("governed_by"),
        )
    )


def _judges(rows):
    """The same of all rows that are judged, in words."""
    names = {
        judged_by(row).replace("_", " ")
        for row in rows
        if not math.isnan(number(row.get(judged_by(row))))
    }
    return " or ".join(sorted(names)) or "margin"


def _ratio_with_interval(row):
    name = judged_by(row)
    return with_interval(*[number(row.get(name + end)) for end in ("", "_lower", "_upper")])


def summary(rows, drawn):
    predicted = [row for row in rows if not row["message"]]
    parts = ["%s, %d of them predicted." % (counted(len(rows), "scan"), len(predicted))]
    for word, status in (("bonded", "BONDED"), ("without equilibrium", "NO_EQUILIBRIUM")):
        count = sum(row["status"] == status for row in predicted)
        if count:
            parts.append("%d %s." % (count, word))
    if any("sticks" in row for row in predicted):
        counts = [
            (verdict_word(word), sum(row["sticks"] == word for row in predicted))
            for word in ("no", "marginal", "yes", "unknown")
        ]
        parts.append(
            "The device, by scans: " + ", ".join("%s %d" % pair for pair in counts if pair[1]) + "."
        )
    alone = sum(
        "sticks" in row and not (row.get("part_id") or row.get("serial_id")) for row in predicted
    )
    if alone > 1:
        parts.append(
            "%d scans state no part, and each is judged alone: if they are of one device, --part "
            "NAME judges them together." % alone
        )
    if len(drawn) < len(predicted):
        parts.append(
            "Pictures of %s, evenly spread; the table and the trends have all."
            % counted(len(drawn), "scan")
        )
    return " ".join(parts)


def part_row(part):
    """What the page shows of one part: a row of stiction_batch --parts."""
    judge = judged_by(part)
    spread = number(part[judge + "_spread"])
    worst = number(part["worst_" + judge])
    by = (
        ""
        if part["verdict_by"] in ("", "prediction")
        else " (by %s)" % judge_words(part["verdict_by"])
    )
    return {
        "part": part["part_id"],
        "serial": part["serial_id"],
        "sticks": part["sticks"],
        "releases": verdict_word(part["sticks"]) + by,
        "ratio": _ratio_with_interval(part),
        "spread": "" if math.isnan(spread) else "%.2g" % spread,
        "worst": ""
        if math.isnan(worst)
        else "%s of %s" % (ratio(worst), part["worst_%s_scan" % judge]),
        "scans": "%d of %d" % (part["counted_scans"], part["scan_count"]),
        "reason": _sentence(part["reason"]),
        "limits": _limits(part),
    }


def parts_caption(parts):
    """What the figures in the table of the parts are."""
    own = sum(not math.isnan(number(part["device_pull_off_force"])) for part in parts)
    of_device = (
        "by the device's own force, found from all scans of one part and serial number together, "
        "with its 95 % interval."
    )
    pooled = (
        "The scans of one part and serial number, pooled: the geometric mean and its 95 % "
        "interval. What is common to all scans (constants, model, pitch) does not shrink with "
        "their number."
    )
    if not own:
        return pooled
    if own == len(parts):
        return "Judged " + of_device
    return "%d of %d parts: %s The others: %s" % (
        own,
        len(parts),
        of_device,
        pooled[:1].lower() + pooled[1:],
    )


def page(
    title, rows, sections, settings_text, configuration_path, parts=(), date=None, settings_name=""
):
    """The HTML. `settings_text` is the settings file beside the rows; parts: the rows of
    stiction_batch --parts; settings_name: of the file beside the page that has the settings."""
    predicted = [row for row in rows if not row["message"]]
    settings = yaml.safe_load(settings_text)
    given = (
        pathlib.Path(configuration_path).read_text(encoding="utf-8") if configuration_path else ""
    )
    configuration = settings_text.split("\nconfiguration:\n", 1)[1]
    drawn = {section["number"] for section in sections}
    versions = [
        ("mems_stiction", settings["version"]),
        ("OpenCV", settings["opencv_version"]),
        ("Python", platform.python_version()),
        ("Matplotlib", matplotlib.__version__),
        ("Jinja", jinja2.__version__),
    ]
    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, finalize=_with_units
    )
    return environment.from_string(PAGE).render(
        title=title,
        version=settings["version"],
        summary=summary(rows, drawn),
        date=date or datetime.datetime.now().strftime("%Y-%m-%d %H:%M"),
        lots=lots_section(rows, embedded),
        has_half_space=any(_is_half_space_asked(row) for row in predicted),
        has_device=any("sticks" in row for row in predicted),
        judged_by=_judges(predicted),
        table=[table_row(row, drawn) for row in rows],
        parts=[part_row(part) for part in parts]
        if any("sticks" in row for row in predicted)
        else [],
        parts_caption=parts_caption(parts),
        bounded=any(row["is_lower_bound"] for row in predicted),
        trends=embedded(trend_figure(predicted)) if len(predicted) > 1 else "",
        scans=sections,
        device=device_lines(settings["configuration"]),
        measurements=measurements_of(rows),
        has_measurements=any(row.get(name) for row in rows for name in TOLD_OF_SCANS),
        inputs=settings["inputs"],
        versions=versions,
        sources=SOURCES,
        configuration_file=Verbatim(given),
        configuration_name=str(configuration_path or ""),
        settings_name=settings_name,
        configuration=Verbatim(re.sub(r"(?m)^  ", "", configuration)),
    )


class Verbatim(str):
    """A text that stays as it is, to be copied."""


def _with_units(value):
    """What the page writes: no line ends between a number and its unit."""
    return (
        unbroken(value)
        if isinstance(value, str)
        and not isinstance(value, Verbatim)
        and not value.startswith("data:")
        else value
    )


def write_csv(rows, path):
    """Every row with the columns of stiction_batch. Raises CannotWrite."""
    columns = list(max(rows, key=len))
    with whole(path) as part, open(str(part), "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: csv_cell(value) for name, value in row.items()} for row in rows)


def write_json(rows, parts, settings_text, path):
    """Settings, parts and rows. Raises CannotWrite."""
    settings = yaml.safe_load(settings_text)
    with whole(path) as part, open(str(part), "w", encoding="utf-8") as stream:
        json.dump(
            {"settings": settings, "parts": parts, "scans": rows}, stream, indent=1, default=str
        )
        stream.write("\n")
