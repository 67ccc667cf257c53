"""What rows say of lots and wafers, and what they cannot, in sentences."""

from __future__ import annotations

import math
from typing import Dict, List, Sequence

from mems_stiction.lots_data import (
    RELEASING,
    RMS_HEIGHT,
    UNITS,
    VOLTAGES,
    WORDS,
    Lots,
    wafer_word,
    word_of,
)
from mems_stiction.lots_variance import Components, Hierarchy
from mems_stiction.lots_wafer import CHANCE, BadPlace, Trend, is_steep
from mems_stiction.lots_yield import BOUND, COUNTED, NORMAL, Share
from mems_stiction.quantities import counted, percent, ratio, with_unit

FEW = 4  # degrees of freedom: below, an interval is wider than a factor of three either way
MANY_WAFERS = 20  # of which one has a bad place by chance
MOST_NAMED = 6
LEAST_TOLD = 1e-6  # of a share, as share_text() says
LARGEST_WAFER = 0.5  # [m]; wafers have 0.3 m, some 0.45 m
MOST_FACTOR = 1000  # that is told
SMALL = 1e-12  # of a variance over all of them


def text_of(value: float, figure: str) -> str:
    return with_unit(value, UNITS[figure]) if UNITS[figure] else ratio(value)


def condition_text(at: float, against: str) -> str:
    """ "voltage 20 V"; empty without a condition."""
    if not against:
        return ""
    unit = UNITS.get(against, "")
    return "%s %s" % (WORDS.get(against, against), with_unit(at, unit) if unit else ratio(at))


def _some(texts: Sequence[str]) -> str:
    shown = list(texts[:MOST_NAMED])
    return ", ".join(shown) + (
        " and %d more" % (len(texts) - MOST_NAMED) if len(texts) > MOST_NAMED else ""
    )


def of_rows(lots: Lots, sites: int) -> List[str]:
    """What was left out, and what rows do not say. sites: places that the chosen rows are of."""
    said = []
    lost = sum(not place.is_known() for place in lots.places)
    if lost:
        said.append(
            "without a %s, and left out: %d of %d rows"
            % (WORDS[lots.figure], lost, len(lots.places))
        )
    if len(lots.conditions()) > 1:
        said.append(
            "lots, wafers and places are compared at %s, where most rows are"
            % condition_text(lots.at, lots.against)
        )
    if sites < len(lots.chosen):
        said.append(
            "scans of one site are averaged, since they are no independent places: %d rows are %s"
            % (len(lots.chosen), counted(sites, "place"))
        )
    free = sum(math.isinf(place.value) for place in lots.chosen)
    if free:
        said.append(
            "with an infinite %s, since nothing holds there: %s, counted as releasing and left out "
            "of differences" % (WORDS[lots.figure], counted(free, "row"))
        )
    settings = {place.settings for place in lots.chosen if place.settings}
    if len(settings) > 1:
        said.append(
            "the rows were made with %d different settings: what these change is taken for a "
            "difference of the places" % len(settings)
        )
    sites = [(place.x, place.y) for place in lots.places if place.has_site()]
    if sites and max(max(axis) - min(axis) for axis in zip(*sites)) > LARGEST_WAFER:
        said.append(
            "sites lie up to %s apart: site_x and site_y are taken for metres"
            % with_unit(max(max(axis) - min(axis) for axis in zip(*sites)), "m")
        )
    stated = [
        word
        for word, given in (
            ("lot_id", any(place.lot for place in lots.places)),
            ("wafer_id", any(place.wafer for place in lots.places)),
            ("site_x, site_y", any(place.has_site() for place in lots.places)),
        )
        if not given
    ]
    if stated:
        said.append("no row has %s, and nothing is said of these" % ", ".join(stated))
    return said


def of_bad_places(found: Sequence[BadPlace]) -> List[str]:
    return [
        "%s does not belong to %s: %s %s, %s expected there (%.1f robust standard deviations, "
        "limit %.1f)"
        % (
            word_of(bad.place),
            "its wafer" if bad.place.wafer else "the others",
            WORDS[bad.figure],
            text_of(bad.value, bad.figure),
            text_of(bad.expected, bad.figure),
            abs(bad.deviations),
            bad.limit,
        )
        for bad in of_each_place(found)
    ][:MOST_NAMED]


def of_each_place(found: Sequence[BadPlace]) -> List[BadPlace]:
    """The first of each: what is compared goes before force and rms height."""
    first: Dict[int, BadPlace] = {}
    for bad in found:
        first.setdefault(id(bad.place), bad)
    return list(first.values())


def _factor(variance: float) -> str:
    factor = math.exp(min(math.sqrt(variance), 700.0))
    return ratio(factor) if factor < MOST_FACTOR else "more than %d" % MOST_FACTOR


def of_components(components: Components, hierarchy: Hierarchy, left_out: int) -> List[str]:
    """left_out: bad places, which were."""
    total = components.total()
    if total <= SMALL:
        return ["no differences: all of %d values are equal" % components.counts[-1]]
    said = []
    for place, word in enumerate(components.words):
        low, best, high = (
            components.lower[place],
            components.variances[place],
            components.upper[place],
        )
        share = best / total
        text = (
            "%s differ by a factor of %s (%s to %s) for one standard deviation, %s of the variance"
            % (word, _factor(best), _factor(low), _factor(high), percent(share))
        )
        if components.freedoms[place] < FEW:
            text = "a rough estimate, from %d %s alone: %s" % (components.counts[place], word, text)
        elif low <= SMALL and place < len(components.words) - 1:
            text += "; they may not differ at all"
        said.append(text)
    for word in hierarchy.single:
        said.append(
            "all rows are of one of the %s: how far %s differ cannot be told" % (word, word)
        )
    said += hierarchy.merged
    if left_out:
        said.append(
            "%s left out of these differences, not of the share that sticks"
            % ("the bad place is" if left_out == 1 else "the %d bad places are" % left_out)
        )
    if components.why_squares:
        said.append("differences are estimated by mean squares: %s" % components.why_squares)
    return said


def of_trends(trends: Sequence[Trend], figure: str, of_heights: Sequence[Trend]) -> List[str]:
    """Those that are there, the steepest first; one sentence for the others. Then those of the rms
    height, which may be a cause."""
    said = _of_steep(trends, figure)
    flat = [
        wafer_word(trend.lot, trend.wafer) or "the wafer" for trend in trends if not is_steep(trend)
    ]
    if flat:
        said.append("no trend of the %s is seen over %s" % (WORDS[figure], _some(flat)))
    said += _of_steep(of_heights, RMS_HEIGHT)
    if len(trends) >= MANY_WAFERS:
        said.append(
            "by chance alone some %.0f of %d wafers show a trend, and as many a bad place"
            % (CHANCE * len(trends), len(trends))
        )
    return said


def _of_steep(trends: Sequence[Trend], figure: str) -> List[str]:
    steep = sorted((trend for trend in trends if is_steep(trend)), key=lambda trend: -trend.factor)
    said = []
    for trend in steep[:MOST_NAMED]:
        low, high = max(trend.factor_lower, 1.0), trend.factor_upper
        said.append(
            "%s: %s grows by a factor of %s (%s to %s) over %s, towards %d deg from x"
            % (
                wafer_word(trend.lot, trend.wafer) or "the wafer",
                WORDS[figure],
                ratio(trend.factor),
                ratio(low),
                ratio(high),
                with_unit(trend.extent, "m"),
                round(math.degrees(trend.direction)),  # a float would keep the sign of -0
            )
        )
    if len(steep) > MOST_NAMED:
        said.append(
            "%d more wafers have a trend of the %s, too" % (len(steep) - MOST_NAMED, WORDS[figure])
        )
    return said


def share_text(value: float) -> str:
    """As far as digits tell something."""
    if 0.0 < value < LEAST_TOLD:
        return "less than 0.0001 %"
    return "more than 99.9 %" if 0.9995 < value < 1.0 else percent(value)


def share_words(share: Share) -> str:
    """What is expected to stick, and by what."""
    if share.method == BOUND and share.lower < 0.001 and share.upper > 0.999:
        return (
            "not known (%s of %d places stick%s, but the error of constants and model, which all "
            "margins share, reaches across 1)"
            % (
                "none" if share.sticking == 0 else "all",
                share.places,
                "s" if share.sticking == 0 else "",
            )
        )
    if share.method == BOUND:
        bound = (
            "at most %s" % share_text(share.upper)
            if share.sticking == 0
            else "at least %s" % share_text(share.lower)
        )
        return "%s (%s of %d places stick%s)" % (
            bound,
            "none" if share.sticking == 0 else "all",
            share.places,
            "s" if share.sticking == 0 else "",
        )
    return "%s (%s to %s)" % (
        share_text(share.share),
        share_text(share.lower),
        share_text(share.upper),
    )


def of_shares(shares: Sequence[Share], lots: Lots, hierarchy: Hierarchy) -> List[str]:
    if lots.figure not in RELEASING:
        return [
            "no row has a margin: state the device (device/spring_stiffness, device/travel, "
            "device/contact_area) for the share that sticks"
        ]
    said = []
    for share in shares:
        where = condition_text(share.at, lots.against)
        text = "%sexpected to stick: %s" % ("at %s " % where if where else "", share_words(share))
        said.append(text + ", " + _method(share))
    lacking, places = (
        sum(getattr(share, name) for share in shares) for name in ("without_interval", "places")
    )
    if lacking == places:
        said.append(
            "margins come without intervals: the error of constants and model, which all rows "
            "share, is not in the share that sticks"
        )
    elif lacking:
        said.append(
            "%d of %d margins come without an interval: that of the others, as it is in the middle "
            "of them, is taken for it" % (lacking, places)
        )
    if hierarchy.single and len(lots.places) > 1:
        said.append(
            "that share is for more places of the same %s" % hierarchy.single[-1].rstrip("s")
        )
    if lots.against in ("",) + VOLTAGES:
        said.append(
            "how that share grows with the time stuck down is not told by these rows: the model "
            "has no creep and no ageing. Margins that were measured after several times tell it, "
            "with a column of the times (against)"
        )
    return said


def _method(share: Share) -> str:
    if share.method == NORMAL:
        return "by the normal distribution of the logarithms of %d margins; %d of them stick" % (
            share.places,
            share.sticking,
        )
    worth = (
        ""
        if share.worth > 0.95 * share.places
        else "; places of one unit are alike, and these are worth %s independent ones"
        % ratio(share.worth, 2)
    )
    if share.method == COUNTED:
        return "counted: %d of %d places%s" % (share.sticking, share.places, worth)
    tail = (
        ""
        if math.isnan(share.tail)
        else (
            "; by a normal distribution it would be %s, but its tail is further out than these "
            "places show" % share_text(share.tail)
        )
    )
    return "a bound of 95 %%%s%s" % (worth, tail)
