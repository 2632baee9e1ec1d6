#pragma once
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

#include "monarch_flight/insect/prescribed_motion.h"
#include "monarch_flight/math/eigen.h"

namespace monarch_flight {

/// Goes through a state number by number, to write it down or to set it: whoever has a state shows
/// it once, for both ways. Names are the state's own; they are those of a checkpoint's datasets.
class StateVisitor {
 public:
  virtual ~StateVisitor() = default;
  /// Whether the values are being set.
  virtual bool loading() const = 0;
  /// Whether there is such a value to load; true when nothing is loaded.
  virtual bool has(const char* name) const = 0;
  /// `count` numbers, bit for bit.
  virtual void numbers(const char* name, double* values, std::size_t count) = 0;
  /// Bytes of any length; they may be moved away when they are written down.
  virtual void bytes(const char* name, std::vector<char>& value) = 0;

  void operator()(const char* name, double& value) { numbers(name, &value, 1); }
  /// Integers below 2^53, and truth values.
  template <class T>
  std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>> operator()(const char* name,
                                                                          T& value) {
    double number = static_cast<double>(value);
    numbers(name, &number, 1);
    if (loading()) value = static_cast<T>(number);
  }
  template <class Derived>
  void operator()(const char* name, Eigen::PlainObjectBase<Derived>& values) {
    numbers(name, values.data(), static_cast<std::size_t>(values.size()));
  }
  void operator()(const char* name, std::string& text) {
    std::vector<char> value(text.begin(), text.end());
    bytes(name, value);
    if (loading()) text.assign(value.begin(), value.end());
  }
  void operator()(const char* name, Interface& interface);
  void operator()(const char* name, PrescribedState& prescribed);
  void operator()(const char* name, Loads& loads);
};

/// A state as a row of numbers in memory: taken and put back without a file, and without an
/// allocation once it has been taken. It holds no bytes.
class StateSnapshot {
 public:
  /// `show` visits the state.
  template <class Show>
  void take(Show&& show) {
    numbers_.clear();
    Pass pass(numbers_, false);
    show(pass);
  }
  template <class Show>
  void putBack(Show&& show) {
    Pass pass(numbers_, true);
    show(pass);
  }

 private:
  class Pass : public StateVisitor {
   public:
    Pass(std::vector<double>& numbers, bool loading) : numbers_(numbers), loading_(loading) {}
    bool loading() const override { return loading_; }
    bool has(const char*) const override { return true; }
    void numbers(const char* name, double* values, std::size_t count) override;
    void bytes(const char* name, std::vector<char>& value) override;

   private:
    std::vector<double>& numbers_;
    bool loading_;
    std::size_t at_ = 0;
  };
  std::vector<double> numbers_;
};

}  // namespace monarch_flight
