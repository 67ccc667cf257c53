#include "evaluation/part_surfaces.hpp"

#include <algorithm>

#include "surface/alignment.hpp"

namespace mems_stiction {
namespace {

std::size_t bytesOf(const HeightMap& surface) {
  return surface.heights().total() * surface.heights().elemSize();
}

bool haveSamePixels(const HeightMap& left, const HeightMap& right) {
  return left.heights().data == right.heights().data && left.rows() == right.rows() &&
         left.cols() == right.cols();
}

bool haveSamePixels(const SurfacePair& left, const SurfacePair& right) {
  return haveSamePixels(left.lower, right.lower) && haveSamePixels(left.upper, right.upper);
}

/// The model's grid is the scan's own unless preprocessing/refine asks for another.
std::size_t bytesOf(const PreparedScan& scan) {
  const SurfacePair& model = scan.model_surfaces;
  return bytesOf(scan.surfaces.lower) + bytesOf(scan.surfaces.upper) +
         (haveSamePixels(scan.surfaces, model) ? 0 : bytesOf(model.lower) + bytesOf(model.upper)) +
         scan.outside.total() * scan.outside.elemSize();
}

/// And what a prediction of them needs for its flags.
PreparedScan surfacesAlone(const PreparedScan& scan) {
  PreparedScan alone;
  alone.surfaces = scan.surfaces;
  alone.model_surfaces = scan.model_surfaces;
  alone.refinement = scan.refinement;
  alone.outside = scan.outside;
  alone.tip_limit = scan.tip_limit;
  alone.short_waves = scan.short_waves;
  return alone;
}

/// The oldest of those that share the commonest grid.
std::vector<ScannedSurface>::iterator mostSpareable(std::vector<ScannedSurface>& scans) {
  auto found = scans.begin();
  std::ptrdiff_t most = 0;
  for (auto scan = scans.begin(); scan != scans.end(); ++scan) {
    const std::ptrdiff_t alike =
        std::count_if(scans.begin(), scans.end(), [&](const ScannedSurface& other) {
          return haveSameGrid(scan->scan.surfaces.lower, other.scan.surfaces.lower);
        });
    if (alike <= most) continue;
    most = alike;
    found = scan;
  }
  return found;
}

}  // namespace

DeviceScans ScannedPart::together(const Configuration& configuration) const {
  DeviceScans device(configuration);
  for (const ScannedSurface& scanned : scans) device.add(scanned.statement.scan_name, scanned.scan);
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

std::vector<PartName> PartSurfaces::add(const PartName& part, std::uint64_t scan_id,
                                        ScanStatement statement, const PreparedScan& scan) {
  const auto entry = std::find_if(parts_.begin(), parts_.end(),
                                  [&](const Entry& other) { return other.name == part; });
  if (entry == parts_.end()) {
    parts_.push_back({part, {}});
  } else {
    parts_.splice(parts_.end(), parts_, entry);
  }
  ScannedPart& own = parts_.back().part;
  std::vector<ScannedSurface>& scans = own.scans;
  const bool is_alone = part.first.empty() && part.second.empty();
  const auto same = std::find_if(scans.begin(), scans.end(), [&](const ScannedSurface& other) {
    return scan_id != 0 ? other.id == scan_id
                        : haveSamePixels(other.scan.surfaces.lower, scan.surfaces.lower);
  });
  if (same != scans.end()) {
    statement.scan_name = same->statement.scan_name;
    same->statement = std::move(statement);
    if (haveSamePixels(same->scan.surfaces, scan.surfaces)) return {};
    bytes_ += bytesOf(scan) - bytesOf(same->scan);
    same->scan = surfacesAlone(scan);
    same->number = ++numbers_;
  } else {
    while (is_alone && !scans.empty()) drop(own, scans.begin());
    own.taken = is_alone ? 1 : own.taken + 1;
    std::string& name = statement.scan_name;
    const bool is_named_before =
        std::any_of(scans.begin(), scans.end(),
                    [&](const ScannedSurface& other) { return other.statement.scan_name == name; });
    if (is_named_before || name.empty())
      name += (name.empty() ? "scan " : " ") + std::to_string(own.taken);
    scans.push_back({scan_id, ++numbers_, std::move(statement), surfacesAlone(scan)});
    bytes_ += bytesOf(scan);
    while (scans.size() > most_.scans) drop(own, mostSpareable(scans));
  }
  std::vector<PartName> gone;
  while (bytes_ > most_.bytes && parts_.size() > 1) {
    Entry& oldest = parts_.front();
    while (!oldest.part.scans.empty()) drop(oldest.part, oldest.part.scans.begin());
    gone.push_back(oldest.name);
    parts_.pop_front();
  }
  while (bytes_ > most_.bytes && scans.size() > 1) drop(own, scans.begin());
  return gone;
}

std::optional<ScannedPart> PartSurfaces::of(const PartName& part) const {
  const auto found = std::find_if(parts_.begin(), parts_.end(),
                                  [&](const Entry& other) { return other.name == part; });
  if (found == parts_.end()) return std::nullopt;
  return found->part;
}

std::size_t PartSurfaces::scans() const {
  std::size_t count = 0;
  for (const Entry& entry : parts_) count += entry.part.scans.size();
  return count;
}

void PartSurfaces::drop(ScannedPart& part, std::vector<ScannedSurface>::iterator scan) {
  bytes_ -= bytesOf(scan->scan);
  part.scans.erase(scan);
}

}  // namespace mems_stiction
