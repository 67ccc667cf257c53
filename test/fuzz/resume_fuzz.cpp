/// The files that a batch finds when it goes on: its rows, and the settings that they were made
/// with. A first byte chooses the kind of rows, a zero byte parts the two files.

#include "fuzz/byte_source.hpp"
#include "fuzz/fuzzing.hpp"
#include "support/scratch_folder.hpp"
#include "tools/batch_rows.hpp"
#include "tools/batch_settings.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  static const ScratchFolder folder;
  fuzzing::ByteSource bytes(data, size);
  const bool is_csv = bytes.below(2) == 0;
  const std::string text = bytes.rest();
  const std::size_t end = text.find('\0');
  const std::string path = folder.write(is_csv ? "rows.csv" : "rows.jsonl", text.substr(0, end));
  const std::string settings = end == std::string::npos ? "" : text.substr(end + 1);
  folder.write(is_csv ? "rows.csv.settings.yaml" : "rows.jsonl.settings.yaml", settings);

  fuzzing::accepted([&] { checkSettings(path, "total: 3\n"); });
  fuzzing::accepted([&] { totalOf(path, settings); });
  const RowFormat format = rowFormatOf(path);
  const std::string heading = headingText(format, {"number", "status"});
  fuzzing::accepted(
      [&] { mergeRows({path}, folder.file(is_csv ? "whole.csv" : "whole.jsonl"), 3); });
  fuzzing::accepted([&] {
    std::size_t done = 0;
    {
      RowFile rows(path, format, heading, {1, 2, 3});
      done = rows.done();
      fuzzing::require(done <= 3, "no more rows than the shard has");
      rows.append(
          rowText({{"number", done + 1}, {"status", "bonded"}}, format, {"number", "status"}));
    }
    if (done == 3) return;
    const RowFile again(path, format, heading, {1, 2, 3});
    fuzzing::require(again.done() == done + 1, "a row that was appended is found again");
  });
  return 0;
}
