#pragma once

/// @file
/// Which scan it is: of which part and which place on its wafer, by whom and with what it was
/// measured, and from which bytes it was read.
///
///     ScanIdentity identity;
///     identity.part_id = "beam";
///     identity.serial_id = "0012";
///     for (const std::string& complaint : identityComplaints(identity, "")) report(complaint);

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "mems_stiction/settings/figure.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

/// Texts are empty, and numbers NaN, where nobody states them.
struct ScanIdentity {
  std::string scan_name = {};
  std::string part_id = {};
  std::string serial_id = {};
  std::string lot_id = {};
  std::string wafer_id = {};
  double site_x = std::numeric_limits<double>::quiet_NaN();  ///< of the scan on its wafer [m];
                                                             ///< stated with site_y or not
  double site_y = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  std::string acquisition_time = {};
  std::string instrument = {};
  std::string operator_name = {};
  std::string checksum = {};  ///< sha256Text() of the file's bytes

  /// Every field as "scan/..." but the checksum, which nobody states by hand.
  void describe(OptionVisitor& visitor);
};

inline bool isStated(const std::string& text) { return !text.empty(); }
inline bool isStated(double number) { return !std::isnan(number); }

/// A text that states who or what, in bytes: such texts are kept for a thousand scans of each part.
constexpr std::size_t kLongestName = 1000;

/// Calls visit(Figure, value) for each field, by the names of the messages.
template <typename Source, typename Visitor>
void visitScanIdentityFields(Source& identity, Visitor&& visit) {
  visit({"scan_name", "", "scan_info.scan_name, else the frame_id"}, identity.scan_name);
  visit({"part_id", "", "scan_info.part_id, else the parameter part/id"}, identity.part_id);
  visit({"serial_id", "", "scan_info.serial_id, else the parameter part/serial"},
        identity.serial_id);
  visit({"lot_id", "", "scan_info.lot_id, else the parameter part/lot"}, identity.lot_id);
  visit({"wafer_id", "", "scan_info.wafer_id, else the parameter part/wafer"}, identity.wafer_id);
  visit({"site_x", "m", "where on its wafer the scan was taken"}, identity.site_x);
  visit({"site_y", "m", "where on its wafer the scan was taken"}, identity.site_y);
  visit({"acquisition_time", "",
         "when it was measured, by ISO 8601; without a zone where the file states none"},
        identity.acquisition_time);
  visit({"instrument", "", "it was measured with"}, identity.instrument);
  visit({"operator_name", "", "who measured it"}, identity.operator_name);
  visit({"checksum", "", "sha256: and 64 hexadecimal digits, of the bytes of the scan's file"},
        identity.checksum);
}

/// What both state alike of part, serial number, lot, wafer, instrument and operator: of scans that
/// count together.
ScanIdentity commonIdentity(const ScanIdentity& one, const ScanIdentity& other);

/// What cannot be: names that are too long, and half a site. One line each, that begins with the
/// name of the field.
/// - @p prefix of the names of the fields: "scan_info."
std::vector<std::string> identityComplaints(const ScanIdentity& identity,
                                            const std::string& prefix);

}  // namespace mems_stiction
