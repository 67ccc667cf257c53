#pragma once

/// @file
/// What the end of a process must leave alone while threads work in the core.
///
/// A daemon thread of Python goes on in the core, or ends, while the main thread leaves by exit(),
/// which destroys the static objects of every library: of the core, OpenCV, TBB. A thread that
/// meets one of them half destroyed ends the process by a signal ("pure virtual method called").

namespace mems_stiction {
namespace python {

/// Counts the calling thread among those that work in the core, until the thread has ended.
void countThisThread();

/// From now on, a process whose interpreter has ended leaves with its status and without destroying
/// static objects if a thread that was counted still lives. Buffers of stdio are written before.
/// To be called once, when the module is loaded.
void spareStaticObjects();

}  // namespace python
}  // namespace mems_stiction
