#pragma once

/// @file
/// Publishes scans as the node takes them: `height` and `scan_info` with one stamp, no stamp twice,
/// and no faster than the node answers.

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "mems_stiction/StictionPrediction.h"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/height_map/scan_identity.hpp"
#include "source/source_options.hpp"

namespace mems_stiction {

/// publish() and waitsFor() are for one thread; the node's answers come on another.
class ScanPublisher {
 public:
  ScanPublisher(ros::NodeHandle& handle, const SourceOptions& options);

  /// Why a scan that is published now might be lost; empty = it arrives.
  std::string waitsFor();

  /// A stamp that was given, as by an earlier run [ns].
  void reserve(std::uint64_t stamp) { stamps_.insert(stamp); }
  /// The stamp [ns], or the next that was not given yet; never 0.
  std::uint64_t freeStamp(std::uint64_t stamp) const;

  /// - @p frame that the heights are in
  /// - @p stamp of freeStamp()
  void publish(const HeightMap& surface, const ScanIdentity& identity, const std::string& frame,
               std::uint64_t stamp);

 private:
  template <typename Message>
  ros::Publisher advertise(ros::NodeHandle& handle, const char* topic,
                           std::multiset<std::string>& listeners);
  bool isHeard();
  /// Of the audience, the first node that is not there yet; empty = all are, or were, or the time
  /// is over.
  std::string missingListener();
  void takeAnswer(const StictionPrediction& prediction);

  const std::size_t max_ahead_;
  const double answer_timeout_;
  const std::string listener_;         ///< its full name; empty = anybody
  std::vector<std::string> audience_;  ///< their full names; empty once all have listened
  const ros::SteadyTime audience_until_;
  const bool has_audience_;
  ros::SteadyTime last_come_;  ///< a listener: the audience may still have to join its answers
  std::mutex mutex_;
  std::multiset<std::string> height_listeners_, info_listeners_;  ///< names of nodes
  ros::Publisher height_, info_;
  ros::Subscriber predictions_;
  std::set<std::uint64_t> stamps_;
  std::uint32_t count_ = 0;
  std::map<std::uint64_t, ros::SteadyTime> unanswered_;  ///< when they were published, by stamp
};

}  // namespace mems_stiction
