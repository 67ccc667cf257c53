/// A small rough pair under any settings: bytes choose size, heights and each setting, within its
/// range or anywhere.

#include <cmath>
#include <limits>

#include <opencv2/core.hpp>

#include "fuzz/byte_source.hpp"
#include "fuzz/fuzzing.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"

namespace {

using namespace mems_stiction;

/// Leaves most settings as they are and moves the others over many powers of ten.
class SettingChooser : public OptionVisitor {
 public:
  explicit SettingChooser(fuzzing::ByteSource& bytes) : bytes_(bytes) {}

  void number(const std::string& /*key*/, double& value, const std::string& /*unit*/,
              const Range& range, const std::string& /*meaning*/) override {
    switch (bytes_.below(16)) {
      case 1:
        value *= std::pow(10.0, 20.0 * bytes_.share() - 10.0);
        break;
      case 2:
        value = bytes_.take<double>();
        break;
      case 3:
        value = std::isfinite(range.lower) ? range.lower : 0.0;
        break;
      case 4:
        value = std::isfinite(range.upper) ? range.upper : 1.0;
        break;
      case 5:
        value = bytes_.share();
        break;
      case 6:
        value = std::pow(10.0, -12.0 + 24.0 * bytes_.share());
        break;
      case 7:
        value = -value;
        break;
      default:
        break;
    }
  }
  void integer(const std::string& /*key*/, int& value, const Range& /*range*/,
               const std::string& /*meaning*/) override {
    switch (bytes_.below(16)) {
      case 1:
        value = static_cast<int>(bytes_.below(16));
        break;
      case 2:
        value = static_cast<int>(bytes_.below(256));
        break;
      case 3:
        value = bytes_.take<std::int32_t>();
        break;
      default:
        break;
    }
  }
  void flag(const std::string& /*key*/, bool& value, const std::string& /*meaning*/) override {
    if (bytes_.below(8) == 1) value = !value;
  }
  void text(const std::string& /*key*/, std::string& /*value*/,
            const std::string& /*meaning*/) override {}
  void choice(const std::string& /*key*/, std::string& value, const std::vector<std::string>& names,
              const std::string& /*meaning*/) override {
    if (bytes_.below(4) == 1) value = names[bytes_.below(names.size())];
  }

 private:
  fuzzing::ByteSource& bytes_;
};

/// At most 16 x 16, on a scale of heights and with a few special values.
HeightMap chosenSurface(fuzzing::ByteSource& bytes) {
  const int rows = 1 + static_cast<int>(bytes.below(16));
  const int cols = 1 + static_cast<int>(bytes.below(16));
  const double pitch = std::pow(10.0, -9.0 + 3.0 * bytes.share());
  const double scale = std::pow(10.0, -10.0 + 5.0 * bytes.share());
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const int level = bytes.take<std::int8_t>();
      heights.at<double>(row, col) =
          level == -128 ? std::numeric_limits<double>::quiet_NaN() : scale * level / 127.0;
    }
  }
  return {heights, pitch, pitch};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzzing::ByteSource bytes(data, size);
  const HeightMap surface = chosenSurface(bytes);
  Configuration configuration;
  SettingChooser chooser(bytes);
  configuration.describe(chooser);
  if (configuration.preprocessing.refine.factor > 4)
    configuration.preprocessing.refine.factor = 4;  // cost alone

  fuzzing::accepted([&] {
    ScanPredictor predictor(configuration);
    const Prediction prediction = predictor.predict(surface);
    fuzzing::require(prediction.contact_fraction >= 0.0 && prediction.contact_fraction <= 1.0,
                     "the share in contact is a share");
    fuzzing::require(std::isfinite(prediction.normal_load), "the load is a number");
    fuzzing::require(std::isfinite(prediction.pull_off_force), "the pull-off force is a number");
    fuzzing::require(std::isfinite(prediction.total_energy), "the energy is a number");
  });
  return 0;
}
