/// What a bag says of its own lengths is checked before rosbag believes it.

#include "tools/bag_check.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <string>

#include "mems_stiction/ScanInfo.h"
#include "mems_stiction/errors/errors.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

class BagCheck : public ::testing::Test {
 protected:
  BagCheck() {
    const std::string path = folder_.file("whole.bag");
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    for (int second = 1; second <= 3; ++second)
      bag.write("scan_info", ros::Time(second), ScanInfo());
    bag.write("other_info", ros::Time(4), ScanInfo());
    bag.close();
    whole_ = ScratchFolder::read(path);
  }

  std::string refusal(const std::string& bytes) const {
    try {
      checkBag(folder_.write("other.bag", bytes));
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  /// The whole bag with a number of 4 bytes changed, `before` bytes before the first `text` after
  /// `start`.
  std::string changed(const std::string& text, std::size_t before, std::uint32_t number,
                      std::size_t start = 0) const {
    std::string bytes = whole_;
    bytes.replace(bytes.find(text, start) - before, 4, reinterpret_cast<const char*>(&number), 4);
    return bytes;
  }

  ScratchFolder folder_;
  std::string whole_;
};

TEST_F(BagCheck, AWholeBagIsWhole) {
  EXPECT_EQ(checkBag(folder_.file("whole.bag")), BagEnd::kWhole);
}

TEST_F(BagCheck, ABagWithoutItsEndIsCutOffWhereverItEnds) {
  for (std::size_t length = 20; length < whole_.size(); length += 97) {
    EXPECT_EQ(checkBag(folder_.write("cut.bag", whole_.substr(0, length))), BagEnd::kCutOff)
        << length;
  }
}

TEST_F(BagCheck, ABagThatWasCutOffInsideItsIndexSaysWhereItsMessagesEnd) {
  std::uint64_t index = 0;
  whole_.copy(reinterpret_cast<char*>(&index), sizeof index, whole_.find("index_pos=") + 10);
  for (std::size_t length = index - 32; length < whole_.size(); length += 32) {
    const std::string path = folder_.write("cut.bag", whole_.substr(0, length));
    EXPECT_EQ(checkBag(path), BagEnd::kCutOff) << length;
    EXPECT_EQ(cutIndexPlace(path), length < index ? 0 : index) << length;
  }
  EXPECT_EQ(cutIndexPlace(folder_.file("whole.bag")), 0u);
}

TEST_F(BagCheck, AFieldThatIsLongerThanItsHeaderIsRefused) {
  EXPECT_NE(refusal(changed("topic=", 4, 0xfffffff0u)).find("longer than its header"),
            std::string::npos);
}

TEST_F(BagCheck, AnIndexThatLeadsToNoMessageIsRefused) {
  const std::size_t index = whole_.find("count=");  // of the bag's header comes "chunk_count="
  const std::size_t entries = whole_.find("ver=", index) + 4 + 4;
  std::string bytes = whole_;
  bytes[entries + 4 + 8] ^= 0x7f;
  EXPECT_NE(refusal(bytes), "");
}

TEST_F(BagCheck, AnIndexThatLeadsToAMessageOfAnotherConnectionIsRefused) {
  const std::size_t index =
      whole_.find("count=", whole_.find("size="));  // behind the chunk's header: of the first index
  EXPECT_NE(refusal(changed("count=", 8, 1, index)).find("a message of another connection"),
            std::string::npos);
}

TEST_F(BagCheck, AConnectionThatIsNotInTheBagsIndexIsRefused) {
  std::string bytes = whole_;
  bytes[bytes.rfind("conn=") + 5] =
      64;  // rosbag looked for connection 1 there, and read what it did not find
  EXPECT_NE(refusal(bytes).find("a connection (1) that is not in its index"), std::string::npos)
      << refusal(bytes);
}

TEST_F(BagCheck, AnotherFileIsNoBag) {
  EXPECT_NE(refusal("#ROSBAG V1.2\n").find("version 2.0"), std::string::npos);
  EXPECT_NE(refusal("").find("version 2.0"), std::string::npos);
}

}  // namespace
}  // namespace mems_stiction
