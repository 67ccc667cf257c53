"""What the report's page says: the device first, units beside their numbers, who measured and when,
few pages."""

import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import weasyprint
from mems_stiction import report
from mems_stiction.quantities import unbroken
from mems_stiction.report_device import device_lines, measurements_of
from roslib.packages import find_node

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "ros"))
import browser  # noqa: E402  (the path comes first)

AFM_SCAN = pathlib.Path(__file__).resolve().parents[2] / "scripts/examples/make_afm_scan"
NO_BREAK = "\u00a0"
SCANS = 3
STEPS = 3  # thumbnails of a scan's cleaning: as measured, spikes, level
MILLIMETRE = 96 / 25.4  # in pixels of CSS


def plain(text):
    """What a reader of the page sees, without what is to be copied."""
    text = re.sub(r"(?s)<pre>.*?</pre>|<style>.*?</style>|<head>.*?</head>", "", text)
    return html.unescape(re.sub(r"<[^>]*>", "\n", text))


class WordsTest(unittest.TestCase):
    def test_warnings_have_the_micro_of_the_other_figures(self):
        rows = [{"warnings": "measure a field of 40 um"}, {"warnings": None}, {}]
        self.assertEqual(
            [report._limits(row) for row in rows], ["measure a field of 40 µm", "", ""]
        )

    def test_no_line_ends_between_a_number_and_its_unit(self):
        for text in (
            "12.3 nN",
            "95 %",
            "0.2 µm²",
            "1 J/m²",
            "3 N/m",
            "2.5e-13 m^2",
            "12 GPa",
            "1 mJ/m^2",
            "30 V",
            "7 mm²",
            "5 s",
        ):
            self.assertEqual(
                unbroken("of %s, then" % text), "of %s, then" % text.replace(" ", NO_BREAK)
            )
        self.assertEqual(unbroken("≥ 3 nN"), "≥" + NO_BREAK + "3" + NO_BREAK + "nN")
        for text in ("of 3 most", "scan 3 is", "2 scans say", "1 sticks", "4 Nodes", "at 3 min"):
            self.assertEqual(unbroken(text), text)

    def test_a_table_that_cannot_be_written_whole_leaves_the_one_that_was_there(self):
        class NoText:
            def __str__(self):
                raise ValueError("no text")

        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "report.csv")
            path.write_text("before")
            for write in (
                lambda: report.write_csv([{"a": 1}, {"a": NoText()}], path),
                lambda: report.write_json([NoText()], [], "{}", path),
            ):
                self.assertRaises(ValueError, write)
                self.assertEqual(path.read_text(), "before")
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [path])

    def test_the_device_is_what_the_settings_state(self):
        lines = dict(
            device_lines(
                {
                    "device": {
                        "spring_stiffness": 10.0,
                        "travel": 1e-6,
                        "contact_area": 1e-10,
                        "contacts": 4,
                        "guidance": "free",
                        "beam_type": "none",
                    },
                    "interface": {"work_of_adhesion": 0.05},
                    "load": {"voltage": 0.0, "mechanical_load": 2e-6},
                }
            )
        )
        self.assertEqual(
            lines,
            {
                "stiffness of the suspension": "10.0 N/m",
                "travel to contact": "1.00 µm",
                "restoring force": "10.0 µN",
                "area of its contacts": "100 µm²",
                "number of its contacts": "4",
                "guidance": "free",
                "work of adhesion": "50.0 mJ/m²",
                "mechanical load on the scan": "2.00 µN",
            },
        )
        self.assertEqual(device_lines({"device": {"contacts": 1, "guidance": "guided"}}), [])
        beam = dict(
            device_lines(
                {"device": {"beam_type": "doubly_clamped", "beam_length": 1e-4, "contacts": 1}}
            )
        )
        self.assertEqual((beam["beam"], beam["length of the beam"]), ("doubly clamped", "100 µm"))

    def test_who_measured_and_when_is_what_the_record_says(self):
        row = {
            "acquisition_time": "2021-03-04T05:06:07",
            "operator_name": "A. Nother",
            "instrument": "",
            "checksum": "00ff",
        }
        self.assertEqual(measurements_of([{}, {}]), "")
        self.assertEqual(
            measurements_of([row, dict(row, acquisition_time="2020-01-02"), {}]),
            "Measured from 2020-01-02 to 2021-03-04T05:06:07; operator: A. Nother; 1 of 3 scans "
            "state no date.",
        )
        self.assertEqual(
            measurements_of([dict(row, acquisition_time="", instrument="Icon")]),
            "Operator: A. Nother; instrument: Icon.",
        )


class PageTest(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        cls.doClassCleanups()  # nose knows nothing of them

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        scan = cls.folder / "afm.txt"
        subprocess.run([AFM_SCAN, str(scan)], check=True, timeout=300)
        scans = [scan]
        for number in range(2, SCANS + 1):
            scans.append(cls.folder / ("afm_%d.txt" % number))
            scans[-1].write_text(scan.read_text())
        for path in scans:
            pathlib.Path(str(path) + ".yaml").write_text(
                "pitch_x: 10.0e-9\npitch_y: 10.0e-9\nheight_scale: 1.0e-9\n"
            )
        (cls.folder / "device.yaml").write_text(
            "load: {mechanical_load: 1.0e-6}\npreprocessing: {spikes: {enabled: true}, level: "
            "plane}\n"
            "device: {spring_stiffness: 100.0, travel: 1.0e-6, contact_area: "
            "1.0e-11}\ndevice_force: {enabled: false}\n"
        )
        done = subprocess.run(
            [
                find_node("mems_stiction", "stiction_report")[0],
                "-c",
                cls.folder / "device.yaml",
                "-o",
                cls.folder / "r.html",
            ]
            + scans,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
            timeout=600,
        )
        assert done.returncode == 0, done.stderr
        cls.text = (cls.folder / "r.html").read_text(encoding="utf-8")
        cls.printed = printed = weasyprint.HTML(string=cls.text).render().pages
        cls.pages = [
            " ".join(box.text for box in page._page_box.descendants() if hasattr(box, "text"))
            for page in printed
        ]  # their words

    def test_units_stay_with_their_numbers_and_what_is_copied_stays_as_it_is(self):
        words = plain(self.text)
        self.assertEqual(re.findall(r"\d (?:[pnµmkMG]?(?:N|m|J|Pa|V)[²³]?|%)(?!\w)", words), [])
        self.assertGreater(words.count(NO_BREAK), 50)
        (given, *_) = re.findall(r"(?s)<pre>(.*?)</pre>", self.text)
        self.assertEqual(html.unescape(given), (self.folder / "device.yaml").read_text())

    def test_the_device_and_the_table_stand_on_the_first_page_and_pages_are_filled(self):
        pages = self.pages
        for expected in (
            "The device",
            "stiffness of the suspension",
            "100" + NO_BREAK + "µN",
            "afm_%d.txt" % SCANS,
        ):
            self.assertIn(expected, pages[0])
        self.assertLessEqual(len(pages), 4)  # with the cleaning of each

    def test_all_settings_are_a_file_and_no_part_of_what_is_printed(self):
        self.assertIn("spring_stiffness: 100", (self.folder / "r.settings.yaml").read_text())
        self.assertIn("r.settings.yaml", self.pages[-1])
        self.assertNotIn("spring_stiffness", " ".join(self.pages))
        self.assertIn("spring_stiffness", self.text)  # on the screen it unfolds

    @unittest.skipUnless(browser.program(), "no browser is installed")
    def test_no_width_needs_scrolling_sideways_and_nothing_overlaps(self):
        page = browser.Browser(420, 800)
        self.addCleanup(page.close)
        page.open((self.folder / "r.html").as_uri())
        for width in (320, 420, 1280):
            page.resize(width, 800)
            self.assertEqual(page.value("document.documentElement.scrollWidth"), width)
            overlaps = page.value(
                "[...document.querySelectorAll('.figures div')].filter(({children: [a, b]}) => { "
                "const [one, other] = [a, b].map((span) => span.getBoundingClientRect()); return "
                "one.right > other.left + 1 || other.right > innerWidth; })"
                ".map((row) => row.textContent)"
            )
            self.assertEqual(overlaps, [], width)
            # pictures that are scrolled in their own box keep a size that can be read
            least = page.value(
                "Math.min(...[...document.querySelectorAll('.picture img')].map((image) => "
                "image.clientWidth))"
            )
            self.assertGreater(least, 800, width)

    def test_thumbnails_of_the_cleaning_are_large_enough_on_paper(self):
        widths = []
        for page in self.printed:
            for box in page._page_box.descendants():
                if box.element_tag == "img" and "cleaning step" in (box.element.get("alt") or ""):
                    widths.append(box.width)
        self.assertEqual(len(widths), SCANS)
        self.assertGreater(min(widths) / MILLIMETRE / STEPS, 20)

    def test_a_heading_stands_with_its_picture(self):
        """No page ends with the heading of a scan."""
        for page in self.pages:
            if re.search(r"\d: afm[_\d]*\.txt", page):
                self.assertRegex(page, "formulation|Trends")

    def test_date_and_operator_stand_in_table_and_section(self):
        rows = json.loads((self.folder / "r.json").read_text())["scans"]
        for row in rows[:2]:
            row.update(acquisition_time="2021-03-04T05:06:07", operator_name="A. Nother")
        settings = (
            "version: 1\nopencv_version: 2\ninputs: []\nconfiguration:\n  load: {voltage: 0}\n"
        )
        section = dict.fromkeys(
            (
                "maps",
                "details",
                "surface",
                "sticks",
                "releases",
                "verdict",
                "flags",
                "half_space",
                "cleaning",
                "why_no_cleaning",
            ),
            "",
        )
        section.update(
            number=1,
            name="one",
            figures=[],
            surface_figures=[],
            warnings=[],
            origin=report.origin_of(rows[0]),
        )
        text = plain(report.page("A report", rows, [section], settings, None))
        self.assertIn("2021-03-04T05:06:07, A. Nother", text)
        self.assertIn(
            "Measured 2021-03-04T05:06:07; operator: A. Nother; %d of %d scans state no date."
            % (SCANS - 2, SCANS),
            text,
        )
        self.assertRegex(text, r"measured 2021-03-04T05:06:07,\s+by A\. Nother")
        self.assertNotIn("state no date", plain(self.text))
        self.assertNotIn("<th>measured</th>", self.text)


if __name__ == "__main__":
    unittest.main()
