#include "evaluation/row_columns.hpp"

#include <algorithm>
#include <functional>
#include <regex>

#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr const char* kAll = "all";

bool isAmong(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The names of groups are no more than columns' for who mistypes one.
[[noreturn]] void refuseWord(const std::string& word, const std::vector<std::string>& names) {
  std::vector<std::string> groups;
  for (const ColumnGroup& group : columnGroups()) groups.emplace_back(group.name);
  std::vector<std::string> choices = groups;
  choices.emplace_back(kAll);
  choices.insert(choices.end(), names.begin(), names.end());
  throw OptionsError({"--columns: '" + word + "' is neither a column nor a group" +
                      suggestion(word, choices) + "; groups are " + listed(groups) + ", and " +
                      kAll});
}

/// Those of the names whose group this is.
std::vector<std::string> ofGroup(const ColumnGroup& wanted, const std::vector<std::string>& names) {
  std::vector<std::string> left = names;
  for (const ColumnGroup& group : columnGroups()) {
    const std::regex pattern(group.pattern);
    const auto fits = [&](const std::string& name) { return std::regex_match(name, pattern); };
    if (&group == &wanted) {
      left.erase(std::remove_if(left.begin(), left.end(), std::not_fn(fits)), left.end());
      return left;
    }
    left.erase(std::remove_if(left.begin(), left.end(), fits), left.end());
  }
  return {};
}

std::vector<std::string> columnsOf(const std::string& word, const std::vector<std::string>& names,
                                   const std::vector<std::string>& known) {
  if (word == kAll) return names;
  if (isAmong(names, word)) return {word};
  for (const ColumnGroup& group : columnGroups()) {
    if (word == group.name) return ofGroup(group, known);
  }
  refuseWord(word, names);
}

}  // namespace

const std::vector<ColumnGroup>& columnGroups() {
  static const std::vector<ColumnGroup> groups = {
      {"origin", "which scan of what, when and by whom",
       R"(time|stamp|bag|topic|frame_id|number|file|scan|name|channel|scan_name|\w+_id|site_[xy]|)"
       R"(acquisition_time|instrument|operator_name|checksum|file_\w+|\w+_checksum|scan_count)"},
      {"half_space", "the surface as one elastic half-space", R"(half_space_\w+)"},
      {"verdict", "does the device stick",
       R"(sticks|reason|verdict_\w+|margin\w*|peel_number\w*|restoring_force|)"
       R"(device_pull_off_force\w*|detachment_length|unstuck_length|pull_in_voltage\w*|)"
       R"(governed_by|is_peeled|place_deviation)"},
      {"doubts", "flags and warnings",
       R"(\w*flags|regime_flag_names|model_doubt|warnings|is_\w+|below_tip_count|tip_\w+|message|)"
       R"(unresolved_\w+|needed_pitch)"},
      {"settings", "what was predicted with",
       R"(version|settings_hash|formulation|voltage|mechanical_load|preprocessing|steps|)"
       R"(processing_time|realisations|cells|pitch\w*|area|rows|cols)"},
      {"roughness", "of the surface, ISO 25178-2",
       R"(roughness/\w+|spatial_roughness/\w+|composite_rms_height|rms_height|invalid_fraction|)"
       R"(s[aqpvz]|ssk|sku|sdq|sdr|sal|str|m[024]|nayak|hurst|summit_density|)"
       R"(mean_summit_radius)"},
      {"energy", "energies and bonding",
       R"(\w+_energy|plastic_work|bonding_\w+|adhesion_parameter|flattening_ratio)"},
      {"contact", "where the surfaces touch",
       R"(status|separation_at_rest|contact_(area\w*|fraction|theory)|nominal_area|approach|)"
       R"(mean_gap|max_tilt|median_\w+|\w*(asperity|elastic|plastic|contact)_count|contacts\w*)"},
      {"forces", "forces and works", R"(\w*(force|load|stiffness|adhesion|exponent)(_\w+)?)"},
      {"other", "the rest", R"(.*)"},
  };
  return groups;
}

std::string columnGroupsText() {
  std::string text;
  for (const ColumnGroup& group : columnGroups()) {
    text += (text.empty() ? "" : "; ") + std::string(group.name) + ": " + group.meaning;
  }
  return text;
}

std::vector<std::string> chosenColumns(const std::vector<std::string>& names,
                                       const std::vector<std::string>& known,
                                       const std::optional<std::string>& wanted) {
  if (!wanted) return known;
  std::vector<std::string> chosen;
  std::size_t start = 0;
  while (start != std::string::npos) {
    const std::size_t comma = wanted->find(',', start);
    const std::string word =
        trimmed(wanted->substr(start, comma == std::string::npos ? comma : comma - start), " \t\n");
    addMissing(columnsOf(word, names, known), chosen);
    start = comma == std::string::npos ? comma : comma + 1;
  }
  return chosen;
}

}  // namespace mems_stiction
