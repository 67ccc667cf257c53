#include "mems_stiction/separation/separation_trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mems_stiction/base/constants.hpp"
#include "mems_stiction/mechanics/transition.hpp"

namespace mems_stiction {
namespace {

/// Share of the cells that is put in order first, and by how much more when that does not suffice.
constexpr double kFirstFraction = 1.0 / 64.0;
constexpr double kMoreCells = 4.0;
/// Maugis' parameter over Tabor's, for this law: with Maugis' own 1.157 the pull-off force of a sphere lies up to 5 %
/// below that of the 9-3 law, with 0.56 it is that of the law, and in between within 3 % of it and 5 % of his.
constexpr double kMaugisPerTabor = 0.75;
/// What a summit loses by bending even where its neighbours hold on [-], and what it loses more when it stands alone.
constexpr double kLossInCompany = 0.6;
/// P/(Ha A) at which a paraboloid begins to flow: its largest pressure is three times P over the overlapped area.
constexpr double kFlowOnset = 1.0 / 3.0;

}  // namespace

void SeparationTrace::start(const GapField& field, const ContactSettings& settings, bool flows) {
  field_ = &field;
  settings_ = &settings;
  attraction_.emplace(settings.interface, settings.load.voltage, field.cellArea());
  water_ = CapillaryForce(settings.capillary);
  const ContactPair pair(settings.lower, settings.upper);
  contact_modulus_ = pair.contact_modulus;
  const bool can_flow = flows && settings.deformation == Deformation::kThreeRegimes;
  hardness_ = can_flow ? pair.hardness : std::numeric_limits<double>::infinity();
  load_factor_ = 0.6 * contact_modulus_ * std::sqrt(kPi * field.cellArea());
  const double strain = law().workOfAdhesion() / (contact_modulus_ * law().range());
  maugis_factor_ = kMaugisPerTabor * kMaugisPerTabor * kMaugisPerTabor * strain * strain / law().range();
  build(kFirstFraction);
  restart();
}

void SeparationTrace::restart() {
  contacts_.start(*field_, settings_->approach.connectivity);
  in_reach_.start(*field_, settings_->approach.connectivity);
}

void SeparationTrace::build(double fraction) {
  ordered_fraction_ = std::min(1.0, fraction);
  order_.build(*field_, ordered_fraction_);
  pyramid_.prepare(order_);
}

void SeparationTrace::orderUpTo(double approach) {
  while (approach >= order_.groupLowerEnd(order_.groupCount()) && ordered_fraction_ < 1.0) {
    build(kMoreCells * ordered_fraction_);
  }
}

int SeparationTrace::contactLimit() const {
  const double wanted = std::ceil(settings_->approach.max_contact_fraction * field_->validCount());
  return std::clamp(static_cast<int>(wanted), 1, field_->validCount());
}

double SeparationTrace::limitApproach() {
  const int count = contactLimit();
  if (static_cast<int>(order_.cells().size()) < count) build(settings_->approach.max_contact_fraction);
  order_.sortBetween(count - 1, count);
  // the next number: cells with just this gap are in
  return std::nextafter(order_.cells()[static_cast<std::size_t>(count - 1)].gap, GapField::kInvalidGap);
}

SeparationState SeparationTrace::at(double approach) {
  orderUpTo(approach + law().range());
  SeparationState state;
  state.approach = approach;
  state.contact_count = contacts_.advanceTo(approach, order_);
  const Attraction attraction = attraction_->forces(pyramid_, approach, state.contact_count);
  state.electrostatic = attraction.electrostatic;
  state.capillary = capillaryForce(order_, approach, state.contact_count, water_, field_->cellArea());
  if (law().attracts()) {
    in_reach_.advanceTo(approach + law().range(), order_);
    state.adhesion = attraction.adhesion * bendingFactor(approach);
  }
  for (const std::int32_t id : contacts_.livePatches()) {
    state.carried += loadOf(contacts_.patch(id), approach).carried;
  }
  return state;
}

Attraction SeparationTrace::energiesAt(const SeparationState& state) const {
  return attraction_->all(pyramid_, state.approach, state.contact_count);
}

PatchLoad SeparationTrace::loadOf(const OverlapPatch& patch, double approach) const {
  const double area = patch.cells * field_->cellArea();
  PatchLoad load;
  const double pressure = std::max(load_factor_ * patch.loadTerm(approach), 0.0) / area;
  load.elastic = area * law().pressureInSeries(pressure, patch.depth(approach));
  load.carried = load.elastic;
  const double fullness = load.elastic / (hardness_ * area);
  if (fullness > kFlowOnset) {
    // Under a pressure Ha everywhere the edge of the contact sinks in by (4/pi) Ha a/E, and what touches is that much
    // less than the overlap: y + b sqrt(y) = 1 for y = P/(Ha A), b = 8 sqrt(2)/(3 pi^2)/fullness = 0.382/fullness; with
    // 0.385 the curve has no step at the onset.
    const double b = 2.0 / 3.0 * std::sqrt(kFlowOnset) / fullness;
    const double root = std::sqrt(1.0 + 0.25 * b * b) - 0.5 * b;
    load.carried = hardness_ * area * root * root;
  }
  return load;
}

double SeparationTrace::pullOffPrefactor(double radius) const {
  return maugis::fittedPullOffPrefactor(std::cbrt(maugis_factor_ * radius));
}

double SeparationTrace::bendingFactor(double approach) const {
  const double reach = approach + law().range();
  double weights = 0.0;
  double losses = 0.0;        // of summits in company
  double losses_alone = 0.0;  // what the same lose more when they stand alone, times their weight
  for (const std::int32_t id : in_reach_.livePatches()) {
    const OverlapPatch& patch = in_reach_.patch(id);
    const double radius = patch.radius(reach, field_->cellArea());
    const double weight = radius * law().energy(std::max(patch.first_gap - approach, 0.0));
    const double lost = weight * (1.0 - 0.5 * pullOffPrefactor(radius / patch.summits)) / std::sqrt(patch.summits);
    weights += weight;
    losses += lost;
    losses_alone += lost * weight;
  }
  if (!(weights > 0.0)) return 1.0;
  return 1.0 - (kLossInCompany * losses + (1.0 - kLossInCompany) * losses_alone / weights) / weights;
}

}  // namespace mems_stiction
