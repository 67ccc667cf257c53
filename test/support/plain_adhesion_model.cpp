#include "support/plain_adhesion_model.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <opencv2/imgproc.hpp>

#include "mems_stiction/paper/paper_options.hpp"
#include "paper/approach_search.hpp"
#include "paper/asperity_summary.hpp"
#include "paper/cap_couple.hpp"
#include "paper/level_search.hpp"
#include "preprocess/refine.hpp"
#include "support/frame_gaps.hpp"

namespace mems_stiction {
namespace plain {
namespace {

bool touches(double gap, double approach, Touch touch) {
  return touch == Touch::kBelow ? gap < approach : gap <= approach;
}

bool isDeeper(const GapField& field, int cell, int other) {
  return field.gap(cell) != field.gap(other) ? field.gap(cell) < field.gap(other) : cell < other;
}

/// Calls visit(row, col, label) for every cell in contact.
template <typename Visitor>
void forEachContactCell(const cv::Mat& labels, Visitor&& visit) {
  for (int row = 0; row < labels.rows; ++row) {
    for (int col = 0; col < labels.cols; ++col) {
      if (labels.at<int>(row, col) > 0) visit(row, col, labels.at<int>(row, col));
    }
  }
}

/// The edge between a cell in contact and its neighbour.
void addEdge(const GapField& field, cv::Point cell, cv::Point neighbour, BoundarySums& sums) {
  const int cells[] = {cell.y * field.cols() + cell.x, neighbour.y * field.cols() + neighbour.x};
  const double x = cell.x + neighbour.x;
  const double y = cell.y + neighbour.y;
  const double gap = 0.5 * (field.gap(cells[0]) + field.gap(cells[1]));
  sums += {1.0, gap, x, x * gap, y, y * gap, x * x, y * y, x * y, 0.0, 0.0, 0.0};
  if (field.upperIsFlat()) return;  // the lower surface is then the gap, turned over
  const double lower = 0.5 * (field.lowerHeight(cells[0]) + field.lowerHeight(cells[1]));
  sums.lower += lower;
  sums.x_lower += x * lower;
  sums.y_lower += y * lower;
}

void measureBoundary(const GapField& field, const cv::Mat& labels,
                     std::vector<ContactPatch>& patches) {
  forEachContactCell(labels, [&](int row, int col, int label) {
    for (const cv::Point step :
         {cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, -1), cv::Point(0, 1)}) {
      const cv::Point neighbour = cv::Point(col, row) + step;
      if (!cv::Rect(0, 0, labels.cols, labels.rows).contains(neighbour)) continue;
      if (labels.at<int>(neighbour) > 0 || !isValid(field, neighbour.y * labels.cols + neighbour.x))
        continue;
      addEdge(field, {col, row}, neighbour, patches[static_cast<std::size_t>(label - 1)].boundary);
    }
  });
}

/// One state of the approach with its forces.
struct State {
  double approach = 0.0;
  Touch touch = Touch::kBelow;
  Labelling labelling;
  std::vector<CapCouple> caps;
  std::vector<AsperityResponse> responses;
  NormalLoad load;
  ForceBalance balance;
};

struct Problem {
  const Options& options;
  GapField field;
  AsperityLaw law;
};

State stateAt(const Problem& problem, double approach, Touch touch) {
  State state;
  state.approach = approach;
  state.touch = touch;
  state.labelling =
      labelPatches(problem.field, approach, touch, problem.options.approach.connectivity);
  for (const ContactPatch& patch : state.labelling.patches) {
    PatchCentre centre = boxCentre(patch, problem.field);
    const auto label = static_cast<int>(state.caps.size()) + 1;
    const bool is_inside =
        state.labelling.labels.at<int>(centre.cell.row, centre.cell.col) == label;
    if (!is_inside) centre = deepestCentre(patch, problem.field);
    state.caps.push_back(capCouple(patch, problem.field, centre,
                                   problem.options.solver.of<PaperOptions>().cutoff_distance));
    state.responses.emplace_back(state.caps.back(), problem.law);
  }
  const CellForces forces(problem.options.interface,
                          problem.options.solver.of<PaperOptions>().cutoff_distance,
                          problem.options.load.fieldVoltage(), problem.field.cellArea());
  state.load =
      sumLoads(problem.field, approach, touch, forces, problem.options.load.mechanical_load);
  state.balance = forceBalance(state.responses, state.load.total(), problem.law);
  return state;
}

/// The first gap level at which at least the limiting share of the valid cells touches.
double limitGap(const GapField& field, double max_contact_fraction) {
  std::vector<double> gaps = frameGaps(field);
  std::sort(gaps.begin(), gaps.end());  // those that are not valid last
  const auto wanted =
      static_cast<std::size_t>(std::max(1.0, std::ceil(max_contact_fraction * field.validCount())));
  return gaps[wanted - 1];
}

/// The first level in (previous, step_end] that is in equilibrium, or the end of the step.
State refined(const Problem& problem, const State& step_end, double previous_approach,
              double step) {
  std::set<double> gaps;
  for (const double gap : frameGaps(problem.field)) {
    if (touches(gap, step_end.approach, step_end.touch) && gap >= previous_approach)
      gaps.insert(gap);
  }
  // Gaps within a millionth of a step of the smallest among them are one level: they differ by
  // round-off.
  std::vector<double> ordered;
  double level_start = -1.0;
  for (const double gap : gaps) {
    if (ordered.empty() || gap > level_start + 1e-6 * step) {
      ordered.push_back(gap);
      level_start = gap;
    } else {
      ordered.back() = gap;
    }
  }
  State found = step_end;
  const auto count = static_cast<int>(ordered.size());
  const int level = firstLevelThat(count, [&](int candidate) {
    found = stateAt(problem, ordered[static_cast<std::size_t>(candidate)], Touch::kUpTo);
    return found.balance.is_equilibrium;
  });
  return level < count ? found : step_end;
}

double meanGapApart(const GapField& field, const State& state) {
  double sum = 0.0;
  int apart = 0;
  for (const double gap : frameGaps(field)) {
    if (gap == GapField::kInvalidGap || touches(gap, state.approach, state.touch)) continue;
    sum += gap - state.approach;
    ++apart;
  }
  return apart > 0 ? sum / apart : 0.0;
}

Formulation formulationOf(const Options& options) {
  return options.formulation == "printed" ? Formulation::kPrinted : Formulation::kPaper;
}

void summarize(const Problem& problem, const State& state, Prediction& prediction) {
  const GapField& field = problem.field;
  prediction.voltage = problem.options.load.voltage;
  prediction.mechanical_load = problem.options.load.mechanical_load;
  prediction.van_der_waals_force = state.load.van_der_waals;
  prediction.electrostatic_force = state.load.electrostatic;
  prediction.normal_load = state.load.total();
  prediction.contact_area = state.labelling.contact_count * field.cellArea();
  prediction.nominal_area = field.validCount() * field.cellArea();
  prediction.contact_fraction =
      static_cast<double>(state.labelling.contact_count) / field.validCount();
  prediction.approach = state.approach;
  prediction.mean_gap = meanGapApart(field, state);
  const Energies energies = totalEnergies(state.responses, state.balance, problem.law);
  prediction.mechanical_energy = energies.mechanical;
  prediction.surface_energy = energies.surface;
  prediction.elastic_energy = energies.elastic;
  prediction.total_energy = energies.total();
  prediction.bonding_energy = energies.total() / prediction.nominal_area;
  ContactSolution sums;
  for (std::size_t i = 0; i < state.caps.size(); ++i) {
    sums.asperities.push_back(asperityAt(state.labelling.patches[i], state.caps[i],
                                         state.responses[i], state.balance.load_share, field,
                                         problem.law, problem.options.interface));
  }
  sumAsperities(problem.law, sums);
  prediction.pull_off_force_jkr = sums.pull_off_force_jkr;
  prediction.pull_off_force_transition = sums.pull_off_force_transition;
  prediction.contact_area_jkr = sums.contact_area_jkr;
  prediction.adhesion_parameter = sums.adhesion_parameter;
  prediction.pull_off_force =
      prediction.pull_off_force_jkr + prediction.van_der_waals_force +
      problem.options.load.lastingFieldShare() * prediction.electrostatic_force;
  prediction.asperity_count = static_cast<int>(sums.asperities.size());
  for (const Asperity& asperity : sums.asperities) {
    prediction.max_tilt = std::max(prediction.max_tilt, asperity.tilt);
    if (asperity.regime == Regime::kElastic) ++prediction.elastic_count;
    if (asperity.regime == Regime::kElastoPlastic) ++prediction.elasto_plastic_count;
    if (asperity.regime == Regime::kPlastic) ++prediction.plastic_count;
  }
  prediction.asperities = sums.asperities;
}

}  // namespace

Labelling labelPatches(const GapField& field, double approach, Touch touch,
                       Connectivity connectivity) {
  cv::Mat1b mask(field.rows(), field.cols());
  for (int cell = 0; cell < field.cellCount(); ++cell) {
    mask(cell / field.cols(), cell % field.cols()) =
        touches(field.gap(cell), approach, touch) ? 255 : 0;
  }
  Labelling labelling;
  cv::Mat stats;
  cv::Mat centroids;
  const int count =
      cv::connectedComponentsWithStats(mask, labelling.labels, stats, centroids,
                                       connectivity == Connectivity::kFour ? 4 : 8, CV_32S);
  labelling.patches.resize(static_cast<std::size_t>(count - 1));
  for (int label = 1; label < count; ++label) {
    ContactPatch& patch = labelling.patches[static_cast<std::size_t>(label - 1)];
    patch.area = stats.at<int>(label, cv::CC_STAT_AREA);
    patch.min_col = stats.at<int>(label, cv::CC_STAT_LEFT);
    patch.max_col = patch.min_col + stats.at<int>(label, cv::CC_STAT_WIDTH) - 1;
    patch.min_row = stats.at<int>(label, cv::CC_STAT_TOP);
    patch.max_row = patch.min_row + stats.at<int>(label, cv::CC_STAT_HEIGHT) - 1;
    patch.deepest = -1;
    for (const Side side : kSides) patch.extreme[side] = {-1, 0.0, 0.0};
    labelling.contact_count += patch.area;
  }
  forEachContactCell(labelling.labels, [&](int row, int col, int label) {
    ContactPatch& patch = labelling.patches[static_cast<std::size_t>(label - 1)];
    const int cell = row * field.cols() + col;
    const auto gapAt = [&](int other_row, int other_col) {
      const bool is_in_frame =
          other_row >= 0 && other_row < field.rows() && other_col >= 0 && other_col < field.cols();
      return is_in_frame ? field.gap(other_row * field.cols() + other_col) : GapField::kInvalidGap;
    };
    const auto take = [&](Side side, bool applies, int row_step, int col_step) {
      const int best = patch.extreme[side].cell;
      if (!applies || (best >= 0 && !isDeeper(field, cell, best))) return;
      patch.extreme[side] = {cell, field.gap(cell), gapAt(row + row_step, col + col_step)};
    };
    take(kLeft, col == patch.min_col, 0, -1);
    take(kRight, col == patch.max_col, 0, 1);
    take(kTop, row == patch.min_row, -1, 0);
    take(kBottom, row == patch.max_row, 1, 0);
    if (patch.deepest < 0 || isDeeper(field, cell, patch.deepest)) patch.deepest = cell;
    patch.deepest_gap = field.gap(patch.deepest);
    patch.latest_gap = std::max(patch.latest_gap, field.gap(cell));
  });
  measureBoundary(field, labelling.labels, labelling.patches);
  return labelling;
}

NormalLoad sumLoads(const GapField& field, double approach, Touch touch, const CellForces& forces,
                    double mechanical_load) {
  NormalLoad load;
  load.mechanical = mechanical_load;
  for (const double gap : frameGaps(field)) {
    if (gap == GapField::kInvalidGap) continue;
    if (touches(gap, approach, touch)) {
      load.electrostatic += forces.electrostaticInContact();
    } else {
      load.van_der_waals += forces.vanDerWaals(gap - approach);
      load.electrostatic += forces.electrostatic(gap - approach);
    }
  }
  return load;
}

Prediction predict(const Options& options, const SurfacePair& surfaces) {
  options.check();
  Prediction prediction;
  prediction.rms_height = heightStatistics(surfaces.lower).rms_height;
  const double upper_rms_height =
      surfaces.upperIsPlane() ? 0.0 : heightStatistics(surfaces.upper).rms_height;
  prediction.composite_rms_height = std::hypot(prediction.rms_height, upper_rms_height);
  Problem problem{
      options, GapField(),
      AsperityLaw(ContactPair(options.lower, options.upper), options.interface.work_of_adhesion,
                  prediction.composite_rms_height, formulationOf(options), options.deformation)};
  problem.field.compute(surfaces);
  prediction.invalid_fraction =
      1.0 - static_cast<double>(problem.field.validCount()) / problem.field.cellCount();

  const double limit_gap = limitGap(problem.field, options.approach.max_contact_fraction);
  const double step =
      approachStep(options.solver.of<PaperOptions>(), prediction.composite_rms_height);
  State state;
  bool has_ended = false;
  while (!has_ended && prediction.steps < options.approach.max_steps) {
    ++prediction.steps;
    const double previous_approach = state.approach;
    const double approach = prediction.steps * step;
    const bool reaches_limit = limit_gap < approach;
    state = reaches_limit ? stateAt(problem, limit_gap, Touch::kUpTo)
                          : stateAt(problem, approach, Touch::kBelow);
    has_ended = state.balance.is_equilibrium || reaches_limit;
    if (state.balance.is_equilibrium) {
      state = refined(problem, state, previous_approach, step);
      prediction.status = Status::kEquilibrium;
    } else if (reaches_limit) {
      const bool all_plastic = std::all_of(
          state.responses.begin(), state.responses.end(),
          [](const AsperityResponse& asperity) { return asperity.elastic_share == 0.0; });
      prediction.status = all_plastic ? Status::kNoEquilibrium : Status::kBonded;
    }
    prediction.plastic_work += state.balance.plastic_force * (state.approach - previous_approach);
  }
  summarize(problem, state, prediction);
  return prediction;
}

}  // namespace plain
}  // namespace mems_stiction
