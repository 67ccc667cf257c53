/// The whole model on one sphere, two spheres and many: where theory is closed and only the grid
/// stands between.

#include <cmath>
#include <cstdio>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/sphere_contact.hpp"
#include "verification/closed_forms.hpp"
#include "verification/grid_convergence.hpp"
#include "verification/sections.hpp"

namespace mems_stiction {
namespace verification {
namespace {

constexpr double kRadius = 2e-6;
constexpr double kWork = 50e-3;
constexpr double kModulus = closed_form::kPolysiliconModulus;
constexpr const char* kJkr = "JKR, solved by bisection";
constexpr const char* kPixels = "pixels per contact radius";

/// Figures of the caps: summit and outline are interpolated.
const Order& ofCaps() {
  static const Order order{1.7, "outline and heights are interpolated linearly: second order"};
  return order;
}
/// Figures that count cells or end with one.
const Order& ofRims() {
  static const Order order{
      1.2, "a rim of pixels, evened out around the circle: between first and second order"};
  return order;
}
constexpr const char* kTenth = "the outline of 100 pixels is known to a tenth of one";
constexpr const char* kTwoTenths = "twice that of a radius known to a tenth of a pixel of 100";

double circle(double radius) { return closed_form::kPi * radius * radius; }

SphereGrid gridAt(const Phase& phase) { return {"", 4, 4, 0, 1.0, phase.x, phase.y}; }

std::string withLoad(const char* quantity, double load) {
  char text[96];
  std::snprintf(text, sizeof text, "%s at %g N", quantity, load);
  return text;
}

std::vector<Row> jkrRows(double load) {
  const double a = closed_form::jkrContactRadius(load, kRadius, kWork, kModulus);
  const closed_form::MaugisUnits units{kRadius, kWork, kModulus};
  const double in_units = a / units.length();
  const double energy_unit = units.force() * units.approach();
  const double mechanical = load / units.force() * closed_form::jkrApproach(in_units) * energy_unit;
  const double work = closed_form::jkrWork(in_units) * energy_unit;
  const std::vector<Row> rows = {
      limit(withLoad("contact area by JKR", load), "m^2", kJkr, circle(a), 1e-3, kTenth, ofCaps()),
      limit(withLoad("patch radius", load), "m", kJkr, a, 1e-3, kTenth, ofRims()),
      limit(withLoad("pull-off force", load), "N", "3/2 pi w R", 1.5 * units.force(), 1e-3, kTenth,
            ofCaps()),
      limit(withLoad("area of the contact cells", load), "m^2", kJkr, circle(a), 2e-3, kTwoTenths,
            ofRims()),
      limit(withLoad("(8), total energy", load), "J", "load times approach less the work of JKR",
            mechanical - work, 2e-3, kTwoTenths, ofCaps())};
  return onGrids(rows, {kPixels, {12.5, 25, 50, 100}},
                 [=](double pixels, const Phase& phase) -> std::vector<double> {
                   const Prediction found =
                       AdhesionModel(contactOnly(load, kWork))
                           .predict(sphereOn(gridAt(phase), kRadius, a, pixels));
                   if (found.status != Status::kEquilibrium || found.asperity_count != 1) return {};
                   return {found.contact_area_jkr, found.asperities[0].cap_radius,
                           found.pull_off_force, found.contact_area, found.total_energy};
                 });
}

std::vector<Row> hertzRows(double load) {
  const double a = std::cbrt(0.75 * load * kRadius / kModulus);
  return onGrids({limit(withLoad("without adhesion: contact area by JKR", load), "m^2", "Hertz",
                        circle(a), 1e-3, kTenth, ofCaps()),
                  limit(withLoad("without adhesion: area of the cells", load), "m^2", "Hertz",
                        circle(a), 2e-3, kTwoTenths, ofRims())},
                 {kPixels, {12.5, 25, 50, 100}},
                 [=](double pixels, const Phase& phase) -> std::vector<double> {
                   const Prediction found =
                       AdhesionModel(contactOnly(load, 0.0))
                           .predict(sphereOn(gridAt(phase), kRadius, a, pixels));
                   if (found.status != Status::kEquilibrium || found.pull_off_force != 0.0)
                     return {};
                   return {found.contact_area_jkr, found.contact_area};
                 });
}

std::vector<Row> twoSphereRows() {
  const double load = 1e-6;
  const double composite = 1.0 / (1.0 / 2e-6 + 1.0 / 3e-6);
  const double a = closed_form::jkrContactRadius(load, composite, kWork, kModulus);
  const std::vector<Row> rows = {
      limit("(5), radius of 2 um on 3 um", "m", "1/(1/2 um + 1/3 um)", composite, 1e-3, kTenth,
            ofCaps()),
      limit("contact area of these", "m^2", kJkr, circle(a), 1e-3, kTenth, ofCaps())};
  return onGrids(rows, {kPixels, {12.5, 25, 50, 100}},
                 [=](double pixels, const Phase& phase) -> std::vector<double> {
                   const HeightMap lower = sphereOn(gridAt(phase), 2e-6, a, pixels);
                   const cv::Mat1d turned = -sphereOn(gridAt(phase), 3e-6, a, pixels).heights();
                   const Prediction found =
                       AdhesionModel(contactOnly(load, kWork))
                           .predict({lower, HeightMap(turned, lower.pitchX(), lower.pitchY())});
                   if (found.asperity_count != 1) return {};
                   return {found.asperities[0].composite_radius, found.contact_area_jkr};
                 });
}

std::vector<Row> tiltRows() {
  const double load = 1e-6;
  const double tilt = 10.0 * closed_form::kPi / 180.0;
  const double a = closed_form::jkrContactRadius(load * std::cos(tilt), kRadius, kWork, kModulus);
  const std::vector<Row> rows = {limit("tilt of a sphere on a slope of 10 degrees", "degrees",
                                       "put in", 10.0, 1e-3, kTenth, ofRims()),
                                 limit("its contact area, pressed by F cos(tilt)", "m^2", kJkr,
                                       circle(a), 1e-3, kTenth, ofCaps())};
  return onGrids(
      rows, {kPixels, {12.5, 25, 50, 100}},
      [=](double pixels, const Phase& phase) -> std::vector<double> {
        const HeightMap sphere = sphereOn(gridAt(phase), kRadius, a, pixels);
        const HeightMap plane = analytic::tiltedPlane(sphere.rows(), sphere.cols(), sphere.pitchX(),
                                                      sphere.pitchY(), std::tan(tilt), 0.0);
        const Prediction found =
            AdhesionModel(contactOnly(load, kWork)).predict({analytic::sum(sphere, plane), plane});
        if (found.asperity_count != 1) return {};
        return {found.asperities[0].tilt * 180.0 / closed_form::kPi, found.contact_area_jkr};
      });
}

std::vector<Row> arrayRows() {
  const double load = 1e-6;
  const double a = closed_form::jkrContactRadius(load, kRadius, kWork, kModulus);
  const double pitch = a / 25;
  const auto predictArray = [&](int count_x, int count_y, double total_load) {
    return AdhesionModel(contactOnly(total_load, kWork))
        .predict(analytic::sphereArray(90 * count_y, 96 * count_x, pitch, pitch, {kRadius}, count_x,
                                       count_y));
  };
  const Prediction one = predictArray(1, 1, load);
  const Prediction twelve = predictArray(4, 3, 12 * load);
  const char* why = "the same cells in each tile; sums of twelve";
  return {near("pull-off of 12 spheres over that of one", "", "12",
               twelve.pull_off_force / one.pull_off_force, 12.0, 1e-9, why),
          near("contact area by JKR of 12 spheres over that of one", "", "12",
               twelve.contact_area_jkr / one.contact_area_jkr, 12.0, 1e-9, why),
          near("approach of 12 spheres over that of one", "", "1", twelve.approach / one.approach,
               1.0, 1e-9, why),
          near("contact cells of 12 spheres over those of one", "", "12",
               twelve.contact_area / one.contact_area, 12.0, 1e-9, why),
          near("energy of 12 spheres over that of one", "", "12",
               twelve.total_energy / one.total_energy, 12.0, 1e-9, why),
          near("contacts of 12 spheres in equilibrium", "", "12",
               twelve.status == Status::kEquilibrium ? twelve.asperity_count : 0, 12.0, 1e-9, why)};
}

/// Spheres of R and 2 R at the same depth: rc^2 is about 2 R D, so volumes, and with them loads, go
/// with R.
std::vector<Row> twoRadiiRows() {
  const double small_radius = 1e-6, large_radius = 2e-6, load = 4e-7;
  const double a = closed_form::jkrContactRadius(load, large_radius, kWork, kModulus);
  const std::vector<Row> rows = {
      limit("pull-off of spheres of 1 um and 2 um", "N", "3/2 pi w sum R",
            1.5 * closed_form::kPi * kWork * (small_radius + large_radius), 1e-3, kTenth, ofCaps()),
      limit("(6), load of the larger over that of the smaller", "", "R2/R1 at one depth",
            large_radius / small_radius, 4e-3,
            "four times that of radii known to a tenth of a pixel of 100", ofRims())};
  return onGrids(rows, {kPixels, {12.5, 25, 50, 100}},
                 [=](double pixels, const Phase& phase) -> std::vector<double> {
                   const HeightMap small = sphereOn(gridAt(phase), small_radius, a, pixels);
                   const HeightMap large = sphereOn(gridAt(phase), large_radius, a, pixels);
                   cv::Mat both;
                   cv::hconcat(small.heights(), large.heights(), both);
                   const Prediction found =
                       AdhesionModel(contactOnly(load, kWork))
                           .predict(HeightMap(both, small.pitchX(), small.pitchY()));
                   if (found.asperity_count != 2) return {};
                   const auto loadBeside = [&](bool is_large) {
                     const Asperity& first = found.asperities[0];
                     const bool takes_first = (first.composite_radius > 1.5e-6) == is_large;
                     return takes_first ? first.load : found.asperities[1].load;
                   };
                   return {found.pull_off_force, loadBeside(true) / loadBeside(false)};
                 });
}

}  // namespace

Section sphereOnFlatSection() {
  Section section{"Spheres of 2 um, by the whole model", {}};
  const auto append = [&section](const std::vector<Row>& rows) {
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  };
  for (const double load : {0.0, 1e-7, 1e-6, 1e-5}) append(jkrRows(load));
  for (const double load : {1e-7, 1e-5}) append(hertzRows(load));
  append(twoSphereRows());
  append(tiltRows());
  append(arrayRows());
  append(twoRadiiRows());
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
