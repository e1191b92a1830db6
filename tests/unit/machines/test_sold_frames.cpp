// SPDX-License-Identifier: Apache-2.0
// Bus profiles of parts off the shelf: frames as standards and data sheets print them, read by the
// shipped tables, and what these send.

#include "app/machines/bus_file.hpp"
#include "firmware/numeric/constants.hpp"
#include "hal/buses/excavator_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"

constexpr TimeUs kNow = 5 * kSecondUs;
constexpr TimeUs kPeriod = 10 * kMillisecondUs;
constexpr double kDegree_rad = kPi / 180.0;

CanFrame frame_of(std::uint32_t id, std::uint8_t length, const dbc::Payload& data) {
  CanFrame frame;
  frame.id = id;
  frame.extended = id > 0x7FF;
  frame.length = length;
  frame.data = data;
  return frame;
}

struct Bus {
  explicit Bus(const char* name)
      : file(machines::load_bus(machines::find_bus(name))),
        receiver(with_table({}, &file.table)),
        transmitter(with_table({}, &file.table)) {}

  void take(std::uint32_t id, std::uint8_t length, const dbc::Payload& data) {
    receiver.accept(frame_of(id, length, data), now);
  }
  void pass() {
    receiver.finish(now);
    now += kPeriod;
  }
  [[nodiscard]] const Signal<double>& joint(std::size_t axis) const {
    return receiver.inputs().joint_rad[axis];
  }
  /// The frame of this id that is sent of the duties.
  [[nodiscard]] CanFrame sent(std::uint32_t id) {
    ExcavatorTransmitter::Frames frames;
    for (int cycle = 0; cycle < 10; ++cycle) {
      const int count = transmitter.frames(outputs, {}, now, frames);
      now += kPeriod;
      for (int i = 0; i < count; ++i) {
        if (frames[static_cast<unsigned>(i)].id == id) {
          return frames[static_cast<unsigned>(i)];
        }
      }
    }
    fail_msg("no frame %x", id);
    return {};
  }

  machines::BusFile file;
  ExcavatorReceiver receiver;
  ExcavatorTransmitter transmitter;
  ExcavatorOutputs outputs;
  TimeUs now = kNow;
};

/// Honeywell TARS-LCASS user manual, 32332897 issue B, 7.2: level, functional, 2.5 ms old, from E2.
constexpr dbc::Payload kLevel{0x00, 0x00, 0x7D, 0x00, 0x00, 0x7D, 0x00, 0x05};

/// A pitch by the formula of its table 8, (uint32 - 8192000) / 32768 degrees.
dbc::Payload pitched(unsigned raw) {
  dbc::Payload data = kLevel;
  for (unsigned n = 0; n < 3; ++n) {
    data[n] = static_cast<std::uint8_t>(raw >> (8 * n));
  }
  return data;
}

void slopes(Bus& bus, const dbc::Payload& arm) {
  bus.take(0x0CF029E2, 8, pitched(8192000 + 30 * 32768));
  bus.take(0x0CF029E3, 8, arm);
  bus.take(0x0CF029E4, 8, pitched(8192000 - 170 * 32768));
  bus.take(0x0CF029E5, 8, pitched(8192000 + 1 * 32768));
  bus.pass();
}

TEST(slopes_become_joint_angles) {
  Bus bus("slopes");
  assert_true(bus.file.capabilities.joint_angles);
  bus.take(0x0CF029E2, 8, kLevel);
  bus.take(0x0CF029E5, 8, kLevel);
  bus.pass();
  assert_near(bus.joint(0).value, 0.0, 1e-9);
  assert_true(bus.joint(0).validity == Validity::kValid);
  assert_true(bus.joint(1).validity == Validity::kNotReceived);
  bus.now += kSecondUs;
  bus.pass();  // Silent: what comes now is new.
  slopes(bus, pitched(8192000 - 60 * 32768));
  assert_near(bus.joint(0).value, 29.0 * kDegree_rad, 1e-8);
  assert_near(bus.joint(1).value, -90.0 * kDegree_rad, 1e-8);
  assert_near(bus.joint(2).value, -110.0 * kDegree_rad, 1e-8);
}

/// The shorter way round, and the one turn that a joint can have.
TEST(a_slope_goes_over_the_top) {
  Bus bus("slopes");
  slopes(bus, pitched(8192000 - 60 * 32768));
  for (const int degree : {-173, -176, -179, 178, 175}) {
    bus.take(0x0CF029E2, 8, pitched(8192000 + 30 * 32768));
    bus.take(0x0CF029E3, 8, pitched(8192000 - 60 * 32768));
    bus.take(0x0CF029E4, 8, pitched(static_cast<unsigned>(8192000 + degree * 32768)));
    bus.pass();
    const int turned = degree > 0 ? degree - 360 : degree;
    assert_near(bus.joint(2).value, (turned + 60) * kDegree_rad, 1e-6);
    assert_true(bus.joint(2).validity == Validity::kValid);
  }
}

/// FE and FF in the top byte, 1 degraded and 2 error in the figure of merit, 125 ms of latency.
TEST(a_slope_that_says_it_is_none) {
  const dbc::Payload good = pitched(8192000 - 60 * 32768);
  const auto with = [&good](std::size_t byte, std::uint8_t value) {
    dbc::Payload data = good;
    data[byte] = value;
    return data;
  };
  const struct {
    dbc::Payload data;
    Validity validity;
  } cases[] = {{good, Validity::kValid},
               {with(2, 0xFE), Validity::kError},
               {with(2, 0xFF), Validity::kNotAvailable},
               {with(6, 0x04), Validity::kError},
               {with(6, 0x08), Validity::kError},
               {with(6, 0x0C), Validity::kValid},
               {with(7, 250), Validity::kError},
               {with(7, 255), Validity::kValid}};
  for (const auto& each : cases) {
    Bus bus("slopes");
    slopes(bus, each.data);
    assert_int_equal(bus.joint(0).validity, Validity::kValid);
    assert_int_equal(bus.joint(1).validity, each.validity);
    assert_int_equal(bus.joint(2).validity, each.validity);
  }
}

/// A position as Pepperl+Fuchs prints one, 7200 steps: 20 1C 00 00 (Absolute Rotary Encoder,
/// CANopen manual 2017-04, table 7.10), under the identifier that CiA 301 gives TPDO1.
TEST(an_encoders_position) {
  Bus bus("encoders");
  bus.take(0x701, 1, {0x05});
  bus.take(0x181, 4, {0x20, 0x1C, 0x00, 0x00});
  bus.pass();
  assert_near(bus.receiver.inputs().axis[0].stroke_m.value, 0.072, 1e-12);
  bus.take(0x181, 4, {0xFF, 0xFF, 0xFF, 0xFF});
  bus.pass();
  assert_true(bus.receiver.inputs().axis[0].stroke_m.validity == Validity::kError);
}

/// Integer 16, 0.01 degree a step: SICK TMM61 operating instructions, table 35; two's complement.
TEST(an_inclinometers_slope) {
  Bus bus("inclinometers");
  for (unsigned node = 17; node <= 20; ++node) {
    bus.take(0x700 + node, 1, {0x05});
  }
  bus.take(0x191, 4, {0xB8, 0x0B, 0x00, 0x00});  // 3000
  bus.take(0x192, 4, {0x90, 0xE8, 0x00, 0x00});  // -6000
  bus.take(0x193, 4, {0x98, 0xBD, 0x00, 0x00});  // -17000
  bus.take(0x194, 4, {0x64, 0x00, 0x00, 0x00});  // 100
  bus.pass();
  assert_near(bus.joint(0).value, 29.0 * kDegree_rad, 1e-8);
  assert_near(bus.joint(1).value, -90.0 * kDegree_rad, 1e-8);
  assert_near(bus.joint(2).value, -110.0 * kDegree_rad, 1e-8);
}

/// ISO 11783-7, B.13 and A.21.10 to A.21.12: flow 0.4 % a step in byte 1; in byte 3 the state, 0
/// block, 1 extend, 2 retract, in bits 1 to 4, bits 5 and 6 reserved, the fail-safe mode, 0 block,
/// in bits 7 and 8; all else reserved, which is 1.
TEST(an_auxiliary_valves_command) {
  Bus bus("aux_valves");
  const auto assert_sent = [&bus](double duty_ratio, std::uint8_t flow, std::uint8_t third) {
    bus.outputs.duty_ratio[1] = duty_ratio;
    const CanFrame frame = bus.sent(0x0CFE3182);
    const dbc::Payload wanted{flow, 0xFF, third, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};
    assert_memory_equal(frame.data.data(), wanted.data(), wanted.size());
    assert_int_equal(frame.length, 8);
  };
  assert_sent(0.5, 0, 0x30);  // Not enabled.
  bus.outputs.enable = true;
  assert_sent(0.0, 0, 0x30);
  assert_sent(0.5, 125, 0x31);
  assert_sent(1.0, 250, 0x31);
  assert_sent(-0.2, 50, 0x32);
}

TEST(a_solenoids_current) {
  Bus bus("valve_driver");
  const auto assert_sent = [&bus](double duty_ratio, unsigned extend_ma, unsigned retract_ma) {
    bus.outputs.duty_ratio[0] = duty_ratio;
    const CanFrame frame = bus.sent(0x0CFF4082);
    assert_int_equal(frame.data[0] | frame.data[1] << 8, extend_ma);
    assert_int_equal(frame.data[2] | frame.data[3] << 8, retract_ma);
    assert_int_equal(frame.data[4] | frame.data[5] << 8, 120);
    assert_int_equal(frame.data[6], bus.outputs.enable ? 0xFF : 0xFE);
  };
  assert_sent(0.5, 0, 0);
  bus.outputs.enable = true;
  assert_sent(0.0, 0, 0);
  assert_sent(0.002, 251, 0);
  assert_sent(0.5, 500, 0);
  assert_sent(-1.0, 0, 750);
}

TEST(a_retrofit_is_complete) {
  Bus bus("retrofit");
  assert_int_equal(bus.file.table.bus_count, 2);
  assert_false(bus.file.table.own_frames);
  assert_false(bus.file.capabilities.identity || bus.file.capabilities.valve_echo ||
               bus.file.capabilities.spool_feedback || bus.file.capabilities.protection);
  bus.take(0x721, 1, {0x05});
  bus.take(0x1A1, 3, {0xDC, 0x05, 0x00});  // 1500: 150 bar.
  bus.pass();
  assert_near(bus.receiver.inputs().axis[0].cap_pressure_pa.value, 15e6, 1e-3);
  bus.take(0x1A1, 3, {0xDC, 0x05, 0x01});
  bus.pass();
  assert_true(bus.receiver.inputs().axis[0].cap_pressure_pa.validity == Validity::kError);
}
