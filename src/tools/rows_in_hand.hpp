#pragma once

/// What a batch leaves beside its rows while it works, and what the next one makes of that: a scan
/// that ends the program itself must not end every call at the same row.

#include <cstddef>
#include <optional>
#include <string>

#include "batch_arguments.hpp"
#include "files/interruption.hpp"

namespace mems_stiction {

/// As long as the object lives, OUT.in_hand beside the rows says how many are worked on at a time.
/// It goes with the object, and with an interruption (INT, TERM, HUP). It stays if the program
/// crashes or is killed.
class RowsInHand {
 public:
  /// - @p rows_path a file that this program has locked; nothing is left beside a device
  /// @throw FileError if it cannot be written
  RowsInHand(const std::string& rows_path, std::size_t count);
  ~RowsInHand();
  RowsInHand(const RowsInHand&) = delete;
  RowsInHand& operator=(const RowsInHand&) = delete;

  /// How many rows an earlier call had in hand when it crashed or was killed, counted from the
  /// first that is missing; 0 if none did.
  std::size_t left() const { return left_; }

 private:
  std::optional<ScratchPath> path_;
  std::size_t left_ = 0;
};

/// Predicts a scan in another process of this program, which then ends instead of this one.
/// - @p input, shard the scan among those of its file: "1/1", or "3/5" of a bag
/// @return why there can be no row: the signal that has ended that process, or that it took more
/// than an hour; else empty
std::string causeOfDeath(const BatchArguments& arguments, const std::string& input,
                         const std::string& shard);

}  // namespace mems_stiction
