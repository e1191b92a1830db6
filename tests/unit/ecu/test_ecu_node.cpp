// SPDX-License-Identifier: Apache-2.0
// What the ECU tells its controller of the bus, and what it does about it.

#include <algorithm>
#include <vector>

#include "app/ecu/dozer_kind.hpp"
#include "app/ecu/excavator_kind.hpp"
#include "app/machines/dozer_file.hpp"
#include "app/machines/excavator_file.hpp"
#include "can_dbc/generated/dozer_dbc.hpp"
#include "can_dbc/generated/excavator_dbc.hpp"
#include "platform/loopback/loopback_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machines.hpp"

struct Excavator {
  using Ecu = ecu::ExcavatorKind::Ecu;
  using Stroke = dbc::excavator::BoomStroke;
  using EcuHealth = dbc::excavator::EcuHealth;
  using MachineIdentity = dbc::excavator::MachineIdentity;
  static constexpr std::uint8_t kDbcVersion = dbc::excavator::kDbcVersion;
  static std::vector<std::uint32_t> commands() { return {dbc::excavator::SpoolCommand::kId}; }
  static ExcavatorProfile profile() { return plant::machine_22t().machine; }
};

// With a swing drive.
struct ExcavatorWithSwing : Excavator {
  static std::vector<std::uint32_t> commands() {
    return {dbc::excavator::SpoolCommand::kId, dbc::excavator::SwingCommand::kId};
  }
  static ExcavatorProfile profile() {
    return machines::load_excavator(machines::find_profile("excavator_12t")).profile;
  }
};

struct Dozer {
  using Ecu = ecu::DozerKind::Ecu;
  using Stroke = dbc::dozer::BladeStroke;
  using EcuHealth = dbc::dozer::EcuHealth;
  using MachineIdentity = dbc::dozer::MachineIdentity;
  static constexpr std::uint8_t kDbcVersion = dbc::dozer::kDbcVersion;
  static std::vector<std::uint32_t> commands() {
    return {dbc::dozer::SpoolCommand::kId, dbc::dozer::PumpDisplacementCommand::kId,
            dbc::dozer::MotorDisplacementCommand::kId};
  }
  static DozerProfile profile() {
    return machines::load_dozer(machines::find_profile("dozer_9t")).profile;
  }
};

constexpr TimeUs kCycleUs = 10'000;

// A port that does what it is told and says what was done to it.
template <class Kind>
class Port final : public CanPort {
 public:
  [[nodiscard]] bool open() override {
    ++opened;
    pending = 0;
    if (opens) {
      shown = CanPortState::kActive;
    }
    return opens;
  }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    int count = 0;
    shown = comes_back ? CanPortState::kActive : shown;
    for (; count < capacity && pending > 0; ++count, --pending) {
      frames[count] = CanFrame{};
      frames[count].id = Kind::Stroke::kId;  // without data: counted once it is looked at
    }
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    if (frame.id == Kind::EcuHealth::kId) {
      health = Kind::EcuHealth::decode(frame.data);
    }
    const auto commands = Kind::commands();
    const bool is_command = std::count(commands.begin(), commands.end(), frame.id) > 0;
    sent.insert(sent.end(), is_command ? 1U : 0U, frame);
    return is_command ? frame.id != refused_command : takes_others;
  }
  [[nodiscard]] CanPortState state() const override { return shown; }

  CanPortState shown = CanPortState::kActive;
  bool opens = true;
  bool comes_back = false;  // with the frame that is read next
  std::uint32_t refused_command = 0;
  bool takes_others = true;
  int pending = 0;
  int opened = 0;
  std::vector<CanFrame> sent;  // commands
  typename Kind::EcuHealth health;
};

template <class Kind>
struct Rig {
  Port<Kind> port;
  typename Kind::Ecu ecu{Kind::profile(), 0x1234, port};
  TimeUs now = 0;

  const LinkInputs& step() {
    ecu.step(now, 0);
    now += kCycleUs;
    return ecu.inputs().link;
  }
};

TEST_FOR_EACH(the_ports_state_is_the_buss, Kind, Excavator, Dozer) {
  const std::pair<CanPortState, BusState> states[] = {
      {CanPortState::kActive, BusState::kActive}, {CanPortState::kErrorPassive, BusState::kPassive},
      {CanPortState::kBusOff, BusState::kOff},    {CanPortState::kDown, BusState::kDown},
      {CanPortState::kClosed, BusState::kDown},
  };
  for (const auto& [shown, expected] : states) {
    Rig<Kind> rig;
    rig.port.shown = shown;
    assert_int_equal(rig.step().bus, expected);
    const bool away = expected == BusState::kOff || expected == BusState::kDown;
    assert_int_equal(rig.port.opened, away ? 1 : 0);
  }
}

TEST_FOR_EACH(a_port_that_is_down_is_tried_every_200_ms, Kind, Excavator, Dozer) {
  Rig<Kind> rig;
  assert_int_equal(rig.step().bus, BusState::kActive);
  rig.port.shown = CanPortState::kDown;
  rig.port.opens = false;
  for (int cycle = 0; cycle < 41; ++cycle) {
    assert_int_equal(rig.step().bus, BusState::kDown);
    assert_int_equal(rig.port.opened, 1 + cycle / 20);
  }
  rig.port.opens = true;
  repeat(20, [&] { assert_int_equal(rig.step().bus, BusState::kDown); });
  assert_int_equal(rig.port.opened, 4);
  assert_int_equal(rig.step().bus, BusState::kActive);
  rig.step();
  assert_int_equal(rig.port.opened, 4);
}

// Back by itself: what queued up meanwhile is thrown away at once.
TEST_FOR_EACH(a_port_that_comes_back_is_flushed, Kind, Excavator, Dozer) {
  Rig<Kind> rig;
  rig.step();
  rig.port.shown = CanPortState::kBusOff;
  rig.port.opens = false;
  rig.step();
  rig.step();
  rig.port.shown = CanPortState::kActive;
  rig.port.opens = true;
  rig.port.pending = 5;
  assert_int_equal(rig.step().bus, BusState::kActive);
  assert_int_equal(rig.port.opened, 2);
  assert_int_equal(rig.ecu.link().wrong_length, 0);
  rig.port.pending = 5;
  rig.step();
  assert_int_equal(rig.port.opened, 2);
  assert_int_equal(rig.ecu.link().wrong_length, 5);
}

// Bus-off that the first try ends is seen all the same.
TEST_FOR_EACH(a_short_bus_off_is_seen, Kind, Excavator, Dozer) {
  Rig<Kind> rig;
  rig.step();
  rig.port.shown = CanPortState::kBusOff;
  assert_int_equal(rig.step().bus, BusState::kOff);
  assert_int_equal(rig.step().bus, BusState::kActive);
}

// Reading the port may end what it was; it is seen all the same.
TEST_FOR_EACH(a_state_that_reading_ends_is_seen, Kind, Excavator, Dozer) {
  Rig<Kind> rig;
  rig.step();
  rig.port.shown = CanPortState::kErrorPassive;
  rig.port.comes_back = true;
  assert_int_equal(rig.step().bus, BusState::kPassive);
  assert_int_equal(rig.step().bus, BusState::kActive);
}

// What queued up through a stall is old, be it read or be it left for the next cycle.
TEST_FOR_EACH(a_stall_throws_away_what_queued_up, Kind, Excavator, Dozer) {
  Rig<Kind> rig;
  rig.now = kSecondUs;  // the first cycle follows none, whatever the clock says
  rig.step();
  assert_int_equal(rig.port.opened, 0);
  rig.now += 5 * kCycleUs;
  rig.port.pending = 5;
  rig.step();
  assert_int_equal(rig.ecu.link().wrong_length, 0);
  assert_int_equal(rig.port.opened, 1);
  rig.port.pending = 5;
  rig.step();
  assert_int_equal(rig.ecu.link().wrong_length, 5);
  assert_int_equal(rig.port.opened, 1);
}

// Nothing is left to be taken for fresh in the next cycle until the port holds more than it should.
TEST_FOR_EACH(what_a_cycle_reads_is_bounded, Kind, Excavator, Dozer) {
  constexpr int kTaken = 2 * 96;
  constexpr int kRead = 4 * 96;
  Rig<Kind> rig;
  rig.step();
  rig.port.pending = kRead;
  rig.step();
  assert_int_equal(rig.port.pending, 0);
  assert_int_equal(rig.ecu.link().wrong_length, kTaken);
  rig.port.pending = kRead + 10;
  rig.step();
  assert_int_equal(rig.port.pending, 10);
  assert_int_equal(rig.ecu.link().wrong_length, 2 * kTaken);
  rig.step();
  assert_int_equal(rig.port.pending, 0);
  assert_int_equal(rig.ecu.link().wrong_length, 2 * kTaken + 10);
}

// A cycle counts as dropped if any of its commands was not taken; other frames do not count.
TEST_FOR_EACH(commands_that_are_not_taken_are_counted, Kind, Excavator, Dozer, ExcavatorWithSwing) {
  for (const std::uint32_t command : Kind::commands()) {
    Rig<Kind> rig;
    rig.step();
    rig.port.takes_others = false;
    assert_int_equal(rig.step().dropped_cycles, 0);
    assert_int_equal(rig.step().dropped_cycles, 0);
    assert_true(rig.ecu.dropped() > 0);
    rig.port.takes_others = true;
    rig.port.refused_command = command;
    const std::uint32_t before = rig.ecu.dropped();
    assert_int_equal(rig.step().dropped_cycles, 0);
    assert_int_equal(rig.step().dropped_cycles, 1);
    rig.port.refused_command = 0;
    assert_int_equal(rig.step().dropped_cycles, 2);
    assert_int_equal(rig.step().dropped_cycles, 0);
    assert_int_equal(rig.ecu.dropped(), before + 2);
  }
}

// A controller that hears nothing sends neutral: what one cycle leaves is what the next one sends.
TEST_FOR_EACH(a_cycle_leaves_the_neutral_frames_that_come_next, Kind, Excavator, Dozer,
              ExcavatorWithSwing) {
  Rig<Kind> rig;
  ecu::LastFrames last;
  rig.ecu.set_last_frames(last);
  for (int cycle = 0; cycle < 20; ++cycle) {
    const ecu::LastFrames::Frames left = last.get();
    rig.port.sent.clear();
    rig.step();
    assert_true(cycle == 0 || left.count == Kind::commands().size());
    for (std::size_t i = 0; i < left.count; ++i) {
      const CanFrame& sent = rig.port.sent.at(i);
      assert_true(left.frame[i].id == sent.id && left.frame[i].data == sent.data);
    }
  }
}

TEST_FOR_EACH(the_process_is_told_of, Kind, Excavator, Dozer) {
  Rig<Kind> rig;
  assert_false(rig.step().stop_requested);
  rig.port.refused_command = Kind::commands().front();
  rig.step();
  rig.port.refused_command = 0;
  rig.ecu.set_process_health({1, 2, 3, true});
  rig.ecu.request_stop();
  repeat(10, [&] { assert_true(rig.step().stop_requested); });
  assert_int_equal(rig.port.health.allocations.value, 1);
  assert_int_equal(rig.port.health.page_faults.value, 2);
  assert_int_equal(rig.port.health.overruns.value, 3);
  assert_int_equal(rig.port.health.dropped_frames.value, 1);
  assert_int_equal(rig.port.health.real_time.value, Kind::EcuHealth::RealTime::kOn);
}

/// A controller of this kind with hash 0x1234 that hears what the test says.
template <class Kind>
struct OnBus {
  LoopbackBus can;
  LoopbackPort& port = can.attach();
  bool opened = port.open();
  typename Kind::Ecu ecu{Kind::profile(), 0x1234, port};
  TimeUs now = 0;

  /// A cycle with all that was said before it.
  const typename Kind::Ecu& step() {
    assert_true(opened);
    ecu.step(now, 0);
    now += kCycleUs;
    return ecu;
  }
  void say_identity(std::uint32_t hash) {
    typename Kind::MachineIdentity identity;
    identity.profile_hash.value = hash;
    identity.dbc_version = {Kind::kDbcVersion, dbc::RawState::kValid};
    CanFrame frame;
    frame.id = Kind::MachineIdentity::kId;
    frame.length = 8;
    frame.data = identity.encode();
    can.inject(frame);
  }
};

template <class Kind>
CanFrame stroke_frame(std::uint8_t counter, std::uint32_t raw) {
  CanFrame frame;
  frame.id = Kind::Stroke::kId;
  frame.length = 8;
  frame.data = typename Kind::Stroke{}.encode();
  dbc::insert(frame.data, 16, 16, raw);
  e2e_protect(frame.data, Kind::Stroke::kDataId, counter);
  return frame;
}

TEST_FOR_EACH(the_machine_has_to_be_ours, Kind, Excavator, Dozer) {
  OnBus<Kind> bus;
  for (const std::uint32_t hash : {0x1234U, 0x4321U}) {
    bus.say_identity(hash);
    const auto& heard = bus.step().inputs().same_machine;
    assert_int_equal(heard.validity, Validity::kValid);
    assert_int_equal(heard.value, hash == 0x1234U);
  }
}

// One that babbles is believed in what it said last.
TEST_FOR_EACH(the_newest_identity_counts, Kind, Excavator, Dozer) {
  OnBus<Kind> bus;
  for (const std::uint32_t last : {0x1234U, 0x4321U}) {
    for (int n = 1; n <= 20; ++n) {
      bus.say_identity(n == 20 ? last : 0x1234U ^ 0x4321U ^ last);
    }
    const auto& inputs = bus.step().inputs();
    assert_int_equal(inputs.same_machine.value, last == 0x1234U);
    assert_true(inputs.link.message_faults.empty());
  }
}

TEST_FOR_EACH(what_is_wrong_with_frames_reaches_the_controller, Kind, Excavator, Dozer) {
  OnBus<Kind> bus;
  const auto step_with = [&](const CanFrame& frame) {
    bus.can.inject(frame);
    return bus.step().inputs().link;
  };
  for (std::uint8_t counter = 0; counter < 4; ++counter) {
    assert_false(step_with(stroke_frame<Kind>(counter, 1000)).out_of_range);
  }
  assert_true(step_with(stroke_frame<Kind>(4, 0xFAFF)).out_of_range);
  LinkInputs link = step_with(stroke_frame<Kind>(5, 1000));
  assert_false(link.out_of_range);
  for (int wrong = 0; wrong < 3; ++wrong) {
    assert_true(link.message_faults.empty());
    CanFrame frame = stroke_frame<Kind>(6, 1000);
    frame.data[2] = static_cast<std::uint8_t>(frame.data[2] ^ 0x10U);
    link = step_with(frame);
  }
  assert_true(link.message_faults.has(Fault::kMessageCorrupt));
}
