/// What the tools leave behind: nothing when they are interrupted, no file of somebody else's
/// replaced, no text of a file in the place of a line of their own, and an error where an output is
/// not whole.

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/import/scan_file.hpp"
#include "support/gwy_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

class ImportOutputs : public ::testing::Test {
 protected:
  /// @return the exit status; output and errors go to the files "out" and "err"
  int run(const std::string& program, const std::string& arguments,
          const std::string& output = "") const {
    const std::string command = program + " " + arguments + " >" +
                                (output.empty() ? folder_.file("out") : output) + " 2>" +
                                folder_.file("err");
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  int importScan(const std::string& arguments, const std::string& output = "") const {
    return run(MEMS_STICTION_IMPORT_SCAN, arguments, output);
  }
  std::string errors() const { return ScratchFolder::read(folder_.file("err")); }
  std::size_t errorLines() const {
    const std::string text = errors();
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
  std::string grid(const std::string& name = "grid.txt") const {
    return folder_.write(name, "# Value units: nm\n1.5 2.5\n0.5 3.5\n");
  }
  /// A folder where the core's library finds this script as its reader of makers' files; none where
  /// the script is empty.
  std::string coreBeside(const std::string& script) const {
    fs::create_directories(folder_.file("lib"));
    const fs::path core = MEMS_STICTION_CORE;
    fs::remove(folder_.file("lib") / core.filename());
    fs::create_symlink(core, folder_.file("lib") / core.filename());
    if (!script.empty()) {
      fs::permissions(folder_.write("lib/read_by_gwyddion", script), fs::perms::owner_all);
    }
    return folder_.file("lib");
  }

  ScratchFolder folder_;
};

/// True while any process of the group exists.
bool isAlive(pid_t group) { return kill(-group, 0) == 0; }

TEST_F(ImportOutputs, AnInterruptionEndsTheChildAndRemovesItsFolder) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    fs::create_directories(folder_.file("tmp"));
    const std::string told = folder_.file("group");
    fs::remove(told);
    const std::string libraries =
        coreBeside("#!/bin/sh\nsleep 600 &\nhead -c 100000 /dev/zero > \"$2\"\necho $$ > " + told +
                   ".part\nmv " + told + ".part " + told + "\nsleep 600\n");
    const std::string scan = folder_.write("scan.di", "not really");
    const pid_t tool = fork();
    ASSERT_GE(tool, 0);
    if (tool == 0) {
      setenv("TMPDIR", folder_.file("tmp").c_str(), 1);
      setenv("LD_LIBRARY_PATH", libraries.c_str(), 1);
      signal(number, SIG_DFL);  // a test that runs in the background ignores some
      execl(MEMS_STICTION_IMPORT_SCAN, "import_scan", "-o", folder_.file("o").c_str(), scan.c_str(),
            nullptr);
      _exit(127);
    }
    for (int tenth = 0; tenth < 600 && !fs::exists(told); ++tenth)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_TRUE(fs::exists(told)) << "the child has not started within a minute";
    const pid_t group = std::stoi(ScratchFolder::read(told));
    EXPECT_TRUE(isAlive(group));
    kill(tool, number);
    int status = 0;
    waitpid(tool, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number)
        << "the caller must see the signal";
    for (int tenth = 0; tenth < 600 && isAlive(group); ++tenth)
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_FALSE(isAlive(group));
    EXPECT_TRUE(fs::is_empty(folder_.file("tmp"))) << "signal " << number;
  }
}

TEST_F(ImportOutputs, WithoutGwyddionItSaysWhatToInstallAndReadsItsOwnFormats) {
  const std::string environment = "LD_LIBRARY_PATH=" + coreBeside("") + " ";
  const std::string arguments =
      "-o " + folder_.file("o") + " " + folder_.write("scan.al3d", "AliconaImaging");
  EXPECT_EQ(run(environment + MEMS_STICTION_IMPORT_SCAN, arguments + " -p 1e-9 " + grid()), 2);
  EXPECT_NE(errors().find("scan.al3d: needs Gwyddion's libraries to be read"), std::string::npos)
      << errors();
  EXPECT_NE(errors().find("libgwyddion20-dev"), std::string::npos) << errors();
  EXPECT_EQ(errors().find("scan.al3d"), errors().rfind("scan.al3d")) << "one line";
  EXPECT_TRUE(fs::exists(folder_.file("o/grid.tiff")));
}

TEST_F(ImportOutputs, AReaderThatCrashesCostsOneSentenceAndTheNextFileIsRead) {
  const std::string script = "#!/bin/sh\ncase $1 in *bad*) kill -SEGV $$ ;; esac\ncp " +
                             folder_.write("made.gwy", gwy_bytes::example()) + " \"$2\"\n";
  const std::string environment = "LD_LIBRARY_PATH=" + coreBeside(script) + " ";
  const std::string scans =
      folder_.write("bad.di", "damaged") + " " + folder_.write("good.di", "whole");
  EXPECT_EQ(run(environment + MEMS_STICTION_IMPORT_SCAN, "-o " + folder_.file("o") + " " + scans),
            2);
  EXPECT_NE(
      errors().find("bad.di: gwyddion crashed on this file (Segmentation fault): it is damaged"),
      std::string::npos);
  EXPECT_EQ(errors().find("bad.di"), errors().rfind("bad.di")) << "one line: " << errors();
  EXPECT_TRUE(fs::exists(folder_.file("o/good.tiff")));
}

TEST_F(ImportOutputs, FilesThatImportScanDidNotWriteAreNotReplaced) {
  const std::string scan = grid();
  fs::create_directories(folder_.file("o"));
  folder_.write("o/grid.tiff", "a photograph");
  EXPECT_EQ(importScan("-p 1e-9 -o " + folder_.file("o") + " " + scan), 2);
  EXPECT_EQ(ScratchFolder::read(folder_.file("o/grid.tiff")), "a photograph");
  EXPECT_NE(errors().find("remove both, or choose another --output"), std::string::npos)
      << errors();
  EXPECT_EQ(errorLines(), 1u);
  fs::remove(folder_.file("o/grid.tiff"));
  folder_.write("o/grid.tiff.yaml", "pitch_x: 1e-9\n");
  EXPECT_EQ(importScan("-p 1e-9 -o " + folder_.file("o") + " " + scan), 2) << "a sidecar by hand";
}

TEST_F(ImportOutputs, WhatImportScanWroteMayBeWrittenAgainUntilSomebodyChangesIt) {
  const std::string call = "-p 1e-9 -o " + folder_.file("o") + " " + grid();
  EXPECT_EQ(importScan(call), 0);
  EXPECT_EQ(importScan(call), 0) << errors();
  EXPECT_DOUBLE_EQ(readScanFile(folder_.file("o/grid.tiff")).height(1, 1), 3.5e-9);
  folder_.write("o/grid.tiff.yaml",
                ScratchFolder::read(folder_.file("o/grid.tiff.yaml")) + "# my remark\n");
  EXPECT_EQ(importScan(call), 2);
}

TEST_F(ImportOutputs, ControlCharactersOfNamesStayInOneLineAndOutOfTheSidecar) {
  const std::string scan = grid("evil\npitch_x: 5\n\x1b[2J.txt");
  EXPECT_EQ(importScan("-p 1e-9 -o " + folder_.file("o") + " '" + scan + "'"), 0) << errors();
  bool is_seen = false;
  for (const auto& entry : fs::directory_iterator(folder_.file("o"))) {
    if (entry.path().extension() != ".yaml") continue;
    is_seen = true;
    std::istringstream sidecar(ScratchFolder::read(entry.path().string()));
    int pitches = 0;
    for (std::string line; std::getline(sidecar, line);) {
      if (line.compare(0, 7, "pitch_x") == 0) ++pitches;
      EXPECT_EQ(line.find('\x1b'), std::string::npos);
    }
    EXPECT_EQ(pitches, 1);
  }
  EXPECT_TRUE(is_seen);
  EXPECT_EQ(ScratchFolder::read(folder_.file("out")).find('\x1b'), std::string::npos);
  EXPECT_EQ(importScan("-o " + folder_.file("p") + " '" + scan + "'"), 2);
  EXPECT_EQ(errorLines(), 1u) << errors();
}

TEST_F(ImportOutputs, AFullStandardOutputIsAnError) {
  const std::string scan = grid();
  EXPECT_EQ(importScan("--list " + scan, "/dev/full"), 2);
  EXPECT_NE(errors().find("the standard output cannot be written"), std::string::npos) << errors();
  EXPECT_EQ(run(MEMS_STICTION_PREDICT_SCAN, "-p 1e-9 " + scan, "/dev/full"), 2);
}

TEST_F(ImportOutputs, AFullDiskUnderTheDeformedSurfaceIsAnError) {
  EXPECT_EQ(run(MEMS_STICTION_PREDICT_SCAN, "-p 1e-8 -d /dev/full " + grid()), 2);
  EXPECT_NE(errors().find("/dev/full: cannot be written: No space left on device"),
            std::string::npos)
      << errors();
  EXPECT_EQ(errorLines(), 2u) << errors();  // the other warns that the scan is small
}

}  // namespace
}  // namespace mems_stiction
