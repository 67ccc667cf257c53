"""Maps and curves of a result as HDF5, in the layout of NetCDF-4: read by h5py, xarray, netCDF4,
MATLAB, Panoply."""

from __future__ import annotations

import os
import pathlib
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from mems_stiction._settings import Error
from mems_stiction.other_packages import require_package
from mems_stiction.whole_file import whole

ENDINGS = (".h5", ".hdf5", ".nc")
REGIMES = {
    "flag_values": np.array([0, 1, 2, 3], np.uint8),
    "flag_meanings": "apart elastic elasto_plastic plastic",
}
DIRECTIONS = {"flag_values": np.array([0, 1], np.uint8), "flag_meanings": "approach retraction"}
YES = {"flag_values": np.array([0, 1], np.uint8), "flag_meanings": "no yes"}
COLUMNS = {  # of curves and contacts, with their units
    "displacement": "m",
    "height": "m",
    "force": "N",
    "direction": "1",
    "is_separation": "1",
    "approach": "m",
    "contact_fraction": "1",
    "normal_load": "N",
    "carried_load": "N",
    "generalized_force": "N",
    "mechanical_energy": "J",
    "surface_energy": "J",
    "elastic_energy": "J",
    "total_energy": "J",
    "x": "m",
    "y": "m",
    "z": "m",
    "cap_radius": "m",
    "composite_radius": "m",
    "contact_radius": "m",
    "load": "N",
    "tilt": "rad",
    "plasticity_index": "1",
    "tabor_parameter": "1",
    "area": "m^2",
    "is_at_border": "1",
    "regime": "1",
}
FLAGS = {"direction": DIRECTIONS, "is_separation": YES, "is_at_border": YES, "regime": REGIMES}

Attributes = Dict[str, Any]


class Map(NamedTuple):
    """One array over the scan, in the index order that came in; None is left out."""

    name: str
    pixels: Optional[np.ndarray]
    unit: str
    meaning: str
    attributes: Attributes = {}


def maps_after_contact(result: Any) -> List[Map]:
    """What a prediction and a half-space have in common."""
    return [
        Map("deformed_lower", result.deformed_lower, "m", "height of the scan after contact"),
        Map(
            "deformed_upper",
            result.deformed_upper,
            "m",
            "height of the counter-surface after contact, in its own z",
        ),
        Map("contact_map", result.contact_map, "1", "contacts at rest by regime", REGIMES),
        Map("pressure", result.pressure, "Pa", "between the surfaces at rest, repulsion positive"),
    ]


def save(
    path: Union[str, "os.PathLike[str]"],
    maps: Sequence[Map],
    curves: Dict[str, np.recarray],
    pitch: Tuple[float, float],
    is_transposed: bool,
    attributes: Attributes,
    record: str = "",
) -> None:
    """Writes the file, whole or not at all.

    maps: of one size. curves: by the name of their group, a record for each point with names of
    COLUMNS. record: all figures as JSON.
    attributes: of the whole file.
    Raises Error without h5py and for another ending, OSError.
    """
    path = pathlib.Path(os.fspath(path))
    if path.suffix not in ENDINGS:
        raise Error(
            "path: '%s' is not allowed, must end in %s or %s"
            % (path, ", ".join(ENDINGS[:-1]), ENDINGS[-1])
        )
    require_package("h5py", "path: HDF5")
    import h5py

    # In memory: HDF5 goes on over a disk that is full, and then has much to say of it.
    with h5py.File(path.name, "w", driver="core", backing_store=False) as file:
        file.attrs["Conventions"] = "CF-1.8"
        for name, value in attributes.items():
            file.attrs[name] = value
        if record:  # may be longer than an attribute
            file.create_dataset("record", data=record, dtype=h5py.string_dtype()).attrs[
                "long_name"
            ] = "all figures as JSON, SI units"
        _write_maps(file, [item for item in maps if item.pixels is not None], pitch, is_transposed)
        for name, records in curves.items():
            if len(records):
                _write_records(file.create_group(name), records)
        file.flush()
        image = file.id.get_file_image()
    with whole(path) as part:
        part.write_bytes(image)


def _dimension(group: Any, name: str, values: np.ndarray, unit: str, meaning: str) -> Any:
    scale = group.create_dataset(name, data=values)
    scale.attrs["units"] = unit
    scale.attrs["long_name"] = meaning
    scale.make_scale(name)
    return scale


def _write_maps(
    file: Any, maps: Sequence[Map], pitch: Tuple[float, float], is_transposed: bool
) -> None:
    if not maps:
        return
    assert maps[0].pixels is not None
    shape = maps[0].pixels.shape
    names = ("x", "y") if is_transposed else ("y", "x")
    scales = []
    for name, count in zip(names, shape):
        along = "columns" if name == "x" else "rows"
        scales.append(
            _dimension(
                file,
                name,
                np.arange(count) * pitch[name == "y"],
                "m",
                "place of the pixel, along the %s" % along,
            )
        )
    for item in maps:
        data = file.create_dataset(
            item.name,
            data=np.asarray(item.pixels),
            compression="gzip",
            compression_opts=4,
            shuffle=True,
        )
        data.attrs["units"] = item.unit
        data.attrs["long_name"] = item.meaning
        for name, value in item.attributes.items():
            data.attrs[name] = value
        for axis, scale in enumerate(scales):
            data.dims[axis].attach_scale(scale)


def _write_records(group: Any, records: np.recarray) -> None:
    scale = _dimension(group, "point", np.arange(len(records)), "1", "number of the point")
    for name in records.dtype.names or ():
        column = np.ascontiguousarray(records[name])
        data = group.create_dataset(
            name, data=column.astype(np.uint8) if column.dtype == bool else column
        )
        data.attrs["units"] = COLUMNS[name]
        for attribute, value in FLAGS.get(name, {}).items():
            data.attrs[attribute] = value
        data.dims[0].attach_scale(scale)
