"""Image messages of scans and maps as arrays: rows x columns, row 0 the top."""

import numpy as np

PIXEL_TYPES = {"32FC1": "f4", "64FC1": "f8", "16UC1": "u2", "mono16": "u2", "16SC1": "i2", "mono8": "u1", "8UC1": "u1"}


def pixels(image):
    """rows x columns, whatever the row length in bytes and the byte order; the first channel of 32FC2."""
    channels = 2 if image.encoding == "32FC2" else 1
    kind = np.dtype("f4" if channels == 2 else PIXEL_TYPES[image.encoding]).newbyteorder(">" if image.is_bigendian else "<")
    lines = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
    used = np.ascontiguousarray(lines[:, :image.width * channels * kind.itemsize])
    return used.view(kind)[:, ::channels]
