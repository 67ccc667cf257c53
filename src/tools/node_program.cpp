#include "node_program.hpp"

#include <unistd.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <ros/ros.h>

#include "command_line.hpp"
#include "files/open_files.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "ros/master_calls.hpp"

namespace mems_stiction {
namespace {

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

/// What a handler writes, which may not put texts together. Never freed: it may come while the
/// process is in exit().
const std::string* end_text = nullptr;

void endAtOnce(int /*signal*/) {
  const ssize_t written = write(STDERR_FILENO, end_text->data(), end_text->size());
  _exit(written < 0 ? EXIT_FAILURE : EXIT_SUCCESS);
}

void shutDownOn(int number) {
  if (std::signal(number, requestEnd) == SIG_IGN) std::signal(number, SIG_IGN);  // nohup stays
}

void serve(const NodeProgram& program, const ros::NodeHandle& handle,
           const ros::NodeHandle& private_handle, const std::string& node) {
  std::shared_ptr<void> server = program.start(handle, private_handle, node);
  is_serving = 1;
  while (is_end_requested == 0 && !ros::isShuttingDown()) ros::WallDuration(0.05).sleep();
  alarm(kLongestEnd);
  server.reset();
  ros::shutdown();
}

int run(int argc, char** argv, const NodeProgram& program) {
  // rosconsole's log writes "?" for each letter that the locale of C has not. Numbers keep their
  // decimal point.
  std::setlocale(LC_CTYPE, "C.UTF-8");
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // whenever it ends, what was said is written
  CLI::App app(program.description, program.name);
  bool takes_over = false;
  if (program.may_take_over) {
    app.add_flag("--take-over", takes_over,
                 "if a node of this name runs, end it and take its place; else that is refused");
  }
  app.footer("Exit status: 0 ended, 1 it cannot start, 2 bad command line.");
  if (asksVersion(argc, argv)) {
    printVersion(program.name);
    return EXIT_SUCCESS;
  }
  addVersion(app);
  ros::V_string stated;
  ros::removeROSArgs(argc, argv, stated);
  try {
    app.parse(std::vector<std::string>(stated.rbegin(), stated.rend() - 1));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    complain(program.name, parseFailure(app, error));
    return kBadInput;
  }
  const std::string lack = lackOfOpenFiles();
  if (!lack.empty()) complain(program.name, lack);
  ros::init(argc, argv, program.name, ros::init_options::NoSigintHandler);
  end_text = new std::string(program.what +
                             " ends without having finished: a master that does not answer, or "
                             "work that takes long; the master may still hold its name\n");
  std::signal(SIGALRM, endAtOnce);
  std::signal(SIGINT, requestEnd);
  shutDownOn(SIGTERM);
  shutDownOn(SIGHUP);
  const std::string& node = ros::this_node::getName();
  const std::string owner = livingOwnerOf(node);
  if (!owner.empty() && takes_over) {
    endOwner(owner);
  } else if (!owner.empty()) {
    const std::string end_it = " end that one (rosnode kill " + node + ")";
    complain(program.name,
             "a node of the name " + node + " runs already, at " + owner +
                 ": give another name (__name:=NAME)" +
                 (program.may_take_over ? "," + end_it + ", or take its place with --take-over"
                                        : " or" + end_it));
    return EXIT_FAILURE;
  }
  // Outlive what runs, and what it throws: with the last handle ROS shuts down, and its log with
  // it.
  const ros::NodeHandle handle;
  const ros::NodeHandle private_handle("~");
  try {
    serve(program, handle, private_handle, node);
  } catch (const OptionsError& error) {
    for (const std::string& line : error.violations()) ROS_FATAL_STREAM("parameter ~" << line);
    return EXIT_FAILURE;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(program.what << " cannot start: " << error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

}  // namespace

int runNode(int argc, char** argv, const NodeProgram& program) {
  holdStandardDescriptors();
  try {
    return run(argc, argv, program);
  } catch (const std::exception& error) {
    complain(program.name, error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace mems_stiction
