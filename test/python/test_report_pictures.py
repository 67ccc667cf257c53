"""What the report draws: bearing curve, spectrum, cleaning steps, energies around the equilibrium;
no label lies on another."""

import io
import itertools
import json
import math
import pathlib
import subprocess
import tempfile
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy as np
from mems_stiction import cleaning_steps, plots, report, report_figures, surface_figures
from mems_stiction.cleaning_run import CannotShow, stages_of
from mems_stiction.cleaning_steps import Stage, cleaning_figure, first_steps, rows_of, steps_of
from mems_stiction.plots import plt, widen
from mems_stiction.quantities import unbroken
from mems_stiction.surface_figures import MaterialRatioCurve, profile_spectrum, surface_figure
from roslib.packages import find_node
from scipy import integrate, stats

AFM_SCAN = pathlib.Path(__file__).resolve().parents[2] / "scripts/examples/make_afm_scan"


def rough(seed=1, rows=64, columns=96, rms=3e-9):
    noise = np.random.RandomState(seed).normal(size=(rows, columns))
    smooth = sum(
        np.roll(np.roll(noise, row, 0), column, 1) for row in range(4) for column in range(4)
    )
    return smooth * (rms / smooth.std())


def result(**changes):
    """Of result.json, as far as the pictures look at it."""
    count = 40
    random = np.random.RandomState(2)
    values = dict(
        status="EQUILIBRIUM",
        formulation="paper",
        force_curve=None,
        pull_off_force=4e-7,
        pull_off_force_jkr=1e-7,
        is_lower_bound=False,
        van_der_waals_force=3e-7,
        electrostatic_force=0.0,
        mechanical_load=1e-6,
        capillary_force=0.0,
        normal_load=1.3e-6,
        approach=5.49e-8,
        total_energy=1.5e-15,
        mechanical_energy=1.6e-15,
        surface_energy=1e-16,
        elastic_energy=2e-16,
        asperities={
            "load": list(1e-8 * random.lognormal(size=count)),
            "plasticity_index": list(random.uniform(0, 2, count)),
            "regime": list(random.randint(1, 4, count)),
        },
    )
    approach = np.linspace(1e-9, 5.48e-8, 80)
    values["energy_curve"] = {
        "approach": list(approach),
        "surface_energy": [1e-16] * 80,
        "elastic_energy": [2e-16] * 80,
        "mechanical_energy": list(4e-15 - ((approach - 5e-8) / 1e-9) ** 2 * 1e-16),
    }
    values["energy_curve"]["total_energy"] = [
        value - 1e-16 for value in values["energy_curve"]["mechanical_energy"]
    ]
    values.update(changes)
    return values


def labels_of(figure):
    """(text, box) of every label that is seen: ticks beyond the ends of an axis are not."""
    figure.canvas.draw()
    texts = list(figure.texts) + [text for legend in figure.legends for text in legend.get_texts()]
    for axes in figure.axes:
        texts += [axes.title] + list(axes.texts)
        if not axes.axison:
            continue
        texts += [axes.xaxis.label, axes.yaxis.label] + (
            axes.get_legend().get_texts() if axes.get_legend() else []
        )
        for axis, place in ((axes.xaxis, 0), (axes.yaxis, 1)):
            low, high = sorted(axis.get_view_interval())
            texts += [
                label
                for label in axis.get_ticklabels(which="both")
                if low <= label.get_position()[place] <= high
            ]
    return [
        (text.get_text(), text.get_window_extent())
        for text in texts
        if text.get_visible() and text.get_text().strip()
    ]


def collisions(figure):
    """Pairs of labels that overlap by more than a pixel."""
    pairs = []
    for (one, a), (other, b) in itertools.combinations(labels_of(figure), 2):
        wide = min(a.x1, b.x1) - max(a.x0, b.x0)
        tall = min(a.y1, b.y1) - max(a.y0, b.y0)
        if wide > 1 and tall > 1:
            pairs.append((one, other))
    return pairs


class PictureTest(unittest.TestCase):
    def drawn(self, module, draw):
        """The figure that a function of the module draws, before it becomes a PNG."""
        figures = []
        with mock.patch.object(
            module, "png_of", side_effect=lambda figure: figures.append(figure) or b""
        ):
            draw()
        self.addCleanup(plt.close, figures[0])
        return figures[0]

    def stages(self):
        heights = rough()
        measured = heights + np.linspace(0, 2e-8, heights.shape[1])
        measured[5, 6] = np.nan
        shifted = measured - np.nanmean(measured)
        spiked = shifted.copy()
        spiked[3:5, 7] = np.nan
        filled = np.where(np.isnan(spiked), 0.0, spiked)
        surfaces = [
            ("", measured),
            ("offset", shifted),
            ("spikes", spiked),
            ("fill", filled),
            ("level", heights),
        ]
        return [
            Stage(name, surface, {"pull_off_force": 1e-7 * place})
            for place, (name, surface) in enumerate(surfaces)
        ]

    def test_no_label_lies_on_another(self):
        flat = np.zeros((32, 32))
        for name, module, draw in (
            ("surface", surface_figures, lambda: surface_figure(rough(), 1e-8, 2e-8)),
            ("flat", surface_figures, lambda: surface_figure(flat, 1e-8, 1e-8)),
            ("steps", cleaning_steps, lambda: cleaning_figure(self.stages(), 1e-8, 1e-8)),
            ("upright", cleaning_steps, lambda: cleaning_figure(self.stages(), 1e-8, 5e-8)),
            ("energies", report_figures, lambda: report_figures.scan_figure(result())),
            (
                "one contact",
                report_figures,
                lambda: report_figures.scan_figure(
                    result(asperities={"load": [1.3e-6], "plasticity_index": [0.63], "regime": [1]})
                ),
            ),
        ):
            with self.subTest(picture=name):
                self.assertEqual(collisions(self.drawn(module, draw)), [])

    def test_no_label_leaves_the_picture(self):
        curve = {
            "height": [2e-9, 1e-10, 1e-10, 2e-9],
            "force": [0.0, -1e-7, -1e-7, 4e-7],
            "direction": ["APPROACH", "APPROACH", "RETRACTION", "RETRACTION"],
        }
        for module, draw in (
            (report_figures, lambda: report_figures.scan_figure(result())),
            (
                report_figures,
                lambda: report_figures.scan_figure(
                    result(formulation="separation_curve", force_curve=curve)
                ),
            ),
            (report_figures, lambda: report_figures.trend_figure(self.rows())),
            (cleaning_steps, lambda: cleaning_figure(self.stages(), 1e-8, 1e-8)),
            (surface_figures, lambda: surface_figure(rough(), 1e-8, 2e-8)),
            (surface_figures, lambda: surface_figure(rough(rms=2e-7), 1e-8, 2e-8)),
        ):
            figure = self.drawn(module, draw)
            width, height = figure.canvas.get_width_height()
            outside = [
                text
                for text, box in labels_of(figure)
                if box.x0 < -1 or box.y0 < -1 or box.x1 > width + 1 or box.y1 > height + 1
            ]
            self.assertEqual(outside, [])

    def rows(self):
        return [
            dict(
                number=number,
                status="EQUILIBRIUM",
                pull_off_force=4e-7,
                contact_fraction=1e-5 * number,
                rms_height=3e-9,
                margin=60.0 * number,
                margin_lower=20.0 * number,
                margin_upper=200.0,
                is_lower_bound=False,
            )
            for number in (1, 2, 3)
        ]

    def test_the_line_that_margins_are_judged_by_is_seen(self):
        figure = self.drawn(report_figures, lambda: report_figures.trend_figure(self.rows()))
        margin = figure.axes[3]
        self.assertEqual(margin.get_yscale(), "log")
        self.assertLess(margin.get_ylim()[0], 1.0)
        self.assertEqual(figure.axes[1].get_ylabel(), "contact fraction [%]")

    def test_ticks_over_many_decades_have_prefixes_of_their_own(self):
        rows = self.rows()
        for place, row in enumerate(rows):
            row.update(pull_off_force=1e-11 * 1e3**place, rms_height=2e-10 * 30.0**place)
        figure = self.drawn(report_figures, lambda: report_figures.trend_figure(rows))
        self.assertEqual(
            (figure.axes[0].get_ylabel(), figure.axes[2].get_ylabel()),
            ("pull-off force [N]", "rms height [m]"),
        )
        ticks = [
            figure.axes[place].yaxis.get_major_formatter()(value)
            for place, value in ((0, 1e-6), (0, 1e-3), (0, 1.0), (2, 1.0), (2, 100.0))
        ]
        self.assertEqual(ticks, ["1 pN", "1 nN", "1 µN", "1 nm", "100 nm"])
        self.assertEqual(collisions(figure), [])

    def test_trends_stand_below_each_other_however_few_scans_a_figure_is_known_of(self):
        rows = self.rows()
        for row in rows[1:]:
            row.update(margin=None, margin_lower=None, margin_upper=None)
        figure = self.drawn(report_figures, lambda: report_figures.trend_figure(rows))
        self.assertEqual({axes.get_xlim() for axes in figure.axes}, {(0.5, 3.5)})

    def test_a_few_contacts_have_no_distribution(self):
        few = {"load": [1.3e-6] * 4, "plasticity_index": [0.63] * 4, "regime": [1] * 4}
        titles = [
            axes.get_title()
            for axes in self.drawn(
                report_figures, lambda: report_figures.scan_figure(result(asperities=few))
            ).axes
        ]
        self.assertNotIn("Load of each contact", titles)
        many = {name: values * 2 for name, values in few.items()}
        titles = [
            axes.get_title()
            for axes in self.drawn(
                report_figures, lambda: report_figures.scan_figure(result(asperities=many))
            ).axes
        ]
        self.assertIn("Load of each contact", titles)

    def test_a_shift_does_not_hide_what_else_a_step_did(self):
        heights = rough()
        tilted = heights + 1e-6 + np.linspace(0, 2e-8, heights.shape[1])
        figure = self.drawn(
            cleaning_steps,
            lambda: cleaning_figure(
                [Stage("", tilted, {}), Stage("level", heights, {})], 1e-8, 1e-8
            ),
        )
        titles = [text for text, _ in labels_of(figure)]
        self.assertTrue(
            any(text.startswith("-1.01 µm everywhere,\nbeside it rms 5.8") for text in titles),
            titles,
        )
        shown = (
            figure.axes[-1].images or [image for axes in figure.axes for image in axes.images][-1:]
        )
        self.assertAlmostEqual(
            np.ptp(np.asarray(shown[0].get_array())), 20.0, delta=0.1
        )  # nm, as the plane spans

    def test_a_long_caption_leaves_room_for_the_titles(self):
        heights = rough()
        contact = SimpleNamespace(
            x=3e-7,
            y=2e-7,
            load=1e-6,
            cap_radius=2e-8,
            composite_radius=4.28e-7,
            plasticity_index=2.24,
            regime=1,
            area=1e-16,
        )
        prediction = SimpleNamespace(
            status=0,
            pull_off_force=4e-7,
            is_lower_bound=False,
            contact_fraction=1e-5,
            rms_height=3e-9,
            normal_load=1e-6,
            voltage=0.0,
            regime_flags=511,
            model_doubt="it tears",
            elastic_count=1,
            elasto_plastic_count=0,
            plastic_count=0,
        )
        regimes = np.zeros(heights.shape, np.uint8)
        regimes[20, 30] = 1
        picture = plots.ScanPicture(
            "scan", heights, heights, None, regimes, [contact], prediction, 1e-8, 1e-8
        )
        figures = []
        with mock.patch.object(plots.plt, "close", side_effect=figures.append):
            plots.save_picture(picture, io.BytesIO())
        self.addCleanup(plt.close, figures[-1])
        self.assertEqual(collisions(figures[-1]), [])

    def test_each_step_is_shown_with_what_it_did(self):
        figure = self.drawn(cleaning_steps, lambda: cleaning_figure(self.stages(), 1e-8, 1e-8))
        texts = [text for text, _ in labels_of(figure)]
        for expected in (
            "as measured",
            "1 mean taken off",
            "2 spikes taken out",
            "3 holes filled",
            "4 levelled",
            "2 pixels taken out",
            "3 pixels filled",
        ):
            self.assertIn(expected, texts)
        self.assertTrue(any(text.endswith("everywhere") for text in texts), texts)
        rows = rows_of(self.stages())
        self.assertEqual([row["changed"] for row in rows], [None, 64 * 96 - 1, 2, 3, 64 * 96])
        self.assertEqual([row["missing"] for row in rows], [1, 1, 3, 0, 0])
        self.assertIsNone(rows[2]["change"])  # what was taken out has no height to compare
        self.assertEqual(rows[4]["pull_off"], 4e-7)

    def test_the_extremum_of_the_energy_is_marked_where_it_is(self):
        figure, axes = plt.subplots()
        self.addCleanup(plt.close, figure)
        report_figures.draw_energy_at_rest(axes, result())
        labels = [line.get_label() for line in axes.lines]
        # the step nearest to 50 nm, of 0.7 nm
        place = float(
            next(label for label in labels if label.startswith("extremum")).split("=")[1].split()[0]
        )
        self.assertAlmostEqual(place, 50.0, delta=0.4)
        shown = axes.get_xlim()
        self.assertGreater(shown[0], 25.0)  # of 55 nm: the beginning is left out

    def test_noise_of_a_millionth_is_a_level_line(self):
        for values, least in (([3.0402229, 3.0402235], 0.15), ([-2.0, -2.0], 0.1)):
            figure, axes = plt.subplots()
            self.addCleanup(plt.close, figure)
            axes.plot(values)
            widen(axes, values)
            low, high = axes.get_ylim()
            self.assertGreater(high - low, least)
            self.assertTrue(low < min(values) and max(values) < high)
        figure, axes = plt.subplots()
        self.addCleanup(plt.close, figure)
        axes.plot([1.0, 2.0])
        before = axes.get_ylim()
        widen(axes, [1.0, 2.0])
        self.assertEqual(axes.get_ylim(), before)


class SurfaceTest(unittest.TestCase):
    def test_a_uniform_distribution_is_core_alone(self):
        curve = MaterialRatioCurve(np.linspace(0, 1e-8, 10001).reshape(1, -1))
        self.assertAlmostEqual(curve.sk, 1e-8, delta=1e-14)
        self.assertLess(max(curve.spk, curve.svk), 1e-13)

    def test_a_gaussian_has_the_core_of_the_normal_distribution(self):
        # The line through the middle 40 % of its quantiles: slope 12/w^3 times the integral of (p -
        # 1/2) h(p).
        moment, _ = integrate.quad(lambda p: (p - 0.5) * stats.norm.ppf(p), 0.3, 0.7)
        expected = 12 / 0.4**3 * moment
        heights = stats.norm.ppf((np.arange(200000) + 0.5) / 200000).reshape(400, 500)
        curve = MaterialRatioCurve(heights)
        self.assertAlmostEqual(
            curve.sk / expected, 1.0, delta=2e-3
        )  # the flattest window is found in steps of 0.001
        self.assertAlmostEqual(curve.spk, curve.svk, delta=0.01)
        self.assertAlmostEqual(curve.smr1, 1 - curve.smr2, delta=0.005)

    def test_one_height_and_missing_pixels_are_no_trouble(self):
        curve = MaterialRatioCurve(np.full((4, 4), 3e-9))
        self.assertAlmostEqual(curve.sk, 0.0, delta=1e-20)
        with_holes = rough()
        with_holes[::7, ::5] = np.nan
        self.assertTrue(math.isfinite(MaterialRatioCurve(with_holes).sk))

    def test_a_wave_stands_at_its_frequency_with_its_power(self):
        pitch, wavelength, amplitude = 1e-8, 16e-8, 2e-9
        x = pitch * np.arange(256)
        heights = np.tile(amplitude * np.sin(2 * np.pi * x / wavelength), (5, 1))
        heights[2, 100] = np.nan
        frequencies, densities, count = profile_spectrum(heights, pitch)
        self.assertEqual(count, 4)
        self.assertAlmostEqual(frequencies[np.argmax(densities)] * wavelength, 1.0, delta=1e-9)
        power = densities.sum() * (frequencies[1] - frequencies[0])
        self.assertAlmostEqual(
            power / (amplitude**2 / 2), 1.0, delta=0.02
        )  # the line that is taken off has a little of it

    def test_without_a_whole_line_there_is_no_spectrum(self):
        heights = rough()
        heights[:, 3] = np.nan
        self.assertEqual(len(profile_spectrum(heights, 1e-8)[0]), 0)


class StepsTest(unittest.TestCase):
    def test_the_first_steps_are_those_that_run_first(self):
        for configuration in (
            {
                "preprocessing": {
                    "level": "plane",
                    "spikes/enabled": True,
                    "lines/method": "median",
                    "tip/radius": 0,
                    "refine/factor": 1,
                }
            },
            {
                "preprocessing": {
                    "level": "plane",
                    "spikes": {"enabled": True},
                    "lines": {"method": "median"},
                }
            },
        ):
            self.assertEqual(steps_of(configuration), ["lines", "spikes", "level"])
            self.assertEqual(steps_of(first_steps(configuration, ["lines"])), ["lines"])
            self.assertEqual(steps_of(first_steps(configuration, [])), [])
            self.assertEqual(len(steps_of(configuration)), 3)  # its own are left alone
        self.assertEqual(steps_of({}), [])


class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls._folder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls._folder.name)
        cls.scan = cls.folder / "afm.txt"
        subprocess.run([AFM_SCAN, str(cls.scan)], check=True, timeout=300)
        (cls.folder / "afm.txt.yaml").write_text(
            "pitch_x: 10.0e-9\npitch_y: 10.0e-9\nheight_scale: 1.0e-9\n"
        )
        (cls.folder / "clean.yaml").write_text(
            "load: {mechanical_load: 1.0e-6}\npreprocessing: {spikes: {enabled: true}, level: "
            "plane}\n"
        )
        (cls.folder / "plain.yaml").write_text("load: {mechanical_load: 1.0e-6}\n")

    @classmethod
    def tearDownClass(cls):
        cls._folder.cleanup()

    def run_program(self, name, *arguments):
        return subprocess.run(
            [find_node("mems_stiction", name)[0]] + [str(argument) for argument in arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=120,
        )

    def test_each_cleaning_step_stands_beside_its_prediction_and_flags_need_no_device(self):
        done = self.run_program(
            "stiction_report",
            "-c",
            self.folder / "clean.yaml",
            "-o",
            self.folder / "r.html",
            self.scan,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "r.html").read_text(encoding="utf-8")
        record = json.loads(
            self.run_program(
                "predict_scan", "--json", "-c", self.folder / "plain.yaml", self.scan
            ).stdout
        )
        cleaned = json.loads((self.folder / "r.json").read_text())["scans"][0]
        table = text[text.index("What each cleaning step did") :]
        self.assertIn("<td>as measured</td>", table)
        first, last = table.index("<td>as measured</td>"), table.index("<td>levelled</td>")
        self.assertLess(table.index("<td>spikes taken out</td>"), last)
        self.assertIn(
            unbroken(report.text_of(record["pull_off_force"], "N")), table[first : first + 300]
        )
        self.assertIn(
            unbroken(report.text_of(cleaned["pull_off_force"], "N")), table[last : last + 300]
        )
        for expected in (
            "root mean square height Sq",
            "core height Sk",
            "developed interfacial area ratio Sdr",
            "Outside the model's range: ",
        ):
            self.assertIn(expected, text)
        self.assertEqual(text.count("data:image/png;base64,"), 4)
        without = self.run_program(
            "stiction_report",
            "-c",
            self.folder / "clean.yaml",
            "--steps",
            0,
            "-o",
            self.folder / "s.html",
            self.scan,
        )
        self.assertEqual(without.returncode, 0, without.stderr)
        self.assertNotIn(
            "What each cleaning step did", (self.folder / "s.html").read_text(encoding="utf-8")
        )

    def test_why_steps_are_not_shown_is_said(self):
        (self.folder / "grid.txt").write_text("nan 1e-9 2e-9\n0 0 1e-9\n" * 4)
        configuration = {
            "preprocessing": {"level": "plane", "fill/enabled": True},
            "scan": {"pitch_x": 0.0},
        }
        with self.assertRaisesRegex(CannotShow, "the scan is not predicted: .*pitch"):
            stages_of(
                find_node("mems_stiction", "stiction_batch")[0],
                {"configuration": configuration, "total": 1},
                [str(self.folder / "grid.txt")],
                1,
                None,
                self.folder,
            )

    def test_a_place_that_cannot_be_written_is_one_line_before_any_work(self):
        (self.folder / "folder.html").mkdir()
        for output, reason in (
            ("/proc/r.html", "nothing can be written to '/proc'"),
            ("/no/such/r.html", "there is no folder"),
            (self.folder / "folder.html", "is a folder"),
        ):
            done = self.run_program("stiction_report", "-o", output, self.scan)
            self.assertEqual(done.returncode, 2)
            self.assertIn(reason, done.stderr.splitlines()[-1])
            self.assertNotIn("Traceback", done.stderr)
            self.assertNotIn("rows", done.stdout)

    def test_no_to_sticking_is_releases(self):
        self.assertEqual(
            [report.verdict_word(word) for word in ("no", "marginal", "yes", "unknown", None)],
            ["releases", "marginal", "sticks", "not known", "not known"],
        )


if __name__ == "__main__":
    unittest.main()
