#pragma once

/// A writer of Gwyddion's container, by its documentation: name, type letter, little-endian value.

#include <cstdint>
#include <string>
#include <vector>

#include "support/binary_writer.hpp"

namespace mems_stiction::gwy_bytes {

inline std::string littleEndian(std::uint64_t value, int bytes) {
  return littleBytes(value).substr(0, static_cast<std::size_t>(bytes));
}
inline std::string realBytes(double value) { return littleBytes(value); }

inline std::string named(const std::string& name, char type) { return name + '\0' + type; }
inline std::string integer(const std::string& name, std::uint32_t value) {
  return named(name, 'i') + littleEndian(value, 4);
}
inline std::string real(const std::string& name, double value) {
  return named(name, 'd') + realBytes(value);
}
inline std::string text(const std::string& name, const std::string& value) {
  return named(name, 's') + value + '\0';
}
inline std::string body(const std::string& type, const std::string& content) {
  return type + '\0' + littleEndian(content.size(), 4) + content;
}
inline std::string object(const std::string& name, const std::string& type,
                          const std::string& content) {
  return named(name, 'o') + body(type, content);
}
inline std::string reals(const std::string& name, const std::vector<double>& values) {
  std::string bytes = named(name, 'D') + littleEndian(values.size(), 4);
  for (const double value : values) bytes += realBytes(value);
  return bytes;
}
inline std::string unit(const std::string& name, const std::string& symbol) {
  return object(name, "GwySIUnit", text("unitstr", symbol));
}

inline std::string field(const std::string& name, std::uint32_t cols, std::uint32_t rows,
                         const std::vector<double>& values, const std::string& unit_z = "m") {
  return object(name, "GwyDataField",
                integer("xres", cols) + integer("yres", rows) + real("xreal", 3e-6) +
                    real("yreal", 4e-6) + unit("si_unit_xy", "m") + unit("si_unit_z", unit_z) +
                    reals("data", values));
}

inline std::string file(const std::string& content) {
  return "GWYP" + body("GwyContainer", content);
}

/// Two channels, a mask, and components of every other type that a reader must step over.
inline std::string example() {
  return file(named("/0/data/visible", 'b') + '\1' + named("flag", 'c') + 'x' + named("/big", 'q') +
              littleEndian(1, 8) + named("counts", 'I') + littleEndian(2, 4) + littleEndian(7, 8) +
              named("wide", 'Q') + littleEndian(1, 4) + littleEndian(7, 8) + named("bytes", 'C') +
              littleEndian(3, 4) + "abc" + named("names", 'S') + littleEndian(2, 4) +
              std::string("one\0two\0", 8) + named("objects", 'O') + littleEndian(2, 4) +
              body("GwySIUnit", text("unitstr", "V")) + body("Other", "") +
              object("/0/meta", "GwyContainer", text("Instrument", "none")) +
              field("/10/data", 3, 2, {1, 2, 3, 4, 5, 6}, "V") + text("/0/data/title", "ZSensor") +
              field("/0/data", 3, 2, {1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9}) +
              field("/0/mask", 3, 2, {0, 1, 0, 0, 0, 0.5}, ""));
}

}  // namespace mems_stiction::gwy_bytes
