"""Bags that a script is given: what is none, was cut off, or is damaged inside, is said in one
sentence."""

import contextlib
import re
import struct

import genpy
import rosbag
from mems_stiction.input_file import UnfitFile, require_file

MAGIC = b"#ROSBAG V2.0\n"


class BagError(Exception):
    """Which bag cannot be read, and why."""


def _require_magic(path):
    """Of something else rosbag would take all for the first line."""
    with open(path, "rb") as stream:
        begin = stream.read(len(MAGIC))
    if begin != MAGIC:
        raise UnfitFile("is not a bag" if begin else "is empty")


def _index_place(path):
    """Where a bag says that its index begins, behind all messages; 0 where it does not say it, or
    ends before."""
    with open(path, "rb") as stream:
        begin = stream.read(4096)
        size = stream.seek(0, 2)
    found = re.search(b"index_pos=(.{8})", begin, re.DOTALL)
    place = struct.unpack("<Q", found.group(1))[0] if found else 0
    return place if place <= size else 0


@contextlib.contextmanager
def opened_bag(path):
    """rosbag.Bag(path) to read; also what goes wrong while it is read becomes a BagError."""
    try:
        require_file(path, "a bag")
        _require_magic(path)
        with rosbag.Bag(path) as bag:
            yield bag
    except FileNotFoundError:
        raise BagError("%s cannot be read: no such file" % path)
    except rosbag.ROSBagUnindexedException:
        place = _index_place(path)
        if place:  # rosbag reindex would take nothing of it
            raise BagError(
                "%s cannot be read: was cut off inside its index; truncate -s %d %s and then "
                "rosbag reindex %s mend it" % (path, place, path, path)
            )
        raise BagError(
            "%s cannot be read: was cut off, or is still being recorded; rosbag reindex %s mends it"
            % (path, path)
        )
    except UnfitFile as error:
        raise BagError("%s cannot be read: %s" % (path, error))
    except UnicodeDecodeError:  # of a name in it
        raise BagError("%s cannot be read: is not a bag, or damaged" % path)
    except (OSError, rosbag.ROSBagException) as error:
        raise BagError("%s cannot be read: %s" % (path, error))


def messages_of(bag, **options):
    """bag.read_messages(). Raises BagError at the first message that is damaged."""
    messages = bag.read_messages(**options)
    while True:
        try:
            found = next(messages)
        except StopIteration:
            return
        except (
            genpy.MessageException,
            rosbag.ROSBagException,
            struct.error,
            KeyError,
            ValueError,
        ) as error:
            raise BagError(
                "%s cannot be read: a message in it is damaged (%s)" % (bag.filename, error)
            )
        yield found
