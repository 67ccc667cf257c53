"""The tutorial and README's first screen say what the programs say: every command, run anew."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from roslib.packages import find_node

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
RUNNER = REPOSITORY / "scripts" / "lib" / "run_tutorial.py"


def run(page):
    programs = pathlib.Path(find_node("mems_stiction", "predict_scan")[0]).parent
    path = os.pathsep.join(
        [str(programs), str(REPOSITORY / "scripts" / "examples"), os.environ["PATH"]]
    )
    return subprocess.run(
        [sys.executable, str(RUNNER), str(page)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        universal_newlines=True,
        env=dict(os.environ, PATH=path),
        timeout=1000,
    )


class TutorialTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def test_every_command_says_what_the_page_shows(self):
        for page in ("doc/tutorial.md", "README.md"):
            done = run(REPOSITORY / page)
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_comparison_sees_what_rots(self):
        good = (
            "```yaml\n# a.yaml\nkey: 1\n```\n\n```console\n$ cat a.yaml | tail -n 1\nkey: 1\n$ "
            "echo 14.58, 2.014e-06 and 7\n14.58, 2.01e-06 and 7\n```\n"
        )
        for page, status in (
            (good, 0),
            (good.replace("key: 1\n$", "key: 2\n$"), 1),
            (good.replace("\n14.58", "\n14.59"), 1),
            (good.replace("2.01e-06", "2.02e-06"), 1),
            (good.replace("7\n`", "8\n`"), 1),
            (good.replace("$ echo", "$ ecko"), 1),
            (good.replace("14.58, 2.01e-06 and 7\n", ""), 1),
            ("no command", 1),
        ):
            path = self.folder / "page.md"
            path.write_text(page)
            self.assertEqual(run(path).returncode, status, page)


if __name__ == "__main__":
    unittest.main()
