// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a commissioning at the station is of one machine kind: its sequence, what that goes by and
/// what it tries, in words and frames.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/commission/commission_progress.hpp"
#include "app/commission/commission_sequence.hpp"
#include "app/commission/dozer_ear.hpp"
#include "app/commission/dozer_sequence.hpp"
#include "app/operate/commission_frames.hpp"
#include "app/operate/dozer_frames.hpp"
#include "app/operate/ecu_listener.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"

namespace graben::operate {

class ExcavatorLead {
 public:
  using Options = commission::SequenceOptions;
  using Sequence = commission::CommissionSequence;
  using Tried = TriedDuties;
  using Frames = CommissionFrames;
  static constexpr std::uint32_t kDbcVersion = dbc::excavator::kDbcVersion;

  ExcavatorLead(const Options& options, const std::vector<commission::StepResult>& done);

  /// Every frame of the bus.
  void hear(const CanFrame& frame, TimeUs now);
  /// True where all that it goes by came of late.
  [[nodiscard]] bool look(const EcuListener& ecu, TimeUs now);
  /// 10 ms on; `moving`: the controller moves what is tried.
  void step(const EcuListener& ecu, bool moving, TimeUs now);

  [[nodiscard]] const Sequence& sequence() const { return sequence_; }
  /// The windows, and what is tried now; nothing unless `on`.
  [[nodiscard]] Tried tried(bool on) const;
  [[nodiscard]] double swing_duty() const { return sequence_.swing_duty(); }
  /// Its step goes on where the controller holds it back at the stroke's end.
  [[nodiscard]] bool touches() const;
  [[nodiscard]] std::size_t steps() const { return sequence_.steps().size(); }
  [[nodiscard]] std::string step_text(std::size_t at) const;
  [[nodiscard]] std::string speed_text(std::size_t at) const;
  [[nodiscard]] std::string wrong_text() const;

 private:
  Options options_;
  Sequence sequence_;
  std::array<double, kAxisCount> stroke_m_{};
  double swing_rad_ = 0.0;
};

/// Members as ExcavatorLead has them.
class DozerLead {
 public:
  using Options = commission::DozerOptions;
  using Sequence = commission::DozerSequence;
  using Tried = DozerTries;
  using Frames = DozerFrames;
  static constexpr std::uint32_t kDbcVersion = dbc::dozer::kDbcVersion;

  DozerLead(const Options& options, const std::vector<commission::StepResult>& done);

  void hear(const CanFrame& frame, TimeUs now) { ear_.hear(frame, now); }
  [[nodiscard]] bool look(const EcuListener& ecu, TimeUs now);
  void step(const EcuListener& ecu, bool moving, TimeUs now);

  [[nodiscard]] const Sequence& sequence() const { return sequence_; }
  [[nodiscard]] Tried tried(bool on) const;
  [[nodiscard]] double swing_duty() const { return 0.0; }
  [[nodiscard]] bool touches() const { return false; }
  [[nodiscard]] std::size_t steps() const { return sequence_.texts().size(); }
  [[nodiscard]] std::string step_text(std::size_t at) const { return sequence_.texts()[at]; }
  [[nodiscard]] std::string speed_text(std::size_t at) const;
  [[nodiscard]] std::string wrong_text() const;

 private:
  Options options_;
  Sequence sequence_;
  commission::DozerEar ear_;
};

}  // namespace graben::operate
