// An index function as UM-Bridge's protocol 1.0 has it (Seelinger and others 2023, "UM-Bridge: uncertainty quantification and
// modeling bridge", JOSS 8(83), 4748; um-bridge-benchmarks.readthedocs.io): requests and answers in JSON, without their transport.
//
//   GET  /Info                                  {"protocolVersion": 1.0, "models": ["NAME"]}
//   POST /ModelInfo, /InputSizes, /OutputSizes  {"name": "NAME"}
//   POST /Evaluate       {"name", "input": [[x1, x2, ...]]}                          {"output": [[index]]}
//   POST /Gradient       {"name", "input", "outWrt": 0, "inWrt": 0, "sens": [s]}     {"output": [s d/dx1, s d/dx2, ...]}
//   POST /ApplyJacobian  {"name", "input", "outWrt": 0, "inWrt": 0, "vec": [v1, ..]} {"output": [sum v d/dx]}
//
// The model has one input vector, its numbers in SI, and one output vector of one number, the index in SI. Numbers travel with all
// their digits. What is wrong is {"error": {"type", "message"}}.
#pragma once

#include <atomic>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "boresight_analyses/function/index_function.hpp"

namespace boresight::app {

struct UmBridgeAnswer {
  int status = 200;             // of HTTP
  std::string body;             // JSON
  double motion_seconds = 0.0;  // wall time that the motions took
};

// type: "InvalidInput", "ModelNotFound", "UnsupportedFeature", ...
UmBridgeAnswer umbridge_error(int status, const std::string& type, const std::string& message);

class UmBridge {
 public:
  UmBridge(std::shared_ptr<const IndexFunction> function, std::string name);

  const std::string& name() const { return name_; }
  UmBridgeAnswer info() const;
  // endpoint: "/Evaluate". From many threads. stop: an evaluation then ends soon, and its answer says so.
  UmBridgeAnswer answer(const std::string& endpoint, const std::string& body, const std::atomic<bool>& stop) const;
  // Whether it follows motions, which take their time.
  static bool computes(const std::string& endpoint);

 private:
  UmBridgeAnswer evaluate(const nlohmann::json& request, const std::atomic<bool>& stop) const;
  UmBridgeAnswer slopes(const nlohmann::json& request, bool gradient, const std::atomic<bool>& stop) const;

  std::shared_ptr<const IndexFunction> function_;
  std::string name_;
};

}  // namespace boresight::app
