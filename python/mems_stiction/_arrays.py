"""Heights from whatever has them, and the core's memory as NumPy arrays: neither is copied where
the type allows."""

from __future__ import annotations

import inspect
import os
from typing import Any, NamedTuple, Optional, Sequence, Tuple, TypeVar, Union

import numpy as np

from mems_stiction import _core
from mems_stiction._settings import Settings, SurfaceError

# As SurfaceTopography writes them.
METRES = {
    "m": 1.0,
    "dm": 1e-1,
    "cm": 1e-2,
    "mm": 1e-3,
    "um": 1e-6,
    "µm": 1e-6,
    "μm": 1e-6,
    "nm": 1e-9,
    "A": 1e-10,
    "\u00c5": 1e-10,
    "\u212b": 1e-10,
    "pm": 1e-12,
}
AS_IT_IS = ("float32", "float64", "uint8", "uint16", "int16")

NO_PITCH = (
    "pitch: an array says nothing of it; must be a number > 0 m, or two of them (x, y), "
    "here or as scan/pitch_x and scan/pitch_y"
)

Pitch = Union[float, Sequence[float]]
Kind = TypeVar("Kind", bound=type)


class Surface(NamedTuple):
    """Heights as the core has them."""

    core: _core.HeightMap
    name: str  # of the file, or empty
    is_transposed: bool  # the caller's first index is x
    channel: str = ""
    notes: Tuple[str, ...] = ()  # what to know of how the file was read
    identity: _core.ScanIdentity = _core.ScanIdentity()  # of what it is, and who measured it
    is_periodic: bool = False  # the last column goes on in the first, the last row in the first row

    def back(self, array: np.ndarray) -> np.ndarray:
        """A map of the core in the index order of the heights that came in."""
        return array.T if self.is_transposed else array

    def map_of(self, memory: Any) -> Optional[np.ndarray]:
        """The same of the core's memory; None for None."""
        array = array_of(memory)
        return None if array is None else self.back(array)


def name_of(path: Union[str, "os.PathLike[str]"]) -> str:
    """A path as text, with what of it is no UTF-8 written out."""
    return os.fsencode(path).decode("utf-8", "backslashreplace")


def surface_of(
    heights: Any, pitch: Optional[Pitch], settings: Settings, what: str = "heights"
) -> Surface:
    """Heights, by whatever they are: a path, a Scan, a topography (heights(), physical_sizes,
    unit), an array.

    Raises SurfaceError with the cause; what: the name of the argument, for messages.
    """
    if isinstance(heights, Surface):
        return heights
    if isinstance(heights, (str, os.PathLike)):
        x, y = (0.0, 0.0) if pitch is None else pitch_of(pitch)
        core, channel, notes, identity = _core.read(
            os.fsencode(heights), settings._configuration, x, y, "", False
        )
        return Surface(core, name_of(heights), False, channel, tuple(notes), identity)
    own = getattr(heights, "_surface", None)
    if isinstance(own, Surface):
        if pitch is not None:
            raise SurfaceError(
                "pitch: %r is given, but the scan brings its own; leave it out" % (pitch,)
            )
        return own
    if callable(getattr(heights, "heights", None)):
        return _of_topography(heights, pitch, settings, what)
    if is_data_array(heights):
        return _of_data_array(heights, pitch, settings, what)
    unit = getattr(heights, "unit", getattr(heights, "units", None))
    if unit is not None:
        raise SurfaceError(
            "%s: values with a unit (%s) are not allowed, must be plain numbers in metres"
            % (what, unit)
        )
    x, y = (0.0, 0.0) if pitch is None else pitch_of(pitch)
    pixels = pixels_of(heights, what)
    if pitch is None and settings._configuration.pitch[0] <= 0:
        raise SurfaceError(NO_PITCH)
    return Surface(_core.height_map(pixels, x, y, settings._configuration), "", False)


def is_data_array(heights: Any) -> bool:
    """Whether it is one of xarray's, which is not imported for that."""
    return hasattr(heights, "dims") and hasattr(heights, "coords") and hasattr(heights, "values")


def _factor_of(unit: Any, what: str, whose: str) -> float:
    """Metres of a unit of length. Raises SurfaceError."""
    factor = METRES.get(unit) if isinstance(unit, str) else None
    if factor is None:
        raise SurfaceError(
            "%s: the unit '%s' of %s is not allowed, must be one of: %s"
            % (what, unit, whose, ", ".join(METRES))
        )
    return factor


def _factor_of_attributes(attributes: Any, what: str, whose: str) -> float:
    """The same of xarray's; numbers without a unit are in metres."""
    unit = attributes.get("units", attributes.get("unit"))
    return 1.0 if unit is None or unit == "" else _factor_of(unit, what, whose)


def _of_data_array(array: Any, pitch: Optional[Pitch], settings: Settings, what: str) -> Surface:
    """By xarray: heights over x and y in either order, each with its unit (attrs["units"])."""
    if set(array.dims) != {"x", "y"}:
        raise SurfaceError(
            "%s: dimensions (%s) are not allowed, must be y and x, in either order"
            % (what, ", ".join(map(str, array.dims)))
        )
    packed = [name for name in ("scale_factor", "add_offset") if name in array.attrs]
    if packed:
        raise SurfaceError(
            "%s: numbers with %s are not heights; open the file with decode_cf=True"
            % (what, " and ".join(packed))
        )
    factor = _factor_of_attributes(array.attrs, what, "the heights")
    placed = [name for name in ("x", "y") if name in array.coords]
    if placed and pitch is not None:
        raise SurfaceError(
            "pitch: %r is given, but the array brings its own (coordinates %s); leave it out"
            % (pitch, " and ".join(placed))
        )
    if len(placed) == 1:
        raise SurfaceError("%s: the array has coordinates of %s alone" % (what, placed[0]))
    pixels = pixels_of(np.asarray(array.transpose("y", "x").values), what)
    if factor != 1.0:
        pixels = pixels * factor
    if placed:
        x, y = (_pitch_along(array.coords[name], what, name) for name in placed)
    elif pitch is None and settings._configuration.pitch[0] <= 0:
        raise SurfaceError(NO_PITCH)
    else:
        x, y = (0.0, 0.0) if pitch is None else pitch_of(pitch)
    return Surface(
        _core.height_map(pixels, x, y, settings._configuration), "", tuple(array.dims) == ("x", "y")
    )


def _pitch_along(places: Any, what: str, axis: str) -> float:
    """Of evenly spaced coordinates [m]. Raises SurfaceError."""
    factor = _factor_of_attributes(places.attrs, what, axis)
    steps = np.diff(np.asarray(places.values, dtype=float)) * factor
    if not len(steps) or not np.allclose(steps, steps.mean(), rtol=1e-6, atol=0.0):
        raise SurfaceError(
            "%s: coordinates of %s: they are not even, so that pixels have no pitch" % (what, axis)
        )
    return float(abs(steps.mean()))


def _of_topography(
    topography: Any, pitch: Optional[Pitch], settings: Settings, what: str
) -> Surface:
    """x is the first index of a topography, and the columns of a height map."""
    sizes = getattr(topography, "physical_sizes", None)
    heights = np.ma.asanyarray(topography.heights())
    if heights.ndim != 2:
        raise SurfaceError(_shape_text(heights, what))
    if sizes is None and pitch is None:
        raise SurfaceError(
            "%s: the topography states no physical_sizes; give them there, or a pitch" % what
        )
    if sizes is not None and pitch is not None:
        raise SurfaceError(
            "pitch: %r is given, but the topography brings its own (physical_sizes); leave it out"
            % (pitch,)
        )
    unit = getattr(topography, "unit", None)
    if unit is None:
        raise SurfaceError(
            "%s: the topography states no unit; must be one of: %s" % (what, ", ".join(METRES))
        )
    factor = _factor_of(unit, what, "the topography")
    if sizes is not None and heights.size:
        pitches = _pitch_of_sizes(sizes, heights.shape, factor)
    else:
        pitches = pitch_of(1.0 if pitch is None else pitch)
    pixels = pixels_of(heights.T, what)
    if factor != 1.0:
        pixels = pixels * factor
    return Surface(
        _core.height_map(pixels, pitches[0], pitches[1], settings._configuration),
        "",
        True,
        is_periodic=getattr(topography, "is_periodic", False) is True,
    )


def _pitch_of_sizes(sizes: Any, shape: Sequence[int], factor: float) -> Tuple[float, float]:
    try:
        x, y = (float(size) / count * factor for size, count in zip(sizes, shape))
        if len(sizes) == 2:
            return pitch_of((x, y))
    except (TypeError, ValueError):  # SurfaceError is a ValueError
        pass
    raise SurfaceError(
        "physical_sizes: %r is not allowed, must be two numbers > 0 (along x, along y)" % (sizes,)
    )


def pitch_of(pitch: Pitch) -> Tuple[float, float]:
    """(along columns, along rows) [m]. Raises SurfaceError."""
    wrong = "pitch: %r is not allowed, must be a number > 0 m, or two of them (x, y)" % (pitch,)
    if isinstance(pitch, (str, bytes, bool)):
        raise SurfaceError(wrong)
    try:
        pair: Any = (pitch, pitch) if np.ndim(pitch) == 0 else pitch
        x, y = (float(value) for value in pair)
    except (TypeError, ValueError):
        raise SurfaceError(wrong) from None
    if not (0 < x < np.inf and 0 < y < np.inf):
        raise SurfaceError(wrong)
    return x, y


def _shape_text(array: np.ndarray, what: str) -> str:
    line = (
        "; one line says nothing of the contacts beside it: surface_of_profile() makes grooves or "
        "a random surface of it"
        if array.ndim == 1 or array.ndim == 2 and 1 in array.shape
        else ""
    )
    return "%s: an array of shape %s is not allowed, must have two dimensions, rows x columns%s" % (
        what,
        array.shape,
        line,
    )


def pixels_of(heights: Any, what: str = "heights") -> np.ndarray:
    """The array itself where the core can show it as it lies: float32 or float64 of this machine,
    columns next to each other, rows at any distance, writeable or not. Else a copy. Masked pixels
    are NaN: missing."""
    try:
        array = heights if isinstance(heights, np.ma.MaskedArray) else np.asarray(heights)
    except ValueError as error:  # rows of different lengths
        raise SurfaceError("%s: %s" % (what, error)) from None
    if array.dtype.kind == "O" and array.ndim == 0:
        raise SurfaceError(
            "%s: %s is not allowed, must be an array, a topography, a Scan or the path of a scan"
            % (what, type(heights).__name__)
        )
    if array.dtype.kind == "f" and array.dtype.itemsize == 2:  # of either byte order
        raise SurfaceError(
            "%s: an array of type float16 is not allowed, its steps are 60 nm where they are "
            "finest; must be float32 or float64" % what
        )
    if array.dtype.kind not in "fiu":
        raise SurfaceError(
            "%s: an array of type %s is not allowed, must be real numbers [m]" % (what, array.dtype)
        )
    if array.ndim == 2 and array.size == 0:
        raise SurfaceError("%s: an array of shape %s has no pixel" % (what, array.shape))
    if array.ndim != 2 or 1 in array.shape:
        raise SurfaceError(_shape_text(array, what))
    if isinstance(array, np.ma.MaskedArray):
        array = np.ma.filled(array if array.dtype.kind == "f" else array.astype(float), np.nan)
    if array.dtype.name not in AS_IT_IS or not array.dtype.isnative:
        array = array.astype(np.float64)
    rows, columns = array.shape
    is_in_rows = columns == 1 or array.strides[1] == array.itemsize
    is_ordered = rows == 1 or array.strides[0] >= columns * array.itemsize
    is_aligned = array.flags.aligned and array.strides[0] % array.itemsize == 0
    return array if is_in_rows and is_ordered and is_aligned else array.copy(order="C")


def array_of(memory: Any) -> Optional[np.ndarray]:
    """A view of the core's memory, read-only; None for None."""
    if memory is None:
        return None
    array = np.asarray(memory)
    array.flags.writeable = False
    return array


def records_of(records: _core.Records) -> np.recarray:
    """A view of a list of the core as an array with named fields, read-only."""
    names, formats, offsets = zip(*records.fields)
    layout = np.dtype(
        {
            "names": list(names),
            "formats": list(formats),
            "offsets": list(offsets),
            "itemsize": records.record_size,
        }
    )
    memory = np.asarray(records.bytes)
    memory.flags.writeable = False
    return memory.view(layout).view(np.recarray)


def copied(value: Any) -> Any:
    """An array with memory of its own; anything else as it is."""
    return np.array(value).view(type(value)) if isinstance(value, np.ndarray) else value


def plain_value(value: Any) -> Any:
    """As JSON has it: Python's own number, None for what is not finite."""
    value = value.item() if hasattr(value, "item") else value
    return None if isinstance(value, float) and not np.isfinite(value) else value


class ReadOnly:
    """A result: what was found stays as it was found."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AttributeError(
                "%s.%s: a result cannot be changed; predict with other settings, or take a copy of "
                "its figures" % (type(self).__name__, name)
            )
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        raise AttributeError("%s.%s: a result cannot be changed" % (type(self).__name__, name))

    def __setstate__(self, state: Any) -> None:
        """From another process, where the copies could be written to."""
        for value in state.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(state)


def explained(kind: Kind) -> Kind:
    """The class with the text of its first base behind its own: what the core declares of its
    figures."""
    kind.__doc__ = "%s\n\n%s" % (inspect.cleandoc(kind.__doc__ or ""), kind.__bases__[0].__doc__)
    return kind
