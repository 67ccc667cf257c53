#include "approach/area_cells.hpp"

#include <algorithm>
#include <cmath>

#include "files/byte_pieces.hpp"
#include "files/content_hash.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

constexpr std::int64_t kFarthestPlace = std::int64_t{1} << 30U;
/// Cells that are held before those that will not be kept are dropped: a part more than are kept,
/// and these.
constexpr std::int64_t kFewCells = 1 << 14;
constexpr std::int64_t kPartMore = 2;
constexpr std::size_t kBlock = 16;

constexpr char kName[] = "mems_stiction area cells 2\n";
constexpr std::uint32_t kOrderOfBytes = 0x01020304;

template <typename Scalar>
MEMS_STICTION_INLINE double highestIn(const Scalar* line, std::size_t size) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  Packet highest = kNone;
  const auto take = [&](const Packet& heights) {
    const Packet valid = select(heights - heights == 0.0, heights, kNone);
    highest = select(valid > highest, valid, highest);
  };
  const std::size_t in_packets = size / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount) take(Packet::load(line + i));
  if (in_packets < size) take(Packet::loadFirst(line + in_packets, size - in_packets, kNone));
  return highest.largest();
}

MEMS_STICTION_VECTORIZED double highestOf(const float* line, std::size_t size) {
  return highestIn(line, size);
}
MEMS_STICTION_VECTORIZED double highestOf(const double* line, std::size_t size) {
  return highestIn(line, size);
}

MEMS_STICTION_VECTORIZED std::int32_t largestOfBlock(const std::int32_t* slots) {
  std::int32_t largest = 0;
  for (std::size_t i = 0; i < kBlock; ++i) largest = slots[i] > largest ? slots[i] : largest;
  return largest;
}

bool sameLimits(const AreaCellLimits& one, const AreaCellLimits& other) {
  return one.depth == other.depth && one.most_cells == other.most_cells;
}

}  // namespace

AreaCells::AreaCells(double pitch_x, double pitch_y, const AreaCellLimits& limits)
    : pitch_x_(pitch_x), pitch_y_(pitch_y), limits_(limits) {
  const auto isLength = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!isLength(pitch_x) || !isLength(pitch_y)) {
    throw SurfaceError("the pitch of an area (" + numberText(pitch_x) + " x " +
                       numberText(pitch_y) + " m) must be above 0");
  }
  if (!(limits.depth > 0.0) || limits.most_cells < 1) {
    throw SurfaceError("an area keeps no cell " + numberText(limits.depth) + " m deep, at most " +
                       std::to_string(limits.most_cells));
  }
}

std::int64_t AreaCells::levelByDepth() const {
  if (!(limits_.depth < HeightCounts::kLargestHeight) || counts_.empty()) return kNoLevel;
  return HeightCounts::finestOf(highest_) - HeightCounts::finestOf(limits_.depth);
}

std::int64_t AreaCells::finestLevel() const {
  std::int64_t level = levelByDepth();
  if (counts_.total() > limits_.most_cells) {
    level = std::max(level, counts_.finestOfBucket(counts_.lowestWithin(limits_.most_cells)));
  }
  return level;
}

std::int64_t AreaCells::levelBucket() const {
  if (counts_.empty()) return 0;
  const std::int64_t level = finestLevel();
  return level == kNoLevel ? counts_.lowest()
                           : std::max(counts_.bucketAbove(level), counts_.lowest());
}

std::int64_t AreaCells::cellCount() const { return counts_.countFrom(levelBucket()); }

std::vector<AreaCell> AreaCells::cellsFrom(std::int64_t bucket) const {
  std::vector<AreaCell> found;
  std::copy_if(cells_.begin(), cells_.end(), std::back_inserter(found),
               [&](const AreaCell& cell) { return counts_.bucketOf(cell.relief) >= bucket; });
  std::sort(found.begin(), found.end(), [](const AreaCell& one, const AreaCell& other) {
    return one.row != other.row ? one.row < other.row : one.col < other.col;
  });
  const auto twice = std::adjacent_find(found.begin(), found.end(),
                                        [](const AreaCell& one, const AreaCell& other) {
                                          return one.row == other.row && one.col == other.col;
                                        });
  if (twice != found.end()) {
    throw SurfaceError("the cell in row " + std::to_string(twice->row) + ", column " +
                       std::to_string(twice->col) +
                       " of the area was added twice: tiles must not overlap");
  }
  return found;
}

std::int64_t AreaCells::mostInMemory() const {
  return limits_.most_cells + limits_.most_cells / kPartMore + kFewCells;
}

void AreaCells::makeRoom(std::size_t more) {
  const std::size_t wanted = cells_.size() + more;
  if (wanted <= cells_.capacity()) return;
  cells_.reserve(std::max(
      wanted, std::min(2 * cells_.capacity(), static_cast<std::size_t>(mostInMemory()) + more)));
}

void AreaCells::dropCells() {
  if (static_cast<std::int64_t>(cells_.size()) <= mostInMemory()) return;
  dropped_below_ = std::max(dropped_below_, finestLevel());
  // all that is surely below; whoever reads leaves out the others
  const double level = counts_.lowerEnd(counts_.bucketAbove(dropped_below_)) - counts_.width();
  const auto isLow = [=](const AreaCell& cell) { return cell.relief < level; };
  cells_.erase(std::remove_if(cells_.begin(), cells_.end(), isLow), cells_.end());
}

template <typename Scalar>
void AreaCells::addRow(std::int64_t row, std::int64_t col, const Scalar* line, std::size_t size) {
  counts_.add(line, size, slots_.data());
  const double highest = highestOf(line, size);
  if (std::isfinite(highest) && !(highest <= highest_)) highest_ = highest;
  dropped_below_ = std::max(dropped_below_, levelByDepth());
  std::int64_t wanted = 1;  // slot 0 is that of what is invalid
  if (dropped_below_ != kNoLevel)
    wanted = std::max(counts_.slotOf(counts_.bucketAbove(dropped_below_)), wanted);
  AreaCell* next = row_cells_.data();
  for (std::size_t first = 0; first < size; first += kBlock) {
    const std::size_t end = std::min(first + kBlock, size);
    if (end - first == kBlock && largestOfBlock(slots_.data() + first) < wanted) continue;
    for (std::size_t i = first; i < end; ++i) {  // which ones is random: written without a branch
      *next = {static_cast<std::int32_t>(row),
               static_cast<std::int32_t>(col) + static_cast<std::int32_t>(i),
               static_cast<double>(line[i])};
      next += slots_[i] >= wanted ? 1 : 0;
    }
  }
  makeRoom(static_cast<std::size_t>(next - row_cells_.data()));
  cells_.insert(cells_.end(), row_cells_.data(), next);
  dropCells();
}

void AreaCells::add(std::int64_t row, std::int64_t col, const cv::Mat& relief) {
  if (relief.type() != CV_32FC1 && relief.type() != CV_64FC1) {
    throw SurfaceError("the relief of a tile must be CV_32FC1 or CV_64FC1");
  }
  if (row < -kFarthestPlace || col < -kFarthestPlace || row > kFarthestPlace - relief.rows ||
      col > kFarthestPlace - relief.cols) {
    throw SurfaceError("a tile at row " + std::to_string(row) + ", column " + std::to_string(col) +
                       " lies too far out: the area must lie within " +
                       std::to_string(kFarthestPlace) + " pixels");
  }
  const auto cols = static_cast<std::size_t>(relief.cols);
  slots_.resize(cols);
  row_cells_.resize(cols + 1);  // one past the last is written, too
  for (int i = 0; i < relief.rows; ++i) {
    if (relief.depth() == CV_32F) {
      addRow(row + i, col, relief.ptr<float>(i), cols);
    } else {
      addRow(row + i, col, relief.ptr<double>(i), cols);
    }
  }
}

void AreaCells::add(const AreaCells& other) {
  if (pitch_x_ != other.pitch_x_ || pitch_y_ != other.pitch_y_ ||
      !sameLimits(limits_, other.limits_)) {
    throw SurfaceError(
        "parts of an area must have been collected with the same pitch and the same limits");
  }
  counts_.add(other.counts_);
  if (!std::isnan(other.highest_) && !(other.highest_ <= highest_)) highest_ = other.highest_;
  dropped_below_ = std::max(dropped_below_, other.dropped_below_);
  makeRoom(other.cells_.size());
  cells_.insert(cells_.end(), other.cells_.begin(), other.cells_.end());
  dropCells();
}

std::string AreaCells::toBytes() const {
  std::string bytes = kName;
  appendBytes(bytes, kOrderOfBytes);
  for (const double value : {pitch_x_, pitch_y_, limits_.depth}) appendBytes(bytes, value);
  appendBytes(bytes, limits_.most_cells);
  appendBytes(bytes, highest_);
  counts_.appendTo(bytes);
  const std::vector<AreaCell> cells = cellsFrom(levelBucket());
  appendBytes(bytes, static_cast<std::int64_t>(cells.size()));
  bytes.append(reinterpret_cast<const char*>(cells.data()), cells.size() * sizeof(AreaCell));
  return bytes + contentHash(bytes);
}

AreaCells AreaCells::fromBytes(std::string_view bytes) {
  const std::string_view name(kName);
  if (bytes.substr(0, name.size()) != name)
    throw SurfaceError("these bytes are no area cells of this version");
  const std::size_t hash_size = contentHash("").size();
  if (bytes.size() < name.size() + hash_size ||
      bytes.substr(bytes.size() - hash_size) !=
          contentHash(bytes.substr(0, bytes.size() - hash_size))) {
    throw SurfaceError("the bytes of these area cells have been cut off or changed");
  }
  bytes.remove_prefix(name.size());
  bytes.remove_suffix(hash_size);
  std::uint32_t order_of_bytes = 0;
  double pitch_x = 0.0;
  double pitch_y = 0.0;
  double highest = 0.0;
  AreaCellLimits limits;
  if (!takeBytes(bytes, order_of_bytes) || order_of_bytes != kOrderOfBytes) {
    throw SurfaceError("these area cells come from a machine with another order of bytes");
  }
  bool is_whole = takeBytes(bytes, pitch_x) && takeBytes(bytes, pitch_y) &&
                  takeBytes(bytes, limits.depth) && takeBytes(bytes, limits.most_cells) &&
                  takeBytes(bytes, highest);
  AreaCells cells(pitch_x, pitch_y, limits);
  cells.highest_ = highest;
  cells.counts_ = HeightCounts::takeFrom(bytes);
  std::int64_t count = 0;
  is_whole = is_whole && takeBytes(bytes, count) && count == cells.cellCount() &&
             bytes.size() == static_cast<std::size_t>(count) * sizeof(AreaCell);
  if (!is_whole) throw SurfaceError("the bytes of these area cells contradict each other");
  cells.cells_.resize(static_cast<std::size_t>(count));
  for (AreaCell& cell : cells.cells_) takeBytes(bytes, cell);
  cells.dropped_below_ = cells.finestLevel();
  return cells;
}

}  // namespace mems_stiction
