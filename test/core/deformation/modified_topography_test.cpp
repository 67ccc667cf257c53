#include "deformation/modified_topography.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kLimit = 0.9;  // a of (12)
constexpr double kPlastic = 2.0;
constexpr double kNm = 1e-9;
constexpr double kRoundOff = 1e-20;  // m, of sums of some ten nanometres

DeformationShare shareOf(double lower_hardness, double upper_hardness) {
  Material lower;
  Material upper;
  lower.hardness = lower_hardness;
  upper.hardness = upper_hardness;
  return {lower, upper, kLimit};
}

TEST(DeformationShare, dependsOnTheRegime) {
  const DeformationShare share = shareOf(10e9, 10.5e9);
  const double s = share.lower(kPlastic);
  EXPECT_EQ(share.lower(0.6), 0.0);
  EXPECT_EQ(share.upper(0.6), 0.0);
  EXPECT_NEAR(share.lower(0.8), 0.4 * s, 1e-12);  // c = 2 (phi - 0.6)
  EXPECT_NEAR(share.upper(0.8), 0.4 * (1.0 - s), 1e-12);
  EXPECT_DOUBLE_EQ(share.lower(1.1), s);
  EXPECT_DOUBLE_EQ(share.lower(kPlastic) + share.upper(kPlastic), 1.0);
}

/// Two rough surfaces that press on each other.
struct Contact {
  HeightMap lower = samples::withHoles(
      samples::gaussian(64, 71, 10 * kNm, 12 * kNm, 4 * kNm, 50 * kNm, 1), 0.03, 3);
  HeightMap upper =
      analytic::sum(samples::gaussian(64, 71, 10 * kNm, 12 * kNm, 3 * kNm, 60 * kNm, 2),
                    analytic::flat(64, 71, 10 * kNm, 12 * kNm, 1e-6));
  Options options = paperOptions();

  Contact(double lower_hardness, double upper_hardness) {
    options.lower.hardness = lower_hardness;
    options.upper.hardness = upper_hardness;
    options.load.mechanical_load = 2e-6;
  }

  Prediction predict() const { return AdhesionModel(options).predict({lower, upper}); }

  /// z of the upper surface where the approach has brought it.
  double approachedHeight(const Prediction& prediction, const cv::Mat& upper_heights, int row,
                          int col) const {
    double closest = INFINITY;
    for (int r = 0; r < lower.rows(); ++r) {
      for (int c = 0; c < lower.cols(); ++c) {
        const double separation = upper.height(r, c) - lower.height(r, c);
        if (std::isfinite(separation)) closest = std::min(closest, separation);
      }
    }
    return upper_heights.at<double>(row, col) - closest - prediction.approach;
  }
};

constexpr double kOffsetRoundOff =
    1e-21;  // m, of subtractions at a height of one micrometre: 2e-22 each

/// Visits every cell in contact with its interference and what both surfaces lost of it.
template <typename Visitor>
void forEachContact(const Contact& contact, const Prediction& prediction, Visitor&& visit) {
  for (int row = 0; row < contact.lower.rows(); ++row) {
    for (int col = 0; col < contact.lower.cols(); ++col) {
      const auto regime = static_cast<Regime>(prediction.contact_map.at<std::uint8_t>(row, col));
      if (regime == Regime::kApart) continue;
      const double interference =
          contact.lower.height(row, col) -
          contact.approachedHeight(prediction, contact.upper.heights(), row, col);
      const double lost =
          contact.lower.height(row, col) - prediction.deformed_lower.at<double>(row, col);
      const double raised =
          prediction.deformed_upper.at<double>(row, col) - contact.upper.height(row, col);
      visit(regime, interference, lost, raised);
    }
  }
}

TEST(ModifiedTopography, ofAFullyPlasticPatchEndsInTouch) {
  const Contact contact(0.8e9, 0.84e9);
  const Prediction prediction = contact.predict();
  ASSERT_GT(prediction.plastic_count, 0);
  int plastic_cells = 0;
  for (int row = 0; row < contact.lower.rows(); ++row) {
    for (int col = 0; col < contact.lower.cols(); ++col) {
      if (prediction.contact_map.at<std::uint8_t>(row, col) !=
          static_cast<std::uint8_t>(Regime::kPlastic))
        continue;
      ++plastic_cells;
      ASSERT_NEAR(prediction.deformed_lower.at<double>(row, col),
                  contact.approachedHeight(prediction, prediction.deformed_upper, row, col),
                  kOffsetRoundOff);
    }
  }
  EXPECT_GT(plastic_cells, 10);
}

TEST(ModifiedTopography, leavesTheHarderBodyAlone) {
  for (const bool lower_is_soft : {true, false}) {
    const Contact contact(lower_is_soft ? 0.8e9 : 12e9, lower_is_soft ? 12e9 : 0.8e9);
    const Prediction prediction = contact.predict();
    double soft_loss = 0.0;
    forEachContact(contact, prediction, [&](Regime, double, double lost, double raised) {
      EXPECT_NEAR(lower_is_soft ? raised : lost, 0.0, kRoundOff);
      soft_loss += lower_is_soft ? lost : raised;
    });
    EXPECT_GT(soft_loss, 0.01 * kNm);
  }
}

TEST(ModifiedTopography, bringsElasticPatchesBackUnchanged) {
  Contact contact(0.8e9, 0.8e9);
  contact.options.deformation = Deformation::kElastic;
  const Prediction prediction = contact.predict();
  ASSERT_EQ(prediction.elastic_count, prediction.asperity_count);
  int cells = 0;
  forEachContact(contact, prediction, [&](Regime regime, double, double lost, double raised) {
    ++cells;
    EXPECT_EQ(regime, Regime::kElastic);
    EXPECT_EQ(lost, 0.0);
    EXPECT_EQ(raised, 0.0);
  });
  EXPECT_GT(cells, 0);
}

TEST(ModifiedTopography, keepsInvalidCells) {
  const Contact contact(0.8e9, 0.8e9);
  const Prediction prediction = contact.predict();
  int invalid = 0;
  for (int row = 0; row < contact.lower.rows(); ++row) {
    for (int col = 0; col < contact.lower.cols(); ++col) {
      if (std::isfinite(contact.lower.height(row, col))) continue;
      ++invalid;
      ASSERT_EQ(prediction.contact_map.at<std::uint8_t>(row, col), 0);
      ASSERT_FALSE(std::isfinite(prediction.deformed_lower.at<double>(row, col)));
      ASSERT_EQ(prediction.deformed_upper.at<double>(row, col), contact.upper.height(row, col));
    }
  }
  EXPECT_GT(invalid, 0);
}

TEST(ModifiedTopography, leavesTheScanItself) {
  const Contact contact(0.8e9, 0.8e9);
  const cv::Mat before = contact.upper.heights().clone();
  contact.predict();
  EXPECT_EQ(cv::countNonZero(before != contact.upper.heights()), 0);
}

}  // namespace
}  // namespace mems_stiction
