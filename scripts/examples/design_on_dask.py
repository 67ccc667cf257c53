#!/usr/bin/env python3
"""A sweep of a design over the workers of a Dask cluster: a task for each force.

usage: design_on_dask.py --axis NAME=FROM:TO:COUNT [--axis NAME=FROM:TO:COUNT] [--config FILE.yaml]
[--pitch M]
                         [--workers N | --scheduler HOST:PORT] -o ROWS.csv [--picture OUT.png]
                         SCAN...

Without --scheduler the workers run on this machine. With one, they must have mems_stiction
installed; the scans are sent to them.
A point whose worker dies goes to another. Called again after an interruption, it goes on after the
rows that are there. The rows are those of the program design_sweep.
"""

import argparse
import sys


def positive(text):
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be a whole number > 0" % text)
    return int(text)


def axis(text):
    name, _, values = text.partition("=")
    try:
        first, last, count = values.split(":")
        return name, (float(first), float(last), int(count))
    except ValueError:
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be NAME=FROM:TO:COUNT" % text)


def show_progress(share):
    print("%.0f %%" % (100 * share), file=sys.stderr, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument(
        "scans",
        nargs="+",
        metavar="SCAN",
        help="of the device's surface, as predict_device takes them",
    )
    parser.add_argument(
        "--axis",
        action="append",
        type=axis,
        required=True,
        metavar="NAME=FROM:TO:COUNT",
        help="a setting and its values; once or twice",
    )
    parser.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="ROWS.csv",
        help="the rows, as they come; goes on after those of the same sweep",
    )
    parser.add_argument(
        "--picture", metavar="OUT.png", help="the margin over the axes, .png, .pdf or .svg"
    )
    parser.add_argument(
        "-c", "--config", metavar="FILE.yaml", help="materials, interface, device, cleaning"
    )
    parser.add_argument(
        "-p", "--pitch", type=float, metavar="M", help="of scans that do not say it"
    )
    parser.add_argument("--workers", type=positive, default=2, help="on this machine (2)")
    parser.add_argument("--scheduler", metavar="HOST:PORT", help="of a cluster that runs already")
    arguments = parser.parse_args()

    from distributed import Client, KilledWorker, LocalCluster

    import mems_stiction

    cluster = None
    try:
        if not arguments.scheduler:
            cluster = LocalCluster(
                n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None
            )
        with Client(arguments.scheduler or cluster) as client:
            found = mems_stiction.design_sweep(
                arguments.scans,
                arguments.pitch,
                arguments.config,
                axes=dict(arguments.axis),
                output=arguments.output,
                on_progress=show_progress,
                executor=client.get_executor(pure=False, retries=2),
            )
    except (KilledWorker, OSError, mems_stiction.Error) as error:
        print("design_on_dask: %s" % error, file=sys.stderr)
        return 2
    finally:
        if cluster is not None:
            cluster.close()
    print(found)
    if arguments.picture:
        found.save_picture(arguments.picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
