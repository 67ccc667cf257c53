#include "station/remaining_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/jkr.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/constants.hpp"
#include "prediction/asked_output.hpp"

namespace mems_stiction {
namespace {

/// NaN if the solver parts the contact into no asperities.
double remainingContactArea(const Prediction& contact, double normal_load, const Options& options) {
  if (!contact.has_asperities) return std::numeric_limits<double>::quiet_NaN();
  const double work = options.interface.work_of_adhesion;
  const double modulus = ContactPair(options.lower, options.upper).contact_modulus;
  const double load_ratio = contact.normal_load > 0.0 ? normal_load / contact.normal_load : 1.0;
  double area = 0.0;
  for (const Asperity& asperity : contact.asperities) {
    const double axial_load = load_ratio * asperity.load * std::cos(asperity.tilt);
    const double unloaded =
        jkr::equilibriumContactRadius(axial_load, work, asperity.composite_radius, modulus);
    const double share = regimeFactor(asperity.plasticity_index);
    area += kPi * (share * unloaded * unloaded +
                   (1.0 - share) * asperity.contact_radius * asperity.contact_radius);
  }
  return area;
}

}  // namespace

RemainingContact::RemainingContact(const Options& options, const SurfacePair& surfaces,
                                   MeasuredScan scan)
    : options_(withDeformedSurfaces(options)),
      model_(options_),
      surfaces_(surfaces),
      scan_(std::move(scan)) {}

RemainingContact::RemainingContact(const Options& options, const SurfacePair& surfaces)
    : RemainingContact(options, surfaces, asMeasured(options, surfaces)) {}

RemainingState RemainingContact::advance(double voltage, double mechanical_load) {
  Options options = options_;
  options.load.voltage = voltage;
  options.load.mechanical_load = mechanical_load;
  model_.setOptions(options);  // refuses before anything changes

  RemainingState state;
  state.voltage = voltage;
  state.mechanical_load = mechanical_load;
  state.lasting_field_share = options.load.lastingFieldShare();
  const double field_voltage = options.load.fieldVoltage();
  const bool is_within = std::abs(voltage) <= largest_voltage_ && mechanical_load <= largest_load_;
  if (!has_contact_ || !is_within) {
    Prediction prediction = model_.predict(surfaces_);
    largest_voltage_ = std::max(largest_voltage_, std::abs(voltage));
    largest_load_ = std::max(largest_load_, mechanical_load);
    if (field_voltage != 0.0) {
      field_factor_ =
          std::max(field_factor_, prediction.electrostatic_force / (field_voltage * field_voltage));
    }
    if (!has_contact_ || prediction.approach >= contact_.approach) {
      contact_ = std::move(prediction);
      scan_.flag(contact_);
      pressed_ = SurfacePair(
          HeightMap(contact_.deformed_lower, surfaces_.lower.pitchX(), surfaces_.lower.pitchY()),
          HeightMap(contact_.deformed_upper, surfaces_.lower.pitchX(), surfaces_.lower.pitchY()));
      has_contact_ = true;
      state.is_searched = true;
      state.electrostatic_force = contact_.electrostatic_force;
      state.normal_load = contact_.normal_load;
      state.contact_area = contact_.contact_area;
      state.contact_fraction = contact_.contact_fraction;
      state.contact_area_jkr = contact_.contact_area_jkr;
      return state;
    }
  }
  if (contact_.model.knows_every_load) {
    const Prediction now = model_.predict(pressed_);
    const Prediction as_new = model_.predict(surfaces_);
    const Prediction& wider =
        now.contact_area < as_new.contact_area ? as_new : now;  // what is flatter touches no less
    state.electrostatic_force = now.electrostatic_force;
    state.normal_load = now.normal_load;
    state.contact_area = wider.contact_area;
    state.contact_fraction = wider.contact_fraction;
    state.contact_area_jkr = now.contact_area_jkr;
    return state;
  }
  state.contact_area = contact_.contact_area;
  state.contact_fraction = contact_.contact_fraction;
  state.electrostatic_force = field_factor_ * field_voltage * field_voltage;
  const double attraction =
      contact_.normal_load - contact_.electrostatic_force - contact_.mechanical_load;
  state.normal_load = attraction + state.electrostatic_force + mechanical_load;
  state.contact_area_jkr = remainingContactArea(contact_, state.normal_load, options);
  return state;
}

}  // namespace mems_stiction
