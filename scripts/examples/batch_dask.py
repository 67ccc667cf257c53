#!/usr/bin/env python3
"""An archive of bags and scan files over the workers of a Dask cluster: shards by stiction_batch,
joined at the end.

usage: batch_dask.py [--config FILE.yaml] [--workers N | --scheduler HOST:PORT] [--shards N] -o
ROWS.csv BAG|SCAN...

Without --scheduler the workers run on this machine. With one, workers must see the same folders and
have stiction_batch on their PATH, from ROS or from pip. A shard whose worker dies goes to another,
which goes on where it was; so does every shard when this is called again after an interruption.
"""

import argparse
import ctypes
import os
import pathlib
import signal
import subprocess
import sys


NONE_PREDICTED = 1  # every scan of the shard has its row, with a reason
DIE_WITH_PARENT = 1  # PR_SET_PDEATHSIG of Linux


def run_shard(command):
    """One shard, in a process of its own; its last line. It ends with its worker: two must not
    write one file."""

    def die_with_worker():
        ctypes.CDLL(None).prctl(DIE_WITH_PARENT, signal.SIGKILL)

    done = subprocess.run(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        preexec_fn=die_with_worker,
    )
    if done.returncode not in (0, NONE_PREDICTED):
        raise RuntimeError(
            done.stderr.strip() or "stiction_batch ended with status %d" % done.returncode
        )
    return done.stdout.strip()


def positive(text):
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be a whole number > 0" % text)
    return int(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument(
        "inputs",
        nargs="+",
        metavar="BAG|SCAN",
        help="bags, and files of every kind that predict_scan reads",
    )
    parser.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="ROWS.csv|ROWS.jsonl",
        help="the rows of all shards, those of one run",
    )
    parser.add_argument(
        "-c", "--config", metavar="FILE.yaml", help="materials, interface, device, cleaning"
    )
    parser.add_argument("--workers", type=positive, default=2, help="on this machine (2)")
    parser.add_argument("--scheduler", metavar="HOST:PORT", help="of a cluster that runs already")
    parser.add_argument("--shards", type=positive, help="four for each worker if not given")
    arguments = parser.parse_args()

    from distributed import Client, KilledWorker, LocalCluster, as_completed

    output = pathlib.Path(os.path.abspath(arguments.output))
    count = arguments.shards or 4 * arguments.workers
    shards = [
        "%s.shard_%04d%s" % (output.with_suffix(""), index, output.suffix)
        for index in range(1, count + 1)
    ]
    # Absolute, since workers stand in other folders. Links are not followed: a scan's settings lie
    # beside its link.
    inputs = [os.path.abspath(path) for path in arguments.inputs]
    settings = ["--config", os.path.abspath(arguments.config)] if arguments.config else []
    commands = [
        ["stiction_batch", "--shard", "%d/%d" % (index, count), "-o", shard]
        + settings
        + ["--"]
        + inputs
        for index, shard in enumerate(shards, 1)
    ]

    cluster = None
    if not arguments.scheduler:
        # Threads suffice: each runs a program and waits for it.
        cluster = LocalCluster(
            n_workers=arguments.workers,
            threads_per_worker=1,
            processes=False,
            dashboard_address=None,
        )
    try:
        with Client(arguments.scheduler or cluster) as client:
            futures = client.map(run_shard, commands, pure=False, retries=2)
            for done, future in enumerate(as_completed(futures), 1):
                future.result()
                print("%d of %d shards" % (done, count), file=sys.stderr, flush=True)
    except (KilledWorker, OSError, RuntimeError) as error:
        print("batch_dask: %s" % error, file=sys.stderr)
        return 2
    finally:
        if cluster is not None:
            cluster.close()
    print(run_shard(["stiction_batch", "--merge", "-o", str(output)] + shards))
    return 0


if __name__ == "__main__":
    sys.exit(main())
