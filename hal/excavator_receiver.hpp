#pragma once
/// Frames to signals. What is not certain never reaches the inputs: it is counted, the signals keep
/// their last value and stamp, and it is for the validation to find them too old.

#include <array>
#include <cstdint>

#include "firmware/core/time.hpp"
#include "firmware/signals/excavator_signals.hpp"
#include "hal/can_frame.hpp"
#include "hal/e2e.hpp"
#include "hal/e2e_window.hpp"
#include "hal/link_counters.hpp"

namespace graben {

/// What the other end says it is; arming needs it to equal our own.
struct ExcavatorIdentity {
  Signal<std::uint32_t> profile_hash;
  Signal<std::uint32_t> dbc_version;
};

/// Whether that is what we are; as valid and as old as the worse of the two.
[[nodiscard]] Signal<bool> same_machine(const ExcavatorIdentity& identity,
                                        std::uint32_t own_profile_hash);

/// Receives every frame of the bus, keeps those of excavator.dbc that are meant for the controller.
/// A message is known by its whole 29-bit id: priority, page, PGN and source address.
///
/// A frame is refused as a whole if its kind, length, CRC, counter or any of its values is wrong. A
/// value that the sender itself calls 'error' or 'not available' is accepted as that: the signal
/// gets kError or kNotAvailable, value 0, and the new stamp.
class ExcavatorReceiver {
 public:
  static constexpr int kMessageCount = 11;

  /// The 29-bit ids that it keeps, for a port's filters.
  [[nodiscard]] static std::array<std::uint32_t, kMessageCount> ids();

  /// `now` becomes the stamp of the signals; the frame's own stamp is not used, so that signals and
  /// control cycle share one clock.
  void accept(const CanFrame& frame, TimeUs now);

  [[nodiscard]] const ExcavatorInputs& inputs() const { return received_.inputs; }
  [[nodiscard]] const ExcavatorIdentity& identity() const { return received_.identity; }

  /// Over all messages. An error frame is nobody's, so it is counted here only.
  [[nodiscard]] const LinkCounters& total() const { return total_; }
  /// Frames, 11-bit ones too, whose id is none of ours.
  [[nodiscard]] std::uint32_t foreign() const { return foreign_; }

  /// Counters and end-to-end state of a message; `id` is its 29-bit id. An id that is not received
  /// has empty counters and kNoNewData; kNoNewData is also the state of an unprotected message.
  [[nodiscard]] LinkCounters link(std::uint32_t id) const;
  [[nodiscard]] E2eCheck link_check(std::uint32_t id, TimeUs now) const;

  /// Of all messages: kMessageCorrupt, kMessageSequence, kMessageMasquerade.
  [[nodiscard]] FaultSet message_faults(TimeUs now) const;
  /// Whether a value was out of range since the last call.
  [[nodiscard]] bool take_out_of_range();

  /// Where the decode functions put what they found.
  struct Received {
    ExcavatorInputs inputs;
    ExcavatorIdentity identity;
  };

 private:
  void count(std::size_t row, std::uint32_t LinkCounters::*counter);
  [[nodiscard]] bool passes_e2e(std::size_t row, const CanFrame& frame, TimeUs now);

  Received received_;
  std::array<E2eState, kMessageCount> e2e_{};
  std::array<E2eWindow, kMessageCount> window_{};
  std::array<LinkCounters, kMessageCount> link_{};
  LinkCounters total_;
  std::uint32_t foreign_ = 0;
  bool out_of_range_ = false;
};

}  // namespace graben
