"""Maps of the wafers on the station's page, and their parts side by side. No ROS here; it loads the
core."""

import math

import numpy as np

from mems_stiction._settings import OptionsError
from mems_stiction.lots_data import UNITS, WORDS, by_wafer, lots_of, wafer_word, word_of
from mems_stiction.lots_wafer import bad_places, colour_range, figures_of, missing_sites
from mems_stiction.lots_words import text_of
from mems_stiction.page_places import MOST_PLACES, MOST_WAFERS, has_site
from mems_stiction.page_words import VERDICTS, all_finite, sentence
from mems_stiction.quantities import typeset, with_interval

MOST_PARTS = 40  # side by side
WHAT_TO_STATE = (
    "State site_x and site_y [m] with wafer_id, and lot_id and part_id as far as they are known, "
    "in scan_info or in the sidecar of the scan's file (import_scan writes one)."
)


def told(rows_and_counts):
    """What the page shows, as JSON can have it; numbers are SI.

    figures: what places may be coloured by; wafers, heard of last first: name, missing sites where
    others have one, and what is said of bad places by figure;
    parts: name, part, serial, and of each figure median and middle half in words; places: wafer and
    part by their numbers (None: none), site, values
    (None: missing or infinite) and texts (None: missing) by figure, and by which they are bad;
    notes: what is not shown, and what to state.
    """
    rows, counts = rows_and_counts
    shown = {
        "version": counts["version"],
        "figures": [],
        "wafers": [],
        "parts": [],
        "places": [],
        "notes": [],
    }
    try:
        lots = lots_of(rows)
    except OptionsError:
        shown["notes"] = _notes(rows, counts) + (
            ["No prediction of these places has a margin or a force > 0."] if rows else []
        )
        return shown
    values = {
        name: np.where(np.array(listed) > 0.0, listed, math.nan)
        for name, listed in figures_of(lots.figure, lots.force, lots.places).items()
    }
    shown["figures"] = [
        _figure(name, listed) for name, listed in values.items() if np.isfinite(listed).any()
    ]
    names = [figure["name"] for figure in shown["figures"]]
    wafers = [
        key
        for key, places in reversed(list(by_wafer(lots.places).items()))
        if any(place.has_site() for place in places)
    ]
    parts = list(
        dict.fromkeys(_part_of(place) for place in reversed(lots.places) if any(_part_of(place)))
    )
    bad = {}
    for key in wafers:
        places = [place for place in lots.places if (place.lot, place.wafer) == key]
        sites = [place for place in places if place.has_site()]
        found = {
            name: bad_places(sites, name, figures_of(lots.figure, lots.force, sites)[name])
            for name in names
        }
        bad.update({(id(one.place), name): one for name in names for one in found[name]})
        own = {(place.x, place.y) for place in sites}
        shown["wafers"].append(
            {
                "name": _capital(wafer_word(*key) or "wafer without a name"),
                "missing": [site for site in missing_sites(sites, lots.places) if site not in own],
                "bad": {name: [_bad_words(one) for one in found[name]] for name in names},
            }
        )
    shown["places"] = [
        {
            "wafer": _index(wafers, (place.lot, place.wafer)) if place.has_site() else None,
            "part": _index(parts[:MOST_PARTS], _part_of(place)),
            "x": place.x,
            "y": place.y,
            "name": ", ".join(
                text for text in (word_of(place), place.part and "part " + place.part) if text
            ),
            "level": row["level"],
            "values": {name: float(values[name][number]) for name in names},
            "texts": {
                name: _text(values[name][number], name) if values[name][number] > 0.0 else None
                for name in names
            },
            "bad": [name for name in names if (id(place), name) in bad],
        }
        for number, (row, place) in enumerate(zip(rows, lots.places))
    ]
    shown["parts"] = [
        _part(
            part,
            [number for number, place in enumerate(lots.places) if _part_of(place) == part],
            rows,
            values,
            names,
        )
        for part in parts[:MOST_PARTS]
    ]
    shown["notes"] = _notes(rows, counts) + (
        ["Of %d parts the %d heard of last stand side by side." % (len(parts), MOST_PARTS)]
        if len(parts) > MOST_PARTS
        else []
    )
    return all_finite(shown)


def _figure(name, values):
    low, high, is_by_ratio = colour_range(values[np.isfinite(values)])
    return {
        "name": name,
        "label": WORDS[name],
        "unit": UNITS[name],
        "low": low,
        "high": high,
        "is_by_ratio": is_by_ratio,
    }


def _part_of(place):
    """A part by its name; what names none, by its wafer."""
    return place.lot, place.wafer, place.part


def _index(keys, key):
    return keys.index(key) if key in keys else None


def _capital(text):
    return text[:1].upper() + text[1:]


def _text(value, figure):
    return "infinite" if math.isinf(value) else typeset(text_of(value, figure))


def _bad_words(bad):
    where = "(%.4g, %.4g) mm %s" % (
        1e3 * bad.place.x + 0.0,
        1e3 * bad.place.y + 0.0,
        bad.place.part,
    )
    return "%s: %s, expected %s" % (
        where.strip(),
        _text(bad.value, bad.figure),
        _text(bad.expected, bad.figure),
    )


def _part(part, numbers, rows, values, names):
    lot, wafer, name = part
    word = ", ".join(text for text in (name, wafer_word(lot, wafer)) if text)
    levels = [rows[number]["level"] for number in numbers]
    spread = {}
    for figure in names:
        known = values[figure][numbers]
        known = known[~np.isnan(known)]
        low, median, high = _quartiles(known)
        spread[figure] = {
            "count": int(known.size),
            "median": float(median),
            "low": float(low),
            "high": float(high),
            "text": "no value"
            if not known.size
            else _text(median, figure)
            if known.size == 1 or math.isinf(high)
            else typeset(with_interval(median, low, high, UNITS[figure])),
        }
    return {
        "name": word,
        "part": rows[numbers[0]]["part_id"],
        "serial": rows[numbers[0]]["serial_id"],
        "places": len(numbers),
        "figures": spread,
        "levels": {level: levels.count(level) for level, _ in VERDICTS.values() if level in levels},
    }


def _quartiles(values):
    """Where some are infinite, of the values themselves: nothing lies between."""
    if not values.size:
        return (math.nan,) * 3
    shares = np.array([0.25, 0.5, 0.75])
    return (
        np.sort(values)[np.rint(shares * (values.size - 1)).astype(int)]
        if np.isinf(values).any()
        else np.percentile(values, 100 * shares)
    )


def _notes(rows, counts):
    """What is not shown and why; what mixes."""
    notes = []
    sited = [row for row in rows if has_site(row)]
    if not sited:
        notes.append(
            "%s %s"
            % (
                "No scan has stated where on a wafer it was taken."
                if rows or counts["nameless"]
                else "No scan yet.",
                WHAT_TO_STATE,
            )
        )
    elif len(sited) < len(rows) or counts["nameless"]:
        lost = len(rows) - len(sited) + counts["nameless"]
        notes.append(
            "%d scan%s no site_x and site_y: %s on no map."
            % ((lost,) + ((" states", "it is") if lost == 1 else ("s state", "they are")))
        )
    if any(not row["wafer_id"] for row in sited):
        notes.append(
            "Sites without a wafer_id lie on one map for each lot: state wafer_id in scan_info or "
            "in the sidecar of the scan's file."
        )
    settings = {row["settings_hash"] for row in rows if row["settings_hash"]}
    if len(settings) > 1:
        notes.append(
            "The places were predicted with %d different settings: what these change is taken for "
            "a difference of the places." % len(settings)
        )
    for name, left in (
        ("wafers", "the %d wafers heard of last are" % MOST_WAFERS),
        ("places", "the %d newest places of each wafer are" % MOST_PLACES),
    ):
        if counts[name]:
            notes.append(
                "Dropped: %d %s; %s kept."
                % (counts[name], name if counts[name] > 1 else name[:-1], left)
            )
    return [sentence(note) for note in notes]
