#pragma once

/// @file
/// Where a figure comes from, so that whoever finds it years later can tell: which part, which
/// scan, which settings, which version.
///
///     const Provenance origin = provenanceOf(identity, configuration);
///     print(origin.scan_name, origin.version, origin.settings_hash);

#include <string>

#include "mems_stiction/height_map/scan_identity.hpp"
#include "mems_stiction/settings/figure.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

struct Configuration;

/// The part whose scans are predicted, where the scans themselves do not say.
struct PartOptions {
  std::string id;      ///< scans of one id belong together
  std::string serial;  ///< its serial number
  std::string lot;     ///< that its wafer is of
  std::string wafer;   ///< that it is of

  void describe(OptionVisitor& visitor);
};

/// What was scanned, and what it was predicted with.
struct Provenance : ScanIdentity {
  std::string version;        ///< of this package
  std::string settings_hash;  ///< of settingsHash()
};

/// "1.2.3", of this package.
const char* packageVersion();

/// 16 hexadecimal digits, the same for configurations that give the same figures: of every setting
/// but part/... (who it is), limits/... (what it may take), output/... (what is asked for) and
/// half_space/threads. Files that settings name count by their content, not by their names.
std::string settingsHash(const Configuration& configuration);

/// - @p configuration that the prediction was made with
Provenance provenanceOf(const ScanIdentity& identity, const Configuration& configuration);

/// Calls visit(Figure, value) for each field, by the names of the messages.
template <typename Source, typename Visitor>
void visitProvenanceFields(Source& provenance, Visitor&& visit) {
  visit({"version", "", "of this package"}, provenance.version);
  visit({"settings_hash", "", "16 hexadecimal digits, of every setting that bears on the figures"},
        provenance.settings_hash);
  visitScanIdentityFields(provenance, visit);
}

/// Of the same fields those that are stated: no empty text, and no NaN.
template <typename Visitor>
void visitStatedProvenance(const Provenance& provenance, Visitor&& visit) {
  visitProvenanceFields(provenance, [&](const Figure& figure, const auto& value) {
    if (isStated(value)) visit(figure, value);
  });
}

}  // namespace mems_stiction
