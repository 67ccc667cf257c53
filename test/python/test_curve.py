"""plot_curve and what it reads: curves of force over height, whichever model they are of."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from mems_stiction.curve import Curve, CurveError, read_curve
from mems_stiction.curve_figure import curve_picture
from mems_stiction.plots import plt

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from one_process import run_in_one_process  # noqa: E402  (the path comes first)

PLOT_CURVE = pathlib.Path(__file__).resolve().parents[2] / "scripts/plot_curve"
HEAD = "height,force,direction\n"


def attraction(heights):
    """Smooth, with its largest attraction, 1e-7 N, at 2e-10 m."""
    x = np.asarray(heights) / 2e-10
    return 1e-7 * (3 / x**2 - 2 / x**3)


def points(jump_at=None):
    heights = np.linspace(1.4e-10, 1e-9, 44)
    retraction = attraction(heights)
    if jump_at is not None:
        retraction = np.where(heights > jump_at, 0.1 * retraction, retraction)
    return [(h, f, "APPROACH") for h, f in zip(heights[::-1], attraction(heights)[::-1])] + [
        (h, f, "RETRACTION") for h, f in zip(heights, retraction)
    ]


class CurveTest(unittest.TestCase):
    def test_the_pull_off_force_is_the_largest_attraction_of_the_retraction(self):
        curve = Curve("a", points())
        height, force = curve.pull_off()
        self.assertAlmostEqual(height, 2e-10, delta=2e-11)  # the points are that far apart
        self.assertAlmostEqual(force, 1e-7, delta=1e-9)
        self.assertTrue(curve.came_apart())

    def test_a_path_that_was_broken_off_says_so(self):
        curve = Curve("a", points()[:50])
        self.assertFalse(curve.came_apart())
        self.assertIsNone(Curve("a", points()[:40]).pull_off())

    def test_a_stated_pull_off_force_stands_at_the_highest_point(self):
        height, force = Curve("a", points(), 1.01e-7).pull_off()
        self.assertAlmostEqual(height, 2e-10, delta=2e-11)  # the points are that far apart
        self.assertEqual(force, 1.01e-7)

    def test_a_jump_is_found_and_a_smooth_curve_has_none(self):
        self.assertEqual(Curve("a", points()).retraction.jumps(), [])
        way = Curve("a", points(jump_at=4e-10)).retraction
        self.assertEqual(len(way.jumps()), 1)
        place = way.jumps()[0]
        self.assertTrue(way.heights[place] <= 4e-10 < way.heights[place + 1])

    def test_two_jumps_one_after_the_other_are_two(self):
        forces = [10.0, 9.9, 9.8, 9.7, 5.0, 4.9, 1.0, 0.9, 0.8, 0.7]
        way = Curve(
            "a", [(height, force, "RETRACTION") for height, force in enumerate(forces)]
        ).retraction
        self.assertEqual(way.jumps(), [3, 5])


class PictureTest(unittest.TestCase):
    def picture(self, *curves):
        figure = curve_picture(list(curves), "title")
        self.addCleanup(plt.close, figure)
        axes = figure.axes[0]
        return axes, [text.get_text() for text in axes.get_legend().get_texts()]

    def test_axes_have_units_with_prefixes_and_the_mark_stands_on_the_pull_off_force(self):
        axes, legend = self.picture(Curve("a", points()))
        self.assertIn("[nm]", axes.get_xlabel())
        self.assertIn("[nN]", axes.get_ylabel())
        mark = [line for line in axes.lines if line.get_marker() == "v"]
        self.assertEqual(len(mark), 1)
        self.assertAlmostEqual(mark[0].get_ydata()[0], 100.0, delta=1.0)
        self.assertIn("pull-off 100 nN", " ".join(legend))
        self.assertNotIn("jump", legend)

    def test_a_jump_is_dotted_and_interrupts_the_line(self):
        axes, legend = self.picture(Curve("a", points(jump_at=4e-10)))
        self.assertIn("jump", legend)
        self.assertTrue(
            any(
                np.isnan(line.get_ydata()).any()
                for line in axes.lines
                if line.get_linestyle() == "-"
            )
        )

    def test_several_are_told_apart_by_their_names(self):
        _, legend = self.picture(
            Curve("first", points()), Curve("second", points(jump_at=4e-10)[:60])
        )
        self.assertTrue({"first, approach", "second, retraction"} <= set(legend))

    def test_deep_repulsion_leaves_the_picture_and_is_named(self):
        pressed = points() + [(-1e-9, -1e-3, "RETRACTION")]
        axes, _ = self.picture(Curve("a", pressed))
        self.assertGreater(
            axes.get_ylim()[0], -1000.0
        )  # nN; else a millinewton hides a hundred nanonewtons
        self.assertGreater(axes.get_xlim()[0], 0.05)  # nm: what is not shown needs no room
        self.assertIn(
            "-1.00 mN", " ".join(text.get_text() for text in axes.get_legend().get_texts())
        )


class PlotCurveTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def run_it(self, *arguments):
        return subprocess.run(
            [sys.executable, str(PLOT_CURVE)] + [str(part) for part in arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            stdin=subprocess.DEVNULL,
            universal_newlines=True,
            timeout=120,
        )

    def curve_file(self, name="curve.csv"):
        return self.write(name, HEAD + "".join("%.17g,%.17g,%s\n" % point for point in points()))

    def test_a_picture_stands_beside_the_file_or_where_it_is_wanted(self):
        first, second = self.curve_file(), self.curve_file("other.csv")
        done = self.run_it(first, second)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.folder / "curve.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(self.run_it(first, "-o", self.folder / "p.pdf").returncode, 0)
        self.assertEqual((self.folder / "p.pdf").read_bytes()[:5], b"%PDF-")

    def test_columns_of_another_model_are_left_out_and_may_stand_anywhere(self):
        path = self.write(
            "a.csv", "gap,direction,force,height\n3,APPROACH,-2e-9,1e-9\n4,RETRACTION,5e-9,2e-9\n"
        )
        curve = read_curve(path, "a")
        self.assertEqual(
            (list(curve.approach.heights), list(curve.approach.forces)), ([1e-9], [-2e-9])
        )
        self.assertEqual(curve.pull_off(), (2e-9, 5e-9))
        self.assertEqual(self.run_it(path).returncode, 0)

    def test_bad_input_is_one_line_with_file_place_and_what_is_allowed(self):
        good = self.curve_file()
        cases = [
            (
                [self.write("a.csv", HEAD + "1e-9,2e-9,APPROACH\n1e-9,much,APPROACH\n")],
                ("a.csv: line 3: force: 'much'", "a finite number"),
            ),
            (
                [self.write("b.csv", HEAD + "nan,2e-9,APPROACH\n")],
                ("b.csv: line 2: height: 'nan'", "a finite number"),
            ),
            (
                [self.write("c.csv", HEAD + "1e-9\n")],
                ("c.csv: line 2: direction: ''", "APPROACH, RETRACTION"),
            ),
            (
                [self.write("d.csv", HEAD + "1e-9,2e-9,DOWN\n")],
                ("d.csv: line 2: direction: 'DOWN'", "APPROACH, RETRACTION"),
            ),
            (
                [self.write("e.csv", "height,load\n1,2\n")],
                ("e.csv: line 1: ", "'force', 'direction'", "height, force, direction"),
            ),
            ([self.write("f.csv", "")], ("f.csv: line 1: ", "height, force, direction")),
            ([self.write("g.csv", HEAD)], ("g.csv: has no point",)),
            ([self.folder / "none.csv"], ("none.csv: cannot be read",)),
            ([good, "-o", self.folder / "p.jpg"], ("--output", ".png, .pdf or .svg")),
            ([good, "-o", self.folder / "none/p.png"], ("none/p.png' cannot be written",)),
        ]
        answers = run_in_one_process([PLOT_CURVE] + arguments for arguments, _ in cases)
        for (status, _, error), (_, expected) in zip(answers, cases):
            self.assertEqual((status, error.count("\n")), (2, 1), error)
            for text in expected:
                self.assertIn(text, error)
        (self.folder / "h.csv").write_bytes(b"\xff\xfe\x00\x01")
        with self.assertRaises(CurveError):
            read_curve(self.folder / "h.csv", "h")


if __name__ == "__main__":
    unittest.main()
