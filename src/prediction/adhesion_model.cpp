#include "mems_stiction/prediction/adhesion_model.hpp"

#include <chrono>
#include <cmath>
#include <utility>

#include "contact/contact_solver.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "prediction/contact_solvers.hpp"
#include "prediction/contact_summary.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

double secondsSince(const std::chrono::steady_clock::time_point& start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The larger memory of two lists goes to `user`.
template <typename List>
void giveLarger(List& other, List& user) {
  if (other.capacity() > user.capacity()) other.swap(user);
}

/// What an earlier prediction has becomes the solution's memory, and every figure as in a new one.
void handOver(Prediction& prediction, ContactSolution& solution) {
  giveLarger(prediction.asperities, solution.asperities);
  giveLarger(prediction.pull_off_contacts, solution.pull_off_contacts);
  giveLarger(prediction.energy_curve, solution.energy_curve);
  giveLarger(prediction.curve, solution.curve);
  solution.contact_map = std::move(prediction.contact_map);
  solution.displaced_lower = std::move(prediction.deformed_lower);
  solution.displaced_upper = std::move(prediction.deformed_upper);
  solution.pressure = std::move(prediction.pressure);
  Prediction fresh;
  fresh.asperities.swap(prediction.asperities);
  fresh.pull_off_contacts.swap(prediction.pull_off_contacts);
  fresh.energy_curve.swap(prediction.energy_curve);
  fresh.curve.swap(prediction.curve);
  fresh.asperities.clear();
  fresh.pull_off_contacts.clear();
  fresh.energy_curve.clear();
  fresh.curve.clear();
  prediction = std::move(fresh);
}

}  // namespace

class AdhesionModel::Implementation {
 public:
  explicit Implementation(const Options& new_options) { setOptions(new_options); }

  const Options& options() const { return options_; }
  void setOptions(const Options& new_options);
  void see(const SurfacePair& surfaces);
  /// Whether the last ones had this grid.
  bool hasSeen(const SurfacePair& surfaces) const {
    return gap_.rows() == surfaces.lower.rows() && gap_.cols() == surfaces.lower.cols();
  }
  void solve(const SurfacePair& surfaces, Prediction& prediction);

 private:
  double compositeRmsHeight(const SurfacePair& surfaces, double lower_rms_height) const;

  Options options_;
  std::unique_ptr<ContactSolver> solver_;
  GapField gap_;                       ///< of the surfaces that were seen last, as both rms heights
  double rms_height_ = 0.0;            ///< [m]
  double composite_rms_height_ = 0.0;  ///< [m]
  ContactSolution solution_;
  std::vector<double> values_;
};

void AdhesionModel::Implementation::setOptions(const Options& new_options) {
  new_options.check();
  if (new_options.load.isPerArea()) {
    throw OptionsError(
        {"load/pressure, load/device_force: a model takes load/mechanical_load alone; scale them "
         "to the "
         "frame first (evaluation/frame_load.hpp)"});
  }
  if (!solver_ || new_options.formulation != options_.formulation)
    solver_ = makeContactSolver(new_options.formulation);
  options_ = new_options;
}

double AdhesionModel::Implementation::compositeRmsHeight(const SurfacePair& surfaces,
                                                         double lower_rms_height) const {
  const double upper_rms_height =
      surfaces.upperIsPlane() ? 0.0 : heightStatistics(surfaces.upper).rms_height;
  const double composite_rms_height = std::hypot(lower_rms_height, upper_rms_height);
  if (!std::isfinite(composite_rms_height)) {  // large against their gap, or their sums would have
                                               // been refused
    throw SurfaceError("the rms heights of scan (" + numberText(lower_rms_height) +
                       " m) and counter-surface (" + numberText(upper_rms_height) +
                       " m) must be finite");
  }
  return composite_rms_height;
}

void AdhesionModel::Implementation::see(const SurfacePair& surfaces) {
  gap_.compute(surfaces);
  rms_height_ =
      surfaces.upperIsPlane() ? gap_.rmsGap() : heightStatistics(surfaces.lower).rms_height;
  composite_rms_height_ = compositeRmsHeight(surfaces, rms_height_);
}

void AdhesionModel::Implementation::solve(const SurfacePair& surfaces, Prediction& prediction) {
  const ContactProblem problem{surfaces, gap_, composite_rms_height_, options_};
  TimeLimit::check();
  handOver(prediction, solution_);
  solver_->solve(problem, solution_);
  TimeLimit::check();
  summarizeContact(problem, solution_, values_, prediction);
  prediction.rms_height = rms_height_;
  if (options_.output.roughness) prediction.roughness = arealParameters(surfaces.lower);
}

AdhesionModel::AdhesionModel(const Options& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
AdhesionModel::~AdhesionModel() = default;
AdhesionModel::AdhesionModel(AdhesionModel&&) noexcept = default;
AdhesionModel& AdhesionModel::operator=(AdhesionModel&&) noexcept = default;

const Options& AdhesionModel::options() const { return implementation_->options(); }

void AdhesionModel::setOptions(const Options& options) { implementation_->setOptions(options); }

Prediction AdhesionModel::predict(const SurfacePair& surfaces) {
  Prediction prediction;
  predict(surfaces, prediction);
  return prediction;
}

void AdhesionModel::predict(const SurfacePair& surfaces, Prediction& prediction) {
  const auto start = std::chrono::steady_clock::now();
  implementation_->see(surfaces);
  implementation_->solve(surfaces, prediction);
  prediction.processing_time = secondsSince(start);
}

Prediction AdhesionModel::predictAgain(const SurfacePair& surfaces) {
  if (!implementation_->hasSeen(surfaces)) return predict(surfaces);
  const auto start = std::chrono::steady_clock::now();
  Prediction prediction;
  implementation_->solve(surfaces, prediction);
  prediction.processing_time = secondsSince(start);
  return prediction;
}

}  // namespace mems_stiction
