#pragma once

/// @file
/// The one list of what the verdict on a part says, with the field names of the message and the units.

#include <string>

#include "mems_stiction/verdict/part_verdict.hpp"

namespace mems_stiction {

/// @param part PooledVerdict, const or not
/// @param visit called with (name, value, unit) for each figure; regime_flags is for the names of its bits
template <typename VerdictType, typename Visitor>
void visitPartVerdictFields(VerdictType& part, Visitor&& visit) {
  visit("scan_count", part.scan_count, "");
  visit("counted_scans", part.counted_scans, "");
  visit("sticks", part.sticks, "");
  visit("reason", part.reason, "");
  visit("verdict_by", part.verdict_by, "");
  const auto visitRatio = [&](const std::string& name, auto& ratio) {
    visit(name, ratio.value, "");
    visit(name + "_lower", ratio.lower, "");
    visit(name + "_upper", ratio.upper, "");
    visit(name + "_spread", ratio.spread, "");
    visit(name + "_place_spread", ratio.place_spread, "");
    visit("worst_" + name, ratio.worst, "");
    visit("worst_" + name + "_scan", ratio.worst_scan, "");
  };
  visitRatio("margin", part.margin);
  visitRatio("peel_number", part.peel_number);
  visit("regime_flags", part.regime_flags, "");
}

}  // namespace mems_stiction
