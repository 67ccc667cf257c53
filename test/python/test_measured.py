"""The page against measurement: it is written by this study, what the sources say is on it, and its
settings are the shipped ones."""

import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
STUDIES = REPOSITORY / "studies"
sys.path.insert(0, str(STUDIES))

import measured  # noqa: E402  (the path comes first)
import measured_cases as cases  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from tiers import evidence  # noqa: E402


def first_cells(page):
    """Headings and the first cells of all rows: what a page has, whatever its figures."""
    return re.findall(r"^(#+ .*|\| [^|]*)", page, re.MULTILINE)


class MeasuredTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.shipped = (REPOSITORY / "doc" / "measured.md").read_text(encoding="utf-8")

    @evidence
    def test_shipped_page_is_one_of_this_study(self):
        path = self.folder / "page.md"
        done = subprocess.run(
            [sys.executable, str(STUDIES / "measured.py"), str(path), "--quick"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=120,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(first_cells(path.read_text(encoding="utf-8")), first_cells(self.shipped))

    def test_every_source_is_on_the_page(self):
        for case in cases.CASES:
            self.assertIn(case.source.name, self.shipped)
            self.assertIn(case.source.says, self.shipped)
        self.assertIn("Of %d other sources" % len(cases.FOUND), self.shipped)
        self.assertIn("| beams | 2.6 nm | 50 uJ/m^2 (recalled) |", self.shipped)
        self.assertIn("11 kPa (read)", self.shipped)  # 13.3 uN on 1.256e-9 m^2

    def test_predictions_of_the_page_are_those_of_the_program(self):
        """The case with small frames, again in full: the page's median to its two digits."""
        case = next(case for case in cases.CASES if case.key == "alumina")
        with ThreadPoolExecutor(2) as pool:
            values = measured.Study(12, False, pool).values(case, cases.AS_ASSUMED)
        median = statistics.median(values[0])
        row = re.search(
            r"^\| alumina \| 1\.5 nm over 12 nm \| 5 \(read\) \| (\S+) \|",
            self.shipped,
            re.MULTILINE,
        )
        self.assertAlmostEqual(
            float(row.group(1)) / median, 1.0, delta=0.05
        )  # half a unit of the second digit

    def test_work_of_rough_planes_goes_with_their_mean_separation(self):
        """Van der Waals attraction across what does not touch: never less than two planes at that
        distance, since 1/D^2 is convex."""
        case = cases.CASES[0]
        with ThreadPoolExecutor(1) as pool:
            records = measured.Study(2, True, pool).records(case, cases.AS_ASSUMED, 2e-9)
        for record in records:
            planes = case.settings["hamaker"] / (12 * math.pi * record["mean_gap"] ** 2)
            self.assertGreater(
                record["apparent_work_of_adhesion"], 0.9 * planes
            )  # z0 = 0.16 nm of a gap of some nm: 6 %

    def test_polysilicon_is_the_ready_made_configuration(self):
        text = (REPOSITORY / "config" / "polysilicon_oxide.yaml").read_text(encoding="utf-8")
        found = {
            name: float(re.search(r"%s: (\S+)" % name, text).group(1))
            for name in (
                "youngs_modulus",
                "poisson_ratio",
                "hardness",
                "work_of_adhesion",
                "hamaker_constant",
            )
        }
        settings = cases.polysilicon()
        self.assertEqual(settings["work"], found["work_of_adhesion"])
        self.assertEqual(settings["hamaker"], found["hamaker_constant"])
        self.assertEqual(settings["hardness"], found["hardness"])
        self.assertAlmostEqual(
            settings["modulus"] * 2 * (1 - found["poisson_ratio"] ** 2),
            found["youngs_modulus"],
            delta=1.0,
        )


if __name__ == "__main__":
    unittest.main()
