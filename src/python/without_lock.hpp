#pragma once

/// @file
/// Work without the interpreter's lock, also when the interpreter ends in the meantime.

#include <cxxabi.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include "threads_inside.hpp"

namespace mems_stiction {
namespace python {

/// Calls work(), which takes the interpreter's lock. While the interpreter ends, it ends every
/// other thread that asks for the lock (daemon threads), by an unwinding that no destructor of C++
/// lets through: the process would abort. Such a thread waits here for the process to end instead.
template <typename Work>
void takingLock(const Work& work) {
  try {
    work();
  } catch (const abi::__forced_unwind&) {
    while (true) pause();
  }
}

/// Lets go of the lock for as long as it lives. pybind11's gil_scoped_release, but for
/// takingLock() and threads_inside.hpp.
class WithoutLock {
 public:
  WithoutLock() : state_(nullptr) {
    countThisThread();  // while the interpreter cannot end
    state_ = PyEval_SaveThread();
  }
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;
  ~WithoutLock() {
    takingLock([this] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

}  // namespace python
}  // namespace mems_stiction
