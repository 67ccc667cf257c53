/// How fast is a prediction, and what comes before it? Every case runs in one process on one core
/// beside its baselines: the labelling that a frame-by-frame approach would spend in
/// connectedComponentsWithStats alone, and one pass over the frame's memory. scripts/bench makes
/// the table of ratios from its JSON.

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "approach/gap_field.hpp"
#include "bench/frames.hpp"
#include "bench/settings.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/roughness/spatial_roughness.hpp"

namespace mems_stiction {
namespace bench {
namespace {

void predict(benchmark::State& state, const Case& setting, const Options& options) {
  const HeightMap& frame = frameOf(setting.frame, setting.size);
  AdhesionModel model(options);
  Prediction prediction;
  model.predict(frame, prediction);
  for (auto _ : state) {
    model.predict(frame, prediction);
    benchmark::DoNotOptimize(prediction.pull_off_force);
  }
  state.counters["steps"] = prediction.steps;
  state.counters["patches"] = prediction.asperity_count;
  state.counters["contact_fraction"] = prediction.contact_fraction;
}

/// Cleaning and prediction of scan after scan, as they arrive; by the paper's formulation, whose
/// time is the yardstick.
void cleanAndPredict(benchmark::State& state, const Recipe& recipe) {
  cv::setNumThreads(1);
  const Case setting{Frame::kGaussian, 1024, 200};
  const HeightMap& frame = frameOf(setting.frame, setting.size);
  AdhesionModel model(optionsFor(setting, "paper", Pressing::kOverload, false));
  ScanCleaner cleaner(recipe.cleaning);
  Prediction prediction;
  for (auto _ : state) {
    model.predict(cleaner.clean(frame).surface, prediction);
    benchmark::DoNotOptimize(prediction.pull_off_force);
  }
}

void describeRoughness(benchmark::State& state) {
  cv::setNumThreads(1);
  const HeightMap& frame = frameOf(Frame::kGaussian, 1024);
  for (auto _ : state) benchmark::DoNotOptimize(spatialRoughness(frame, {}));
}

/// The whole frame is labelled anew at each step, and nothing else is done.
void label(benchmark::State& state, const Case& setting) {
  cv::setNumThreads(1);
  const HeightMap& frame = frameOf(setting.frame, setting.size);
  const double full_approach = fullApproach(frame);
  GapField field;
  field.compute(frame);
  cv::Mat1d gaps(setting.size, setting.size);
  for (int row = 0; row < setting.size; ++row) field.gapsOfRow(row, gaps.ptr<double>(row));
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  for (auto _ : state) {
    for (int step = 1; step <= setting.steps; ++step) {
      state.PauseTiming();
      const cv::Mat mask = gaps < full_approach * step / setting.steps;
      state.ResumeTiming();
      benchmark::DoNotOptimize(
          cv::connectedComponentsWithStats(mask, labels, stats, centroids, 4, CV_32S));
    }
  }
}

/// Reading the frame once.
void pass(benchmark::State& state, int size) {
  const cv::Mat& heights = frameOf(Frame::kGaussian, size).heights();
  for (auto _ : state) benchmark::DoNotOptimize(cv::sum(heights));
}

/// Frames per second of one or two models, each on its own core with frames of its own.
void inFlight(benchmark::State& state, int models) {
  const Case setting{Frame::kGaussian, 1024, 200};
  constexpr int kFramesEach = 8;
  std::vector<AdhesionModel> pool;
  std::vector<Prediction> predictions(static_cast<std::size_t>(models));
  for (int i = 0; i < models; ++i) {
    pool.emplace_back(optionsFor(setting, kDefaultFormulation, Pressing::kAdhesion, false));
    pool.back().predict(frameOf(setting.frame, setting.size),
                        predictions[static_cast<std::size_t>(i)]);
  }
  for (auto _ : state) {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < pool.size(); ++i) {
      threads.emplace_back([&, i] {
        for (int k = 0; k < kFramesEach; ++k) {
          pool[i].predict(frameOf(setting.frame, setting.size), predictions[i]);
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  state.counters["frames_per_second"] = benchmark::Counter(
      static_cast<double>(kFramesEach * models), benchmark::Counter::kIsIterationInvariantRate);
}

void registerCase(const std::string& name, const std::function<void(benchmark::State&)>& run,
                  double min_time) {
  benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond)->MinTime(min_time);
}

void registerAll() {
  std::vector<Case> cases;
  for (const int size : {256, 512, 1024, 2048}) cases.push_back({Frame::kGaussian, size, 200});
  for (const int steps : {50, 1000}) cases.push_back({Frame::kGaussian, 1024, steps});
  for (const Frame frame :
       {Frame::kSmooth, Frame::kRough, Frame::kSpheres, Frame::kWhiteNoise, Frame::kPlane}) {
    cases.push_back({frame, 1024, 200});
  }
  for (const Case& setting : cases) {
    const auto add = [&setting](const std::string& name, const std::string& formulation,
                                Pressing pressing, bool all) {
      const auto run = [=](benchmark::State& state) {
        predict(state, setting, optionsFor(setting, formulation, pressing, all));
      };
      registerCase(name + "/" + setting.name(), run, 0.3);
    };
    add("predict", kDefaultFormulation, Pressing::kAdhesion, false);
    add("predict_all_outputs", kDefaultFormulation, Pressing::kAdhesion, true);
    add("predict_loaded", kDefaultFormulation, Pressing::kOverload, false);
    add("predict_loaded_all_outputs", kDefaultFormulation, Pressing::kOverload, true);
    add("predict_paper", "paper", Pressing::kOverload, false);
    add("predict_paper_all_outputs", "paper", Pressing::kOverload, true);
    benchmark::RegisterBenchmark(("label/" + setting.name()).c_str(),
                                 [setting](benchmark::State& state) { label(state, setting); })
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  for (const char* const pressure : {"1e6", "1e7", "1e8", "1e9"}) {
    for (const Frame frame : {Frame::kGaussian, Frame::kWhiteNoise}) {
      const Case setting{frame, 1024, 200};
      const auto run = [=](benchmark::State& state) {
        predict(state, setting, optionsUnder(setting, std::stod(pressure)));
      };
      registerCase(std::string("predict_under/") + pressure + "/" + setting.name(), run, 0.3);
    }
  }
  for (const Recipe& recipe : cleaningRecipes()) {
    registerCase(
        "clean/" + recipe.name,
        [recipe](benchmark::State& state) { cleanAndPredict(state, recipe); }, 0.3);
  }
  registerCase("spatial_roughness", describeRoughness, 0.3);
  for (const int size : {256, 512, 1024, 2048}) {
    registerCase(
        "pass/" + std::to_string(size), [size](benchmark::State& state) { pass(state, size); },
        0.1);
  }
  for (const int models : {1, 2}) {
    benchmark::RegisterBenchmark(("in_flight/" + std::to_string(models)).c_str(),
                                 [models](benchmark::State& state) { inFlight(state, models); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->MinTime(0.5);
  }
}

}  // namespace
}  // namespace bench
}  // namespace mems_stiction

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  mems_stiction::bench::registerAll();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
