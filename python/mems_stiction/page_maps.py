"""The maps of the station's page: PNGs of the newest scan, and where contacts are that are too
small to be seen."""

import io
import math

import numpy as np
from PIL import Image
from scipy import ndimage

from mems_stiction.scan_images import pixels

LONGEST = 512  # pixels of a map's longer side
LONGEST_ZOOMED = 4096  # of one of which a piece is looked at
SMALL_CONTACT_SHARE = 3e-4  # of the frame: ringed, or nobody sees them
MOST_RINGS = 300
NOT_MEASURED = (0x6D, 0x4A, 0x6D)
REGIME_COLOURS = (
    (0, 0, 0),
    (0x2F, 0x9B, 0xFF),
    (0xFF, 0xD2, 0x3F),
    (0xFF, 0x4D, 0x4D),
)  # apart, elastic, elasto-plastic, plastic


def require_map(name, message):
    """Raises ValueError where an image message is no map of this name ("height", "contacts")."""
    pixels(message)
    if name == "contacts" and message.encoding not in ("mono8", "8UC1"):
        raise ValueError(
            "encoding '%s' is not allowed for contacts, must be mono8" % message.encoding
        )


def png_of(shown, palette, transparent=None):
    """A PNG of indices into a palette of (red, green, blue)."""
    image = Image.fromarray(np.ascontiguousarray(shown, dtype=np.uint8), mode="P")
    image.putpalette([channel for colour in palette for channel in colour])
    stream = io.BytesIO()
    image.save(
        stream, format="PNG", **({} if transparent is None else {"transparency": transparent})
    )
    return stream.getvalue()


def height_range(message):
    """(low, high) above the mean [m], from 1 % to 99 % of the heights; (0, 0) where nothing was
    measured."""
    heights = thinned(pixels(message))
    measured = heights[np.isfinite(heights)].astype(float)
    if not measured.size:
        return 0.0, 0.0
    low, high = np.percentile(measured, [1, 99]) - mean_height(message)
    return float(low), float(high)


def mean_height(message):
    """Of what was measured [m]; heights are told above it."""
    heights = pixels(message)
    measured = heights[np.isfinite(heights)]
    return float(np.mean(measured, dtype=float)) if measured.size else math.nan


def height_png(message, longest=LONGEST, quarters=0):
    """The topic deformed_height: the colours of the range from low to high, NOT_MEASURED elsewhere.
    quarters: of a turn, clockwise."""
    from matplotlib import cm  # slow to import: not before the subscriptions

    colours = (255 * cm.viridis(np.linspace(0, 1, 255))[:, :3]).round().astype(int).tolist()
    low, high = height_range(message)
    heights = thinned(pixels(message), longest)
    is_measured = np.isfinite(heights)
    shares = (
        (np.where(is_measured, heights, 0.0) - mean_height(message) - low) / ((high - low) or 1.0)
        if is_measured.any()
        else np.zeros(heights.shape)
    )
    shares = np.nan_to_num(shares)
    return png_of(
        np.rot90(np.where(is_measured, 1 + np.rint(254 * np.clip(shares, 0, 1)), 0), -quarters),
        [NOT_MEASURED] + colours,
    )


def contact_png(message, longest=LONGEST, quarters=0):
    """The topic contact_map: contacts in the colours of their regimes, transparent where the
    surfaces are apart."""
    return png_of(
        np.rot90(np.minimum(severest(pixels(message), longest), 3), -quarters),
        REGIME_COLOURS,
        transparent=0,
    )


def measured_at(message, size, places):
    """What stands at one place or two, each (x, y) as shares of width and height: where that is [m]
    and how high [m above the mean]; of two also their distance, and how much higher the second is.
    None where a pixel was not measured, or the size is not known."""
    heights, mean = pixels(message), mean_height(message)
    rows, columns = heights.shape
    points = []
    for x, y in places:
        height = (
            float(heights[min(int(y * rows), rows - 1), min(int(x * columns), columns - 1)]) - mean
        )
        points.append(
            {
                "x": size and x * size[0],
                "y": size and y * size[1],
                "height": height if math.isfinite(height) else None,
            }
        )
    told = {"points": points}
    if len(points) == 2:
        first, second = points
        told["distance"] = size and math.hypot(second["x"] - first["x"], second["y"] - first["y"])
        is_known = first["height"] is not None and second["height"] is not None
        told["step"] = second["height"] - first["height"] if is_known else None
    return told


def rings(message):
    """[x, y, regime] of the small contacts, the largest first; x and y as shares of width and
    height."""
    regimes = severest(pixels(message))
    labels, count = ndimage.label(regimes)
    if not count:
        return []
    every = np.arange(1, count + 1)
    areas = ndimage.sum(np.ones_like(labels), labels, every)
    small = every[areas < SMALL_CONTACT_SHARE * regimes.size]
    small = small[np.argsort(-areas[small - 1], kind="stable")][:MOST_RINGS]
    rows, columns = regimes.shape
    return [
        [(column + 0.5) / columns, (row + 0.5) / rows, int(regime)]
        for (row, column), regime in zip(
            ndimage.center_of_mass(regimes > 0, labels, small),
            ndimage.maximum(regimes, labels, small),
        )
    ]


def _stride(array, longest):
    return -(-max(array.shape) // longest)


def thinned(array, longest=LONGEST):
    """Every n-th row and column, so that the longer side fits."""
    stride = _stride(array, longest)
    return array[::stride, ::stride]


def severest(array, longest=LONGEST):
    """The largest value of each block of pixels: no contact is lost where a map is made smaller."""
    stride = _stride(array, longest)
    if stride == 1:
        return array
    starts = [np.arange(0, side, stride) for side in array.shape]
    return np.maximum.reduceat(np.maximum.reduceat(array, starts[0], axis=0), starts[1], axis=1)
