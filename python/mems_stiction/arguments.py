"""Values of options, as argparse asks for them: what is not allowed is said in one sentence with what is."""

import argparse
import math

PICTURES = (".png", ".pdf", ".svg")


def number(text):
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError("'%s' is not allowed, must be a number: without its unit, and with a point as the decimal sign" % text)
    return value


def picture(text):
    """The name of a picture that can be drawn."""
    if not text.endswith(PICTURES):
        raise argparse.ArgumentTypeError("'%s' is not allowed, must end in %s or %s" % (text, ", ".join(PICTURES[:-1]), PICTURES[-1]))
    return text
