// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The WebSocket /frames: who may have one, and what goes over it.

#include <libwebsockets.h>

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "app/scope/server/client.hpp"
#include "app/scope/server/show.hpp"

namespace graben::scope {

class FramesService {
 public:
  FramesService(Show& show, std::string listened_on)
      : show_(show), listened_on_(std::move(listened_on)) {}

  static constexpr const char* kProtocol = "graben-scope";
  /// Of a page that only looks, as the operator's view: it gets the same and may say nothing.
  static constexpr const char* kLookProtocol = "graben-look";

  // For the library: 0 goes on, -1 hangs up.

  /// Somebody asks to go over to another protocol. Above 0: was answered that he may not.
  int on_upgrade(lws* wsi, std::string_view to);
  int on_open(lws* wsi);
  void on_close(lws* wsi) { clients_.erase(wsi); }
  int on_writeable(lws* wsi);
  int on_receive(lws* wsi, std::string_view content);
  /// The end of a connection that only looks and has said something, whatever that was.
  int refuse_word(lws* wsi);
  /// It ends, by its will or by ours: what the library says of that is the last word.
  void on_closing(lws* wsi);

  /// There may be something to send to every page.
  void wake();
  /// To be called ten times a second.
  void tick();

 private:
  struct Connection {
    Client client;
    bool is_heard = true;
    bool is_closing = false;  ///< It was told so, and is sent no more.
  };

  [[nodiscard]] const char* refusal(lws* wsi, unsigned& status) const;
  static void hear(lws* wsi, Connection& connection);

  Show& show_;
  std::string listened_on_;
  std::unordered_map<lws*, Connection> clients_;
  std::string buffer_;  ///< Of what is being sent.
};

}  // namespace graben::scope
