"""Values of options, as argparse asks for them: what is not allowed is said in one sentence with
what is."""

import argparse
import math
import re

from mems_stiction.version import version

PICTURES = (".png", ".pdf", ".svg")


class PrintVersion(argparse.Action):
    """As the programs print it; found only when it is asked for."""

    def __init__(self, option_strings, dest, **_):
        super().__init__(
            option_strings,
            dest,
            nargs=0,
            default=argparse.SUPPRESS,
            help="print the version and end",
        )

    def __call__(self, parser, *_):
        print(
            "%s of mems_stiction %s" % (parser.prog, version())
        )  # argparse alone would write to the standard error
        parser.exit()


def add_version(parser):
    """--version, as every program of the package has it."""
    parser.add_argument("--version", action=PrintVersion)


def add_plausibility(parser):
    """--accept-implausible and --strict, as the other programs have them."""
    parser.add_argument(
        "--accept-implausible",
        action="store_true",
        help="take scans and constants that no instrument, material or device has "
        "(limits/accept_implausible)",
    )
    parser.add_argument(
        "--strict",
        action="store_true",
        help="exit with 1 where there is a warning and nothing worse",
    )


def plausibility_of(arguments):
    """The settings that --accept-implausible states."""
    return {"limits/accept_implausible": True} if arguments.accept_implausible else {}


def number(text):
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(
            "'%s' is not allowed, must be a number: without its unit, and with a point as the "
            "decimal sign" % text
        )
    if is_lost(text, value):
        raise argparse.ArgumentTypeError(
            "'%s' is not allowed: too near to 0 for a number; write 0 for none" % text
        )
    return value


def is_lost(text, value):
    """Whether a number that is not 0 was read as 0, as 1e-400 is."""
    return value == 0 and re.search("[1-9]", re.split("[eE]", text)[0]) is not None


def number_in(least, most=math.inf, is_least_allowed=True):
    """A number of this range, as type=."""
    allowed = (
        "[%g, %g]" % (least, most)
        if most < math.inf
        else "%s %g" % (">=" if is_least_allowed else ">", least)
    )

    def checked(text):
        value = number(text)
        if not least <= value <= most or value == least and not is_least_allowed:
            raise argparse.ArgumentTypeError(
                "'%s' is not allowed, must be %s%s"
                % (text, "in " if most < math.inf else "", allowed)
            )
        return value

    return checked


not_negative = number_in(0)
positive = number_in(0, is_least_allowed=False)
share = number_in(0, 1)


def count(text):
    """A whole number, 0 or more."""
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be a whole number >= 0" % text)
    return int(text)


def picture(text):
    """The name of a picture that can be drawn."""
    if not text.endswith(PICTURES):
        raise argparse.ArgumentTypeError(
            "'%s' is not allowed, must end in %s or %s"
            % (text, ", ".join(PICTURES[:-1]), PICTURES[-1])
        )
    return text
