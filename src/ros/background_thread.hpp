#pragma once

/// @file
/// Work that must never keep a scan waiting.

namespace mems_stiction {

/// The calling thread gets a processor only as far as the node's other threads leave one, from now
/// until it ends.
void yieldToOtherThreads();

}  // namespace mems_stiction
