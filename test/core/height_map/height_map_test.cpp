#include "mems_stiction/height_map/height_map.hpp"

#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

/// A map of pixels inside a vector, as inside a message, which only the map holds.
HeightMap mapInside(std::vector<float> pixels, std::weak_ptr<std::vector<float>>& watched) {
  const auto owner = std::make_shared<std::vector<float>>(std::move(pixels));
  watched = owner;
  return {cv::Mat(2, 2, CV_32FC1, owner->data()), 1e-9, 1e-9, owner};
}

TEST(HeightMap, HoldsWhatItsPixelsLieInAsLongAsAnyCopyShowsThem) {
  std::weak_ptr<std::vector<float>> pixels;
  HeightMap copy;
  {
    const HeightMap map = mapInside({1.0F, 2.0F, 3.0F, 4.0F}, pixels);
    EXPECT_EQ(map.heights().data, reinterpret_cast<const uchar*>(pixels.lock()->data()));
    copy = map;
  }
  ASSERT_FALSE(pixels.expired());
  EXPECT_EQ(copy.height(1, 1), 4.0);
  copy = HeightMap();
  EXPECT_TRUE(pixels.expired());
}

TEST(HeightMap, ADoubleCopyHoldsItsOwnPixelsOrTheOwnerOfThose) {
  std::weak_ptr<std::vector<float>> singles;
  const HeightMap wide = mapInside({1.0F, 2.0F, 3.0F, 4.0F}, singles).asDouble();
  EXPECT_TRUE(singles.expired());
  EXPECT_EQ(wide.height(0, 1), 2.0);

  auto doubles = std::make_shared<std::vector<double>>(4, 5.0);
  const std::weak_ptr<std::vector<double>> watched = doubles;
  const HeightMap same =
      HeightMap(cv::Mat(2, 2, CV_64FC1, doubles->data()), 1e-9, 1e-9, doubles).asDouble();
  doubles.reset();
  ASSERT_FALSE(watched.expired());
  EXPECT_EQ(same.height(1, 0), 5.0);
}

TEST(HeightMap, CopiesPixelsThatNobodyHolds) {
  std::vector<float> pixels{1.0F, 2.0F, 3.0F, 4.0F};
  const HeightMap map(cv::Mat(2, 2, CV_32FC1, pixels.data()), 1e-9, 1e-9);
  pixels.assign(4, -1.0F);
  EXPECT_EQ(map.height(1, 1), 4.0);
}

TEST(HeightMap, SharesAMatrixThatHoldsItsPixelsAndLetsGoOfAnOwnerThatItDoesNotNeed) {
  const cv::Mat heights = cv::Mat::ones(2, 3, CV_64FC1);
  auto owner = std::make_shared<int>(1);
  const HeightMap map(heights, 1e-9, 1e-9, owner);
  EXPECT_EQ(map.heights().data, heights.data);
  EXPECT_EQ(owner.use_count(), 1);
}

TEST(HeightMap, RefusesPitchesWhoseAreasAreNoNumbers) {
  const cv::Mat heights = cv::Mat::zeros(4, 4, CV_64FC1);
  EXPECT_THROW(HeightMap(heights, 1e150, 1e-9), SurfaceError);
  EXPECT_THROW(HeightMap(heights, 1e-9, 1e-200), SurfaceError);
  EXPECT_NO_THROW(HeightMap(heights, 1e-12, 1.0));
}

}  // namespace
}  // namespace mems_stiction
