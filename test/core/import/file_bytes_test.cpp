#include "import/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <chrono>
#include <filesystem>

#include "import/zip_check.hpp"
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

std::uint32_t crc(const std::string& content) {
  return static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size())));
}

TEST(ZipCheck, AnEntryThatDoesNotHaveItsChecksumIsRefused) {
  const std::string content = "heights of a surface";
  const std::uint32_t checksum = crc(content);
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

/// An archive with one entry more, of so many bytes by its directory.
std::string x3pWith(const std::string& entry, std::uint64_t size, const std::string& points) {
  const std::string xml =
      "<a:ISO5436_2><SizeX >" + points + "</SizeX><SizeY>\n1 </SizeY><p:SizeZ>1</p:SizeZ>";
  const bool is_wide = size >= 0xFFFFFFFF;
  const std::string narrow = littleBytes(static_cast<std::uint32_t>(is_wide ? 0xFFFFFFFF : size));
  const std::string wide =
      is_wide ? littleBytes(std::uint16_t{1}) + littleBytes(std::uint16_t{8}) + littleBytes(size)
              : "";
  std::string bytes = zip(xml, crc(xml), "main.xml");
  const std::size_t directory = bytes.find("PK\1\2");
  const std::size_t end = bytes.find("PK\5\6");
  const std::string list =
      (entry == "main.xml" ? "" : bytes.substr(directory, end - directory)) + "PK\1\2" +
      littleBytes(std::uint16_t{20}) + littleBytes(std::uint16_t{20}) + std::string(2, '\0') +
      littleBytes(std::uint16_t{8}) + std::string(8, '\0') + littleBytes(std::uint32_t{9}) +
      narrow + littleBytes(static_cast<std::uint16_t>(entry.size())) +
      littleBytes(static_cast<std::uint16_t>(wide.size())) + std::string(14, '\0') + entry + wide;
  const auto count = static_cast<std::uint16_t>(entry == "main.xml" ? 1 : 2);
  return bytes.substr(0, directory) + list + "PK\5\6" + std::string(4, '\0') + littleBytes(count) +
         littleBytes(count) + littleBytes(static_cast<std::uint32_t>(list.size())) +
         littleBytes(static_cast<std::uint32_t>(directory)) + std::string(2, '\0');
}

std::string x3pFault(const std::string& bytes) {
  try {
    checkX3p(bytes);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

TEST(ZipCheck, AnX3pThatUnpacksToMoreThanItsPointsNeedIsRefusedUnread) {
  constexpr std::uint64_t kGigabyte = 1 << 30;
  EXPECT_TRUE(mentions(x3pFault(x3pWith("main.xml", kGigabyte, "9")),
                       "'main.xml' unpacks to 1073741824 bytes, more than the 67108864"));
  EXPECT_TRUE(mentions(x3pFault(x3pWith("bindata/data.bin", kGigabyte, "640")),
                       "bytes, more than the 67108864 that 640 points may need"));
  EXPECT_TRUE(mentions(x3pFault(x3pWith("bindata/data.bin", kGigabyte, "10000000")),
                       "bytes, more than the 240000000 that 10000000 points may need"));
  EXPECT_FALSE(mentions(x3pFault(x3pWith("data.bin", 200'000'000, "10000000")), "more than"));
  EXPECT_TRUE(mentions(x3pFault(x3pWith("data.bin", 9, "10000000000")), "pixels are more than"));
  EXPECT_TRUE(
      mentions(x3pFault(x3pWith("data.bin", 9, "many")), "main.xml states 'many' as SizeX"));
}

TEST(ZipCheck, SizesOf64BitsCount) {
  for (const char* name : {"main.xml", "data.bin"}) {
    EXPECT_TRUE(mentions(x3pFault(x3pWith(name, std::uint64_t{3} << 40, "9")),
                         "unpacks to 3298534883328 bytes"));
  }
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
