"""Which design releases? The margin of a device over one or two quantities of its design, and where
it is surely above 1."""

from __future__ import annotations

import contextlib
import itertools
import json
import math
import os
import warnings
from concurrent.futures import Executor, as_completed
from typing import Any, Callable, Dict, List, Mapping, Optional, Tuple, Union

import numpy as np

from mems_stiction._arrays import ReadOnly, plain_value
from mems_stiction._device import Pitches, scans_of_device
from mems_stiction._settings import Config, OptionsError, values_of
from mems_stiction._types import Scans, UpperScans
from mems_stiction._warnings import ScanWarning, SettingsWarning, warn
from mems_stiction.other_packages import require_package
from mems_stiction.design_axes import AREA, BEAM, ETCH, OF_THE_SPRING, STIFFNESS, TRAVEL, Axis
from mems_stiction.design_points import GAP, POTENTIAL, Holding, axes_of, warnings_of
from mems_stiction.design_rows import FIGURES, Rows
from mems_stiction.design_words import statements_of, told_once
from mems_stiction.quantities import counted
from mems_stiction.design_workers import Answers, answers_of_processes

OnProgress = Callable[[float], None]


class DesignSweep(ReadOnly):
    """The margin of a device over one or two quantities of its design.

    axes: names of the quantities, each with its values in ascending order.
    margin, margin_lower, margin_upper: over the axes, in their order [-]: median and 95 % interval.
    rows: a record for each point: the axes by their names, restoring_force, pull_off_force,
    pull_off_force_lower, pull_off_force_upper [N], margin, margin_lower, margin_upper,
    margin_transition [-], sticks, doubt: why no verdict is sure there.
    statements: where the device surely releases, in sentences.
    """

    axes: Dict[str, np.ndarray]
    margin: np.ndarray
    margin_lower: np.ndarray
    margin_upper: np.ndarray
    rows: np.recarray
    statements: Tuple[str, ...]

    def __init__(self, rows: Rows) -> None:
        listed = rows.all_rows()
        self._whole = [axis.name for axis in rows.axes if axis.is_whole]
        self._units = {axis.name: axis.unit for axis in rows.axes}
        self._origin = {"version": rows.version, "sweep": rows.fingerprint}
        shape = [len(axis.values) for axis in rows.axes]
        names = [axis.name for axis in rows.axes] + list(FIGURES) + ["sticks", "doubt"]
        kinds = [(name, object if name in ("sticks", "doubt") else float) for name in names]
        table = np.rec.fromrecords(
            [tuple(row[name] for name in names) for row in listed], dtype=kinds
        )
        self.__dict__.update(
            axes={axis.name: np.array(axis.values) for axis in rows.axes},
            rows=table,
            statements=statements_of(rows.axes, listed),
            **{
                name: table[name].reshape(shape)
                for name in ("margin", "margin_lower", "margin_upper")
            },
        )

    def save_rows(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """CSV, or Parquet with units where the path ends in .parquet: every point, as in rows."""
        from mems_stiction import row_table

        units = dict(
            {name: "N" for name in FIGURES if name.endswith("force") or "_force_" in name},
            **self._units,
        )
        rows = [dict(zip(self.rows.dtype.names or (), point)) for point in self.rows.tolist()]
        row_table.write_rows(
            os.fspath(path),
            self.rows.dtype.names,
            rows,
            {name: unit for name, unit in units.items() if unit},
            self._origin,
        )

    def to_dict(self) -> Dict[str, Any]:
        """What json() prints. None stands for what is not known, and for the infinite margin where
        nothing holds."""
        return dict(
            self._origin,
            axes={name: list(map(float, values)) for name, values in self.axes.items()},
            units=dict(self._units),
            whole=list(self._whole),
            statements=list(self.statements),
            rows=[
                {name: plain_value(row[name]) for name in self.rows.dtype.names}
                for row in self.rows
            ],
        )

    def json(self) -> str:
        """One line."""
        return json.dumps(self.to_dict())

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG, PDF or SVG: the margin over the axes, with the line of margin 1 and its 95 %
        band."""
        require_package("matplotlib", "a picture")
        from mems_stiction.design_figure import save_design

        save_design(self.to_dict(), path)

    picture = save_picture

    def __repr__(self) -> str:
        lines = ["Design over %s: %s" % (" and ".join(self.axes), counted(len(self.rows), "point"))]
        return "\n".join(lines + ["  " + statement for statement in self.statements])


def design_sweep(
    scans: Scans,
    pitch: Optional[Pitches] = None,
    config: Optional[Config] = None,
    *,
    axes: Mapping[str, Any],
    output: Optional[Union[str, "os.PathLike[str]"]] = None,
    workers: Optional[int] = None,
    on_progress: Optional[OnProgress] = None,
    upper: Optional[UpperScans] = None,
    etch_wavelength: Optional[float] = None,
    executor: Optional[Executor] = None,
    **settings: Any,
) -> DesignSweep:
    """Which design of this device releases?

        found = mems_stiction.design_sweep(["a.gwy", "b.gwy"], config="part.yaml",
                                           axes={"device/spring_stiffness": (0.5, 50, 12),
                                                 "interface/work_of_adhesion": [0.02, 0.1]},
                                           output="rows.csv")
        found.statements

    scans, pitch, config, upper, settings: as of predict_device(); the settings state the device.
    axes: one or two names of settings, each with its values: a list, or (from, to, count), which is
    filled by ratio where the ends lie a factor of 10 or more apart. `hardness` [Pa] is that of both
    bodies, load/pressure what presses them before they are drawn apart.
    Beside settings, what processing makes of the scans' heights: roughness/scale, a factor of all
    heights; roughness/polish [m], a wavelength that a Gaussian filter halves (shorter waves go, 0:
    none); roughness/etch, a factor of the waves that are shorter than etch_wavelength [m].
    output: a .csv file that gets the rows as they come; a run that finds rows of the same sweep
    there goes on after them.
    workers: processes; as many as processors if None. With 1 all is done in this one. A program
    that starts more needs the usual
    `if __name__ == "__main__":`.
    on_progress: called with the share of the work that is done; what it throws ends it.
    executor: of concurrent.futures, that gets the points instead of processes of this machine:
    processes elsewhere, as those of
    Client.get_executor() of Dask.

    Each margin is that of predict_device(). Stiffness and travel of the spring do not change what
    holds: their values cost no time. Beams are not swept.
    Ctrl-C ends it; the rows that are written stay. Raises OptionsError, SurfaceError and FileError.
    """
    count = os.cpu_count() or 1 if workers is None else workers
    if not isinstance(count, int) or isinstance(count, bool) or count < 1:
        raise OptionsError("workers: %r is not allowed, must be an integer >= 1" % (workers,))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SettingsWarning)  # said of the axes' ends
        lower, above, checked = scans_of_device(
            scans, None, pitch, None, config, upper, settings, {}
        )
        sought = axes_of(axes, checked)
    warn(told_once(warnings_of(sought, checked)), SettingsWarning)
    _check_etching(sought, etch_wavelength)
    _check_electrodes(sought, values_of(checked))
    fixed = _fixed(sought, values_of(checked))
    holding = Holding(lower, above, checked, etch_wavelength)
    rows = Rows(sought, fixed, holding.fingerprint(sought), output)
    force_axes = [axis for axis in sought if axis.name not in OF_THE_SPRING]
    points = [
        dict(zip([axis.name for axis in force_axes], values))
        for values in itertools.product(*(axis.values for axis in force_axes))
    ]
    missing = [point for point in points if rows.key(point) not in rows.rows]
    tell = on_progress or (lambda share: None)
    done = len(points) - len(missing)
    tell(done / len(points))
    told: List[str] = []
    answers_of = (
        _found(holding, missing, min(count, len(missing)))
        if executor is None
        else _found_by(executor, holding, missing)
    )
    with contextlib.closing(answers_of) as answers:
        for point, (hold, said) in answers:
            rows.add(point, hold)
            told += said
            done += 1
            tell(done / len(points))
    rows.write()
    warn(told_once(told), ScanWarning)
    return DesignSweep(rows)


def _check_etching(axes: List[Axis], wavelength: Optional[float]) -> None:
    is_etched = any(axis.name == ETCH for axis in axes)
    if not is_etched and wavelength is not None:
        raise OptionsError("etch_wavelength: is not allowed without the axis %s" % ETCH)
    if is_etched and not (isinstance(wavelength, (int, float)) and 0.0 < wavelength < math.inf):
        raise OptionsError(
            "etch_wavelength: %r is not allowed with the axis %s, must be a number > 0 m"
            % (wavelength, ETCH)
        )


def _check_electrodes(axes: List[Axis], values: Dict[str, Any]) -> None:
    """What a contact potential holds at the electrodes would go with the travel, which costs no
    time."""
    names = [axis.name for axis in axes]
    if TRAVEL in names and values[GAP] > 0 and (values[POTENTIAL] != 0 or POTENTIAL in names):
        raise OptionsError(
            "axes: %s is not allowed with %s and %s: the gap of the closed electrodes goes with it"
            % (TRAVEL, GAP, POTENTIAL)
        )


def _fixed(axes: List[Axis], values: Dict[str, Any]) -> Dict[str, float]:
    """What of the spring is no axis. Raises OptionsError where the device is not stated."""
    swept = [axis.name for axis in axes]
    if values[BEAM] != "none":
        raise OptionsError(
            "%s: '%s' is not allowed: a sweep judges springs, not beams; call predict_device() for "
            "each design of a beam%s"
            % (
                BEAM,
                values[BEAM],
                ", or state none, and its spring is judged alone"
                if STIFFNESS in swept or values[STIFFNESS] > 0
                else "",
            )
        )
    for name in OF_THE_SPRING + (AREA,):
        if name not in swept and not values[name] > 0:
            raise OptionsError("%s: is not stated; must be > 0, or one of the axes" % name)
    return {name: float(values[name]) for name in OF_THE_SPRING if name not in swept}


def _found_by(executor: Executor, holding: Holding, points: List[Dict[str, float]]) -> Answers:
    """The same by whoever has the processors. What is not begun when it ends is not begun any
    more."""
    futures = {executor.submit(holding.at, point): point for point in points}
    try:
        for future in as_completed(futures):
            yield futures[future], future.result()
    finally:
        for future in futures:
            future.cancel()


def _found(holding: Holding, points: List[Dict[str, float]], count: int) -> Answers:
    """Each point with what holds there, in the order in which they end."""
    if count > 1:
        yield from answers_of_processes(holding, points, count)
        return
    for point in points:
        yield point, holding.at(point)
