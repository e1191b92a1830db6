// SPDX-License-Identifier: Apache-2.0
#pragma once
/// GET /: the page; GET /log: the log that is shown, if one is. Nothing else is there.

#include <libwebsockets.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/scope/server/show.hpp"

namespace graben::scope {

/// What of the page, or of the log, a connection was sent; the library makes it, all zero.
struct PageProgress {
  std::uint64_t sent;
  bool is_log;
};

class PageService {
 public:
  /// `log`: null if there is none. Both have to outlive this.
  PageService(std::string_view page, const LogFile* log, std::string listened_on)
      : page_(page), log_(log), listened_on_(std::move(listened_on)) {}

  /// A whole request. For the library: 0 goes on, -1 hangs up.
  int on_request(lws* wsi, std::string_view path, PageProgress& progress);
  /// The connection takes more of the page.
  int on_writeable(lws* wsi, PageProgress& progress);

 private:
  int begin(lws* wsi, PageProgress& progress);
  /// The next piece into the buffer, behind what the library needs; false: it can't be had.
  bool take_piece(const PageProgress& progress, std::size_t size);
  [[nodiscard]] std::uint64_t size_of(const PageProgress& progress) const {
    return progress.is_log ? log_->bytes : page_.size();
  }

  std::string_view page_;
  const LogFile* log_;
  std::string listened_on_;
  std::vector<unsigned char> buffer_;
};

}  // namespace graben::scope
