#include "mems_stiction/verdict/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "errors/short_number.hpp"
#include "numeric/constants.hpp"
#include "numeric/words.hpp"
#include "verdict/contact_size.hpp"
#include "verdict/electrode_hold.hpp"
#include "verdict/finding.hpp"
#include "verdict/margin_uncertainty.hpp"
#include "verdict/missing_scan.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr double kStandardLower =
    0.158655;  // one standard deviation of a normal distribution to either side
constexpr double kStandardUpper = 1.0 - kStandardLower;
/// By less the linear rule's margin may differ unsaid [-].
constexpr double kWorthSaying = 1.5;

/// A margin can be found: by the spring, or by the force of a beam alone.
bool hasContact(const DeviceOptions& device) {
  return device.contact_area > 0.0 && (device.hasSpring() || device.hasBeamContact());
}

/// What there is to say where the contacts are not listed, so that nothing tells how far the
/// figures may be off.
Finding withoutContacts(const std::string& what, const Prediction& prediction) {
  return {Sticks::kUnknown,
          what + " needs the list of contacts: " +
              (prediction.has_asperities ? "output/asperities is off"
                                         : "this approach/formulation tells none apart")};
}

/// "2.2e-09 m (now 1e-08 m), 512 x 512 of them on 1.1e-06 m": pixels of which a contact of one
/// pixel would have enough.
std::string finerPixels(double cell_area) {
  constexpr int kUsual = 512;  // pixels of a side
  const double pitch = std::sqrt(cell_area);
  const double finer = pitch / std::sqrt(kFewestCellsPerContact);
  const std::string side = std::to_string(kUsual);
  return shortNumber(finer, 2) + " m (now " + shortNumber(pitch, 2) + " m), " + side + " x " +
         side + " of them on " + shortNumber(kUsual * finer, 2) + " m";
}

/// "at least 3 times", for one contact.
std::string areaFactor(int contacts) {
  const double factor = static_cast<double>(kFewestContactsForStatement) / std::max(contacts, 1);
  return "at least " + shortNumber(factor, 2) + " times";
}

/// Why a scan can carry no plain "no", and what to do, one thing after the other; empty if it can.
/// - @p cell_area of the scan [m^2]
/// - @p of_device surfaces of the device's size judge, whose contacts are not those of the scan;
/// nullptr: the scan does
std::string whatLacks(const Prediction& prediction, std::uint32_t flags, double cell_area,
                      const DeviceEvidence* of_device) {
  const bool is_of_device = of_device != nullptr;
  const int contacts = is_of_device ? of_device->contacts : prediction.pull_off_contact_count;
  const bool has_few = prediction.has_asperities && contacts < kFewestContactsForStatement;
  if ((flags & kOnePixelFlag) != 0) {
    const bool needs_places = !is_of_device && (has_few || (flags & kBorderFlag) != 0);
    return "the answer rests on contacts of one pixel: scan finer pixels" +
           std::string(needs_places ? " first" : "") + ", of at most " + finerPixels(cell_area) +
           (needs_places
                ? ", then as many such places as have " +
                      std::to_string(kFewestContactsForStatement) +
                      " contacts inside; a larger area of the same pixels would show none better"
                : "") +
           "; or set preprocessing/refine";
  }
  if (!is_of_device && (flags & kBorderFlag) != 0) {
    return "the answer rests on a contact at the border of the frame, whose summit may lie "
           "outside: scan another "
           "place, "
           "or a larger one";
  }
  if (has_few) {
    return "the answer rests on " + countText(contacts, "contact") +
           (is_of_device ? " in all scans" : "") + ": scan more places, or an area " +
           areaFactor(contacts) + " as large, another may have higher summits";
  }
  return "";
}

/// Whose figures hold a device, and how they are known.
struct Holding {
  const Prediction& prediction;     ///< of whoever judges the scan
  const DeviceOptions& device;      ///< that is held
  const Options& options;           ///< those that the prediction was made with
  const AdhesionSpread& spread;     ///< of the figures that judge
  const DeviceEvidence* of_device;  ///< its own figures; nullptr: the scan's stand for it
  bool has_cleanings;               ///< the spread knows of other cleanings
  std::string why_not;              ///< the scan cannot stand for it; empty if it can, or need not
  FieldHold electrodes;             ///< what a contact potential holds there without a voltage
  double potential_deviation;       ///< of the logarithm of the contact potential [-]
};

/// What holds, of which a share is of the surfaces and the rest of the electrodes: as a multiple
/// of itself where both are at the same quantile, as if they went together.
/// - @p deviations standard ones of a normal distribution to that quantile
double holdingFactor(const Holding& holding, double share, double of_surfaces, double deviations) {
  return share * of_surfaces +
         (1.0 - share) * std::exp(2.0 * deviations * holding.potential_deviation);
}

/// What a quantile of the work of adhesion is of it [-]; 1 where it was measured on beams.
double workFactor(const Holding& holding, double place) {
  return holding.device.apparent_work_of_adhesion > 0.0
             ? 1.0
             : quantile(holding.spread.apparent_work, place);
}

/// "; 1.2e-07 N of what holds are of the contact potential between the electrodes", or nothing.
std::string electrodeShare(double hold, const char* unit) {
  if (hold == 0.0) return "";
  return "; " + shortNumber(hold, 2) + " " + unit +
         " of what holds are of the contact potential between the electrodes";
}

/// "; the scan's force by area would say margin 0.2", where that is worth saying.
/// - @p electrodes what holds beside the surfaces [N]
std::string linearMargin(const DeviceEvidence& of_device, double electrodes,
                         const Verdict& verdict) {
  const double linear = verdict.restoring_force / (of_device.linear_pull_off_force + electrodes);
  const double ratio = linear / verdict.margin;
  if (!(std::max(ratio, 1.0 / ratio) > kWorthSaying)) return "";
  return "; the scan's force by area would say margin " + shortNumber(linear, 2);
}

Finding springFinding(const Holding& holding, Verdict& verdict) {
  const Prediction& prediction = holding.prediction;
  if (!holding.why_not.empty()) return {Sticks::kUnknown, holding.why_not};
  const double across_the_gap = prediction.pull_off_force - prediction.pull_off_force_jkr;
  const double transition = prediction.pull_off_force_transition + across_the_gap;
  const double of_surfaces =
      holding.of_device != nullptr
          ? holding.of_device->pull_off_force
          : prediction.pull_off_force * (holding.device.contact_area / prediction.nominal_area);
  const double of_electrodes = holding.electrodes.force;
  verdict.device_pull_off_force = of_surfaces + of_electrodes;
  verdict.margin = verdict.restoring_force / verdict.device_pull_off_force;
  if (std::isinf(verdict.margin)) {
    verdict.margin_lower = verdict.margin_upper = verdict.margin_transition = verdict.margin;
    return {Sticks::kNo, "nothing holds the contact: no adhesion"};
  }
  if (std::isinf(of_electrodes)) {
    verdict.margin_lower = verdict.margin_upper = verdict.margin_transition = verdict.margin;
    return {Sticks::kYes, "the contact potential between the electrodes holds the device"};
  }
  const double share = of_surfaces / verdict.device_pull_off_force;
  verdict.margin_transition = verdict.margin;
  if (transition > 0.0) {
    const double force = prediction.pull_off_force;
    verdict.margin_transition *= force / (share * transition + (1.0 - share) * force);
  }
  if (!holding.spread.isKnown()) return withoutContacts("the margin's interval", prediction);
  // the margin falls as the pull-off force grows
  const auto forceAt = [&](double place, double deviations) {
    return holdingFactor(holding, share, quantile(holding.spread.pull_off, place), deviations);
  };
  verdict.device_pull_off_force_lower =
      verdict.device_pull_off_force * forceAt(kLowerShare, -kNormal95);
  verdict.device_pull_off_force_upper =
      verdict.device_pull_off_force * forceAt(kUpperShare, kNormal95);
  verdict.margin_lower = verdict.restoring_force / verdict.device_pull_off_force_upper;
  verdict.margin_upper = verdict.restoring_force / verdict.device_pull_off_force_lower;
  verdict.margin_uncertainty =
      0.5 * verdict.margin *
      (1.0 / forceAt(kStandardLower, -1.0) - 1.0 / forceAt(kStandardUpper, 1.0));
  const double lowest = std::min(verdict.margin_lower, verdict.margin_transition);
  Finding finding = judgedRatio("margin", verdict.margin, lowest, verdict.margin_upper,
                                prediction.isLowerBound(), holding.has_cleanings);
  finding.reason += electrodeShare(of_electrodes, "N");
  if (holding.of_device != nullptr)
    finding.reason += linearMargin(*holding.of_device, of_electrodes, verdict);
  return finding;
}

Finding beamFinding(const Holding& holding, Verdict& verdict) {
  const DeviceOptions& device = holding.device;
  const bool is_measured = device.apparent_work_of_adhesion > 0.0;
  if (!is_measured && !holding.why_not.empty()) return {Sticks::kUnknown, holding.why_not};
  const Beam beam = device.beam();
  const double work = verdict.device_apparent_work_of_adhesion;
  if (std::isnan(work)) return withoutContacts("the beam's adhesion", holding.prediction);
  const double of_electrodes = holding.electrodes.work;
  const double share = work / (work + of_electrodes);
  verdict.peel_number = peelNumber(beam, work + of_electrodes);
  const BeamLengths lengths =
      stuckLengths(device, holding.options.interface, holding.options.load.contact_potential,
                   holding.prediction.mean_gap, work);
  verdict.detachment_length = lengths.detachment;
  verdict.unstuck_length = lengths.unstuck;
  verdict.peel_number_lower = verdict.peel_number_upper = verdict.peel_number;
  if (std::isinf(verdict.peel_number)) return {Sticks::kNo, "nothing holds the beam: no adhesion"};
  if (std::isinf(of_electrodes))
    return {Sticks::kYes, "the contact potential of the electrode holds the beam"};
  // the spread is known, as the contacts that the work of adhesion was summed over
  const auto workAt = [&](double place, double deviations) {
    return holdingFactor(holding, share, workFactor(holding, place), deviations);
  };
  const double at_most = verdict.peel_number / workAt(kLowerShare, -kNormal95);
  const double at_least = verdict.peel_number / workAt(kUpperShare, kNormal95);
  verdict.peel_number_lower =
      std::min(at_least, at_most);  // compressed beams have peel numbers below 0
  verdict.peel_number_upper = std::max(at_least, at_most);
  Finding finding = judgedRatio(
      "peel number", verdict.peel_number, verdict.peel_number_lower, verdict.peel_number_upper,
      holding.prediction.isLowerBound() && !is_measured, holding.has_cleanings && !is_measured);
  finding.reason += electrodeShare(of_electrodes, "J/m^2");
  if (!is_measured && device.contact_area == 0.0) {
    finding.reason +=
        "; by the scan's work of adhesion: with device/contact_area it would be that of the device";
  }
  const bool is_force_known = is_measured || device.hasSpring() || device.hasBeamContact();
  if (finding.sticks == Sticks::kNo && device.contact_area > 0.0 && !is_force_known) {
    finding.sticks = Sticks::kUnknown;
    finding.reason +=
        "; but the force that opens a contact of device/contact_area is not known without "
        "device/beam_width";
  }
  return finding;
}

/// The decay length of a bonded beam over peelLength(), which is half of it: ends of a contact that
/// are further apart do not feel each other [-].
constexpr double kDecayLength = 2.0;

/// How far along a beam adhesion gives way at one time (peelLength()), and between which lengths a
/// contact is neither pulled open as a whole nor peeled: from the shortest that 95 % contain to the
/// longest decay length [m].
struct PeelReach {
  double length = 0.0;
  double shortest = 0.0;
  double longest = 0.0;
};

/// Force and work rise together, as their quantiles do.
PeelReach peelReach(const Holding& holding, const Verdict& verdict) {
  const DeviceOptions& device = holding.device;
  const Beam beam = device.beam();
  const double pressure =
      (verdict.device_pull_off_force - holding.electrodes.force) / device.contact_area;
  PeelReach reach;
  reach.length = reach.shortest =
      peelLength(beam, verdict.device_apparent_work_of_adhesion, pressure);
  reach.longest = kDecayLength * reach.length;
  if (!holding.spread.isKnown()) return reach;
  for (const double share : {kLowerShare, kUpperShare}) {
    const double length =
        peelLength(beam, verdict.device_apparent_work_of_adhesion * workFactor(holding, share),
                   pressure * quantile(holding.spread.pull_off, share));
    reach.shortest = std::min(reach.shortest, length);
    reach.longest = std::max(reach.longest, kDecayLength * length);
  }
  return reach;
}

/// Of a beam whose force and whose work of adhesion are both known, that which decides: by how far
/// the contact reaches, and the worse of both where that leaves it open.
Finding governingFinding(const Holding& holding, Finding of_force, Finding of_work,
                         Verdict& verdict) {
  if (std::isnan(verdict.margin) || std::isnan(verdict.peel_number) || std::isinf(verdict.margin))
    return of_work;
  const double reach = holding.device.beamContactLength();
  const PeelReach peeled = peelReach(holding, verdict);
  const bool is_open = reach > peeled.shortest && reach < peeled.longest;
  const int worse_force = gravity(of_force.sticks) - gravity(of_work.sticks);
  const bool is_worse_by_force =
      worse_force != 0 ? worse_force > 0 : verdict.margin < verdict.peel_number;
  const bool is_force = is_open ? is_worse_by_force : reach < peeled.length;
  verdict.governed_by = is_force ? kGovernedByForce : kGovernedByPeeling;
  Finding finding = is_force ? std::move(of_force) : std::move(of_work);
  const std::string other = is_force ? "peel number " + shortNumber(verdict.peel_number, 2)
                                     : "margin " + shortNumber(verdict.margin, 2);
  const std::string opens =
      is_open
          ? " may open as a whole or peel, as any from " + shortNumber(peeled.shortest, 2) +
                " m to " + shortNumber(peeled.longest, 2) + " m"
          : std::string(is_force ? ", less" : ", more") + " than " + shortNumber(peeled.length, 2) +
                " m, " + (is_force ? "opens as a whole" : "peels");
  finding.reason += std::string("; the ") + (is_force ? "margin" : "peel number") + " decides" +
                    (is_open ? ", the worse of both" : "") + " (" + other +
                    "): a contact that reaches " + shortNumber(reach, 2) + " m along the beam" +
                    opens;
  return finding;
}

/// What pressed the surfaces before they were drawn apart, if that changed them; else nothing.
/// - @p contact_potential [V]
std::string historyOf(const Prediction& prediction, double contact_potential) {
  const bool flowed = prediction.elasto_plastic_count + prediction.plastic_count > 0;
  if (!flowed || !prediction.model.knows_every_load) return "";
  const double pressure = prediction.mechanical_load / prediction.nominal_area;
  std::string loads;
  const auto add = [&](double value, const std::string& unit) {
    if (value == 0.0) return;
    loads += (loads.empty() ? "" : " and ") + shortNumber(std::abs(value)) + unit;
  };
  add(1e-6 * pressure, " MPa");
  add(prediction.voltage, " V");
  add(contact_potential, " V of contact potential");
  return loads.empty() ? "" : "; after " + loads + ", under which contacts have flowed";
}

/// Spring or beam, whichever is worse by its word, then by the ratio that decides.
/// - @p of_spring the device without its beam
/// - @p of_beam without its spring, with a margin and a peel number of its own
Verdict worseOf(Verdict of_spring, Verdict of_beam) {
  const double deciding =
      of_beam.governed_by == kGovernedByPeeling ? of_beam.peel_number : of_beam.margin;
  const int worse = gravity(of_beam.sticks) - gravity(of_spring.sticks);
  const double pull_in = of_spring.pull_in_voltage;
  if (worse > 0 || (worse == 0 && deciding < of_spring.margin)) {
    of_beam.pull_in_voltage = pull_in;
    if (of_beam.governed_by == kGovernedByPeeling) {  // the force is that of the spring
      of_beam.restoring_force = of_spring.restoring_force;
      of_beam.margin = of_spring.margin;
      of_beam.margin_lower = of_spring.margin_lower;
      of_beam.margin_upper = of_spring.margin_upper;
    }
    of_beam.reason += "; that is of the beam, the worse of both";
    if (!std::isnan(of_spring.margin)) {
      of_beam.reason += " (the spring alone: margin " + shortNumber(of_spring.margin, 2) + ")";
    }
    return of_beam;
  }
  of_spring.device_apparent_work_of_adhesion = of_beam.device_apparent_work_of_adhesion;
  of_spring.peel_number = of_beam.peel_number;
  of_spring.peel_number_lower = of_beam.peel_number_lower;
  of_spring.peel_number_upper = of_beam.peel_number_upper;
  of_spring.detachment_length = of_beam.detachment_length;
  of_spring.unstuck_length = of_beam.unstuck_length;
  of_spring.governed_by = kGovernedByForce;
  return of_spring;
}

/// - @p prediction of whoever judges the scan
/// - @p flags of the formulation's prediction
/// - @p cell_area of the scan [m^2]
/// - @p evidence on the device, with the cleanings; its half-space is in the prediction
/// - @p potential_deviation of the logarithm of the contact potential [-]
/// - @p spread_of gives the spread of the figures, if it is needed
Verdict verdictBy(const Prediction& prediction, const DeviceOptions& device, const Options& options,
                  std::uint32_t flags, double cell_area, const Evidence& evidence,
                  double potential_deviation, const std::function<AdhesionSpread()>& spread_of) {
  if (device.hasSpring() && device.withoutSpring().hasBeamContact()) {
    DeviceOptions spring = device;
    spring.beam_type = BeamType::kNone;
    std::optional<AdhesionSpread> spread;  // of the prediction, for both
    const auto alone = [&](const DeviceOptions& one) {
      return verdictBy(prediction, one, options, flags, cell_area, evidence, potential_deviation,
                       [&] { return spread ? *spread : spread.emplace(spread_of()); });
    };
    return worseOf(alone(spring), alone(device.withoutSpring()));
  }
  Verdict verdict;
  verdict.regime_flags = flags;
  const double contact_potential = options.load.contact_potential;
  verdict.pull_in_voltage = closingVoltage(device, options.interface, contact_potential);
  verdict.device_apparent_work_of_adhesion = prediction.apparent_work_of_adhesion;
  const bool has_contact = hasContact(device);
  if (device.hasSpring() || device.hasBeamContact())
    verdict.restoring_force = device.restoringForce();
  if (!has_contact && !device.hasBeam()) {
    const std::string missing = whatSpringLacks(device);
    verdict.reason = "the device is not stated" +
                     (missing.empty() ? ": it needs device/spring_stiffness with device/travel and "
                                        "device/contact_area; or a beam"
                                      : " in full: " + missing + " must be > 0");
    return verdict;
  }
  if (device.hasBeam() && device.beam_residual_stress < bucklingStress(device.beam())) {
    verdict.restoring_force = verdict.pull_in_voltage = Verdict::kNotStated;
    verdict.reason = "the beam buckles: device/beam_residual_stress of " +
                     shortNumber(device.beam_residual_stress, 3) + " Pa is below " +
                     shortNumber(bucklingStress(device.beam()), 3) +
                     " Pa, and a beam that is not straight has no such restoring force";
    return verdict;
  }
  const DeviceEvidence* of_device = evidence.device ? &*evidence.device : nullptr;
  if (device.apparent_work_of_adhesion > 0.0) {
    verdict.device_apparent_work_of_adhesion = device.apparent_work_of_adhesion;
  } else {
    verdict.device_apparent_work_of_adhesion = of_device != nullptr
                                                   ? of_device->apparent_work_of_adhesion
                                                   : apparentWorkOfAdhesion(prediction, options);
  }
  if (prediction.status == Status::kNoEquilibrium) {
    verdict.reason =
        "the search for equilibrium ended before it was found: raise approach/max_steps";
    return verdict;
  }

  const AdhesionSpread spread = spread_of();
  verdict.place_deviation = spread.place_deviation;
  verdict.surface_reach =
      of_device != nullptr ? of_device->surface_reach : kNormal95 * spread.place_deviation;
  std::string why_not = of_device != nullptr ? of_device->missing_scan
                                             : whatIsMissing(prediction.short_waves, kTheScan);
  if (why_not.empty() && of_device == nullptr && !hasSizeOfScan(prediction, device)) {
    why_not = whatSizeLacks(prediction, device, evidence.why_no_device);
  }
  const Holding holding{
      prediction,
      device,
      options,
      spread,
      of_device,
      evidence.cleaning.has_value(),
      why_not,
      lastingHold(device, options.interface, contact_potential, prediction.mean_gap),
      potential_deviation};
  Finding finding{Sticks::kNo, ""};
  if (has_contact) finding = springFinding(holding, verdict);
  if (device.hasBeam()) {
    const Finding of_beam = beamFinding(holding, verdict);
    if (device.hasBeamContact()) {
      finding = governingFinding(holding, finding, of_beam, verdict);
    } else if (!has_contact || gravity(of_beam.sticks) > gravity(finding.sticks)) {
      finding = of_beam;
    }
  }
  verdict.sticks = finding.sticks;
  verdict.reason = finding.reason;
  const bool is_of_scan =
      has_contact || device.apparent_work_of_adhesion == 0.0;  // not of beams that were measured
  const std::string lack =
      finding.sticks == Sticks::kNo && is_of_scan && prediction.pull_off_force > 0.0
          ? whatLacks(prediction, flags, cell_area, of_device)
          : "";
  if (!lack.empty()) {
    verdict.sticks = Sticks::kUnknown;
    verdict.reason = finding.reason + "; but " + lack;
  }
  verdict.reason += historyOf(prediction, contact_potential);
  const bool is_plain = verdict.sticks == Sticks::kNo || verdict.sticks == Sticks::kYes;
  if (of_device != nullptr && why_not.empty() && !is_plain && !of_device->warnings.empty()) {
    verdict.reason += "; " + of_device->warnings.front();
  }
  return verdict;
}

}  // namespace

const char* judgeText(Judge judge) {
  return judge == Judge::kHalfSpace ? "half_space" : "prediction";
}

const char* sticksText(Sticks sticks) {
  constexpr const char* kWords[] = {"no", "marginal", "yes", "unknown"};
  return kWords[static_cast<int>(sticks)];
}

Verdict verdictOf(const Prediction& prediction, const DeviceOptions& device,
                  const UncertaintyOptions& uncertainty, const Options& options, double cell_area,
                  const Evidence& evidence) {
  const std::uint32_t flags = regimeFlags(prediction, cell_area);
  const bool is_asked = evidence.half_space != nullptr && (hasContact(device) || device.hasBeam());
  const std::string objection = is_asked ? whyNotJudging(*evidence.half_space) : "";
  const std::string& why = evidence.why_half_space;
  Evidence counted = evidence;
  if (evidence.device &&
      !(std::isfinite(evidence.device->pull_off_force) && !evidence.device->force_factors.empty() &&
        std::isfinite(evidence.device->force_factors.back()))) {
    if (counted.why_no_device.empty() && !evidence.device->warnings.empty()) {
      counted.why_no_device = evidence.device->warnings.front();
    }
    counted.device.reset();
  }
  if (!is_asked || !objection.empty()) counted.half_space = nullptr;
  const auto judged_by = [&](const Prediction& figures) {
    if (counted.device && counted.half_space != nullptr) {
      counted.device =
          scaled(*counted.device, figures.pull_off_force / prediction.pull_off_force,
                 figures.apparent_work_of_adhesion / prediction.apparent_work_of_adhesion);
    }
    return verdictBy(figures, device, options, flags, cell_area, counted,
                     lognormalDeviation(uncertainty.contact_potential),
                     [&] { return adhesionSpread(prediction, options, uncertainty, counted); });
  };
  if (counted.half_space == nullptr) {
    Verdict verdict = judged_by(prediction);
    if (!objection.empty()) {
      verdict.reason += "; " +
                        (why.empty() ? "the half-space" : why + " asks for the half-space, which") +
                        " does not count: " + objection;
    } else if (!why.empty() && !evidence.where_half_space.empty()) {
      verdict.reason += "; " + why + " asks for the half-space: " + evidence.where_half_space;
    }
    return verdict;
  }
  Verdict verdict = judged_by(withHalfSpace(prediction, *evidence.half_space));
  verdict.judge = Judge::kHalfSpace;
  verdict.reason = "by the half-space" + (why.empty() ? "" : ", as " + why + " asks for it") +
                   ": " + verdict.reason;
  return verdict;
}

}  // namespace mems_stiction
