// SPDX-License-Identifier: Apache-2.0
// IMUs on links by SAE J1939-71: frames as a data sheet prints them, and what is refused.

#include "firmware/numeric/constants.hpp"
#include "hal/buses/excavator_bus.hpp"
#include "tests/unit/cmocka_cpp.hpp"

namespace bus = dbc::j1939;

constexpr double kDegree_rad = kPi / 180.0;
constexpr TimeUs kNow = 5 * kSecondUs;
constexpr TimeUs kPeriod = 10 * kMillisecondUs;
/// Honeywell TARS-LCASS user manual, 32332897 issue B: examples of 7.2, 7.4 and 7.6, from 0xE2; the
/// accelerations at priority 2, as two makers send them.
constexpr std::uint32_t kSlopeId = 0x0CF029E2;
constexpr dbc::Payload kSlope{0x00, 0x00, 0x7D, 0x00, 0x00, 0x7D, 0x00, 0x05};
constexpr std::uint32_t kRatesId = 0x0CF02AE2;
constexpr dbc::Payload kRates{0x00, 0x7D, 0x00, 0x7D, 0x00, 0x7D, 0x00, 0x05};
constexpr std::uint32_t kForcesId = 0x08F02DE2;
constexpr dbc::Payload kForces{0x00, 0x7D, 0x00, 0x7D, 0xD5, 0x80, 0x00, 0x05};

CanFrame frame(std::uint32_t id, const dbc::Payload& data) {
  CanFrame made;
  made.id = id;
  made.extended = true;
  made.length = 8;
  made.data = data;
  return made;
}

/// A machine whose arm has the data sheet's sensor.
struct Arm {
  ExcavatorReceiver receiver{BusParts{false, {0xE1, 0xE2, 0xE3, 0}}};

  [[nodiscard]] const ImuInputs& imu() const { return receiver.inputs().imu[1]; }
};

TEST(printed_slope) {
  assert_int_equal(bus::SSI2::kId, kSlopeId);
  const bus::SSI2 level = bus::SSI2::decode(kSlope);
  assert_near(level.pitch_rad.value, 0.0, 0.0);
  assert_near(level.roll_rad.value, 0.0, 0.0);
  assert_true(level.pitch_rad.state == dbc::RawState::kValid);
  assert_true(level.pitch_merit.value == bus::SSI2::PitchMerit::kFunctional);
  // (uint32 - 8192000) / 32768 of Table 8, at the ends that the standard leaves for values.
  dbc::Payload up = kSlope;
  up[2] = 0xAA;
  assert_near(bus::SSI2::decode(up).pitch_rad.value, (0xAA0000 - 8192000) / 32768.0 * kDegree_rad,
              1e-15);
  for (const auto& [top, state] : {std::pair{std::uint8_t{0xFE}, dbc::RawState::kError},
                                   std::pair{std::uint8_t{0xFF}, dbc::RawState::kNotAvailable},
                                   std::pair{std::uint8_t{0xFC}, dbc::RawState::kOutOfRange}}) {
    up[2] = top;
    assert_true(bus::SSI2::decode(up).pitch_rad.state == state);
  }
}

TEST(printed_rates_and_forces, Arm arm) {
  arm.receiver.accept(frame(kRatesId, kRates), kNow);
  arm.receiver.accept(frame(kForcesId, kForces), kNow);
  assert_true(arm.imu().rates.validity == Validity::kValid);
  assert_int_equal(arm.imu().rates.stamp_us, kNow);
  assert_near(arm.imu().rates.value.pitch_radps, 0.0, 0.0);
  assert_near(arm.imu().rates.value.latency_s, 0.0025, 1e-12);
  assert_true(arm.imu().forces.validity == Validity::kValid);
  assert_near(arm.imu().forces.value.longitudinal_mps2, 0.0, 0.0);
  // '+1 g (9.80665 m/s2)' in hundredths.
  assert_near(arm.imu().forces.value.vertical_mps2, 9.81, 1e-12);
  // LORD MV5-AR user manual, 4.2.3: payload / 100 - 320.
  dbc::Payload forces = kForces;
  forces[2] = 0x34;
  forces[3] = 0x12;
  arm.receiver.accept(frame(kForcesId, forces), kNow + kPeriod);
  assert_near(arm.imu().forces.value.longitudinal_mps2, 0x1234 / 100.0 - 320.0, 1e-12);
  assert_int_equal(arm.receiver.imus().accepted, 3);
  assert_int_equal(arm.receiver.foreign(), 0);
  assert_true(arm.receiver.inputs().imu[0].rates.validity == Validity::kNotReceived);
}

TEST(rates_scale, Arm arm) {
  dbc::Payload rates = kRates;
  rates[1] = 0x7E;  // 256 counts of 1/128 deg/s.
  rates[3] = 0x7C;
  rates[7] = 0xFF;
  // Another priority is the same message.
  arm.receiver.accept(frame(0x18F02AE2, rates), kNow);
  assert_near(arm.imu().rates.value.pitch_radps, 2.0 * kDegree_rad, 1e-15);
  assert_near(arm.imu().rates.value.roll_radps, -2.0 * kDegree_rad, 1e-15);
  assert_true(arm.imu().rates.value.latency_s < 0.0);
}

TEST(a_sensor_in_doubt_says_so, Arm arm) {
  dbc::Payload rates = kRates;
  const struct {
    std::uint8_t merit;
    Validity validity;
  } cases[] = {{0x01, Validity::kError},
               {0x02, Validity::kError},
               {0x03, Validity::kValid},
               {0x04, Validity::kValid},
               {0x00, Validity::kValid}};
  TimeUs now = kNow;
  for (const auto& each : cases) {
    rates[6] = each.merit;
    arm.receiver.accept(frame(kRatesId, rates), now);
    assert_true(arm.imu().rates.validity == each.validity);
    now += kPeriod;
  }
  rates = kRates;
  rates[1] = 0xFE;
  arm.receiver.accept(frame(kRatesId, rates), now);
  assert_true(arm.imu().rates.validity == Validity::kError);
  dbc::Payload forces = kForces;
  forces[5] = 0xFF;
  arm.receiver.accept(frame(kForcesId, forces), now);
  assert_true(arm.imu().forces.validity == Validity::kNotAvailable);
}

TEST(refused_frames_leave_the_last_value, Arm arm) {
  arm.receiver.accept(frame(kRatesId, kRates), kNow);
  const TimeUs later = kNow + kPeriod;
  CanFrame bad = frame(kRatesId, kRates);
  bad.length = 7;
  arm.receiver.accept(bad, later);
  assert_int_equal(arm.receiver.imus().wrong_length, 1);
  bad = frame(kRatesId, kRates);
  bad.remote = true;
  arm.receiver.accept(bad, later);
  assert_int_equal(arm.receiver.imus().wrong_kind, 1);
  bad = frame(kRatesId, kRates);
  bad.data[1] = 0xFC;
  arm.receiver.accept(bad, later);
  assert_int_equal(arm.receiver.imus().out_of_range, 1);
  assert_int_equal(arm.imu().rates.stamp_us, kNow);
  assert_true(arm.imu().rates.validity == Validity::kValid);
}

TEST(a_second_sender_is_an_error, Arm arm) {
  TimeUs now = kNow;
  // Frames of two cycles in one, and a clock that is a tenth fast, are sound.
  for (int i = 0; i < 100; ++i) {
    now += i % 2 == 0 ? 0 : 18 * kMillisecondUs;
    arm.receiver.accept(frame(kRatesId, kRates), now);
  }
  assert_int_equal(arm.receiver.imus().surplus, 0);
  int errors = 0;
  for (int i = 0; i < 40; ++i) {
    now += i % 2 == 0 ? 0 : kPeriod;
    arm.receiver.accept(frame(kRatesId, kRates), now);
    errors += arm.imu().rates.validity == Validity::kError ? 1 : 0;
  }
  assert_in_range(errors, 8, 20);
}

TEST(others_stay_foreign, Arm arm) {
  arm.receiver.accept(frame(0x0CF02AE4, kRates), kNow);
  arm.receiver.accept(frame(kSlopeId, kSlope), kNow);
  CanFrame short_id = frame(0x2A, kRates);
  short_id.extended = false;
  arm.receiver.accept(short_id, kNow);
  assert_int_equal(arm.receiver.foreign(), 3);
  ExcavatorReceiver without;
  without.accept(frame(kRatesId, kRates), kNow);
  assert_int_equal(without.foreign(), 1);
}

TEST(filters_let_them_through) {
  const auto ids = imu_ids({0xE1, 0, 0xE3, 0});
  const std::array<std::uint32_t, 8> expected = {0x0CF02AE1, 0x08F02DE1, 0, 0,
                                                 0x0CF02AE3, 0x08F02DE3, 0, 0};
  assert_true(ids == expected);
}
