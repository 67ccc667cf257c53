#include "device/law_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/area_load.hpp"
#include "device/scan_list.hpp"
#include "height_map/validity.hpp"
#include "numeric/constants.hpp"
#include "numeric/mean.hpp"
#include "preprocess/level.hpp"

namespace mems_stiction {
namespace {

/// The square of a difference over its standard error that is no evidence yet: two standard errors.
constexpr double kByChance = 4.0;
/// Share of a misfit at the size of the scans that is found at that of the device; the rest of it
/// is its uncertainty (doc/device.md says on which surfaces it was set).
constexpr double kCarried = 0.7;
/// A misfit that is larger by a standard error tells that summits are of another kind: on bumps of
/// one height (misfits of 5 to 19) the device's force was 0.05 to 10 times that of the whole
/// surface.
constexpr double kFailedTimes = 3.0;
/// Of many scans, so many are made and predicted in each round.
constexpr std::size_t kScansOfRound = 4;

/// Empty where none is missing.
cv::Mat missingPixels(const HeightMap& scan) {
  cv::Mat missing = ~validMask(scan.heights());
  return cv::countNonZero(missing) > 0 ? missing : cv::Mat();
}

/// Made scans get the holes of the scan that they stand for.
HeightMap withHoles(const HeightMap& made, const cv::Mat& missing) {
  if (missing.empty()) return made;
  cv::Mat heights = made.heights().clone();
  heights.setTo(std::numeric_limits<double>::quiet_NaN(), missing);
  return {heights, made.pitchX(), made.pitchY()};
}

}  // namespace

double logOf(double figure) {
  return std::log(std::max(figure, std::numeric_limits<double>::min()));
}

SurfacePair underCounterSurface(const HeightMap& scan,
                                const std::vector<HeightMap>& counter_surface) {
  for (const HeightMap& upper : counter_surface) {
    if (upper.rows() >= scan.rows() && upper.cols() >= scan.cols() &&
        upper.pitchX() == scan.pitchX() && upper.pitchY() == scan.pitchY()) {
      return {scan, HeightMap(upper.heights()(cv::Rect(0, 0, scan.cols(), scan.rows())),
                              scan.pitchX(), scan.pitchY())};
    }
  }
  return scan;
}

double LawMisfit::share() const {
  if (!(difference != 0.0)) return 0.0;
  return std::max(0.0, 1.0 - kByChance * deviation * deviation / (difference * difference));
}

double LawMisfit::shift() const { return kCarried * share() * difference; }

bool LawMisfit::fails() const {
  return share() > 0.0 && std::abs(difference) > std::log(kFailedTimes) + deviation;
}

double LawMisfit::shiftDeviation() const {
  // of a law that fails 95 % are to contain the whole misfit
  const double rest = fails() ? 1.0 / kNormal95 : 1.0 - kCarried;
  return share() * std::hypot(rest * difference, kCarried * deviation);
}

LawCheck::LawCheck(const Options& model, const std::vector<HeightMap>& scans,
                   const std::vector<HeightMap>& counter_surface)
    : options_(model), loaded_area_(areaOf(scans.front())), adhesion_(model) {
  for (const HeightMap& upper : counter_surface) missing_above_.push_back(missingPixels(upper));
  const double finest = finestPitch(scans);
  for (std::size_t place = 0; place < scans.size(); ++place) {
    if (!showsSummits(scans[place], finest)) continue;
    checked_.emplace_back();
    checked_.back().place = place;
    checked_.back().missing = missingPixels(scans[place]);
    predict(scans[place], counter_surface, checked_.back().own);
  }
}

void LawCheck::add(const std::vector<HeightMap>& made,
                   const std::vector<HeightMap>& made_counter_surface) {
  const std::size_t every = (checked_.size() + kScansOfRound - 1) / kScansOfRound;
  std::vector<HeightMap> above;
  for (std::size_t i = 0; i < made_counter_surface.size(); ++i) {
    above.push_back(withHoles(made_counter_surface[i], missing_above_[i]));
  }
  for (std::size_t i = 0; i < checked_.size(); ++i) {
    if ((i + rounds_) % every != 0) continue;
    Checked& checked = checked_[i];
    predict(withHoles(made[checked.place], checked.missing), above, checked.made);
  }
  ++rounds_;
}

void LawCheck::predict(const HeightMap& scan, const std::vector<HeightMap>& counter_surface,
                       Logs& logs) {
  adhesion_.setOptions(loadedOn(options_, loaded_area_, areaOf(scan)));
  // made scans are not levelled yet, and all are to be alike
  const Prediction found = adhesion_.predict(underCounterSurface(levelled(scan), counter_surface));
  logs.force.push_back(logOf(found.pull_off_force));
  logs.work.push_back(logOf(found.apparent_work_of_adhesion));
}

double LawCheck::largestExcess(std::vector<double> Logs::*figure) const {
  double largest = 0.0;
  for (const Checked& checked : checked_) {
    const std::vector<double>& made = checked.made.*figure;
    if (!made.empty()) largest = std::max(largest, (checked.own.*figure).front() - meanOf(made));
  }
  return largest;
}

LawMisfit LawCheck::misfit(std::vector<double> Logs::*figure) const {
  std::vector<double> differences;
  double squares = 0.0;
  double freedom = 0.0;
  double made_count = 0.0;
  for (const Checked& checked : checked_) {
    const std::vector<double>& made = checked.made.*figure;
    if (made.empty()) continue;
    const double mean = meanOf(made);
    differences.push_back((checked.own.*figure).front() - mean);
    const auto count = static_cast<double>(made.size());
    squares += squaresAbout(mean, made);
    freedom += count - 1.0;
    made_count += count;
  }
  if (differences.empty()) return {};
  LawMisfit misfit;
  misfit.difference = meanOf(differences);
  squares += squaresAbout(misfit.difference, differences);
  const auto scans = static_cast<double>(differences.size());
  freedom += scans - 1.0;
  if (!(freedom > 0.0)) return {};
  misfit.deviation = std::sqrt(squares / freedom * (1.0 / scans + 1.0 / made_count));
  return misfit;
}

}  // namespace mems_stiction
