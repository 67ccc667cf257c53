#include "errors/plain_format.hpp"

#include <locale.h>
#include <stdlib.h>

#include <cstdarg>
#include <cstdio>

namespace mems_stiction {
namespace {

locale_t pointLocale() {
  static const locale_t kLocale = newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
  return kLocale;
}

}  // namespace

std::string plainFormat(const char* format, ...) {
  const locale_t before = uselocale(pointLocale());  // of this thread alone
  char buffer[128] = "";                             // enough for most
  std::va_list values;
  va_start(values, format);
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(buffer, sizeof buffer, format, values);
  std::string text(length < static_cast<int>(sizeof buffer) ? buffer : "");
  if (length >= static_cast<int>(sizeof buffer)) {
    text.resize(static_cast<std::size_t>(length));
    std::vsnprintf(text.data(), text.size() + 1, format, again);
  }
  va_end(again);
  va_end(values);
  uselocale(before);
  return text;
}

double plainStrtod(const char* text, char** end) { return strtod_l(text, end, pointLocale()); }

bool isLostInReading(const std::string& text, double value) {
  return value == 0.0 &&
         text.substr(0, text.find_first_of("eE")).find_first_of("123456789") != std::string::npos;
}

}  // namespace mems_stiction
