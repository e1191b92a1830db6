// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A simulation that runs on, round after round, and does what the pages ask of it. Time is
/// simulated: whoever steps it decides when.

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/scope/sim/sim_machine.hpp"
#include "app/scope/sim/sim_operator.hpp"
#include "app/scope/sim/sim_wish.hpp"

namespace graben::scope {

/// `SimState` of page/src/model/api.ts.
struct SimState {
  bool running = true;  ///< The operator wants to work.
  double pace = 1.0;
  double speed = 1.0;
  bool soil = false;
  bool obstacle = false;
  std::vector<std::string> faults;
};

/// step() and now_us() are for one thread, the rest for any.
class SimSession {
 public:
  static constexpr TimeUs kCycle_us = 10 * kMillisecondUs;
  /// A task that is done is shown so for a moment before it begins anew.
  static constexpr TimeUs kShownDone_us = kSecondUs;
  /// Wishes that may wait for a cycle.
  static constexpr std::size_t kWishesMost = 64;

  /// Throws as make_sim_machine(). The tap is called within step().
  SimSession(const SimOptions& options, FrameTap tap);

  /// Does what was wished, then one cycle. True if the state has changed.
  bool step();
  /// Of the next cycle; goes on over restarts.
  [[nodiscard]] TimeUs now_us() const { return now_us_; }

  /// Takes a wish for the next cycle; else why not.
  [[nodiscard]] std::optional<std::string> control(const nlohmann::json& message);
  /// {"kind": "sim", ...} if it changed since `seen`, which becomes its revision; they begin at 1.
  [[nodiscard]] std::optional<nlohmann::json> state(std::uint64_t& seen) const;
  [[nodiscard]] double pace() const;
  /// `SimSetup`.
  [[nodiscard]] nlohmann::json setup() const;

 private:
  void see(const CanFrame& frame);
  void fulfil(const SimWish& wish);
  void begin_anew();
  void look_at_end();
  [[nodiscard]] SimState state_now() const;
  [[nodiscard]] bool publish();

  std::string task_;
  FrameTap tap_;
  std::unique_ptr<SimMachine> machine_;
  SimOperator operator_;
  bool running_ = true;
  double pace_ = 1.0;
  TimeUs now_us_ = 0;
  std::optional<TimeUs> done_since_us_;

  mutable std::mutex mutex_;  ///< Of all that follows.
  std::vector<SimWish> wishes_;
  SimState published_;
  std::uint64_t revision_ = 1;
};

}  // namespace graben::scope
