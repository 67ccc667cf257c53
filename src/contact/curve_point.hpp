#pragma once

/// @file
/// Force over height as files and records have it, whichever solver followed it.
///
///     visitCurvePointFields(point, [&](const Figure& figure, const auto& value) {
///         print(figure.name, value); });

#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// Which way the upper body went.
enum class CurveDirection { kApproach, kRetraction };

/// A point of the curve.
struct CurvePoint {
  double height;  ///< of the upper body over first touch [m]; negative: pressed in
  double force;   ///< positive pulls the bodies together [N]
  CurveDirection direction;
};

/// "APPROACH", "RETRACTION"
inline const char* word(CurveDirection direction) {
  return direction == CurveDirection::kApproach ? "APPROACH" : "RETRACTION";
}

/// The figures of one point.
/// @param point of a curve
/// @param visit called with (Figure, value) for each
template <typename Visitor>
void visitCurvePointFields(const CurvePoint& point, Visitor&& visit) {
  visit({"height", "m", "of the upper body over first touch; negative: pressed in"}, point.height);
  visit({"force", "N", "attraction positive"}, point.force);
  visit({"direction", "", "APPROACH or RETRACTION"}, point.direction);
}

}  // namespace mems_stiction
