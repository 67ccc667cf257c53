#include "device/device_surface.hpp"

#include <algorithm>
#include <cmath>

#include "device/scan_list.hpp"
#include "files/byte_pieces.hpp"
#include "files/content_hash.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

/// Pixels along the side of the corner by which a surface is known.
constexpr std::int64_t kCorner = 32;

}  // namespace

void checkDevice(const DeviceSurfaces& surfaces, const DeviceArea& area,
                 const DeviceForceOptions& options) {
  std::vector<std::string> violations = rangeViolations(options);
  if (!Range::positive().contains(area.area)) {
    violations.push_back("device/contact_area: " + numberText(area.area) +
                         " m^2 is not allowed, must be > 0 m^2");
  }
  if (area.contacts < 1) {
    violations.push_back("device/contacts: " + std::to_string(area.contacts) +
                         " is not allowed, must be >= 1");
  }
  if (surfaces.scans.empty())
    violations.emplace_back("the force of a device needs at least one scan of its surface");
  if (!violations.empty()) throw OptionsError(std::move(violations));
  for (const std::vector<NamedScan>* scans : {&surfaces.scans, &surfaces.counter_surface}) {
    for (const NamedScan& scan : *scans) {
      if (std::min(scan.surface.rows(), scan.surface.cols()) >= kLeastPixelsAlong) continue;
      throw SurfaceError(scan.name + ": " + std::to_string(scan.surface.cols()) + " x " +
                         std::to_string(scan.surface.rows()) +
                         " pixels say nothing of a device; at least 8 x 8 do");
    }
  }
}

DevicePieces piecesOf(const DeviceArea& area, double pitch, double most_cells) {
  DevicePieces pieces;
  pieces.count = area.contacts;
  const double most_area = most_cells * pitch * pitch;
  const double piece_area =
      std::max(area.area / area.contacts, kLeastPixelsAlong * kLeastPixelsAlong * pitch * pitch);
  pieces.is_part = piece_area * area.contacts > most_area;
  if (pieces.is_part) {
    // fewer pieces of their own size, or a part of one
    pieces.count = std::clamp(static_cast<int>(most_area / piece_area), 1, area.contacts);
  }
  const double side = std::sqrt(std::min(piece_area, most_area));
  pieces.size.pitch_x = pieces.size.pitch_y = pitch;
  pieces.size.rows = pieces.size.cols =
      std::max<std::int64_t>(kLeastPixelsAlong, std::llround(side / pitch));
  pieces.area_ratio = area.area / pieces.area();
  return pieces;
}

double madePitch(const DeviceSurfaces& surfaces, const DeviceForceOptions& options) {
  return options.pitch > 0.0 ? options.pitch : finestPitch(mapsOf(surfaces.scans));
}

std::uint64_t realisationSeed(const DeviceForceOptions& options, int number) {
  return static_cast<std::uint64_t>(options.seed) * 1000003 +
         static_cast<std::uint64_t>(number) * 1009;
}

SurfaceLaw lawOf(const SurfaceStudy& study, const DeviceForceOptions& options, TailForm form) {
  SurfaceLaw law = study.law(form);
  if (!options.own_long_waves) law.own.reset();
  return law;
}

DeviceLaws lawsOf(const DeviceSurfaces& surfaces, const DeviceForceOptions& options,
                  TailForm form) {
  const auto of = [&](const std::vector<NamedScan>& scans) {
    return lawOf(SurfaceStudy(mapsOf(scans)), options, form);
  };
  DeviceLaws laws;
  laws.lower = of(surfaces.scans);
  if (!surfaces.counter_surface.empty()) laws.upper = of(surfaces.counter_surface);
  return laws;
}

DeviceSurface::DeviceSurface(const DeviceLaws& laws, const DevicePieces& pieces, std::uint64_t seed)
    : laws_(&laws), pieces_(pieces) {
  reseed(seed);
}

void DeviceSurface::reseed(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::pair<SpectrumContinuation, SpectrumContinuation> ends;
  ends.first = drawnContinuation(laws_->lower, pieces_.side(), engine);
  if (laws_->upper) ends.second = drawnContinuation(*laws_->upper, pieces_.side(), engine);
  seeds_.clear();
  for (int piece = 0; piece < pieces_.count; ++piece) {
    const std::uint64_t below = engine();
    seeds_.emplace_back(below, laws_->upper ? engine() : 0);
  }
  identity_.clear();
  piece_ = 0;
  const auto& [below, above] = seeds_.front();
  if (ends_ == ends) {
    lower_->reseed(below);
    if (upper_) upper_->reseed(above);
    return;
  }
  ends_ = ends;
  const BlockChoice blocks = blocksOf(pieces_.size);
  const Among among = pieces_.count > 1 ? Among::kOthers : Among::kNone;
  lower_.emplace(laws_->lower, ends.first, pieces_.size, pieces_.side(), below, blocks, among);
  if (laws_->upper) {
    upper_.emplace(*laws_->upper, ends.second, pieces_.size, pieces_.side(), above, blocks, among);
  }
}

void DeviceSurface::goTo(int piece) {
  if (piece == piece_) return;
  const auto& [below, above] = seeds_[static_cast<std::size_t>(piece)];
  lower_->reseed(below);
  if (upper_) upper_->reseed(above);
  piece_ = piece;
}

void DeviceSurface::pieceHeights(std::int64_t row, std::int64_t col, cv::Mat& tile) {
  lower_->heights(row, col, tile);
  if (!upper_) return;
  above_.create(tile.size(), CV_32FC1);
  upper_->heights(row, col, above_);
  tile -= above_;
}

void DeviceSurface::heights(std::int64_t row, std::int64_t col, cv::Mat& tile) {
  for (int done = 0; done < tile.rows;) {
    const std::int64_t at = (row + done) % pieces_.size.rows;
    const int rows =
        static_cast<int>(std::min<std::int64_t>(tile.rows - done, pieces_.size.rows - at));
    cv::Mat part = tile.rowRange(done, done + rows);
    goTo(static_cast<int>((row + done) / pieces_.size.rows));
    pieceHeights(at, col, part);
    done += rows;
  }
}

void DeviceSurface::visitTiles(std::int64_t first_row, std::int64_t rows, const Visit& visit) {
  const cv::Size whole = tile();
  cv::Mat relief;
  for (std::int64_t row = first_row; row < first_row + rows;) {
    const int piece = static_cast<int>(row / pieces_.size.rows);
    const std::int64_t at = row % pieces_.size.rows;
    // to the end of the tile, the piece and the rows that are asked for
    const std::int64_t end =
        std::min(at / whole.height * whole.height + whole.height, pieces_.size.rows);
    const int height = static_cast<int>(std::min(end - at, first_row + rows - row));
    goTo(piece);
    for (std::int64_t col = 0; col < cols(); col += whole.width) {
      TimeLimit::check();
      relief.create(height, static_cast<int>(std::min<std::int64_t>(whole.width, cols() - col)),
                    CV_32FC1);
      pieceHeights(at, col, relief);
      visit(piece, at, col, relief);
    }
    row += height;
  }
}

std::string DeviceSurface::identity() {
  if (!identity_.empty()) return identity_;
  std::string bytes;
  for (const std::int64_t number :
       {std::int64_t{pieces_.count}, pieces_.size.rows, pieces_.size.cols}) {
    appendBytes(bytes, number);
  }
  appendBytes(bytes, pieces_.size.pitch_x);
  for (const auto& [below, above] : seeds_) {
    appendBytes(bytes, below);
    appendBytes(bytes, above);
  }
  cv::Mat corner(static_cast<int>(std::min(pieces_.size.rows, kCorner)),
                 static_cast<int>(std::min(cols(), kCorner)), CV_32FC1);
  heights(0, 0, corner);
  for (int row = 0; row < corner.rows; ++row) {
    for (int col = 0; col < corner.cols; ++col) appendBytes(bytes, corner.at<float>(row, col));
  }
  identity_ = contentHash(bytes);
  return identity_;
}

}  // namespace mems_stiction
