/// Cleaning and roughness figures on files as instruments wrote them. The folder is named by the
/// environment variable MEMS_STICTION_SCANS; rms heights and gradients are those that numpy gives
/// for the same files after plane levelling.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "height_map/validity.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"
#include "mems_stiction/roughness/areal_parameters.hpp"
#include "roughness/autocorrelation.hpp"
#include "roughness/power_spectrum.hpp"
#include "roughness/summits.hpp"

namespace mems_stiction {
namespace {

struct KnownScan {
  const char* file;
  double sq;   // [m]
  double sdq;  // by central differences [-]
};

const std::vector<KnownScan> kScans = {
    {"di-5.di", 1.535927e-9, 0.057388},   {"di-6.di", 1.431934e-8, 0.208644},
    {"di-3.di", 3.522292e-8, 0.166662},   {"example_ps.tiff", 3.933334e-9, 0.367455},
    {"top-1.top", 1.613985e-9, 0.146434}, {"opd-1.opd", 6.711198e-9, 0.014604},
    {"x3p-2.x3p", 7.719303e-8, 0.059571}, {"al3d-1.al3d", 2.898221e-7, 0.087390},
};

class VendorRoughness : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("MEMS_STICTION_SCANS");
    if (folder == nullptr || *folder == '\0') {
      GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
    }
    folder_ = folder;
  }

  HeightMap scan(const std::string& file) const { return readScanFile(folder_ + "/" + file); }
  HeightMap flat(const std::string& file) const {
    PipelineOptions options;
    options.level.shape = LevelShape::kPlane;
    return cleanScan(scan(file), options).surface;
  }

  std::string folder_;
};

TEST_F(VendorRoughness, spectrumCarriesTheKnownRmsHeight) {
  for (const KnownScan& known : kScans) {
    SCOPED_TRACE(known.file);
    const HeightMap surface = flat(known.file);
    const SpectralMoments moments = powerSpectrum(surface, SpectrumWindow::kNone).moments;
    // Parseval; seven digits are listed. Pixels that the interferometer lacks lie in a pit, and are
    // filled.
    EXPECT_NEAR(std::sqrt(moments.m0) / known.sq, 1.0,
                invalidFraction(surface) > 0.0 ? 5e-3 : 1e-6);
    // Central differences see less than the spectrum up to its end; how much less hangs on the
    // noise.
    EXPECT_GT(std::sqrt(2.0 * moments.m2), known.sdq);
    EXPECT_GE(moments.alpha, 1.5);
  }
}

TEST_F(VendorRoughness, textureIsThatOfTheSurfacesThatWereMeasured) {
  // Machined, with ridges along y, on pixels of 128 nm x 314 nm.
  const SpatialParameters lay = spatialParameters(flat("x3p-2.x3p"));
  EXPECT_LT(lay.str, 0.3);
  // Isotropic, stationary random roughness.
  const SpatialParameters random = spatialParameters(flat("di-6.di"));
  EXPECT_GT(random.str, 0.6);
  EXPECT_TRUE(random.decayed);
  // Grains of tens of nanometres.
  const SpatialParameters grains = spatialParameters(flat("example_ps.tiff"));
  EXPECT_GT(grains.sal, 3e-9);
  EXPECT_LT(grains.sal, 50e-9);
  EXPECT_GT(summitParameters(flat("example_ps.tiff")).count, 100);
}

TEST_F(VendorRoughness, theWholePipelineRunsOnEveryScan) {
  for (const KnownScan& known : kScans) {
    SCOPED_TRACE(known.file);
    const HeightMap surface = scan(known.file);
    PipelineOptions options;
    options.offset.enabled = true;
    options.lines.method = LineAlignment::kMedianDifference;
    options.spikes.enabled = true;
    options.spikes.threshold = 8.0;
    options.fill.enabled = true;
    options.tip.radius = 3.0 * surface.pitchX();
    options.tip.half_angle = 0.3;
    options.level.shape = LevelShape::kPolynomial;
    options.level.robust = true;
    options.low_pass.cutoff_wavelength = 4.0 * surface.pitchX();
    options.refine.factor = 2;
    const CleanedScan prepared = cleanScan(surface, options);
    EXPECT_EQ(prepared.record.steps.size(), 8u);
    EXPECT_EQ(prepared.surface.cols(), 2 * surface.cols());
    EXPECT_LT(invalidFraction(prepared.surface), 0.001);
    const double sq = arealParameters(prepared.surface).sq;
    EXPECT_GT(sq, 0.1 * known.sq);
    EXPECT_LT(sq, 1.2 * known.sq);
    for (const std::string& line : recordLines(prepared.record)) RecordProperty(known.file, line);
  }
}

TEST_F(VendorRoughness, missingPixelsOfTheInterferometerAreFilled) {
  PipelineOptions options;
  options.level.shape = LevelShape::kPlane;
  options.fill.enabled = true;
  const CleanedScan prepared = cleanScan(scan("opd-1.opd"), options);
  EXPECT_EQ(prepared.record.steps[0].changed_pixels, 116);
  EXPECT_EQ(invalidFraction(prepared.surface), 0.0);
  // The largest hole is the bottom of a pit whose rim lies 70 nm deep: the rms height grows a
  // little.
  EXPECT_NEAR(arealParameters(prepared.surface).sq / 6.711198e-9, 1.0, 0.01);
}

}  // namespace
}  // namespace mems_stiction
