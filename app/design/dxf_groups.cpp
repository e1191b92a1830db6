// SPDX-License-Identifier: Apache-2.0
#include "app/design/dxf_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "app/machines/plain_text.hpp"
#include "app/machines/profile_file.hpp"

namespace graben::design {
namespace {

constexpr std::string_view kBlank = " \t\r\n";
constexpr std::string_view kBinary = "AutoCAD Binary DXF";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  text.remove_suffix(text.size() - std::min(text.find_last_not_of(kBlank) + 1, text.size()));
  return text;
}

/// Takes the text's first line away and returns it.
std::string_view line_of(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

}  // namespace

bool is_dxf(std::string_view text) {
  if (text.substr(0, kBinary.size()) == kBinary) {
    return true;
  }
  std::string_view code = line_of(text);
  std::string_view value = line_of(text);
  constexpr std::string_view kComment = "999";
  while (code == kComment && !text.empty()) {
    code = line_of(text);
    value = line_of(text);
  }
  return code == "0" && value == "SECTION";
}

DxfGroups::DxfGroups(const std::filesystem::path& file) : file_(file) {
  const std::string wanted = "a design in DXF";
  if (machines::file_text(file, wanted).compare(0, kBinary.size(), kBinary) == 0) {
    throw machines::ProfileError(
        file.string(), {"is a binary DXF; allowed: DXF of text (ASCII), as CAD saves it too"});
  }
  text_ = machines::plain_text(file, wanted);
}

bool DxfGroups::take_line(std::string_view& line) {
  if (at_ >= text_.size()) {
    return false;
  }
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line = trimmed(std::string_view(text_).substr(at_, end - at_));
  at_ = end + 1;
  ++line_;
  return true;
}

bool DxfGroups::next() {
  std::string_view code;
  if (!take_line(code)) {
    return false;
  }
  const auto [stop, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
  if (error != std::errc() || stop != code.data() + code.size()) {
    // Blank lines at the very end are no group.
    if (code.empty() &&
        text_.find_first_not_of(kBlank, std::min(at_, text_.size())) == std::string::npos) {
      return false;
    }
    refuse(line_, fmt::format("'{}' as a group's code; allowed: a whole number, as DXF of text "
                              "has it on every other line",
                              code.substr(0, 30)));
  }
  if (!take_line(value_)) {
    refuse(line_, fmt::format("the file ends after the code {}, without its value", code_));
  }
  return true;
}

void DxfGroups::refuse(std::size_t line, const std::string& what) const {
  throw machines::ProfileError(file_.string(), {fmt::format("line {}: {}", line, what)});
}

}  // namespace graben::design
