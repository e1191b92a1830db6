// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The page of the scope and of every report, and the operator's view: HTML files that need nothing
/// beside them. Built from app/scope/page.

#include <string_view>

namespace graben::scope {

/// As a server gives it: without a setup, for which it asks where it came from.
[[nodiscard]] std::string_view scope_page();
/// The operator's view, which only looks: nothing in it can send.
[[nodiscard]] std::string_view operator_page();

}  // namespace graben::scope
