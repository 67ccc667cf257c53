"""YAML that somebody else has written, read with limits.

Anchors and aliases let a text of a few bytes contain itself, or stand for more than any memory
holds.
Both are refused before a tree is built, with the limits and words of the compiled reader
(yaml_text.hpp).
"""

from typing import Any, Dict, List, Optional

MOST_LEVELS = 32
MOST_VALUES = 10000
MOST_BYTES = 1000000


class UnfitYaml(ValueError):
    """Why a text is not read, in one line without the name of its file."""


def read_yaml(text: str, loader: Optional[Any] = None) -> Any:
    """The only document of a text. Raises UnfitYaml.

    loader: of PyYAML, which builds the values; None for its safe one.
    """
    import yaml  # type: ignore[import]

    safe = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        _Meter(len(text)).measure(yaml.parse(text, Loader=safe), yaml)
        return yaml.load(text, Loader=loader or safe)
    except yaml.YAMLError as error:
        raise UnfitYaml("is no YAML: %s" % " ".join(str(error).split()))
    except UnfitYaml:
        raise
    except (
        ValueError,
        OverflowError,
        RecursionError,
    ) as error:  # 2001-99-99 is a date to YAML alone
        raise UnfitYaml("has a value that cannot be read: %s" % " ".join(str(error).split()))


class _Size:
    """What a node holds with all that its aliases stand for."""

    def __init__(self, mark: Any, anchor: Optional[str], levels: int) -> None:
        self.mark = mark
        self.anchor = anchor
        self.values = 1
        self.bytes = 0
        self.levels = levels  # of maps and lists, itself among them


class _Meter:
    """Measures a document by the events of its parser."""

    def __init__(self, length: int) -> None:
        self.most_values = max(MOST_VALUES, length)
        self.most_bytes = max(MOST_BYTES, length)
        self.open: List[_Size] = []
        self.sizes: Dict[str, Optional[_Size]] = {}  # by anchor; None while what it names is open

    def measure(self, events: Any, yaml: Any) -> None:
        for event in events:
            if isinstance(event, (yaml.SequenceStartEvent, yaml.MappingStartEvent)):
                if event.anchor is not None:
                    self.sizes[event.anchor] = None
                self.open.append(_Size(event.start_mark, event.anchor, 1))
                self.check_levels(event.start_mark, len(self.open))
            elif isinstance(event, (yaml.SequenceEndEvent, yaml.MappingEndEvent)):
                self.add(self.open.pop())
            elif isinstance(event, yaml.ScalarEvent):
                size = _Size(event.start_mark, event.anchor, 0)
                size.bytes = len(event.value)
                self.add(size)
            elif isinstance(event, yaml.AliasEvent) and event.anchor in self.sizes:  # else no YAML
                named = self.sizes[event.anchor]
                if named is None:
                    refuse(
                        event.start_mark,
                        "an alias stands inside what it names, so that the text "
                        "contains itself; must not",
                    )
                else:
                    size = _Size(event.start_mark, None, named.levels)
                    size.values, size.bytes = named.values, named.bytes
                    self.add(size)

    def add(self, size: _Size) -> None:
        """A node that is complete, to what it stands in."""
        if size.anchor is not None:
            self.sizes[size.anchor] = size
        self.check_levels(size.mark, len(self.open) + size.levels)
        if not self.open:
            return
        whole = self.open[-1]
        whole.values += size.values
        whole.bytes += size.bytes
        whole.levels = max(whole.levels, size.levels + 1)
        for count, most, word in (
            (whole.values, self.most_values, "values"),
            (whole.bytes, self.most_bytes, "bytes"),
        ):
            if count > most:
                refuse(
                    size.mark,
                    "the text holds more than %d %s, as aliases stand for many" % (most, word),
                )

    def check_levels(self, mark: Any, levels: int) -> None:
        if levels > MOST_LEVELS:
            refuse(mark, "more than %d levels of maps and lists below one another" % MOST_LEVELS)


def refuse(mark: Any, why: str) -> None:
    raise UnfitYaml("line %d: %s" % (mark.line + 1, why))
