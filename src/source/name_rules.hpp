#pragma once

/// @file
/// What the name of a file says: whether it is a scan at all, and of which part, lot, wafer and
/// site.
///
///     const NameRules rules("*.di", R"((?<lot_id>L\d+)/part(?<part_id>\d+))", 1e-3);
///     // part_id 12, lot_id L7
///     if (rules.isScan("L7/part12.di")) rules.identify("L7/part12.di", identity);

#include <string>
#include <vector>

#include <boost/regex.hpp>

#include "mems_stiction/height_map/scan_identity.hpp"

namespace mems_stiction {

/// Names are relative to the folder that is watched.
class NameRules {
 public:
  /// - @p patterns with commas between them, for fnmatch() without regard to case, of names or,
  /// with a slash, of whole
  ///        relative paths; empty = every name but those of temporary files
  /// - @p name_pattern Perl's regular expression; `(?<part_id>...)` and `(?P<part_id>...)` name a
  /// group; empty = none
  /// - @p site_scale of site_x and site_y [m per unit of the name]
  /// @throw OptionsError for a pattern that is none, and for a group of another name
  NameRules(const std::string& patterns, const std::string& name_pattern, double site_scale);

  /// Hidden files and files of settings never are.
  bool isScan(const std::string& name) const;

  /// Sets those texts and numbers of the identity that are not stated yet.
  /// @return an empty text, or why the name says nothing
  std::string identify(const std::string& name, ScanIdentity& identity) const;

 private:
  std::vector<std::string> patterns_;
  std::string stated_pattern_;
  boost::regex name_pattern_;
  double site_scale_;
};

}  // namespace mems_stiction
