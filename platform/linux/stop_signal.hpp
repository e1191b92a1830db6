#pragma once
/// SIGTERM and SIGINT ask the loop to end after its cycle.

#include "platform/linux/error_text.hpp"

namespace graben {

/// From here on the first SIGTERM and the first SIGINT only set a flag. A second one of the same
/// kind kills, for a process that no longer looks at the flag.
[[nodiscard]] ErrorText catch_stop_signals();

[[nodiscard]] bool stop_requested();

}  // namespace graben
