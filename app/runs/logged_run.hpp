#pragma once
/// A bench from the first cycle to the last, with its log.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "hal/link/link_counters.hpp"
#include "platform/loopback/candump_log.hpp"

namespace graben::runs {

/// Share of the work done and where it stands.
using Progress = std::function<void(double share, const std::string& where)>;

struct BenchFigures {
  double wall_s = 0.0;
  std::uint32_t rejected_frames = 0;
};

[[nodiscard]] inline double seconds(TimeUs time_us) { return static_cast<double>(time_us) * 1e-6; }

/// Steps the bench from time 0 on until `ended(now_us)`, with `look(now_us, cycle_us)` after each
/// step. Then the operator lets go, and the log shows neutral. No log if its name is empty.
template <class Bench, class Ended, class Look>
BenchFigures run_bench(Bench& bench, const std::filesystem::path& log_file, Ended ended,
                       Look look) {
  constexpr TimeUs kAfterwards_us = 300 * kMillisecondUs;
  std::optional<CandumpLog> log;
  if (!log_file.empty()) {
    log.emplace(log_file, "vcan0");
    bench.bus.set_tap([&](const CanFrame& frame) { log->write(frame, frame.stamp_us); });
  }
  const auto begin = std::chrono::steady_clock::now();
  TimeUs now_us = 0;
  for (; !ended(now_us); now_us += Bench::kPeriod_us) {
    look(now_us, bench.step(now_us));
  }
  bench.release();
  for (const TimeUs end_us = now_us + kAfterwards_us; now_us < end_us;
       now_us += Bench::kPeriod_us) {
    static_cast<void>(bench.step(now_us));
  }
  BenchFigures figures;
  figures.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  figures.rejected_frames = rejected(bench.ecu->link());
  bench.bus.set_tap(nullptr);
  if (log) {
    log->close();
  }
  return figures;
}

}  // namespace graben::runs
