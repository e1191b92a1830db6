// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Faults of every simulated machine. The default is nothing; each switch acts from the
/// next cycle on and can be taken back.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "app/plant/random.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "firmware/signals/machine_signals.hpp"

namespace graben::plant {

/// Of a node's frames, by their messages' 29-bit ids.
struct FrameFaults {
  std::set<std::uint32_t> silent;          ///< Not sent; the counter stands still meanwhile.
  std::set<std::uint32_t> frozen_counter;  ///< Sent with the same counter again and again.
  /// Each is protected with the other's data id.
  std::optional<std::pair<std::uint32_t, std::uint32_t>> swapped_data_ids;
  /// Every frame goes out that much later. What is still on its way when it becomes 0 is lost.
  TimeUs delay_us = 0;

  void set_silent(std::uint32_t id, bool on) { set(silent, id, on); }
  void set_frozen_counter(std::uint32_t id, bool on) { set(frozen_counter, id, on); }

 private:
  static void set(std::set<std::uint32_t>& ids, std::uint32_t id, bool in) {
    if (in) {
      ids.insert(id);
    } else {
      ids.erase(id);
    }
  }
};

/// A sensor that lives and lies.
struct LivingLie {
  double noise = 0.0;  ///< Added while it is stuck, evenly up to this, in its reading's unit.
  /// It shows so many times what its reading changes; -1: the other way.
  double gain = 1.0;
  bool from_zero = false;  ///< From 0 on; else from where it was as that began.
  /// Each second it shows what is so many seconds older than before, in frames as frequent as ever.
  double later = 0.0;
};

/// What a stroke sensor shows.
struct StrokeFault {
  bool stuck = false;      ///< What it showed when this began.
  double jump_m = 0.0;     ///< Added.
  double drift_mps = 0.0;  ///< Added, growing from 0 on; 0 takes it back.
  dbc::RawState state{};   ///< kValid shows the stroke; else 'error' or 'not available'.
  LivingLie lie{};
};

/// What an angle sensor shows.
struct AngleFault {
  bool stuck = false;        ///< What it showed when this began.
  double jump_rad = 0.0;     ///< Added.
  double drift_radps = 0.0;  ///< Added, growing from 0 on; 0 takes it back.
  dbc::RawState state{};     ///< kValid shows the angle; else 'error' or 'not available'.
  LivingLie lie{};
};

/// What a sensor shows, in its reading's unit.
struct ReadingFault {
  bool stuck = false;     ///< What it showed when this began.
  double jump = 0.0;      ///< Added.
  double drift_ps = 0.0;  ///< Added, growing by that much a second from 0 on; 0 takes it back.
  dbc::RawState state{};  ///< kValid shows the reading; else 'error' or 'not available'.
  std::optional<double> reads{};  ///< Shows this, whatever it measures.
  LivingLie lie{};

  ReadingFault() = default;
  explicit ReadingFault(const StrokeFault& fault)
      : stuck(fault.stuck),
        jump(fault.jump_m),
        drift_ps(fault.drift_mps),
        state(fault.state),
        lie(fault.lie) {}
  explicit ReadingFault(const AngleFault& fault)
      : stuck(fault.stuck),
        jump(fault.jump_rad),
        drift_ps(fault.drift_radps),
        state(fault.state),
        lie(fault.lie) {}
};

/// A sensor that can fail. A reading is taken once a cycle of 10 ms.
class FaultyReading {
 public:
  FaultyReading() = default;
  /// Of a sound sensor that shows what was `age_s` ago.
  explicit FaultyReading(double age_s) : sound_age_s_(age_s), age_s_(age_s) {}

  [[nodiscard]] dbc::Physical show(double reading, const ReadingFault& fault) {
    reading = late(reading, fault.lie.later);
    drift_ = fault.drift_ps == 0.0 ? 0.0 : drift_ + kCycle_s * fault.drift_ps;
    if (fault.lie.gain == 1.0) {
      from_ = reading;
    } else if (fault.lie.from_zero) {
      from_ = 0.0;
    }
    const double scaled = from_ + fault.lie.gain * (reading - from_);
    if (!fault.stuck) {
      shown_ = fault.reads.value_or(scaled + fault.jump + drift_);
    }
    const double noise = fault.stuck ? random_.symmetric(fault.lie.noise) : 0.0;
    return {fault.state == dbc::RawState::kValid ? shown_ + noise : 0.0, fault.state};
  }

 private:
  static constexpr double kCycle_s = 0.01;

  /// As it was by now so long ago.
  double late(double reading, double later) {
    if (later == 0.0) {
      age_s_ = sound_age_s_;
    }
    if (age_s_ == 0.0 && later == 0.0) {
      past_.clear();
      return reading;
    }
    past_.push_back(reading);
    age_s_ += kCycle_s * later;
    const double last = static_cast<double>(past_.size() - 1);
    const double at = std::max(0.0, last - age_s_ / kCycle_s);
    const auto before = static_cast<std::size_t>(at);
    const double next = past_[std::min(before + 1, past_.size() - 1)];
    return past_[before] + (at - static_cast<double>(before)) * (next - past_[before]);
  }

  double shown_ = 0.0;  ///< Last: a stuck sensor goes on showing it.
  double drift_ = 0.0;
  double from_ = 0.0;
  double sound_age_s_ = 0.0;
  double age_s_ = 0.0;
  std::vector<double> past_;  ///< Readings since it began to be late.
  Random random_{1, Draw::kSensorNoise};
};

struct NodeFaults {
  /// Somebody outside limits the machine, on the same bus, from the first word on.
  std::optional<ExternalWord> external;
  bool wrong_identity = false;  ///< The machine names another profile.
  double engine_ratio = 1.0;    ///< Of the engine's speed; 0: it stands.
  ReadingFault engine_speed;    ///< As EEC1 shows it, rad/s.
  /// EEC1 comes for so long, then not for so long, and so on; 0: all the time.
  TimeUs engine_speed_turns_us = 0;
  bool loses_spool_commands = false;  ///< SpoolCommand does not reach the valve side.
  bool cannot_answer = false;         ///< It knows nothing of the controller's stamps.
  FrameFaults frames;

  void set_silent(std::uint32_t id, bool silent) { frames.set_silent(id, silent); }
  void set_frozen_counter(std::uint32_t id, bool frozen) { frames.set_frozen_counter(id, frozen); }
};

}  // namespace graben::plant
