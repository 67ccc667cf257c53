#include "ros/work_queue.hpp"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
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
  std::promise<void> is_at_gate;  // else a worker that starts late takes the call first
  std::promise<void> gate;
  queue.push([&] {
    is_at_gate.set_value();
    gate.get_future().wait();
  });
  queue.start();
  is_at_gate.get_future().wait();
  for (int scan = 0; scan < 3; ++scan) {
    queue.pushScan([&ran, scan] { ran.push_back(scan); },
                   [] { ADD_FAILURE() << "an unlimited queue drops nothing"; });
  }
  std::thread caller([&] { EXPECT_EQ(queue.call([&ran] { return ran.push_back(100), 7; }), 7); });
  while (queue.waitingScans() != 3) std::this_thread::yield();
  while (queue.waitingCalls() != 1) std::this_thread::yield();
  gate.set_value();
  caller.join();
  queue.call([] {});
  while (queue.waitingScans() != 0) std::this_thread::yield();
  queue.stop();
  ASSERT_FALSE(ran.empty());
  EXPECT_EQ(ran.front(), 100);
  for (std::size_t i = 1; i < ran.size(); ++i) EXPECT_EQ(ran[i], static_cast<int>(i) - 1);
}

TEST(WorkQueue, AJobThatThrowsEndsNeitherTheProcessNorTheJobsBehindIt) {
  std::promise<void> all_done;
  WorkQueue queue(0);
  queue.push([] { throw std::runtime_error("a publisher failed"); });
  queue.pushScan([] { throw std::bad_alloc(); }, [] {});
  queue.push([&all_done] { all_done.set_value(); });
  queue.start();
  EXPECT_EQ(all_done.get_future().wait_for(std::chrono::seconds(60)), std::future_status::ready);
  EXPECT_THROW(queue.call([]() -> int { throw std::runtime_error("for the caller"); }),
               std::runtime_error);
}

TEST(WorkQueue, DropsTheOldestScansAndNothingElse) {
  Numbers ran, dropped;
  std::promise<void> all_done;
  WorkQueue queue(2);
  queue.push([&ran] { ran.push_back(100); });
  for (int scan = 0; scan < 5; ++scan) {
    queue.pushScan([&ran, scan] { ran.push_back(scan); },
                   [&dropped, scan] { dropped.push_back(scan); });
  }
  queue.push([&all_done] { all_done.set_value(); });
  EXPECT_EQ(dropped, (Numbers{0, 1, 2}));
  queue.start();
  all_done.get_future().wait();
  EXPECT_EQ(ran, (Numbers{100, 3, 4}));
}

TEST(WorkQueue, DropsTheOldestScansBeyondItsMemoryButNeverTheNewest) {
  Numbers dropped;
  WorkQueue queue(0, 100);
  for (int scan = 0; scan < 5; ++scan) {
    queue.pushScan([] {}, [&dropped, scan] { dropped.push_back(scan); }, 40);
  }
  EXPECT_EQ(dropped, (Numbers{0, 1, 2}));
  EXPECT_EQ(queue.waitingBytes(), 80U);
  queue.pushScan([] {}, [] { ADD_FAILURE() << "the newest stays"; }, 400);
  EXPECT_EQ(dropped, (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(queue.waitingBytes(), 400U);
}

class CounterSurfacesTest : public ::testing::Test {
 protected:
  void scan(int number) { queue_.pushScan(running(number), dropping(number), 40); }
  void counterSurface(int number) {
    queue_.pushCounterSurface(running(number), dropping(number), 40);
  }
  std::function<void()> running(int number) {
    return [this, number] { ran_.push_back(number); };
  }
  std::function<void()> dropping(int number) {
    return [this, number] { dropped_.push_back(number); };
  }
  Numbers ran() {
    std::promise<void> all_done;
    queue_.push([&] { all_done.set_value(); });
    queue_.start();
    all_done.get_future().wait();
    return ran_;
  }

  Numbers ran_, dropped_;
  WorkQueue queue_{0, 100};
};

TEST_F(CounterSurfacesTest, OfThoseWithoutAScanBetweenThemTheNewestIsEnough) {
  for (int number = 100; number < 105; ++number) counterSurface(number);
  EXPECT_EQ(dropped_, (Numbers{100, 101, 102}));
  EXPECT_EQ(queue_.waitingBytes(), 80U);
  EXPECT_EQ(ran(), (Numbers{103, 104}));
}

TEST_F(CounterSurfacesTest, ScansKeepThatWhichCameBeforeThem) {
  counterSurface(100), scan(1), counterSurface(101), scan(2);
  EXPECT_EQ(dropped_, (Numbers{1, 100}));  // nobody needs 100 any more
  counterSurface(102);
  EXPECT_EQ(queue_.waitingBytes(),
            120U);  // the newest of either kind, and what the scan is pressed against
  EXPECT_EQ(ran(), (Numbers{101, 2, 102}));
}

TEST_F(CounterSurfacesTest, ManyScansAreNoReasonToDropOne) {
  WorkQueue queue(1);
  queue.pushCounterSurface([] {}, dropping(100), 40);
  for (int number = 1; number < 4; ++number) queue.pushScan([] {}, dropping(number), 40);
  queue.pushCounterSurface([] {}, dropping(101), 40);
  EXPECT_EQ(dropped_, (Numbers{1, 2}));
}

std::size_t residentBytes() {
  std::size_t pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * 4096;
}

TEST(WorkQueue, GivesTheMemoryOfABacklogBack) {
  if (std::getenv("MEMS_STICTION_SANITIZER") != nullptr)
    GTEST_SKIP() << "a sanitizer keeps memory that was freed";
  constexpr std::size_t kScan = 1 << 20;
  WorkQueue queue(0);
  ASSERT_EQ(std::vector<char>(16 << 20, 'x').back(),
            'x');  // from now on the allocator keeps smaller blocks
  const std::size_t before = residentBytes();
  std::vector<std::shared_ptr<std::vector<char>>>
      kept;  // between the scans, so that the heap cannot shrink by itself
  for (int scan = 0; scan < 200; ++scan) {
    auto pixels = std::make_shared<std::vector<char>>(kScan, 'x');
    queue.pushScan([pixels] {}, [] {}, kScan);
    pixels.reset();
    kept.push_back(std::make_shared<std::vector<char>>(4096, 'x'));
  }
  ASSERT_GT(residentBytes(), before + 150 * kScan);
  queue.start();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (residentBytes() > before + 50 * kScan && std::chrono::steady_clock::now() < end)
    std::this_thread::yield();
  EXPECT_LT(residentBytes(), before + 50 * kScan);
}

TEST(WorkQueue, ACallGetsTheExceptionOfItsFunction) {
  WorkQueue queue(0);
  queue.start();
  EXPECT_THROW(queue.call([]() -> int { throw std::invalid_argument("x"); }),
               std::invalid_argument);
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
  while (queue.waitingCalls() != 1) std::this_thread::yield();
  std::thread stopper([&] { queue.stop(); });
  caller.join();
  gate.set_value();
  stopper.join();
  EXPECT_THROW(queue.call([] { return 1; }), std::future_error);
}

// Three callers that ask without end: one call is always waiting, and scans must get their half all
// the same.
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
  while (calls < 50) std::this_thread::yield();
  is_over = true;
  for (std::thread& caller : callers) caller.join();
  EXPECT_GE(scans, calls - 5);  // the callers' first and last calls are free
}

}  // namespace
}  // namespace mems_stiction
