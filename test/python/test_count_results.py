"""The last line of scripts/test tells the truth."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "lib" / "count_results.py"


class CountResultsTest(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.folder = pathlib.Path(self._folder.name)
        self.checks = self.folder / "checks.tsv"
        self.checks.write_text("")

    def write(self, name, cases):
        (self.folder / name).write_text(
            "<testsuites><testsuite>%s</testsuite></testsuites>" % cases
        )

    def run_program(self):
        done = subprocess.run(
            [sys.executable, str(PROGRAM), "--total", str(self.checks), str(self.folder)],
            stdout=subprocess.PIPE,
            universal_newlines=True,
        )
        return done.returncode, done.stdout.splitlines()

    def test_cases_are_counted_not_files(self):
        self.write(
            "a.xml",
            '<testcase classname="S" name="one"/><testcase classname="S" name="two"/>'
            '<testcase classname="S" name="three" result="skipped"><skipped message="no '
            'scans"/></testcase>',
        )
        status, lines = self.run_program()
        self.assertEqual((status, lines[-1]), (0, "2 passed, 0 failed, 1 skipped"))
        self.assertIn("skipped 1: no scans", lines)

    def test_a_failure_is_told_and_changes_the_status(self):
        self.write(
            "a.xml",
            '<testcase classname="S" name="one"><failure message="m">1 is not '
            "2</failure></testcase>",
        )
        status, lines = self.run_program()
        self.assertEqual((status, lines[-1]), (1, "0 passed, 1 failed, 0 skipped"))
        self.assertIn("FAILED  S.one", lines)
        self.assertIn("    1 is not 2", lines)

    def test_nothing_ran_is_a_failure(self):
        self.assertEqual(self.run_program(), (1, ["0 passed, 0 failed, 0 skipped"]))

    def test_a_failure_that_no_case_tells_is_a_failure(self):
        """rosunit counts the failures of a subTest, and leaves them out of its cases."""
        (self.folder / "rosunit-replay.xml").write_text(
            '<testsuite errors="1" failures="1" name="s"><testcase classname="S" '
            'name="one"/><testcase classname="S" name="two">'
            "<failure>1 is not 2</failure></testcase></testsuite>"
        )
        self.assertEqual(self.run_program()[1][-1], "1 passed, 2 failed, 0 skipped")

    def test_a_broken_result_file_is_a_failure(self):
        (self.folder / "a.xml").write_text("<testsuites><test")
        self.assertEqual(self.run_program()[1][-1], "0 passed, 1 failed, 0 skipped")

    def run_with_ctest(self, text):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "ctest.xml"
        path.write_text(text)
        done = subprocess.run(
            [
                sys.executable,
                str(PROGRAM),
                "--total",
                str(self.checks),
                "--ctest",
                str(path),
                str(self.folder),
            ],
            stdout=subprocess.PIPE,
            universal_newlines=True,
        )
        return done.returncode, done.stdout.splitlines()

    def test_a_program_that_left_no_failed_case_is_one(self):
        """It crashed, ran out of time, or was not found."""
        self.write("gtest-one_test.xml", '<testcase classname="S" name="one" time="12.5"/>')
        status, lines = self.run_with_ctest(
            '<testsuite><testcase name="_ctest_p_gtest_one_test" status="fail"><failure '
            'message="SEGFAULT"/><system-out>last words</system-out></testcase>'
            '<testcase name="_ctest_p_rostest_test_ros_page.test" status="notrun"/></testsuite>'
        )
        self.assertEqual((status, lines[-1]), (1, "1 passed, 2 failed, 0 skipped"))
        self.assertIn("    last words", lines)
        self.assertIn("   12.5 s  S.one", lines)

    def test_a_program_with_a_failed_case_is_not_told_twice(self):
        (self.folder / "test_ros_page").mkdir()
        self.write(
            "gtest-one_test.xml",
            '<testcase classname="S" name="one"><failure>no</failure></testcase>',
        )
        self.write(
            "test_ros_page/rosunit-page.xml",
            '<testcase classname="P" name="two"><failure>no</failure></testcase>',
        )
        self.write(
            "test_ros_page/rostest-test_ros_page.xml",
            '<testcase classname="R" name="testpage"><failure>no</failure></testcase>',
        )
        status, lines = self.run_with_ctest(
            '<testsuite><testcase name="_ctest_p_gtest_one_test" status="fail"/><testcase '
            'name="_ctest_p_rostest_test_ros_page.test" status="fail"/></testsuite>'
        )
        self.assertEqual((status, lines[-1]), (1, "0 passed, 2 failed, 0 skipped"))

    def test_without_a_build_there_is_a_count_all_the_same(self):
        self.checks.write_text("failed\tbuild\t\n")
        done = subprocess.run(
            [
                sys.executable,
                str(PROGRAM),
                "--total",
                str(self.checks),
                "--ctest",
                str(self.folder / "none.xml"),
                str(self.folder / "none"),
            ],
            stdout=subprocess.PIPE,
            universal_newlines=True,
        )
        self.assertEqual(
            (done.returncode, done.stdout.splitlines()[-1]), (1, "0 passed, 1 failed, 0 skipped")
        )

    def test_the_nodes_of_a_rostest_count_once(self):
        self.write(
            "rosunit-replay.xml",
            '<testcase name="a"/><testcase name="b"><failure>no</failure></testcase>',
        )
        self.write(
            "rostest-replay.xml",
            '<testcase classname="R" name="testreplay"><failure>b failed</failure></testcase>',
        )
        self.assertEqual(self.run_program()[1][-1], "1 passed, 1 failed, 0 skipped")

    def test_a_node_of_a_rostest_that_died_counts_as_failed(self):
        self.write("rosunit-replay.xml", '<testcase name="a"/>')
        self.write(
            "rostest-replay.xml",
            '<testcase classname="R" name="testreplay"><failure>died</failure></testcase>',
        )
        self.assertEqual(self.run_program()[1][-1], "1 passed, 1 failed, 0 skipped")

    def test_checks_count_too(self):
        output = self.folder / "output.txt"
        output.write_text("wrong format")
        self.checks.write_text("passed\tone\t\nfailed\ttwo\t%s\n" % output)
        status, lines = self.run_program()
        self.assertEqual((status, lines[-1]), (1, "1 passed, 1 failed, 0 skipped"))
        self.assertIn("    wrong format", lines)

    def test_a_long_output_is_shown_from_both_ends(self):
        output = self.folder / "output.txt"
        output.write_text("the cause\n" + "Installing\n" * 500 + "cannot find predict_device\n")
        self.checks.write_text("failed\tinstallation\t%s\n" % output)
        lines = self.run_program()[1]
        self.assertIn("    the cause", lines)
        self.assertIn("    cannot find predict_device", lines)
        self.assertLess(len(lines), 60)


if __name__ == "__main__":
    unittest.main()
