"""What studies share that write a section of a page from frames that they solve."""

import argparse
import pathlib
import re
import sys
import textwrap
import warnings

import mems_stiction


def parser_of(description, pixels, limit, limited):
    """limit: seconds of processor time; limited: what may take them."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("--pixels", type=int, default=pixels)
    parser.add_argument(
        "--limit", type=float, default=limit, help="seconds of processor time that " + limited
    )
    parser.add_argument("--page", type=pathlib.Path, help="whose section is written anew")
    return parser


def run(arguments, study, section_of, heading):
    """Prints the section of what study(arguments) finds, and puts it into its page."""
    for of_draws in (
        mems_stiction.ScanWarning,
        mems_stiction.SettingsWarning,
    ):  # of heights and materials that are as drawn
        warnings.simplefilter("ignore", of_draws)
    arguments.folder.mkdir(parents=True, exist_ok=True)
    section = wrapped(section_of(study(arguments), arguments))
    print(section, end="")
    if arguments.page:
        put(section, arguments.page, heading)


def wrapped(section):
    """Its paragraphs in the pages' 100 columns; tables and lists as they are."""
    return "".join(
        line
        if line[0] in "|-#!\n"
        else textwrap.fill(line, 100, break_long_words=False, break_on_hyphens=False) + "\n"
        for line in section.splitlines(keepends=True)
    )


def put(section, page, heading):
    """In place of the section of this heading, which is not the last one of the page."""
    text = page.read_text(encoding="utf-8")
    changed, count = re.subn(
        r"^%s\n.*?(?=^## )" % re.escape(heading),
        lambda _: section + "\n",
        text,
        flags=re.MULTILINE | re.DOTALL,
    )
    if count != 1:
        sys.exit("%s has no section '%s'" % (page, heading))
    page.write_text(changed, encoding="utf-8")
