// SPDX-License-Identifier: Apache-2.0
#include "app/built/machine_edge.hpp"
#include "app/ecu/excavator_kind.hpp"
#include "app/ecu/ground/edge_finder.hpp"

namespace graben::built {
namespace {

namespace bus = dbc::excavator;

/// With a width that may be told beside the profile.
ExcavatorProfile profile_of(const machines::ExcavatorMachine& machine, double width_m) {
  ExcavatorProfile profile = machine.profile;
  double& its_m = profile.geometry.body.bucket_width_m;
  its_m = width_of(its_m, width_m, "bucket.width");
  return profile;
}

class ExcavatorEdge : public MachineEdge {
 public:
  ExcavatorEdge(const machines::ExcavatorMachine& machine, double width_m)
      : setup_(profile_of(machine, width_m)),
        receiver_(parts_of(setup_, machine.bus)),
        finder_(setup_) {}

  void take(const CanFrame& frame, TimeUs now_us) override {
    if (frame.extended && frame.length == bus::EcuTipLoad::kLength &&
        same_message(frame.id, bus::EcuTipLoad::kId)) {
      take_force(bus::EcuTipLoad::decode(frame.data), now_us);
    }
    receiver_.accept(frame, now_us);
  }

  std::optional<EdgePlace> look(TimeUs now_us) override {
    receiver_.finish(now_us);
    std::optional<EdgePlace> place = finder_.look(receiver_.inputs(), now_us);
    if (place && tells_force_ && static_cast<double>(now_us - force_us_) < 1e6 * kForceOld_s) {
      place->level_n = level_n_;
      place->deviation_n = deviation_n_;
    }
    return place;
  }

  LinkCounters counters() const override { return receiver_.total(); }
  bool tells_work() const override { return tells_force_; }

 private:
  static BusParts parts_of(const ExcavatorSetup& setup, const BusTable& table) {
    return with_table(ecu::ExcavatorKind::parts(setup), &table);
  }

  void take_force(const bus::EcuTipLoad& load, TimeUs now_us) {
    const auto valid = [](const dbc::Physical& signal) {
      return signal.state == dbc::RawState::kValid;
    };
    if (valid(load.tip_force_outwards_n) && valid(load.tip_force_deviation_n)) {
      tells_force_ = true;
      force_us_ = now_us;
      level_n_ = load.tip_force_outwards_n.value;
      deviation_n_ = load.tip_force_deviation_n.value;
    }
  }

  ExcavatorSetup setup_;
  ExcavatorReceiver receiver_;
  ground::ExcavatorFinder finder_;
  bool tells_force_ = false;
  double level_n_ = 0.0;
  double deviation_n_ = 0.0;
  TimeUs force_us_ = 0;
};

}  // namespace

std::unique_ptr<MachineEdge> excavator_edge(const machines::ExcavatorMachine& machine,
                                            double width_m) {
  return std::make_unique<ExcavatorEdge>(machine, width_m);
}

}  // namespace graben::built
