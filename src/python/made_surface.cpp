/// One made surface of a device, as a whole, as heights and in strips.

#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "device/device_force_lists.hpp"
#include "device/surface_strips.hpp"
#include "device_scan.hpp"
#include "interruptible.hpp"
#include "memory.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

/// What has been found on a surface.
struct Found {
  std::vector<Realisation> realisations;  ///< one
  std::vector<std::string> warnings;
};

/// For several threads of Python, one after another.
class SharedSurface {
  /// Without the interpreter's lock, one at a time; Ctrl-C ends it.
  template <typename Work>
  auto alone(const Work& work) {
    return interruptible([&](const std::atomic<bool>& cancel) {
      const Cancellation check(cancel);
      const BesideWork beside([&] { check(0.0); });
      const std::lock_guard<std::mutex> lock(mutex_);
      return work();
    });
  }

 public:
  SharedSurface(DividedSurface&& surface, std::vector<std::string> warnings)
      : surface_(std::move(surface)), warnings_(std::move(warnings)) {}

  const std::vector<std::string>& warnings() const { return warnings_; }
  std::int64_t rows() { return surface_.surface().rows(); }
  std::int64_t cols() { return surface_.surface().cols(); }
  double pitch() { return surface_.surface().pieces().size.pitch_x; }
  int tileRows() { return surface_.surface().tile().height; }

  std::optional<Memory> heights(std::int64_t row, std::int64_t col, int rows, int cols) {
    return memoryOf(alone([&] {
      cv::Mat relief(rows, cols, CV_32FC1);
      surface_.surface().heights(row, col, relief);
      return relief;
    }));
  }

  py::bytes cells(std::int64_t first_row, std::int64_t rows) {
    return py::bytes(alone([&] { return surface_.strip(first_row, rows); }));
  }

  std::shared_ptr<SurfaceStrips> strips() {
    return alone([&] { return std::make_shared<SurfaceStrips>(surface_); });
  }

  std::shared_ptr<Found> adhesion(const SurfaceStrips& strips) {
    return alone([&] {
      auto found = std::make_shared<Found>();
      found->realisations.push_back(surface_.realise(strips));
      found->warnings = surface_.warnings();
      return found;
    });
  }

 private:
  std::mutex mutex_;
  DividedSurface surface_;
  std::vector<std::string> warnings_;
};

std::shared_ptr<SharedSurface> madeSurface(const std::vector<DeviceScan>& scans,
                                           const std::vector<DeviceScan>& counter_surface,
                                           const Configuration& configuration, int number,
                                           std::optional<double> depth) {
  return interruptible([&](const std::atomic<bool>& cancel) {
    const Cancellation check(cancel);
    const BesideWork beside([&] { check(0.0); });
    DevicePredictor predictor(configuration);
    addScans(scans, counter_surface, check, predictor);
    DividedSurface surface = predictor.surface(number, depth);
    std::vector<std::string> warnings = predictor.scanWarnings();
    for (const std::string& shortcoming : surface.shortcomings()) warnings.push_back(shortcoming);
    return std::make_shared<SharedSurface>(std::move(surface), std::move(warnings));
  });
}

Records recordOf(const std::shared_ptr<Found>& found) {
  return recordsOf(found->realisations, found,
                   [](const auto& item, auto& fields) { visitRealisationFields(item, fields); });
}

void addStrip(SurfaceStrips& strips, const py::bytes& part) {
  const std::string_view bytes = part;
  const WithoutLock unlocked;
  strips.add(bytes);
}

}  // namespace

void bindMadeSurface(py::module& module) {
  py::class_<SurfaceStrips, std::shared_ptr<SurfaceStrips>>(module, "SurfaceStrips")
      .def("add", &addStrip, "part"_a);
  py::class_<Found, std::shared_ptr<Found>>(module, "SurfaceAdhesion")
      .def_property_readonly("record", &recordOf)
      .def_readonly("warnings", &Found::warnings);
  py::class_<SharedSurface, std::shared_ptr<SharedSurface>>(module, "MadeSurface")
      .def(py::init(&madeSurface), "scans"_a, "counter_surface"_a, "configuration"_a, "number"_a,
           "depth"_a)
      .def_property_readonly("warnings", &SharedSurface::warnings)
      .def_property_readonly("rows", &SharedSurface::rows)
      .def_property_readonly("cols", &SharedSurface::cols)
      .def_property_readonly("pitch", &SharedSurface::pitch)
      .def_property_readonly("tile_rows", &SharedSurface::tileRows)
      .def("heights", &SharedSurface::heights, "row"_a, "col"_a, "rows"_a, "cols"_a)
      .def("cells", &SharedSurface::cells, "first_row"_a, "rows"_a)
      .def("strips", &SharedSurface::strips)
      .def("adhesion", &SharedSurface::adhesion, "strips"_a);
}

}  // namespace python
}  // namespace mems_stiction
