#pragma once
/// What went wrong, in words, without the heap: a port is opened again while the machine is armed.

#include <array>

namespace graben {

/// A short text; empty when nothing went wrong. One that is too long is cut.
class ErrorText {
 public:
  ErrorText() = default;

  [[nodiscard]] bool empty() const { return text_[0] == '\0'; }
  [[nodiscard]] const char* c_str() const { return text_.data(); }

  /// As printf.
  void set(const char* format, ...) __attribute__((format(printf, 2, 3)));
  void clear() { text_[0] = '\0'; }

 private:
  std::array<char, 240> text_{};
};

/// The C library's words for an errno, always in English and never from the heap.
[[nodiscard]] const char* error_words(int error_number);

}  // namespace graben
