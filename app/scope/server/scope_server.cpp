// SPDX-License-Identifier: Apache-2.0
#include "app/scope/server/scope_server.hpp"

#include <fmt/format.h>
#include <libwebsockets.h>

#include <array>
#include <atomic>
#include <stdexcept>

#include "app/scope/server/access.hpp"
#include "app/scope/server/frames_service.hpp"
#include "app/scope/server/page_service.hpp"

namespace graben::scope {
namespace {

/// How often it is looked whether to end, and pages are given what they may say.
constexpr lws_usec_t kTickUs = 100000;
/// Of a connection that has sent no whole request, and of one that asks for nothing more.
constexpr int kRequestTimeout_s = 2;
/// Pages, connections that ask for one, and what the library has itself.
/// A few hundred that never say a whole request are held beside a page that does.
constexpr unsigned kSocketsMost = 640;
/// So much is handed to the kernel at once; what it does not take waits in the library.
constexpr std::size_t kSendMostBytes = ClientStream::kMessageMostBytes;

/// A page of which nothing was heard for a while is asked, and after another while given up.
constexpr lws_retry_bo_t life_signs() {
  lws_retry_bo_t policy{};
  policy.secs_since_valid_ping = 20;
  policy.secs_since_valid_hangup = 60;
  return policy;
}
constexpr lws_retry_bo_t kLifeSigns = life_signs();

/// What the library's callbacks work on.
struct Services {
  PageService page;
  FramesService frames;
};

Services& services_of(lws* wsi) {
  return *static_cast<Services*>(lws_context_user(lws_get_context(wsi)));
}

std::string_view view(const void* in, std::size_t length) {
  return {static_cast<const char*>(in), in == nullptr ? 0 : length};
}

int on_http(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_HTTP:
      return services_of(wsi).page.on_request(wsi, view(in, length),
                                              *static_cast<PageProgress*>(user));
    case LWS_CALLBACK_HTTP_WRITEABLE:
      return services_of(wsi).page.on_writeable(wsi, *static_cast<PageProgress*>(user));
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return services_of(wsi).frames.on_upgrade(wsi, static_cast<const char*>(in));
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION:
      // A WebSocket of no subprotocol.
      return -1;
    default:
      return lws_callback_http_dummy(wsi, reason, user, in, length);
  }
}

int on_frames(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_ESTABLISHED:
      return services_of(wsi).frames.on_open(wsi);
    case LWS_CALLBACK_CLOSED:
      services_of(wsi).frames.on_close(wsi);
      return 0;
    case LWS_CALLBACK_WS_PEER_INITIATED_CLOSE:
      services_of(wsi).frames.on_closing(wsi);
      return 0;
    case LWS_CALLBACK_SERVER_WRITEABLE:
      return services_of(wsi).frames.on_writeable(wsi);
    case LWS_CALLBACK_RECEIVE:
      return services_of(wsi).frames.on_receive(wsi, view(in, length));
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      services_of(wsi).frames.wake();
      return 0;
    default:
      return lws_callback_http_dummy(wsi, reason, user, in, length);
  }
}

/// Of a page that only looks: what it says is heard by nobody, and ends its connection.
int on_look(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  switch (reason) {
    case LWS_CALLBACK_RECEIVE:
      return services_of(wsi).frames.refuse_word(wsi);
    case LWS_CALLBACK_EVENT_WAIT_CANCELLED:
      return 0;  // on_frames wakes the pages of both
    default:
      return on_frames(wsi, reason, user, in, length);
  }
}

/// What a callback throws must not pass through the library, which is C: the connection is closed.
template <lws_callback_function kCallback>
int guarded(lws* wsi, lws_callback_reasons reason, void* user, void* in, std::size_t length) {
  try {
    return kCallback(wsi, reason, user, in, length);
  } catch (const std::exception& error) {
    fmt::print(stderr, "graben scope: a connection is closed: {}\n", error.what());
    return -1;
  }
}

lws_protocols protocol(const char* name, lws_callback_function* callback) {
  lws_protocols result{};
  result.name = name;
  result.callback = callback;
  return result;
}

/// What the library has to say of connections. Whoever sends nonsense must not fill a disk by it.
void say_error(int /*level*/, const char* line) {
  constexpr int kMost = 20;
  static std::atomic<int> said{0};
  const int before = said.fetch_add(said < kMost + 1 ? 1 : 0);
  if (before < kMost) {
    fmt::print(stderr, "graben scope: {}", line);
  } else if (before == kMost) {
    fmt::print(stderr, "graben scope: more of this is not shown\n");
  }
}

}  // namespace

/// Does not move: the library has its address.
class ScopeServer::Work {
 public:
  Work(const ServerOptions& options, const Pages& pages, Show& show)
      : address_(listen_address(options.host, options.port)),
        services_{PageService(pages.scope, pages.operators, show.log(), options.host),
                  FramesService(show, options.host)} {
    protocols_[0] = protocol("http", &guarded<on_http>);
    protocols_[0].per_session_data_size = sizeof(PageProgress);
    protocols_[1] = protocol(FramesService::kProtocol, &guarded<on_frames>);
    protocols_[1].rx_buffer_size = Client::kMessageMostBytes;
    protocols_[1].tx_packet_size = kSendMostBytes;
    protocols_[2] = protocol(FramesService::kLookProtocol, &guarded<on_look>);
    protocols_[2].tx_packet_size = kSendMostBytes;
    lws_set_log_level(LLL_ERR, &say_error);
    context_ = make_context(options.port);
    if (context_ == nullptr) {
      throw std::runtime_error(fmt::format("{} port {}: can't listen", options.host, options.port));
    }
    port_ = lws_get_vhost_listen_port(lws_get_vhost_by_name(context_, "default"));
    url_ = url_of(address_, port_);
    tick_.work = this;
    schedule_tick();
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  ~Work() {
    lws_sul_cancel(&tick_.timer);
    lws_context_destroy(context_);
  }

  void run(const std::function<bool()>& should_stop) {
    while (!should_stop()) {
      if (lws_service(context_, 0) < 0) {
        throw std::runtime_error("the server cannot go on");
      }
    }
  }
  void wake() { lws_cancel_service(context_); }

  [[nodiscard]] const ListenAddress& address() const { return address_; }
  [[nodiscard]] const std::string& url() const { return url_; }
  [[nodiscard]] int port() const { return port_; }

 private:
  struct Tick {
    lws_sorted_usec_list_t timer{};  ///< First: the library gives its address.
    Work* work = nullptr;
  };

  lws_context* make_context(int port) {
    lws_context_creation_info info{};
    info.port = port;
    info.iface = address_.numeric.c_str();
    info.protocols = protocols_.data();
    info.user = &services_;
    // None other than the process has already.
    info.gid = static_cast<gid_t>(-1);
    info.uid = static_cast<uid_t>(-1);
    info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_VALIDATE_UTF8;
    info.options |= address_.is_ipv6 ? 0U : LWS_SERVER_OPTION_DISABLE_IPV6;
    info.timeout_secs = kRequestTimeout_s;
    info.keepalive_timeout = kRequestTimeout_s;
    info.fd_limit_per_thread = kSocketsMost;
    info.retry_and_idle_policy = &kLifeSigns;
    return lws_create_context(&info);
  }

  void schedule_tick() { lws_sul_schedule(context_, 0, &tick_.timer, &Work::on_tick, kTickUs); }

  static void on_tick(lws_sorted_usec_list_t* timer) {
    Work& work = *reinterpret_cast<Tick*>(timer)->work;
    work.services_.frames.tick();
    work.schedule_tick();
  }

  ListenAddress address_;
  Services services_;
  /// The last one is empty: the end of the list.
  std::array<lws_protocols, 4> protocols_{};
  lws_context* context_ = nullptr;
  int port_ = 0;
  std::string url_;
  Tick tick_;
};

ScopeServer::ScopeServer(const ServerOptions& options, const Pages& pages, Show& show)
    : work_(std::make_unique<Work>(options, pages, show)) {}

ScopeServer::~ScopeServer() = default;

const std::string& ScopeServer::url() const { return work_->url(); }
int ScopeServer::port() const { return work_->port(); }
bool ScopeServer::is_loopback() const { return work_->address().is_loopback; }
void ScopeServer::run(const std::function<bool()>& should_stop) { work_->run(should_stop); }
void ScopeServer::wake() { work_->wake(); }

}  // namespace graben::scope
