#include "import/channel_choice.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

#include "errors/short_number.hpp"
#include "height_map/unmeasured.hpp"
#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

using Words = std::vector<std::string>;

bool isIn(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool containsAny(const std::string& text, const Words& parts) {
  return std::any_of(parts.begin(), parts.end(), [&text](const std::string& part) {
    return text.find(part) != std::string::npos;
  });
}

/// Small letters; everything else becomes a single blank.
std::string lettersOf(const std::string& title) {
  std::string text;
  for (const char c : lowered(title)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalnum(byte) != 0) {
      text += c;
    } else if (!text.empty() && text.back() != ' ') {
      text += ' ';
    }
  }
  if (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// Pixels of one number each, or (height, quality).
bool isOneValue(const FileChannel& channel) {
  return channel.values.channels() == 1 || channel.values.type() == CV_32FC2;
}

bool isLength(const FileChannel& channel) {
  if (!isOneValue(channel)) return false;
  const auto is_metre = [&channel](const std::string& unit) {
    return unit == "m" || (channel.takes_settings && unit.empty());
  };
  return is_metre(channel.unit_xy) && is_metre(channel.unit_z);
}

/// Number of times that pixels of a scan are at most as long as wide; an array of curves is no
/// image.
constexpr double kMostElongated = 1000.0;

bool isImage(const FileChannel& channel) {
  if (channel.takes_settings) return true;
  const double ratio = channel.width / channel.values.cols / (channel.height / channel.values.rows);
  return !(ratio > kMostElongated || ratio < 1.0 / kMostElongated);
}

/// Largest less smallest height; 0 if there is none. In one pass: files have a dozen channels, and
/// each is asked.
/// - @p channel of type CV_64FC1
double rangeOf(const FileChannel& channel) {
  double least = kLargestHeight;
  double most = -kLargestHeight;
  for (int row = 0; row < channel.values.rows; ++row) {
    const double* line = channel.values.ptr<double>(row);
    for (int col = 0; col < channel.values.cols; ++col) {
      const bool is_height = std::fabs(line[col]) < kLargestHeight;  // false for NaN
      const double low = is_height ? line[col] : kLargestHeight;
      const double high = is_height ? line[col] : -kLargestHeight;
      least = low < least ? low : least;
      most = high > most ? high : most;
    }
  }
  return most < least ? 0.0 : most - least;
}

/// Closed-loop sensors and the piezo's own calibration differ by some percent.
constexpr double kReachMargin = 1.2;

bool isBeyondReach(const FileChannel& channel) {
  return channel.reach > 0.0 && channel.unit_z == "m" && channel.values.type() == CV_64FC1 &&
         rangeOf(channel) > kReachMargin * channel.reach;
}

/// Heights that span more than the scan is wide, or than the instrument can move, are another
/// quantity, whatever title and unit say: volts of a sensor that was never calibrated. Nothing is
/// said of values without a unit.
bool isSteep(const FileChannel& channel) {
  if (channel.takes_settings || channel.values.type() != CV_64FC1) return false;
  return isBeyondReach(channel) || rangeOf(channel) > std::max(channel.width, channel.height);
}

/// The direction that a scan was stopped in, or before.
bool isUnmeasured(const FileChannel& channel) {
  if (channel.takes_settings || channel.values.type() != CV_64FC1) return false;
  return cv::countNonZero(validMask(channel.values)) == 0;
}

/// Lower is likelier to be the height; kOtherSignal is never taken by itself.
enum Likelihood { kSensor, kHeight, kUnknown, kOtherSignal };

/// Signals that other channels carry in metres are told by one word anywhere. Signals that have
/// another unit by nature can be in metres only by their file's mistake: they are told by a title
/// that says nothing else, so that "Adhesion sample 4" may be a height.
bool isOtherSignal(const std::string& letters) {
  if (containsAny(letters, {"error", "deflection", "amplitude", "deformation", "indentation"}))
    return true;
  static const Words kSignals = {
      "friction", "lateral",     "current",   "potential", "adhesion", "stiffness", "modulus",
      "force",    "dissipation", "peak",      "intensity", "log",      "dmt",       "sneddon",
      "voltage",  "peakforce",   "frequency", "shift",     "df",       "i",         "quality"};
  static const Words kManner = {"forward", "backward", "trace", "retrace", "fwd",
                                "bwd",     "left",     "right", "channel"};
  bool is_signal = false;
  for (const std::string& word : wordsOf(letters)) {
    if (isIn(kSignals, word)) {
      is_signal = true;
    } else if (!isIn(kManner, word) && word.find_first_not_of("0123456789") != std::string::npos) {
      return false;
    }
  }
  return is_signal;
}

/// Lower is taken first: steep (1) and empty (2) channels last, then what the title says, then
/// backward.
using Rank = std::tuple<int, Likelihood, bool>;

Likelihood likelihood(const FileChannel& channel) {
  const std::string letters = lettersOf(channel.title);
  if (isOtherSignal(letters)) return kOtherSignal;
  const Words words = wordsOf(letters);
  const bool is_height = letters == "z" || containsAny(letters, {"height", "topo", "depth",
                                                                 "surface", "z axis", "zaxis"});
  if (containsAny(letters, {"zsensor", "z sensor", "height sensor", "heightsensor", "axissensor",
                            "axis sensor", "z height"}) ||
      (is_height && (isIn(words, "measured") || isIn(words, "sensor") ||
                     containsAny(letters, {"closed loop"})))) {
    return kSensor;
  }
  return is_height ? kHeight : kUnknown;
}

bool isBackward(const FileChannel& channel) {
  if (endsWith(channel.title, " [Left]"))
    return true;  // RHK names the way that the tip went; it begins to the right
  if (channel.title.find("<-") != std::string::npos ||
      channel.title.find("\xE2\x86\x90") != std::string::npos) {
    return true;
  }
  static const Words kBackward = {"backward", "backwards", "bwd", "back", "bw",
                                  "retrace",  "reverse",   "rev", "rl"};
  const Words words = wordsOf(lettersOf(channel.title));
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return isIn(kBackward, word) || containsAny(word, {"retrace", "backward"});
  });
}

/// "0: Height [m], 1: Phase [deg]"
std::string list(const std::vector<FileChannel>& channels) {
  std::string text;
  for (const FileChannel& channel : channels) {
    text += (text.empty() ? "" : ", ") + channelName(channel) + " ";
    if (!channel.takes_settings) {
      text += "[" + (channel.unit_z.empty() ? "no unit" : channel.unit_z) + "]";
    } else {
      text += "[" + std::to_string(channel.values.cols) + " x " +
              std::to_string(channel.values.rows) +
              (channel.unit_z.empty() ? "" : ", " + channel.unit_z) +
              (isOneValue(channel)
                   ? "]"
                   : ", " + std::to_string(channel.values.channels()) + " values per pixel]");
    }
  }
  return text;
}

}  // namespace

std::string channelName(const FileChannel& channel) {
  return std::to_string(channel.id) + ": " + (channel.title.empty() ? "(no title)" : channel.title);
}

std::size_t chooseHeightChannel(const std::vector<FileChannel>& channels,
                                const std::string& wanted) {
  if (channels.empty()) throw FileError("the file has no image channel");
  if (!wanted.empty()) {
    for (const bool by_number : {true, false}) {
      for (std::size_t i = 0; i < channels.size(); ++i) {
        if (wanted != (by_number ? std::to_string(channels[i].id) : channels[i].title)) continue;
        if (isLength(channels[i])) return i;
        throw FileError("the channel " + channelName(channels[i]) +
                        " is not in metres along x, y and z; there are: " + list(channels));
      }
    }
    throw FileError("there is no channel '" + wanted + "'; there are: " + list(channels));
  }
  std::size_t best = channels.size();
  std::size_t equals = 0;
  Rank rank_of_best;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const FileChannel& channel = channels[i];
    const Likelihood kind = likelihood(channel);
    if (!isLength(channel) || !isImage(channel) || kind == kOtherSignal) continue;
    const int doubt = channels.size() == 1    ? 0
                      : isUnmeasured(channel) ? 2
                      : isSteep(channel)      ? 1
                                              : 0;
    const Rank rank(doubt, kind, isBackward(channel));
    if (best == channels.size() || rank < rank_of_best) {
      best = i;
      rank_of_best = rank;
      equals = 1;
    } else if (rank == rank_of_best) {
      ++equals;
    }
  }
  if (best == channels.size() && channels.size() == 1 && !isOneValue(channels[0])) {
    throw FileError(std::to_string(channels[0].values.channels()) +
                    " channels per pixel are a picture, a height map has 1");
  }
  if (best == channels.size()) {
    throw FileError("the file has no channel of heights in metres over metres; there are: " +
                    list(channels));
  }
  if (equals > 1 && channels[best].takes_settings) {
    throw FileError(
        "the file does not say which of its images the heights are: name one with --channel; there "
        "are: " +
        list(channels));
  }
  return best;
}

std::string passedOver(const std::vector<FileChannel>& channels, std::size_t chosen) {
  const auto rank = [&channels](std::size_t i) {  // without steepness
    return std::make_tuple(likelihood(channels[i]), isBackward(channels[i]), i);
  };
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const FileChannel& channel = channels[i];
    if (!isLength(channel) || !isImage(channel) || rank(i) >= rank(chosen)) continue;
    const std::string taken = channelName(channels[chosen]) + " is taken: ";
    if (isUnmeasured(channel)) return taken + channelName(channel) + " has no measured pixel";
    if (!isSteep(channel)) continue;
    return taken + "the heights of " + channelName(channel) +
           (isBeyondReach(channel) ? " span more than the piezo can move"
                                   : " span more than the scan is wide");
  }
  return "";
}

std::string othersOfOtherSize(const std::vector<FileChannel>& channels, std::size_t chosen) {
  const FileChannel& taken = channels[chosen];
  const auto size = [](const FileChannel& channel) {
    return std::to_string(channel.values.cols) + " x " + std::to_string(channel.values.rows) +
           " pixels of " + shortNumber(channel.width) + " x " + shortNumber(channel.height) + " m";
  };
  constexpr int kMostNamed = 5;
  std::string others;
  int count = 0;
  for (const FileChannel& channel : channels) {
    const bool is_alike = isLength(channel) && isImage(channel) && !channel.takes_settings &&
                          likelihood(channel) <= likelihood(taken);
    if (!is_alike || size(channel) == size(taken)) continue;
    if (++count <= kMostNamed)
      others += (others.empty() ? "" : ", ") + channelName(channel) + " (" + size(channel) + ")";
  }
  if (count == 0) return "";
  if (count > kMostNamed) others += " and " + std::to_string(count - kMostNamed) + " more";
  return "of topographies of different size " + channelName(taken) + " (" + size(taken) +
         ") is taken; --channel takes another: " + others;
}

HeightMap surfaceOfChannel(const FileChannel& channel) {
  if (isBeyondReach(channel)) {
    throw FileError("the heights of " + channelName(channel) + " span " +
                    shortNumber(rangeOf(channel)) + " m, the piezo can move " +
                    shortNumber(channel.reach) +
                    " m: they are no heights, or their scale is wrong");
  }
  if (channel.values.rows < 2 || channel.values.cols < 2) {
    throw FileError("the channel " + channelName(channel) + " has only " +
                    std::to_string(channel.values.cols) + " x " +
                    std::to_string(channel.values.rows) + " pixels");
  }
  try {
    return {channel.values, channel.width / channel.values.cols,
            channel.height / channel.values.rows};
  } catch (const SurfaceError& error) {
    throw FileError("the channel " + channelName(channel) + ": " + error.what());
  }
}

}  // namespace mems_stiction
