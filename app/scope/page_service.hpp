#pragma once
/// GET /: the page; GET /log: the log that is shown, if one is. Nothing else is there.

#include <libwebsockets.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace graben::scope {

/// What of the page a connection was sent; the library makes it, all zero.
struct PageProgress {
  std::size_t sent;
};

class PageService {
 public:
  /// `log_file`: empty if there is none.
  PageService(std::string_view page, std::string log_file, std::string listened_on)
      : page_(page), log_file_(std::move(log_file)), listened_on_(std::move(listened_on)) {}

  /// A whole request. For the library: 0 goes on, -1 hangs up.
  int on_request(lws* wsi, std::string_view path, PageProgress& progress);
  /// The connection takes more of the page.
  int on_writeable(lws* wsi, PageProgress& progress);

 private:
  int begin(lws* wsi, PageProgress& progress);
  int begin_log(lws* wsi) const;

  std::string_view page_;
  std::string log_file_;
  std::string listened_on_;
  std::vector<unsigned char> buffer_;
};

}  // namespace graben::scope
