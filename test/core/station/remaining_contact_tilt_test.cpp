/// A contact that leans is held by the load along its axis.

#include <cmath>

#include <gtest/gtest.h>

#include "mechanics/jkr.hpp"
#include "numeric/constants.hpp"
#include "station/remaining_contact.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sphere_contact.hpp"

namespace mems_stiction {
namespace {

TEST(RemainingContact, onASlopeFollowsJkrOfTheLoadAlongItsAxis) {
  constexpr double kWork = 0.05;
  const double pitch = 1.5e-9;
  const HeightMap plane = analytic::tiltedPlane(101, 110, pitch, pitch, std::tan(0.5), 0.0);
  const HeightMap sphere = analytic::sum(analytic::paraboloid(101, 110, pitch, pitch, 2e-6), plane);
  Options options = contactOnly(0.0, kWork);
  options.deformation = Deformation::kElastic;
  RemainingContact remaining(options, {sphere, plane});
  remaining.advance(0.0, 1e-5);
  const RemainingState released = remaining.advance(0.0, 1e-6);
  ASSERT_FALSE(released.is_searched);
  ASSERT_EQ(remaining.contact().asperities.size(), 1u);
  const Asperity& asperity = remaining.contact().asperities[0];
  const double modulus = ContactPair(Material(), Material()).contact_modulus;
  // cos(0.5) = 0.878; the tilt is measured within 0.2 degrees
  const double a = jkr::equilibriumContactRadius(1e-6 * std::cos(0.5), kWork,
                                                 asperity.composite_radius, modulus);
  EXPECT_NEAR(released.contact_area_jkr, kPi * a * a, 2e-3 * kPi * a * a);
  EXPECT_NEAR(asperity.tilt, 0.5, 0.0035);
}

}  // namespace
}  // namespace mems_stiction
