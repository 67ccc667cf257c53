"""python3 -m paper [options]: predicts, draws, writes the page. studies/reproduce_paper calls
it."""

import argparse
import json
import os
import pathlib
import shutil
import sys
import time

from paper import cases, page
from paper.version import version

SECONDS_BETWEEN_LINES = 30  # of progress, where it does not go to a terminal


class Progress:
    """Predictions done and the time left: in place on a terminal, a line now and then elsewhere."""

    def __init__(self, total):
        from tqdm import tqdm

        self._bar = tqdm(
            total=total, desc="predictions", unit="", disable=not sys.stderr.isatty(), leave=False
        )
        self._total, self._done, self._started = total, 0, time.monotonic()
        self._said = self._started

    def step(self):
        self._done += 1
        self._bar.update(1)
        now = time.monotonic()
        if self._bar.disable and now - self._said > SECONDS_BETWEEN_LINES:
            self._said = now
            print(
                "predictions: %d of %d (%d s)" % (self._done, self._total, now - self._started),
                flush=True,
            )

    def close(self):
        self._bar.close()
        return time.monotonic() - self._started


def parse():
    parser = argparse.ArgumentParser(
        prog="reproduce_paper", description="Figures like the paper's, and the page around them."
    )
    parser.add_argument(
        "--seeds",
        type=int,
        metavar="N",
        help="pairs of surfaces per point of figures 6 and 7 (12; quick: 3)",
    )
    parser.add_argument(
        "--size",
        type=int,
        metavar="N",
        help="rows and columns of their surfaces (1024; quick: 256)",
    )
    parser.add_argument(
        "--jobs",
        type=int,
        default=os.cpu_count(),
        metavar="N",
        help="surfaces at the same time (all processors)",
    )
    parser.add_argument(
        "--quick", action="store_true", help="a trial of a few seconds: few, small surfaces"
    )
    parser.add_argument(
        "--doc",
        type=pathlib.Path,
        metavar="FOLDER",
        help="where paper.md and figures/ go (doc; with --quick, --seeds or --size out/paper)",
    )
    parser.add_argument(
        "--work",
        type=pathlib.Path,
        default=cases.REPOSITORY / "out" / "paper",
        metavar="FOLDER",
        help="for what the core returns (out/paper)",
    )
    parser.add_argument(
        "--redraw", action="store_true", help="figures and page from the results of the last run"
    )
    arguments = parser.parse_args()
    for name, lowest in (("seeds", 2), ("size", 64), ("jobs", 1)):
        value = getattr(arguments, name)
        if value is not None and value < lowest:
            parser.error("--%s: %d is not allowed, must be >= %d" % (name, value, lowest))
    arguments.is_trial = (
        arguments.quick or arguments.seeds is not None or arguments.size is not None
    )
    if arguments.seeds is None:
        arguments.seeds = 3 if arguments.quick else 12
    if arguments.size is None:
        arguments.size = 256 if arguments.quick else 1024
    return arguments


def predict(arguments):
    study = cases.Study(arguments.seeds, arguments.size, arguments.quick)
    dump = arguments.work / "dump"
    shutil.rmtree(dump, ignore_errors=True)
    pairs = cases.all_pairs(study, dump)
    sources = version()  # now: a long run may outlive a commit
    progress = Progress(sum(len(pair["cases"]) for pair in pairs))
    results = cases.run(pairs, arguments.jobs, progress.step)
    seconds = progress.close()
    record = {
        "seeds": arguments.seeds,
        "size": arguments.size,
        "quick": arguments.quick,
        "trial": arguments.is_trial,
        "jobs": arguments.jobs,
        "seconds": seconds,
        "predictions": len(results),
        "version": sources,
        "results": results,
    }
    (arguments.work / "results.json").write_text(json.dumps(record))
    return record


def main():
    arguments = parse()
    arguments.work.mkdir(parents=True, exist_ok=True)
    if arguments.redraw:
        record = json.loads((arguments.work / "results.json").read_text())
    else:
        record = predict(arguments)
    study = cases.Study(record["seeds"], record["size"], record["quick"])
    doc = arguments.doc or (arguments.work if record["trial"] else cases.REPOSITORY / "doc")
    (doc / "figures").mkdir(parents=True, exist_ok=True)
    page.write(study, record, arguments.work / "dump", doc)
    print("page: %s" % (doc / "paper.md"))


if __name__ == "__main__":
    main()
