"""What may be changed in a sweep of a design: names, and an axis with its values."""

from __future__ import annotations

from typing import NamedTuple, Tuple

STIFFNESS, TRAVEL, AREA = "device/spring_stiffness", "device/travel", "device/contact_area"
BEAM = "device/beam_type"
OF_THE_SPRING = (STIFFNESS, TRAVEL)
SCALE, POLISH, ETCH = "roughness/scale", "roughness/polish", "roughness/etch"
OF_THE_SURFACE = {SCALE: "", POLISH: "m", ETCH: ""}  # with their units
OF_BOTH_BODIES = {
    "hardness": ("lower/hardness", "upper/hardness")
}  # names that state a setting of each body
WORDS = {
    "hardness": "hardness of both bodies",
    SCALE: "factor of the heights",
    POLISH: "polished wavelength",
    ETCH: "factor of the short waves",
    "device/contacts": "number of contacts",
}
BY_RATIO = 10.0  # ends of a range that lie further apart are filled by ratio


def settings_named(name: str) -> Tuple[str, ...]:
    """That an axis states, but for what is of the surface."""
    return OF_BOTH_BODIES.get(name, (name,))


class Axis(NamedTuple):
    """One quantity of the design. name: of the setting, or roughness/...; unit: as SI has it;
    values: ascending; is_whole: it takes whole numbers alone."""

    name: str
    unit: str
    values: Tuple[float, ...]
    is_whole: bool = False

    @property
    def word(self) -> str:
        """For sentences."""
        section, _, last = self.name.rpartition("/")
        body = section + " body's " if section in ("lower", "upper") else ""
        return WORDS.get(self.name, body + last.replace("_", " "))
