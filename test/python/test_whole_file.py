"""Files that are whole or absent are written where nobody else has laid anything."""

import os
import pathlib
import stat
import tempfile
import unittest
from unittest import mock

from mems_stiction.whole_file import CannotWrite, check_writable, whole


class WholeFileTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.path = self.folder / "rows.csv"

    def test_no_link_that_lies_beside_the_file_leads_to_another_one(self):
        victim = self.folder / "victim"
        victim.write_text("kept")
        (self.folder / ".rows.part.csv").symlink_to(victim)  # the name that was predictable
        check_writable(self.path)
        with whole(self.path) as part:
            part.write_text("a,b\n")
        self.assertEqual((victim.read_text(), self.path.read_text()), ("kept", "a,b\n"))

    def test_a_link_by_the_very_name_that_was_drawn_is_not_followed(self):
        victim = self.folder / "victim"
        victim.write_text("kept")
        (self.folder / ".rows.part-guessed.csv").symlink_to(victim)
        with mock.patch(
            "mems_stiction.whole_file.secrets.token_hex", side_effect=["guessed", "another"]
        ):
            with whole(self.path) as part:
                part.write_text("a,b\n")
        self.assertEqual((victim.read_text(), self.path.read_text()), ("kept", "a,b\n"))

    def test_each_writer_has_a_place_of_its_own(self):
        with whole(self.path) as one, whole(self.path) as other:
            self.assertNotEqual(one, other)
            self.assertEqual((one.suffix, other.suffix), (".csv", ".csv"))
            one.write_text("one")
            other.write_text("other")
        self.assertEqual((self.path.read_text(), os.listdir(self.folder)), ("one", ["rows.csv"]))

    def test_others_may_read_it_as_any_other_file(self):
        before = os.umask(0o027)
        self.addCleanup(os.umask, before)
        with whole(self.path):
            pass
        self.assertEqual(stat.S_IMODE(self.path.stat().st_mode), 0o640)

    def test_what_fails_leaves_nothing_and_names_the_file(self):
        with self.assertRaises(ValueError), whole(self.path) as part:
            part.write_text("half")
            raise ValueError("no")
        self.assertEqual(os.listdir(self.folder), [])
        nowhere = self.folder / "nowhere" / "rows.csv"
        for write in (check_writable, lambda path: whole(path).__enter__()):
            with self.assertRaisesRegex(
                CannotWrite, "nowhere/rows.csv: cannot be written: No such file"
            ):
                write(nowhere)


if __name__ == "__main__":
    unittest.main()
