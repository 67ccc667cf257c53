#include "bag_check.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

const std::string kMagic = "#ROSBAG V2.0\n";
/// Of a header or a connection: names, a type and a definition [bytes].
constexpr std::uint64_t kLargestHeader = 1 << 20;

enum Op : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// Reading went beyond the end.
struct CutOff {};

struct Record {
  std::uint64_t begin = 0, data = 0, end = 0;  ///< places in the file
  std::map<std::string, std::string> fields;
  std::uint8_t op = 0;
};

class BagWalk {
 public:
  explicit BagWalk(const std::string& path)
      : path_(path), stream_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {}

  BagEnd walk() {
    if (bytes(0, std::min<std::uint64_t>(kMagic.size(), size_)) != kMagic) {
      throw FileError(path_ + ": not a bag that can be read: not of version 2.0");
    }
    try {
      walkRecords();
    } catch (const CutOff&) {
      return BagEnd::kCutOff;
    }
    return BagEnd::kWhole;
  }

  /// After walk().
  std::uint64_t indexPlace() const { return index_place_ <= size_ ? index_place_ : 0; }

 private:
  [[noreturn]] void fail(std::uint64_t place, const std::string& what) const {
    throw FileError(path_ + ": the bag is damaged at byte " + std::to_string(place) + ": " + what);
  }

  std::string bytes(std::uint64_t place, std::uint64_t count) {
    if (place > size_ || count > size_ - place) throw CutOff();
    std::string text(count, '\0');
    stream_.seekg(static_cast<std::streamoff>(place));
    if (!stream_.read(text.data(), static_cast<std::streamsize>(count)))
      throw FileError(path_ + ": cannot be read");
    return text;
  }

  template <typename Value>
  Value value(std::uint64_t place) {
    Value number{};
    std::memcpy(&number, bytes(place, sizeof number).data(), sizeof number);
    return number;
  }

  /// @throw FileError if the record has no such field of this size
  template <typename Value>
  Value field(const Record& record, const std::string& name) const {
    Value number{};
    const auto found = record.fields.find(name);
    if (found == record.fields.end() || found->second.size() != sizeof number) {
      fail(record.begin, "a record without its field '" + name + "'");
    }
    std::memcpy(&number, found->second.data(), sizeof number);
    return number;
  }

  std::map<std::string, std::string> fieldsOf(std::uint64_t begin, std::uint64_t length) {
    if (length > kLargestHeader) fail(begin, "a header of " + std::to_string(length) + " bytes");
    const std::string text = bytes(begin, length);
    std::map<std::string, std::string> fields;
    for (std::size_t place = 0; place < text.size();) {
      std::uint32_t size = 0;
      if (text.size() - place < sizeof size)
        fail(begin + place, "a header that ends inside a field");
      std::memcpy(&size, text.data() + place, sizeof size);
      place += sizeof size;
      if (size > text.size() - place) fail(begin + place, "a field that is longer than its header");
      const std::string entry = text.substr(place, size);
      const std::size_t equals = entry.find('=');
      if (equals == std::string::npos || equals == 0) fail(begin + place, "a field without a name");
      fields[entry.substr(0, equals)] = entry.substr(equals + 1);
      place += size;
    }
    return fields;
  }

  /// - @p end of what the record must lie in
  Record recordAt(std::uint64_t begin, std::uint64_t end) {
    Record record;
    record.begin = begin;
    const std::uint64_t header_length = value<std::uint32_t>(begin);
    record.fields = fieldsOf(begin + 4, header_length);
    record.op = field<std::uint8_t>(record, "op");
    record.data = begin + 4 + header_length + 4;
    record.end = record.data + value<std::uint32_t>(record.data - 4);
    if (record.end > size_) throw CutOff();
    if (record.end > end) fail(begin, "a record that is longer than its chunk");
    if (record.op == kConnection) {
      field<std::uint32_t>(record, "conn");
      fieldsOf(record.data, record.end - record.data);
    }
    return record;
  }

  /// Where the records of a chunk begin, from its first byte; empty if it is compressed.
  void walkChunk(const Record& chunk) {
    messages_.clear();
    chunk_size_ = field<std::uint32_t>(chunk, "size");
    const auto compression = chunk.fields.find("compression");
    is_compressed_ = compression != chunk.fields.end() && compression->second != "none";
    if (is_compressed_) return;
    if (chunk_size_ != chunk.end - chunk.data)
      fail(chunk.begin, "a chunk of another size than it states");
    for (std::uint64_t place = chunk.data; place < chunk.end;) {
      const Record record = recordAt(place, chunk.end);
      if (record.op == kMessage) messages_[place - chunk.data] = connectionOf(record);
      place = record.end;
    }
  }

  /// The connection that a message or an index names.
  std::uint32_t connectionOf(const Record& record) {
    const auto connection = field<std::uint32_t>(record, "conn");
    named_.emplace(connection, record.begin);
    return connection;
  }

  /// Entries of 12 bytes: time and place in the chunk before it.
  void checkIndex(const Record& index) {
    const std::uint32_t connection = connectionOf(index);
    const std::uint64_t count = field<std::uint32_t>(index, "count");
    if (12 * count != index.end - index.data)
      fail(index.begin, "an index of another length than it states");
    for (std::uint64_t place = index.data; place < index.end; place += 12) {
      const std::uint32_t message = value<std::uint32_t>(place + 8);
      const auto found = messages_.find(message);
      if (is_compressed_ ? message >= chunk_size_ : found == messages_.end()) {
        fail(place, "an index that leads to no message");
      }
      if (!is_compressed_ && found->second != connection)
        fail(place, "an index that leads to a message of another connection");
    }
  }

  void checkChunkInfo(const Record& info, const std::set<std::uint64_t>& chunks) {
    if (8 * std::uint64_t{field<std::uint32_t>(info, "count")} != info.end - info.data) {
      fail(info.begin, "a list of another length than it states");
    }
    if (chunks.count(field<std::uint64_t>(info, "chunk_pos")) == 0)
      fail(info.begin, "a list of no chunk");
  }

  void walkRecords() {
    std::uint64_t place = kMagic.size();
    const Record header = recordAt(place, size_);
    if (header.op != kBagHeader) fail(place, "the header of the bag is missing");
    const auto index_place = field<std::uint64_t>(header, "index_pos");
    index_place_ = index_place;
    if (index_place == 0) throw CutOff();  // whoever wrote it did not come to its end
    std::set<std::uint64_t> chunks;
    std::set<std::uint64_t> places;
    std::uint64_t chunk_infos = 0;
    std::set<std::uint32_t>
        connections;  // that stand behind all chunks, where rosbag looks for them
    for (place = header.end; place < size_;) {
      const Record record = recordAt(place, size_);
      places.insert(place);
      if (record.op == kChunk) {
        chunks.insert(place);
        walkChunk(record);
      } else if (record.op == kIndex) {
        if (chunks.empty()) fail(place, "an index before any chunk");
        checkIndex(record);
      } else if (record.op == kChunkInfo) {
        checkChunkInfo(record, chunks);
        ++chunk_infos;
      } else if (record.op == kConnection) {
        if (place >= index_place) connections.insert(field<std::uint32_t>(record, "conn"));
      } else {
        fail(place, "a record of an unknown kind");
      }
      place = record.end;
    }
    if (index_place > size_) throw CutOff();
    if (index_place != size_ && places.count(index_place) == 0)
      fail(kMagic.size(), "its index is not where it states");
    // Between two of the last records, where nothing but their number tells of a cut.
    if (connections.size() < field<std::uint32_t>(header, "conn_count") ||
        chunk_infos < field<std::uint32_t>(header, "chunk_count")) {
      throw CutOff();
    }
    for (const auto& [connection, named_at] : named_) {
      if (connections.count(connection) == 0) {
        fail(named_at,
             "a connection (" + std::to_string(connection) + ") that is not in its index");
      }
    }
  }

  std::string path_;
  std::ifstream stream_;
  std::uint64_t size_;
  std::uint64_t index_place_ = 0;
  std::uint64_t chunk_size_ = 0;                     ///< of the last chunk
  bool is_compressed_ = false;                       ///< the last chunk
  std::map<std::uint64_t, std::uint32_t> messages_;  ///< in the last chunk: place and connection
  std::map<std::uint32_t, std::uint64_t> named_;     ///< connections, and who names each first
};

}  // namespace

BagEnd checkBag(const std::string& path) { return BagWalk(path).walk(); }

std::uint64_t cutIndexPlace(const std::string& path) {
  BagWalk walk(path);
  return walk.walk() == BagEnd::kCutOff ? walk.indexPlace() : 0;
}

}  // namespace mems_stiction
