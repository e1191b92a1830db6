// SPDX-License-Identifier: Apache-2.0
/// Throws at a server whatever a seed makes, and has it serve two good pages all the while: one
/// that stays from beginning to end and must miss nothing, and one that comes anew now and then.
///
///   fuzz_scope ROUNDS [SEED]
///   fuzz_scope --planted     a wish that the source cannot take kills it: this must be found
///
/// The server is in this process: what breaks it, or a sanitizer, ends the process.

#include <fmt/format.h>

#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <sstream>
#include <string>

#include "tests/unit/scope/attacks.hpp"
#include "tests/unit/scope/scripted_source.hpp"
#include "tests/unit/scope/tcp_peer.hpp"

namespace {

using namespace graben;
using test::Draw;
using test::Milliseconds;
using test::Opcode;
using test::WsClient;
using test::WsMessage;

constexpr std::size_t kOpenMost = 12;
constexpr std::uint64_t kLookEvery = 100;
/// A dozen others at once are being told of ten minutes.
constexpr Milliseconds kQuietMost(20000);

[[noreturn]] void fail(const std::string& what) {
  fmt::print(stderr, "fuzz_scope: {}\n", what);
  std::_Exit(1);
}

/// As a page does, in a thread of its own.
class Witness {
 public:
  explicit Witness(int port) : client_(port) {
    if (!client_.open()) {
      fail("the first page was not served");
    }
    thread_ = std::thread([this] { read(); });
  }
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;
  ~Witness() { thread_.join(); }

  void stop() { stop_ = true; }

 private:
  void read() {
    while (!stop_) {
      const std::optional<WsMessage> message = client_.read(kQuietMost);
      if (!message) {
        fail("the page that stayed got nothing for twenty seconds");
      }
      if (message->opcode == Opcode::kBinary) {
        look_at(message->content);
      }
    }
  }

  void look_at(const std::string& lines) {
    std::stringstream stream(lines);
    for (std::string line; std::getline(stream, line); ++frames_) {
      const std::string number = line.substr(line.find('#') + 1);
      if (number.size() != 8 || (frames_ > 0 && std::stoul(number, nullptr, 16) != last_ + 1)) {
        fail("the page that stayed missed a frame before " + line);
      }
      last_ = std::stoul(number, nullptr, 16);
    }
  }

  WsClient client_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  unsigned long last_ = 0;
  std::uint64_t frames_ = 0;
};

/// A page that comes anew gets setup and frames, and an answer to nonsense.
void look(int port, std::uint64_t round) {
  for (int attempt = 0; attempt < 200; ++attempt) {
    WsClient client(port);
    if (!client.open()) {
      // Its places may be taken by what was thrown, for as long as that lasts.
      std::this_thread::sleep_for(Milliseconds(50));
      continue;
    }
    client.send(Opcode::kText, "nonsense");
    bool setup = false;
    bool frames = false;
    bool refused = false;
    while (!(setup && frames && refused)) {
      const std::optional<WsMessage> message = client.read(Milliseconds(5000));
      if (!message) {
        fail(fmt::format("a good page was let down after round {}", round));
      }
      frames = frames || message->opcode == Opcode::kBinary;
      setup = setup || message->content.find(R"("kind":"setup")") != std::string::npos;
      refused = refused || message->content.find("this is not JSON") != std::string::npos;
    }
    return;
  }
  fail(fmt::format("no good page was let in after round {}", round));
}

/// In pieces now and then, as a network may do.
void send(Draw& draw, test::TcpPeer& peer, const std::string& bytes) {
  const std::size_t piece = draw.one_in(4) ? 1 + draw.below(50) : bytes.size();
  for (std::size_t at = 0; at < bytes.size() && at < 40 * piece; at += piece) {
    if (!peer.send(std::string_view(bytes).substr(at, piece))) {
      return;
    }
  }
}

std::unique_ptr<WsClient> attack(Draw& draw, int port, std::uint64_t& opened) {
  auto client = std::make_unique<WsClient>(port, draw.one_in(3) ? 4096 : 0);
  const std::uint64_t kind = draw.below(5);
  if (kind == 0) {
    send(draw, client->peer(), test::raw_bytes(draw));
  } else if (kind == 1) {
    send(draw, client->peer(), test::odd_request(draw, port));
  } else if (client->open()) {
    ++opened;
    send(draw, client->peer(), kind == 2 ? test::odd_frames(draw) : test::odd_wishes(draw));
  }
  if (draw.one_in(3)) {
    static_cast<void>(client->read(Milliseconds(draw.below(4))));
  }
  if (draw.one_in(4)) {
    client->peer().close_half();
  }
  return client;
}

/// A source that dies of a number where a word belongs.
class PlantedSource : public test::ScriptedSource {
 public:
  using ScriptedSource::ScriptedSource;
  [[nodiscard]] std::optional<std::string> control(const nlohmann::json& wish) override {
    if (wish.contains("do") && wish["do"].is_number()) {
      fail("the planted defect");
    }
    return ScriptedSource::control(wish);
  }
};

void run(test::ScriptedSource& source, std::uint64_t rounds, std::uint64_t seed) {
  test::LiveRig rig(source);
  Witness witness(rig.port());
  Draw draw(seed);
  std::deque<std::unique_ptr<WsClient>> open;
  std::uint64_t opened = 0;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    open.push_back(attack(draw, rig.port(), opened));
    // What is closed at once, the server may never get to see.
    while (open.size() > (draw.one_in(20) ? 0 : kOpenMost)) {
      open.pop_front();
    }
    if (round % kLookEvery == kLookEvery - 1) {
      look(rig.port(), round);
    }
  }
  open.clear();
  look(rig.port(), rounds);
  witness.stop();
  fmt::print("{} rounds from seed {}: served all the while; {} WebSockets, {} wishes\n", rounds,
             seed, opened, source.wishes());
  // The series must reach what it is thrown at.
  if (opened < rounds / 3 || source.wishes() < rounds / 10) {
    fail("too little of it arrived");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "2000";
  if (first == "--planted") {
    PlantedSource source(4);
    run(source, 2000, 1);
    fail("nothing was found");
  }
  test::ScriptedSource source(4);
  const std::uint64_t rounds = std::stoull(first);
  const std::uint64_t seed = argc > 2 ? std::stoull(argv[2]) : 1;
  run(source, rounds, seed);
  return 0;
}
