#include "separation/summit_bending.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace mems_stiction {
namespace {

/// What keeps equations of summits that hardly know of each other solvable.
constexpr double kRidge = 1e-9;

int wrapped(int index, int count) { return (index % count + count) % count; }

}  // namespace

SummitBending::SummitBending(const GapField& field, ReliefSpectrum& relief, const ExtraCompliance& compliance,
                             double apart)
    : relief_(relief),
      compliance_(compliance),
      apart_(apart),
      area_(relief.blocks().area() * relief.blockArea()),
      tops_(relief.blocks(), -std::numeric_limits<double>::infinity()),
      is_free_(relief.blocks(), 1) {
  std::vector<double> line(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line.data());
    const auto block_row = static_cast<int>(static_cast<std::int64_t>(row) * tops_.rows / field.rows());
    for (int col = 0; col < field.cols(); ++col) {
      const auto block_col = static_cast<int>(static_cast<std::int64_t>(col) * tops_.cols / field.cols());
      double& top = tops_(block_row, block_col);
      top = std::max(top, -line[static_cast<std::size_t>(col)]);
    }
  }
  cv::Mat1d force(relief.weighedSize(), 0.0);
  force(0, 0) = 1.0 / relief.blockArea();
  kernel_ = relief.weighed(force, [&](double q) { return compliance_.at(q); }).clone();
  bending_ = cv::Mat1d(relief.blocks(), 0.0);
}

std::vector<cv::Point> SummitBending::images(const cv::Point& place) const {
  if (relief_.repeats()) return {place};
  const cv::Size all = kernel_.size();
  return {place,
          {all.width - 1 - place.x, place.y},
          {place.x, all.height - 1 - place.y},
          {all.width - 1 - place.x, all.height - 1 - place.y}};
}

bool SummitBending::addSummit() {
  double highest = -std::numeric_limits<double>::infinity();
  cv::Point summit(-1, -1);
  for (int row = 0; row < tops_.rows; ++row) {
    for (int col = 0; col < tops_.cols; ++col) {
      const double height = tops_(row, col) - bending_(row, col);
      if (is_free_(row, col) == 0 || !(height > highest)) continue;
      highest = height;
      summit = {col, row};
    }
  }
  if (summit.x < 0) return false;
  summits_.push_back(summit);
  for (int row = 0; row < tops_.rows; ++row) {
    for (int col = 0; col < tops_.cols; ++col) {
      for (const cv::Point& image : images(summit)) {
        int across = std::abs(col - image.x);
        int along = std::abs(row - image.y);
        across = std::min(across, kernel_.cols - across);
        along = std::min(along, kernel_.rows - along);
        if (std::hypot(across * relief_.blockWidth(), along * relief_.blockHeight()) <= apart_) is_free_(row, col) = 0;
      }
    }
  }
  if (count() > 1) bend();
  return true;
}

void SummitBending::bend() {
  const int n = count();
  // forces in units of what bends by 1 m at its own place
  const double unit = kernel_(0, 0);
  cv::Mat1d equations(n + 1, n + 1, 0.0);
  cv::Mat1d heights(n + 1, 1, 0.0);
  for (int i = 0; i < n; ++i) {
    const cv::Point& place = summits_[static_cast<std::size_t>(i)];
    for (int j = 0; j < n; ++j) {
      for (const cv::Point& image : images(summits_[static_cast<std::size_t>(j)])) {
        equations(i, j) +=
            kernel_(wrapped(place.y - image.y, kernel_.rows), wrapped(place.x - image.x, kernel_.cols)) / unit;
      }
    }
    equations(i, i) += kRidge;
    equations(i, n) = equations(n, i) = 1.0;
    heights(i, 0) = tops_(place);
  }
  cv::Mat1d forces;
  cv::solve(equations, heights, forces, cv::DECOMP_LU);
  cv::Mat1d loads(kernel_.size(), 0.0);
  for (int j = 0; j < n; ++j) {
    for (const cv::Point& image : images(summits_[static_cast<std::size_t>(j)])) {
      loads(image) += forces(j, 0) / unit / relief_.blockArea();
    }
  }
  relief_.weighed(loads, [&](double q) { return compliance_.at(q); })(cv::Rect({0, 0}, relief_.blocks()))
      .copyTo(bending_);
  double work = 0.0;
  for (int j = 0; j < n; ++j) work += 0.5 * forces(j, 0) / unit * bending_(summits_[static_cast<std::size_t>(j)]);
  energy_ = work / area_;
}

}  // namespace mems_stiction
