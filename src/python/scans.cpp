/// Heights in: from an array, from a file; and what can be asked of them before any contact.

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "evaluation/plausibility.hpp"
#include "figures.hpp"
#include "height_map/scan_sanity.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "mems_stiction/configuration/configuration.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/convergence.hpp"
#include "mems_stiction/evaluation/prepared_scan.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "preprocess/cleaning_warnings.hpp"
#include "roughness/filled_surface.hpp"
#include "roughness/framed_roughness.hpp"
#include "surface/counter_surface.hpp"
#include "without_lock.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

ScanFileOptions fileOptions(double pitch_x, double pitch_y, const std::string& channel,
                            bool ignore_mask) {
  ScanFileOptions options;
  options.pitch_x = pitch_x;
  options.pitch_y = pitch_y;
  options.pitch_option = "pitch";
  options.import.channel = channel;
  options.import.ignore_mask = ignore_mask;
  return options;
}

std::tuple<HeightMap, std::string, std::vector<std::string>, ScanIdentity> readScan(
    const py::bytes& path, const Configuration& configuration, double pitch_x, double pitch_y,
    const std::string& channel, bool ignore_mask) {
  ScanFile file;
  const ScanFileOptions options = fileOptions(pitch_x, pitch_y, channel, ignore_mask);
  const std::string name = path;
  {
    const WithoutLock unlocked;
    file = openScanFile(name, configuration.scan, options);
  }
  return {file.surface, file.channel, file.notes, file.identity};
}

py::list channelsOf(const py::bytes& path, const Configuration& configuration) {
  std::vector<ScanChannel> channels;
  const std::string name = path;
  {
    const WithoutLock unlocked;
    channels = listScanChannels(name, configuration.scan);
  }
  py::list list;
  for (const ScanChannel& channel : channels) {
    py::dict entry;
    entry["name"] = channel.name;
    entry["shape"] = py::make_tuple(channel.rows, channel.cols);
    entry["pitch"] = py::make_tuple(channel.pitch_x, channel.pitch_y);
    entry["unit_xy"] = channel.unit_xy;
    entry["unit_z"] = channel.unit_z;
    entry["is_chosen"] = channel.is_chosen;
    list.append(entry);
  }
  return list;
}

std::tuple<HeightMap, py::list, std::vector<std::string>> cleaned(
    const HeightMap& scan, const Configuration& configuration) {
  CleanedScan result;
  std::vector<std::string> warnings;
  {
    const WithoutLock unlocked;
    result = cleanScan(scan, configuration.preprocessing);
    warnings = cleaningWarnings(scan, result.surface, configuration.preprocessing);
  }
  return {result.surface, stepsOf(result.record), warnings};
}

/// The figures, and what is to be said about them.
std::pair<py::dict, std::vector<std::string>> roughnessOf(const HeightMap& scan,
                                                          const Configuration& configuration,
                                                          bool is_spatial, bool is_periodic) {
  ArealParameters areal;
  SpatialRoughness spatial;
  std::vector<std::string> warnings;
  {
    const WithoutLock unlocked;
    areal = arealParameters(scan);
    if (is_spatial) {
      spatial = spatialRoughness(scan, configuration.spatial_roughness,
                                 is_periodic ? FrameBoundary::kPeriodic : FrameBoundary::kOpen);
      const std::string filled = filledSentence(scan);
      if (!filled.empty()) warnings.push_back(filled);
    }
  }
  return {dictionaryOf([&](auto& fields) {
            visitRoughnessFields(areal, fields);
            visitSpatialRoughnessFields(spatial, fields);
          }),
          warnings};
}

/// A generated surface as a probe would see it, asperities up.
HeightMap generated(int rows, int cols, double pitch_x, double pitch_y,
                    const Configuration& configuration) {
  const CounterSurfaceOptions& options = configuration.counter_surface;
  if (!options.isGenerated()) {
    throw OptionsError({"counter_surface/type: only gaussian and self_affine are generated"});
  }
  const WithoutLock unlocked;
  const HeightMap grid(cv::Mat::zeros(rows, cols, CV_64FC1), pitch_x, pitch_y);
  return turnedOver(generatedCounterSurface(grid, options));
}

/// - @p counter_surface that was measured beside the scan; none: the configured one
PreparedScan prepared(const HeightMap& scan, const std::optional<HeightMap>& counter_surface,
                      const Configuration& configuration) {
  return interruptible([&](const std::atomic<bool>& /*cancel*/) {
    ScanPreparer preparer(configuration);
    if (counter_surface) preparer.setMeasuredCounterSurface(*counter_surface);
    return preparer.prepare(scan);
  });
}

py::dict identityFigures(const ScanIdentity& identity) {
  return dictionaryOf([&](auto& fields) { visitScanIdentityFields(identity, fields); });
}

ScanIdentity identityFromFigures(const py::dict& figures) {
  ScanIdentity identity;
  visitScanIdentityFields(identity, [&](const Figure& figure, auto& value) {
    value = figures[figure.name].cast<std::decay_t<decltype(value)>>();
  });
  return identity;
}

}  // namespace

void bindScans(py::module& module) {
  DeclaredFields declared;
  const ArealParameters areal;
  const SpatialRoughness spatial;
  visitRoughnessFields(areal, declared);
  visitSpatialRoughnessFields(spatial, declared);
  declared.addTo(module, "RoughnessFigures");

  DeclaredFields of_identity;
  const ScanIdentity identity;
  visitScanIdentityFields(identity, of_identity);
  of_identity.addTo(module, "ScanIdentityFigures");
  py::class_<ScanIdentity>(module, "ScanIdentity")
      .def(py::init<>())
      .def_property_readonly("figures", &identityFigures)
      .def(py::pickle(&identityFigures, &identityFromFigures));

  module.def(
      "height_map",
      [](const py::buffer& pixels, double pitch_x, double pitch_y,
         const Configuration& configuration) {
        return heightMapOf(pixels, configuration.scan, pitch_x, pitch_y);
      },
      "pixels"_a, "pitch_x"_a, "pitch_y"_a, "configuration"_a);
  py::class_<PreparedScan>(module, "PreparedScan")
      .def_property_readonly("warnings", &warningsOf)
      .def_property_readonly("lower",
                             [](const PreparedScan& prepared) { return prepared.surfaces.lower; })
      .def_property_readonly("upper", [](const PreparedScan& prepared) -> std::optional<HeightMap> {
        if (prepared.surfaces.upper.empty()) return std::nullopt;
        return prepared.surfaces.upper;
      });
  module.def("prepare", &prepared, "scan"_a, "counter_surface"_a, "configuration"_a);
  module.def("scan_warnings", &scanWarnings, "scan"_a, py::call_guard<WithoutLock>());
  module.def("read", &readScan, "path"_a, "configuration"_a, "pitch_x"_a, "pitch_y"_a, "channel"_a,
             "ignore_mask"_a);
  module.def("channels", &channelsOf, "path"_a, "configuration"_a);
  module.def("clean", &cleaned, "scan"_a, "configuration"_a);
  module.def("roughness", &roughnessOf, "scan"_a, "configuration"_a, "is_spatial"_a,
             "is_periodic"_a);
  module.def("generate", &generated, "rows"_a, "cols"_a, "pitch_x"_a, "pitch_y"_a,
             "configuration"_a);
  module.def(
      "decimate", [](const HeightMap& scan, int factor) { return decimated(scan, factor); },
      "scan"_a, "factor"_a);
}

}  // namespace python
}  // namespace mems_stiction
