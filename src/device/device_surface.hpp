#pragma once

/// @file
/// One surface of a device as it is made: all its contacts, each a square of its own, under their
/// counter-surface. A place's relief depends on the laws, the size and the seed alone, so any part
/// of it may be made anywhere.
///
///     DeviceSurface surface(laws, pieces, realisationSeed(options, 0));
///     surface.visitTiles(0, surface.rows(), [&](int piece, std::int64_t row, std::int64_t col,
///         const cv::Mat& tile) { ... });

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/made_surface.hpp"
#include "mems_stiction/device/device_force.hpp"

namespace mems_stiction {

/// Along the side of a scan or a contact: fewer say nothing of its summits.
constexpr int kLeastPixelsAlong = 8;

/// The contacts of a device as squares of one size, each on a surface of its own.
struct DevicePieces {
  int count = 1;
  MadeSize size;  ///< of each
  double area_ratio =
      1.0;  ///< of the device over what is made: not 1 where that has no room, or has whole pixels
  bool is_part = false;  ///< the device has no room

  double side() const { return size.sideX(); }
  double area() const { return count * size.sideX() * size.sideY(); }  ///< that is made [m^2]
};

/// @throw OptionsError if there is no scan or no area, or options are out of range
void checkDevice(const DeviceSurfaces& surfaces, const DeviceArea& area,
                 const DeviceForceOptions& options);

/// Smaller contacts are as wide as kLeastPixelsAlong.
/// - @p most_cells of all pieces together
DevicePieces piecesOf(const DeviceArea& area, double pitch, double most_cells);

/// Pixels of surfaces that are made [m]: as the options say, else the finest of the scans.
double madePitch(const DeviceSurfaces& surfaces, const DeviceForceOptions& options);

/// Of the n-th surface that is made, from 0.
std::uint64_t realisationSeed(const DeviceForceOptions& options, int number);

/// The laws of both surfaces; the upper one may be a plane.
struct DeviceLaws {
  SurfaceLaw lower;
  std::optional<SurfaceLaw> upper;
};
/// The law of one surface, with long waves of its own if the options want them.
SurfaceLaw lawOf(const SurfaceStudy& study, const DeviceForceOptions& options, TailForm form);
DeviceLaws lawsOf(const DeviceSurfaces& surfaces, const DeviceForceOptions& options, TailForm form);

/// Contacts lie one after another, along the columns. One object serves one thread at a time.
class DeviceSurface {
 public:
  using Visit =
      std::function<void(int piece, std::int64_t row, std::int64_t col, const cv::Mat& tile)>;

  /// - @p laws must outlive the object
  DeviceSurface(const DeviceLaws& laws, const DevicePieces& pieces, std::uint64_t seed);
  /// Goes on as the surface of another seed: the same as a new one, but sooner.
  void reseed(std::uint64_t seed);

  const DevicePieces& pieces() const { return pieces_; }
  std::int64_t rows() const { return pieces_.count * pieces_.size.rows; }
  std::int64_t cols() const { return pieces_.size.cols; }
  /// Tiles of this size are made fastest.
  cv::Size tile() const { return lower_->tile(); }

  /// Relief [m], lower minus upper, of the tile whose first pixel is (row, col), CV_32FC1; all of
  /// it lies in the surface.
  void heights(std::int64_t row, std::int64_t col, cv::Mat& tile);
  /// Calls visit(piece, row in the piece, col, relief) for tiles that fill these rows.
  void visitTiles(std::int64_t first_row, std::int64_t rows, const Visit& visit);

  /// The same for the same surface, on any machine that makes it to the bit; another one for any
  /// other.
  std::string identity();

 private:
  void goTo(int piece);
  void pieceHeights(std::int64_t row, std::int64_t col, cv::Mat& tile);

  const DeviceLaws* laws_;
  DevicePieces pieces_;
  std::optional<std::pair<SpectrumContinuation, SpectrumContinuation>> ends_;  ///< below and above
  std::vector<std::pair<std::uint64_t, std::uint64_t>> seeds_;  ///< of each piece, below and above
  std::optional<MadeSurface> lower_;
  std::optional<MadeSurface> upper_;
  int piece_ = 0;
  cv::Mat above_;
  std::string identity_;
};

}  // namespace mems_stiction
