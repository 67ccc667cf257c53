#include "ros/call_queue.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

namespace mems_stiction {
namespace {

using std::chrono::seconds;

class Callback : public ros::CallbackInterface {
 public:
  explicit Callback(std::function<void()> run) : run_(std::move(run)) {}
  CallResult call() override {
    run_();
    return Success;
  }

 private:
  std::function<void()> run_;
};

void add(CallQueue& queue, std::function<void()> run) {
  queue.addCallback(boost::make_shared<Callback>(std::move(run)));
}

TEST(CallQueue, CallsThatWaitKeepNoOtherWaiting) {
  CallQueue queue;
  queue.start();
  std::promise<void> come;
  const std::shared_future<void> waited_for = come.get_future().share();
  std::atomic<int> waiting{0};
  std::atomic<int> done{0};
  for (int call = 0; call < 100; ++call) {
    add(queue, [&] {
      ++waiting;
      waited_for.wait();
      ++done;
    });
  }
  std::promise<void> called;
  add(queue, [&] { called.set_value(); });
  EXPECT_EQ(called.get_future().wait_for(seconds(120)), std::future_status::ready);
  while (waiting < 100) std::this_thread::yield();  // whoever took it may not have come so far
  EXPECT_EQ(done, 0);
  come.set_value();
  queue.stop();
  EXPECT_EQ(done, 100);
}

TEST(CallQueue, StopWaitsForWhatRunsAndForgetsTheRest) {
  CallQueue queue;
  add(queue, [] { FAIL() << "not started"; });
  queue.stop();
  CallQueue running;
  running.start();
  std::promise<void> begun;
  std::atomic<bool> done{false};
  add(running, [&] {
    begun.set_value();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    done = true;
  });
  begun.get_future().wait();
  running.stop();
  EXPECT_TRUE(done);
  running.stop();
}

TEST(CallQueue, WhatACallThrowsEndsNoThread) {
  CallQueue queue;
  queue.start();
  for (int call = 0; call < 20; ++call) add(queue, [] { throw std::runtime_error("of a peer"); });
  std::promise<void> called;
  add(queue, [&] { called.set_value(); });
  EXPECT_EQ(called.get_future().wait_for(seconds(120)), std::future_status::ready);
}

TEST(CallQueue, ThreadsLeaveAndComeAgain) {
  CallQueue queue;
  queue.start();
  for (int round = 0; round < 2; ++round) {
    std::vector<std::promise<void>> called(10);
    for (std::promise<void>& one : called) {
      add(queue, [&one] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        one.set_value();
      });
    }
    for (std::promise<void>& one : called) {
      EXPECT_EQ(one.get_future().wait_for(seconds(120)), std::future_status::ready);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  }
}

}  // namespace
}  // namespace mems_stiction
