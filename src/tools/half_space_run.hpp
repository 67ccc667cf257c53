#pragma once

/// A solution of the half-space as a program gives it: with progress, with Ctrl-C, and with its
/// maps in files.

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mems_stiction/half_space/half_space_solver.hpp"

namespace mems_stiction {

/// How far a solution is, in words.
class HalfSpaceText {
 public:
  /// "half-space: retraction, 12 heights, 0.35 nm, 0.041 uN"
  /// @param point the next height that was solved
  std::string next(const ForcePoint& point);

 private:
  double height_ = 0.0;
  int heights_ = 0;
};

/// On a terminal it says how far it is, from two seconds on. Ctrl-C ends the program.
/// - @p solve gets what it is to be watched by
SolvedHalfSpace withHalfSpaceProgress(
    const std::function<SolvedHalfSpace(const HalfSpaceControl&)>& solve);

/// Where the maps of one solution go; names that are empty are not written.
struct HalfSpaceMapFiles {
  std::string pressure;
  std::string gap;
  std::string deformed;

  /// Options and names of the maps that are to be written.
  std::vector<std::pair<std::string, std::string>> wanted() const;
};

/// As float TIFF: pressure [Pa] and gap [m] at rest, the lower surface after contact [m].
/// @throw FileError if one cannot be written, or the solution does not have it
void writeMaps(const HalfSpaceMapFiles& files, const SolvedHalfSpace& solution);

}  // namespace mems_stiction
