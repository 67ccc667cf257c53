"""Messages of ROS 1 as ROS 2 has them: definitions as ros2msg schemas, contents by the names of
those.

A header loses its seq, a time becomes a builtin_interfaces/Time, and names of fields are in small
letters, of constants in capitals, as
ROS 2 asks for (sensor_msgs/CameraInfo: D becomes d). All else stays, so that a reader of one
version knows the fields of the other.
"""

import re

import genpy

SEPARATOR = "=" * 80
TIMES = {"time": "builtin_interfaces/Time", "duration": "builtin_interfaces/Duration"}
TYPES = dict(
    TIMES, Header="std_msgs/Header", char="uint8", byte="int8"
)  # as ROS 1 has the last two
_ENTRY = re.compile(r"(?P<type>[\w/]+)(?P<array>\[\d*\])?\s+(?P<name>\w+)\s*(?P<rest>.*)$")
_TIME = "MSG: %s\nint32 sec\nuint32 nanosec\n"


def schema_name(datatype):
    """mems_stiction/ScanInfo is mems_stiction/msg/ScanInfo."""
    return "/msg/".join(datatype.split("/"))


def schema_of(definition):
    """The text of a ros2msg schema with all that it uses; definition: as a bag has it beside a
    topic."""
    parts = re.split("^={3,}$", definition, flags=re.MULTILINE)
    sections = [_section(part.strip("\n")) for part in parts]
    used = {
        kind
        for section in sections
        for kind in re.findall(r"^(builtin_interfaces/\w+)", section, flags=re.MULTILINE)
    }
    return ("\n%s\n" % SEPARATOR).join(sections + [_TIME % kind for kind in sorted(used)])


def _section(text):
    lines = text.splitlines()
    is_header = bool(lines) and lines[0].split() == ["MSG:", "std_msgs/Header"]
    translated = [_line(line) for line in lines]
    return "\n".join(
        line for line in translated if not (is_header and re.match(r"uint32\s+seq\b", line))
    )


def _line(line):
    entry = _ENTRY.match(line)
    if not entry or line.startswith("MSG:"):
        return line
    kind, name, rest = entry.group("type"), entry.group("name"), entry.group("rest")
    kind = TYPES.get(kind, kind) + (entry.group("array") or "")
    if not rest.startswith("="):
        return "%s %s  %s" % (kind, name.lower(), rest) if rest else "%s %s" % (kind, name.lower())
    if kind == "string":  # of ROS 1 without quotes, to the end of the line
        text = rest[1:].strip().replace("\\", "\\\\").replace('"', '\\"')
        return '%s %s="%s"' % (kind, name.upper(), text)
    return "%s %s %s" % (kind, name.upper(), rest)


def as_ros2(value):
    """A message as a dictionary with the names of its schema; what a message holds, in the same
    way."""
    if isinstance(value, genpy.Message):
        return {name.lower(): as_ros2(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, genpy.TVal):
        return {"sec": value.secs, "nanosec": value.nsecs}
    if (
        isinstance(value, (list, tuple))
        and value
        and isinstance(value[0], (genpy.Message, genpy.TVal))
    ):
        return [as_ros2(item) for item in value]
    return value
