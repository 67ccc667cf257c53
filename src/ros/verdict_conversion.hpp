#pragma once

/// @file
/// The verdict in the messages that carry one beside their figures.

#include "errors/one_line.hpp"
#include "mems_stiction/verdict/verdict.hpp"
#include "ros/message_text.hpp"

namespace mems_stiction {

/// Into the fields of @p message that every such message has.
template <typename Message>
void fillVerdict(const Verdict& verdict, Message& message) {
  message.sticks = static_cast<decltype(message.sticks)>(verdict.sticks);
  message.verdict_reason = withoutCommas(oneLine(verdict.reason));
  message.verdict_by = judgeText(verdict.judge);
  message.margin = verdict.margin;
  message.margin_lower = verdict.margin_lower;
  message.margin_upper = verdict.margin_upper;
  message.peel_number = verdict.peel_number;
  message.peel_number_lower = verdict.peel_number_lower;
  message.peel_number_upper = verdict.peel_number_upper;
}

/// As if nobody had judged.
template <typename Message>
void clearVerdict(Message& message) {
  fillVerdict(Verdict(), message);
  message.verdict_by.clear();
}

}  // namespace mems_stiction
