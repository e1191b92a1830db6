// SPDX-License-Identifier: Apache-2.0
// What the service manager hears, on a socket of its own; and when signals ask to stop.

#include "platform/linux/service_notify.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

#include "platform/linux/process.hpp"
#include "tests/unit/cmocka_cpp.hpp"

/// The manager's end, bound to a path or, after '@', to an abstract name.
class Manager {
 public:
  explicit Manager(const std::string& name) : name_(name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name[0] == '@') {
      address.sun_path[0] = '\0';
    }
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    assert_int_equal(bind(socket_, reinterpret_cast<sockaddr*>(&address),
                          static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size())),
                     0);
  }
  ~Manager() {
    close(socket_);
    if (name_[0] == '/') {
      unlink(name_.c_str());
    }
  }
  Manager(const Manager&) = delete;
  Manager& operator=(const Manager&) = delete;

  /// The next message; empty if there is none.
  std::string heard() const {
    char text[1024];
    const ssize_t length = read(socket_, text, sizeof text);
    return length < 0 ? std::string() : std::string(text, static_cast<std::size_t>(length));
  }

 private:
  std::string name_;
  int socket_ = -1;
};

std::string g_folder;

int make_folder(void**) {
  char name[] = "/tmp/graben-notify-XXXXXX";
  if (mkdtemp(name) == nullptr) {
    return -1;
  }
  g_folder = name;
  return 0;
}

int remove_folder(void**) { return rmdir(g_folder.c_str()); }

std::string path() { return g_folder + "/notify"; }

TEST(every_message_arrives) {
  for (const std::string& name : {path(), "@graben-notify-test-" + std::to_string(getpid())}) {
    const Manager manager(name);
    ServiceNotify notify(name.c_str());
    assert_true(notify.connected());
    assert_true(notify.ready());
    assert_true(notify.status("armed, 12 cycles"));
    assert_true(notify.watchdog());
    assert_true(notify.stopping());
    assert_string_equal(manager.heard().c_str(), "READY=1");
    assert_string_equal(manager.heard().c_str(), "STATUS=armed, 12 cycles");
    assert_string_equal(manager.heard().c_str(), "WATCHDOG=1");
    assert_string_equal(manager.heard().c_str(), "STOPPING=1");
    assert_string_equal(manager.heard().c_str(), "");
  }
}

TEST(a_status_is_one_line_of_200_bytes) {
  const Manager manager(path());
  ServiceNotify notify(path().c_str());
  assert_true(notify.status("one\nWATCHDOG=trigger"));
  assert_string_equal(manager.heard().c_str(), "STATUS=one");
  assert_true(notify.status(std::string(200, 'x').c_str()));
  assert_string_equal(manager.heard().c_str(), ("STATUS=" + std::string(200, 'x')).c_str());
  assert_true(notify.status(std::string(5000, 'x').c_str()));
  assert_string_equal(manager.heard().c_str(), ("STATUS=" + std::string(200, 'x')).c_str());
}

TEST(nobody_listens) {
  for (const char* const name : {static_cast<const char*>(nullptr), "", "relative/path",
                                 "/nowhere/at/all", "@graben-nobody-is-here"}) {
    ServiceNotify notify(name);
    assert_false(notify.connected());
    assert_false(notify.ready());
    assert_false(notify.watchdog());
  }
}

TEST(a_name_fits_or_is_refused) {
  constexpr std::size_t kPathBytes = sizeof(sockaddr_un::sun_path);
  std::string longest = path();
  longest.resize(kPathBytes - 1, 'n');
  {
    const Manager manager(longest);
    ServiceNotify notify(longest.c_str());
    assert_true(notify.ready());
    assert_string_equal(manager.heard().c_str(), "READY=1");
  }
  const Manager beyond(longest + "n");
  ServiceNotify notify((longest + "n").c_str());
  assert_false(notify.connected());
}

TEST(a_manager_that_went_away_or_does_not_read) {
  ServiceNotify* notify = nullptr;
  {
    const Manager manager(path());
    notify = new ServiceNotify(path().c_str());
    // Full: dropped, not waited for.
    int delivered = 0;
    while (notify->watchdog()) {
      assert_true(++delivered < 100'000);
    }
    assert_true(delivered > 0);
    assert_string_equal(manager.heard().c_str(), "WATCHDOG=1");
    assert_true(notify->watchdog());
  }
  assert_false(notify->watchdog());
  delete notify;
}

TEST(the_watchdog_interval_is_for_us) {
  constexpr pid_t kOwn = 4711;
  assert_int_equal(watchdog_interval_us("100000", "4711", kOwn), 100'000);
  assert_int_equal(watchdog_interval_us("100000", nullptr, kOwn), 100'000);
  assert_int_equal(watchdog_interval_us("100000", "4712", kOwn), 0);
  assert_int_equal(watchdog_interval_us("100000", "", kOwn), 0);
  assert_int_equal(watchdog_interval_us("100000", "4711x", kOwn), 0);
  assert_int_equal(watchdog_interval_us(nullptr, "4711", kOwn), 0);
  assert_int_equal(watchdog_interval_us("0", nullptr, kOwn), 0);
  for (const char* const bad : {"", "x", "-5", "+5", " 5", "5s", "99999999999999999999"}) {
    assert_int_equal(watchdog_interval_us(bad, nullptr, kOwn), 0);
  }
}

/// In a child: handlers are the process's. Its status: 0 as it ought to be, or the signal.
template <class Body>
int in_child(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    _exit(body() ? 0 : 1);
  }
  int status = -1;
  assert_int_equal(waitpid(child, &status, 0), child);
  return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
}

TEST(a_stop_signal_is_caught_once) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const int other = signal == SIGTERM ? SIGINT : SIGTERM;
    assert_int_equal(in_child([signal] {
                       const bool caught = catch_stop_signals().empty();
                       const bool before = stop_requested();
                       raise(signal);
                       return caught && !before && stop_requested();
                     }),
                     0);
    assert_int_equal(in_child([signal, other] {
                       const bool caught = catch_stop_signals().empty();
                       raise(signal);
                       raise(other);
                       return caught && stop_requested();
                     }),
                     0);
    assert_int_equal(in_child([signal] {
                       static_cast<void>(catch_stop_signals());
                       raise(signal);
                       raise(signal);
                       return true;
                     }),
                     signal);
  }
}

TESTS_WITHIN(make_folder, remove_folder)
