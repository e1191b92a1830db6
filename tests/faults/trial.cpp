// SPDX-License-Identifier: Apache-2.0
#include "tests/faults/trial.hpp"

#include <fmt/format.h>

#include "tests/faults/dozer_kind.hpp"
#include "tests/faults/excavator_kind.hpp"

namespace graben::faults {
namespace {

/// No row's draws are another's.
constexpr std::uint64_t kSeedsPerRow = 1'000'003;
}  // namespace

template <class Kind>
Trial<Kind>::Trial(std::uint64_t seed, int row)
    : random(seed + kSeedsPerRow * static_cast<std::uint64_t>(row), plant::Draw::kStart),
      seed_(seed),
      scenery_(Kind::scenery_of(seed)) {
  rig.emplace(scenery_, LoopbackBus::kQueueCapacity, witness);
}

template <class Kind>
void Trial<Kind>::set_up(const typename Kind::Scenery& scenery, std::size_t ecu_queue) {
  scenery_ = scenery;
  rig.emplace(scenery_, ecu_queue, witness);
}

template <class Kind>
void Trial<Kind>::set_queue(std::size_t ecu_queue) {
  rig.emplace(scenery_, ecu_queue, witness);
}

template <class Kind>
Rig<Kind>& Trial<Kind>::work() {
  rig->run(200 * kMillisecondUs);
  rig->ask(true, Task::kNone);
  rig->run(100 * kMillisecondUs);
  rig->ask(true, Kind::kTask);
  check(rig->run_until(kSecondUs, [this] { return rig->mode() == EcuMode::kActive; }),
        "the task does not begin");
  rig->run(any_time(Kind::kFirstInjection_us, Kind::kLastInjection_us));
  const bool moves =
      rig->run_until(4 * kSecondUs, [this] { return wanted_mps() > Kind::kMoving_mps; });
  check(moves && rig->mode() == EcuMode::kActive && rig->enabled(),
        fmt::format("no task under way before the fault: mode {}, fault {}",
                    static_cast<int>(rig->mode()), static_cast<int>(rig->outputs().status.fault)));
  return *rig;
}

template <class Kind>
Rig<Kind>& Trial<Kind>::arm() {
  rig->run(200 * kMillisecondUs);
  rig->ask(true, Task::kNone);
  rig->run(any_time(kSecondUs, 2 * kSecondUs));
  check(rig->mode() == EcuMode::kArmed, "not armed before the fault");
  return *rig;
}

template <class Kind>
void Trial<Kind>::check(bool is_right, const std::string& what) {
  if (!is_right) {
    outcome.failures.push_back(what);
  }
}

template <class Kind>
void Trial<Kind>::saw(const std::string& reaction) {
  outcome.seen += (outcome.seen.empty() ? "" : "; ") + reaction;
}

template <class Kind>
unsigned Trial<Kind>::any_of(unsigned count) {
  return static_cast<unsigned>(random.uniform() * count);
}

template <class Kind>
std::uint32_t Trial<Kind>::any_id(const std::vector<std::uint32_t>& ids) {
  return ids[any_of(static_cast<unsigned>(ids.size()))];
}

template <class Kind>
const Sensor& Trial<Kind>::any_sensor(const std::vector<Sensor>& sensors) {
  return sensors[any_of(static_cast<unsigned>(sensors.size()))];
}

template <class Kind>
const dbc::Field& Trial<Kind>::any_field(const Sensor& sensor) {
  const auto count = static_cast<unsigned>(sensor.fields.size());
  return sensor.fields[count == 1 ? 0 : any_of(count)];
}

template <class Kind>
TimeUs Trial<Kind>::any_time(TimeUs least_us, TimeUs most_us) {
  const double cycles = static_cast<double>((most_us - least_us) / kCycle_us + 1);
  return least_us + kCycle_us * static_cast<TimeUs>(random.uniform() * cycles);
}

template <class Kind>
double Trial<Kind>::wanted_mps() const {
  const auto& wanted = rig->record.wanted;
  return wanted.empty() ? 0.0 : wanted.back().speed_mps;
}

template class Trial<Excavator>;
template class Trial<Dozer>;

}  // namespace graben::faults
