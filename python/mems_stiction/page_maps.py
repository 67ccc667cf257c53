"""The maps of the station's page: PNGs of the newest scan, and where contacts are that are too small to be seen."""

import io

import numpy as np
from PIL import Image
from scipy import ndimage

from mems_stiction.scan_images import pixels

LONGEST = 512  # pixels of a map's longer side
SMALL_CONTACT_SHARE = 3e-4  # of the frame: ringed, or nobody sees them
MOST_RINGS = 300
NOT_MEASURED = (0x6d, 0x4a, 0x6d)
REGIME_COLOURS = ((0, 0, 0), (0x2f, 0x9b, 0xff), (0xff, 0xd2, 0x3f), (0xff, 0x4d, 0x4d))  # apart, elastic, elasto-plastic, plastic


def png_of(shown, palette, transparent=None):
    """A PNG of indices into a palette of (red, green, blue)."""
    image = Image.fromarray(np.ascontiguousarray(shown, dtype=np.uint8), mode="P")
    image.putpalette([channel for colour in palette for channel in colour])
    stream = io.BytesIO()
    image.save(stream, format="PNG", **({} if transparent is None else {"transparency": transparent}))
    return stream.getvalue()


def height_png(message):
    """The topic preview: 1 to 255 from low to high, 0 not measured."""
    from matplotlib import cm  # slow to import: not before the subscriptions

    colours = (255 * cm.viridis(np.linspace(0, 1, 255))[:, :3]).round().astype(int).tolist()
    return png_of(thinned(pixels(message)), [NOT_MEASURED] + colours)


def contact_png(message):
    """The topic contact_map: contacts in the colours of their regimes, transparent where the surfaces are apart."""
    return png_of(np.minimum(severest(pixels(message)), 3), REGIME_COLOURS, transparent=0)


def rings(message):
    """[x, y, regime] of the small contacts, the largest first; x and y as shares of width and height."""
    regimes = severest(pixels(message))
    labels, count = ndimage.label(regimes)
    if not count:
        return []
    every = np.arange(1, count + 1)
    areas = ndimage.sum(np.ones_like(labels), labels, every)
    small = every[areas < SMALL_CONTACT_SHARE * regimes.size]
    small = small[np.argsort(-areas[small - 1], kind="stable")][:MOST_RINGS]
    rows, columns = regimes.shape
    return [[(column + 0.5) / columns, (row + 0.5) / rows, int(regime)] for (row, column), regime in zip(
        ndimage.center_of_mass(regimes > 0, labels, small), ndimage.maximum(regimes, labels, small))]


def _stride(array):
    return -(-max(array.shape) // LONGEST)


def thinned(array):
    """Every n-th row and column, so that the longer side fits."""
    stride = _stride(array)
    return array[::stride, ::stride]


def severest(array):
    """The largest value of each block of pixels: no contact is lost where a map is made smaller."""
    stride = _stride(array)
    if stride == 1:
        return array
    starts = [np.arange(0, side, stride) for side in array.shape]
    return np.maximum.reduceat(np.maximum.reduceat(array, starts[0], axis=0), starts[1], axis=1)
