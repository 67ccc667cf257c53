#include "surface/counter_surface.hpp"

#include "mems_stiction/errors/errors.hpp"
#include "surface/correlated_surface.hpp"
#include "surface/self_affine_surface.hpp"
#include "surface/translated_gaussian_surface.hpp"

namespace mems_stiction {
namespace {

/// Only the settings that do not come from the scan.
void describeGaussian(OptionVisitor& visitor, TranslatedGaussianOptions& options) {
  const std::string prefix = "counter_surface/gaussian";
  visitor.number(prefix + "/rms_height", options.gaussian.rms_height, "m", Range::nonNegative(),
                 "root mean square height, exact");
  visitor.number(
      prefix + "/correlation_length_x", options.gaussian.correlation_length_x, "m",
      Range::positive(),
      "distance along x at which the autocorrelation has fallen to 1/e; at most half of the scan");
  visitor.number(prefix + "/correlation_length_y", options.gaussian.correlation_length_y, "m",
                 Range::positive(), "the same along y");
  visitor.number(prefix + "/skewness", options.skewness, "", Range::within(-4.0, 4.0),
                 "skewness of the heights, summits towards the scan counting as high; Gaussian: 0");
  visitor.number(prefix + "/kurtosis", options.kurtosis, "",
                 Range::within(options.skewness * options.skewness + 1.2, 100.0),
                 "kurtosis of the heights, at least skewness^2 + 1.2; Gaussian: 3");
}

void describeSelfAffine(OptionVisitor& visitor, SelfAffineSurfaceOptions& options) {
  const std::string prefix = "counter_surface/self_affine";
  visitor.number(prefix + "/hurst_exponent", options.hurst_exponent, "", Range::within(0.0, 1.0),
                 "the power spectrum falls as wave number to -2 - 2 H");
  visitor.number(
      prefix + "/rolloff_wavelength", options.rolloff_wavelength, "m",
      Range{options.cutoff_wavelength, std::numeric_limits<double>::infinity(), true, false},
      "longer wavelengths have the same spectral density as this one; at most the scan's longer "
      "side");
  visitor.number(prefix + "/cutoff_wavelength", options.cutoff_wavelength, "m", Range::positive(),
                 "shorter wavelengths are absent; at least two of the scan's larger pitch");
  visitor.enumeration(
      prefix + "/scale", options.scale,
      {{"rms_height", RoughnessScale::kRmsHeight}, {"rms_slope", RoughnessScale::kRmsSlope}},
      "which of the two figures is made exact; the other one is not used");
  visitor.number(prefix + "/rms_height", options.rms_height, "m", Range::nonNegative(),
                 "root mean square height");
  visitor.number(prefix + "/rms_slope", options.rms_slope, "", Range::nonNegative(),
                 "root mean square gradient");
}

template <typename Grid>
void takeGrid(const HeightMap& scan, int seed, Grid& grid) {
  grid.rows = scan.rows();
  grid.cols = scan.cols();
  grid.pitch_x = scan.pitchX();
  grid.pitch_y = scan.pitchY();
  grid.seed = seed;
}

/// @throw SurfaceError with the lines, if there are any
void refuse(const std::vector<std::string>& violations) {
  if (violations.empty()) return;
  std::string text = "the counter-surface cannot be drawn on this scan's grid: ";
  for (const std::string& line : violations)
    text += (&line == &violations.front() ? "" : "; ") + line;
  throw SurfaceError(text);
}

}  // namespace

void CounterSurfaceOptions::describe(OptionVisitor& visitor) {
  visitor.enumeration("counter_surface/type", type,
                      {{"flat", CounterSurfaceType::kFlat},
                       {"topic", CounterSurfaceType::kTopic},
                       {"file", CounterSurfaceType::kFile},
                       {"gaussian", CounterSurfaceType::kGaussian},
                       {"self_affine", CounterSurfaceType::kSelfAffine}},
                      "what the scan touches: a plane, the latest measured counter-surface, a scan "
                      "file, or a random "
                      "rough surface");
  visitor.enumeration("counter_surface/facing", facing,
                      {{"unstated", CounterSurfaceFacing::kUnstated},
                       {"down", CounterSurfaceFacing::kDown},
                       {"up", CounterSurfaceFacing::kUp}},
                      "which way the asperities of a measured counter-surface point, which must be "
                      "stated with one: up "
                      "as an instrument measures them, to be turned over about its y axis here; or "
                      "down as mounted");
  visitor.text("counter_surface/file", file, "scan file of the counter-surface, for type file");
  visitor.text("counter_surface/channel", channel,
               "title or number of the channel of that file; empty = the likeliest height channel");
  pose.describe(visitor);
  visitor.integer("counter_surface/seed", seed, Range::within(0, std::numeric_limits<int>::max()),
                  "of types gaussian and self_affine; the same seed gives the same surface");
  visitor.number(
      "counter_surface/correlation", correlation, "", Range::within(0.0, 1.0),
      "of types gaussian and self_affine: correlation of its heights with the scan's, as "
      "mounted; 1 fits into it");
  visitor.number("counter_surface/correlation_length", correlation_length, "m",
                 Range::nonNegative(),
                 "waves longer than this are correlated, shorter ones independent; 0 = all waves");
  describeGaussian(visitor, gaussian);
  describeSelfAffine(visitor, self_affine);
}

HeightMap turnedOver(const HeightMap& surface) {
  cv::Mat turned;
  cv::flip(surface.heights(), turned, 1);  // about the y axis: columns mirrored
  turned *= -1.0;
  return {turned, surface.pitchX(), surface.pitchY()};
}

std::string facingComplaint() {
  return "counter_surface/facing: must be stated for a measured counter-surface: up = its heights "
         "are as an instrument "
         "measures them, asperities up, and it is turned over here (a file of an AFM or "
         "interferometer); down = its "
         "heights are already those of the mounted surface in the scan's frame, asperities down";
}

HeightMap mountedCounterSurface(const HeightMap& measured, CounterSurfaceFacing facing) {
  if (facing == CounterSurfaceFacing::kUnstated) throw OptionsError({facingComplaint()});
  return facing == CounterSurfaceFacing::kDown ? measured : turnedOver(measured);
}

HeightMap drawnCounterSurface(const HeightMap& scan, const CounterSurfaceOptions& options) {
  if (options.type == CounterSurfaceType::kSelfAffine) {
    SelfAffineSurfaceOptions surface = options.self_affine;
    takeGrid(scan, options.seed, surface);
    refuse(surface.validate("counter_surface/self_affine"));
    return turnedOver(selfAffineSurface(surface));
  }
  TranslatedGaussianOptions surface = options.gaussian;
  takeGrid(scan, options.seed, surface.gaussian);
  refuse(surface.validate("counter_surface/gaussian"));
  return turnedOver(translatedGaussianSurface(surface));
}

HeightMap fittedCounterSurface(const HeightMap& scan, const HeightMap& drawn,
                               const CounterSurfaceOptions& options) {
  if (!options.fitsScan()) return drawn;
  return correlatedWith(scan, drawn, {options.correlation, options.correlation_length});
}

HeightMap generatedCounterSurface(const HeightMap& scan, const CounterSurfaceOptions& options) {
  return fittedCounterSurface(scan, drawnCounterSurface(scan, options), options);
}

bool isIdentity(const SurfacePose& pose) {
  return pose.offset_x == 0.0 && pose.offset_y == 0.0 && pose.rotation == 0.0 &&
         pose.tilt_x == 0.0 && pose.tilt_y == 0.0;
}

}  // namespace mems_stiction
