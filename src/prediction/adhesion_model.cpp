#include "mems_stiction/prediction/adhesion_model.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "mems_stiction/equilibrium/approach_search.hpp"
#include "mems_stiction/prediction/contact_summary.hpp"
#include "mems_stiction/prediction/surface_outputs.hpp"

namespace mems_stiction {

class AdhesionModel::Implementation {
 public:
  explicit Implementation(const Options& new_options) : options(new_options) { options.check(); }

  Prediction predict(const HeightMap& lower, const HeightMap* upper);

  Options options;

 private:
  GapField field_;
  GapOrder order_;
  ApproachSearch search_;
};

Prediction AdhesionModel::Implementation::predict(const HeightMap& lower, const HeightMap* upper) {
  const auto start = std::chrono::steady_clock::now();
  if (upper != nullptr) {
    field_.compute(lower, *upper);
  } else {
    field_.compute(lower);
  }
  order_.build(field_, options.approach.max_contact_fraction);

  const double lower_rms_height = upper != nullptr ? heightStatistics(lower).rms_height : field_.rmsGap();
  const double upper_rms_height = upper != nullptr ? heightStatistics(*upper).rms_height : 0.0;
  const double composite_rms_height = std::hypot(lower_rms_height, upper_rms_height);

  const ContactPair pair(options.lower, options.upper);
  const SearchSetting setting{
      AsperityLaw(pair, options.interface.work_of_adhesion, composite_rms_height, options.approach),
      CellForces(options.interface, options.load.voltage, field_.cellArea()),
      options.load.mechanical_load,
      approachStep(options.approach, composite_rms_height, options.interface.cutoff_distance),
      options.approach.max_steps,
      options.interface.cutoff_distance,
      options.output.energy_curve};
  EquilibriumState state = search_.run(field_, order_, options.approach.connectivity, setting);

  Prediction prediction;
  prediction.voltage = options.load.voltage;
  prediction.mechanical_load = options.load.mechanical_load;
  prediction.composite_rms_height = composite_rms_height;
  prediction.rms_height = lower_rms_height;
  prediction.invalid_fraction = 1.0 - static_cast<double>(field_.validCount()) / field_.cellCount();
  summarizeContact(lower, state, search_, field_, order_, setting.law, options, prediction);
  if (options.output.roughness) prediction.roughness = arealParameters(lower);
  fillSurfaceOutputs(lower, upper, state, search_, field_, order_, setting.law, options, prediction);
  prediction.energy_curve = std::move(state.curve);
  prediction.processing_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return prediction;
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

Prediction AdhesionModel::predict(const HeightMap& lower) { return implementation_->predict(lower, nullptr); }

Prediction AdhesionModel::predict(const HeightMap& lower, const HeightMap& upper) {
  return implementation_->predict(lower, &upper);
}

}  // namespace mems_stiction
