// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A run of a rig from the first cycle to the last, with its log.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "hal/link/message_links.hpp"
#include "platform/loopback/candump_log.hpp"

namespace graben::runs {

/// Share of the work done, 0 .. 1, and the place that the run has come to, in a few words.
using Progress = std::function<void(double share, const std::string& where)>;

/// Cost of a run, and frames that its controller did not take.
struct LoggedRun {
  double wall_s = 0.0;
  std::uint32_t rejected_frames = 0;
};

[[nodiscard]] inline double seconds(TimeUs time_us) { return static_cast<double>(time_us) * 1e-6; }

/// Steps the rig from time 0 on until `ended(now_us)`, with `look(now_us, cycle_us)` after each
/// step. Then the operator lets go, and the log shows neutral. No log if its name is empty.
template <class Rig, class Ended, class Look>
LoggedRun run_logged(Rig& rig, const std::filesystem::path& log_file, Ended ended, Look look) {
  constexpr TimeUs kAfterwards_us = 300 * kMillisecondUs;
  std::optional<CandumpLog> log;
  if (!log_file.empty()) {
    log.emplace(log_file, "vcan0");
    rig.bus.set_tap([&](const CanFrame& frame) { log->write(frame, frame.stamp_us); });
  }
  const auto begin = std::chrono::steady_clock::now();
  TimeUs now_us = 0;
  for (; !ended(now_us); now_us += Rig::kPeriod_us) {
    look(now_us, rig.step(now_us));
  }
  rig.release();
  for (const TimeUs end_us = now_us + kAfterwards_us; now_us < end_us; now_us += Rig::kPeriod_us) {
    static_cast<void>(rig.step(now_us));
  }
  LoggedRun figures;
  figures.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.rejected_frames = rejected(rig.ecu->link());
  rig.bus.set_tap(nullptr);
  if (log) {
    log->close();
  }
  return figures;
}

}  // namespace graben::runs
