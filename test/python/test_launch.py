"""Launch files: an argument that nobody declares is a slip, not a default."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import roslaunch
import roslaunch.config
from roslaunch.node_args import create_local_process_args

LAUNCH = pathlib.Path(__file__).resolve().parents[2] / "launch"
NEEDED = {"demo.launch": ["bag:=" + __file__], "afm_folder.launch": ["folder:=/data"]}


def nodes(path, *arguments):
    return subprocess.run(
        ["roslaunch", "--nodes", str(path)] + list(arguments),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        timeout=300,
    )


def loaded(path, *arguments):
    """What roslaunch would start and set."""
    return roslaunch.config.load_config_default([(str(path), list(arguments))], None, verbose=False)


def command(file, node, *arguments):
    """What roslaunch starts a node by, as a list of words."""
    config = loaded(LAUNCH / file, *arguments)
    found = next(one for one in config.nodes if one.name == node)
    return create_local_process_args(found, config.machines[found.machine_name or ""])


class LaunchTest(unittest.TestCase):
    def test_a_misspelt_argument_is_refused_by_its_name(self):
        for path in sorted(LAUNCH.glob("*.launch")):
            needed = NEEDED.get(path.name, [])
            self.assertTrue(loaded(path, *needed).nodes)
            with self.assertRaisesRegex(roslaunch.RLException, "no such argument: confg"):
                loaded(path, "confg:=device.yaml", *needed)

    def test_a_station_of_files_needs_their_folder(self):
        done = nodes(LAUNCH / "afm_folder.launch")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("'folder'", done.stdout + done.stderr)

    def test_every_argument_that_is_declared_is_known(self):
        for path in sorted(LAUNCH.glob("*.launch")):
            text = path.read_text().split("<include")[0]
            declared = set(re.findall(r'<arg name="(\w+)"(?: default=| doc=)', text))
            passed_on = re.search(r'/launch/(\w+.launch)" pass_all_args="true"', path.read_text())
            if passed_on:  # that file refuses what it does not know
                text = (LAUNCH / passed_on.group(1)).read_text()
            (known,) = re.findall(r"name not in \(([^)]*)\)", text)
            (self.assertLessEqual if passed_on else self.assertEqual)(
                declared, set(re.findall(r"'(\w+)'", known)), path
            )

    def test_names_with_blanks_quotes_and_umlauts_reach_the_programs_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("my scans.bag", "Jürgens 'Proben'.bag", 'a "b" c.bag', "back\\slash.bag"):
                path = os.path.join(folder, name)
                pathlib.Path(path).touch()
                self.assertEqual(command("demo.launch", "replay", "bag:=" + path)[-2], path)
                self.assertEqual(
                    command("view.launch", "stiction_trend", "trend_file:=" + path)[3:5],
                    ["--output", path],
                )
                self.assertEqual(
                    command("view.launch", "stiction_view", "rviz_config:=" + path)[2], path
                )
        self.assertNotIn("--output", command("view.launch", "stiction_trend"))

    def test_a_bag_that_is_not_there_is_refused_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            done = nodes(LAUNCH / "demo.launch", "bag:=%s/no such.bag" % folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("no such.bag", done.stdout + done.stderr)
            pathlib.Path(folder, "there.bag").touch()
            done = subprocess.run(
                ["roslaunch", "--nodes", str(LAUNCH / "demo.launch"), "bag:=there.bag"],
                cwd=folder,
                timeout=300,
                env=dict(os.environ, PWD=folder),
                stdout=subprocess.DEVNULL,
            )
            self.assertEqual(done.returncode, 0)

    def test_settings_that_are_not_there_are_refused_with_what_to_do(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, words in (
                (
                    "nope.yaml",
                    r"config:=nope\.yaml: there is no such file in .*; give its full path",
                ),
                (folder + "/nope.yaml", r"config:=/.*/nope\.yaml: there is no such file\n"),
                (folder, "config:=/.*: is no file of settings that can be read"),
            ):
                for file in ("stiction.launch", "station.launch"):
                    done = nodes(LAUNCH / file, "config:=" + name)
                    self.assertEqual(done.returncode, 1, done.stdout)
                    self.assertRegex(done.stderr, words)
            for name in ("my part.yaml", "Jürgens 'Teil'.yaml", 'a "b".yaml', "back\\slash.yaml"):
                path = pathlib.Path(folder, name)
                path.write_text("interface: {work_of_adhesion: 0.0625}  # Kommentar: ä\n")
                config = loaded(LAUNCH / "stiction.launch", "config:=%s" % path)
                text = config.params["/stiction_node/config/text"].value
                self.assertEqual(text, path.read_text())

    def test_names_of_ros_itself_pass(self):
        self.assertIn("/afm/stiction_node", nodes(LAUNCH / "stiction.launch", "__ns:=afm").stdout)

    def test_a_file_that_passes_all_of_its_arguments_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "station.launch")
            for more, status in (("", 1), ('<arg name="other_args" value="taken" />', 0)):
                with open(path, "w") as stream:
                    stream.write(
                        '<launch><arg name="bench" default="3" /><include file="%s" '
                        'pass_all_args="true">%s</include></launch>'
                        % (LAUNCH / "stiction.launch", more)
                    )
                self.assertEqual(nodes(path).returncode, status)


if __name__ == "__main__":
    unittest.main()
