"""JSON that somebody else has written."""

import json
from typing import Any


def read_json(text: str) -> Any:
    """What a text holds. Raises ValueError, also where maps and lists stand in one another too
    deeply to be read."""
    try:
        return json.loads(text)
    except RecursionError:
        raise ValueError("too many levels of maps and lists below one another") from None
