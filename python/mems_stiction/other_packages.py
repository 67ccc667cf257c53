"""Packages of others that `pip install .` does not bring: where one is missing, the sentence says
how to get it."""

from __future__ import annotations

import importlib

from mems_stiction._settings import Error


def require_package(name: str, purpose: str) -> None:
    """Raises Error; purpose: what needs it."""
    try:
        importlib.import_module(name)
    except ImportError:
        raise Error(
            "%s needs the Python package %s (apt install python3-%s, or pip install %s)"
            % (purpose, name, name, name)
        ) from None
