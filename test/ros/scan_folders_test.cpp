#include "ros/scan_folders.hpp"

#include <cstdlib>

#include <gtest/gtest.h>

#include "../support/scratch_folder.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

/// The variable for one test.
class Stated {
 public:
  explicit Stated(const std::string& folders) { setenv(kScanFoldersVariable, folders.c_str(), 1); }
  ~Stated() { unsetenv(kScanFoldersVariable); }
  Stated(const Stated&) = delete;
  Stated& operator=(const Stated&) = delete;
};

Configuration under(const std::string& file) {
  Configuration configuration;
  configuration.counter_surface.type = CounterSurfaceType::kFile;
  configuration.counter_surface.facing = CounterSurfaceFacing::kDown;
  configuration.counter_surface.file = file;
  configuration.scan.pitch_x = configuration.scan.pitch_y = 1e-8;
  return configuration;
}

std::string whyNot(const Configuration& configuration) {
  try {
    predictorFromFolders(configuration, false);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(ScanFolders, NoWordOfAFileIsInTheMessage) {
  const ScratchFolder folder;
  const Stated stated(folder.file(""));
  const std::string secret = "hunter2";
  for (const char* name : {"secret.txt", "secret.csv", "secret.xyz", "secret.asc", "secret.gwy",
                           "secret.png", "secret"}) {
    const std::string text =
        whyNot(under(folder.write(name, secret + " " + secret + "\n1 " + secret + "\n")));
    EXPECT_NE(text.find("counter_surface/file: "), std::string::npos) << name << ": " << text;
    EXPECT_EQ(text.find(secret), std::string::npos) << text;
  }
  folder.write("grid.txt.yaml", secret + ": " + secret + "\n");
  const std::string text = whyNot(under(folder.write("grid.txt", "0 1e-9\n1e-9 0\n")));
  EXPECT_NE(text.find("grid.txt cannot be used"), std::string::npos) << text;
  EXPECT_EQ(text.find(secret), std::string::npos) << text;
  Configuration region;
  region.preprocessing.region.polygon_file = folder.write("corners.txt", secret + "\n");
  EXPECT_EQ(whyNot(region).find(secret), std::string::npos);
  EXPECT_NE(whyNot(region).find("preprocessing/region/polygon_file: "), std::string::npos)
      << whyNot(region);
}

TEST(ScanFolders, FilesAreReadBelowTheStatedFoldersOnly) {
  const ScratchFolder inside;
  const ScratchFolder outside;
  const std::string grid = "0 1e-9 0\n1e-9 0 1e-9\n0 1e-9 0\n";
  const std::string here = inside.write("grid.txt", grid);
  const std::string there = outside.write("grid.txt", grid);
  const std::string link = inside.file("link.txt");
  std::filesystem::create_symlink(there, link);
  std::filesystem::create_directory(inside.file("a"));

  const Stated stated(inside.file(""));
  EXPECT_EQ(whyNot(under(here)), "");
  EXPECT_EQ(whyNot(under(inside.file("a/../grid.txt"))), "");
  const std::string missing = outside.file("missing.txt");
  for (const std::string& path :
       {there, link, inside.file("../grid.txt"), missing, std::string("/etc/passwd")}) {
    const std::string text = whyNot(under(path));
    EXPECT_NE(text.find(path + " is not allowed, must lie below"), std::string::npos) << text;
    EXPECT_NE(text.find(kScanFoldersVariable), std::string::npos) << text;
  }
}

TEST(ScanFolders, AFileThatIsNotUsedMayLieAnywhere) {
  const Stated stated("");
  Configuration configuration = under("/etc/passwd");
  configuration.counter_surface.type = CounterSurfaceType::kFlat;
  EXPECT_EQ(whyNot(configuration), "");
}

TEST(ScanFolders, AFolderWithALongerNameIsAnother) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.file("scans"));
  std::filesystem::create_directory(folder.file("scans2"));
  const std::vector<std::filesystem::path> folders = {
      std::filesystem::canonical(folder.file("scans"))};
  EXPECT_EQ(filesElsewhere(under(folder.file("scans2/grid.txt")), folders).size(), 1U);
  EXPECT_EQ(filesElsewhere(under(folder.file("scans/grid.txt")), folders).size(), 0U);
}

TEST(ScanFolders, WithoutAWordItIsTheHome) {
  unsetenv(kScanFoldersVariable);
  const ScratchFolder home;
  const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  setenv("HOME", home.file("").c_str(), 1);
  const std::vector<std::filesystem::path> folders = scanFolders();
  setenv("HOME", before.c_str(), 1);
  EXPECT_EQ(folders,
            (std::vector<std::filesystem::path>{std::filesystem::canonical(home.file(""))}));
  const Stated nothing("");
  EXPECT_TRUE(scanFolders().empty());
}

TEST(ScanFolders, NothingElsewhereIsReadWithAFile) {
  const ScratchFolder inside;
  const ScratchFolder outside;
  const Stated stated(inside.file(""));
  const std::string grid = "0 1e-9 0\n1e-9 0 1e-9\n0 1e-9 0\n";
  const std::string scan = inside.write("grid.txt", grid);
  std::filesystem::create_symlink(inside.write("mine.yaml", "pitch_x: 2.0e-8\n"),
                                  inside.file("grid.yaml"));
  std::filesystem::create_symlink(outside.write("other.txt", grid), inside.file("other.txt"));
  EXPECT_EQ(whyNot(under(scan)), "");

  const std::string theirs = outside.write("theirs.yaml", "pitch_x: 2.0e-8\n");
  for (const char* name : {"grid.txt.yaml", "GRID_0001.mtrx"}) {
    std::filesystem::create_symlink(theirs, inside.file(name));
    const std::string text = whyNot(under(scan));
    EXPECT_NE(text.find("has the link " + std::string(name) + " beside it"), std::string::npos)
        << text;
    std::filesystem::remove(inside.file(name));
  }
  std::filesystem::create_symlink(theirs, inside.file("data.int"));
  for (const char* header : {"FileName : data.int\n", "FileName : ../data.int\n",
                             "NRRD0004\ntype: float\ndata file: /etc/passwd\n"}) {
    const std::string text = whyNot(under(inside.write("header.int.txt", header)));
    EXPECT_TRUE(text.find("data.int beside it") != std::string::npos ||
                text.find("names files of other folders") != std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace mems_stiction
