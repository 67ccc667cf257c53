#pragma once

/// The rows of a batch in their order, several made at a time.

#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "batch_scans.hpp"
#include "row_maker.hpp"
#include "scans_ahead.hpp"

namespace mems_stiction {

class RowQueue {
 public:
  /// @param arguments, configuration, scans must outlive this
  /// @throw OptionsError if the configuration cannot be used
  RowQueue(const BatchArguments& arguments, const Configuration& configuration, BatchScans& scans);

  /// Rows that may be worked on at a time.
  std::size_t inHand() const { return makers_.size() + ahead_.atATime(); }

  /// Which rows will be asked for, in this order: their files are read ahead.
  void expect(std::vector<std::size_t> numbers);

  /// @param tell what the half-space is at; nothing where several workers make the rows. @throw as
  /// RowMaker::row()
  BatchRow next(const std::function<void(const std::string&)>& tell);

 private:
  BatchScans& scans_;
  ScansAhead ahead_;
  std::vector<std::unique_ptr<RowMaker>> makers_;
  std::vector<std::size_t> numbers_;
  std::size_t started_ = 0;
  std::deque<std::future<BatchRow>> rows_;  ///< their threads end before what they use goes
};

}  // namespace mems_stiction
