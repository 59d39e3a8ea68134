#include "terminal/embedding.hpp"

#include <atomic>

namespace boresight::app {
namespace {

std::atomic<const Embedding*> current{nullptr};

}  // namespace

Embedded::Embedded(const Embedding& embedding) { current = &embedding; }
Embedded::~Embedded() { current = nullptr; }

const Embedding* embedding() { return current; }

}  // namespace boresight::app
