// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The station's frames while it commissions a dozer.

#include <array>
#include <vector>

#include "app/commission/dozer_plan.hpp"
#include "app/operate/station.hpp"
#include "can_dbc/codec.hpp"
#include "firmware/core/time.hpp"
#include "firmware/dozer/dozer_signals.hpp"
#include "hal/can_frame.hpp"
#include "hal/link/message_transmitter.hpp"

namespace graben::operate {

/// What is to be tried, and where: of lift, tilt and tracks.
struct DozerTries {
  DozerTry tried;
  std::array<commission::Window, kTriedCount> window{};
  std::array<bool, kTriedCount> has_window{};
};

/// OperatorCommand and DozerTry every 20 ms; DozerWindow every 100 ms, of the drives that have one
/// by turns.
class DozerFrames {
 public:
  /// The next ones, enable first; to be sent every 20 ms.
  [[nodiscard]] std::vector<CanFrame> next(const Request& request, const DozerTries& tries,
                                           dbc::Count echo, TimeUs now);
  /// What would be next and asks for nothing, for whoever has to send it in our place.
  [[nodiscard]] std::array<CanFrame, 1> last_words(TimeUs now) const;

 private:
  void put_window(const DozerTries& tries, TimeUs now, std::vector<CanFrame>& to);

  SendState command_;
  SendState try_;
  SendState window_;
  unsigned turn_ = kTriedCount - 1;  ///< Whose window was sent last.
  unsigned calls_ = 0;
};

}  // namespace graben::operate
