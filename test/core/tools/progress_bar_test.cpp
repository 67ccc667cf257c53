#include "tools/progress_bar.hpp"

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

/// It rose from 1:29 to 6:16 while the force of a device was found.
TEST(TimeLeft, FallsWhileARowIsWorkedAt) {
  TimeLeft left(3, 0);
  EXPECT_EQ(left.seconds(0, 5.0), 0.0);  // nothing is known yet
  EXPECT_DOUBLE_EQ(left.seconds(1, 10.0), 20.0);
  double before = left.seconds(1, 10.0);
  for (double elapsed = 11.0; elapsed < 60.0; elapsed += 1.0) {
    const double now = left.seconds(1, elapsed);
    EXPECT_LE(now, before) << elapsed;
    before = now;
  }
  EXPECT_DOUBLE_EQ(before, 10.0);                 // the row after it still takes its time
  EXPECT_DOUBLE_EQ(left.seconds(2, 60.0), 30.0);  // the mean knows the slow one
  EXPECT_EQ(left.seconds(2, 100.0), 0.0);
  EXPECT_EQ(left.seconds(3, 101.0), 0.0);
}

TEST(TimeLeft, RowsOfAnEarlierCallCostNothing) {
  TimeLeft left(100, 90);
  EXPECT_EQ(left.seconds(90, 1.0), 0.0);
  EXPECT_DOUBLE_EQ(left.seconds(91, 2.0), 18.0);
}

}  // namespace
}  // namespace mems_stiction
