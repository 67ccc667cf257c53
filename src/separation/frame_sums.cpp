#include "separation/frame_sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "loads/force_range.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/packet.hpp"
#include "settings/time_limit.hpp"

namespace mems_stiction {
namespace {

/// Share of the cells that is put in order first, and by how much more when that does not suffice.
constexpr double kFirstFraction = 1.0 / 64.0;
constexpr double kMoreCells = 8.0;
/// By how much the Hamaker constant is changed to see what that does.
constexpr double kMoreHamaker = 1.02;

/// The law if all Hamaker constants were larger, those under films too.
ContactTraction withMoreHamaker(const ContactSettings& settings) {
  InterfaceOptions interface = settings.interface;
  Material lower = settings.lower;
  Material upper = settings.upper;
  for (double* const constant :
       {&interface.hamaker_constant, &lower.hamaker_constant, &upper.hamaker_constant}) {
    *constant *= kMoreHamaker;
  }
  return ContactTraction(interface, lower, upper);
}

double exponentOf(double with_more_hamaker, double value) {
  return value > 0.0 ? std::log(with_more_hamaker / value) / std::log(kMoreHamaker) : 0.0;
}

PyramidRule ruleOf(const ContactTraction& law) { return {0.0, law.range(), law.steepness()}; }

}  // namespace

CellsMissing::CellsMissing(double gap)
    : Error("cells with gaps up to " + numberText(gap) +
            " m come in reach and are not in the frame"),
      gap_(gap) {}

void FrameSums::start(const GapField& field, const ContactSettings& settings, const FarGaps* far,
                      bool flows, double fraction) {
  field_ = &field;
  far_ = far;
  settings_ = &settings;
  patch_forces_.emplace(settings, field.cellArea(), flows);
  wider_law_.emplace(withMoreHamaker(settings));
  voltage_.emplace(fieldLaw(settings.load.fieldVoltage(), settings.interface));
  water_ = settings.capillary.law();
  dales_.start(field);
  ordered_fraction_ = std::max(kFirstFraction, fraction);
  order_.build(field, ordered_fraction_, 0.0, &dales_);
  pyramid_.prepare(order_);
  // if the limit lies beyond the frame, cells will be missing before it is reached
  const std::int64_t limit = contactLimit();
  approach_before_limit_ = limit <= field.validCount()
                               ? order_.lowerEndAt(static_cast<int>(limit - 1))
                               : std::numeric_limits<double>::infinity();
  const double farthest = approach_before_limit_ + order_.bucketWidth() + law().range();
  most_fraction_ = std::min(1.0, order_.cellsBelow(farthest) / field.validCount());
  startSweeps();
}

void FrameSums::takeChangedGaps(double approach) {
  // where dales lie and which cells meet others stays as it was
  order_.changeGaps(approach, changed_gaps_);
  pyramid_.prepare(order_);
  patch_forces_.emplace(*settings_, field_->cellArea(), false);
  startSweeps();
}

void FrameSums::startSweeps() {
  has_mark_ = false;
  contacts_.start(*field_, dales_, settings_->approach.connectivity);
  in_reach_.start(*field_, dales_, settings_->approach.connectivity);
}

void FrameSums::mark() {
  marked_contacts_ = contacts_;
  marked_in_reach_ = in_reach_;
  has_mark_ = true;
}

void FrameSums::sweepTo(double approach, OverlapSweep& sweep, const OverlapSweep& marked,
                        const OverlapSweep* ahead) {
  const double wanted = std::max(approach, 0.0);  // no gap is below 0
  if (sweep.approach() > wanted) {
    if (has_mark_ && marked.approach() <= wanted) {
      sweep = marked;
    } else {
      sweep.start(*field_, dales_, settings_->approach.connectivity);
    }
  }
  sweep.advanceTo(approach, order_, ahead);
}

OverlapSweep& FrameSums::contactsAt(double approach) {
  orderUpTo(approach, approach);
  sweepTo(approach, contacts_, marked_contacts_, law().attracts() ? &in_reach_ : nullptr);
  return contacts_;
}

const OverlapSweep& FrameSums::inReachAt(double approach, double hysteresis) {
  const double reach = approach + law().range() + hysteresis;
  orderUpTo(reach, reach);
  if (law().attracts()) sweepTo(reach, in_reach_, marked_in_reach_, nullptr);
  return in_reach_;
}

void FrameSums::extend(double fraction) {
  ordered_fraction_ = fraction;
  order_.extend(*field_, fraction);
  pyramid_.prepare(order_);
}

void FrameSums::orderUpTo(double approach, double expected) {
  if (far_ != nullptr && approach > far_->first()) throw CellsMissing(approach);
  while (!isOrderedUpTo(approach)) {
    const double more = std::max(kMoreCells * ordered_fraction_,
                                 order_.cellsBelow(expected) / field_->validCount());
    // the curve ends at the limit of contact, but for the step that passes it
    extend(ordered_fraction_ < most_fraction_ ? std::min(more, most_fraction_)
                                              : std::min(more, 1.0));
  }
}

std::int64_t FrameSums::contactLimit() const {
  const std::int64_t valid_count = validCount();
  const double wanted =
      std::ceil(settings_->approach.max_contact_fraction * static_cast<double>(valid_count));
  return std::clamp(static_cast<std::int64_t>(wanted), std::int64_t{1}, valid_count);
}

double FrameSums::limitApproach() {
  if (contactLimit() > field_->validCount()) throw CellsMissing(far_->first());
  const int count = static_cast<int>(contactLimit());
  if (static_cast<int>(order_.cells().size()) < count) extend(most_fraction_);
  order_.sortBetween(count - 1, count);
  // the next number: cells with just this gap are in
  return std::nextafter(order_.cells()[static_cast<std::size_t>(count - 1)].gap,
                        GapField::kInvalidGap);
}

PlaceSums FrameSums::reach(double approach, double hysteresis, double expected_end) {
  TimeLimit::check();
  PlaceSums sums;
  const double range = law().range() + hysteresis;
  orderUpTo(approach + range, expected_end + range);
  if (law().attracts())
    patch_forces_->addReach(inReachAt(approach, hysteresis), approach + hysteresis, sums);
  return sums;
}

void FrameSums::add(double approach, double hysteresis, PlaceSums& sums) {
  const OverlapSweep& contacts = contactsAt(approach);
  sums.contact_count += contacts.cellCount();
  patch_forces_->addContacts(contacts, approach, sums);
  const Attraction attraction = attractionAt(law(), approach, hysteresis);
  sums.adhesion += attraction.adhesion;
  sums.electrostatic += attraction.electrostatic;
  sums.capillary +=
      capillaryForce(order_, approach, contacts.cellCount(), water_, field_->cellArea());
  if (far_ != nullptr && water_.isOn()) {
    sums.capillary +=
        far_->cellsBelow(approach + water_.gapLimit()) * (water_.pressure() * field_->cellArea());
  }
}

MEMS_STICTION_VECTORIZED void FrameSums::addCells(const ContactTraction& law,
                                                  const OrderedCell* cells, std::size_t count,
                                                  double approach, Attraction& sum) const {
  const FieldLaw& voltage = *voltage_;
  Packet adhesion = 0.0;
  Packet field = 0.0;
  const std::size_t in_fours = visitFours(cells, count, approach, [&](const Packet& gap) {
    adhesion += law.traction(gap);
    field += 1.0 / voltage.squaredDistance(gap);
  });
  sum.adhesion += adhesion.sum();
  if (voltage.isOn()) sum.electrostatic += field.sum();
  for (std::size_t i = in_fours; i < count; ++i) {
    const double gap = cells[i].gap - approach;
    sum.adhesion += law.traction(gap);
    if (voltage.isOn()) sum.electrostatic += 1.0 / voltage.squaredDistance(gap);
  }
}

MEMS_STICTION_VECTORIZED FrameSums::Attraction FrameSums::attractionOver(const ContactTraction& law,
                                                                         double approach,
                                                                         int contact_count) const {
  const FieldLaw& voltage = *voltage_;
  Attraction sum;
  const auto add_moments = [&](const GapMoments& gaps) {
    const double gap = gaps.mean - approach;
    sum.adhesion += gaps.count * law.meanTraction(gap, gaps.variance);
    if (!voltage.isOn()) return;
    const double square = voltage.squaredDistance(gap);
    sum.electrostatic += gaps.count / square * (1.0 + 3.0 * gaps.variance / square);
  };
  pyramid_.visit(
      approach, contact_count, ruleOf(law),
      [&](const OrderedCell* cells, std::size_t count) {
        addCells(law, cells, count, approach, sum);
      },
      add_moments);
  if (far_ != nullptr) std::for_each(far_->moments().begin(), far_->moments().end(), add_moments);
  const double cell_area = field_->cellArea();
  sum.adhesion *= cell_area;
  sum.electrostatic *= cell_area * voltage.factor();
  if (voltage.isOn()) sum.electrostatic += contact_count * cell_area * voltage.pressure(0.0);
  return sum;
}

FrameSums::Attraction FrameSums::attractionAt(const ContactTraction& law, double approach,
                                              double hysteresis) {
  Attraction attraction = attractionOver(law, approach, overlappingAt(approach));
  if (hysteresis > 0.0) {
    const double longest = approach + hysteresis;
    attraction.adhesion = std::max(attraction.adhesion,
                                   attractionOver(law, longest, overlappingAt(longest)).adhesion);
  }
  return attraction;
}

template <typename AddCells, typename OfMoments>
double FrameSums::sumApart(double approach, int contact_count, const ContactTraction& law,
                           const AddCells& add_cells, const OfMoments& of_moments) const {
  double sum = 0.0;
  const auto add_moments = [&](const GapMoments& gaps) {
    sum += gaps.count * of_moments(gaps, gaps.mean - approach);
  };
  pyramid_.visit(
      approach, contact_count, ruleOf(law),
      [&](const OrderedCell* cells, std::size_t count) { add_cells(cells, count, sum); },
      add_moments);
  if (far_ != nullptr) std::for_each(far_->moments().begin(), far_->moments().end(), add_moments);
  return sum;
}

MEMS_STICTION_VECTORIZED void FrameSums::addEnergies(const ContactTraction& law,
                                                     const OrderedCell* cells, std::size_t count,
                                                     double approach, double& sum) {
  const std::size_t in_fours = visitFours(cells, count, approach, [&](const Packet& gap) {
    const Packet energy = law.energy(gap);
    for (std::size_t i = 0; i < Packet::kCount; ++i) sum += energy[i];
  });
  for (std::size_t i = in_fours; i < count; ++i) sum += law.energy(cells[i].gap - approach);
}

double FrameSums::energyAt(const ContactTraction& law, double approach) {
  const int contact_count = overlappingAt(approach);
  const double sum = sumApart(
      approach, contact_count, law,
      [&](const OrderedCell* cells, std::size_t count, double& energy) {
        addEnergies(law, cells, count, approach, energy);
      },
      [&](const GapMoments& gaps, double gap) { return law.meanEnergy(gap, gaps.variance); });
  return field_->cellArea() * (sum + contact_count * law.workOfAdhesion());
}

double FrameSums::lastingFieldEnergy(double approach) {
  const double share = load().lastingFieldShare();
  if (share == 0.0) return 0.0;
  const FieldLaw& field = *voltage_;
  const int contact_count = overlappingAt(approach);
  const double sum = sumApart(
      approach, contact_count, law(),
      [&](const OrderedCell* cells, std::size_t count, double& energy) {
        for (std::size_t i = 0; i < count; ++i) energy += field.energy(cells[i].gap - approach);
      },
      [&](const GapMoments& gaps, double gap) {
        return field.energy(gap) - 0.5 * field.slope(gap) * gaps.variance;
      });
  return share * field_->cellArea() * (sum + contact_count * field.energy(0.0));
}

double FrameSums::hamakerExponentOfForce(double approach, double hysteresis) {
  return exponentOf(attractionAt(*wider_law_, approach, hysteresis).adhesion,
                    attractionAt(law(), approach, hysteresis).adhesion);
}

double FrameSums::hamakerExponentOfEnergy(double approach) {
  return exponentOf(energyAt(*wider_law_, approach), energyAt(law(), approach));
}

}  // namespace mems_stiction
