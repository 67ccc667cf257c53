"""The pages say what the code says: links lead somewhere, names of topics, services and diagnostics
are those of the sources."""

import importlib.util
import pathlib
import re
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = REPOSITORY / "scripts" / "lib"
PAGES = [REPOSITORY / "README.md", REPOSITORY / "CONTRIBUTING.md"] + sorted(
    (REPOSITORY / "doc").glob("*.md")
)
API = (REPOSITORY / "doc" / "ros_api.md").read_text(encoding="utf-8")


def module(name):
    specification = importlib.util.spec_from_file_location(name, str(LIBRARY / (name + ".py")))
    loaded = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(loaded)
    return loaded


markdown = module("markdown_for_doxygen")


def source(path):
    return (REPOSITORY / path).read_text()


def section(title):
    """The text below a heading of the API page, up to the next of the same or a higher rank."""
    match = re.search(r"^(#+) %s$" % re.escape(title), API, re.MULTILINE)
    rest = API[match.end() :]
    end = re.search(r"^#{1,%d} " % len(match.group(1)), rest, re.MULTILINE)
    return rest[: end.start()] if end else rest


def rows(title):
    """{name: type} of the table below a heading."""
    found = re.findall(r"^\| (`[^|]+`) \| ([^|]+) \|", section(title), re.MULTILINE)
    return {name: kind.strip() for names, kind in found for name in re.findall(r"`([^`]+)`", names)}


class LinkTest(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        for page in PAGES:
            text = re.sub(
                r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL
            )
            for target in re.findall(r"\]\(([^)\s]+)\)", text):
                if target.startswith("http"):
                    continue
                path, _, anchor = target.partition("#")
                file = (page.parent / path).resolve() if path else page
                with self.subTest(page=page.name, target=target):
                    self.assertTrue(file.exists())
                    if anchor:
                        self.assertIn(anchor, markdown.anchors(file.read_text(encoding="utf-8")))

    def test_every_page_is_linked_from_the_readme(self):
        readme = PAGES[0].read_text(encoding="utf-8")
        for page in PAGES[1:]:
            self.assertTrue(
                "(%s" % page.relative_to(REPOSITORY).as_posix() in readme, "%s is not" % page.name
            )

    def test_every_picture_is_shown(self):
        text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
        for picture in (REPOSITORY / "doc" / "images").iterdir():
            self.assertIn(picture.name, text)


class RosApiTest(unittest.TestCase):
    def names(self, suffix):
        return re.findall(r'k\w+%s\[\] = "([^"]+)"' % suffix, source("src/ros/topic_names.hpp"))

    def test_topics(self):
        listed = dict(rows("Subscribed"))
        listed.update(rows("Published"))
        self.assertEqual(
            set(self.names("Topic")), {name for name in listed if not name.startswith("/")}
        )
        publisher = source("src/ros/result_publisher.cpp") + source("src/ros/half_space_stream.cpp")
        constants = dict(
            re.findall(r'(k\w+Topic)\[\] = "([^"]+)"', source("src/ros/topic_names.hpp"))
        )
        advertised = re.findall(
            r"(?:advertise<([\w:]+)>|transport_\.(advertise))\(\s*(k\w+)", publisher
        )
        self.assertGreaterEqual(len(advertised), 12)
        for kind, by_transport, constant in advertised:
            expected = "sensor_msgs/Image" if by_transport else kind.replace("::", "/")
            self.assertEqual(
                rows("Published")[constants[constant]].split("/")[-1], expected.split("/")[-1]
            )

    def test_services_and_actions(self):
        for title, suffix, folder in (
            ("Services", "Service", "srv"),
            ("Actions", "Action", "action"),
        ):
            listed = rows(title)
            self.assertEqual(
                {"~" + name for name in self.names(suffix)},
                {name for name in listed if name.startswith("~")},
            )
            for kind in listed.values():
                package, _, name = kind.partition("/")
                if package == "mems_stiction":
                    self.assertTrue(
                        (REPOSITORY / folder / ("%s.%s" % (name, folder))).exists(), kind
                    )

    def test_diagnostics(self):
        added = []
        for path in (
            "src/ros/scan_accounting.cpp",
            "src/ros/stiction_server.cpp",
            "src/ros/master_watch.cpp",
            "src/ros/half_space_stream.cpp",
            "src/ros/device_force_stream.cpp",
        ):
            added += re.findall(r'status\.add\("([^"]+)"', source(path))
        listed = re.findall(r"^\| `([^`]+)` \|", section("Diagnostics"), re.MULTILINE)
        self.assertEqual(listed, added)

    def test_encodings(self):
        for encoding in re.findall(
            r"enc::(?:TYPE_)?(\w+),", source("src/ros/image_conversion.cpp")
        ):
            self.assertIn(
                "`%s`" % (encoding if encoding[0].isdigit() else encoding.lower()),
                section("Subscribed"),
            )

    def test_every_definition_is_linked(self):
        for folder in ("msg", "srv", "action"):
            for path in (REPOSITORY / folder).iterdir():
                self.assertIn("(../%s/%s)" % (folder, path.name), section("Messages"))

    def test_settings_that_change_are_whole_sections(self):
        cfg = set(re.findall(r'^(\w+)\.add\(\s*"(\w+)"', source("cfg/Stiction.cfg"), re.MULTILINE))
        keys = re.findall(
            r"^\| `(\w+)/(\w+)` \|",
            (REPOSITORY / "doc" / "parameters.md").read_text(encoding="utf-8"),
            re.MULTILINE,
        )
        self.assertEqual(
            cfg, {(part, name) for part, name in keys if part in {part for part, _ in cfg}}
        )


class ParametersTest(unittest.TestCase):
    def test_the_ten_that_matter_are_settings_and_every_section_is_named(self):
        page = (REPOSITORY / "doc" / "parameters.md").read_text(encoding="utf-8")
        begin = page.index("## What a prediction depends on")
        matter, sections = page[:begin].split("## Section by section")
        keys = set(re.findall(r"^\| `([\w/]+)` \|", page[begin:], re.MULTILINE))
        chosen = re.findall(r"^\| `([\w/]+)` \|", matter, re.MULTILINE)
        self.assertEqual((len(chosen), set(chosen) - keys), (10, set()))
        headings = re.findall(r"^### (.+)$", page[begin:], re.MULTILINE)
        self.assertEqual(
            {name for heading in headings for name in heading.split(", ")}
            - set(re.findall(r"`(\w+)`", sections)),
            set(),
        )


class ValidityTest(unittest.TestCase):
    def test_every_flag_is_explained(self):
        page = (REPOSITORY / "doc" / "validity.md").read_text(encoding="utf-8")
        flags = re.findall(
            r"^uint32 (FLAG_\w+) = (\d+)", source("msg/StictionPrediction.msg"), re.MULTILINE
        )
        self.assertEqual(len(flags), 10)
        for name, value in flags:
            self.assertIn("`%s` (%s)" % (name, value), page)

    def test_few_contacts_forbid_no_plain_no_that_an_example_shows(self):
        """The README's first device has two contacts and a plain "No", by generated surfaces."""
        rows = {
            row.split("`")[1]: row
            for row in source("doc/validity.md").splitlines()
            if row.startswith("| `FLAG_")
        }
        readme = source("README.md")
        self.assertRegex(readme, r"status: equilibrium, 2 contacts\n.*\n +Does it stick\? No: ")
        never = 'the verdict is never a plain "no"'
        self.assertIn(never + ", unless generated surfaces judge", rows["FLAG_FEW_CONTACTS"])
        self.assertIn("*unknown*, unless another scan", rows["FLAG_UNRESOLVED"])

    def test_limits_are_those_of_the_code(self):
        page = (REPOSITORY / "doc" / "validity.md").read_text(encoding="utf-8")
        flags = source("src/verdict/regime_flags.hpp")
        self.assertIn(
            "fewer than %g pixels"
            % float(re.search(r"kFewestCellsPerContact = ([\d.]+)", flags).group(1)),
            page,
        )
        self.assertIn(
            "fewer than %s contacts" % re.search(r"kFewestContacts = (\d+)", flags).group(1), page
        )
        summary = source("src/prediction/contact_summary.cpp")
        self.assertIn(
            "not above %g" % float(re.search(r"kJkrLimit = ([\d.]+)", summary).group(1)), page
        )
        resolution = source("include/mems_stiction/verdict/resolution.hpp")
        self.assertIn(
            "`resolution/min_contact_pixels` pixels (%g)"
            % float(re.search(r"min_contact_pixels =\s*([\d.]+)", resolution).group(1)),
            " ".join(source("doc/scans.md").split()),
        )


class ReleaseTest(unittest.TestCase):
    def test_versions_agree(self):
        released = re.search(
            r"^(\d+\.\d+\.\d+) \((\S+)\)$", source("CHANGELOG.rst"), re.MULTILINE
        ).groups()
        citation = source("CITATION.cff")
        self.assertEqual(
            re.search(r"^version: (\S+)$\n^date-released: (\S+)$", citation, re.MULTILINE).groups(),
            released,
        )
        self.assertIn(
            "<version>%s</version>" % released[0], source("package.xml")
        )  # setup.py reads it there
        self.assertIn("project(mems_stiction VERSION %s " % released[0], source("CMakeLists.txt"))


class HeaderTest(unittest.TestCase):
    def test_opening_comments_belong_to_their_files(self):
        """Without @file doxygen takes the comment that opens a header for one on whatever
        follows."""
        for path in sorted((REPOSITORY / "include").rglob("*.hpp")):
            lines = path.read_text().splitlines()
            with self.subTest(header=path.name):
                if lines[2].startswith("///"):
                    self.assertEqual(lines[2], "/// @file")


if __name__ == "__main__":
    unittest.main()
