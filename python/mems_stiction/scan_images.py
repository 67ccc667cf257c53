"""Image messages of scans and maps as arrays: rows x columns, row 0 the top."""

import numpy as np

PIXEL_TYPES = {
    "32FC1": "f4",
    "64FC1": "f8",
    "16UC1": "u2",
    "mono16": "u2",
    "16SC1": "i2",
    "mono8": "u1",
    "8UC1": "u1",
}


def pixels(image):
    """rows x columns, whatever the row length in bytes and the byte order; the first channel of
    32FC2. Raises ValueError that says what is wrong with the message."""
    if image.encoding not in PIXEL_TYPES and image.encoding != "32FC2":
        raise ValueError(
            "encoding '%.40s' is not allowed, must be one of 32FC2, %s"
            % (image.encoding, ", ".join(PIXEL_TYPES))
        )
    channels = 2 if image.encoding == "32FC2" else 1
    kind = np.dtype("f4" if channels == 2 else PIXEL_TYPES[image.encoding]).newbyteorder(
        ">" if image.is_bigendian else "<"
    )
    row = image.width * channels * kind.itemsize
    if image.height == 0 or image.width == 0:
        raise ValueError(
            "size %d x %d is not allowed, must be one pixel at least" % (image.height, image.width)
        )
    if image.step < row:
        raise ValueError(
            "step %d is not allowed for %d columns of %s, must be >= %d bytes"
            % (image.step, image.width, image.encoding, row)
        )
    if len(image.data) != image.height * image.step:
        raise ValueError(
            "data has %d bytes, must have step %d x height %d"
            % (len(image.data), image.step, image.height)
        )
    lines = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
    used = np.ascontiguousarray(lines[:, :row])
    return used.view(kind)[:, ::channels]
