#include "mems_stiction/ros/stiction_server.hpp"

#include <utility>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/one_line.hpp"
#include "mems_stiction/base/option_visitor.hpp"
#include "mems_stiction/ros/prediction_conversion.hpp"
#include "mems_stiction/ros/topic_names.hpp"

namespace mems_stiction {

void StictionServer::advertiseServices() {
  services_ = {service_handle_.advertiseService(kSetLoadService, &StictionServer::setLoad, this),
               service_handle_.advertiseService(kGetLoadService, &StictionServer::getLoad, this),
               service_handle_.advertiseService(kPredictService, &StictionServer::predict, this),
               service_handle_.advertiseService(kResetSurfaceService, &StictionServer::resetSurface, this)};
}

bool StictionServer::setLoad(SetLoad::Request& request, SetLoad::Response& response) {
  // What is returned when there is no prediction: NO_EQUILIBRIUM and zeros.
  response.prediction = predictionMessage(PredictedScan(), std_msgs::Header());
  try {
    const boost::recursive_mutex::scoped_lock lock(reconfigure_.mutex());
    RunningSettings settings = predictor_.settings().current();
    const LoadOptions before = settings.load;
    settings.load.voltage = request.voltage;
    settings.load.mechanical_load = request.mechanical_load;
    change(settings);
    reconfigure_.show();
    worker_.call([&] {
      response.success = true;
      response.message = "from " + numberText(before.voltage) + " V, " + numberText(before.mechanical_load) + " N";
      try {
        if (const std::optional<PredictedScan> predicted = predictor_.predictLastScan()) {
          response.prediction = predictionMessage(*predicted, predictor_.lastScan()->header);
        } else {
          response.message += "; no scan yet, so there is no prediction";
        }
      } catch (const std::exception& error) {
        response.message += "; the last scan cannot be predicted: " + oneLine(error.what());
      }
    });
  } catch (const std::future_error&) {
    response.success = false;
    response.message = kShuttingDown;
  } catch (const std::exception& error) {
    response.success = false;
    response.message = oneLine(error.what());
  }
  return true;
}

bool StictionServer::getLoad(GetLoad::Request& /*request*/, GetLoad::Response& response) {
  const LoadOptions load = predictor_.settings().current().load;
  response.voltage = load.voltage;
  response.mechanical_load = load.mechanical_load;
  response.max_voltage = load.max_voltage;
  response.max_mechanical_load = load.max_mechanical_load;
  return true;
}

bool StictionServer::predict(Predict::Request& request, Predict::Response& response) {
  response.prediction = predictionMessage(PredictedScan(), request.height.header);
  try {
    const ReceivedScan scan = receiveByCall(std::move(request.height), request.scan_info);
    worker_.call([&] {
      const PredictedScan predicted = predictor_.predictOnce(scan, request.voltage, request.mechanical_load);
      response.prediction = predictionMessage(predicted, scan.header);
    });
    response.success = true;
  } catch (const std::future_error&) {
    response.message = kShuttingDown;
  } catch (const std::exception& error) {
    response.message = oneLine(error.what());
  }
  return true;
}

bool StictionServer::resetSurface(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
  try {
    worker_.call([this] { predictor_.resetSurface(); });
    response.success = true;
    response.message = options_.accumulate_deformation ? "the next scan is taken as it was made"
                                                       : "nothing to forget: accumulate_deformation is false";
  } catch (const std::future_error&) {
    response.message = kShuttingDown;
  }
  return true;
}

}  // namespace mems_stiction
