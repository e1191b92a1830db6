// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A ground that task Assist is tried on.

#include <memory>

#include "app/runs/assist_run.hpp"

namespace graben::cli {

/// The shipped crest.xml as the machine has it that stands where the file means it to.
[[nodiscard]] std::shared_ptr<const runs::AssistGround> crest_ground(
    const ExcavatorProfile& profile);

}  // namespace graben::cli
