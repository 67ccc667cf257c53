#include "separation/contact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "numeric/constants.hpp"
#include "numeric/packet.hpp"
#include "separation/real_area.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

Regime regimeOf(const PatchLoad& load, double area, double hardness) {
  if (load.elasticShare() >= chosen::kRegimeShare) return Regime::kElastic;
  return load.carried >= chosen::kRegimeShare * hardness * area ? Regime::kPlastic
                                                                : Regime::kElastoPlastic;
}

/// So many times the cells that came in reach without flow are put in order at once: it decides on
/// time alone.
constexpr double kMoreInReach = 2.0;

/// Squares of differences between cells that have a gap, and how many there are.
struct Differences {
  double squares = 0.0;
  double count = 0.0;
};

MEMS_STICTION_VECTORIZED void addDifferences(const double* gaps, const double* others,
                                             std::size_t count, Differences& differences) {
  constexpr double kNone = GapField::kInvalidGap;
  Packet squares = 0.0;
  Packet counted = 0.0;
  const auto add = [&](const Packet& difference) {
    const Packet square = difference * difference;
    const PacketMask is_known = square < kNone;
    squares += select(is_known, square, Packet(0.0));
    counted += oneWhere(is_known);
  };
  const std::size_t in_packets = count / Packet::kCount * Packet::kCount;
  for (std::size_t i = 0; i < in_packets; i += Packet::kCount)
    add(Packet::load(gaps + i) - Packet::load(others + i));
  const std::size_t rest = count - in_packets;
  add(Packet::loadFirst(gaps + in_packets, rest, kNone) -
      Packet::loadFirst(others + in_packets, rest, 0.0));
  differences.squares += squares.sum();
  differences.count += counted.sum();
}

/// Rms slope of the gap from cell to cell [-].
double rmsSlope(const GapField& field) {
  const auto cols = static_cast<std::size_t>(field.cols());
  std::vector<double> row(cols);
  std::vector<double> above(cols, GapField::kInvalidGap);
  Differences along;
  Differences down;
  for (int i = 0; i < field.rows(); ++i) {
    field.gapsOfRow(i, row.data());
    addDifferences(row.data(), above.data(), cols, down);
    addDifferences(row.data() + 1, row.data(), cols - 1, along);
    row.swap(above);
  }
  const auto meanSquare = [](const Differences& all, double pitch) {
    return all.squares / (std::max(all.count, 1.0) * pitch * pitch);
  };
  return std::sqrt(meanSquare(along, field.pitchX()) + meanSquare(down, field.pitchY()));
}

/// Where the patches' approximations weigh most: contacts as wide as a0, which part by their edges,
/// and a force that is the difference of larger ones, so that what is out in these weighs more in
/// it. Or where the surfaces may have come to another rest, or what is out in the load of the
/// contacts decides how near to it they part.
/// - @p exponent of the force with all that attracts: 1 where nothing is subtracted
const char* doubtOf(const SeparationCurve& curve, double exponent, double force_from_next_rest) {
  if (force_from_next_rest > chosen::kDoubtedFactor * curve.pull_off_force) {
    return "hardly anything keeps the surfaces from a nearer rest, from which they part with a "
           "larger force";
  }
  const SeparationState& strongest = curve.states[curve.strongest];
  if (!(strongest.adhesion > 0.0)) return nullptr;
  const double excess = std::max(0.0, exponent - 1.0);
  if (strongest.width + excess > chosen::kDoubtedContacts) {
    return strongest.width > excess
               ? "contacts that hold are so wide that they part by cracks from their edges"
               : "where the force is largest it is a difference of larger forces";
  }
  return hangsOnWhatIsCarried(curve)
             ? "a little less carried by the contacts would leave a larger force near their rest"
             : nullptr;
}

}  // namespace

void ContactCurve::comeToRest(const GapField& field, const ContactSettings& settings,
                              const FarGaps* far) {
  start(field, settings, far, nullptr, true, 0.0);
}

void ContactCurve::comeToRest(const GapField& field, const ContactSettings& settings,
                              const FlowingPlaces& flow) {
  start(field, settings, nullptr, &flow, false, reachedFraction());
}

void ContactCurve::comeToRestElastically(const GapField& field, const ContactSettings& settings) {
  start(field, settings, nullptr, nullptr, false, reachedFraction());
}

double ContactCurve::reachedFraction() {
  const double reached = frame_.cellsBelow(rest().approach + frame_.law().range());
  const double fraction = kMoreInReach * reached / static_cast<double>(frame_.validCount());
  return std::min(fraction, frame_.orderedFraction());
}

void ContactCurve::start(const GapField& field, const ContactSettings& settings, const FarGaps* far,
                         const FlowingPlaces* flow, bool flows_by_patches, double fraction) {
  flow_ = flow;
  cell_area_ = field.cellArea();
  has_unloading_ = false;
  frame_.start(field, settings, far, flows_by_patches, fraction);
  followCurve(frame_, settings, loading_);
  const double gaps = takeContacts();
  regime_of_dale_.clear();
  if (flow != nullptr) takeFlow(*flow);
  if (loading_.status == Status::kBonded && far == nullptr)
    growTo(settings.load.mechanical_load, gaps);
}

void ContactCurve::takeFlow(const FlowingPlaces& flow) {
  OverlapSweep& sweep = frame_.contactsAt(rest().approach);
  const GapField& field = frame_.field();
  std::vector<double> borne(contacts_.size(), 0.0);
  std::vector<double> by_flow(contacts_.size(), 0.0);
  std::vector<int> pressed(contacts_.size(), 0);
  for (int row = 0; row < field.rows(); ++row) {
    flow.visitRow(row, [&](int col, double flowed, double pressure) {
      if (!(pressure > 0.0)) return;
      const std::int32_t id = sweep.patchOf(field.cellAt(row, col));
      if (id < 0) return;
      const auto place = static_cast<std::size_t>(sweep.livePlace(id));
      borne[place] += pressure;
      ++pressed[place];
      if (flowed > 0.0) by_flow[place] += pressure;
    });
  }
  by_contacts_.contact_area = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts_[i].is_of_places = pressed[i] * cell_area_ >= contacts_[i].area;
    contacts_[i].area = std::max(contacts_[i].area, pressed[i] * cell_area_);
    by_contacts_.contact_area += contacts_[i].area;
    if (by_flow[i] >= chosen::kRegimeShare * borne[i] && by_flow[i] > 0.0) {
      contacts_[i].regime = Regime::kPlastic;
    } else if (by_flow[i] > (1.0 - chosen::kRegimeShare) * borne[i]) {
      contacts_[i].regime = Regime::kElastoPlastic;
    }
  }
  regime_of_dale_.assign(static_cast<std::size_t>(sweep.daleCount()), Regime::kElastic);
  for (int dale = 0; dale < sweep.daleCount(); ++dale) {
    const std::int32_t place = sweep.livePlace(sweep.patchOfDale(dale));
    if (place < 0) continue;
    regime_of_dale_[static_cast<std::size_t>(dale)] =
        contacts_[static_cast<std::size_t>(place)].regime;
  }
}

// (S13d), (S13e)
void ContactCurve::growTo(double load, double gaps) {
  const SeparationState& rest = loading_.rest();
  if (!(load > rest.carried)) return;
  const double cells_at_rest = static_cast<double>(rest.contact_count);
  double approach = rest.approach;
  double cells = cells_at_rest;
  double volume = cells * approach - gaps;
  double carried = rest.carried;
  if (!(volume > 0.0)) return;
  const double unit = carried * std::sqrt(cells) / volume;
  while (carried < load && cells < static_cast<double>(frame_.validCount())) {
    const double step = chosen::kStep * (frame_.law().range() + approach);
    const double cells_before = cells;
    const double carried_before = carried;
    approach += step;
    cells = frame_.cellsBelow(approach);
    volume += 0.5 * (cells_before + cells) * step;
    carried = unit * volume / std::sqrt(cells);
    if (carried > load) {
      cells = cells_before +
              (cells - cells_before) * (load - carried_before) / (carried - carried_before);
    }
  }
  const double pressure = load / frame_.area();
  const double slope = rmsSlope(frame_.field());
  by_contacts_.contact_area = std::max(
      by_contacts_.contact_area * cells / cells_at_rest,
      frame_.area() * touchingShare(pressure, frame_.patchForces().contactModulus(), slope));
}

double ContactCurve::takeContacts() {
  const SeparationState& rest = loading_.rest();
  const OverlapSweep& sweep = frame_.contactsAt(rest.approach);
  const PatchForces& forces = frame_.patchForces();
  contacts_.assign(sweep.patches().size(), {});
  forces.loadsOf(sweep, rest.approach, loads_);
  by_contacts_.contact_area = 0.0;
  has_flowed_ = false;
  largest_fullness_ = 0.0;
  double touching = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const OverlapPatch& patch = sweep.patches()[i];
    Contact& contact = contacts_[i];
    const double area = patch.cells * cell_area_;
    contact.load = loads_[i];
    const double radius = patch.radius(rest.approach, cell_area_);
    contact.composite_radius = radius;
    const double rim_force =
        2.0 * kPi * frame_.law().workOfAdhesion() * radius / std::sqrt(patch.summits);
    contact.area =
        cell_area_ *
        realCells({contact.load, static_cast<double>(patch.cells), rim_force,
                   forces.pullOffPrefactor(radius / patch.summits), forces.hardness() * area});
    contact.regime = regimeOf(contact.load, area, forces.hardness());
    by_contacts_.contact_area += contact.area;
    const double area_share = std::max(0.5, contact.load.carried / (forces.hardness() * area));
    const double fullness = contact.load.elastic / (forces.hardness() * area);
    largest_fullness_ = std::max(largest_fullness_, fullness);
    contact.remaining = RemainingOverlap(fullness, area_share, patch.depth(rest.approach),
                                         rest.approach - patch.first_gap);
    has_flowed_ = has_flowed_ || contact.remaining.isChanged();
    touching += patch.gap_sum;
  }
  const std::int64_t apart = frame_.validCount() - rest.contact_count;
  mean_gap_ =
      apart > 0 ? (frame_.gapSum() - touching) / static_cast<double>(apart) - rest.approach : 0.0;
  return touching;
}

double ContactCurve::stiffness() const {
  // a secant to the nearest state that is half a step or more before rest, where the force is known
  // to kAccuracy
  const std::vector<SeparationState>& states = loading_.states;
  const SeparationState& rest = states.back();
  const double least = 0.5 * chosen::kStep * (frame_.law().range() + rest.approach);
  for (auto before = states.rbegin() + 1; before != states.rend(); ++before) {
    const double length = rest.approach - before->approach;
    if (length < least) continue;
    const double stiffness = (before->force() - rest.force()) / length;
    return stiffness > 0.0 ? stiffness : ContactSolution::kUnknown;  // not across a jump
  }
  return ContactSolution::kUnknown;
}

void ContactCurve::appendLoading(std::vector<SeparationCurvePoint>& points) const {
  for (const SeparationState& state : loading_.states)
    points.push_back({state.approach, state.force(), false});
}

void ContactCurve::part(double force_from_next_rest) {
  const Branch branch = unloadingOf(loading_, frame_.law().range());
  has_unloading_ = has_flowed_ || branch.largest_hysteresis > 0.0;
  if (has_unloading_) followChanged(branch);
  const SeparationCurve& curve = unloading();
  const CurveExponents exponents = exponentsOf(frame_, curve);
  by_contacts_.force = curve.pull_off_force;
  by_contacts_.force_exponents = exponents.pull_off;
  by_contacts_.work = curve.work / frame_.area();
  by_contacts_.work_exponents = exponents.work;
  by_contacts_.lost = has_flowed_ || flow_ != nullptr
                          ? 0.0
                          : 0.5 * std::max(0.0, curve.work - loading_.work) / frame_.area();
  const double by_attraction =  // a lasting field pulls as adhesion does
      exponents.pull_off.adhesion + 0.5 * exponents.pull_off.contact_potential;
  const LoadOptions& load = frame_.load();
  by_contacts_.doubt = doubtOf(curve, by_attraction, force_from_next_rest);
  by_contacts_.curve.clear();
  const bool has_edges = curve.states[curve.strongest].edge_share < 1.0 - chosen::kAccuracy;
  const bool has_voltage = load.voltage != 0.0;
  if (!has_unloading_ && !has_voltage && !has_edges && flow_ == nullptr) return;
  const double lowering = flow_ != nullptr ? flow_->lowering() : 0.0;
  for (auto state = curve.states.rbegin(); state != curve.states.rend(); ++state) {
    by_contacts_.curve.push_back({state->approach + lowering, state->partingForce(), true});
  }
}

void ContactCurve::followChanged(const Branch& branch) {
  double first_touch = 0.0;
  if (has_flowed_) {
    first_touch = branch.rest;
    const OverlapSweep& sweep = frame_.contactsAt(branch.rest);
    frame_.change(branch.rest, [&](const OrderedCell& ordered) {
      const Contact& contact =
          contacts_[static_cast<std::size_t>(sweep.livePlace(sweep.patchOf(ordered)))];
      const auto dale = static_cast<std::size_t>(ordered.tag.dale());
      if (dale >= regime_of_dale_.size()) regime_of_dale_.resize(dale + 1, Regime::kElastic);
      regime_of_dale_[dale] = contact.regime;
      const double gap = branch.rest - contact.remaining.of(branch.rest - ordered.gap);
      first_touch = std::min(first_touch, gap);
      return gap;
    });
  }
  followUnloading(frame_, first_touch, branch, unloading_);
}

}  // namespace mems_stiction
