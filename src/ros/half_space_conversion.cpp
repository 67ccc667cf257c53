#include "ros/half_space_conversion.hpp"

#include <algorithm>
#include <vector>

#include "errors/one_line.hpp"
#include "half_space/half_space_fields.hpp"
#include "ros/message_fields.hpp"
#include "ros/message_parts.hpp"

namespace mems_stiction {
namespace {

// The message states the same numbers as the core's enumeration.
static_assert(static_cast<int>(HalfSpaceStatus::kSolved) == HalfSpaceSolution::SOLVED, "status");
static_assert(static_cast<int>(HalfSpaceStatus::kLoadNotReached) ==
                  HalfSpaceSolution::LOAD_NOT_REACHED,
              "status");
static_assert(static_cast<int>(HalfSpaceStatus::kNotConverged) == HalfSpaceSolution::NOT_CONVERGED,
              "status");
static_assert(static_cast<int>(HalfSpaceStatus::kTooManyStates) ==
                  HalfSpaceSolution::TOO_MANY_STATES,
              "status");
static_assert(static_cast<int>(HalfSpaceStatus::kCancelled) == HalfSpaceSolution::CANCELLED,
              "status");

void addPoints(const std::vector<ForcePoint>& points, std::uint8_t direction,
               std::vector<HalfSpacePoint>& curve) {
  if (points.empty()) return;
  const auto largest = static_cast<std::size_t>(
      std::max_element(points.begin(), points.end(),
                       [](const ForcePoint& left, const ForcePoint& right) {
                         return left.force < right.force;
                       }) -
      points.begin());
  // the last and the largest one may come on top of every stride-th
  const std::size_t stride =
      points.size() <= kMostCurvePoints ? 1 : points.size() / (kMostCurvePoints - 2) + 1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % stride != 0 && i != largest && i + 1 != points.size()) continue;
    HalfSpacePoint point;
    point.height = points[i].height;
    point.force = points[i].force;
    point.direction = direction;
    curve.push_back(point);
  }
}

}  // namespace

HalfSpaceSolution halfSpaceMessage(const SolvedHalfSpace& solved, const LoadOptions& load,
                                   const std_msgs::Header& header) {
  HalfSpaceSolution message;
  message.header = header;
  MessageFields fields;
  visitHalfSpaceFields(solved, fields);
  visitHalfSpaceDetails(solved, fields);
  fields.fill(message);
  message.message = withoutCommas(oneLine(solved.message));
  message.voltage = load.voltage;
  message.mechanical_load = load.mechanical_load;
  message.states = static_cast<std::uint32_t>(solved.state_count);

  addPoints(solved.approach, HalfSpacePoint::APPROACH, message.curve);
  addPoints(solved.retraction, HalfSpacePoint::RETRACTION, message.curve);
  clearVerdict(message);
  return message;
}

HalfSpaceSolution refusedMessage(const std::string& reason, const LoadOptions& load,
                                 const std_msgs::Header& header) {
  HalfSpaceSolution message = halfSpaceMessage(SolvedHalfSpace(), load, header);
  message.status = HalfSpaceSolution::REFUSED;
  message.message = withoutCommas(oneLine(reason));
  return message;
}

}  // namespace mems_stiction
