// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the tests of the server have in common.

#include <string>

#include "tests/unit/cmocka_cpp.hpp"
#include "tests/unit/scope/scripted_source.hpp"
#include "tests/unit/scope/tcp_peer.hpp"

namespace graben::test {

/// A server of a source that makes so many frames every 4 ms.
struct ScriptRig {
  explicit ScriptRig(int frames_per_block) : source_(frames_per_block) {}
  [[nodiscard]] ScriptedSource& source() { return source_; }
  [[nodiscard]] int port() const { return rig_.port(); }

 private:
  ScriptedSource source_;
  LiveRig rig_{source_};
};

inline std::string own_host(int port) { return "127.0.0.1:" + std::to_string(port); }

/// All of an answer whose connection ends, or nothing more comes for a moment.
inline std::string ask(int port, const std::string& request) {
  TcpPeer peer(port);
  assert_true(peer.send(request));
  std::string answer;
  for (std::string more = peer.receive(Milliseconds(2000)); !more.empty();
       more = peer.receive(Milliseconds(100))) {
    answer += more;
  }
  return answer;
}

inline void assert_has(const std::string& text, const std::string& part) {
  if (text.find(part) == std::string::npos) {
    print_error("'%s' not in '%s'\n", part.c_str(), text.substr(0, 2000).c_str());
    _fail(__FILE__, __LINE__);
  }
}

inline void assert_begins(const std::string& text, const std::string& with) {
  if (text.compare(0, with.size(), with) != 0) {
    print_error("not '%s' but '%s'\n", with.c_str(), text.substr(0, 200).c_str());
    _fail(__FILE__, __LINE__);
  }
}

}  // namespace graben::test
