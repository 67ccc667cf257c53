"""The rooms are as doc/architecture.md says: no include goes backwards, the core knows no ROS, only
one file knows a solver. Numbers as text do not follow the locale, and waits not the system's
clock."""

import pathlib
import re
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PAGE = REPOSITORY / "doc" / "architecture.md"
FIRST_ROOM_WITH_ROS = "ros"
INCLUDE = re.compile(r'^\s*#\s*include\s+"(?:mems_stiction/)?(\w+)/\w+\.hpp"')
PUBLIC = REPOSITORY / "include"
ONE_FOR_ALL = "mems_stiction/mems_stiction.hpp"
ROS = re.compile(
    r"\bros(?:::|/|cpp|bag|console)|\bROS_[A-Z]|\b\w+_msgs\b|<(?:tf2|nodelet|image_transport)"
)


def rooms_of_the_page():
    """The part of the page that has the picture and the table."""
    return re.search(
        r"^## Rooms\n(.*?)^## ", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    ).group(1)


def rooms():
    """{room: who may use it, besides itself} from below to above, as in the picture; None for every
    later room, else what the table of closed rooms has."""
    page = rooms_of_the_page()
    picture = re.search(r"^```text\n(.*?)^```", page, re.MULTILINE | re.DOTALL).group(1)
    closed = dict(re.findall(r"^\| `(\w+)` \| ([^|]+) \|$", page, re.MULTILINE))
    found = {
        room: re.findall(r"`([^`]+)`", closed.pop(room)) if room in closed else None
        for room in reversed(re.findall(r"^[ \w]{12}\|  (\w+)", picture, re.MULTILINE))
    }
    assert not closed, "closed rooms that the picture does not show: %s" % ", ".join(closed)
    return found


def sources():
    """(room, path inside include/mems_stiction or src, lines) of every file."""
    for top in (REPOSITORY / "include" / "mems_stiction", REPOSITORY / "src"):
        for path in sorted(top.glob("*/**/*.[hc]pp")):
            inside = path.relative_to(top)
            yield inside.parts[0], inside.as_posix(), path.read_text(encoding="utf-8").splitlines()


def backward_includes(order, files):
    """A line for each include that the order forbids."""
    names = list(order)
    found = []
    for room, path, lines in files:
        for number, line in enumerate(lines, 1):
            match = INCLUDE.match(line)
            if not match or match.group(1) == room:
                continue
            used = match.group(1)
            allowed = order[used]
            if names.index(used) > names.index(room):
                found.append("%s:%d: %s comes before %s" % (path, number, room, used))
            elif allowed is not None and room not in allowed and path not in allowed:
                found.append(
                    "%s:%d: %s is for %s alone"
                    % (path, number, used, ", ".join(allowed) or "nobody")
                )
    return found


def by_locale(code):
    """What writes or reads numbers, or turns letters, as the locale of the process has them; "%.0f"
    has no decimal sign."""
    plain = re.sub(r"//[^\n]*", "", code)
    found = re.findall(
        r"\b(?:strto(?:f|d|ld)|atof|sto(?:f|d|ld)|v?f?s?scanf|o?stringstream|tolower|toupper)\b",
        plain,
    )
    for call in re.findall(r"\bv?f?s?n?printf\([^;]*", plain):
        found += re.findall(r"%(?!\.0f)[-+ #0-9.*]*[aefgAEFG]", call)
    return found


class ArchitectureTest(unittest.TestCase):
    def test_every_folder_is_a_room_of_the_page(self):
        self.assertEqual({room for room, _, _ in sources()}, set(rooms()))
        tested = {path.name for path in (REPOSITORY / "test" / "core").iterdir() if path.is_dir()}
        self.assertLessEqual(tested, set(rooms()))

    def test_no_include_goes_backwards(self):
        self.assertEqual(backward_includes(rooms(), sources()), [])

    def test_public_headers_are_those_of_the_one_for_all(self):
        reached, waiting = set(), [ONE_FOR_ALL]
        while waiting:
            header = waiting.pop()
            if header not in reached:
                reached.add(header)
                waiting += re.findall(
                    r'^#include "(mems_stiction/[^"]+\.hpp)"',
                    (PUBLIC / header).read_text(encoding="utf-8"),
                    re.MULTILINE,
                )
        self.assertEqual(
            {path.relative_to(PUBLIC).as_posix() for path in PUBLIC.rglob("*.hpp")}, reached
        )

    def test_the_core_knows_no_ros(self):
        names = list(rooms())
        core = set(names[: names.index(FIRST_ROOM_WITH_ROS)])
        found = [
            "%s:%d: %s" % (path, number, line)
            for room, path, lines in sources()
            if room in core
            for number, line in enumerate(lines, 1)
            if ROS.search(line.partition("//")[0])
        ]
        self.assertEqual(found, [])

    def test_numbers_do_not_follow_the_locale(self):
        found = [
            (path, by_locale("\n".join(lines)))
            for _, path, lines in sources()
            if not path.startswith("errors/plain_format.")
        ]
        self.assertEqual([one for one in found if one[1]], [])

    def test_no_wait_follows_a_clock_that_somebody_sets(self):
        found = [
            "%s:%d: %s" % (path, number, line.strip())
            for _, path, lines in sources()
            for number, line in enumerate(lines, 1)
            if re.search(r"\bWallTim(?:e|er)\b|\bsystem_clock\b", line.partition("//")[0])
        ]
        self.assertEqual(found, [])

    def test_the_check_sees_what_follows_the_locale(self):
        for wrong in (
            "x = std::strtod(a, nullptr);",
            'std::snprintf(text, sizeof text,\n  "%s %.3g", a, b);',
            "std::stod(text)",
            "std::ostringstream out;",
        ):
            self.assertTrue(by_locale(wrong), wrong)
        for right in (
            'std::snprintf(text, 3, "%02x", a);',
            "plainStrtod(a)",
            'plainFormat("%g", a)',
            '// printf shows "%g"',
            'std::snprintf(t, 3, "%.0f s", a);',
        ):
            self.assertFalse(by_locale(right), right)

    def test_the_check_sees_what_is_wrong(self):
        order = {"low": None, "hidden": ["high", "middle/door.cpp"], "middle": None, "high": None}
        use = '#include "mems_stiction/%s/a.hpp"'
        for room, path, used, is_allowed in (
            ("low", "low/a.cpp", "high", False),
            ("high", "high/a.cpp", "low", True),
            ("low", "low/a.cpp", "low", True),
            ("high", "high/a.cpp", "hidden", True),
            ("middle", "middle/a.cpp", "hidden", False),
            ("middle", "middle/door.cpp", "hidden", True),
        ):
            for line in (use % used, '#include "%s/a.hpp"' % used):
                self.assertEqual(
                    backward_includes(order, [(room, path, [line])]) == [], is_allowed, (path, used)
                )


if __name__ == "__main__":
    unittest.main()
