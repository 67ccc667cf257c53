#include "study_surfaces.hpp"

#include <cstdio>
#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/scan/prepared_scan.hpp"
#include "mems_stiction/surface/gaussian_surface.hpp"
#include "mems_stiction/surface/self_affine_surface.hpp"

namespace mems_stiction {
namespace study {
namespace {

constexpr double kScanPitch = 10e-9;  // [m], a usual one of an AFM on a frame of 10 um
constexpr int kScanFactor = 2;
constexpr int kSmallestSide = 64;

std::string nanometers(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%g nm", 1e9 * length);
  return text;
}

Surface gaussian(const std::string& name, double rms_height, double correlation_length, int scans, int pixels) {
  GaussianSurfaceOptions options;
  options.rows = options.cols = kScanFactor * pixels;
  options.pitch_x = options.pitch_y = kScanPitch / kScanFactor;
  options.rms_height = rms_height;
  options.correlation_length_x = options.correlation_length_y = correlation_length;
  const std::string description =
      "Gaussian, rms height " + nanometers(rms_height) + ", correlation length " + nanometers(correlation_length);
  return {name, description, scans, [options](int index) {
            GaussianSurfaceOptions seeded = options;
            seeded.seed = index + 1;
            return Place{gaussianSurface(seeded), kScanFactor};
          }};
}

Surface selfAffine(double rms_height, int scans, int pixels) {
  SelfAffineSurfaceOptions options;
  options.rows = options.cols = kScanFactor * pixels;
  options.pitch_x = options.pitch_y = kScanPitch / kScanFactor;
  options.rms_height = rms_height;
  const std::string description = "Hurst exponent " + numberText(options.hurst_exponent) + " between " +
                                  nanometers(options.cutoff_wavelength) + " and " +
                                  nanometers(options.rolloff_wavelength) + ", rms height " + nanometers(rms_height);
  return {"self-affine", description, scans, [options](int index) {
            SelfAffineSurfaceOptions seeded = options;
            seeded.seed = index + 1;
            return Place{selfAffineSurface(seeded), kScanFactor};
          }};
}

}  // namespace

std::vector<Surface> generatedSurfaces(int scans, int pixels) {
  return {gaussian("smooth", 1.5e-9, 80e-9, scans, pixels), gaussian("rough", 12e-9, 100e-9, scans, pixels),
          selfAffine(6e-9, scans, pixels)};
}

Surface surfaceOfFile(const std::string& path, const Configuration& configuration) {
  const HeightMap cleaned =
      ScanPreparer(configuration).prepare(openScanFile(path, configuration.scan, {}).surface).surfaces.lower.asDouble();
  if (cleaned.rows() < kSmallestSide || cleaned.cols() < kSmallestSide) {
    throw SurfaceError(path + ": " + std::to_string(cleaned.cols()) + " x " + std::to_string(cleaned.rows()) +
                       " pixels are too few to be cut into quarters; must have " + std::to_string(kSmallestSide) +
                       " x " + std::to_string(kSmallestSide) + " or more");
  }
  const int rows = cleaned.rows() / 2;
  const int cols = cleaned.cols() / 2;
  return {path.substr(path.find_last_of('/') + 1), "quarters of the scan", 4, [cleaned, rows, cols](int index) {
            const cv::Rect frame((index % 2) * cols, (index / 2) * rows, cols, rows);
            return Place{HeightMap(cleaned.heights()(frame).clone(), cleaned.pitchX(), cleaned.pitchY()), 1};
          }};
}

std::vector<Surface> surfacesNearBonding(int scans, int pixels) {
  std::vector<Surface> surfaces;
  for (const double rms_height : {0.3e-9, 0.6e-9, 0.9e-9, 1.2e-9, 1.5e-9, 2e-9}) {
    surfaces.push_back(gaussian(nanometers(rms_height), rms_height, 80e-9, scans, pixels));
  }
  return surfaces;
}

}  // namespace study
}  // namespace mems_stiction
