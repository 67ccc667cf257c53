"""Packages of others that `pip install .` does not bring: where one is missing, the sentence says
how to get it."""

from __future__ import annotations

import importlib

from mems_stiction._core import Error

# Which extra of setup.py brings it.
EXTRAS = {
    "h5py": "formats",
    "pyarrow": "formats",
    "matplotlib": "pictures",
    "scipy": "process",
    "yaml": "process",
}


class MissingPackage(Error, ImportError):
    """What is asked for needs a package that is not installed."""


def require_package(name: str, purpose: str) -> None:
    """Raises MissingPackage; purpose: what needs it."""
    try:
        importlib.import_module(name)
    except ImportError:
        raise MissingPackage(
            "%s needs the Python package %s (apt install python3-%s, or pip install "
            '"mems_stiction[%s]")' % (purpose, name, name, EXTRAS[name])
        ) from None
