// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What pages about a machine's identification share: their look, sections and lists.

#include <string>
#include <vector>

namespace graben::reports {

/// Up to where the sections begin. `title` and `from` are escaped here.
[[nodiscard]] std::string page_head(const std::string& title, const std::string& heading,
                                    const std::string& from);
inline constexpr const char* kPageEnd = "</main></body>\n</html>\n";

/// `text` and `body` are HTML.
[[nodiscard]] std::string section(const std::string& title, const std::string& text,
                                  const std::string& body);
[[nodiscard]] std::string listed(const std::vector<std::string>& items);

}  // namespace graben::reports
