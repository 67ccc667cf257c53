#!/usr/bin/env python3
"""Runs the commands of a page and compares what they say with what the page shows, so that it does
not rot.

usage: run_tutorial.py [--write] PAGE.md    in a folder of its own, which is removed; the programs
must be on the PATH

Blocks marked ```console hold commands ("$ ...") with their output below; blocks marked ```yaml
whose first line is a comment with a file's name, as in "# device.yaml", are files that are written
before the commands that follow. All commands of a page run in one shell, in order. Numbers agree to
the last digit that is printed: a stale one would pass any tolerance that is wider. --write puts
what the commands said into the page.
"""

import argparse
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile

TIMEOUT = 900  # of the whole page [s]
PROGRESS = re.compile(r"\d+ of \d+ scans?\b.*")  # of a batch, each half minute on busy machines
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
END = "-----end of command"


class Step:
    """One command and the lines that the page shows below it."""

    def __init__(self, command, line_number):
        self.command, self.line_number, self.shown, self.said = command, line_number, [], []


def blocks_of(lines):
    """(language, first line, lines) of each fenced block."""
    language, start = None, 0
    for index, line in enumerate(lines):
        if not line.startswith("```"):
            continue
        if language is None:
            language, start = line[3:].strip(), index + 1
        else:
            yield language, start, lines[start:index]
            language = None


def actions_of(text):
    """Steps, and files as (name, content), in the order of the page."""
    for language, start, block in blocks_of(text.splitlines()):
        if language == "yaml":
            match = re.match(r"# (\S+\.yaml)$", block[0]) if block else None
            if match:
                yield match.group(1), "\n".join(block) + "\n"
        elif language == "console":
            step = None
            for offset, line in enumerate(block):
                if line.startswith("$ "):
                    if step:
                        yield step
                    step = Step(line[2:], start + offset)
                elif step:
                    step.shown.append(line)
            if step:
                yield step


def script_of(actions):
    lines = []
    for action in actions:
        if isinstance(action, Step):
            lines += [action.command, "printf '%%s %%d\\n' '%s' $?" % END]
        else:
            lines.append("cat >%s <<'END_OF_FILE'\n%sEND_OF_FILE" % action)
    return "\n".join(lines) + "\n"


def run(actions, folder):
    """Fills in what each step said; returns the commands whose exit status was not 0."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    settings = dict(
        os.environ,
        ROS_MASTER_URI="http://localhost:%d" % port,
        ROS_HOSTNAME="localhost",
        ROS_HOME=str(folder / "ros_home"),
    )
    settings.pop("ROS_NAMESPACE", None)
    shell = subprocess.Popen(
        ["bash", "-c", script_of(actions)],
        cwd=str(folder),
        env=settings,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        universal_newlines=True,
        start_new_session=True,
    )
    try:
        output, _ = shell.communicate(timeout=TIMEOUT)
    finally:
        try:
            os.killpg(shell.pid, signal.SIGTERM)  # what a command left in the background
        except ProcessLookupError:
            pass
    failed, step_lines = [], []
    steps = iter([action for action in actions if isinstance(action, Step)])
    for line in output.splitlines():
        if line.startswith(END):
            step = next(steps)
            step.said, step_lines = step_lines, []
            if line.split()[-1] != "0":
                failed.append(step)
        elif not PROGRESS.match(line):
            step_lines.append(line.rstrip())
    return failed


def last_digit(number):
    """What one more in the last printed digit is worth: 0.01 of "14.58", 1e-08 of "1.58e-06"."""
    digits, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def agree(shown, said):
    """The same text, with numbers that round to each other at the digits that both have."""
    if NUMBER.sub("#", shown) != NUMBER.sub("#", said):
        return False
    for first, second in zip(NUMBER.findall(shown), NUMBER.findall(said)):
        unit = max(last_digit(first), last_digit(second))
        if abs(float(first) - float(second)) > 0.501 * unit:  # by round-off not above a half
            return False
    return True


def differences(step):
    shown, said = [line.rstrip() for line in step.shown], step.said
    while shown and not shown[-1]:
        shown.pop()
    if len(shown) == len(said) and all(agree(*pair) for pair in zip(shown, said)):
        return None
    return "line %d: $ %s\n  shown:\n    %s\n  said:\n    %s" % (
        step.line_number + 1,
        step.command,
        "\n    ".join(shown),
        "\n    ".join(said),
    )


def rewritten(text, steps):
    """The page with what the commands said."""
    lines, written, index = text.splitlines(), [], 0
    by_line = {step.line_number: step for step in steps}
    while index < len(lines):
        written.append(lines[index])
        step = by_line.get(index)
        index += 1
        if step:
            written += step.said
            while not lines[index].startswith("```") and not lines[index].startswith("$ "):
                index += 1
    return "\n".join(written) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument(
        "--write", action="store_true", help="put what the commands said into the page"
    )
    arguments = parser.parse_args()
    text = arguments.page.read_text(encoding="utf-8")
    actions = list(actions_of(text))
    steps = [action for action in actions if isinstance(action, Step)]
    with tempfile.TemporaryDirectory() as folder:
        failed = run(actions, pathlib.Path(folder))
    for step in failed:
        print(
            "line %d: $ %s\n  failed and said:\n    %s"
            % (step.line_number + 1, step.command, "\n    ".join(step.said))
        )
    if arguments.write and not failed:
        arguments.page.write_text(rewritten(text, steps), encoding="utf-8")
        return 0
    problems = [problem for problem in map(differences, steps) if problem]
    for problem in problems:
        print(problem)
    if not steps:
        print("%s has no commands" % arguments.page)
    return 0 if steps and not failed and not problems else 1


if __name__ == "__main__":
    sys.exit(main())
