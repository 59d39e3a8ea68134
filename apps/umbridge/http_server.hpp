// UM-Bridge over HTTP: connections, limits, and how it ends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "umbridge/umbridge.hpp"

namespace boresight::app {

struct ServerOptions {
  std::string address = "127.0.0.1";
  int port = 4242;                   // 0: any that is free
  int jobs = 1;                      // motions at once; further requests wait
  double longest = 60.0;             // wall time of one request's motion and of its waiting before [s]
  std::size_t most_bytes = 1 << 20;  // of a request's body
  std::function<bool()> ended = {};  // asked often: then the server ends
};

struct ServerCount {
  std::uint64_t answered = 0, refused = 0;  // refused: with an error
};

class HttpServer {
 public:
  // Takes the port. Throws ComputationError where it cannot be had.
  HttpServer(const UmBridge& model, ServerOptions options);
  ~HttpServer();

  int port() const;
  // Answers until it is ended: motions under way are stopped, and everybody has an answer.
  ServerCount serve();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace boresight::app
