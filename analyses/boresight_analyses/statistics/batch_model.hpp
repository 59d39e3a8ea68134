// A model as the numerics of statistics see it: numbers in the unit cube (or of the standard normal space) in, one number
// out, many points at a time. A point whose value is not finite has failed.
#pragma once

#include <functional>
#include <vector>

namespace boresight {

using Point = std::vector<double>;
using Points = std::vector<Point>;

// One value per point. The value must depend on the point alone.
using BatchModel = std::function<std::vector<double>(const Points&)>;

}  // namespace boresight
