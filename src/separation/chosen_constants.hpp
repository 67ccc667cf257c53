#pragma once
#include "mems_stiction/base/constants.hpp"
namespace mems_stiction {
namespace chosen {
constexpr double kHoldPerTabor = 0.77;
constexpr double kStiffTabor = 0.5;
constexpr double kLongestHold = 4.0;
constexpr double kLossInCompany = 0.6;
constexpr double kApart[] = {-12.0, -8.0, -6.0, -4.5, -3.5, -2.8, -2.2, -1.8, -1.5, -1.2, -1.0};
constexpr double kStep = 0.1;
constexpr double kStepPerApproach = 0.05;
constexpr double kPushing = 2.0;
constexpr int kPushingSteps = 8;
constexpr int kRestSearches = 24;
constexpr double kRestAccuracy = 1e-3;
}
}
