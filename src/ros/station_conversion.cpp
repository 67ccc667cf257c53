#include "ros/station_conversion.hpp"

#include "ros/message_fields.hpp"
#include "station/station_fields.hpp"

namespace mems_stiction {
namespace {

static_assert(static_cast<int>(SweepDirection::kUp) == SweepPoint::UP, "direction");
static_assert(static_cast<int>(SweepDirection::kDown) == SweepPoint::DOWN, "direction");
static_assert(static_cast<int>(Lands::kNo) == SweepPoint::LANDS_NO, "lands");
static_assert(static_cast<int>(Lands::kYes) == SweepPoint::LANDS_YES, "lands");
static_assert(static_cast<int>(Lands::kUnknown) == SweepPoint::LANDS_UNKNOWN, "lands");

}  // namespace

SweepLoadResult sweepMessage(const LoadSweepResult& sweep) {
  SweepLoadResult message;
  MessageFields fields;
  for (const LoadSweepRow& row : sweep.rows) {
    visitSweepFields(row, fields);
    fields.fill(message.points.emplace_back());
  }
  for (const LoadSweepSummary& summary : sweep.summaries) {
    visitSummaryFields(summary, fields);
    fields.fill(message.summaries.emplace_back());
  }
  message.pull_in_voltage = sweep.pull_in_voltage;
  message.pull_in_reason = sweep.pull_in_reason;
  return message;
}

CycleContactResult cyclesMessage(const ContactCyclesResult& cycles) {
  CycleContactResult message;
  MessageFields fields;
  for (const ContactCycle& cycle : cycles.cycles) {
    visitCycleFields(cycle, fields);
    fields.fill(message.cycles.emplace_back());
  }
  message.first_sticking_cycle = static_cast<std::uint32_t>(cycles.first_sticking_cycle);
  return message;
}

}  // namespace mems_stiction
