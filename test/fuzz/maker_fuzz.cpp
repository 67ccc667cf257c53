/// The bytes of a file of an instrument maker, an image or an array, behind the signature of its
/// format, which the first byte of the input chooses: by the readers here that need no other
/// program.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "fuzz/byte_source.hpp"
#include "fuzz/fuzzing.hpp"
#include "height_map/scan_sanity.hpp"
#include "import/channel_choice.hpp"
#include "import/file_checks.hpp"
#include "import/format_readers.hpp"
#include "import/nanoscope_check.hpp"
#include "import/stated_twice.hpp"
#include "import/zip_check.hpp"

namespace mems_stiction {
namespace {

using Channels = std::vector<FileChannel>;

struct Reader {
  std::string signature;
  std::function<Channels(const std::string& bytes)> read;
};

Channels readNanoscope(const std::string& bytes) {
  checkedNanoscope(bytes);
  return parseNanoscope(bytes);
}

Channels readWsxm(const std::string& bytes) {
  if (!isWsxmImage(bytes.substr(0, 200))) return {};
  return {parseWsxm(bytes)};
}

Channels readNetcdf(const std::string& bytes) {
  if (const auto heights = parseNetcdfHeights(bytes)) return {*heights};
  gxsmStatements(bytes);
  return {};
}

/// What is asked of every file before gwyddion reads it.
Channels checkWhole(const std::string& bytes) {
  checkTransfer(bytes);
  checkStatedLength(bytes);
  checkStatedTwice(bytes);
  withWholeCreatecHeader(bytes);
  return {};
}

const std::array<Reader, 17>& readers() {
  static const std::array<Reader, 17> readers = {{
      {"\\*File list", readNanoscope},
      {"\\*File list", parseNanoscopeText},
      {"\"\\*File list", parseNanoscopeText},
      {"DIGITAL SURF", parseSur},
      {"DSCOMPRESSED", parseSur},
      {"WSxM", readWsxm},
      {std::string("CDF\1", 4), readNetcdf},
      {"DSAA\n", [](const std::string& bytes) { return Channels{parseSurferGrid(bytes)}; }},
      {"\x93NUMPY", [](const std::string& bytes) { return Channels{parseNpy(bytes)}; }},
      {"PK\3\4",
       [](const std::string& bytes) {
         checkX3p(bytes);
         return Channels();
       }},
      {"", checkWhole},
      {std::string("II*\0", 4), parseTiff},
      {std::string("MM\0*", 4), parseTiff},
      {"\x89PNG", [](const std::string& bytes) { return Channels{parsePng(bytes)}; }},
      {"\x76\x2f\x31\x01", [](const std::string& bytes) { return Channels{parseExr(bytes)}; }},
      {"Gwyddion Simple Field 1.",
       [](const std::string& bytes) { return Channels{parseGsf(bytes)}; }},
      {"Binary TrueMap Data File v2.0",
       [](const std::string& bytes) { return Channels{parseTmd(bytes)}; }},
  }};
  return readers;
}

}  // namespace
}  // namespace mems_stiction

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  fuzzing::ByteSource source(data, size);
  const Reader& reader = readers().at(source.below(readers().size()));
  const std::string bytes = reader.signature + source.rest();
  fuzzing::accepted([&] {
    const Channels channels = reader.read(bytes);
    if (channels.empty()) return;
    const std::size_t chosen = chooseHeightChannel(channels);
    fuzzing::require(chosen < channels.size(), "what is chosen is there");
    passedOver(channels, chosen);
    if (channels[chosen].takes_settings) return;  // pitch and unit are for others to state
    const HeightMap surface = surfaceOfChannel(channels[chosen]);
    fuzzing::require(surface.pitchX() > 0.0 && surface.pitchY() > 0.0, "a surface has a pitch");
    scanWarnings(surface);
  });
  return 0;
}
