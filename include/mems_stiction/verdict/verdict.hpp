#pragma once

/// @file
/// Does this device stick? From what is known of its adhesion to a word and its reason.
///
///     restoring force = k travel
///     pull-off force  = that of surfaces of the device's size (device_force.hpp), which come as
///                       evidence
///     margin          = restoring force/pull-off force: above 1 the spring pulls the contact open
///     peel number     = what bending gives per what adhesion takes, of a beam (beam_adhesion.hpp):
///                       above 1 it comes off
///
/// The margin is a ratio, so that 2 reads "twice the force needed" for every device, and beams and
/// springs compare. Its 95 % interval is that of the force it rests on, quantile by quantile: the
/// uncertain constants and the model (margin_uncertainty.hpp), and in quadrature with them what the
/// scans leave open of the device's surfaces. The word:
///
///     no        the whole interval is above 1, also with the pull-off prefactors of the JKR-DMT
///               transition
///     yes       the whole interval is below 1
///     marginal  1 lies within
///     unknown   the device is not stated, or the search found no equilibrium; pixels or tip of the
///               finest scan are coarser than what holds (missing_scan.hpp), and the reason says
///               which scan is missing; the device's own force has not been found and its contacts
///               have not the scan's size (contact_size.hpp); the answer would be no, but rests on
///               contacts of one pixel; or the surfaces bond under paper or printed (the forces are
///               then lower bounds: they can say "yes", not "no")
///
/// Where the device's own force has not been found, a scan stands for contacts of half to twice its
/// area, each with the force per area of the scan. Then a "no" that rests on a contact at the
/// frame's border, or on fewer than three, is unknown, too. So is a "no" by places of the device
/// that are cut from scans in which fewer than three contacts hold. Surfaces that are made for the
/// device have their own contacts, whose scatter is in the interval. The reason says what margin
/// the scan's force by area would give, where it differs by more than a factor of 1.5.
///
/// A half-space of the same scan judges in the prediction's place if it is solved, converged,
/// resolved and converged with its steps (whyNotJudging()): its pull-off force and work, with its
/// error for that of the model. The device's own figures move by as much as it moves those of the
/// scan. What speaks of the scan still counts. Other cleanings of the scan, if they were tried,
/// widen the interval. The reason says both.
///
/// With a spring and a beam stated, the worse of both counts: yes, unknown, marginal, no; where
/// both have one word, the lower ratio. The beam is judged as if it were alone. A beam that states
/// its width and its contact area has a margin, too: its force over the pull-off force. A contact
/// that is shorter than what adhesion gives way to at one time (peelLength()) is judged by the
/// margin, one of twice that by the peel number, between by the worse of both, and the reason says
/// why. A beam without device/contact_area is judged by the scan's work, which it says.
/// Assumptions: the scans stand for the whole contact area; the load has been taken away before the
/// device is to open (voltage and mechanical load made the contact, they do not hold it); the
/// spring pulls along the normal and evenly on all contacts, so that none peels before the others
/// (a tilting part comes off more easily than said here).
///
///     const Verdict verdict = verdictOf(prediction, device, uncertainty, options,
///         scan.cellArea(), evidence);
///     if (verdict.sticks == Sticks::kYes) reject(verdict.reason);

#include <cstdint>
#include <limits>
#include <string>

#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "mems_stiction/verdict/device_options.hpp"
#include "mems_stiction/verdict/evidence.hpp"
#include "mems_stiction/verdict/uncertainty_options.hpp"

namespace mems_stiction {

/// The values are those of the message.
enum class Sticks : std::uint8_t { kNo = 0, kMarginal = 1, kYes = 2, kUnknown = 3 };

/// "no", "marginal", "yes", "unknown".
const char* sticksText(Sticks sticks);

/// Whose figures a verdict rests on.
enum class Judge { kPrediction, kHalfSpace };

/// "prediction", "half_space".
const char* judgeText(Judge judge);

/// What decides whether a beam sticks whose margin and peel number are both known.
inline constexpr char kGovernedByForce[] = "force";
inline constexpr char kGovernedByPeeling[] = "peeling";

/// NaN stands for what the device's settings do not allow to say.
struct Verdict {
  static constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

  Sticks sticks = Sticks::kUnknown;
  std::string reason;  ///< one sentence for people
  Judge judge = Judge::kPrediction;
  std::string
      governed_by;  ///< kGovernedBy...; empty where one of margin and peel number is all there is

  double restoring_force = kNotStated;        ///< of the device [N]
  double device_pull_off_force = kNotStated;  ///< of the whole device [N]
  double device_pull_off_force_lower =
      kNotStated;  ///< 2.5 % quantile [N]; restoring force over it is margin_upper
  double device_pull_off_force_upper =
      kNotStated;              ///< 97.5 % quantile [N]; restoring force over it is margin_lower
  double margin = kNotStated;  ///< restoring over pull-off force [-]; infinite without adhesion
  double margin_lower = kNotStated;  ///< 2.5 % quantile [-]
  double margin_upper = kNotStated;  ///< 97.5 % quantile [-]
  double margin_uncertainty =
      kNotStated;  ///< half of the central 68 % interval [-]: one standard deviation
  double margin_transition =
      kNotStated;  ///< with the prefactors of the JKR-DMT transition [-], <= margin
  /// Of the rough interface, which beams peel [J/m^2]: as measured, of surfaces of the device's
  /// size, or else the scan's.
  double device_apparent_work_of_adhesion = kNotStated;
  double peel_number = kNotStated;        ///< of the beam [-]
  double peel_number_lower = kNotStated;  ///< 2.5 % quantile [-]
  double peel_number_upper = kNotStated;  ///< 97.5 % quantile [-]
  double detachment_length = kNotStated;  ///< longest beam that comes off by itself [m]
  double unstuck_length = kNotStated;     ///< free arm of the beam while it is stuck [m]
  double pull_in_voltage = kNotStated;    ///< at which the electrodes close [V]
  std::uint32_t regime_flags = 0;         ///< bits of RegimeFlag

  /// What of the interval is of the place alone, for pooledVerdictOf(): standard deviation of ln
  /// margin [-]; 0 where the device's own force judges. In no message.
  double place_deviation = kNotStated;
  /// What of the interval the scans leave open: reach of ln force to either side, 95 % [-]. In no
  /// message.
  double surface_reach = kNotStated;
};

/// - @p options those that the prediction was made with
/// - @p cell_area of the scan [m^2], > 0
/// - @p evidence what else is known
Verdict verdictOf(const Prediction& prediction, const DeviceOptions& device,
                  const UncertaintyOptions& uncertainty, const Options& options, double cell_area,
                  const Evidence& evidence = {});

}  // namespace mems_stiction
