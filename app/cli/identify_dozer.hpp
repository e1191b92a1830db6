// SPDX-License-Identifier: Apache-2.0
#pragma once
/// `graben identify --log` of a dozer.

#include "app/cli/identify_log.hpp"

namespace graben::cli {

/// A better profile of the logs, written to --out; with --check only what the profile predicts.
/// Throws std::runtime_error, with the reason; then nothing was written.
void identify_dozer_logs(const IdentifyLogCommand& options);

}  // namespace graben::cli
