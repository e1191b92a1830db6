// SPDX-License-Identifier: Apache-2.0
#pragma once
/// An HTTP request, as libwebsockets has it.

#include <libwebsockets.h>

#include <string>

namespace graben::scope {

/// Empty if the request has no such header.
[[nodiscard]] std::string header_of(lws* wsi, lws_token_indexes header);

/// Answers with a status and some words. For the library: 0 goes on, -1 hangs up.
[[nodiscard]] int answer(lws* wsi, unsigned status, const char* words);

/// Whether its `Host` is this server (access.hpp).
[[nodiscard]] bool has_own_host(lws* wsi, const std::string& listened_on);

/// Whether it comes from a page of another server; what is no browser says no `Origin`.
[[nodiscard]] bool has_foreign_origin(lws* wsi);

}  // namespace graben::scope
