#include "ros/device_verdict_topic.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "errors/one_line.hpp"
#include "ros/message_parts.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {
namespace {

/// Scans whose answer may still change.
constexpr std::size_t kMostSaid = 100;

void fillAwaited(const AwaitedAnswers& awaited, DeviceVerdict& message) {
  message.waits_for = awaited.device_force ? kDeviceForceTopic : "";
  if (awaited.half_space) message.waits_for += std::string(message.waits_for.empty() ? "" : " ") + kHalfSpaceTopic;
  message.is_final = static_cast<decltype(message.is_final)>(message.waits_for.empty());
}

/// - @p judgement a Verdict or a PooledVerdict
template <typename Judgement>
void fillWord(const Judgement& judgement, DeviceVerdict& message) {
  message.sticks = static_cast<decltype(message.sticks)>(judgement.sticks);
  message.word = sticksText(judgement.sticks);
  message.reason = withoutCommas(oneLine(judgement.reason));
}

}  // namespace

DeviceVerdict deviceVerdictMessage(const DeviceAnswer& answer, const AwaitedAnswers& awaited) {
  const Provenance& provenance = answer.last.provenance;
  DeviceVerdict message;
  message.header = answer.last.header;
  message.part_id = provenance.part_id;
  message.serial_id = provenance.serial_id;
  message.scan_name = provenance.scan_name;
  message.settings_hash = answer.part ? answer.last.pool_settings_hash : provenance.settings_hash;
  message.version = provenance.version;
  message.scan_count = answer.part ? static_cast<std::uint32_t>(answer.part->scan_count) : 1U;
  message.by_device_force = static_cast<decltype(message.by_device_force)>(answer.is_by_device_force);
  const auto fill_ratios = [&message](const auto& margin, const auto& peel_number) {
    std::tie(message.margin, message.margin_lower, message.margin_upper) = margin;
    std::tie(message.peel_number, message.peel_number_lower, message.peel_number_upper) = peel_number;
  };
  if (answer.part) {
    const PooledVerdict& part = *answer.part;
    fillWord(part, message);
    message.verdict_by = part.verdict_by;
    fill_ratios(std::make_tuple(part.margin.value, part.margin.lower, part.margin.upper),
                std::make_tuple(part.peel_number.value, part.peel_number.lower, part.peel_number.upper));
  } else {
    const Verdict& verdict = *answer.verdict;
    fillWord(verdict, message);
    message.verdict_by = judgeText(verdict.judge);
    fill_ratios(std::make_tuple(verdict.margin, verdict.margin_lower, verdict.margin_upper),
                std::make_tuple(verdict.peel_number, verdict.peel_number_lower, verdict.peel_number_upper));
  }
  fillAwaited(awaited, message);
  return message;
}

DeviceVerdictTopic::DeviceVerdictTopic(const ros::NodeHandle& handle) {
  ros::NodeHandle node(handle);
  publisher_ = node.advertise<DeviceVerdict>(kVerdictTopic, kPredictionQueue, true);
}

void DeviceVerdictTopic::publish(const DeviceAnswer& answer, const AwaitedAnswers& awaited) {
  const auto before =
      std::find_if(said_.begin(), said_.end(), [&](const Said& said) { return said.scan_id == answer.last.id; });
  Said said{answer.last.id, {}};
  if (answer.verdict) {
    said.message = deviceVerdictMessage(answer, awaited);
  } else {
    if (before == said_.end()) return;
    said.message = before->message;
    fillAwaited(awaited, said.message);
    if (said.message.waits_for == before->message.waits_for) return;
  }
  if (before != said_.end()) said_.erase(before);
  publisher_.publish(said.message);
  said_.push_front(std::move(said));
  if (said_.size() > kMostSaid) said_.pop_back();
}

}  // namespace mems_stiction
