"""Lots and wafers in a report: what compare_lots says of its rows, with a map of each wafer."""

import io
import itertools

from mems_stiction._lots import compare_lots
from mems_stiction._settings import OptionsError
from mems_stiction.lots_data import by_wafer, lots_of, wafer_word
from mems_stiction.lots_figure import comparison_figure
from mems_stiction.plots import save
from mems_stiction.quantities import typeset

MOST_MAPS = 12


def lots_section(rows, embedded):
    """What the page shows; None where no row says of which lot or wafer it is, or none was
    predicted.

    embedded: makes the address of a picture within the page from a PNG.
    """
    try:
        places = lots_of(rows).places
    except OptionsError:
        return None
    wafers = by_wafer(place for place in places if place.has_site())
    if not wafers and not any(place.lot or place.wafer for place in places):
        return None
    found = compare_lots(rows)
    maps = [
        (wafer_word(lot, wafer) or "the wafer", embedded(_png(figure)))
        for lot, wafer, figure in itertools.islice(found.maps(), MOST_MAPS)
    ]
    return {
        "statements": [typeset(text[0].upper() + text[1:] + ".") for text in found.statements],
        "picture": embedded(_png(comparison_figure(found.to_dict(), has_statements=False))),
        "maps": maps,
        "has_more": len(wafers) > MOST_MAPS,
    }


def _png(figure):
    stream = io.BytesIO()
    save(figure, stream)
    return stream.getvalue()
