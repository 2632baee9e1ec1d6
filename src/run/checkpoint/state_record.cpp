#include "monarch_flight/run/state_record.h"

#include <hdf5.h>

#include <algorithm>
#include <utility>

namespace monarch_flight {
namespace {

// An identifier of HDF5, given back at the end of its scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) throw CheckpointError("HDF5 refuses " + what);
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: it stands for the identifier everywhere

 private:
  hid_t id_;
  Close close_;
};

void require(herr_t status, const std::string& what) {
  if (status < 0) throw CheckpointError("HDF5 refuses " + what);
}

// A file that lives in memory; HDF5's own messages on stderr are ours to give.
Handle memoryDriver() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  constexpr std::size_t kGrow = 1 << 20;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "a file in memory");
  require(H5Pset_fapl_core(access, kGrow, 0), "a file in memory");
  return Handle(H5Pcopy(access), H5Pclose, "a file in memory");
}

void write(hid_t file, const std::string& name, hid_t type, const void* data, std::size_t size) {
  const hsize_t count = size;
  const Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, name);
  const Handle set(
      H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
      name);
  if (size > 0) require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

template <class T>
std::vector<T> read(hid_t set, hid_t type, const std::string& name) {
  const Handle space(H5Dget_space(set), H5Sclose, name);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0) throw CheckpointError("HDF5 refuses " + name);
  std::vector<T> values(static_cast<std::size_t>(count));
  if (count > 0) require(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

void readInto(StateRecord& record, hid_t file, const std::string& name) {
  const Handle set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  const Handle type(H5Dget_type(set), H5Tclose, name);
  if (H5Tget_class(type) == H5T_FLOAT)
    record.numbers[name] = read<double>(set, H5T_NATIVE_DOUBLE, name);
  else
    record.bytes[name] = read<char>(set, H5T_NATIVE_CHAR, name);
}

herr_t addName(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->push_back(name);
  return 0;
}

}  // namespace

std::vector<char> StateRecord::toHdf5() const {
  const Handle access = memoryDriver();
  const Handle file(H5Fcreate("state", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "a new file");
  for (const auto& [name, values] : numbers)
    write(file, name, H5T_NATIVE_DOUBLE, values.data(), values.size());
  for (const auto& [name, values] : bytes)
    write(file, name, H5T_NATIVE_CHAR, values.data(), values.size());
  require(H5Fflush(file, H5F_SCOPE_GLOBAL), "a file in memory");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) throw CheckpointError("HDF5 refuses a file in memory");
  std::vector<char> image(static_cast<std::size_t>(size));
  if (H5Fget_file_image(file, image.data(), image.size()) != size)
    throw CheckpointError("HDF5 refuses a file in memory");
  return image;
}

StateRecord StateRecord::fromHdf5(const std::vector<char>& image, const std::string& name) {
  const Handle access = memoryDriver();
  require(H5Pset_file_image(access, const_cast<char*>(image.data()), image.size()), name);
  const hid_t opened = H5Fopen("state", H5F_ACC_RDONLY, access);
  if (opened < 0) throw CheckpointError(name + " is no HDF5 file");
  const Handle file(opened, H5Fclose, name);
  std::vector<std::string> names;
  require(H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, addName, &names), name);
  StateRecord record;
  for (const std::string& each : names) readInto(record, file, each);
  return record;
}

void StateWriter::numbers(const char* name, double* values, std::size_t count) {
  if (!record_.numbers.emplace(name, std::vector<double>(values, values + count)).second)
    throw std::logic_error(std::string("state: two values are called ") + name);
}

void StateWriter::bytes(const char* name, std::vector<char>& value) {
  if (!record_.bytes.emplace(name, std::move(value)).second)
    throw std::logic_error(std::string("state: two values are called ") + name);
}

bool StateReader::has(const char* name) const {
  return record_.numbers.count(name) > 0 || record_.bytes.count(name) > 0;
}

void StateReader::numbers(const char* name, double* values, std::size_t count) {
  const auto found = record_.numbers.find(name);
  if (found == record_.numbers.end()) throw CheckpointError(name_ + " does not hold " + name);
  if (found->second.size() != count)
    throw CheckpointError(name_ + " holds " + std::to_string(found->second.size()) +
                          " numbers of " + name + ", not " + std::to_string(count));
  std::copy(found->second.begin(), found->second.end(), values);
}

void StateReader::bytes(const char* name, std::vector<char>& value) {
  const auto found = record_.bytes.find(name);
  if (found == record_.bytes.end()) throw CheckpointError(name_ + " does not hold " + name);
  value = found->second;
}

}  // namespace monarch_flight
