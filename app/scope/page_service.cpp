#include "app/scope/page_service.hpp"

#include <algorithm>
#include <array>

#include "app/scope/request.hpp"
#include "app/scope/show.hpp"

namespace graben::scope {
namespace {

constexpr std::size_t kPieceBytes = 64 * 1024;
constexpr std::size_t kHeaderBytes = 1024;

struct Header {
  const char* name;
  std::string_view value;
};

/// The page is whole: it needs nothing but its own WebSocket, and can be made to load nothing.
constexpr std::array<Header, 5> kHeaders = {{
    {"content-security-policy:",
     "default-src 'none'; script-src 'unsafe-inline' blob:; worker-src blob:; "
     "style-src 'unsafe-inline'; connect-src 'self' ws:; img-src data: blob:; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"x-content-type-options:", "nosniff"},
    {"referrer-policy:", "no-referrer"},
    {"cross-origin-resource-policy:", "same-origin"},
    {"cache-control:", "no-store"},
}};

bool add_header(lws* wsi, const Header& header, unsigned char*& at, unsigned char* end) {
  return lws_add_http_header_by_name(wsi, reinterpret_cast<const unsigned char*>(header.name),
                                     reinterpret_cast<const unsigned char*>(header.value.data()),
                                     static_cast<int>(header.value.size()), &at, end) == 0;
}

}  // namespace

int PageService::on_request(lws* wsi, std::string_view path, PageProgress& progress) {
  if (!has_own_host(wsi, listened_on_)) {
    return answer(wsi, HTTP_STATUS_FORBIDDEN, "This server is not known by that name.");
  }
  if (lws_hdr_total_length(wsi, WSI_TOKEN_GET_URI) <= 0) {
    return answer(wsi, HTTP_STATUS_METHOD_NOT_ALLOWED, "Here is only a page to get.");
  }
  if (path == kLogPath && !log_file_.empty()) {
    return begin_log(wsi);
  }
  if (path != "/" && path != "/index.html") {
    return answer(wsi, HTTP_STATUS_NOT_FOUND, "There is only one page here: /");
  }
  return begin(wsi, progress);
}

int PageService::begin(lws* wsi, PageProgress& progress) {
  std::array<unsigned char, LWS_PRE + kHeaderBytes> header{};
  unsigned char* const start = header.data() + LWS_PRE;
  unsigned char* at = start;
  unsigned char* const end = header.data() + header.size();
  bool whole = lws_add_http_common_headers(wsi, HTTP_STATUS_OK, "text/html; charset=utf-8",
                                           page_.size(), &at, end) == 0;
  for (const Header& each : kHeaders) {
    whole = whole && add_header(wsi, each, at, end);
  }
  if (!whole || lws_finalize_write_http_header(wsi, start, &at, end) != 0) {
    return -1;
  }
  progress.sent = 0;
  lws_callback_on_writable(wsi);
  return 0;
}

int PageService::begin_log(lws* wsi) const {
  static constexpr std::string_view kAlso =
      "cache-control: no-store\r\nx-content-type-options: nosniff\r\n"
      "cross-origin-resource-policy: same-origin\r\n";
  // The library reads and sends it by itself from here on.
  const int result = lws_serve_http_file(wsi, log_file_.c_str(), "application/octet-stream",
                                         kAlso.data(), static_cast<int>(kAlso.size()));
  return result < 0 || (result > 0 && lws_http_transaction_completed(wsi) != 0) ? -1 : 0;
}

int PageService::on_writeable(lws* wsi, PageProgress& progress) {
  const std::string_view piece = page_.substr(progress.sent, kPieceBytes);
  buffer_.resize(LWS_PRE + kPieceBytes);
  std::copy(piece.begin(), piece.end(), buffer_.begin() + LWS_PRE);
  progress.sent += piece.size();
  const bool is_last = progress.sent == page_.size();
  const int wanted = static_cast<int>(piece.size());
  if (lws_write(wsi, buffer_.data() + LWS_PRE, piece.size(),
                is_last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) < wanted) {
    return -1;
  }
  if (!is_last) {
    lws_callback_on_writable(wsi);
    return 0;
  }
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

}  // namespace graben::scope
