"""Settings by the names of config/stiction.yaml, with the words of its reader for what is wrong."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Dict, List, Optional, Union

from mems_stiction import _core
from mems_stiction._warnings import SettingsWarning, warn
from mems_stiction.other_packages import require_package
from mems_stiction.yaml_text import MOST_LEVELS, MOST_VALUES

Error = _core.Error
FileError = _core.FileError
OptionsError = _core.OptionsError
SurfaceError = _core.SurfaceError

Error.__doc__ = "Base of every error that the core raises on purpose."
FileError.__doc__ = "A file cannot be read; the message names it and the cause. Also an OSError."
OptionsError.__doc__ = (
    "Settings are unknown, of the wrong type or out of range: a line each. Also a ValueError."
)
SurfaceError.__doc__ = (
    "Heights cannot be used: shape, type, pitch, no valid pixel. Also a ValueError."
)
for _error in (Error, FileError, OptionsError, SurfaceError):
    _error.__module__ = "mems_stiction"


class Settings:
    """A configuration that is read and checked once, for many calls.

    config: None for the defaults, a dictionary, the path of a YAML file, or other Settings.
    settings: sections or single keys that go before it: load={"voltage": 5.0}, **{"load/voltage":
    5.0}. half_space="auto",
    True or False stands for half_space={"enabled": ...}.
    Raises OptionsError with a line for each key that is unknown, of the wrong type or out of range;
    FileError.
    Warns (SettingsWarning) about values that look like a wrong unit.
    """

    _configuration: _core.Configuration

    def __init__(self, config: Optional[Config] = None, **settings: Any) -> None:
        self._configuration = _configuration_of(config, settings)
        if settings or not isinstance(config, Settings):
            warn(self._configuration.warnings, SettingsWarning)

    def yaml(self) -> str:
        """Every setting as YAML, with units and ranges as comments; it reads back to the same
        values."""
        return self._configuration.yaml()

    def __repr__(self) -> str:
        return "Settings(%s)" % (", ".join(changed_lines(self)) or "defaults")

    def __reduce__(self) -> Any:
        return _settings_of_text, (self.yaml(),)


def _configuration_of(config: Optional[Config], settings: Dict[str, Any]) -> _core.Configuration:
    over = _plain(settings)
    if isinstance(config, Settings):
        return config._configuration.changed({}, over) if over else config._configuration
    if config is None:
        return _core.Configuration().changed({}, over)
    if isinstance(config, Mapping):
        return _core.Configuration().changed(_plain(config), over)
    if isinstance(config, (str, os.PathLike)):
        return _core.Configuration().loaded(os.fsencode(config), over)
    raise OptionsError(
        "config: %r is not allowed, must be a dictionary, the path of a YAML file or Settings"
        % (config,)
    )


def settings_with(
    config: Optional[Config], settings: Dict[str, Any], stated: Dict[str, Any]
) -> Settings:
    """Settings with values that go before both, and warnings about what holds in the end alone."""
    if not stated:
        return Settings(config, **settings)
    quiet = Settings.__new__(Settings)
    quiet._configuration = _configuration_of(config, settings)
    return Settings(quiet, **stated)


Config = Union[Mapping, str, "os.PathLike[str]", Settings]


def _settings_of_text(text: str) -> Settings:
    settings = Settings()
    settings._configuration = settings._configuration.read(text)
    return settings


def _plain(mapping: Mapping) -> Dict[str, Any]:
    """What YAML would give: dictionaries, and Python's own numbers in place of NumPy's.

    Raises OptionsError for a mapping that contains itself.
    """
    budget = [MOST_VALUES]
    return {
        str(key): (_half_space_section if key == "half_space" else _plain_value)(value, 1, budget)
        for key, value in mapping.items()
    }


def _half_space_section(value: Any, level: int, budget: List[int]) -> Any:
    """half_space="auto" is short for its setting `enabled`."""
    plain = _plain_value(value, level, budget)
    if isinstance(plain, Mapping):
        return plain
    if not isinstance(plain, bool) and plain != "auto":
        raise OptionsError(
            'half_space: %r is not allowed, must be True, False, "auto", or a dictionary of '
            "half_space/..." % (value,)
        )
    return {"enabled": "flagged" if plain == "auto" else plain}


def _plain_value(value: Any, level: int, budget: List[int]) -> Any:
    """level: maps and lists that the value stands in. budget: how many more values there may be."""
    budget[0] -= 1
    if level > MOST_LEVELS or budget[0] < 0:
        raise OptionsError(
            "settings: more than %d levels of dictionaries and lists, or %d values; "
            "do they contain themselves?" % (MOST_LEVELS, MOST_VALUES)
        )
    if isinstance(value, Mapping):
        return {str(key): _plain_value(inner, level + 1, budget) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain_value(inner, level + 1, budget) for inner in value]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if type(value).__module__ == "numpy" and getattr(value, "ndim", None) == 0:
        return value.item()
    if hasattr(value, "tolist"):
        return value.tolist()
    return value


def _lines(text: str) -> Any:
    """ "section/key: value" of each setting."""
    section = ""
    for line in text.splitlines():
        setting = line.partition("  # ")[0].rstrip()
        if setting.endswith(":"):
            section = setting[:-1]
        else:
            yield (
                "/".join(part for part in (section, setting.strip()) if part)
                if line.startswith(" ")
                else setting
            )


def changed_lines(settings: Settings) -> List[str]:
    """ "section/key: value" of each setting that is not its default."""
    return sorted(set(_lines(settings.yaml())) - set(_lines(_core.Configuration().yaml())))


def values_of(settings: Settings) -> Dict[str, Any]:
    """Every setting with its value, by "section/key"."""
    require_package("yaml", "a setting by its name")
    import yaml  # type: ignore[import]

    values: Dict[str, Any] = {}
    _flatten(yaml.safe_load(settings.yaml()), "", values)
    return values


def _flatten(section: Dict[str, Any], before: str, values: Dict[str, Any]) -> None:
    for key, value in section.items():
        if isinstance(value, dict):
            _flatten(value, before + key + "/", values)
        else:
            values[before + key] = value
