"""The error map, small: frames are the same in every run, a run goes on where it ended, and
doc/trust.md is a page of this study."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import mems_stiction
import numpy as np

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
STUDIES = REPOSITORY / "studies"
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(STUDIES))

import effects_map  # noqa: E402  (the path comes first)
import half_space_steps  # noqa: E402
import trust_frames  # noqa: E402
import trust_kinds  # noqa: E402
import trust_page  # noqa: E402
import trust_run  # noqa: E402
from tiers import evidence  # noqa: E402

COUNT = 6


def run(*command):
    return subprocess.run(
        [str(part) for part in command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        timeout=600,
    )


def headings(page):
    return re.findall(r"^#+ .*$", page, re.MULTILINE)


class TrustTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_frames(self, count):
        done = run(sys.executable, STUDIES / "trust_run.py", self.folder, count, "--pixels", "48")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    @evidence
    def test_quick_map_goes_on_and_gives_the_page(self):
        self.run_frames(3)
        path = self.folder / "half_space.jsonl"
        first = path.read_text()
        path.write_text(first + '{"frame": {"num')  # as an interrupted run leaves it
        progress = self.run_frames(COUNT)
        self.assertTrue(path.read_text().startswith(first))
        self.assertEqual(len(path.read_text().splitlines()), COUNT)
        self.assertNotIn("solved 3 of", progress)
        self.assertIn("solved 4 of %d" % COUNT, progress)
        done = run(
            sys.executable,
            STUDIES / "trust_page.py",
            self.folder / "predictions.jsonl",
            self.folder / "page.md",
            self.folder / "map.png",
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "map.png").read_bytes()[1:4], b"PNG")
        shipped = (REPOSITORY / "doc" / "trust.md").read_text(encoding="utf-8")
        self.assertEqual(
            headings((self.folder / "page.md").read_text(encoding="utf-8")), headings(shipped)
        )
        for text in (self.folder / "predictions.jsonl").read_text().splitlines():
            line = json.loads(text)
            if line["half_space"]["status"] == "SOLVED" and line["half_space"]["is_resolved"]:
                ratio = (
                    line["separation_curve"]["pull_off_force"]
                    / line["half_space"]["pull_off_force"]
                )
                self.assertTrue(
                    0.5 < ratio < 2, (line["frame"], ratio)
                )  # what the map has at worst

    @evidence
    def test_both_steps_are_compared_and_the_run_goes_on(self):
        page = self.folder / "page.md"
        shipped = (REPOSITORY / "doc" / "half_space.md").read_text(encoding="utf-8")
        page.write_text(shipped, encoding="utf-8")
        for count in (2, 4):
            done = run(
                sys.executable,
                STUDIES / "half_space_steps.py",
                self.folder,
                count,
                "--pixels",
                "48",
                "--page",
                page,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("solved 2 of", done.stderr)
        self.assertIn("solved 3 of 4", done.stderr)
        written = page.read_text(encoding="utf-8")
        self.assertEqual(headings(written), headings(shipped))
        self.assertIn("| all | 4 |", written)
        lines = [
            json.loads(text) for text in (self.folder / "steps.jsonl").read_text().splitlines()
        ]
        # of one frame either retraction may reuse the approach, which takes half the states
        usual, fine = (
            sum(line[steps]["state_count"] for line in lines) for steps in ("usual", "fine")
        )
        self.assertGreater(fine, 1.2 * usual)
        for line in lines:
            for name in half_space_steps.COMPARED:
                self.assertLess(abs(half_space_steps.deviation(line, name)), 0.2, line["frame"])

    @evidence
    def test_pressed_frames_are_compared_and_the_run_goes_on(self):
        path = self.folder / "pressed.jsonl"
        for count in (2, 4):
            before = path.read_text() if path.exists() else ""
            done = run(
                sys.executable,
                STUDIES / "flow_map.py",
                self.folder,
                count,
                "--pixels",
                "48",
                "--seeds",
                "61,62",
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(path.read_text().startswith(before))
        lines = [json.loads(line) for line in path.read_text().splitlines()]
        self.assertEqual([line["frame"]["seed"] for line in lines], [61, 62, 61, 62])
        self.assertTrue(all(line["half_space"]["status"] == "SOLVED" for line in lines), lines)
        self.assertIn("| without a doubt |", done.stdout)
        shipped = (REPOSITORY / "doc" / "separation_evidence.md").read_text(encoding="utf-8")
        heading, table = (
            done.stdout.splitlines()[0],
            [line for line in done.stdout.splitlines() if line.startswith("| frames")][0],
        )
        self.assertIn(heading, headings(shipped))
        self.assertIn(table, shipped)

    def test_effects_are_compared_and_the_run_goes_on(self):
        page, path = self.folder / "page.md", self.folder / "effects.jsonl"
        shipped = (REPOSITORY / "doc" / "separation_evidence.md").read_text(encoding="utf-8")
        page.write_text(shipped, encoding="utf-8")
        for count in (1, 2):
            before = path.read_text() if path.exists() else ""
            done = run(
                sys.executable,
                STUDIES / "effects_map.py",
                self.folder,
                count,
                "--pixels",
                "48",
                "--seed",
                "1",
                "--page",
                page,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(path.read_text().startswith(before))
        written = page.read_text(encoding="utf-8")
        self.assertEqual(headings(written), headings(shipped))
        section = written.split(effects_map.HEADING)[1].split("\n## ")[0]
        rows = re.findall(r"^\| (.*?) \| 2 \| .* \|$", section, re.M)
        self.assertEqual(rows, list(effects_map.EFFECTS))
        for text in path.read_text().splitlines():
            line = json.loads(text)
            plain, *others = (line["found"][name]["half_space"][1] for name in effects_map.EFFECTS)
            for work in others:  # each of them adds to what holds
                self.assertGreater(work, plain)

    def test_retraction_does_not_pass_over_one_of_several_maxima(self):
        # behind the first maximum retraction is another branch for a while: reusing the states of
        # the approach from there lost 1.4 and 1.0 %
        for number in (183, 225):
            frame, heights = half_space_steps.drawn(number, 96, 35)
            line = half_space_steps.line_of(frame, heights, 60.0)
            self.assertEqual(line["fine"]["status"], "SOLVED", frame)
            self.assertLess(abs(half_space_steps.deviation(line, "pull_off_force")), 0.005, frame)

    def test_a_rest_beside_a_jump_is_not_crept_up_to(self):
        # the curve between both sides of the jump tells nothing of where the force falls to the
        # load: 1900 attempts led there
        frame, heights = trust_kinds.draw(157, 160)
        solution = mems_stiction.half_space(
            heights, frame["pitch"], trust_run.settings_of(frame, "separation_curve")
        )
        self.assertEqual(solution.status, "SOLVED")
        self.assertLess(solution.state_count, 1000)

    def test_jumps_of_a_curve_within_a_step(self):
        heights = np.linspace(0.0, 10.0, 101)
        saw = half_space_steps.Way(
            np.column_stack([heights, np.where(heights < 5.02, heights, 1.0)])
        )
        none = half_space_steps.Way(np.empty((0, 2)))
        for shift, met in ((0.0, 1), (0.3, 1), (-0.3, 1), (1.0, 0), (-1.0, 0)):
            moved = half_space_steps.Way(np.column_stack([heights + shift, saw.forces]))
            self.assertEqual(
                half_space_steps.jumps_of((none, moved), (none, saw), 5.0, 0.4), (1, met), shift
            )
        straight = half_space_steps.Way(np.column_stack([heights, 0.1 * heights]))
        self.assertEqual(half_space_steps.jumps_of((none, saw), (none, straight), 1.0, 0.4), (0, 0))

    def test_frames_are_the_same_in_every_run(self):
        none = trust_frames.Scans(None)
        kinds = set()
        for number in range(20):
            frame, heights = trust_frames.draw(number, 48, none)
            again, same = trust_frames.draw(number, 48, none)
            self.assertEqual(frame, again)
            self.assertTrue(np.array_equal(heights, same) and np.isfinite(heights).all())
            kinds.add(frame["kind"])
            self.assertTrue(
                0.1e9 <= frame["modulus"] <= 100e9 and 0.005 <= frame["work"] <= 0.15, frame
            )
        self.assertEqual(kinds, {"gaussian", "skewed", "self-affine", "spheres"})

    def test_kinds_whose_texture_changes_come_after_the_others(self):
        of_alike = {trust_kinds.kind_of(number) for number in range(trust_kinds.ALIKE_COUNT)}
        self.assertEqual(of_alike, set(trust_kinds.ALIKE))
        for number in (trust_kinds.ALIKE_COUNT, trust_kinds.ALIKE_COUNT + 1):
            frame, heights = trust_kinds.draw(number, 96)
            again, same = trust_kinds.draw(number, 96)
            self.assertEqual(frame, again)
            self.assertTrue(np.array_equal(heights, same) and np.isfinite(heights).all())
            self.assertIn(frame["kind"], trust_kinds.CHANGING)
            # blocks of an eighth of the side differ far more than those of one texture
            blocks = heights.reshape(8, 12, 8, 12).std(axis=(1, 3))
            self.assertGreater(blocks.max(), 3 * blocks.min(), frame["kind"])

    def test_interval_of_the_pages_is_that_of_the_code(self):
        stated = trust_page.errors_of_code()
        for name in ("trust.md", "trust_kinds.md"):
            table = (
                (REPOSITORY / "doc" / name)
                .read_text(encoding="utf-8")
                .split("## The interval of the margin")[1]
            )
            for group, errors in stated.items():
                of_page = re.search(
                    r"^\| %s \| \d+ \| (\S+) \| (\S+) \|" % group, table, re.MULTILINE
                ).groups()
                self.assertEqual(tuple(map(float, of_page)), errors, name)
            if name == "trust.md":  # the other page refers to it
                self.assertIn(
                    "with the power 1/%.0f of that ratio" % (1 / trust_page.error_power()), table
                )

    def test_the_flag_catches(self):
        # what the pages promise: without the flag 99 % are within 1.3, none beyond 1.6, and 36 %
        # have it at most
        for name in ("trust.md", "trust_kinds.md"):
            page = (REPOSITORY / "doc" / name).read_text(encoding="utf-8")
            rows = {
                title: re.search(
                    r"^\| %s \| (\d+) \|.* ([\d.]+) \| (\S+) \|$" % title, page, re.MULTILINE
                ).groups()
                for title in ("without NEAR_BONDING", "NEAR_BONDING")
            }
            count, within, worst = rows["without NEAR_BONDING"]
            self.assertGreaterEqual(float(within), 99.0, name)
            self.assertLess(float(worst), 1.6, name)
            judged = re.search(
                r"^\| all \| \d+ \| \d+ \|.* \| ([\d.]+) \| ([\d.]+) \| ([\d.]+) \|$",
                page,
                re.MULTILINE,
            ).groups()
            for share, least in zip(
                map(float, judged), (99.5, 98.0, 90.0)
            ):  # force, work, area as a device is judged
                self.assertGreaterEqual(share, least, name)
            self.assertLessEqual(
                int(rows["NEAR_BONDING"][0]),
                0.36 * (int(count) + int(rows["NEAR_BONDING"][0])),
                name,
            )


if __name__ == "__main__":
    unittest.main()
