/// The nodelet: opens the source in whatever manager loads it, so that scans reach a
/// StictionNodelet there without a copy. With bad parameters it says so and stays idle.

#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "mems_stiction/errors/errors.hpp"
#include "source/scan_source.hpp"

namespace mems_stiction {

class ScanSourceNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      source_ = std::make_unique<ScanSource>(getNodeHandle(), getPrivateNodeHandle(), getName());
    } catch (const OptionsError& error) {
      for (const std::string& line : error.violations())
        NODELET_FATAL_STREAM("parameter ~" << line);
      NODELET_FATAL("stays idle: mend the parameters and load the nodelet again");
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM("stays idle: " << error.what());
    }
  }

  std::unique_ptr<ScanSource> source_;
};

}  // namespace mems_stiction

PLUGINLIB_EXPORT_CLASS(mems_stiction::ScanSourceNodelet, nodelet::Nodelet)
