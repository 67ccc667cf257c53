#pragma once

/// What predict_scan says of a scan, and where: the answer for people, or the whole record.

#include <string>
#include <vector>

#include "evaluation/record.hpp"

namespace mems_stiction {

enum class AnswerForm { kShort, kYaml, kJson };

/// On the standard output; the short one in colours where that is a terminal and NO_COLOR
/// (no-color.org) is not set.
void printAnswer(AnswerForm form, const std::string& file, const HeightMap& scan,
                 const Prediction& prediction, const RecordExtras& extras);

/// Whether a reader sees the warnings in the answer itself: the short one, where both outputs are
/// terminals. Then they need not stand on the standard error, too.
bool answerShowsWarnings(AnswerForm form);

/// Warnings about one scan: at once on the standard error, or, where the answer shows them, only if
/// there is none in the end.
class ScanWarnings {
 public:
  ScanWarnings(std::string path, bool answer_shows_them);
  ~ScanWarnings();
  ScanWarnings(const ScanWarnings&) = delete;
  ScanWarnings& operator=(const ScanWarnings&) = delete;

  /// @param of_settings counted before
  void addCounted(const std::vector<std::string>& of_settings);
  void add(const std::vector<std::string>& lines);
  void answered() { withheld_.clear(); }

 private:
  std::string path_;
  bool answer_shows_them_;
  std::vector<std::string> withheld_;
};

}  // namespace mems_stiction
