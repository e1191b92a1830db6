// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/scope/tcp_peer.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace graben::test {
namespace {

bool wait_for(int fd, short events, Milliseconds within) {
  pollfd waiting = {fd, events, 0};
  return poll(&waiting, 1, static_cast<int>(within.count())) == 1;
}

}  // namespace

TcpPeer::TcpPeer(int port, int receive_buffer_bytes)
    : fd_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer_bytes > 0) {
    setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close(fd_);
    fd_ = -1;
  }
}

TcpPeer::~TcpPeer() {
  if (fd_ >= 0) {
    close(fd_);
  }
}

bool TcpPeer::send(std::string_view bytes) {
  while (!bytes.empty()) {
    if (!wait_for(fd_, POLLOUT, Milliseconds(1000))) {
      return false;
    }
    const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent <= 0) {
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

std::string TcpPeer::receive(Milliseconds within) {
  std::array<char, 65536> buffer{};
  if (fd_ < 0 || !wait_for(fd_, POLLIN, within)) {
    return "";
  }
  const ssize_t size = recv(fd_, buffer.data(), buffer.size(), MSG_DONTWAIT);
  return {buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

void TcpPeer::close_half() { shutdown(fd_, SHUT_WR); }

std::string ws_frame(Opcode opcode, std::string_view content, bool is_last) {
  constexpr std::array<unsigned char, 4> kMask = {0x12, 0x34, 0x56, 0x78};
  std::string frame(1, static_cast<char>((is_last ? 0x80U : 0U) | static_cast<unsigned>(opcode)));
  const std::size_t size = content.size();
  const int length_bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
  frame += static_cast<char>(0x80U | (length_bytes == 0 ? size : length_bytes == 2 ? 126U : 127U));
  for (int i = length_bytes - 1; i >= 0; --i) {
    frame += static_cast<char>((size >> (8U * static_cast<unsigned>(i))) & 255U);
  }
  frame.append(kMask.begin(), kMask.end());
  for (std::size_t i = 0; i < size; ++i) {
    frame += static_cast<char>(static_cast<unsigned char>(content[i]) ^ kMask[i % 4]);
  }
  return frame;
}

std::string ws_request(const std::string& host, const std::string& extra, const std::string& path,
                       const std::string& protocol) {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host +
         "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         (protocol.empty() ? "" : "Sec-WebSocket-Protocol: " + protocol + "\r\n") + extra + "\r\n";
}

WsClient::WsClient(int port, int receive_buffer_bytes)
    : port_(port), peer_(port, receive_buffer_bytes) {}

std::string WsClient::ask(const std::string& request) {
  if (!peer_.send(request)) {
    return "";
  }
  while (received_.find("\r\n\r\n") == std::string::npos) {
    const std::string more = peer_.receive(Milliseconds(2000));
    if (more.empty()) {
      break;
    }
    received_ += more;
  }
  const std::string first = received_.substr(0, received_.find("\r\n"));
  const std::size_t end = received_.find("\r\n\r\n");
  received_.erase(0, end == std::string::npos ? end : end + 4);
  return first;
}

bool WsClient::open() {
  const std::string host = "127.0.0.1:" + std::to_string(port_);
  return ask(ws_request(host, "Origin: http://" + host + "\r\n")).rfind("HTTP/1.1 101", 0) == 0;
}

std::optional<WsMessage> WsClient::take() {
  const auto byte = [this](std::size_t i) { return static_cast<unsigned char>(received_[i]); };
  if (received_.size() < 2) {
    return std::nullopt;
  }
  std::size_t size = byte(1);
  std::size_t header = 2;
  if (size >= 126) {
    header = size == 126 ? 4 : 10;
    size = 0;
    for (std::size_t i = 2; i < header && header <= received_.size(); ++i) {
      size = size << 8U | byte(i);
    }
  }
  if (received_.size() < header + size) {
    return std::nullopt;
  }
  WsMessage message{static_cast<Opcode>(byte(0) & 15U), received_.substr(header, size)};
  received_.erase(0, header + size);
  return message;
}

std::optional<WsMessage> WsClient::read(Milliseconds within) {
  const auto until = std::chrono::steady_clock::now() + within;
  for (;;) {
    if (std::optional<WsMessage> message = take()) {
      return message;
    }
    const auto left =
        std::chrono::duration_cast<Milliseconds>(until - std::chrono::steady_clock::now());
    const std::string more = left.count() > 0 ? peer_.receive(left) : "";
    if (more.empty()) {
      return std::nullopt;
    }
    received_ += more;
  }
}

}  // namespace graben::test
