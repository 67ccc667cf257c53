/// One prediction of a 512 x 512 Gaussian surface up to 30 % contact, for instruction counts by
/// callgrind: collection is toggled at measuredPrediction().

#include <cstdio>

#include "bench/frames.hpp"
#include "bench/settings.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"

/// Not inlined, and with a name that the profiler finds.
extern "C" __attribute__((noinline)) void measuredPrediction(
    mems_stiction::AdhesionModel& model, const mems_stiction::HeightMap& frame,
    mems_stiction::Prediction& prediction) {
  model.predict(frame, prediction);
}

int main() {
  using namespace mems_stiction;
  const bench::Case setting{bench::Frame::kGaussian, 512, 200};
  const HeightMap& frame = bench::frameOf(setting.frame, setting.size);
  AdhesionModel model(
      bench::optionsFor(setting, kDefaultFormulation, bench::Pressing::kOverload, false));
  Prediction prediction;
  model.predict(frame, prediction);  // brings the memory in
  measuredPrediction(model, frame, prediction);
  std::printf("%d steps, %d patches\n", prediction.steps, prediction.asperity_count);
  return 0;
}
