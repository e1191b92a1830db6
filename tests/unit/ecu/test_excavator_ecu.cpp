// What the ECU tells its controller of the bus, and what it does about it.

#include "app/ecu/excavator_ecu.hpp"

#include "can_dbc/generated/excavator_dbc.hpp"
#include "platform/loopback/loopback_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/plant/fixture/machine_22t.hpp"

namespace {

using namespace graben;
namespace bus = dbc::excavator;

constexpr TimeUs kCycleUs = 10'000;

// A port that does what it is told and says what was done to it.
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
    for (; count < capacity && pending > 0; ++count, --pending) {
      frames[count] = CanFrame{};
      frames[count].id = bus::BoomStroke::kId;  // without data: counted once it is looked at
    }
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    if (frame.id == bus::EcuHealth::kId) {
      health = bus::EcuHealth::decode(frame.data);
    }
    return frame.id == bus::SpoolCommand::kId ? takes_commands : takes_others;
  }
  [[nodiscard]] CanPortState state() const override { return shown; }

  CanPortState shown = CanPortState::kActive;
  bool opens = true;
  bool takes_commands = true;
  bool takes_others = true;
  int pending = 0;
  int opened = 0;
  bus::EcuHealth health;
};

struct Rig {
  Port port;
  ecu::ExcavatorEcu ecu{plant::machine_22t().machine, 0x1234, port};
  TimeUs now = 0;

  const LinkInputs& step() {
    ecu.step(now, 0);
    now += kCycleUs;
    return ecu.inputs().link;
  }
};

void the_ports_state_is_the_buss(void**) {
  const std::pair<CanPortState, BusState> states[] = {
      {CanPortState::kActive, BusState::kActive}, {CanPortState::kErrorPassive, BusState::kPassive},
      {CanPortState::kBusOff, BusState::kOff},    {CanPortState::kDown, BusState::kDown},
      {CanPortState::kClosed, BusState::kDown},
  };
  for (const auto& [shown, expected] : states) {
    Rig rig;
    rig.port.shown = shown;
    assert_int_equal(rig.step().bus, expected);
    const bool away = expected == BusState::kOff || expected == BusState::kDown;
    assert_int_equal(rig.port.opened, away ? 1 : 0);
  }
}

void a_port_that_is_down_is_tried_every_200_ms(void**) {
  Rig rig;
  assert_int_equal(rig.step().bus, BusState::kActive);
  rig.port.shown = CanPortState::kDown;
  rig.port.opens = false;
  for (int cycle = 0; cycle < 41; ++cycle) {
    assert_int_equal(rig.step().bus, BusState::kDown);
    assert_int_equal(rig.port.opened, 1 + cycle / 20);
  }
  rig.port.opens = true;
  for (int cycle = 0; cycle < 20; ++cycle) {
    assert_int_equal(rig.step().bus, BusState::kDown);
  }
  assert_int_equal(rig.port.opened, 4);
  assert_int_equal(rig.step().bus, BusState::kActive);
  rig.step();
  assert_int_equal(rig.port.opened, 4);
}

// Back by itself: what queued up meanwhile is thrown away at once.
void a_port_that_comes_back_is_flushed(void**) {
  Rig rig;
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
void a_short_bus_off_is_seen(void**) {
  Rig rig;
  rig.step();
  rig.port.shown = CanPortState::kBusOff;
  assert_int_equal(rig.step().bus, BusState::kOff);
  assert_int_equal(rig.step().bus, BusState::kActive);
}

void commands_that_are_not_taken_are_counted(void**) {
  Rig rig;
  rig.step();
  rig.port.takes_others = false;  // only the command counts
  assert_int_equal(rig.step().dropped_cycles, 0);
  assert_int_equal(rig.step().dropped_cycles, 0);
  assert_true(rig.ecu.dropped() > 0);
  rig.port.takes_others = true;
  rig.port.takes_commands = false;
  const std::uint32_t before = rig.ecu.dropped();
  assert_int_equal(rig.step().dropped_cycles, 0);
  assert_int_equal(rig.step().dropped_cycles, 1);
  rig.port.takes_commands = true;
  assert_int_equal(rig.step().dropped_cycles, 2);
  assert_int_equal(rig.step().dropped_cycles, 0);
  assert_int_equal(rig.ecu.dropped(), before + 2);
}

void the_process_is_told_of(void**) {
  Rig rig;
  assert_false(rig.step().stop_requested);
  rig.port.takes_commands = false;
  rig.step();
  rig.port.takes_commands = true;
  rig.ecu.set_process_health({1, 2, 3, true});
  rig.ecu.request_stop();
  for (int cycle = 0; cycle < 10; ++cycle) {
    assert_true(rig.step().stop_requested);
  }
  assert_int_equal(rig.port.health.allocations.value, 1);
  assert_int_equal(rig.port.health.page_faults.value, 2);
  assert_int_equal(rig.port.health.overruns.value, 3);
  assert_int_equal(rig.port.health.dropped_frames.value, 1);
  assert_int_equal(rig.port.health.real_time.value, bus::EcuHealth::RealTime::kOn);
}

CanFrame stroke_frame(std::uint8_t counter, std::uint32_t raw) {
  CanFrame frame;
  frame.id = bus::BoomStroke::kId;
  frame.length = 8;
  frame.data = bus::BoomStroke{}.encode();
  dbc::insert(frame.data, 16, 16, raw);
  e2e_protect(frame.data, bus::BoomStroke::kDataId, counter);
  return frame;
}

void what_is_wrong_with_frames_reaches_the_controller(void**) {
  LoopbackBus can;
  LoopbackPort& port = can.attach();
  assert_true(port.open());
  ecu::ExcavatorEcu ecu(plant::machine_22t().machine, 0x1234, port);
  TimeUs now = 0;
  const auto step_with = [&](const CanFrame& frame) {
    can.inject(frame);
    ecu.step(now, 0);
    now += kCycleUs;
    return ecu.inputs().link;
  };
  for (std::uint8_t counter = 0; counter < 4; ++counter) {
    assert_false(step_with(stroke_frame(counter, 1000)).out_of_range);
  }
  assert_true(step_with(stroke_frame(4, 0xFAFF)).out_of_range);
  LinkInputs link = step_with(stroke_frame(5, 1000));
  assert_false(link.out_of_range);
  for (int wrong = 0; wrong < 3; ++wrong) {
    assert_true(link.message_faults.empty());
    CanFrame frame = stroke_frame(6, 1000);
    frame.data[2] = static_cast<std::uint8_t>(frame.data[2] ^ 0x10U);
    link = step_with(frame);
  }
  assert_true(link.message_faults.has(Fault::kMessageCorrupt));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_ports_state_is_the_buss),
      cmocka_unit_test(a_port_that_is_down_is_tried_every_200_ms),
      cmocka_unit_test(a_port_that_comes_back_is_flushed),
      cmocka_unit_test(a_short_bus_off_is_seen),
      cmocka_unit_test(commands_that_are_not_taken_are_counted),
      cmocka_unit_test(the_process_is_told_of),
      cmocka_unit_test(what_is_wrong_with_frames_reaches_the_controller),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
