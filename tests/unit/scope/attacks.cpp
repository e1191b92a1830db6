// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/scope/attacks.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "tests/unit/scope/tcp_peer.hpp"

namespace graben::test {
namespace {

/// Some places of it changed, taken out, doubled, or filled with something else.
std::string mutated(Draw& draw, std::string text) {
  for (std::uint64_t changes = draw.below(6); changes > 0; --changes) {
    const std::size_t at = draw.below(text.size() + 1);
    const std::size_t length = std::min<std::size_t>(draw.below(12), text.size() - at);
    switch (draw.below(5)) {
      case 0:
        text.replace(at, length, draw.bytes(length));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(at, draw.bytes(1 + draw.below(40)));
        break;
      default:
        text.insert(at, std::string(draw.below(draw.one_in(8) ? 20000 : 300), 'a'));
        break;
    }
  }
  return text;
}

std::string header(Draw& draw, int port) {
  const std::string own = "127.0.0.1:" + std::to_string(port);
  const std::array<std::string, 14> lines = {
      "Host: " + own,
      "Host: evil.example",
      "Origin: http://" + own,
      "Origin: null",
      "Connection: keep-alive, Upgrade",
      "Upgrade: h2c\r\nHTTP2-Settings: AAMAAABkAARAAAAAAAIAAAAA",
      "Upgrade: websocket",
      "Sec-WebSocket-Protocol: graben-scope, http",
      "Sec-WebSocket-Extensions: permessage-deflate; client_max_window_bits=99",
      "Sec-WebSocket-Version: 12",
      "Content-Length: 18446744073709551617",
      "Content-Length: -1",
      "Transfer-Encoding: chunked",
      "Expect: 100-continue"};
  return lines[draw.below(lines.size())] + "\r\n";
}

std::uint64_t odd_length(Draw& draw) {
  constexpr std::array<std::uint64_t, 12> kLengths = {0,
                                                      1,
                                                      125,
                                                      126,
                                                      127,
                                                      4096,
                                                      4097,
                                                      65535,
                                                      65536,
                                                      0x7FFFFFFF,
                                                      0x7FFFFFFFFFFFFFFF,
                                                      0xFFFFFFFFFFFFFFFF};
  return draw.one_in(3) ? kLengths[draw.below(kLengths.size())] : draw.below(300);
}

std::string big_endian(std::uint64_t value, unsigned bytes) {
  std::string text;
  for (unsigned i = bytes; i > 0; --i) {
    text += static_cast<char>((value >> (8U * (i - 1U))) & 255U);
  }
  return text;
}

/// Every bit of a header is anything; now and then the length is not what follows.
std::string odd_frame(Draw& draw) {
  std::string frame(1, static_cast<char>(draw.below(256)));
  const std::uint64_t length = odd_length(draw);
  const bool masked = !draw.one_in(5);
  const unsigned bit = masked ? 0x80U : 0U;
  const std::uint64_t form = draw.one_in(6)   ? draw.below(3)
                             : length < 126   ? 0
                             : length < 65536 ? 1
                                              : 2;
  if (form == 0) {
    frame += static_cast<char>(bit | (length & 0x7FU));
  } else {
    frame += static_cast<char>(bit | (form == 1 ? 126U : 127U));
    frame += big_endian(length, form == 1 ? 2 : 8);
  }
  frame += masked ? draw.bytes(4) : "";
  return frame + draw.bytes(std::min<std::uint64_t>(length, draw.below(6000)));
}

/// A message in pieces, with whatever comes between them.
std::string fragments(Draw& draw) {
  std::string text = ws_frame(draw.one_in(2) ? Opcode::kText : Opcode::kBinary,
                              draw.bytes(draw.below(100)), false);
  for (std::uint64_t i = draw.below(8); i > 0; --i) {
    const auto opcode = draw.one_in(3) ? Opcode::kPing : Opcode::kContinuation;
    text += ws_frame(opcode, draw.bytes(draw.below(140)), draw.one_in(2));
  }
  return text;
}

std::string json_value(Draw& draw, int depth) {
  switch (draw.below(depth > 0 ? 9 : 6)) {
    case 0:
      return std::to_string(static_cast<std::int64_t>(draw.below(0xFFFFFFFFFFFFFFFF)));
    case 1:
      return draw.one_in(2) ? "1e999" : "-0.0e-7";
    case 2:
      return draw.one_in(2) ? "true" : "null";
    case 3:
      return "\"" + std::string(draw.below(50), 'x') + "\\uD800\"";
    case 4:
      return "\"stop\"";
    case 5:
      return std::to_string(draw.below(1000));
    case 6:
      return "[" + json_value(draw, depth - 1) + "," + json_value(draw, depth - 1) + "]";
    default:
      return "{\"do\":" + json_value(draw, depth - 1) + "}";
  }
}

std::string wish(Draw& draw) {
  constexpr std::array<const char*, 7> kWishes = {R"({"do":"run"})",
                                                  R"({"do":"stop"})",
                                                  R"({"do":"pace","value":2})",
                                                  R"({"do":"speed","value":0.5})",
                                                  R"({"do":"soil","value":true})",
                                                  R"({"do":"fault","id":"stroke_0","value":true})",
                                                  R"({"do":"restart"})"};
  switch (draw.below(6)) {
    case 0:
      return kWishes[draw.below(kWishes.size())];
    case 1:
      return mutated(draw, kWishes[draw.below(kWishes.size())]);
    case 2:
      return std::string(draw.below(4096), draw.one_in(2) ? '[' : '{');
    case 3:
      return R"({"do":"fault","id":)" + json_value(draw, 3) + R"(,"value":)" + json_value(draw, 3) +
             "}";
    case 4:
      return R"({"do":)" + json_value(draw, 3) + "}";
    default:
      return json_value(draw, 5);
  }
}

}  // namespace

std::string Draw::bytes(std::size_t count) {
  std::string result(count, '\0');
  std::generate(result.begin(), result.end(), [this] { return static_cast<char>(below(256)); });
  return result;
}

std::string raw_bytes(Draw& draw) { return draw.bytes(draw.below(draw.one_in(10) ? 50000 : 500)); }

std::string odd_request(Draw& draw, int port) {
  const std::string own = "127.0.0.1:" + std::to_string(port);
  std::string extra;
  for (std::uint64_t i = draw.below(draw.one_in(10) ? 300 : 5); i > 0; --i) {
    extra += header(draw, port);
  }
  const std::string request = draw.one_in(2) ? ws_request(own, extra)
                                             : (draw.one_in(4) ? "POST" : "GET") +
                                                   std::string(" / HTTP/1.1\r\nHost: ") + own +
                                                   "\r\n" + extra + "\r\n";
  return mutated(draw, request);
}

std::string odd_frames(Draw& draw) {
  std::string text;
  for (std::uint64_t i = draw.below(4); i > 0; --i) {
    text += draw.one_in(3) ? fragments(draw) : odd_frame(draw);
  }
  return text;
}

std::string odd_wishes(Draw& draw) {
  std::string text;
  for (std::uint64_t i = draw.below(6); i > 0; --i) {
    text += ws_frame(Opcode::kText, wish(draw));
  }
  return text;
}

}  // namespace graben::test
