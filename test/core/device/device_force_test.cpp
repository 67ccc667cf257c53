#include "mems_stiction/device/device_force.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <opencv2/imgproc.hpp>

#include "device/device_area.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "prediction/area_adhesion.hpp"
#include "preprocess/level.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/gaussian_heights.hpp"
#include "support/holed_surfaces.hpp"

namespace mems_stiction {
namespace {

constexpr double kPitch = 10e-9;
constexpr int kSide = 768;

cv::Mat surfaceOf(int side, double length, double rms, int seed) {
  return gaussianHeights(side, kPitch, length, rms, seed);
}

NamedScan part(const std::string& name, const cv::Mat& heights, int row, int col, int side) {
  return {name, HeightMap(heights(cv::Rect(col, row, side, side)).clone(), kPitch, kPitch)};
}

DeviceForceOptions fewRealisations() {
  DeviceForceOptions options;
  options.realisations = 3;
  return options;
}

/// Paraboloids of one radius in square tiles, their summits of normally distributed height.
cv::Mat domes() {
  constexpr int kTile = 24;
  constexpr double kRadius = 240e-9;
  cv::Mat tops(kSide / kTile, kSide / kTile, CV_64FC1);
  cv::RNG random(1);
  random.fill(tops, cv::RNG::NORMAL, 0.0, 10e-9);
  cv::Mat heights(kSide, kSide, CV_64FC1);
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col) {
      const double x = (col % kTile + 0.5 - 0.5 * kTile) * kPitch;
      const double y = (row % kTile + 0.5 - 0.5 * kTile) * kPitch;
      heights.at<double>(row, col) =
          tops.at<double>(row / kTile, col / kTile) - (x * x + y * y) / (2.0 * kRadius);
    }
  }
  return heights;
}

bool isTold(const DeviceForce& force, const std::string& words) {
  return std::any_of(force.warnings.begin(), force.warnings.end(), [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

double areaOfPixels(double side) { return side * side * kPitch * kPitch; }

class DeviceForceTest : public testing::Test {
 protected:
  void SetUp() override {
    large_ = surfaceOf(kSide, 60e-9, 5e-9, 1);
    surfaces_.scans = {part("first", large_, 0, 0, 256), part("second", large_, 450, 380, 256)};
  }

  DeviceForce force(double area, int contacts = 1) const {
    return deviceForce(surfaces_, {area, contacts}, model_, uncertainty_, options_);
  }

  cv::Mat large_;
  DeviceSurfaces surfaces_;
  Options model_;
  UncertaintyOptions uncertainty_;
  DeviceForceOptions options_ = fewRealisations();
};

TEST_F(DeviceForceTest, TheForceOfALargeSurfaceFromPartsOfIt) {
  const double truth =
      AdhesionModel(model_).predict(HeightMap(large_, kPitch, kPitch)).pull_off_force;
  const DeviceForce found = force(areaOfPixels(kSide));
  EXPECT_GT(found.pull_off_force, truth / 2.0);
  EXPECT_LT(found.pull_off_force, truth * 2.0);
  EXPECT_LT(found.pull_off_force_lower, truth);
  EXPECT_GT(found.pull_off_force_upper, truth);
  EXPECT_GT(found.linear_pull_off_force, 3.0 * truth);
  EXPECT_EQ(found.realisations.size(), 3U);
  EXPECT_TRUE(found.warnings.empty()) << found.warnings.front();
}

TEST_F(DeviceForceTest, ContactsWithoutRoomInTheScansStandAsUnevenAsThoseThatAreCut) {
  constexpr int kContacts = 60;
  for (const int seed : {1, 2}) {
    const cv::Mat smooth = surfaceOf(kSide, 100e-9, 3e-9, seed);  // waves as long as a contact
    const double area = kContacts * areaOfPixels(24);
    surfaces_.scans = {part("whole", smooth, 0, 0, kSide)};
    const DeviceForce cut = force(area, kContacts);
    surfaces_.scans = {part("small", smooth, 0, 0, 160)};
    const DeviceForce made = force(area, kContacts);
    ASSERT_TRUE(cut.is_cut_from_scans);
    ASSERT_FALSE(made.is_cut_from_scans);
    EXPECT_GT(made.pull_off_force, cut.pull_off_force / 4.0) << seed;
    EXPECT_LT(made.pull_off_force, cut.pull_off_force * 4.0) << seed;
  }
}

TEST_F(DeviceForceTest, AFewScansOfTheDevicesSizeCountAlikeWhateverTheSeed) {
  surfaces_.scans.clear();
  for (int i = 0; i < 3; ++i) {
    surfaces_.scans.push_back(part("scan " + std::to_string(i), large_, 0, 256 * i, 256));
  }
  options_.realisations = 6;
  const double first = force(areaOfPixels(256)).pull_off_force;
  for (options_.seed = 2; options_.seed < 5; ++options_.seed)
    EXPECT_DOUBLE_EQ(force(areaOfPixels(256)).pull_off_force, first) << options_.seed;
}

TEST_F(DeviceForceTest, ContactsOfAFewPixelsMissAScan) {
  const DeviceForce found = force(1e-12, 1000);
  EXPECT_NE(found.missing_scan.find("each of 1000 contacts on 1e-12 m^2 is 31.6 nm wide, less than "
                                    "8 pixels of 10 nm: a scan with pixels of 4 nm or less"),
            std::string::npos)
      << found.missing_scan;
  EXPECT_EQ(force(1000 * areaOfPixels(8), 1000).missing_scan, "");
}

TEST_F(DeviceForceTest, TheOrderOfTheScansTellsNothing) {
  surfaces_.scans.push_back(part("third", large_, 200, 100, 256));
  surfaces_.scans.push_back(part("wide", large_, 0, 0, kSide));
  const DeviceForce first = force(areaOfPixels(420));
  for (int rotation = 1; rotation < 4; ++rotation) {
    std::rotate(surfaces_.scans.begin(), surfaces_.scans.begin() + 1, surfaces_.scans.end());
    if (rotation == 2) std::swap(surfaces_.scans[0], surfaces_.scans[2]);
    const DeviceForce found = force(areaOfPixels(420));
    EXPECT_EQ(found.pull_off_force, first.pull_off_force) << rotation;
    EXPECT_EQ(found.pull_off_force_lower, first.pull_off_force_lower);
    EXPECT_EQ(found.pull_off_force_upper, first.pull_off_force_upper);
    EXPECT_EQ(found.apparent_work_of_adhesion, first.apparent_work_of_adhesion);
    EXPECT_EQ(found.linear_pull_off_force, first.linear_pull_off_force);
  }
}

TEST_F(DeviceForceTest, TheSameSeedGivesTheSameFigures) {
  const DeviceForce one = force(areaOfPixels(300));
  const DeviceForce again = force(areaOfPixels(300));
  EXPECT_EQ(one.pull_off_force, again.pull_off_force);
  EXPECT_EQ(one.pull_off_force_upper, again.pull_off_force_upper);
  options_.seed = 2;
  EXPECT_NE(force(areaOfPixels(300)).pull_off_force, one.pull_off_force);
}

TEST_F(DeviceForceTest, LongWavesThatAreMissingAreNamedAndWidenTheInterval) {
  const cv::Mat steep = filteredNoise(whiteNoise(kSide, kSide, 2), [](int row, int col) {
    const double q = std::hypot(waveNumber(col, kSide, kPitch), waveNumber(row, kSide, kPitch));
    return row == 0 && col == 0 ? 0.0 : std::pow(q, -1.8);
  });
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(steep, mean, deviation);
  const cv::Mat heights = steep * (5e-9 / deviation[0]);
  surfaces_.scans = {part("first", heights, 0, 0, 256), part("second", heights, 450, 380, 256)};
  const DeviceForce without = force(areaOfPixels(kSide));
  ASSERT_EQ(without.warnings.size(), 1U);
  EXPECT_NE(without.warnings[0].find("measure a field of at least 7.7 um"), std::string::npos)
      << without.warnings[0];
  // the spectrum goes on to waves as long as the device, and says that nobody has measured those
  EXPECT_FALSE(without.spectrum.front().is_measured);
  EXPECT_NEAR(without.spectrum.front().wavelength, kSide * kPitch, 1e-3 * kSide * kPitch);
  EXPECT_GT(without.spectrum.front().density_upper, without.spectrum.front().density);
  EXPECT_GT(without.spectrum.front().density, without.spectrum.front().density_lower);
  EXPECT_TRUE(without.spectrum.back().is_measured);
  cv::Mat coarse;
  cv::resize(heights, coarse, cv::Size(kSide / 8, kSide / 8), 0.0, 0.0, cv::INTER_AREA);
  surfaces_.scans.push_back({"wide", HeightMap(coarse, 8 * kPitch, 8 * kPitch)});
  const DeviceForce with = force(areaOfPixels(kSide));
  EXPECT_TRUE(with.warnings.empty()) << with.warnings.front();
  EXPECT_TRUE(with.spectrum.front().is_measured);
}

NamedScan wideScan(const cv::Mat& heights) {
  cv::Mat coarse;
  cv::resize(heights, coarse, heights.size() / 8, 0.0, 0.0, cv::INTER_AREA);
  return {"wide", HeightMap(coarse, 8 * kPitch, 8 * kPitch)};
}

/// White light leaves pixels out: AFM and white light together gave no force.
TEST_F(DeviceForceTest, MissingPixelsOfTheWideScanAreFilledAndTold) {
  surfaces_.scans.push_back(wideScan(large_));
  const DeviceForce whole = force(areaOfPixels(400));
  HeightMap& wide = surfaces_.scans.back().surface;
  wide = analytic::withInvalidPixel(wide, 40, 50);
  const DeviceForce one = force(areaOfPixels(400));
  EXPECT_NEAR(one.pull_off_force / whole.pull_off_force, 1.0, 0.05);
  EXPECT_TRUE(isTold(one, "wide: 1 of 9216 pixels are missing"));
  EXPECT_FALSE(isTold(one, "first: "));
}

/// Scattered ones and discs made 0.83 to 2.8 of the force without them.
TEST_F(DeviceForceTest, MissingPixelsOfFineScansHardlyMoveTheForce) {
  const double whole = force(areaOfPixels(400)).pull_off_force;
  const std::vector<NamedScan> scans = surfaces_.scans;
  for (const bool are_scattered : {true, false}) {
    for (std::size_t i = 0; i < scans.size(); ++i) {
      const int seed = 1 + static_cast<int>(i);
      surfaces_.scans[i].surface = are_scattered ? withScatteredHoles(scans[i].surface, 0.05, seed)
                                                 : withRoundHoles(scans[i].surface, 0.05, seed);
    }
    EXPECT_NEAR(std::log(force(areaOfPixels(400)).pull_off_force / whole), 0.0, 0.15)
        << are_scattered;
  }
}

/// As a region leaves it.
TEST_F(DeviceForceTest, AScanWithoutItsSurroundingsIsUsed) {
  const double whole = force(areaOfPixels(400)).pull_off_force;
  cv::Mat heights = surfaces_.scans[0].surface.heights().clone();
  cv::Mat inside = cv::Mat::zeros(heights.size(), CV_8UC1);
  cv::circle(inside, cv::Point(128, 128), 110, cv::Scalar(255), cv::FILLED);
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), ~inside);
  surfaces_.scans[0].surface = HeightMap(heights, kPitch, kPitch);
  const DeviceForce found = force(areaOfPixels(400));
  EXPECT_NEAR(std::log(found.pull_off_force / whole), 0.0,
              0.4);  // of one scan less than half is left
  EXPECT_TRUE(isTold(found, "first: ")) << found.warnings.front();
}

TEST_F(DeviceForceTest, MoreScansAreSurerOfContactsThatAreCutFromThem) {
  // 192 pixels hold a few contacts, of which another place may have others
  const auto widthOf = [&](int per_side) {
    surfaces_.scans.clear();
    for (int i = 0; i < per_side * per_side; ++i) {
      surfaces_.scans.push_back(
          part("scan " + std::to_string(i), large_, i / per_side * 192, i % per_side * 192, 192));
    }
    const DeviceForce found = force(areaOfPixels(128));
    EXPECT_TRUE(found.is_cut_from_scans);
    return std::log(found.pull_off_force_upper / found.pull_off_force_lower);
  };
  options_.realisations = 8;
  EXPECT_LT(widthOf(4), 0.9 * widthOf(2));
}

TEST_F(DeviceForceTest, ContactsAreCutWhereTheScansWereMeasured) {
  for (NamedScan& scan : surfaces_.scans) {
    cv::Mat heights = scan.surface.heights().clone();
    heights(cv::Rect(0, 0, 128, 256)).setTo(std::numeric_limits<double>::quiet_NaN());
    heights.at<double>(0, 0) = 0.0;  // the frame stays
    scan.surface = HeightMap(heights, kPitch, kPitch);
  }
  for (const Realisation& realisation : force(areaOfPixels(40)).realisations) {
    EXPECT_TRUE(std::isfinite(realisation.pull_off_force));
  }
}

TEST_F(DeviceForceTest, AScanOfWhichNothingWasMeasuredIsNamed) {
  const cv::Mat nothing(64, 64, CV_64FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  surfaces_.scans.push_back({"dark.opd", HeightMap(nothing, kPitch, kPitch)});
  try {
    force(areaOfPixels(kSide));
    FAIL() << "was taken";
  } catch (const SurfaceError& error) {
    EXPECT_NE(std::string(error.what()).find("dark.opd: its measured pixels lie within 0 x 0"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("Leave it out"), std::string::npos) << error.what();
  }
}

/// It counted as two, and halved the interval.
TEST_F(DeviceForceTest, AScanThatIsGivenTwiceCountsOnce) {
  const DeviceForce once = force(areaOfPixels(400));
  const std::vector<NamedScan> scans = surfaces_.scans;
  cv::Mat single;
  scans[0].surface.heights().convertTo(single, CV_32F, 1.0, 1e-7);
  surfaces_.scans.push_back({"copy", HeightMap(single, kPitch, kPitch)});
  surfaces_.scans.push_back(scans[1]);
  const DeviceForce twice = force(areaOfPixels(400));
  EXPECT_EQ(twice.pull_off_force, once.pull_off_force);
  EXPECT_EQ(twice.pull_off_force_lower, once.pull_off_force_lower);
  EXPECT_EQ(twice.parts_of_scans.size(), 2U);
  EXPECT_TRUE(isTold(twice, "copy: shows the heights of first again"));
  EXPECT_TRUE(isTold(twice, "second: is given twice"));
  // noise alone makes another scan of the same place
  cv::Mat noise(single.size(), CV_32FC1);
  cv::RNG random(1);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 1e-10);
  surfaces_.scans = scans;
  surfaces_.scans.push_back({"again", HeightMap(single + noise, kPitch, kPitch)});
  EXPECT_FALSE(isTold(force(areaOfPixels(400)), "again"));
}

/// Made surfaces are alike everywhere: a smooth place that bonds by itself was in no interval.
TEST_F(DeviceForceTest, APlaceThatBondsByItselfIsNamedAndInTheInterval) {
  const DeviceForce even = force(areaOfPixels(400));
  cv::Mat heights = surfaces_.scans[1].surface.heights().clone();
  heights(cv::Rect(64, 128, 64, 64)) *= 0.02;
  surfaces_.scans[1].surface = HeightMap(heights, kPitch, kPitch);
  const DeviceForce uneven = force(areaOfPixels(400));
  EXPECT_TRUE(
      isTold(uneven,
             "second: its places differ by more than chance. The 0.64 x 0.64 um about x = 0.96 um, "
             "y = 1.6 um hold most"));
  EXPECT_TRUE(isTold(uneven, "By itself it bonds all over"));
  EXPECT_GT(uneven.pull_off_force_upper / uneven.pull_off_force,
            2.0 * even.pull_off_force_upper / even.pull_off_force);
  // less than the law of all scans says no place holds
  EXPECT_GT(uneven.pull_off_force_lower / uneven.pull_off_force,
            0.3 * even.pull_off_force_lower / even.pull_off_force);
  EXPECT_FALSE(isTold(even, "its places differ"));
}

/// Where it does not bond all over it was judged by its scan alone, in which it may lie low.
TEST_F(DeviceForceTest, TheIntervalContainsWhatThePlaceThatHoldsMostHoldsAlone) {
  cv::Mat heights = surfaces_.scans[1].surface.heights().clone();
  const cv::Rect place(64, 128, 64, 64);
  heights(place) *= 0.15;
  surfaces_.scans[1].surface = HeightMap(heights, kPitch, kPitch);
  const Prediction alone =
      AdhesionModel(model_).predict(levelled(HeightMap(heights(place).clone(), kPitch, kPitch)));
  ASSERT_FALSE(alone.is_conforming);
  const DeviceForce one = force(areaOfPixels(400));
  EXPECT_GT(alone.pull_off_force, 3.0 * one.pull_off_force);
  EXPECT_GE(one.pull_off_force_upper, alone.pull_off_force);
  EXPECT_GE(one.apparent_work_of_adhesion_upper,
            alone.apparent_work_of_adhesion * areaOfPixels(64) / one.area);
  EXPECT_TRUE(isTold(one, "If the device rests on such a place alone, it holds up to "));
  const DeviceForce four = force(4.0 * areaOfPixels(400), 4);
  EXPECT_GE(four.pull_off_force_upper, 4.0 * alone.pull_off_force);
}

TEST_F(DeviceForceTest, APlaceOfTheCounterSurfaceIsNamed) {
  cv::Mat heights = part("", large_, 300, 300, 256).surface.heights().clone();
  heights(cv::Rect(64, 128, 64, 64)) *= 0.02;
  surfaces_.counter_surface = {{"above", HeightMap(heights, kPitch, kPitch)}};
  const DeviceForce found = force(areaOfPixels(400));
  EXPECT_TRUE(
      isTold(found, "above: its places differ by more than chance. The 0.64 x 0.64 um about x = "));
  EXPECT_FALSE(isTold(found, "first: its places"));
  EXPECT_FALSE(isTold(found, "By itself it bonds all over")) << "under the rough scans";
}

TEST_F(DeviceForceTest, ScansThatContradictEachOtherAreNamed) {
  surfaces_.scans.push_back(
      {"other",
       HeightMap(3.0 * part("", large_, 300, 300, 256).surface.heights(), kPitch, kPitch)});
  EXPECT_TRUE(isTold(force(areaOfPixels(300)), "other contradicts the other scans"));
}

TEST_F(DeviceForceTest, TheIntervalHoldsTheDeviceOfAScanThatContradictsTheOthers) {
  const double area = areaOfPixels(kSide);
  const DeviceForce alone = force(area);
  surfaces_.scans.push_back(
      {"other",
       HeightMap(5.0 * part("", large_, 300, 300, 256).surface.heights(), kPitch, kPitch)});
  const DeviceForce found = force(area);
  EXPECT_GT(found.pull_off_force_upper, alone.pull_off_force);
  EXPECT_TRUE(isTold(found, "as the one that holds most"));
}

TEST_F(DeviceForceTest, ALoadUnderWhichNothingFlowsChangesNothing) {
  model_.lower.hardness = model_.upper.hardness = 60e9;
  const double area = areaOfPixels(kSide);
  const DeviceForce unpressed = force(area);
  model_.load.pressure = 20e6;
  model_.load.setMechanicalLoad(20e6 * areaOfPixels(256));
  const DeviceForce pressed = force(area);
  EXPECT_NEAR(pressed.pull_off_force, unpressed.pull_off_force, 0.02 * unpressed.pull_off_force);
}

/// Summits of domes are as round as all of them, those of a Gaussian field of their spectrum are
/// sharp.
TEST_F(DeviceForceTest, SummitsThatNoLawHasAreToldAndWidenTheInterval) {
  large_ = domes();
  surfaces_.scans = {part("first", large_, 0, 0, 256), part("second", large_, 450, 380, 256)};
  options_.realisations = 8;  // of three, chance decides whether a misfit shows
  const double truth =
      AdhesionModel(model_).predict(HeightMap(large_, kPitch, kPitch)).pull_off_force;
  const DeviceForce found = force(areaOfPixels(kSide));
  EXPECT_TRUE(isTold(found, "times as strongly as scans of the surfaces that were made"));
  double made = 0.0;  // mean logarithm
  for (const Realisation& realisation : found.realisations) {
    made += std::log(realisation.pull_off_force) / static_cast<double>(found.realisations.size());
  }
  EXPECT_GT(std::log(found.pull_off_force), made + 0.2);
  EXPECT_LT(std::abs(std::log(found.pull_off_force / truth)), std::abs(made - std::log(truth)));
  EXPECT_LT(found.pull_off_force_lower, truth);
  EXPECT_GT(found.pull_off_force_upper, truth);
}

/// Contacts smaller than the scans are parts of them: no surface is made, and their force is that
/// of such parts.
TEST_F(DeviceForceTest, SmallContactsArePartsOfTheScans) {
  surfaces_.scans = {
      {"flat but for one summit", HeightMap(cv::Mat::zeros(128, 128, CV_64FC1), kPitch, kPitch)}};
  cv::Mat heights = cv::Mat::zeros(128, 128, CV_64FC1);
  for (int row = 0; row < 128; ++row) {
    for (int col = 0; col < 128; ++col) {
      const double square =
          (std::pow((row % 32) - 15.5, 2) + std::pow((col % 32) - 15.5, 2)) * kPitch * kPitch;
      heights.at<double>(row, col) = -square / (2.0 * 200e-9);
    }
  }
  surfaces_.scans = {{"spheres", HeightMap(heights, kPitch, kPitch)}};
  // each part of 32 pixels holds one sphere's summit or its parts; four of them share a height
  const DeviceForce found = force(4.0 * areaOfPixels(32), 4);
  const double sphere =
      AdhesionModel(model_)
          .predict(HeightMap(heights(cv::Rect(0, 0, 32, 32)).clone(), kPitch, kPitch))
          .pull_off_force;
  EXPECT_GT(found.pull_off_force, 1.5 * sphere);
  EXPECT_LT(found.pull_off_force, 4.5 * sphere);
}

TEST_F(DeviceForceTest, ContactsShareOneHeight) {
  const double area = areaOfPixels(kSide);
  const DeviceForce one = force(area);
  const DeviceForce many = force(area, 16);
  // the area decides, not into how many pieces of many correlation lengths it is cut
  EXPECT_NEAR(std::log(many.pull_off_force / one.pull_off_force), 0.0, 0.8);
}

TEST_F(DeviceForceTest, LargerAreasThanAreMadeGoOnAsTheForceHasGrown) {
  options_.max_cells = 384.0 * 384.0;
  const DeviceForce found = force(areaOfPixels(kSide));
  const double truth =
      AdhesionModel(model_).predict(HeightMap(large_, kPitch, kPitch)).pull_off_force;
  EXPECT_GT(found.pull_off_force, truth / 4.0);
  EXPECT_LT(found.pull_off_force, truth * 4.0);
  ASSERT_FALSE(found.warnings.empty());
  EXPECT_NE(found.warnings.back().find("4 times the area that device_force/max_cells makes"),
            std::string::npos)
      << found.warnings.back();
}

TEST_F(DeviceForceTest, SurfacesThatConformGoWithArea) {
  for (NamedScan& scan : surfaces_.scans)
    scan.surface = HeightMap(0.02 * scan.surface.heights(), kPitch, kPitch);
  const DeviceForce found = force(areaOfPixels(kSide));
  EXPECT_TRUE(found.is_conforming);
  EXPECT_NEAR(found.pull_off_force / found.linear_pull_off_force, 1.0, 0.05);
  EXPECT_NE(found.warnings.back().find("bond all over"), std::string::npos);
}

/// A load presses the device as it presses the scan, by area.
TEST_F(DeviceForceTest, ALoadOnTheScanIsAPressureOnTheDevice) {
  const DeviceForce unloaded = force(areaOfPixels(420));
  model_.load.mechanical_load = 1e8 * areaOfPixels(256);
  const DeviceForce loaded = force(areaOfPixels(420));
  EXPECT_LT(loaded.separation_at_rest, unloaded.separation_at_rest);
}

/// The limit is for what is stated, the load on the first scan; on a larger one the same pressure
/// is more.
TEST_F(DeviceForceTest, ALargerScanMayBePressedByMoreThanTheLargestLoadThatMayBeStated) {
  surfaces_.scans.push_back(part("large", large_, 0, 0, kSide));
  model_.load.mechanical_load = model_.load.max_mechanical_load = 1e8 * areaOfPixels(256);
  EXPECT_GT(force(areaOfPixels(420)).pull_off_force, 0.0);
}

/// Many contacts of a soft metal flow place by place, on made surfaces as on the whole one.
TEST_F(DeviceForceTest, ALoadThatMakesPlacesFlowMakesItHoldMore) {
  model_.lower.hardness = model_.upper.hardness = 1.5e9;
  const double side = areaOfPixels(kSide);
  double before = force(side).pull_off_force;
  for (const double pressure : {20e6, 100e6}) {
    model_.load.mechanical_load = pressure * areaOfPixels(256);
    const DeviceForce pressed = force(side);
    EXPECT_GT(pressed.pull_off_force, 1.2 * before) << pressure;
    EXPECT_FALSE(isTold(pressed, "whole contacts"));
    before = pressed.pull_off_force;
    Options of_whole = model_;
    of_whole.load.mechanical_load = pressure * side;
    const double truth =
        AdhesionModel(of_whole).predict(HeightMap(large_, kPitch, kPitch)).pull_off_force;
    EXPECT_NEAR(std::log(pressed.pull_off_force / truth), 0.0, std::log(2.0)) << pressure;
  }
}

TEST_F(DeviceForceTest, ContactsThatFlowAreCutToWhatAFrameHolds) {
  constexpr int kLarge = 2200;
  surfaces_.scans = {part("large", surfaceOf(kLarge, 60e-9, 5e-9, 3), 0, 0, kLarge)};
  model_.lower.hardness = model_.upper.hardness = 1.5e9;
  model_.load.mechanical_load = 20e6 * areaOfPixels(kLarge);
  const DeviceForce found = force(areaOfPixels(2100));
  EXPECT_TRUE(found.is_cut_from_scans);
  EXPECT_GT(found.pull_off_force, 0.0);
}

TEST_F(DeviceForceTest, WithoutAdhesionNothingHolds) {
  model_.interface.work_of_adhesion = 0.0;
  const DeviceForce found = force(areaOfPixels(420));
  EXPECT_EQ(found.pull_off_force, 0.0);
  EXPECT_EQ(found.pull_off_force_upper, 0.0);
}

TEST_F(DeviceForceTest, TwoRoughBodiesHoldLessThanOne) {
  const DeviceForce one = force(areaOfPixels(420));
  surfaces_.counter_surface = {part("counter", surfaceOf(512, 60e-9, 5e-9, 8), 0, 0, 256)};
  const DeviceForce two = force(areaOfPixels(420));
  EXPECT_GT(two.separation_at_rest, 1.2 * one.separation_at_rest);
}

TEST_F(DeviceForceTest, ProgressEndsItWhereItThrows) {
  double last = -1.0;
  EXPECT_THROW(deviceForce(surfaces_, {areaOfPixels(300), 1}, model_, uncertainty_, options_,
                           [&](double share) {
                             EXPECT_GE(share, last);
                             last = share;
                             if (share > 0.3) throw SurfaceError("enough");
                           }),
               SurfaceError);
  EXPECT_LT(last, 0.6);
}

TEST_F(DeviceForceTest, RefusesWhatMakesNoSense) {
  EXPECT_THROW(force(0.0), OptionsError);
  EXPECT_THROW(force(-1e-9), OptionsError);
  EXPECT_THROW(force(std::numeric_limits<double>::quiet_NaN()), OptionsError);
  EXPECT_THROW(force(1e-9, 0), OptionsError);
  options_.realisations = 2;
  EXPECT_THROW(force(1e-9), OptionsError);
  options_.realisations = 3;
  surfaces_.scans.clear();
  EXPECT_THROW(force(1e-9), OptionsError);
  surfaces_.scans = {{"flat", HeightMap(cv::Mat::zeros(64, 64, CV_64FC1), kPitch, kPitch)}};
  EXPECT_NO_THROW(force(areaOfPixels(512)));  // it conforms
}

TEST_F(DeviceForceTest, thinBodiesAreAMosaicWhoseForceGoesWithArea) {
  model_.lower.thickness = 40e-9;
  const DeviceForce once = force(areaOfPixels(1200));
  const DeviceForce twice = force(2.0 * areaOfPixels(1200));
  const auto tellsOfMosaic = [](const DeviceForce& found) {
    return std::any_of(found.warnings.begin(), found.warnings.end(),
                       [](const std::string& warning) {
                         return warning.find("is a mosaic of") != std::string::npos;
                       });
  };
  EXPECT_TRUE(tellsOfMosaic(once));
  EXPECT_TRUE(tellsOfMosaic(twice));
  EXPECT_NEAR(twice.pull_off_force, 2.0 * once.pull_off_force, 0.2 * once.pull_off_force);
  EXPECT_NEAR(twice.contacts, 2.0 * once.contacts, 0.3 * once.contacts);
  EXPECT_EQ(twice.area, 2.0 * areaOfPixels(1200));
  model_.lower.thickness = 0.0;
  EXPECT_GT(once.pull_off_force, 1.5 * force(areaOfPixels(1200)).pull_off_force);
}

/// A plate that tilts comes to rest on more contacts than the one that is highest.
TEST_F(DeviceForceTest, aPlateOfOneContactTilts) {
  const DeviceForce guided = force(areaOfPixels(420));
  model_.guidance = Guidance::kFree;
  const DeviceForce free = force(areaOfPixels(420));
  EXPECT_LT(free.separation_at_rest, guided.separation_at_rest);
  EXPECT_GT(free.pull_off_force, guided.pull_off_force);
  EXPECT_TRUE(free.warnings.empty()) << free.warnings.front();
  EXPECT_EQ(free.linear_pull_off_force, guided.linear_pull_off_force);
}

/// The same made surface, as the frame that it is.
TEST_F(DeviceForceTest, aTiltedPlateIsTheFramesOwn) {
  model_.guidance = Guidance::kFree;
  const DevicePieces pieces = piecesOf({areaOfPixels(300), 1}, kPitch, 1e6);
  const DeviceLaws laws = lawsOf(surfaces_, options_, TailForm::kExponential);
  DeviceSurface surface(laws, pieces, 5);
  DeviceAreaSolver solver(model_, areaOfPixels(256), pieces);
  const Realisation found = solver.realise(surface);
  cv::Mat relief(300, 300, CV_32FC1);
  surface.heights(0, 0, relief);
  const Prediction whole = AdhesionModel(model_).predict(HeightMap(relief, kPitch, kPitch));
  EXPECT_EQ(found.pull_off_force, whole.pull_off_force);
  EXPECT_EQ(found.apparent_work_of_adhesion, whole.apparent_work_of_adhesion);
  EXPECT_EQ(found.separation_at_rest, whole.mean_gap);
}

/// Few cells of a surface are kept at first: where a load presses far more than those, all of them
/// are.
TEST_F(DeviceForceTest, whatIsFoundByFewCellsIsWhatAllOfThemSay) {
  const DevicePieces pieces = piecesOf({areaOfPixels(600), 1}, kPitch, 1e6);
  const DeviceLaws laws = lawsOf(surfaces_, options_, TailForm::kExponential);
  DeviceSurface surface(laws, pieces, 5);
  AreaCells all(kPitch, kPitch);
  surface.visitTiles(0, surface.rows(),
                     [&](int piece, std::int64_t row, std::int64_t col, const cv::Mat& tile) {
                       all.add(rowInArea(pieces, piece, row), col, tile);
                     });
  AreaCells few(kPitch, kPitch, {1.0, 1 << 16});
  surface.visitTiles(0, surface.rows(),
                     [&](int piece, std::int64_t row, std::int64_t col, const cv::Mat& tile) {
                       few.add(rowInArea(pieces, piece, row), col, tile);
                     });
  int beyond_few = 0;
  for (const double pressure : {0.0, 1e6, 3e7, 1e9}) {
    SCOPED_TRACE(pressure);
    model_.load.max_mechanical_load = 1.0;
    model_.load.setMechanicalLoad(pressure * areaOfPixels(256));
    DeviceAreaSolver by_few(model_, areaOfPixels(256), pieces);
    DeviceAreaSolver by_all(model_, areaOfPixels(256), pieces);
    const Realisation found = by_few.realise(surface);
    const Realisation expected = by_all.realise(all, surface);
    EXPECT_EQ(found.pull_off_force, expected.pull_off_force);
    EXPECT_EQ(found.separation_at_rest, expected.separation_at_rest);
    EXPECT_EQ(found.contacts, expected.contacts);
    EXPECT_EQ(by_few.warnings(), by_all.warnings());
    Options loaded = model_;
    loaded.load.setMechanicalLoad(pressure * few.area());
    const AreaAdhesion with_few = areaAdhesion(few, loaded);
    beyond_few += !with_few.is_enough || with_few.took_all_cells ? 1 : 0;
  }
  EXPECT_GT(beyond_few, 0);
  EXPECT_LT(beyond_few, 4);
}

TEST_F(DeviceForceTest, platesThatCannotBeTiltedStayLevelAndSaySo) {
  const DeviceForce guided = force(areaOfPixels(420), 4);
  model_.guidance = Guidance::kFree;
  const DeviceForce free = force(areaOfPixels(420), 4);
  EXPECT_EQ(free.pull_off_force, guided.pull_off_force);
  EXPECT_TRUE(isTold(free, "where its contacts lie is not known"));
  EXPECT_NE(whyLevel(piecesOf({areaOfPixels(3000), 1}, kPitch, 1e8)).find("3000 x 3000 pixels"),
            std::string::npos);
  EXPECT_EQ(whyLevel(piecesOf({areaOfPixels(2048), 1}, kPitch, 1e8)), "");
}

TEST_F(DeviceForceTest, aBlockIsAsGoodAsThickAndSaysSo) {
  const DeviceForce thick = force(areaOfPixels(600));
  model_.upper.thickness = 20e-6;
  const DeviceForce block = force(areaOfPixels(600));
  EXPECT_EQ(block.pull_off_force, thick.pull_off_force);
  EXPECT_EQ(block.pull_off_force_upper, thick.pull_off_force_upper);
  EXPECT_EQ(block.warnings.size(), thick.warnings.size() + 1);
}

TEST_F(DeviceForceTest, severalModelsHaveTheForcesOfEach) {
  std::vector<Options> models(2, model_);
  models[1].interface.work_of_adhesion *= 20.0;
  for (const double side : {200.0, 260.0}) {  // parts of the scans, made surfaces
    const DeviceArea area{areaOfPixels(side), 1};
    const std::vector<DeviceForce> together =
        deviceForces(surfaces_, area, models, uncertainty_, options_);
    ASSERT_EQ(together.size(), models.size());
    for (std::size_t i = 0; i < models.size(); ++i) {
      const DeviceForce alone = deviceForce(surfaces_, area, models[i], uncertainty_, options_);
      EXPECT_EQ(together[i].pull_off_force, alone.pull_off_force) << side << " " << i;
      EXPECT_EQ(together[i].pull_off_force_lower, alone.pull_off_force_lower);
      EXPECT_EQ(together[i].apparent_work_of_adhesion_upper, alone.apparent_work_of_adhesion_upper);
      EXPECT_EQ(together[i].warnings, alone.warnings);
      EXPECT_EQ(together[i].realisations.size(), alone.realisations.size());
      EXPECT_EQ(together[i].made_surface.rows(), alone.made_surface.rows());
    }
    EXPECT_LT(together[0].pull_off_force, together[1].pull_off_force);
  }
}

}  // namespace
}  // namespace mems_stiction
