"""Numbers have a decimal point whatever locale the process runs in: the module under one with a
decimal comma, against itself under "C"."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

try:
    from mems_stiction import _core  # noqa: F401
except ImportError:
    raise unittest.SkipTest("the Python module is not built: MEMS_STICTION_WITH_PYTHON is off")

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from tiers import times  # noqa: E402  (the path comes first)

HERE = pathlib.Path(__file__).resolve().parent
COMMA = "de_DE.UTF-8"
TURKISH = "tr_TR.UTF-8"  # a decimal comma, too, and tolower("I") is "I"
TESTS = ["test_module_words"] + times(
    [],
    [
        "test_module",
        "test_module_arrays",
        "test_module_device",
        "test_module_inputs",
        "test_module_runs",
        "test_made_surface",
    ],
)

# Sizes, sensitivities and resolutions that are no whole numbers, so that each of them shows who
# reads it wrong.
NANOSCOPE = (
    "\\*File list\r\n\\Version: 0x07200000\r\n\\Data length: 4096\r\n\\*Scanner list\r\n\\@Sens. "
    "Zsens: V 12.34567 nm/V\r\n"
    "\\*Ciao scan list\r\n\\Scan Size: 1.5 um\r\n\\Samps/line: 8\r\n\\Lines: 8\r\n\\Aspect Ratio: "
    "1:1\r\n"
    "\\@1:ZLimit: V [Sens. Zsens] (0.006713867 V/LSB) 100.0000 V\r\n\\*Ciao image list\r\n\\Data "
    "offset: 4096\r\n\\Data length: 128\r\n"
    "\\Bytes/pixel: 2\r\n\\Samps/line: 8\r\n\\Number of lines: 8\r\n\\Aspect Ratio: 1:1\r\n\\Scan "
    "Size: 1.5 1.5 ~m\r\n"
    "\\@2:Z scale: V [Sens. Zsens] (0.0003750000 V/LSB) 24.57563 V\r\n\\@2:Image Data: S [Height] "
    '"Height"\r\n\\*File list end\r\n\x1a'
)
SURFER = (
    "DSAA\n4 4\n0 1.5\n0 1.5\n0.25 2.75\n"
    + "0.25 0.5 0.75 1.0\n1.25 1.5 1.75 2.0\n2.25 2.5 2.75 0.5\n0.5 0.75 1.0 1.25\n"
)


def answers(folder, locale_name):
    """Everything that has numbers in it, as text; run in a process of its own."""
    import locale
    import warnings

    import mems_stiction
    import numpy as np
    from module_cases import CLEANING, DEVICE, FEW, PITCH, frames, rough, without_times

    locale.setlocale(locale.LC_ALL, locale_name)
    said = []
    folder = pathlib.Path(folder)
    (folder / "scan.txt").write_text(
        "# Width: 1.25 um\n# Height: 1.25 um\n# Value units: nm\n"
        + "".join("\t".join("%.3f" % value for value in row) + "\n" for row in 1e9 * rough(20, 20))
    )
    (folder / "LOUD.txt").write_text(
        (folder / "scan.txt")
        .read_text()
        .replace("Width: 1.25 um", "WIDTH: 1.25 um")
        .replace("Height:", "HEIGHT:")
    )
    (folder / "surface.grd").write_text(SURFER)
    (folder / "surface.grd.yaml").write_text(
        "pitch_x: 1.5e-8\npitch_y: 1.5e-8\nheight_scale: 1.0e-9\n"
    )
    (folder / "scan.000").write_bytes(
        NANOSCOPE.encode("latin-1").ljust(4096, b"\0") + np.arange(64, dtype="<i2").tobytes()
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        settings = mems_stiction.Settings(
            load={"voltage": 2.5, "mechanical_load": 1.25e-6},
            interface={"insulator_thickness": 2.5e-9},
            device=DEVICE,
        )
        said += [
            settings.yaml(),
            repr(settings),
            mems_stiction.Settings({"load/mechanical_load": 0.75e-6}).yaml(),
        ]
        for name in ("scan.txt", "LOUD.txt", "surface.grd", "scan.000"):
            scan = mems_stiction.read(folder / name)
            said += [name, scan.heights.tolist(), scan.pitch, mems_stiction.predict(scan).to_dict()]
        for heights in list(frames().values())[-times(1, 5) :]:
            cleaned = mems_stiction.clean(heights, PITCH, preprocessing=CLEANING)
            prediction = mems_stiction.predict(cleaned, device=DEVICE)
            said += [
                str(prediction),
                repr(cleaned),
                prediction.to_dict(),
                mems_stiction.predict(cleaned, config=settings).to_dict(),
            ]
        said += [
            str(mems_stiction.half_space(rough(20, 20), PITCH)),
            str(
                mems_stiction.predict_device(
                    [rough(32, 32)], pitch=PITCH, device=DEVICE, device_force=FEW
                )
            ),
        ]
        for wrong in (
            {"load/voltage": "2,5"},
            {"load/voltage": -0.5},
            {"preprocessing/fill/max_fraction": 1.5},
        ):
            try:
                mems_stiction.Settings(wrong)
            except mems_stiction.OptionsError as error:
                said.append(str(error))
    said += sorted(str(warning.message) for warning in caught)
    plain = [
        without_times(one)
        if isinstance(one, dict)
        else re.sub(r" in [0-9.e-]+ [a-z]*s$", "", one)
        if isinstance(one, str)
        else one
        for one in said
    ]
    print(json.dumps(plain, indent=1, default=str, sort_keys=True))


class LocaleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        for name in (COMMA, TURKISH):
            subprocess.run(
                [
                    "localedef",
                    "-i",
                    name.partition(".")[0],
                    "-f",
                    "UTF-8",
                    str(pathlib.Path(cls.folder.name) / name),
                ],
                check=True,
                timeout=120,
            )
        cls.environment = dict(os.environ, LOCPATH=cls.folder.name)
        cls.environment.pop("LC_ALL", None)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def run_python(self, code, *arguments):
        run = subprocess.run(
            [sys.executable, "-c", code, *arguments],
            env=self.environment,
            cwd=str(HERE),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            encoding="utf-8",
            timeout=800,
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def test_the_locale_has_a_decimal_comma(self):
        shown = self.run_python(
            "import locale, sys; locale.setlocale(locale.LC_ALL, sys.argv[1]); "
            "print(locale.localeconv()['decimal_point'])",
            COMMA,
        )
        self.assertEqual(shown, ",\n")

    def test_answers_are_those_of_a_decimal_point(self):
        said = {}
        for name in ("C", COMMA, TURKISH):
            with tempfile.TemporaryDirectory() as folder:
                code = (
                    "import sys; sys.path.insert(0, sys.argv[1]); import test_locale; "
                    "test_locale.answers(*sys.argv[2:])"
                )
                said[name] = (
                    self.run_python(code, str(HERE), folder, name)
                    .replace(folder, "FOLDER")
                    .splitlines()
                )
        self.assertIn("the decimal sign is a point", "\n".join(said["C"]), "a refusal")
        self.assertEqual(said[COMMA], said["C"])
        self.assertEqual(said[TURKISH], said["C"])

    def test_the_tests_of_the_module_pass(self):
        code = (
            "import locale, sys, unittest; locale.setlocale(locale.LC_ALL, sys.argv[1]); "
            "unittest.main(module=None, argv=['test'] + sys.argv[2:])"
        )
        self.run_python(code, COMMA, *TESTS)


if __name__ == "__main__":
    unittest.main()
