/// The node: constructs the server and runs until ROS ends, by a shutdown, INT, TERM or HUP: all of
/// them let it finish the scan at hand and take its name off the master, in 4 s at most, whatever
/// the master does. Exit 1 with one line per bad parameter, or where a node of its name runs.

#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include <ros/ros.h>

#include "command_line.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/master_calls.hpp"
#include "ros/stiction_server.hpp"

namespace {

using namespace mems_stiction;

/// From the signal to the end [s]. A master that takes the call by which a topic is taken back and
/// does not answer keeps roscpp for ever.
constexpr unsigned kLongestEnd = 4;

volatile std::sig_atomic_t is_end_requested = 0;
volatile std::sig_atomic_t is_serving = 0;

/// roscpp's own would take all topics back at once, before the scan at hand is done.
void requestEnd(int /*signal*/) {
  is_end_requested = 1;
  alarm(kLongestEnd);
  if (is_serving == 0) ros::requestShutdown();  // roscpp waits for a master that is not there
}

void endAtOnce(int /*signal*/) {
  constexpr std::string_view kText =
      "the node ends without having finished: a master that does not answer, or a long prediction; "
      "the master may "
      "still "
      "hold its name\n";
  const ssize_t written = write(STDERR_FILENO, kText.data(), kText.size());
  _exit(written < 0 ? EXIT_FAILURE : EXIT_SUCCESS);
}

void shutDownOn(int number) {
  if (std::signal(number, requestEnd) == SIG_IGN) std::signal(number, SIG_IGN);  // nohup stays
}

/// The whole of main(). @return the exit status
int run(int argc, char** argv) {
  // rosconsole's log writes "?" for each letter that the locale of C has not. Numbers keep their
  // decimal point.
  std::setlocale(LC_CTYPE, "C.UTF-8");
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // whenever it ends, what was said is written
  CLI::App app(
      "Predicts each scan that comes on the topic height; doc/ros_api.md. Settings are parameters "
      "of the node: start "
      "it by\n"
      "  roslaunch mems_stiction stiction.launch config:=/path/to/device.yaml\n"
      "or set single ones by _KEY:=VALUE; __name:=NAME gives it another name.");
  bool takes_over = false;
  app.add_flag("--take-over", takes_over,
               "if a node of this name runs, end it and take its place; else that is refused");
  app.footer("Exit status: 0 ended, 1 it cannot start, 2 bad command line.");
  if (asksVersion(argc, argv)) {
    printVersion("stiction_node");
    return EXIT_SUCCESS;
  }
  addVersion(app);
  ros::V_string stated;
  ros::removeROSArgs(argc, argv, stated);
  try {
    app.parse(std::vector<std::string>(stated.rbegin(), stated.rend() - 1));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    complain("stiction_node", parseFailure(app, error));
    return kBadInput;
  }
  ros::init(argc, argv, "stiction_node", ros::init_options::NoSigintHandler);
  std::signal(SIGALRM, endAtOnce);
  std::signal(SIGINT, requestEnd);
  shutDownOn(SIGTERM);
  shutDownOn(SIGHUP);
  const std::string& name = ros::this_node::getName();
  const std::string owner = takes_over ? "" : livingOwnerOf(name);
  if (!owner.empty()) {
    complain("stiction_node",
             "a node of the name " + name + " runs already, at " + owner +
                 ": give another name (__name:=NAME), end that one (rosnode kill " + name +
                 "), or take its place with --take-over");
    return EXIT_FAILURE;
  }
  // Outlive the server: with the last handle ROS shuts down, and its log with it.
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  try {
    std::optional<StictionServer> server;
    server.emplace(handle, private_handle, name);
    is_serving = 1;
    while (is_end_requested == 0 && !ros::isShuttingDown()) ros::WallDuration(0.05).sleep();
    alarm(kLongestEnd);
    server.reset();
    ros::shutdown();
  } catch (const OptionsError& error) {
    for (const std::string& line : error.violations()) ROS_FATAL_STREAM("parameter ~" << line);
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM("the node cannot start: " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    complain("stiction_node", error.what());
    return EXIT_FAILURE;
  }
}
