// SPDX-License-Identifier: Apache-2.0
#include "app/scope/sim/sim_rig.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace graben::scope {

unsigned SimExcavator::moving_axis(const Rig& nodes) {
  unsigned most = 0;
  for (unsigned axis = 1; axis < kAxisCount; ++axis) {
    if (std::abs(spool_ratio(nodes, axis)) > std::abs(spool_ratio(nodes, most))) {
      most = axis;
    }
  }
  return most;
}

template <class Kind>
SimRig<Kind>::SimRig(SimSite<Kind> site, std::vector<SimFaultRow<Kind>> rows, FrameTap tap)
    : site_(std::move(site)),
      rows_(std::move(rows)),
      faults_(rows_.begin(), rows_.end()),
      tap_(std::move(tap)) {
  make_nodes();
}

template <class Kind>
void SimRig<Kind>::make_nodes() {
  nodes_ = site_.make();
  nodes_->says_cycle_time = true;
  nodes_->bus.set_fault_hook(
      [this](CanFrame& frame, const LoopbackPort* from) { return on_its_way(frame, from); });
  nodes_->bus.set_tap(tap_);
}

template <class Kind>
bool SimRig<Kind>::on_its_way(CanFrame& frame, const LoopbackPort* from) {
  return std::all_of(live_.begin(), live_.end(), [&](const Live& live) {
    return !live.effect.tamper || live.effect.tamper(frame, from);
  });
}

template <class Kind>
void SimRig<Kind>::step(TimeUs now_us, const plant::OperatorRequest& request) {
  plant::OperatorRequest asked = request;
  for (const Live& live : live_) {
    if (live.effect.operator_does) {
      live.effect.operator_does(asked);
    }
  }
  if (site_.before_cycle) {
    site_.before_cycle(*nodes_);
  }
  nodes_->driver.set_schedule({{0, asked}});
  nodes_->step_machine(now_us);
  step_controller(now_us);
  end_what_is_over();
}

template <class Kind>
void SimRig<Kind>::step_controller(TimeUs now_us) {
  bool runs = true;
  for (const Live& live : live_) {
    if (live.effect.before_controller) {
      live.effect.before_controller();
    }
    // Each of them counts the cycles that it leaves out.
    const bool lets = !live.effect.controller_runs || live.effect.controller_runs();
    runs = runs && lets;
  }
  if (runs && nodes_->ecu) {
    static_cast<void>(nodes_->step_ecu(now_us));
  }
}

template <class Kind>
void SimRig<Kind>::end_what_is_over() {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const auto found = std::find_if(live_.begin(), live_.end(), [row](const Live& live) {
      return live.row == row && live.effect.is_over && live.effect.is_over();
    });
    if (found != live_.end()) {
      set_fault(row, false);
    }
  }
}

template <class Kind>
void SimRig<Kind>::restart() {
  std::vector<std::size_t> stays;
  for (const Live& live : live_) {
    if (!rows_[live.row].once) {
      stays.push_back(live.row);
    }
  }
  // What they have changed goes with the nodes.
  live_.clear();
  make_nodes();
  for (const std::size_t row : stays) {
    set_fault(row, true);
  }
}

template <class Kind>
bool SimRig<Kind>::is_on(std::size_t fault) const {
  return std::any_of(live_.begin(), live_.end(),
                     [fault](const Live& live) { return live.row == fault; });
}

template <class Kind>
void SimRig<Kind>::set_fault(std::size_t fault, bool on) {
  if (on == is_on(fault)) {
    return;
  }
  if (on) {
    live_.push_back({fault, rows_[fault].begin(*this)});
    return;
  }
  const auto found = std::find_if(live_.begin(), live_.end(),
                                  [fault](const Live& live) { return live.row == fault; });
  const SimEffect effect = std::move(found->effect);
  live_.erase(found);
  if (effect.undo) {
    effect.undo();
  }
}

template class SimRig<SimExcavator>;
template class SimRig<SimDozer>;

}  // namespace graben::scope
