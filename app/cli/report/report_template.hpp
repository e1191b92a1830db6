#pragma once
/// The page without its data, as embed.py compiled it in: head, then the data, then tail.

#include <string_view>

namespace graben::cli {

[[nodiscard]] std::string_view report_head();
[[nodiscard]] std::string_view report_tail();

}  // namespace graben::cli
