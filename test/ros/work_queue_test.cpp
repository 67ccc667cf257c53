#include "mems_stiction/ros/work_queue.hpp"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace mems_stiction {
namespace {

using Numbers = std::vector<int>;

TEST(WorkQueue, RunsScansInOrderAndCallsBeforeThem) {
  Numbers ran;
  WorkQueue queue(0);
  std::promise<void> gate;
  queue.push([&] { gate.get_future().wait(); });
  queue.start();
  for (int scan = 0; scan < 3; ++scan) {
    queue.pushScan([&ran, scan] { ran.push_back(scan); }, [] { ADD_FAILURE() << "an unlimited queue drops nothing"; });
  }
  std::thread caller([&] { EXPECT_EQ(queue.call([&ran] { return ran.push_back(100), 7; }), 7); });
  while (queue.waitingScans() != 3) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // lets the call get into the queue
  gate.set_value();
  caller.join();
  queue.call([] {});
  while (queue.waitingScans() != 0) std::this_thread::yield();
  queue.stop();
  ASSERT_FALSE(ran.empty());
  EXPECT_EQ(ran.front(), 100);
  for (std::size_t i = 1; i < ran.size(); ++i) EXPECT_EQ(ran[i], static_cast<int>(i) - 1);
}

TEST(WorkQueue, DropsTheOldestScansAndNothingElse) {
  Numbers ran, dropped;
  std::promise<void> all_done;
  WorkQueue queue(2);
  queue.push([&ran] { ran.push_back(100); });
  for (int scan = 0; scan < 5; ++scan) {
    queue.pushScan([&ran, scan] { ran.push_back(scan); }, [&dropped, scan] { dropped.push_back(scan); });
  }
  queue.push([&all_done] { all_done.set_value(); });
  EXPECT_EQ(dropped, (Numbers{0, 1, 2}));
  queue.start();
  all_done.get_future().wait();
  EXPECT_EQ(ran, (Numbers{100, 3, 4}));
}

TEST(WorkQueue, ACallGetsTheExceptionOfItsFunction) {
  WorkQueue queue(0);
  queue.start();
  EXPECT_THROW(queue.call([]() -> int { throw std::invalid_argument("x"); }), std::invalid_argument);
  EXPECT_EQ(queue.call([] { return 3; }), 3);
}

TEST(WorkQueue, ACallThatIsNotRunAnyMoreEndsWithAnError) {
  WorkQueue queue(0);
  std::promise<void> entered, gate;
  queue.push([&] {
    entered.set_value();
    gate.get_future().wait();
  });
  queue.start();
  entered.get_future().wait();
  std::thread caller([&] { EXPECT_THROW(queue.call([] { return 1; }), std::future_error); });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // lets the call get into the queue
  std::thread stopper([&] { queue.stop(); });
  caller.join();
  gate.set_value();
  stopper.join();
  EXPECT_THROW(queue.call([] { return 1; }), std::future_error);
}

// Three callers that ask without end: one call is always waiting, and scans must get their half all the same.
TEST(WorkQueue, CallsThatNeverEndLeaveHalfOfTheTimeToScans) {
  const auto work = [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
  WorkQueue queue(0);
  std::atomic<int> calls{0}, scans{0};
  for (int scan = 0; scan < 1000; ++scan) {
    queue.pushScan([&] { work(), ++scans; }, [] {});
  }
  queue.start();
  std::atomic<bool> is_over{false};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 3; ++caller) {
    callers.emplace_back([&] {
      while (!is_over) queue.call([&] { work(), ++calls; });
    });
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  is_over = true;
  for (std::thread& caller : callers) caller.join();
  EXPECT_GT(calls, 10);
  EXPECT_GE(scans, calls - 5);  // the callers' first and last calls are free
}

}  // namespace
}  // namespace mems_stiction
