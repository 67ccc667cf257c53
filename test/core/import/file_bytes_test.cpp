#include "import/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <chrono>
#include <filesystem>

#include "import/file_checks.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/binary_writer.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

std::string refusal(const std::string& path) {
  try {
    readScanFile(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(FileBytes, PipesAndDevicesAreRefusedWithoutWaiting) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo(folder.file("pipe.di").c_str(), 0600), 0);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(mentions(refusal(folder.file("pipe.di")), "is a pipe, a socket or a device"));
  EXPECT_TRUE(mentions(refusal("/dev/zero"), "is a pipe, a socket or a device"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(FileBytes, TooLargeAFileIsRefusedBeforeItIsRead) {
  const ScratchFolder folder;
  folder.write("large.txt", "1 2\n");
  std::filesystem::resize_file(folder.file("large.txt"),
                               kMaxFileBytes + 1);  // a hole: no disk is used
  EXPECT_TRUE(mentions(refusal(folder.file("large.txt")), "more than the"));
}

// ---- Archives

std::string zip(const std::string& content, std::uint32_t checksum, const std::string& name = "a") {
  const std::string name_size = littleBytes(static_cast<std::uint16_t>(name.size()));
  const std::string sizes = littleBytes(checksum) +
                            littleBytes(static_cast<std::uint32_t>(content.size())) +
                            littleBytes(static_cast<std::uint32_t>(content.size()));
  const std::string stored =
      std::string(2, '\0') + std::string(2, '\0') + std::string(4, '\0') + sizes;
  const std::string local = "PK\3\4" + littleBytes(std::uint16_t{20}) + stored + name_size +
                            littleBytes(std::uint16_t{0}) + name + content;
  const std::string entry = "PK\1\2" + littleBytes(std::uint16_t{20}) +
                            littleBytes(std::uint16_t{20}) + stored + name_size +
                            std::string(16, '\0') + name;
  return local + entry + "PK\5\6" + std::string(4, '\0') + littleBytes(std::uint16_t{1}) +
         littleBytes(std::uint16_t{1}) + littleBytes(static_cast<std::uint32_t>(entry.size())) +
         littleBytes(static_cast<std::uint32_t>(local.size())) + std::string(2, '\0');
}

TEST(ZipCheck, AnEntryThatDoesNotHaveItsChecksumIsRefused) {
  const std::string content = "heights of a surface";
  const auto checksum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
  EXPECT_NO_THROW(checkZip(zip(content, checksum)));
  EXPECT_THROW(checkZip(zip(content, checksum ^ 1u)), FileError);
  const std::string whole = zip(content, checksum);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(checkZip(whole.substr(0, size)), FileError) << size;
}

TEST(ZipCheck, AnX3pWithItsFilesInAFolderSaysSo) {
  const ScratchFolder folder;
  const std::string path = folder.write("part.x3p", zip("", 0, "part 7/main.xml"));
  EXPECT_TRUE(mentions(refusal(path), "main.xml in the folder 'part 7'"));
}

TEST(ZipCheck, AFlippedByteInAPublicArchiveIsRefused) {
  const char* folder = std::getenv("MEMS_STICTION_SCANS");
  if (folder == nullptr)
    GTEST_SKIP() << "MEMS_STICTION_SCANS is not set to a folder of vendor scans";
  std::string bytes = ScratchFolder::read(std::string(folder) + "/x3p-2.x3p");
  EXPECT_NO_THROW(checkZip(bytes));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x10);
  const ScratchFolder scratch;
  EXPECT_TRUE(mentions(refusal(scratch.write("flipped.x3p", bytes)), "damaged"));
}

}  // namespace
}  // namespace mems_stiction
