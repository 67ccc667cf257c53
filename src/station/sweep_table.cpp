#include "station/sweep_table.hpp"

#include <algorithm>
#include <cmath>

#include "errors/plain_format.hpp"
#include "errors/short_number.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kFormat = "%-5s %11s %11s  %-8s %12s  %-28s %10s  %s\n";

/// "2.4 (0.46 to 12)", of a beam that is peeled "peel 15 (5.1 to 44)".
std::string ratioText(const LoadSweepRow& row) {
  const double lower = row.is_peeled ? row.peel_number_lower : row.margin_lower;
  const double upper = row.is_peeled ? row.peel_number_upper : row.margin_upper;
  if (std::isnan(row.ratio())) return "-";
  const int digits = knownDigits(row.ratio(), lower, upper);
  std::string text = (row.is_peeled ? "peel " : "") + shortNumber(row.ratio(), digits);
  if (std::isfinite(row.ratio()) && !std::isnan(lower)) {
    text += " (" + shortNumber(lower, digits) + " to " + shortNumber(upper, digits) + ")";
  }
  return text;
}

std::string line(const LoadSweepRow& row) {
  const bool is_open = row.is_open;
  const std::string force =
      is_open ? "open" : (row.is_lower_bound ? ">= " : "") + shortNumber(row.pull_off_force);
  const std::string holding =
      is_open || std::isnan(row.holding_margin) ? "-" : shortNumber(row.holding_margin, 2);
  return plainFormat(kFormat, word(row.direction), shortNumber(row.voltage, 4).c_str(),
                     shortNumber(row.mechanical_load).c_str(), word(row.lands), force.c_str(),
                     is_open ? "-" : ratioText(row).c_str(), holding.c_str(),
                     sticksText(row.sticks));
}

std::string volts(double voltage) { return shortNumber(voltage, 4) + " V"; }

std::string upTo(double voltage) {
  return std::isnan(voltage) ? "after none of the voltages"
                             : "after voltages up to " + volts(voltage);
}

/// What one loop says.
std::string sentence(const LoadSweepSummary& summary, const std::vector<LoadSweepRow>& rows) {
  std::string text = "Pressed with " + shortNumber(summary.mechanical_load) + " N: releases " +
                     upTo(summary.highest_releasing_voltage) + ", surely (95 %) " +
                     upTo(summary.highest_safe_voltage);
  const bool has_way_down = std::any_of(rows.begin(), rows.end(), [&](const LoadSweepRow& row) {
    return row.direction == SweepDirection::kDown && row.mechanical_load == summary.mechanical_load;
  });
  if (!has_way_down) return text + ".";
  const double opening = summary.opening_voltage;
  return text + "; " +
         (std::isnan(opening) ? "does not open on the way down"
                              : "opens on the way down at " + volts(opening)) +
         ".";
}

}  // namespace

std::string sweepTable(const LoadSweepResult& sweep, const std::string& indent) {
  std::string text = indent + plainFormat(kFormat, "way", "voltage [V]", "load [N]", "lands",
                                          "pull-off [N]", "margin, 95 %", "while held", "sticks");
  for (const LoadSweepRow& row : sweep.rows) text += indent + line(row);
  const bool has_ratio =
      std::any_of(sweep.rows.begin(), sweep.rows.end(),
                  [](const LoadSweepRow& row) { return !std::isnan(row.ratio()); });
  for (const LoadSweepSummary& summary : sweep.summaries) {
    if (has_ratio) text += indent + sentence(summary, sweep.rows) + "\n";
  }
  text +=
      indent + "Pull-in voltage: " +
      (std::isnan(sweep.pull_in_voltage)
           ? "not stated" + (sweep.pull_in_reason.empty() ? "" : " (" + sweep.pull_in_reason + ")")
           : volts(sweep.pull_in_voltage) + "; from there on the voltage alone closes the device") +
      ".\n";
  return text + indent +
         "Margin and sticks: once the device has touched and the load is gone. While held: with "
         "the load.\n";
}

}  // namespace mems_stiction
