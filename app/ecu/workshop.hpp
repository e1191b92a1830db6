// SPDX-License-Identifier: Apache-2.0
#pragma once
/// After each cycle of the deployed process: the workshop's requests, and what goes to the store.

#include <cstdint>

#include "app/ecu/address_port.hpp"
#include "app/ecu/diagnostic_port.hpp"
#include "app/ecu/store/fault_recorder.hpp"
#include "app/ecu/store/frozen_fault.hpp"
#include "app/ecu/store/process_store.hpp"

namespace graben::ecu {

/// What others on the bus ask for beside control, and what is stored for it.
class Workshop {
 public:
  /// `site`: site_mark() of the tasks' file, 0 where there are none.
  Workshop(AddressPort& address, DiagnosticPort& port, ProcessStore* store, std::uint32_t site)
      : address_(address),
        port_(port),
        site_(site),
        rings_(store == nullptr ? nullptr : &store->rings()),
        recorder_(rings_) {
    if (store != nullptr) {
      recorder_.begin(store->found());
    }
  }
  void begin(TimeUs now_us) {
    address_.begin(now_us);
    port_.begin(now_us);
  }
  template <class Ecu>
  void cycle_done(const Ecu& ecu, TimeUs now_us) {
    const MachineStatus& status = ecu.outputs().status;
    recorder_.look(sample_of(ecu.inputs(), ecu.outputs(), now_us), status.faults);
    const FaultSet cleared = port_.finish({status.faults, status.mode, recorder_.stored(),
                                           frozen_of(recorder_.last()), recorder_.can_forget()});
    recorder_.forget(cleared, now_us);
    keep_learnt(ecu, now_us);
    keep_left_site(ecu);
    address_.finish();
  }

 private:
  /// A copy each second, for the store; one that it has no room for is followed by another.
  template <class Ecu>
  void keep_learnt(const Ecu& ecu, TimeUs now_us) {
    if (rings_ != nullptr && now_us - learnt_us_ >= kSecondUs && rings_->learnt.has_room()) {
      learnt_us_ = now_us;
      static_cast<void>(rings_->learnt.put(record_of(ecu.learnt())));
    }
  }

  /// Once, as soon as the store has room for it.
  template <class Ecu>
  void keep_left_site(const Ecu& ecu) {
    if (rings_ != nullptr && site_ != 0 && !site_is_kept_ && ecu.site_is_left()) {
      site_is_kept_ = rings_->left_site.has_room() && rings_->left_site.put(site_);
    }
  }

  AddressPort& address_;
  DiagnosticPort& port_;
  std::uint32_t site_;
  FaultRings* rings_;
  FaultRecorder recorder_;
  TimeUs learnt_us_ = 0;
  bool site_is_kept_ = false;
};

}  // namespace graben::ecu
