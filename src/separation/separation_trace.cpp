#include "mems_stiction/separation/separation_trace.hpp"

#include <algorithm>
#include <cmath>

#include "mems_stiction/base/time_limit.hpp"

namespace mems_stiction {
namespace {

/// Share of the cells that is put in order first, and by how much more when that does not suffice.
constexpr double kFirstFraction = 1.0 / 64.0;
constexpr double kMoreCells = 8.0;
/// A summit of Tabor's parameter mu lets go 0.77 mu z0 before it would touch (JKR, doc/separation_curve.md); up to 1/2
/// the law's own range does as much.
constexpr double kHoldPerTabor = 0.77;
constexpr double kStiffTabor = 0.5;
constexpr double kLongestHold = 4.0;  ///< of z0
/// However the gap opens around contacts, they keep this share of the attraction: that of Hertz' contact.
constexpr double kLeastShare = 0.5;
/// By how much the Hamaker constant is changed to see what that does.
constexpr double kMoreHamaker = 1.02;

InterfaceOptions withMoreHamaker(InterfaceOptions interface) {
  interface.hamaker_constant *= kMoreHamaker;
  return interface;
}

double exponentOf(double with_more_hamaker, double value) {
  return value > 0.0 ? std::log(with_more_hamaker / value) / std::log(kMoreHamaker) : 0.0;
}

}  // namespace

void SeparationTrace::start(const GapField& field, const ContactSettings& settings, bool flows) {
  field_ = &field;
  settings_ = &settings;
  attraction_.emplace(settings.interface, settings.load.voltage, field.cellArea());
  wider_attraction_.emplace(withMoreHamaker(settings.interface), 0.0, field.cellArea());
  water_ = settings.capillary.law();
  patch_forces_.emplace(settings, field.cellArea(), flows);
  dales_.start(field);
  ordered_fraction_ = kFirstFraction;
  order_.build(field, ordered_fraction_, 0.0, &dales_);
  pyramid_.prepare(order_);
  approach_before_limit_ = order_.lowerEndAt(contactLimit() - 1);
  const double farthest = approach_before_limit_ + order_.bucketWidth() + law().range();
  most_fraction_ = std::min(1.0, order_.cellsBelow(farthest) / field.validCount());
  softest_ = 0.0;
  longest_hold_ = 0.0;
  restart();
}

void SeparationTrace::startParting(double rest) {
  rest_ = rest;
  longest_hold_ = holdOf(softest_);
  restart();
}

void SeparationTrace::restart() {
  contacts_.start(*field_, dales_, settings_->approach.connectivity);
  in_reach_.start(*field_, dales_, settings_->approach.connectivity);
}

void SeparationTrace::changeGaps(double approach, const std::vector<double>& gaps) {
  // where dales lie and which cells meet others stays as it was
  order_.changeGaps(approach, gaps);
  pyramid_.prepare(order_);
  patch_forces_.emplace(*settings_, field_->cellArea(), false);
  startParting(approach);
}

void SeparationTrace::keep() {
  kept_contacts_ = contacts_;
  kept_in_reach_ = in_reach_;
}

void SeparationTrace::backToKept() {
  contacts_ = kept_contacts_;
  in_reach_ = kept_in_reach_;
}

void SeparationTrace::extend(double fraction) {
  ordered_fraction_ = fraction;
  order_.extend(*field_, fraction);
  pyramid_.prepare(order_);
}

void SeparationTrace::orderUpTo(double approach, double expected) {
  while (approach >= order_.groupLowerEnd(order_.groupCount()) && ordered_fraction_ < 1.0) {
    const double more = std::max(kMoreCells * ordered_fraction_, order_.cellsBelow(expected) / field_->validCount());
    // the curve ends at the limit of contact, but for the step that passes it
    extend(ordered_fraction_ < most_fraction_ ? std::min(more, most_fraction_) : std::min(more, 1.0));
  }
}

double SeparationTrace::strongestPull() const {
  return (law().strength() + water_.pressure()) * field_->validCount() * field_->cellArea();
}

int SeparationTrace::contactLimit() const {
  const double wanted = std::ceil(settings_->approach.max_contact_fraction * field_->validCount());
  return std::clamp(static_cast<int>(wanted), 1, field_->validCount());
}

double SeparationTrace::limitApproach() {
  const int count = contactLimit();
  if (static_cast<int>(order_.cells().size()) < count) extend(most_fraction_);
  order_.sortBetween(count - 1, count);
  // the next number: cells with just this gap are in
  return std::nextafter(order_.cells()[static_cast<std::size_t>(count - 1)].gap, GapField::kInvalidGap);
}

SeparationState SeparationTrace::at(double approach, double expected_end) {
  TimeLimit::check();
  SeparationState state;
  state.approach = approach;
  const Bending bending = bendingAt(approach, expected_end);
  // what has not been nearer than at rest holds nothing
  const double hold = std::min(holdOf(bending.tabor_parameter), longest_hold_);
  state.hold = std::clamp(rest_ - approach, 0.0, hold);
  state.contact_count = contacts_.advanceTo(approach, order_, law().attracts() ? &in_reach_ : nullptr);
  const PatchSums patches = patch_forces_->sums(contacts_, approach);
  state.carried = patches.carried;
  const Attraction attraction = attractionAt(*attraction_, state);
  state.electrostatic = attraction.electrostatic;
  state.capillary = capillaryForce(order_, approach, state.contact_count, water_, field_->cellArea());
  state.adhesion = bending.factor * std::max(attraction.adhesion - patches.opened, kLeastShare * attraction.adhesion);
  return state;
}

Bending SeparationTrace::bendingAt(double approach, double expected_end) {
  const double reach = law().range() + longest_hold_;
  orderUpTo(approach + reach, expected_end + reach);
  if (!law().attracts()) return {};
  in_reach_.advanceTo(approach + reach, order_);
  const Bending bending = patch_forces_->bending(in_reach_, approach + longest_hold_);
  softest_ = std::max(softest_, bending.tabor_parameter);
  return bending;
}

double SeparationTrace::holdOf(double tabor_parameter) const {
  if (!(tabor_parameter > kStiffTabor)) return 0.0;  // nor if it is not known
  return law().range() * std::min(kHoldPerTabor * (tabor_parameter - kStiffTabor), kLongestHold);
}

bool SeparationTrace::holdsOn() const { return softest_ > kStiffTabor; }

Attraction SeparationTrace::attractionAt(const AttractionSum& sum, const SeparationState& state) {
  Attraction attraction = sum.forces(pyramid_, state.approach, state.contact_count);
  if (state.hold > 0.0) {
    const double held = state.approach + state.hold;
    const int touching = held > 0.0 ? order_.sortBelow(held) : 0;
    attraction.adhesion = std::max(attraction.adhesion, sum.forces(pyramid_, held, touching).adhesion);
  }
  return attraction;
}

double SeparationTrace::energyAt(const SeparationState& state) const {
  return attraction_->energy(pyramid_, state.approach, state.contact_count);
}

double SeparationTrace::hamakerExponentOfForce(const SeparationState& state) {
  return exponentOf(attractionAt(*wider_attraction_, state).adhesion, attractionAt(*attraction_, state).adhesion);
}

double SeparationTrace::hamakerExponentOfEnergy(const SeparationState& state) const {
  return exponentOf(wider_attraction_->energy(pyramid_, state.approach, state.contact_count), energyAt(state));
}

}  // namespace mems_stiction
