"""Bags that a script is given: what is none, or was cut off, is said in one sentence."""

import contextlib
import os

import rosbag


class BagError(Exception):
    """Which bag cannot be read, and why."""


@contextlib.contextmanager
def opened_bag(path):
    """rosbag.Bag(path) to read; also what goes wrong while it is read becomes a BagError."""
    if os.path.isdir(path):
        raise BagError("%s cannot be read: is a folder, not a bag" % path)
    try:
        with rosbag.Bag(path) as bag:
            yield bag
    except FileNotFoundError:
        raise BagError("%s cannot be read: no such file" % path)
    except rosbag.ROSBagUnindexedException:
        raise BagError("%s cannot be read: was cut off, or is still being recorded; rosbag reindex %s mends it" % (path, path))
    except UnicodeDecodeError:  # of the first line, where a bag says that it is one
        raise BagError("%s cannot be read: is not a bag, or damaged" % path)
    except (OSError, rosbag.ROSBagException) as error:
        raise BagError("%s cannot be read: %s" % (path, error))
