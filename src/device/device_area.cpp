#include "device/device_area.hpp"

#include <algorithm>
#include <cmath>

#include "approach/area_cells.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "prediction/area_adhesion.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

/// Rows between pieces, so that no contact reaches from one to the next.
constexpr std::int64_t kRowsBetween = 2;
/// Of the area: parts whose forces tell how the force of a larger area goes on.
constexpr int kPartsAlongSide = 2;

/// visit(row, col, tile of the relief) for all tiles.
template <typename Visit>
void visitTiles(const MadeSize& size, MadeSurface& lower, MadeSurface* upper, const Visit& visit) {
  const cv::Size whole = lower.tile();
  cv::Mat tile;
  cv::Mat above;
  for (std::int64_t row = 0; row < size.rows; row += whole.height) {
    const int rows = static_cast<int>(std::min<std::int64_t>(whole.height, size.rows - row));
    for (std::int64_t col = 0; col < size.cols; col += whole.width) {
      TimeLimit::check();
      const int cols = static_cast<int>(std::min<std::int64_t>(whole.width, size.cols - col));
      tile.create(rows, cols, CV_32FC1);
      lower.heights(row, col, tile);
      if (upper != nullptr) {
        above.create(rows, cols, CV_32FC1);
        upper->heights(row, col, above);
        tile -= above;
      }
      visit(row, col, tile);
    }
  }
}

}  // namespace

DevicePieces piecesOf(const DeviceArea& area, double pitch, double most_cells) {
  constexpr std::int64_t kLeastSide = 8;
  DevicePieces pieces;
  pieces.count = area.contacts;
  const double most_area = most_cells * pitch * pitch;
  const double piece_area = area.area / area.contacts;
  if (area.area > most_area) {
    // fewer pieces of their own size, or a part of one
    pieces.count = std::max(1, static_cast<int>(most_area / piece_area));
  }
  const double side = std::sqrt(std::min(piece_area, most_area));
  pieces.size.pitch_x = pieces.size.pitch_y = pitch;
  pieces.size.rows = pieces.size.cols = std::max(kLeastSide, static_cast<std::int64_t>(std::lround(side / pitch)));
  pieces.area_ratio = std::max(1.0, area.area / pieces.area());
  return pieces;
}

DeviceAreaSolver::DeviceAreaSolver(const Options& model, double loaded_area, const DevicePieces& pieces)
    : model_(model), loaded_area_(loaded_area), pieces_(pieces) {}

Realisation DeviceAreaSolver::realise(const SurfaceLaw& lower, const std::optional<SurfaceLaw>& upper,
                                      std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const SpectrumContinuation lower_end = drawnContinuation(lower, pieces_.side(), engine);
  std::optional<SpectrumContinuation> upper_end;
  if (upper) upper_end = drawnContinuation(*upper, pieces_.side(), engine);
  AreaCells cells(pieces_.size.pitch_x, pieces_.size.pitch_y);
  std::optional<MadeSurface> below;
  std::optional<MadeSurface> above;
  for (int piece = 0; piece < pieces_.count; ++piece) {
    below.emplace(lower, lower_end, pieces_.size, pieces_.side(), engine());
    if (upper) above.emplace(*upper, *upper_end, pieces_.size, pieces_.side(), engine());
    const std::int64_t first_row = piece * (pieces_.size.rows + kRowsBetween);
    visitTiles(pieces_.size, *below, above ? &*above : nullptr,
               [&](std::int64_t row, std::int64_t col, const cv::Mat& tile) { cells.add(first_row + row, col, tile); });
  }
  Options options = model_;
  options.load.setMechanicalLoad(model_.load.mechanical_load * cells.area() / loaded_area_);
  options.load.max_mechanical_load = std::max(options.load.max_mechanical_load, options.load.mechanical_load);
  const AreaAdhesion found = areaAdhesion(cells, options);
  if (found.reach != AreaReach::kHeld) {
    throw SurfaceError("so much of the device's area comes in reach of the attraction that its contacts cannot be told apart: " +
                       std::to_string(found.needed_cells) + " pixels of " + std::to_string(cells.validCount()));
  }
  force_exponents_ = found.pull_off_exponents;
  work_exponents_ = found.work_exponents;
  Realisation realisation;
  realisation.pull_off_force = found.pull_off_force * pieces_.area_ratio;
  realisation.apparent_work_of_adhesion = found.apparent_work_of_adhesion;
  realisation.contacts = found.pull_off_contact_count;
  realisation.separation_at_rest = found.separation_at_rest;
  return realisation;
}

}  // namespace mems_stiction
