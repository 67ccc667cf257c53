#include "paper/approach_search.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/analytic_surfaces.hpp"
#include "support/sample_frames.hpp"

namespace mems_stiction {
namespace {

constexpr double kNm = 1e-9;
constexpr double kCutoffDistance = 0.165e-9;
constexpr double kContactFractionLimit = 0.5;

/// One search with everything that it needs.
struct Search {
  explicit Search(const GapField& field_in, double mechanical_load = 0.0)
      : field(field_in),
        setting{AsperityLaw(ContactPair(Material(), Material()), 0.05, 3 * kNm, Formulation::kPaper,
                            Deformation::kThreeRegimes),
                CellForces(InterfaceOptions(), kCutoffDistance, 0.0, field_in.cellArea()),
                mechanical_load,
                field_in.largestGap() / 60,
                1000,
                kCutoffDistance,
                false,
                WaterLaw()} {}

  const EquilibriumState& run(Connectivity connectivity = Connectivity::kFour) {
    order.build(field, kContactFractionLimit, setting.step);
    search.run(field, order, connectivity, setting, state);
    return state;
  }

  GapField field;
  SearchSetting setting;
  GapOrder order;
  ApproachSearch search;
  EquilibriumState state;
};

GapField roughField(int seed = 1) {
  return samples::Frame{
      "", samples::gaussian(90, 101, 10 * kNm, 10 * kNm, 3 * kNm, 60 * kNm, seed), {}}
      .gapField();
}

/// Caps and responses are those of the patches in which the search ended.
void expectPatchesDescribed(ApproachSearch& search, const GapField& field,
                            const SearchSetting& setting) {
  PatchSweep& sweep = search.sweep();
  ASSERT_EQ(search.caps().size(), sweep.livePatches().size());
  ASSERT_EQ(search.responses().size(), sweep.livePatches().size());
  for (std::size_t i = 0; i < search.caps().size(); ++i) {
    const std::int32_t id = sweep.livePatches()[i];
    const ContactPatch& patch = sweep.patch(id);
    PatchCentre centre = boxCentre(patch, field);
    if (sweep.patchOf(centre.cell) != id) centre = deepestCentre(patch, field);
    const CapCouple caps = capCouple(patch, field, centre, setting.cutoff_distance);
    EXPECT_EQ(search.caps()[i].centre.index, centre.cell.index);
    EXPECT_EQ(search.caps()[i].cap_radius, caps.cap_radius);
    EXPECT_EQ(search.caps()[i].height, caps.height);
    EXPECT_EQ(search.caps()[i].composite_radius, caps.composite_radius);
    EXPECT_EQ(search.caps()[i].squared_slope, caps.squared_slope);
    const AsperityResponse response(caps, setting.law);
    EXPECT_EQ(search.responses()[i].radius, response.radius);
    EXPECT_EQ(search.responses()[i].load_weight, response.load_weight);
    EXPECT_EQ(search.responses()[i].imposed_load, response.imposed_load);
    EXPECT_EQ(search.responses()[i].elastic_share, response.elastic_share);
  }
}

TEST(ApproachStep, isAsSetOrAFiftiethOfTheRoughnessOrTheCutOff) {
  PaperOptions options;
  EXPECT_EQ(approachStep(options, 5 * kNm), 5 * kNm / 50);
  EXPECT_EQ(approachStep(options, 0.0), kCutoffDistance);
  options.step = 2 * kNm;
  EXPECT_EQ(approachStep(options, 5 * kNm), 2 * kNm);
}

TEST(ApproachSearch, endsInEquilibriumUnderALoadThatTheContactsCarry) {
  Search search(roughField(), 1e-6);
  const EquilibriumState& state = search.run();
  ASSERT_EQ(state.status, Status::kEquilibrium);
  EXPECT_TRUE(state.balance.is_equilibrium);
  EXPECT_GE(state.balance.carried_load, state.load.total());
  EXPECT_EQ(state.load.mechanical, 1e-6);
  EXPECT_GT(state.approach, 0.0);
}

TEST(ApproachSearch, putsTheSurfacesAtTheGapOfTheLastCellThatTouches) {
  Search search(roughField(), 1e-6);
  const EquilibriumState& state = search.run();
  ASSERT_EQ(state.status, Status::kEquilibrium);
  const auto count = static_cast<std::size_t>(state.contact_count);
  EXPECT_EQ(search.order.cells()[count - 1].gap, state.approach);
  EXPECT_GT(search.order.cells()[count].gap, state.approach);
  EXPECT_GE(search.search.sweep().patchOf(search.order.cells()[count - 1].cell), 0);
  EXPECT_EQ(search.search.sweep().patchOf(search.order.cells()[count].cell), -1);
}

TEST(ApproachSearch, findsTheSameStateWhateverTheStep) {
  // one sphere: its force has one zero, which no step can miss
  GapField field;
  field.compute(analytic::paraboloid(121, 121, 4 * kNm, 4 * kNm, 2e-6));
  Search search(field, 1e-6);
  const EquilibriumState expected = search.run();
  ASSERT_EQ(expected.status, Status::kEquilibrium);
  const double step = search.setting.step;
  for (const double share : {0.13, 0.5, 1.7, 5.0}) {
    search.setting.step = share * step;
    const EquilibriumState& state = search.run();
    EXPECT_EQ(state.contact_count, expected.contact_count) << share;
    EXPECT_EQ(state.approach, expected.approach) << share;
    EXPECT_EQ(state.steps,
              static_cast<int>(std::floor(expected.approach / search.setting.step)) + 1)
        << share;
  }
}

TEST(ApproachSearch, endsBondedAtTheFirstLevelThatReachesTheContactFractionLimit) {
  Search search(roughField(), 1.0);  // [N]: no contact of a square micrometre carries it
  const EquilibriumState& state = search.run();
  EXPECT_EQ(state.status, Status::kBonded);
  EXPECT_FALSE(state.balance.is_equilibrium);
  EXPECT_EQ(state.contact_count, search.order.contactLimit());
  EXPECT_GE(state.contact_count, kContactFractionLimit * search.field.validCount());
}

TEST(ApproachSearch, endsWithoutEquilibriumWhenTheStepsAreUsedUp) {
  Search search(roughField(), 1.0);
  search.setting.max_steps = 7;
  const EquilibriumState& state = search.run();
  EXPECT_EQ(state.status, Status::kNoEquilibrium);
  EXPECT_EQ(state.steps, 7);
  EXPECT_EQ(state.approach, 7 * search.setting.step);
}

TEST(ApproachSearch, endsWithoutEquilibriumWhereEverythingFlowsAndNothingResists) {
  for (const Formulation formulation : {Formulation::kPaper, Formulation::kPrinted}) {
    for (const double load : {0.0, 1e-6, 1.0}) {
      Search search(roughField(), load);
      search.setting.law.formulation = formulation;
      search.setting.law.hardness = 1e6;  // [Pa]
      EXPECT_EQ(search.run().status, Status::kNoEquilibrium) << load;
      EXPECT_EQ(search.state.contact_count, search.order.contactLimit()) << load;
      EXPECT_FALSE(search.state.balance.is_equilibrium) << load;
    }
  }
}

TEST(ApproachSearch, goesOnWhereStoredEnergyIsTakenAway) {
  Search search(roughField(), 2e-6);
  search.setting.law.deformation = Deformation::kElastic;
  const EquilibriumState elastic = search.run();
  ASSERT_EQ(elastic.status, Status::kEquilibrium);
  search.setting.law.deformation = Deformation::kThreeRegimes;
  double previous = elastic.approach;
  // chi falls with the hardness: each rests later than the harder one, until nothing is left to
  // rest on
  for (const double hardness : {8e9, 6e9}) {
    search.setting.law.hardness = hardness;
    const EquilibriumState& state = search.run();
    EXPECT_EQ(state.status, Status::kEquilibrium) << hardness;
    EXPECT_GT(state.approach, previous) << hardness;
    previous = state.approach;
  }
}

TEST(ApproachSearch, describesThePatchesThatItEndedIn) {
  for (const samples::Frame& frame : samples::allFrames()) {
    for (const double load : {0.0, 1e-7, 1.0}) {
      for (const Connectivity connectivity : {Connectivity::kFour, Connectivity::kEight}) {
        SCOPED_TRACE(frame.name + " " + std::to_string(load));
        Search search(frame.gapField(), load);
        if (search.setting.step <= 0.0) search.setting.step = kCutoffDistance;
        search.run(connectivity);
        expectPatchesDescribed(search.search, search.field, search.setting);
      }
    }
  }
}

TEST(ApproachSearch, recordsOnePointPerStepWhenAsked) {
  Search search(roughField(), 1e-6);
  EXPECT_TRUE(search.run().curve.empty());
  search.setting.record_curve = true;
  const EquilibriumState& state = search.run();
  ASSERT_EQ(state.curve.size(), static_cast<std::size_t>(state.steps));
  for (std::size_t i = 0; i + 1 < state.curve.size(); ++i) {
    EXPECT_EQ(state.curve[i].approach, static_cast<double>(i + 1) * search.setting.step);
    EXPECT_LE(state.curve[i].contact_fraction, state.curve[i + 1].contact_fraction);
    EXPECT_GE(state.curve[i + 1].normal_load, 1e-6);
  }
  EXPECT_EQ(state.curve.back().approach, state.approach);
  EXPECT_LE(state.curve.back().generalized_force, 0.0);
}

TEST(ApproachSearch, sumsTheWorkOfFlowAlongTheApproach) {
  Search search(roughField(), 1e-6);
  search.setting.law.deformation = Deformation::kElastic;
  EXPECT_EQ(search.run().plastic_work, 0.0);
  search.setting.law.deformation = Deformation::kThreeRegimes;
  search.setting.law.hardness = 1e9;
  EXPECT_GT(search.run().plastic_work, 0.0);
}

TEST(ApproachSearch, leavesNoTraceOfThePreviousFrame) {
  Search fresh(roughField(2), 1e-6);
  fresh.run();
  Search used(roughField(1), 1.0);
  used.setting.record_curve = true;
  used.run(Connectivity::kEight);
  used.field = fresh.field;
  used.setting = fresh.setting;
  const EquilibriumState& state = used.run();
  EXPECT_EQ(state.status, fresh.state.status);
  EXPECT_EQ(state.contact_count, fresh.state.contact_count);
  EXPECT_EQ(state.approach, fresh.state.approach);
  EXPECT_EQ(state.balance.load_share, fresh.state.balance.load_share);
  EXPECT_EQ(state.plastic_work, fresh.state.plastic_work);
  EXPECT_TRUE(state.curve.empty());
  expectPatchesDescribed(used.search, used.field, used.setting);
}

}  // namespace
}  // namespace mems_stiction
