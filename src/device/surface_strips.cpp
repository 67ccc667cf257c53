#include "device/surface_strips.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "approach/area_cells.hpp"
#include "device/device_mosaic.hpp"
#include "device/scan_list.hpp"
#include "device/scan_shortcomings.hpp"
#include "files/byte_pieces.hpp"
#include "files/content_hash.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

constexpr char kName[] = "mems_stiction surface strip 1\n";
/// Squares by which the heights of a surface are known, along each side, and pixels along theirs.
constexpr int kSquares = 4;
constexpr int kSquareSide = 128;
/// Share of their heights that is told one by one.
constexpr double kShareOfHighest = 0.05;

std::string rowsText(std::int64_t first, std::int64_t end) {
  return end - first == 1 ? "row " + std::to_string(first)
                          : "rows " + std::to_string(first) + " to " + std::to_string(end - 1);
}

UsableScans checkedScans(const DeviceSurfaces& surfaces, const DeviceArea& area,
                         const DeviceForceOptions& options) {
  checkDevice(surfaces, area, options);
  return usableScans(surfaces);
}

DevicePieces wholePieces(const DeviceSurfaces& surfaces, const DeviceArea& area,
                         const DeviceForceOptions& options) {
  return piecesOf(area, madePitch(surfaces, options), std::numeric_limits<double>::infinity());
}

/// How far the highest part of the heights reaches down, by squares that lie all over the surface
/// [m].
double depthOfHighest(DeviceSurface& surface) {
  std::vector<float> heights;
  const auto firstOf = [](int square, std::int64_t size, int side) {
    return (size - side) * square / (kSquares - 1);
  };
  const int height = static_cast<int>(std::min<std::int64_t>(kSquareSide, surface.rows()));
  const int width = static_cast<int>(std::min<std::int64_t>(kSquareSide, surface.cols()));
  cv::Mat square(height, width, CV_32FC1);
  for (int i = 0; i < kSquares; ++i) {
    for (int j = 0; j < kSquares; ++j) {
      surface.heights(firstOf(i, surface.rows(), height), firstOf(j, surface.cols(), width),
                      square);
      heights.insert(heights.end(), square.begin<float>(), square.end<float>());
    }
  }
  const auto place =
      static_cast<std::ptrdiff_t>((1.0 - kShareOfHighest) * static_cast<double>(heights.size()));
  std::nth_element(heights.begin(), heights.begin() + place, heights.end());
  const float level = heights[static_cast<std::size_t>(place)];
  return static_cast<double>(*std::max_element(heights.begin() + place, heights.end())) -
         static_cast<double>(level);
}

}  // namespace

DividedSurface::DividedSurface(const DeviceSurfaces& surfaces, const DeviceArea& area,
                               const Options& model, const DeviceForceOptions& options, int number,
                               std::optional<double> depth)
    : DividedSurface(checkedScans(surfaces, area, options), area, model, options, number, depth) {}

DividedSurface::DividedSurface(const UsableScans& scans, const DeviceArea& area,
                               const Options& model, const DeviceForceOptions& options, int number,
                               std::optional<double> depth)
    : laws_(std::make_unique<const DeviceLaws>(
          lawsOf(scans.surfaces, options, TailForm::kExponential))),
      surface_(*laws_, wholePieces(scans.surfaces, area, options),
               realisationSeed(options, number)),
      solver_(stiffModel(model), areaOf(scans.surfaces.scans.front().surface), surface_.pieces()),
      depth_(depth),
      shortcomings_(scans.remarks) {
  const double side = std::sqrt(area.area / area.contacts);
  for (const std::string& warning : missingLongWaves(scans.surfaces, *laws_, side))
    shortcomings_.push_back(warning);
  for (const std::string& warning : contradictions(scans.surfaces))
    shortcomings_.push_back(warning);
  if (depth_ && !(*depth_ > 0.0)) {
    throw OptionsError({"depth: " + numberText(*depth_) + " m is not allowed, must be > 0 m"});
  }
}

double DividedSurface::depth() {
  if (!depth_) {
    const bool is_small = surface_.rows() * surface_.cols() <= AreaCellLimits().most_cells;
    depth_ = is_small ? std::numeric_limits<double>::infinity() : depthOfHighest(surface_);
  }
  return *depth_;
}

std::string DividedSurface::strip(std::int64_t first_row, std::int64_t rows) {
  if (first_row < 0 || rows < 1 || rows > surface_.rows() - first_row) {
    throw SurfaceError("a strip of " + std::to_string(rows) + " rows from row " +
                       std::to_string(first_row) + " is not allowed, must lie in the " +
                       std::to_string(surface_.rows()) + " rows of the surface");
  }
  AreaCellLimits limits;
  limits.depth = depth();
  const DevicePieces& pieces = surface_.pieces();
  AreaCells cells(pieces.size.pitch_x, pieces.size.pitch_y, limits);
  surface_.visitTiles(first_row, rows,
                      [&](int piece, std::int64_t row, std::int64_t col, const cv::Mat& tile) {
                        cells.add(rowInArea(pieces, piece, row), col, tile);
                      });
  std::string bytes = kName + surface_.identity();
  appendBytes(bytes, first_row);
  appendBytes(bytes, rows);
  bytes += cells.toBytes();
  return bytes + contentHash(bytes);
}

Realisation DividedSurface::realise(const SurfaceStrips& strips) {
  return solver_.realise(strips.cells(), surface_);
}

SurfaceStrips::SurfaceStrips(DividedSurface& surface)
    : identity_(surface.surface().identity()), rows_(surface.surface().rows()) {}

void SurfaceStrips::add(std::string_view strip) {
  const std::string_view name(kName);
  if (strip.substr(0, name.size()) != name)
    throw SurfaceError("these bytes are no strip of a surface of this version");
  const std::size_t hash_size = contentHash("").size();
  const std::size_t size = strip.size() - std::min(strip.size(), hash_size);
  if (size < name.size() + identity_.size() ||
      strip.substr(size) != contentHash(strip.substr(0, size))) {
    throw SurfaceError("the bytes of this strip have been cut off or changed");
  }
  std::string_view bytes = strip.substr(name.size(), size - name.size());
  if (bytes.substr(0, identity_.size()) != identity_) {
    throw SurfaceError(
        "this strip is of another surface: scans, settings, area, contacts, seed and number must "
        "be the same");
  }
  bytes.remove_prefix(identity_.size());
  std::int64_t first = 0;
  std::int64_t rows = 0;
  if (!takeBytes(bytes, first) || !takeBytes(bytes, rows))
    throw SurfaceError("the bytes of this strip are not whole");
  if (first < 0 || first >= rows_ || rows < 1 || rows > rows_ - first)
    throw SurfaceError("this strip has rows that the surface has not");
  std::int64_t end = first + rows;
  auto after = ends_.upper_bound(first);
  const bool begins_before = after != ends_.begin() && std::prev(after)->second > first;
  if (begins_before || (after != ends_.end() && after->first < end)) {
    const std::int64_t twice = begins_before ? first : after->first;
    const std::int64_t twice_end =
        std::min(end, begins_before ? std::prev(after)->second : after->second);
    throw SurfaceError(rowsText(twice, twice_end) + " of the surface came twice");
  }
  AreaCells cells = AreaCells::fromBytes(bytes);
  if (cells_) {
    cells_->add(cells);
  } else {
    cells_ = std::move(cells);
  }
  if (after != ends_.end() && after->first == end) {
    end = after->second;
    after = ends_.erase(after);
  }
  if (after != ends_.begin() && std::prev(after)->second == first) {
    std::prev(after)->second = end;
  } else {
    ends_.emplace(first, end);
  }
}

const AreaCells& SurfaceStrips::cells() const {
  std::vector<std::string> missing;
  std::int64_t next = 0;
  for (const auto& [first, end] : ends_) {
    if (first > next) missing.push_back(rowsText(next, first));
    next = end;
  }
  if (next < rows_) missing.push_back(rowsText(next, rows_));
  if (!missing.empty()) {
    std::string text = missing.front();
    if (missing.size() > 1) text += " and " + std::to_string(missing.size() - 1) + " other gaps";
    throw SurfaceError("strips are missing: " + text + " of the " + std::to_string(rows_) +
                       " rows of the surface");
  }
  return *cells_;
}

}  // namespace mems_stiction
