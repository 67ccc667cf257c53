#pragma once

/// Random rough surfaces and settings for properties of whole predictions.
///
/// A case is a handful of whole numbers, so that a failing one shrinks to a small frame with plain
/// settings, and prints as a line that can be typed in again.

#include <cmath>
#include <ostream>

#include <rapidcheck.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace property {

inline constexpr double kNm = 1e-9;

/// One frame, alone on a plane or on a second one.
struct PairCase {
  int rows = 0, cols = 0;
  int pitch_x = 0, pitch_y = 0;  ///< [nm]
  int rms_height = 0;            ///< [0.1 nm]
  int correlation = 0;           ///< [pitches]
  int seed = 0;
  bool has_counter_surface = false;
  int holes = 0;  ///< invalid pixels [%]

  friend std::ostream& operator<<(std::ostream& stream, const PairCase& c) {
    return stream << "PairCase{" << c.rows << ", " << c.cols << ", " << c.pitch_x << ", "
                  << c.pitch_y << ", " << c.rms_height << ", " << c.correlation << ", " << c.seed
                  << ", " << c.has_counter_surface << ", " << c.holes << "}";
  }
};

/// Heights on whole multiples of 2^-60 m, a billionth of a nanometre: sums with an offset of 2^-20
/// m are then exact.
inline HeightMap withExactSums(const HeightMap& surface) {
  return samples::quantized(surface, std::ldexp(1.0, -60));
}

inline SurfacePair pairOf(const PairCase& c) {
  const auto frame = [&](int seed, double rms_height) {
    const double longest =
        0.49 * std::min(c.rows * c.pitch_y, c.cols * c.pitch_x);  // the generator's limit: half
    const double correlation =
        std::min(longest, 1.0 * c.correlation * std::max(c.pitch_x, c.pitch_y));
    const HeightMap rough = samples::gaussian(c.rows, c.cols, c.pitch_x * kNm, c.pitch_y * kNm,
                                              rms_height, correlation * kNm, seed);
    return withExactSums(c.holes > 0 ? samples::withHoles(rough, 0.01 * c.holes, seed + 1000)
                                     : rough);
  };
  SurfacePair pair{frame(c.seed, 0.1 * c.rms_height * kNm), {}};
  if (c.has_counter_surface) pair.upper = frame(c.seed + 500, 0.07 * c.rms_height * kNm);
  return pair;
}

inline Prediction predict(const Options& options, const SurfacePair& pair) {
  AdhesionModel model(options);
  return model.predict(pair);
}

/// What a prediction depends on beside the surfaces.
struct SettingCase {
  int work = 0;            ///< of adhesion [mJ/m^2]
  int lower_hardness = 0;  ///< [0.1 GPa]
  int upper_hardness = 0;  ///< [0.1 GPa]
  int load = 0;            ///< [0.1 uN]
  int hamaker = 0;         ///< [zJ]
  int voltage = 0;         ///< [V], across 50 nm of oxide
  bool is_printed = false, is_elastic = false, joins_corners = false;

  friend std::ostream& operator<<(std::ostream& stream, const SettingCase& c) {
    return stream << "SettingCase{" << c.work << ", " << c.lower_hardness << ", "
                  << c.upper_hardness << ", " << c.load << ", " << c.hamaker << ", " << c.voltage
                  << ", " << c.is_printed << ", " << c.is_elastic << ", " << c.joins_corners << "}";
  }
};

inline Options optionsOf(const SettingCase& c) {
  Options options;
  options.interface.work_of_adhesion = 1e-3 * c.work;
  options.lower.hardness = 1e8 * c.lower_hardness;
  options.upper.hardness = 1e8 * c.upper_hardness;
  options.upper.youngs_modulus = 100e9;
  options.load.mechanical_load = 1e-7 * c.load;
  options.interface.hamaker_constant = 1e-21 * c.hamaker;
  options.interface.insulator_thickness = 50 * kNm;
  options.load.voltage = c.voltage;
  options.formulation = c.is_printed ? "printed" : "paper";
  options.deformation = c.is_elastic ? Deformation::kElastic : Deformation::kThreeRegimes;
  options.approach.connectivity = c.joins_corners ? Connectivity::kEight : Connectivity::kFour;
  options.output.roughness = false;
  return options;
}

}  // namespace property
}  // namespace mems_stiction

namespace rc {

/// Whole numbers of [low, high) from the first case on: RapidCheck's own begin near `low`.
inline Gen<int> evenly(int low, int high) {
  return gen::resize(kNominalSize, gen::inRange(low, high));
}

template <>
struct Arbitrary<mems_stiction::property::PairCase> {
  static Gen<mems_stiction::property::PairCase> arbitrary() {
    using Case = mems_stiction::property::PairCase;
    return gen::build<Case>(
        gen::set(&Case::rows, evenly(24, 72)), gen::set(&Case::cols, evenly(24, 72)),
        gen::set(&Case::pitch_x, evenly(5, 20)), gen::set(&Case::pitch_y, evenly(5, 20)),
        gen::set(&Case::rms_height, evenly(2, 60)), gen::set(&Case::correlation, evenly(3, 9)),
        gen::set(&Case::seed, evenly(1, 400)), gen::set(&Case::has_counter_surface),
        gen::set(&Case::holes, gen::weightedElement<int>({{3, 0}, {1, 2}, {1, 15}})));
  }
};

template <>
struct Arbitrary<mems_stiction::property::SettingCase> {
  static Gen<mems_stiction::property::SettingCase> arbitrary() {
    using Case = mems_stiction::property::SettingCase;
    return gen::build<Case>(
        gen::set(&Case::work, evenly(1, 200)), gen::set(&Case::lower_hardness, evenly(5, 150)),
        gen::set(&Case::upper_hardness, evenly(5, 150)), gen::set(&Case::load, evenly(0, 60)),
        gen::set(&Case::hamaker, evenly(0, 100)), gen::set(&Case::voltage, evenly(0, 20)),
        gen::set(&Case::is_printed), gen::set(&Case::is_elastic), gen::set(&Case::joins_corners));
  }
};

}  // namespace rc
