#include "scan_row.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <type_traits>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/one_line.hpp"
#include "mems_stiction/base/output_file.hpp"
#include "mems_stiction/prediction/prediction_fields.hpp"
#include "mems_stiction/verdict/regime_flags.hpp"
#include "mems_stiction/verdict/verdict_fields.hpp"
#include "npy_file.hpp"

namespace mems_stiction {
namespace {

template <typename Value>
nlohmann::json jsonOf(const Value& value) {
  if constexpr (std::is_same_v<Value, Sticks>) {
    return sticksText(value);
  } else if constexpr (std::is_enum_v<Value>) {
    return word(value);
  } else {
    return value;
  }
}

/// Visits every figure of a row with its value and unit.
template <typename Visitor>
void visitFigures(const HeightMap& scan, const std::vector<std::string>& warnings, const Prediction& prediction,
                  const std::optional<Verdict>& verdict, const std::string& formulation, const Provenance& provenance,
                  Visitor&& visit) {
  std::string said;
  for (const std::string& warning : warnings) said += (said.empty() ? "" : "; ") + oneLine(warning);
  visit("warnings", said, "");
  visit("rows", scan.rows(), "");
  visit("cols", scan.cols(), "");
  visit("pitch_x", scan.pitchX(), "m");
  visit("pitch_y", scan.pitchY(), "m");
  visit("formulation", formulation, "");
  visitPredictionFields(prediction, [&](const char* name, const auto& value, const char* unit) {
    const bool verdict_has_it = verdict && std::strcmp(name, "apparent_work_of_adhesion") == 0;
    if (std::strcmp(name, "processing_time") != 0 && !verdict_has_it) visit(name, value, unit);
  });
  visitRoughnessFields(prediction.roughness, visit);
  visitSpatialRoughnessFields(prediction.spatial_roughness, visit);
  const std::uint32_t flags = regimeFlags(prediction, scan.cellArea());
  if (verdict) {
    visitVerdictFields(*verdict, [&](const char* name, const auto& value, const char* unit) {
      // The reason of a row is that of its failure.
      visit(std::strcmp(name, "reason") == 0 ? "verdict_reason" : name, value, unit);
    });
    visit("place_deviation", verdict->place_deviation, "");
    visit("size_objection", oneLine(verdict->size_objection), "");
  } else {
    visit("regime_flags", flags, "");
  }
  visit("regime_flag_names", regimeFlagNames(flags), "");
  visitProvenanceFields(provenance, [&](const char* name, const std::string& value, const char* unit) {
    visit(name, oneLine(value), unit);
  });
}

nlohmann::json asperityColumns(const std::vector<Asperity>& asperities) {
  nlohmann::json columns = nlohmann::json::object();
  const auto column = [&](const char* name, const auto& value_of) {
    nlohmann::json values = nlohmann::json::array();
    for (const Asperity& asperity : asperities) values.push_back(value_of(asperity));
    columns[name] = values;
  };
  column("x", [](const Asperity& a) { return a.x; });
  column("y", [](const Asperity& a) { return a.y; });
  column("z", [](const Asperity& a) { return a.z; });
  column("cap_radius", [](const Asperity& a) { return a.cap_radius; });
  column("composite_radius", [](const Asperity& a) { return a.composite_radius; });
  column("load", [](const Asperity& a) { return a.load; });
  column("contact_radius", [](const Asperity& a) { return a.contact_radius; });
  column("tilt", [](const Asperity& a) { return a.tilt; });
  column("plasticity_index", [](const Asperity& a) { return a.plasticity_index; });
  column("tabor_parameter", [](const Asperity& a) { return a.tabor_parameter; });
  column("area", [](const Asperity& a) { return a.area; });
  column("regime", [](const Asperity& a) { return static_cast<int>(a.regime); });
  return columns;
}

nlohmann::json energyColumns(const std::vector<EnergyPoint>& curve) {
  nlohmann::json columns = nlohmann::json::object();
  for (const EnergyPoint& point : curve) {
    visitEnergyPointFields(point, [&](const char* name, double value, const char*) { columns[name].push_back(value); });
  }
  return columns;
}

}  // namespace

nlohmann::json curveColumns(const std::vector<CurvePoint>& curve) {
  nlohmann::json columns = nlohmann::json::object();
  for (const CurvePoint& point : curve) {
    visitCurvePointFields(
        point, [&](const char* name, const auto& value, const char*) { columns[name].push_back(jsonOf(value)); });
  }
  return columns;
}

RowFields originFields(const ScanOrigin& origin, const std::string& reason) {
  nlohmann::json scan;
  if (origin.scan > 0) scan = origin.scan;
  return {{"number", origin.number},      {"file", oneLine(origin.file)}, {"scan", scan},
          {"name", oneLine(origin.name)}, {"stamp", origin.stamp},        {"channel", oneLine(origin.channel)},
          {"reason", oneLine(reason)}};
}

RowFields figureFields(const HeightMap& scan, const std::vector<std::string>& warnings, const Prediction& prediction,
                       const std::optional<Verdict>& verdict, const std::string& formulation,
                       const Provenance& provenance) {
  RowFields fields;
  visitFigures(scan, warnings, prediction, verdict, formulation, provenance,
               [&](const char* name, const auto& value, const char*) { fields.emplace_back(name, jsonOf(value)); });
  return fields;
}

std::vector<std::string> columnNames(bool with_verdict) {
  std::vector<std::string> names;
  for (const auto& field : originFields({}, "")) names.push_back(field.first);
  std::optional<Verdict> verdict;
  if (with_verdict) verdict.emplace();
  for (const auto& field : figureFields({}, {}, {}, verdict, "", {})) names.push_back(field.first);
  return names;
}

std::map<std::string, std::string> columnUnits(bool with_verdict) {
  std::optional<Verdict> verdict;
  if (with_verdict) verdict.emplace();
  std::map<std::string, std::string> units;
  visitFigures({}, {}, {}, verdict, "", {}, [&](const char* name, const auto&, const char* unit) {
    if (*unit != '\0') units[name] = unit;
  });
  return units;
}

void writeFullResult(const std::string& folder, const RowFields& fields, const HeightMap& prepared,
                     const Prediction& prediction, const std::vector<CurvePoint>& curve, const NamedMaps& more) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileError(folder + ": cannot be made: " + error.message());
  writeNpy(folder + "/heights.npy", prepared.asDouble().heights());
  writeNpy(folder + "/deformed.npy", prediction.deformed_lower);
  writeNpy(folder + "/counter_deformed.npy", prediction.deformed_upper);
  writeNpy(folder + "/contact_map.npy", prediction.contact_map);
  for (const auto& [name, map] : more) writeNpy(folder + "/" + name + ".npy", map);
  nlohmann::json result;
  for (const auto& [name, value] : fields) result[name] = value;
  result["processing_time"] = prediction.processing_time;
  result["asperities"] = asperityColumns(prediction.asperities);
  result["energy_curve"] = energyColumns(prediction.energy_curve);
  result["force_curve"] = curveColumns(curve);
  writeFile(folder + "/result.json", result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
            OutputSafety::kWhole);
}

}  // namespace mems_stiction
