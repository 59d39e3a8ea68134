#include "umbridge/umbridge.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <numeric>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"

namespace boresight::app {
namespace {

using Json = nlohmann::json;

// What is wrong with a request.
struct Refusal {
  int status;
  std::string type, message;
};

constexpr char kStopped[] =
    "the motion was stopped before its end: it took longer than the server allows, or the server ended";

[[noreturn]] void refuse(const std::string& message) { throw Refusal{400, "InvalidInput", message}; }

std::vector<double> numbers(const Json& list, const std::string& key) {
  if (!list.is_array()) refuse(key + ": found " + list.type_name() + ", expected a list of numbers");
  std::vector<double> values;
  for (const Json& value : list) {
    if (!value.is_number()) refuse(key + ": found " + value.type_name() + ", expected numbers");
    values.push_back(value.get<double>());
  }
  return values;
}

std::vector<double> numbers(const Json& request, const std::string& key, std::size_t count) {
  if (!request.contains(key)) refuse(key + ": found nothing, expected a list of numbers");
  std::vector<double> values = numbers(request[key], key);
  if (values.size() != count)
    refuse(key + ": found " + std::to_string(values.size()) + " numbers, expected " + std::to_string(count));
  return values;
}

std::vector<double> point_of(const Json& request) {
  if (!request.contains("input")) refuse("input: found nothing, expected a list with one list of numbers");
  const Json& input = request["input"];
  if (!input.is_array() || input.size() != 1)
    refuse("input: expected a list with one list of numbers, as this model has one input vector");
  return numbers(input[0], "input");
}

void check_which(const Json& request, const char* key) {
  if (!request.contains(key) || !request[key].is_number_integer() || request[key] != 0)
    refuse(std::string(key) + ": expected 0, as this model has one input vector and one output vector");
}

// This model has no choices to make.
void check_config(const Json& request) {
  if (!request.contains("config") || request["config"].is_null()) return;
  const Json& config = request["config"];
  if (!config.is_object() || !config.empty()) refuse("config: expected {}, as this model has no options");
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

UmBridgeAnswer umbridge_error(int status, const std::string& type, const std::string& message) {
  return {status,
          Json{{"error", {{"type", type}, {"message", message}}}}.dump(-1, ' ', false, Json::error_handler_t::replace),
          0.0};
}

UmBridge::UmBridge(std::shared_ptr<const IndexFunction> function, std::string name)
    : function_(std::move(function)), name_(std::move(name)) {}

UmBridgeAnswer UmBridge::info() const { return {200, Json{{"protocolVersion", 1.0}, {"models", {name_}}}.dump(), 0.0}; }

bool UmBridge::computes(const std::string& endpoint) {
  return endpoint == "/Evaluate" || endpoint == "/Gradient" || endpoint == "/ApplyJacobian";
}

UmBridgeAnswer UmBridge::evaluate(const Json& request, const std::atomic<bool>& stop) const {
  const std::vector<double> point = point_of(request);
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = function_->at(point, stop);
  const double seconds = seconds_since(start);
  if (outcome.status == Outcome::Status::not_reached) throw Refusal{503, "Stopped", kStopped};
  if (outcome.status == Outcome::Status::failed) throw Refusal{500, "ComputationFailed", outcome.message};
  return {200, Json{{"output", {{outcome.value}}}}.dump(), seconds};
}

UmBridgeAnswer UmBridge::slopes(const Json& request, bool gradient, const std::atomic<bool>& stop) const {
  check_which(request, "outWrt");
  check_which(request, "inWrt");
  const std::vector<double> point = point_of(request);
  const std::vector<double> factor =
      numbers(request, gradient ? "sens" : "vec", gradient ? 1 : function_->inputs().size());
  if (const std::string why = function_->why_no_slopes(); !why.empty()) throw Refusal{400, "UnsupportedFeature", why};
  const auto start = std::chrono::steady_clock::now();
  std::vector<double> by = function_->slopes_at(point, stop).by;
  const double seconds = seconds_since(start);
  if (gradient)
    for (double& slope : by) slope *= factor[0];
  else
    by = {std::inner_product(by.begin(), by.end(), factor.begin(), 0.0)};
  return {200, Json{{"output", by}}.dump(), seconds};
}

UmBridgeAnswer UmBridge::answer(const std::string& endpoint, const std::string& body,
                                const std::atomic<bool>& stop) const {
  try {
    const Json request = Json::parse(body);
    if (!request.is_object()) refuse("found " + std::string(request.type_name()) + ", expected an object");
    if (!request.contains("name") || !request["name"].is_string())
      refuse("name: expected the model's name, \"" + name_ + "\"");
    if (const auto name = request["name"].get<std::string>(); name != name_)
      throw Refusal{400, "ModelNotFound", "found \"" + name + "\", expected \"" + name_ + "\""};
    check_config(request);
    if (endpoint == "/ModelInfo") {
      const bool has_slopes = function_->why_no_slopes().empty();
      return {
          200,
          Json{{"support",
                {{"Evaluate", true}, {"Gradient", has_slopes}, {"ApplyJacobian", has_slopes}, {"ApplyHessian", false}}}}
              .dump(),
          0.0};
    }
    if (endpoint == "/InputSizes") return {200, Json{{"inputSizes", {function_->inputs().size()}}}.dump(), 0.0};
    if (endpoint == "/OutputSizes") return {200, Json{{"outputSizes", {1}}}.dump(), 0.0};
    if (endpoint == "/Evaluate") return evaluate(request, stop);
    if (endpoint == "/Gradient") return slopes(request, true, stop);
    if (endpoint == "/ApplyJacobian") return slopes(request, false, stop);
    if (endpoint == "/ApplyHessian")
      throw Refusal{400, "UnsupportedFeature", "a motion through impacts has no second derivatives here"};
    throw Refusal{404, "NotFound", "found " + endpoint + ", expected an address of UM-Bridge's protocol 1.0"};
  } catch (const Refusal& refusal) {
    return umbridge_error(refusal.status, refusal.type, refusal.message);
  } catch (const Json::exception& error) {
    return umbridge_error(400, "InvalidInput", "no JSON: " + std::string(error.what()));
  } catch (const InputError& error) {
    return umbridge_error(400, "InvalidInput", error.what());
  } catch (const ComputationError& error) {
    return umbridge_error(500, "ComputationFailed", error.what());
  } catch (const Interrupted&) {
    return umbridge_error(503, "Stopped", kStopped);
  }
}

}  // namespace boresight::app
