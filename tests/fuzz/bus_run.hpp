#pragma once
/// The controller's whole cycle on a scripted bus, watched from outside.

#include <string>

#include "tests/fuzz/bus_evidence.hpp"
#include "tests/fuzz/bus_partner.hpp"
#include "tests/fuzz/bus_rules.hpp"

namespace graben::test {

template <class Kind>
class BusRun {
 public:
  static constexpr TimeUs kPeriod_us = 10 * kMillisecondUs;
  static constexpr TimeUs kStart_us = kSecondUs;

  explicit BusRun(const typename Kind::Machine& machine);

  /// One cycle `elapsed_us` after the last one; empty, or what was wrong with it.
  [[nodiscard]] std::string cycle(TimeUs elapsed_us);

  /// Everything is well again and the operator starts afresh: Active within 4 s, and it stays so.
  [[nodiscard]] std::string recover();

  [[nodiscard]] bool is_active() const { return ecu_.outputs().status.mode == EcuMode::kActive; }

  ScriptedPort port;
  BusPartner<Kind> partner;

 private:
  TimeUs now_ = kStart_us;
  typename Kind::Ecu ecu_;
  BusEvidence<Kind> evidence_;
  BusRules<Kind> rules_;
  bool has_run_ = false;
};

}  // namespace graben::test
