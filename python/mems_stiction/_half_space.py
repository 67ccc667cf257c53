"""The whole surface as one elastic half-space with adhesion."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import (
    Pitch,
    ReadOnly,
    Surface,
    copied,
    explained,
    plain_value,
    records_of,
)
from mems_stiction._inputs import inputs_of, warn_about
from mems_stiction._prediction import Verdict
from mems_stiction._settings import Config
from mems_stiction._types import Heights, Upper
from mems_stiction.other_packages import require_package
from mems_stiction.quantities import counted, percent, with_unit


@explained
class HalfSpace(_core.HalfSpaceFigures, ReadOnly):
    """What the half-space answers. Forces and areas are of the frame, attraction is positive; NaN:
    not reached.

    verdict: on the device, by the half-space if it can judge, else by a prediction of the same
    surfaces (verdict_by says which, and the reason why); None without a device.
    Sources: doc/half_space.md.
    """

    def __init__(self, core: _core.SolvedScan, surface: Surface) -> None:
        self.__dict__.update(core.figures)
        verdict = core.verdict
        self.verdict: Optional[Verdict]
        self.name: str
        self.pitch: Tuple[float, float]
        self._is_transposed = surface.is_transposed
        self._origin = core.origin
        #: force over height, both ways: height [m] over first touch, force [N], direction (0
        # approach, 1 retraction)
        self.curve: np.recarray
        #: between the surfaces at rest [Pa], repulsion positive; None if there is no rest, as the
        # maps below
        self.pressure: Optional[np.ndarray]
        #: at rest [m]
        self.gap: Optional[np.ndarray]
        #: 0 apart, 1 elastic, 3 plastic
        self.contact_map: Optional[np.ndarray]
        #: the scan after contact [m]: what flowed is missing
        self.deformed_lower: Optional[np.ndarray]
        #: the same of the upper surface; None if it is flat and harder
        self.deformed_upper: Optional[np.ndarray]
        self.__dict__.update(
            verdict=None if verdict is None else Verdict(verdict),
            name=surface.name,
            pitch=surface.core.pitch,
            curve=records_of(core.curve),
            pressure=surface.map_of(core.pressure),
            gap=surface.map_of(core.gap),
            contact_map=surface.map_of(core.contact_map),
            deformed_lower=surface.map_of(core.deformed_lower.pixels),
            deformed_upper=surface.map_of(core.deformed_upper.pixels),
        )

    def save_maps(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """HDF5 in the layout of NetCDF-4 (.h5, .hdf5, .nc), by h5py: the maps and the curve (group
        curve) with their units as attributes."""
        from mems_stiction import map_file

        maps = [map_file.Map("gap", self.gap, "m", "gap at rest")] + map_file.maps_after_contact(
            self
        )
        figures = {name: getattr(self, name) for name in _core.figures["HalfSpaceFigures"]}
        map_file.save(
            path,
            maps,
            {"curve": self.curve},
            self.pitch,
            self._is_transposed,
            dict({"scan_name": self.name}, **self._origin, status=self.status),
            json.dumps({name: plain_value(value) for name, value in figures.items()}),
        )

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG: pressure at rest, and force over height."""
        require_package("matplotlib", "a picture")
        from mems_stiction import _pictures

        _pictures.save_half_space(self, os.fspath(path))

    def __getstate__(self) -> Dict[str, Any]:
        return {name: copied(value) for name, value in self.__dict__.items()}

    def __repr__(self) -> str:
        lines = [
            "Half-space%s: %s"
            % (" of " + self.name if self.name else "", self.status.lower().replace("_", " "))
        ]
        lines.append(
            "  pull-off force %s; contact %s in %s; mean gap %s"
            % (
                with_unit(self.pull_off_force, "N"),
                percent(self.contact_fraction),
                counted(self.contact_count, "group"),
                with_unit(self.mean_gap, "m"),
            )
        )
        lines.append(
            "  %s, %s; %s in %s"
            % (
                "converged" if self.is_converged else "not converged",
                "resolved" if self.is_resolved else "pixels too large",
                counted(self.state_count, "state"),
                with_unit(self.processing_time, "s"),
            )
        )
        if self.verdict is not None:
            lines.append("  sticks: %s" % self.verdict.summary)
        return "\n".join(lines)

    def _repr_html_(self) -> Optional[str]:
        try:
            from mems_stiction import _pictures
        except ImportError:  # without Matplotlib a notebook shows the text
            return None
        return _pictures.half_space_html(self)


def half_space(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    upper: Optional[Upper] = None,
    **settings: Any,
) -> HalfSpace:
    """Solves the same surfaces, with the same settings, as one elastic half-space: seconds to
    minutes, for the frames that matter. Arguments are those of predict(); half_space/... are its
    own settings.

    Ctrl-C stops it; the interpreter's lock is released. half_space={"threads": N} uses more
    processors, for the same bits.
    Raises OptionsError for a work of adhesion, Hamaker constant, material or load that has no
    solution; SurfaceError for a frame without a valid pixel, or with more than
    half_space/max_pixels. Warns (ScanWarning) of pixels that are too large for the edges of
    contacts.
    """
    checked, surface, prepared = inputs_of(heights, pitch, config, upper, settings)
    warn_about(surface, _core.half_space_warnings(prepared, checked._configuration))
    return HalfSpace(_core.half_space(prepared, surface.identity, checked._configuration), surface)
