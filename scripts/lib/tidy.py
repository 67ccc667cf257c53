#!/usr/bin/env python3
"""Runs clang-tidy over the sources below src, side by side, and prints what it finds, each finding
once.

usage: tidy.py [--jobs N] [--progress FILE] BUILD-FOLDER

BUILD-FOLDER holds compile_commands.json. A source is not checked again as long as nothing has
changed of: clang-tidy's version and .clang-tidy, its compile command, its text, and every header
that it reaches in the repository and in the build folder. Headers of other packages are not looked
at: after an upgrade of those, delete BUILD-FOLDER/tidy. FILE gets a line for each source that is
done. Exit status: 0 clean, 1 findings, 2 it could not run.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]', re.MULTILINE)
FINDING = re.compile(r"^(/[^:\n]+):\d+:\d+: (?:fatal )?(?:error|warning): ", re.MULTILINE)
SLOW_FIRST = ("ros", "tools", "preprocess")  # so that no core idles at the end


class Source:
    def __init__(self, command):
        self.path = pathlib.Path(command["file"])
        self.command = command["command"]
        # without -isystem: those folders belong to others
        self.folders = [
            pathlib.Path(word[2:]) for word in shlex.split(self.command) if word.startswith("-I")
        ]

    @property
    def name(self):
        return str(self.path.relative_to(REPOSITORY))


def sources_of(build):
    """One for each file below src, the slow folders first; a file that several targets compile
    counts once."""
    found = {}
    for command in json.loads((build / "compile_commands.json").read_text()):
        path = pathlib.Path(command["file"])
        if REPOSITORY / "src" in path.parents and path.exists():
            found.setdefault(path, Source(command))
    return sorted(
        found.values(),
        key=lambda source: (
            source.path.parts[len(REPOSITORY.parts) + 1] not in SLOW_FIRST,
            source.name,
        ),
    )


class Texts:
    """Digests of files and the includes in them, each read once."""

    def __init__(self):
        self._known = {}

    def _read(self, path):
        if path not in self._known:
            data = path.read_bytes()
            self._known[path] = (
                hashlib.sha256(data).hexdigest(),
                INCLUDE.findall(data.decode(errors="replace")),
            )
        return self._known[path]

    def digests(self, source):
        """Of the source and of all that it reaches, by path."""
        reached, waiting = {}, [source.path]
        while waiting:
            path = waiting.pop()
            if path in reached:
                continue
            reached[path], includes = self._read(path)
            for include in includes:
                candidates = (
                    pathlib.Path(os.path.normpath(str(folder / include)))
                    for folder in [path.parent, *source.folders]
                )
                waiting.extend(
                    list(candidate for candidate in candidates if candidate.is_file())[:1]
                )
        return sorted((str(path), digest) for path, digest in reached.items())


def key_of(source, texts, tool):
    return hashlib.sha256(
        json.dumps([tool, source.command, texts.digests(source)]).encode()
    ).hexdigest()


def findings_of(text):
    """The findings in clang-tidy's output, with their notes; paths as seen from the repository."""
    starts = [match.start() for match in FINDING.finditer(text)]
    blocks = [text[start:end].rstrip() for start, end in zip(starts, starts[1:] + [len(text)])]
    return [block.replace(str(REPOSITORY) + "/", "") for block in blocks]


def run(source, build):
    done = subprocess.run(
        ["clang-tidy", "--quiet", "-p", str(build), str(source.path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
        universal_newlines=True,
    )
    findings = findings_of(done.stdout)
    if done.returncode and not findings:
        findings = [
            "%s: clang-tidy ended with %d\n%s%s"
            % (source.name, done.returncode, done.stdout, done.stderr)
        ]
    return findings


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD-FOLDER")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument(
        "--progress", type=pathlib.Path, default=pathlib.Path(os.devnull), metavar="FILE"
    )
    arguments = parser.parse_args()

    build = arguments.build.resolve()
    sources = sources_of(build)
    if not sources:
        print("%s names no source of this clone" % (build / "compile_commands.json"))
        return 2
    version = subprocess.run(
        ["clang-tidy", "--version"], stdout=subprocess.PIPE, check=True, universal_newlines=True
    ).stdout
    tool, texts = [version, (REPOSITORY / ".clang-tidy").read_text()], Texts()
    keys = {source: key_of(source, texts, tool) for source in sources}
    record = build / "tidy" / "clean.json"
    record.parent.mkdir(exist_ok=True)
    clean = json.loads(record.read_text()) if record.exists() else {}
    waiting = [source for source in sources if clean.get(source.name) != keys[source]]
    clean = {source.name: keys[source] for source in sources if source not in waiting}

    findings = set()
    with (
        arguments.progress.open("w", buffering=1) as progress,
        concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool,
    ):
        runs = {pool.submit(run, source, build): source for source in waiting}
        for count, done in enumerate(concurrent.futures.as_completed(runs), 1):
            source = runs[done]
            if done.result():
                findings.update(done.result())
            else:
                clean[source.name] = keys[source]
                # whoever ends this early keeps what is done
                record.with_suffix(".new").write_text(json.dumps(clean, indent=0))
                record.with_suffix(".new").replace(record)
            print("%d of %d sources" % (count, len(waiting)), file=progress)
    for finding in sorted(findings):
        print(finding)
    if not findings:
        print(
            "%d sources are clean, %d of them unchanged since they were found so"
            % (len(sources), len(sources) - len(waiting))
        )
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
