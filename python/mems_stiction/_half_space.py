"""The whole surface as one elastic half-space with adhesion."""

from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import Pitch, Surface, array_of, records_of
from mems_stiction._inputs import inputs_of
from mems_stiction._prediction import Verdict
from mems_stiction._settings import Config
from mems_stiction.quantities import percent, with_unit


class HalfSpace:
    """What the half-space answers. Forces and areas are of the frame, attraction is positive; NaN: not reached.

    status: "SOLVED", "LOAD_NOT_REACHED", "NOT_CONVERGED" or "TOO_MANY_STATES". message: the same in a sentence.
    pull_off_force, pull_off_uncertainty [N]: largest of the retraction, voltage and load having gone, and by which finer steps
    may exceed it. pull_off_force_under_voltage [N]: the same if the voltage stays on.
    pull_off_height [m]: of the upper body then, over first touch.
    apparent_work_of_adhesion, adhesion_hysteresis [J/m^2]: from zero force to apart; what approach and retraction differ by.
    rest_height [m], rest_force [N]: under the mechanical load. contact_area [m^2], contact_fraction [-], contact_count:
    cells that repel each other at rest, and their groups. mean_gap [m]: at rest. flowed_volume [m^3]: lost by both.
    range, cohesive_length [m]: z0 of the traction law, and E z0^2/Gamma over which contacts part.
    is_converged, is_resolved, is_step_converged: every state is an equilibrium; pixels are small enough; so are steps.
    residual [-], state_count, iterations, jumps, processing_time [s]: of the solution.

    verdict: on the device, by the half-space if it can judge, else by a prediction of the same surfaces (verdict_by says
    which, and the reason why); None without a device.
    Sources: doc/half_space.md.
    """

    status: str
    message: str
    pull_off_force: float
    pull_off_uncertainty: float
    pull_off_height: float
    apparent_work_of_adhesion: float
    adhesion_hysteresis: float
    rest_height: float
    rest_force: float
    contact_area: float
    contact_fraction: float
    contact_count: int
    mean_gap: float
    flowed_volume: float
    range: float
    cohesive_length: float
    is_converged: bool
    is_resolved: bool
    is_step_converged: bool
    residual: float
    state_count: int
    iterations: int
    jumps: int
    processing_time: float
    pull_off_force_under_voltage: float

    def __init__(self, core: _core.SolvedScan, surface: Surface) -> None:
        def view(memory: Any) -> Optional[np.ndarray]:
            array = array_of(memory)
            return None if array is None else surface.back(array)

        self.__dict__.update(core.figures)
        verdict = core.verdict
        self.verdict = None if verdict is None else Verdict(verdict)
        self.name = surface.name
        #: force over height, both ways: height [m] over first touch, force [N], direction (0 approach, 1 retraction)
        self.curve: np.recarray = records_of(core.curve)
        #: between the surfaces at rest [Pa], repulsion positive; None if there is no rest, as the maps below
        self.pressure = view(core.pressure)
        #: at rest [m]
        self.gap = view(core.gap)
        #: 0 apart, 1 elastic, 3 plastic
        self.contact_map = view(core.contact_map)
        #: the scan after contact [m]: what flowed is missing
        self.deformed_lower = view(core.deformed_lower.pixels)
        #: the same of the upper surface; None if it is flat and harder
        self.deformed_upper = view(core.deformed_upper.pixels)

    def __getstate__(self) -> Dict[str, Any]:
        return {name: np.array(value).view(type(value)) if isinstance(value, np.ndarray) else value
                for name, value in self.__dict__.items()}

    def __repr__(self) -> str:
        lines = ["Half-space%s: %s" % (" of " + self.name if self.name else "", self.status.lower().replace("_", " "))]
        lines.append("  pull-off force %s; contact %s in %d groups; mean gap %s" % (
            with_unit(self.pull_off_force, "N"), percent(self.contact_fraction), self.contact_count, with_unit(self.mean_gap, "m")))
        lines.append("  %s, %s; %d states in %s" % (
            "converged" if self.is_converged else "not converged", "resolved" if self.is_resolved else "pixels too large",
            self.state_count, with_unit(self.processing_time, "s")))
        if self.verdict is not None:
            lines.append("  sticks: %s" % self.verdict.summary)
        return "\n".join(lines)

    def _repr_html_(self) -> Optional[str]:
        try:
            from mems_stiction import _pictures
        except ImportError:  # without Matplotlib a notebook shows the text
            return None
        return _pictures.half_space_html(self)


def half_space(heights: Any, pitch: Optional[Pitch] = None, config: Optional[Config] = None, upper: Any = None,
               **settings: Any) -> HalfSpace:
    """Solves the same surfaces, with the same settings, as one elastic half-space: seconds to minutes, for the frames that
    matter. Arguments are those of predict(); half_space/... are its own settings.

    Ctrl-C stops it; the interpreter's lock is released. half_space={"threads": N} uses more processors, for the same bits.
    Raises OptionsError for a work of adhesion, Hamaker constant, material or load that has no solution; SurfaceError for a
    frame without a valid pixel, or with more than half_space/max_pixels.
    """
    checked, surface, prepared = inputs_of(heights, pitch, config, upper, settings)
    return HalfSpace(_core.half_space(prepared, checked._configuration), surface)
