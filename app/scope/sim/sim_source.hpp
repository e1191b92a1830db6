#pragma once
/// A simulation in real time as a source of frames.

#include <memory>

#include "app/scope/server/frame_source.hpp"
#include "app/scope/sim/sim_machine.hpp"

namespace graben::scope {

/// Throws std::runtime_error where the options do not fit, ProfileError for a wrong file. Frames
/// are stamped with simulated time, from 0 on.
[[nodiscard]] std::unique_ptr<FrameSource> make_sim_source(const SimOptions& options);

}  // namespace graben::scope
