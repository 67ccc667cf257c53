#pragma once

/// What a prediction has to say for one row of a table, and in full for a report.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "batch_rows.hpp"
#include "contact/curve_point.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/verdict.hpp"

namespace mems_stiction {

/// Where a scan comes from. The number counts from 1 over all inputs.
struct ScanOrigin {
  std::size_t number = 0;
  std::string file;      ///< as the user wrote it
  std::size_t scan = 0;  ///< in its bag, from 1; 0 for a file
  std::string name;      ///< the frame_id; empty for a file
  std::string stamp;     ///< seconds.nanoseconds; empty for a file
  std::string channel;   ///< of an instrument maker's file
};

/// number, file, scan, name, stamp, channel, message; the message says why the scan was not
/// predicted, and is empty if it was.
RowFields originFields(const ScanOrigin& origin, const std::string& message);

/// The figures of the prediction, by the names of StictionPrediction, and of the verdict if there
/// is one. No wall time: the same scan gives the same row. Flags of the model's range are there
/// with and without a verdict.
/// @param formulation that the prediction is of
RowFields figureFields(const HeightMap& scan, const std::vector<std::string>& warnings,
                       const Prediction& prediction, const std::optional<Verdict>& verdict,
                       const std::string& formulation, const Provenance& provenance);

/// A row with every column in order, as it is without a value.
/// @param formulation those of figures that it has not are left out
/// @param with_verdict whether a device is stated
RowFields sampleFields(const std::string& formulation, bool with_verdict);

/// The unit of every such column that has one.
std::map<std::string, std::string> columnUnits(const std::string& formulation, bool with_verdict);

/// A curve by its columns height [m], force [N] and direction; no column without a point.
nlohmann::json curveColumns(const std::vector<CurvePoint>& curve);

/// Maps of the size of the scan, by the names of their files.
using NamedMaps = std::vector<std::pair<std::string, cv::Mat>>;

/// Writes heights.npy, deformed.npy, counter_deformed.npy (float64 [m], NaN where invalid),
/// contact_map.npy (uint8) and, last, result.json: figures, asperities, energy curve and force
/// curve by columns. Makes the folder.
/// @param prepared the scan that the model got, before contact
/// @param curve force over height of the prediction, as far as it has one
/// @param more maps to write too, as writeNpy() takes them
/// @throw FileError
void writeFullResult(const std::string& folder, const RowFields& fields, const HeightMap& prepared,
                     const Prediction& prediction, const std::vector<CurvePoint>& curve,
                     const NamedMaps& more = {});

}  // namespace mems_stiction
