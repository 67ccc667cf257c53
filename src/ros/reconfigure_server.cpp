#include "ros/reconfigure_server.hpp"

#include <algorithm>
#include <exception>
#include <future>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <dynamic_reconfigure/Reconfigure.h>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"
#include "ros/topic_names.hpp"
#include "settings/option_values.hpp"

namespace mems_stiction {
namespace {

// dynamic_reconfigure's names are the keys without their section (`voltage` for `load/voltage`):
// lastPart().

/// A message's entries for values of this type.
template <typename Value, typename Message>
auto& entriesOf(Message& message) {
  if constexpr (std::is_same_v<Value, double>) {
    return message.doubles;
  } else if constexpr (std::is_same_v<Value, int>) {
    return message.ints;
  } else if constexpr (std::is_same_v<Value, bool>) {
    return message.bools;
  } else {
    return message.strs;
  }
}

/// Checks the names of choices, and nothing else.
template <typename Take>
class Reader : public ValueVisitor<Take> {
 public:
  explicit Reader(Take take) : ValueVisitor<Take>(std::move(take)) {}

  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string& meaning) override {
    ValueVisitor<Take>::choice(key, value, names, meaning);
    if (std::find(names.begin(), names.end(), value) != names.end()) return;
    std::string line =
        key + ": '" + shortened(value, kLongestQuotation) + "' is not allowed, must be one of";
    for (const std::string& name : names) line += " " + name;
    violations.push_back(line);
  }

  std::vector<std::string> violations;
};

/// The settings that the message has are taken over. @throw OptionsError for a choice that is none.
RunningSettings changedBy(const dynamic_reconfigure::Config& message, RunningSettings settings) {
  Reader reader([&message](const std::string& key, auto& value) {
    for (const auto& entry : entriesOf<std::decay_t<decltype(value)>>(message)) {
      if (entry.name == lastPart(key)) value = entry.value;
    }
  });
  settings.describe(reader);
  if (!reader.violations.empty()) throw OptionsError(std::move(reader.violations));
  return settings;
}

/// One line for each entry that is no setting, has another type, or comes twice.
template <typename Value>
void checkNames(const dynamic_reconfigure::Config& wanted, const dynamic_reconfigure::Config& known,
                const char* type, std::vector<std::string>& violations) {
  const auto isOf = [](const auto& entries, const std::string& name) {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const auto& entry) { return entry.name == name; });
  };
  std::vector<std::string> seen;
  for (const auto& entry : entriesOf<Value>(wanted)) {
    const std::string name = "'" + shortened(entry.name, kLongestQuotation) + "'";
    if (std::find(seen.begin(), seen.end(), entry.name) != seen.end()) {
      violations.push_back(name + " is given twice");
    } else if (!isOf(entriesOf<Value>(known), entry.name)) {
      const bool is_known = isOf(known.doubles, entry.name) || isOf(known.ints, entry.name) ||
                            isOf(known.bools, entry.name) || isOf(known.strs, entry.name);
      violations.push_back(name + (is_known ? std::string(" is given as ") + type +
                                                  ", which is another type than that of the setting"
                                            : " is no setting that can be changed"));
    }
    seen.push_back(entry.name);
  }
}

/// @throw OptionsError
void checkNames(const dynamic_reconfigure::Config& wanted, const StictionConfig& config) {
  dynamic_reconfigure::Config known;
  config.__toMessage__(known);
  std::vector<std::string> violations;
  checkNames<double>(wanted, known, "a double", violations);
  checkNames<int>(wanted, known, "an int", violations);
  checkNames<bool>(wanted, known, "a bool", violations);
  checkNames<std::string>(wanted, known, "a string", violations);
  if (!violations.empty()) throw OptionsError(std::move(violations));
}

StictionConfig configOf(const RunningSettings& settings) {
  StictionConfig config = StictionConfig::__getDefault__();
  dynamic_reconfigure::Config message;
  visitValues(settings, [&message](const std::string& key, const auto& value) {
    auto& entry = entriesOf<std::decay_t<decltype(value)>>(message).emplace_back();
    entry.name = lastPart(key);
    entry.value = value;
  });
  config.__fromMessage__(message);
  return config;
}

template <typename Value>
std::string textOf(const Value& value) {
  PlainStream text;
  text << value;
  return text.str();
}

template <typename List>
void compare(const List& before, const List& now, std::string& differences) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (before[i].value == now[i].value) continue;
    differences += (differences.empty() ? "" : "; ") + now[i].name + " was " +
                   textOf(before[i].value) + " and is " + textOf(now[i].value);
  }
}

/// What was changed in a run before this one, which ended without a word or was started again:
/// "voltage was 3 and is 0".
std::string lostSettings(const ros::NodeHandle& private_handle, const RunningSettings& settings) {
  if (!private_handle.hasParam(kReconfigureParameters)) return {};
  StictionConfig left = configOf(settings);
  left.__fromServer__(ros::NodeHandle(private_handle, kReconfigureParameters));
  dynamic_reconfigure::Config before;
  left.__toMessage__(before);
  dynamic_reconfigure::Config now;
  configOf(settings).__toMessage__(now);
  std::string differences;
  compare(before.doubles, now.doubles, differences);
  compare(before.strs, now.strs, differences);
  if (differences.empty()) return {};
  return "what was changed in the run before is lost: " +
         oneLine(shortened(differences, kLongestSentence));
}

}  // namespace

ReconfigureServer::ReconfigureServer(ros::NodeHandle& private_handle, const SettingsOwner& settings,
                                     double max_message_size, Change change,
                                     std::function<void()> changed)
    : settings_(settings),
      change_(std::move(change)),
      changed_(std::move(changed)),
      mirror_name_(private_handle.resolveName(kReconfigureParameters)),
      lost_(lostSettings(private_handle, settings.current())) {
  if (!lost_.empty()) logSoon(ros::console::levels::Warn, lost_);
  // What an earlier run left would be taken for the settings of this one.
  private_handle.deleteParam(kReconfigureParameters);
  descriptions_ = private_handle.advertise<dynamic_reconfigure::ConfigDescription>(
      "parameter_descriptions", 1, true);
  descriptions_.publish(StictionConfig::__getDescriptionMessage__());
  updates_ = private_handle.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  updates_.publish(shown());
  setParameterAtStart(mirror_name_, mirror());
  using Service = dynamic_reconfigure::Reconfigure;
  service_ = advertiseChecked<Service>(
      private_handle, "set_parameters",
      {[this](Service::Request& request, Service::Response& response) {
         take(request.config);
         response.config = shown();
       },
       [this](Service::Response& response, const std::string& reason) {
         logSoon(ros::console::levels::Warn, "reconfigure refused, nothing changed: " + reason);
         response.config = shown();
       },
       max_message_size});
}

void ReconfigureServer::show() {
  forgetLost();
  updates_.publish(shown());
  changed_();
}

dynamic_reconfigure::Config ReconfigureServer::shown() const {
  dynamic_reconfigure::Config message;
  configOf(settings_.current()).__toMessage__(message);
  return message;
}

XmlRpc::XmlRpcValue ReconfigureServer::mirror() const {
  const dynamic_reconfigure::Config settings = shown();
  XmlRpc::XmlRpcValue mirror;
  for (const auto& entry : settings.doubles) mirror[entry.name] = entry.value;
  for (const auto& entry : settings.strs) mirror[entry.name] = entry.value;
  return mirror;
}

bool ReconfigureServer::writeMirror(const MasterCalls& calls) const {
  return calls.setParameter(mirror_name_, mirror());
}

std::string ReconfigureServer::lost() const {
  const std::lock_guard<std::mutex> lock(lost_mutex_);
  return lost_;
}

void ReconfigureServer::forgetLost() {
  const std::lock_guard<std::mutex> lock(lost_mutex_);
  lost_.clear();
}

void ReconfigureServer::take(dynamic_reconfigure::Config& wanted) {
  const boost::recursive_mutex::scoped_lock lock(mutex_);
  try {
    StictionConfig config = configOf(settings_.current());
    checkNames(wanted, config);
    config.__fromMessage__(wanted);
    config.__clamp__();
    dynamic_reconfigure::Config message;
    config.__toMessage__(message);
    change_(changedBy(message, settings_.current()));
    forgetLost();
    changed_();
  } catch (const OptionsError& error) {
    for (const std::string& line : error.violations()) {
      logSoon(ros::console::levels::Warn, oneLine("reconfigure refused, nothing changed: " + line));
    }
  } catch (const std::future_error&) {
    // the node is shutting down
  } catch (const std::exception& error) {  // such as memory that is not to be had: show what is set
    logSoon(ros::console::levels::Error, "reconfigure failed: " + oneLine(reasonOf(error)));
  }
  updates_.publish(shown());
}

}  // namespace mems_stiction
