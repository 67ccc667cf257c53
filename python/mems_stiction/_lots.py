"""How far lots, wafers, parts and places differ, and which share of them sticks, by rows of
predictions."""

from __future__ import annotations

import json
import math
import os
import pathlib
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from mems_stiction._arrays import ReadOnly, plain_value
from mems_stiction.lots_data import (
    RELEASING,
    RMS_HEIGHT,
    WORDS,
    Lots,
    Place,
    at_sites,
    by_wafer,
    lots_of,
)
from mems_stiction.lots_variance import Components, components_of, hierarchy_of
from mems_stiction.lots_wafer import (
    BadPlace,
    Trend,
    bad_places,
    figures_of,
    missing_sites,
    trend_of,
)
from mems_stiction.lots_words import (
    of_bad_places,
    of_components,
    of_rows,
    of_shares,
    of_trends,
    text_of,
)
from mems_stiction.lots_yield import Share, share_of
from mems_stiction.other_packages import require_package
from mems_stiction.quantities import counted

UNITS_SHOWN = 60  # of one level, in the text
FILE_LETTERS = "-_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"

Path = Union[str, "os.PathLike[str]"]


class LotComparison(ReadOnly):
    """Lots, wafers, parts and places side by side.

    figure: what is compared: margin, peel_number, device_pull_off_force or pull_off_force. against:
    the column of the condition, or "".
    components: a record of each level: level, units, degrees_of_freedom, deviation,
    deviation_lower, deviation_upper: standard deviation of the figure's logarithm with its 95 %
    interval, share: of the variance.
    units: a record of each lot, wafer and part: level, lot_id, wafer_id, part, places, value
    (geometric mean), lower, upper (95 %), sticking (places).
    shares: a record for each condition: at, places, sticking, share, lower, upper: expected to
    stick with its 95 % interval; method: normal, counted or bound; tail: what a normal distribution
    says, NaN where the figures have another; worth: as many independent places; lost: rows without
    the figure; without_interval: places whose margins come without an interval, for which that of
    the others is taken.
    trends: a record of each wafer: gradient_x, gradient_y [1/m] of the logarithm with ..._lower,
    ..._upper; factor, ...: from end to end over extent [m] in direction [rad from x]; chance: that
    a wafer without a trend shows as much.
    bad_places: a record of each: lot_id, wafer_id, part, site_x, site_y [m], name, figure, value,
    expected, deviations, limit.
    statements: what the rows tell, and what they cannot.
    """

    figure: str
    against: str
    components: np.recarray
    units: np.recarray
    shares: np.recarray
    trends: np.recarray
    bad_places: np.recarray
    statements: Tuple[str, ...]

    def __init__(self, lots: Lots, sites: List[Place], figures: Dict[str, Any]) -> None:
        self._lots, self._sites = lots, sites
        self.__dict__.update(figures, figure=lots.figure, against=lots.against)

    def to_dict(self) -> Dict[str, Any]:
        """What json() prints. None stands for what is not known."""
        from mems_stiction.version import version

        record: Dict[str, Any] = {
            "version": version(),
            "figure": self.figure,
            "against": self.against,
        }
        for name in ("components", "units", "shares", "trends", "bad_places"):
            table = getattr(self, name)
            record[name] = [
                {key: plain_value(row[key]) for key in table.dtype.names} for row in table
            ]
        record["statements"] = list(self.statements)
        return record

    def json(self) -> str:
        """One line."""
        return json.dumps(self.to_dict())

    def save_picture(self, path: Path) -> None:
        """PNG, PDF or SVG: where differences lie, parts side by side, the share that sticks."""
        require_package("matplotlib", "a picture")
        from mems_stiction.lots_figure import save_comparison

        save_comparison(self.to_dict(), path)

    picture = save_picture

    def save_maps(self, folder: Path) -> List[pathlib.Path]:
        """A map of each wafer with sites as PNG into a folder, which is made: the figure, the force
        and the rms height. Returns the paths."""
        from mems_stiction.plots import save

        target = pathlib.Path(os.fspath(folder))
        target.mkdir(parents=True, exist_ok=True)
        paths: List[pathlib.Path] = []
        for lot, wafer, figure in self.maps():
            name = (
                "_".join(["wafer"] + [_file_name(text) for text in (lot, wafer) if text]) + ".png"
            )
            path = target / (
                name if target / name not in paths else "%s_%d.png" % (name[:-4], len(paths) + 1)
            )
            save(figure, path)
            paths.append(path)
        return paths

    def maps(self) -> Iterator[Tuple[str, str, Any]]:
        """lot_id, wafer_id and the figure of each wafer with sites, drawn when its turn comes. The
        caller saves it."""
        require_package("matplotlib", "a picture")
        from mems_stiction.lots_maps import has_map, map_figure

        for (lot, wafer), places in by_wafer(self._sites).items():
            if has_map((self.figure, self._lots.force), places):
                trends = [
                    trend for trend in self.trends if (trend.lot_id, trend.wafer_id) == (lot, wafer)
                ]
                yield (
                    lot,
                    wafer,
                    map_figure(
                        (self.figure, self._lots.force),
                        places,
                        missing_sites(places, self._sites),
                        self._sites,
                        [
                            bad
                            for bad in self.bad_places
                            if (bad.lot_id, bad.wafer_id) == (lot, wafer)
                        ],
                        trends[0] if trends else None,
                    ),
                )

    def __repr__(self) -> str:
        lines = [
            "Comparison of %s by their %s"
            % (counted(len(self._lots.places), "row"), WORDS[self.figure])
        ]
        lines += ["  " + statement for statement in self.statements]
        for level in dict.fromkeys(self.units.level):
            units = self.units[self.units.level == level]
            lines += [_unit_line(unit, self.figure) for unit in units[:UNITS_SHOWN]]
            if len(units) > UNITS_SHOWN:
                lines.append("  and %d more %s" % (len(units) - UNITS_SHOWN, level))
        return "\n".join(lines)


def _unit_line(unit: Any, figure: str) -> str:
    interval = (
        ""
        if math.isnan(unit.lower)
        else " (%s to %s)" % (text_of(unit.lower, figure), text_of(unit.upper, figure))
    )
    sticking = (
        ", %d of %d stick" % (unit.sticking, unit.places)
        if figure in RELEASING
        else ", " + counted(unit.places, "place")
    )
    return "  %s: %s %s%s%s" % (
        unit_word(unit),
        WORDS[figure],
        text_of(unit.value, figure),
        interval,
        sticking,
    )


def unit_word(unit: Any) -> str:
    return ", ".join(
        "%s %s" % (word, text)
        for word, text in (("lot", unit.lot_id), ("wafer", unit.wafer_id), ("part", unit.part))
        if text
    )


def _file_name(text: str) -> str:
    return "".join(letter if letter in FILE_LETTERS else "-" for letter in text)


def compare_lots(
    rows: Any, *, figure: Optional[str] = None, against: Optional[str] = None
) -> LotComparison:
    """How far do lots, wafers, parts and places differ, and which share of them sticks?

        found = mems_stiction.compare_lots("rows.csv")
        found.statements
        found.save_picture("lots.png")
        found.save_maps("maps")

    rows: of stiction_batch: the path of a .csv, .jsonl or .parquet file, several paths,
    dictionaries, or a table of pandas; with lot_id, wafer_id, part_id, serial_id, site_x, site_y
    [m] as far as they are known.
    figure: what is compared; the first of margin, peel_number, device_pull_off_force and
    pull_off_force that the rows have. Of beams that are peeled, peel_number comes first.
    Scans of one site of a part are one place, with the geometric means of their figures.
    against: the column of a condition under which the share that sticks is asked. Without it the
    voltage, where rows of several are there.
    The model knows no ageing: against a time stuck down only a column of measured times tells.

    Variances between lots, wafers, parts and places are those of random effects of the logarithm
    (statsmodels), the share that sticks is that of a normal distribution where the rows have one,
    else it is counted (doc/process.md). Raises OptionsError and FileError.
    """
    require_package("scipy", "compare_lots")
    lots = lots_of(rows, figure, against)
    sites = at_sites(lots.chosen)
    finite = [place for place in lots.chosen if place.is_known() and math.isfinite(place.value)]
    bad = _bad_places(lots, sites)
    outlying = {found.place.site() for found in bad if found.figure == lots.figure}
    sound = [place for place in finite if place.site() not in outlying]
    statements = of_rows(lots, len(sites))
    hierarchy = hierarchy_of(sound)
    components = (
        components_of(np.log([place.value for place in sound]), hierarchy)
        if len(sound) > 1
        else None
    )
    trends = [
        trend
        for trend in (trend_of(places) for places in by_wafer(at_sites(sound)).values())
        if trend is not None
    ]
    shares = _shares(lots) if lots.figure in RELEASING else []
    statements += of_shares(shares, lots, hierarchy) + of_bad_places(bad)
    if components is not None:
        statements += of_components(components, hierarchy, len(outlying))
    else:
        statements.append("one row does not tell how far places differ")
    statements += of_trends(trends, lots.figure, _trends_of_heights(sites, bad))
    return LotComparison(
        lots,
        sites,
        {
            "components": _components_table(components),
            "units": _units_table(finite, lots.figure),
            "shares": _table(Share, shares),
            "trends": _trends_table(trends),
            "bad_places": _bad_table(bad),
            "statements": tuple(statements),
        },
    )


def _trends_of_heights(sites: Sequence[Place], bad: Sequence[BadPlace]) -> List[Trend]:
    """Of the rms height, over the places that are none of its bad ones."""
    outlying = {id(found.place) for found in bad if found.figure == RMS_HEIGHT}
    heights = [
        place._replace(value=place.rms_height)
        for place in sites
        if place.rms_height > 0.0 and id(place) not in outlying
    ]
    return [trend for trend in map(trend_of, by_wafer(heights).values()) if trend is not None]


def _bad_places(lots: Lots, sites: Sequence[Place]) -> List[BadPlace]:
    found: List[BadPlace] = []
    for places in by_wafer(sites).values():
        for figure, values in figures_of(lots.figure, lots.force, places).items():
            found += bad_places(places, figure, values)
    return found


def _shares(lots: Lots) -> List[Share]:
    found = []
    for at in lots.conditions():
        rows = lots.under(at)
        known = [place for place in at_sites(rows) if place.is_known()]
        if known:
            share = share_of(known, hierarchy_of(known), at)
            found.append(share._replace(lost=sum(not row.is_known() for row in rows)))
    return found


def _table(kind: Any, rows: Sequence[Any]) -> np.recarray:
    types = {"int": int, "float": float, "bool": bool}
    return _records(
        [(name, types.get(kind.__annotations__[name], object)) for name in kind._fields], rows
    )


def _records(layout: Sequence[Tuple[str, Any]], rows: Sequence[Any]) -> np.recarray:
    table = np.recarray(len(rows), dtype=list(layout))
    for place, row in enumerate(rows):
        table[place] = tuple(row)
    return table


def _components_table(components: Optional[Components]) -> np.recarray:
    layout = [
        ("level", object),
        ("units", int),
        ("degrees_of_freedom", int),
        ("deviation", float),
        ("deviation_lower", float),
        ("deviation_upper", float),
        ("share", float),
    ]
    if components is None:
        return _records(layout, [])
    total = components.total()
    return _records(
        layout,
        [
            (
                word,
                components.counts[place],
                components.freedoms[place],
                math.sqrt(components.variances[place]),
                math.sqrt(components.lower[place]),
                math.sqrt(components.upper[place]),
                components.variances[place] / total if total > 0.0 else math.nan,
            )
            for place, word in enumerate(components.words)
        ],
    )


def _units_table(known: Sequence[Place], figure: str) -> np.recarray:
    """Each with the mean of the units in it, and by what these differ in all units of its level."""
    layout = [
        ("level", object),
        ("lot_id", object),
        ("wafer_id", object),
        ("part", object),
        ("places", int),
        ("value", float),
        ("lower", float),
        ("upper", float),
        ("sticking", int),
    ]
    rows: List[Tuple[Any, ...]] = []
    for depth, level in enumerate(("lots", "wafers", "parts")):
        if not any((place.lot, place.wafer, place.part)[depth] for place in known):
            continue
        groups: Dict[Any, List[Place]] = {}
        for place in known:
            groups.setdefault((place.lot, place.wafer, place.part)[: depth + 1], []).append(place)
        means = {key: _means_within(places, depth) for key, places in groups.items()}
        freedom = sum(len(inner) - 1 for inner in means.values())
        square = (
            sum(float(((inner - inner.mean()) ** 2).sum()) for inner in means.values()) / freedom
            if freedom
            else math.nan
        )
        for key, places in groups.items():
            sites = at_sites(places)
            mean = float(means[key].mean())
            half = _reach(freedom) * math.sqrt(square / len(means[key])) if freedom else math.nan
            sticking = sum(place.value < 1.0 for place in sites) if figure in RELEASING else 0
            rows.append(
                (level,)
                + key
                + ("",) * (2 - depth)
                + (
                    len(sites),
                    math.exp(mean),
                    math.exp(mean - half),
                    math.exp(mean + half),
                    sticking,
                )
            )
    return _records(layout, rows)


def _means_within(places: Sequence[Place], depth: int) -> np.ndarray:
    """Of the logarithms in the next smaller units that there are several of."""
    for inner in range(depth + 1, 4):
        groups: Dict[Any, List[float]] = {}
        for number, place in enumerate(places):
            names: Tuple[Any, ...] = (
                place.lot,
                place.wafer,
                place.part,
                (place.x, place.y) if place.has_site() else number,
            )
            groups.setdefault(names[: inner + 1], []).append(math.log(place.value))
        if len(groups) > 1:
            return np.array([np.mean(values) for values in groups.values()])
    return np.log([place.value for place in places])


def _reach(freedom: int) -> float:
    from scipy.stats import t

    return float(t.isf(0.025, freedom))


def _trends_table(trends: Sequence[Trend]) -> np.recarray:
    names = ["lot_id", "wafer_id"] + list(Trend._fields[2:])
    return _records(
        [
            (name, object if name.endswith("_id") else int if name == "places" else float)
            for name in names
        ],
        trends,
    )


def _bad_table(found: Sequence[BadPlace]) -> np.recarray:
    texts = ("lot_id", "wafer_id", "part", "name", "figure")
    names = (
        "lot_id",
        "wafer_id",
        "part",
        "site_x",
        "site_y",
        "name",
        "figure",
        "value",
        "expected",
        "deviations",
        "limit",
    )
    return _records(
        [(name, object if name in texts else float) for name in names],
        [
            (
                bad.place.lot,
                bad.place.wafer,
                bad.place.part,
                bad.place.x,
                bad.place.y,
                bad.place.name,
            )
            + tuple(bad[1:])
            for bad in found
        ],
    )
