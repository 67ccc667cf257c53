"""Predictions: one scan, or many over a pool of threads."""

from __future__ import annotations

import json
import os
import threading
from collections import deque
from collections.abc import Iterable as IterableOf
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Dict, Iterable, Iterator, List, Optional, Tuple, Union

import numpy as np

from mems_stiction import _core
from mems_stiction._arrays import (
    Pitch,
    ReadOnly,
    Surface,
    copied,
    explained,
    records_of,
    surface_of,
)
from mems_stiction._inputs import (
    boundary_of,
    brings_pitch,
    counter_of,
    section_or_surface,
    warn_about,
)
from mems_stiction._scans import Roughness
from mems_stiction._settings import Config, Error, OptionsError, Settings
from mems_stiction._types import Heights, Upper
from mems_stiction.other_packages import require_package
from mems_stiction.provenance import FIELDS
from mems_stiction.quantities import area, percent, ratio, with_interval, with_unit


@explained
class Verdict(_core.VerdictFigures, ReadOnly):
    """Does the device stick? Of a prediction whose settings state device/...; NaN where they do not
    allow to say."""

    def __init__(self, figures: Dict[str, Any]) -> None:
        self.__dict__.update(figures)

    @property
    def summary(self) -> str:
        """Word, margin and whose figures they are: "no, margin 2.5 (2 to 3), by the half-space"."""
        return "%s, margin %s, by the %s" % (
            self.sticks,
            with_interval(self.margin, self.margin_lower, self.margin_upper),
            self.verdict_by.replace("_", "-"),
        )

    def __repr__(self) -> str:
        return "Verdict: sticks: %s; %s" % (self.summary, self.reason)


@explained
class Prediction(_core.PredictionFigures, ReadOnly):
    """What comes out for one pair of surfaces. Forces and areas are of the scan; NaN: the
    formulation does not know it.
    Equation numbers are those of Deladi, Krijnen, Tas and Elwenspoek 2002; doc/theory.md has each
    as implemented.

    verdict: a Verdict, or None without a device. device_force: what its own force was found to be,
    by this scan alone, as a dictionary with the names of DeviceForce; None without a contact area,
    or with device_force/enabled false.
    half_space: the same of HalfSpace, where the scan was solved as one (half_space/enabled); the
    verdict's reason says which flags have asked for it, or why there is none.
    roughness: a Roughness, of the cleaned scan.
    preprocessing: what each step of the cleaning did. warnings: about pitch, heights and settings.
    """

    _LAZY = (
        "contact_map",
        "deformed_lower",
        "deformed_upper",
        "pressure",
        "heights",
        "upper_heights",
        "asperities",
        "energy_curve",
        "curve",
        "curve_over_height",
        "preprocessing",
        "roughness",
        "flags",
        "model_doubt",
    )

    def __init__(self, core: _core.PredictedScan, surface: Surface) -> None:
        self.__dict__.update(core.figures)
        verdict = core.verdict
        self.verdict: Optional[Verdict]
        self.device_force: Optional[Dict[str, Any]]
        self.half_space: Optional[Dict[str, Any]]
        self.warnings: Tuple[str, ...]
        self.name: str
        self.pitch: Tuple[float, float]
        self.__dict__.update(
            verdict=None if verdict is None else Verdict(verdict),
            device_force=core.device_force,
            half_space=core.half_space,
            warnings=tuple(core.warnings),
            name=surface.name,
            pitch=core.scan.pitch,
        )
        self._core: Optional[_core.PredictedScan] = core
        self._surface: Optional[Surface] = surface
        self._is_transposed = surface.is_transposed
        self._json: Optional[str] = None

    def _cached(self, name: str, make: Any) -> Any:
        """A view of the core's memory, made when it is first asked for."""
        key = "_" + name
        if key not in self.__dict__:
            self.__dict__[key] = make()
        return self.__dict__[key]

    def _map(self, name: str, memory: Any) -> Optional[np.ndarray]:
        return self._cached(
            name,
            lambda: self._surface.map_of(memory(self._core)),  # type: ignore[union-attr]
        )

    @property
    def contact_map(self) -> Optional[np.ndarray]:
        """0 apart, 1 elastic, 2 elasto-plastic, 3 plastic; in the index order of the heights, as
        all maps. None unless output/contact_map."""
        return self._map("contact_map", lambda core: core.contact_map)

    @property
    def heights(self) -> np.ndarray:
        """The scan after its cleaning [m]: the memory that came in, where nothing was cleaned."""
        heights = self._map("heights", lambda core: core.lower.pixels)
        assert heights is not None
        return heights

    @property
    def upper_heights(self) -> Optional[np.ndarray]:
        """The counter-surface in its place, in the scan's frame [m]; None for a plane."""
        return self._map("upper_heights", lambda core: core.upper.pixels)

    @property
    def deformed_lower(self) -> Optional[np.ndarray]:
        """The scan after contact [m]; None unless output/deformed_surfaces."""
        return self._map("deformed_lower", lambda core: core.deformed_lower)

    @property
    def deformed_upper(self) -> Optional[np.ndarray]:
        """The counter-surface after contact, in its own z [m]."""
        return self._map("deformed_upper", lambda core: core.deformed_upper)

    @property
    def pressure(self) -> Optional[np.ndarray]:
        """Between the surfaces at rest [Pa], repulsion positive; None if the formulation does not
        know it."""
        return self._map("pressure", lambda core: core.pressure)

    @property
    def asperities(self) -> np.recarray:
        """One record for each contact: x, y, z (column times pitch, row times pitch, height),
        cap_radius, composite_radius, contact_radius [m], load [N], area [m^2], tilt [rad],
        plasticity_index, tabor_parameter [-], is_at_border, regime (1 elastic, 2 elasto-plastic, 3
        plastic)."""
        return self._cached("asperities", lambda: records_of(self._core.asperities))  # type: ignore[union-attr]

    @property
    def energy_curve(self) -> np.recarray:
        """One record for each step of the approach: approach [m], contact_fraction, normal_load,
        carried_load, generalized_force [N], mechanical_energy, surface_energy, elastic_energy,
        total_energy [J]. Empty unless output/energy_curve."""
        return self._cached("energy_curve", lambda: records_of(self._core.energy_curve))  # type: ignore[union-attr]

    @property
    def curve(self) -> np.recarray:
        """Force over displacement: displacement [m] past first touch, force [N] (attraction
        positive), is_separation (of the way out, where that differs from the way in). Empty if the
        formulation does not follow the force."""
        return self._cached("curve", lambda: records_of(self._core.curve))  # type: ignore[union-attr]

    @property
    def curve_over_height(self) -> np.recarray:
        """The same over the height of HalfSpace.curve, to be laid over it: height [m], force [N],
        direction (0 approach, 1 retraction)."""
        return self._cached("curve_over_height", lambda: records_of(self._core.curve_over_height))  # type: ignore[union-attr]

    @property
    def preprocessing(self) -> List[Dict[str, Any]]:
        """step, parameters, rms_change [m], changed_pixels, invalid_pixels of each step that
        ran."""
        return self._cached("preprocessing", lambda: self._core.preprocessing)  # type: ignore[union-attr]

    @property
    def roughness(self) -> Roughness:
        """Of the cleaned scan; its spatial figures only with output/spatial_roughness."""
        return self._cached("roughness", lambda: Roughness(self._core.roughness))  # type: ignore[union-attr]

    @property
    def flags(self) -> Tuple[str, ...]:
        """The names of the bits of regime_flags, as in doc/validity.md."""
        return self._cached("flags", lambda: tuple(filter(None, self._core.flag_names.split(", "))))  # type: ignore[union-attr]

    @property
    def model_doubt(self) -> str:
        """Why the pull-off force may be out by more than 1.3 against the half-space (flag
        near_bonding); else empty."""
        return self._cached("model_doubt", lambda: self._core.model_doubt)  # type: ignore[union-attr]

    @property
    def version(self) -> str:
        """Of the package that predicted."""
        return self._origin()["version"]

    @property
    def settings_hash(self) -> str:
        """Of all settings: predictions with the same one were made alike."""
        return self._origin()["settings_hash"]

    def _origin(self) -> Dict[str, Any]:
        return self._cached("record", self.to_dict)

    def json(self) -> str:
        """The record that predict_scan --json prints, one line."""
        if self._json is None:
            assert self._core is not None
            return self._core.json(self.name)
        return self._json

    def to_dict(self) -> Dict[str, Any]:
        """The same as a dictionary: for tables and files. None stands for what is not finite."""
        return json.loads(self.json())

    def spread(self, config: Optional[Config] = None, **settings: Any) -> np.ndarray:
        """Pull-off forces over this one, of samples of the uncertain constants (uncertainty/...),
        in ascending order: what the margin's interval is made of. Settings are those of the
        prediction. Empty without a list of contacts."""
        if self._core is None:
            raise RuntimeError(
                "a prediction that came from another process has no contacts to draw from"
            )
        return np.array(self._core.spread(Settings(config, **settings)._configuration))

    def save_picture(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """PNG: heights, contacts by regime, cross-section through the contact that carries most."""
        require_package("matplotlib", "a picture")
        from mems_stiction import _pictures, plots

        plots.save_picture(_pictures.picture_of(self), os.fspath(path))

    def save_maps(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """HDF5 in the layout of NetCDF-4 (.h5, .hdf5, .nc), by h5py: the maps that output/... asked
        for, curve and contacts, with their units as attributes, and the record. h5py, xarray and
        MATLAB read it; groups: curve, curve_over_height, energy_curve, contacts."""
        from mems_stiction import map_file

        maps = [
            map_file.Map("heights", self.heights, "m", "height of the scan after its cleaning"),
            map_file.Map(
                "upper_heights",
                self.upper_heights,
                "m",
                "height of the counter-surface in its place",
            ),
        ]
        curves = {
            "curve": self.curve,
            "curve_over_height": self.curve_over_height,
            "energy_curve": self.energy_curve,
            "contacts": self.asperities,
        }
        origin = self._origin()
        map_file.save(
            path,
            maps + map_file.maps_after_contact(self),
            curves,
            self.pitch,
            self._is_transposed,
            {name: origin[name] for name in FIELDS if origin.get(name) not in (None, "")},
            self.json(),
        )

    def __getstate__(self) -> Dict[str, Any]:
        """With copies of all arrays: for another process."""
        self._json = self.json()
        state = dict(self.__dict__, _core=None, _surface=None)
        for name in self._LAZY:
            state["_" + name] = copied(getattr(self, name))
        return state

    def __repr__(self) -> str:
        lines = [
            "Prediction%s: %s"
            % (" of " + self.name if self.name else "", self.status.lower().replace("_", " "))
        ]
        lines.append(
            "  pull-off force %s on %s; contact %s of it"
            % (
                with_unit(self.pull_off_force, "N"),
                area(self.nominal_area),
                percent(self.contact_fraction),
            )
        )
        lines.append(
            "  contacts: %d (%d elastic, %d elasto-plastic, %d plastic); rms height %s; flattening "
            "ratio %s"
            % (
                self.asperity_count,
                self.elastic_count,
                self.elasto_plastic_count,
                self.plastic_count,
                with_unit(self.rms_height, "m"),
                ratio(self.flattening_ratio),
            )
        )
        if self.verdict is not None:
            lines.append("  sticks: %s" % self.verdict.summary)
        if self.flags:
            lines.append("  outside the model's range: %s" % ", ".join(self.flags))
        if self.model_doubt:
            lines.append("  may be out by more than 1.3: %s" % self.model_doubt)
        lines += ["  warning: " + text for text in self.warnings]
        return "\n".join(lines)

    def _repr_html_(self) -> Optional[str]:
        try:
            from mems_stiction import _pictures
        except ImportError:  # without Matplotlib a notebook shows the text
            return None
        return _pictures.prediction_html(self)


class Predictor:
    """Settings that are read and checked once, for scan after scan; the core keeps its memory
    between them.

    Any thread may call it; one scan is predicted at a time. predict_many() has one for each thread.
    """

    def __init__(self, config: Optional[Config] = None, **settings: Any) -> None:
        self.settings = Settings(config, **settings)
        self._core = _core.Predictor(self.settings._configuration)

    def predict(
        self, heights: Heights, pitch: Optional[Pitch] = None, upper: Optional[Upper] = None
    ) -> Prediction:
        """As the function predict()."""
        surface = surface_of(heights, pitch, self.settings)
        settings = boundary_of(surface, self.settings)
        core = self._core if settings is self.settings else _core.Predictor(settings._configuration)
        predicted = core.predict(
            surface.core, counter_of(upper, surface, settings), surface.notes, surface.identity
        )
        warn_about(surface, predicted.scan_warnings)
        return Prediction(predicted, surface)

    def __reduce__(self) -> Any:
        return Predictor, (self.settings,)


def predict(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    upper: Optional[Upper] = None,
    **settings: Any,
) -> Prediction:
    """Will this surface stick to its counter-surface?

    heights: rows x columns in metres, NaN or masked where nothing was measured; or an object with
    heights(), physical_sizes and unit (a Topography of SurfaceTopography, whose first index is x:
    maps come back in its order); or a
    Scan; or the path of a file. Arrays of float32 and float64 are not copied, also read-only ones
    and parts of rows.
    pitch: distance of neighbouring pixels [m], a number or (x, y). Left out where the object brings
    it, or scan/pitch_x.
    config: a dictionary, the path of a YAML file, or Settings: materials, interface, loads,
    cleaning (doc/parameters.md).
    upper: the counter-surface as it was measured beside the scan, on the same grid and in its index
    order; counter_surface/facing must say which way it faces, "up" as measured or "down" as
    mounted. None: the configured one, a plane unless counter_surface/type says otherwise.
    settings: sections that go before config: load={"mechanical_load": 1e-6}. A dictionary as
    `upper` is the section of that name. half_space: "auto", True and False are half_space/enabled
    flagged, true and false. Where the settings state a device, "auto" holds: scans whose flags say
    that the model's force may be far out take seconds to minutes, and the half-space judges them.

    Bits are those of predict_scan with the same settings. Raises SurfaceError for heights,
    OptionsError for settings, each in a sentence with what is allowed; warns (ScanWarning,
    SettingsWarning) of what looks like a wrong unit.
    The interpreter's lock is released meanwhile.
    """
    upper = section_or_surface(upper, settings)
    return Predictor(config, **settings).predict(heights, pitch, upper)


def predict_under(
    heights: Heights,
    pitch: Optional[Pitch] = None,
    configs: Iterable[Config] = (),
    upper: Optional[Upper] = None,
    **settings: Any,
) -> Iterator[Prediction]:
    """Predicts one pair of surfaces under settings after settings, and yields the predictions in
    their order: the bits of predict(), in less time, since the surfaces are prepared and their gap
    is computed once.

    configs: of each prediction; a list or a generator. They may differ in materials, interface,
    loads, approach, output, device and uncertainty; what bears on the scan and its counter-surface
    must be the same. Those of one approach/formulation are best kept together: the solver's memory
    goes when it changes.
    Other arguments are those of predict(). settings go before each of configs.
    """
    upper = section_or_surface(upper, settings)
    if isinstance(configs, (Mapping, Settings, str, os.PathLike)) or not isinstance(
        configs, IterableOf
    ):
        raise OptionsError(
            "configs: one %s is not allowed, must be a list or a generator of settings"
            % type(configs).__name__
        )
    return _predictions_under(
        heights, pitch, (Settings(config, **settings) for config in configs), upper
    )


def _predictions_under(
    heights: Heights, pitch: Optional[Pitch], configs: Iterator[Settings], upper: Any
) -> Iterator[Prediction]:
    scan: Optional[_core.OneScan] = None
    for settings in configs:
        if scan is None:
            surface = surface_of(heights, pitch, settings)
            settings = boundary_of(surface, settings)
            scan = _core.OneScan(
                surface.core,
                counter_of(upper, surface, settings),
                settings._configuration,
                surface.notes,
                surface.identity,
            )
            warn_about(surface, scan.scan_warnings)
        yield Prediction(scan.predict(boundary_of(surface, settings)._configuration), surface)


def predict_many(
    frames: Iterable[Heights],
    pitch: Optional[Pitch] = None,
    config: Optional[Config] = None,
    *,
    workers: Optional[int] = None,
    errors: str = "raise",
    **settings: Any,
) -> Iterator[Any]:
    """Predicts frame after frame on a pool of threads, and yields the predictions in the order of
    the frames.

    frames: whatever predict() takes, from a list or a generator; only some frames for each thread
    are in memory at a time.
    pitch: of all frames that are arrays [m].
    workers: threads; as many as processors if None.
    errors: "raise" ends at the first frame that cannot be predicted; "return" yields its exception
    in its place.
    Ctrl-C ends it after the frames that are being predicted.
    """
    if errors not in ("raise", "return"):
        raise ValueError("errors: %r is not allowed, must be 'raise' or 'return'" % (errors,))
    count = os.cpu_count() or 1 if workers is None else workers
    if not isinstance(count, int) or count < 1:
        raise ValueError("workers: %r is not allowed, must be an integer >= 1" % (workers,))
    if brings_pitch(frames) or not isinstance(frames, IterableOf):
        raise ValueError(
            "frames: one %s is not allowed, must be a list or a generator of frames"
            % type(frames).__name__
        )
    if isinstance(frames, np.ndarray) and frames.ndim != 3:
        raise ValueError(
            "frames: an array of shape %s is not allowed, must be frames x rows x columns, or a "
            "list" % (frames.shape,)
        )
    upper = settings.get("upper")
    if upper is not None and not isinstance(upper, Mapping):
        raise ValueError("upper: a counter-surface for many frames is set by counter_surface/file")
    return _predictions(
        iter(frames), pitch, Settings(config, **settings), count, errors == "return"
    )


def _predictions(
    frames: Iterator[Any],
    pitch: Optional[Pitch],
    settings: Settings,
    count: int,
    returns_errors: bool,
) -> Iterator[Any]:
    own = threading.local()

    def predict_one(frame: Any) -> Any:
        try:
            if not hasattr(own, "predictor"):
                own.predictor = Predictor(settings)
            return own.predictor.predict(frame, None if brings_pitch(frame) else pitch)
        except Error as error:
            if returns_errors:
                return error
            raise

    if count == 1:
        yield from map(predict_one, frames)
        return
    pool = ThreadPoolExecutor(count)
    waiting: Any = deque()
    try:
        for frame in frames:
            if isinstance(frame, np.ndarray) and frame.flags.writeable:
                frame = frame.copy()  # who yields one buffer again and again fills it meanwhile
            waiting.append(pool.submit(predict_one, frame))
            if len(waiting) >= 4 * count:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:
        for future in waiting:
            future.cancel()
        pool.shutdown()
