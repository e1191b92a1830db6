// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The station's frames while it commissions.

#include <vector>

#include "app/commission/commission_plan.hpp"
#include "app/operate/command_frames.hpp"

namespace graben::operate {

/// What is to be tried, and where.
struct TriedDuties {
  std::array<double, kAxisCount> duty_ratio{};
  std::array<commission::Window, kAxisCount> window{};
  std::array<bool, kAxisCount> has_window{};
};

/// OperatorCommand, OperatorAxes and CommissionDuty every 20 ms; CommissionWindow every 100 ms, of
/// the drives that have one by turns.
class CommissionFrames {
 public:
  /// The next ones, enable first; to be sent every 20 ms.
  [[nodiscard]] std::vector<CanFrame> next(const Request& request, const TriedDuties& tried,
                                           dbc::Count echo, TimeUs now);
  /// The pair that would be next and asks for nothing, for whoever has to send it in our place.
  [[nodiscard]] CommandPair last_words(TimeUs now) const { return command_.last_words(now); }

 private:
  void put_window(const TriedDuties& tried, TimeUs now, std::vector<CanFrame>& to);

  CommandFrames command_;
  SendState duty_;
  SendState window_;
  unsigned turn_ = kAxisCount - 1;  ///< Whose window was sent last.
  unsigned calls_ = 0;
};

}  // namespace graben::operate
