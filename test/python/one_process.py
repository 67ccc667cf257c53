"""Several calls of Python programs in one process, which loads what they share once."""

import json
import subprocess
import sys

CALLS = """
import contextlib, io, json, runpy, sys
answers = []
for call in json.load(sys.stdin):
    sys.argv = call
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            runpy.run_path(call[0], run_name="__main__")
            status = 0
        except SystemExit as end:
            status = end.code or 0
    answers.append((status, out.getvalue(), err.getvalue()))
print(json.dumps(answers))
"""


def run_in_one_process(calls, **settings):
    """(exit status, standard output, standard error) of each [program, argument, ...]."""
    done = subprocess.run(
        [sys.executable, "-c", CALLS],
        input=json.dumps([[str(part) for part in call] for call in calls]),
        stdout=subprocess.PIPE,
        universal_newlines=True,
        timeout=300,
        check=True,
        **settings,
    )
    return json.loads(done.stdout)
