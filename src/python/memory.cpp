#include "memory.hpp"

#include <pybind11/stl.h>

#include <utility>

#include "height_map/unmeasured.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "without_lock.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;

/// The type of OpenCV for a format of the buffer protocol; -1 if there is none.
int pixelTypeOf(const py::buffer_info& info) {
  if (info.format == py::format_descriptor<float>::format()) return CV_32FC1;
  if (info.format == py::format_descriptor<double>::format()) return CV_64FC1;
  if (info.format == py::format_descriptor<std::uint16_t>::format()) return CV_16UC1;
  if (info.format == py::format_descriptor<std::int16_t>::format()) return CV_16SC1;
  if (info.format == py::format_descriptor<std::uint8_t>::format()) return CV_8UC1;
  return -1;
}

std::string formatOfPixels(const cv::Mat& map) {
  switch (map.depth()) {
    case CV_64F:
      return py::format_descriptor<double>::format();
    case CV_32F:
      return py::format_descriptor<float>::format();
    default:
      return py::format_descriptor<std::uint8_t>::format();
  }
}

Memory memoryOfMap(const cv::Mat& map, PixelOwner owner) {
  Memory memory;
  memory.owner = std::move(owner);
  memory.data = map.data;
  memory.item_size = static_cast<py::ssize_t>(map.elemSize());
  memory.format = formatOfPixels(map);
  memory.shape = {map.rows, map.cols};
  memory.strides = {static_cast<py::ssize_t>(map.step[0]), memory.item_size};
  return memory;
}

/// Shares a Python object; whichever thread lets go of it last takes the interpreter's lock for
/// that.
PixelOwner ownedBuffer(py::buffer_info&& info) {
  return {new py::buffer_info(std::move(info)), [](const void* owned) {
            takingLock([owned] {
              const py::gil_scoped_acquire lock;
              delete static_cast<const py::buffer_info*>(owned);
            });
          }};
}

py::buffer_info bufferOf(Memory& memory) {
  return {const_cast<void*>(memory.data),
          memory.item_size,
          memory.format,
          static_cast<py::ssize_t>(memory.shape.size()),
          memory.shape,
          memory.strides};
}

}  // namespace

std::optional<Memory> memoryOf(const cv::Mat& map) {
  if (map.empty()) return std::nullopt;
  const auto owned = std::make_shared<cv::Mat>(map);
  return memoryOfMap(*owned, owned);
}

HeightMap heightMapOf(const py::buffer& pixels, ScanOptions options, double pitch_x,
                      double pitch_y) {
  py::buffer_info info = pixels.request();
  const int type = pixelTypeOf(info);
  if (info.ndim != 2 || type < 0 || (info.shape[1] > 1 && info.strides[1] != info.itemsize)) {
    throw SurfaceError("pixels of format '" + info.format + "' with " + std::to_string(info.ndim) +
                       " dimensions cannot be shown as they lie");
  }
  if (pitch_x > 0.0 || options.pitch_x <= 0.0) {
    options.pitch_x = pitch_x;
    options.pitch_y = pitch_y;
  }
  const int rows = static_cast<int>(info.shape[0]);
  const int cols = static_cast<int>(info.shape[1]);
  const std::size_t step =
      rows > 1 ? static_cast<std::size_t>(info.strides[0]) : std::size_t{cv::Mat::AUTO_STEP};
  const cv::Mat shown(rows, cols, type, info.ptr, step);
  return measuredPart(heightMapFromPixels(shown, options, ownedBuffer(std::move(info))));
}

void bindMemory(py::module& module) {
  py::class_<Memory>(module, "Memory", py::buffer_protocol()).def_buffer(&bufferOf);

  py::class_<Records>(module, "Records")
      .def_readonly("bytes", &Records::bytes)
      .def_readonly("record_size", &Records::record_size)
      .def_readonly("fields", &Records::fields);

  py::class_<HeightMap>(module, "HeightMap")
      .def_property_readonly("pixels",
                             [](const HeightMap& map) -> std::optional<Memory> {
                               if (map.empty()) return std::nullopt;
                               const auto owned = std::make_shared<HeightMap>(map);
                               return memoryOfMap(owned->heights(), owned);
                             })
      .def_property_readonly(
          "pitch", [](const HeightMap& map) { return std::make_pair(map.pitchX(), map.pitchY()); });
}

}  // namespace python
}  // namespace mems_stiction
