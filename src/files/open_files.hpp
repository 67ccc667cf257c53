#pragma once

/// @file
/// Files that a process has open from its start: how many there may be (RLIMIT_NOFILE, `ulimit
/// -n`), and the three standard ones.

#include <string>

namespace mems_stiction {

/// Raises the limit as far as the process may raise its own, to 1024 at most: select() of other
/// libraries takes no more. A higher limit stays.
/// @return what is missing, as a sentence without its full stop, if a node has fewer than 256 then;
/// else empty. roscpp keeps 32 descriptors free and refuses, without a word, every connection that
/// would take one of them.
std::string lackOfOpenFiles();

/// Where the caller has closed a standard stream, what is opened next would take its descriptor,
/// and whatever is printed would be written into that file. For the begin of a program: the null
/// device takes the place of each, and what is to be printed cannot be written, as if it were
/// closed.
void holdStandardDescriptors();

}  // namespace mems_stiction
