/// HDF5 files as their programs lay them out, written by h5py; without it there is nothing to test.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

bool hasH5py() { return std::system("/usr/bin/python3 -c 'import h5py' >/dev/null 2>&1") == 0; }

/// The path of a file that the lines write into `file`.
std::string writtenBy(const ScratchFolder& folder, const std::string& name,
                      const std::string& lines) {
  const std::string path = folder.file(name);
  const std::string script = folder.write(
      "write.py", "import sys, h5py, numpy\nfile = h5py.File(sys.argv[1], 'w')\n" + lines);
  EXPECT_EQ(std::system(("/usr/bin/python3 " + script + " " + path).c_str()), 0);
  return path;
}

class Hdf5 : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!hasH5py()) GTEST_SKIP() << "needs python3-h5py";
  }

  ScratchFolder folder_;
};

TEST_F(Hdf5, ReadsTheFirstFrameOfJpk) {
  const std::string path = writtenBy(folder_, "scan.h5-jpk", R"(
group = file.create_group("Measurement_000")
for key, value in (("ilength", 3), ("jlength", 2), ("ulength", 3e-6), ("vlength", 1e-6)):
    group.attrs["position-pattern.grid." + key] = value
for number, name, retrace in ((0, "height", "true"), (1, "measuredHeight", "false"), (2, "vDeflection", "false")):
    channel = group.create_group("Channel_%03d" % number)
    channel.attrs["channel.name"] = name
    channel.attrs["retrace"] = retrace
    channel.attrs["net-encoder.scaling.multiplier"] = 1e-9
    channel.attrs["net-encoder.scaling.offset"] = 5e-9
    channel[name.capitalize()] = numpy.array([[1, 9], [2, 9], [3, 9], [4, 9], [5, 9], [6, 9 + number]], dtype="i4")
)");
  const Hdf5Channels read = channelsByH5py(path, 60.0);
  ASSERT_EQ(read.channels.size(), 3U);
  EXPECT_EQ(read.channels[0].title, "height retrace");
  EXPECT_EQ(read.channels[2].unit_z, "V");
  ASSERT_EQ(read.channels[1].notes.size(), 1U);
  EXPECT_EQ(read.channels[1].notes[0], "the first of 2 frames");
  const HeightMap surface = readScanFile(path);
  ASSERT_EQ(surface.rows(), 2);
  ASSERT_EQ(surface.cols(), 3);
  EXPECT_DOUBLE_EQ(surface.pitchX(), 1e-6);
  EXPECT_DOUBLE_EQ(surface.pitchY(), 0.5e-6);
  EXPECT_NEAR(surface.height(0, 0), 9e-9, 1e-20);  // the last line of the file is the upper row
  EXPECT_NEAR(surface.height(1, 2), 8e-9, 1e-20);
}

TEST_F(Hdf5, ReadsTopostats) {
  const std::string path = writtenBy(folder_, "scan.topostats", R"(
file["image"] = numpy.array([[1.5, 2.5, 0.5], [4.0, numpy.nan, 6.0]])
file["image_original"] = numpy.ones((2, 3))
file["pixel_to_nm_scaling"] = 2.0
file["topostats_file_version"] = 0.2
)");
  EXPECT_EQ(channelsByH5py(path, 60.0).channels.size(), 2U);
  const HeightMap surface = readScanFile(path);
  EXPECT_DOUBLE_EQ(surface.pitchX(), 2e-9);
  EXPECT_DOUBLE_EQ(surface.pitchY(), 2e-9);
  EXPECT_NEAR(surface.height(1, 2), 6e-9, 1e-20);
  EXPECT_FALSE(std::isfinite(surface.height(1, 1)));
}

TEST_F(Hdf5, ReadsNetcdf4OfSurfaceTopography) {
  const std::string path = writtenBy(folder_, "scan.nc", R"(
file["heights"] = numpy.arange(6.0).reshape(3, 2)
file["heights"].attrs["unit"] = "nm"
file["mask"] = numpy.array([[0, 0], [1, 0], [0, 0]], dtype="i1")
for axis, length in (("x", 6.0), ("y", 2.0)):
    file[axis] = numpy.arange(2.0)
    file[axis].attrs["length"] = length
    file[axis].attrs["unit"] = "um"
)");
  const HeightMap surface = readScanFile(path);
  ASSERT_EQ(surface.cols(), 3);
  EXPECT_DOUBLE_EQ(surface.pitchX(), 2e-6);
  EXPECT_DOUBLE_EQ(surface.pitchY(), 1e-6);
  EXPECT_NEAR(surface.height(1, 2), 5e-9, 1e-20);
  EXPECT_FALSE(std::isfinite(surface.height(0, 1)));
}

TEST_F(Hdf5, OtherLayoutsAndDamagedFilesHaveNoChannels) {
  EXPECT_TRUE(
      channelsByH5py(writtenBy(folder_, "other.h5", "file['force'] = numpy.ones((4, 4))\n"), 60.0)
          .channels.empty());
  const std::string several = writtenBy(folder_, "several.h5", R"(
file["first"] = numpy.ones((4, 5))
file["group/second"] = numpy.ones((3, 2), dtype="i2")
file["curve"] = numpy.ones(7)
file["cube"] = numpy.ones((2, 2, 2))
file["words"] = numpy.array([[b"a", b"b"], [b"c", b"d"]])
)");
  EXPECT_EQ(channelsByH5py(several, 60.0).arrays, "'first' (5 x 4), 'group/second' (2 x 3)");
  ScanFileOptions options;
  options.import.gwyddion_reader = "false";
  try {
    openScanFile(several, {}, options);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("its arrays are 'first' (5 x 4), 'group/second' (2 x 3); write"),
              std::string::npos)
        << error.what();
  }
  const std::string damaged = folder_.write("damaged.h5", "\x89HDF\r\n\x1a\n");
  const Hdf5Channels read = channelsByH5py(damaged, 60.0);
  EXPECT_TRUE(read.channels.empty());
  EXPECT_FALSE(read.is_library_missing);
}

/// As Gxsm4 lays it out: counts over dz, everything in angstrom.
std::string gxsmLines(const std::string& unit, double dx, const std::string& more = "") {
  return "field = file.create_dataset('FloatField', data=numpy.arange(6.0, dtype='f4').reshape(1, "
         "1, 2, 3))\n"
         "field.attrs['label'] = 'ZS-Topo'\nfield.attrs['var_unit'] = '" +
         unit + "'\nfield.attrs['unit'] = 'nm'\nfor name, value in (('dx', " + std::to_string(dx) +
         "), ('dy', 5.0), ('rangex', 20.0), ('rangey', 5.0)):\n    file[name] = value\n    "
         "file[name].attrs['var_unit'] = "
         "'Å'\n    file[name].attrs['unit'] = 'nm'\nfile['dz'] = 2.0\n" +
         more;
}

TEST_F(Hdf5, ReadsNetcdf4OfGxsm) {
  const HeightMap surface = readScanFile(writtenBy(folder_, "scan.nc", gxsmLines("Å", 10.0)));
  ASSERT_EQ(surface.cols(), 3);
  ASSERT_EQ(surface.rows(), 2);
  EXPECT_NEAR(surface.pitchX(), 1e-9, 1e-21);
  EXPECT_NEAR(surface.pitchY(), 0.5e-9, 1e-21);
  EXPECT_NEAR(surface.height(1, 2), 10e-10, 1e-22);
  std::string doubles = gxsmLines("Å", 10.0);
  doubles.replace(doubles.find("FloatField"), 10, "DoubleField");
  EXPECT_NEAR(readScanFile(writtenBy(folder_, "doubles.nc", doubles)).height(1, 2), 10e-10, 1e-22);
  for (const char* unit : {"nA", "A", "Hz"}) {
    const Hdf5Channels read =
        channelsByH5py(writtenBy(folder_, "other.nc", gxsmLines(unit, 10.0)), 60.0);
    ASSERT_EQ(read.channels.size(), 1U);
    EXPECT_EQ(read.channels[0].unit_z, unit);
  }
  try {
    readScanFile(writtenBy(folder_, "contradiction.nc", gxsmLines("Å", 11.0)));
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("contradicts rangex"), std::string::npos)
        << error.what();
  }
}

/// Each way of the format to bring numbers of another file in. The file is one that would be read.
TEST_F(Hdf5, WhatLeadsToOtherFilesIsRefused) {
  const std::string secret = folder_.write("secret", std::string(48, 's'));
  writtenBy(folder_, "other.h5", "file['image'] = numpy.ones((2, 3))\n");
  const std::string scaled = "file['pixel_to_nm_scaling'] = 2.0\n";
  const std::string image = "file['image'] = numpy.ones((2, 3))\n";
  const struct {
    const char* name;
    std::string lines;
    std::string says;
  } kWays[] = {
      {"storage.topostats",
       scaled + "file.create_dataset('image', (2, 3), 'f8', external=[('" + secret +
           "', 0, 48)])\n",
       "the numbers of '/image' stand in other files"},
      {"link.topostats", scaled + "file['image'] = h5py.ExternalLink('other.h5', '/image')\n",
       "the link 'image' leads to another file"},
      {"soft.topostats",
       scaled + "file['deep/link'] = h5py.ExternalLink('other.h5', '/')\nfile['image'] = "
                "h5py.SoftLink('/deep/link/image')\n",
       "the link 'link' leads to another file"},
      {"virtual.topostats",
       scaled +
           "layout = h5py.VirtualLayout((2, 3), 'f8')\nlayout[:] = h5py.VirtualSource('other.h5', "
           "'image', (2, 3))\n" +
           "file.create_virtual_dataset('image', layout)\n",
       "the numbers of '/image' stand in other files"},
      {"beside.topostats",
       scaled + image + "file['far/away'] = h5py.ExternalLink('other.h5', '/image')\n",
       "the link 'away' leads to another file"},
      {"unknown.h5", "file['away'] = h5py.ExternalLink('other.h5', '/image')\n",
       "the link 'away' leads"},
  };
  for (const auto& way : kWays) {
    try {
      readScanFile(writtenBy(folder_, way.name, way.lines));
      ADD_FAILURE() << way.name;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(way.name + std::string(": ") + way.says),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(
      readScanFile(
          writtenBy(
              folder_, "soft_inside.topostats",
              scaled + "file['a'] = numpy.ones((2, 3))\nfile['image'] = h5py.SoftLink('/a')\n"))
          .cols(),
      3);
}

/// A block of the user's before the signature, as MATLAB's files have it, hides nothing.
TEST_F(Hdf5, IsKnownBehindABlockOfTheUser) {
  const std::string path =
      writtenBy(folder_, "user.mat",
                "file.close()\nfile = h5py.File(sys.argv[1], 'w', userblock_size=512)\n"
                "file['image'] = numpy.ones((2, 3))\nfile['pixel_to_nm_scaling'] = 2.0\n");
  EXPECT_EQ(readScanFile(path).cols(), 3);
}

}  // namespace
}  // namespace mems_stiction
