"""--help of each Python program says in whole sentences what the program does."""

import pathlib
import subprocess
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = sorted(
    path
    for path in (REPOSITORY / "scripts").iterdir()
    if path.is_file() and "ArgumentParser" in path.read_text(encoding="utf-8")
)


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


if __name__ == "__main__":
    unittest.main()
