#pragma once

/// @file
/// Memory between Python and the core, by the buffer protocol alone, so that the module fits every version of NumPy.
///
/// Heights that Python holds are shown to the core where they lie; arrays that the core has made are shown to Python
/// where they lie. Neither way copies; whoever shows holds.

#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"

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

/// One field of a record: where it lies in the structure, and its format in the buffer protocol.
struct Field {
  std::string name;
  std::string format;
  std::size_t offset;
};

template <typename Value>
std::string formatOf() {
  if constexpr (std::is_enum_v<Value>) {
    return formatOf<std::underlying_type_t<Value>>();
  } else {
    return pybind11::format_descriptor<Value>::format();
  }
}

/// Collects the fields of a structure, as the visitors of the core name them or by hand.
template <typename Record>
class Fields {
 public:
  template <typename Value>
  void operator()(const char* name, const Value& value, const char* /*unit*/ = "") {
    const auto offset = reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(&sample);
    fields.push_back({name, formatOf<Value>(), static_cast<std::size_t>(offset)});
  }

  Record sample{};
  std::vector<Field> fields;
};

/// A list of structures as Python shows it: an array with named fields.
struct Records {
  Memory bytes;
  std::size_t record_size = 0;
  std::vector<Field> fields;
};

/// - @p owner what the list lies in
template <typename Record>
Records recordsOf(const std::vector<Record>& list, std::vector<Field> fields, const PixelOwner& owner) {
  Records records;
  records.record_size = sizeof(Record);
  records.fields = std::move(fields);
  records.bytes.owner = owner;
  records.bytes.data = list.data();
  records.bytes.shape = {static_cast<pybind11::ssize_t>(list.size() * sizeof(Record))};
  records.bytes.strides = {1};
  return records;
}

/// The pixels of a map of the core; None for an empty one. The map is held.
pybind11::object memoryOf(const cv::Mat& map);

/// Pixels of a Python object as heights in metres, without a copy; the object is held as long as anybody shows them.
/// - @p pixels two-dimensional buffer, columns next to each other
/// - @p options scale, and pitch where `pitch_x` is 0
/// - @p pitch_x, pitch_y [m]
/// @throw SurfaceError as heightMapFromPixels()
HeightMap heightMapOf(const pybind11::buffer& pixels, ScanOptions options, double pitch_x, double pitch_y);

void bindMemory(pybind11::module& module);

}  // namespace python
}  // namespace mems_stiction
