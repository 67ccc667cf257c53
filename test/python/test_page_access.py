"""The station's page for a keyboard, a screen reader, a telephone and either theme, in a real
browser; and what it shows while the force of the whole device is on its way."""

import importlib.util
import pathlib
import sys
import unittest

from mems_stiction.msg import DeviceAdhesion, DeviceVerdict
from mems_stiction.page_words import ON_ITS_WAY

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import page_cases as made  # noqa: E402  (the path comes first)
from page_cases import NAN, SECOND, browser  # noqa: E402

AXE = importlib.util.find_spec("axe_playwright_python")
WIDTHS = (320, 360, 400, 1280)
THEMES = ("dark", "light")
AWAITED = (
    "the device's own force has not been found (the node finds it by the scans on its topic height "
    "and publishes it on device_force): the contact has 1e-10 m^2"
)
FOCUS = "document.activeElement.id"


def awaiting(number, **changes):
    """A prediction whose device's force is on its way."""
    return made.prediction(
        number, **dict(dict(sticks=3, reason=AWAITED, margin=NAN, margin_lower=NAN), **changes)
    )


def device(margin, sticks, **changes):
    message = DeviceAdhesion(
        scan_count=1,
        sticks=sticks,
        reason="why",
        pull_off_force=2e-6,
        restoring_force=1e-5,
        margin=margin,
        margin_lower=margin / 2,
        margin_upper=2 * margin,
        peel_number=NAN,
        linear_pull_off_force=NAN,
        contacts=NAN,
        apparent_work_of_adhesion=NAN,
        settings_hash="00ff",
    )
    for name, value in changes.items():
        setattr(message, name, value)
    return message


@unittest.skipUnless(
    browser.program(),
    "no browser is installed: apt-get install chromium-headless-shell (scripts/setup does), or "
    "chromium",
)
class AccessTest(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        cls.doClassCleanups()  # nose knows nothing of them

    @classmethod
    def setUpClass(cls):
        made.serve(cls)
        cls.number = 0
        made.add_wafers(cls.state)
        cls.state.add_sweep("goal", made.sweep())
        cls.state.add_part(SECOND, made.part("0010", 3.0, 0, reason="of the whole part, " * 20))
        cls.page = browser.Browser(1280, 800)
        cls.addClassCleanup(cls.page.close)
        cls.page.open("http://127.0.0.1:%d" % cls.server.port)
        cls.page.wait("document.title.startsWith('WAITING')")

    def setUp(self):
        self.page.resize(1280, 800)
        self.page.theme("dark")
        self.page.value("location.hash = 'overview'")
        self.page.wait("chosenTab() === 'overview'")

    def send(self, message):
        """The prediction, once the page shows it; its stamp."""
        stamp = AccessTest.number = AccessTest.number + 1
        self.state.add_prediction(stamp * SECOND, message)
        self.page.wait("state && state.count === %d" % stamp)
        return stamp * SECOND

    def show_maps(self):
        stamp = self.send(made.prediction(self.number))
        size = (9.6e-7, 6.4e-7)
        self.state.set_map("height", stamp, made.heights_message(64, 96), size)
        self.state.set_map("contacts", stamp, made.contacts_message(64, 96), size)
        self.page.wait("state.maps.contacts && state.maps.contacts.id === '%d'" % stamp)

    def open_tab(self, name):
        self.page.value("location.hash = '%s'" % name)
        self.page.wait(
            "byId('tab-%s').classList.contains('chosen') && %s"
            % (name, "document.querySelectorAll('.wafer-map').length" if name == "wafers" else "1")
        )

    def tab_to(self, selector):
        """By the key Tab alone, as often as it takes."""
        self.page.value("document.activeElement.blur()")
        for _ in range(60):
            self.page.press("Tab")
            if self.page.value("document.activeElement.matches(%r)" % selector):
                return
        self.fail("no way leads to %s" % selector)

    def test_title_and_live_region_tell_a_new_verdict_and_repeat_none(self):
        self.send(made.prediction(1, scan_name="first"))
        self.page.wait("document.title === 'RELEASES · Stiction station'")
        self.page.wait("byId('told').textContent.includes('RELEASES, margin 3, 95 %: 2 to 4.')")
        self.assertEqual(self.page.value("byId('told').getAttribute('role')"), "status")
        self.page.value(
            "window.heard = 0; window.observer = new MutationObserver(() => ++heard);"
            "observer.observe(byId('told'), {childList: true, characterData: true, subtree: true})"
        )
        for number in range(5):  # the same verdict again and again is no news
            self.send(made.prediction(number))
        self.assertLessEqual(self.page.value("heard"), 1)
        self.send(made.prediction(1, sticks=2, margin=0.3, margin_lower=0.2, margin_upper=0.4))
        self.page.wait("document.title.startsWith('STICKS')")
        self.assertIn("STICKS, margin 0.3", self.page.value("byId('told').textContent"))
        self.page.value("state.stale_after = 0, show()")
        self.page.wait("document.title.startsWith('Old: STICKS')")
        self.assertIn("What is shown is old", self.page.value("byId('told').textContent"))

    def test_arrow_keys_lead_along_the_tabs_and_the_chosen_one_is_told(self):
        selected = (
            "[...document.querySelectorAll('[role=tab]')].map((tab) => "
            "[tab.getAttribute('aria-selected'), tab.tabIndex].join())"
        )
        chosen = ["true,0"] + ["false,-1"] * (len(made.TABS) - 1)
        self.assertEqual(self.page.value(selected), chosen)
        self.tab_to("#to-overview")
        for key, name in (
            ("ArrowRight", "maps"),
            ("ArrowLeft", "overview"),
            ("ArrowLeft", "node"),
            ("Home", "overview"),
            ("End", "node"),
        ):
            self.page.press(key)
            self.page.wait("chosenTab() === '%s'" % name)
            self.page.wait("byId('to-%s').getAttribute('aria-selected') === 'true'" % name)
            self.assertEqual(self.page.value(FOCUS), "to-" + name)
            panels = self.page.value(
                "[...document.querySelectorAll('[role=tabpanel]')].filter((panel) => "
                "panel.clientHeight).map((panel) => panel.getAttribute('aria-labelledby'))"
            )
            self.assertEqual(panels, ["to-" + name])

    def test_cut_texts_unfold_by_keyboard(self):
        self.page.resize(400, 800)
        stamp = self.send(
            made.prediction(
                1,
                part_id="lot 3",
                serial_id="0010",
                reason="the whole interval lies above 1, " * 30,
            )
        )
        self.state.add_part(stamp, made.part("0010", 3.0, 1, reason="of the whole part, " * 20))
        self.page.wait("state.part.is_newest")
        for box, text, key in (
            ("verdict", "reason", "Enter"),
            ("limits", "limits-text", " "),
            ("part", "part-more", "Enter"),
        ):
            button = "#%s .unfold" % box
            cut = "byId('%s').scrollHeight > byId('%s').clientHeight + 1" % (text, text)
            expanded = "document.querySelector('%s').getAttribute('aria-expanded')" % button
            self.assertTrue(self.page.value(cut), box)
            self.tab_to(button)
            for is_open in ("true", "false"):
                self.page.press(key)
                self.page.wait("%s === '%s'" % (expanded, is_open))
                self.assertEqual(self.page.value(cut), is_open == "false", box)
        # a text that is whole has no button
        self.send(made.prediction(1, reason="short"))
        self.page.wait("document.querySelector('#verdict .unfold').hidden")

    def test_no_width_needs_scrolling_sideways(self):
        self.show_maps()
        for message in (
            made.prediction(1, scan_name="x" * 90, reason="y" * 300),
            made.prediction(2, status=2),  # the longest word
            awaiting(3),
        ):
            self.send(message)
            for width in WIDTHS:
                self.page.resize(width, 640)
                for tab in made.TABS:
                    self.open_tab(tab)
                    self.page.value("show()")
                    beyond = self.page.value(
                        "[...document.querySelectorAll('body *')].filter((one) => "
                        "!one.closest('svg, .map, .unseen') && one.clientWidth && "
                        "one.getBoundingClientRect().right > innerWidth + 1)"
                        ".map((one) => `${one.tagName} ${one.id}`)"
                    )
                    self.assertEqual(beyond, [], (width, tab))
                    self.assertEqual(
                        self.page.value("document.documentElement.scrollWidth"), width, tab
                    )

    def test_the_theme_is_the_systems(self):
        for theme, is_dark in (("dark", True), ("light", False)):
            self.page.theme(theme)
            red, green, blue = self.page.value(
                "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)"
            )
            self.assertEqual(red + green + blue < 3 * 128, is_dark, theme)

    @unittest.skipUnless(AXE, "axe-core is missing: scripts/setup installs axe-playwright-python")
    def test_axe_finds_nothing(self):
        source = pathlib.Path(AXE.submodule_search_locations[0], "axe.min.js").read_text()
        self.show_maps()
        self.page.value(source + "; 0")
        shown = [
            made.prediction(1),
            made.prediction(1, sticks=1),
            made.prediction(1, sticks=2),
            made.prediction(1, status=2),
            made.prediction(1, reason="", margin=NAN, restoring_force=NAN),
            awaiting(2),
        ]
        for number, message in enumerate(shown):
            self.send(message)
            for theme in THEMES:
                self.page.theme(theme)
                for width in (320, 1280):
                    self.page.resize(width, 800)
                    for tab in made.TABS if number == 0 else ("overview",):
                        self.open_tab(tab)
                        found = self.page.value(
                            "axe.run(document, {resultTypes: ['violations']}).then((answer) => "
                            "answer.violations.flatMap((one) => one.nodes.map((node) => one.id + "
                            "': ' + node.failureSummary.split('\\n')[1] + ' ' + node.html)))"
                        )
                        self.assertEqual(found, [], (number, theme, width, tab))

    def test_what_is_known_is_shown_while_the_force_of_the_device_is_on_its_way(self):
        before = self.send(made.prediction(1))
        self.state.add_device(before, device(2.5, 0))
        first = self.number
        self.page.wait("state.device && state.device.stamp === %d" % before)
        stamp = self.send(awaiting(2, pull_off_force=3.7e-6))
        self.page.wait("byId('word').textContent === 'COMPUTING'")
        self.assertEqual(self.page.text("#provisional").lower(), ON_ITS_WAY)
        self.assertEqual(
            self.page.text("#reason"),
            "The pull-off force of this scan is 3.70 µN, the restoring force of the spring 10.0 µN."
            " The verdict before, on scan %d: RELEASES, margin 2.5." % first,
        )
        self.assertEqual(self.page.text("#ratio-value"), "")
        self.assertTrue(self.page.value("document.title").startswith("COMPUTING (provisional)"))
        # the node's answer on the part by the scans before this one
        answer = DeviceVerdict(
            sticks=0,
            reason="by two scans",
            waits_for="device_force half_space",
            margin=2.4,
            margin_lower=1.2,
            margin_upper=4.8,
            peel_number=NAN,
        )
        self.state.add_answer(stamp, answer)
        self.page.wait("byId('word').textContent === 'RELEASES'")
        self.assertEqual(self.page.text("#ratio-value"), "2.4")
        self.assertTrue(self.page.value("document.title").startswith("RELEASES (provisional)"))
        self.state.add_device(stamp, device(0.2, 2))
        self.page.wait("byId('word').textContent === 'STICKS'")
        self.assertTrue(self.page.value("byId('provisional').hidden"))

    def test_a_force_that_will_not_come_is_not_waited_for(self):
        stamp = self.send(awaiting(1))
        self.page.wait("byId('word').textContent === 'COMPUTING'")
        self.state.add_answer(stamp, DeviceVerdict(sticks=3, reason="no", is_final=True))
        self.page.wait("byId('word').textContent === 'NOT KNOWN'")
        self.assertTrue(self.page.value("byId('provisional').hidden"))
        stamp = self.send(awaiting(1))
        refused = device(NAN, 3, status=DeviceAdhesion.REFUSED, message="no scan is large enough")
        self.state.add_device(stamp, refused)
        self.page.wait("byId('reason').textContent === 'No scan is large enough.'")
        self.assertEqual(self.page.text("#word"), "NOT KNOWN")


if __name__ == "__main__":
    unittest.main()
