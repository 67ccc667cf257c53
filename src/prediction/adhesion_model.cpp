#include "mems_stiction/prediction/adhesion_model.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/prediction/contact_summary.hpp"
#include "mems_stiction/prediction/surface_outputs.hpp"

namespace mems_stiction {
namespace {

/// Every figure as in a new prediction; lists are empty and maps are there to be written over.
void resetKeepingMemory(Prediction& prediction) {
  Prediction fresh;
  fresh.asperities.swap(prediction.asperities);
  fresh.energy_curve.swap(prediction.energy_curve);
  fresh.asperities.clear();
  fresh.energy_curve.clear();
  fresh.deformed_lower = std::move(prediction.deformed_lower);
  fresh.deformed_upper = std::move(prediction.deformed_upper);
  fresh.contact_map = std::move(prediction.contact_map);
  prediction = std::move(fresh);
}

}  // namespace

class AdhesionModel::Implementation {
 public:
  explicit Implementation(const Options& new_options) : options(new_options) { options.check(); }

  void predict(const HeightMap& lower, const HeightMap* upper, Prediction& prediction);

  Options options;

 private:
  GapField field_;
  GapOrder order_;
  ApproachSearch search_;
  EquilibriumState state_;
  std::vector<double> tabor_parameters_;
  SurfaceOutputMemory surface_memory_;
};

void AdhesionModel::Implementation::predict(const HeightMap& lower, const HeightMap* upper, Prediction& prediction) {
  const auto start = std::chrono::steady_clock::now();
  if (upper != nullptr) {
    field_.compute(lower, *upper);
  } else {
    field_.compute(lower);
  }

  const double lower_rms_height = upper != nullptr ? heightStatistics(lower).rms_height : field_.rmsGap();
  const double upper_rms_height = upper != nullptr ? heightStatistics(*upper).rms_height : 0.0;
  const double composite_rms_height = std::hypot(lower_rms_height, upper_rms_height);
  if (!std::isfinite(composite_rms_height)) {  // large against their gap, or their sums would have been refused
    throw SurfaceError("the rms heights of scan (" + numberText(lower_rms_height) + " m) and counter-surface (" +
                       numberText(upper_rms_height) + " m) must be finite");
  }

  const double step = approachStep(options.approach, composite_rms_height, options.interface.cutoff_distance);
  order_.build(field_, options.approach.max_contact_fraction, step);

  const ContactPair pair(options.lower, options.upper);
  const SearchSetting setting{
      AsperityLaw(pair, options.interface.work_of_adhesion, composite_rms_height, options.approach),
      CellForces(options.interface, options.load.voltage, field_.cellArea()),
      options.load.mechanical_load,
      step,
      options.approach.max_steps,
      options.interface.cutoff_distance,
      options.output.energy_curve,
      CapillaryForce(options.capillary)};
  search_.run(field_, order_, options.approach.connectivity, setting, state_);

  resetKeepingMemory(prediction);
  prediction.voltage = options.load.voltage;
  prediction.mechanical_load = options.load.mechanical_load;
  prediction.composite_rms_height = composite_rms_height;
  prediction.rms_height = lower_rms_height;
  prediction.invalid_fraction = 1.0 - static_cast<double>(field_.validCount()) / field_.cellCount();
  summarizeContact(lower, state_, search_, field_, order_, setting.law, options, tabor_parameters_, prediction);
  if (options.output.roughness) prediction.roughness = arealParameters(lower);
  fillSurfaceOutputs(lower, upper, state_, search_, field_, setting.law, options, surface_memory_, prediction);
  prediction.energy_curve.assign(state_.curve.begin(), state_.curve.end());
  prediction.processing_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

AdhesionModel::AdhesionModel(const Options& options) : implementation_(std::make_unique<Implementation>(options)) {}
AdhesionModel::~AdhesionModel() = default;
AdhesionModel::AdhesionModel(AdhesionModel&&) noexcept = default;
AdhesionModel& AdhesionModel::operator=(AdhesionModel&&) noexcept = default;

const Options& AdhesionModel::options() const { return implementation_->options; }

void AdhesionModel::setOptions(const Options& options) {
  options.check();
  implementation_->options = options;
}

Prediction AdhesionModel::predict(const HeightMap& lower) {
  Prediction prediction;
  predict(lower, prediction);
  return prediction;
}

Prediction AdhesionModel::predict(const HeightMap& lower, const HeightMap& upper) {
  Prediction prediction;
  predict(lower, upper, prediction);
  return prediction;
}

void AdhesionModel::predict(const HeightMap& lower, Prediction& prediction) {
  implementation_->predict(lower, nullptr, prediction);
}

void AdhesionModel::predict(const HeightMap& lower, const HeightMap& upper, Prediction& prediction) {
  implementation_->predict(lower, &upper, prediction);
}

}  // namespace mems_stiction
