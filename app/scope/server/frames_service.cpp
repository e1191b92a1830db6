// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/frames_service.hpp"

#include <sys/socket.h>

#include <array>
#include <optional>

#include "app/scope/server/access.hpp"
#include "app/scope/server/request.hpp"
#include "app/scope/server/scope_server.hpp"

namespace graben::scope {
namespace {

int say_close(lws* wsi, lws_close_status status, std::string_view why) {
  std::array<unsigned char, 64> words{};
  const std::size_t length = why.copy(reinterpret_cast<char*>(words.data()), words.size());
  lws_close_reason(wsi, status, words.data(), length);
  return -1;
}

}  // namespace

const char* FramesService::refusal(lws* wsi, unsigned& status) const {
  status = HTTP_STATUS_FORBIDDEN;
  if (!has_own_host(wsi, listened_on_)) {
    return "This server is not known by that name.";
  }
  if (has_foreign_origin(wsi)) {
    return "A page from elsewhere gets nothing here.";
  }
  if (header_of(wsi, WSI_TOKEN_GET_URI) != "/frames") {
    status = HTTP_STATUS_NOT_FOUND;
    return "The only WebSocket here is /frames.";
  }
  if (const std::string protocol = header_of(wsi, WSI_TOKEN_PROTOCOL);
      protocol != kProtocol && protocol != kLookProtocol) {
    status = HTTP_STATUS_BAD_REQUEST;
    return "The WebSocket's subprotocol is graben-scope or graben-look.";
  }
  if (clients_.size() >= kClientsMost) {
    status = HTTP_STATUS_SERVICE_UNAVAILABLE;
    return "Too many pages look already.";
  }
  return nullptr;
}

int FramesService::on_upgrade(lws* wsi, std::string_view to) {
  if (to != "websocket") {
    return -1;
  }
  unsigned status = 0;
  const char* why = refusal(wsi, status);
  if (why == nullptr) {
    return 0;
  }
  return lws_return_http_status(wsi, status, why) != 0 ? -1 : 1;
}

int FramesService::on_open(lws* wsi) {
  if (clients_.size() >= kClientsMost) {
    return say_close(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, "too many pages look already");
  }
  if (const int most = show_.send_buffer_bytes(); most > 0) {
    // What cannot be set stays as the kernel has it: the page would only lag more.
    static_cast<void>(
        setsockopt(lws_get_socket_fd(wsi), SOL_SOCKET, SO_SNDBUF, &most, sizeof most));
  }
  clients_.emplace(wsi, Connection{Client(show_)});
  lws_callback_on_writable(wsi);
  return 0;
}

int FramesService::on_writeable(lws* wsi) {
  const auto found = clients_.find(wsi);
  if (found == clients_.end()) {
    return -1;
  }
  if (found->second.is_closing) {
    return 0;  // Nothing comes after a close, which the library sends.
  }
  // Room for what the library puts before it.
  buffer_.assign(LWS_PRE, '\0');
  const std::optional<Content> content = found->second.client.next(buffer_);
  hear(wsi, found->second);
  if (!content) {
    return 0;
  }
  const std::size_t size = buffer_.size() - LWS_PRE;
  auto* const data = reinterpret_cast<unsigned char*>(buffer_.data()) + LWS_PRE;
  if (lws_write(wsi, data, size, *content == Content::kJson ? LWS_WRITE_TEXT : LWS_WRITE_BINARY) <
      static_cast<int>(size)) {
    return -1;
  }
  lws_callback_on_writable(wsi);
  return 0;
}

int FramesService::on_receive(lws* wsi, std::string_view content) {
  const auto found = clients_.find(wsi);
  if (found == clients_.end()) {
    return -1;
  }
  const bool is_last = lws_is_final_fragment(wsi) != 0 && lws_remaining_packet_payload(wsi) == 0;
  const auto hang_up = [&](lws_close_status status, std::string_view why) {
    found->second.is_closing = true;
    return say_close(wsi, status, why);
  };
  switch (found->second.client.receive({content, lws_frame_is_binary(wsi) != 0, is_last})) {
    case Received::kBinary:
      return hang_up(LWS_CLOSE_STATUS_UNACCEPTABLE_OPCODE, "only JSON, as text");
    case Received::kTooLong:
      return hang_up(LWS_CLOSE_STATUS_MESSAGE_TOO_LARGE, "4096 bytes are the most");
    case Received::kTaken:
      break;
  }
  hear(wsi, found->second);
  lws_callback_on_writable(wsi);
  return 0;
}

void FramesService::on_closing(lws* wsi) {
  const auto found = clients_.find(wsi);
  if (found != clients_.end()) {
    found->second.is_closing = true;
  }
}

int FramesService::refuse_word(lws* wsi) {
  on_closing(wsi);
  return say_close(wsi, LWS_CLOSE_STATUS_POLICY_VIOLATION, "this page only looks");
}

/// Reads on, or lets the sender wait, as the client's budget has it.
void FramesService::hear(lws* wsi, Connection& connection) {
  const bool may_speak = connection.client.may_speak();
  if (may_speak != connection.is_heard) {
    connection.is_heard = may_speak;
    lws_rx_flow_control(wsi, may_speak ? 1 : 0);
  }
}

void FramesService::wake() {
  for (auto& [wsi, connection] : clients_) {
    lws_callback_on_writable(wsi);
  }
}

void FramesService::tick() {
  for (auto& [wsi, connection] : clients_) {
    connection.client.tick();
    hear(wsi, connection);
  }
}

}  // namespace graben::scope
