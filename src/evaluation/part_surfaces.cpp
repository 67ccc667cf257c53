#include "evaluation/part_surfaces.hpp"

#include <algorithm>

namespace mems_stiction {
namespace {

std::size_t bytesOf(const HeightMap& surface) { return surface.heights().total() * surface.heights().elemSize(); }

std::size_t bytesOf(const SurfacePair& surfaces) { return bytesOf(surfaces.lower) + bytesOf(surfaces.upper); }

bool haveSamePixels(const HeightMap& left, const HeightMap& right) {
  return left.heights().data == right.heights().data && left.rows() == right.rows() && left.cols() == right.cols();
}

bool areOneGrid(const HeightMap& left, const HeightMap& right) {
  return left.rows() == right.rows() && left.cols() == right.cols() && left.pitchX() == right.pitchX() &&
         left.pitchY() == right.pitchY();
}

/// Bit for bit, also where nothing was measured.
bool haveSameHeights(const HeightMap& left, const HeightMap& right) {
  if (!areOneGrid(left, right) || left.heights().type() != right.heights().type()) return false;
  if (haveSamePixels(left, right)) return true;
  const std::size_t bytes = static_cast<std::size_t>(left.cols()) * left.heights().elemSize();
  for (int row = 0; row < left.rows(); ++row) {
    const auto* const begin = left.heights().ptr(row);
    if (!std::equal(begin, begin + bytes, right.heights().ptr(row))) return false;
  }
  return true;
}

/// The oldest of those that share the commonest grid.
std::vector<ScannedSurface>::iterator mostSpareable(std::vector<ScannedSurface>& scans) {
  auto found = scans.begin();
  std::ptrdiff_t most = 0;
  for (auto scan = scans.begin(); scan != scans.end(); ++scan) {
    const std::ptrdiff_t alike = std::count_if(scans.begin(), scans.end(), [&](const ScannedSurface& other) {
      return areOneGrid(scan->surfaces.lower, other.surfaces.lower);
    });
    if (alike <= most) continue;
    most = alike;
    found = scan;
  }
  return found;
}

}  // namespace

DeviceSurfaces ScannedPart::surfaces() const {
  DeviceSurfaces device;
  for (const ScannedSurface& scan : scans) {
    device.scans.push_back({scan.statement.scan_name, scan.surfaces.lower});
    const HeightMap& upper = scan.surfaces.upper;
    const auto is_there = [&](const NamedScan& other) { return haveSameHeights(other.surface, upper); };
    if (upper.empty() || std::any_of(device.counter_surface.begin(), device.counter_surface.end(), is_there)) continue;
    device.counter_surface.push_back({"the counter-surface of " + scan.statement.scan_name, upper});
  }
  return device;
}

std::vector<std::uint64_t> ScannedPart::numbers() const {
  std::vector<std::uint64_t> numbers;
  for (const ScannedSurface& scan : scans) numbers.push_back(scan.number);
  return numbers;
}

std::vector<ScanStatement> ScannedPart::statements() const {
  std::vector<ScanStatement> statements;
  for (const ScannedSurface& scan : scans) statements.push_back(scan.statement);
  return statements;
}

std::vector<PartName> PartSurfaces::add(const PartName& part, std::uint64_t scan_id, ScanStatement statement,
                                        const SurfacePair& surfaces) {
  const auto entry = std::find_if(parts_.begin(), parts_.end(), [&](const Entry& other) { return other.name == part; });
  if (entry == parts_.end()) {
    parts_.push_back({part, {}});
  } else {
    parts_.splice(parts_.end(), parts_, entry);
  }
  ScannedPart& kept = parts_.back().part;
  std::vector<ScannedSurface>& scans = kept.scans;
  const bool is_alone = part.first.empty() && part.second.empty();
  const auto same = std::find_if(scans.begin(), scans.end(), [&](const ScannedSurface& other) {
    return scan_id != 0 ? other.id == scan_id : haveSamePixels(other.surfaces.lower, surfaces.lower);
  });
  if (same != scans.end()) {
    statement.scan_name = same->statement.scan_name;
    same->statement = std::move(statement);
    if (haveSamePixels(same->surfaces.lower, surfaces.lower) && haveSamePixels(same->surfaces.upper, surfaces.upper)) {
      return {};
    }
    bytes_ += bytesOf(surfaces) - bytesOf(same->surfaces);
    same->surfaces = surfaces;
    same->number = ++numbers_;
  } else {
    while (is_alone && !scans.empty()) drop(kept, scans.begin());
    kept.taken = is_alone ? 1 : kept.taken + 1;
    std::string& name = statement.scan_name;
    const bool is_named_before = std::any_of(
        scans.begin(), scans.end(), [&](const ScannedSurface& other) { return other.statement.scan_name == name; });
    if (is_named_before || name.empty()) name += (name.empty() ? "scan " : " ") + std::to_string(kept.taken);
    scans.push_back({scan_id, ++numbers_, std::move(statement), surfaces});
    bytes_ += bytesOf(surfaces);
    while (scans.size() > most_.scans) drop(kept, mostSpareable(scans));
  }
  std::vector<PartName> gone;
  while (bytes_ > most_.bytes && parts_.size() > 1) {
    Entry& oldest = parts_.front();
    while (!oldest.part.scans.empty()) drop(oldest.part, oldest.part.scans.begin());
    gone.push_back(oldest.name);
    parts_.pop_front();
  }
  while (bytes_ > most_.bytes && scans.size() > 1) drop(kept, scans.begin());
  return gone;
}

std::optional<ScannedPart> PartSurfaces::of(const PartName& part) const {
  const auto found = std::find_if(parts_.begin(), parts_.end(), [&](const Entry& other) { return other.name == part; });
  if (found == parts_.end()) return std::nullopt;
  return found->part;
}

std::size_t PartSurfaces::scans() const {
  std::size_t count = 0;
  for (const Entry& entry : parts_) count += entry.part.scans.size();
  return count;
}

void PartSurfaces::drop(ScannedPart& part, std::vector<ScannedSurface>::iterator scan) {
  bytes_ -= bytesOf(scan->surfaces);
  part.scans.erase(scan);
}

}  // namespace mems_stiction
