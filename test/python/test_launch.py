"""Launch files: an argument that nobody declares is a slip, not a default."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

LAUNCH = pathlib.Path(__file__).resolve().parents[2] / "launch"


def nodes(path, *arguments):
    return subprocess.run(["roslaunch", "--nodes", str(path)] + list(arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=300)


class LaunchTest(unittest.TestCase):
    def test_a_misspelt_argument_is_refused_by_its_name(self):
        for path in sorted(LAUNCH.glob("*.launch")):
            needed = ["bag:=scans.bag"] if path.name == "demo.launch" else []
            self.assertIn("/", nodes(path, *needed).stdout)
            done = nodes(path, "confg:=device.yaml", *needed)
            self.assertNotEqual(done.returncode, 0, path)
            self.assertIn("no such argument: confg", done.stdout + done.stderr, path)

    def test_every_argument_that_is_declared_is_known(self):
        for path in sorted(LAUNCH.glob("*.launch")):
            text = path.read_text().split("<include")[0]
            declared = set(re.findall(r'<arg name="(\w+)"(?: default=| doc=)', text))
            (known,) = re.findall(r"name not in \(([^)]*)\)", text)
            self.assertEqual(set(re.findall(r"'(\w+)'", known)), declared, path)

    def test_names_of_ros_itself_pass(self):
        self.assertIn("/afm/stiction_node", nodes(LAUNCH / "stiction.launch", "__ns:=afm").stdout)

    def test_a_file_that_passes_all_of_its_arguments_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "station.launch")
            for more, status in (("", 1), ('<arg name="other_args" value="taken" />', 0)):
                with open(path, "w") as stream:
                    stream.write('<launch><arg name="bench" default="3" /><include file="%s" pass_all_args="true">%s</include></launch>'
                                 % (LAUNCH / "stiction.launch", more))
                self.assertEqual(nodes(path).returncode, status)


if __name__ == "__main__":
    unittest.main()
