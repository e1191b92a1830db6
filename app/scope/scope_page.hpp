#pragma once
/// The page, whole: one HTML file with everything inline, embedded when the tool is built.

#include <string_view>

namespace graben::scope {

[[nodiscard]] std::string_view scope_page();

}  // namespace graben::scope
