#include "errors/plain_format.hpp"

#include <clocale>
#include <cstdlib>
#include <limits>
#include <locale>

#include <gtest/gtest.h>

#include "errors/short_number.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "support/program_run.hpp"

namespace mems_stiction {
namespace {

/// The process in a locale that writes 1.234,5, of C and of C++.
class PlainFormat : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string name = "de_DE.UTF-8";
    const Outcome made = runProgram(folder_, "localedef -i de_DE -f UTF-8 " + folder_.file(name));
    ASSERT_EQ(made.status, 0) << "of the package locales";
    setenv("LOCPATH", folder_.file("").c_str(), 1);
    ASSERT_NE(std::setlocale(LC_ALL, name.c_str()), nullptr);
    std::locale::global(std::locale(name));
    ASSERT_STREQ(std::localeconv()->decimal_point, ",");
  }
  void TearDown() override {
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
  }

 private:
  ScratchFolder folder_;
};

TEST_F(PlainFormat, NumbersHaveADecimalPointInALocaleWithAComma) {
  EXPECT_EQ(plainFormat("%s: %.3g nm, %d", "gap", 0.25, 12345), "gap: 0.25 nm, 12345");
  EXPECT_EQ(plainFormat("%s", ""), "");
  EXPECT_EQ(plainFormat("%s", std::string(1000, 'x').c_str()), std::string(1000, 'x'));
  EXPECT_EQ(shortNumber(0.029941), "0.0299");
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(6.5e-20), "6.5e-20");
  PlainStream stream;
  stream << 1234567 << ' ' << 0.5;
  EXPECT_EQ(stream.str(), "1234567 0.5");
  EXPECT_STREQ(std::localeconv()->decimal_point, ",") << "it is the caller's";
}

TEST_F(PlainFormat, NumbersAreReadWithADecimalPointInALocaleWithAComma) {
  const std::string text = "12.5 nm";
  char* end = nullptr;
  EXPECT_EQ(plainStrtod(text.c_str(), &end), 12.5);
  EXPECT_STREQ(end, " nm");
  EXPECT_EQ(plainStrtod("0,5"), 0.0);
  for (const double value : {0.1, 1.0 / 3.0, std::numeric_limits<double>::max(), 5e-324}) {
    EXPECT_EQ(plainStrtod(numberText(value).c_str()), value);
  }
}

}  // namespace
}  // namespace mems_stiction
