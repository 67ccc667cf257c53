#pragma once

/// @file
/// Two surfaces that come to rest on each other along the separation curve, their contacts there,
/// and how they part when these contacts let go one by one: of a frame, or of an area by its
/// highest cells (frame_sums.hpp).
///
///     ContactCurve curve;
///     curve.comeToRest(field, settings);
///     for (const auto& contact : curve.contacts()) ...
///     curve.part();
///     use(curve.byContacts().force);

#include <vector>

#include "separation/chosen_constants.hpp"
#include "separation/flowing_places.hpp"
#include "separation/remaining_overlap.hpp"
#include "separation/separation_curve.hpp"
#include "separation/unloading.hpp"

namespace mems_stiction {

/// Keeps its memory between calls.
class ContactCurve {
 public:
  /// One contact at rest.
  struct Contact {
    PatchLoad load;
    RemainingOverlap remaining;
    double area = 0.0;              ///< real [m^2]
    double composite_radius = 0.0;  ///< [m]
    Regime regime = Regime::kElastic;
    bool is_of_places = false;  ///< whether the area is that of the places that a pressure presses
  };

  /// Field, settings and gaps must outlive the object's use.
  /// - @p far as in FrameSums
  void comeToRest(const GapField& field, const ContactSettings& settings,
                  const FarGaps* far = nullptr);
  /// The same of surfaces that have flowed place by place under these settings, and bear what made
  /// them flow without flowing any more.
  /// - @p flow of the places of `field`; both must outlive the object's use
  void comeToRest(const GapField& field, const ContactSettings& settings,
                  const FlowingPlaces& flow);
  /// The same of the surfaces that came to rest last, no place of which has turned out to flow.
  void comeToRestElastically(const GapField& field, const ContactSettings& settings);
  /// From then on frame() is that of the surfaces as flow has changed them.
  /// - @p force_from_next_rest forceFromNextRest() of the loading branch; 0 where they are not
  /// asked for another rest [N]
  void part(double force_from_next_rest = 0.0);

  FrameSums& frame() { return frame_; }
  const FrameSums& frame() const { return frame_; }
  const SeparationCurve& loading() const { return loading_; }
  const SeparationState& rest() const { return loading_.rest(); }
  /// Share of the area that is in contact or within z0 of it at rest [-].
  double joinedShare() {
    return static_cast<double>(frame_.inReachAt(rest().approach, 0.0).cellCount()) /
           static_cast<double>(frame_.validCount());
  }
  /// At rest, in the order of the sweep's patches there.
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// Whether places of contacts at rest may flow. Loads press wide contacts, of whose overlap a
  /// small part touches; what adhesion alone draws together flows from its tops on.
  bool mayFlow(const LoadOptions& load) const {
    return largest_fullness_ > (load.presses() ? chosen::kMayFlow : PatchForces::kFlowOnset);
  }
  /// Whether contacts at rest have flowed, each as a whole.
  bool flowsByPatches() const { return has_flowed_ || largest_fullness_ > PatchForces::kFlowOnset; }
  /// Mean gap of the cells apart at rest [m]; 0 when every cell touches.
  double meanGap() const { return mean_gap_; }
  /// -dF/dD at rest [N/m]; NaN if it is not known.
  double stiffness() const;
  /// The loading branch as a list.
  void appendLoading(std::vector<SeparationCurvePoint>& points) const;

  /// What parting by contacts takes; contact area from comeToRest(), the rest from part().
  const Unloading& byContacts() const { return by_contacts_; }
  /// Of part(): the loading branch where it is no other.
  const SeparationCurve& unloading() const { return has_unloading_ ? unloading_ : loading_; }
  /// The contacts that hold at the pull-off: patches within reach of the attraction there.
  const OverlapSweep& inReachAtPullOff() {
    return frame_.inReachAt(unloading().pull_off_approach, unloading().branch.largest_hysteresis);
  }
  /// By dale, at rest; of the dales that were in contact where surfaces have flowed.
  const std::vector<Regime>& regimeOfDale() const { return regime_of_dale_; }

 private:
  void start(const GapField& field, const ContactSettings& settings, const FarGaps* far,
             const FlowingPlaces* flow, bool flows_by_patches, double fraction);
  /// Of the cells, that come in reach again about.
  double reachedFraction();
  /// @return sum of the gaps of the cells in contact [m]
  double takeContacts();
  /// Regimes of contacts by the share of their load that places bear which have flowed, and their
  /// areas, which contain all that is pressed.
  void takeFlow(const FlowingPlaces& flow);
  /// Lets the contact area grow where a load is more than the contacts carry at the end of the
  /// search: all of them as one patch, whose overlap is that of the heights, and at least that of a
  /// random surface of these slopes.
  /// - @p gaps that takeContacts() has summed
  void growTo(double load, double gaps);
  /// Where the unloading branch is another than the loading branch: of surfaces that have flowed,
  /// or with soft summits, which let go later (adhesive hysteresis).
  void followChanged(const Branch& branch);

  FrameSums frame_;
  double cell_area_ = 0.0;  ///< [m^2]
  SeparationCurve loading_;
  std::vector<Contact> contacts_;
  std::vector<PatchLoad> loads_;  ///< in the same order
  double mean_gap_ = 0.0;
  double largest_fullness_ = 0.0;
  const FlowingPlaces* flow_ = nullptr;  ///< place by place, before the loading branch
  bool has_flowed_ = false;              ///< as patches, at rest
  SeparationCurve unloading_;            ///< where it is another than the loading branch
  bool has_unloading_ = false;
  Unloading by_contacts_;
  std::vector<Regime> regime_of_dale_;
};

}  // namespace mems_stiction
