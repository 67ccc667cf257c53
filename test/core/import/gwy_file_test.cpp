
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include "import/channel_choice.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/gwy_bytes.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

using namespace gwy_bytes;

TEST(GwyFile, ChannelsCarrySizeUnitAndTitle) {
  const std::vector<FileChannel> channels = parseGwy(example());
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].id, 0);
  EXPECT_EQ(channels[0].title, "ZSensor");
  EXPECT_EQ(channels[0].unit_xy, "m");
  EXPECT_EQ(channels[0].unit_z, "m");
  EXPECT_EQ(channels[0].width, 3e-6);
  EXPECT_EQ(channels[0].height, 4e-6);
  EXPECT_EQ(channels[1].id, 10);
  EXPECT_EQ(channels[1].title, "");
  EXPECT_EQ(channels[1].unit_z, "V");
}

TEST(GwyFile, UnitsWithAPrefixAreReadAndAmperesAreNone) {
  const auto channelIn = [](const std::string& unit_xy, const std::string& unit_z) {
    const std::string content = integer("xres", 2) + integer("yres", 2) + real("xreal", 4.0) +
                                real("yreal", 2.0) + unit("si_unit_xy", unit_xy) +
                                unit("si_unit_z", unit_z) + reals("data", {1.0, 2.0, 3.0, 4.0});
    return parseGwy(file(object("/0/data", "GwyDataField", content)))[0];
  };
  const FileChannel scaled = channelIn("um", "nm");
  EXPECT_EQ(scaled.unit_xy, "m");
  EXPECT_EQ(scaled.unit_z, "m");
  EXPECT_DOUBLE_EQ(scaled.width, 4e-6);
  EXPECT_DOUBLE_EQ(scaled.height, 2e-6);
  EXPECT_DOUBLE_EQ(scaled.values.at<double>(1, 1), 4e-9);
  EXPECT_EQ(channelIn("\xC2\xB5m", "A").unit_z, "A");
  EXPECT_EQ(channelIn("m", "A").values.at<double>(1, 1), 4.0);
}

TEST(GwyFile, RowsAndColumnsAreInReadingOrder) {
  const cv::Mat values = parseGwy(example())[0].values;
  ASSERT_EQ(values.size(), cv::Size(3, 2));
  EXPECT_EQ(values.at<double>(0, 2), 3e-9);
  EXPECT_EQ(values.at<double>(1, 0), 4e-9);
}

TEST(GwyFile, MaskedPixelsAreInvalid) {
  const cv::Mat values = parseGwy(example())[0].values;
  EXPECT_TRUE(std::isnan(values.at<double>(0, 1)));
  EXPECT_EQ(values.at<double>(1, 2), 6e-9) << "a mask of 0.5 is not above 0.5";
}

TEST(GwyFile, ThatAMaskCountsAsMissingIsSaidAndCanBeSwitchedOff) {
  const std::vector<FileChannel> masked = parseGwy(example());
  ASSERT_EQ(masked[0].notes.size(), 1u);
  EXPECT_EQ(masked[0].notes[0].find("1 pixels under the mask"), 0u) << masked[0].notes[0];
  EXPECT_TRUE(masked[1].notes.empty());
  const std::vector<FileChannel> whole = parseGwy(example(), true);
  EXPECT_EQ(whole[0].values.at<double>(0, 1), 2e-9);
  EXPECT_TRUE(whole[0].notes.empty());
}

TEST(GwyFile, PitchIsSizeOverPixels) {
  const HeightMap surface = surfaceOfChannel(parseGwy(example())[0]);
  EXPECT_EQ(surface.pitchX(), 3e-6 / 3);
  EXPECT_EQ(surface.pitchY(), 4e-6 / 2);
}

TEST(GwyFile, NoChannelIsNoError) {
  EXPECT_TRUE(parseGwy(file(text("/0/base/palette", "Gray"))).empty());
}

TEST(GwyFile, SizesThatDoNotMatchTheDataAreRefused) {
  EXPECT_THROW(parseGwy(file(field("/0/data", 3, 2, {1, 2, 3, 4, 5}))), FileError);
  EXPECT_THROW(parseGwy(file(field("/0/data", 0, 2, {}))), FileError);
  EXPECT_THROW(parseGwy(file(field("/0/data", 0x80000003u, 2, {1, 2, 3, 4, 5, 6}))), FileError);
  EXPECT_THROW(parseGwy(file(field("/0/data", 0xFFFFFFFFu, 0xFFFFFFFFu, {1}))), FileError);
  EXPECT_THROW(parseGwy(file(field("/0/data", 1, 1, {1}) + field("/0/mask", 2, 1, {1, 1}))),
               FileError);
}

TEST(GwyFile, HugeCountsAreRefusedBeforeMemoryIsTaken) {
  EXPECT_THROW(parseGwy(file(named("data", 'D') + littleEndian(0xFFFFFFFF, 4))), FileError);
  EXPECT_THROW(parseGwy(file(named("names", 'S') + littleEndian(0xFFFFFFFF, 4))), FileError);
  EXPECT_THROW(parseGwy("GWYP" + std::string("GwyContainer\0", 13) + littleEndian(0xFFFFFFFF, 4)),
               FileError);
}

TEST(GwyFile, OtherContentIsRefused) {
  EXPECT_THROW(parseGwy(""), FileError);
  EXPECT_THROW(parseGwy("GWYO"), FileError);
  EXPECT_THROW(parseGwy("GWYP" + body("GwyDataField", "")), FileError);
  EXPECT_THROW(parseGwy(file(named("x", 'z'))), FileError);
}

TEST(GwyFile, EveryTruncationIsRefused) {
  const std::string whole = example();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(parseGwy(whole.substr(0, size)), FileError)
        << size << " of " << whole.size() << " bytes";
  }
}

TEST(GwyFile, EveryFlippedByteIsReadOrRefused) {
  const std::string whole = example();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int value : {0x00, 0x01, 0x7F, 0x80, 0xFF, whole[at] ^ 0x20}) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(value);
      try {
        for (const FileChannel& channel : parseGwy(damaged)) EXPECT_FALSE(channel.values.empty());
      } catch (const FileError&) {
        // Refused by name: as good as read.
      }
    }
  }
}

TEST(GwyFile, RandomBytesAreReadOrRefused) {
  std::mt19937 random(1);
  const std::string whole = example();
  for (int round = 0; round < 20000; ++round) {
    std::string damaged = whole;
    for (int flips = 0; flips < 4; ++flips)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      parseGwy(damaged);
    } catch (const FileError&) {
    }
  }
}

TEST(GwyFile, ErrorsNameTheFile) {
  const ScratchFolder folder;
  const std::string path = folder.write("cut.gwy", example().substr(0, 100));
  try {
    readScanFile(path);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).find(path + ": "), 0u) << error.what();
  }
  EXPECT_THROW(readScanFile(folder.file("none.gwy")), FileError);
}

TEST(GwyFile, AnotherVersionIsNamedNotCalledDamaged) {
  const ScratchFolder folder;
  for (const std::string kind : {"GWYO", "GWYQ"}) {
    try {
      readScanFile(folder.write("old.gwy", kind + "GwyContainer" + std::string(20, '\0')));
      ADD_FAILURE() << kind;
    } catch (const FileError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(kind), std::string::npos) << text;
      EXPECT_EQ(text.find("misnamed"), std::string::npos) << text;
    }
  }
}

// ---- Which channel is the height?

FileChannel channel(int id, const std::string& title, const std::string& unit_z = "m") {
  FileChannel result;
  result.id = id;
  result.title = title;
  result.values = cv::Mat::zeros(4, 4, CV_64FC1);
  result.width = result.height = 1e-6;
  result.unit_xy = "m";
  result.unit_z = unit_z;
  return result;
}

TEST(ChannelChoice, ClosedLoopSensorGoesBeforeHeight) {
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height"), channel(1, "ZSensor")}), 1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height"), channel(1, "Height")}), 0u);
  EXPECT_EQ(chooseHeightChannel({channel(3, "Unknown"), channel(4, "Topography")}), 1u);
  EXPECT_EQ(chooseHeightChannel({channel(3, "")}), 0u);
}

TEST(ChannelChoice, MetresThatAreNotHeightsAreNotTaken) {
  EXPECT_EQ(chooseHeightChannel(
                {channel(0, "AmplitudeError"), channel(1, "Deflection"), channel(2, "Height")}),
            2u);
  EXPECT_THROW(chooseHeightChannel({channel(0, "AmplitudeError"), channel(1, "Deflection")}),
               FileError);
}

TEST(ChannelChoice, SensorsOfEveryMakerGoBeforeTheirOpenLoops) {
  EXPECT_EQ(chooseHeightChannel({channel(0, "Z-Axis forward"), channel(1, "Z-AxisSensor forward")}),
            1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height"), channel(1, "Height (measured)")}), 1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height"), channel(1, "Height Sensor")}), 1u);
}

TEST(ChannelChoice, ForwardGoesBeforeBackward) {
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height (Backward)"), channel(1, "Height (Forward)")}),
            1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Topography [<-]"), channel(1, "Topography [->]")}),
            1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "HeightRetrace"), channel(1, "HeightTrace")}), 1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Z bwd"), channel(1, "Z fwd")}), 1u);
  // The sensor of the way back is still the sensor.
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height trace"), channel(1, "ZSensor retrace")}), 1u);
}

TEST(ChannelChoice, TheTipOfRhkGoesToTheRightFirst) {
  EXPECT_EQ(
      chooseHeightChannel({channel(0, "Topography [Left]"), channel(1, "Topography [Right]")}), 1u);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Upper left corner"), channel(1, "Lower corner")}), 0u);
}

TEST(ChannelChoice, HeightsBeyondThePiezoAreNone) {
  FileChannel beyond = channel(0, "ZSensor");
  beyond.reach = 1e-7;
  beyond.values.at<double>(1, 1) = 5e-7;
  FileChannel within = channel(1, "Height");
  within.reach = 1e-7;
  within.values.at<double>(1, 1) = 1.1e-7;  // calibrations differ
  EXPECT_EQ(chooseHeightChannel({beyond, within}), 1u);
  EXPECT_NE(passedOver({beyond, within}, 1).find("piezo can move"), std::string::npos);
  EXPECT_THROW(surfaceOfChannel(beyond), FileError);
  EXPECT_NO_THROW(surfaceOfChannel(within));
}

TEST(ChannelChoice, TopographiesOfOtherSizeAreSaid) {
  FileChannel smaller = channel(7, "Zoom");
  smaller.width = 5e-7;
  const std::string said = othersOfOtherSize({channel(0, "Topography"), smaller}, 0);
  EXPECT_EQ(said, "") << "a title that says nothing is no topography as this one is";
  smaller.title = "Topography zoom";
  const std::string named =
      othersOfOtherSize({channel(0, "Topography"), channel(1, "Topography"), smaller}, 0);
  EXPECT_NE(named.find("0: Topography (4 x 4 pixels of 1e-06 x 1e-06 m) is taken"),
            std::string::npos)
      << named;
  EXPECT_NE(named.find("--channel takes another: 7: Topography zoom"), std::string::npos) << named;
  EXPECT_EQ(othersOfOtherSize({channel(0, "Topography"), channel(1, "Topography")}, 0), "");
}

TEST(ChannelChoice, NamesOfSignalsInMetresAreNamesOfSamples) {
  EXPECT_EQ(chooseHeightChannel({channel(0, "Phase")}), 0u)
      << "interferometers call their heights so";
  EXPECT_EQ(chooseHeightChannel({channel(0, "Adhesion sample 4")}), 0u);
  EXPECT_THROW(chooseHeightChannel({channel(0, "Adhesion")}), FileError);
  EXPECT_THROW(chooseHeightChannel({channel(0, "Current (forward)")}), FileError);
  EXPECT_EQ(chooseHeightChannel({channel(0, "Phase"), channel(1, "Height")}), 1u);
}

TEST(ChannelChoice, ASensorInVoltsThatCallsThemMetresIsPassedOver) {
  std::vector<FileChannel> channels = {channel(0, "HeightTrace"), channel(1, "ZSensorTrace")};
  channels[1].values.at<double>(1, 1) = 0.6;  // on a scan of a micrometre
  EXPECT_EQ(chooseHeightChannel(channels), 0u);
  EXPECT_EQ(
      passedOver(channels, 0),
      "0: HeightTrace is taken: the heights of 1: ZSensorTrace span more than the scan is wide");
  EXPECT_EQ(chooseHeightChannel(channels, "ZSensorTrace"), 1u);
  channels[1].values.at<double>(1, 1) = 1e38;  // a program's "none"
  EXPECT_EQ(chooseHeightChannel(channels), 1u);
  EXPECT_EQ(passedOver(channels, 1), "");
  EXPECT_EQ(chooseHeightChannel({channels[1]}), 0u)
      << "what there is alone is taken; the scan's warning says the rest";
}

TEST(ChannelChoice, ASpikeThatSwitchesToTheWayBackIsSaid) {
  std::vector<FileChannel> channels = {channel(0, "Z Forward"), channel(1, "Z Backward")};
  EXPECT_EQ(chooseHeightChannel(channels), 0u);
  EXPECT_EQ(passedOver(channels, 0), "");
  channels[0].values.at<double>(1, 1) = 2e-6;  // on a scan of a micrometre
  EXPECT_EQ(chooseHeightChannel(channels), 1u);
  EXPECT_EQ(passedOver(channels, 1),
            "1: Z Backward is taken: the heights of 0: Z Forward span more than the scan is wide");
  channels[1].title = "Z Forward";  // the second frame, of no other title
  EXPECT_EQ(chooseHeightChannel(channels), 1u);
  EXPECT_NE(passedOver(channels, 1), "");
  std::swap(channels[0].values, channels[1].values);
  EXPECT_EQ(chooseHeightChannel(channels), 0u);
  EXPECT_EQ(passedOver(channels, 0), "") << "what comes behind in any case";
}

TEST(ChannelChoice, AChannelWithoutAMeasuredPixelIsPassedOver) {
  std::vector<FileChannel> channels = {channel(0, "Z Forward"), channel(1, "Z Backward")};
  channels[0].values.setTo(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(chooseHeightChannel(channels), 1u);
  EXPECT_EQ(passedOver(channels, 1), "1: Z Backward is taken: 0: Z Forward has no measured pixel");
  channels[1].values.setTo(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(chooseHeightChannel(channels), 0u) << "whoever opens it says that nothing was measured";
}

TEST(ChannelChoice, ArraysOfCurvesAreNotTaken) {
  FileChannel curves = channel(0, "Z-Axis Sensor");
  curves.height = 1.0;  // 4 curves of 4 points a micrometre long
  EXPECT_EQ(chooseHeightChannel({curves, channel(1, "Z-Axis forward")}), 1u);
  EXPECT_THROW(chooseHeightChannel({curves}), FileError);
  EXPECT_EQ(chooseHeightChannel({curves}, "0"), 0u);
}

TEST(ChannelChoice, OtherUnitsAreNotTaken) {
  EXPECT_EQ(chooseHeightChannel({channel(0, "Height", "V"), channel(1, "Height")}), 1u);
  EXPECT_THROW(chooseHeightChannel({channel(0, "Height", "V")}), FileError);
  EXPECT_THROW(chooseHeightChannel({}), FileError);
}

TEST(ChannelChoice, MayBeNamedByTitleOrNumber) {
  const std::vector<FileChannel> channels = {channel(0, "ZSensor"), channel(3, "Deflection"),
                                             channel(5, "Phase", "deg")};
  EXPECT_EQ(chooseHeightChannel(channels, "Deflection"), 1u);
  EXPECT_EQ(chooseHeightChannel(channels, "3"), 1u);
  EXPECT_THROW(chooseHeightChannel(channels, "Phase"), FileError);
  try {
    chooseHeightChannel(channels, "Heihgt");
    FAIL();
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(),
                 "there is no channel 'Heihgt'; there are: 0: ZSensor [m], 3: Deflection [m], 5: "
                 "Phase [deg]");
  }
}

TEST(ChannelChoice, ASurfaceHasTwoPixelsEachWayAndAPitch) {
  FileChannel bad = channel(0, "Height");
  bad.width = 0.0;
  EXPECT_THROW(surfaceOfChannel(bad), FileError);
  bad = channel(0, "Height");
  bad.values = cv::Mat::zeros(1, 1, CV_64FC1);
  EXPECT_THROW(surfaceOfChannel(bad), FileError);
}

}  // namespace
}  // namespace mems_stiction
