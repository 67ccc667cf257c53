"""Which version of the package this is, with or without its compiled part."""

import pathlib
import xml.etree.ElementTree

UNKNOWN = "unknown"


def version() -> str:
    """ "0.2.0": as package.xml has it, which the core was compiled with."""
    try:
        from mems_stiction import _core

        return _core.version()
    except ImportError:
        pass
    for folder in (
        pathlib.Path(__file__).resolve().parents
    ):  # of the sources, or of what was installed
        for place in (folder / "package.xml", folder / "share/mems_stiction/package.xml"):
            if place.is_file():
                found = xml.etree.ElementTree.parse(str(place)).getroot()
                if found.findtext("name") == "mems_stiction":
                    return found.findtext("version") or UNKNOWN
    return UNKNOWN
