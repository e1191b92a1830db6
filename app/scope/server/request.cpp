// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/request.hpp"

#include "app/scope/server/access.hpp"

namespace graben::scope {

std::string header_of(lws* wsi, lws_token_indexes header) {
  const int length = lws_hdr_total_length(wsi, header);
  if (length <= 0) {
    return "";
  }
  // The library writes an end of the string, too.
  std::string text(static_cast<std::size_t>(length) + 1, '\0');
  if (lws_hdr_copy(wsi, text.data(), length + 1, header) < 0) {
    return "";
  }
  text.resize(static_cast<std::size_t>(length));
  return text;
}

int answer(lws* wsi, unsigned status, const char* words) {
  if (lws_return_http_status(wsi, status, words) != 0) {
    return -1;
  }
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

bool has_own_host(lws* wsi, const std::string& listened_on) {
  return is_own_host(header_of(wsi, WSI_TOKEN_HOST), listened_on);
}

bool has_foreign_origin(lws* wsi) {
  return lws_hdr_total_length(wsi, WSI_TOKEN_ORIGIN) > 0 &&
         !is_own_origin(header_of(wsi, WSI_TOKEN_ORIGIN), header_of(wsi, WSI_TOKEN_HOST));
}

}  // namespace graben::scope
