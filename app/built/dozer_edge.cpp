// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "app/built/machine_edge.hpp"
#include "app/ecu/dozer_kind.hpp"
#include "app/ecu/ground/edge_finder.hpp"

namespace graben::built {
namespace {

class DozerEdge : public MachineEdge {
 public:
  DozerEdge(const machines::DozerMachine& machine, double width_m)
      : setup_(machine.profile),
        finder_(setup_, width_of(machine.profile.tilt.edge_width_m, width_m, "tilt.edge_width")) {}

  void take(const CanFrame& frame, TimeUs now_us) override {
    if (frame.extended && same_message(frame.id, dbc::dozer::BodyCourse::kId)) {
      throw std::runtime_error(
          "its track curves (BodyCourse): the bus then tells stations along it and no place in "
          "plan; allowed: a dozer on a straight track");
    }
    receiver_.accept(frame, now_us);
  }

  std::optional<EdgePlace> look(TimeUs now_us) override {
    receiver_.finish(now_us);
    return finder_.look(receiver_.inputs(), now_us);
  }

  LinkCounters counters() const override { return receiver_.total(); }
  bool tells_work() const override { return true; }

 private:
  DozerSetup setup_;
  DozerReceiver receiver_;
  ground::DozerFinder finder_;
};

}  // namespace

std::unique_ptr<MachineEdge> dozer_edge(const machines::DozerMachine& machine, double width_m) {
  return std::make_unique<DozerEdge>(machine, width_m);
}

}  // namespace graben::built
