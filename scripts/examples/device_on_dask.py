#!/usr/bin/env python3
"""The force of one device of any size, its surface made and summed strip by strip by the workers of
a Dask cluster.

usage: device_on_dask.py --area M2 [--contacts N] [--config FILE.yaml] [--pitch M] [--seed N]
[--realisation N] [--depth M]
                         [--workers N | --scheduler HOST:PORT] [--strips N] SCAN...

Prints one JSON object: what holds the surface of this seed, the same bits on any cluster. Without
--scheduler the workers run on this machine. With one, they must have mems_stiction installed; the
scans are sent to them, once, and the surface is made there.
A strip whose worker dies goes to another. 10^10 pixels take about 6 minutes of one processor.
"""

import argparse
import json
import sys


def cells(surface, first_row, rows):
    """A task."""
    return surface.cells(first_row, rows)


def positive(text):
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be a whole number > 0" % text)
    return int(text)


def arrived(futures):
    """What tasks answer, in the order in which they end, each let go of at once."""
    from distributed import as_completed

    for done, future in enumerate(as_completed(futures), 1):
        yield future.result()
        future.release()
        print("%d of %d strips" % (done, len(futures)), file=sys.stderr, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument(
        "scans",
        nargs="+",
        metavar="SCAN",
        help="of the device's surface, as predict_device takes them",
    )
    parser.add_argument(
        "-a",
        "--area",
        type=float,
        metavar="M2",
        help="of all contacts together; else device/contact_area",
    )
    parser.add_argument(
        "--contacts", type=positive, metavar="N", help="that share it; else device/contacts"
    )
    parser.add_argument(
        "-c", "--config", metavar="FILE.yaml", help="materials, interface, device, cleaning"
    )
    parser.add_argument(
        "-p", "--pitch", type=float, metavar="M", help="of scans that do not say it"
    )
    parser.add_argument("--seed", type=int, help="else device_force/seed")
    parser.add_argument("--realisation", type=int, default=0, help="which surface of the seed (0)")
    parser.add_argument(
        "--depth",
        type=float,
        metavar="M",
        help="of the cells that are sent; only where it is asked for",
    )
    parser.add_argument("--workers", type=positive, default=2, help="on this machine (2)")
    parser.add_argument("--scheduler", metavar="HOST:PORT", help="of a cluster that runs already")
    parser.add_argument("--strips", type=positive, help="sixteen for each worker if not given")
    arguments = parser.parse_args()

    from distributed import Client, KilledWorker, LocalCluster

    import mems_stiction

    cluster = None
    try:
        surface = mems_stiction.MadeSurface(
            arguments.scans,
            arguments.pitch,
            arguments.config,
            area=arguments.area,
            contacts=arguments.contacts,
            seed=arguments.seed,
            realisation=arguments.realisation,
            depth=arguments.depth,
        )
        if not arguments.scheduler:
            cluster = LocalCluster(
                n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None
            )
        with Client(arguments.scheduler or cluster) as client:
            workers = len(client.scheduler_info()["workers"])
            shared = client.scatter(
                surface, broadcast=True, hash=False
            )  # made again from its scans and its seed
            futures = [
                client.submit(cells, shared, first_row, rows, pure=False, retries=2)
                for first_row, rows in surface.strips(arguments.strips or 16 * max(workers, 1))
            ]
            found = surface.adhesion(arrived(futures))
    except (KilledWorker, OSError, mems_stiction.Error) as error:
        print("device_on_dask: %s" % error, file=sys.stderr)
        return 2
    finally:
        if cluster is not None:
            cluster.close()
    print(
        json.dumps(
            dict(
                {name: found[name].item() for name in found.dtype.names},
                rows=surface.rows,
                cols=surface.cols,
                pitch=surface.pitch,
            )
        )
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
