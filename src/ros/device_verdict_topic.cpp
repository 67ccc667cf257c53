#include "ros/device_verdict_topic.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "errors/one_line.hpp"
#include "evaluation/part_scans.hpp"
#include "ros/message_fields.hpp"
#include "ros/message_parts.hpp"
#include "ros/topic_names.hpp"
#include "verdict/part_verdict_fields.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

/// Scans whose answer may still change.
constexpr std::size_t kMostSaid = 100;

void fillAwaited(const AwaitedAnswers& awaited, DeviceVerdict& message) {
  message.waits_for = awaited.device_force ? kDeviceForceTopic : "";
  if (awaited.half_space)
    message.waits_for += std::string(message.waits_for.empty() ? "" : " ") + kHalfSpaceTopic;
  message.is_final =
      static_cast<decltype(message.is_final)>(message.waits_for.empty() && !awaited.is_overtaken);
}

}  // namespace

DeviceVerdict deviceVerdictMessage(const DeviceAnswer& answer, const AwaitedAnswers& awaited) {
  DeviceVerdict message;
  message.header = answer.last.header;
  message.scan_count = 1;
  message.verdict_by = judgeText(answer.verdict->judge);
  message.by_device_force =
      static_cast<decltype(message.by_device_force)>(answer.is_by_device_force);
  MessageFields fields;
  visitProvenanceFields(answer.last.provenance, fields);
  if (answer.part) {
    visitPartVerdictFields(*answer.part, fields);
  } else {
    visitVerdictFields(*answer.verdict, fields);
  }
  fields.fill(message);
  if (answer.part) message.settings_hash = answer.last.pool_settings_hash;
  message.word = sticksText(static_cast<Sticks>(message.sticks));
  message.reason = withoutCommas(oneLine(message.reason));
  fillAwaited(awaited, message);
  return message;
}

std::vector<DeviceVerdict> DeviceVerdicts::answer(const DeviceAnswer& answer,
                                                  const AwaitedAnswers& awaited,
                                                  bool is_of_newest_scan) {
  const auto before = std::find_if(
      said_.begin(), said_.end(), [&](const Said& said) { return said.scan_id == answer.last.id; });
  Said said{answer.last.id, {}};
  if (answer.verdict) {
    said.message = deviceVerdictMessage(answer, awaited);
  } else {
    if (before == said_.end() || awaited.is_overtaken) return {};
    said.message = before->message;
    fillAwaited(awaited, said.message);
    if (said.message.waits_for == before->message.waits_for) return {};
  }
  if (before != said_.end()) said_.erase(before);
  std::vector<DeviceVerdict> messages{said.message};
  said_.push_front(std::move(said));
  if (said_.size() > kMostSaid) said_.pop_back();
  if (is_of_newest_scan) {
    newest_ = messages.front();
  } else if (newest_) {
    messages.push_back(*newest_);
  }
  return messages;
}

bool DeviceVerdicts::isByDeviceForce(const ScanOfPart& scan) const {
  const Provenance& of = scan.provenance;
  const bool has_part = PartKey{of.part_id, of.serial_id, ""}.isStated();
  const auto last = std::find_if(said_.begin(), said_.end(), [&](const Said& said) {
    return has_part ? said.message.part_id == of.part_id && said.message.serial_id == of.serial_id
                    : said.scan_id == scan.id;
  });
  return last != said_.end() && static_cast<bool>(last->message.by_device_force);
}

DeviceVerdictTopic::DeviceVerdictTopic(const ros::NodeHandle& handle) {
  ros::NodeHandle node(handle);
  publisher_ = node.advertise<DeviceVerdict>(kVerdictTopic, kPredictionQueue, true);
}

void DeviceVerdictTopic::publish(const DeviceAnswer& answer, const AwaitedAnswers& awaited,
                                 bool is_of_newest_scan) {
  for (const DeviceVerdict& message : said_.answer(answer, awaited, is_of_newest_scan))
    publisher_.publish(message);
}

}  // namespace mems_stiction
