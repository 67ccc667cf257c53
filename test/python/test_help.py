"""--help of each Python program says in whole sentences what the program does, and of each argument
what it is; that of a node names the program."""

import pathlib
import re
import subprocess
import sys
import unittest

from roslib.packages import find_node

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = sorted(
    path
    for path in (REPOSITORY / "scripts").iterdir()
    if path.is_file() and "ArgumentParser" in path.read_text(encoding="utf-8")
)
EXAMPLES = sorted(
    path
    for path in (REPOSITORY / "scripts" / "examples").iterdir()
    if "ArgumentParser" in path.read_text(encoding="utf-8")
)


def arguments_of(text):
    """What --help says of each argument: a name, and behind two blanks or a line's end what it
    is."""
    listed = re.split(r"\n\n(?:positional arguments|optional arguments|options):\n", text)[1:]
    for part in listed:
        yield from re.split(r"\n(?=  \S)", part.partition("\n\n")[0])


class HelpTest(unittest.TestCase):
    def test_the_description_ends_with_a_full_stop(self):
        self.assertGreaterEqual(len(PROGRAMS), 18)
        for program in PROGRAMS:
            done = subprocess.run(
                [str(program), "--help"], capture_output=True, text=True, timeout=120
            )
            with self.subTest(program=program.name):
                self.assertEqual(done.returncode, 0, done.stderr)
                description = done.stdout.split("\n\n")[1]
                self.assertTrue(description.endswith("."), description)

    def test_each_argument_is_explained(self):
        self.assertGreaterEqual(len(EXAMPLES), 4)
        for program in PROGRAMS + EXAMPLES:
            done = subprocess.run(
                [sys.executable, str(program), "--help"],
                capture_output=True,
                text=True,
                timeout=120,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            arguments = list(arguments_of(done.stdout))
            self.assertGreater(len(arguments), 1, program)
            for argument in arguments:
                with self.subTest(program=program.name):
                    self.assertRegex(argument.strip(), r"\S\s{2,}\S")

    def test_a_node_names_its_program(self):
        for name in ("stiction_node", "scan_source"):
            done = subprocess.run(
                [find_node("mems_stiction", name)[0], "--help"], capture_output=True, text=True
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("Usage: %s [OPTIONS]\n" % name, done.stdout)


if __name__ == "__main__":
    unittest.main()
