// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far a commissioning has come, in a file beside its log: what is needed to go on after a
/// break, a fault or a restart.

#include <cstdint>
#include <filesystem>

#include "app/commission/commission_plan.hpp"
#include "app/commission/dozer_plan.hpp"

namespace graben::commission {

template <class Options>
struct ProgressOf {
  std::uint32_t profile_hash = 0;
  Options options;
  std::vector<StepResult> results;  ///< Of the steps that are done, in their order.
};

using Progress = ProgressOf<SequenceOptions>;
using DozerProgress = ProgressOf<DozerOptions>;

/// LOG.progress.json.
[[nodiscard]] std::filesystem::path progress_file(const std::filesystem::path& log);

/// In one piece: whoever reads sees the old one or the new one. Throws std::runtime_error.
void write_progress(const std::filesystem::path& file, const Progress& progress);
void write_progress(const std::filesystem::path& file, const DozerProgress& progress);

/// Throws std::runtime_error, with the file's name and the reason, if it is not there, not of this
/// tool, or of another machine profile than `profile_hash`. Strokes and pumps are those of
/// `machine`, which the file does not have.
[[nodiscard]] Progress read_progress(const std::filesystem::path& file, std::uint32_t profile_hash,
                                     const SequenceOptions& machine);
[[nodiscard]] DozerProgress read_progress(const std::filesystem::path& file,
                                          std::uint32_t profile_hash, const DozerOptions& machine);

/// Throws std::runtime_error that names the first drive whose window, speed or ends differ, of the
/// drives that are tried.
void require_same_windows(const SequenceOptions& before, const SequenceOptions& now);
void require_same_windows(const DozerOptions& before, const DozerOptions& now);

}  // namespace graben::commission
