#include "mems_stiction/ros/station_conversion.hpp"

namespace mems_stiction {
namespace {

static_assert(static_cast<int>(SweepDirection::kUp) == SweepPoint::UP, "direction");
static_assert(static_cast<int>(SweepDirection::kDown) == SweepPoint::DOWN, "direction");

SweepPoint pointMessage(const LoadSweepRow& row) {
  SweepPoint message;
  message.direction = static_cast<std::uint8_t>(row.direction);
  message.voltage = row.voltage;
  message.mechanical_load = row.mechanical_load;
  message.status = static_cast<std::uint8_t>(row.status);
  message.is_open = static_cast<std::uint8_t>(row.is_open);
  message.pull_off_force = row.pull_off_force;
  message.van_der_waals_force = row.van_der_waals_force;
  message.electrostatic_force = row.electrostatic_force;
  message.normal_load = row.normal_load;
  message.contact_area = row.contact_area;
  message.contact_area_jkr = row.contact_area_jkr;
  message.contact_fraction = row.contact_fraction;
  message.asperity_count = static_cast<std::uint32_t>(row.asperity_count);
  message.approach = row.approach;
  message.sticks = static_cast<std::uint8_t>(row.sticks);
  message.margin = row.margin;
  message.margin_lower = row.margin_lower;
  message.holding_margin = row.holding_margin;
  message.margin_upper = row.margin_upper;
  message.pull_off_force_lower = row.pull_off_interval.lower;
  message.pull_off_force_upper = row.pull_off_interval.upper;
  return message;
}

SweepSummary summaryMessage(const LoadSweepSummary& summary) {
  SweepSummary message;
  message.mechanical_load = summary.mechanical_load;
  message.highest_releasing_voltage = summary.highest_releasing_voltage;
  message.highest_safe_voltage = summary.highest_safe_voltage;
  message.lowest_sticking_voltage = summary.lowest_sticking_voltage;
  message.lowest_safe_voltage = summary.lowest_safe_voltage;
  message.opening_voltage = summary.opening_voltage;
  return message;
}

CyclePoint cycleMessage(const ContactCycle& cycle) {
  CyclePoint message;
  message.cycle = static_cast<std::uint32_t>(cycle.cycle);
  message.status = static_cast<std::uint8_t>(cycle.status);
  message.pull_off_force = cycle.pull_off_force;
  message.van_der_waals_force = cycle.van_der_waals_force;
  message.contact_area = cycle.contact_area;
  message.contact_area_jkr = cycle.contact_area_jkr;
  message.contact_fraction = cycle.contact_fraction;
  message.asperity_count = static_cast<std::uint32_t>(cycle.asperity_count);
  message.plastic_count = static_cast<std::uint32_t>(cycle.plastic_count);
  message.rms_height = cycle.rms_height;
  message.largest_change = cycle.largest_change;
  message.sticks = static_cast<std::uint8_t>(cycle.sticks);
  message.margin = cycle.margin;
  message.margin_lower = cycle.margin_lower;
  message.margin_upper = cycle.margin_upper;
  message.pull_off_force_lower = cycle.pull_off_interval.lower;
  message.pull_off_force_upper = cycle.pull_off_interval.upper;
  return message;
}

}  // namespace

SweepLoadResult sweepMessage(const LoadSweepResult& sweep) {
  SweepLoadResult message;
  for (const LoadSweepRow& row : sweep.rows) message.points.push_back(pointMessage(row));
  for (const LoadSweepSummary& summary : sweep.summaries) message.summaries.push_back(summaryMessage(summary));
  message.pull_in_voltage = sweep.pull_in_voltage;
  return message;
}

CycleContactResult cyclesMessage(const ContactCyclesResult& cycles) {
  CycleContactResult message;
  for (const ContactCycle& cycle : cycles.cycles) message.cycles.push_back(cycleMessage(cycle));
  message.first_sticking_cycle = static_cast<std::uint32_t>(cycles.first_sticking_cycle);
  return message;
}

}  // namespace mems_stiction
