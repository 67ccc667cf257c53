#pragma once

/// @file
/// Memory between Python and the core, by the buffer protocol alone, so that the module fits every
/// version of NumPy.
///
/// Heights that Python owns are shown to the core where they lie; arrays that the core has made are
/// shown to Python where they lie. Neither way copies; whoever shows shares.

#include <pybind11/pybind11.h>

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {
namespace python {

/// A buffer of the core with its shape; Python makes a NumPy array over it.
struct Memory {
  PixelOwner owner;
  const void* data = nullptr;
  pybind11::ssize_t item_size = 1;
  std::string format = "B";  ///< of the buffer protocol
  std::vector<pybind11::ssize_t> shape;
  std::vector<pybind11::ssize_t> strides;  ///< [bytes]
};

/// One field of a record: its name, its format in the buffer protocol, and where it lies in the
/// structure.
using Field = std::tuple<std::string, std::string, std::size_t>;

template <typename Value>
std::string formatOf() {
  if constexpr (std::is_enum_v<Value>) {
    return formatOf<std::underlying_type_t<Value>>();
  } else {
    return pybind11::format_descriptor<Value>::format();
  }
}

/// A list of structures as Python shows it: an array with named fields.
struct Records {
  Memory bytes;
  std::size_t record_size = 0;
  std::vector<Field> fields;
};

/// - @p owner what the list lies in
/// - @p visit_fields called with one record and a visitor of its figures
template <typename Record, typename VisitFields>
Records recordsOf(const std::vector<Record>& list, const PixelOwner& owner,
                  const VisitFields& visit_fields) {
  Records records;
  records.record_size = sizeof(Record);
  const Record sample{};
  const auto add = [&](const Figure& figure, const auto& value) {
    const auto offset =
        reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(&sample);
    records.fields.emplace_back(figure.name, formatOf<std::decay_t<decltype(value)>>(), offset);
  };
  visit_fields(sample, add);
  records.bytes.owner = owner;
  records.bytes.data = list.data();
  records.bytes.shape = {static_cast<pybind11::ssize_t>(list.size() * sizeof(Record))};
  records.bytes.strides = {1};
  return records;
}

/// The pixels of a map of the core; nothing for an empty one. The map is held.
std::optional<Memory> memoryOf(const cv::Mat& map);

/// Pixels of a Python object as heights in metres, without a copy; the object is shared as long as
/// anybody shows them.
/// - @p pixels two-dimensional buffer, columns next to each other
/// - @p options scale, and pitch where `pitch_x` is 0
/// - @p pitch_x, pitch_y [m]
/// @throw SurfaceError as heightMapFromPixels()
HeightMap heightMapOf(const pybind11::buffer& pixels, ScanOptions options, double pitch_x,
                      double pitch_y);

void bindMemory(pybind11::module& module);

}  // namespace python
}  // namespace mems_stiction
