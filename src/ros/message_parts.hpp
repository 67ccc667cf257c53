#pragma once

/// @file
/// What several messages have in common: texts, the verdict, and where a result comes from.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "errors/one_line.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// Semicolons in the place of commas: `rostopic echo -p` puts commas between fields and no marks
/// around texts.
inline std::string withoutCommas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

inline std::vector<std::string> withoutCommas(std::vector<std::string> texts) {
  for (std::string& text : texts) text = withoutCommas(std::move(text));
  return texts;
}

/// The verdict into the fields that every message has that carries one beside its figures.
template <typename Message>
void fillVerdict(const Verdict& verdict, Message& message) {
  message.sticks = static_cast<decltype(message.sticks)>(verdict.sticks);
  message.reason = withoutCommas(oneLine(verdict.reason));
  message.verdict_by = judgeText(verdict.judge);
  message.margin = verdict.margin;
  message.margin_lower = verdict.margin_lower;
  message.margin_upper = verdict.margin_upper;
  message.peel_number = verdict.peel_number;
  message.peel_number_lower = verdict.peel_number_lower;
  message.peel_number_upper = verdict.peel_number_upper;
  message.governed_by = verdict.governed_by;
}

/// As if nobody had judged.
template <typename Message>
void clearVerdict(Message& message) {
  fillVerdict(Verdict(), message);
  message.verdict_by.clear();
}

/// What was scanned: between ScanIdentity, ScanInfo and the messages with results, which name it
/// alike.
template <typename Source, typename Target>
void copyIdentity(const Source& source, Target& target) {
  target.scan_name = source.scan_name;
  target.part_id = source.part_id;
  target.serial_id = source.serial_id;
  target.lot_id = source.lot_id;
  target.wafer_id = source.wafer_id;
  target.site_x = source.site_x;
  target.site_y = source.site_y;
  target.acquisition_time = source.acquisition_time;
  target.instrument = source.instrument;
  target.operator_name = source.operator_name;
  target.checksum = source.checksum;
}

template <typename Message>
void fillProvenance(const Provenance& provenance, Message& message) {
  message.version = provenance.version;
  message.settings_hash = provenance.settings_hash;
  copyIdentity(provenance, message);
}

}  // namespace mems_stiction
