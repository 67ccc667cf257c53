#!/usr/bin/env python3
"""Doxygen's input filter for Markdown: gives headings the anchors that GitHub gives them, so that
links between and within pages work in both. Doxygen's anchors are one for all pages: each gets its
page's name in front.

usage: markdown_for_doxygen.py PAGE.md    (prints the page)
"""

import os
import pathlib
import re
import sys

HEADING = re.compile(r"^(#{1,6})\s+(.*?)\s*$")
LINK = re.compile(r"\]\(([^)#\s]*)#([^)\s]+)\)")


def slug(title):
    """GitHub's anchor of a heading: lower case, no punctuation but hyphens and underscores, hyphens
    for spaces."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(text):
    """Anchors of a page in order; GitHub numbers those that come again."""
    seen, found, in_code = {}, [], False
    for line in text.splitlines():
        if line.startswith("```"):
            in_code = not in_code
        match = HEADING.match(line)
        if not match or in_code:
            continue
        name = slug(match.group(2))
        count = seen.get(name, 0)
        seen[name] = count + 1
        found.append(name if count == 0 else "%s-%d" % (name, count))
    return found


def prefix(path):
    return pathlib.Path(path).stem.lower()


def filtered(path, text):
    names, lines, in_code = iter(anchors(text)), [], False
    for line in text.splitlines():
        if line.startswith("```"):
            in_code = not in_code
        if HEADING.match(line) and not in_code:
            line = "%s {#%s-%s}" % (line.rstrip(), prefix(path), next(names))
        elif not in_code:
            line = LINK.sub(
                lambda link: (
                    "](#%s-%s)" % (prefix(link.group(1) or path), link.group(2))
                    if not link.group(1).startswith("http")
                    else link.group(0)
                ),
                line,
            )
            # Whatever is no page of the documentation (configuration, scripts, messages) is no link
            # in it.
            line = re.sub(
                r"\[([^\]]*)\]\(((?!http|#)[^)#\s]+)\)", lambda link: as_text(path, link), line
            )
        lines.append(line)
    return "\n".join(lines) + "\n"


def as_text(path, link):
    target = os.path.normpath(os.path.join(os.path.dirname(path), link.group(2)))
    if target.endswith(".md") or link.group(2).endswith((".png", ".svg")):
        return link.group(0)
    return (
        link.group(1)
        if link.group(1).endswith(os.path.basename(link.group(2)))
        else "%s (%s)" % link.group(1, 2)
    )


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8")
    print(filtered(sys.argv[1], pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")), end="")
