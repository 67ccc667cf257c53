#include "mems_stiction/scan/scan_predictor.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/scan/resolution.hpp"

namespace mems_stiction {
namespace {

constexpr int kCoarsest = 4;
constexpr int kSmallestSide = 16;

const Configuration& checked(const Configuration& configuration) {
  configuration.check();
  return configuration;
}

/// All steps but refinement.
PipelineOptions cleaningOf(const Configuration& configuration) {
  PipelineOptions options = configuration.preprocessing;
  options.refine.factor = 1;
  return options;
}

/// Refinement alone.
PipelineOptions refinementOf(const Configuration& configuration) {
  PipelineOptions options;
  options.refine = configuration.preprocessing.refine;
  return options;
}

/// Means over blocks of factor x factor cells.
cv::Mat blockMeans(const cv::Mat& cells, int factor) {
  cv::Mat means;
  cv::resize(cells, means, cells.size() / factor, 0.0, 0.0, cv::INTER_AREA);
  return means;
}

/// Largest values in blocks of factor x factor cells.
cv::Mat blockMaxima(const cv::Mat& cells, int factor) {
  cv::Mat maxima(cells.size() / factor, CV_8UC1, cv::Scalar(0));
  for (int row = 0; row < cells.rows; ++row) {
    const std::uint8_t* source = cells.ptr<std::uint8_t>(row);
    std::uint8_t* target = maxima.ptr<std::uint8_t>(row / factor);
    for (int col = 0; col < cells.cols; ++col) target[col / factor] = std::max(target[col / factor], source[col]);
  }
  return maxima;
}

HeightMap cropped(const HeightMap& surface, int multiple) {
  if (surface.empty()) return surface;
  const cv::Rect frame(0, 0, surface.cols() / multiple * multiple, surface.rows() / multiple * multiple);
  return {surface.heights()(frame).clone(), surface.pitchX(), surface.pitchY()};
}

}  // namespace

ScanPredictor::ScanPredictor(const Configuration& configuration)
    : configuration_(checked(configuration)),
      model_(configuration_.model),
      counter_surface_(configuration_.counter_surface, configuration_.scan, configuration_.preprocessing) {
  try {
    counter_surface_.load();
  } catch (const OptionsError&) {
    throw;
  } catch (const Error& error) {
    throw OptionsError({"counter_surface/file: " + std::string(error.what())});
  }
}

void ScanPredictor::setLoad(double voltage, double mechanical_load) {
  Options options = configuration_.model;
  options.load.voltage = voltage;
  options.load.mechanical_load = mechanical_load;
  model_.setOptions(options);  // refuses before it changes anything
  configuration_.model = options;
}

void ScanPredictor::setOutput(const OutputOptions& output) {
  Options options = configuration_.model;
  options.output = output;
  model_.setOptions(options);
  configuration_.model = options;
}

void ScanPredictor::setCounterSurfacePose(const SurfacePose& pose) {
  counter_surface_.setPose(pose);  // refuses before it changes anything
  configuration_.counter_surface.pose = pose;
}

HeightMap ScanPredictor::prepared(const HeightMap& scan) const {
  return cleanScan(scan, cleaningOf(configuration_)).surface;
}

HeightMap ScanPredictor::prepare(const HeightMap& scan) {
  CleanedScan prepared = cleanScan(scan, cleaningOf(configuration_));
  record_ = std::move(prepared.record);
  return prepared.surface;
}

Prediction ScanPredictor::predict(const HeightMap& scan) {
  const HeightMap lower = prepare(scan);
  Prediction prediction = predictPair(lower, counter_surface_.over(lower));
  describeScan(lower, prediction);
  return prediction;
}

Prediction ScanPredictor::predict(const HeightMap& scan, const HeightMap& measured_counter_surface) {
  const HeightMap lower = prepare(scan);
  Prediction prediction = predictPair(lower, counter_surface_.over(lower, measured_counter_surface));
  describeScan(lower, prediction);
  return prediction;
}

Prediction ScanPredictor::predictPair(const HeightMap& lower, const HeightMap& upper) {
  if (configuration_.preprocessing.refine.factor > 1) return predictRefined(lower, upper);
  return model_.predict({lower, upper});
}

void ScanPredictor::describeScan(const HeightMap& lower, Prediction& prediction) const {
  const ResolutionOptions& resolution = configuration_.resolution;
  flagResolution(resolution.min_contact_pixels,
                 resolution.tip_radius > 0.0 ? resolution.tip_radius : configuration_.preprocessing.tip.radius,
                 prediction);
  if (configuration_.spatial_roughness.enabled) {
    prediction.spatial_roughness = spatialRoughness(lower, configuration_.spatial_roughness);
  }
}

Prediction ScanPredictor::predictRefined(const HeightMap& lower, const HeightMap& upper) {
  const int factor = configuration_.preprocessing.refine.factor;
  const CleanedScan fine_scan = cleanScan(lower, refinementOf(configuration_));
  record_.steps.insert(record_.steps.end(), fine_scan.record.steps.begin(), fine_scan.record.steps.end());
  const HeightMap& fine_lower = fine_scan.surface;
  HeightMap fine_upper;
  if (!upper.empty()) fine_upper = refined(upper, configuration_.preprocessing.refine);

  Prediction prediction = model_.predict({fine_lower, fine_upper});
  prediction.median_contact_pixels /= factor * factor;
  for (Asperity& asperity : prediction.asperities) {  // from the middle of the first fine pixel to that of the scan's
    asperity.x -= 0.5 * (factor - 1) * fine_lower.pitchX();
    asperity.y -= 0.5 * (factor - 1) * fine_lower.pitchY();
  }
  if (!prediction.contact_map.empty()) prediction.contact_map = blockMaxima(prediction.contact_map, factor);
  if (!prediction.deformed_lower.empty()) {
    const cv::Mat depth = fine_lower.asDouble().heights() - prediction.deformed_lower;
    prediction.deformed_lower = lower.asDouble().heights() - blockMeans(depth, factor);
    if (upper.empty()) {
      prediction.deformed_upper = blockMeans(prediction.deformed_upper, factor);
    } else {
      const cv::Mat lift = prediction.deformed_upper - fine_upper.asDouble().heights();
      prediction.deformed_upper = upper.asDouble().heights() + blockMeans(lift, factor);
    }
  }
  return prediction;
}

std::vector<ConvergenceRow> ScanPredictor::convergence(const HeightMap& scan) {
  const HeightMap whole = prepared(scan);
  if (std::min(whole.rows(), whole.cols()) < kSmallestSide) {
    throw SurfaceError("a scan of " + std::to_string(whole.cols()) + " x " + std::to_string(whole.rows()) +
                       " pixels has no quarter resolution to compare with; must have 16 x 16 or more");
  }
  const HeightMap lower = cropped(whole, kCoarsest);
  const HeightMap upper = cropped(counter_surface_.over(whole), kCoarsest);
  const PreprocessRecord record = record_;  // stays that of the latest predict()
  std::vector<ConvergenceRow> rows;
  for (int decimation = 1; decimation <= kCoarsest; decimation *= 2) {
    const HeightMap coarse = decimated(lower, decimation);
    const Prediction prediction = predictPair(coarse, upper.empty() ? upper : decimated(upper, decimation));
    ConvergenceRow row;
    row.decimation = decimation;
    row.rows = coarse.rows();
    row.cols = coarse.cols();
    row.pitch_x = coarse.pitchX();
    row.pitch_y = coarse.pitchY();
    row.status = prediction.status;
    row.pull_off_force = prediction.pull_off_force;
    row.contact_area = prediction.contact_area;
    row.contact_area_jkr = prediction.contact_area_jkr;
    row.asperity_count = prediction.asperity_count;
    row.median_contact_pixels = prediction.median_contact_pixels;
    if (!rows.empty()) {
      row.pull_off_force_ratio = row.pull_off_force / rows.front().pull_off_force;
      row.contact_area_ratio = row.contact_area / rows.front().contact_area;
    }
    rows.push_back(row);
  }
  record_ = record;
  return rows;
}

}  // namespace mems_stiction
