"""SI numbers as people read them: 1.23e-7 N as "123 nN"."""

import math
import re

BEYOND_PREFIXES = 1e15  # from there on, and below the smallest prefix: an exponent
LONGEST_DRAWN = 400  # letters of a line of a picture
SURE = 0.05  # of a value: what reaches further than this leaves two digits of it
_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]")  # all but tab and line ends
_PREFIXES = {
    -21: "z",
    -18: "a",
    -15: "f",
    -12: "p",
    -9: "n",
    -6: "u",
    -3: "m",
    0: "",
    3: "k",
    6: "M",
    9: "G",
}


def counted(number, word):
    """ "1 scan", "2 scans"."""
    return "%d %s%s" % (number, word, "" if number == 1 else "s")


def prefix_for(value):
    """The power of ten (a multiple of 3) and the letter with which `value` has one to three digits
    before the point."""
    if value == 0 or not math.isfinite(value):
        return 0, ""
    exponent = 3 * math.floor(math.log10(abs(value) * (1 + 1e-9)) / 3)
    exponent = min(max(exponent, min(_PREFIXES)), max(_PREFIXES))
    return exponent, _PREFIXES[exponent]


def with_unit(value, unit, digits=3):
    """Three significant digits and a prefix: with_unit(1.234e-7, "N") is "123 nN"."""
    if not math.isfinite(value):
        return "%s %s" % (value, unit)
    if value == 0:
        return "0 %s" % unit
    if abs(value) >= BEYOND_PREFIXES or abs(value) < 10.0 ** min(_PREFIXES):
        return "%.*g %s" % (digits, value, unit)
    exponent, letter = prefix_for(float("%.*e" % (digits - 1, value)))
    scaled = float("%.*g" % (digits, value / 10.0**exponent))
    before_point = len("%d" % abs(scaled))
    return "%.*f %s%s" % (max(0, digits - before_point), scaled, letter, unit)


def length_scale(extent):
    """Factor and unit for an axis that spans `extent` metres: (1e9, "nm") or (1e6, "µm"), (1e3,
    "mm")."""
    if extent < 2e-6:
        return 1e9, "nm"
    return (1e6, "µm") if extent < 2e-3 else (1e3, "mm")


def percent(fraction):
    """Three significant digits: "12.3 %", "0.0123 %"."""
    value = 100 * fraction
    if not math.isfinite(value) or abs(value) >= BEYOND_PREFIXES:
        return "%.3g %%" % value
    if value == 0:
        return "0 %"
    decimals = max(0, 2 - math.floor(math.log10(abs(value)))) if abs(value) < 100 else 0
    return "%.*f %%" % (min(decimals, 6), value)


def ratio(value, digits=3):
    """Significant digits, without an exponent up to a million: "0.0299", "16", "1240". "-" where
    there is none."""
    if math.isnan(value):
        return "-"
    text = "%.*g" % (digits, value)
    return "%.0f" % float(text) if "e+" in text and abs(value) < 1e6 else text


def known_digits(value, lower, upper):
    """How many digits of a value are worth showing whose 95 % interval is this: two where it
    reaches further than 5 % to either side, else three; three where it is not known."""
    return 2 if abs(upper - lower) > 2 * SURE * abs(value) else 3


def with_interval(value, lower, upper, unit=""):
    """ "2.1 uN (1.5 to 2.9)", rounded to what is known; without the interval where that is not."""
    digits = known_digits(value, lower, upper)
    text = with_unit(value, unit, digits) if unit else ratio(value, digits)
    if not math.isfinite(value) or math.isnan(lower) or math.isnan(upper):
        return text
    scale = 10.0 ** prefix_for(float("%.*e" % (digits - 1, value)))[0] if unit else 1.0
    return "%s (%s to %s)" % (text, ratio(lower / scale, digits), ratio(upper / scale, digits))


def typeset(text):
    """A sentence with quantities, as a picture or a page can show it and a terminal may not: "0.2
    um^2" with its letters."""
    return re.sub(r"(?<=\d )u(?=\w)", "µ", text).replace("^2", "²")


def shortened(text, most):
    """The text, cut to so many letters."""
    return text if len(text) <= most else text[: most - 3] + "..."


def visible(text):
    r"""The text with its control characters written out: "\x1b[31m"."""
    return _CONTROL.sub(lambda found: "\\x%02x" % ord(found[0]), text)


def literal(text):
    """A text that came from outside, as it stands, for a picture of matplotlib, which takes what is
    between two dollar signs for a formula, has no glyph of a control character, and cannot draw
    some thousand letters in a line."""
    return visible(shortened(text, LONGEST_DRAWN)).replace("$", r"\$")


_UNITS = r"(?:[afpnuµmkMG]?(?:m|N|V|J|Pa|s|Hz|K)(?:\^?[2²3³])?(?:/(?:m|s)(?:\^?[2²3³])?)?|%)"


def unbroken(text):
    """The text with a space that ends no line between each number and its unit, and behind a
    bound's sign."""
    return re.sub(r"(?<=≥) (?=\d)|(?<=\d) (?=%s(?![\w]))" % _UNITS, "\u00a0", text)


def area(value):
    """Prefixes do not fit squares: area(2e-16) is "200 nm^2", area(2e-13) "0.2 um^2"."""
    return "%s nm^2" % ratio(value * 1e18) if value < 1e-14 else "%s um^2" % ratio(value * 1e12)
