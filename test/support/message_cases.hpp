#pragma once

/// What the tests of messages share: a load, a verdict, and the lines that ROS prints of a message.

#include <set>
#include <sstream>
#include <string>

#include "mems_stiction/loads/interface.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

inline LoadOptions someLoad() {
  LoadOptions load;
  load.voltage = 3.0;
  load.mechanical_load = 2e-6;
  return load;
}

inline Verdict someVerdict() {
  Verdict verdict;
  verdict.sticks = Sticks::kYes;
  verdict.reason = "two\nlines, 95 %";
  verdict.restoring_force = 1e-6;
  verdict.margin = 0.5;
  verdict.margin_lower = 0.4;
  verdict.margin_upper = 0.6;
  verdict.peel_number = 5.0;
  verdict.peel_number_lower = 4.0;
  verdict.peel_number_upper = 6.0;
  return verdict;
}

/// As ROS prints a value.
inline std::string text(double value) {
  std::ostringstream stream;
  stream << value;
  return stream.str();
}

/// As ROS prints a message.
template <typename Message>
std::set<std::string> linesOf(const Message& message) {
  std::stringstream stream;
  stream << message;
  std::set<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.insert(line);
  return lines;
}

}  // namespace mems_stiction
