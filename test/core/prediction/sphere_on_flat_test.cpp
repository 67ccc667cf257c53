/// The model against the closed forms of one and several spheres on a flat, in SI.

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sphere_contact.hpp"

namespace mems_stiction {
namespace {

constexpr double kRadius = 2e-6;
constexpr double kWorkOfAdhesion = 0.05;
constexpr double kLoads[] = {0.0, 1e-7, 1e-6, 1e-5};

Options silicon(double load) { return contactOnly(load, kWorkOfAdhesion); }

double contactModulus() { return ContactPair(Material(), Material()).contact_modulus; }

double jkrRadius(double load, double radius = kRadius, double work_of_adhesion = kWorkOfAdhesion) {
  return jkr::equilibriumContactRadius(load, work_of_adhesion, radius, contactModulus());
}

const SphereGrid kGrids[] = {{"square_even", 4, 4, 0, 1, 0, 0},
                             {"square_odd", 4, 4, 1, 1, 0, 0},
                             {"wide", 3, 6, 0, 1, 0.3, 0.3},
                             {"anisotropic", 4, 4, 1, 1.25, 0.2, 0.25},
                             {"anisotropic_tall", 6, 3, 0, 0.8, 0.4, 0.32}};

struct Errors {
  double area = 0.0;
  double patch_radius = 0.0;
  double pull_off = 0.0;
  double cell_area = 0.0;

  double largest() const { return std::max({area, patch_radius, pull_off}); }
};

Errors errorsOf(const SphereGrid& grid, double load, double pixels) {
  const double a = jkrRadius(load);
  const Prediction prediction =
      AdhesionModel(silicon(load)).predict(sphereOn(grid, kRadius, a, pixels));
  EXPECT_EQ(prediction.status, Status::kEquilibrium);
  EXPECT_EQ(prediction.asperity_count, 1);
  Errors errors;
  if (prediction.asperities.empty()) return errors;
  errors.area = std::abs(prediction.contact_area_jkr / (kPi * a * a) - 1.0);
  errors.patch_radius = std::abs(prediction.asperities[0].cap_radius / a - 1.0);
  errors.pull_off =
      std::abs(prediction.pull_off_force / (1.5 * kPi * kWorkOfAdhesion * kRadius) - 1.0);
  errors.cell_area = std::abs(prediction.contact_area / (kPi * a * a) - 1.0);
  return errors;
}

class SphereOnFlat : public testing::TestWithParam<SphereGrid> {};

INSTANTIATE_TEST_SUITE_P(Grids, SphereOnFlat, testing::ValuesIn(kGrids),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(SphereOnFlat, isJkrWithinThreePercentAtTwentyFivePixels) {
  for (const double load : kLoads) {
    const Errors errors = errorsOf(GetParam(), load, 25);
    EXPECT_LT(errors.area, 0.03) << "load " << load;
    EXPECT_LT(errors.patch_radius, 0.03) << "load " << load;
    EXPECT_LT(errors.pull_off, 0.03) << "load " << load;
    EXPECT_LT(errors.cell_area, 0.06) << "load " << load;  // square of the patch radius
  }
}

TEST_P(SphereOnFlat, comesCloserWithAFinerPitch) {
  for (const double load : kLoads) {
    // over an octave of pitches the error scatters with the grid's phase, so bounds are compared,
    // not single values
    EXPECT_LT(errorsOf(GetParam(), load, 50).largest(), 0.015) << "load " << load;
    EXPECT_LT(errorsOf(GetParam(), load, 100).largest(), 0.0075) << "load " << load;
  }
}

/// chi of a sphere in a frame: by (9) with the rms height of that frame.
double elasticShareOf(const Prediction& prediction, double radius, double hardness) {
  return regimeFactor(
      plasticityIndex(contactModulus(), hardness, prediction.composite_rms_height, radius));
}

TEST(SphereOnFlat, restsOnALargerContactWhenPartlyPlastic) {
  // chi P1^2 - 2 b P1 + (2 - chi) P0^2 = 0 with b = P0 + 3 pi Gamma R; chi from the frame, which is
  // two radii of an elastic contact wide
  const double load = 5e-5, work_of_adhesion = 0.2;
  const double pitch = jkrRadius(load, kRadius, work_of_adhesion) / 25;
  const HeightMap surface =
      analytic::sphere(120, 120, pitch, pitch, kRadius, 0.3 * pitch, 0.2 * pitch);
  double previous = 0.0;
  for (const double hardness : {8e9, 7e9, 6e9}) {
    Options options = contactOnly(load, work_of_adhesion);
    options.lower.hardness = hardness;
    const Prediction prediction = AdhesionModel(options).predict(surface);
    ASSERT_EQ(prediction.status, Status::kEquilibrium) << hardness;
    ASSERT_EQ(prediction.elasto_plastic_count, 1) << hardness;
    const double chi = elasticShareOf(prediction, kRadius, hardness);
    const double b = load + 3 * kPi * work_of_adhesion * kRadius;
    const double apparent = (b + std::sqrt(b * b - chi * (2 - chi) * load * load)) / chi;
    const double a = jkr::contactRadius(apparent, kRadius, contactModulus());
    EXPECT_NEAR(prediction.asperities[0].cap_radius, a, 0.03 * a)
        << hardness;  // 25 pixels and more
    EXPECT_NEAR(prediction.contact_area, kPi * a * a, 0.06 * kPi * a * a) << hardness;
    EXPECT_NEAR(prediction.pull_off_force, 1.5 * kPi * work_of_adhesion * kRadius,
                0.03 * prediction.pull_off_force);
    const double cap =
        kPi * kRadius * prediction.approach * prediction.approach;  // volume that flowed
    EXPECT_NEAR(prediction.plastic_work, (1 - chi) * hardness * cap, 0.1 * prediction.plastic_work)
        << hardness;
    EXPECT_GT(prediction.contact_area, previous) << hardness;
    previous = prediction.contact_area;
  }
}

TEST(SphereOnFlat, neverRestsWhenFullyPlastic) {
  for (const double load : {0.0, 5e-5}) {
    Options options = contactOnly(load, 0.2);
    options.lower.hardness = 0.3e9;
    const double pitch = 5e-9;
    const Prediction prediction = AdhesionModel(options).predict(
        analytic::paraboloid(121, 120, pitch, pitch, 0.5e-6, 0.2 * pitch));
    EXPECT_EQ(prediction.status, Status::kNoEquilibrium) << load;
    EXPECT_EQ(prediction.plastic_count, 1);
    EXPECT_NEAR(prediction.contact_fraction, 0.5,
                0.01);  // where the search ends: a ring of pixels more
    const double cap = kPi * 0.5e-6 * prediction.approach * prediction.approach;
    EXPECT_NEAR(prediction.plastic_work, 0.3e9 * cap, 0.1 * prediction.plastic_work);
  }
}

TEST(SphereArray, ofTwoRadiiHasTheSumOfTheirPullOffs) {
  const double radii[] = {1e-6, 2e-6};
  const double pitch = 1.25e-9;
  const HeightMap surface =
      analytic::sphereArray(200, 200, pitch, pitch, {radii[0], radii[1], radii[1], radii[0]}, 2, 2);
  const Prediction prediction = AdhesionModel(silicon(4e-7)).predict(surface);
  EXPECT_EQ(prediction.status, Status::kEquilibrium);
  ASSERT_EQ(prediction.asperity_count, 4);
  const double sum = 1.5 * kPi * kWorkOfAdhesion * 2 * (radii[0] + radii[1]);
  EXPECT_NEAR(prediction.pull_off_force, sum, 0.03 * sum);
  EXPECT_EQ(prediction.van_der_waals_force, 0.0);
  double load = 0.0;
  double area = 0.0;
  for (const Asperity& asperity : prediction.asperities) {
    load += asperity.load;
    const double a = jkrRadius(asperity.load, asperity.composite_radius);
    area += kPi * a * a;
  }
  EXPECT_NEAR(load, 4e-7, 1e-12 * load);
  EXPECT_NEAR(prediction.contact_area_jkr, area, 1e-9 * area);
  // rc^2 = 2 R D for every sphere, and the caps' volume goes with R: the larger carry twice as much
  for (const Asperity& asperity : prediction.asperities) {
    EXPECT_NEAR(asperity.load / asperity.composite_radius, load / (2 * (radii[0] + radii[1])),
                0.06 * 4e-7 / 6e-6);
  }
}

TEST(SphereOnTiltedFlat, isPressedByTheLoadAlongItsAxis) {
  const double load = 1e-6;
  const double pitch = jkrRadius(load) / 25;
  const HeightMap plane =
      analytic::tiltedPlane(101, 110, pitch, pitch, std::tan(10 * kPi / 180), 0.0);
  const HeightMap sphere =
      analytic::sum(analytic::paraboloid(101, 110, pitch, pitch, kRadius), plane);
  const Prediction prediction = AdhesionModel(silicon(load)).predict({sphere, plane});
  EXPECT_EQ(prediction.status, Status::kEquilibrium);
  ASSERT_EQ(prediction.asperity_count, 1);
  const Asperity& asperity = prediction.asperities[0];
  EXPECT_NEAR(asperity.tilt * 180 / kPi, 10.0, 0.2);
  EXPECT_EQ(prediction.max_tilt, asperity.tilt);
  EXPECT_DOUBLE_EQ(asperity.load, load);
  const double a = jkrRadius(load * std::cos(asperity.tilt), asperity.composite_radius);
  EXPECT_NEAR(asperity.contact_radius, a, 1e-9 * a);
  EXPECT_NEAR(asperity.cap_radius, a, 0.03 * a);  // 25 pixels
}

}  // namespace
}  // namespace mems_stiction
