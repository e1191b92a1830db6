// SPDX-License-Identifier: Apache-2.0
#include "app/identify/lines.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace graben::identify {

Lines::Lines(const std::string& path) : path_(path), file_(gzopen(path.c_str(), "rb"), gzclose) {
  if (!file_) {
    throw std::runtime_error(fmt::format(
        "{}: {}", path, errno == ENOENT ? "there is no such file" : std::strerror(errno)));
  }
  // zlib would only say that it can't read it.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw std::runtime_error(fmt::format("{}: is a folder; a file is wanted", path));
  }
}

bool Lines::next(std::string& line) {
  line.clear();
  std::array<char, 4096> part{};
  while (gzgets(file_.get(), part.data(), static_cast<int>(part.size())) != nullptr) {
    const std::string_view text(part.data());
    const bool ends = !text.empty() && text.back() == '\n';
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
  ++number_;
  is_whole_ = line.back() == '\n';
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) {
    line.pop_back();
  }
  return true;
}

std::string Lines::where() const { return fmt::format("{}:{}", path_, number_); }

}  // namespace graben::identify
