#include "separation/separation_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "contact/prepared_maps.hpp"
#include "deformation/modified_topography.hpp"
#include "loads/force_range.hpp"
#include "mechanics/transition.hpp"
#include "mechanics/wave_stiffness.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// What the contacts carry, or would where a load is more than they do [N].
double carriedAtRest(const SeparationState& rest, const LoadOptions& load) {
  return rest.force() + rest.carried + load.mechanical_load;
}

/// Whether the longest wave of a frame reaches through the bodies, so that it meets another
/// stiffness than a half-space's.
bool areThin(const GapField& field, const WaveStiffness& bodies) {
  if (bodies.isThick()) return false;
  const double longest = std::max(field.cols() * field.pitchX(), field.rows() * field.pitchY());
  const double thick = 1.0 / (bodies.lower().planeCompliance() + bodies.upper().planeCompliance());
  const double share = bodies.modulus(2.0 * kPi / longest) / thick;
  return std::min(share, 1.0 / share) < chosen::kThickShare;
}

}  // namespace

void SeparationSolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  const ContactSettings& settings = problem.settings;
  const GapField& settled =
      settings.guidance == Guidance::kGuided ? problem.gap : tilt_.settle(problem.gap, settings);
  const GapField& at_rest =
      comeToRest({problem.surfaces, settled, problem.composite_rms_height, settings}, solution);
  const ContactProblem standing = {problem.surfaces, at_rest, problem.composite_rms_height,
                                   settings};
  const double joined_share = curve_.joinedShare();
  const double contact_modulus = curve_.frame().patchForces().contactModulus();
  solution.flattening_energy = flattening_.of(at_rest, contact_modulus);

  curve_.part(forceFromNextRest(curve_.frame(), settings, curve_.loading()));
  const std::optional<Unloading> bonded = bondedUnloading(standing, joined_share, solution);
  takeDecision(bonded.has_value(), solution);
  takeUnloading(bonded ? *bonded : curve_.byContacts(), solution);
  listPullOffContacts(standing, solution);
  if (solution.model.doubt == nullptr &&
      isDrawnPastARest(curve_.loading(), settings.load.mechanical_load, solution.pull_off_force)) {
    solution.model.doubt =
        "the surfaces are hardly drawn past a farther rest, from which they part with a smaller "
        "force";
  }
  doubtPlaces(at_rest, solution);
  doubtFlow(solution);
  if (solution.model.doubt == nullptr && settings.guidance != Guidance::kGuided && tilt_.isTipped())
    solution.model.doubt = "the loads tip the plate further than the relief is high";
  solution.model =
      CurveStatement::of(solution, settings.gainedWork(),
                         areThin(at_rest, WaveStiffness(settings.lower, settings.upper)));
}

const GapField& SeparationSolver::comeToRest(const ContactProblem& problem,
                                             ContactSolution& solution) {
  solution.clear();
  curve_.comeToRest(problem.gap, problem.settings);
  curve_.appendLoading(solution.curve);
  solution.steps = static_cast<int>(curve_.loading().states.size());
  attracts_more_ = is_overloaded_ = false;
  has_flowed_ = curve_.loading().status != Status::kNoEquilibrium &&
                curve_.mayFlow(problem.settings.load) && flow(problem);
  const GapField& gap = has_flowed_ ? places_that_flow_.changed() : problem.gap;
  const ContactProblem standing = {problem.surfaces, gap, problem.composite_rms_height,
                                   problem.settings};
  takeRest(standing, solution);
  listContacts(standing, solution);
  fillMaps(standing, solution);
  return gap;
}

std::optional<Unloading> SeparationSolver::bondedUnloading(const ContactProblem& problem,
                                                           double joined_share,
                                                           const ContactSolution& solution) {
  const ContactTraction& law = curve_.frame().law();
  // tall summits may hold surfaces apart whose energy would bond them
  if (!(joined_share > chosen::kJoinedShare)) return std::nullopt;
  const WaterLaw water = problem.settings.capillary.law();
  const double gained = problem.settings.gainedWork();
  if (!(solution.flattening_energy / gained < chosen::kConformingRatio)) return std::nullopt;
  const FieldLaw lasting_field =
      fieldLaw(problem.settings.load.contact_potential, problem.settings.interface);
  conforming_.start(problem.gap, law, lasting_field, water,
                    curve_.frame().patchForces().contactModulus(), solution.flattening_energy);
  if (!conforming_.holds()) return std::nullopt;
  return conforming_.unloading(curve_.byContacts(),
                               problem.settings.load.mechanical_load / curve_.frame().area());
}

bool SeparationSolver::flow(const ContactProblem& problem) {
  const LoadOptions& load = problem.settings.load;
  const ContactTraction law = curve_.frame().law();
  const bool is_reached = curve_.loading().status == Status::kEquilibrium;
  FlowingPlaces::Press press = {curve_.frame().patchForces().contactModulus(),
                                curve_.frame().patchForces().hardness(),
                                carriedAtRest(curve_.rest(), load),
                                is_reached ? curve_.rest().approach : GapField::kInvalidGap};
  bool has_flowed = false;
  double carried = 0.0;
  for (int round = 0; round < chosen::kFlowRounds; ++round) {
    if (!places_that_flow_.press(problem.gap, law, press)) break;
    has_flowed = true;
    curve_.comeToRest(places_that_flow_.changed(), problem.settings, places_that_flow_);
    // flattened summits bring the surfaces nearer to each other, which attract the more
    carried = carriedAtRest(curve_.rest(), load);
    if (carried < chosen::kMoreCarried * press.load) break;
    press.load = carried;
    const double approach = curve_.rest().approach + places_that_flow_.lowering();
    press.approach = curve_.loading().status == Status::kEquilibrium
                         ? std::max(press.approach, approach)
                         : GapField::kInvalidGap;
  }
  if (!has_flowed && curve_.flowsByPatches())
    curve_.comeToRestElastically(problem.gap, problem.settings);
  const double pressed_by = load.mechanical_load + curve_.rest().electrostatic;
  attracts_more_ = has_flowed && carried > chosen::kDoubtedTimes * pressed_by &&
                   carried > chosen::kDoubtedTimes *
                                 carriedAtRest(restIfElastic(problem.gap, problem.settings), load);
  is_overloaded_ = places_that_flow_.isOverloaded() ||
                   (has_flowed && curve_.loading().status == Status::kBonded &&
                    load.mechanical_load > chosen::kDoubtedTimes * curve_.rest().carried);
  return has_flowed;
}

void SeparationSolver::takeDecision(bool is_conforming, ContactSolution& solution) const {
  solution.is_conforming = is_conforming;
  solution.status = is_conforming ? Status::kBonded : curve_.loading().status;
  solution.is_bonded_by_load = !is_conforming && curve_.loading().isBondedByLoad();
}

void SeparationSolver::takeUnloading(const Unloading& unloading, ContactSolution& solution) const {
  solution.model.doubt = unloading.doubt;
  solution.pull_off_force = unloading.force;
  solution.pull_off_exponents = unloading.force_exponents;
  solution.apparent_work_of_adhesion = unloading.work;
  solution.work_exponents = unloading.work_exponents;
  // a sum over all cells may be larger by rounding
  solution.contact_area = std::min(unloading.contact_area, curve_.frame().area());
  solution.contact_fraction = solution.contact_area / curve_.frame().area();
  solution.curve.insert(solution.curve.end(), unloading.curve.begin(), unloading.curve.end());
}

void SeparationSolver::doubtFlow(ContactSolution& solution) const {
  if (solution.model.doubt != nullptr) return;
  if (attracts_more_) {
    solution.model.doubt =
        "contacts have flowed until the surfaces attract each other much more, and how far is not "
        "sure";
  } else if (is_overloaded_) {
    solution.model.doubt =
        "contacts have flowed under a load that presses the surfaces together nearly everywhere";
  }
}

void SeparationSolver::doubtPlaces(const GapField& field, ContactSolution& solution) {
  if (solution.model.doubt != nullptr) return;
  const FrameSums& frame = curve_.frame();
  const double modulus = frame.patchForces().contactModulus();
  if (solution.is_conforming) {
    if (places_.largestEnergy(field, modulus) >
        chosen::kDoubtedTimes * solution.flattening_energy) {
      solution.model.doubt =
          "the surfaces are bonded, and their texture changes from place to place";
    }
    return;
  }
  const double least = has_flowed_ ? chosen::kDoubtedFactor : chosen::kPullOfPlaces;
  if (places_.force(field, frame.law(), modulus, curve_.unloading(),
                    least * solution.pull_off_force) > 0.0) {
    solution.model.doubt =
        "places smoother than the rest close by themselves, and hold more than the contacts";
  } else if (holdTogether(solution.pull_off_force)) {
    solution.model.doubt =
        "flat tops of nearly one height hold together, with more force than one by one";
  }
}

bool SeparationSolver::holdTogether(double force) {
  flat_tops_.start(curve_.frame(), curve_.rest().approach);
  const double pull = flat_tops_.pullTogether() / chosen::kDoubtedFactor;
  return pull > force && pull > flat_tops_.pullOneByOne();
}

void SeparationSolver::takeRest(const ContactProblem& problem, ContactSolution& solution) {
  const SeparationState& rest = curve_.rest();
  solution.approach = rest.approach + (has_flowed_ ? places_that_flow_.lowering() : 0.0);
  solution.load.van_der_waals = rest.adhesion;
  solution.load.electrostatic = rest.electrostatic;
  solution.load.mechanical = problem.settings.load.mechanical_load;
  solution.load.capillary = rest.capillary;
  solution.energies.elastic = curve_.loading().elastic_energy;
  solution.energies.surface = curve_.frame().energy(rest.approach);
  solution.contact_stiffness = curve_.stiffness();
  solution.mean_gap = curve_.meanGap();
  findBorder(problem.gap);
}

void SeparationSolver::findBorder(const GapField& field) {
  OverlapSweep& sweep = curve_.frame().contactsAt(curve_.rest().approach);
  is_at_border_.assign(curve_.contacts().size(), 0);
  const auto mark = [&](int row, int col) {
    const std::int32_t id = sweep.patchOf(field.cellAt(row, col));
    if (id >= 0) is_at_border_[static_cast<std::size_t>(sweep.livePlace(id))] = 1;
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
  OverlapSweep& sweep = curve_.frame().contactsAt(approach);
  const auto cols = static_cast<std::size_t>(field.cols());
  // the order knows them by gap: each marks its place in the frame
  overlaps_.assign(static_cast<std::size_t>(field.cellCount()), 0);
  const OrderedCell* const ordered = curve_.frame().orderedCells().data();
  for (int i = 0; i < sweep.cellCount(); ++i)
    overlaps_[static_cast<std::size_t>(ordered[i].cell)] = 1;
  for (int row = 0; row < field.rows(); ++row) {
    const std::uint8_t* const line = overlaps_.data() + static_cast<std::size_t>(row) * cols;
    const auto next = [&](const std::uint8_t* from) {
      const auto left = static_cast<std::size_t>(line + cols - from);
      return static_cast<const std::uint8_t*>(std::memchr(from, 1, left));
    };
    for (const std::uint8_t* at = next(line); at != nullptr; at = next(at + 1)) {
      const GridCell cell = field.cellAt(row, static_cast<int>(at - line));
      const std::int32_t id = sweep.patchOf(cell);
      take(row, cell.col, approach - field.gap(cell.index),
           static_cast<std::size_t>(sweep.livePlace(id)));
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
  const OverlapSweep& sweep = curve_.frame().contactsAt(approach);
  for (std::size_t i = 0; i < curve_.contacts().size(); ++i) {
    const OverlapPatch& patch = sweep.patches()[i];
    const ContactCurve::Contact& contact = curve_.contacts()[i];
    const double area = patch.cells * field.cellArea();
    const GridCell cell = field.cellAt(patch.first_cell);
    Asperity asperity;
    asperity.x = cell.col * field.pitchX();
    asperity.y = cell.row * field.pitchY();
    asperity.z = problem.surfaces.lower.height(cell.row, cell.col);
    asperity.cap_radius = std::sqrt(area / kPi);
    asperity.composite_radius = contact.composite_radius;
    asperity.load = contact.load.carried;
    asperity.contact_radius = std::sqrt(contact.area / kPi);
    asperity.tilt = ContactSolution::kUnknown;
    asperity.plasticity_index =
        plasticityIndex(pair.contact_modulus, pair.hardness, sigma, asperity.composite_radius);
    asperity.tabor_parameter = taborParameter(asperity.composite_radius, gamma,
                                              pair.contact_modulus, curve_.frame().law().range());
    asperity.area = contact.area;
    asperity.is_at_border = is_at_border_[i] != 0;
    asperity.regime = contact.regime;
    parameters +=
        pair.contact_modulus / gamma * std::sqrt(sigma * sigma * sigma / asperity.composite_radius);
    solution.asperities.push_back(asperity);
  }
  solution.has_asperities = true;
  solution.adhesion_parameter = gamma > 0.0
                                    ? parameters / static_cast<double>(solution.asperities.size())
                                    : std::numeric_limits<double>::infinity();
}

void SeparationSolver::takeLeastOverlaps(const GapField& field) {
  const double approach = curve_.rest().approach;
  const std::vector<OverlapPatch>& patches = curve_.frame().contactsAt(approach).patches();
  least_overlaps_.resize(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const double area = patches[i].cells * field.cellArea();
    least_overlaps_[i] =
        2.0 * patches[i].depth(approach) * (1.0 - curve_.contacts()[i].area / area);
  }
}

void SeparationSolver::fillMaps(const ContactProblem& problem, ContactSolution& solution) {
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const bool wants_map = settings.output.contact_map;
  const bool wants_surfaces = settings.output.deformed_surfaces;
  prepareMaps(problem, solution);
  if (!wants_map && !wants_surfaces) return;

  const DeformationShare share(settings.lower, settings.upper,
                               settings.interface.hardness_ratio_limit);
  const OverlapSweep& sweep = curve_.frame().contactsAt(curve_.rest().approach);
  if (wants_map) takeLeastOverlaps(field);
  flowed_line_.resize(static_cast<std::size_t>(field.cols()));
  pressure_line_.resize(static_cast<std::size_t>(field.cols()));
  int last_row = -1;
  visitOverlaps(field, [&](int row, int col, double overlap, std::size_t place) {
    const ContactCurve::Contact& contact = curve_.contacts()[place];
    if (wants_map) {
      if (has_flowed_ && row != std::exchange(last_row, row))
        places_that_flow_.readRow(row, flowed_line_.data(), pressure_line_.data());
      const bool touches = contact.is_of_places
                               ? pressure_line_[static_cast<std::size_t>(col)] > 0.0
                               : overlap >= least_overlaps_[place];
      if (touches || field.cellAt(row, col).index == sweep.patches()[place].first_cell) {
        const bool flows = has_flowed_ && flowed_line_[static_cast<std::size_t>(col)] > 0.0;
        const Regime regime = !has_flowed_ ? contact.regime
                              : flows      ? Regime::kPlastic
                                           : Regime::kElastic;
        solution.contact_map.at<std::uint8_t>(row, col) = static_cast<std::uint8_t>(regime);
      }
    }
    if (wants_surfaces && contact.remaining.isChanged()) {
      const double flowed = overlap - contact.remaining.of(overlap);
      solution.displaced_lower.at<double>(row, col) -= share.lower(kPlasticLimit) * flowed;
      solution.displaced_upper.at<double>(row, col) += share.upper(kPlasticLimit) * flowed;
    }
  });
  if (!has_flowed_ || !wants_surfaces) return;
  for (int row = 0; row < field.rows(); ++row) {
    double* const lower = solution.displaced_lower.ptr<double>(row);
    double* const upper = solution.displaced_upper.ptr<double>(row);
    places_that_flow_.visitRow(row, [&](int col, double flowed, double) {
      if (!(flowed > 0.0)) return;  // most cells: neither map is touched there
      lower[col] -= share.lower(kPlasticLimit) * flowed;
      upper[col] += share.upper(kPlasticLimit) * flowed;
    });
  }
}

void SeparationSolver::listPullOffContacts(const ContactProblem& problem,
                                           ContactSolution& solution) {
  if (!(solution.pull_off_force > 0.0)) return;
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const FrameSums& frame = curve_.frame();
  const double modulus = frame.patchForces().contactModulus();
  const std::vector<Regime>& regime_of_dale = curve_.regimeOfDale();
  const OverlapSweep& reached = curve_.inReachAtPullOff();
  std::vector<Asperity>& contacts = solution.pull_off_contacts;
  for (const OverlapPatch& patch : reached.patches()) {
    const GridCell cell = field.cellAt(patch.first_cell);
    Asperity contact;
    contact.x = cell.col * field.pitchX();
    contact.y = cell.row * field.pitchY();
    contact.area = patch.cells * field.cellArea();
    contact.composite_radius = patch.radius(reached.approach(), field.cellArea());
    contact.tabor_parameter =
        taborParameter(contact.composite_radius, settings.interface.work_of_adhesion, modulus,
                       frame.law().range());
    contacts.push_back(contact);
  }
  for (int place = 0; place < reached.cellCount(); ++place) {
    const OrderedCell& ordered = frame.orderedCells()[static_cast<std::size_t>(place)];
    const GridCell cell = field.cellAt(ordered.cell);
    const bool is_at_border = cell.row == 0 || cell.col == 0 || cell.row == field.rows() - 1 ||
                              cell.col == field.cols() - 1;
    const auto dale = static_cast<std::size_t>(ordered.tag.dale());
    if (!is_at_border && dale >= regime_of_dale.size()) continue;
    const auto of_patch = static_cast<std::size_t>(reached.livePlace(reached.patchOf(ordered)));
    contacts[of_patch].is_at_border = contacts[of_patch].is_at_border || is_at_border;
    const bool is_summit = reached.patches()[of_patch].first_cell == ordered.cell;
    if (is_summit && dale < regime_of_dale.size()) contacts[of_patch].regime = regime_of_dale[dale];
  }
}

}  // namespace mems_stiction
