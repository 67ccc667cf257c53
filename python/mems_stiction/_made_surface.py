"""One made surface of a device: its heights, and its force from strips that may be made
anywhere."""

from __future__ import annotations

from typing import Any, Iterable, List, Optional, Tuple

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import Surface, array_of, pixels_of, records_of
from mems_stiction._device import Pitches, core_scans, scans_of_device
from mems_stiction._settings import Config, Settings, SurfaceError
from mems_stiction._types import Scans, UpperScans
from mems_stiction._warnings import ScanWarning, warn
from mems_stiction.quantities import with_unit

_Given = Tuple[List[Surface], List[Surface], Settings, int, Optional[float]]


class MadeSurface:
    """One of the surfaces that predict_device() makes, of the device's whole size.

        scans = ["afm_1.gwy", "wide.gwy"]
        surface = mems_stiction.MadeSurface(scans, area=1e-8, config="part.yaml")
        surface.heights(0, 0, 1000, 1000)  # [m]
        parts = [surface.cells(first, rows) for first, rows in surface.strips(8)]
        surface.adhesion(parts).pull_off_force  # [N]

    scans, pitch, config, area, contacts, upper, settings: as of predict_device().
    seed: goes before device_force/seed. realisation: which of the surfaces of this seed, from 0.
    depth: how far below its highest place the cells of a strip are told one by one [m]; None: what
    suffices as a rule.

    It is the surface of predict_device(...).realisations[realisation], to the bit, where that makes
    surfaces (contacts larger than the scans) and has room for the whole device
    (device_force/max_cells, which has no say here). rows, cols, pitch [m]: of the surface. Several
    contacts are squares of cols x cols pixels, one after another.
    A place depends on scans, settings and seed alone, not on what was asked for before: strips may
    be made in any order and any cut, on any machine, and add up to the same bits. Pickled, it is
    its scans and its seed: a machine that gets it makes it again.

    The interpreter's lock is released; Ctrl-C stops it. Threads that share one work one after
    another.
    """

    rows: int
    cols: int
    pitch: float

    def __init__(
        self,
        scans: Scans,
        pitch: Optional[Pitches] = None,
        config: Optional[Config] = None,
        *,
        area: Optional[float] = None,
        contacts: Optional[int] = None,
        seed: Optional[int] = None,
        realisation: int = 0,
        upper: Optional[UpperScans] = None,
        depth: Optional[float] = None,
        **settings: Any,
    ) -> None:
        lower, above, checked = scans_of_device(
            scans, area, pitch, contacts, config, upper, settings, {"device_force/seed": seed}
        )
        if (
            isinstance(realisation, bool)
            or not isinstance(realisation, (int, np.integer))
            or realisation < 0
        ):
            raise SurfaceError(
                "realisation: %r is not allowed, must be a whole number >= 0" % (realisation,)
            )
        self._make(
            (lower, above, checked, int(realisation), None if depth is None else float(depth))
        )
        warn(self._core.warnings, ScanWarning)

    def _make(self, given: _Given) -> None:
        lower, above, settings, realisation, depth = given
        self._given = given
        self._core = _core.MadeSurface(
            core_scans(lower), core_scans(above), settings._configuration, realisation, depth
        )
        self.rows, self.cols, self.pitch = self._core.rows, self._core.cols, self._core.pitch

    def heights(
        self, row: int = 0, col: int = 0, rows: Optional[int] = None, cols: Optional[int] = None
    ) -> np.ndarray:
        """The relief [m] of so many rows and cols from (row, col) on, float32: lower surface minus
        upper. None: to the end."""
        rows = self.rows - row if rows is None else rows
        cols = self.cols - col if cols is None else cols
        if not (0 <= row < row + rows <= self.rows and 0 <= col < col + cols <= self.cols):
            raise SurfaceError(
                "heights of %d x %d pixels from row %d, column %d are not allowed, must lie in the "
                "surface of %d x %d pixels" % (rows, cols, row, col, self.rows, self.cols)
            )
        heights = array_of(self._core.heights(row, col, rows, cols))
        assert heights is not None
        return heights

    def strips(self, count: int) -> List[Tuple[int, int]]:
        """(first row, rows) of as many strips, or of fewer where rows are few, that together are
        the surface; cut where it takes least time."""
        if count < 1:
            raise SurfaceError("count: %r is not allowed, must be >= 1" % (count,))
        tile_rows = self._core.tile_rows
        tiles = -(-self.cols // tile_rows)  # of a contact
        total = tiles * (self.rows // self.cols)
        count = min(count, total)
        places = [total * number // count for number in range(count + 1)]
        ends = [place // tiles * self.cols + place % tiles * tile_rows for place in places]
        return [(first, end - first) for first, end in zip(ends, ends[1:])]

    def cells(self, first_row: int, rows: int) -> bytes:
        """What a strip of the surface tells of the contacts of the whole, for adhesion() on this or
        another machine: its highest cells, and how many others lie at which height. A part in a
        hundred of what the heights would take, as a rule."""
        return self._core.cells(first_row, rows)

    def adhesion(self, parts: Iterable[bytes]) -> np.record:
        """The force of the whole, from what cells() told of all its rows, in any order:
        pull_off_force [N], apparent_work_of_adhesion [J/m^2], contacts, separation_at_rest [m], as
        in predict_device(...).realisations.

        Parts are taken one after another and not kept. Raises SurfaceError for a part of another
        surface, for rows that are missing or come twice, and where the cells do not reach deep
        enough; it says which depth does.
        """
        strips = self._core.strips()
        for part in parts:
            strips.add(part)
        found = self._core.adhesion(strips)
        warn(found.warnings, ScanWarning)
        return records_of(found.record)[0]

    def __reduce__(self) -> Any:
        lower, above, *rest = self._given
        return _made_again, (
            [_plain(scan) for scan in lower],
            [_plain(scan) for scan in above],
            *rest,
        )

    def __repr__(self) -> str:
        return "MadeSurface: %d x %d pixels of %s" % (
            self.rows,
            self.cols,
            with_unit(self.pitch, "m"),
        )


def _plain(scan: Surface) -> Tuple[Any, ...]:
    return (np.array(array_of(scan.core.pixels)), tuple(scan.core.pitch)) + tuple(scan[1:])


def _made_again(
    lower: Any, above: Any, settings: Settings, realisation: int, depth: Optional[float]
) -> MadeSurface:
    def surface(pixels: np.ndarray, pitch: Tuple[float, float], *rest: Any) -> Surface:
        return Surface(
            _core.height_map(pixels_of(pixels), pitch[0], pitch[1], _core.Configuration()), *rest
        )

    made = MadeSurface.__new__(MadeSurface)
    made._make(
        (
            [surface(*scan) for scan in lower],
            [surface(*scan) for scan in above],
            settings,
            realisation,
            depth,
        )
    )
    return made
