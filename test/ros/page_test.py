#!/usr/bin/env python3
"""station_page in a real browser: what it shows is what the messages say, whatever comes, and
nothing is asked of other machines."""

import json
import re
import subprocess
import unittest

import actionlib
import browser
import dynamic_reconfigure.client
import numpy as np
import rospy
import rostest
from mems_stiction.msg import (
    CycleContactAction,
    CycleContactGoal,
    DeviceAdhesion,
    HalfSpaceSolution,
    PartVerdict,
    StictionPrediction,
    SweepLoadAction,
    SweepLoadGoal,
)
from mems_stiction.page_words import VERDICTS, flags_of, ratio_text, with_unit
from mems_stiction.prediction_text import judge_words
from mems_stiction.provenance import provenance_words
from mems_stiction.quantities import percent, typeset, with_interval
from roslib.packages import find_node
from stiction_client import (
    TIMEOUT,
    Collector,
    Counts,
    Station,
    Traffic,
    image_message,
    info_message,
    rough_surface,
    wait_for_listener,
    wait_until,
)

# A spring of 1 N/m over 1 um is far stronger than 3e-13 m^2 of these surfaces hold; three contacts
# carry a statement.
DEVICE = dict(
    spring_stiffness=100.0,
    travel=1e-6,
    contact_area=48 * 64 * 1e-16,
    mechanical_load=1e-5,
    electrode_area=1e-8,
)
HOSTILE = "<img src=x onerror=\"document.title='broken'\"><script>alert(1)</script>&amp;"
SHOWN = (
    "pull_off_force",
    "restoring_force",
    "contact_fraction",
    "asperity_count",
    "rms_height",
    "mechanical_load",
    "flattening_ratio",
)


def started(*arguments):
    """station_page on a free port: the process and the page's address."""
    process = subprocess.Popen(
        [find_node("mems_stiction", "station_page")[0], "--port", "0"] + list(arguments),
        stdout=subprocess.PIPE,
    )
    line = process.stdout.readline().decode()
    assert "shows it to this machine alone" in line, line
    return process, re.search(r"http://\S+", line).group(0)


@unittest.skipUnless(
    browser.program(),
    "no browser is installed: apt-get install chromium-headless-shell (scripts/setup does), "
    "or chromium",
)
class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("page_test")
        cls.counts = Counts()
        cls.predictions = Collector("prediction", StictionPrediction).connect()
        cls.solutions = Collector("half_space", HalfSpaceSolution)
        cls.devices = Collector("device_force", DeviceAdhesion).connect()
        cls.station = Station()
        cls.settings = dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT)
        process, cls.address = started(
            "--stale", "40"
        )  # longer than a busy machine takes from a scan to what is asked of it
        cls.addClassCleanup(process.communicate)
        cls.addClassCleanup(process.terminate)
        cls.page = browser.Browser(1024, 768)
        cls.addClassCleanup(cls.page.close)
        cls.page.open(cls.address)
        for topic in ("prediction", "half_space", "part_verdict", "contact_map", "deformed_height"):
            wait_for_listener(topic, "/station_page")

    def setUp(self):
        self.page.click("button[data-tab=overview]")

    def live(self, surface, name="scan"):
        """The prediction of the surface, once the page shows it."""
        count = len(self.predictions.messages)
        image = image_message(surface, self.station.stamp())
        image.header.frame_id = name
        self.station.height.publish(image)
        self.station.info.publish(info_message(image.header.stamp))
        prediction = self.predictions.wait(count + 1)[count]
        self.page.wait("state.scan && state.scan.stamp === '%.3f'" % image.header.stamp.to_sec())
        return prediction

    def live_device(self, surface):
        """The prediction of the surface and the force of its device, once the page shows both."""
        prediction = self.live(surface)
        stamp = prediction.header.stamp
        self.page.wait("state.device && state.device.stamp === %d" % stamp.to_nsec())
        return prediction, self.devices.of(stamp)

    def figure(self, name):
        """Text and exact value beside the verdict."""
        return self.page.value(
            "(() => { const found = document.querySelector('dd[data-name=%s]');"
            "return found && [found.textContent, found.dataset.value]; })()" % name
        )

    def open_tab(self, name):
        self.page.click("button[data-tab=%s]" % name)
        self.page.wait(
            "getComputedStyle(document.querySelector('#tab-%s')).display === 'grid'" % name
        )

    def test_1_before_any_scan_it_says_so(self):
        self.page.wait(
            "document.querySelector('#link-text').textContent === 'Connected to the node.'"
        )
        self.assertEqual(self.page.text("#word"), "WAITING")
        self.open_tab("runs")
        self.assertIn("None yet", self.page.text("#sweep-words"))

    def test_2_without_a_device_there_is_no_verdict_and_the_reason(self):
        prediction = self.live(rough_surface(1))
        self.assertEqual(self.page.text("#word"), "NO VERDICT")
        self.assertIn("device is not stated", self.page.text("#reason"))
        self.assertEqual(self.page.text("#ratio-value"), "")
        text, value = self.figure("pull_off_force")
        self.assertEqual(
            (text, float(value)),
            (with_unit(prediction.pull_off_force, "N"), prediction.pull_off_force),
        )
        self.assertIsNone(self.figure("restoring_force"))

    def test_3_verdict_margin_and_figures_are_those_of_the_message(self):
        self.settings.update_configuration(DEVICE)
        wait_until(
            lambda: self.devices.messages, "the device of the scan before, which is stated now"
        )
        smooth = rough_surface(
            2, rms_height=5e-10
        )  # three contacts hold it: one carries no statement
        prediction, device = self.live_device(smooth)
        self.assertEqual(
            (prediction.sticks, device.sticks),
            (StictionPrediction.STICKS_NO, StictionPrediction.STICKS_NO),
        )
        self.assertEqual(self.page.text("#word"), "RELEASES")
        self.assertEqual(
            self.page.value("document.querySelector('#verdict').dataset.level"), "releases"
        )
        self.assertTrue(self.page.value("document.title").startswith("RELEASES \u00b7 "))
        self.assertEqual(self.page.text("#ratio-value"), ratio_text(device.margin))
        self.assertEqual(
            self.page.text("#ratio-interval"),
            "95 %%: %s to %s" % (ratio_text(device.margin_lower), ratio_text(device.margin_upper)),
        )
        for name in SHOWN:
            self.assertEqual(float(self.figure(name)[1]), getattr(prediction, name), name)
        text, value = self.figure("device_pull_off_force")
        self.assertEqual(
            text,
            typeset(
                with_interval(
                    device.pull_off_force,
                    device.pull_off_force_lower,
                    device.pull_off_force_upper,
                    "N",
                )
            ),
        )
        self.assertEqual(float(value), device.pull_off_force)
        self.assertEqual(
            float(self.figure("linear_pull_off_force")[1]), device.linear_pull_off_force
        )
        self.assertIn(
            "RELEASES, margin %s" % ratio_text(device.margin), self.page.text("#device-words")
        )
        self.assertEqual(self.figure("contact_fraction")[0], percent(prediction.contact_fraction))
        self.assertEqual(
            self.page.value("byId('limits-text').textContent"),
            " · ".join(
                flags_of(prediction)
                + ["warning: " + text for text in list(prediction.warnings) + list(device.warnings)]
            ),
        )
        self.assertEqual(
            self.page.value("state.trend[state.trend.length - 1].ratio"), device.margin
        )
        self.assertEqual(self.page.text("#origin"), provenance_words(prediction))
        self.assertEqual(
            self.page.value("document.querySelectorAll('#trend-ratio circle').length"), 2
        )

        self.settings.update_configuration(dict(spring_stiffness=1e-4))
        self.live_device(smooth)
        self.assertEqual(self.page.text("#word"), "STICKS")
        self.assertEqual(
            self.page.value("document.querySelector('#verdict').dataset.level"), "sticks"
        )
        self.settings.update_configuration(DEVICE)

    def test_4_maps_and_curve_are_of_the_scan(self):
        surface = rough_surface(3)
        prediction = self.live(surface)
        self.open_tab("maps")
        for name in ("height", "contacts", "relief"):
            self.page.wait(
                "document.querySelector('#%s').naturalWidth === %d" % (name, surface.shape[1])
            )
        self.page.wait(
            "document.querySelector('#height-of').textContent === 'of scan ' + state.scan.number"
        )
        self.page.wait(
            "document.querySelector('#height-legend').textContent.includes('640 nm x 480 nm')"
        )  # by its scan_info, which may come later
        self.assertEqual(
            self.page.value(
                "Math.round(100 * document.querySelector('.map').clientWidth / "
                "document.querySelector('.map').clientHeight)"
            ),
            133,
        )
        self.page.wait("state.height_range && state.height_range[1] > 0")
        small = self.page.value("state.rings.length")
        self.assertEqual(
            self.page.value("document.querySelectorAll('#rings ellipse').length"), small
        )

        self.open_tab("curve")
        self.assertIn(
            "pull-off force %s" % with_unit(prediction.pull_off_force, "N"),
            self.page.text("#curve-words"),
        )
        forces = [point.force for point in prediction.curve]
        self.assertEqual(
            self.page.value("state.scan.curve.in.concat(state.scan.curve.out).length"), len(forces)
        )
        self.assertEqual(self.page.value("state.scan.curve.peak[1]"), max(forces))
        stamp = prediction.header.stamp
        solution = self.solutions.of(stamp)
        self.page.wait("state.half_space && state.half_space.stamp === %d" % stamp.to_nsec())
        self.assertIn(
            "solved. Pull-off force %s." % with_unit(solution.pull_off_force, "N"),
            self.page.text("#half-space"),
        )

    def test_5_a_rejected_scan_is_shown_with_its_reason(self):
        shown = self.page.value("state.scan.number")
        self.station.send(np.full((48, 64), np.nan, np.float32))
        self.page.wait("document.querySelector('#word').textContent === 'NOT PREDICTED'")
        self.assertIn("Rejected the scan of stamp", self.page.text("#reason"))
        self.assertIn("the last verdict, of scan %d: " % shown, self.page.text("#scan-name"))
        self.assertIn("1 not predicted", self.page.text("#counts"))
        self.open_tab("node")
        self.assertIn("scan %d: Rejected the scan" % (shown + 1), self.page.text("#losses"))
        self.page.wait("document.querySelector('#diagnostics').innerText.includes('rejected\\t1')")
        self.page.wait(
            "document.querySelector('#link').className === 'ok'", timeout=10
        )  # of the report that counted it, 'warn'
        _, device = self.live_device(rough_surface(4))
        self.assertEqual(self.page.text("#word"), VERDICTS[device.sticks][1])

    def test_6_names_are_text_and_never_markup(self):
        self.live(rough_surface(5), HOSTILE)
        self.assertTrue(
            self.page.text("#scan-name").endswith(": " + HOSTILE), self.page.text("#scan-name")
        )
        self.assertRegex(
            self.page.value("document.title"),
            r"^(Old: )?[A-Z ]+( \(provisional\))? · Stiction station$",
        )
        self.assertEqual(self.page.value("document.querySelectorAll('#scan-name *').length"), 0)

    def test_6b_the_part_and_what_the_scan_was_made_with_are_shown(self):
        parts = Collector("part_verdict", PartVerdict).connect()
        for seed, serial in ((11, "0012"), (12, "0012"), (16, HOSTILE)):
            stamp = self.station.stamp()
            info = info_message(stamp)
            info.scan_name, info.part_id, info.serial_id = "place %d" % seed, "lot 3", serial
            self.station.height.publish(image_message(rough_surface(seed), stamp))
            self.station.info.publish(info)
            self.page.wait("state.scan && state.scan.stamp === '%.3f'" % stamp.to_sec())
            wait_until(
                lambda: self.devices.messages[-1].header.stamp == stamp, "the device of the scan"
            )
            device = self.devices.messages[-1]
            wait_until(
                lambda: (
                    parts.messages
                    and (parts.messages[-1].header.stamp, parts.messages[-1].margin)
                    == (stamp, device.margin)
                ),
                "the part's verdict with that of the device",
            )
            part = parts.messages[-1]
            self.page.wait(
                "state.part.ratio.interval === %s && state.part.verdict_by === %s"
                % (
                    json.dumps(
                        "95 %%: %s to %s"
                        % (ratio_text(part.margin_lower), ratio_text(part.margin_upper))
                    ),
                    json.dumps(judge_words(part.verdict_by)),
                )
            )
            self.assertEqual(
                self.page.text("#part-word"),
                {0: "RELEASES", 1: "MARGINAL", 2: "STICKS", 3: "NOT KNOWN"}[part.sticks],
            )
            self.assertIn(
                "margin %s (95 %%: %s to %s)"
                % tuple(
                    ratio_text(value)
                    for value in (part.margin, part.margin_lower, part.margin_upper)
                ),
                self.page.text("#part-ratio"),
            )
            self.assertEqual(self.page.text("#part-name"), "Part lot 3, serial number %s:" % serial)
            self.open_tab("node")
            for name in ("scan_name", "part_id", "serial_id", "settings_hash", "version"):
                self.assertEqual(self.figure(name)[0], getattr(part, name))
        self.assertIn("1 scan", self.page.text("#part-scans"))
        self.live(rough_surface(14))
        self.assertIn("(before the newest scan)", self.page.text("#part-name"))

    def test_7_sweep_and_cycles_are_shown(self):
        for name, kind, goal in (
            ("sweep_load", SweepLoadAction, SweepLoadGoal(voltages=[0.0, 10.0, 20.0])),
            ("cycle_contact", CycleContactAction, CycleContactGoal(count=3)),
        ):
            client = actionlib.SimpleActionClient("stiction_node/" + name, kind)
            self.assertTrue(client.wait_for_server(rospy.Duration(TIMEOUT)))
            client.send_goal(goal)
            self.assertTrue(client.wait_for_result(rospy.Duration(TIMEOUT)))
        cycles = client.get_result().cycles
        self.open_tab("runs")
        self.page.wait(
            "state.runs.cycles && state.runs.cycles.points && state.runs.sweep.points.length === 5"
        )
        self.page.wait(
            "document.querySelector('#sweep-words').innerText.includes('Pressed with 10.0 µN')"
        )
        self.assertEqual(
            self.page.value("state.runs.cycles.points.map((point) => point.force)"),
            [one.pull_off_force for one in cycles],
        )
        self.assertIn("From contact 1 to contact 3", self.page.text("#cycles-words"))
        self.assertNotIn("running", self.page.text("#sweep-age"))
        self.assertGreater(
            self.page.value("document.querySelectorAll('#sweep-area circle').length"), 2
        )

    def test_7b_labels_of_axes_are_whole_on_every_screen(self):
        for width, height in ((1024, 768), (768, 1024), (1280, 500)):
            self.page.resize(width, height)
            for tab in ("overview", "curve", "runs"):
                self.open_tab(tab)
                self.page.value("show()")
                cut = self.page.value(
                    "[...document.querySelectorAll('#tab-%s svg.chart .label')].filter((label) => "
                    "{ const outer = label.ownerSVGElement.getBoundingClientRect(), inner = "
                    "label.getBoundingClientRect(); return inner.top < outer.top - 1 || "
                    "inner.bottom > outer.bottom + 1; }).map((label) => label.textContent)" % tab
                )
                self.assertEqual(cut, [], (tab, width))
        self.page.resize(1024, 768)

    def test_8_thirty_scans_a_second_are_throttled_and_none_is_missing(self):
        before = self.page.value("state.count")
        with Traffic(self.station, [rough_surface(6), rough_surface(7)], period=1 / 30) as traffic:
            self.page.value(
                "window.shown = 0, window.plain_show = window.show, window.show = () => { "
                "++window.shown; window.plain_show(); },window.since = performance.now(), 0"
            )
            wait_until(lambda: len(traffic.sent) >= 60, "two seconds of scans")
            self.page.wait("window.shown >= 2")
            shown, seconds = self.page.value(
                "[window.shown, (performance.now() - window.since) / 1000]"
            )
            self.page.value("window.show = window.plain_show, 0")
        self.assertLessEqual(shown, seconds / 0.2 + 1)  # one in 0.2 s at most
        self.page.wait("state.count === %d" % (before + len(traffic.sent)))
        self.page.wait("state.control && state.control.last === state.count")
        self.assertEqual(
            self.page.value(
                "document.querySelectorAll('#trend-force path[stroke=\"var(--control)\"]').length"
            ),
            3,
        )  # limits and centre
        shown, outside = self.page.value(
            "[document.querySelectorAll('#trend-force ellipse').length, "
            "state.control.outside.length]"
        )
        self.assertEqual(shown, outside)

    def test_9_several_browsers_see_the_same_and_old_data_are_marked(self):
        other = browser.Browser(768, 1024)
        self.addCleanup(other.close)
        other.open(self.address + "/#node")
        _, device = self.live_device(rough_surface(8))
        other.wait("state && state.device.stamp === %d" % device.header.stamp.to_nsec())
        self.assertEqual(other.text("#ratio-value"), ratio_text(device.margin))
        for page in (self.page, other):
            page.wait("/^last scan \\d\\d s ago$/.test(document.querySelector('#age').textContent)")
            self.assertEqual(
                page.value("document.querySelector('#verdict').className.split(' ')[0]"), "stale"
            )
        self.live(rough_surface(8))
        self.page.wait("document.querySelector('#age').textContent === ''")

    def test_a_a_node_that_restarts_is_followed_again(self):
        count = self.page.value("state.count")
        subprocess.run(
            ["rosnode", "kill", "stiction_node"],
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=30,
        )
        self.page.wait(
            "state.diagnostics.some((status) => status.values.some(([key, value]) => key === "
            "'received' && value === '0'))"
        )
        # it says what it does not know any more, until something is set
        self.page.wait(
            "document.querySelector('#link').textContent.includes('what was changed in the run "
            "before is lost')"
        )
        dynamic_reconfigure.client.Client("stiction_node", timeout=TIMEOUT).update_configuration(
            {"mechanical_load": 2e-6}
        )
        self.page.wait("document.querySelector('#link').className === 'ok'")
        PageTest.station = Station()
        wait_until(
            lambda: self.station.height.get_num_connections() > 0, "the node to subscribe again"
        )
        prediction = self.live(rough_surface(1))
        self.assertEqual(
            self.page.text("#word"), "NO VERDICT"
        )  # its settings are those of its configuration again
        self.assertEqual(float(self.figure("pull_off_force")[1]), prediction.pull_off_force)
        self.assertEqual(self.page.value("state.count"), count + 1)

    def test_b_a_page_whose_node_is_not_there_says_so(self):
        process, address = started("--node", "nobody", "prediction:=nothing")
        self.addCleanup(process.communicate)
        self.addCleanup(process.terminate)
        other = browser.Browser()
        self.addCleanup(other.close)
        other.open(address)
        other.wait(
            "document.querySelector('#link-text').textContent.startsWith('No node publishes "
            "/nothing')"
        )

    def test_c_nothing_went_wrong_and_nothing_was_asked_of_other_machines(self):
        self.assertEqual(self.page.errors, [])
        self.assertEqual(
            [
                address
                for address in self.page.requests
                if not address.startswith((self.address, "about:"))
            ],
            [],
        )
        self.assertGreater(len(self.page.requests), 5)


if __name__ == "__main__":
    rostest.rosrun("mems_stiction", "page", PageTest)
