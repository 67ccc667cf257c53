#include "import/file_statements.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>

#include "errors/one_line.hpp"
#include "import/acquisition_time.hpp"
#include "import/length_unit.hpp"
#include "import/plain_number.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr std::size_t kLongestStatement = 200;  // [bytes]

/// "General Info::Acquisition time" is "acquisitiontime".
std::string plainName(const std::string& name) {
  const std::size_t section = name.rfind('/');
  const std::size_t scope = name.rfind("::");
  std::size_t begin = section == std::string::npos ? 0 : section + 1;
  if (scope != std::string::npos) begin = std::max(begin, scope + 2);
  std::string plain;
  for (const char letter : lowered(name.substr(begin))) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) plain += letter;
  }
  return plain;
}

/// One line of UTF-8, not too long; empty where it says that nothing is known.
std::string statement(const std::string& value) {
  std::string text = oneLine(trimmed(toUtf8(value), " \t\r\n"));
  const std::string word = lowered(text);
  if (isMissingWord(text) || word == "not available" || word == "unknown" ||
      word == "not specified")
    return "";
  if (text.size() <= kLongestStatement) return text;
  std::size_t end = kLongestStatement - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
    --end;  // inside of a letter
  return text.substr(0, end) + "...";
}

/// The names of a file without its sections.
class Statements {
 public:
  explicit Statements(const FileStatements& statements) {
    for (const auto& [name, value] : statements) {
      const std::string text = statement(value);
      if (!text.empty()) values_.emplace(plainName(name), text);
    }
  }

  /// Of the first name that is there.
  std::string first(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const auto found = values_.find(name);
      if (found != values_.end()) return found->second;
    }
    return "";
  }

 private:
  std::map<std::string, std::string> values_;
};

std::string joined(const std::string& first, const char* between, const std::string& second) {
  return first.empty() || second.empty() ? first + second : first + between + second;
}

std::string timeOf(const Statements& said) {
  const std::string day = said.first({"acquisitiondatetime", "acquisitiontime", "acquisitiondate",
                                      "measurementdate", "scandate", "datetime", "date"});
  const std::string time = said.first({"scantime", "time"});
  const bool is_whole =
      day.empty() || day.find(':') != std::string::npos || time.find(':') == std::string::npos;
  return acquisitionTime(
      is_whole ? day : joined(day, " ", time));  // a time without a colon is a duration
}

std::string instrumentOf(const Statements& said) {
  const std::string maker = said.first({"manufacturer", "instrumentmanufacturer"});
  const std::string model =
      said.first({"model", "instrumentmodel", "instrument", "instrumentname", "microscope",
                  "microscopename", "scannertype", "headtype", "headname"});
  const std::string serial =
      said.first({"instrumentserialnumber", "serialnumber", "serial", "dulcineaserialnumber"});
  return joined(joined(maker, " ", model), ", ", serial.empty() ? "" : "serial number " + serial);
}

}  // namespace

ScanIdentity identityFrom(const FileStatements& statements) {
  const Statements said(statements);
  ScanIdentity identity;
  identity.acquisition_time = timeOf(said);
  identity.instrument = instrumentOf(said);
  identity.operator_name =
      said.first({"operator", "operatorname", "username", "user", "creator", "measuredby"});
  return identity;
}

ScanIdentity completed(ScanIdentity identity, const ScanIdentity& other) {
  for (std::string ScanIdentity::*text :
       {&ScanIdentity::acquisition_time, &ScanIdentity::instrument, &ScanIdentity::operator_name}) {
    if ((identity.*text).empty()) identity.*text = other.*text;
  }
  return identity;
}

}  // namespace mems_stiction
