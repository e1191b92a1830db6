// SPDX-License-Identifier: Apache-2.0
// What the service manager hears of nodes' emergencies, on a socket of its own.

#include "app/ecu/emergency_note.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <string>

#include "tests/unit/cmocka_cpp.hpp"

/// The manager's end, by an abstract name.
class Manager {
 public:
  Manager() : name_("@graben-emergency-" + std::to_string(getpid())) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name_.data(), name_.size());
    address.sun_path[0] = '\0';
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    assert_int_equal(bind(socket_, reinterpret_cast<sockaddr*>(&address),
                          static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size())),
                     0);
  }
  ~Manager() { close(socket_); }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  [[nodiscard]] const char* name() const { return name_.c_str(); }
  std::string heard() const {
    char text[256];
    const ssize_t length = read(socket_, text, sizeof text);
    return length < 0 ? std::string() : std::string(text, static_cast<std::size_t>(length));
  }

 private:
  std::string name_;
  int socket_ = -1;
};

TEST(an_emergency_is_told_as_it_comes_changes_and_goes) {
  const Manager manager;
  ServiceNotify notify(manager.name());
  ecu::EmergencyNote note(notify, "cycling");
  note.look({});
  assert_string_equal(manager.heard().c_str(), "");
  assert_string_equal(note.words().c_str(), "");
  note.look({17, 0x5010});
  assert_string_equal(manager.heard().c_str(), "STATUS=cycling; node 17 has emergency 5010h");
  note.look({17, 0x5010});
  assert_string_equal(manager.heard().c_str(), "");
  note.look({17, 0x0042});
  assert_string_equal(manager.heard().c_str(), "STATUS=cycling; node 17 has emergency 0042h");
  note.look({});
  assert_string_equal(manager.heard().c_str(), "STATUS=cycling");
  assert_string_equal(note.words().c_str(), "node 17 had emergency 0042h, the last of 2");
  assert_int_equal(note.last().id, 17);
}

TEST(without_a_manager_it_is_kept_for_the_end) {
  ServiceNotify nobody(nullptr);
  ecu::EmergencyNote note(nobody, "cycling");
  note.look({2, 0xFF01});
  assert_string_equal(note.words().c_str(), "node 2 had emergency FF01h, the last of 1");
  assert_int_equal(note.count(), 1);
}
