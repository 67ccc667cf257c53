"""plot_device and predict_device --picture: what is drawn of a device's force, and what is
refused."""

import copy
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from mems_stiction import device_figure
from mems_stiction.plots import plt

PLOT_DEVICE = pathlib.Path(__file__).resolve().parents[2] / "scripts/plot_device"


def band(wavelength, is_measured=True):
    density = 1e-30 * (wavelength / 1e-6) ** 3
    return {
        "wavelength": wavelength,
        "density": density,
        "density_lower": 0.7 * density,
        "density_upper": 1.4 * density,
        "rms_height": 4e-9 * (wavelength / 1e-6) ** 0.5,
        "rms_slope": 0.1,
        "rms_curvature": 1e6,
        "is_measured": is_measured,
    }


RECORD = {
    "scans": ["a.gwy", "b.gwy"],
    "area": 1e-10,
    "pull_off_force": 2e-6,
    "pull_off_force_lower": 1e-6,
    "pull_off_force_upper": 5e-6,
    "linear_pull_off_force": 4e-5,
    "realisations": [{"pull_off_force": force} for force in (1.5e-6, 2e-6, 2.5e-6)],
    "parts_of_scans": [
        {"area": 4e-12, "pull_off_force": 1.6e-6},
        {"area": 1e-12, "pull_off_force": 0.5e-6},
    ],
    "spectrum": [band(1e-6 * 2.0**step, step < 3) for step in range(5)],
    "settings_hash": "0123456789abcdef",
    "warnings": [
        "the spectrum still rises towards its longest wave: measure a field of at least 40 um"
    ],
}


class PictureTest(unittest.TestCase):
    def test_no_label_of_the_area_is_cut_at_the_edge(self):
        for area in (2.3e-9, 4e-9, 9.9e-9):  # up to 0.01 mm² at the end of the axis
            figure = self.drawn(dict(RECORD, area=area))
            figure.canvas.draw()
            labels = [label for label in figure.axes[-1].get_xticklabels() if label.get_text()]
            low, high = figure.axes[-1].get_xlim()
            shown = [label for label in labels if low <= label.get_position()[0] <= high]
            self.assertTrue(shown)
            for label in shown:
                self.assertLessEqual(label.get_window_extent().x1, figure.bbox.x1, area)

    def drawn(self, record, heights=None):
        figure = device_figure.device_picture(record, heights)
        self.addCleanup(plt.close, figure)
        return figure

    @staticmethod
    def panel(figure, title):
        return next(axes for axes in figure.axes if axes.get_title() == title)

    def test_measured_and_continued_bands_are_drawn_apart(self):
        lines = self.panel(self.drawn(RECORD), "What the scans say of the waves").get_lines()
        self.assertEqual(
            [line.get_label() for line in lines], ["measured", "continued beyond the scans"]
        )
        self.assertEqual(lines[0].get_linestyle(), "-")
        self.assertNotEqual(lines[1].get_linestyle(), "-")
        np.testing.assert_allclose(lines[0].get_xdata(), [1e-6, 2e-6, 4e-6])
        np.testing.assert_allclose(lines[1].get_xdata(), [4e-6, 8e-6, 16e-6])
        np.testing.assert_allclose(
            lines[0].get_ydata(), [one["density"] for one in RECORD["spectrum"][:3]]
        )

    def test_forces_stand_over_their_areas(self):
        axes = self.panel(self.drawn(RECORD), "Force against area")
        lines = {line.get_label().partition(":")[0]: line for line in axes.get_lines()}
        np.testing.assert_allclose(
            lines["scans and parts of them"].get_xydata(), [(4e-12, 1.6e-6), (1e-12, 0.5e-6)]
        )
        linear = lines["by area"]
        self.assertEqual(linear.get_linestyle(), "--")
        np.testing.assert_allclose(linear.get_xydata(), [(1e-12, 4e-7), (1e-10, 4e-5)])
        np.testing.assert_allclose(lines["made surfaces"].get_ydata(), [1.5e-6, 2e-6, 2.5e-6])
        labels = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertIn("the device: 2.0 µN, 95 % 1.0 µN to 5.0 µN", labels)

    def test_warnings_and_title_are_in_the_picture(self):
        figure = self.drawn(RECORD)
        self.assertEqual(figure._suptitle.get_text(), "Device of 100 µm², by 2 scans")
        self.assertTrue(
            any("measure a field of at least 40 µm" in text.get_text() for text in figure.texts)
        )

    def test_what_is_not_known_is_left_out(self):
        record = copy.deepcopy(RECORD)
        for one in record["spectrum"]:
            one.update(density_lower=None, density_upper=0.0, rms_slope=None, rms_height=0.0)
        record.update(
            pull_off_force_lower=None,
            pull_off_force_upper=None,
            linear_pull_off_force=None,
            parts_of_scans=[],
            warnings=[],
        )
        figure = self.drawn(record)
        self.assertEqual(
            [text.get_text() for axes in figure.axes for text in axes.texts],
            ["not known", "not known"],
        )
        record.update(spectrum=[], realisations=[], pull_off_force=None)
        self.drawn(record).canvas.draw()

    def test_a_made_surface_has_its_place(self):
        figure = self.drawn(RECORD, (np.arange(12.0).reshape(3, 4) * 1e-9, 20e-9))
        self.panel(figure, "A made surface")
        self.assertEqual(len(figure.axes), 7)  # with its colours


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def plot(self, *arguments):
        return subprocess.run(
            [sys.executable, str(PLOT_DEVICE)] + [str(argument) for argument in arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=120,
        )

    def test_it_draws_beside_the_record(self):
        path = self.folder / "record.json"
        path.write_text(json.dumps(RECORD))
        done = self.plot(path)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.folder / "record.png").read_bytes()[:4], b"\x89PNG")

    def test_heights_are_shown_with_their_pitch(self):
        path, heights = self.folder / "record.json", self.folder / "heights.npy"
        path.write_text(json.dumps(RECORD))
        np.save(str(heights), np.eye(8, 12) * 1e-9)
        done = self.plot(
            "-o", self.folder / "out.svg", "--heights", heights, "--pitch", "50e-9", path
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(
            "<!-- A made surface -->", (self.folder / "out.svg").read_text(encoding="utf-8")
        )
        self.assertIn("--pitch: None is not allowed", self.plot("--heights", heights, path).stderr)
        np.save(str(heights), np.arange(5.0))
        for wrong, words in (
            (heights, "holds no rows"),
            (path, "record.json: "),
            (self.folder / "none.npy", "none.npy: "),
        ):
            done = self.plot("--heights", wrong, "--pitch", "50e-9", path)
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)

    def test_what_is_no_record_is_named_in_one_line(self):
        texts = {
            "no.json": "no json",
            "list.json": "[1]",
            "deep.json": "[" * 200000,
            "other.json": json.dumps({"pull_off_force": 1.0}),
        }
        for name, text in texts.items():
            (self.folder / name).write_text(text)
        for name, words in (
            ("no.json", "is no JSON object"),
            ("deep.json", "is no JSON object"),
            ("list.json", "has no 'pull_off_force'"),
            ("other.json", "has no 'area'"),
            ("none.json", "no such file"),
        ):
            done = self.plot("-o", self.folder / "out.png", self.folder / name)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.assertIn(name, done.stderr)
            self.assertIn(
                words,
                done.stderr.lower()
                if words[0].islower() and words == "no such file"
                else done.stderr,
            )
        (self.folder / "record.json").write_text(json.dumps(RECORD))
        self.assertIn(
            "--output: ",
            self.plot("-o", self.folder / "out.jpg", self.folder / "record.json").stderr,
        )

    def test_predict_device_draws_its_picture(self):
        try:
            from roslib.packages import find_node
        except ImportError:
            raise unittest.SkipTest("without ROS the script does not lie beside the program")
        program = find_node("mems_stiction", "predict_device")[0]
        heights = np.random.RandomState(1).standard_normal((48, 48)) * 1e-9
        np.save(str(self.folder / "a.npy"), heights)
        command = [
            program,
            "--json",
            "--area",
            "1e-12",
            "--pitch",
            "10e-9",
            "--realisations",
            "3",
            "--max-cells",
            "1e4",
            str(self.folder / "a.npy"),
        ]
        plain = subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout
        picture = self.folder / "out.svg"
        done = subprocess.run(
            command + ["--picture", str(picture)],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, plain.decode())
        self.assertIn("<!-- A made surface -->", picture.read_text(encoding="utf-8"))
        lonely = shutil.copy(
            program, str(self.folder / "predict_device")
        )  # where no script lies beside it
        environment = dict(os.environ, PATH=str(self.folder))
        done = subprocess.run(
            [lonely] + command[1:] + ["--picture", str(self.folder / "none.png")],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            env=environment,
        )
        self.assertEqual(done.returncode, 2)
        self.assertIn("--picture: needs the program plot_device", done.stderr)


if __name__ == "__main__":
    unittest.main()
