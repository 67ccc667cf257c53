/// From one patch to caps, regimes, energies and deformed surfaces: single equations of the model.

#include <cmath>

#include "mems_stiction/mechanics/plasticity.hpp"
#include "mems_stiction/paper/paper_options.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "paper/force_balance.hpp"
#include "paper/formulation_share.hpp"
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
constexpr double kHardness = 12e9;
constexpr double kModulus = closed_form::kPolysiliconModulus;
constexpr double kStiffness = 4.0 / 3.0 * kModulus;

/// All that one sphere at an imposed contact radius depends on.
AsperityLaw lawOf(Formulation formulation) {
  return {ContactPair(Material(), Material()), kWork, 0.0, formulation, Deformation::kThreeRegimes};
}

AsperityResponse sphereAt(double contact_radius, double elastic_share, Formulation formulation) {
  CapCouple caps;
  caps.cap_radius = contact_radius;
  caps.composite_radius = kRadius;
  caps.height = contact_radius * contact_radius / (2.0 * kRadius);
  AsperityResponse response(caps, lawOf(formulation));
  response.elastic_share = elastic_share;
  return response;
}

/// dE_t/dD along rc drc/dD = R by central differences of (8).
double slopeOfEnergy(double contact_radius, double elastic_share, double load,
                     Formulation formulation) {
  const double step = 1e-4 * contact_radius * contact_radius / kRadius;
  const auto energyAt = [&](double advance) {
    const double rc = std::sqrt(contact_radius * contact_radius + 2.0 * kRadius * advance);
    return asperityEnergies(sphereAt(rc, elastic_share, formulation), load, lawOf(formulation))
        .total();
  };
  return (energyAt(step) - energyAt(-step)) / (2.0 * step);
}

FormulationShare shareOf(double lower_hardness, double upper_hardness, Formulation formulation) {
  Material lower, upper;
  lower.hardness = lower_hardness;
  upper.hardness = upper_hardness;
  return {lower, upper, 0.9, formulation, Deformation::kThreeRegimes};
}

}  // namespace

Section capsSection() {
  // one raised pixel of height h on a flat, pitch p: the outline lies half a pixel out, at half the
  // height
  const double height = 6e-9, pitch = 10e-9;
  Options elastic = contactOnly(1e-9, kWork);
  elastic.deformation =
      Deformation::kElastic;  // so steep a pixel would flow and never come to rest
  const Prediction raised =
      AdhesionModel(elastic).predict(analytic::flatWithBump(20, 30, pitch, pitch, height));
  const double rc = 0.5 * pitch, cap = 0.5 * height;
  const double radius = (rc * rc + cap * cap) / (2.0 * cap);
  Section section{"Caps and single figures", {}};
  if (raised.asperities.size() != 1) {
    section.rows.push_back(always("one raised pixel is one contact", "put in", 1, "a count"));
    return section;
  }
  section.rows = {
      exact("base radius of one raised pixel of 10 nm", "m",
            "(Lx + Ly)/4, outline at half the height", raised.asperities[0].cap_radius, rc),
      exact("its cap radius at a height of 6 nm", "m", "circle through rim, summit, rim",
            raised.asperities[0].composite_radius, radius),
      exact("(11), its pull-off force", "N", "3/2 pi w R", raised.pull_off_force,
            1.5 * closed_form::kPi * kWork * radius),
  };
  const double strain = kWork / (kModulus * 0.2e-9);
  const double tabor = std::pow(radius / 0.2e-9 * strain * strain, 1.0 / 3.0);
  const double lambda =
      32.0 / (9.0 * std::sqrt(3.0)) * std::pow(9.0 / (16.0 * closed_form::kPi), 1.0 / 3.0) * tabor;
  const double x = 4.04 * std::pow(lambda, 1.4);
  section.rows.push_back(
      exact("its pull-off force by the transition", "N", "the fit at its own Tabor parameter",
            raised.pull_off_force_transition,
            (1.75 - 0.25 * (x - 1.0) / (x + 1.0)) * closed_form::kPi * kWork * radius));
  // (14) of a paraboloid: sigma from the spread of squares of equidistant points, n^2 -> (n^2 -
  // 1)(n^2 - 4)/180
  const int n = 101;
  const double step = 1e-9;
  const double sigma =
      std::sqrt(2.0 * std::pow(step, 4) * (n * n - 1.0) * (n * n - 4.0) / 180.0) / (2.0 * kRadius);
  const Prediction sphere = AdhesionModel(contactOnly(0.0, kWork))
                                .predict(analytic::paraboloid(n, n, step, step, kRadius));
  section.rows.push_back(exact("rms height of a paraboloid", "m",
                               "variance of squares of equidistant points",
                               sphere.composite_rms_height, sigma));
  section.rows.push_back(
      near("(14), adhesion parameter of a sphere of 2 um", "", "(E/w) sqrt(sigma^3/R)",
           sphere.adhesion_parameter, kModulus / kWork * std::sqrt(sigma * sigma * sigma / kRadius),
           5e-4, "half of that of R, whose outline of 30 pixels is known to 0.03 of one"));
  Options crushed = contactOnly(0.1, kWork);
  crushed.approach.max_steps = 3;
  section.rows.push_back(exact(
      "(1), approach after three automatic steps", "m", "3 sigma/50",
      AdhesionModel(crushed).predict(analytic::paraboloid(n, n, step, step, kRadius)).approach,
      3.0 * sigma / 50));
  return section;
}

Section plasticitySection() {
  Section section{"Plasticity", {}};
  section.rows = {
      exact("(9), E/Ha sqrt(3 nm/300 nm)", "", "by hand: 88.7978/12 times 0.1",
            plasticityIndex(88.7978e9, 12e9, 3e-9, 300e-9), 88.7978 / 12.0 * 0.1),
      exact("chi at phi = 0.85", "", "(10.2)", regimeFactor(0.85), 0.5),
      exact("chi at phi = 0.6", "", "(10.2)", regimeFactor(0.6), 1.0),
      near("chi at phi = 1.1", "", "(10.2)", regimeFactor(1.1), 0.0, kRoundOff, kRoundOffReason),
  };
  // half elastic by (9) with the rms height of a frame of four contact radii: r = 0 is
  // chi P1^2 - 2 b P1 + (2 - chi) P0^2 = 0 with b = P0 + 3 pi w R
  const double load = 5e-5, hardness = 6.8e9, work = 0.2, radius = 2e-6;
  const auto chiOf = [=](const Prediction& found) {
    return 1.0 - 2.0 * (kModulus / hardness * std::sqrt(found.composite_rms_height / radius) - 0.6);
  };
  const auto restOf = [=](double chi) {
    const double b = load + 3.0 * closed_form::kPi * work * radius;
    return std::cbrt(radius / kStiffness *
                     (b + std::sqrt(b * b - chi * (2.0 - chi) * load * load)) / chi);
  };
  const double a = restOf(0.5);
  const auto predict = [=](double pixels, double step, const Phase& phase) {
    Options options = contactOnly(load, work);
    options.lower.hardness = hardness;
    options.solver.of<PaperOptions>().step = step;
    return AdhesionModel(options).predict(
        sphereOn({"", 4, 4, 0, 1.0, phase.x, phase.y}, radius, a, pixels));
  };
  const std::vector<Row> area_row =
      onGrids({limit("contact area of an elasto-plastic sphere over that where r = 0", "",
                     "(10.2), by hand", 1.0, 2e-3,
                     "twice that of a radius known to a tenth of a pixel of 100",
                     {1.2, "a rim of pixels: between first and second order"})},
              {"pixels per contact radius", {12.5, 25, 50, 100}},
              [&](double pixels, const Phase& phase) -> std::vector<double> {
                const Prediction found = predict(pixels, 0.0, phase);
                const double rest = restOf(chiOf(found));
                return {found.elasto_plastic_count == 1
                            ? found.contact_area / (closed_form::kPi * rest * rest)
                            : 0.0};
              });
  const std::vector<Row> work_row =
      onGrids({limit("work of flow over (1 - chi) Ha times the cap's volume", "",
                     "pi D^2 (R - D/3) of a sphere", 1.0, 5e-3,
                     "a step of 320, and the outline's tenth of a pixel of 60",
                     {0.9, "rectangles, a step wide"})},
              {"steps until equilibrium", {40, 80, 160, 320}, 2},
              [&](double steps, const Phase& phase) -> std::vector<double> {
                const Prediction found = predict(60, 0.5 * a * a / radius / steps, phase);
                const double depth = found.approach;
                const double cap = closed_form::kPi * depth * depth * (radius - depth / 3.0);
                return {found.plastic_work / ((1.0 - chiOf(found)) * hardness * cap)};
              });
  section.rows.push_back(area_row[0]);
  section.rows.push_back(work_row[0]);
  int at_rest = 0;
  for (const double soft : {0.05e9, 0.3e9, 1e9}) {
    Options options = contactOnly(load, work);
    options.lower.hardness = soft;
    const Prediction found =
        AdhesionModel(options).predict(sphereOn({"", 4, 4, 0, 1.0, 0.5, 0.5}, radius, a, 25));
    if (found.status != Status::kNoEquilibrium || found.plastic_count != 1) ++at_rest;
  }
  section.rows.push_back(always("a fully plastic sphere does not come to rest",
                                "(10.2): nothing resists", at_rest,
                                "holds for each of 3 hardnesses"));
  return section;
}

Section equilibriumSection() {
  const closed_form::MaugisUnits units{kRadius, kWork, kModulus};
  const double load = 3.0 * units.force();
  const double a = closed_form::jkrContactRadius(load, kRadius, kWork, kModulus);
  const double in_units = a / units.length();
  const double energy_unit = units.force() * units.approach();
  const AsperityLaw law = lawOf(Formulation::kPaper);
  const AsperityResponse sphere = sphereAt(a, 1.0, Formulation::kPaper);
  const Energies energies = asperityEnergies(sphere, load, law);
  const double surface = in_units * in_units;  // in energy units: pi w a^2
  Section section{"Energies and equilibrium of one asperity", {}};
  section.rows = {
      exact("(10.1), mechanical energy at equilibrium, 3 pi w R", "J", "load times JKR's approach",
            energies.mechanical, 3.0 * closed_form::jkrApproach(in_units) * energy_unit),
      exact("(10.1), surface energy", "J", "pi w a^2", energies.surface, surface * energy_unit),
      exact("(10.2), elastic energy", "J", "JKR's work and surface energy, by hand",
            energies.elastic, (closed_form::jkrWork(in_units) + surface) * energy_unit),
      exact("(10.2) at chi = 0.25", "J", "a quarter of it",
            asperityEnergies(sphereAt(a, 0.25, Formulation::kPaper), load, law).elastic,
            0.25 * (closed_form::jkrWork(in_units) + surface) * energy_unit),
      near("generalised force where (7) holds", "pi w R", "0",
           sphere.generalizedForce(load, law) / units.force(), 0.0, 1e-11,
           "round-off of terms of 10"),
      exact("load that a sphere carries", "N", "K a^3/R", sphere.carriedLoad(),
            kStiffness * a * a * a / kRadius),
  };
  const struct {
    const char* name;
    double share;
    Formulation formulation;
  } slopes[] = {{"dE_t/dD, elastic, off equilibrium", 1.0, Formulation::kPaper},
                {"dE_t/dD, chi = 0.4", 0.4, Formulation::kPaper},
                {"dE_t/dD, chi = 0", 0.0, Formulation::kPaper},
                {"dE_t/dD as printed, chi = 1", 1.0, Formulation::kPrinted},
                {"dE_t/dD as printed, chi = 0.4", 0.4, Formulation::kPrinted}};
  for (const auto& slope : slopes) {
    const double rc = 0.8 * a;
    const double force = sphereAt(rc, slope.share, slope.formulation)
                             .generalizedForce(load, lawOf(slope.formulation));
    section.rows.push_back(
        near(slope.name, "pi w R", "central difference of (8)", force / units.force(),
             slopeOfEnergy(rc, slope.share, load, slope.formulation) / units.force(), 1e-6,
             "a step of 1e-4: its square"));
  }
  // yielding, chi = 0.8: (10.2) to the letter and the load carried, from areas and pressures
  for (const bool is_deep : {false, true}) {
    const double rc = is_deep ? 1.8e-6 : 0.9e-6;
    const double imposed = kStiffness * rc * rc * rc / kRadius;
    const double yield = kHardness * closed_form::kPi * rc * rc;
    const double axial = 0.2 * imposed;
    const AsperityResponse mixed = sphereAt(rc, 0.8, Formulation::kPaper);
    const std::string depth = is_deep ? " deep in flow" : " in early flow";
    // P0 = 0.2 P1: 2 P0 - 2 P0^2/P1 = 0.32 P1, P1 - P0^2/P1 = 0.96 P1
    section.rows.push_back(exact("generalised force" + depth + ", chi = 0.8", "N",
                                 "(0.32 - 0.8 0.96) P1/3 + 2 pi w R",
                                 mixed.generalizedForce(axial, law),
                                 (0.32 - 0.8 * 0.96) * imposed / 3.0 + 2.0 * units.force()));
    section.rows.push_back(exact("load carried" + depth + ", chi = 0.8", "N",
                                 "0.8 P1 + 0.2 Ha pi rc^2", mixed.carriedLoad(),
                                 0.8 * imposed + 0.2 * yield));
  }
  // under P1/3 a half elastic asperity rests without adhesion, as Hertz does under P1
  AsperityLaw dry = law;
  dry.work_of_adhesion = 0.0;
  section.rows.push_back(
      near("generalised force under P1/3, chi = 0.5, no adhesion", "P1", "P1 = (2 - chi)/chi P0",
           sphereAt(a, 0.5, Formulation::kPaper).generalizedForce(sphere.imposed_load / 3.0, dry) /
               sphere.imposed_load,
           0.0, kRoundOff, kRoundOffReason));
  return section;
}

Section deformedSurfacesSection() {
  const double log_ratio = std::log(1.05) / std::log(1.0 / 0.9);
  const FormulationShare softer = shareOf(10e9, 10.5e9, Formulation::kPaper);
  Section section{"Surfaces after contact", {}};
  section.rows = {
      exact("share of the lower body, equal hardness", "", "1/2",
            shareOf(12e9, 12e9, Formulation::kPaper).lower(2.0), 0.5),
      exact("share of the lower body, 5 % softer", "", "1/2 + ln(1.05)/(2 |ln 0.9|)",
            softer.lower(2.0), 0.5 + 0.5 * log_ratio),
      exact("share of the upper body, same", "", "the rest", softer.upper(2.0),
            0.5 - 0.5 * log_ratio),
      exact("(13), share of the lower body, 12 times softer", "", "1",
            shareOf(1e9, 12e9, Formulation::kPaper).lower(2.0), 1.0),
      near("(13), share of the lower body, 12 times harder", "", "0",
           shareOf(12e9, 1e9, Formulation::kPaper).lower(2.0), 0.0, kRoundOff, kRoundOffReason),
      exact("share at phi = 0.8, 5 % softer", "", "2 (0.8 - 0.6) of it", softer.lower(0.8),
            0.4 * (0.5 + 0.5 * log_ratio)),
      near("share at phi = 0.6", "", "0", softer.lower(0.6), 0.0, kRoundOff, kRoundOffReason),
      exact("(12) as printed, 5 % softer", "", "1/2 + 1/(4 (1 + ln(1.05)/|ln 0.9|))",
            shareOf(10e9, 10.5e9, Formulation::kPrinted).lower(2.0),
            0.5 + 0.25 / (1.0 + log_ratio)),
  };
  // a soft sphere pressed into a flat, as far as the search goes: the cap it loses
  Options options = contactOnly(2e-6, kWork);
  options.lower.hardness = 0.3e9;
  const double pitch = 1e-9;
  const HeightMap sphere = analytic::paraboloid(301, 301, pitch, pitch, 0.5e-6);
  const Prediction found = AdhesionModel(options).predict(sphere);
  double lost = 0.0, above = 0.0;
  for (int row = 0; row < sphere.rows(); ++row) {
    for (int col = 0; col < sphere.cols(); ++col) {
      lost += sphere.height(row, col) - found.deformed_lower.at<double>(row, col);
      above += std::fmax(0.0, sphere.height(row, col) + found.approach);
    }
  }
  section.rows.push_back(near("volume that a soft sphere loses to a hard flat", "m^3",
                              "its pixels above the plane", lost * pitch * pitch,
                              above * pitch * pitch, 1e-9, "sums over the contact"));
  section.rows.push_back(near("the same", "m^3", "cap of a paraboloid: pi R D^2",
                              lost * pitch * pitch,
                              closed_form::kPi * 0.5e-6 * found.approach * found.approach, 0.01,
                              "a rim of pixels, each with a share of a pixel's height"));
  return section;
}

}  // namespace verification
}  // namespace mems_stiction
