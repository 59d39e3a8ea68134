// Results as lists of numbers, and back, bit for bit: what a store of samples keeps of them. Of a type of one's own:
//
//   void fields(Numbers& numbers, Measurement& m) { numbers(m.values, m.value, m.refusal); }
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace boresight {

class Numbers {
 public:
  // Of a value; of what was kept of one, which throws std::out_of_range where it is not of this type.
  template <typename Value>
  static std::vector<double> of(Value value) {
    Numbers numbers({}, true);
    numbers(value);
    return std::move(numbers.list_);
  }
  template <typename Value>
  static Value back(std::vector<double> list) {
    Numbers numbers(std::move(list), false);
    Value value{};
    numbers(value);
    if (numbers.at_ != numbers.list_.size()) throw std::out_of_range("more numbers than the value has");
    return value;
  }

  template <typename... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }

 private:
  Numbers(std::vector<double> list, bool writing) : list_(std::move(list)), writing_(writing) {}

  void one(double& value) {
    if (writing_)
      list_.push_back(value);
    else
      value = list_.at(at_++);
  }
  template <typename Value>
  requires std::is_integral_v<Value> || std::is_enum_v<Value>
  void one(Value& value) {  // up to 2^53
    auto number = static_cast<double>(value);
    one(number);
    value = static_cast<Value>(number);
  }
  template <typename Value>
  requires std::is_class_v<Value>
  void one(Value& value) { fields(*this, value); }
  void one(std::string& text) {
    sized(text);
    for (char& c : text) one(c);
  }
  template <typename Value>
  void one(std::vector<Value>& values) {
    sized(values);
    for (Value& value : values) one(value);
  }
  template <typename First, typename Second>
  void one(std::pair<First, Second>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <typename Value>
  void one(std::optional<Value>& value) {
    bool there = value.has_value();
    one(there);
    if (there && !value) value.emplace();
    if (there) one(*value);
  }
  template <int Rows, int Columns>
  void one(Eigen::Matrix<double, Rows, Columns>& matrix) {
    Eigen::Index rows = matrix.rows(), columns = matrix.cols();
    (*this)(rows, columns);
    if (!writing_) {
      if (rows < 0 || columns < 0 || rows * columns > left())
        throw std::out_of_range("a matrix larger than what is kept");
      matrix.resize(rows, columns);
    }
    for (Eigen::Index k = 0; k < matrix.size(); ++k) one(matrix.data()[k]);
  }
  void one(Eigen::Quaterniond& q) { one(q.coeffs()); }

  template <typename Container>
  void sized(Container& container) {
    std::size_t size = container.size();
    one(size);
    if (!writing_ && size > static_cast<std::size_t>(left()))
      throw std::out_of_range("a list longer than what is kept");
    container.resize(size);
  }
  std::ptrdiff_t left() const { return static_cast<std::ptrdiff_t>(list_.size() - at_); }

  std::vector<double> list_;
  bool writing_;
  std::size_t at_ = 0;
};

}  // namespace boresight
