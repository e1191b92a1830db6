// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The nodes of one kind of machine, with what is broken on them.

#include <functional>
#include <memory>
#include <vector>

#include "app/scope/sim/sim_kinds.hpp"
#include "app/scope/sim/sim_machine.hpp"

namespace graben::scope {

/// What makes one machine of a kind another simulation than the next.
template <class Kind>
struct SimSite {
  using Rig = typename Kind::Rig;

  /// The nodes, as they are at the start.
  std::function<std::unique_ptr<Rig>()> make;
  std::function<bool(const Rig& nodes)> is_done;
  /// Before each cycle; may be empty.
  std::function<void(Rig& nodes)> before_cycle;
  std::shared_ptr<SimGround> ground;  ///< Null without.
};

template <class Kind>
class SimRig final : public SimMachine {
 public:
  using Rig = typename Kind::Rig;

  SimRig(SimSite<Kind> site, std::vector<SimFaultRow<Kind>> rows, FrameTap tap);

  void step(TimeUs now_us, const plant::OperatorRequest& request) override;
  void restart() override;
  [[nodiscard]] bool is_done() const override { return nodes_->ecu && site_.is_done(*nodes_); }
  [[nodiscard]] Task task() const override { return nodes_->task; }
  [[nodiscard]] const std::vector<SimFault>& faults() const override { return faults_; }
  [[nodiscard]] bool is_on(std::size_t fault) const override;
  void set_fault(std::size_t fault, bool on) override;
  [[nodiscard]] SimGround* ground() const override { return site_.ground.get(); }

  /// Others after a restart.
  [[nodiscard]] Rig& nodes() { return *nodes_; }

 private:
  struct Live {
    std::size_t row = 0;
    SimEffect effect;
  };

  void make_nodes();
  /// Whether the frame gets through.
  [[nodiscard]] bool on_its_way(CanFrame& frame, const LoopbackPort* from);
  void step_controller(TimeUs now_us);
  void end_what_is_over();

  SimSite<Kind> site_;
  std::vector<SimFaultRow<Kind>> rows_;
  std::vector<SimFault> faults_;  ///< Of the rows.
  FrameTap tap_;
  std::unique_ptr<Rig> nodes_;
  std::vector<Live> live_;
};

extern template class SimRig<SimExcavator>;
extern template class SimRig<SimDozer>;

}  // namespace graben::scope
