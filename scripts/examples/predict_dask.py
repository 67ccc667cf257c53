#!/usr/bin/env python3
"""An archive of scan files over the workers of a Dask cluster, through the Python module: a row for each scan.

usage: predict_dask.py [--config FILE.yaml] [--workers N | --scheduler HOST:PORT] -o ROWS.jsonl SCAN...

Without --scheduler the workers are processes of this machine. With one, workers must see the same folders and have
mems_stiction installed. A worker that dies loses the scans that it was at; others take them. Called again after an
interruption it goes on with the scans that have no row. For bags: batch_dask.py.
"""

import argparse
import sys

import mems_stiction
from mems_stiction.archive import BAD_INPUT, RowFile, numbered, rows_of


def predict_part(scans, settings):
    """Runs on a worker."""
    return list(rows_of(scans, settings))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scans", nargs="+", metavar="SCAN")
    parser.add_argument("-o", "--output", required=True, metavar="ROWS.jsonl")
    parser.add_argument("-c", "--config", metavar="FILE.yaml")
    parser.add_argument("--workers", type=int, default=2, help="on this machine (2)")
    parser.add_argument("--scheduler", metavar="HOST:PORT", help="of a cluster that runs already")
    parser.add_argument("--part", type=int, default=8, metavar="N", help="scans that a worker gets at a time (8)")
    arguments = parser.parse_args()

    from distributed import Client, KilledWorker, LocalCluster, as_completed

    cluster = None
    try:
        settings = mems_stiction.Settings(arguments.config)
        rows = RowFile(arguments.output, settings)
        missing = rows.missing(numbered(arguments.scans))
        parts = [missing[first:first + arguments.part] for first in range(0, len(missing), arguments.part)]
        if not arguments.scheduler:
            cluster = LocalCluster(n_workers=arguments.workers, threads_per_worker=1, dashboard_address=None)
        with Client(arguments.scheduler or cluster) as client:
            futures = client.map(predict_part, parts, settings=settings, pure=False, retries=2)
            for done, future in enumerate(as_completed(futures), 1):
                for _ in rows.add(future.result()):
                    pass
                print("%d of %d parts" % (done, len(parts)), file=sys.stderr, flush=True)
        print(rows.finish())
    except (mems_stiction.Error, KilledWorker, OSError) as error:
        print("predict_dask: %s" % " ".join(str(error).split()), file=sys.stderr)
        return BAD_INPUT
    finally:
        if cluster is not None:
            cluster.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
