// SPDX-License-Identifier: Apache-2.0
/// A bus that is heard, on one end of a socket pair that every kernel has, the test on the other.

#include "app/scope/server/can_source.hpp"

#include <fcntl.h>
#include <linux/can/error.h>
#include <sys/socket.h>
#include <unistd.h>

#include <map>
#include <thread>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/refusal.hpp"

using nlohmann::json;
using scope::CanListener;
using scope::CanSource;

/// The other end of each interface, and those that cannot be opened just now.
std::map<std::string, int> g_bus;
std::map<std::string, bool> g_is_down;

OpenedCanSocket open_pair(const CanSocketConfig& config) {
  OpenedCanSocket result;
  if (g_is_down[config.interface]) {
    result.error.set("%s: the interface is down", config.interface.c_str());
    return result;
  }
  int ends[2] = {-1, -1};
  assert_int_equal(socketpair(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0, ends), 0);
  const int on = 1;
  assert_int_equal(setsockopt(ends[0], SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on), 0);
  if (g_bus.count(config.interface) != 0) {
    close(g_bus[config.interface]);
  }
  g_bus[config.interface] = ends[1];
  result.fd = ends[0];
  result.state = CanPortState::kActive;
  return result;
}

void set_up() {
  for (const auto& [name, fd] : g_bus) {
    close(fd);
  }
  g_bus.clear();
  g_is_down.clear();
}

void from_bus(const std::string& interface, canid_t id, std::uint8_t byte = 0) {
  can_frame frame{};
  frame.can_id = id;
  frame.can_dlc = 1;
  frame.data[0] = byte;
  assert_int_equal(write(g_bus[interface], &frame, sizeof frame), sizeof frame);
}

std::vector<CanFrame> hear(CanListener& listener) {
  std::vector<CanFrame> frames;
  listener.hear([&](const CanFrame& frame) { frames.push_back(frame); });
  return frames;
}

TimeUs wall_us() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return TimeUs{now.tv_sec} * kSecondUs + now.tv_nsec / 1000;
}

TEST(every_kind_of_frame_is_heard) {
  set_up();
  CanListener listener("can7", &open_pair);
  assert_true(listener.open());
  const TimeUs before_us = wall_us();
  from_bus("can7", 0x18FF2080U | CAN_EFF_FLAG, 5);
  from_bus("can7", 0x7FU);
  from_bus("can7", CAN_ERR_FLAG | CAN_ERR_CRTL, 9);
  const std::vector<CanFrame> frames = hear(listener);
  assert_int_equal(frames.size(), 3);
  assert_int_equal(frames[0].id, 0x18FF2080U);
  assert_true(frames[0].extended);
  assert_int_equal(frames[0].data[0], 5);
  assert_false(frames[1].extended);
  assert_true(frames[2].error);
  assert_int_equal(frames[2].id, CAN_ERR_CRTL);
  for (const CanFrame& frame : frames) {
    assert_in_range(frame.stamp_us - before_us, 0, kSecondUs);
  }
  assert_int_equal(hear(listener).size(), 0);
  assert_true(listener.is_open());
}

TEST(what_is_no_frame_is_left_out) {
  set_up();
  CanListener listener("can7", &open_pair);
  assert_true(listener.open());
  assert_int_equal(write(g_bus["can7"], "x", 1), 1);
  const std::string fd_frame(72, 'x');
  assert_int_equal(write(g_bus["can7"], fd_frame.data(), fd_frame.size()), fd_frame.size());
  from_bus("can7", 0x7FU);
  assert_int_equal(hear(listener).size(), 1);
}

/// What the kernel says of it does not matter: it says the same of an interface that is down.
OpenedCanSocket open_no_socket(const CanSocketConfig& /*config*/) {
  OpenedCanSocket result;
  result.fd = open("/dev/null", O_RDONLY);
  result.state = CanPortState::kActive;
  return result;
}

TEST(an_interface_that_fails_is_not_open_any_more) {
  set_up();
  CanListener listener("can7", &open_no_socket);
  assert_true(listener.open());
  assert_int_equal(hear(listener).size(), 0);
  assert_false(listener.is_open());
  assert_string_equal(listener.last_error(), "can7: Socket operation on non-socket");
  assert_int_equal(hear(listener).size(), 0);
}

TEST(an_interface_that_is_down_can_be_opened_again) {
  set_up();
  CanListener listener("can7", &open_pair);
  g_is_down["can7"] = true;
  assert_false(listener.open());
  assert_string_equal(listener.last_error(), "can7: the interface is down");
  g_is_down["can7"] = false;
  assert_true(listener.open());
  from_bus("can7", 1);
  assert_int_equal(hear(listener).size(), 1);
}

/// A source at work, read as a page does.
struct Rig {
  CanSource source;
  scope::FrameFeed feed;
  scope::FrameReader reader{feed};
  std::atomic<bool> stop{false};
  std::thread thread;

  explicit Rig(const std::vector<std::string>& interfaces)
      : source(interfaces, 250000, &open_pair), thread([this] { source.run(feed, stop); }) {}
  ~Rig() {
    stop = true;
    thread.join();
  }

  std::string lines(int frames) {
    std::string text;
    for (int i = 0; i < 200 && frames > 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      while (const auto block = reader.next()) {
        text += block->text;
        frames -= static_cast<int>(block->frames);
      }
    }
    return text;
  }

  /// The state that says this, within two seconds.
  json state_with(const std::string& words) {
    std::uint64_t seen = 0;
    json state;
    for (int i = 0; i < 200; ++i) {
      if (const std::optional<json> news = source.state(seen)) {
        state = *news;
      }
      if (state["words"].get<std::string>().find(words) != std::string::npos) {
        return state;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    print_error("'%s' not in %s\n", words.c_str(), state.dump().c_str());
    _fail(__FILE__, __LINE__);
    return state;
  }
};

TEST(frames_become_lines_of_their_interface) {
  set_up();
  Rig rig({"can7", "can8"});
  from_bus("can7", 0x18FF2080U | CAN_EFF_FLAG, 0xA5);
  from_bus("can8", CAN_ERR_FLAG | CAN_ERR_CRTL, 1);
  const std::string text = rig.lines(2);
  assert_true(text.find(" can7 18FF2080#A5\n") != std::string::npos);
  assert_true(text.find(" can8 20000004#01\n") != std::string::npos);
}

/// Both get frames all the while that they are heard, as many as they take.
TEST(stamps_rise_over_all_interfaces) {
  set_up();
  Rig rig({"can7", "can8"});
  can_frame frame{};
  std::string text;
  for (int i = 0; i < 100; ++i) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(15);
    while (std::chrono::steady_clock::now() < until) {
      static_cast<void>(!write(g_bus["can8"], &frame, sizeof frame));
      static_cast<void>(!write(g_bus["can7"], &frame, sizeof frame));
    }
    while (const auto block = rig.reader.next()) {
      text += block->text;
    }
  }
  std::string before;
  std::stringstream stream(text);
  int lines = 0;
  for (std::string line; std::getline(stream, line); ++lines) {
    const std::string stamp = line.substr(0, line.find(')'));
    assert_true(before <= stamp);
    before = stamp;
  }
  assert_int_equal(rig.reader.lost(), 0);
  assert_true(lines > 1000);
}

TEST(the_bus_is_told_in_words) {
  set_up();
  g_is_down["can8"] = false;
  Rig rig({"can7", "can8"});
  const json up = rig.state_with("can7: heard; can8: heard");
  assert_true(up["up"].get<bool>());
  assert_true(up["kind"] == "bus");
  const json setup = rig.source.setup()["source"];
  assert_true(setup["mode"] == "can");
  assert_true(setup["name"] == "can7, can8");
  assert_int_equal(setup["bitrate"].get<int>(), 250000);
  assert_true(rig.source.control({{"do", "run"}}).has_value());
}

TEST(a_state_is_told_once) {
  set_up();
  Rig rig({"can7"});
  std::uint64_t seen = 0;
  assert_true(rig.source.state(seen).has_value());
  assert_false(rig.source.state(seen).has_value());
}

void assert_no_source(const std::vector<std::string>& interfaces, const char* why) {
  const std::string said =
      test::refusal_of([&] { return CanSource(interfaces, 500000, &open_pair); });
  assert_string_equal(said.c_str(), why);
}

TEST(what_cannot_be_heard_is_refused) {
  set_up();
  assert_no_source({}, "no CAN interface is named");
  assert_no_source({"can7", "can8", "can7"}, "CAN interface 'can7' is named twice");
  g_is_down["can9"] = true;
  assert_no_source({"can9"}, "can9: the interface is down");
  // One that this machine has is waited for.
  g_is_down["lo"] = true;
  Rig rig({"lo"});
  const json down = rig.state_with("lo: the interface is down; tried again every half second");
  assert_false(down["up"].get<bool>());
  g_is_down["lo"] = false;
  assert_true(rig.state_with("lo: heard")["up"].get<bool>());
}
