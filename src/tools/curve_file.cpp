#include "curve_file.hpp"

#include <fstream>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_visitor.hpp"

namespace mems_stiction {

void writeCurve(const std::string& path, const std::vector<CurvePoint>& curve) {
  std::ofstream file(path);
  file << "height,force,direction\n";
  for (const CurvePoint& point : curve) {
    file << numberText(point.height) << ',' << numberText(point.force) << ',' << word(point.direction) << '\n';
  }
  file.close();
  if (!file) throw FileError(path + ": cannot be written");
}

}  // namespace mems_stiction
