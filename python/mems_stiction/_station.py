"""One contact under many loads, or many times."""

from __future__ import annotations

import os
from typing import Any, List, Optional, Sequence, Union

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import Pitch, ReadOnly, Surface, records_of
from mems_stiction._inputs import inputs_of
from mems_stiction._settings import Config, OptionsError
from mems_stiction._types import Heights, Upper
from mems_stiction.other_packages import require_package

LARGEST_COUNT = 2**31 - 1


class LoadSweep(ReadOnly):
    """A contact while the voltage goes up and down again, for each mechanical load.

    points: a record for each load, with the fields of msg/SweepPoint.msg: direction (0 up, 1 down),
    voltage [V], mechanical_load, pull_off_force, van_der_waals_force, electrostatic_force,
    normal_load [N], status (0 equilibrium, 1 bonded, 2 none), is_open, contact_area,
    contact_area_jkr [m^2], contact_fraction, approach [m], asperity_count, sticks (0 no, 1
    marginal, 2 yes, 3 unknown), margin, margin_lower, holding_margin, margin_upper [-],
    pull_off_force_lower, pull_off_force_upper [N], lands (0 no, 1 yes, 2 unknown), peel_number,
    peel_number_lower, peel_number_upper [-], is_peeled (of a beam: the peel number decides, not the
    margin), is_lower_bound (of pull_off_force).
    summaries: a record for each mechanical load: highest_releasing_voltage, highest_safe_voltage,
    lowest_sticking_voltage, opening_voltage, lowest_safe_voltage [V], as in msg/SweepSummary.msg;
    NaN: none of the sweep. pull_in_voltage [V]: at which the electrodes close; NaN where
    pull_in_reason names the settings that it lacks. why_no_margin: of the first point, in words;
    empty where it has a margin or a peel number.
    """

    def __init__(self, core: _core.LoadSweepResult) -> None:
        self.points: np.recarray
        self.summaries: np.recarray
        self.pull_in_voltage: float
        self.pull_in_reason: str
        self.why_no_margin: str
        self.__dict__.update(
            points=records_of(core.points),
            summaries=records_of(core.summaries),
            pull_in_voltage=core.pull_in_voltage,
            pull_in_reason=core.pull_in_reason,
            why_no_margin=core.why_no_margin,
        )

    def __repr__(self) -> str:
        from mems_stiction import station_text

        lines = [station_text.sweep_header()] + [
            station_text.sweep_line(point) for point in self.points
        ]
        return "\n".join(lines + station_text.sweep_sentences(self))

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG: contact and margins against the voltage, both ways."""
        require_package("matplotlib", "a picture")
        from mems_stiction import station_figures

        station_figures.save_sweep(self, path)


class ContactCycles(ReadOnly):
    """A contact that is made and opened again and again, each time as the last one left the
    surfaces.

    cycles: a record for each contact, with the fields of msg/CyclePoint.msg: cycle, status (0
    equilibrium, 1 bonded, 2 none), pull_off_force, van_der_waals_force [N], contact_area,
    contact_area_jkr [m^2], contact_fraction, asperity_count, plastic_count, rms_height,
    largest_change [m], sticks (0 no, 1 marginal, 2 yes, 3 unknown), margin, margin_lower,
    margin_upper [-], pull_off_force_lower, pull_off_force_upper [N], peel_number,
    peel_number_lower, peel_number_upper [-], is_peeled, is_lower_bound (of
    pull_off_force).
    first_sticking_cycle: 0 if none surely sticks, or neither a spring nor a beam is stated.
    why_no_margin: of the first contact, in words; empty where it has a margin or a peel number.
    lower, upper: both surfaces after the last contact [m], refined as preprocessing/refine says.
    """

    def __init__(self, core: _core.ContactCyclesResult, surface: Surface) -> None:
        self.cycles: np.recarray
        self.first_sticking_cycle: int
        self.why_no_margin: str
        self.lower: Optional[np.ndarray]
        self.upper: Optional[np.ndarray]
        self.__dict__.update(
            cycles=records_of(core.cycles),
            first_sticking_cycle=core.first_sticking_cycle,
            why_no_margin=core.why_no_margin,
            lower=surface.map_of(core.lower.pixels),
            upper=surface.map_of(core.upper.pixels),
        )

    def __repr__(self) -> str:
        from mems_stiction import station_text

        lines = [station_text.cycle_header()] + [
            station_text.cycle_line(cycle) for cycle in self.cycles
        ]
        return "\n".join(lines + station_text.cycle_sentences(self))

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG: pull-off force, contact, rms height and margin against the number of the contact."""
        require_package("matplotlib", "a picture")
        from mems_stiction import station_figures

        station_figures.save_cycles(self, path)


def _numbers(values: Any, name: str, unit: str) -> List[float]:
    """A number, or a list of them in any dress."""
    array = np.atleast_1d(np.asarray(values))
    if array.dtype.kind not in "fiu" and array.size or array.ndim != 1:
        raise OptionsError(
            "%s: %r is not allowed, must be a list of numbers [%s]" % (name, values, unit)
        )
    return array.astype(float).tolist()


def sweep_loads(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    upper: Optional[Upper] = None,
    *,
    voltages: Sequence[float] = (0.0,),
    mechanical_loads: Sequence[float] = (0.0,),
    **settings: Any,
) -> LoadSweep:
    """Up to which voltage does the device still come off? For each mechanical load [N] the voltage
    [V] goes up through the values and down again. Other arguments are those of predict(). Ctrl-C
    stops it.
    Raises OptionsError for values that do not ascend or are out of range.
    """
    checked, _, prepared = inputs_of(heights, pitch, config, upper, settings)
    return LoadSweep(
        _core.sweep_loads(
            prepared,
            checked._configuration,
            _numbers(voltages, "voltages", "V"),
            _numbers(mechanical_loads, "mechanical_loads", "N"),
        )
    )


def cycle_contact(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    upper: Optional[Upper] = None,
    *,
    count: int = 10,
    **settings: Any,
) -> ContactCycles:
    """After how many contacts does the device fail? The surfaces meet `count` times under the same
    load. Other arguments are those of predict(). Ctrl-C stops it. Raises OptionsError for a count
    below 1.
    """
    if (
        isinstance(count, bool)
        or not isinstance(count, (int, np.integer))
        or not -LARGEST_COUNT <= count <= LARGEST_COUNT
    ):
        raise OptionsError("count: %r is not allowed, must be an integer >= 1" % (count,))
    checked, surface, prepared = inputs_of(heights, pitch, config, upper, settings)
    return ContactCycles(_core.cycle_contact(prepared, checked._configuration, count), surface)
