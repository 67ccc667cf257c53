#pragma once

/// Pages of doc/ whose tables come from the code: what the code says, and what the page says
/// between its markers
///
///     <!-- begin NAME: ... -->
///     ...
///     <!-- end NAME -->

#include <string>

#include "settings/option_yaml.hpp"

namespace mems_stiction {
namespace documents {

/// The settings as Markdown: a heading and a table per section, one row per key with default, unit,
/// range and meaning.
std::string parameterTables(const DescribeFunction& describe);

/// The default of one setting as parameterTables() shows it; empty if there is no such key.
std::string defaultText(const DescribeFunction& describe, const std::string& key);

/// What stands between the markers of a page. @throw std::runtime_error if it has none of that
/// name.
std::string generatedPart(const std::string& page, const std::string& name);

/// The page's text with `part` between the markers.
std::string withGeneratedPart(const std::string& page, const std::string& name,
                              const std::string& part);

/// Expects that the page's part is what the code says. With MEMS_STICTION_WRITE_DOCUMENTS set in
/// the environment, writes it instead.
void expectUpToDate(const std::string& path, const std::string& name, const std::string& part);

}  // namespace documents
}  // namespace mems_stiction
