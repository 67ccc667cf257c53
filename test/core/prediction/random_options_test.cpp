/// Settings that no one would combine: every figure is a number, or NaN where nothing is to be
/// told.

#include <cmath>
#include <random>
#include <sstream>
#include <type_traits>

#include <gtest/gtest.h>

#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/prediction_fields.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

/// Draws settings inside their ranges: as they are, a few decades away, or at a closed lower end.
class RandomSettings : public OptionVisitor {
 public:
  explicit RandomSettings(unsigned seed) : random_(seed) {}

  void number(const std::string& key, double& value, const std::string&, const Range& range,
              const std::string&) override {
    const double before = value;
    switch (random_() % 3) {
      case 0:
        value *= std::pow(10.0, std::uniform_real_distribution<>(-6.0, 6.0)(random_));
        break;
      case 1:
        if (std::isfinite(range.lower) && !range.lower_open) value = range.lower;
        break;
      default:
        break;
    }
    if (!range.contains(value)) value = before;
    note(key, value);
  }
  void integer(const std::string&, int&, const Range&, const std::string&) override {}
  void flag(const std::string& key, bool& value, const std::string&) override {
    if (random_() % 3 == 0) value = !value;
    note(key, value);
  }
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string&) override {
    value = names[random_() % names.size()];
    note(key, value);
  }

  std::string text() const { return text_.str(); }

 private:
  template <typename Value>
  void note(const std::string& key, const Value& value) {
    text_ << key << ": " << value << "; ";
  }

  std::mt19937 random_;
  std::ostringstream text_;
};

TEST(RandomOptions, TotalEnergyIsANumberAndNothingIsInfinite) {
  const SurfacePair pair{samples::gaussian(32, 24, 5e-9, 5e-9, 2e-9, 25e-9, 3), {}};
  int predicted = 0;
  for (unsigned seed = 0; seed < 500; ++seed) {
    Options options;
    options.load.mechanical_load = 1e-8;
    options.load.voltage = 1.0;
    options.interface.insulator_thickness = 50e-9;
    options.approach.max_steps = 400;
    RandomSettings draw(seed);
    options.describe(draw);
    options.approach.max_steps = 400;
    if (!options.validate().empty()) continue;
    ++predicted;
    AdhesionModel model(options);
    const Prediction prediction = model.predict(pair);
    visitPredictionFields(prediction, [&](const Figure& declared, const auto& value) {
      if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>) {
        // infinite without adhesion, or without a range of it, as documented
        const std::string figure = declared.name;
        if (figure == "adhesion_parameter" || figure == "median_tabor_parameter") return;
        // of surfaces that have flowed until they are flat
        if (figure == "median_composite_radius" && prediction.contact_fraction == 1.0) return;
        EXPECT_FALSE(std::isinf(value)) << figure << ", seed " << seed << ": " << draw.text();
      }
    });
    EXPECT_TRUE(std::isfinite(prediction.total_energy))
        << "seed " << seed << ", status " << static_cast<int>(prediction.status) << ": "
        << draw.text();
  }
  EXPECT_GT(predicted, 250);  // the others are combinations that are refused
}

/// One setting at a time at an end of its range, the others as they are.
class OneAtItsEnd : public OptionVisitor {
 public:
  OneAtItsEnd(int chosen, bool upper) : chosen_(chosen), upper_(upper) {}

  void number(const std::string& key, double& value, const std::string&, const Range& range,
              const std::string&) override {
    if (seen_++ != chosen_) return;
    key_ = key;
    // Decades towards the end, as far as the range goes: an end itself may be open.
    double at = value != 0.0 ? value : 1e-9;
    while (range.contains(upper_ ? 10.0 * at : 0.1 * at) && at != 0.0) at *= upper_ ? 10.0 : 0.1;
    if (range.contains(at)) value = at;
    is_bounded_ = !range.contains(upper_ ? 1e301 : 1e-301) || (!upper_ && range.contains(-1e-9));
  }
  void integer(const std::string&, int&, const Range&, const std::string&) override {}
  void flag(const std::string&, bool&, const std::string&) override {}
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string&, std::string&, const std::vector<std::string>&,
              const std::string&) override {}

  int seen() const { return seen_; }
  const std::string& key() const { return key_; }
  bool isBounded() const { return is_bounded_; }

 private:
  int chosen_;
  bool upper_;
  int seen_ = 0;
  std::string key_;
  bool is_bounded_ = false;
};

TEST(RandomOptions, EachNumberIsBoundedAndNothingIsInfiniteAtTheEnds) {
  const SurfacePair pair{samples::gaussian(16, 16, 5e-9, 5e-9, 2e-9, 15e-9, 3), {}};
  for (const char* formulation : {"separation_curve", "paper"}) {
    for (const bool upper : {false, true}) {
      for (int setting = 0;; ++setting) {
        Options options;
        options.formulation = formulation;
        options.load.mechanical_load = 1e-8;
        options.interface.insulator_thickness = 50e-9;
        options.approach.max_steps = 100;
        OneAtItsEnd at_its_end(setting, upper);
        options.describe(at_its_end);
        if (setting >= at_its_end.seen()) break;
        EXPECT_TRUE(at_its_end.isBounded()) << at_its_end.key();
        if (!options.validate().empty()) continue;
        AdhesionModel model(options);
        const Prediction prediction = model.predict(pair);
        EXPECT_TRUE(std::isfinite(prediction.total_energy))
            << at_its_end.key() << ", upper " << upper;
        EXPECT_TRUE(std::isfinite(prediction.pull_off_force))
            << at_its_end.key() << ", upper " << upper;
        EXPECT_TRUE(std::isfinite(prediction.normal_load))
            << at_its_end.key() << ", upper " << upper;
      }
    }
  }
}

}  // namespace
}  // namespace mems_stiction
