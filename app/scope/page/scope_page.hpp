// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The page of the scope and of every report: one HTML file that needs nothing beside it. Built
/// from app/scope/page.

#include <string_view>

namespace graben::scope {

/// As a server gives it: without a setup, for which it asks where it came from.
[[nodiscard]] std::string_view scope_page();

}  // namespace graben::scope
