#include "curve_file.hpp"

#include <type_traits>

#include "csv_text.hpp"
#include "errors/one_line.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {

void writeCurve(const std::string& path, const std::vector<CurvePoint>& curve,
                const Provenance& provenance) {
  std::string text = "height,force,direction";
  std::string origin;
  visitProvenanceFields(provenance, [&](const Figure& figure, const auto& value) {
    text += std::string(",") + figure.name;
    if constexpr (std::is_same_v<decltype(value), const std::string&>) {
      origin += "," + csvText(oneLine(value));
    } else {
      origin += "," + (isStated(value) ? numberText(value) : "");
    }
  });
  text += "\n";
  for (const CurvePoint& point : curve) {
    text += numberText(point.height) + "," + numberText(point.force) + "," + word(point.direction) +
            origin + "\n";
  }
  writeFile(path, text);
}

}  // namespace mems_stiction
