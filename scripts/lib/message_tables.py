#!/usr/bin/env python3
"""Writes the tables of doc/ros_api.md that repeat msg/, srv/, action/ and cfg/, between their markers.

usage: message_tables.py [--check]    --check: changes nothing, exit status 1 if the page is out of date
"""

import argparse
import pathlib
import re
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PAGE = REPOSITORY / "doc" / "ros_api.md"
PARTS = {".srv": ("request", "response"), ".action": ("goal", "result", "feedback"), ".msg": ("",)}
FIELD = re.compile(r"^(?P<type>[\w/]+(?:\[\])?)\s+(?P<name>\w+)(?:\s*=\s*(?P<value>\S+))?\s*(?:#\s*(?P<meaning>.*))?$")


def cell(text):
    return text.replace("|", "\\|")


def parts_of(path):
    """(description, [rows of one part, ...]) of a definition; a row is (field, type, meaning), or (heading,)."""
    description, parts, in_description = [], [[]], True
    for line in path.read_text().splitlines():
        text = line.strip()
        if not text:
            in_description = in_description and not description
        elif text == "---":
            parts.append([])
            in_description = False
        elif text.startswith("#"):
            if in_description:
                description.append(text.lstrip("# "))
            else:
                parts[-1].append((text.lstrip("# "),))
        else:
            in_description = False
            field = FIELD.match(text)
            if not field:
                raise ValueError("%s: what is '%s'?" % (path.name, text))
            name = field.group("name") + (" = " + field.group("value") if field.group("value") else "")
            parts[-1].append((name, field.group("type"), field.group("meaning") or ""))
    return " ".join(description), parts


def message_tables():
    lines = []
    for folder in ("msg", "srv", "action"):
        for path in sorted((REPOSITORY / folder).iterdir()):
            description, parts = parts_of(path)
            lines += ["### %s" % path.stem, ""]
            if description:
                lines += [description, ""]
            for title, rows in zip(PARTS[path.suffix], parts):
                if title:
                    lines += ["*%s*%s" % (title, "" if rows else ": empty"), ""]
                if not rows:
                    continue
                lines += ["| field | type | meaning |", "|---|---|---|"]
                for row in rows:
                    if len(row) == 1:
                        lines.append("| *%s* | | |" % cell(row[0]))
                    else:
                        lines.append("| `%s` | %s | %s |" % (row[0], row[1], cell(row[2])))
                lines.append("")
    return lines


def reconfigure_table():
    groups, meanings = {}, re.compile(r'^(\w+)\.add\("(\w+)", \w+, 0, "([^"]*)"')
    for line in (REPOSITORY / "cfg" / "Stiction.cfg").read_text().splitlines():
        match = meanings.match(line)
        if match:
            groups.setdefault(match.group(1), []).append((match.group(2), match.group(3)))
    lines = ["", "| name | key | meaning |", "|---|---|---|"]
    for group, settings in groups.items():
        lines += ["| `%s` | `%s/%s` | %s |" % (name, group, name, cell(meaning)) for name, meaning in settings]
    return lines + [""]


def with_part(page, name, lines):
    pattern = re.compile(r"(<!-- begin %s:[^>]*-->\n).*?(<!-- end %s -->)" % (name, name), re.DOTALL)
    if not pattern.search(page):
        raise ValueError("%s has no markers of '%s'" % (PAGE.name, name))
    return pattern.sub(lambda match: match.group(1) + "\n".join(lines) + match.group(2), page)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    page = PAGE.read_text()
    wanted = with_part(page, "messages", [""] + message_tables())
    wanted = with_part(wanted, "reconfigure", reconfigure_table())
    if wanted == page:
        return 0
    if arguments.check:
        print("%s is out of date; scripts/lib/message_tables.py writes it anew" % PAGE.name, file=sys.stderr)
        return 1
    PAGE.write_text(wanted)
    return 0


if __name__ == "__main__":
    sys.exit(main())
