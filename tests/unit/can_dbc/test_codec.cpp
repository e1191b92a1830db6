// Every signal over its whole raw range, against a hand-written table of scales.

#include <cstring>
#include <limits>
#include <type_traits>

#include "can_dbc/generated/excavator_dbc.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace {

using namespace graben::dbc;
namespace bus = graben::dbc::excavator;

// SI value = raw * factor + offset within [min, max].
struct Scale {
  const char* name;
  double factor;
  double offset;
  double min;
  double max;
};

constexpr double kPi = 3.14159265358979323846;
constexpr Scale kScales[] = {
    {"BoomStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"ArmStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"BucketStroke", 0.05e-3, 0.0, 0.0, 3.2},
    {"BoomCapPressure", 1e3, 0.0, 0.0, 64e6},
    {"BoomRodPressure", 1e3, 0.0, 0.0, 64e6},
    {"ArmCapPressure", 1e3, 0.0, 0.0, 64e6},
    {"ArmRodPressure", 1e3, 0.0, 0.0, 64e6},
    {"BucketCapPressure", 1e3, 0.0, 0.0, 64e6},
    {"BucketRodPressure", 1e3, 0.0, 0.0, 64e6},
    {"Pump1Swash", 2e-5, 0.0, 0.0, 1.2},
    {"Pump2Swash", 2e-5, 0.0, 0.0, 1.2},
    {"EngineSpeed", 0.125 * 2.0 * kPi / 60.0, 0.0, 0.0, 8031.875 * 2.0 * kPi / 60.0},
    {"SpeedOverride", 0.005, 0.0, 0.0, 1.0},
    {"BoomDuty", 5e-5, -1.6, -1.0, 1.0},
    {"ArmDuty", 5e-5, -1.6, -1.0, 1.0},
    {"BucketDuty", 5e-5, -1.6, -1.0, 1.0},
    {"BoomSpool", 5e-5, -1.6, -1.0, 1.0},
    {"ArmSpool", 5e-5, -1.6, -1.0, 1.0},
    {"BucketSpool", 5e-5, -1.6, -1.0, 1.0},
    {"Lambda", 2e-5, 0.0, 0.0, 1.0},
    {"BoomWantedVelocity", 1e-4, -3.0, -3.0, 3.4},
    {"ArmWantedVelocity", 1e-4, -3.0, -3.0, 3.4},
    {"BucketWantedVelocity", 1e-4, -3.0, -3.0, 3.4},
    {"Pump1ExpectedPressure", 2e3, 0.0, 0.0, 128e6},
    {"Pump2ExpectedPressure", 2e3, 0.0, 0.0, 128e6},
    {"PathError", 1e-4, 0.0, 0.0, 6.4},
};

const Scale& scale_of(const char* name) {
  for (const Scale& scale : kScales) {
    if (std::strcmp(scale.name, name) == 0) {
      return scale;
    }
  }
  fail_msg("no scale for %s", name);
  return kScales[0];
}

// Calls check(message, field, signal) for each signal of each message; `message` is a filled-in
// default that check may change.
template <class Message, class Check>
void for_signals(Check check) {
  Message message;
  Message::visit(message, [&](const Field& field, auto& signal) {
    const auto initial = signal;
    check(message, field, signal);
    signal = initial;
  });
}

template <class Check, class... Messages>
void for_all(MessageList<Messages...>, Check check) {
  (for_signals<Messages>(check), ...);
}

// Hashes, bit fields and the parts of a trouble code use their whole width.
bool has_specials(const Field& field) {
  for (const char* name : {"ProfileHash", "WhyNotArmed", "SpnLow", "SpnHigh", "Fmi",
                           "OccurrenceCount", "ConversionMethod"}) {
    if (std::strcmp(field.name, name) == 0) {
      return false;
    }
  }
  return true;
}

// The J1939 ranges, told without the generated constants.
RawState j1939_state(const Field& field, std::uint32_t raw) {
  if (!has_specials(field)) {
    return RawState::kValid;
  }
  const std::uint32_t top = field.width == 16 ? raw >> 8U : raw;
  const std::uint32_t not_available = field.width >= 8 ? 0xFFU : (1U << field.width) - 1U;
  if (top == not_available) {
    return RawState::kNotAvailable;
  }
  return top == not_available - 1U ? RawState::kError : RawState::kValid;
}

template <class Message>
auto decoded(const Field& wanted, std::uint32_t raw, Payload& payload) {
  payload.fill(0xFF);
  insert(payload, wanted.start_bit, wanted.width, raw);
  return Message::decode(payload);
}

void check_value(const Field& field, std::uint32_t raw, const Physical& signal) {
  const Scale& scale = scale_of(field.name);
  const double expected = raw * scale.factor + scale.offset;
  const bool inside =
      expected >= scale.min - 1e-9 * scale.max && expected <= scale.max * (1 + 1e-9);
  RawState state = j1939_state(field, raw);
  if (state == RawState::kValid && !inside) {
    state = RawState::kOutOfRange;
  }
  assert_int_equal(signal.state, state);
  assert_near(signal.value, state == RawState::kValid ? expected : 0.0, 1e-12 * scale.max);
}

template <class Plain>
void check_value(const Field& field, std::uint32_t raw, const Plain& signal) {
  if (j1939_state(field, raw) != RawState::kValid) {
    assert_int_equal(signal.state, j1939_state(field, raw));
    assert_int_equal(static_cast<std::uint32_t>(signal.value), 0);
  } else if (signal.state == RawState::kValid) {
    assert_int_equal(static_cast<std::uint32_t>(signal.value), raw);
  } else {
    assert_int_equal(signal.state, RawState::kOutOfRange);
    assert_true(raw > field.raw_max);
  }
}

void every_raw_value(void**) {
  int signals = 0;
  for_all(bus::AllMessages{}, [&](auto& message, const Field& field, auto&) {
    using Message = std::remove_reference_t<decltype(message)>;
    ++signals;
    const std::uint64_t end = std::uint64_t{1} << field.width;
    const std::uint64_t step = field.width == 32 ? 65521 : 1;
    for (std::uint64_t raw64 = 0; raw64 < end; raw64 += step) {
      const auto raw = static_cast<std::uint32_t>(raw64);
      Payload payload{};
      const Message read = decoded<Message>(field, raw, payload);
      Message::visit(read, [&](const Field& other, const auto& signal) {
        if (std::strcmp(other.name, field.name) == 0) {
          check_value(field, raw, signal);
          if (signal.state == RawState::kValid) {
            // All other bits are 1, as 'not available' and unused bits are: nothing else may
            // change.
            assert_memory_equal(read.encode().data(), payload.data(), payload.size());
          }
        }
      });
    }
  });
  assert_int_equal(signals, 59);
}

template <class Message>
std::uint32_t sent(const Message& message, const Field& field) {
  return extract(message.encode(), field.start_bit, field.width);
}

void saturates_and_refuses(void**) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for_all(bus::AllMessages{}, [&](auto& message, const Field& field, auto& signal) {
    const std::uint32_t error = field.width == 16 ? 0xFEFFU : (1U << (field.width % 32)) - 2U;
    const std::uint32_t not_available = field.width == 16 ? 0xFFFFU : error + 1U;
    const bool has_special = has_specials(field);
    signal.state = RawState::kError;
    assert_int_equal(sent(message, field), has_special ? error : field.start_raw);
    signal.state = RawState::kOutOfRange;
    assert_int_equal(sent(message, field), has_special ? error : field.start_raw);
    signal.state = RawState::kNotAvailable;
    assert_int_equal(sent(message, field), has_special ? not_available : field.start_raw);
    signal.state = RawState::kValid;
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(signal)>, Physical>) {
      const Scale& scale = scale_of(field.name);
      const auto low =
          static_cast<std::uint32_t>(std::lround((scale.min - scale.offset) / scale.factor));
      const auto high =
          static_cast<std::uint32_t>(std::lround((scale.max - scale.offset) / scale.factor));
      for (const double beyond : {scale.max, scale.max * 1.0001, 1e9 * scale.max, 1.7e308}) {
        signal.value = beyond;
        assert_int_equal(sent(message, field), high);
      }
      for (const double beyond :
           {scale.min, scale.min - scale.factor, -1e9 * scale.max, -1.7e308}) {
        signal.value = beyond;
        assert_int_equal(sent(message, field), low);
      }
      for (const double no_value : {kNan, kInfinity, -kInfinity}) {
        signal.value = no_value;
        assert_int_equal(sent(message, field), error);
      }
      // Nearest, not truncated.
      signal.value = (low + 100.4) * scale.factor + scale.offset;
      assert_int_equal(sent(message, field), low + 100U);
      signal.value = (low + 100.6) * scale.factor + scale.offset;
      assert_int_equal(sent(message, field), low + 101U);
    }
  });
}

void plain_numbers(void**) {
  bus::EcuStatus status;
  status.rejected_frames.value = 100000;
  assert_int_equal(sent(status, bus::EcuStatus::kRejectedFrames), 250);
  status.limit_index.value = 251;
  assert_int_equal(sent(status, bus::EcuStatus::kLimitIndex), 250);
  status.fault.value = static_cast<bus::EcuStatus::Fault>(bus::EcuStatus::kFault.raw_max + 1);
  assert_int_equal(sent(status, bus::EcuStatus::kFault), 0xFE);
  status.mode.value = bus::EcuStatus::Mode::kFault;
  assert_int_equal(sent(status, bus::EcuStatus::kMode), 5);
  const bus::EcuIdentity identity{{0xDEADBEEFU, RawState::kValid}, {1U, RawState::kValid}};
  const Payload expected{0xEF, 0xBE, 0xAD, 0xDE, 0x01, 0xFF, 0xFF, 0xFF};
  assert_memory_equal(identity.encode().data(), expected.data(), expected.size());
}

// Positions, byte for byte, as the DBC gives them.
void known_payloads(void**) {
  const Payload neutral{0xFF, 0x0F, 0x00, 0x7D, 0x00, 0x7D, 0x00, 0x7D};
  assert_memory_equal(bus::SpoolCommand{}.encode().data(), neutral.data(), neutral.size());

  bus::SpoolCommand command;
  command.enable.value = bus::SpoolCommand::Enable::kOn;
  command.boom_duty_ratio.value = 1.0;
  command.arm_duty_ratio.value = -1.0;
  command.bucket_duty_ratio.value = 0.00005;
  const Payload moving{0xFF, 0x1F, 0x20, 0xCB, 0xE0, 0x2E, 0x01, 0x7D};
  assert_memory_equal(command.encode().data(), moving.data(), moving.size());

  command = {};
  command.pilot_cut.value = bus::SpoolCommand::PilotCut::kOn;
  const Payload cut{0xFF, 0x4F, 0x00, 0x7D, 0x00, 0x7D, 0x00, 0x7D};
  assert_memory_equal(command.encode().data(), cut.data(), cut.size());

  const bus::EEC1 engine = bus::EEC1::decode({0xFF, 0xFF, 0xFF, 0x80, 0x3E, 0xFF, 0xFF, 0xFF});
  assert_near(engine.engine_speed_radps.value, 2000.0 * 2.0 * kPi / 60.0, 1e-9);

  const bus::OperatorCommand driver =
      bus::OperatorCommand::decode({0x00, 0xD0, 0xF1, 0x01, 0x64, 0xFF, 0xFF, 0xFF});
  assert_int_equal(driver.enable.value, bus::OperatorCommand::Enable::kOn);
  assert_int_equal(driver.operator_mode.value, bus::OperatorCommand::OperatorMode::kAutomatic);
  assert_int_equal(driver.task.value, bus::OperatorCommand::Task::kDig);
  assert_near(driver.speed_override_ratio.value, 0.5, 0.0);

  // J1939-73, version 4: red stop lamp, SPN 520192 + 12 = 0x7F00C, FMI 19, third time; lamp bytes,
  // SPN low byte first, its high bits above the FMI, conversion method 0 above the count.
  bus::DM1 trouble;
  trouble.red_stop_lamp.value = bus::DM1::RedStopLamp::kOn;
  trouble.spn_low.value = 0xF00C;
  trouble.spn_high.value = 7;
  trouble.fmi.value = 19;
  trouble.occurrence_count.value = 3;
  const Payload dm1{0x10, 0xFF, 0x0C, 0xF0, 0xF3, 0x03, 0xFF, 0xFF};
  assert_memory_equal(trouble.encode().data(), dm1.data(), dm1.size());
  const Payload no_trouble{0x00, 0xFF, 0x00, 0x00, 0x00, 0x00, 0xFF, 0xFF};
  assert_memory_equal(bus::DM1{}.encode().data(), no_trouble.data(), no_trouble.size());

  // Neutral and full scale are exact: 0 is neutral, and a ratio of 1 is not above 1.
  const bus::SpoolCommand back = bus::SpoolCommand::decode(moving);
  assert_true(back.boom_duty_ratio.value == 1.0);
  assert_true(back.arm_duty_ratio.value == -1.0);
  assert_true(bus::SpoolCommand::decode(neutral).boom_duty_ratio.value == 0.0);
}

void start_values(void**) {
  assert_int_equal(bus::BoomStroke{}.boom_stroke_m.state, RawState::kNotAvailable);
  assert_int_equal(bus::SpoolCommand{}.enable.value, bus::SpoolCommand::Enable::kOff);
  assert_int_equal(bus::SpoolCommand{}.pilot_cut.value, bus::SpoolCommand::PilotCut::kOff);
  assert_int_equal(bus::PumpCommand{}.pump1_swash_ratio.state, RawState::kNotAvailable);
  assert_int_equal(bus::ValveState{}.enabled.state, RawState::kNotAvailable);
  assert_int_equal(bus::EcuHealth{}.real_time.value, bus::EcuHealth::RealTime::kOff);
  assert_int_equal(bus::OperatorCommand{}.enable.value, bus::OperatorCommand::Enable::kOff);
  for_all(bus::AllMessages{}, [](auto& message, const Field& field, auto&) {
    assert_int_equal(sent(message, field), field.start_raw);
  });
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_raw_value), cmocka_unit_test(saturates_and_refuses),
      cmocka_unit_test(plain_numbers),   cmocka_unit_test(known_payloads),
      cmocka_unit_test(start_values),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
