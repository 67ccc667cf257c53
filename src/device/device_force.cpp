#include "mems_stiction/device/device_force.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <tuple>
#include <utility>

#include "device/area_load.hpp"
#include "device/device_area.hpp"
#include "device/device_evidence.hpp"
#include "device/device_mosaic.hpp"
#include "device/law_check.hpp"
#include "device/made_surface.hpp"
#include "device/place_check.hpp"
#include "device/scan_list.hpp"
#include "device/scan_shortcomings.hpp"
#include "device/surface_law.hpp"
#include "device/usable_scans.hpp"
#include "errors/short_number.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "numeric/constants.hpp"
#include "numeric/mean.hpp"
#include "numeric/median.hpp"
#include "prediction/asked_output.hpp"
#include "verdict/margin_uncertainty.hpp"
#include "verdict/part_verdict.hpp"

namespace mems_stiction {
namespace {

/// Standard deviation of ln force that the law's form leaves where nothing else scatters [-].
constexpr double kOwnError = 0.12;
/// A misfit of the law that moves the force by less is not worth a sentence.
constexpr double kToldMisfit = 1.1;

/// As many of them, by lot.
std::vector<HeightMap> drawnAgain(const std::vector<HeightMap>& scans, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::vector<HeightMap> drawn;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    drawn.push_back(scans[std::uniform_int_distribution<std::size_t>(0, scans.size() - 1)(engine)]);
  }
  return drawn;
}

/// What the scans say, and what they would say if they had been other ones of the same surface.
class Surfaces {
 public:
  /// - @p size of a surface that is made
  Surfaces(const DeviceSurfaces& scanned, const MadeSize& size, const DeviceForceOptions& options)
      : lower_(mapsOf(scanned.scans)),
        upper_(mapsOf(scanned.counter_surface)),
        size_(size),
        options_(options),
        of_lower_(lower_) {
    if (!upper_.empty()) of_upper_.emplace(upper_);
    const bool has_tails = !of_lower_.isGaussian() || (of_upper_ && !of_upper_->isGaussian());
    for (const TailForm form : {TailForm::kExponential, TailForm::kPower}) {
      if (form == TailForm::kPower && !has_tails) break;
      laws_.push_back({lawOf(of_lower_, options, form), std::nullopt});
      if (of_upper_) laws_.back().upper = lawOf(*of_upper_, options, form);
    }
  }

  /// Realisations take one form of the tail after the other.
  const DeviceLaws& laws(int realisation) const {
    return laws_[static_cast<std::size_t>(realisation) % laws_.size()];
  }

  /// Scans like those that there are, made by the laws of a realisation.
  struct MadeScans {
    std::vector<HeightMap> lower;
    std::vector<HeightMap> upper;
  };
  MadeScans scansAgain(int realisation, std::uint64_t seed) {
    return scansAgain(realisation, seed, OwnWavesOf::kWidest);
  }
  /// Whether surfaces of the device have the long waves of a wide scan.
  bool haveOwnWaves() const {
    const DeviceLaws& stated = laws(0);
    return takesOwnWaves(stated.lower, size_) ||
           (stated.upper && takesOwnWaves(*stated.upper, size_));
  }
  /// The same as scansAgain() of surfaces as those of the device: with these long waves, too.
  MadeScans scansOfDevice(int realisation, std::uint64_t seed) {
    return scansAgain(realisation, seed, OwnWavesOf::kAll);
  }
  /// What they say.
  DeviceLaws lawsAgain(int realisation, const MadeScans& made) const {
    const TailForm form = realisation / 2 % 2 == 0 ? TailForm::kExponential : TailForm::kPower;
    DeviceLaws laws;
    laws.lower = lawOf(SurfaceStudy(made.lower, &of_lower_), options_, form);
    if (!made.upper.empty())
      laws.upper = lawOf(SurfaceStudy(made.upper, &*of_upper_), options_, form);
    return laws;
  }

  const std::vector<HeightMap>& lower() const { return lower_; }
  const std::vector<HeightMap>& upper() const { return upper_; }

 private:
  MadeScans scansAgain(int realisation, std::uint64_t seed, OwnWavesOf own_waves) {
    const DeviceLaws& stated = laws(realisation);
    MadeScans made;
    made.lower = again(stated.lower, lower_, seed, own_waves);
    if (stated.upper) made.upper = again(*stated.upper, upper_, seed + 500, own_waves);
    return made;
  }
  std::vector<HeightMap> again(const SurfaceLaw& law, const std::vector<HeightMap>& scans,
                               std::uint64_t seed, OwnWavesOf own_waves) {
    std::mt19937_64 engine(seed);
    const SpectrumContinuation continuation = drawnContinuation(law, size_.sideX(), engine);
    return makers_.try_emplace({&law, own_waves}, law, scans, size_.sideX(), own_waves)
        .first->second.make(continuation, engine);
  }

  std::vector<HeightMap> lower_;
  std::vector<HeightMap> upper_;
  MadeSize size_;
  DeviceForceOptions options_;
  SurfaceStudy of_lower_;
  std::optional<SurfaceStudy> of_upper_;
  std::vector<DeviceLaws> laws_;
  std::map<std::pair<const SurfaceLaw*, OwnWavesOf>, ScanMaker> makers_;
};

/// Surfaces of the device's size by what the scans say; one for each law, which goes on from seed
/// to seed.
class StatedSurfaces {
 public:
  /// - @p known outlives the object
  StatedSurfaces(const Surfaces& known, const DevicePieces& pieces)
      : known_(known), pieces_(pieces) {}

  DeviceSurface& surface(int realisation, std::uint64_t seed) {
    std::optional<DeviceSurface>& surface = surfaces_[&known_.laws(realisation)];
    if (surface) {
      surface->reseed(seed);
    } else {
      surface.emplace(known_.laws(realisation), pieces_, seed);
    }
    return *surface;
  }

 private:
  const Surfaces& known_;
  DevicePieces pieces_;
  std::map<const DeviceLaws*, std::optional<DeviceSurface>> surfaces_;
};

/// The median of figures, by their logarithms.
double medianFigure(std::vector<double>& logs) {
  const double median = medianOf(logs);
  return median > logOf(0.0) ? std::exp(median) : 0.0;
}

/// Logarithms of figures, by realisation.
struct Logs {
  std::vector<double> force;
  std::vector<double> work;

  void add(const Realisation& realisation) {
    force.push_back(logOf(realisation.pull_off_force));
    work.push_back(logOf(realisation.apparent_work_of_adhesion));
  }
};

/// Samples of a figure over its median: constants and model as they are, surfaces by Student's
/// distribution.
std::vector<double> factorsOf(std::vector<double> of_constants, int samples,
                              const FactorRange& of_surfaces) {
  if (of_constants.empty())
    of_constants.assign(static_cast<std::size_t>(samples), 1.0);  // none is uncertain
  const double median = quantile(of_constants, 0.5);
  for (double& factor : of_constants) factor /= median;
  widen(of_constants, of_surfaces);
  return of_constants;
}

/// By how much more a place may hold than the surfaces that are alike everywhere, of ln F and ln w;
/// >= 0 [-].
struct PlaceExcess {
  double force = 0.0;
  double work = 0.0;
};

/// What raises the upper end beyond surfaces that are alike everywhere.
struct UpperEnd {
  PlaceExcess places;  ///< one of which may hold more
  PlaceExcess scans;   ///< that contradict each other: the device may be as the one that holds most
};

/// What 95 % of the surfaces are within.
/// - @p reach of ln figure to either side
FactorRange surfaceRange(double reach, double of_places, double of_scans) {
  FactorRange range = factorsWithin(reach);
  range.highest =
      std::max({range.highest, std::exp(std::hypot(reach, of_places)), std::exp(reach + of_scans)});
  return range;
}

/// - @p like a prediction whose figures move with the constants as the device's do
/// - @p student standard deviations of the surfaces to either side
void takeIntervals(const Prediction& like, const Options& model,
                   const UncertaintyOptions& constants, double student, const UpperEnd& upper,
                   DeviceForce& force) {
  const auto factors = [&](const Prediction& prediction) {
    AdhesionSpread spread = adhesionSpread(prediction, model, constants);
    return std::pair(factorsOf(std::move(spread.pull_off), constants.samples,
                               surfaceRange(student * force.force_deviation, upper.places.force,
                                            upper.scans.force)),
                     factorsOf(std::move(spread.apparent_work), constants.samples,
                               surfaceRange(student * force.work_deviation, upper.places.work,
                                            upper.scans.work)));
  };
  auto [of_force, of_work] = factors(like);
  takeFactors(std::move(of_force), std::move(of_work), force);
  if (like.model.doubt == nullptr) return;
  Prediction sure = like;
  sure.model.error = like.model.error_without_doubt;
  std::tie(force.force_factors_without_doubt, force.work_factors_without_doubt) = factors(sure);
}

/// What chi^2/freedom is not below, or above, in 2.5 % of cases (Wilson and Hilferty).
double chiSquareFactor(double freedom, double normal) {
  const double term = 2.0 / (9.0 * freedom);
  return std::pow(std::max(1.0 - term + normal * std::sqrt(term), 0.0), 3);
}

/// Waves between the longest that the scans show and those as long as the device, by what is drawn
/// of them: the slope goes on up to a roll-off anywhere.
std::vector<BandOfWaves> continuedBands(const SurfaceLaw& law, double side) {
  if (!lacksLongWaves(law, side)) return {};
  constexpr double kBandsPerOctave = 2.0;
  const SpectrumBand& first = law.heights.bands.front();
  const double last = 2.0 * kPi / side;
  const int count =
      static_cast<int>(std::ceil(kBandsPerOctave * std::log2(first.wave_number / last)));
  const auto slopeAt = [&](double normal) {
    return std::clamp(law.slope + normal * law.slope_deviation, 0.0, 4.0);
  };
  std::vector<BandOfWaves> bands;
  for (int i = count; i >= 1; --i) {
    const double distance = std::log(first.wave_number / last) * i / count;
    BandOfWaves band;
    band.wavelength = law.longestWave() * std::exp(distance);
    band.density =
        first.density *
        std::exp(slopeAt(0.0) * std::min(distance, 0.5 * std::log(first.wave_number / last)));
    band.density_lower = first.density;
    band.density_upper = first.density * std::exp(slopeAt(kNormal95) * distance);
    band.is_measured = false;
    bands.push_back(band);
  }
  return bands;
}

void showSpectrum(const SurfaceLaw& law, double side, DeviceForce& force) {
  force.spectrum = continuedBands(law, side);
  for (const SpectrumBand& band : law.heights.bands) {
    BandOfWaves shown;
    shown.wavelength = 2.0 * kPi / band.wave_number;
    shown.density = band.density;
    shown.density_lower = band.density * chiSquareFactor(band.freedom, -kNormal95);
    shown.density_upper = band.density * chiSquareFactor(band.freedom, kNormal95);
    force.spectrum.push_back(shown);
  }
  std::stable_sort(force.spectrum.begin(), force.spectrum.end(),
                   [](const BandOfWaves& one, const BandOfWaves& other) {
                     return one.wavelength > other.wavelength;
                   });
  MergedSpectrum spectrum = law.heights;  // with the continued bands
  spectrum.bands.clear();
  for (const BandOfWaves& shown : force.spectrum) {
    spectrum.bands.push_back({2.0 * kPi / shown.wavelength, shown.density, 0.0});
  }
  const double from = std::min(2.0 * kPi / side, spectrum.bands.front().wave_number);
  for (BandOfWaves& shown : force.spectrum) {
    const double wave_number = 2.0 * kPi / shown.wavelength;
    shown.rms_height = spectrum.rootMean(0, wave_number, spectrum.largest_wave_number);
    shown.rms_slope = spectrum.rootMean(1, from, wave_number);
    shown.rms_curvature = spectrum.rootMean(2, from, wave_number);
  }
}

/// The misfit of the law, where there is one.
void takeMisfit(const LawCheck& check, DeviceForce& force) {
  const LawMisfit of_force = check.force();
  const LawMisfit of_work = check.work();
  force.pull_off_force *= std::exp(of_force.shift());
  force.apparent_work_of_adhesion *= std::exp(of_work.shift());
  force.force_deviation = std::hypot(force.force_deviation, of_force.shiftDeviation());
  force.work_deviation = std::hypot(force.work_deviation, of_work.shiftDeviation());
  if (std::abs(of_force.shift()) < std::log(kToldMisfit)) return;
  force.warnings.push_back(
      "the scans hold " + shortNumber(std::exp(of_force.difference), 2) +
      " times as strongly as scans of the surfaces that were made by their spectrum and heights: "
      "their summits "
      "are others. The force was taken " +
      shortNumber(std::exp(of_force.shift()), 2) +
      " times as large for that, and the interval holds what of it may not go for the device");
}

/// By how much more a device holds each of whose contacts rests on such a place alone.
PlaceExcess excessOf(const PlaceAlone& place, int contacts, const DeviceForce& force) {
  const double contact_area = force.area / contacts;
  const auto over = [](double figure, double median) {
    return figure > 0.0 && median > 0.0 ? std::log(figure / median) : 0.0;
  };
  return {
      over(contacts * place.force * std::min(contact_area / place.area, 1.0), force.pull_off_force),
      over(place.work * std::min(place.area / contact_area, 1.0), force.apparent_work_of_adhesion)};
}

/// Places that differ, in words: the upper end of the interval reaches what the one that holds most
/// may do.
/// - @p checks of both surfaces
/// - @p contacts that share the area
PlaceExcess placesThatHoldMost(const std::vector<PlaceCheck>& checks, const LawCheck& scans,
                               int contacts, DeviceForce& force) {
  PlaceExcess largest;
  for (const PlaceCheck& places : checks) {
    if (!places.isUneven()) continue;
    const PlaceExcess alone = excessOf(places.alone(), contacts, force);
    const PlaceExcess with_others =
        places.closes() ? PlaceExcess{places.forceExcess(), places.workExcess()}
                        : PlaceExcess{scans.largestForceExcess(), scans.largestWorkExcess()};
    const double force_excess = std::max(alone.force, with_others.force);
    largest.force = std::max(largest.force, force_excess);
    largest.work = std::max({largest.work, alone.work, with_others.work});
    std::string sentence = places.sentence();
    if (force_excess > std::log(kToldMisfit)) {
      sentence +=
          places.closes()
              ? ". By itself it bonds all over: if it does so in the device, that holds up to "
          : alone.force > with_others.force
              ? ". If the device rests on such a place alone, it holds up to "
              : ". If the device is like the scan that holds most, it holds up to ";
      sentence +=
          shortNumber(std::exp(force_excess), 2) + " times as much, which the interval contains";
    }
    force.warnings.push_back(sentence);
  }
  return largest;
}

/// Of scans that contradict each other, by their figures and those of scans that were made by the
/// law of all.
PlaceExcess scanThatHoldsMost(const LawCheck& scans, DeviceForce& force) {
  const PlaceExcess excess = {scans.largestForceExcess(), scans.largestWorkExcess()};
  if (excess.force > std::log(kToldMisfit)) {
    force.warnings.push_back(
        "scans contradict each other: if the device is as the one that holds most, it holds " +
        shortNumber(std::exp(excess.force), 2) + " times as much, which the interval contains");
  }
  return excess;
}

/// The same surfaces seen from the other side: the upper one lies below.
std::vector<HeightMap> turned(const std::vector<HeightMap>& surfaces) {
  std::vector<HeightMap> maps;
  for (const HeightMap& surface : surfaces) {
    const cv::Mat below = -surface.heights();
    maps.emplace_back(below, surface.pitchX(), surface.pitchY());
  }
  return maps;
}

std::vector<NamedScan> turned(const std::vector<NamedScan>& scans) {
  std::vector<NamedScan> named = scans;
  const std::vector<HeightMap> maps = turned(mapsOf(scans));
  for (std::size_t i = 0; i < named.size(); ++i) named[i].surface = maps[i];
  return named;
}

/// What one model makes of the scans, and of the surfaces that are made after them.
struct ModelRun {
  Options level;  ///< of scans, which are parts of a plate
  DeviceForce force;
  std::vector<Prediction> predictions;  ///< of the scans that show summits
  Logs stated;                          ///< by the law of the scans, or by parts of them
  Logs others;                          ///< by what other scans of the same surfaces would give
  std::vector<double> counts;
  std::vector<double> gaps;
  bool do_scans_contradict = false;
  std::optional<LawCheck> check;
  std::vector<PlaceCheck>
      places;  ///< of the lower surface, and of the upper one if that is no plane
  std::optional<DeviceAreaSolver> solver;

  bool isConforming() const {
    const auto conforming =
        std::count_if(predictions.begin(), predictions.end(),
                      [](const Prediction& prediction) { return prediction.is_conforming; });
    return 2 * conforming > static_cast<std::ptrdiff_t>(predictions.size());
  }

  void add(const Realisation& realisation) {
    force.realisations.push_back(realisation);
    stated.add(realisation);
    counts.push_back(realisation.contacts);
    gaps.push_back(realisation.separation_at_rest);
  }
};

/// The scans as frames, each under what lies over it.
ModelRun predictedScans(const DeviceSurfaces& surfaces, const DeviceArea& area,
                        const Options& model) {
  ModelRun run;
  run.level = stiffModel(model);
  run.level.output = figuresAlone();
  run.force.area = area.area;
  AdhesionModel adhesion(run.level);
  const double finest = finestPitch(mapsOf(surfaces.scans));
  const std::vector<HeightMap> counter_surface = mapsOf(surfaces.counter_surface);
  const double loaded_area = areaOf(surfaces.scans.front().surface);
  double force_per_area = 0.0;
  for (const NamedScan& scan : surfaces.scans) {
    if (!showsSummits(scan.surface, finest)) continue;
    adhesion.setOptions(loadedOn(run.level, loaded_area, areaOf(scan.surface)));
    run.predictions.push_back(adhesion.predict(underCounterSurface(scan.surface, counter_surface)));
    const Prediction& prediction = run.predictions.back();
    force_per_area += prediction.pull_off_force / prediction.nominal_area;
    run.force.parts_of_scans.push_back({prediction.nominal_area, prediction.pull_off_force});
    run.force.contacts_of_scans += prediction.pull_off_contact_count;
  }
  run.force.linear_pull_off_force =
      force_per_area / static_cast<double>(run.predictions.size()) * area.area;
  return run;
}

/// The surfaces bond all over: force and work go with area.
void takeConforming(const std::vector<Prediction>& predictions, const Options& model,
                    const UncertaintyOptions& uncertainty, DeviceForce& force) {
  force.is_conforming = true;
  std::vector<double> forces;
  std::vector<double> works;
  for (const Prediction& prediction : predictions) {
    const double of_area = prediction.pull_off_force * force.area / prediction.nominal_area;
    force.realisations.push_back({of_area, prediction.apparent_work_of_adhesion,
                                  prediction.pull_off_contact_count, prediction.mean_gap});
    forces.push_back(std::log(of_area));
    works.push_back(std::log(prediction.apparent_work_of_adhesion));
  }
  force.pull_off_force = std::exp(medianOf(forces));
  force.apparent_work_of_adhesion = std::exp(medianOf(works));
  force.contacts = 1.0;
  force.separation_at_rest = predictions.back().mean_gap;
  double student = 0.0;
  force.force_deviation = force.work_deviation = 0.0;
  if (forces.size() > 1) {
    const double once_more = std::sqrt(1.0 + 1.0 / static_cast<double>(forces.size()));
    force.force_deviation = deviationOf(forces) * once_more;
    force.work_deviation = deviationOf(works) * once_more;
    student = studentQuantile(static_cast<double>(forces.size()) - 1.0);
  }
  takeIntervals(predictions.back(), model, uncertainty, student, {}, force);
  force.warnings.emplace_back(
      "the scans' surfaces conform and bond all over: force and work go with area");
}

/// The contacts that hold in any of the scans: the more scans, the surer is what another place has.
std::vector<Asperity> contactsOfAll(const std::vector<Prediction>& predictions) {
  std::vector<Asperity> contacts;
  for (const Prediction& prediction : predictions) {
    const std::vector<Asperity>& holding = prediction.holdingContacts();
    contacts.insert(contacts.end(), holding.begin(), holding.end());
  }
  return contacts;
}

/// Medians and intervals of all realisations.
/// - @p contacts that share the area
void takeRealisations(const UncertaintyOptions& uncertainty, int realisations, int contacts,
                      ModelRun& run) {
  DeviceForce& force = run.force;
  const AreaGrowth growth = run.solver->growth();
  for (Realisation& realisation : force.realisations) {
    realisation.pull_off_force *= growth.force;
    realisation.apparent_work_of_adhesion *= growth.work;
  }
  force.pull_off_force = medianFigure(run.stated.force) * growth.force;
  force.apparent_work_of_adhesion = medianFigure(run.stated.work) * growth.work;
  force.contacts = medianOf(run.counts);
  force.separation_at_rest = medianOf(run.gaps);
  const double once_more = std::sqrt(1.0 + 1.0 / realisations);
  const auto scatter = [&](const std::vector<double>& of_stated,
                           const std::vector<double>& of_others) {
    return once_more *
           std::hypot(std::max(deviationOf(of_stated), deviationOf(of_others)), kOwnError);
  };
  force.force_deviation = scatter(run.stated.force, run.others.force);
  force.work_deviation = scatter(run.stated.work, run.others.work);
  const double student = studentQuantile(realisations - 1);
  if (run.check) takeMisfit(*run.check, force);
  UpperEnd upper;
  if (run.check) {
    upper.places = placesThatHoldMost(run.places, *run.check, contacts, force);
    if (run.do_scans_contradict) upper.scans = scanThatHoldsMost(*run.check, force);
  }

  UncertaintyOptions constants = uncertainty;
  constants.scan_sampling = uncertainty.scan_sampling && !run.check;  // few scans have few contacts
  Prediction like = run.predictions.back();
  like.pull_off_exponents = run.solver->lastForceExponents();
  like.work_exponents = run.solver->lastWorkExponents();
  like.pull_off_contacts = contactsOfAll(run.predictions);
  takeIntervals(like, run.level, constants, student, upper, force);
  force.made_surface = run.solver->madeSurface();
  for (const std::string& warning : run.solver->warnings()) force.warnings.push_back(warning);
}

/// Places of scans that differ by more than chance: where one bonds all over, the scans that were
/// made are made once more and its strength is compared with theirs.
void comparePlaces(const std::vector<ModelRun*>& runs, const DeviceForceOptions& options,
                   Surfaces& known) {
  std::vector<std::pair<PlaceCheck*, bool>> closing;  // and whether it is of the upper surface
  for (ModelRun* run : runs) {
    for (PlaceCheck& places : run->places) {
      if (places.find()) closing.emplace_back(&places, &places != &run->places.front());
    }
  }
  for (int number = 0; !closing.empty() && number < options.realisations; ++number) {
    const Surfaces::MadeScans scans =
        known.scansAgain(number, realisationSeed(options, number) + 1);
    for (const auto& [places, is_upper] : closing) {
      if (!is_upper) {
        places->compare(scans.lower, scans.upper);
      } else {
        places->compare(turned(scans.upper), turned(scans.lower));
      }
    }
  }
}

/// Of all models, the surfaces of which are made once.
void followAll(const DeviceSurfaces& surfaces, const DeviceArea& area,
               const std::vector<ModelRun*>& runs, const std::vector<Guidance>& guidances,
               const UncertaintyOptions& uncertainty, const DeviceForceOptions& options,
               const std::function<void(double)>& progress) {
  const DevicePieces pieces = piecesOf(area, madePitch(surfaces, options), options.max_cells);
  const double loaded_area = areaOf(surfaces.scans.front().surface);
  const std::vector<HeightMap> parts_lower = fineMapsOf(surfaces.scans);
  const std::vector<HeightMap> parts_upper = fineMapsOf(surfaces.counter_surface);
  const bool has_parts = options.pitch == 0.0 && haveRoom(parts_lower, pieces) &&
                         (parts_upper.empty() || haveRoom(parts_upper, pieces));
  Surfaces known(surfaces, pieces.size, options);
  std::vector<std::string> warnings;
  if (!has_parts)
    warnings = missingLongWaves(surfaces, known.laws(0), std::sqrt(area.area / area.contacts));
  const std::vector<std::string> contradicting = contradictions(surfaces);
  warnings.insert(warnings.end(), contradicting.begin(), contradicting.end());

  std::vector<DeviceAreaSolver*> solvers;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    ModelRun& run = *runs[i];
    showSpectrum(known.laws(0).lower, pieces.side(), run.force);
    run.force.is_cut_from_scans = has_parts;
    run.force.warnings = warnings;
    run.do_scans_contradict = !contradicting.empty();
    Options of_plate = run.level;
    if (guidances[i] != Guidance::kGuided) {
      const std::string why_level = whyLevel(pieces);
      if (why_level.empty()) {
        of_plate.guidance = guidances[i];
      } else {
        run.force.warnings.push_back(why_level);
      }
    }
    solvers.push_back(&run.solver.emplace(of_plate, loaded_area, pieces));
    if (!has_parts) {
      run.check.emplace(run.level, known.lower(), known.upper());
      run.places.emplace_back(run.level, loaded_area, surfaces.scans, known.upper());
      if (!known.upper().empty()) {
        run.places.emplace_back(run.level, loaded_area, turned(surfaces.counter_surface),
                                turned(known.lower()));
      }
    }
  }
  StatedSurfaces made(known, pieces);
  const auto deckOf = [&](const std::vector<HeightMap>& scans, std::uint64_t seed) {
    return scans.empty() ? std::nullopt : std::make_optional<ScanDeck>(scans, seed);
  };
  const auto ofParts = [&](std::optional<ScanDeck>& lower, std::optional<ScanDeck>& upper,
                           std::uint64_t seed) {
    return DeviceAreaSolver::realise(solvers, *lower, upper ? &*upper : nullptr, seed);
  };
  const std::uint64_t first_seed = realisationSeed(options, 0);
  std::optional<ScanDeck> stated_lower = deckOf(parts_lower, first_seed + 4);
  std::optional<ScanDeck> stated_upper = deckOf(parts_upper, first_seed + 5);
  const auto addOthers = [&](const std::vector<Realisation>& found) {
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i]->others.add(found[i]);
  };
  for (int number = 0; number < options.realisations; ++number) {
    const std::uint64_t seed = realisationSeed(options, number);
    const std::vector<Realisation> found =
        has_parts ? ofParts(stated_lower, stated_upper, seed)
                  : DeviceAreaSolver::realise(solvers, made.surface(number, seed));
    progress((number + 0.5) / options.realisations);
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i]->add(found[i]);
    if (has_parts) {
      const std::vector<HeightMap> lower = drawnAgain(parts_lower, seed + 1);
      const std::vector<HeightMap> upper = drawnAgain(parts_upper, seed + 2);
      std::optional<ScanDeck> other_lower = deckOf(lower, seed + 6);
      std::optional<ScanDeck> other_upper = deckOf(upper, seed + 7);
      addOthers(ofParts(other_lower, other_upper, seed + 3));
    } else {
      const Surfaces::MadeScans scans = known.scansAgain(number, seed + 1);
      // a single scan is of one place of the wide one, and where it lies is not known
      const bool are_several = runs.front()->check->scanCount() > 1;
      const Surfaces::MadeScans of_device =
          are_several && known.haveOwnWaves() ? known.scansOfDevice(number, seed + 8) : scans;
      const bool has_upper = !scans.upper.empty();
      const std::vector<HeightMap> from_above = turned(scans.upper);
      for (ModelRun* run : runs) {
        const ModelRun* first = run == runs.front() ? nullptr : runs.front();
        run->check->add(of_device.lower, of_device.upper);
        run->places.front().add(scans.lower, first != nullptr ? &first->places.front() : nullptr);
        if (has_upper)
          run->places.back().add(from_above, first != nullptr ? &first->places.back() : nullptr);
      }
      const DeviceLaws again = known.lawsAgain(number, scans);
      DeviceSurface surface(again, pieces, seed + 2);
      addOthers(DeviceAreaSolver::realise(solvers, surface));
    }
    progress((number + 1.0) / options.realisations);
  }
  comparePlaces(runs, options, known);
  for (ModelRun* run : runs)
    takeRealisations(uncertainty, options.realisations, area.contacts, *run);
}

/// deviceForces() of usable scans.
std::vector<DeviceForce> forcesOf(const DeviceSurfaces& surfaces, const DeviceArea& area,
                                  const std::vector<Options>& models,
                                  const UncertaintyOptions& uncertainty,
                                  const DeviceForceOptions& options,
                                  const std::function<void(double)>& on_progress);

/// Of a part whose bodies are thin.
DeviceForce forceOfThinBodies(const DeviceSurfaces& surfaces, const DeviceArea& area,
                              const Options& model, const UncertaintyOptions& uncertainty,
                              const DeviceForceOptions& options,
                              const std::function<void(double)>& on_progress) {
  const auto ofStiff = [&](const DeviceArea& part, const Options& stiff) {
    return std::move(forcesOf(surfaces, part, {stiff}, uncertainty, options, on_progress).front());
  };
  const double length = mosaicLength(surfaces, area, model, options);
  Options stiff = stiffModel(model);
  if (!std::isfinite(length)) {
    stiff.guidance = model.guidance;
    DeviceForce force = ofStiff(area, stiff);
    force.warnings.emplace_back(
        "bodies of this thickness are stiff over the whole contact: no wave of it bends them");
    return force;
  }
  DeviceForce force = ofStiff({length * length, 1}, stiff);
  takePlaces(area, length, force);
  if (model.guidance != Guidance::kGuided) {
    force.warnings.emplace_back(
        "device/guidance: free changes nothing here: a thin body bends down to its contacts before "
        "it would tilt");
  }
  return force;
}

std::vector<DeviceForce> forcesOf(const DeviceSurfaces& surfaces, const DeviceArea& area,
                                  const std::vector<Options>& models,
                                  const UncertaintyOptions& uncertainty,
                                  const DeviceForceOptions& options,
                                  const std::function<void(double)>& on_progress) {
  const auto progress = [&](double share) {
    if (on_progress) on_progress(share);
  };
  std::vector<DeviceForce> forces(models.size());
  std::vector<ModelRun> runs;
  std::vector<std::size_t> places;  // of the runs among the models
  for (std::size_t i = 0; i < models.size(); ++i) {
    const Options& model = models[i];
    if (model.lower.thickness > 0.0 || model.upper.thickness > 0.0) {
      // each has a mosaic of its own
      const double count = static_cast<double>(models.size());
      forces[i] = forceOfThinBodies(surfaces, area, model, uncertainty, options, [&](double share) {
        progress((static_cast<double>(i) + share) / count);
      });
      continue;
    }
    if (runs.empty()) progress(0.0);
    runs.push_back(predictedScans(surfaces, area, model));
    runs.back().force.pitch = madePitch(surfaces, options);
    places.push_back(i);
  }
  std::vector<ModelRun*> open;
  std::vector<Guidance> guidances;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Options& model = models[places[i]];
    if (runs[i].isConforming()) {
      takeConforming(runs[i].predictions, model, uncertainty, runs[i].force);
    } else {
      open.push_back(&runs[i]);
      guidances.push_back(model.guidance);
    }
  }
  if (!open.empty()) followAll(surfaces, area, open, guidances, uncertainty, options, progress);
  for (std::size_t i = 0; i < runs.size(); ++i) forces[places[i]] = std::move(runs[i].force);
  return forces;
}

}  // namespace

DeviceForce deviceForce(const DeviceSurfaces& surfaces, const DeviceArea& area,
                        const Options& model, const UncertaintyOptions& uncertainty,
                        const DeviceForceOptions& options,
                        const std::function<void(double)>& on_progress) {
  return std::move(
      deviceForces(surfaces, area, {model}, uncertainty, options, on_progress).front());
}

std::vector<DeviceForce> deviceForces(const DeviceSurfaces& surfaces, const DeviceArea& area,
                                      const std::vector<Options>& models,
                                      const UncertaintyOptions& uncertainty,
                                      const DeviceForceOptions& options,
                                      const std::function<void(double)>& on_progress) {
  checkDevice(surfaces, area, options);
  const UsableScans usable = usableScans(surfaces);
  std::vector<DeviceForce> forces =
      forcesOf(usable.surfaces, area, models, uncertainty, options, on_progress);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    DeviceForce& force = forces[i];
    force.missing_scan = missingShortWaves(usable.surfaces, models[i]);
    if (force.missing_scan.empty())
      force.missing_scan = missingPixels(area, madePitch(usable.surfaces, options));
    if (!force.missing_scan.empty())
      force.warnings.insert(force.warnings.begin(), force.missing_scan);
    force.warnings.insert(force.warnings.begin(), usable.remarks.begin(), usable.remarks.end());
  }
  return forces;
}

}  // namespace mems_stiction
