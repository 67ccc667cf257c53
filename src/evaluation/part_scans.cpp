#include "evaluation/part_scans.hpp"

#include <algorithm>

namespace mems_stiction {

std::optional<PooledVerdict> PartScans::add(const PartKey& key, std::uint64_t scan_id,
                                            ScanStatement statement) {
  if (!key.isStated()) return std::nullopt;
  Part& part = parts_[key];
  part.last = ++clock_;
  if (part.first == 0) part.first = clock_;
  const auto same =
      scan_id == 0 ? part.ids.end() : std::find(part.ids.begin(), part.ids.end(), scan_id);
  if (same != part.ids.end()) {
    ScanStatement& before = part.scans[static_cast<std::size_t>(same - part.ids.begin())];
    statement.scan_name = before.scan_name;
    before = std::move(statement);
  } else {
    ++part.taken;
    const bool is_named_before = std::any_of(
        part.scans.begin(), part.scans.end(),
        [&](const ScanStatement& scan) { return scan.scan_name == statement.scan_name; });
    if (is_named_before || statement.scan_name.empty()) {
      statement.scan_name +=
          (statement.scan_name.empty() ? "scan " : " ") + std::to_string(part.taken);
    }
    part.ids.push_back(scan_id);
    part.scans.push_back(std::move(statement));
    if (part.scans.size() > most_scans_) {
      part.ids.erase(part.ids.begin());
      part.scans.erase(part.scans.begin());
    }
  }
  PooledVerdict verdict = verdictOf(part);
  if (parts_.size() > most_parts_) forgetOldest();
  return verdict;
}

std::optional<PooledVerdict> PartScans::judgeAgain(const PartKey& key, std::uint64_t scan_id,
                                                   const Verdict& verdict) {
  const auto found = parts_.find(key);
  if (found == parts_.end() || scan_id == 0) return std::nullopt;
  Part& part = found->second;
  const auto scan = std::find(part.ids.begin(), part.ids.end(), scan_id);
  if (scan == part.ids.end()) return std::nullopt;
  mems_stiction::judgeAgain(part.scans[static_cast<std::size_t>(scan - part.ids.begin())], verdict);
  return verdictOf(part);
}

std::vector<std::pair<PartKey, PooledVerdict>> PartScans::verdicts() const {
  std::vector<std::pair<std::size_t, const PartKey*>> order;
  order.reserve(parts_.size());
  for (const auto& [key, part] : parts_) order.emplace_back(part.first, &key);
  std::sort(order.begin(), order.end());
  std::vector<std::pair<PartKey, PooledVerdict>> verdicts;
  verdicts.reserve(order.size());
  for (const auto& entry : order)
    verdicts.emplace_back(*entry.second, verdictOf(parts_.at(*entry.second)));
  return verdicts;
}

PooledVerdict PartScans::verdictOf(const Part& part) {
  PooledVerdict verdict = pooledVerdictOf(part.scans);
  if (part.taken > part.scans.size()) {
    verdict.warnings.push_back("only the newest " + std::to_string(part.scans.size()) + " of " +
                               std::to_string(part.taken) + " scans are kept");
  }
  return verdict;
}

void PartScans::forgetOldest() {
  parts_.erase(std::min_element(
      parts_.begin(), parts_.end(),
      [](const auto& left, const auto& right) { return left.second.last < right.second.last; }));
}

}  // namespace mems_stiction
