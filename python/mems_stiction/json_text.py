"""JSON that somebody else has written."""

import json
from typing import Any, Dict, Iterable, Iterator


def read_json(text: str) -> Any:
    """What a text holds. Raises ValueError, also where maps and lists stand in one another too
    deeply to be read."""
    try:
        return json.loads(text)
    except RecursionError:
        raise ValueError("too many levels of maps and lists below one another") from None


def json_records(lines: Iterable[str]) -> Iterator[Dict[str, Any]]:
    """The records of JSON lines. Raises ValueError."""
    for line in lines:
        if line.strip():
            row = read_json(line)
            if not isinstance(row, dict):
                raise ValueError("a line is no record")
            yield row
