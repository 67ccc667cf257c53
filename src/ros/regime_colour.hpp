#pragma once

/// @file
/// The colours of deformation regimes, as in all our pictures: told apart without red-green vision
/// too.

#include <cstdint>

#include "mems_stiction/mechanics/plasticity.hpp"

namespace mems_stiction {

/// Of a picture's pixel, 0 to 255 each.
struct Colour {
  std::uint8_t red, green, blue;
};

inline constexpr char kRegimeLegend[] =
    "grey: apart   blue: elastic   yellow: elasto-plastic   red: plastic";

inline Colour colourOf(Regime regime) {
  switch (regime) {
    case Regime::kElastic:
      return {47, 127, 209};
    case Regime::kElastoPlastic:
      return {242, 183, 5};
    case Regime::kPlastic:
      return {209, 50, 47};
    case Regime::kApart:
      break;
  }
  return {190, 190, 190};
}

}  // namespace mems_stiction
