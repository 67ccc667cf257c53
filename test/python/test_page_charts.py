"""What the page's charts write beside their lines, in a real browser: the files of the page alone,
without a server."""

import pathlib
import sys
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "test" / "ros"))
import browser  # noqa: E402  (the path comes first)

CHART = """(() => {
  drawChart(byId('force-curve'), {x: {label: 'scan', low: 0, high: 2}, y: {label: 'force', unit: 'N', low: %g, high: %g, log: true}});
  return [...document.querySelectorAll('#force-curve text')].map((text) => text.textContent);
})()"""  # noqa: E501
STATE = """state = {scan: {number: 3, curve: {formulation: 'separation_curve', text: '1 µN', peak: [1e-9, 1e-6],
    in: [[-1e-9, 0], [2e-9, 5e-7]], out: [[2e-9, 5e-7], [1e-9, 1e-6], [-1e-9, 0]]}}, half_space: %s}; showCurve();
    [...document.querySelectorAll('#curve-keys li')].map((item) => item.textContent)"""  # noqa: E501
SOLVED = (
    "{is_solved: true, status: 'solved', text: '2 µN', number: 3, notes: [], in: [[-1e-9, 0], "
    "[1e-9, 1e-7]], out: [[1e-9, 1e-7], [-1e-9, 2e-6]]}"
)


@unittest.skipUnless(
    browser.program(),
    "no browser is installed: apt-get install chromium-headless-shell (scripts/setup does), or "
    "chromium",
)
class ChartTest(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        cls.doClassCleanups()  # nose knows nothing of them

    @classmethod
    def setUpClass(cls):
        cls.page = browser.Browser(1024, 768)
        cls.addClassCleanup(cls.page.close)
        cls.page.open(
            "file://%s" % (REPOSITORY / "python" / "mems_stiction" / "page" / "index.html")
        )
        cls.page.wait("typeof showCurve === 'function' && document.readyState === 'complete'")
        cls.page.click("button[data-tab=curve]")
        cls.page.wait(
            "byId('force-curve').clientWidth > 0"
        )  # the tab is shown a moment after the click; a hidden chart draws nothing

    def test_ticks_over_many_decades_have_prefixes_of_their_own(self):
        words = self.page.value(CHART % (1e-9, 2e-3))
        self.assertIn("force [N]", words)
        for tick in ("1 n", "1 µ", "1 m"):
            self.assertIn(tick, words)
        self.assertFalse([word for word in words if "0.000" in word])

    def test_ticks_over_few_decades_share_the_prefix_of_the_axis(self):
        words = self.page.value(CHART % (1e-6, 1e-4))
        self.assertIn("force [µN]", words)
        self.assertIn("10", words)

    def test_no_tick_is_wider_than_its_room(self):
        self.page.value(CHART % (1e-18, 1e3))
        self.assertTrue(
            self.page.value(
                "[...document.querySelectorAll('#force-curve text:not(.label)')].every((text) => "
                "text.getBBox().x >= 0)"
            )
        )

    def test_the_force_curve_says_which_line_is_which(self):
        self.assertEqual(self.page.value(STATE % "null"), ["approach", "retraction"])
        self.assertEqual(
            self.page.value(STATE % SOLVED),
            ["approach", "retraction", "half-space, approach", "half-space, retraction"],
        )
        colours = self.page.value(
            "[...document.querySelectorAll('#curve-keys span')].map((piece) => "
            "getComputedStyle(piece).borderTopColor)"
        )
        lines = self.page.value(
            "[...document.querySelectorAll('#force-curve path')].map((line) => "
            "getComputedStyle(line).stroke)"
        )
        self.assertEqual(sorted(colours), sorted(lines))


if __name__ == "__main__":
    unittest.main()
