"""Rows of many scan files: one JSON line for each, whatever happens in between.

    python3 -m mems_stiction.archive --config part.yaml --shard 3/16 -o rows/shard_0003.jsonl --inputs-from scans.txt

A row is the record of predict_scan --json without its time, so that the same scan gives the same row, with `number` (of the
scan in the list, from 1), `reason`: empty, or why there is no prediction, and the state of the file that it is of: its size,
time and checksum, and those of the files that belong to it. Rows are written as they come; the same call again goes on with
the scans that have none, and with those whose files have changed since. Beside them FILE.settings.yaml holds the settings, which must stay the same.
scripts/examples/predict_dask.py and predict_array.sbatch spread an archive over a cluster with it.
"""

from __future__ import annotations

import argparse
import collections
import json
import os
import pathlib
import sys
import warnings
from typing import Any, Deque, Dict, Iterable, Iterator, List, Sequence, Tuple

from mems_stiction import _core
from mems_stiction._prediction import predict_many
from mems_stiction._settings import Error, OptionsError, Settings
from mems_stiction._warnings import ScanWarning
from mems_stiction.input_file import UnfitFile, is_open_pipe, require_file

BAD_INPUT = 2
MOST_LIST_BYTES = 100000000
Numbered = Tuple[int, str]


def numbered(paths: Sequence[str]) -> List[Numbered]:
    """Absolute paths with their numbers. Links are not followed: what lies beside a link, such as the settings of its scan, need not lie
    beside the file that it leads to."""
    return [(number, os.path.abspath(path)) for number, path in enumerate(paths, 1)]


def rows_of(scans: Iterable[Numbered], settings: Settings, workers: int = 1) -> Iterator[Dict[str, Any]]:
    """The row of each scan, in order, on so many threads."""
    kept = list(scans)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ScanWarning)  # rows have them
        states: Deque[Dict[str, Any]] = collections.deque()
        settings_files = _core.settings_file_checksum(settings._configuration)

        def paths() -> Iterator[str]:
            for _, path in kept:
                states.append(_core.scan_state(path, settings_files))  # before it is read: what changes in between shows next time
                yield path

        results = predict_many(paths(), config=settings, workers=workers, errors="return")
        for (number, path), result in zip(kept, results):
            row = {"number": number, "file": path, "reason": " ".join(str(result).split()) if isinstance(result, Error) else ""}
            if not isinstance(result, Error):
                row.update({name: value for name, value in result.to_dict().items() if name not in ("file", "processing_time", "reason")})
                row["warnings"] = "; ".join(result.warnings)
                if result.verdict is not None:
                    row["verdict_reason"] = result.verdict.reason
            row.update(states.popleft())
            yield row


def _change(row: Dict[str, Any], now: Dict[str, Any], rows: pathlib.Path) -> str:
    """What has changed since the row was written; a file that is no longer there has not: its row is all that is left of it."""
    if "file_checksum" not in row:
        raise OptionsError("%s: row %d does not say which state of its file it is of (no file_checksum): rows of an earlier version; "
                           "give another name, or remove it" % (rows, row["number"]))
    changed = [name for name in now if name.endswith("checksum") and row.get(name) != now[name]] if now["file_checksum"] else []
    return ", ".join("%s is %s, was %s" % (name, now[name] or "none", row.get(name) or "none") for name in changed)


class RowFile:
    """The rows of a call, and of those that it goes on from."""

    def __init__(self, path: str, settings: Settings) -> None:
        self.path = pathlib.Path(path)
        self._settings = settings
        self.path.parent.mkdir(parents=True, exist_ok=True)
        beside = pathlib.Path(path + ".settings.yaml")
        if self.path.exists() and (not beside.exists() or beside.read_text(encoding="utf-8") != settings.yaml()):
            raise OptionsError("%s: holds rows of other settings; give another name, or remove it" % path)
        beside.write_text(settings.yaml(), encoding="utf-8")
        text = self.path.read_text(encoding="utf-8") if self.path.exists() else ""
        whole = text[:text.rfind("\n") + 1]  # a call that was killed may have left half a line
        self.rows = {row["number"]: row for row in map(json.loads, whole.splitlines())}
        if whole != text:
            self.path.write_text(whole, encoding="utf-8")

    def missing(self, scans: Sequence[Numbered]) -> List[Numbered]:
        """The scans that have no row yet, or one of a file that has changed since, which is said. Raises OptionsError if a row is of
        another scan, or does not say which state of its file it is of."""
        settings_files = _core.settings_file_checksum(self._settings._configuration)
        wanted = []
        for number, path in scans:
            if number in self.rows and self.rows[number]["file"] != path:
                raise OptionsError("%s: row %d is of %s, not of %s; give another name, or the same scans" % (
                    self.path, number, self.rows[number]["file"], path))
            if number in self.rows:
                change = _change(self.rows[number], _core.scan_state(path, settings_files), self.path)
                if not change:
                    continue
                print("%s: has changed since its row %d was written, predicted again: %s" % (path, number, change), file=sys.stderr)
            wanted.append((number, path))
        return wanted

    def add(self, rows: Iterable[Dict[str, Any]]) -> Iterator[Dict[str, Any]]:
        """Writes each row as it comes, and passes it on."""
        with open(str(self.path), "a", encoding="utf-8") as stream:
            for row in rows:
                self.rows[row["number"]] = row
                stream.write(json.dumps(row) + "\n")
                stream.flush()
                yield row

    def finish(self) -> str:
        """Puts the rows into the order of the scans. Returns a line on them."""
        ordered = [self.rows[number] for number in sorted(self.rows)]
        partial = self.path.with_name(self.path.name + ".partial")
        partial.write_text("".join(json.dumps(row) + "\n" for row in ordered), encoding="utf-8")
        os.replace(str(partial), str(self.path))
        return "%d rows, %d of them with a reason why there is no prediction: %s" % (
            len(ordered), sum(bool(row["reason"]) for row in ordered), self.path)


def _listed(path: str) -> List[str]:
    """The lines of a file. Raises OptionsError for a device, a pipe of its own or a file without end."""
    try:
        if path != os.devnull and not is_open_pipe(path):
            require_file(path, "a list of scans", MOST_LIST_BYTES)
    except UnfitFile as error:
        raise OptionsError("%s: %s" % (path, error))
    return pathlib.Path(path).read_text(encoding="utf-8").splitlines()


def _shard(text: str) -> Tuple[int, int]:
    index, _, count = text.partition("/")
    if not (index.isdigit() and count.isdigit() and 1 <= int(index) <= int(count)):
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be I/N with 1 <= I <= N" % text)
    return int(index), int(count)


def main() -> int:
    parser = argparse.ArgumentParser(prog="mems_stiction.archive", description="One row for each scan file.")
    parser.add_argument("scans", nargs="*", metavar="SCAN")
    parser.add_argument("--inputs-from", metavar="FILE", help="more scans, one on a line")
    parser.add_argument("-o", "--output", required=True, metavar="ROWS.jsonl")
    parser.add_argument("-c", "--config", metavar="FILE.yaml")
    parser.add_argument("--shard", type=_shard, default=(1, 1), metavar="I/N", help="every N-th scan, from the I-th on")
    parser.add_argument("--workers", type=int, default=1, help="threads (1)")
    arguments = parser.parse_args()
    try:
        paths = list(arguments.scans)
        if arguments.inputs_from:
            paths += _listed(arguments.inputs_from)
        settings = Settings(arguments.config)
        rows = RowFile(arguments.output, settings)
        index, count = arguments.shard
        for _ in rows.add(rows_of(rows.missing(numbered(paths)[index - 1::count]), settings, arguments.workers)):
            pass
        print(rows.finish())
    except (Error, OSError, ValueError) as error:
        print("mems_stiction.archive: %s" % " ".join(str(error).split()), file=sys.stderr)
        return BAD_INPUT
    return 0


if __name__ == "__main__":
    sys.exit(main())
