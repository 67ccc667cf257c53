#include "separation/separation_solver.hpp"

#include <algorithm>
#include <cmath>

#include "contact/prepared_maps.hpp"
#include "deformation/modified_topography.hpp"
#include "mechanics/transition.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Real area of a patch that overlaps over `area`: half of it while it is elastic (Hertz), more where adhesion widens
/// the contact (JKR), all of it when what it carries is all that flow allows. The load that widens it is P (DMT) to
/// JKR's P1 of what presses beside the contact's own rim, as far as Tabor's parameter has come from one to the other.
/// The half-space knows no smaller contact than a cell.
double realArea(const PatchLoad& load, double area, double rim_force, double prefactor, double hardness,
                double cell_area) {
  const double fullness = std::isfinite(hardness) ? std::min(1.0, load.carried / (hardness * area)) : 0.0;
  double widening = 1.0;
  if (!std::isfinite(rim_force)) {  // a plateau without depth: no paraboloid, and it touches everywhere
    widening = 2.0;
  } else if (load.carried > 0.0) {
    const double outer = std::max(load.carried - rim_force, 0.0);  // rim_force is DMT's 2 pi Gamma R
    const double jkr_load = outer + 1.5 * rim_force + std::sqrt(3.0 * rim_force * outer + 2.25 * rim_force * rim_force);
    const double jkr_share = 2.0 * (2.0 - prefactor);
    const double root = std::cbrt(1.0 + jkr_share * std::max(jkr_load / load.carried - 1.0, 0.0));
    widening = root * root;
  }
  return std::max(cell_area, area * std::max(0.5 * std::min(widening, 2.0), fullness));
}

Regime regimeOf(const PatchLoad& load, double area, double hardness) {
  if (load.elasticShare() >= chosen::kElasticShare) return Regime::kElastic;
  return load.carried >= chosen::kPlasticShare * hardness * area ? Regime::kPlastic : Regime::kElastoPlastic;
}

void appendCurve(const SeparationCurve& curve, bool is_separation, std::vector<SeparationCurvePoint>& points) {
  const auto add = [&](const SeparationState& state) {
    points.push_back({state.approach, is_separation ? state.partingForce() : state.force(), is_separation});
  };
  if (is_separation) {
    std::for_each(curve.states.rbegin(), curve.states.rend(), add);
  } else {
    std::for_each(curve.states.begin(), curve.states.end(), add);
  }
}

/// A secant to the nearest state that is far enough before rest: forces are known to a thousandth of what is carried.
double stiffnessAtRest(const std::vector<SeparationState>& states, double range) {
  const SeparationState& rest = states.back();
  for (auto before = states.rbegin() + 1; before != states.rend(); ++before) {
    const double length = rest.approach - before->approach;
    if (length >= chosen::kStiffnessLength * range) return (before->force() - rest.force()) / length;
  }
  return ContactSolution::kUnknown;
}

}  // namespace

void SeparationSolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  solution.clear();
  frame_.start(problem.gap, problem.settings);
  followCurve(frame_, problem.settings, curve_);
  appendCurve(curve_, false, solution.curve);
  solution.steps = static_cast<int>(curve_.states.size());
  solution.flattening_energy = flattening_.of(problem.gap, frame_.patchForces().contactModulus());
  solution.joining_rise = joiningRise(curve_);
  takeRest(problem, solution);
  listContacts(problem, solution);
  fillMaps(problem, solution);
  partByContacts(problem);
  conforming_.start(problem.gap, frame_.law(), frame_.patchForces().contactModulus(), solution.flattening_energy);
  const std::optional<WayOut> conforming =
      conformingWayOut(by_contacts_, conforming_, solution.flattening_energy / frame_.law().workOfAdhesion(),
                       problem.settings.load.mechanical_load / frame_.area());
  takeWayOut(conforming ? *conforming : by_contacts_, solution);
  listPullOffContacts(problem, solution);
  solution.model = statement_.of(solution, problem.settings.interface.work_of_adhesion);
}

void SeparationSolver::takeWayOut(const WayOut& way_out, ContactSolution& solution) const {
  solution.is_conforming = way_out.parting != Parting::kByContacts;
  solution.status = solution.is_conforming ? Status::kBonded : curve_.status;
  solution.is_bonded_by_load =
      !solution.is_conforming && curve_.status == Status::kBonded && curve_.firstPushing() != curve_.states.end();
  solution.pull_off_force = way_out.force;
  solution.pull_off_exponents = way_out.force_exponents;
  solution.apparent_work_of_adhesion = way_out.work;
  solution.work_exponents = way_out.work_exponents;
  // a sum over all cells may be larger by rounding
  solution.contact_area = std::min(way_out.contact_area, frame_.area());
  solution.contact_fraction = solution.contact_area / frame_.area();
  solution.curve.insert(solution.curve.end(), way_out.curve.begin(), way_out.curve.end());
}

void SeparationSolver::takeRest(const ContactProblem& problem, ContactSolution& solution) {
  const GapField& field = problem.gap;
  const SeparationState& rest = curve_.rest();
  solution.approach = rest.approach;
  solution.load.van_der_waals = rest.adhesion;
  solution.load.electrostatic = rest.electrostatic;
  solution.load.mechanical = problem.settings.load.mechanical_load;
  solution.load.capillary = rest.capillary;
  solution.energies.elastic = curve_.elastic_energy;
  solution.energies.surface = frame_.energy(rest.approach);
  solution.contact_stiffness = stiffnessAtRest(curve_.states, frame_.law().range());

  const OverlapSweep& sweep = frame_.contactsAt(rest.approach);
  const PatchForces& forces = frame_.patchForces();
  contacts_.assign(sweep.patches().size(), {});
  forces.loadsOf(sweep, rest.approach, loads_);
  by_contacts_.contact_area = 0.0;
  has_flowed_ = false;
  double touching = 0.0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const OverlapPatch& patch = sweep.patches()[i];
    Contact& contact = contacts_[i];
    const double area = patch.cells * field.cellArea();
    contact.load = loads_[i];
    const double radius = patch.radius(rest.approach, field.cellArea());
    contact.area =
        realArea(contact.load, area, 2.0 * kPi * frame_.law().workOfAdhesion() * radius / std::sqrt(patch.summits),
                 forces.pullOffPrefactor(radius / patch.summits), forces.hardness(), field.cellArea());
    contact.regime = regimeOf(contact.load, area, forces.hardness());
    by_contacts_.contact_area += contact.area;
    const double area_share = std::max(0.5, contact.load.carried / (forces.hardness() * area));
    contact.remaining = RemainingOverlap(contact.load.elastic / (forces.hardness() * area), area_share,
                                         patch.depth(rest.approach), rest.approach - patch.first_gap);
    has_flowed_ = has_flowed_ || contact.remaining.isChanged();
    touching += patch.gap_sum;
  }
  findBorder(field);
  const int apart = field.validCount() - rest.contact_count;
  solution.mean_gap = apart > 0 ? (field.meanGap() * field.validCount() - touching) / apart - rest.approach : 0.0;
}

void SeparationSolver::findBorder(const GapField& field) {
  OverlapSweep& sweep = frame_.contactsAt(curve_.rest().approach);
  const auto mark = [&](int row, int col) {
    const std::int32_t id = sweep.patchOf(field.cellAt(row, col).index);
    if (id >= 0) contactOf(sweep, id).is_at_border = true;
  };
  for (int col = 0; col < field.cols(); ++col) {
    mark(0, col);
    mark(field.rows() - 1, col);
  }
  for (int row = 0; row < field.rows(); ++row) {
    mark(row, 0);
    mark(row, field.cols() - 1);
  }
}

template <typename Taker>
void SeparationSolver::visitOverlaps(const GapField& field, const Taker& take) {
  const double approach = curve_.rest().approach;
  OverlapSweep& sweep = frame_.contactsAt(approach);
  row_gaps_.resize(static_cast<std::size_t>(field.cols()));
  columns_.resize(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, row_gaps_.data());
    const int count = columnsBetween(0.0, approach, row_gaps_.data(), field.cols(), columns_.data());
    for (int i = 0; i < count; ++i) {
      const std::int32_t col = columns_[static_cast<std::size_t>(i)];
      const std::int32_t id = sweep.patchOf(field.cellAt(row, col).index);
      take(row, col, approach - row_gaps_[static_cast<std::size_t>(col)], sweep.patch(id), contactOf(sweep, id));
    }
  }
}

void SeparationSolver::listContacts(const ContactProblem& problem, ContactSolution& solution) {
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const ContactPair pair(settings.lower, settings.upper);
  const double gamma = settings.interface.work_of_adhesion;
  const double sigma = problem.composite_rms_height;
  const double approach = curve_.rest().approach;
  double parameters = 0.0;
  const OverlapSweep& sweep = frame_.contactsAt(approach);
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const OverlapPatch& patch = sweep.patches()[i];
    const Contact& contact = contacts_[i];
    const double area = patch.cells * field.cellArea();
    const GridCell cell = field.cellAt(patch.first_cell);
    Asperity asperity;
    asperity.x = cell.col * field.pitchX();
    asperity.y = cell.row * field.pitchY();
    asperity.z = problem.surfaces.lower.height(cell.row, cell.col);
    asperity.cap_radius = std::sqrt(area / kPi);
    asperity.composite_radius = patch.radius(approach, field.cellArea());
    asperity.load = contact.load.carried;
    asperity.contact_radius = std::sqrt(contact.area / kPi);
    asperity.tilt = ContactSolution::kUnknown;
    asperity.plasticity_index = plasticityIndex(pair.contact_modulus, pair.hardness, sigma, asperity.composite_radius);
    asperity.tabor_parameter =
        taborParameter(asperity.composite_radius, gamma, pair.contact_modulus, frame_.law().range());
    asperity.area = contact.area;
    asperity.is_at_border = contact.is_at_border;
    asperity.regime = contact.regime;
    parameters += pair.contact_modulus / gamma * std::sqrt(sigma * sigma * sigma / asperity.composite_radius);
    solution.asperities.push_back(asperity);
  }
  solution.has_asperities = true;
  solution.adhesion_parameter = gamma > 0.0 ? parameters / static_cast<double>(solution.asperities.size())
                                            : std::numeric_limits<double>::infinity();
}

void SeparationSolver::fillMaps(const ContactProblem& problem, ContactSolution& solution) {
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const bool wants_map = settings.output.contact_map;
  const bool wants_surfaces = settings.output.deformed_surfaces;
  prepareMaps(problem, solution);
  if (!wants_map && !wants_surfaces) return;

  const DeformationShare share(settings.lower, settings.upper, settings.interface.hardness_ratio_limit);
  const double approach = curve_.rest().approach;
  visitOverlaps(field, [&](int row, int col, double overlap, const OverlapPatch& patch, const Contact& contact) {
    if (wants_map) {
      // the deepest cells, as many as the real area has: those of a paraboloid whose overlap exceeds this
      const double area = patch.cells * field.cellArea();
      const double least = 2.0 * patch.depth(approach) * (1.0 - contact.area / area);
      if (overlap >= least || field.cellAt(row, col).index == patch.first_cell) {
        solution.contact_map.at<std::uint8_t>(row, col) = static_cast<std::uint8_t>(contact.regime);
      }
    }
    if (wants_surfaces) {
      const double flowed = overlap - contact.remaining.of(overlap);
      solution.displaced_lower.at<double>(row, col) -= share.lower(kPlasticLimit) * flowed;
      solution.displaced_upper.at<double>(row, col) += share.upper(kPlasticLimit) * flowed;
    }
  });
}

void SeparationSolver::partByContacts(const ContactProblem& problem) {
  const Way way = wayOutOf(curve_, frame_.law().range());
  has_way_out_ = has_flowed_ || way.longest_hold > 0.0;
  regime_of_dale_.clear();
  if (has_way_out_) followChanged(way);
  const SeparationCurve& curve = wayOut();
  const CurveExponents exponents = exponentsOf(frame_, curve);
  by_contacts_.force = curve.pull_off_force;
  by_contacts_.force_exponents = exponents.pull_off;
  by_contacts_.work = curve.work / frame_.area();
  by_contacts_.work_exponents = exponents.work;
  by_contacts_.curve.clear();
  if (has_way_out_ || problem.settings.load.voltage != 0.0) appendCurve(curve, true, by_contacts_.curve);
}

void SeparationSolver::followChanged(const Way& way) {
  double first_touch = 0.0;
  if (has_flowed_) {
    first_touch = way.rest;
    const OverlapSweep& sweep = frame_.contactsAt(way.rest);
    frame_.change(way.rest, [&](const OrderedCell& ordered) {
      const Contact& contact = contactOf(sweep, sweep.patchOf(ordered));
      const auto dale = static_cast<std::size_t>(ordered.tag.dale());
      if (dale >= regime_of_dale_.size()) regime_of_dale_.resize(dale + 1, Regime::kElastic);
      regime_of_dale_[dale] = contact.regime;
      const double gap = way.rest - contact.remaining.of(way.rest - ordered.gap);
      first_touch = std::min(first_touch, gap);
      return gap;
    });
  }
  followWayOut(frame_, first_touch, way, way_out_);
}

void SeparationSolver::listPullOffContacts(const ContactProblem& problem, ContactSolution& solution) {
  if (!(solution.pull_off_force > 0.0)) return;
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const double modulus = frame_.patchForces().contactModulus();
  const SeparationCurve& way_out = wayOut();
  const OverlapSweep& reached = frame_.inReachAt(way_out.pull_off_approach, way_out.way.longest_hold);
  std::vector<Asperity>& contacts = solution.pull_off_contacts;
  for (const OverlapPatch& patch : reached.patches()) {
    const GridCell cell = field.cellAt(patch.first_cell);
    Asperity contact;
    contact.x = cell.col * field.pitchX();
    contact.y = cell.row * field.pitchY();
    contact.area = patch.cells * field.cellArea();
    contact.composite_radius = patch.radius(reached.approach(), field.cellArea());
    contact.tabor_parameter =
        taborParameter(contact.composite_radius, settings.interface.work_of_adhesion, modulus, frame_.law().range());
    contacts.push_back(contact);
  }
  for (int place = 0; place < reached.cellCount(); ++place) {
    const OrderedCell& ordered = frame_.orderedCells()[static_cast<std::size_t>(place)];
    const GridCell cell = field.cellAt(ordered.cell);
    const bool is_at_border =
        cell.row == 0 || cell.col == 0 || cell.row == field.rows() - 1 || cell.col == field.cols() - 1;
    const auto dale = static_cast<std::size_t>(ordered.tag.dale());
    if (!is_at_border && dale >= regime_of_dale_.size()) continue;
    const auto of_patch = static_cast<std::size_t>(reached.livePlace(reached.patchOf(ordered)));
    contacts[of_patch].is_at_border = contacts[of_patch].is_at_border || is_at_border;
    const bool is_summit = reached.patches()[of_patch].first_cell == ordered.cell;
    if (is_summit && dale < regime_of_dale_.size()) contacts[of_patch].regime = regime_of_dale_[dale];
  }
}

}  // namespace mems_stiction
