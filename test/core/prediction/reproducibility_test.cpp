/// The same input gives the same output, bit for bit, whatever the model did before and however
/// many threads there are.

#include <cstring>
#include <thread>

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/paper_options.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

Options richOptions() {
  Options options = paperOptions();
  options.lower.hardness = 3e9;
  options.load.mechanical_load = 2e-6;
  options.load.voltage = 5.0;
  options.interface.insulator_thickness = 50e-9;
  options.output.energy_curve = true;
  return options;
}

template <typename Record>
void appendBits(const Record& record, std::string& bits) {
  bits.append(reinterpret_cast<const char*>(&record), sizeof record);
}

void appendBits(const cv::Mat& map, std::string& bits) {
  for (int row = 0; row < map.rows; ++row) {
    bits.append(map.ptr<char>(row), static_cast<std::size_t>(map.cols) * map.elemSize());
  }
}

/// Every figure and map of a prediction but the time that it took.
std::string bitsOf(const Prediction& p) {
  std::string bits;
  for (const double value : {p.voltage,
                             p.mechanical_load,
                             p.van_der_waals_force,
                             p.electrostatic_force,
                             p.normal_load,
                             p.pull_off_force,
                             p.pull_off_force_jkr,
                             p.pull_off_force_transition,
                             p.contact_area,
                             p.contact_area_jkr,
                             p.nominal_area,
                             p.contact_fraction,
                             p.approach,
                             p.mean_gap,
                             p.mechanical_energy,
                             p.surface_energy,
                             p.elastic_energy,
                             p.total_energy,
                             p.plastic_work,
                             p.bonding_energy,
                             p.normalized_bonding_energy,
                             p.adhesion_parameter,
                             p.max_tilt,
                             p.median_tabor_parameter,
                             p.composite_rms_height,
                             p.rms_height,
                             p.invalid_fraction}) {
    appendBits(value, bits);
  }
  for (const int value : {static_cast<int>(p.status), p.steps, p.asperity_count, p.elastic_count,
                          p.elasto_plastic_count, p.plastic_count}) {
    appendBits(value, bits);
  }
  for (const Asperity& a : p.asperities) {
    for (const double value :
         {a.x, a.y, a.z, a.cap_radius, a.composite_radius, a.load, a.contact_radius, a.tilt,
          a.plasticity_index, a.tabor_parameter, a.area}) {
      appendBits(value, bits);
    }
  }
  for (const EnergyPoint& point : p.energy_curve) appendBits(point, bits);
  appendBits(p.deformed_lower, bits);
  appendBits(p.deformed_upper, bits);
  appendBits(p.contact_map, bits);
  return bits;
}

std::string predictFrame(AdhesionModel& model, const samples::Frame& frame) {
  return bitsOf(model.predict(frame));
}

TEST(Reproducibility, givesTheSameBitsAgain) {
  for (const samples::Frame& frame : samples::allFrames()) {
    AdhesionModel first(richOptions());
    AdhesionModel second(richOptions());
    const std::string bits = predictFrame(first, frame);
    EXPECT_TRUE(predictFrame(first, frame) == bits) << frame.name;
    EXPECT_TRUE(predictFrame(second, frame) == bits) << frame.name;
  }
}

TEST(Reproducibility, doesNotRememberOtherFrames) {
  const std::vector<samples::Frame> frames = samples::allFrames();
  AdhesionModel used(richOptions());
  // up and down the list: larger and smaller frames, flat and rough counter-surfaces follow each
  // other
  for (std::size_t k = 0; k < 2 * frames.size(); ++k) {
    const samples::Frame& frame = frames[k * 7 % frames.size()];
    AdhesionModel fresh(richOptions());
    EXPECT_TRUE(predictFrame(used, frame) == predictFrame(fresh, frame)) << frame.name;
  }
}

TEST(Reproducibility, doesNotRememberOtherOptions) {
  const samples::Frame frame = samples::allFrames()[2];
  AdhesionModel used(richOptions());
  const std::string before = predictFrame(used, frame);
  Options other = richOptions();
  other.approach.connectivity = Connectivity::kEight;
  other.load.mechanical_load = 1e-5;
  used.setOptions(other);
  AdhesionModel fresh(other);
  EXPECT_TRUE(predictFrame(used, frame) == predictFrame(fresh, frame));
  used.setOptions(richOptions());
  EXPECT_TRUE(predictFrame(used, frame) == before);
}

TEST(Reproducibility, doesNotDependOnTheNumberOfThreads) {
  const HeightMap surface = samples::gaussian(300, 280, 10e-9, 10e-9, 3e-9, 60e-9, 5);
  const samples::Frame frame{"", surface, {}};
  AdhesionModel model(richOptions());
  const int threads = cv::getNumThreads();
  cv::setNumThreads(1);
  const std::string one = predictFrame(model, frame);
  cv::setNumThreads(8);
  const std::string eight = predictFrame(model, frame);
  cv::setNumThreads(threads);
  EXPECT_TRUE(one == eight);

  std::vector<std::string> bits(4);
  std::vector<std::thread> workers;
  for (std::string& result : bits) {
    workers.emplace_back([&result, &frame] {
      AdhesionModel own(richOptions());
      result = predictFrame(own, frame);
    });
  }
  for (std::thread& worker : workers) worker.join();
  for (const std::string& result : bits) EXPECT_TRUE(result == one);
}

TEST(Reproducibility, doesNotDependOnHowThePixelsLieInMemory) {
  const HeightMap surface = samples::gaussian(50, 60, 10e-9, 10e-9, 3e-9, 60e-9, 5);
  cv::Mat1d larger(80, 90, 1.0);
  surface.heights().copyTo(larger(cv::Rect(11, 13, 60, 50)));
  AdhesionModel model(richOptions());
  const std::string bits = bitsOf(model.predict(surface));
  EXPECT_TRUE(bitsOf(model.predict(HeightMap(larger(cv::Rect(11, 13, 60, 50)), 10e-9, 10e-9))) ==
              bits);
}

}  // namespace
}  // namespace mems_stiction
