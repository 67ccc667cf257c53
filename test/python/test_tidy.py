"""scripts/lib/tidy.py: what is checked again, and what it prints, with a clang-tidy that finds the
word "wrong"."""

import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "scripts" / "lib"))

import tidy  # noqa: E402

CLANG_TIDY = """#!/bin/sh
if [ "$1" = --version ]; then echo version 14; exit 0; fi
for source; do :; done
root=$(dirname "$0")/..
echo "$(basename "$source")" >>"$root/checked"
grep -n wrong "$source" "$root/include/shared.hpp" | sed 's/:wrong.*/:1: error: it is wrong [some-check]/' | grep . && exit 1
exit 0
"""  # noqa: E501


class Tidy(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.root = pathlib.Path(self._folder.name).resolve()
        self.write("bin/clang-tidy", CLANG_TIDY).chmod(0o755)
        self.write(".clang-tidy", "Checks: some")
        self.write("include/shared.hpp", "int shared;\n")
        self.write("include/own.hpp", "int own;\n")
        self.write("src/one.cpp", '#include "shared.hpp"\n#include <own.hpp>\n#include <vector>\n')
        self.write("src/two.cpp", '#include "shared.hpp"\n')
        self.write("test/test.cpp", "wrong\n")
        self.write(
            "build/compile_commands.json",
            json.dumps(
                [
                    {
                        "file": str(self.root / name),
                        "command": "c++ -I%s/include -c %s" % (self.root, name),
                    }
                    for name in ("src/one.cpp", "src/two.cpp", "src/two.cpp", "test/test.cpp")
                ]
            ),
        )
        for patch in (
            unittest.mock.patch.object(tidy, "REPOSITORY", self.root),
            unittest.mock.patch.dict(
                os.environ, PATH="%s/bin:%s" % (self.root, os.environ["PATH"])
            ),
        ):
            patch.start()
            self.addCleanup(patch.stop)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return path

    def run_tidy(self):
        """Exit status, what it printed, and which sources it checked."""
        self.write("checked", "")
        printed = io.StringIO()
        with (
            contextlib.redirect_stdout(printed),
            unittest.mock.patch.object(sys, "argv", ["tidy.py", str(self.root / "build")]),
        ):
            status = tidy.main()
        return status, printed.getvalue(), sorted((self.root / "checked").read_text().split())

    def test_checks_each_source_below_src_once(self):
        status, _, checked = self.run_tidy()
        self.assertEqual((status, checked), (0, ["one.cpp", "two.cpp"]))

    def test_a_clean_source_is_checked_again_only_after_a_change_that_it_sees(self):
        self.run_tidy()
        self.assertEqual(self.run_tidy()[2], [])
        self.write("include/own.hpp", "int other;\n")
        self.assertEqual(self.run_tidy()[2], ["one.cpp"])
        self.write("include/shared.hpp", "int other;\n")
        self.assertEqual(self.run_tidy()[2], ["one.cpp", "two.cpp"])
        self.write(".clang-tidy", "Checks: others")
        self.assertEqual(self.run_tidy()[2], ["one.cpp", "two.cpp"])

    def test_a_finding_in_a_header_is_printed_once_and_found_again(self):
        self.write("include/shared.hpp", "int shared;\nwrong\n")
        for _ in range(2):
            status, printed, checked = self.run_tidy()
            self.assertEqual((status, checked), (1, ["one.cpp", "two.cpp"]))
            self.assertEqual(
                printed.count("include/shared.hpp:2:1: error: it is wrong"), 1, printed
            )

    def test_a_clang_tidy_that_fails_without_a_finding_is_a_failure(self):
        self.write(
            "bin/clang-tidy", '#!/bin/sh\n[ "$1" = --version ] || { echo killed >&2; exit 9; }\n'
        ).chmod(0o755)
        status, printed, _ = self.run_tidy()
        self.assertEqual(status, 1)
        self.assertIn("killed", printed)

    def test_commands_of_another_clone_are_no_success(self):
        self.write(
            "build/compile_commands.json",
            json.dumps([{"file": "/elsewhere/src/one.cpp", "command": "c++"}]),
        )
        self.assertEqual(self.run_tidy()[0], 2)


if __name__ == "__main__":
    unittest.main()
