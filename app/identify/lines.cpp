// SPDX-License-Identifier: Apache-2.0
#include "app/identify/lines.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "app/machines/missing_file.hpp"
#include "app/machines/plain_text.hpp"

namespace graben::identify {

Lines::Lines(const std::string& path, const std::string& wanted)
    : path_(path), file_(gzopen(path.c_str(), "rb"), gzclose) {
  // Of a folder zlib would only say that it can't read it.
  std::error_code ignored;
  if (!file_ || std::filesystem::is_directory(path, ignored)) {
    throw std::runtime_error(machines::unread_text(path, wanted));
  }
}

bool Lines::next(std::string& line) {
  line.clear();
  std::array<char, 4096> part{};
  while (gzgets(file_.get(), part.data(), static_cast<int>(part.size())) != nullptr) {
    const std::string_view text(part.data());
    const bool ends = !text.empty() && text.back() == '\n';
    // A text of one letter has a zero behind it too.
    const bool has_more = part[0] == '\0' || part[1] != '\0' || part[2] != '\0';
    if (number_ == 0 && line.empty() && has_more && machines::is_utf16({part.data(), 2})) {
      throw std::runtime_error(fmt::format("{}: {}", path_, machines::kUtf16));
    }
    if (text.empty() || (!ends && text.size() + 1 < part.size() && gzeof(file_.get()) == 0)) {
      throw std::runtime_error(fmt::format("{}:{}: is no text", path_, number_ + 1));
    }
    line += text;
    if (ends) {
      break;
    }
  }
  int error = Z_OK;
  gzerror(file_.get(), &error);
  if (error != Z_OK) {
    throw std::runtime_error(fmt::format("{}: is cut off or damaged (gzip)", path_));
  }
  if (line.empty()) {
    return false;
  }
  if (++number_ == 1) {
    machines::drop_byte_order_mark(line);
  }
  is_whole_ = !line.empty() && line.back() == '\n';
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
    line.pop_back();
  }
  return true;
}

std::string Lines::where() const { return fmt::format("{}:{}", path_, number_); }

}  // namespace graben::identify
