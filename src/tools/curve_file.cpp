#include "curve_file.hpp"

#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/base/output_file.hpp"

namespace mems_stiction {

void writeCurve(const std::string& path, const std::vector<CurvePoint>& curve) {
  std::string text = "height,force,direction\n";
  for (const CurvePoint& point : curve) {
    text += numberText(point.height) + "," + numberText(point.force) + "," + word(point.direction) + "\n";
  }
  writeFile(path, text);
}

}  // namespace mems_stiction
