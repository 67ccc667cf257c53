#pragma once

/// One line in place on the terminal of the standard error, gone at the end, or when the program is
/// interrupted. Elsewhere there is none.

#include <unistd.h>

#include <string>

#include "files/interruption.hpp"

namespace mems_stiction {

class StatusLine {
 public:
  StatusLine() = default;
  ~StatusLine() {
    if (is_shown_) writeInPlace("");
  }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool onTerminal() const { return on_terminal_; }
  /// In place of what is shown; nothing if there is no terminal.
  void show(const std::string& text) {
    if (!on_terminal_) return;
    is_shown_ = true;
    writeInPlace(text);
  }

 private:
  bool on_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
};

}  // namespace mems_stiction
