#pragma once

/// @file
/// The figures of a Prediction: name, unit, what it is, and the member that holds it. Nothing else
/// lists them: records, rows, messages (each field of msg/StictionPrediction.msg by its name) and
/// the attributes of Python come from here.
///
///     visitPredictionFields(prediction, [&](const Figure& figure, const auto& value) {
///         print(figure.name, value); });
///
/// Values are double, int, bool, Status, Regime, BondingRegime and ContactTheory; word() makes
/// words of the enumerations.

#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// @param roughness ArealParameters, const or not
/// @param visit called with (Figure, value) for each
template <typename Parameters, typename Visitor>
void visitRoughnessFields(Parameters& roughness, Visitor&& visit) {
  visit({"sa", "m", "arithmetical mean height"}, roughness.sa);
  visit({"sq", "m", "root mean square height"}, roughness.sq);
  visit({"ssk", "", "skewness"}, roughness.ssk);
  visit({"sku", "", "kurtosis; 3 for a Gaussian surface"}, roughness.sku);
  visit({"sp", "m", "maximum peak height"}, roughness.sp);
  visit({"sv", "m", "maximum pit depth, positive"}, roughness.sv);
  visit({"sz", "m", "maximum height, sp + sv"}, roughness.sz);
  visit({"sdq", "", "root mean square gradient"}, roughness.sdq);
  visit({"sdr", "", "developed interfacial area ratio"}, roughness.sdr);
}

/// @param roughness SpatialRoughness, const or not
/// @param visit called with (Figure, value) for each
template <typename Parameters, typename Visitor>
void visitSpatialRoughnessFields(Parameters& roughness, Visitor&& visit) {
  visit({"sal", "m", "autocorrelation length, to 0.2"}, roughness.sal);
  visit({"str", "", "texture aspect ratio: near 1 isotropic, near 0 a lay"}, roughness.str);
  visit({"m0", "m^2", "mean squared height of a profile, averaged over its directions"},
        roughness.m0);
  visit({"m2", "", "mean squared slope of a profile"}, roughness.m2);
  visit({"m4", "1/m^2", "mean squared curvature of a profile"}, roughness.m4);
  visit({"nayak", "", "Nayak's parameter, m0 m4/m2^2"}, roughness.nayak);
  visit({"summit_density", "1/m^2", "summits per area"}, roughness.summit_density);
  visit({"mean_summit_radius", "m", "1/mean curvature of the summits"},
        roughness.mean_summit_radius);
  visit({"hurst", "", "exponent of the self-affine range"}, roughness.hurst);
}

/// Every scalar of the prediction; the roughness figures have visitRoughnessFields() and
/// visitSpatialRoughnessFields().
/// @param prediction Prediction, const or not
/// @param visit called with (Figure, value) for each
template <typename PredictionType, typename Visitor>
void visitPredictionFields(PredictionType& prediction, Visitor&& visit) {
  visit({"status", "", "EQUILIBRIUM, BONDED or NO_EQUILIBRIUM (then do not use the forces)"},
        prediction.status);
  visit({"steps", "", "of the approach that were taken"}, prediction.steps);

  visit({"voltage", "V", "across the interface"}, prediction.voltage);
  visit({"mechanical_load", "N", "pressing, on the scanned area"}, prediction.mechanical_load);
  visit({"van_der_waals_force", "N", "attraction of the cells out of contact (2)"},
        prediction.van_der_waals_force);
  visit({"electrostatic_force", "N", "attraction by voltage and contact potential (3)"},
        prediction.electrostatic_force);
  visit({"normal_load", "N", "mechanical, van der Waals, electrostatic, capillary together"},
        prediction.normal_load);
  visit({"capillary_force", "N", "of condensed water, part of normal_load; 0 when off"},
        prediction.capillary_force);

  visit({"pull_off_force", "N",
         "largest while the surfaces are drawn apart, after voltage and load have gone; (11) of "
         "the paper"},
        prediction.pull_off_force);
  visit({"pull_off_force_jkr", "N", "(3/2) pi Gamma times the sum of the composite radii"},
        prediction.pull_off_force_jkr);
  visit({"pull_off_force_transition", "N",
         "the same sum with the prefactor of the JKR-DMT transition for each contact"},
        prediction.pull_off_force_transition);

  visit({"contact_area", "m^2",
         "real area of contact; of the paper's formulations all cells that overlap"},
        prediction.contact_area);
  visit({"contact_area_jkr", "m^2", "sum of the JKR contacts"}, prediction.contact_area_jkr);
  visit({"nominal_area", "m^2", "valid cells of the scan"}, prediction.nominal_area);
  visit({"contact_fraction", "", "contact_area/nominal_area"}, prediction.contact_fraction);
  visit({"approach", "m", "of the surfaces from first touch"}, prediction.approach);
  visit({"mean_gap", "m", "over the cells out of contact"}, prediction.mean_gap);

  visit({"mechanical_energy", "J", "of the load (10.1)"}, prediction.mechanical_energy);
  visit({"surface_energy", "J", "of the surfaces that touch (10.1)"}, prediction.surface_energy);
  visit({"elastic_energy", "J", "stored in the bodies (10.2)"}, prediction.elastic_energy);
  visit({"total_energy", "J", "mechanical + surface - elastic (8)"}, prediction.total_energy);
  visit({"plastic_work", "J", "dissipated in flow along the approach"}, prediction.plastic_work);
  visit({"bonding_energy", "J/m^2", "total_energy/nominal_area"}, prediction.bonding_energy);
  visit({"normalized_bonding_energy", "", "bonding_energy/work of adhesion; NaN when that is 0"},
        prediction.normalized_bonding_energy);

  visit({"apparent_work_of_adhesion", "J/m^2", "of drawing the surfaces apart, per nominal area"},
        prediction.apparent_work_of_adhesion);
  visit({"contact_stiffness", "N/m", "-dF/dD at rest"}, prediction.contact_stiffness);
  visit({"flattening_energy", "J/m^2", "that pressing the surfaces flat would store, per area"},
        prediction.flattening_energy);
  visit({"flattening_ratio", "", "flattening_energy over what adhesion and water give"},
        prediction.flattening_ratio);
  visit({"adhesion_exponent", "", "d ln(pull_off_force)/d ln(work of adhesion)"},
        prediction.pull_off_exponents.adhesion);
  visit({"modulus_exponent", "", "d ln(pull_off_force)/d ln(contact modulus)"},
        prediction.pull_off_exponents.modulus);
  visit({"is_conforming", "",
         "flattening costs less than adhesion gives: flat against each other nearly everywhere"},
        prediction.is_conforming);
  visit({"adhesion_parameter", "",
         "mean of (E/Gamma) sqrt(sigma^3/R) (14); infinite when Gamma is 0"},
        prediction.adhesion_parameter);
  visit({"bonding_regime", "",
         "BONDING, ADHERENCE, NON_BONDING or UNKNOWN by the adhesion parameter (Gui et al. 1999)"},
        prediction.bonding_regime);
  visit({"asperity_count", "", "contacts at rest"}, prediction.asperity_count);
  visit({"elastic_count", "", "of them elastic"}, prediction.elastic_count);
  visit({"elasto_plastic_count", "", "of them elasto-plastic"}, prediction.elasto_plastic_count);
  visit({"plastic_count", "", "of them fully plastic"}, prediction.plastic_count);
  visit({"max_tilt", "rad", "largest tilt of a contact"}, prediction.max_tilt);
  visit({"median_tabor_parameter", "",
         "of the contacts; infinite when adhesion has no range, NaN without contact"},
        prediction.median_tabor_parameter);
  visit({"contact_theory", "",
         "DMT, TRANSITION, JKR or UNKNOWN by the median Tabor parameter (Johnson and Greenwood "
         "1997)"},
        prediction.contact_theory);

  visit({"composite_rms_height", "m", "sqrt(sigma1^2 + sigma2^2) (9)"},
        prediction.composite_rms_height);
  visit({"rms_height", "m", "of the scanned surface"}, prediction.rms_height);
  visit({"invalid_fraction", "", "share of pixels that are invalid in either surface"},
        prediction.invalid_fraction);
  visit({"processing_time", "s", "wall time of this prediction"}, prediction.processing_time);

  visit({"median_contact_pixels", "",
         "pixels of the scan in half of the contacts or fewer; NaN without contact"},
        prediction.median_contact_pixels);
  visit({"median_composite_radius", "m", "median of the composite radii; NaN without contact"},
        prediction.median_composite_radius);
  visit(
      {"is_resolution_limited", "", "median_contact_pixels is below resolution/min_contact_pixels"},
      prediction.is_resolution_limited);
  visit({"is_tip_limited", "",
         "the tip is blunter than the contacts: its radius exceeds median_composite_radius"},
        prediction.is_tip_limited);
  visit({"tip_limit", "m",
         "shorter waves of the scan, and contacts of a smaller diameter, are drawn by the tip: "
         "over this length the "
         "sharpest "
         "summit has half of its curvature; 0 none, NaN where no tip is stated"},
        prediction.tip_limit);
  visit({"below_tip_count", "",
         "contacts at the pull-off that are smaller than tip_limit; -1 not known"},
        prediction.below_tip_count);
  visit({"pull_off_contact_count", "",
         "contacts that hold at the pull-off, on which flags and verdict rest; -1 not known"},
        prediction.pull_off_contact_count);
  visit({"unresolved_height", "m",
         "rms height of the waves that pixels or tip do not show, continued from those that they "
         "do; NaN not known"},
        prediction.short_waves.waves.rms_height);
  visit({"unresolved_limit", "m",
         "of it, above which the scan does not show what holds: what adhesion bridges"},
        prediction.short_waves.limit);
  visit(
      {"needed_pitch", "m", "pixels of a scan that would show what holds; NaN where this one does"},
      prediction.short_waves.needed_pitch);
  visit({"is_lower_bound", "",
         "pull_off_force is a lower bound: the search ended before the contacts stopped growing"},
        prediction.isLowerBound());
}

/// The figures of one contact.
template <typename Contact, typename Visitor>
void visitAsperityFields(Contact& asperity, Visitor&& visit) {
  visit({"x", "m", "centre, column times pitch_x"}, asperity.x);
  visit({"y", "m", "centre, row times pitch_y"}, asperity.y);
  visit({"z", "m", "height of the scanned surface at the centre"}, asperity.z);
  visit({"cap_radius", "m",
         "of a disc as large as the overlap; paper, printed: of the base of the caps"},
        asperity.cap_radius);
  visit({"composite_radius", "m", "of the gap; paper, printed: of the couple (5)"},
        asperity.composite_radius);
  visit({"load", "N", "share of the normal load (6)"}, asperity.load);
  visit(
      {"contact_radius", "m", "of a disc of the real area; paper, printed: of the JKR contact (7)"},
      asperity.contact_radius);
  visit({"tilt", "rad", "of the plane of contact to the horizontal; separation_curve: NaN"},
        asperity.tilt);
  visit({"plasticity_index", "", "(E/Ha) sqrt(sigma/R) (9)"}, asperity.plasticity_index);
  visit({"tabor_parameter", "", "JKR holds for values well above 1, DMT well below"},
        asperity.tabor_parameter);
  visit({"area", "m^2", "real; paper, printed: of the cells in contact"}, asperity.area);
  visit({"is_at_border", "", "reaches the frame's border: its summit may lie outside"},
        asperity.is_at_border);
  visit({"regime", "", "1 elastic, 2 elasto-plastic, 3 plastic"}, asperity.regime);
}

/// The figures of one point of the energy curve.
template <typename Point, typename Visitor>
void visitEnergyPointFields(Point& point, Visitor&& visit) {
  visit({"approach", "m", "of the surfaces from first touch"}, point.approach);
  visit({"contact_fraction", "", "contact_area/nominal_area"}, point.contact_fraction);
  visit({"normal_load", "N", "mechanical, van der Waals, electrostatic, capillary together"},
        point.normal_load);
  visit({"carried_load", "N", "what the contacts can carry"}, point.carried_load);
  visit({"generalized_force", "N", "dE_t/dD"}, point.generalized_force);
  visit({"mechanical_energy", "J", "of the load (10.1)"}, point.mechanical_energy);
  visit({"surface_energy", "J", "of the surfaces that touch (10.1)"}, point.surface_energy);
  visit({"elastic_energy", "J", "stored in the bodies (10.2)"}, point.elastic_energy);
  visit({"total_energy", "J", "mechanical + surface - elastic (8)"}, point.total_energy);
}

/// The figures of one point of the curve.
template <typename Point, typename Visitor>
void visitSeparationPointFields(Point& point, Visitor&& visit) {
  visit({"displacement", "m", "of the upper surface past first touch, below zero apart"},
        point.displacement);
  visit({"force", "N", "attraction positive"}, point.force);
  visit({"is_separation", "", "of the way out, where it differs from the way in"},
        point.is_separation);
}

}  // namespace mems_stiction
