
#include <gtest/gtest.h>
#include <tiffio.h>

#include <cmath>
#include <functional>

#include "import/channel_choice.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

namespace mems_stiction {
namespace {

constexpr int kCols = 5;
constexpr int kRows = 4;

/// One page: how its numbers are stored, the bytes of a row, and tags of its own.
struct Page {
  int bits = 32;
  int format = SAMPLEFORMAT_IEEEFP;
  int cols = kCols, rows = kRows, samples = 1;
  std::function<std::string(int row)> line;
  std::function<void(TIFF*)> tags = [](TIFF*) {};
};

template <typename Number>
std::string numbers(int row, int cols = kCols) {
  std::string bytes;
  for (int col = 0; col < cols; ++col) {
    const auto value = static_cast<Number>(10 * row + col);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return bytes;
}

Page floatPage() {
  Page page;
  page.line = [](int row) { return numbers<float>(row); };
  return page;
}

class TiffFile : public ::testing::Test {
 protected:
  std::string write(const std::vector<Page>& pages) const {
    static TIFFExtendProc parent = nullptr;
    if (parent == nullptr) {
      parent = TIFFSetTagExtender([](TIFF* tiff) {
        static const TIFFFieldInfo kGdal[] = {
            {42112, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDAL_METADATA")},
            {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("GDAL_NODATA")}};
        TIFFMergeFieldInfo(tiff, kGdal, 2);
      });
    }
    TIFF* tiff = TIFFOpen(path().c_str(), "w");
    for (const Page& page : pages) {
      TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, page.cols);
      TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, page.rows);
      TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, page.bits);
      TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, page.samples);
      TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, page.format);
      TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                   page.samples == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
      page.tags(tiff);
      for (int row = 0; row < page.rows; ++row) {
        std::string line = page.line(row);
        TIFFWriteScanline(tiff, line.data(), static_cast<std::uint32_t>(row));
      }
      TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
    return ScratchFolder::read(path());
  }
  std::string path() const { return folder_.file("scan.tiff"); }

  std::vector<FileChannel> parsed(const Page& page) const { return parseTiff(write({page})); }

  static void expectNumbers(const cv::Mat& values, double scale = 1.0, double offset = 0.0) {
    cv::Mat wide;
    values.convertTo(wide, CV_64F);
    ASSERT_EQ(wide.size(), cv::Size(kCols, kRows));
    for (int row = 0; row < kRows; ++row) {
      for (int col = 0; col < kCols; ++col) {
        EXPECT_DOUBLE_EQ(wide.at<double>(row, col), (10 * row + col) * scale + offset)
            << row << ", " << col;
      }
    }
  }

  ScratchFolder folder_;
};

TEST_F(TiffFile, IntegersAndFloatsOfEverySizeAreReadAsTheyStand) {
  struct Kind {
    int bits, format;
    std::function<std::string(int)> line;
  };
  const auto half = [](int row) {
    std::string bytes;
    for (int col = 0; col < kCols; ++col) {
      // Whole numbers to 2047 are exact: 1.f x 2^e with the exponent biased by 15.
      const int value = 10 * row + col;
      int exponent = 0;
      while (value >> (exponent + 1) != 0) ++exponent;
      const int code = value == 0 ? 0 : (exponent + 15) << 10 | (value << (10 - exponent) & 1023);
      bytes += static_cast<char>(code & 0xFF);
      bytes += static_cast<char>(code >> 8);
    }
    return bytes;
  };
  for (const Kind& kind : std::vector<Kind>{
           {8, SAMPLEFORMAT_UINT, [](int row) { return numbers<std::uint8_t>(row); }},
           {8, SAMPLEFORMAT_INT, [](int row) { return numbers<std::int8_t>(row); }},
           {16, SAMPLEFORMAT_UINT, [](int row) { return numbers<std::uint16_t>(row); }},
           {16, SAMPLEFORMAT_INT, [](int row) { return numbers<std::int16_t>(row); }},
           {32, SAMPLEFORMAT_UINT, [](int row) { return numbers<std::uint32_t>(row); }},
           {32, SAMPLEFORMAT_INT, [](int row) { return numbers<std::int32_t>(row); }},
           {16, SAMPLEFORMAT_IEEEFP, half},
           {32, SAMPLEFORMAT_IEEEFP, [](int row) { return numbers<float>(row); }},
           {64, SAMPLEFORMAT_IEEEFP, [](int row) { return numbers<double>(row); }}}) {
    SCOPED_TRACE(std::to_string(kind.bits) + " bits of format " + std::to_string(kind.format));
    Page page;
    page.bits = kind.bits;
    page.format = kind.format;
    page.line = kind.line;
    const auto channels = parsed(page);
    ASSERT_EQ(channels.size(), 1u);
    expectNumbers(channels[0].values);
  }
}

TEST_F(TiffFile, LargeIntegersKeepTheirLastBit) {
  Page page = floatPage();
  page.format = SAMPLEFORMAT_UINT;
  page.line = [](int row) {
    std::string bytes;
    for (std::uint32_t col = 0; col < kCols; ++col) {
      const std::uint32_t value = 0xFFFFFF00u + 10u * static_cast<std::uint32_t>(row) + col;
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    return bytes;
  };
  expectNumbers(parsed(page)[0].values, 1.0, 4294967040.0);
}

TEST_F(TiffFile, CountsOfTwelveBitsAndOfOneAreNotScaled) {
  Page twelve;
  twelve.bits = 12;
  twelve.format = SAMPLEFORMAT_UINT;
  twelve.line = [](int row) {
    std::string bytes(8, '\0');
    for (int col = 0; col < kCols; ++col) {
      const int value = 10 * row + col;
      for (int bit = 0; bit < 12; ++bit) {
        if ((value >> (11 - bit) & 1) != 0)
          bytes[static_cast<std::size_t>((12 * col + bit) / 8)] |=
              static_cast<char>(0x80 >> (12 * col + bit) % 8);
      }
    }
    return bytes;
  };
  expectNumbers(parsed(twelve)[0].values);
  Page one;
  one.bits = 1;
  one.format = SAMPLEFORMAT_UINT;
  one.line = [](int row) { return std::string(1, static_cast<char>(row == 2 ? 0xA8 : 0x00)); };
  const cv::Mat bits = parsed(one)[0].values;
  EXPECT_EQ(bits.at<std::uint8_t>(2, 0), 1);
  EXPECT_EQ(bits.at<std::uint8_t>(2, 1), 0);
  EXPECT_EQ(bits.at<std::uint8_t>(0, 0), 0);
}

TEST_F(TiffFile, ThumbnailsAreLeftOutWhereverTheyStand) {
  Page thumbnail = floatPage();
  thumbnail.cols = thumbnail.rows = 2;
  thumbnail.line = [](int row) { return numbers<float>(row, 2); };
  thumbnail.tags = [](TIFF* tiff) {
    TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE);
  };
  for (const auto& pages :
       {std::vector<Page>{thumbnail, floatPage()}, std::vector<Page>{floatPage(), thumbnail}}) {
    const auto channels = parseTiff(write(pages));
    ASSERT_EQ(channels.size(), 1u);
    expectNumbers(channels[0].values);
  }
}

TEST_F(TiffFile, ThePageThatIsNoPictureIsTaken) {
  Page picture = floatPage();
  picture.bits = 8;
  picture.format = SAMPLEFORMAT_UINT;
  picture.samples = 3;
  picture.line = [](int) { return std::string(3 * kCols, 'x'); };
  const auto channels = parseTiff(write({picture, floatPage()}));
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(chooseHeightChannel(channels), 1u);
}

TEST_F(TiffFile, SeveralPagesAreNamedAndNoneIsTakenUnasked) {
  Page second = floatPage();
  second.tags = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_PAGENAME, "error signal"); };
  Page third = floatPage();
  const auto channels = parseTiff(write({floatPage(), second, third}));
  ASSERT_EQ(channels.size(), 3u);
  EXPECT_EQ(channels[1].title, "error signal");
  try {
    chooseHeightChannel(channels);
    FAIL() << "one of two pages was taken";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("0: (no title) [5 x 4], 1: error signal [5 x 4], 2:"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(chooseHeightChannel(channels, "2"), 2u);
}

TEST_F(TiffFile, PagesThatAreNamedHeightAreTaken) {
  Page phase = floatPage();
  phase.tags = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, "Amplitude"); };
  Page height = floatPage();
  height.tags = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, "Height"); };
  EXPECT_EQ(chooseHeightChannel(parseTiff(write({phase, height}))), 1u);
}

TEST_F(TiffFile, TheMissingValueOfGdalIsMissing) {
  Page page = floatPage();
  page.tags = [](TIFF* tiff) { TIFFSetField(tiff, 42113, "12"); };
  const cv::Mat values = parsed(page)[0].values;
  EXPECT_TRUE(std::isnan(values.at<double>(1, 2)));
  EXPECT_EQ(values.at<double>(1, 3), 13.0);
}

TEST_F(TiffFile, TheScaleOfGdalIsApplied) {
  Page page = floatPage();
  page.tags = [](TIFF* tiff) {
    TIFFSetField(tiff, 42112,
                 "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item>"
                 "<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">3</Item></GDALMetadata>");
  };
  const auto channels = parsed(page);
  expectNumbers(channels[0].values, 0.5, 3.0);
  EXPECT_EQ(channels[0].notes.size(), 1u);
}

TEST_F(TiffFile, TheScaleOfImageJIsThePitch) {
  Page page = floatPage();
  page.tags = [](TIFF* tiff) {
    TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, "ImageJ=1.53t\nunit=micron\nmin=0\n");
    TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
    TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 50.0);  // pixels per micron
    TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 25.0);
  };
  write({page});
  const HeightMap surface = readScanFile(path());
  EXPECT_NEAR(surface.pitchX(), 20e-9, 1e-15);  // the resolution is a float32 ratio
  EXPECT_NEAR(surface.pitchY(), 40e-9, 1e-15);
}

TEST_F(TiffFile, YOfImageJMayHaveAnotherUnit) {
  const auto pitched = [this](const char* yunit) {
    Page page = floatPage();
    page.tags = [yunit](TIFF* tiff) {
      TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION,
                   (std::string("ImageJ=1.53t\nunit=um\nyunit=") + yunit + "\n").c_str());
      TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 50.0F);
      TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 0.05F);
    };
    return parsed(page)[0];
  };
  const FileChannel both = pitched("nm");
  EXPECT_NEAR(both.width / both.values.cols, 2e-8, 1e-14);
  EXPECT_NEAR(both.height / both.values.rows, 2e-8, 1e-14);
  EXPECT_EQ(pitched("sec").width, 0.0);
}

TEST_F(TiffFile, AStackThatImageJHidesBehindThePageIsRefused) {
  Page page = floatPage();
  page.tags = [](TIFF* tiff) {
    TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, "ImageJ=1.53t\nimages=7\nslices=7\n");
  };
  EXPECT_THROW(parsed(page), FileError);
}

TEST_F(TiffFile, TheScaleOfOmeIsThePitch) {
  Page page = floatPage();
  page.tags = [](TIFF* tiff) {
    TIFFSetField(
        tiff, TIFFTAG_IMAGEDESCRIPTION,
        "<?xml version=\"1.0\"?><OME><Image><Pixels PhysicalSizeX=\"20\" PhysicalSizeXUnit=\"nm\" "
        "PhysicalSizeY=\"0.04\" SizeX=\"5\"/></Image></OME>");
  };
  write({page});
  EXPECT_DOUBLE_EQ(readScanFile(path()).pitchX(), 20e-9);
  EXPECT_DOUBLE_EQ(readScanFile(path()).pitchY(), 40e-9) << "OME's own unit is the micrometre";
}

TEST_F(TiffFile, AResolutionIsThePitchUnlessItIsAPrinters) {
  const auto with = [](double x, double y, int unit) {
    Page page = floatPage();
    page.tags = [=](TIFF* tiff) {
      TIFFSetField(tiff, TIFFTAG_RESOLUTIONUNIT, unit);
      TIFFSetField(tiff, TIFFTAG_XRESOLUTION, x);
      TIFFSetField(tiff, TIFFTAG_YRESOLUTION, y);
    };
    return page;
  };
  write({with(500000.0, 250000.0, RESUNIT_CENTIMETER)});
  EXPECT_NEAR(readScanFile(path()).pitchX(), 20e-9, 1e-15);
  EXPECT_NEAR(readScanFile(path()).pitchY(), 40e-9, 1e-15);
  ScanOptions configured;
  configured.pitch_x = configured.pitch_y = 5e-9;
  EXPECT_EQ(readScanFile(path(), configured).pitchX(), 5e-9) << "programs fill this field unasked";
  for (const Page& page :
       {with(72.0, 72.0, RESUNIT_INCH), with(300.0, 300.0, RESUNIT_INCH),
        with(1.0, 1.0, RESUNIT_NONE), with(118.11, 118.11, RESUNIT_CENTIMETER)}) {
    write({page});
    EXPECT_THROW(readScanFile(path()), FileError);
  }
}

TEST_F(TiffFile, RowsStandUprightWhateverTheirOrderInTheFile) {
  Page page = floatPage();
  page.line = [](int row) { return numbers<float>(kRows - 1 - row); };
  page.tags = [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_ORIENTATION, ORIENTATION_BOTLEFT); };
  expectNumbers(parsed(page)[0].values);
}

TEST_F(TiffFile, CompressedPagesAreRead) {
  for (const int compression : {COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS}) {
    Page page = floatPage();
    page.tags = [=](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression); };
    expectNumbers(parsed(page)[0].values);
  }
}

/// Where the directory of the first page begins.
std::size_t directoryAt(const std::string& bytes) {
  return static_cast<std::size_t>(static_cast<unsigned char>(bytes[4]) |
                                  static_cast<unsigned char>(bytes[5]) << 8 |
                                  static_cast<unsigned char>(bytes[6]) << 16);
}

TEST_F(TiffFile, ASizeThatDoesNotMatchItsBytesIsRefused) {
  std::string bytes = write({floatPage()});
  ASSERT_EQ(parseTiff(bytes).size(), 1u);
  ASSERT_EQ(bytes[directoryAt(bytes) + 2 + 8], kCols);
  bytes[directoryAt(bytes) + 2 + 8] = kCols / 2;
  EXPECT_THROW(parseTiff(bytes), FileError);
}

/// Where the number @p index of a tag's list stands, of type LONG, or SHORT.
std::size_t listAt(const std::string& bytes, int tag, std::size_t index, std::size_t& size) {
  const auto number = [&bytes](std::size_t at, int count) {
    std::size_t value = 0;
    for (int i = count; i-- > 0;)
      value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    return value;
  };
  std::size_t entry = directoryAt(bytes) + 2;
  while (number(entry, 2) != static_cast<std::size_t>(tag)) entry += 12;
  size = number(entry + 2, 2) == TIFF_SHORT ? 2 : 4;
  const std::size_t list = number(entry + 4, 4) * size <= 4 ? entry + 8 : number(entry + 8, 4);
  return list + index * size;
}

std::uint32_t numberOf(const std::string& bytes, int tag, std::size_t index) {
  std::size_t size = 0;
  const std::size_t at = listAt(bytes, tag, index, size);
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string withNumber(std::string bytes, int tag, std::size_t index, std::uint32_t value) {
  std::size_t size = 0;
  const std::size_t at = listAt(bytes, tag, index, size);
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(value >> 8 * i & 0xFF);
  return bytes;
}

TEST_F(TiffFile, CompressedStripsThatAreAlikeMayShareTheirBytes) {
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE}) {
    Page page = floatPage();
    page.tags = [=](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression); };
    std::string bytes = write({page});
    const auto sameAsFirst = [&](int tag) {
      return withNumber(bytes, tag, 1, numberOf(bytes, tag, 0));
    };
    bytes = sameAsFirst(TIFFTAG_STRIPOFFSETS);
    EXPECT_THROW(parseTiff(bytes), FileError);  // as many bytes as the second strip had
    bytes = sameAsFirst(TIFFTAG_STRIPBYTECOUNTS);
    if (compression == COMPRESSION_NONE) {
      EXPECT_THROW(parseTiff(bytes), FileError);
    } else {
      EXPECT_EQ(parseTiff(bytes).size(), 1u);
    }
  }
}

TEST_F(TiffFile, AStripThatWasNotWrittenIsRefused) {
  const auto fault = [](const std::string& bytes) -> std::string {
    try {
      parseTiff(bytes);
      return "taken";
    } catch (const FileError& error) {
      return error.what();
    }
  };
  for (const int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE}) {
    Page page = floatPage();
    page.tags = [=](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_COMPRESSION, compression); };
    const std::string whole = write({page});
    ASSERT_EQ(fault(whole), "taken");
    EXPECT_EQ(fault(withNumber(whole, TIFFTAG_STRIPBYTECOUNTS, 1, 0)).find("strip 2 of 2 is not"),
              0u);
    EXPECT_EQ(fault(withNumber(whole, TIFFTAG_STRIPOFFSETS, 0, 0)).find("strip 1 of 2 is not"), 0u);
    EXPECT_EQ(fault(withNumber(whole, TIFFTAG_STRIPOFFSETS, 1, 8)).find("strip 2 of 2 overlaps"),
              0u);
  }
  const std::string whole = write({floatPage()});
  EXPECT_EQ(fault(withNumber(whole, TIFFTAG_STRIPOFFSETS, 1, 12)).find("strip 2 of 2 overlaps"),
            0u);
  EXPECT_EQ(fault(withNumber(whole, TIFFTAG_STRIPBYTECOUNTS, 1, 36)),
            "strip 2 of 2 is cut off: the file states 36 bytes for it, must be 40");
}

TEST_F(TiffFile, ATileThatWasNotWrittenIsRefused) {
  TIFF* tiff = TIFFOpen(path().c_str(), "w");
  for (const auto& [tag, value] : std::vector<std::pair<int, int>>{{TIFFTAG_IMAGEWIDTH, 32},
                                                                   {TIFFTAG_IMAGELENGTH, 16},
                                                                   {TIFFTAG_BITSPERSAMPLE, 8},
                                                                   {TIFFTAG_SAMPLESPERPIXEL, 1},
                                                                   {TIFFTAG_PHOTOMETRIC, 1},
                                                                   {TIFFTAG_TILEWIDTH, 16},
                                                                   {TIFFTAG_TILELENGTH, 16}})
    TIFFSetField(tiff, static_cast<std::uint32_t>(tag), value);
  std::string tile(256, 'x');
  for (const std::uint32_t number : {0u, 1u}) TIFFWriteEncodedTile(tiff, number, tile.data(), 256);
  TIFFClose(tiff);
  const std::string whole = ScratchFolder::read(path());
  ASSERT_EQ(parseTiff(whole).size(), 1u);
  const std::string sparse = withNumber(whole, TIFFTAG_TILEOFFSETS, 1, 0);
  try {
    parseTiff(sparse);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()),
              "tile 2 of 2 is not in the file: the file states offset 0 and 256 bytes for it");
  }
}

TEST_F(TiffFile, APageThatCannotBeFoundIsNotLeftOut) {
  std::string bytes = write({floatPage(), floatPage()});
  ASSERT_EQ(parseTiff(bytes).size(), 2u);
  const std::size_t entries = static_cast<unsigned char>(bytes[directoryAt(bytes)]);
  bytes[directoryAt(bytes) + 2 + 12 * entries + 2] = '\x7F';  // of the second page's place
  EXPECT_THROW(parseTiff(bytes), FileError);
}

TEST_F(TiffFile, TooManyPixelsAreRefusedBeforeMemoryIsTaken) {
  std::string bytes = write({floatPage()});
  // Width and length are the first two entries of the directory, both of type LONG or SHORT.
  const std::size_t at = directoryAt(bytes);
  for (const std::size_t entry : {std::size_t{0}, std::size_t{1}}) {
    const std::size_t start = at + 2 + 12 * entry;
    bytes.replace(start + 2, 2, std::string("\4\0", 2));          // LONG
    bytes.replace(start + 8, 4, std::string("\x30\x75\0\0", 4));  // 30000
  }
  try {
    parseTiff(bytes);
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("30000 x 30000 pixels are more than"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace mems_stiction
