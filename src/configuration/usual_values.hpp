#pragma once

/// @file
/// Which constants are likely? What no material, device or instrument is likely to have is a slip
/// of a unit: a modulus of 169 is 169 GPa, a hundred metres of insulator are 100 nm.

#include <string>
#include <vector>

namespace mems_stiction {

struct Configuration;

/// One sentence, without commas, for each stated constant that is not usual, with the unit that was
/// probably meant. Zeros say "not stated".
struct SettingRemarks {
  std::vector<std::string> implausible;  ///< refused unless limits/accept_implausible is true
  std::vector<std::string> unusual;      ///< warned of
};

SettingRemarks settingRemarks(const Configuration& configuration);

/// A number as sentences about settings show it.
std::string fourDigits(double value);

/// Whether @p value of a key that settingRemarks() knows is usual.
bool isUsual(const std::string& key, double value);

}  // namespace mems_stiction
