"""studies/reproduce_paper: a trial run, its page, and that the rows of its table are computed."""

import copy
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import mems_stiction
import numpy as np

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "studies"))

from paper import cases, claims, data, figures  # noqa: E402
from paper.version import version  # noqa: E402


class OtherMaps:
    """Maps of a case after which no surface had changed, with the energies backwards and twice the
    tilt."""

    def __init__(self, maps):
        self._maps = maps
        self.lower_after, self.upper_after = maps.lower, maps.upper

    def __getattr__(self, name):
        return getattr(self._maps, name)

    def asperities(self, name):
        return 2 * self._maps.asperities(name)

    def energies(self, name):
        return self._maps.energies(name)[::-1]


class OtherFacts(claims.Facts):
    def maps(self, name):
        return OtherMaps(super().maps(name))


class TrialRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        cls.done = subprocess.run(
            [
                str(REPOSITORY / "studies" / "reproduce_paper"),
                "--quick",
                "--built",
                "--work",
                str(cls.folder / "work"),
                "--doc",
                str(cls.folder / "doc"),
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
            timeout=600,
        )
        assert cls.done.returncode == 0, cls.done.stderr
        cls.record = json.loads((cls.folder / "work" / "results.json").read_text())
        cls.study = cases.Study(cls.record["seeds"], cls.record["size"], True)
        cls.page = (cls.folder / "doc" / "paper.md").read_text()

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def facts(self, results=None, kind=claims.Facts):
        results = self.record["results"] if results is None else results
        return kind(
            self.study, results, data.Sweep(self.study, results), self.folder / "work" / "dump"
        )

    def changed(self, change):
        """The results after change(name, found) went over each case."""
        results = copy.deepcopy(self.record["results"])
        for name, found in results.items():
            change(name, found)
        return results

    def row(self, name, **arguments):
        return {row.name: row for row in claims.all_rows(self.facts(**arguments))}[name]

    def test_writes_seven_figures_fit_for_a_repository(self):
        names = re.findall(r"\]\((figures/[^)]+)\)", self.page)
        self.assertEqual(names, ["figures/figure_%d.png" % number for number in range(1, 8)])
        for name in names:
            self.assertTrue(10e3 < (self.folder / "doc" / name).stat().st_size < 300e3, name)

    def test_the_page_says_what_was_run(self):
        self.assertIn("quick trial", self.page)
        self.assertIn("%d predictions" % self.record["predictions"], self.page)
        self.assertIn(self.record["version"], self.page)
        self.assertIn(
            "%d × %d pixels, %d pairs" % (self.study.size, self.study.size, self.study.seeds),
            self.page,
        )
        self.assertNotIn(str(REPOSITORY), self.page)

    def test_every_claim_is_a_row_with_a_verdict(self):
        table = self.page[self.page.index("## The paper's claims") :]
        rows = claims.all_rows(self.facts())
        for row in rows:
            self.assertIn("| %s | %s |" % (row.part, row.claim), table)
            self.assertIn("| **%s** |" % row.verdict, table)
        for part in (
            "abstract",
            "2.2",
            "conclusions 1",
            "conclusions 2",
            "conclusions 3",
            "conclusions 4",
            "conclusions 5",
            "conclusions 6",
        ):
            self.assertTrue(any(part in row.part for row in rows), part)

    def test_other_results_give_other_rows(self):
        """No number of a row is typed in: with every figure changed, every row that claims to have
        run something changes."""
        random = np.random.RandomState(1)

        def change(name, figures):
            for field, value in figures.items():
                if isinstance(value, float):
                    figures[field] = value * random.uniform(0.5, 0.9)
                if isinstance(value, int) and field.endswith("_count"):
                    figures[field] = value + random.randint(3, 9)
            if figures["status"] == "BONDED":
                figures["status"] = "EQUILIBRIUM"

        before = claims.all_rows(self.facts())
        after = claims.all_rows(self.facts(self.changed(change), OtherFacts))
        unchanged = [
            row.name for row, other in zip(before, after) if row.came_out == other.came_out
        ]
        self.assertEqual(unchanged, ["friction"])

    def test_verdicts_follow_the_results(self):
        def weak(name, figures):
            figures["bonding_energy"] *= 1e-6

        def shrunk(name, figures):
            if "/regimes" in name:
                figures["contact_area"] *= (
                    1e-6  # below the elastic pair's, however many times as large it was
                )

        def elastic(name, figures):
            figures["elasto_plastic_count"] = figures["plastic_count"] = 0

        def rough_bonds(name, figures):
            if name.startswith("sweep/"):
                figures["contact_fraction"] = 1 - figures["contact_fraction"]

        def flow_weakens(name, figures):
            if name.startswith("pressed/") and "/flow/" in name:
                for field in (
                    "half_space_contact_fraction",
                    "half_space_pull_off_force",
                    "contact_fraction",
                    "pull_off_force",
                ):
                    figures[field] *= 1e-6

        for solver in claims.SOLVERS:
            for of_what in ("larger_area", "higher_pull_off"):
                name = "%s_by_%s" % (of_what, solver)
                self.assertIn(
                    self.row(name).verdict, (claims.YES, claims.PART), self.row(name).came_out
                )
                self.assertEqual(
                    self.row(name, results=self.changed(flow_weakens)).verdict, claims.NO, name
                )
        for name, change, before in (
            ("energy_outside_bonding", weak, claims.YES),
            ("larger_area_gold", shrunk, claims.YES),
            ("three_regimes", elastic, claims.YES),
            ("plastic_without_load", elastic, claims.YES),
            ("falls", rough_bonds, claims.PART),
        ):
            self.assertEqual(self.row(name).verdict, before, name)
            row = self.row(name, results=self.changed(change))
            self.assertIn(row.verdict, (claims.NO, claims.PART), row.came_out)
            self.assertNotEqual(row.came_out, self.row(name).came_out)
        self.assertEqual(self.row("material_topography", kind=OtherFacts).verdict, claims.NO)
        self.assertEqual(self.row("energy_extremum", kind=OtherFacts).verdict, claims.NO)

    def test_area_and_energy_fall_with_the_adhesion_parameter_within_their_bands(self):
        sweep = self.facts().sweep
        for material in cases.MATERIALS:
            for series in (one for one in cases.SERIES if one.name.startswith("elastic")):
                self.assertLessEqual(
                    claims.largest_rise(sweep.values(material, series.name, "contact_fraction")),
                    1.0,
                    series.name,
                )
                if not series.name.endswith(
                    "vdw"
                ):  # E_t contains the energy of the attraction, which first rises
                    rise = claims.largest_rise(
                        sweep.values(material, series.name, "normalized_bonding_energy")
                    )
                    self.assertLessEqual(rise, 1.0, series.name)

    def test_asperities_that_flow_never_make_a_pair_rest_earlier(self):
        """With them curves may rise again: rougher pairs have more of them."""
        sweep = self.facts().sweep
        larger = 0
        for material in cases.MATERIALS:
            for regimes, elastic in cases.WITH_AND_WITHOUT_REGIMES:
                area = [
                    sweep.values(material, series, "contact_area") for series in (regimes, elastic)
                ]
                self.assertTrue(np.all(area[0] >= area[1]), (material.name, regimes))
                larger += np.sum(area[0] > area[1])
        self.assertGreater(larger, 0)

    def test_the_paper_s_formulation_is_stated_whatever_the_default(self):
        for pair in cases.all_pairs(self.study, pathlib.Path("dump")):
            for case in pair["cases"]:
                is_beside = (
                    case["name"].startswith(("half_space/", "pressed/"))
                    or "/separation_curve/" in case["name"]
                )
                self.assertEqual(
                    case["settings"]["approach/formulation"],
                    "separation_curve" if is_beside else "paper",
                    case["name"],
                )

    def test_beside_the_paper_s_forms_no_energy_exceeds_the_work_of_adhesion(self):
        sweep = self.facts().sweep
        for material in cases.MATERIALS:
            energy = sweep.values(material, cases.BESIDE.name, "normalized_bonding_energy")
            self.assertTrue(
                np.all(energy > 0) and np.all(energy <= 1 + 1e-6), energy
            )  # round-off of a sum over cells
            self.assertGreater(
                sweep.values(material, "regimes_vdw", "normalized_bonding_energy").max(), 5.0
            )

    def test_half_space_is_solved_beside_and_agrees_on_the_same_frames(self):
        frames = data.HalfSpaceFrames(self.study, self.record["results"])
        for material in cases.MATERIALS:
            ratio = frames.model(material, "normalized_bonding_energy") / figures.half_space_energy(
                frames, material
            )
            self.assertTrue(np.all(np.isfinite(ratio)), ratio)
            self.assertTrue(
                np.all((ratio > 0.5) & (ratio < 2)), ratio
            )  # the worst of doc/trust.md for the work
        self.assertIn("### Beside the paper's forms", self.page)

    def test_without_van_der_waals_and_plasticity_only_the_adhesion_parameter_counts(self):
        """Silicon of 10 nm and gold of 50 nm: the same pairs give the same state at the same
        parameter, to round-off; a cell more or less where round-off decides a level."""
        sweep = self.facts().sweep
        silicon, gold = (
            sweep.values(material, "elastic", "asperity_count") for material in cases.MATERIALS
        )
        self.assertGreater(np.mean(silicon == gold), 0.9)
        self.assertTrue(np.all(np.abs(silicon - gold) <= 1))

    def test_the_number_of_jobs_changes_nothing(self):
        pairs = [
            cases.pair(
                cases.SILICON,
                64,
                seed,
                [cases.case("a/%d" % seed, cases.SILICON, 1e-10 * seed, {})],
            )
            for seed in range(1, 6)
        ]
        one, three = (cases.run(pairs, jobs, lambda: None) for jobs in (1, 3))
        self.assertEqual(len(one), 5)
        for name, found in one.items():
            del found["processing_time"], three[name]["processing_time"]
        self.assertEqual(one, three)

    def test_a_setting_that_does_not_exist_is_an_error_that_names_it(self):
        wrong = cases.pair(
            cases.SILICON, 64, 1, [cases.case("a", cases.SILICON, 1e-9, {"interface/gamma": 1.0})]
        )
        with self.assertRaisesRegex(mems_stiction.OptionsError, "interface/gamma"):
            cases.run([wrong], 1, lambda: None)


class Version(unittest.TestCase):
    """What the page says that its numbers come from."""

    def setUp(self):
        text = (REPOSITORY / "package.xml").read_text()
        self.package = re.search(r"<version>([^<]+)</version>", text).group(1)

    def test_is_the_package_s_where_there_is_no_git(self):
        with unittest.mock.patch.dict(os.environ, PATH=os.devnull):
            self.assertEqual(version(), self.package)

    @unittest.skipUnless(shutil.which("git"), "git is not installed")
    def test_is_the_package_s_in_an_archive_whatever_repository_lies_around_it(self):
        with tempfile.TemporaryDirectory() as folder:
            git = ["git", "-C", folder, "-c", "user.name=a", "-c", "user.email=a@b"]
            for command in (
                ["init", "--quiet"],
                ["commit", "--quiet", "--allow-empty", "--message=other"],
            ):
                subprocess.run(git + command, check=True)
            archive = pathlib.Path(folder) / "archive"
            archive.mkdir()
            shutil.copy(str(REPOSITORY / "package.xml"), str(archive))
            with unittest.mock.patch.object(cases, "REPOSITORY", archive):
                self.assertEqual(version(), self.package)
            with unittest.mock.patch.object(cases, "REPOSITORY", pathlib.Path(folder)):
                shutil.copy(str(REPOSITORY / "package.xml"), folder)
                self.assertIn(self.package + ", sources of commit ", version())


class ShippedPage(unittest.TestCase):
    def test_is_of_a_full_run_and_complete(self):
        page = (REPOSITORY / "doc" / "paper.md").read_text()
        self.assertNotIn("quick trial", page)
        for name in re.findall(r"\]\((figures/[^)]+)\)", page):
            self.assertLess((REPOSITORY / "doc" / name).stat().st_size, 300e3, name)
        full = cases.Study(12, 1024, False)
        self.assertIn("%d × %d pixels, %d pairs" % (full.size, full.size, full.seeds), page)


if __name__ == "__main__":
    unittest.main()
