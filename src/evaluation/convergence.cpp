#include "mems_stiction/evaluation/convergence.hpp"

#include <cmath>
#include <limits>

#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "prediction/prediction_fields.hpp"

namespace mems_stiction {
namespace {

const char* resolutionName(int decimation) {
  if (decimation == 1) return "full";
  return decimation == 2 ? "half" : "quarter";
}

std::string percent(double ratio) {
  if (std::isnan(ratio)) return "not known";
  return plainFormat("%+.1f %%", 100.0 * (ratio - 1.0));
}

}  // namespace

HeightMap decimated(const HeightMap& surface, int factor) {
  const int rows = surface.rows() / factor;
  const int cols = surface.cols() / factor;
  if (rows < 1 || cols < 1) {
    throw SurfaceError(std::to_string(surface.cols()) + " x " + std::to_string(surface.rows()) +
                       " pixels cannot be made coarser by " + std::to_string(factor));
  }
  const HeightMap wide = surface.asDouble();
  cv::Mat heights(rows, cols, CV_64FC1);
  for (int row = 0; row < rows; ++row) {
    double* line = heights.ptr<double>(row);
    for (int col = 0; col < cols; ++col) {
      double sum = 0.0;
      int valid = 0;
      for (int down = 0; down < factor; ++down) {
        const double* source = wide.heights().ptr<double>(row * factor + down) + col * factor;
        for (int right = 0; right < factor; ++right) {
          if (!std::isfinite(source[right])) continue;
          sum += source[right];
          ++valid;
        }
      }
      line[col] =
          2 * valid >= factor * factor ? sum / valid : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return {heights, factor * surface.pitchX(), factor * surface.pitchY()};
}

std::string convergenceTable(const std::vector<ConvergenceRow>& rows, const std::string& indent) {
  std::string text = indent +
                     "resolution     pixels        pull-off [N]           contact area [m^2]     "
                     "contacts  pixels/contact\n";
  for (const ConvergenceRow& row : rows) {
    const std::string size = std::to_string(row.cols) + " x " + std::to_string(row.rows);
    text += indent;
    text += plainFormat(
        "%-10s %13s  %10.3g %10s  %11.3g %10s  %8d  %14.3g%s\n", resolutionName(row.decimation),
        size.c_str(), row.pull_off_force,
        row.decimation == 1 ? "" : percent(row.pull_off_force_ratio).c_str(), row.contact_area,
        row.decimation == 1 ? "" : percent(row.contact_area_ratio).c_str(), row.asperity_count,
        row.median_contact_pixels,
        row.status == Status::kEquilibrium ? "" : (std::string("  ") + word(row.status)).c_str());
  }
  if (rows.size() < 2) return text;
  const ConvergenceRow& half = rows[1];
  text += indent + "From half to full resolution the pull-off force moves by " +
          percent(1.0 / half.pull_off_force_ratio) + ", the contact area by " +
          percent(1.0 / half.contact_area_ratio) + ".\n";
  return text;
}

}  // namespace mems_stiction
