// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/page_service.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "app/scope/server/request.hpp"

namespace graben::scope {
namespace {

constexpr std::size_t kPieceBytes = 256 * 1024;
constexpr int kPatience_s = 120;
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
  progress.is_log = path == kLogPath && log_ != nullptr;
  if (progress.is_log && has_foreign_origin(wsi)) {
    return answer(wsi, HTTP_STATUS_FORBIDDEN, "A page from elsewhere gets nothing here.");
  }
  if (!progress.is_log && path != "/" && path != "/index.html") {
    return answer(wsi, HTTP_STATUS_NOT_FOUND, "There is only one page here: /");
  }
  return begin(wsi, progress);
}

int PageService::begin(lws* wsi, PageProgress& progress) {
  std::array<unsigned char, LWS_PRE + kHeaderBytes> header{};
  unsigned char* const start = header.data() + LWS_PRE;
  unsigned char* at = start;
  unsigned char* const end = header.data() + header.size();
  const char* type = progress.is_log ? "application/octet-stream" : "text/html; charset=utf-8";
  bool whole =
      lws_add_http_common_headers(wsi, HTTP_STATUS_OK, type, size_of(progress), &at, end) == 0;
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

bool PageService::take_piece(const PageProgress& progress, std::size_t size) {
  buffer_.resize(LWS_PRE + kPieceBytes);
  unsigned char* const to = buffer_.data() + LWS_PRE;
  if (!progress.is_log) {
    const std::string_view piece = page_.substr(progress.sent, size);
    std::copy(piece.begin(), piece.end(), to);
    return true;
  }
  std::size_t got = 0;
  while (got < size) {
    const ssize_t count =
        pread(log_->file, to + got, size - got, static_cast<off_t>(progress.sent + got));
    if (count == 0 || (count < 0 && errno != EINTR)) {
      // Shorter than it was: what was promised can't be kept.
      return false;
    }
    got += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  return true;
}

int PageService::on_writeable(lws* wsi, PageProgress& progress) {
  const std::uint64_t left = size_of(progress) - progress.sent;
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, kPieceBytes));
  if (!take_piece(progress, size)) {
    return -1;
  }
  // A reader may pause; one that is gone must not be kept for ever.
  lws_set_timeout(wsi, PENDING_TIMEOUT_HTTP_CONTENT, kPatience_s);
  progress.sent += size;
  const bool is_last = size == left;
  if (lws_write(wsi, buffer_.data() + LWS_PRE, size,
                is_last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) < static_cast<int>(size)) {
    return -1;
  }
  if (!is_last) {
    lws_callback_on_writable(wsi);
    return 0;
  }
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

}  // namespace graben::scope
