#include "scan_answer.hpp"

#include <unistd.h>

#include <cstdlib>
#include <utility>

#include "command_line.hpp"
#include "evaluation/short_record.hpp"

namespace mems_stiction {
namespace {

/// What a variable of the environment says; empty where it is not set.
std::string environmentText(const char* name) {
  const char* const text = std::getenv(name);
  return text != nullptr ? text : "";
}

bool hasColours() {
  return isatty(STDOUT_FILENO) == 1 && environmentText("NO_COLOR").empty() &&
         environmentText("TERM") != "dumb";
}

}  // namespace

void printAnswer(AnswerForm form, const std::string& file, const HeightMap& scan,
                 const Prediction& prediction, const RecordExtras& extras) {
  switch (form) {
    case AnswerForm::kJson:
      std::cout << jsonRecord(file, scan, prediction, extras) << std::endl;
      return;
    case AnswerForm::kYaml:
      std::cout << yamlRecord(file, scan, prediction, extras) << std::flush;
      return;
    case AnswerForm::kShort:
      std::cout << shortRecord(file, scan, prediction, extras, hasColours()) << std::flush;
      return;
  }
}

bool answerShowsWarnings(AnswerForm form) {
  return form == AnswerForm::kShort && isatty(STDOUT_FILENO) == 1 && isatty(STDERR_FILENO) == 1;
}

ScanWarnings::ScanWarnings(std::string path, bool answer_shows_them)
    : path_(std::move(path)), answer_shows_them_(answer_shows_them) {}

ScanWarnings::~ScanWarnings() {
  for (const std::string& line : withheld_) printWarning(path_, line);
}

void ScanWarnings::addCounted(const std::vector<std::string>& of_settings) {
  if (answer_shows_them_) withheld_.insert(withheld_.end(), of_settings.begin(), of_settings.end());
}

void ScanWarnings::add(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (!answer_shows_them_) {
      warn(path_, line);
      continue;
    }
    ++warningCount();
    withheld_.push_back(line);
  }
}

}  // namespace mems_stiction
