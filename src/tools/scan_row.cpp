#include "scan_row.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <type_traits>

#include "errors/one_line.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "npy_file.hpp"
#include "prediction/contact_solvers.hpp"
#include "prediction/prediction_fields.hpp"
#include "verdict/regime_flags.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace {

/// Visits every figure of a row with its value and unit.
template <typename Visitor>
void visitFigures(const HeightMap& scan, const std::vector<std::string>& warnings,
                  const Prediction& prediction, const std::optional<Verdict>& verdict,
                  const std::string& formulation, const Provenance& provenance, Visitor&& visit) {
  std::string said;
  for (const std::string& warning : warnings) said += (said.empty() ? "" : "; ") + oneLine(warning);
  visit({"warnings"}, said);
  visit({"rows"}, scan.rows());
  visit({"cols"}, scan.cols());
  visit({"pitch_x", "m"}, scan.pitchX());
  visit({"pitch_y", "m"}, scan.pitchY());
  visit({"formulation"}, formulation);
  visitPredictionFields(prediction, [&](const Figure& figure, const auto& value) {
    if (std::strcmp(figure.name, "processing_time") == 0) return;
    if (hasFigure(formulation, figure.name)) visit(figure, value);
  });
  visitRoughnessFields(prediction.roughness, visit);
  visitSpatialRoughnessFields(prediction.spatial_roughness, visit);
  const std::uint32_t flags = regimeFlags(prediction, scan.cellArea());
  if (verdict) {
    visitVerdictFields(*verdict, visit);
    visit({"place_deviation"}, verdict->place_deviation);
  } else {
    visit({"regime_flags"}, flags);
  }
  visit({"regime_flag_names"}, regimeFlagNames(flags));
  visit({"model_doubt"}, modelDoubt(prediction));
  visitProvenanceFields(provenance, [&](const Figure& figure, const auto& value) {
    if constexpr (std::is_same_v<decltype(value), const std::string&>) {
      visit(figure, oneLine(value));
    } else {
      visit(figure, value);
    }
  });
}

/// By columns, which are there without a contact too; regimes by their numbers, as in contact_map.
nlohmann::json asperityColumns(const std::vector<Asperity>& asperities) {
  nlohmann::json columns = nlohmann::json::object();
  const Asperity none;
  visitAsperityFields(none, [&](const Figure& figure, const auto&) {
    columns[figure.name] = nlohmann::json::array();
  });
  for (const Asperity& asperity : asperities) {
    visitAsperityFields(asperity, [&](const Figure& figure, const auto& value) {
      columns[figure.name].push_back(value);
    });
  }
  columns.erase("is_at_border");
  return columns;
}

nlohmann::json energyColumns(const std::vector<EnergyPoint>& curve) {
  nlohmann::json columns = nlohmann::json::object();
  for (const EnergyPoint& point : curve) {
    visitEnergyPointFields(
        point, [&](const Figure& figure, double value) { columns[figure.name].push_back(value); });
  }
  return columns;
}

}  // namespace

nlohmann::json curveColumns(const std::vector<CurvePoint>& curve) {
  nlohmann::json columns = nlohmann::json::object();
  for (const CurvePoint& point : curve) {
    visitCurvePointFields(point, [&](const Figure& figure, const auto& value) {
      columns[figure.name].push_back(shown(value));
    });
  }
  return columns;
}

RowFields originFields(const ScanOrigin& origin, const std::string& message) {
  nlohmann::json scan;
  if (origin.scan > 0) scan = origin.scan;
  return {{"number", origin.number},
          {"file", oneLine(origin.file)},
          {"scan", scan},
          {"name", oneLine(origin.name)},
          {"stamp", origin.stamp},
          {"channel", oneLine(origin.channel)},
          {"message", oneLine(message)}};
}

RowFields figureFields(const HeightMap& scan, const std::vector<std::string>& warnings,
                       const Prediction& prediction, const std::optional<Verdict>& verdict,
                       const std::string& formulation, const Provenance& provenance) {
  RowFields fields;
  visitFigures(scan, warnings, prediction, verdict, formulation, provenance,
               [&](const Figure& figure, const auto& value) {
                 fields.emplace_back(figure.name, shown(value));
               });
  return fields;
}

RowFields sampleFields(const std::string& formulation, bool with_verdict) {
  RowFields fields = originFields({}, "");
  std::optional<Verdict> verdict;
  if (with_verdict) verdict.emplace();
  for (auto& field : figureFields({}, {}, {}, verdict, formulation, {}))
    fields.push_back(std::move(field));
  return fields;
}

std::map<std::string, std::string> columnUnits(const std::string& formulation, bool with_verdict) {
  std::optional<Verdict> verdict;
  if (with_verdict) verdict.emplace();
  std::map<std::string, std::string> units;
  visitFigures({}, {}, {}, verdict, formulation, {}, [&](const Figure& figure, const auto&) {
    if (*figure.unit != '\0') units[figure.name] = figure.unit;
  });
  return units;
}

void writeFullResult(const std::string& folder, const RowFields& fields, const HeightMap& prepared,
                     const Prediction& prediction, const std::vector<CurvePoint>& curve,
                     const NamedMaps& more) {
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
  writeFile(folder + "/result.json",
            result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
            OutputSafety::kWhole);
}

}  // namespace mems_stiction
