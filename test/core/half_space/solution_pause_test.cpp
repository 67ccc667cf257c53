/// Solutions give way to urgent work, come back, and are not starved by it.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "half_space/solution_pause.hpp"
#include "mems_stiction/half_space/half_space_solver.hpp"
#include "support/analytic_surfaces.hpp"
#include "support/half_space_cases.hpp"

namespace mems_stiction {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// How long a call takes.
Clock::duration timeOf(const std::function<void()>& call) {
  const Clock::time_point begin = Clock::now();
  call();
  return Clock::now() - begin;
}

HalfSpaceProblem sphere() {
  return half_space_cases::onRigidPlane(analytic::paraboloid(24, 24, 1e-9, 1e-9, 60e-9), 88.8e9);
}

TEST(SolutionPause, NobodyWaitsForNothing) {
  SolutionPause pause;
  const std::atomic<bool> cancel{false};
  const std::function<void()> give_way = pause.waiter(cancel);
  { const SolutionPause::Request request(pause); }
  std::this_thread::sleep_for(milliseconds(50));
  EXPECT_LT(timeOf(give_way), milliseconds(20));  // a busy machine; nine times 50 ms if it were held
}

TEST(SolutionPause, WaitsUntilTheLastHoldIsLetGo) {
  SolutionPause pause;
  const std::atomic<bool> cancel{false};
  const std::function<void()> give_way = pause.waiter(cancel);
  std::this_thread::sleep_for(milliseconds(100));  // patience for 900 ms
  auto first = std::make_unique<SolutionPause::Request>(pause);
  auto second = std::make_unique<SolutionPause::Request>(pause);
  std::atomic<bool> is_let_go{false};
  std::thread urgent([&] {
    std::this_thread::sleep_for(milliseconds(50));
    first.reset();
    std::this_thread::sleep_for(milliseconds(50));
    is_let_go = true;
    second.reset();
  });
  give_way();
  EXPECT_TRUE(is_let_go);
  urgent.join();
}

TEST(SolutionPause, EndlessUrgentWorkLeavesATenth) {
  SolutionPause pause;
  const std::atomic<bool> cancel{false};
  const std::function<void()> give_way = pause.waiter(cancel);
  const SolutionPause::Request request(pause);
  give_way();  // what it has worked before counts once
  for (int i = 0; i < 3; ++i) {
    Clock::duration worked = timeOf([] { std::this_thread::sleep_for(milliseconds(10)); });
    const Clock::duration waited = timeOf(give_way);
    EXPECT_GE(waited, 9 * worked);
    EXPECT_LT(waited, 9 * worked + milliseconds(200));  // a busy machine
  }
}

TEST(SolutionPause, LongWorkDoesNotWaitForMoreThanASecond) {
  SolutionPause pause;
  const std::atomic<bool> cancel{false};
  const std::function<void()> give_way = pause.waiter(cancel);
  std::this_thread::sleep_for(milliseconds(200));
  const SolutionPause::Request request(pause);
  EXPECT_LT(timeOf(give_way), milliseconds(1500));  // 1800 ms by its work alone
}

TEST(SolutionPause, CancelEndsTheWait) {
  SolutionPause pause;
  std::atomic<bool> cancel{false};
  const std::function<void()> give_way = pause.waiter(cancel);
  std::this_thread::sleep_for(milliseconds(100));
  const SolutionPause::Request request(pause);
  std::thread other([&] {
    std::this_thread::sleep_for(milliseconds(50));
    cancel = true;
  });
  EXPECT_LT(timeOf(give_way), milliseconds(600));  // 900 ms otherwise
  other.join();
}

TEST(SolutionPause, TheSolverGivesWayBeforeEachIterationAndSolvesTheSame) {
  const HalfSpaceSolver solver(half_space_cases::elastic(1.608e-10));
  const SolvedHalfSpace alone = solver.solve(sphere());
  int asked = 0;
  HalfSpaceControl control;
  control.give_way = [&] { ++asked; };
  const SolvedHalfSpace beside = solver.solve(sphere(), control);
  EXPECT_GT(asked, alone.newton_steps);
  EXPECT_LE(asked, alone.products);
  EXPECT_EQ(beside.pull_off_force, alone.pull_off_force);
}

TEST(SolutionPause, ASolutionInHoldIsCancelledWithinASecond) {
  SolutionPause pause;
  std::atomic<bool> cancel{false};
  HalfSpaceControl control;
  control.cancel = &cancel;
  control.give_way = pause.waiter(cancel);
  std::atomic<bool> has_begun{false};
  control.on_state = [&](const ForcePoint&) { has_begun = true; };
  HalfSpaceProblem problem = sphere();
  problem.surfaces.lower = analytic::paraboloid(512, 512, 1e-9, 1e-9, 60e-9);
  SolvedHalfSpace solution;
  std::thread solving(
      [&] { solution = HalfSpaceSolver(half_space_cases::elastic(1.608e-10)).solve(problem, control); });
  while (!has_begun) std::this_thread::sleep_for(milliseconds(1));
  const SolutionPause::Request request(pause);
  std::this_thread::sleep_for(milliseconds(50));
  const Clock::duration ended = timeOf([&] {
    cancel = true;
    solving.join();
  });
  EXPECT_EQ(solution.status, HalfSpaceStatus::kCancelled);
  EXPECT_LT(ended, milliseconds(1000));
}

}  // namespace
}  // namespace mems_stiction
