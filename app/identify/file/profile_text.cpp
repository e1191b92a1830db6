// SPDX-License-Identifier: Apache-2.0
#include "app/identify/file/profile_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "app/machines/profile_document.hpp"

namespace graben::identify {
namespace {

/// By it a comment of an earlier identification is known.
constexpr std::string_view kMark = "# identified: ";
/// Longer ones are not repeated in a comment.
constexpr std::size_t kShown = 60;

toml::table parsed(const std::string& text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(machines::syntax_words(text, error));
  }
}

bool begins_code_point(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

/// A key as it has to be written.
std::string written_key(const std::string& key) {
  const bool bare = !key.empty() && key.find_first_not_of(
                                        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                        "0123456789_-") == std::string::npos;
  return bare ? key : toml_quoted(key);
}

std::string_view line_of(std::string_view text, std::size_t begin) {
  return text.substr(begin, text.find('\n', begin) - begin);
}

std::string_view indent_of(std::string_view line) {
  return line.substr(0, std::min(line.find_first_not_of(" \t"), line.size()));
}

}  // namespace

std::string toml_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

ProfileText::ProfileText(std::string text) : text_(std::move(text)), root_(parsed(text_)) {
  lines_.push_back(0);
  for (std::size_t at = 0; at < text_.size(); ++at) {
    if (text_[at] == '\n') {
      lines_.push_back(at + 1);
    }
  }
}

std::size_t ProfileText::offset(const toml::source_position& position) const {
  std::size_t at = line_begin(position.line);
  // Columns count code points, from 1.
  for (std::uint32_t column = 1; column < position.column && at < text_.size(); ++column) {
    ++at;
    while (at < text_.size() && !begins_code_point(text_[at])) {
      ++at;
    }
  }
  return at;
}

void ProfileText::put_comment(std::size_t line, const std::string& comment) {
  if (comment.empty()) {
    return;
  }
  const std::size_t at = line_begin(line);
  const std::string_view text(text_);
  const std::string indent(indent_of(line_of(text, at)));
  std::size_t from = at;
  if (line > 1) {
    const std::string_view above = line_of(text, line_begin(line - 1));
    if (above.substr(indent_of(above).size(), kMark.size()) == kMark) {
      from = line_begin(line - 1);
    }
  }
  // Two values of one line have one comment above the other.
  edits_.push_back({from, at - from, fmt::format("{}{}{}\n", indent, kMark, comment)});
}

void ProfileText::replace(const std::string& key, const toml::node& node, const std::string& value,
                          const std::string& comment) {
  const std::size_t begin = offset(node.source().begin);
  const std::size_t end = offset(node.source().end);
  const std::string before = text_.substr(begin, end - begin);
  bool found = end > begin;
  try {
    found = found && toml::parse("x = " + before).size() == 1;
  } catch (const toml::parse_error&) {
    found = false;
  }
  if (!found) {
    throw std::runtime_error(
        fmt::format("{}: cannot be replaced in its line {}", key, node.source().begin.line));
  }
  const bool shown = before.size() <= kShown && before.find('\n') == std::string::npos;
  put_comment(node.source().begin.line,
              comment.empty() || !shown ? comment : fmt::format("{} before; {}", before, comment));
  edits_.push_back({begin, end - begin, value});
}

void ProfileText::add(const std::string& section, const toml::table& table, const std::string& key,
                      const std::string& value, const std::string& comment) {
  const std::string line = fmt::format("{} = {}", written_key(key), value);
  const std::string above = comment.empty() ? "" : fmt::format("{}{}\n", kMark, comment);
  const std::size_t begin = offset(table.source().begin);
  if (table.is_inline()) {
    const std::size_t end = offset(table.source().end) - 1;
    edits_.push_back({end, 0, fmt::format("{}{} ", table.empty() ? " " : ", ", line)});
    return;
  }
  if (begin < text_.size() && text_[begin] == '[') {
    const std::size_t next = text_.find('\n', begin);
    const bool last = next == std::string::npos;
    edits_.push_back({last ? text_.size() : next + 1, 0,
                      fmt::format("{}{}{}\n", last ? "\n" : "", above, line)});
    return;
  }
  // Made by dotted keys: beside one of them, by the same path.
  if (table.empty()) {
    throw std::runtime_error(fmt::format("{}: has no place in the text", section));
  }
  const std::size_t at = line_begin(table.begin()->second.source().begin.line);
  const std::string_view sister = line_of(text_, at);
  const std::size_t dot = sister.substr(0, sister.find('=')).rfind('.');
  if (dot == std::string_view::npos) {
    throw std::runtime_error(fmt::format("{}: has no place in the text", section));
  }
  edits_.push_back({at, 0, fmt::format("{}{}{}\n", above, sister.substr(0, dot + 1), line)});
}

void ProfileText::add_section(const std::string& section, const std::string& lines) {
  const auto there = std::find_if(sections_.begin(), sections_.end(),
                                  [&](const NewSection& of) { return of.name == section; });
  if (there != sections_.end()) {
    there->lines += lines;
  } else {
    sections_.push_back({section, lines});
  }
}

void ProfileText::set(const std::string& section, const std::string& key, const std::string& value,
                      const std::string& comment) {
  const auto view = root_.at_path(section);
  const toml::table* table = view.as_table();
  if (table == nullptr && section.find('[') != std::string::npos) {
    throw std::runtime_error(fmt::format(
        "{}.{}: has no place in this profile's text, which is like another; give it all "
        "tables [[{}]] of its own",
        section, key, section.substr(0, section.find('['))));
  }
  if (table == nullptr) {
    const std::string above = comment.empty() ? "" : fmt::format("{}{}\n", kMark, comment);
    add_section(section, fmt::format("{}{} = {}\n", above, written_key(key), value));
  } else if (const toml::node* node = table->get(key)) {
    replace(fmt::format("{}.{}", section, key), *node, value, comment);
  } else {
    add(section, *table, key, value, comment);
  }
}

std::string ProfileText::text() const {
  std::vector<Edit> edits = edits_;
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.at < b.at; });
  std::string text;
  std::size_t from = 0;
  for (const Edit& edit : edits) {
    if (edit.at > from) {
      text += text_.substr(from, edit.at - from);
    }
    text += edit.text;
    from = std::max(from, edit.at + edit.length);
  }
  text += text_.substr(std::min(from, text_.size()));
  if (!sections_.empty() && !text.empty() && text.back() != '\n') {
    text += '\n';
  }
  for (const NewSection& section : sections_) {
    text += fmt::format("\n[{}]\n{}", section.name, section.lines);
  }
  return text;
}

}  // namespace graben::identify
