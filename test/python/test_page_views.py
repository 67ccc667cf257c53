"""The station's page in a real browser, with the real server and messages, without a graph: maps,
sweep, parts, downloads, at tablet and desk size."""

import csv
import io
import pathlib
import re
import sys
import tempfile
import time
import unittest

from mems_stiction.msg import (
    CycleContactResult,
    CyclePoint,
    PartVerdict,
    SeparationPoint,
    StictionPrediction,
    SweepLoadResult,
    SweepPoint,
    SweepSummary,
)
from mems_stiction.page_maps import height_range, measured_at
from sensor_msgs.msg import Image

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from page_cases import (  # noqa: E402  (the path comes first)
    BAD_SITES,
    SECOND,
    TABS,
    add_wafers,
    browser,
    contacts_message,
    heights_message,
    part,
    prediction,
    serve,
    sweep,
)

SCREENS = {
    "desk": (1280, 800),
    "landscape": (1024, 768),
    "tablet": (768, 1024),
    "phone": (400, 800),
    "small phone": (320, 640),
}
# Texts of charts that lie on each other, or are not wholly inside: a hidden one has no box.
BAD_TEXTS = """(() => {
  const found = [];
  for (const svg of document.querySelectorAll('svg.chart, #height-bar, #wafer-bar, svg.wafer-map')) {
    const outer = svg.getBoundingClientRect();
    const texts = [...svg.querySelectorAll('text')].map((text) => [text.textContent, text.getBoundingClientRect()]).filter(([, box]) => box.width);
    for (const [text, box] of texts) if (box.left < outer.left - 1 || box.right > outer.right + 1 || box.top < outer.top - 1 || box.bottom > outer.bottom + 1) found.push(`${svg.id}: ${text} is cut`);
    texts.forEach(([text, a], place) => texts.slice(place + 1).forEach(([other, b]) => {
      if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 4 && b.top < a.bottom - 4) found.push(`${svg.id}: ${text} on ${other}`);
    }));
  }
  return found;
})()"""  # noqa: E501
# Boxes with words that lie on each other, or reach beyond the window.
BAD_BOXES = """(() => {
  const boxes = ['#said', '#ratio', '#limits', '#part', 'nav', 'main'].map((name) => [name, document.querySelector(name).getBoundingClientRect()]).filter(([, box]) => box.width && box.height);
  const found = boxes.filter(([, box]) => box.right > innerWidth + 1).map(([name]) => `${name} is cut`);
  boxes.forEach(([name, a], place) => boxes.slice(place + 1).forEach(([other, b]) => {
    if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1) found.push(`${name} on ${other}`);
  }));
  const words = [...document.querySelectorAll('#reason, #ratio-interval, #ratio-value')].map((found) => found.getBoundingClientRect()).filter((box) => box.width);
  const age = document.querySelector('#age').getBoundingClientRect();
  if (age.width && words.some((box) => age.left < box.right && box.left < age.right && age.top < box.bottom - 1 && box.top < age.bottom)) found.push('#age on words');
  if (document.documentElement.scrollWidth > innerWidth) found.push('the page is wider than the window');
  return found;
})()"""  # noqa: E501


@unittest.skipUnless(
    browser.program(),
    "no browser is installed: apt-get install chromium-headless-shell (scripts/setup does), or "
    "chromium",
)
class ViewTest(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        cls.doClassCleanups()  # nose knows nothing of them

    @classmethod
    def setUpClass(cls):
        serve(cls)
        for number in range(1, 13):
            cls.state.add_prediction(number * SECOND, prediction(number))
        cls.number = 12
        add_wafers(cls.state)
        for serial, margin, sticks in (("0010", 3.0, 0), ("0009", 0.4, 2), ("0011", 1.2, 1)):
            cls.state.add_part(12 * SECOND, part(serial, margin, sticks))
        cls.state.add_part(
            12 * SECOND,
            part(
                "0012",
                6.18,
                1,
                scan_count=2,
                counted_scans=2,
                margin_lower=9.57e-11,
                margin_upper=2.07e12,
            ),
        )
        cls.state.add_sweep("goal", sweep())
        cls.state.add_cycles(
            "goal",
            CycleContactResult(
                cycles=[
                    CyclePoint(
                        cycle=number,
                        pull_off_force=1e-6,
                        margin=3.0,
                        margin_lower=2.0,
                        margin_upper=4.0,
                    )
                    for number in range(1, 9)
                ]
            ),
        )
        cls.page = browser.Browser(*SCREENS["desk"])
        cls.addClassCleanup(cls.page.close)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.page.download_to(cls.folder)
        cls.page.open("http://127.0.0.1:%d" % cls.server.port)
        cls.page.wait("state && state.count === 12")

    def setUp(self):
        self.page.resize(*SCREENS["desk"])

    def open_tab(self, name):
        self.page.click("button[data-tab=%s]" % name)
        self.page.wait(
            "getComputedStyle(document.querySelector('#tab-%s')).display === 'grid'" % name
        )

    def show_scan(self, rows, columns, size):
        """A scan with its maps, once the page shows them."""
        stamp = ViewTest.number = ViewTest.number + 1
        heights = heights_message(rows, columns)
        self.state.add_prediction(stamp * SECOND, prediction(stamp))
        self.state.set_map("height", stamp * SECOND, heights, size)
        self.state.set_map("contacts", stamp * SECOND, contacts_message(rows, columns), size)
        self.open_tab("maps")
        self.page.click("#zoom-whole")
        self.page.wait(
            "state.maps.height && state.maps.height.number === %d && state.maps.contacts.number "
            "=== %d" % (stamp, stamp)
        )
        self.page.wait(
            "['height', 'contacts'].every((id) => byId(id).complete && byId(id).naturalWidth > 0 "
            "&& byId(id).src.endsWith('%d'))" % (stamp * SECOND)
        )
        return heights

    def saved(self, name):
        """The bytes of a file that the page saves, once they are whole."""
        end = time.monotonic() + browser.TIMEOUT
        while not (self.folder / name).exists():
            self.assertLess(
                time.monotonic(),
                end,
                "%s does not come; there are %s"
                % (name, [path.name for path in self.folder.iterdir()]),
            )
            time.sleep(0.05)
        return (self.folder / name).read_bytes()

    def test_no_text_is_cut_or_lies_on_another_on_any_screen(self):
        self.show_scan(64, 96, (9.6e-7, 6.4e-7))
        for screen, size in SCREENS.items():
            self.page.resize(*size)
            for tab in TABS:
                self.open_tab(tab)
                for is_stale in (False, True):
                    set_age = (
                        "document.querySelector('#verdict').classList.toggle('stale', %s), "
                        "say('age', %s)"
                        % (("true", "'last scan 35 s ago'") if is_stale else ("false", "''"))
                    )
                    self.assertEqual(
                        self.page.value("(%s, %s.concat(%s))" % (set_age, BAD_TEXTS, BAD_BOXES)),
                        [],
                        (screen, tab, is_stale),
                    )

    def test_texts_keep_off_what_is_drawn(self):
        self.open_tab("overview")
        self.assertEqual(
            self.page.value(
                "[...document.querySelectorAll('#trend-force text')].filter((text) => "
                "/control|spring/.test(text.textContent)).length"
            ),
            0,
        )
        self.assertIn("control limits", self.page.text("#trend-keys"))
        self.assertIn("restoring force of the spring", self.page.text("#trend-keys"))
        self.open_tab("curve")
        covered = self.page.value("""(() => {
          const [text] = [...document.querySelectorAll('#force-curve text')].filter((one) => one.textContent.startsWith('pull-off'));
          const box = text.getBBox();
          return [...document.querySelectorAll('#force-curve path')].reduce((count, line) => {
            for (let at = 0; at < line.getTotalLength(); at += 2) {
              const {x, y} = line.getPointAtLength(at);
              if (x > box.x && x < box.x + box.width && y > box.y && y < box.y + box.height) ++count;
            }
            return count;
          }, 0); })()""")  # noqa: E501
        self.assertEqual(covered, 0)

    def test_a_bar_says_which_height_each_colour_is(self):
        heights = self.show_scan(64, 96, (9.6e-7, 6.4e-7))
        low, high = height_range(heights)
        self.assertEqual(self.page.value("state.height_range"), [low, high])
        ticks = self.page.value(
            "[...document.querySelectorAll('#height-bar text:not(.label)')].map((text) => "
            "[Number(text.textContent), text.getBBox().y + text.getBBox().height / 2])"
        )
        self.assertEqual(
            self.page.value("document.querySelector('#height-bar .label').textContent"), "nm"
        )
        self.assertGreater(len(ticks), 2)
        self.assertTrue(all(low * 1e9 <= value <= high * 1e9 for value, _ in ticks), ticks)
        (first, bottom), (last, top) = ticks[0], ticks[-1]
        rectangle = self.page.value(
            "(() => { const box = document.querySelector('#height-bar rect').getBBox(); return "
            "box.height; })()"
        )
        self.assertAlmostEqual(
            (bottom - top) / rectangle, (last - first) * 1e-9 / (high - low), delta=0.05
        )

    def test_elongated_scans_fill_the_room(self):
        for rows, columns, shape in ((32, 160, 5.0), (160, 32, 5.0), (100, 100, 1.0)):
            self.show_scan(rows, columns, (columns * 1e-8, rows * 1e-8))
            for screen, size in SCREENS.items():
                self.page.resize(*size)
                self.page.value("show()")
                width, height, room = self.page.value(
                    "(() => { const map = document.querySelector('.map'); return [map.clientWidth, "
                    "map.clientHeight, byId('tab-maps').clientWidth]; })()"
                )
                self.assertAlmostEqual(width / height, shape, delta=0.1)
                if shape > 1:
                    # beside the colour bar, whose numbers keep their size
                    least = min(0.85 * room, room - 93)
                    self.assertGreater(width, least, (rows, columns, screen))
                elif screen == "tablet":  # one below the other
                    self.assertGreater(width, 0.7 * room)
        self.show_scan(160, 32, (32e-8, 160e-8))
        self.assertIn("turned clockwise", self.page.text("#height-legend"))
        self.assertEqual(
            self.page.value("[byId('height').naturalWidth, byId('height').naturalHeight]"),
            [160, 32],
        )

    def assert_measured(self, heights, size, places):
        """That the page tells of these places, shares of the scan, what the heights say; within a
        pixel of the screen."""
        told = self.page.value("measured.told")
        points = self.page.value("measured.places")
        for (x, y), (wanted_x, wanted_y) in zip(points, places):
            self.assertAlmostEqual(x, wanted_x, delta=0.02)
            self.assertAlmostEqual(y, wanted_y, delta=0.02)
        self.assertEqual(told, measured_at(heights, size, points))

    def test_a_click_measures_height_and_distance(self):
        size = (9.6e-7, 6.4e-7)
        heights = self.show_scan(64, 96, size)
        self.page.click(".map", 0.25, 0.5)
        self.page.wait("measured.told && measured.told.points.length === 1")
        self.assert_measured(heights, size, [(0.25, 0.5)])
        self.assertRegex(
            self.page.text("#measured"), r"^Height: .?[\d.]+ nm at x 2[34]\d nm, y 3\d\d nm\.$"
        )
        self.page.click(".map", 0.75, 0.5)
        self.page.wait("measured.told && measured.told.points.length === 2")
        self.assert_measured(heights, size, [(0.25, 0.5), (0.75, 0.5)])
        self.assertAlmostEqual(self.page.value("measured.told.distance"), 4.8e-7, delta=1e-8)
        self.assertRegex(
            self.page.text("#measured"), r"distance 4[78]\d(\.\d)? nm; step .?[\d.]+ nm\.$"
        )
        self.assertEqual(
            self.page.value("document.querySelectorAll('#height-marks circle').length"), 2
        )
        self.page.click("#measure-clear")
        self.assertEqual(self.page.value("document.querySelectorAll('.measure').length"), 0)
        self.page.click(".map", 0.01, 0.01)
        self.page.wait("measured.told")
        self.assertIn("not measured", self.page.text("#measured"))
        self.show_scan(64, 96, size)  # a new scan, whose heights are others
        self.page.wait("!measured.places.length")

    def test_a_turned_scan_is_measured_where_it_is_clicked(self):
        size = (32e-8, 160e-8)
        heights = self.show_scan(160, 32, size)
        self.page.click(".map", 0.25, 0.4)  # its left is the scan's bottom
        self.page.wait("measured.told")
        self.assert_measured(heights, size, [(0.4, 0.75)])

    def test_maps_zoom_and_move_together(self):
        size = (8e-6, 8e-6)
        heights = self.show_scan(800, 800, size)
        self.assertEqual(self.page.value("byId('height').naturalWidth"), 400)  # thinned
        place = self.page.place(".map", 0.75, 0.25)
        self.page.mouse("mouseWheel", place, deltaX=0, deltaY=-100)
        self.page.wait("view.zoom > 1.2")
        self.page.click("#zoom-in")
        self.page.wait("byId('height').naturalWidth === 800")  # all its pixels
        self.assertEqual(
            self.page.value(
                "[...document.querySelectorAll('.map .layer')].map((layer) => "
                "layer.style.transform).filter((text, _, all) => text !== all[0]).length"
            ),
            0,
        )
        before = self.page.value("view.x")
        self.page.drag(".map", (0.7, 0.5), (0.3, 0.5))
        self.page.wait("view.x > %r" % before)
        self.assertEqual(self.page.value("measured.places.length"), 0)  # a drag is no click
        self.page.click(".map", 0.5, 0.5)
        self.page.wait("measured.told")
        x, y, zoom = self.page.value("[view.x, view.y, view.zoom]")
        self.assert_measured(heights, size, [(x + 0.5 / zoom, y + 0.5 / zoom)])
        self.page.click("#zoom-whole")
        self.page.wait("view.zoom === 1 && view.x === 0")

    def test_charts_zoom_by_a_drag(self):
        self.open_tab("curve")
        whole = self.page.value("byId('force-curve').zoomPlace.chart.x")
        self.page.drag("#force-curve", (0.4, 0.5), (0.6, 0.5))
        self.page.wait("byId('force-curve').zoomPlace.chart.x.low > %r" % whole["low"])
        piece = self.page.value("byId('force-curve').zoomPlace.chart.x")
        self.assertAlmostEqual(
            (piece["high"] - piece["low"]) / (whole["high"] - whole["low"]), 0.2, delta=0.05
        )
        self.page.click("#force-curve", count=2)
        self.page.wait("byId('force-curve').zoomPlace.chart.x.low === %r" % whole["low"])

    def test_a_sweep_shows_margin_safe_voltage_and_jumps(self):
        self.open_tab("runs")
        self.page.wait("document.querySelectorAll('#sweep-margin path').length > 0")
        self.assertEqual(
            self.page.value(
                "document.querySelectorAll('#sweep-margin .area, #sweep-force .area').length"
            ),
            2,
        )
        self.assertEqual(
            self.page.value("byId('sweep-margin').zoomPlace.chart.uprights.map((line) => line.x)"),
            [12.5, 20.0],
        )  # pull-in, safe
        self.assertIn("20.0 V", self.page.text("#sweep-keys"))
        jumps = self.page.value("state.runs.sweep.jumps")
        self.assertIn(25.0, [jump["voltage"] for jump in jumps])
        self.assertEqual(
            self.page.value(
                "[...document.querySelectorAll('#sweep-area .number')].map((text) => "
                "text.textContent)"
            ),
            [str(jump["number"]) for jump in jumps],
        )
        self.assertIn("89 new contacts snap in", self.page.text("#sweep-jumps"))
        self.assertNotIn("jump from", self.page.text("#sweep-words"))

    def cells(self, column):
        return self.page.value(
            "[...document.querySelectorAll('#parts-body tr')].map((row) => row.cells[%d].innerText)"
            % column
        )

    def test_the_table_of_parts_has_the_newest_verdict_of_each_and_sorts(self):
        self.open_tab("parts")
        self.assertEqual(
            self.cells(1), ["0012", "0011", "0009", "0010"]
        )  # the one heard of last first
        self.assertEqual(self.page.text("#part-count"), "4")  # behind the heading "Parts"
        self.assertEqual(self.cells(3)[0], "says nothing yet")
        self.assertEqual(self.cells(3)[1], "1.2 (95 %: 0.6 to 2.4)")
        self.page.click("#parts-head th:nth-child(2) button")
        self.assertEqual(self.cells(1), ["0009", "0010", "0011", "0012"])
        self.page.click("#parts-head th:nth-child(3) button")
        self.assertEqual(self.cells(2)[0], "STICKS")
        self.page.click("#parts-head th:nth-child(4) button")
        self.page.click("#parts-head th:nth-child(4) button")
        self.assertEqual(
            [text.split(" (")[0] for text in self.cells(3)], ["3", "1.2", "0.4", "says nothing yet"]
        )
        self.page.click("#part-rows")
        rows = list(csv.DictReader(io.StringIO(self.saved("parts.csv").decode())))
        self.assertEqual(sorted(row["serial_id"] for row in rows), ["0009", "0010", "0011", "0012"])
        self.assertEqual(
            [float(row["margin"]) for row in rows if row["serial_id"] == "0009"], [0.4]
        )

    def show_wafers(self):
        self.open_tab("wafers")
        self.page.wait(
            "wafers && wafers.version === state.wafers && document.querySelectorAll('.wafer-map "
            ".site').length"
        )
        self.page.click("button[data-figure=margin]")

    def marked(self, number, kind):
        """Middles of marks of one map, in pixels of the screen."""
        return self.page.value(
            "[...document.querySelectorAll('.wafer-map')[%d].querySelectorAll('.%s')].map((mark) "
            "=> { const box = mark.getBoundingClientRect(); return [box.x + box.width / 2, box.y + "
            "box.height / 2]; })" % (number, kind)
        )

    def test_maps_of_wafers_mark_what_is_bad_and_what_is_missing(self):
        self.show_wafers()
        for screen in ("desk", "tablet"):
            self.page.resize(*SCREENS[screen])
            self.page.wait("drawnWafers.includes('%d,%d')" % SCREENS[screen])
            self.page.place("#wafers")  # stands still
            self.assertEqual(
                self.page.value(
                    "[...document.querySelectorAll('#wafers h3')].map((heading) => "
                    "heading.textContent)"
                ),
                ["Wafer 8 of lot A", "Wafer 7 of lot A"],
            )
            sites, bad = self.marked(1, "site"), self.marked(1, "bad-site")
            self.assertEqual((len(sites), len(bad)), (49, len(BAD_SITES)), screen)
            columns, rows = (sorted({round(site[axis]) for site in sites}) for axis in (0, 1))
            self.assertEqual(
                {
                    (
                        min(range(7), key=lambda place: abs(columns[place] - x)),
                        6 - min(range(7), key=lambda place: abs(rows[place] - y)),
                    )
                    for x, y in bad
                },
                BAD_SITES,
            )
            self.assertEqual(
                (
                    len(self.marked(0, "site")),
                    len(self.marked(0, "missing-site")),
                    len(self.marked(0, "bad-site")),
                ),
                (34, 15, 0),
            )
            fills = self.page.value(
                "new "
                "Set([...document.querySelectorAll('.wafer-map')[1].querySelectorAll('.site')].map((site) => site.getAttribute('fill'))).size"  # noqa: E501
            )
            self.assertGreater(fills, 10)
            strips = self.page.value(
                "[...document.querySelectorAll('#units .strip')].map((strip) => "
                "strip.getBoundingClientRect()).map((box) => [box.x, box.width])"
            )
            self.assertEqual(
                (len(strips), len({tuple(strip) for strip in strips})), (12, 1)
            )  # all on one axis
            self.assertIn("1 stick, 6 release", self.page.text("#units"))

    def test_wafers_are_coloured_by_the_figure_that_is_chosen_and_a_click_tells_a_place(self):
        self.show_wafers()
        self.page.click("button[data-figure=rms_height]")
        self.page.wait("byId('wafers-of').textContent === 'by rms height'")
        self.assertEqual(
            (
                len(self.marked(1, "bad-site")),
                self.page.value("document.querySelector('#wafer-bar .label').textContent"),
            ),
            (0, "nm"),
        )
        self.page.click("#wafers > div:nth-child(2) .site")
        self.page.wait("document.querySelectorAll('.chosen-site').length === 1")
        self.assertRegex(
            self.page.text("#wafer-place"),
            r"^Wafer 7 of lot A at \(0, 0\) mm, part row 0: margin 2, pull-off force of the device "
            r"1.00 µN, rms height 1.00 nm$",
        )
        self.page.click("button[data-figure=margin]")
        self.page.wait("document.querySelectorAll('.bad-site').length > 1")
        self.assertEqual(self.page.errors, [])

    def test_row_and_pictures_are_saved(self):
        self.show_scan(64, 96, (9.6e-7, 6.4e-7))
        self.open_tab("overview")
        self.page.click("#scan-row")
        (row,) = csv.DictReader(io.StringIO(self.saved("scan_%d.csv" % self.number).decode()))
        self.assertEqual(
            (float(row["pull_off_force"]), row["scan_name"], row["settings_hash"]),
            (prediction(self.number).pull_off_force, "place %d" % self.number, "00ff"),
        )
        self.assertEqual(row["warnings"], "'=HYPERLINK(1)")  # no formula
        from PIL import Image as Picture

        for tab, name in (
            ("overview", "trend"),
            ("overview", "figures"),
            ("maps", "heights"),
            ("maps", "contacts"),
            ("curve", "force_curve"),
            ("runs", "sweep"),
            ("runs", "cycles"),
            ("wafers", "wafers"),
            ("wafers", "parts_side_by_side"),
        ):
            self.open_tab(tab)
            self.page.click(".panel[data-picture=%s] .picture" % name)
            with Picture.open(
                io.BytesIO(self.saved("%s_scan_%d.png" % (name, self.number)))
            ) as picture:
                panel = self.page.value(
                    "(() => { const box = "
                    "document.querySelector('.panel[data-picture=%s]').getBoundingClientRect(); "
                    "return [box.width, box.height]; })()" % name
                )
                self.assertGreater(picture.width, 2 * panel[0])
                colours = picture.convert("RGB").getcolors(picture.width * picture.height)
                self.assertGreater(len(colours), 20, name)  # something is drawn
        self.assertEqual(self.page.errors, [])

    def test_what_is_clamped_is_unfolded_by_a_click(self):
        self.open_tab("overview")
        isWhole = "byId('reason').scrollHeight <= byId('reason').clientHeight + 1"
        self.page.resize(*SCREENS["tablet"])
        self.page.wait("!(%s)" % isWhole)
        self.page.click("#verdict")
        self.page.wait(isWhole)
        self.page.click("#verdict")
        self.page.wait("!(%s)" % isWhole)


@unittest.skipUnless(browser.program(), "no browser is installed")
class OneMessageTest(unittest.TestCase):
    """Nothing that one message does outlives it."""

    @classmethod
    def tearDownClass(cls):
        cls.doClassCleanups()

    @classmethod
    def setUpClass(cls):
        serve(cls)
        cls.page = browser.Browser(*SCREENS["desk"])
        cls.addClassCleanup(cls.page.close)
        cls.page.open("http://127.0.0.1:%d" % cls.server.port)

    def hostile(self):
        """What one message may bring, as functions that send it."""
        state = self.state
        floats = Image(height=2, width=2, step=8, encoding="32FC1", data=b"\0\0")
        bytes_ = Image(height=0, width=0, step=0, encoding="mono8")
        yield lambda stamp: state.add_part(stamp, PartVerdict())
        yield lambda stamp: state.add_prediction(stamp, StictionPrediction())
        yield lambda stamp: state.set_map("height", stamp, floats)
        yield lambda stamp: state.set_map("contacts", stamp, bytes_)
        yield lambda stamp: state.set_map(
            "contacts", stamp, Image(height=2, width=2, step=6, encoding="rgb8", data=bytes(12))
        )
        yield lambda stamp: state.set_map(
            "height", stamp, heights_message(2, 5000), (1e308, 1e-308)
        )
        for value in (1e308, -1e308, 1.7e308, 5e-324, 1e29):
            yield lambda stamp, value=value: state.add_prediction(
                stamp,
                prediction(
                    stamp,
                    pull_off_force=value,
                    restoring_force=value,
                    margin=value,
                    margin_upper=value,
                    device_pull_off_force=value,
                    rms_height=value,
                    curve=[
                        SeparationPoint(displacement=value, force=value),
                        SeparationPoint(displacement=-1e-9, force=1e-6),
                    ],
                ),
            )
            yield lambda stamp, value=value: state._wafers.add(
                stamp,
                prediction(
                    stamp,
                    site_x=value,
                    site_y=value,
                    pull_off_force=value,
                    margin=value,
                    wafer_id="9",
                ),
            )
            yield lambda stamp, value=value: state.add_part(stamp, part("wild", value, 0))
            yield lambda stamp, value=value: state.add_sweep(
                "goal",
                SweepLoadResult(
                    points=[
                        SweepPoint(
                            voltage=value, mechanical_load=value, pull_off_force=value, margin=value
                        )
                    ]
                    * 3,
                    summaries=[SweepSummary(mechanical_load=value)],
                    pull_in_voltage=value,
                ),
            )
            yield lambda stamp, value=value: state.add_cycles(
                "goal",
                CycleContactResult(
                    cycles=[CyclePoint(cycle=2**32 - 1, pull_off_force=value, margin=value)] * 3
                ),
            )

    def test_each_leaves_the_page_alive_for_the_next(self):
        for number, send in enumerate(self.hostile()):
            send(2 * number * SECOND)
            version = self.state.version
            for tab in TABS:
                self.page.value("location.hash = '%s'" % tab)
                self.page.wait(
                    "state && state.version >= %d && chosenTab() === '%s'" % (version, tab)
                )
            good = 2 * number + 1
            self.state.add_prediction(good * SECOND, prediction(good, scan_name="good %d" % number))
            self.page.wait(
                "document.querySelector('#scan-name').textContent.endsWith('good %d')" % number
            )
            if number == 0:
                self.assertEqual(self.page.text("#counts"), "1 scan")
            self.assertEqual(
                self.page.value("Object.values(broken).concat(state.broken)"), [], number
            )
        self.assertEqual(sorted(set(re.sub(r":\d+", "", error) for error in self.page.errors)), [])


if __name__ == "__main__":
    unittest.main()
