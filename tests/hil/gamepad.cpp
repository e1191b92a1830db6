// SPDX-License-Identifier: Apache-2.0
// A gamepad that nobody holds: gamepad INTERFACE NAME <actions. Makes an input device of the kernel
// (uinput) and does what the lines say, one after the other, each told on standard output:
//   make          the device, all at rest
//   BTN_... 0|1   a button
//   ABS_... N     an axis, -32768 .. 32767; of the d-pad -1 .. 1
//   flood N       so many changes of an axis that no lever is, faster than anybody reads them
//   destroy       the device is gone
//   mark N        an 11-bit frame 7F0 with this byte
//   sleep MS
//   run COMMAND   of the shell

#include <libevdev/libevdev-uinput.h>
#include <libevdev/libevdev.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <sstream>
#include <string>

namespace {

constexpr canid_t kMark = 0x7F0;
constexpr useconds_t kUsPerMs = 1000;

[[noreturn]] void give_up(const std::string& what) {
  std::perror(what.c_str());
  std::exit(1);
}

int open_bus(const char* interface) {
  const int fd = socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  ifreq request{};
  std::strncpy(request.ifr_name, interface, sizeof request.ifr_name - 1);
  if (fd < 0 || ioctl(fd, SIOCGIFINDEX, &request) != 0) {
    give_up(interface);
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = request.ifr_ifindex;
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    give_up(interface);
  }
  return fd;
}

libevdev* describe(const char* name) {
  libevdev* const device = libevdev_new();
  libevdev_set_name(device, name);
  for (const unsigned code : {BTN_SOUTH, BTN_TL, BTN_START, BTN_SELECT}) {
    libevdev_enable_event_code(device, EV_KEY, code, nullptr);
  }
  input_absinfo range{};
  range.minimum = -32768;
  range.maximum = 32767;
  for (const unsigned code : {ABS_X, ABS_Y, ABS_RX, ABS_RY, ABS_Z}) {
    libevdev_enable_event_code(device, EV_ABS, code, &range);
  }
  range.minimum = -1;
  range.maximum = 1;
  for (const unsigned code : {ABS_HAT0X, ABS_HAT0Y}) {
    libevdev_enable_event_code(device, EV_ABS, code, &range);
  }
  return device;
}

class Pad {
 public:
  explicit Pad(const char* name) : description_(describe(name)) {}
  Pad(const Pad&) = delete;
  Pad& operator=(const Pad&) = delete;
  ~Pad() {
    destroy();
    libevdev_free(description_);
  }

  void make() {
    if (libevdev_uinput_create_from_device(description_, LIBEVDEV_UINPUT_OPEN_MANAGED, &pad_) !=
        0) {
      give_up("uinput");
    }
  }
  void destroy() {
    if (pad_ != nullptr) {
      libevdev_uinput_destroy(pad_);
      pad_ = nullptr;
    }
  }
  void put(const std::string& code, int value) {
    const unsigned type = code.rfind("BTN_", 0) == 0 ? EV_KEY : EV_ABS;
    const int number = libevdev_event_code_from_name(type, code.c_str());
    if (number < 0) {
      give_up(code);
    }
    write(type, static_cast<unsigned>(number), value);
  }
  void flood(int count) {
    for (int i = 1; i <= count; ++i) {
      write(EV_ABS, ABS_Z, i);
    }
  }

 private:
  void write(unsigned type, unsigned code, int value) {
    if (pad_ == nullptr || libevdev_uinput_write_event(pad_, type, code, value) != 0 ||
        libevdev_uinput_write_event(pad_, EV_SYN, SYN_REPORT, 0) != 0) {
      give_up("write to uinput");
    }
  }

  libevdev* description_;
  libevdev_uinput* pad_ = nullptr;
};

void mark(int bus, int number) {
  can_frame frame{};
  frame.can_id = kMark;
  frame.can_dlc = 1;
  frame.data[0] = static_cast<unsigned char>(number);
  // An interface that went down meanwhile is told once by each socket.
  if (::write(bus, &frame, sizeof frame) != sizeof frame &&
      ::write(bus, &frame, sizeof frame) != sizeof frame) {
    give_up("mark");
  }
}

void act(const std::string& line, Pad& pad, int bus) {
  std::istringstream words(line);
  std::string what;
  int number = 0;
  words >> what;
  if (what == "run") {
    std::string command;
    std::getline(words, command);
    if (std::system(command.c_str()) != 0) {
      give_up(line);
    }
    return;
  }
  words >> number;
  if (what == "make") {
    pad.make();
  } else if (what == "destroy") {
    pad.destroy();
  } else if (what == "mark") {
    mark(bus, number);
  } else if (what == "sleep") {
    usleep(static_cast<useconds_t>(number) * kUsPerMs);
  } else if (what == "flood") {
    pad.flood(number);
  } else {
    pad.put(what, number);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("gamepad INTERFACE NAME <actions\n", stderr);
    return 2;
  }
  const int bus = open_bus(argv[1]);
  Pad pad(argv[2]);
  for (std::string line; std::getline(std::cin, line);) {
    if (line.empty() || line.front() == '#') {
      continue;
    }
    act(line, pad, bus);
    // After it: who waits for a line may rely on it.
    std::cout << line << std::endl;
  }
  return 0;
}
