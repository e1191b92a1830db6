#pragma once
/// Who may talk to the server. A browser lets any page open a WebSocket to any address, this
/// machine's own included, and says only by what page: `Origin`. And a foreign name can be made to
/// lead to this machine (DNS rebinding), with which a foreign page becomes one of the same origin:
/// but `Host` still has the foreign name.

#include <string_view>

namespace graben::scope {

/// Whether a `Host` header, with or without a port, names this server: by an address, which nobody
/// can make lead elsewhere, as localhost, or by the name that it was told to listen on.
[[nodiscard]] bool is_own_host(std::string_view host, std::string_view listened_on);

/// Whether an `Origin` header is the page that this server gives under `host`, the `Host` header of
/// the same request. What is no browser has none, which is the caller's to know.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace graben::scope
