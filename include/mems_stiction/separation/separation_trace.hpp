#pragma once

/// @file
/// The force between two surfaces at each approach, from the gap alone: the separation curve (doc/separation_curve.md).
///
///     F(D) = s(D) (sum over cells apart t(d) dA - O(D)) + F_e(D) + F_c(D) - sum over patches P_i(D),   d = g - D - b
///
/// D is the displacement of the upper surface past first touch, below zero apart. F > 0 attracts. P_i is what a patch
/// carries: Hertz by volume and area (overlap_patch.hpp) in series with the layer of the law (contact_traction.hpp), and
/// no more than flow allows. O is what contacts have opened of the gap around them (S8b). s(D) <= 1 is what the bodies'
/// bending leaves of the attraction:
///
///     s = 1 - sum over summits in reach  v_i (1 - c(mu_i)/2) (3/5 + (2/5) v_i)/sqrt(n_i)
///
/// over the patches of the surfaces brought z0 closer, those in reach of the attraction. v_i is a patch's share of the
/// sum of 2 pi R w(gap at its summit), R = A^2/(4 pi V) its radius, n_i the summits in it, mu_i Tabor's parameter of one
/// of them, and c pi Gamma R the pull-off force of one sphere between DMT (c = 2) and JKR (3/2). A bent summit holds on
/// longer: where many share the load, the neighbours make up for two fifths of what each loses. On the way out soft
/// summits hold until they are drawn out by b (S8a); on the way in b is 0.

#include <optional>

#include "mems_stiction/approach/dale_map.hpp"
#include "mems_stiction/approach/gap_field.hpp"
#include "mems_stiction/approach/gap_order.hpp"
#include "mems_stiction/approach/gap_pyramid.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "mems_stiction/separation/attraction_sum.hpp"
#include "mems_stiction/separation/overlap_sweep.hpp"
#include "mems_stiction/separation/patch_forces.hpp"

namespace mems_stiction {

/// The forces at one approach [N].
struct SeparationState {
  double approach = 0.0;       ///< D [m]
  int contact_count = 0;       ///< cells that overlap
  double adhesion = 0.0;       ///< of the cells apart
  double electrostatic = 0.0;  ///< of all cells
  double capillary = 0.0;      ///< of condensed water
  double carried = 0.0;        ///< by all patches
  double hold = 0.0;           ///< how far beyond its place apart a summit still holds on the way out [m]

  double force() const { return adhesion + electrostatic + capillary - carried; }
  /// The same when the loads that brought the surfaces together, voltage too, have been taken away.
  double partingForce() const { return adhesion + capillary - carried; }
};

/// Goes through the approaches of one frame, upward only, or back to one that it has kept. Keeps its memory between
/// frames.
class SeparationTrace {
 public:
  /// Starts apart. Field and settings must outlive the trace's use.
  /// - @p flows whether the hardness limits what patches carry
  void start(const GapField& field, const ContactSettings& settings, bool flows);

  /// The forces at an approach that is no smaller than the last one [m].
  /// - @p expected_end where the curve probably ends [m]: so many cells are put in order at once when there are not enough
  SeparationState at(double approach, double expected_end = 0.0);
  /// What taking the surfaces apart from a state would cost if they only attracted each other [J], where nothing holds on.
  double energyAt(const SeparationState& state) const;
  /// With which power of the Hamaker constant the attraction of a state goes [-], and its energy: a larger one widens the
  /// law's range, which pulls more over wide gaps and less near contacts.
  double hamakerExponentOfForce(const SeparationState& state);
  double hamakerExponentOfEnergy(const SeparationState& state) const;
  /// Back to apart.
  void restart();
  /// The same, on the way out from now on: soft summits that have touched hold longer than they would reach.
  /// - @p rest the approach from which they part [m]
  void startParting(double rest);
  /// Whether some summit was soft enough for that at the approaches so far.
  bool holdsOn() const;
  /// Makes it the trace of surfaces that have been changed where they overlap, from apart, without flow, on the way out.
  /// - @p approach where the trace stands [m]
  /// - @p gaps of the overlapping cells, in the order of orderedCells(), below the approach [m]; of cells in one patch
  ///      the order of the gaps has not changed
  void changeGaps(double approach, const std::vector<double>& gaps);
  /// Marks the approach where the trace stands, and goes back to the marked one.
  void keep();
  void backToKept();

  const PatchForces& patchForces() const { return *patch_forces_; }
  const ContactTraction& law() const { return attraction_->law(); }
  /// What attraction and water together never exceed [N].
  double strongestPull() const;
  /// Number of cells in contact at which approach/max_contact_fraction is reached.
  int contactLimit() const;
  /// An approach that is no larger than where it is reached, and nearly there [m]: costs nothing.
  double approachBeforeLimit() const { return approach_before_limit_; }
  /// Where it is reached [m].
  double limitApproach();
  OverlapSweep& contacts() { return contacts_; }
  /// The patches of the surfaces brought closer by as much as attraction, and summits that hold on, reach: where the trace
  /// stands.
  const OverlapSweep& inReach() const { return in_reach_; }
  /// The cells that overlap come first.
  const LargePageVector<OrderedCell>& orderedCells() const { return order_.cells(); }

 private:
  /// Brings enough cells into order for this approach, and for the expected one.
  void orderUpTo(double approach, double expected);
  void extend(double fraction);
  /// b [m] of summits with this Tabor parameter.
  double holdOf(double tabor_parameter) const;
  /// Takes what is in reach in, and what it holds on with.
  Bending bendingAt(double approach, double expected_end);
  /// Of the cells apart, or held if that is more.
  Attraction attractionAt(const AttractionSum& sum, const SeparationState& state);

  const GapField* field_ = nullptr;
  const ContactSettings* settings_ = nullptr;
  std::optional<AttractionSum> attraction_;
  std::optional<AttractionSum> wider_attraction_;  ///< with a Hamaker constant that is larger by kMoreHamaker
  WaterLaw water_;
  std::optional<PatchForces> patch_forces_;
  double approach_before_limit_ = 0.0;
  double most_fraction_ = 1.0;  ///< of the cells that the curve may need
  double ordered_fraction_ = 0.0;
  double longest_hold_ = 0.0;  ///< b of the softest summits on the way out, 0 on the way in [m]
  double rest_ = 0.0;          ///< from which the surfaces part [m]
  double softest_ = 0.0;       ///< largest mean Tabor parameter of summits in reach so far
  DaleMap dales_;
  GapOrder order_;
  GapPyramid pyramid_;
  OverlapSweep contacts_;
  OverlapSweep in_reach_;
  OverlapSweep kept_contacts_;
  OverlapSweep kept_in_reach_;
};

}  // namespace mems_stiction
