#pragma once

/// @file
/// The sums over the places of one frame (place_sums.hpp), at any displacement and in any order; or
/// of an area, whose frame holds the highest cells alone (approach/cell_islands.hpp), and what lies
/// below them is known by its gaps (approach/far_gaps.hpp).
///
/// Cells come in by sweeps that move forward; a call that goes back starts them anew, or from
/// mark().

#include <cstdint>
#include <optional>

#include "approach/dale_map.hpp"
#include "approach/far_gaps.hpp"
#include "approach/gap_field.hpp"
#include "approach/gap_order.hpp"
#include "approach/gap_pyramid.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/loads/capillary.hpp"
#include "separation/overlap_sweep.hpp"
#include "separation/patch_forces.hpp"
#include "separation/place_sums.hpp"

namespace mems_stiction {

/// Cells come in reach that are not in the frame. Whoever follows an area's curve goes on with more
/// of its cells.
class CellsMissing : public Error {
 public:
  explicit CellsMissing(double gap);
  /// Cells with a gap below this are needed [m].
  double gap() const { return gap_; }

 private:
  double gap_;
};

/// Of one frame. Keeps its memory between frames.
class FrameSums {
 public:
  /// Field, settings and gaps must outlive the object's use.
  /// - @p far gaps of the cells that are not in the frame, if there are any. Every call then throws
  /// CellsMissing where they would
  ///   come in reach.
  /// - @p flows whether the hardness limits what patches carry
  /// - @p fraction of the cells that will probably come in reach, if it is known
  void start(const GapField& field, const ContactSettings& settings, const FarGaps* far = nullptr,
             bool flows = true, double fraction = 0.0);

  /// The sums over the patches in reach: those of the surfaces brought closer by z0 and a
  /// hysteresis [m].
  /// - @p expected_end where the displacements will probably end [m]: so many cells are put in
  /// order at once when there are
  ///   not enough
  PlaceSums reach(double approach, double hysteresis, double expected_end = 0.0);
  /// Adds the sums over cells and patches that overlap. Attraction counts as if the surfaces were
  /// `hysteresis` [m] closer where that is more.
  void add(double approach, double hysteresis, PlaceSums& sums);
  /// What taking the surfaces apart would cost if they only attracted each other, w summed over the
  /// cells [J].
  double energy(double approach) { return energyAt(law(), approach); }
  /// What taking the surfaces apart would cost by a contact potential alone [J].
  double lastingFieldEnergy(double approach);
  /// That presses the surfaces together, and whose field acts between them.
  const LoadOptions& load() const { return settings_->load; }
  /// That fills narrow gaps.
  const WaterLaw& water() const { return water_; }
  /// d ln/d ln(Hamaker constant) of the attraction [-], with its hysteresis, and of the energy: a
  /// larger one widens the law's range, which pulls more over wide gaps and less near contacts.
  double hamakerExponentOfForce(double approach, double hysteresis);
  double hamakerExponentOfEnergy(double approach);

  /// The patches that overlap, and those in reach.
  OverlapSweep& contactsAt(double approach);
  const OverlapSweep& inReachAt(double approach, double hysteresis);
  /// Cells of the order that overlap come first.
  const LargePageVector<OrderedCell>& orderedCells() const { return order_.cells(); }

  /// From here on these are the sums of surfaces that have been changed where they overlap, which
  /// do not flow any more.
  /// - @p changed called with (ordered cell): its gap from now on, below the approach [m]; within a
  /// patch the order of the
  ///   gaps has not changed
  template <typename Changed>
  void change(double approach, const Changed& changed);
  /// Calls that go back, but not beyond where the last call was, need not start anew from now on.
  void mark();

  const GapField& field() const { return *field_; }
  const PatchForces& patchForces() const { return *patch_forces_; }
  const ContactTraction& law() const { return patch_forces_->law(); }
  /// Number of valid cells.
  std::int64_t validCount() const {
    return field_->validCount() + (far_ != nullptr ? far_->count() : 0);
  }
  /// Of the valid cells [m^2].
  double area() const { return static_cast<double>(validCount()) * field_->cellArea(); }
  /// Sum of the gaps of the valid cells at first touch [m].
  double gapSum() const {
    return field_->meanGap() * field_->validCount() + (far_ != nullptr ? far_->gapSum() : 0.0);
  }
  /// Number of cells with a smaller gap, in order or not, of the field alone.
  double cellsBelow(double approach) const { return order_.cellsBelow(approach); }
  /// Number of cells in contact at which approach/max_contact_fraction is reached.
  std::int64_t contactLimit() const;
  /// An approach that is no larger than where it is reached, and nearly there [m]: costs nothing.
  double approachBeforeLimit() const { return approach_before_limit_; }
  /// Where it is reached [m].
  double limitApproach();
  /// Share of the cells that are in order.
  double orderedFraction() const { return ordered_fraction_; }

 private:
  struct Attraction {
    double adhesion = 0.0;
    double electrostatic = 0.0;
  };

  void startSweeps();
  /// Forward, or back and forward.
  void sweepTo(double approach, OverlapSweep& sweep, const OverlapSweep& marked,
               const OverlapSweep* ahead);
  bool isOrderedUpTo(double gap) const {
    return gap < order_.groupLowerEnd(order_.groupCount()) || ordered_fraction_ >= 1.0;
  }
  /// Brings enough cells into order for this approach, and for the expected one.
  void orderUpTo(double approach, double expected);
  void extend(double fraction);
  void takeChangedGaps(double approach);
  /// Brings the cells that overlap to the front of the order.
  int overlappingAt(double approach) { return approach > 0.0 ? order_.sortBelow(approach) : 0; }
  void addCells(const ContactTraction& law, const OrderedCell* cells, std::size_t count,
                double approach, Attraction& sum) const;
  /// Over the cells, the first `contact_count` ordered ones of which overlap.
  Attraction attractionOver(const ContactTraction& law, double approach, int contact_count) const;
  Attraction attractionAt(const ContactTraction& law, double approach, double hysteresis);
  double energyAt(const ContactTraction& law, double approach);
  /// Sums an energy over the cells apart [J/m^2 times their number].
  /// - @p add_cells(cells, count, sum) one by one; @p of_moments of several, by their gaps and mean
  /// gap less approach
  template <typename AddCells, typename OfMoments>
  double sumApart(double approach, int contact_count, const ContactTraction& law,
                  const AddCells& add_cells, const OfMoments& of_moments) const;
  static void addEnergies(const ContactTraction& law, const OrderedCell* cells, std::size_t count,
                          double approach, double& sum);

  const GapField* field_ = nullptr;
  const FarGaps* far_ = nullptr;
  const ContactSettings* settings_ = nullptr;
  std::optional<PatchForces> patch_forces_;
  std::optional<ContactTraction>
      wider_law_;  ///< with Hamaker constants that are larger by kMoreHamaker
  std::optional<FieldLaw> voltage_;
  WaterLaw water_;
  double approach_before_limit_ = 0.0;
  double most_fraction_ = 1.0;  ///< of the cells that the curve may need
  double ordered_fraction_ = 0.0;
  DaleMap dales_;
  GapOrder order_;
  GapPyramid pyramid_;
  OverlapSweep contacts_;
  OverlapSweep in_reach_;
  OverlapSweep marked_contacts_;
  OverlapSweep marked_in_reach_;
  bool has_mark_ = false;
  std::vector<double> changed_gaps_;
};

template <typename Changed>
void FrameSums::change(double approach, const Changed& changed) {
  const int count = contactsAt(approach).cellCount();
  changed_gaps_.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < changed_gaps_.size(); ++i)
    changed_gaps_[i] = changed(order_.cells()[i]);
  takeChangedGaps(approach);
}

}  // namespace mems_stiction
