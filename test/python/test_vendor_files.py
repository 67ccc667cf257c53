"""Makers' files that Gwyddion's libraries read, from Python: from threads and forks, and files that
were cut off."""

import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest

import mems_stiction
import numpy as np

SIDE = 8
BCR = (
    "fileformat = %s\nxpixels = 8\nypixels = 8\nxlength = 100\nylength = 100\nbit2nm = %s\nxunit "
    "= nm\nyunit = nm\nzunit = nm\n"
)


def bcr(kind, unit, pixels):
    header = (BCR % (kind, unit)).encode()
    return header + b"%" * (2048 - len(header)) + pixels


def ibw(pixels):
    """Igor's binary wave, version 5, with the name of its channel."""
    note, labels = b"ScanSize: 1e-06\r", bytes(32) + b"Height".ljust(32, b"\0")
    whole = bytearray(384) + pixels + note + labels
    struct.pack_into("<hhiiii", whole, 0, 5, 0, 320 + len(pixels), 0, len(note), 0)
    struct.pack_into("<i", whole, 44, len(labels))
    struct.pack_into("<ih", whole, 64 + 12, SIDE * SIDE, 2)
    whole[92:97] = b"image"
    struct.pack_into("<4i4d", whole, 64 + 68, SIDE, SIDE, 1, 0, 1e-8, 1e-8, 0.0, 0.0)
    for place in (148, 152, 156):
        whole[64 + place : 64 + place + 1] = b"m"
    struct.pack_into("<H", whole, 2, -sum(struct.unpack_from("<192h", whole)) & 0xFFFF)
    return bytes(whole)


def made_files():
    source = random.Random(1)
    floats = struct.pack("<64f", *(source.random() for _ in range(64)))
    return {
        "a.bcrf": bcr("bcrf", "1", floats),
        "a.bcr": bcr(
            "bcrstm", "0.01", struct.pack("<64h", *(source.randrange(-999, 999) for _ in range(64)))
        ),
        "a.ibw": ibw(struct.pack("<64f", *(1e-9 * source.random() for _ in range(64)))),
    }


def height_sum(path):
    """For another process."""
    return float(np.sum(mems_stiction.read(path).heights))


class VendorFileTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        try:
            mems_stiction.read(self.write("any.bcrf", made_files()["a.bcrf"]))
        except mems_stiction.FileError as error:
            if "made without" not in str(error):
                raise
            self.skipTest("built without Gwyddion's libraries")

    def write(self, name, content):
        (self.folder / name).write_bytes(content)
        return self.folder / name

    def heights_of(self, name, content):
        """None where the file is refused."""
        try:
            return np.array(mems_stiction.read(self.write(name, content)).heights)
        except mems_stiction.FileError as error:
            self.assertIn(name, str(error))
            self.assertEqual(len(str(error).splitlines()), 1)
            return None

    def test_a_made_file_that_was_cut_off_is_refused(self):
        for name, content in made_files().items():
            self.assertEqual(self.heights_of(name, content).shape, (SIDE, SIDE))
            for missing in (1, 4, 40, len(content) // 3, len(content) - 20):
                self.assertIsNone(
                    self.heights_of(name, content[:-missing]),
                    "%s without %d bytes" % (name, missing),
                )

    def test_a_cut_tiff_of_park_has_all_its_heights_or_is_refused(self):
        """The picture stands behind the heights."""
        scans = os.environ.get("MEMS_STICTION_SCANS")
        if not scans:
            self.skipTest("MEMS_STICTION_SCANS is not set")
        content = (pathlib.Path(scans) / "example_ps.tiff").read_bytes()
        whole = self.heights_of("whole.tiff", content)
        refused = 0
        for missing in (1, 1000, 60000, 100000, len(content) // 3, 2 * len(content) // 3):
            heights = self.heights_of("cut.tiff", content[:-missing])
            refused += heights is None
            if heights is not None:
                np.testing.assert_array_equal(heights, whole)
        self.assertGreater(refused, 1)

    def test_threads_and_forked_processes_read_the_same_and_leave_nothing(self):
        code = (
            "import sys; sys.path.insert(0, %r); import multiprocessing; from multiprocessing.pool "
            "import ThreadPool\n"
            "from test_vendor_files import height_sum\n"
            "paths = sys.argv[1:]\n"
            "own = [height_sum(path) for path in paths]\n"
            "with ThreadPool(3) as pool: assert pool.map(height_sum, paths) == own\n"
            "with multiprocessing.get_context('fork').Pool(1) as pool: assert pool.map(height_sum, "
            "paths) == own\n"
        ) % str(pathlib.Path(__file__).resolve().parent)
        paths = [str(self.write(name, content)) for name, content in made_files().items()]
        done = subprocess.run(
            [sys.executable, "-c", code] + paths,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=120,
            env=dict(os.environ, TMPDIR=str(self.folder)),
        )
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(
            [path.name for path in self.folder.iterdir() if path.is_dir()],
            [],
            "what it worked in is gone",
        )


if __name__ == "__main__":
    unittest.main()
