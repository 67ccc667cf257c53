/// A scan as two messages on the wire: scan_info, then the image. First a byte: whether the pixels
/// are made as long as the image states, so that not every input ends there.

#include <ros/serialization.h>
#include <boost/make_shared.hpp>

#include "fuzz/byte_source.hpp"
#include "fuzz/fuzzing.hpp"
#include "height_map/scan_sanity.hpp"
#include "ros/image_conversion.hpp"

namespace {

using namespace mems_stiction;

constexpr std::uint64_t kMostPixelBytes = 1 << 16;

/// All of the image but its length: roscpp makes room for what a message states before it looks how
/// much there is.
void readImage(ros::serialization::IStream& stream, bool is_made_to_fit,
               sensor_msgs::Image& image) {
  stream.next(image.header);
  stream.next(image.height);
  stream.next(image.width);
  stream.next(image.encoding);
  stream.next(image.is_bigendian);
  stream.next(image.step);
  image.data.assign(stream.getData(), stream.getData() + stream.getLength());
  const std::uint64_t stated = std::uint64_t{image.step} * image.height;
  if (is_made_to_fit && stated <= kMostPixelBytes) image.data.resize(stated);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzzing::ByteSource bytes(data, size);
  const bool is_made_to_fit = bytes.below(2) == 1;
  std::string message = bytes.rest();
  ScanInfo info;
  const auto image = boost::make_shared<sensor_msgs::Image>();
  try {
    ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(message.data()),
                                       static_cast<std::uint32_t>(message.size()));
    stream.next(info);
    readImage(stream, is_made_to_fit, *image);
  } catch (const ros::serialization::StreamOverrunException&) {
    return 0;  // no such message: roscpp lets it go
  }

  fuzzing::accepted([&] {
    const ScanOptions options = scanOptions(info, {});
    const ReceivedScan scan = receiveScan(image, options);
    const ScanIdentity identity = identityOf(image->header, &info);
    fuzzing::require(identity.part_id == info.part_id, "the part is the message's");
    fuzzing::require(scan.surface.rows() == static_cast<int>(image->height), "a row for each row");
    fuzzing::require(scan.surface.pitchX() > 0.0 && scan.surface.pitchY() > 0.0,
                     "a scan has a pitch");
    scanWarnings(scan.surface);
    const sensor_msgs::ImagePtr shown = heightImage(scan.surface.heights(), image->header);
    fuzzing::require(shown->data.size() == std::size_t{shown->step} * image->height,
                     "the picture is whole");
  });
  return 0;
}
