// SPDX-License-Identifier: Apache-2.0
#pragma once
/// GET /: the page; GET /operator: the operator's view; GET /log: the log that is shown, if one is.
/// Nothing else is there.

#include <libwebsockets.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/scope/server/show.hpp"

namespace graben::scope {

/// What a connection asked for.
enum class Asked : std::uint8_t {
  kScope = 0,
  kOperators = 1,
  kLog = 2,
};

/// What of it a connection was sent; the library makes it, all zero.
struct PageProgress {
  std::uint64_t sent;
  Asked asked;
};

class PageService {
 public:
  /// `operators`: empty if there is none. `log`: null if there is none. All have to outlive this.
  PageService(std::string_view page, std::string_view operators, const LogFile* log,
              std::string listened_on)
      : page_(page), operators_(operators), log_(log), listened_on_(std::move(listened_on)) {}

  /// A whole request. For the library: 0 goes on, -1 hangs up.
  int on_request(lws* wsi, std::string_view path, PageProgress& progress);
  /// The connection takes more of the page.
  int on_writeable(lws* wsi, PageProgress& progress);

 private:
  /// What is at this path; nothing if nothing is.
  [[nodiscard]] std::optional<Asked> asked_by(std::string_view path) const;
  int begin(lws* wsi, PageProgress& progress);
  /// The next piece into the buffer, behind what the library needs; false: it can't be had.
  bool take_piece(const PageProgress& progress, std::size_t size);
  [[nodiscard]] std::uint64_t size_of(const PageProgress& progress) const {
    return progress.asked == Asked::kLog ? log_->bytes : text_of(progress).size();
  }
  [[nodiscard]] std::string_view text_of(const PageProgress& progress) const {
    return progress.asked == Asked::kOperators ? operators_ : page_;
  }

  std::string_view page_;
  std::string_view operators_;
  const LogFile* log_;
  std::string listened_on_;
  std::vector<unsigned char> buffer_;
};

}  // namespace graben::scope
