// SPDX-License-Identifier: Apache-2.0
#include "app/cli/output_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace graben::cli {
namespace {

namespace fs = std::filesystem;

/// Where writing to the name ends, through links too whose ends are not there yet.
fs::path written_place(const fs::path& file) {
  constexpr int kMostLinks = 40;  // As Linux follows.
  const fs::path absolute = fs::absolute(file);
  std::vector<fs::path> left(absolute.begin(), absolute.end());
  std::reverse(left.begin(), left.end());
  fs::path place;
  std::error_code error;
  for (int links = 0; !left.empty();) {
    const fs::path part = left.back();
    left.pop_back();
    const fs::path next = part == ".." ? place.parent_path() : place / part;
    if (part == ".." || !fs::is_symlink(next, error) || ++links > kMostLinks) {
      place = part == "." || part.empty() ? place : next;
      continue;
    }
    const fs::path target = fs::read_symlink(next, error);
    std::vector<fs::path> parts(target.begin(), target.end());
    left.insert(left.end(), parts.rbegin(), parts.rend());
    place = target.is_absolute() ? fs::path() : place;
  }
  return place;
}

bool is_same_file(const std::string& one, const std::string& other) {
  std::error_code error;
  return !one.empty() && !other.empty() &&
         (fs::equivalent(one, other, error) || written_place(one) == written_place(other));
}

/// Written beside the file, and renamed once it is whole.
fs::path partial_file(const fs::path& file) {
  fs::path partial = file;
  partial += fmt::format(".part-{}", getpid());
  return partial;
}

[[noreturn]] void refuse(const fs::path& file) {
  throw std::runtime_error(fmt::format("{}: can't be written", file.string()));
}

}  // namespace

void make_folder_of(const fs::path& file) {
  std::error_code error;
  if (!file.empty()) {
    fs::create_directories(fs::absolute(file).parent_path(), error);
  }
  if (error) {
    refuse(file);
  }
}

void assert_writable(const fs::path& file) {
  make_folder_of(file);
  std::error_code error;
  if (fs::is_directory(file, error) ||
      (fs::exists(file, error) && access(file.c_str(), W_OK) != 0)) {
    refuse(file);
  }
  // Permissions don't tell: a file system may be read-only, or take no files.
  const fs::path partial = partial_file(file);
  const bool opened = std::ofstream(partial, std::ios::binary).is_open();
  fs::remove(partial, error);
  if (!opened) {
    refuse(file);
  }
}

void assert_apart(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  std::vector<std::string> others = inputs;
  for (const std::string& file : outputs) {
    for (const std::string& other : others) {
      if (is_same_file(file, other)) {
        throw std::runtime_error(
            fmt::format("{}: would overwrite {}; name another file", file, other));
      }
    }
    others.push_back(file);
  }
}

void write_whole(const fs::path& file, std::string_view text) {
  const fs::path partial = partial_file(file);
  std::ofstream stream(partial, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  std::error_code error;
  if (stream) {
    fs::rename(partial, file, error);
  }
  if (!stream || error) {
    fs::remove(partial, error);
    refuse(file);
  }
}

}  // namespace graben::cli
