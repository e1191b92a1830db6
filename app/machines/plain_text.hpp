// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one reader of text: what editors, spreadsheets and instruments put round and between it,
/// whatever the format is.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graben::machines {

/// The whole file, byte by byte. Throws std::runtime_error, with what is `wanted`, if it can't be
/// read.
[[nodiscard]] std::string file_text(const std::filesystem::path& file, const std::string& wanted);

/// The same without a byte order mark. Throws std::runtime_error also where it is no UTF-8 by its
/// begin: UTF-16, as some spreadsheets call 'Unicode'.
[[nodiscard]] std::string plain_text(const std::filesystem::path& file, const std::string& wanted);

/// Takes a byte order mark of UTF-8 away.
void drop_byte_order_mark(std::string& text);
/// By its mark, or by every other byte of its begin.
[[nodiscard]] bool is_utf16(std::string_view text);
inline constexpr const char* kUtf16 = "is UTF-16; allowed: UTF-8, as editors save it by that name";

/// Cells of a line, without blanks and quotes round them: between semicolons, else tabs, else
/// commas, else blanks. Empty ones count, but not those that end the line; none: it is empty.
[[nodiscard]] std::vector<std::string_view> cells_of(std::string_view line);

/// A finite number with a decimal point, signed or not.
[[nodiscard]] std::optional<double> number_in(std::string_view word);

/// Why such a word is no number: a decimal comma, a character that only looks like one of a number,
/// another encoding; else that it is no finite number.
[[nodiscard]] std::string not_a_number(std::string_view word);

/// The first character beyond ASCII, in words; empty: there is none.
[[nodiscard]] std::string strange_character(std::string_view text);

}  // namespace graben::machines
