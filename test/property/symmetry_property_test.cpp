/// What no change of units, frame or place may change in a prediction.

#include <cmath>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "mems_stiction/paper/paper_options.hpp"
#include "property/rough_pairs.hpp"

namespace mems_stiction {
namespace property {
namespace {

/// Sums in another order: round-off of some thousand terms.
constexpr double kReordered = 1e-9;
/// The mean gap is the small rest of two large sums.
constexpr double kRestOfSums = 1e-6;
/// Closed forms with roots and logarithms of scaled numbers.
constexpr double kScaled = 1e-11;

void checkNear(double value, double expected, double tolerance, const char* name) {
  if (std::isnan(expected) && std::isnan(value)) return;
  if (std::abs(value - expected) <= tolerance * std::abs(expected)) return;
  RC_FAIL(std::string(name) + ": " + std::to_string(value / expected) +
          " times what was expected, " + std::to_string(expected));
}

/// Forces, areas and energies of a prediction, over those of another scaled by the given factors.
void checkSame(const Prediction& found, const Prediction& expected, double tolerance,
               double area = 1.0, double force = 1.0, double length = 1.0) {
  RC_ASSERT(found.status == expected.status);
  RC_ASSERT(found.asperity_count == expected.asperity_count);
  RC_ASSERT(found.elastic_count == expected.elastic_count);
  RC_ASSERT(found.elasto_plastic_count == expected.elasto_plastic_count);
  RC_ASSERT(found.plastic_count == expected.plastic_count);
  RC_ASSERT(found.contact_fraction == expected.contact_fraction);
  const auto check = [&](double Prediction::*figure, double scale, const char* name) {
    checkNear(found.*figure, scale * (expected.*figure), tolerance, name);
  };
  check(&Prediction::van_der_waals_force, force, "van_der_waals_force");
  check(&Prediction::electrostatic_force, force, "electrostatic_force");
  check(&Prediction::normal_load, force, "normal_load");
  check(&Prediction::pull_off_force, force, "pull_off_force");
  check(&Prediction::pull_off_force_jkr, force, "pull_off_force_jkr");
  check(&Prediction::pull_off_force_transition, force, "pull_off_force_transition");
  check(&Prediction::contact_area, area, "contact_area");
  check(&Prediction::contact_area_jkr, area, "contact_area_jkr");
  check(&Prediction::nominal_area, area, "nominal_area");
  check(&Prediction::approach, length, "approach");
  check(&Prediction::mechanical_energy, force * length, "mechanical_energy");
  check(&Prediction::surface_energy, force * length, "surface_energy");
  check(&Prediction::elastic_energy, force * length, "elastic_energy");
  check(&Prediction::plastic_work, force * length, "plastic_work");
  check(&Prediction::adhesion_parameter, 1.0, "adhesion_parameter");
  check(&Prediction::median_tabor_parameter, 1.0, "median_tabor_parameter");
  check(&Prediction::composite_rms_height, length, "composite_rms_height");
  checkNear(found.mean_gap, length * expected.mean_gap, std::max(tolerance, kRestOfSums),
            "mean_gap");
}

HeightMap scaled(const HeightMap& surface, double factor) {
  return {cv::Mat(surface.heights() * factor), surface.pitchX() * factor,
          surface.pitchY() * factor};
}

template <typename Change>
SurfacePair changed(const SurfacePair& pair, Change&& change) {
  return {change(pair.lower), !pair.upperIsPlane() ? change(pair.upper) : HeightMap()};
}

RC_GTEST_PROP(Scaling, lengthsByCAndStiffnessBySScaleForcesBySCSquared,
              (const PairCase& pair_case, const SettingCase& setting)) {
  // powers of two and of four keep every product, quotient and square root exact: the same cells
  // touch
  const double c = std::ldexp(1.0, *rc::evenly(-8, 9));
  const double s = std::ldexp(1.0, 2 * *rc::evenly(-4, 5));
  const SurfacePair pair = pairOf(pair_case);
  Options options = optionsOf(setting);
  options.load.max_voltage = options.load.max_mechanical_load = 1e12;
  const Prediction before = predict(options, pair);

  options.lower.youngs_modulus *= s;
  options.upper.youngs_modulus *= s;
  options.lower.hardness *= s;
  options.upper.hardness *= s;
  options.interface.work_of_adhesion *= s * c;
  options.interface.hamaker_constant *= s * c * c * c;
  options.solver.of<PaperOptions>().cutoff_distance *= c;
  options.interface.equilibrium_distance *= c;
  options.interface.insulator_thickness *= c;
  options.load.mechanical_load *= s * c * c;
  options.load.voltage *= c * std::sqrt(s);  // eps0 U^2 is a force
  const Prediction after =
      predict(options, changed(pair, [c](const HeightMap& map) { return scaled(map, c); }));
  checkSame(after, before, kScaled, c * c, s * c * c, c);
}

HeightMap turned(const HeightMap& surface) {
  cv::Mat heights;
  cv::rotate(surface.heights(), heights, cv::ROTATE_90_CLOCKWISE);
  return {heights, surface.pitchY(), surface.pitchX()};
}

RC_GTEST_PROP(Frame, canBeTurnedByNinetyDegrees,
              (const PairCase& pair_case, const SettingCase& setting)) {
  const SurfacePair pair = pairOf(pair_case);
  const Options options = optionsOf(setting);
  checkSame(predict(options, changed(pair, turned)), predict(options, pair), kReordered);
}

RC_GTEST_PROP(Frame, canBeFlipped, (const PairCase& pair_case, const SettingCase& setting)) {
  const int axis = *rc::evenly(-1, 2);
  const SurfacePair pair = pairOf(pair_case);
  const Options options = optionsOf(setting);
  const auto flipped = [axis](const HeightMap& surface) {
    cv::Mat heights;
    cv::flip(surface.heights(), heights, axis);
    return HeightMap(heights, surface.pitchX(), surface.pitchY());
  };
  checkSame(predict(options, changed(pair, flipped)), predict(options, pair), kReordered);
}

RC_GTEST_PROP(Frame, canHaveABorderOfInvalidPixels,
              (PairCase pair_case, const SettingCase& setting)) {
  const int width = *rc::evenly(1, 5);
  const SurfacePair pair = pairOf(pair_case);
  const Options options = optionsOf(setting);
  const auto bordered = [width](const HeightMap& surface) {
    cv::Mat heights;
    cv::copyMakeBorder(surface.heights(), heights, width, width, width, width, cv::BORDER_CONSTANT,
                       cv::Scalar(std::nan("")));
    return HeightMap(heights, surface.pitchX(), surface.pitchY());
  };
  checkSame(predict(options, changed(pair, bordered)), predict(options, pair), kReordered);
}

RC_GTEST_PROP(Bodies, canBeExchanged, (PairCase pair_case, const SettingCase& setting)) {
  pair_case.has_counter_surface = true;
  const SurfacePair pair = pairOf(pair_case);
  Options options = optionsOf(setting);
  const Prediction before = predict(options, pair);
  const auto turnedOver = [](const HeightMap& surface) {
    return HeightMap(cv::Mat(-surface.heights()), surface.pitchX(), surface.pitchY());
  };
  std::swap(options.lower, options.upper);
  const Prediction after = predict(options, {turnedOver(pair.upper), turnedOver(pair.lower)});
  checkSame(after, before, kReordered);
  for (int row = 0; row < pair.lower.rows(); ++row) {
    for (int col = 0; col < pair.lower.cols(); ++col) {
      const double height = before.deformed_lower.at<double>(row, col);
      if (!std::isfinite(height)) continue;
      // depths by sums in another order, on heights of some ten nanometres
      const double tolerance = kReordered * before.approach + 1e-23;
      RC_ASSERT(std::abs(after.deformed_upper.at<double>(row, col) + height) <= tolerance);
    }
  }
}

RC_GTEST_PROP(Bodies, canBeMovedAlongZ, (const PairCase& pair_case, const SettingCase& setting)) {
  // whole multiples of 2^-20 m: sums with the heights of withExactSums() are exact, so nothing at
  // all may change
  const double lower_offset = std::ldexp(1.0, -20) * *rc::evenly(-5, 6);
  const double upper_offset = std::ldexp(1.0, -20) * *rc::evenly(-5, 6);
  const auto moved = [](const HeightMap& surface, double offset) {
    return HeightMap(cv::Mat(surface.heights() + offset), surface.pitchX(), surface.pitchY());
  };
  const SurfacePair pair = pairOf(pair_case);
  const Options options = optionsOf(setting);
  const SurfacePair elsewhere{moved(pair.lower, lower_offset),
                              !pair.upperIsPlane() ? moved(pair.upper, upper_offset) : HeightMap()};
  checkSame(predict(options, elsewhere), predict(options, pair), kReordered);
}

/// A scan whose border lies so low that no contact reaches it.
HeightMap withLowBorder(const HeightMap& surface) {
  cv::Mat heights;
  cv::copyMakeBorder(surface.heights(), heights, 2, 2, 2, 2, cv::BORDER_CONSTANT,
                     cv::Scalar(-1e-6));
  return {heights, surface.pitchX(), surface.pitchY()};
}

RC_GTEST_PROP(Tiles, twoOfAScanHaveTwiceItsForce, (PairCase pair_case, SettingCase setting)) {
  // without forces across the gap, whose histograms differ: twice the load, then, is exactly twice
  // the load
  setting.hamaker = setting.voltage = 0;
  pair_case.has_counter_surface = false;
  Options options = optionsOf(setting);
  options.solver.of<PaperOptions>().step =
      2e-12 * pair_case.rms_height;  // sigma/50; two tiles have the same but for round-off
  options.output.asperities = false;
  const HeightMap tile = withLowBorder(pairOf(pair_case).lower);
  const bool is_beside = *rc::gen::arbitrary<bool>();
  cv::Mat both;
  if (is_beside) {
    cv::hconcat(tile.heights(), tile.heights(), both);
  } else {
    cv::vconcat(tile.heights(), tile.heights(), both);
  }
  const Prediction one = predict(options, {tile, {}});
  options.load.mechanical_load *= 2.0;
  const Prediction two = predict(options, {HeightMap(both, tile.pitchX(), tile.pitchY()), {}});
  RC_ASSERT(two.status == one.status);
  RC_ASSERT(two.asperity_count == 2 * one.asperity_count);
  RC_ASSERT(two.contact_fraction == one.contact_fraction);
  RC_ASSERT(two.approach == one.approach);
  checkNear(two.pull_off_force, 2.0 * one.pull_off_force, kReordered, "pull_off_force");
  checkNear(two.contact_area_jkr, 2.0 * one.contact_area_jkr, kReordered, "contact_area_jkr");
  checkNear(two.surface_energy, 2.0 * one.surface_energy, kReordered, "surface_energy");
  checkNear(two.elastic_energy, 2.0 * one.elastic_energy, kReordered, "elastic_energy");
  checkNear(two.plastic_work, 2.0 * one.plastic_work, kReordered, "plastic_work");
}

}  // namespace
}  // namespace property
}  // namespace mems_stiction
