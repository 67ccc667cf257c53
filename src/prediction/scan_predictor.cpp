#include "mems_stiction/prediction/scan_predictor.hpp"

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/preprocess/level.hpp"

namespace mems_stiction {
namespace {

const Configuration& checked(const Configuration& configuration) {
  configuration.check();
  return configuration;
}

}  // namespace

ScanPredictor::ScanPredictor(const Configuration& configuration)
    : configuration_(checked(configuration)), model_(configuration_.model) {}

void ScanPredictor::setLoad(double voltage, double mechanical_load) {
  Options options = configuration_.model;
  options.load.voltage = voltage;
  options.load.mechanical_load = mechanical_load;
  model_.setOptions(options);  // refuses before it changes anything
  configuration_.model = options;
}

void ScanPredictor::setOutput(const OutputOptions& output) {
  Options options = configuration_.model;
  options.output = output;
  model_.setOptions(options);
  configuration_.model = options;
}

HeightMap ScanPredictor::prepared(const HeightMap& scan) const {
  switch (configuration_.preprocessing.level) {
    case Levelling::kNone:
      break;
    case Levelling::kPlane:
      return levelled(scan);
  }
  return scan;
}

Prediction ScanPredictor::predict(const HeightMap& scan) {
  if (configuration_.counter_surface.type != CounterSurfaceType::kFlat) {
    throw SurfaceError("no counter-surface: counter_surface/type is not flat, and no measured one was given");
  }
  return model_.predict(prepared(scan));
}

Prediction ScanPredictor::predict(const HeightMap& scan, const HeightMap& measured_counter_surface) {
  const HeightMap counter_surface =
      mountedCounterSurface(measured_counter_surface, configuration_.counter_surface.facing);
  return model_.predict(prepared(scan), prepared(counter_surface));
}

}  // namespace mems_stiction
