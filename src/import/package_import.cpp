#include "import/format_readers.hpp"
#include "import/python_reader.hpp"

namespace mems_stiction {
namespace {

/// As channelsByPython() wants it. SurfaceTopography recognises some formats by nothing but that
/// the file can be read so: those are left out, and so are those that are read here.
constexpr const char* kPackageScript = R"(
import sys
sys.path = [folder for folder in sys.path if folder]
path, folder = sys.argv[1:]
try:
    import numpy
except ImportError:
    sys.exit(3)
LENGTHS = {"km": 1e3, "m": 1.0, "dm": 1e-1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "\u00b5m": 1e-6, "\u03bcm": 1e-6, "nm": 1e-9, "pm": 1e-12,
           "\u00c5": 1e-10}
NOT_RECOGNISED = ("asc", "xyz", "matrix", "npy", "npz", "mat", "nms", "hgt", "h5", "nc")

def by(package):
    try:
        from importlib.metadata import version
        return "read by %s %s" % (package, version(package))
    except Exception:
        return "read by " + package

def surface_topography():
    from SurfaceTopography import open_topography
    reader = open_topography(path)
    if reader.format() in NOT_RECOGNISED:
        return
    for channel in reader.channels:
        if channel.dim != 2:
            continue
        topography = channel.topography()
        factor = LENGTHS.get(topography.unit) if isinstance(topography.unit, str) else None
        heights = numpy.ma.filled(numpy.ma.asanyarray(topography.heights()).astype(float), numpy.nan).T
        sides = [float(size) * (factor or 0.0) for size in topography.physical_sizes]
        yield str(channel.name or ""), heights * (factor or 1.0), sides, "m" if factor else str(topography.unit), by("SurfaceTopography")

def afm_reader():
    if not path.lower().endswith(".asd"):
        return
    from AFMReader.asd import load_asd
    frames, _, header = load_asd(path, "TP")
    frames = numpy.asarray(frames, dtype=float)
    note = by("AFMReader") + (", the first of %d frames" % len(frames) if len(frames) > 1 else "")
    yield "TP Topography", 1e-9 * frames[0], [1e-9 * float(header["x_nm"]), 1e-9 * float(header["y_nm"])], "m", note

has_library, lines, remarks = False, [], []
for package, reader in (("SurfaceTopography", surface_topography), ("AFMReader", afm_reader)):
    try:
        channels = list(reader())
        has_library = True
    except ImportError:
        continue
    except Exception as error:
        has_library = True
        if path.lower().endswith(".asd") == (package == "AFMReader"):
            remarks.append("%s: %s" % (package, " ".join(str(error).split())[:100]))
        continue
    for title, values, sides, unit, note in channels:
        numpy.save("%s/%d.npy" % (folder, len(lines)), numpy.ascontiguousarray(values, dtype="<f8"))
        lines.append("\t".join([" ".join(title.split()), repr(sides[0]), repr(sides[1]), unit, note]) + "\n")
    if lines:
        break
if not lines:
    with open(folder + "/remark", "w", encoding="utf-8") as stream:
        stream.writelines(remark + "\n" for remark in remarks)
    sys.exit(4 if has_library else 3)
with open(folder + "/channels", "w", encoding="utf-8") as stream:
    stream.writelines(lines)
)";

}  // namespace

std::vector<FileChannel> channelsByPackages(const std::string& path, double timeout) {
  return channelsByPython(kPackageScript, "SurfaceTopography or AFMReader", path, timeout).channels;
}

}  // namespace mems_stiction
