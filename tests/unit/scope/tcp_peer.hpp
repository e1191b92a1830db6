// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The other end of a connection to the server: bytes, and a WebSocket client that does what it is
/// told, right or wrong.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace graben::test {

using Milliseconds = std::chrono::milliseconds;

/// A TCP connection to a port of the loopback address. What goes wrong shows as nothing received.
class TcpPeer {
 public:
  /// `receive_buffer_bytes`: what the kernel takes for a peer that does not read; 0: as it likes.
  explicit TcpPeer(int port, int receive_buffer_bytes = 0);
  TcpPeer(const TcpPeer&) = delete;
  TcpPeer& operator=(const TcpPeer&) = delete;
  ~TcpPeer();

  [[nodiscard]] bool is_connected() const { return fd_ >= 0; }
  /// False if the other end is gone, or takes nothing for a second.
  bool send(std::string_view bytes);
  /// What has come within this time, at least a byte; nothing at the end or if nothing comes.
  std::string receive(Milliseconds within);
  /// Says that nothing more comes, and goes on listening.
  void close_half();

 private:
  int fd_ = -1;
};

enum class Opcode : std::uint8_t {
  kContinuation = 0,
  kText = 1,
  kBinary = 2,
  kClose = 8,
  kPing = 9,
  kPong = 10,
};

struct WsMessage {
  Opcode opcode = Opcode::kText;
  std::string content;
};

/// A frame of a client, masked as it has to be.
[[nodiscard]] std::string ws_frame(Opcode opcode, std::string_view content, bool is_last = true);

/// GET of a WebSocket; `extra` are more header lines, each with its end.
[[nodiscard]] std::string ws_request(const std::string& host, const std::string& extra = "",
                                     const std::string& path = "/frames",
                                     const std::string& protocol = "graben-scope");

class WsClient {
 public:
  explicit WsClient(int port, int receive_buffer_bytes = 0);

  /// First line of the answer to this request.
  std::string ask(const std::string& request);
  /// With the request of a page that came from there.
  [[nodiscard]] bool open();
  /// The next whole message, or none within this time.
  std::optional<WsMessage> read(Milliseconds within = Milliseconds(2000));
  bool send(Opcode opcode, std::string_view content) {
    return peer_.send(ws_frame(opcode, content));
  }
  [[nodiscard]] TcpPeer& peer() { return peer_; }

 private:
  std::optional<WsMessage> take();

  int port_;
  TcpPeer peer_;
  std::string received_;
};

}  // namespace graben::test
