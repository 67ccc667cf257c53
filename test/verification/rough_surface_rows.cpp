/// The paper's conclusions on Gaussian surfaces, each counted over seeds, loads and roughnesses,
/// and what no input may change.

#include <cmath>
#include <cstring>
#include <thread>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/prediction_fields.hpp"
#include "support/sample_frames.hpp"
#include "support/sphere_contact.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr double kNm = 1e-9;
constexpr double kWork = 50e-3;

Prediction predict(double rms_height, int seed, double load = 0.0,
                   Deformation deformation = Deformation::kThreeRegimes, double hardness = 12e9) {
  Options options = contactOnly(load, kWork);
  options.deformation = deformation;
  options.lower.hardness = hardness;
  options.output.roughness = false;
  return AdhesionModel(options).predict(
      samples::gaussian(160, 200, 10 * kNm, 10 * kNm, rms_height, 100 * kNm, seed));
}

int smoothOnesThatDoNotBond() {
  int violations = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    for (const double rms_height : {0.05, 0.1, 0.2}) {
      const Prediction found = predict(rms_height * kNm, seed);
      if (found.adhesion_parameter <= 1.0 && found.status != Status::kBonded) ++violations;
    }
  }
  return violations;
}

int roughOnesWithManyContacts() {
  int violations = 0;
  for (int seed = 1; seed <= 5; ++seed) {
    for (const double rms_height : {1.5, 3.0, 6.0}) {
      const Prediction found = predict(rms_height * kNm, seed);
      const bool is_apart = found.status == Status::kEquilibrium && found.contact_fraction < 0.01;
      if (found.adhesion_parameter > 12.0 && !is_apart) ++violations;
    }
  }
  return violations;
}

/// Mean contact fraction of six frames, from smooth to rough.
int stepsWithoutAFall() {
  int violations = 0;
  double previous = 1.0;
  for (const double rms_height : {0.2, 0.45, 0.55, 0.7, 1.0, 2.0}) {
    double fraction = 0.0;
    for (int seed = 1; seed <= 6; ++seed)
      fraction += predict(rms_height * kNm, seed).contact_fraction / 6;
    if (fraction >= previous) ++violations;
    previous = fraction;
  }
  return violations;
}

int softOnesThatTouchLess() {
  int violations = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    for (const double load : {0.0, 1e-6, 2e-5}) {
      for (const double hardness : {12e9, 2e9}) {
        for (const double rms_height : {0.3, 0.7, 1.5, 3.0, 6.0}) {
          const Prediction regimes =
              predict(rms_height * kNm, seed, load, Deformation::kThreeRegimes, hardness);
          const Prediction elastic =
              predict(rms_height * kNm, seed, load, Deformation::kElastic, hardness);
          if (regimes.contact_area < elastic.contact_area) ++violations;
        }
      }
    }
  }
  return violations;
}

/// Gui's limits of the adhesion parameter, as published with each prediction.
int regimesThatAreNotGuis() {
  int violations = 0;
  for (const double rms_height : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 3.0}) {
    const Prediction found = predict(rms_height * kNm, 1);
    const double theta = found.adhesion_parameter;
    const BondingRegime expected =
        theta < 1.0 ? BondingRegime::kBonding
                    : (theta <= 12.0 ? BondingRegime::kAdherence : BondingRegime::kNonBonding);
    if (found.bonding_regime != expected) ++violations;
  }
  return violations;
}

/// Every figure and map but the time that it took.
bool isSameToTheBit(const Prediction& a, const Prediction& b) {
  std::vector<double> first, second;
  const auto collectInto = [](std::vector<double>& values) {
    return [&values](const Figure& figure, const auto& value) {
      if (std::strcmp(figure.name, "processing_time") != 0)
        values.push_back(static_cast<double>(value));
    };
  };
  visitPredictionFields(a, collectInto(first));
  visitPredictionFields(b, collectInto(second));
  const auto isSameMap = [](const cv::Mat& x, const cv::Mat& y) {
    return x.total() == y.total() && x.isContinuous() && y.isContinuous() &&
           std::memcmp(x.data, y.data, x.total() * x.elemSize()) == 0;
  };
  return first.size() == second.size() &&
         std::memcmp(first.data(), second.data(), first.size() * sizeof(double)) == 0 &&
         isSameMap(a.deformed_lower, b.deformed_lower) && isSameMap(a.contact_map, b.contact_map);
}

int runsThatDiffer() {
  int violations = 0;
  const Prediction alone = predict(2 * kNm, 7, 1e-6);
  if (!isSameToTheBit(alone, predict(2 * kNm, 7, 1e-6))) ++violations;
  std::vector<Prediction> found(4);
  std::vector<std::thread> threads;
  for (Prediction& one : found) threads.emplace_back([&one] { one = predict(2 * kNm, 7, 1e-6); });
  for (std::thread& thread : threads) thread.join();
  for (const Prediction& one : found) violations += isSameToTheBit(alone, one) ? 0 : 1;
  return violations;
}

}  // namespace

Section roughSurfacesSection() {
  const char* kPaper = "Deladi et al. 2002, conclusions";
  Section section{"Rough surfaces", {}};
  section.rows = {
      always("bonded at an adhesion parameter of 1 and below", kPaper, smoothOnesThatDoNotBond(),
             "holds for each of 15 surfaces"),
      always("above 12 less than 1 % in contact", kPaper, roughOnesWithManyContacts(),
             "holds for each of 15 surfaces"),
      always("contact fraction falls with the roughness between", kPaper, stepsWithoutAFall(),
             "mean of 6 surfaces, at each of 6 steps"),
      always("contact with three regimes at least the elastic", kPaper, softOnesThatTouchLess(),
             "holds for each of 90 pairs"),
      always("bonding regime by the limits 1 and 12", "Gui et al. 1999", regimesThatAreNotGuis(),
             "a comparison of numbers, on each of 8 surfaces"),
      always("same input, same bits, alone or in four threads", "put in", runsThatDiffer(),
             "compared bit by bit"),
  };
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
