#include "source/name_rules.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

/// What programs call files that are not whole yet, or only theirs; Windows leaves the last two.
constexpr std::array<const char*, 11> kTemporaryEndings = {
    ".tmp", ".temp", ".part", ".partial",  ".crdownload", ".filepart",
    ".swp", ".lock", "~",     "thumbs.db", "desktop.ini"};

constexpr std::array<std::pair<const char*, std::string ScanIdentity::*>, 4> kTextGroups = {
    {{"part_id", &ScanIdentity::part_id},
     {"serial_id", &ScanIdentity::serial_id},
     {"lot_id", &ScanIdentity::lot_id},
     {"wafer_id", &ScanIdentity::wafer_id}}};
constexpr std::array<std::pair<const char*, double ScanIdentity::*>, 2> kSiteGroups = {
    {{"site_x", &ScanIdentity::site_x}, {"site_y", &ScanIdentity::site_y}}};

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::size_t first = text.find_first_not_of(' ', begin);
    if (first < end)
      parts.push_back(text.substr(first, text.find_last_not_of(' ', end - 1) + 1 - first));
    begin = end + 1;
  }
  return parts;
}

/// Python's way to name a group, in Perl's.
std::string perlOf(std::string pattern) {
  for (std::size_t at = pattern.find("(?P<"); at != std::string::npos;
       at = pattern.find("(?P<", at)) {
    pattern.erase(at + 2, 1);
  }
  return pattern;
}

std::vector<std::string> groupsOf(const std::string& pattern) {
  std::vector<std::string> names;
  for (std::size_t at = pattern.find("(?<"); at != std::string::npos;
       at = pattern.find("(?<", at + 1)) {
    const std::size_t begin = at + 3;
    if (begin < pattern.size() && pattern[begin] != '=' &&
        pattern[begin] != '!') {  // else it looks behind
      names.push_back(pattern.substr(begin, pattern.find('>', begin) - begin));
    }
  }
  return names;
}

bool isKnownGroup(const std::string& name) {
  const auto has_name = [&](const auto& group) { return name == group.first; };
  return std::any_of(kTextGroups.begin(), kTextGroups.end(), has_name) ||
         std::any_of(kSiteGroups.begin(), kSiteGroups.end(), has_name);
}

boost::regex compiled(const std::string& stated) {
  const std::string pattern = perlOf(stated);
  const std::string prefix =
      "name_pattern: '" + shortened(stated, kLongestQuotation) + "' is not allowed, ";
  const std::vector<std::string> groups = groupsOf(pattern);
  if (groups.empty()) throw OptionsError({prefix + "must name a group, as in (?<part_id>[0-9]+)"});
  for (const std::string& name : groups) {
    if (isKnownGroup(name)) continue;
    throw OptionsError({prefix + "a group '" + shortened(name, kLongestQuotation) +
                        "' must be part_id, serial_id, lot_id, wafer_id, site_x or site_y"});
  }
  try {
    return boost::regex(pattern, boost::regex::perl);
  } catch (const boost::regex_error& error) {
    throw OptionsError({prefix + "must be a regular expression: " + oneLine(error.what())});
  }
}

}  // namespace

NameRules::NameRules(const std::string& patterns, const std::string& name_pattern,
                     double site_scale)
    : patterns_(splitAtCommas(patterns)),
      stated_pattern_(name_pattern),
      name_pattern_(name_pattern.empty() ? boost::regex() : compiled(name_pattern)),
      site_scale_(site_scale) {}

bool NameRules::isScan(const std::string& name) const {
  const std::string own = std::filesystem::path(name).filename().string();
  const std::string low = lowered(own);
  if (own.empty() || own.front() == '.' || endsWith(low, ".yaml") || endsWith(low, ".yml"))
    return false;
  if (patterns_.empty()) {
    return own.front() != '~' &&
           std::none_of(kTemporaryEndings.begin(), kTemporaryEndings.end(),
                        [&](const char* ending) { return endsWith(low, ending); });
  }
  return std::any_of(patterns_.begin(), patterns_.end(), [&](const std::string& pattern) {
    const bool is_of_path = pattern.find('/') != std::string::npos;
    return fnmatch(pattern.c_str(), (is_of_path ? name : own).c_str(), FNM_CASEFOLD) == 0;
  });
}

std::string NameRules::identify(const std::string& name, ScanIdentity& identity) const {
  if (stated_pattern_.empty()) return "";
  boost::smatch match;
  try {
    if (!boost::regex_search(name, match, name_pattern_)) return "does not match name_pattern";
  } catch (const std::runtime_error&) {
    return "takes name_pattern too long to match";
  }
  for (const auto& [group, member] : kTextGroups) {
    if (match[group].matched && !isStated(identity.*member)) identity.*member = match[group].str();
  }
  if (isStated(identity.site_x) || isStated(identity.site_y)) return "";
  ScanIdentity site;  // one place of two is none
  for (const auto& [group, member] : kSiteGroups) {
    if (!match[group].matched) continue;
    const std::string text = match[group].str();
    char* end = nullptr;
    const double number = plainStrtod(text.c_str(), &end);
    if (text.empty() || *end != '\0')
      return std::string("has a ") + group + " that is no number: '" + text + "'";
    site.*member = number * site_scale_;
  }
  if (isStated(site.site_x) != isStated(site.site_y)) return "has one of site_x and site_y alone";
  identity.site_x = site.site_x;
  identity.site_y = site.site_y;
  return "";
}

}  // namespace mems_stiction
