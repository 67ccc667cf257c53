#pragma once

/// @file
/// Every name that the ROS layer gives to a topic, service or action, and how many messages each
/// connection may hold back.

#include <array>
#include <cstdint>

namespace mems_stiction {

// In
inline constexpr char kHeightTopic[] = "height";
inline constexpr char kScanInfoTopic[] = "scan_info";
inline constexpr char kCounterHeightTopic[] = "counter_height";
inline constexpr char kCounterScanInfoTopic[] = "counter_scan_info";

// Out
inline constexpr char kPredictionTopic[] = "prediction";
inline constexpr char kSummaryTopic[] = "summary";
inline constexpr char kPartVerdictTopic[] = "part_verdict";
inline constexpr char kVerdictTopic[] = "verdict";
inline constexpr char kDeformedHeightTopic[] = "deformed_height";
inline constexpr char kDeformedCounterHeightTopic[] = "deformed_counter_height";
inline constexpr char kContactMapTopic[] = "contact_map";
inline constexpr char kAsperitiesTopic[] = "asperities";
inline constexpr char kSurfacePointsTopic[] = "surface_points";
inline constexpr char kAsperityMarkersTopic[] = "asperity_markers";
inline constexpr char kPreviewTopic[] = "preview";
inline constexpr char kDeviceForceTopic[] = "device_force";
inline constexpr char kHalfSpaceTopic[] = "half_space";
inline constexpr char kHalfSpaceContactMapTopic[] = "half_space_contact_map";

/// Those that carry heights or maps by image_transport.
inline constexpr std::array<const char*, 6> kImageTopics = {
    kHeightTopic,     kCounterHeightTopic,      kDeformedHeightTopic, kDeformedCounterHeightTopic,
    kContactMapTopic, kHalfSpaceContactMapTopic};

// Services, in the node's private namespace
inline constexpr char kSetLoadService[] = "set_load";
inline constexpr char kSetVoltageService[] = "set_voltage";
inline constexpr char kSetMechanicalLoadService[] = "set_mechanical_load";
inline constexpr char kGetLoadService[] = "get_load";
inline constexpr char kGetPredictionService[] = "get_prediction";
inline constexpr char kPredictService[] = "predict";
inline constexpr char kResetSurfaceService[] = "reset_surface";
inline constexpr char kSolveHalfSpaceService[] = "solve_half_space";

// Actions, there too
inline constexpr char kSweepLoadAction[] = "sweep_load";
inline constexpr char kCycleContactAction[] = "cycle_contact";
inline constexpr char kHalfSpaceAction[] = "half_space";

/// Where dynamic_reconfigure mirrors what is set, there too; no setting of ours.
inline constexpr char kReconfigureParameters[] = "reconfigure";

/// What a caller reads when the node ends before it could answer.
inline constexpr char kShuttingDown[] = "the node is shutting down";

/// roscpp drops the oldest message of a full queue without a count. Ours is unlimited (0): messages
/// pass at once to the node's own queue, which is bounded by `queue_size` and counts what it drops.
inline constexpr std::uint32_t kSubscriberQueue = 0;
/// Predictions are small and there is one per scan: a subscriber may fall this far behind.
inline constexpr std::uint32_t kPredictionQueue = 1000;
/// Maps and lists are large: a slow subscriber gets the newest ones.
inline constexpr std::uint32_t kMapQueue = 20;
/// Views for rviz: only the newest matters.
inline constexpr std::uint32_t kDisplayQueue = 1;

}  // namespace mems_stiction
