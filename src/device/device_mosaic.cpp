#include "device/device_mosaic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "device/device_area.hpp"
#include "device/device_surface.hpp"
#include "device/scan_list.hpp"
#include "errors/short_number.hpp"
#include "mechanics/wave_stiffness.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// Pixels along the side of the smallest place, and of all that is made to find the length.
constexpr double kLeastPixels = 32.0;
constexpr double kMostCells = 2e6;
/// From one length to the next, and surfaces that tell the stiffness at each.
constexpr double kNextLength = 1.414;
constexpr int kSurfaces = 3;

/// 1/K of a wave [m/Pa]; 0 where bodies are as good as thick, or stiffer.
double bendingCompliance(const Options& model, double length) {
  const WaveStiffness bodies(model.lower, model.upper);
  const double thick = bodies.lower().planeCompliance() + bodies.upper().planeCompliance();
  return std::max(0.0, length / kPi * (1.0 / bodies.modulus(2.0 * kPi / length) - thick));
}

}  // namespace

Options stiffModel(const Options& model) {
  Options stiff = model;
  for (Material* body : {&stiff.lower, &stiff.upper}) {
    body->thickness = 0.0;
    body->backing = Backing::kFree;
    body->substrate = {};
  }
  stiff.guidance = Guidance::kGuided;
  return stiff;
}

double mosaicLength(const DeviceSurfaces& surfaces, const DeviceArea& area, const Options& model,
                    const DeviceForceOptions& options) {
  checkDevice(surfaces, area, options);
  const Options stiff = stiffModel(model);
  const DeviceLaws laws = lawsOf(surfaces, options, TailForm::kExponential);
  const double pitch = madePitch(surfaces, options);
  const HeightMap& scan = surfaces.scans.front().surface;
  const double scanned_area = areaOf(scan);
  // how much softer the wave of this length is than the contact, as a logarithm: from the mean of
  // some surfaces.
  const auto softness = [&](double length) {
    const double compliance = bendingCompliance(model, length);
    if (compliance == 0.0) return -std::numeric_limits<double>::infinity();
    const DevicePieces pieces =
        piecesOf({length * length, 1}, pitch, std::min(options.max_cells, kMostCells));
    DeviceAreaSolver solver(stiff, scanned_area, pieces);
    DeviceSurface surface(laws, pieces, realisationSeed(options, 0));
    double sum = 0.0;
    for (int i = 0; i < kSurfaces; ++i) {
      if (i > 0) surface.reseed(realisationSeed(options, i));
      solver.realise(surface);
      sum += std::log(compliance * solver.lastStiffness());
    }
    return sum / kSurfaces;
  };
  // the same lengths for every device, so that the mosaic does not hang on how large it is
  const double side = std::sqrt(area.area / area.contacts);
  double before = 0.0;
  for (double length = kLeastPixels * pitch; length < kNextLength * side; length *= kNextLength) {
    const double here = softness(length);
    if (here > 0.0) {
      const double share = before < 0.0 && std::isfinite(before) ? before / (before - here) : 1.0;
      const double found = length * std::pow(kNextLength, share - 1.0);
      return found < side ? found : std::numeric_limits<double>::infinity();
    }
    before = here;
  }
  return std::numeric_limits<double>::infinity();
}

void takePlaces(const DeviceArea& area, double length, DeviceForce& force) {
  const double places = area.area / force.area;
  for (double* figure :
       {&force.pull_off_force, &force.pull_off_force_lower, &force.pull_off_force_upper,
        &force.linear_pull_off_force, &force.contacts}) {
    *figure *= places;
  }
  for (Realisation& realisation : force.realisations) {
    realisation.pull_off_force *= places;
    realisation.contacts = static_cast<int>(std::min(realisation.contacts * places, 2e9));
  }
  force.area = area.area;
  force.warnings.push_back(
      "bodies so thin give way to waves longer than " + shortNumber(length * 1e6, 2) +
      " um: the device is a mosaic of " + shortNumber(places, 2) +
      " places that rest each on their own summits, and its force goes with area from there");
}

}  // namespace mems_stiction
