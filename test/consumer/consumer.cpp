/// What a physicist's own program does with the installed library.

#include <cstdio>

#include <mems_stiction/prediction/adhesion_model.hpp>

int main() {
  cv::Mat heights(64, 64, CV_64FC1);
  for (int row = 0; row < heights.rows; ++row) {
    for (int col = 0; col < heights.cols; ++col) {
      const double x = (col - 32) * 1e-9;
      const double y = (row - 32) * 1e-9;
      heights.at<double>(row, col) = -(x * x + y * y) / 2e-6;  // a sphere of 1 um
    }
  }
  mems_stiction::AdhesionModel model{mems_stiction::Options()};
  const mems_stiction::Prediction prediction = model.predict(mems_stiction::HeightMap(heights, 1e-9, 1e-9));
  std::printf("pull-off force %g N\n", prediction.pull_off_force);
  return prediction.pull_off_force > 0.0 ? 0 : 1;
}
