#include "row_queue.hpp"

#include <algorithm>
#include <utility>

#include "own_thread.hpp"

namespace mems_stiction {

RowQueue::RowQueue(const BatchArguments& arguments, const Configuration& configuration,
                   BatchScans& scans)
    : scans_(scans),
      ahead_(configuration.scan, fileOptions(arguments), scans.settingsFileChecksum(),
             arguments.workers) {
  const std::size_t workers =
      std::max<std::size_t>(1, std::min<std::size_t>(arguments.workers, scans.size()));
  for (std::size_t i = 0; i < workers; ++i) {
    makers_.push_back(std::make_unique<RowMaker>(arguments, configuration, ahead_));
  }
}

void RowQueue::expect(std::vector<std::size_t> numbers) {
  numbers_ = std::move(numbers);
  ahead_.expect(scans_.files(numbers_));
}

BatchRow RowQueue::next(const std::function<void(const std::string&)>& tell) {
  const bool is_alone = makers_.size() == 1;
  for (; started_ < numbers_.size() && rows_.size() < makers_.size(); ++started_) {
    // A maker is free again when the row before its next one has been taken.
    RowMaker& maker = *makers_[started_ % makers_.size()];
    const auto make = [&maker, &tell, is_alone, scan = scans_.read(numbers_[started_])] {
      return maker.row(
          scan, is_alone ? tell : [](const std::string&) {});
    };
    rows_.push_back(is_alone ? std::async(std::launch::deferred, make) : onOwnThread(make));
  }
  std::future<BatchRow> row = std::move(rows_.front());
  rows_.pop_front();
  return row.get();
}

}  // namespace mems_stiction
