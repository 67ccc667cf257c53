"""Studies are run by hand: each starts here, says its version and its usage, and finds its
modules."""

import os
import pathlib
import subprocess
import sys
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
STUDIES = REPOSITORY / "studies"
PROGRAMS = sorted(path for path in STUDIES.iterdir() if path.is_file() and not path.suffix)
MODULES = sorted(path.stem for path in STUDIES.glob("*.py")) + ["paper.page"]


class StudiesTest(unittest.TestCase):
    def test_each_says_its_version_and_its_usage(self):
        self.assertGreaterEqual(len(PROGRAMS), 5)
        for program in PROGRAMS:
            said = [
                subprocess.run([str(program), option], capture_output=True, text=True, timeout=120)
                for option in ("--version", "--help")
            ]
            with self.subTest(program=program.name):
                self.assertEqual([done.returncode for done in said], [0, 0])
                self.assertRegex(said[0].stdout, r"^%s of mems_stiction \d" % program.name)
                self.assertIn("studies/%s" % program.name, said[1].stdout)

    def test_each_module_is_found_with_what_it_imports(self):
        names = ", ".join(MODULES)
        environment = dict(os.environ, PYTHONDONTWRITEBYTECODE="1", MPLBACKEND="Agg")
        environment["PYTHONPATH"] = "%s:%s" % (STUDIES, environment.get("PYTHONPATH", ""))
        done = subprocess.run(
            [sys.executable, "-c", "import " + names],
            env=environment,
            capture_output=True,
            text=True,
            timeout=120,
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""), names)


if __name__ == "__main__":
    unittest.main()
