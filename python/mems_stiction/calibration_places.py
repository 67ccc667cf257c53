"""What a measurement was made on: surfaces, and what holds them by the constants of the interface.

A place is one of four kinds. *Frame*: the scan is what touched. *Probe*: a tip or sphere on a scan,
or on a smooth plane. *Parts*: an area that finds room several times in the scans. *Made*: an area
that the scans stand for; its force is that of surfaces made by their statistics.
"""

from __future__ import annotations

import hashlib
import math
import warnings
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

import mems_stiction
from mems_stiction._device import predict_device_under
from mems_stiction._settings import Settings
from mems_stiction._warnings import ScanWarning, SettingsWarning
from mems_stiction.calibration_constants import settings_of

FRAME_ALONE = {"device_force": {"enabled": False}, "half_space": {"enabled": False}}
NO_CLEANING = {
    "preprocessing": {
        "region": {
            "left": 0.0,
            "top": 0.0,
            "width": 0.0,
            "height": 0.0,
            "polygon_file": "",
            "mask_file": "",
        },
        "offset": {"enabled": False},
        "lines": {"method": "none"},
        "spikes": {"enabled": False},
        "fill": {"enabled": False},
        "tip": {"radius": 0.0, "half_angle": 0.0},
        "level": "none",
        "level_robust": False,
        "low_pass": {"cutoff_wavelength": 0.0},
        "refine": {"factor": 1},
    }
}

SAME_AREA = 0.05  # relative; areas are stated with two digits
PARTS_IN_SCANS = 4  # fewer do not show how places scatter
PLACES_WITH_ALL = 3  # of made surfaces; where there are more, each has fewer realisations
MOST_SHARE = 2.5  # of the realisations, where there are fewer: their chance is common to all
FEWEST_REALISATIONS = 3
SEEDS = 2**31

PROBE_PIXELS = 256
PROBE_DEPTH = 12e-9  # of a smooth probe's edge below its summit [m]: deeper parts attract little
PROBE_CONTACTS = 3.0  # half of a smooth probe's side over its contact radius by JKR, at least
PROBE_PLACES = 3  # on a scan, along each of its sides


class Figures(NamedTuple):
    """What is expected at a place.

    force, work: the geometric mean over such places [N, J/m^2]. ..._scatter: standard deviation of
    its logarithm from one place of the surfaces to another [-]. ..._common: what all places of the
    same surfaces share, since the scans, and the places that were looked at, are a sample [-].
    doubt: why a force may be out by more than 1.3, empty where it is not doubted.
    """

    force: float
    work: float
    force_scatter: float = 0.0
    work_scatter: float = 0.0
    force_common: float = 0.0
    work_common: float = 0.0
    doubt: str = ""


class Place:
    """Surfaces that one or more measurements were made on.

    upper: a list of scans of the counter-surface, or None for the configured one. settings, values:
    with what was stated of these measurements, and the same by names. digests: of the scans, by
    which one is known again. voltage: on while the surfaces are drawn apart [V].
    """

    def __init__(
        self,
        scans: List[Any],
        upper: Optional[List[Any]],
        area: Optional[float],
        contacts: Optional[int],
        radius: Optional[float],
        settings: Settings,
        values: Dict[str, Any],
        digests: Sequence[str],
        voltage: float = 0.0,
    ) -> None:
        self.scans, self.upper, self.area, self.contacts = scans, upper, area, contacts
        self.radius, self.settings, self.values = radius, settings, values
        self.voltage = voltage
        self.digests = tuple(digests)
        self.realisations = int(values["device_force/realisations"])  # that are made for it
        self.stands_for_others = False
        self._known: Dict[Tuple[Tuple[str, float], ...], Figures] = {}
        self._clean_scans: Optional[List[Any]] = None
        self.is_frame = radius is None and (area is None or self._touched_all_of_its_scan(area))
        self._base = settings  # until settle()

    @property
    def is_made(self) -> bool:
        """Whether surfaces have to be made for it, or parts of scans to be drawn."""
        return self.radius is None and not self.is_frame

    @property
    def humidity(self) -> float:
        return float(self.values["interface/relative_humidity"])

    def stand_for_others(self) -> None:
        """The scan is not of the place that was measured: another place of the same surface was."""
        self.is_frame, self.stands_for_others = False, True

    def settle(self, is_shared: bool, made_places: int) -> None:
        """What depends on the other measurements, before figures are asked for.

        is_shared: others rest on one of the scans, too, so it is no scan of this place.
        made_places: how many places surfaces are made for.
        """
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", SettingsWarning)  # of what was not stated by the user
            self._base = Settings(self.settings, **self._own_sections(is_shared, made_places))

    def _own_sections(self, is_shared: bool, made_places: int) -> Dict[str, Any]:
        """Of the settings, what this place needs beside the constants."""
        if self.radius is not None:
            return dict(FRAME_ALONE, **NO_CLEANING)
        if self.is_frame:
            return FRAME_ALONE
        share = min(PLACES_WITH_ALL / max(made_places, 1), MOST_SHARE)
        fewest = min(self.realisations, FEWEST_REALISATIONS)
        self.realisations = max(math.ceil(self.realisations * share), fewest)
        device = {"seed": self._seed(), "realisations": self.realisations}
        if is_shared:
            device["own_long_waves"] = False
        if self._few_parts() and float(self.values["device_force/pitch"]) == 0.0:
            # once stated, it has surfaces made
            device["pitch"] = min(min(scan.pitch) for scan in self.scans)
        return {"device_force": device}

    def figures(self, constants: Dict[str, float]) -> Figures:
        return self.figures_of([constants])[0]

    def figures_of(self, constants: Sequence[Dict[str, float]]) -> List[Figures]:
        """Of each of several constants: made surfaces take little longer for all than for one."""
        keys = [tuple(sorted(one.items())) for one in constants]
        missing = {key: one for key, one in zip(keys, constants) if key not in self._known}
        if missing:
            with warnings.catch_warnings():
                if self._known:  # scans and area are the same each time
                    warnings.simplefilter("ignore", ScanWarning)
                warnings.simplefilter("ignore", SettingsWarning)
                found = self._find(list(missing.values()))
            self._known.update(zip(missing, found))
        return [self._known[key] for key in keys]

    def figures_near(self, constants: Dict[str, float]) -> Figures:
        """For what hardly goes with the constants: of made surfaces the nearest that are known."""
        near = [key for key in self._known if {name for name, _ in key} == set(constants)]
        if not self.is_made or not near:
            return self.figures(constants)
        return self._known[
            min(
                near,
                key=lambda key: sum(
                    abs(value - constants[name]) / (abs(value) + abs(constants[name]) or 1.0)
                    for name, value in key
                ),
            )
        ]

    def fingerprint(self) -> str:
        """SHA-256 of the heights [m] as they are predicted, one after the other."""
        digest = hashlib.sha256()
        for scan in self.scans:
            _add_heights(digest, scan)
        return digest.hexdigest()

    def _touched_all_of_its_scan(self, area: float) -> bool:
        stated = self.contacts or int(self.values["device/contacts"])
        if len(self.scans) != 1 or stated != 1 or not self._fits_its_counter_surface():
            return False
        shown = _areas_of(self._cleaned()[0])
        return any(abs(area / one - 1.0) < SAME_AREA for one in shown)

    def _fits_its_counter_surface(self) -> bool:
        if self.upper is None:
            return True
        scan = self.scans[0]
        return (
            len(self.upper) == 1
            and self.upper[0].heights.shape == scan.heights.shape
            and np.allclose(self.upper[0].pitch, scan.pitch)
        )

    def _few_parts(self) -> bool:
        assert self.area is not None  # as of all made places
        shown = sum(min(_areas_of(scan)) for scan in self._cleaned())
        return shown < PARTS_IN_SCANS * self.area

    def _seed(self) -> int:
        """Its own for each set of scans: the chance in realisations is no error of all places."""
        own = hashlib.sha256("".join(self.digests).encode()).hexdigest()
        return (int(self.values["device_force/seed"]) + int(own[:15], 16)) % SEEDS

    def figures_of_scan(self, constants: Dict[str, float]) -> Figures:
        """Of its first scan as a frame: roughly how made surfaces go with the constants."""
        if not self.is_made:
            return self.figures(constants)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            predictor = mems_stiction.Predictor(
                self.settings, **FRAME_ALONE, **self._stated(constants)
            )
            return _of_several([predictor.predict(self.scans[0])])

    def _find(self, constants: List[Dict[str, float]]) -> List[Figures]:
        stated = [self._stated(one) for one in constants]
        settings = [Settings(self._base, **one) for one in stated]
        if self.is_made:
            assert self.area is not None
            found = predict_device_under(self.scans, self.area, self.contacts, settings, self.upper)
            return [_of_device(one) for one in found]
        return [
            self._of_frame(one, dict(self.values, **values))
            for one, values in zip(settings, stated)
        ]

    def _stated(self, constants: Dict[str, float]) -> Dict[str, float]:
        return settings_of(constants, self.values, self.voltage)

    def _of_frame(self, settings: Settings, values: Dict[str, Any]) -> Figures:
        predictor = mems_stiction.Predictor(settings)
        if self.radius is None:
            upper = None if self.upper is None else self.upper[0]
            return _of_several([predictor.predict(scan, None, upper) for scan in self.scans])
        if not self.scans:
            heights, pitch = _probe_alone(self.radius, values)
            return _of_several([predictor.predict(heights, pitch)])
        return _of_several(
            [
                predictor.predict(scan, None, probe)
                for scan in self._cleaned()
                for probe in _probes_over(scan, self.radius)
            ]
        )

    def _cleaned(self) -> List[Any]:
        """The scans as predicted: cleaning would take a probe over them for their tilt and bow."""
        if self._clean_scans is None:
            self._clean_scans = [
                mems_stiction.clean(scan, None, self.settings) for scan in self.scans
            ]
        return self._clean_scans


def _areas_of(scan: Any) -> Tuple[float, float]:
    """Of the valid pixels of a cleaned scan, and of the rectangle around them [m^2]."""
    valid = np.isfinite(scan.heights)
    sides = [np.ptp(np.flatnonzero(valid.any(axis=axis))) + 1 for axis in (0, 1)]
    pixel = scan.pitch[0] * scan.pitch[1]
    return float(valid.sum() * pixel), float(sides[0] * sides[1] * pixel)


def digest_of(scan: Any) -> str:
    """SHA-256 of the heights [m] and the pitch [m] of one scan."""
    digest = hashlib.sha256()
    _add_heights(digest, scan)
    return digest.hexdigest()


def _add_heights(digest: Any, scan: Any) -> None:
    digest.update(np.ascontiguousarray(scan.heights, dtype=np.float64).tobytes())
    digest.update(np.array(scan.pitch, dtype=np.float64).tobytes())


def _logs(values: Any) -> np.ndarray:
    values = np.asarray(values, float)
    return np.log(values[values > 0])


def _of_device(found: Any) -> Figures:
    """The mean logarithm of the realisations, shifted as the device's figures are from their
    median.

    What the device's deviation has beyond the scatter of its realisations is common to all places;
    so is the error of a mean of few realisations. The deviation rests on the larger of two
    estimates of the scatter, that of the realisations and that by other scans: by chance alone
    this exceeds the scatter by excess_of_larger(), which is no error of the scans.
    """
    force, force_scatter, force_common = _sampled(
        found.pull_off_force, found.realisations.pull_off_force, found.force_deviation
    )
    work, work_scatter, work_common = _sampled(
        found.apparent_work_of_adhesion,
        found.realisations.apparent_work_of_adhesion,
        found._work_deviation,
    )
    return Figures(force, work, force_scatter, work_scatter, force_common, work_common)


def _sampled(figure: float, realisations: Any, deviation: float) -> Tuple[float, float, float]:
    """Geometric mean, scatter, and what is common, of a figure with this deviation of its ln."""
    logs = _logs(realisations)
    count = len(logs)
    if count < 2 or not figure > 0.0:
        return figure, 0.0, deviation
    mean = figure * math.exp(float(np.mean(logs) - np.median(logs)))
    scatter = float(np.std(logs, ddof=1))
    larger = 1.0 + excess_of_larger(count - 1)
    beyond = deviation**2 - (1.0 + 1.0 / count) * larger * scatter**2
    return mean, scatter, math.sqrt(max(beyond, 0.0) + scatter**2 / count)


def excess_of_larger(freedom: int) -> float:
    """By which share the larger of two independent estimates of one variance exceeds it in the
    mean [-].

    freedom: degrees of freedom of each. Half the mean difference of two gamma variables, which is
    their Gini coefficient (McDonald and Jensen, J. Am. Stat. Assoc. 74 (1979) 856).
    """
    logs = math.lgamma((freedom + 1) / 2.0) - math.lgamma(freedom / 2.0 + 1.0)
    return math.exp(logs) / math.sqrt(math.pi)


def _of_several(predictions: List[Any]) -> Figures:
    """The mean logarithm over places, how places differ, and how far so few tell the mean."""
    force, force_scatter, force_common = _of_places([one.pull_off_force for one in predictions])
    work, work_scatter, work_common = _of_places(
        [one.apparent_work_of_adhesion for one in predictions]
    )
    doubt = next((one.model_doubt for one in predictions if one.model_doubt), "")
    return Figures(force, work, force_scatter, work_scatter, force_common, work_common, doubt)


def _of_places(values: List[float]) -> Tuple[float, float, float]:
    if len(values) == 1:
        return float(values[0]), 0.0, 0.0
    logs = _logs(values)
    if len(logs) < len(values):  # some places do not hold, or are not known
        return float(np.median(values)), 0.0, 0.0
    scatter = float(np.std(logs, ddof=1))
    return math.exp(float(np.mean(logs))), scatter, scatter / math.sqrt(len(logs))


def _probe_alone(radius: float, stated: Dict[str, Any]) -> Tuple[np.ndarray, float]:
    """A smooth paraboloid that meets a plane: heights [m], pitch [m].

    stated: values of settings, by name.
    """
    compliance = sum(
        (1.0 - stated[body + "/poisson_ratio"] ** 2) / stated[body + "/youngs_modulus"]
        for body in ("lower", "upper")
    )
    work = stated["interface/work_of_adhesion"]
    contact_radius = (6.0 * math.pi * work * radius**2 * compliance) ** (1.0 / 3.0)
    half = max(math.sqrt(2.0 * radius * PROBE_DEPTH), PROBE_CONTACTS * contact_radius)
    half = min(half, radius)  # a paraboloid is no sphere beyond: softer bodies are doubted
    x = (np.arange(PROBE_PIXELS) + 0.5) / PROBE_PIXELS * 2.0 * half - half
    return -(x[:, None] ** 2 + x[None, :] ** 2) / (2.0 * radius), 2.0 * half / PROBE_PIXELS


def _probes_over(scan: Any, radius: float) -> List[np.ndarray]:
    """The probe, as it is mounted, over places of the scan: heights above its lowest point [m]."""
    rows, cols = scan.heights.shape
    places = (np.arange(PROBE_PLACES) + 1.0) / (PROBE_PLACES + 1.0)
    y = (np.arange(rows)[:, None] - places[None, :] * rows) * scan.pitch[1]
    x = (np.arange(cols)[:, None] - places[None, :] * cols) * scan.pitch[0]
    return [
        (y[:, [i]] ** 2 + x[:, j][None, :] ** 2) / (2.0 * radius)
        for i in range(PROBE_PLACES)
        for j in range(PROBE_PLACES)
    ]
