/// The nodelet: constructs the server in whatever manager loads it. With bad parameters it says so
/// and stays idle, since an exception would end its neighbours in the manager too.

#include <memory>

#include <nodelet/nodelet.h>
#include <ros/service.h>
#include <pluginlib/class_list_macros.hpp>

#include "mems_stiction/errors/errors.hpp"
#include "ros/stiction_server.hpp"

namespace mems_stiction {

class StictionNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      waitForName();
      server_ =
          std::make_unique<StictionServer>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const OptionsError& error) {
      for (const std::string& line : error.violations())
        NODELET_FATAL_STREAM("parameter ~" << line);
      NODELET_FATAL("stays idle: mend the parameters and load the nodelet again");
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM("stays idle: " << error.what());
    }
  }

  /// One that is being unloaded, or a node that has been told to end, gets its time. @throw Error
  /// if it stays
  void waitForName() {
    const std::string service = getPrivateNodeHandle().resolveName("set_load");
    const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(5.0);
    while (ros::service::exists(service, false)) {
      if (ros::SteadyTime::now() > end)
        throw Error("another node or nodelet of the name " + getName() + " runs already");
      ros::WallDuration(0.1).sleep();
    }
  }

  std::unique_ptr<StictionServer> server_;
};

}  // namespace mems_stiction

PLUGINLIB_EXPORT_CLASS(mems_stiction::StictionNodelet, nodelet::Nodelet)
