#pragma once
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "monarch_flight/coupling/state_visitor.h"

namespace monarch_flight {

/// A checkpoint cannot be used: message names file and reason.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A state by names, as a file of a checkpoint holds it.
class StateRecord {
 public:
  std::map<std::string, std::vector<double>> numbers;
  std::map<std::string, std::vector<char>> bytes;

  /// An HDF5 file in memory: a dataset of 64-bit floats or of bytes for each name.
  std::vector<char> toHdf5() const;
  /// `name` stands for the file in messages. Throws CheckpointError.
  static StateRecord fromHdf5(const std::vector<char>& image, const std::string& name);
};

/// Writes a shown state down.
class StateWriter : public StateVisitor {
 public:
  explicit StateWriter(StateRecord& record) : record_(record) {}
  bool loading() const override { return false; }
  bool has(const char*) const override { return true; }
  void numbers(const char* name, double* values, std::size_t count) override;
  void bytes(const char* name, std::vector<char>& value) override;

 private:
  StateRecord& record_;
};

/// Sets a shown state. Throws CheckpointError for what the record does not hold.
class StateReader : public StateVisitor {
 public:
  /// `name` stands for the record in messages.
  StateReader(const StateRecord& record, std::string name)
      : record_(record), name_(std::move(name)) {}
  bool loading() const override { return true; }
  bool has(const char* name) const override;
  void numbers(const char* name, double* values, std::size_t count) override;
  void bytes(const char* name, std::vector<char>& value) override;

 private:
  const StateRecord& record_;
  std::string name_;
};

}  // namespace monarch_flight
