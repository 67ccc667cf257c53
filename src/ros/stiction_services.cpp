#include "ros/stiction_server.hpp"

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "errors/error_text.hpp"
#include "errors/one_line.hpp"
#include "errors/short_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "ros/checked_messages.hpp"
#include "ros/own_log.hpp"
#include "ros/prediction_conversion.hpp"
#include "ros/topic_names.hpp"

namespace mems_stiction {

namespace {

/// "1e-06 N", "2e+05 Pa", "0.001 N on the device".
std::string pressingText(const LoadOptions& load) {
  if (load.pressure > 0.0) return numberText(load.pressure) + " Pa";
  if (load.device_force > 0.0) return numberText(load.device_force) + " N on the device";
  return numberText(load.mechanical_load) + " N";
}

std::string changeText(const std::string& what, const std::string& before,
                       const std::string& after) {
  return what + (before == after ? " stays at " + after : " from " + before + " to " + after);
}

/// What changed, in words.
std::string loadChange(const LoadOptions& before, const LoadOptions& after) {
  return changeText("voltage", numberText(before.voltage) + " V",
                    numberText(after.voltage) + " V") +
         "; " + changeText("mechanical load", pressingText(before), pressingText(after));
}

/// A load that falls to 0 beside another one that is stated may have been left out of the request,
/// which ROS cannot tell from a 0 that was given. Empty where none falls so.
std::string whatMayBeLeftOut(const LoadOptions& before, const LoadOptions& after) {
  const bool pressed = before.mechanical_load > 0.0 || before.isPerArea();
  const bool presses = after.mechanical_load > 0.0 || after.isPerArea();
  if (pressed && !presses && after.voltage != 0.0) {
    return "warning: the mechanical load was set to 0, as whatever a call of ~set_load leaves out "
           "(~set_voltage leaves it as it is)";
  }
  if (before.voltage != 0.0 && after.voltage == 0.0 && presses) {
    return "warning: the voltage was set to 0, as whatever a call of ~set_load leaves out "
           "(~set_mechanical_load leaves it as it is)";
  }
  return "";
}

/// Does the work of a service; what it throws is the answer.
template <typename Response, typename Work>
void answer(Response& response, Work&& work) {
  try {
    work();
    return;
  } catch (const std::future_error&) {
    response.message = kShuttingDown;
  } catch (const std::exception& error) {
    response.message = oneLine(reasonOf(error));
  }
  response.success = false;
}

std::string figure(double value, const char* unit) { return shortNumber(value) + " " + unit; }

/// What another load has done to the same scan.
std::string effect(const LoadFigures& before, const Prediction& after) {
  return changeText("pull-off force", figure(before.pull_off_force, "N"),
                    figure(after.pull_off_force, "N")) +
         "; " +
         changeText("contact area", figure(before.contact_area, "m^2"),
                    figure(after.contact_area, "m^2")) +
         "; " +
         changeText("electrostatic force", figure(before.electrostatic_force, "N"),
                    figure(after.electrostatic_force, "N"));
}

}  // namespace

void StictionServer::advertiseServices() {
  services_ = {
      serveLoggers(service_handle_),
      service_handle_.advertiseService(kSetLoadService, &StictionServer::setLoad, this),
      service_handle_.advertiseService(kSetVoltageService, &StictionServer::setVoltage, this),
      service_handle_.advertiseService(kSetMechanicalLoadService,
                                       &StictionServer::setMechanicalLoad, this),
      service_handle_.advertiseService(kGetLoadService, &StictionServer::getLoad, this),
      service_handle_.advertiseService(kGetPredictionService, &StictionServer::getPrediction, this),
      advertiseChecked<Predict>(
          service_handle_, kPredictService,
          {[this](auto& request, auto& response) { predict(request, response); },
           [](auto& response, const std::string& reason) {
             response.prediction = predictionMessage(PredictedScan(), std_msgs::Header());
             response.success = false;
             response.message = oneLine(reason);
           },
           options_.max_message_size}),
      service_handle_.advertiseService(kResetSurfaceService, &StictionServer::resetSurface, this)};
}

bool StictionServer::setLoad(SetLoad::Request& request, SetLoad::Response& response) {
  std::string left_out;
  changeLoad(
      [&](LoadOptions& load) {
        const LoadOptions before = load;
        load.voltage = request.voltage;
        load.setMechanicalLoad(request.mechanical_load);
        left_out = whatMayBeLeftOut(before, load);
      },
      response);
  if (response.success && !left_out.empty()) {
    response.message += "; " + left_out;
    logSoon(ros::console::levels::Warn, "set_load: " + left_out);
  }
  return true;
}

bool StictionServer::setVoltage(SetVoltage::Request& request, SetVoltage::Response& response) {
  changeLoad([&](LoadOptions& load) { load.voltage = request.voltage; }, response);
  return true;
}

bool StictionServer::setMechanicalLoad(SetMechanicalLoad::Request& request,
                                       SetMechanicalLoad::Response& response) {
  changeLoad([&](LoadOptions& load) { load.setMechanicalLoad(request.mechanical_load); }, response);
  return true;
}

template <typename Response>
void StictionServer::changeLoad(const std::function<void(LoadOptions&)>& set, Response& response) {
  // What is returned when there is no prediction: NO_EQUILIBRIUM and zeros.
  response.prediction = predictionMessage(PredictedScan(), std_msgs::Header());
  answer(response, [&] {
    const boost::recursive_mutex::scoped_lock lock(reconfigure_.mutex());
    RunningSettings settings = predictor_.settings().current();
    const LoadOptions before = settings.load;
    set(settings.load);
    // At one go: no scan comes between what was and what is.
    worker_.call([&] {
      const std::optional<LoadFigures> old = lastFiguresOrNothing();
      predictor_.settings().change(settings);
      response.success = true;
      response.message = loadChange(before, settings.load);
      try {
        if (const std::optional<PredictedScan> predicted = predictor_.predictLastScan()) {
          response.prediction = predictionMessage(*predicted, predictor_.lastScan()->header);
          response.prediction.curve.clear();  // a thousand lines for whoever calls by hand
          offerAgain(*predicted);
          if (old) response.message += "; " + effect(*old, predicted->prediction);
        } else {
          response.message += "; no scan yet, so there is no prediction";
        }
      } catch (const std::exception& error) {
        response.message += "; the last scan cannot be predicted: " + oneLine(reasonOf(error));
      }
    });
    reconfigure_.show();
  });
}

std::optional<PredictedScan> StictionServer::lastScanOrNothing() {
  try {
    return predictor_.predictLastScan();
  } catch (const std::exception&) {  // memory that is not to be had, too: the settings are set all
                                     // the same
    return std::nullopt;
  }
}

std::optional<LoadFigures> StictionServer::lastFiguresOrNothing() {
  try {
    return predictor_.lastFigures();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

bool StictionServer::getLoad(GetLoad::Request& /*request*/, GetLoad::Response& response) {
  const LoadOptions load = predictor_.settings().current().load;
  response.voltage = load.voltage;
  response.mechanical_load = load.mechanical_load;
  response.max_voltage = load.max_voltage;
  response.max_mechanical_load = load.max_mechanical_load;
  response.pressure = load.pressure;
  response.device_force = load.device_force;
  return true;
}

bool StictionServer::getPrediction(GetPrediction::Request& /*request*/,
                                   GetPrediction::Response& response) {
  response.prediction = predictionMessage(PredictedScan(), std_msgs::Header());
  answer(response, [&] {
    worker_.call([&] {
      const std::optional<PredictedScan> predicted = predictor_.predictLastScan();
      response.success = predicted.has_value();
      if (predicted)
        response.prediction = predictionMessage(*predicted, predictor_.lastScan()->header);
    });
    if (!response.success) response.message = "no scan yet";
  });
  return true;
}

void StictionServer::predict(Predict::Request& request, Predict::Response& response) {
  response.prediction = predictionMessage(PredictedScan(), request.height.header);
  answer(response, [&] {
    const ReceivedScan scan = receiveByCall(std::move(request.height), request.scan_info);
    worker_.call([&] {
      const PredictedScan predicted =
          predictor_.predictOnce(scan, request.voltage, request.mechanical_load);
      response.prediction = predictionMessage(predicted, scan.header);
      for (const std::string& warning : predicted.warnings) {
        response.message += (response.message.empty() ? "" : "; ") + oneLine(warning);
      }
    });
    response.success = true;
  });
}

bool StictionServer::resetSurface(std_srvs::Trigger::Request& /*request*/,
                                  std_srvs::Trigger::Response& response) {
  answer(response, [&] {
    worker_.call([this] { predictor_.resetSurface(); });
    response.success = true;
    response.message = options_.accumulate_deformation
                           ? "the next scan is taken as it was made"
                           : "nothing to forget: accumulate_deformation is false";
  });
  return true;
}

}  // namespace mems_stiction
