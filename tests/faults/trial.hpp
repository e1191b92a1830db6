// SPDX-License-Identifier: Apache-2.0
#pragma once
/// One row of the table tried with one seed: the scenery, and the checks that the reactions share.

#include <string>
#include <vector>

#include "app/plant/random.hpp"
#include "firmware/core/fault_set.hpp"
#include "tests/faults/frames.hpp"
#include "tests/faults/rig.hpp"

namespace graben::faults {

/// What a trial found. A time or share below 0 was not looked at.
struct Outcome {
  std::string seen;
  FaultSet codes;  ///< That answered the fault, of those that may.
  TimeUs to_detection_us = -1;
  TimeUs detection_to_neutral_us = -1;
  TimeUs to_neutral_us = -1;
  bool by_valve =
      false;  ///< The bus carried no neutral frame: the valve side's own timeout closed.
  double beyond_share = -1.0;
  double creep_share = -1.0;
  TimeUs rest_us = -1;     ///< From when the machine's side is neutral to tracks at rest.
  double rolled_m = -1.0;  ///< Meanwhile.
  double harm = -1.0;      ///< What came of it until it was seen, true: of the tool or the machine.
  const char* harm_unit = "";
  std::vector<std::string> failures;
};

/// What must stop the machine.
struct Stop {
  TimeUs since_us = 0;       ///< The first wrong thing; in silence the last right frame.
  std::vector<Fault> any{};  ///< One of these has to be the reason; empty: no fault.
  TimeUs detect_us = 0;      ///< From `since_us`, at most.
  TimeUs neutral_us =
      0;  ///< From `since_us` to neutral on the bus, at most; 0: no bound of its own.
  bool bus_carries = true;  ///< Else the valve side has to close by itself.
  bool latches = true;
  bool disobeying = false;       ///< A spool is open against its command.
  bool pilot_cut = false;        ///< The pilot pressure has to be asked away.
  bool brake_at_once = false;    ///< A machine that drives brakes before it stands.
  std::function<void()> cure{};  ///< Takes the fault away; empty: it is over by itself.
};

/// What must slow the machine.
struct Slowing {
  TimeUs since_us = 0;
  Fault fault = Fault::kNone;
  TimeUs detect_us = 0;
  TimeUs hold_us = 700 * kMillisecondUs;  ///< From detection to the cure.
  TimeUs back_us = 0;  ///< From the cure to full speed, at most; 0: what the kind needs.
  std::function<void()> cure{};
};

template <class Kind>
class Trial {
 public:
  Trial(std::uint64_t seed, int row);

  /// Replaces the scenery, before anything has run.
  void set_up(const typename Kind::Scenery& scenery,
              std::size_t ecu_queue = LoopbackBus::kQueueCapacity);
  void set_queue(std::size_t ecu_queue);

  /// From power-on to the task, Active for as long as the machine kind has it, with somewhere to
  /// go.
  Rig<Kind>& work();
  /// From power-on to Armed without a task.
  Rig<Kind>& arm();

  void expect_stop(const Stop& stop);
  void expect_slower(const Slowing& slowing);
  /// For `duration_us` from now nothing may show but counters, and nothing may come further
  /// than `bound_m` from where it would be undisturbed.
  void expect_ignored(TimeUs duration_us, double bound_m);
  /// Enable and task are asked for already: nothing may move, `why` must be among the reasons.
  /// After the cure a fresh enable works.
  void expect_refused(ArmBlock why, TimeUs duration_us, const std::function<void()>& cure);
  /// Lets go, waits for Ready, enables with the task at rest, then gives the task: must end Active.
  void expect_arms_again();

  void check(bool is_right, const std::string& what);
  void saw(const std::string& reaction);

  /// 0 .. count - 1.
  [[nodiscard]] unsigned any_of(unsigned count);
  [[nodiscard]] std::uint32_t any_id(const std::vector<std::uint32_t>& ids);
  [[nodiscard]] const Sensor& any_sensor(const std::vector<Sensor>& sensors);
  [[nodiscard]] const dbc::Field& any_field(const Sensor& sensor);
  [[nodiscard]] TimeUs any_time(TimeUs least_us, TimeUs most_us);  ///< Whole cycles.
  /// Every second seed.
  [[nodiscard]] bool odd() const { return seed_ % 2 == 1; }
  /// Speed that the field wanted in the last frame that said it.
  [[nodiscard]] double wanted_mps() const;
  /// The one that is farthest from here after so long if nothing disturbs the task.
  [[nodiscard]] unsigned farthest_place(TimeUs after_us) const;
  /// When a frame of this message was last on the bus.
  [[nodiscard]] TimeUs last_us(std::uint32_t id) { return rig->record.last_us[id]; }

  std::uint64_t seed() const { return seed_; }

  /// Of the rigs of all trials that are made from here on; null: nobody sees them.
  static inline EcuWitness* witness = nullptr;
  plant::Random random;
  std::optional<Rig<Kind>> rig;
  Outcome outcome;

 private:
  void await_detection(const Stop& stop);
  void stay_stopped(const Stop& stop);
  void judge_closing(bool brake_at_once);
  void judge_rolling(const RollingWatch& rolling, bool brake_at_once);
  void expect_reported(Fault fault, TimeUs since_us, TimeUs from_us);

  std::uint64_t seed_;
  typename Kind::Scenery scenery_;
  TimeUs detected_us_ = -1;
  TimeUs neutral_us_ = -1;
};

/// So much after its last frame a message that comes every 10 or 20 ms is missing.
inline constexpr TimeUs kSilence_us = 50 * kMillisecondUs;

template <class Kind>
void slowed_by_silence(Trial<Kind>& trial, std::uint32_t id, Fault fault) {
  trial.work();
  Slowing slowing{trial.last_us(id), fault, kSilence_us};
  slowing.cure = [&trial, id] { trial.rig->plant.faults().set_silent(id, false); };
  trial.rig->plant.faults().set_silent(id, true);
  trial.expect_slower(slowing);
}

}  // namespace graben::faults
