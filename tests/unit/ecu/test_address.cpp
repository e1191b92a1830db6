// SPDX-License-Identifier: Apache-2.0
// The controller's port with its address: what still goes out of it once that is lost; and its
// NAME.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "app/ecu/address_name.hpp"
#include "app/ecu/address_port.hpp"
#include "tests/unit/cmocka_cpp.hpp"

using j1939::AddressClaim;

constexpr std::uint32_t kOurClaim = 0x18EEFF82;
constexpr std::uint32_t kCannot = 0x18EEFFFE;
constexpr std::uint32_t kCommand = 0x0CFF3182;

// A bus that gives what it is given, and keeps what was sent.
class Bus final : public CanPort {
 public:
  [[nodiscard]] bool open() override {
    ++opened;
    return true;
  }
  [[nodiscard]] CanPortState state() const override { return CanPortState::kActive; }
  [[nodiscard]] int receive(CanFrame* frames, int capacity) override {
    int count = 0;
    while (count < capacity && !waiting.empty()) {
      frames[count++] = waiting.front();
      waiting.erase(waiting.begin());
    }
    return count;
  }
  [[nodiscard]] bool send(const CanFrame& frame) override {
    if (takes || keeps_what_it_refuses) {
      sent.push_back(frame.id);
    }
    return takes;
  }
  void claim(std::uint64_t name) {
    CanFrame frame;
    frame.id = kOurClaim;
    frame.length = 8;
    for (std::size_t i = 0; i < 8; ++i) {
      frame.data[i] = static_cast<std::uint8_t>(name >> (8 * i));
    }
    waiting.push_back(frame);
  }
  bool takes = true;
  bool keeps_what_it_refuses = false;
  int opened = 0;
  std::vector<CanFrame> waiting;
  std::vector<std::uint32_t> sent;
};

// A controller that sends its command in each cycle.
struct Cycles {
  Bus bus;
  AddressClaim claim{130, 1000};
  ecu::LastFrames last;
  ecu::AddressPort port{bus, claim, last};
  TimeUs now = 0;
  CanPortState heard_state = CanPortState::kActive;

  void cycle() {
    now += 10 * kMillisecondUs;
    port.begin(now);
    CanFrame frames[8];
    static_cast<void>(port.receive(frames, 8));
    heard_state = port.state();
    CanFrame command;
    command.id = kCommand;
    static_cast<void>(port.send(command));
    port.finish();
  }
};

TEST(a_claim_waits_for_a_bus_that_takes_it) {
  Cycles ecu;
  ecu.bus.takes = false;
  ecu.cycle();
  assert_true(ecu.bus.sent.empty());
  ecu.bus.takes = true;
  ecu.cycle();
  ecu.cycle();
  const std::vector<std::uint32_t> wanted = {kCommand, kOurClaim, kCommand};
  assert_true(ecu.bus.sent == wanted);
}

TEST(a_bus_that_is_back_hears_the_claim_anew) {
  Cycles ecu;
  ecu.cycle();
  assert_true(ecu.port.open());
  ecu.bus.sent.clear();
  ecu.cycle();
  const std::vector<std::uint32_t> wanted = {kCommand, kOurClaim};
  assert_true(ecu.bus.sent == wanted);
}

TEST(who_has_lost_it_is_off_the_bus_at_once_and_stays_silent) {
  Cycles ecu;
  ecu.cycle();
  ecu.bus.sent.clear();
  ecu.bus.claim(999);
  ecu.cycle();
  // In the cycle that hears of it the controller knows, and what it sends of that goes out.
  assert_int_equal(ecu.heard_state, CanPortState::kDown);
  ecu.last.put(std::array<CanFrame, 3>{});
  assert_int_equal(ecu.last.get().count, 0);
  for (int i = 0; i < 200; ++i) {
    ecu.cycle();
  }
  const std::vector<std::uint32_t> wanted = {kCommand, kCannot};
  assert_true(ecu.bus.sent == wanted);
  assert_false(ecu.port.open());
  assert_int_equal(ecu.bus.opened, 0);
}

// As a group of two is, one of which is off: it says no, and the other has taken it.
TEST(one_of_two_buses_that_is_off_makes_no_storm) {
  Cycles ecu;
  ecu.bus.keeps_what_it_refuses = true;
  ecu.bus.takes = false;
  for (int i = 0; i < 1000; ++i) {
    ecu.cycle();
  }
  const auto claims = std::count(ecu.bus.sent.begin(), ecu.bus.sent.end(), kOurClaim);
  assert_in_range(claims, 45, 51);
}

TEST(who_keeps_it_goes_on) {
  Cycles ecu;
  ecu.cycle();
  ecu.bus.sent.clear();
  ecu.bus.claim(1001);
  ecu.cycle();
  ecu.cycle();
  assert_int_equal(ecu.heard_state, CanPortState::kActive);
  const std::vector<std::uint32_t> wanted = {kCommand, kOurClaim, kCommand};
  assert_true(ecu.bus.sent == wanted);
}

TEST(the_claim_is_said_before_the_first_cycle) {
  Cycles ecu;
  ecu.bus.claim(5);
  ecu::claim_address(ecu.port);
  assert_true(ecu.claim.is_lost());
  Cycles other;
  ecu::claim_address(other.port);
  const std::vector<std::uint32_t> wanted = {kOurClaim};
  assert_true(other.bus.sent == wanted);
}

TEST(a_name_is_16_digits_of_a_station_that_stays) {
  std::string error;
  assert_int_equal(ecu::parse_name("3000ff0000012345", error).value_or(0), 0x3000FF0000012345);
  for (const char* wrong : {"", "3000ff000001234", "3000ff00000123456", "3000ff000001234g",
                            "0x00ff0000012345", " 000ff0000012345", "-000ff0000012345"}) {
    assert_false(ecu::parse_name(wrong, error).has_value());
    assert_non_null(std::strstr(error.c_str(), "16 hexadecimal digits"));
  }
  assert_false(ecu::parse_name("b000ff0000012345", error).has_value());
  assert_non_null(std::strstr(error.c_str(), "bit 63"));
  assert_false(ecu::parse_name("3001ff0000012345", error).has_value());
  assert_non_null(std::strstr(error.c_str(), "bit 48"));
}

TEST(a_computer_has_its_name) {
  const std::string file = "address_machine_id";
  std::ofstream(file) << "8b6f2f0c5d3a4b0e9a7d1c2e3f405162\n";
  const std::uint64_t name = ecu::found_name(file);
  std::ofstream(file) << "8b6f2f0c5d3a4b0e9a7d1c2e3f405163\n";
  assert_true(ecu::found_name(file) != name);
  assert_int_equal(name >> 21U, 0x3000FF0000000000 >> 21U);
  std::remove(file.c_str());
  assert_int_equal(ecu::found_name(file), 0x3000FF0000000000);
}
