"""The study of sensitivities, small: it runs, its page has every part, and doc/sensitivity.md is a
page of this study."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from tiers import evidence  # noqa: E402  (the path comes first)

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PAGE = REPOSITORY / "doc" / "sensitivity.md"
STUDY = REPOSITORY / "studies" / "sensitivity_study.py"
WRITER = REPOSITORY / "studies" / "sensitivity_page.py"


def run(command):
    return subprocess.run(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        timeout=600,
    )


def study(*arguments):
    return run([sys.executable, STUDY] + list(arguments))


def headings(page):
    return re.findall(r"^#+ .*$", page, re.MULTILINE)


def defaults(page):
    """{setting: default} of the page's table."""
    table = page.split("## The defaults")[1].split("## Setting by setting")[0]
    return dict(re.findall(r"^\| `([^`]+)` \| ([^|]*) \|", table, re.MULTILINE))


@evidence
class SensitivityTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def page_of(self, text, *arguments):
        (self.folder / "study.json").write_text(text)
        done = run(
            [
                sys.executable,
                WRITER,
                self.folder / "study.json",
                self.folder / "page.md",
                self.folder / "picture.png",
            ]
            + list(arguments)
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "picture.png").read_bytes()[1:4], b"PNG")
        return (self.folder / "page.md").read_text(encoding="utf-8")

    def test_page_is_of_this_study(self):
        done = study("--scans", "2", "--pixels", "128")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"done (\d+) of \1\n$")
        page, shipped = self.page_of(done.stdout), PAGE.read_text(encoding="utf-8")
        self.assertEqual(headings(page), headings(shipped))
        self.assertEqual(defaults(page), defaults(shipped))

    def test_changes_are_against_the_default_of_the_same_scan(self):
        record = json.loads(study("--scans", "2", "--pixels", "128").stdout)
        for surface in record["surfaces"]:
            cases = {
                (case["key"], case["value"]): case
                for case in surface["cases"]
                if case["key"] != "pitch"
            }
            default = [
                case for case in surface["cases"] if case["key"] == "pitch" and case["is_default"]
            ][0]["outcomes"]
            for key in (
                "approach/connectivity",
                "paper/step",
                "approach/formulation",
                "paper/cutoff_distance",
            ):
                of_key = [
                    case for case in surface["cases"] if case["key"] == key and case["is_default"]
                ]
                self.assertEqual(len(of_key), 1, key)
                self.assertEqual(of_key[0]["outcomes"], default, key)
            # The separation curve has no cut-off; the paper's form lets the rim of each contact
            # pull three times and more.
            far, near = (
                cases["paper/cutoff_distance", "3e-10"],
                cases["paper/cutoff_distance", "1.4e-10"],
            )
            paper = cases["approach/formulation", "paper"]["outcomes"]
            for outcome_far, outcome_near, outcome_paper in zip(
                far["outcomes"], near["outcomes"], paper
            ):
                self.assertEqual(outcome_far["pull_off_force"], outcome_near["pull_off_force"])
                self.assertLess(
                    2.0 * outcome_near["pull_off_force"], outcome_paper["pull_off_force"]
                )

    def test_own_scans_are_cut_into_quarters(self):
        random = np.random.RandomState(3)
        heights = random.standard_normal((128, 130))
        heights = sum(
            np.roll(heights, (row, column), (0, 1)) for row in range(4) for column in range(4)
        )
        np.savetxt(str(self.folder / "own.txt"), heights, fmt="%.3f")
        (self.folder / "own.txt.yaml").write_text(
            "pitch_x: 10.0e-9\npitch_y: 10.0e-9\nheight_scale: 1.0e-9\n"
        )
        done = study(self.folder / "own.txt")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = self.page_of(done.stdout, "--of-files")
        self.assertIn("| own.txt | quarters of the scan | 4 |", page)
        self.assertEqual(defaults(page), defaults(PAGE.read_text(encoding="utf-8")))

    def test_what_cannot_be_read_is_named(self):
        done = study(self.folder / "missing.txt")
        self.assertEqual(done.returncode, 2)
        self.assertIn("missing.txt", done.stderr)


if __name__ == "__main__":
    unittest.main()
