#pragma once
/// The page of the scope and of every report: one HTML file that needs nothing beside it. Built
/// from app/scope/page.

#include <cstddef>
#include <string_view>

namespace graben::scope {

/// Until the JSON that says what is shown (`Setup` of app/scope/page/src/model/api.ts), and from
/// there on. With nothing between, it asks the server that it comes from.
[[nodiscard]] std::string_view scope_page_head();
[[nodiscard]] std::string_view scope_page_tail();

}  // namespace graben::scope
