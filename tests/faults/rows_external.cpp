// SPDX-License-Identifier: Apache-2.0
// Rows 91 to 93: a limit from outside whose source goes silent, is forged, or stops the machine.

#include "tests/faults/frames.hpp"
#include "tests/faults/row.hpp"
#include "tests/faults/trial.hpp"

namespace graben::faults {
namespace {

constexpr double kDeadline_s = 0.25;
constexpr TimeUs kDeadline_us = 250 * kMillisecondUs;
/// Frames at the start that a protected message needs.
constexpr TimeUs kHeard_us = 300 * kMillisecondUs;

ExternalWord word(ExternalLevel level, double speed_ratio) {
  return {level, false, 4, speed_ratio, kDeadline_s};
}

/// At work beside a source that slows nothing, or, in every second seed, to 80 %.
template <class Kind>
Rig<Kind>& work_beside(Trial<Kind>& trial) {
  Rig<Kind>& rig = trial.work();
  rig.plant.faults().external =
      word(trial.odd() ? ExternalLevel::kSlow : ExternalLevel::kFree, 0.8);
  rig.run(kHeard_us);
  trial.check(rig.mode() == EcuMode::kActive, "a source that is heard stops it");
  return rig;
}

template <class Kind>
void source_silent(Trial<Kind>& trial) {
  using Limit = typename Kind::Dbc::ExternalLimit;
  Rig<Kind>& rig = work_beside(trial);
  Stop stop{trial.last_us(Limit::kId),
            {Fault::kExternalSilent},
            kDeadline_us + 2 * kCycle_us,
            kDeadline_us + 2 * kCycle_us};
  rig.plant.faults().set_silent(Limit::kId, true);
  stop.cure = [&rig] { rig.plant.faults().set_silent(Limit::kId, false); };
  trial.expect_stop(stop);
}

/// What is not its sender's own word never lets it go faster: it is refused, and then missed, or is
/// none.
template <class Kind>
void source_forged(Trial<Kind>& trial) {
  using Limit = typename Kind::Dbc::ExternalLimit;
  Rig<Kind>& rig = work_beside(trial);
  const auto seed = trial.seed();
  Stop stop{trial.last_us(Limit::kId),
            {Fault::kExternalSilent, Fault::kMessageCorrupt, Fault::kMessageSequence,
             Fault::kMessageMasquerade, Fault::kValueOutOfRange},
            kDeadline_us + 2 * kCycle_us,
            kDeadline_us + 2 * kCycle_us};
  rig.tamper = [seed](CanFrame& frame, const LoopbackPort*) {
    if (frame.id != Limit::kId) {
      return true;
    }
    switch (seed % 6) {
      case 0:
        corrupt(frame);
        break;
      case 1:  // Bits of the payload, its checksum as it was.
        frame.data[2] = 0x00;
        break;
      case 2:
        frame.length = 7;
        break;
      case 3:  // 'Error', 'not available', of what decides.
        set_raw<Kind>(frame, Limit::kLevel, 14 + seed % 2);
        break;
      case 4:  // Reserved.
        set_raw<Kind>(frame, Limit::kLevel, 3 + static_cast<std::uint32_t>(seed % 11));
        break;
      default:  // For longer than a word may hold; out of its range.
        set_raw<Kind>(frame, Limit::kDeadline, 250);
        break;
    }
    return true;
  };
  stop.cure = [&rig] { rig.tamper = nullptr; };
  trial.expect_stop(stop);
}

template <class Kind>
void stopped_from_outside(Trial<Kind>& trial) {
  using Limit = typename Kind::Dbc::ExternalLimit;
  Rig<Kind>& rig = work_beside(trial);
  Stop stop{trial.last_us(Limit::kId) + cycle_us_of<Kind>(Limit::kId),
            {Fault::kExternalStop},
            2 * kCycle_us,
            2 * kCycle_us};
  rig.plant.faults().external = word(ExternalLevel::kStop, 1.0);
  stop.cure = [&rig] { rig.plant.faults().external = word(ExternalLevel::kFree, 1.0); };
  trial.expect_stop(stop);
}

}  // namespace

template <class Kind>
Rows<Kind> external_rows() {
  return {{91, "who limits the machine from outside goes silent", "N L", source_silent<Kind>},
          {92, "a limit from outside is forged", "N L", source_forged<Kind>},
          {93, "a stop from outside", "N L", stopped_from_outside<Kind>}};
}

template Rows<Excavator> external_rows();
template Rows<Dozer> external_rows();

}  // namespace graben::faults
