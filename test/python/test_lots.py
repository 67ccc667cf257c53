"""compare_lots: known variances and shares come back, a wafer shows its trend and its bad places,
and what rows cannot tell is said."""

import csv
import importlib.util
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from mems_stiction import archive, lots_variance  # noqa: E402
from mems_stiction.lots_data import NUMBERS, TEXTS, Place, _Table, lots_of  # noqa: E402
from mems_stiction.lots_variance import components_of, hierarchy_of  # noqa: E402
from mems_stiction.lots_wafer import bad_places, trend_of  # noqa: E402
from mems_stiction.lots_yield import share_of  # noqa: E402
from module_cases import REPOSITORY, rough  # noqa: E402  (the path comes first)

COMPARE_LOTS = str(REPOSITORY / "scripts" / "compare_lots")
SITES = [(0.01 * x, 0.01 * y) for x in range(-4, 5) for y in range(-4, 5) if x * x + y * y <= 16]
BAD = ((-0.02, 0.01), (0.01, -0.02))
CONFIG = """
scan: {pitch_x: 1.0e-8, pitch_y: 1.0e-8}
load: {mechanical_load: 1.0e-7}
device: {spring_stiffness: 1.0, travel: 1.0e-6, contact_area: 9.2e-13}
device_force: {enabled: false}
"""


def row(lot="A", wafer="1", site=(0.0, 0.0), margin=3.0, **others):
    return dict(
        {"lot_id": lot, "wafer_id": wafer, "site_x": site[0], "site_y": site[1], "margin": margin},
        **others,
    )


def made(shape, deviations, seed, lost=0.0, mean=0.0, draw=None):
    """Places of lots, wafers and sites whose logarithms have these standard deviations; some are
    lost."""
    random = np.random.RandomState(seed)
    found = []
    for lot in range(shape[0]):
        of_lot = deviations[0] * random.standard_normal()
        for wafer in range(shape[1]):
            of_wafer = of_lot + deviations[1] * random.standard_normal()
            for site in range(shape[2]):
                value = math.exp(
                    mean
                    + of_wafer
                    + deviations[2] * (random.standard_normal() if draw is None else draw(random))
                )
                if random.rand() >= lost:
                    found.append(
                        Place(
                            "%d" % lot,
                            "%d" % wafer,
                            "",
                            1e-3 * site,
                            0.0,
                            value,
                            *(math.nan,) * 4,
                            0.0,
                            "",
                            "",
                        )
                    )
    return found


class KnownVariancesTest(unittest.TestCase):
    def logs(self, places):
        return np.log([place.value for place in places])

    def test_intervals_hold_the_truth_for_unequal_numbers(self):
        deviations = (0.2, 0.1, 0.3)
        covered = np.zeros(3)
        draws = 150
        for seed in range(draws):
            places = made((4, 5, 9), deviations, seed, lost=0.1)
            found = components_of(self.logs(places), hierarchy_of(places), by_likelihood=False)
            self.assertEqual(found.words, ("lots", "wafers", "places"))
            covered += (found.lower <= np.square(deviations)) & (
                np.square(deviations) <= found.upper
            )
        for place, word in enumerate(found.words):
            self.assertGreaterEqual(covered[place] / draws, 0.90, word)
            self.assertLessEqual(covered[place] / draws, 0.98, word)

    def test_two_wafers_have_an_interval_that_holds_the_truth_all_the_same(self):
        covered = 0
        for seed in range(150):
            places = made((1, 2, 30), (0.0, 0.2, 0.3), seed)
            found = components_of(self.logs(places), hierarchy_of(places), by_likelihood=False)
            covered += found.lower[0] <= 0.04 <= found.upper[0]
        self.assertGreaterEqual(covered, 135)
        self.assertLessEqual(covered, 148)

    def test_restricted_likelihood_has_no_bias_and_is_that_of_mean_squares_for_equal_numbers(self):
        if not lots_variance.has_likelihood():
            self.skipTest("statsmodels is not installed")
        ratios = []
        for seed in range(30):
            places = made((1, 8, 12), (0.0, 0.3, 0.3), seed)
            values, hierarchy = self.logs(places), hierarchy_of(places)
            likely, by_squares = (components_of(values, hierarchy, flag) for flag in (True, False))
            self.assertEqual(likely.why_squares, "")
            np.testing.assert_allclose(likely.variances, by_squares.variances, rtol=2e-2, atol=1e-4)
            ratios.append(likely.variances / 0.09)
        self.assertAlmostEqual(np.mean(ratios, axis=0)[0], 1.0, delta=0.3)
        self.assertAlmostEqual(np.mean(ratios, axis=0)[1], 1.0, delta=0.1)

    def test_the_interval_of_a_trend_holds_it(self):
        covered = 0
        for seed in range(200):
            values = np.exp(
                10.0 * np.array([x for x, _ in SITES])
                + 0.2 * np.random.RandomState(seed).standard_normal(49)
            )
            trend = trend_of(
                [
                    Place("", "", "", x, y, value, *(math.nan,) * 4, 0.0, "", "")
                    for (x, y), value in zip(SITES, values)
                ]
            )
            covered += trend.gradient_x_lower < 10.0 < trend.gradient_x_upper
        self.assertGreaterEqual(covered, 180)
        self.assertLessEqual(covered, 197)

    def test_levels_that_are_one_are_named(self):
        rows = [
            row(
                lot="%d" % lot,
                wafer="w",
                part_id="p%d" % part,
                margin=3.0 + 0.1 * lot + 0.01 * part,
            )
            for lot in range(3)
            for part in range(4)
        ]
        found = mems_stiction.compare_lots(rows)
        self.assertEqual(list(found.components.level), ["lots and their wafers", "parts"])
        self.assertIn(
            "each of the lots has one of the wafers: they cannot be told apart", found.statements
        )


class SharesTest(unittest.TestCase):
    def coverage(self, truth, shape, deviations, draws=150, **others):
        covered, methods = 0, set()
        for seed in range(draws):
            places = made(shape, deviations, seed, **others)
            share = share_of(places, hierarchy_of(places), 0.0)
            covered += share.lower <= truth <= share.upper
            methods.add(share.method)
        return covered / draws, methods

    def test_intervals_of_a_normal_distribution_hold_the_share_of_all_wafers(self):
        from scipy.stats import norm

        mean, deviations = 0.6, (0.0, 0.2, 0.3)
        truth = norm.cdf(-mean / math.hypot(*deviations))
        covered, methods = self.coverage(truth, (1, 5, 20), deviations, mean=mean)
        self.assertIn("normal", methods)
        self.assertGreaterEqual(covered, 0.90)
        self.assertLessEqual(covered, 0.985)

    def test_where_the_distribution_is_another_places_are_counted(self):
        """One place of ten is bad: no normal distribution."""
        covered, methods = self.coverage(
            0.1,
            (1, 1, 80),
            (0.0, 0.0, 1.0),
            mean=1.0,
            draw=lambda random: -1.5 if random.rand() < 0.1 else 0.1 * random.standard_normal(),
        )
        self.assertEqual(methods, {"counted"})
        self.assertGreaterEqual(covered, 0.93)

    def test_none_of_many_gives_a_bound_and_no_tail(self):
        """Clopper and Pearson, one-sided: 1 - 0.05^(1/N)."""
        places = made((1, 1, 49), (0.0, 0.0, 0.1), 1, mean=math.log(5.0))
        share = share_of(places, hierarchy_of(places), 0.0)
        self.assertEqual(
            (share.method, share.sticking, share.share, share.lower), ("bound", 0, 0.0, 0.0)
        )
        self.assertAlmostEqual(share.upper, 1.0 - 0.05 ** (1.0 / 49.0), places=9)
        self.assertLess(share.tail, 1e-10)

    def test_counts_have_the_interval_of_clopper_and_pearson(self):
        """Two of 20: 1.23 % to 31.70 %, as in their tables."""
        places = [
            Place(
                "",
                "",
                "",
                math.nan,
                math.nan,
                0.5 if number < 2 else 5.0,
                *(math.nan,) * 4,
                0.0,
                "",
                "%d" % number,
            )
            for number in range(20)
        ]
        share = share_of(places, hierarchy_of(places), 0.0)
        self.assertEqual(share.method, "counted")
        self.assertAlmostEqual(share.lower, 0.0123, places=4)
        self.assertAlmostEqual(share.upper, 0.3170, places=4)

    def test_alike_places_are_worth_fewer(self):
        places = made((1, 4, 25), (0.0, 0.8, 0.2), 3, mean=4.0)
        share = share_of(places, hierarchy_of(places), 0.0)
        self.assertLess(share.worth, 10.0)
        self.assertGreater(share.upper, 1.0 - 0.05 ** (1.0 / 10.0))

    def test_an_error_that_all_margins_share_widens_the_interval(self):
        rows = [
            row(site=site, margin=2.0 * math.exp(0.3 * value))
            for site, value in zip(SITES, np.random.RandomState(2).standard_normal(49))
        ]
        plain = mems_stiction.compare_lots(rows)
        self.assertTrue(any("margins come without intervals" in text for text in plain.statements))
        wide = mems_stiction.compare_lots(
            [
                dict(one, margin_lower=one["margin"] / 3.0, margin_upper=one["margin"] * 3.0)
                for one in rows
            ]
        )
        self.assertGreater(wide.shares.upper[0], 0.5)
        self.assertLess(plain.shares.upper[0], 0.2)

    def test_a_row_without_an_interval_does_not_take_those_of_the_others_away(self):
        values = 2.0 * np.exp(0.3 * np.random.RandomState(2).standard_normal(49))
        rows = [
            row(site=site, margin=value, margin_lower=value / 3.0, margin_upper=3.0 * value)
            for site, value in zip(SITES, values)
        ]
        whole = mems_stiction.compare_lots(rows)
        self.assertEqual(whole.shares.without_interval[0], 0)
        lacking = mems_stiction.compare_lots(
            [dict(rows[0], margin_lower="", margin_upper="nan")] + rows[1:]
        )
        self.assertEqual(lacking.shares.without_interval[0], 1)
        self.assertTrue(
            any(
                text.startswith("1 of 49 margins come without an interval")
                for text in lacking.statements
            ),
            lacking.statements,
        )
        for end in ("share", "lower", "upper"):
            self.assertAlmostEqual(
                getattr(lacking.shares, end)[0], getattr(whole.shares, end)[0], places=9
            )

    def test_against_voltage_and_against_times_that_were_measured(self):
        random = np.random.RandomState(5)
        rows = [
            row(
                site=site,
                voltage=volts,
                hold_time=60.0,
                margin=4.0 * math.exp(-0.05 * volts + 0.2 * random.standard_normal()),
            )
            for volts in (0.0, 20.0, 40.0)
            for site in SITES
        ]
        found = mems_stiction.compare_lots(rows)
        self.assertEqual((found.against, list(found.shares["at"])), ("voltage", [0.0, 20.0, 40.0]))
        self.assertEqual(found.shares.sticking[0], 0)
        self.assertLess(found.shares.share[1], 0.1)
        self.assertGreater(found.shares.share[2], 0.9)
        self.assertTrue(
            any(
                text.startswith("at voltage 20.0 V expected to stick: ")
                for text in found.statements
            ),
            found.statements,
        )
        unknown = "how that share grows with the time stuck down is not told by these rows"
        self.assertTrue(any(text.startswith(unknown) for text in found.statements))
        failed = {
            name: value for name, value in rows[0].items() if name not in ("voltage", "margin")
        }  # of a scan that was not predicted
        self.assertEqual(
            list(mems_stiction.compare_lots(rows + [failed]).shares["at"]), [0.0, 20.0, 40.0]
        )
        timed = mems_stiction.compare_lots(
            [dict(one, hold_time=one["voltage"] + 1.0) for one in rows], against="hold_time"
        )
        self.assertEqual(list(timed.shares["at"]), [1.0, 21.0, 41.0])
        self.assertFalse(any(text.startswith(unknown) for text in timed.statements))
        with self.assertRaisesRegex(
            mems_stiction.OptionsError, "no column 'time'; the model knows no ageing"
        ):
            mems_stiction.compare_lots(rows, against="time")

    def test_beams_that_are_peeled_are_compared_by_their_peel_numbers(self):
        rows = [
            row(site=(1e-3 * place, 0.0), peel_number=0.5 + place, governed_by="peeling")
            for place in range(4)
        ]
        self.assertEqual(lots_of(rows).figure, "peel_number")
        self.assertEqual(lots_of(rows, "margin").figure, "margin")
        self.assertEqual(lots_of(rows + [row(governed_by="force")]).figure, "margin")

    def test_without_a_device_there_is_no_share(self):
        found = mems_stiction.compare_lots(
            [{"pull_off_force": 1e-7, "margin": "nan"}, {"pull_off_force": 2e-7, "margin": ""}]
        )
        self.assertEqual((found.figure, len(found.shares)), ("pull_off_force", 0))
        self.assertTrue(any("state the device" in text for text in found.statements))

    def test_what_nothing_holds_counts_as_releasing(self):
        def compared(free):
            return mems_stiction.compare_lots(
                [
                    row(site=site, margin=math.inf if place < free else 2.0 + 0.01 * place)
                    for place, site in enumerate(SITES)
                ]
            )

        def is_said(found, count):
            start = "with an infinite margin, since nothing holds there: %s, " % count
            return any(text.startswith(start) for text in found.statements)

        found = compared(5)
        self.assertEqual(
            (found.shares.places[0], found.shares.sticking[0], found.shares.method[0]),
            (49, 0, "bound"),
        )
        self.assertTrue(np.isfinite(found.units.value).all())
        self.assertTrue(is_said(found, "5 rows"), found.statements)
        self.assertTrue(is_said(compared(1), "1 row"))


class WaferTest(unittest.TestCase):
    """49 sites that are rougher to the right, two smooth ones among them, predicted by
    stiction_batch."""

    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls._folder.name)
        (cls.path / "part.yaml").write_text(CONFIG)
        scans = []
        for number, site in enumerate(SITES):
            scans.append(cls.path / ("%02d.npy" % number))
            np.save(
                str(scans[-1]),
                rough(
                    96,
                    96,
                    0.3e-9 if site in BAD else 3e-9 * math.exp(15.0 * site[0]),
                    number + 1,
                    12,
                ),
            )
        lines = cls.path / "batch.jsonl"
        done = subprocess.run(
            [
                archive.program(),
                "--config",
                str(cls.path / "part.yaml"),
                "-o",
                str(lines),
                *map(str, scans),
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        assert done.returncode == 0, done.stderr
        with open(str(lines), encoding="utf-8") as stream:
            cls.rows = [
                dict(json.loads(line), lot_id="L7", wafer_id="3", site_x=site[0], site_y=site[1])
                for line, site in zip(stream, SITES)
            ]
        cls.table = cls.path / "rows.csv"
        with open(str(cls.table), "w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, list(max(cls.rows, key=len)))
            writer.writeheader()
            writer.writerows(cls.rows)

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def run_program(self, *arguments):
        return subprocess.run(
            [sys.executable, COMPARE_LOTS, *map(str, arguments)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )

    def test_the_two_bad_places_are_named_and_the_trend_is_seen(self):
        found = mems_stiction.compare_lots(self.rows)
        for figure in ("margin", "rms_height"):
            self.assertEqual(
                {(bad.site_x, bad.site_y) for bad in found.bad_places if bad.figure == figure},
                set(BAD),
                figure,
            )
        self.assertEqual(len(found.trends), 1)
        trend = found.trends[0]
        self.assertLess(trend.chance, 0.01)
        self.assertGreater(trend.gradient_x_lower, 0.0)
        self.assertLess(abs(trend.gradient_y), trend.gradient_x)
        self.assertLess(abs(trend.direction), math.radians(30))
        bad = [text for text in found.statements if "does not belong to its wafer" in text]
        self.assertEqual(len(bad), 2)
        self.assertIn("wafer 3 of lot L7 at (", bad[0])
        self.assertTrue(
            any("all rows are of one of the wafers" in text for text in found.statements)
        )

    def test_the_gradient_is_that_of_the_heights(self):
        """The rms height was made with 15 per metre."""
        found = mems_stiction.compare_lots(
            [dict(one, margin=one["rms_height"]) for one in self.rows]
        )
        trend = found.trends[0]
        self.assertAlmostEqual(trend.gradient_x, 15.0, places=6)
        self.assertAlmostEqual(trend.gradient_y, 0.0, places=6)
        self.assertAlmostEqual(trend.factor, math.exp(15.0 * 0.08), places=6)

    def test_forms_of_rows_give_the_same(self):
        expected = mems_stiction.compare_lots(self.rows).json()
        lines = self.path / "rows.jsonl"
        lines.write_text("".join(json.dumps(one) + "\n" for one in self.rows))
        names = list(max(self.rows, key=len))  # a row leaves out what it does not know
        records = np.array(
            [tuple(map(one.get, names)) for one in self.rows],
            dtype=[(name, object) for name in names],
        )
        from mems_stiction.row_table import write_rows

        excel = self.path / "excel.csv"  # semicolons, decimal commas
        write_rows(excel, names, self.rows, {}, is_for_excel=True)
        for form in (self.table, str(self.table), [self.table], lines, records, excel):
            self.assertEqual(mems_stiction.compare_lots(form).json(), expected)

    @unittest.skipUnless(importlib.util.find_spec("pyarrow"), "pyarrow is not installed")
    def test_a_table_in_parquet_gives_the_same(self):
        from mems_stiction.row_table import write_rows

        table = self.path / "rows.parquet"
        write_rows(table, list(max(self.rows, key=len)), self.rows, {})
        self.assertEqual(
            mems_stiction.compare_lots(table).json(), mems_stiction.compare_lots(self.rows).json()
        )
        (self.path / "none.parquet").write_text("no rows")
        with self.assertRaisesRegex(mems_stiction.FileError, "none.parquet: holds no rows"):
            mems_stiction.compare_lots(self.path / "none.parquet")

    def test_of_many_columns_those_in_need_are_kept(self):
        wide = [
            dict(one, **{"column_%d" % number: 0.5 for number in range(200)}) for one in self.rows
        ]
        table = _Table("column_7")
        for one in wide:
            table.add(one)
        self.assertEqual(
            table.columns.intersection(wide[0]),
            {name for name in self.rows[0] if name in TEXTS + NUMBERS} | {"column_7"},
        )
        self.assertEqual(
            mems_stiction.compare_lots(wide).json(), mems_stiction.compare_lots(self.rows).json()
        )

    def test_names_with_dollars_are_drawn_as_they_stand(self):
        """matplotlib takes what is between two dollar signs for a formula, and a formula that is
        none ends the picture."""
        rows = [
            dict(one, lot_id="$lot_{$", wafer_id="a$b$", part_id="p$%d$" % place)
            for place, one in enumerate(self.rows[:20])
        ]
        from matplotlib import cbook, text
        from mems_stiction import plots

        with (
            mock.patch.object(plots, "save", autospec=True, side_effect=plots.save) as save,
            mock.patch("mems_stiction.lots_figure.save", save),
        ):
            found = mems_stiction.compare_lots(rows)
            found.save_maps(self.path / "dollars")
            found.save_picture(self.path / "dollars.png")
        for call in save.call_args_list:
            texts = [drawn.get_text() for drawn in call[0][0].findobj(text.Text)]
            named = [drawn for drawn in texts if "$" in drawn and "mathdefault" not in drawn]
            self.assertTrue(named)
            self.assertFalse([drawn for drawn in named if cbook.is_math_text(drawn)])

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not installed")
    def test_a_table_of_pandas_gives_the_same(self):
        import pandas

        expected = mems_stiction.compare_lots(self.rows).json()
        self.assertEqual(
            mems_stiction.compare_lots(
                pandas.read_csv(str(self.table), float_precision="round_trip")
            ).json(),
            expected,
        )

    def test_the_program_prints_and_draws(self):
        picture, maps = self.path / "lots.png", self.path / "maps"
        run = self.run_program("--json", "--picture", picture, "--maps", maps, self.table)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual(json.loads(run.stdout), mems_stiction.compare_lots(self.table).to_dict())
        for path in (picture, maps / "wafer_L7_3.png"):
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG", path)
        run = self.run_program(self.table)
        self.assertRegex(
            run.stdout, r"^Comparison of 49 rows by their margin\n  expected to stick: "
        )
        self.assertIn("lot L7, wafer 3: margin ", run.stdout)

    def test_a_report_has_lots_and_maps_where_rows_name_them(self):
        try:
            from mems_stiction import report
        except ImportError as missing:
            self.skipTest("%s is not installed" % missing.name)
        settings = (self.path / "batch.jsonl.settings.yaml").read_text()
        page = report.page("Wafer", self.rows, [], settings, None)
        section = page[page.index('<div id="lots">') : page.index("<h2>Scans</h2>")]
        self.assertEqual(section.count("data:image/png;base64,"), 2)
        self.assertIn("<li>Expected to stick: ", section)
        self.assertIn('alt="Maps of wafer 3 of lot L7"', section)
        plain = [
            {
                name: value
                for name, value in one.items()
                if name not in ("lot_id", "wafer_id", "site_x", "site_y")
            }
            for one in self.rows
        ]
        self.assertNotIn('id="lots"', report.page("Scans", plain, [], settings, None))
        many = [dict(one, wafer_id="w%d" % wafer) for wafer in range(13) for one in self.rows[:7]]
        self.assertIn(
            "Of the maps the first 12; compare_lots --maps draws all.",
            report.page("Lot", many, [], settings, None),
        )

    def test_maps_mark_missing_sites_and_draw_each_wafer(self):
        rows = [dict(one, wafer_id=wafer) for wafer in ("3", "4/b") for one in self.rows]
        rows[60]["margin"] = "nan"
        del rows[70]
        from mems_stiction import plots

        with mock.patch.object(plots, "save", autospec=True, side_effect=plots.save) as save:
            paths = mems_stiction.compare_lots(rows).save_maps(self.path / "more")
        self.assertEqual([path.name for path in paths], ["wafer_L7_3.png", "wafer_L7_4-b.png"])
        titles = [call[0][0]._suptitle.get_text() for call in save.call_args_list]
        self.assertEqual(
            titles,
            [
                "Wafer 3 of lot L7: 49 places, 2 bad",
                "Wafer 4/b of lot L7: 47 places, 2 missing, 2 bad",
            ],
        )
        panels = [axes for axes in save.call_args_list[1][0][0].axes if axes.get_xlabel()]
        self.assertEqual(
            [axes.get_title() for axes in panels],
            ["Margin", "Pull-off force of the device", "Rms height"],
        )
        crosses = [
            sum(
                len(drawn.get_offsets())
                for drawn in axes.collections
                if drawn.get_offsets().shape[0] < 40
            )
            for axes in panels
        ]
        self.assertEqual(crosses, [4, 3, 3])  # missing, and two rings

    def test_what_is_wrong_is_one_line(self):
        deep = self.path / "deep.jsonl"
        deep.write_text('{"margin":' + "[" * 200000 + "\n")
        for name, line in (
            ("commas", "L,1,1,5"),
            ("short", "L,1"),
            ("text", "L,1,abc"),
            ("negative", "L,1,-2"),
        ):
            (self.path / (name + ".csv")).write_text("lot_id,wafer_id,margin\nL,1,1.5\n" + line)
        for arguments, words in (
            ((self.path / "none.csv",), r"^compare_lots: .*none\.csv: No such file[^\n]*\n$"),
            ((self.path / "part.yaml",), r"must end in \.csv"),
            ((deep,), r"^compare_lots: .*deep\.jsonl: holds no rows: too many levels[^\n]*\n$"),
            (
                (self.path / "commas.csv",),
                r"/commas\.csv, line 3: has 4 cells, and the header 3; a table with decimal commas "
                r"needs semicolons between its cells\n$",
            ),
            ((self.path / "short.csv",), r"/short\.csv, line 3: has 2 cells, and the header 3\n$"),
            (
                (self.path / "text.csv",),
                r"^compare_lots: margin: 'abc' in [^\n]*/text\.csv, line 3 is not allowed, must be",
            ),
            (
                (self.path / "negative.csv",),
                r"^compare_lots: margin: '-2' in [^\n]*, line 3 is not",
            ),
            (
                ("--against", "time", self.table),
                r"^compare_lots: against: the rows have no column 'time'",
            ),
            (
                ("--figure", "peel_number", self.table),
                r"^compare_lots: rows: none of 49 has a peel_number > 0\n$",
            ),
            (
                ("--picture", self.path / "none" / "a.png", self.table),
                r"^compare_lots: [^\n]*/none/a\.png: cannot be written: No such file or "
                r"directory\n$",
            ),
        ):
            run = self.run_program(*arguments)
            self.assertEqual((run.returncode, run.stdout), (2, ""), arguments)
            self.assertRegex(run.stderr, words)


class RuleTest(unittest.TestCase):
    def test_one_of_twenty_sound_wafers_loses_a_place_and_bad_ones_are_found(self):
        taken = found = 0
        for seed in range(200):
            random = np.random.RandomState(seed)
            values = np.exp(
                0.05 * np.array([100.0 * x for x, _ in SITES]) + 0.15 * random.standard_normal(49)
            )
            places = [
                Place("", "", "", x, y, value, *(math.nan,) * 4, 0.0, "", "")
                for (x, y), value in zip(SITES, values)
            ]
            taken += bool(bad_places(places, "margin", values))
            values[[3, 30]] /= 3.0
            found += {id(bad.place) for bad in bad_places(places, "margin", values)} >= {
                id(places[3]),
                id(places[30]),
            }
        self.assertGreaterEqual(taken, 2)
        self.assertLessEqual(taken, 20)
        self.assertGreaterEqual(found, 185)

    def test_equal_values_have_no_bad_place(self):
        self.assertEqual(
            bad_places(
                [Place("", "", "", *site, 2.0, *(math.nan,) * 4, 0.0, "", "") for site in SITES],
                "margin",
                [2.0] * 49,
            ),
            [],
        )


class SentencesTest(unittest.TestCase):
    def test_two_wafers_give_a_rough_estimate(self):
        random = np.random.RandomState(1)
        found = mems_stiction.compare_lots(
            [
                row(wafer=wafer, site=site, margin=3.0 * math.exp(0.2 * random.standard_normal()))
                for wafer in ("1", "2")
                for site in SITES
            ]
        )
        self.assertTrue(
            any(
                text.startswith(
                    "a rough estimate, from 2 wafers alone: wafers differ by a factor of "
                )
                for text in found.statements
            ),
            found.statements,
        )
        self.assertIn(
            "no trend of the margin is seen over wafer 1 of lot A, wafer 2 of lot A",
            found.statements,
        )

    def test_of_many_wafers_some_show_something_by_chance(self):
        random = np.random.RandomState(1)
        found = mems_stiction.compare_lots(
            [
                row(
                    wafer=str(wafer),
                    site=site,
                    margin=3.0 * math.exp(0.2 * random.standard_normal()),
                )
                for wafer in range(40)
                for site in SITES[::5]
            ]
        )
        self.assertIn(
            "by chance alone some 2 of 40 wafers show a trend, and as many a bad place",
            found.statements,
        )

    def test_scans_of_one_site_are_one_place(self):
        random = np.random.RandomState(1)
        rows = [
            row(
                wafer=str(wafer),
                site=site,
                part_id="p%d" % place,
                margin=3.0 * math.exp(of_part + 0.1 * random.standard_normal()),
            )
            for wafer in range(40)
            for place, site in enumerate(SITES[::5])
            for of_part in [0.2 * random.standard_normal()]
            for _ in range(3)
        ]
        rows += [dict(rows[0], margin="")]
        found = mems_stiction.compare_lots(rows)
        self.assertIn(
            "scans of one site are averaged, since they are no independent places: 1201 rows are "
            "400 places",
            found.statements,
        )
        self.assertLessEqual(sum(found.trends.chance < 0.05), 6)  # 2 of 40, and their spread
        self.assertEqual(found.trends.places.max(), 10)
        self.assertEqual((found.shares.places[0], found.shares.lost[0]), (400, 1))
        wafers = found.units[found.units.level == "wafers"]
        self.assertEqual(set(wafers.places), {10})
        self.assertAlmostEqual(
            math.log(wafers.value[0]), np.mean(np.log([one["margin"] for one in rows[:30]]))
        )
        levels = dict(zip(found.components.level, found.components.deviation))
        self.assertAlmostEqual(levels["parts and their places"], 0.2, delta=0.02)
        self.assertAlmostEqual(levels["scans"], 0.1, delta=0.01)
        _, _, figure = next(found.maps())
        self.assertIn("10 places", figure._suptitle.get_text())
        bad = dict(rows[0], margin=0.3)
        found = mems_stiction.compare_lots([bad, bad, bad] + rows[3:])
        self.assertEqual(
            [(one.site_x, one.site_y) for one in found.bad_places if one.wafer_id == "0"],
            [SITES[0]],
        )

    def test_rows_alone(self):
        """Of a new user: no lot, no wafer, no site."""
        found = mems_stiction.compare_lots([{"margin": 2.0 + 0.1 * place} for place in range(10)])
        self.assertEqual(list(found.components.level), ["scans"])
        self.assertTrue(
            any("no row has lot_id, wafer_id, site_x, site_y" in text for text in found.statements)
        )
        self.assertEqual(len(found.units), 0)
        self.assertIn("Comparison of 10 rows", repr(found))

    def test_a_gradient_of_the_rms_height_is_told_where_the_margin_has_none(self):
        random = np.random.RandomState(1)
        rows = [
            row(
                site=site,
                margin=3.0 * math.exp(0.2 * random.standard_normal()),
                rms_height=2e-9 * math.exp(9.0 * site[1]),
            )
            for site in SITES
        ]
        rows[7]["rms_height"] = 50e-9
        said = mems_stiction.compare_lots(rows).statements
        self.assertIn("no trend of the margin is seen over wafer 1 of lot A", said)
        # exp(9 x 0.08 m)
        self.assertIn(
            "wafer 1 of lot A: rms height grows by a factor of 2.05 (2.05 to 2.05) over 80.0 mm, "
            "towards 90 deg from x",
            said,
        )

    def test_a_trend_along_x_is_towards_0_deg(self):
        """A gradient along x that turns by a tenth of a degree towards -y."""
        for turn in (1e-3, -1e-3):
            rows = [
                row(site=site, margin=3.0 * math.exp(9.0 * (site[0] + turn * site[1])))
                for site in SITES
            ]
            said = " ".join(mems_stiction.compare_lots(rows).statements)
            self.assertIn("towards 0 deg from x", said)

    def test_one_bad_place_is_one(self):
        random = np.random.RandomState(1)
        rows = [
            row(wafer=wafer, site=site, margin=3.0 * math.exp(0.02 * random.standard_normal()))
            for wafer in "12"
            for site in SITES
        ]
        for count, words in (
            (1, "the bad place is left out of these differences"),
            (2, "the 2 bad places are left out of these differences"),
        ):
            rows[count]["margin"] = 0.3
            said = " ".join(mems_stiction.compare_lots(rows).statements)
            self.assertIn(words, said)

    def test_sites_are_numbers_in_metres(self):
        rows = [row(site=site) for site in SITES]
        with self.assertRaisesRegex(
            mems_stiction.OptionsError,
            "^site_x: '12 mm' in row 2 is not allowed, must be a number in metres, or empty$",
        ):
            mems_stiction.compare_lots([rows[0], dict(rows[1], site_x="12 mm")] + rows[2:])
        for unknown in ("", " ", "nan", None):
            mems_stiction.compare_lots([dict(rows[0], site_x=unknown, site_y=unknown)] + rows[1:])
        said = mems_stiction.compare_lots(
            [dict(one, site_x=1e3 * one["site_x"], site_y=1e3 * one["site_y"]) for one in rows]
        ).statements
        self.assertIn("sites lie up to 80.0 m apart: site_x and site_y are taken for metres", said)

    def test_one_row_and_none(self):
        self.assertFalse(
            [
                text
                for text in mems_stiction.compare_lots([row(part_id="a")]).statements
                if text.startswith("that share is for")
            ]
        )
        with self.assertRaisesRegex(
            mems_stiction.OptionsError, "^rows: there is none, must hold one row at least$"
        ):
            mems_stiction.compare_lots([])

    def test_equal_values(self):
        found = mems_stiction.compare_lots(
            [row(site=site, wafer=wafer) for site in SITES for wafer in "12"]
        )
        self.assertIn("no differences: all of 98 values are equal", found.statements)
        self.assertLess(found.components.deviation.max(), 1e-12)

    def test_a_bad_one_of_rows_alone(self):
        found = mems_stiction.compare_lots(
            [
                {"margin": 2.0 + 0.01 * (place % 7), "scan_name": "s%d" % place}
                for place in range(30)
            ]
            + [{"margin": 0.3, "scan_name": "s30"}]
        )
        self.assertTrue(
            any(
                text.startswith("s30 does not belong to the others: margin 0.3, 2.03 expected")
                for text in found.statements
            ),
            found.statements,
        )

    def test_one_row(self):
        found = mems_stiction.compare_lots([row()])
        self.assertEqual((len(found.components), found.shares.method[0]), (0, "bound"))
        self.assertAlmostEqual(found.shares.upper[0], 0.95)
        self.assertIn("one row does not tell how far places differ", found.statements)

    def test_without_statsmodels(self):
        rows = [
            row(wafer="%d" % wafer, site=site, margin=3.0 * math.exp(0.1 * wafer + site[0]))
            for wafer in range(5)
            for site in SITES
        ]
        with mock.patch.object(lots_variance, "has_likelihood", return_value=False):
            found = mems_stiction.compare_lots(rows)
        self.assertTrue(any("python3-statsmodels" in text for text in found.statements))
        with mock.patch.object(lots_variance, "MOST_VALUES", 100):
            self.assertTrue(
                any(
                    "take minutes for so many rows" in text
                    for text in mems_stiction.compare_lots(rows).statements
                )
                or not lots_variance.has_likelihood()
            )
        self.assertAlmostEqual(
            found.components.deviation[0] / 0.158, 1.0, delta=0.05
        )  # of 0 to 0.4 in steps of 0.1

    def test_identifiers_as_tables_read_them(self):
        places = lots_of(
            [
                row(lot=7.0, wafer=math.nan),
                row(lot=7, wafer=None, part_id="P", serial_id=4),
                row(lot="'-7", part_id="P"),
            ]
        ).places
        self.assertEqual(
            [(place.lot, place.wafer, place.part) for place in places],
            [("7", "", ""), ("7", "", "P no. 4"), ("-7", "1", "P")],
        )

    def test_pictures_without_parts_and_shares(self):
        with tempfile.TemporaryDirectory() as folder:
            for number, rows in enumerate(
                (
                    [{"pull_off_force": 1e-7}],
                    [row()],
                    [row(part_id="p%d" % part, margin=0.5 + part) for part in range(100)],
                )
            ):
                path = pathlib.Path(folder) / ("%d.png" % number)
                mems_stiction.compare_lots(rows).save_picture(path)
                self.assertGreater(path.stat().st_size, 10000)
            self.assertEqual(
                mems_stiction.compare_lots([{"margin": 2.0}]).save_maps(
                    pathlib.Path(folder) / "maps"
                ),
                [],
            )

    def test_what_is_no_rows(self):
        for rows, words in (
            (3, "int is not allowed"),
            ([3], "an item is 3"),
            ([], "there is none"),
            ([{"margin": ""}, {"margin": 0.0}], "none of 2 has a margin"),
            (
                [row(), {"margin": "x"}],
                "margin: 'x' in row 2 is not allowed, must be a number >= 0, or empty",
            ),
            ([{"pull_off_force": -2.0}], "pull_off_force: -2.0 in row 1 is not allowed"),
            ([{"peel_number": -2.0}], "none of 1 has a margin"),  # of a beam that buckles
        ):
            with self.assertRaisesRegex(mems_stiction.OptionsError, words):
                mems_stiction.compare_lots(rows)
        with self.assertRaisesRegex(mems_stiction.OptionsError, "figure: 'sq' is not allowed"):
            mems_stiction.compare_lots([row()], figure="sq")


if __name__ == "__main__":
    unittest.main()
