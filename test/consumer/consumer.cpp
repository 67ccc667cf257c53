/// A program outside the package: a rough scan is predicted, its device judged, and its half-space
/// solved.

#include <cmath>
#include <cstdio>

#include <mems_stiction/mems_stiction.hpp>

namespace ms = mems_stiction;

/// Summits of 50 nm radius every 64 nm, whose heights differ by 0.2 nm at most.
ms::HeightMap summits() {
  constexpr double kPitch = 2e-9;  // [m]
  cv::Mat heights(64, 64, CV_64FC1);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double x = (col % 32 - 16) * kPitch;
      const double y = (row % 32 - 16) * kPitch;
      heights.at<double>(row, col) = -(x * x + y * y) / (2 * 50e-9) + 1e-10 * std::sin(0.1 * row);
    }
  }
  return {heights, kPitch, kPitch};
}

int main() {
  ms::Configuration configuration;
  configuration.device.spring_stiffness = 10.0;  // [N/m]
  configuration.device.travel = 2e-6;            // [m]
  configuration.device.contact_area = 1.6e-14;   // [m^2]

  ms::ScanPredictor predictor(configuration);
  const ms::PreparedScan prepared = predictor.preparer().prepare(summits());
  const ms::Prediction prediction = predictor.predict(prepared);
  const ms::Verdict verdict =
      ms::verdictOf(prediction, configuration.device, configuration.uncertainty,
                    predictor.options(), prepared.surfaces.lower.cellArea());
  const ms::SolvedHalfSpace solved =
      ms::HalfSpaceSolver(configuration.half_space)
          .solve(ms::halfSpaceProblem(prepared, predictor.options()));

  std::printf("pull-off force %.3g N, of the half-space %.3g N\n", prediction.pull_off_force,
              solved.pull_off_force);
  std::printf("does it stick? %s: %s\n", ms::sticksText(verdict.sticks), verdict.reason.c_str());
  try {
    ms::readScanFile("no such file.tiff");
    return 1;
  } catch (const ms::FileError& error) {
    std::printf("%s\n", error.what());
  }
  const double ratio = prediction.pull_off_force / solved.pull_off_force;
  return solved.status == ms::HalfSpaceStatus::kSolved && ratio > 0.5 && ratio < 2.0 &&
                 std::isfinite(verdict.margin)
             ? 0
             : 1;
}
