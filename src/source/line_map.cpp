#include "source/line_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "errors/short_number.hpp"
#include "import/file_bytes.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/median.hpp"

namespace mems_stiction {
namespace {

constexpr double kNoHeight = std::numeric_limits<double>::quiet_NaN();

/// Lines nearer than this share of their pitch are at one place.
constexpr double kOnePlace = 0.25;

/// A step this short against the mean step is noise of a stage that stands.
constexpr double kNoStep = 0.05;

/// More lost lines for each that came tell of a wrong pitch.
constexpr double kMostLost = 10.0;

/// Neighbours further apart, over the pitch, have a gap between them that is not measured.
constexpr double kWidestGap = 1.75;

/// A place this near to a sample, over the pitch, is that sample: its neighbour may not be
/// measured.
constexpr double kSamePlace = 1e-3;

/// Heights over one coordinate, ascending.
struct Samples {
  std::vector<double> places, heights;
};

/// A line with its place along the motion.
struct PlacedLine {
  double place;
  Samples samples;  ///< over the coordinate along the line
};

void addSteps(const std::vector<double>& places, std::vector<double>& steps) {
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (places[i] > places[i - 1]) steps.push_back(places[i] - places[i - 1]);
  }
}

/// Median distance of ascending places. Where a stage stands, places are nearly one, and the mean
/// step grows as they are put together.
double lineStep(std::vector<double> places) {
  std::size_t before = 0;
  while (places.size() > 1 && places.size() != before) {
    before = places.size();
    const double least =
        kNoStep * (places.back() - places.front()) / static_cast<double>(places.size() - 1);
    places.erase(std::unique(places.begin(), places.end(),
                             [&](double one, double other) { return other - one < least; }),
                 places.end());
  }
  std::vector<double> steps;
  addSteps(places, steps);
  return medianOf(steps);
}

/// Median distance of the points along all lines: a line with few points has one vote for each.
double pointStep(const std::vector<PlacedLine>& lines) {
  std::vector<double> steps;
  for (const PlacedLine& line : lines) addSteps(line.samples.places, steps);
  return medianOf(steps);
}

/// Where a place lies between samples: the one below, and the share of the next; a negative share:
/// nowhere.
struct Between {
  std::size_t below;
  double share;
};

Between betweenSamples(const std::vector<double>& places, double place, double pitch) {
  const auto next = std::upper_bound(places.begin(), places.end(), place + kSamePlace * pitch);
  if (next == places.begin()) return {0, -1.0};
  const auto below = static_cast<std::size_t>(next - places.begin()) - 1;
  const double beyond = place - places[below];
  if (std::abs(beyond) <= kSamePlace * pitch) return {below, 0.0};
  if (next == places.end() || *next - places[below] > kWidestGap * pitch) return {below, -1.0};
  const double share = beyond / (*next - places[below]);
  return *next - place <= kSamePlace * pitch ? Between{below + 1, 0.0} : Between{below, share};
}

std::vector<double> evenPlaces(double first, double last, double pitch) {
  const double count = std::floor((last - first) / pitch + kSamePlace) + 1.0;
  if (!(count <= static_cast<double>(kMaxPixels))) {
    throw SurfaceError("a pitch of " + shortNumber(pitch) + " m gives too many places over " +
                       shortNumber(last - first) + " m");
  }
  std::vector<double> places(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = first + static_cast<double>(i) * pitch;
  return places;
}

/// The coordinate along which the points of lines differ most; 0 or 1.
int coordinateAlong(const std::vector<ScanLine>& lines) {
  double extent[2] = {0.0, 0.0};
  for (const ScanLine& line : lines) {
    for (int axis = 0; axis < 2; ++axis) {
      const auto [low, high] = std::minmax_element(
          line.begin(), line.end(),
          [axis](const auto& one, const auto& other) { return one[axis] < other[axis]; });
      extent[axis] = std::max(extent[axis], (*high)[axis] - (*low)[axis]);
    }
  }
  return extent[1] > extent[0] ? 1 : 0;
}

PlacedLine placedLine(const ScanLine& line, int along) {
  PlacedLine placed{0.0, {}};
  ScanLine sorted = line;
  std::stable_sort(sorted.begin(), sorted.end(), [along](const auto& one, const auto& other) {
    return one[along] < other[along];
  });
  for (const cv::Vec3d& point : sorted) {
    placed.place += point[1 - along] / static_cast<double>(sorted.size());
    placed.samples.places.push_back(point[along]);
    placed.samples.heights.push_back(point[2]);
  }
  return placed;
}

/// Whether the points of a line are nearer to its place along the motion than the tolerance.
bool liesAcross(const ScanLine& line, int along, double place, double most) {
  return std::all_of(line.begin(), line.end(), [&](const cv::Vec3d& point) {
    return std::abs(point[1 - along] - place) <= most;
  });
}

std::vector<double> placesOf(const std::vector<PlacedLine>& lines) {
  std::vector<double> places;
  for (const PlacedLine& line : lines) places.push_back(line.place);
  return places;
}

/// Leaves the first of those at one place.
std::size_t dropDoubled(std::vector<PlacedLine>& lines, double pitch) {
  const std::size_t before = lines.size();
  lines.erase(std::unique(lines.begin(), lines.end(),
                          [&](const auto& one, const auto& other) {
                            return other.place - one.place < kOnePlace * pitch;
                          }),
              lines.end());
  return before - lines.size();
}

double lostBetween(const std::vector<double>& places, double pitch) {
  double lost = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i)
    lost += std::max(1.0, std::round((places[i] - places[i - 1]) / pitch)) - 1.0;
  return lost;
}

/// @throw SurfaceError if far more are lost than came
void checkLost(double lost, std::size_t came, bool is_stated, double line_pitch) {
  if (lost <= kMostLost * static_cast<double>(came)) return;
  throw SurfaceError(std::string(is_stated ? "line_pitch" : "the median distance of the lines") +
                     ": " + shortNumber(line_pitch) + " m leaves " + shortNumber(lost) +
                     " places without a line, must be at most " + shortNumber(kMostLost) +
                     " for each of " + std::to_string(came) +
                     " lines: state line_pitch as the lines lie");
}

cv::Mat resampled(const std::vector<PlacedLine>& lines, const std::vector<double>& cols,
                  double pitch) {
  cv::Mat heights(static_cast<int>(lines.size()), static_cast<int>(cols.size()), CV_64FC1,
                  cv::Scalar(kNoHeight));
  for (int row = 0; row < heights.rows; ++row) {
    const Samples& samples = lines[static_cast<std::size_t>(row)].samples;
    for (int col = 0; col < heights.cols; ++col) {
      const Between at = betweenSamples(samples.places, cols[static_cast<std::size_t>(col)], pitch);
      if (at.share < 0.0) continue;
      const double low = samples.heights[at.below];
      heights.at<double>(row, col) =
          at.share == 0.0 ? low : low + at.share * (samples.heights[at.below + 1] - low);
    }
  }
  return heights;
}

cv::Mat betweenLines(const cv::Mat& lines, const std::vector<double>& places,
                     const std::vector<double>& rows, double pitch) {
  cv::Mat heights(static_cast<int>(rows.size()), lines.cols, CV_64FC1, cv::Scalar(kNoHeight));
  for (int row = 0; row < heights.rows; ++row) {
    const Between at = betweenSamples(places, rows[static_cast<std::size_t>(row)], pitch);
    if (at.share < 0.0) continue;
    const int below = static_cast<int>(at.below);
    if (at.share == 0.0) {
      lines.row(below).copyTo(heights.row(row));
    } else {
      cv::addWeighted(lines.row(below), 1.0 - at.share, lines.row(below + 1), at.share, 0.0,
                      heights.row(row));
    }
  }
  return heights;
}

cv::Mat asPoints(const std::vector<ScanLine>& lines) {
  std::size_t longest = 0;
  for (const ScanLine& line : lines) longest = std::max(longest, line.size());
  cv::Mat points(static_cast<int>(lines.size()), static_cast<int>(longest), CV_64FC3,
                 cv::Scalar(kNoHeight, kNoHeight, kNoHeight));
  for (std::size_t row = 0; row < lines.size(); ++row) {
    std::copy(lines[row].begin(), lines[row].end(), points.ptr<cv::Vec3d>(static_cast<int>(row)));
  }
  return points;
}

double firstStated(std::initializer_list<double> pitches) {
  return *std::find_if(pitches.begin(), pitches.end() - 1,
                       [](double pitch) { return pitch > 0.0; });
}

/// Their axes are turned round where the options say so.
std::vector<ScanLine> linesWithPoints(const std::vector<ScanLine>& lines,
                                      const CloudOptions& options) {
  const cv::Vec3d signs = axisSigns(options);
  std::vector<ScanLine> some;
  for (const ScanLine& line : lines) {
    ScanLine located;  // a point without a place lends none to its line
    std::copy_if(line.begin(), line.end(), std::back_inserter(located), [](const cv::Vec3d& point) {
      return std::isfinite(point[0]) && std::isfinite(point[1]);
    });
    const bool is_measured = std::any_of(located.begin(), located.end(),
                                         [](const auto& point) { return !std::isnan(point[2]); });
    if (!is_measured) continue;
    for (cv::Vec3d& point : located) point = point.mul(signs);
    some.push_back(std::move(located));
  }
  return some;
}

}  // namespace

LineMap mapOfLines(const std::vector<ScanLine>& stated, const LineMapOptions& options) {
  const std::vector<ScanLine> lines = linesWithPoints(stated, options.map);
  if (lines.size() < 2) {
    throw SurfaceError("of " + std::to_string(stated.size()) + " lines " +
                       std::to_string(lines.size()) + " have a measured point, must be at least 2");
  }
  const int along = coordinateAlong(lines);
  std::vector<PlacedLine> placed;
  for (const ScanLine& line : lines) placed.push_back(placedLine(line, along));
  const std::vector<double> stated_places = placesOf(placed);
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& one, const auto& other) { return one.place < other.place; });
  const double line_pitch = firstStated({options.line_pitch, lineStep(placesOf(placed))});
  if (!(line_pitch > 0.0)) throw SurfaceError("all lines lie at one place: nothing moved");
  const double most = std::max(options.map.grid_tolerance * line_pitch, 1e-12);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!liesAcross(lines[i], along, stated_places[i], most)) {
      CloudOptions turned = options.map;
      turned.is_up_negative = false;
      turned.mirror = Mirror::kNone;
      return {mapOfPoints(asPoints(lines), turned), 0, 0};
    }
  }
  LineMap result;
  result.doubled = dropDoubled(placed, line_pitch);
  const std::vector<double> places = placesOf(placed);
  const double lost = lostBetween(places, line_pitch);
  checkLost(lost, lines.size(), options.line_pitch > 0.0, line_pitch);
  result.lost = static_cast<std::size_t>(lost);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const PlacedLine& line : placed) {
    first = std::min(first, line.samples.places.front());
    last = std::max(last, line.samples.places.back());
  }
  const double own = pointStep(placed);
  const double pitch_along =
      firstStated({along == 0 ? options.map.pitch_x : options.map.pitch_y, own});
  const double pitch_across =
      firstStated({along == 0 ? options.map.pitch_y : options.map.pitch_x, line_pitch});
  if (!(pitch_along > 0.0)) throw SurfaceError("the lines have one point each");
  const std::vector<double> cols = evenPlaces(first, last, pitch_along);
  const std::vector<double> rows = evenPlaces(places.front(), places.back(), pitch_across);
  checkPixelCount(cols.size(), rows.size());
  cv::Mat heights = betweenLines(resampled(placed, cols, std::max(own, pitch_along)), places, rows,
                                 std::max(line_pitch, pitch_across));
  if (along == 1) {
    cv::transpose(heights, heights);  // lines run along y: x grows along the columns already
  }
  cv::flip(heights, heights, 0);  // the largest y into row 0
  const double pitch_x = along == 0 ? pitch_along : pitch_across,
               pitch_y = along == 0 ? pitch_across : pitch_along;
  result.map = {HeightMap(heights, pitch_x, pitch_y), {}};
  return result;
}

}  // namespace mems_stiction
