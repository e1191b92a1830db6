#include "platform/linux/error_text.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace graben {

void ErrorText::set(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  static_cast<void>(std::vsnprintf(text_.data(), text_.size(), format, arguments));
  va_end(arguments);
}

const char* error_words(int error_number) {
  const char* const words = strerrordesc_np(error_number);
  return words == nullptr ? "unknown error" : words;
}

}  // namespace graben
