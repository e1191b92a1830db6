// SPDX-License-Identifier: Apache-2.0
#include "app/reports/report_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/runs/figures.hpp"

namespace graben::reports {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw std::runtime_error("cannot write the report " + file.string() + ": " + why);
}

std::string system_message(int error) { return std::generic_category().message(error); }

/// The page up to the place of the setup, and from there on.
std::pair<std::string_view, std::string_view> around_setup(const fs::path& file,
                                                           std::string_view page) {
  constexpr std::string_view kMark = "<script type=\"application/json\" id=\"graben-setup\">";
  const std::size_t found = page.find(kMark);
  if (found == std::string_view::npos) fail(file, "its page has no place for what it shows");
  const std::size_t at = found + kMark.size();
  return {page.substr(0, at), page.substr(at)};
}

/// JSON for a script element. '<' occurs in strings only, and written as an escape it can neither
/// close the element nor open a comment in it.
std::string embeddable(const nlohmann::json& data) {
  // A byte that is no UTF-8, as a command line may contain, must not cost the report.
  const std::string plain = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

bool put(std::FILE* out, std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), out) == text.size();
}

/// 0, or the error number of the first step that failed.
int write_whole(const fs::path& file, std::string_view head, std::string_view body,
                std::string_view tail) {
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (out == nullptr) return errno;
  // To the disk before the rename: after a power cut the name must not stand for an empty file.
  const bool written = put(out, head) && put(out, body) && put(out, tail) &&
                       std::fflush(out) == 0 && fsync(fileno(out)) == 0;
  int error = written ? 0 : errno;
  if (std::fclose(out) != 0 && error == 0) error = errno;
  return error;
}

/// Target of a symbolic link, so that the link survives. A device or a folder is refused: the
/// rename would replace it.
fs::path resolved(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return file;
  if (error) fail(file, error.message());
  if (!fs::is_regular_file(status)) fail(file, "it is not a regular file");
  fs::path target = fs::canonical(file, error);
  if (error) fail(file, error.message());
  return target;
}

void make_plain(nlohmann::ordered_json& node) {
  if (node.is_number_float()) {
    // The Grisu2 that prints it does not find every number's shortest text; it does with less
    // digits.
    constexpr std::size_t kShort = 18;
    const auto value = node.get<double>();
    node = runs::plain_number(value);
    for (int digits = 11; digits > 8 && node.dump().size() > kShort; --digits) {
      node = runs::plain_number(value, digits);
    }
  }
  if (node.is_structured()) {
    for (nlohmann::ordered_json& below : node) {
      make_plain(below);
    }
  }
}

}  // namespace

void write_report(const fs::path& file, std::string_view page, const nlohmann::json& setup) {
  const fs::path target = resolved(file);
  fs::path partial = target;
  partial += ".part-" + std::to_string(getpid());
  std::error_code ignored;
  const auto [head, tail] = around_setup(file, page);
  if (const int error = write_whole(partial, head, embeddable(setup), tail)) {
    fs::remove(partial, ignored);
    fail(file, system_message(error));
  }
  std::error_code error;
  fs::rename(partial, target, error);
  if (error) {
    fs::remove(partial, ignored);
    fail(file, error.message());
  }
}

void write_json(const fs::path& file, const nlohmann::ordered_json& figures) {
  nlohmann::ordered_json plain = figures;
  make_plain(plain);
  std::ofstream stream(file);
  stream << plain.dump(2) << '\n';
  stream.close();
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: can't be written", file.string()));
  }
}

}  // namespace graben::reports
