"""What people see of the Python module: texts, pictures, descriptions, types, the notebook."""

import pathlib
import pickle
import subprocess
import sys
import tempfile
import unittest

import mems_stiction
import numpy as np

try:
    from mems_stiction import _core
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from mems_stiction.prediction_text import FLAGS, flag_words  # noqa: E402
from module_cases import DEVICE, FEW, FORMULATIONS, PITCH, REPOSITORY, rough  # noqa: E402  (the path comes first)
from tiers import evidence  # noqa: E402


class TextTest(unittest.TestCase):
    def test_results_are_read_only_and_say_where_they_come_from(self):
        prediction = mems_stiction.predict(rough(20, 20), PITCH)
        results = [
            prediction,
            prediction.roughness,
            mems_stiction.half_space(rough(20, 20), PITCH),
            mems_stiction.cycle_contact(rough(20, 20), PITCH, count=2),
            mems_stiction.sweep_loads(rough(20, 20), PITCH, voltages=[0.0]),
        ]
        for result in results:
            for name in ("pull_off_force", "pitch", "anything"):
                self.assertRaisesRegex(
                    AttributeError, "a result cannot be changed", setattr, result, name, 1.0
                )
            self.assertRaisesRegex(
                AttributeError,
                "a result cannot be changed",
                delattr,
                result,
                next(iter(vars(result))),
            )
        copied = pickle.loads(pickle.dumps(prediction))
        record = prediction.to_dict()
        for one in (prediction, copied):
            self.assertEqual(
                (one.version, one.settings_hash), (record["version"], record["settings_hash"])
            )
        self.assertEqual(mems_stiction.__version__, record["version"])
        other = mems_stiction.predict(rough(20, 20), PITCH, load={"mechanical_load": 2e-6})
        self.assertNotEqual(other.settings_hash, prediction.settings_hash)

    def test_dir_has_what_users_use(self):
        names = [name for name in dir(mems_stiction) if not name.startswith("__")]
        self.assertEqual(names, sorted(mems_stiction.__all__))
        self.assertIn("__version__", dir(mems_stiction))

    def test_a_line_is_refused_with_a_reason(self):
        for line in (np.zeros(64), [1e-9, 2e-9, 3e-9]):
            with self.assertRaisesRegex(
                mems_stiction.SurfaceError, "one line says nothing of the contacts beside it"
            ):
                mems_stiction.predict(line, PITCH)

    def test_a_half_space_has_a_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "solved.png"
            mems_stiction.half_space(
                rough(20, 20), PITCH, lower={"youngs_modulus": 1e9}, upper={"youngs_modulus": 1e9}
            ).save_picture(path)
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG")
            self.assertEqual([one.name for one in pathlib.Path(folder).iterdir()], ["solved.png"])

    def test_text_and_page(self):
        prediction = mems_stiction.predict(
            rough(64, 64, 12e-9, 2), PITCH, device=DEVICE, device_force=FEW
        )
        self.assertRegex(
            repr(prediction), r"equilibrium\n  pull-off force [\d.]+ [nu]N on .*\n.*\n  sticks: "
        )
        page = prediction._repr_html_()
        self.assertIn('<img src="data:image/png;base64,iVBOR', page)
        self.assertIn("does the device stick?", page)
        for formulation in FORMULATIONS:
            bare = mems_stiction.predict(
                rough(20, 30),
                PITCH,
                approach={"formulation": formulation},
                output={"contact_map": False, "deformed_surfaces": False},
            )
            self.assertIn("<img", bare._repr_html_())
        soft = {"youngs_modulus": 1e9}
        solved = mems_stiction.half_space(rough(24, 24), PITCH, lower=soft, upper=soft)
        self.assertIn("<img", solved._repr_html_())
        self.assertIn("Half-space: solved", repr(solved))

    def test_a_picture_leaves_the_backend_of_pyplot_alone(self):
        code = (
            "import matplotlib; matplotlib.use('svg')\nimport mems_stiction, numpy\n"
            "mems_stiction.predict(numpy.eye(20) * 1e-9, "
            "20e-9)._repr_html_()\nprint(matplotlib.get_backend().lower())"
        )
        done = subprocess.run(
            [sys.executable, "-W", "ignore", "-c", code],
            stdout=subprocess.PIPE,
            universal_newlines=True,
            check=True,
        )
        self.assertEqual(done.stdout.strip(), "svg")

    def test_messages_and_pictures_do_not_load_the_core(self):
        code = "import mems_stiction.plots, sys; print('mems_stiction._core' in sys.modules)"
        done = subprocess.run(
            [sys.executable, "-c", code],
            stdout=subprocess.PIPE,
            universal_newlines=True,
            check=True,
        )
        self.assertEqual(done.stdout.strip(), "False")

    def test_every_figure_has_its_declaration(self):
        prediction = mems_stiction.predict(rough(20, 30), PITCH, device=DEVICE, device_force=FEW)
        for value, name in (
            (prediction, "Prediction"),
            (prediction.verdict, "Verdict"),
            (prediction.roughness, "Roughness"),
            (mems_stiction.half_space(rough(20, 20), PITCH), "HalfSpace"),
        ):
            declared = _core.figures[name + "Figures"]
            self.assertGreater(len(declared), 10)
            for figure, (kind, unit, meaning) in declared.items():
                self.assertEqual(type(getattr(value, figure)).__name__, kind, figure)
                self.assertIn(
                    "\n%s%s: %s" % (figure, " [%s]" % unit if unit else "", meaning),
                    type(value).__doc__,
                )
                self.assertTrue(meaning, figure)

    def test_every_name_has_a_description(self):
        for name in mems_stiction.__all__:
            self.assertTrue(getattr(mems_stiction, name).__doc__, name)
            self.assertIn(name, dir(mems_stiction))


class FlagTest(unittest.TestCase):
    def test_flags_have_the_words_of_the_core(self):
        for flag, (name, words) in FLAGS.items():
            self.assertEqual(_core.regime_flag_sentences(flag, ""), [words])
            self.assertEqual(
                "; ".join(_core.regime_flag_sentences(flag, "it tears")),
                flag_words([name], "it tears"),
            )


class TypeTest(unittest.TestCase):
    @evidence
    def test_types_fit(self):
        try:
            import mypy.api
        except ImportError:
            self.skipTest("mypy is not installed")
        files = sorted(
            str(path) for path in (REPOSITORY / "python" / "mems_stiction").glob("_*.py*")
        )
        files = [path for path in files if not path.endswith("__init__.py")] + [
            str(REPOSITORY / "python" / "mems_stiction" / "archive.py"),
            str(REPOSITORY / "test" / "python" / "module_use.py"),
        ]
        with tempfile.TemporaryDirectory() as cache:
            out, err, status = mypy.api.run(
                ["--config-file", str(REPOSITORY / "pyproject.toml"), "--cache-dir", cache] + files
            )
        self.assertEqual(status, 0, out + err)

    def test_the_stub_is_that_of_the_compiled_part(self):
        done = subprocess.run(
            [sys.executable, str(REPOSITORY / "scripts" / "lib" / "core_stub.py"), "--check"],
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)


class NotebookTest(unittest.TestCase):
    @evidence
    def test_it_runs(self):
        try:
            import nbclient
            import nbformat
            import ipykernel  # noqa: F401
        except ImportError as missing:
            self.skipTest("%s is not installed" % missing.name)
        for path in sorted((REPOSITORY / "doc" / "notebooks").glob("*.ipynb")):
            notebook = nbformat.read(str(path), as_version=4)
            self.assertTrue(
                all(not cell.get("outputs") for cell in notebook.cells),
                "%s holds outputs" % path.name,
            )
            with tempfile.TemporaryDirectory() as folder:
                nbclient.NotebookClient(
                    notebook,
                    timeout=600,
                    kernel_name="python3",
                    resources={"metadata": {"path": folder}},
                ).execute()
            shown = [
                output
                for cell in notebook.cells
                for output in cell.get("outputs", [])
                if "text/html" in output.get("data", {})
            ]
            self.assertGreater(len(shown), 0)

    def test_between_them_they_show_the_doors_of_the_module(self):
        text = "".join(
            path.read_text(encoding="utf-8")
            for path in (REPOSITORY / "doc" / "notebooks").glob("*.ipynb")
        )
        for door in ("predict(", "predict_device(", "calibrate(", "clean("):
            self.assertIn("mems_stiction." + door, text)


if __name__ == "__main__":
    unittest.main()
