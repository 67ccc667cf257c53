#pragma once

/// @file
/// How many files and connections the process may have open at once (RLIMIT_NOFILE, `ulimit -n`).

#include <string>

namespace mems_stiction {

/// Raises the limit as far as the process may raise its own, to 1024 at most: select() of other
/// libraries takes no more. A higher limit stays.
/// @return what is missing, as a sentence without its full stop, if a node has fewer than 256 then;
/// else empty. roscpp keeps 32 descriptors free and refuses, without a word, every connection that
/// would take one of them.
std::string lackOfOpenFiles();

}  // namespace mems_stiction
