"""stiction_batch where Python is: one row for each scan of an archive, shards, and their merge.

    python3 -m mems_stiction.archive --config part.yaml --shard 3/16 -o shard_0003.jsonl
    --inputs-from scans.txt

Options, rows and exit status are the program's. pip installs it as stiction_batch too, so that the
examples for clusters, scripts/examples/batch_dask.py and batch_array.sbatch, find it; it reads bags
if it was built with ROS.
"""

from __future__ import annotations

import importlib.util
import os
import pathlib
import sys

NAME = "stiction_batch"


def program() -> str:
    """Its path: beside the compiled part of the module as pip leaves it, where a build without
    catkin puts it, or one with it."""
    spec = importlib.util.find_spec("mems_stiction._core")
    if spec is None or spec.origin is None:
        raise FileNotFoundError(
            "mems_stiction has no compiled part: build or install it first (doc/python.md)"
        )
    folder = pathlib.Path(spec.origin).resolve().parent
    places = [folder / NAME, folder.parents[1] / NAME, folder.parents[2] / "mems_stiction" / NAME]
    for place in places:
        if place.is_file() and os.access(str(place), os.X_OK):
            return str(place)
    raise FileNotFoundError("%s is in none of its places: %s" % (NAME, ", ".join(map(str, places))))


def main() -> int:
    """Becomes the program, so that signals and status are its own."""
    try:
        path = program()
        os.execv(path, [path] + sys.argv[1:])
    except OSError as error:
        print("mems_stiction.archive: %s" % error, file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
