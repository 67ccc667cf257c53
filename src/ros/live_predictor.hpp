#pragma once

/// @file
/// What the node remembers between scans, and the core beside it: the settings that may change, the
/// last scan, the counter-surface and the deformation that has accumulated. No ROS graph; one
/// object serves one thread.
///
/// A scan is cleaned once, when it comes. As the last scan it stays prepared: new loads, long runs
/// and the preview take it from there; under a newer counter-surface it is mounted again, not
/// cleaned. The contacts before have left their mark on both cleaned surfaces (surface/wear.hpp),
/// as in cycles. No running setting bears on its preparation.

#include <cstdint>
#include <deque>
#include <optional>

#include "configuration/running_settings.hpp"
#include "evaluation/part_scans.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "ros/image_conversion.hpp"
#include "ros/predicted_scan.hpp"
#include "surface/wear.hpp"

namespace mems_stiction {

/// Where the half-space is found that flags ask for.
inline constexpr char kHalfSpaceOnDemand[] = "~solve_half_space has it";
inline constexpr char kHalfSpaceOnTopic[] =
    "it follows on the topic half_space; ~solve_half_space has it on demand";

/// Why a verdict has no force of the device.
inline constexpr char kDeviceOnTopic[] =
    "the node finds it by the scans on its topic height and publishes it on device_force";

/// What a long run on one scan needs, so that it can go its own way while scans are predicted.
struct StationCase {
  std_msgs::Header header;           ///< of the scan
  ScanIdentity identity;             ///< what was scanned
  PreparedScan scan;                 ///< as the contacts before have left it, if it is the last one
  SettingsOwner::Snapshot settings;  ///< of the time when it was asked for
};

/// What a load bears on most.
struct LoadFigures {
  double pull_off_force = 0.0;       ///< [N]
  double contact_area = 0.0;         ///< [m^2]
  double electrostatic_force = 0.0;  ///< [N]
};

/// How many parts the node remembers: that which has waited longest for a scan is forgotten first.
inline constexpr std::size_t kMostParts = 100;
/// And scans of each, the newest: some 500 bytes a scan, 50 MB for all; with names as long as they
/// may be, 150 MB.
inline constexpr std::size_t kMostScansOfAPart = 1000;

/// The core as the node uses it, one scan after the other.
class LivePredictor {
 public:
  /// - @p accumulate_deformation the depth that a contact has pressed into a scan and into what it
  /// meets is taken off the
  ///        scans of the same size that follow: every scan, and the counter-surface, is then taken
  ///        for the surface as it was made, worn by the contacts before. The same scan again and
  ///        again is cycleContacts(), to the bit.
  /// @throw OptionsError if the configuration is out of range.
  LivePredictor(const Configuration& configuration, bool accumulate_deformation);

  /// For every thread, unlike the rest. A change is that of the next prediction.
  SettingsOwner& settings() { return settings_; }
  const SettingsOwner& settings() const { return settings_; }

  /// The scan that the topic brought; it counts for its part, if it states one. @throw SurfaceError
  /// if it cannot be predicted; then nothing changes.
  PredictedScan predictScan(const ReceivedScan& scan, const OutputOptions& output);

  /// The last scan again, with the settings of now, without adding to the accumulated deformation.
  /// @return nothing if there is no scan yet. @throw SurfaceError if it does not fit a newer
  /// counter-surface.
  std::optional<PredictedScan> predictLastScan();

  /// Another verdict on a scan that predictScan() has counted for its part.
  /// @return what all scans of the part say now; nothing if the scan states no part, or is not
  /// among its scans any more.
  std::optional<PartNews> judgeAgain(const ScanOfPart& scan, const Verdict& verdict);

  /// What the last scan gives with the settings of now: as it was predicted last, or predicted
  /// again if they have changed.
  /// @return nothing if there is no scan yet. @throw SurfaceError as above.
  std::optional<LoadFigures> lastFigures();

  /// A scan at a load of its own, unworn; nothing is remembered.
  /// @throw OptionsError, SurfaceError as above.
  PredictedScan predictOnce(const ReceivedScan& scan, double voltage, double mechanical_load);

  /// @param given null: the last scan as the contacts before have left it.
  /// @throw SurfaceError if there is no scan, or no counter-surface, or either cannot be used.
  StationCase stationCase(const ReceivedScan* given);

  /// For counter_surface/type topic: the latest is kept.
  void setCounterSurface(const ReceivedScan& counter_surface);

  /// Forgets the accumulated deformation.
  void resetSurface();

  /// The scan of the same part that came last; of a scan without a part, it itself.
  const ScanOfPart& newestOf(const ScanOfPart& scan) const;
  /// Whether the scan is the last one (ScanOfPart::id).
  bool isLast(std::uint64_t scan_id) const { return last_ && last_->part.id == scan_id; }
  /// As it came; null: there is none yet.
  const ReceivedScan* lastScan() const { return last_ ? &last_->received : nullptr; }
  /// The last scan as the model got it, on its own grid. Only if there is one.
  const HeightMap& lastSurface() const { return last_->prepared.surfaces.lower; }

  /// How many scans and counter-surfaces have been cleaned so far. For every thread.
  std::uint64_t cleanings() const { return predictor_.preparer().cleanings(); }

 private:
  struct LastScan {
    ReceivedScan received;
    PreparedScan as_made;
    PreparedScan prepared;  ///< the same as the contacts before have left it
    ScanOfPart part;
    Wear wear_before;                ///< what had been pressed in when it came
    bool is_reset = false;           ///< the wear has been forgotten since
    bool has_newer_counter = false;  ///< another counter-surface has come since
  };

  /// Of the last scan, as long as nothing has changed.
  struct KnownFigures {
    SettingsOwner::Snapshot settings;  ///< that they are of; null: there are none
    LoadFigures figures;
  };

  PreparedScan prepare(const ReceivedScan& scan);
  /// Brought up to date, if need be.
  const PreparedScan& lastPrepared();
  void setPoseOf(const ReceivedScan& scan);
  void requireCounterSurface() const;
  /// The prediction among those of its part.
  void addToPart(const ReceivedScan& scan, PredictedScan& predicted);
  /// The prediction with `options` set before, and its verdict.
  PredictedScan judged(const PreparedScan& prepared, const Configuration& settings,
                       const ScanIdentity& identity, const char* where_half_space,
                       const ScanPredictor::OnModel& on_model = {});

  SettingsOwner settings_;
  ScanPredictor predictor_;
  bool accumulate_deformation_;
  bool has_counter_surface_ = false;
  std::optional<LastScan> last_;
  KnownFigures figures_;
  std::uint64_t unstamped_ = 0;  ///< scans without a stamp so far
  PartScans parts_{kMostParts, kMostScansOfAPart};
  std::deque<ScanOfPart> newest_of_parts_;  ///< that of the part that was scanned last at the front
  Wear wear_;                               ///< of the contacts so far
};

}  // namespace mems_stiction
