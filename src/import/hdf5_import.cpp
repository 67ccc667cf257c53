#include <utility>

#include "import/format_readers.hpp"
#include "import/python_reader.hpp"

namespace mems_stiction {
namespace {

/// As channelsByPython() wants it. Where it reads no channel, it says which arrays of two
/// dimensions there are, a line for each.
constexpr const char* kHdf5Script = R"(
import sys
sys.path = [folder for folder in sys.path if folder]
try:
    import h5py
    import numpy
except ImportError:
    sys.exit(3)
LENGTHS = {"AA": 1e-10, "Ang": 1e-10, "m": 1.0, "mm": 1e-3, "um": 1e-6, "\u00b5m": 1e-6, "\u03bcm": 1e-6, "nm": 1e-9, "pm": 1e-12, "A": 1e-10, "\u00c5": 1e-10}
HEIGHTS = {unit: length for unit, length in LENGTHS.items() if unit != "A"}  # of values that is the ampere
PACKED = ("scale_factor", "add_offset")  # attributes of CF: of them and the numbers the heights are made

def text(value):
    value = value.item() if hasattr(value, "item") else value
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)

def number(value):
    return float(numpy.asarray(value).reshape(-1)[0])

def jpk(file):
    for measurement in sorted(name for name in file if name.startswith("Measurement_")):
        grid = file[measurement].attrs
        if "position-pattern.grid.ilength" not in grid:
            continue
        columns = int(number(grid["position-pattern.grid.ilength"]))
        rows = int(number(grid.get("position-pattern.grid.jlength", columns)))
        width = number(grid["position-pattern.grid.ulength"])
        height = number(grid.get("position-pattern.grid.vlength", width * rows / columns))
        for name in sorted(name for name in file[measurement] if name.startswith("Channel_")):
            group = file[measurement][name]
            arrays = [item for item in group.values() if isinstance(item, h5py.Dataset) and item.ndim in (1, 2)]
            arrays = [item for item in arrays if item.shape[0] == rows * columns]
            if "channel.name" not in group.attrs or len(arrays) != 1:
                continue
            title = text(group.attrs["channel.name"]).strip()
            frames = arrays[0].shape[1] if arrays[0].ndim == 2 else 1
            values = numpy.asarray(arrays[0][:, 0] if arrays[0].ndim == 2 else arrays[0][:], dtype=float)
            values = values * number(group.attrs.get("net-encoder.scaling.multiplier", 1.0))
            values = values + number(group.attrs.get("net-encoder.scaling.offset", 0.0))
            unit = "m" if "height" in title.lower() else text(group.attrs.get("net-encoder.scaling.unit.unit", "V"))
            way = "retrace" if text(group.attrs.get("retrace", False)).strip().lower() in ("true", "1") else "trace"
            note = "the first of %d frames" % frames if frames > 1 else ""
            yield title + " " + way, numpy.flipud(values.reshape(rows, columns)), width, height, unit, note

def topostats(file):
    if "pixel_to_nm_scaling" not in file:
        return
    pitch = 1e-9 * number(file["pixel_to_nm_scaling"][()])
    for name, title in (("image", "Height"), ("image_original", "Image as TopoStats found it")):
        if name in file and isinstance(file[name], h5py.Dataset) and file[name].ndim == 2:
            values = 1e-9 * numpy.asarray(file[name], dtype=float)
            yield title, values, pitch * values.shape[1], pitch * values.shape[0], "m", ""

def surface_topography(file):
    if "heights" not in file or file["heights"].ndim != 2:
        return
    values = numpy.array(file["heights"], dtype=float)
    if "mask" in file:
        values[numpy.asarray(file["mask"]) != 0] = numpy.nan
    sides, unit = [], text(file["heights"].attrs.get("unit", ""))
    for axis in ("x", "y"):
        attributes = file[axis].attrs if axis in file else {}
        unit = unit or text(attributes.get("unit", ""))
        scale = LENGTHS.get(text(attributes.get("unit", "")), 0.0)
        sides.append(scale * number(attributes["length"]) if "length" in attributes else 0.0)
    if unit in HEIGHTS:
        values, unit = values * HEIGHTS[unit], "m"
    yield "heights", values.T, sides[0], sides[1], unit, ""

def coordinates(file):
    """Maps of NetCDF-4 over evenly spaced x and y, in either order, with units of length, by the conventions of CF: what save_maps()
    of ours writes, and packed integers."""
    for name in sorted(name for name in file if isinstance(file.get(name), h5py.Dataset) and file[name].ndim == 2):
        data = file[name]
        scales = [dict(dimension.items()) for dimension in data.dims]
        order = ("x", "y") if len(scales) == 2 and "x" in scales[0] and "y" in scales[1] else ("y", "x")
        axes = [scale[axis] for scale, axis in zip(scales, order) if axis in scale]
        factors = [LENGTHS.get(text(axis.attrs.get("units", "")), 0.0) for axis in axes]
        is_packed = any(name in data.attrs for name in PACKED)
        if len(axes) != 2 or min(factors) == 0.0 or min(data.shape) < 2 or data.dtype.kind not in ("fiu" if is_packed else "f"):
            continue
        if any(axis.shape != (count,) for axis, count in zip(axes, data.shape)):
            continue
        sides = []
        for axis, factor, count in zip(axes, factors, data.shape):
            steps = numpy.diff(numpy.asarray(axis, dtype=float)) * factor
            sides.append(abs(steps.mean()) * count if numpy.allclose(steps, steps.mean(), rtol=1e-6, atol=0.0) else 0.0)
        values, unit = numpy.asarray(data, dtype=float), text(data.attrs.get("units", ""))
        values = numpy.flip(values, [place for place, axis in enumerate(axes) if axis[-1] < axis[0]])
        for fill in ("_FillValue", "missing_value"):
            if fill in data.attrs:
                values = numpy.where(values == numpy.ravel(data.attrs[fill])[0], numpy.nan, values)
        values = values * number(data.attrs.get("scale_factor", 1.0)) + number(data.attrs.get("add_offset", 0.0))
        if unit in HEIGHTS:
            values, unit = values * HEIGHTS[unit], "m"
        if order == ("x", "y"):
            values, sides = values.T, sides[::-1]
        yield name, values, sides[1], sides[0], unit, ""

def outside(file):
    """What of the file stands in another one, in words; None if nothing does. Links and storage that lead outside would bring
    any file's bytes into a map."""
    def look(item):
        if isinstance(item, h5py.Group):
            for name in item.id:
                if item.id.links.get_info(name).type not in (h5py.h5l.TYPE_HARD, h5py.h5l.TYPE_SOFT):
                    return "the link '%s' leads to another file: copy what stands there into this one" % text(name)
        if isinstance(item, h5py.Dataset):
            layout = item.id.get_create_plist()
            if layout.get_external_count() > 0 or layout.get_layout() == h5py.h5d.VIRTUAL:
                return "the numbers of '%s' stand in other files: copy them into this one" % item.name
        return None
    return look(file) or file.visititems(lambda name, item: look(item))

def refuse(reason):
    with open(sys.argv[2] + "/remark", "w", encoding="utf-8") as stream:
        stream.write(" ".join(reason.split()) + "\n")
    sys.exit(5)

def gxsm(file):
    """GXSM's NetCDF-4: FloatField, or a field of another type, over (time, value, y, x) counts in units of dz. Its lengths are
    in "var_unit", which is angstrom where another is only shown; dx reaches from pixel to pixel, rangex from the first to the last."""
    data = next((file[name] for name in ("FloatField", "DoubleField", "H", "Intensity", "ByteField") if name in file), None)
    if not isinstance(data, h5py.Dataset) or data.ndim != 4 or "dx" not in file or "dz" not in file:
        return
    def length(name):
        unit = text(file[name].attrs.get("var_unit", "AA"))
        if unit not in LENGTHS:
            refuse("%s is in '%s', which is no length" % (name, unit))
        return abs(number(file[name])) * LENGTHS[unit]
    sides = []
    for axis, count in zip("yx", data.shape[2:]):
        pitch = length("d" + axis)
        if "range" + axis in file and abs(length("range" + axis) - pitch * (count - 1)) > 0.01 * length("range" + axis):
            refuse("d%s, %g m, contradicts range%s, %g m of %d pixels" % (axis, pitch, axis, length("range" + axis), count))
        sides.append(pitch * count)
    unit = text(data.attrs.get("var_unit", data.attrs.get("unit", "")))
    title = text(data.attrs.get("label", data.attrs.get("long_name", data.name.strip("/"))))
    frames = [(time, layer) for time in range(data.shape[0]) for layer in range(data.shape[1])]
    for time, layer in frames:
        values = numpy.asarray(data[time, layer], dtype=float) * number(file["dz"]) * HEIGHTS.get(unit, 1.0)
        name = title if len(frames) == 1 else "%s, time %d, layer %d" % (title, time, layer)
        yield name, values, sides[1], sides[0], "m" if unit in HEIGHTS else unit, ""

def is_map(item):
    return isinstance(item, h5py.Dataset) and item.ndim == 2 and item.dtype.kind in "fiu" and min(item.shape) > 1

def main(path, folder):
    try:
        file = h5py.File(path, "r")
    except OSError:
        sys.exit(4)
    found = outside(file)
    if found:
        refuse(found)
    lines = []
    for layout in (coordinates, gxsm, jpk, topostats, surface_topography):
        if lines:
            break
        for title, values, width, height, unit, note in layout(file):
            numpy.save("%s/%d.npy" % (folder, len(lines)), numpy.ascontiguousarray(values, dtype="<f8"))
            words = [title.replace("\t", " ").replace("\n", " "), repr(width), repr(height), unit, note]
            lines.append("\t".join(words) + "\n")
    if not lines:
        arrays = []
        file.visititems(lambda name, item: arrays.append(name) if is_map(item) else None)
        with open(folder + "/remark", "w", encoding="utf-8") as stream:
            for name in arrays[:8]:
                stream.write("'%s' (%d x %d)\n" % (" ".join(name.split()), *file[name].shape[::-1]))
            stream.write("and %d more\n" % (len(arrays) - 8) if len(arrays) > 8 else "")
        sys.exit(4)
    with open(folder + "/channels", "w", encoding="utf-8") as stream:
        stream.writelines(lines)

main(sys.argv[1], sys.argv[2])
)";

}  // namespace

Hdf5Channels channelsByH5py(const std::string& path, double timeout) {
  PythonReading read = channelsByPython(kHdf5Script, "h5py", path, timeout);
  return {std::move(read.channels), read.is_library_missing, std::move(read.remark)};
}

}  // namespace mems_stiction
