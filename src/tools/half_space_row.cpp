#include "half_space_row.hpp"

#include <cstring>

#include "errors/one_line.hpp"
#include "half_space/half_space_fields.hpp"

namespace mems_stiction {
namespace {

const std::string kPrefix = "half_space_";
const char* const kWallTime = "processing_time";

template <typename Visitor>
void visitFigures(const SolvedHalfSpace& solution, Visitor&& visit) {
  const auto visitOne = [&](const Figure& figure, const auto& value) {
    if (std::strcmp(figure.name, kWallTime) != 0) visit(kPrefix + figure.name, value, figure.unit);
  };
  visitHalfSpaceFields(solution, visitOne);
  visitHalfSpaceStiffness(solution, visitOne);
}

}  // namespace

RowFields halfSpaceFields(const HalfSpaceAnswer& answer, const std::optional<Verdict>& verdict) {
  RowFields fields = {{kPrefix + "message", oneLine(answer.message)}};
  if (verdict) fields.emplace_back("verdict_by", judgeText(verdict->judge));
  if (answer.solution) {
    visitFigures(*answer.solution, [&](const std::string& name, const auto& value, const char*) {
      fields.emplace_back(name, shown(value));
    });
  }
  return fields;
}

RowFields halfSpaceSample(bool with_verdict) {
  std::optional<Verdict> verdict;
  if (with_verdict) verdict.emplace();
  return halfSpaceFields({true, SolvedHalfSpace(), ""}, verdict);
}

std::map<std::string, std::string> halfSpaceColumnUnits() {
  std::map<std::string, std::string> units;
  visitFigures({}, [&](const std::string& name, const auto&, const char* unit) {
    if (*unit != '\0') units[name] = unit;
  });
  return units;
}

RowFields halfSpaceExtras(const SolvedHalfSpace& solution) {
  return {{kPrefix + kWallTime, solution.processing_time},
          {kPrefix + "curve", curveColumns(curveOf(solution))}};
}

NamedMaps halfSpaceMaps(const SolvedHalfSpace& solution) {
  NamedMaps maps;
  for (const auto& [name, map] :
       NamedMaps{{"pressure", solution.pressure},
                 {"gap", solution.gap},
                 {"deformed", solution.deformed_lower.heights()},
                 {"counter_deformed", solution.deformed_upper.heights()}}) {
    if (!map.empty()) maps.emplace_back(kPrefix + name, map);
  }
  return maps;
}

}  // namespace mems_stiction
