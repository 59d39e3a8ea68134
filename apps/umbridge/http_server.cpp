#include "umbridge/http_server.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <chrono>
#include <list>
#include <mutex>
#include <semaphore>
#include <thread>

#include "boresight/mechanism/error.hpp"

namespace boresight::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostConnections = 64;  // at once; further ones wait to be taken
constexpr int kPatience = 10;         // with a connection that says nothing [s]

}  // namespace

struct HttpServer::Server {
  const UmBridge& model;
  ServerOptions options;
  httplib::Server http;
  int port = 0;
  std::counting_semaphore<4096> free;
  std::atomic<std::uint64_t> answered{0}, refused{0};

  struct Work {
    Clock::time_point end;
    std::atomic<bool> stop{false};
  };
  std::mutex mutex;
  std::list<Work> under_way;
  std::atomic<bool> ending{false};

  Server(const UmBridge& bridge, ServerOptions asked) : model(bridge), options(std::move(asked)), free(options.jobs) {}

  void send(httplib::Response& response, const UmBridgeAnswer& answer) {
    ++(answer.status == 200 ? answered : refused);
    response.status = answer.status;
    // Seconds of the motion alone, by the W3C's Server Timing: what is left of a request's time is the way there and back.
    if (answer.motion_seconds > 0.0)
      response.set_header("Server-Timing", fmt::format("motion;dur={:.6f}", 1e3 * answer.motion_seconds));
    response.set_content(answer.body, "application/json");
  }

  // Waits for its turn, and watches the time.
  UmBridgeAnswer compute(const std::string& endpoint, const std::string& body) {
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.longest));
    if (!free.try_acquire_until(end))
      return umbridge_error(503, "Busy", "waited as long as a request may take, while others were computed");
    std::list<Work>::iterator work;
    {
      const std::scoped_lock lock(mutex);
      work = under_way.emplace(under_way.end());
      work->end = end;
      if (ending) work->stop = true;
    }
    UmBridgeAnswer answer;
    try {
      answer = model.answer(endpoint, body, work->stop);
    } catch (const std::exception& error) {
      answer = umbridge_error(500, "ComputationFailed", error.what());
    }
    {
      const std::scoped_lock lock(mutex);
      under_way.erase(work);
    }
    free.release();
    return answer;
  }

  // A body as it comes, however its length is told: more than is allowed is not kept.
  bool read(const httplib::Request& request, const httplib::ContentReader& reader, std::string& body,
            UmBridgeAnswer& refusal) {
    if (request.is_multipart_form_data()) {
      refusal = umbridge_error(415, "InvalidInput", "expected JSON, found a form");
      return false;
    }
    bool too_long = false;
    const bool whole = reader([&](const char* data, std::size_t size) {
      too_long = body.size() + size > options.most_bytes;
      if (!too_long) body.append(data, size);
      return !too_long;
    });
    if (whole) return true;
    const std::string length = request.get_header_value("Content-Length");
    too_long =
        too_long || (!length.empty() && std::strtod(length.c_str(), nullptr) > static_cast<double>(options.most_bytes));
    refusal = too_long
                  ? umbridge_error(413, "InvalidInput", fmt::format("expected at most {} bytes", options.most_bytes))
                  : umbridge_error(400, "InvalidInput", "the request ended before its body");
    return false;
  }

  void take_port() {
    http.new_task_queue = [] { return new httplib::ThreadPool(kMostConnections); };
    http.set_payload_max_length(options.most_bytes);
    // Not the library's SO_REUSEPORT, with which a second server would take the same port, and answer every other question.
    http.set_socket_options([](socket_t socket) {
      const int yes = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.set_tcp_nodelay(true);  // else head and body of an answer wait for each other, 40 ms
    http.set_keep_alive_max_count(1'000'000'000);
    http.set_keep_alive_timeout(kPatience);
    http.set_read_timeout(kPatience);
    http.set_write_timeout(kPatience);
    http.Get("/Info", [this](const httplib::Request&, httplib::Response& response) { send(response, model.info()); });
    http.Post("/.*", [this](const httplib::Request& request, httplib::Response& response,
                            const httplib::ContentReader& reader) {
      std::string body;
      UmBridgeAnswer answer;
      if (!read(request, reader, body, answer)) {
        response.set_header("Connection", "close");
        return send(response, answer);
      }
      static const std::atomic<bool> never{false};
      send(response,
           UmBridge::computes(request.path) ? compute(request.path, body) : model.answer(request.path, body, never));
    });
    // What never comes to a model: unknown addresses, requests that are none.
    http.set_error_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (!response.body.empty()) return;
      const int status = response.status;
      send(response, umbridge_error(status, status == 404 ? "NotFound" : "InvalidInput",
                                    status == 404 ? "found " + request.method + " " + request.path +
                                                        ", expected an address of UM-Bridge's protocol 1.0"
                                    : status == 413 ? fmt::format("expected at most {} bytes", options.most_bytes)
                                                    : "the request is none of HTTP"));
    });
    http.set_exception_handler([this](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
      send(response, umbridge_error(500, "ComputationFailed", "a fault in the program itself"));
    });
    if (options.port == 0)
      port = http.bind_to_any_port(options.address);
    else if (http.bind_to_port(options.address, options.port))
      port = options.port;
    if (port <= 0)
      throw ComputationError(
          fmt::format("cannot listen on {} port {}: it is taken, or not this machine's; --port 0 takes a free one",
                      options.address, options.port));
  }

  // Ends motions that take too long, and everything where that is wanted.
  void watch(const std::stop_token& done) {
    while (!done.stop_requested()) {
      const bool end = options.ended && options.ended();
      {
        const std::scoped_lock lock(mutex);
        ending = ending || end;
        for (Work& work : under_way)
          if (ending || Clock::now() > work.end) work.stop = true;
      }
      if (end && http.is_running()) http.stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
};

HttpServer::HttpServer(const UmBridge& model, ServerOptions options)
    : server_(std::make_unique<Server>(model, std::move(options))) {
  server_->take_port();
}
HttpServer::~HttpServer() = default;

int HttpServer::port() const { return server_->port; }

ServerCount HttpServer::serve() {
  const std::jthread watch([this](const std::stop_token& done) { server_->watch(done); });
  server_->http.listen_after_bind();
  return {server_->answered, server_->refused};
}

}  // namespace boresight::app
