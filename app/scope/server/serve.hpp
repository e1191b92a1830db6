// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben scope` from its first line to SIGINT or SIGTERM.

#include <string_view>

#include "app/scope/server/frame_source.hpp"
#include "app/scope/server/scope_server.hpp"

namespace graben::scope {

/// Serves until SIGINT or SIGTERM. Says on standard output where, and on standard error if other
/// machines can reach it. Throws std::runtime_error if the address cannot be had, or with what the
/// source has thrown.
void serve(const ServerOptions& options, std::string_view page, FrameSource& source,
           const nlohmann::json& parts);
void serve(const ServerOptions& options, std::string_view page, Show& show);

}  // namespace graben::scope
