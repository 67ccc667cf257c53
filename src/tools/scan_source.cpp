/// The program: opens the source and runs until ROS ends, by a shutdown, INT, TERM or HUP. Exit 1
/// with one line per bad parameter, or where a node of its name runs.

#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include <unistd.h>

#include <ros/ros.h>

#include "command_line.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/master_calls.hpp"
#include "source/scan_source.hpp"

namespace {

using namespace mems_stiction;

/// From the signal to the end [s].
constexpr unsigned kLongestEnd = 4;

volatile std::sig_atomic_t is_end_requested = 0;

void requestEnd(int /*signal*/) {
  is_end_requested = 1;
  alarm(kLongestEnd);  // a master that does not answer keeps roscpp for ever
}

void endOn(int number) {
  if (std::signal(number, requestEnd) == SIG_IGN) std::signal(number, SIG_IGN);  // nohup stays
}

/// The whole of main(). @return the exit status
int run(int argc, char** argv) {
  std::setlocale(LC_CTYPE, "C.UTF-8");
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  CLI::App app(
      "Publishes each scan that an instrument gives on the topics height and scan_info; "
      "doc/instruments.md. Settings "
      "are\nparameters of the node: start it by\n"
      "  roslaunch mems_stiction station.launch config:=/path/to/device.yaml "
      "folder:=/path/to/scans");
  app.footer("Exit status: 0 ended, 1 it cannot start, 2 bad command line.");
  if (asksVersion(argc, argv)) {
    printVersion("scan_source");
    return EXIT_SUCCESS;
  }
  addVersion(app);
  ros::V_string stated;
  ros::removeROSArgs(argc, argv, stated);
  try {
    app.parse(std::vector<std::string>(stated.rbegin(), stated.rend() - 1));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    complain("scan_source", parseFailure(app, error));
    return kBadInput;
  }
  ros::init(argc, argv, "scan_source", ros::init_options::NoSigintHandler);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) endOn(number);
  const std::string& name = ros::this_node::getName();
  const std::string owner = livingOwnerOf(name);
  if (!owner.empty()) {
    complain("scan_source",
             "a node of the name " + name + " runs already, at " + owner +
                 ": give another name (__name:=NAME) or end that one (rosnode kill " + name + ")");
    return EXIT_FAILURE;
  }
  const ros::NodeHandle
      handle;  // outlives the source: with the last handle ROS shuts down, and its log with it
  const ros::NodeHandle private_handle("~");
  try {
    std::optional<ScanSource> source;
    source.emplace(handle, private_handle, name);
    while (is_end_requested == 0 && !ros::isShuttingDown()) ros::WallDuration(0.05).sleep();
    alarm(kLongestEnd);
    source.reset();
    ros::shutdown();
  } catch (const OptionsError& error) {
    for (const std::string& line : error.violations()) ROS_FATAL_STREAM("parameter ~" << line);
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("the source cannot start: " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    complain("scan_source", error.what());
    return EXIT_FAILURE;
  }
}
