#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <system_error>

#include "monarch_flight/run/checkpoint_files.h"
#include "monarch_flight/run/output_file.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFormat = 5;
constexpr std::size_t kKept = 2;
constexpr char kManifest[] = "/manifest.json";
constexpr char kPrefix[] = "step_";
constexpr char kActive[] = ".active";
constexpr char kRefused[] = ".refused";

std::vector<char> readWhole(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  std::vector<char> bytes(size > 0 ? static_cast<std::size_t>(size) : 0);
  file.seekg(0);
  if (size < 0 || !file.read(bytes.data(), size)) throw CheckpointError(path + " cannot be read");
  return bytes;
}

std::string digest(const std::vector<char>& bytes) {
  return sha256Hex({bytes.data(), bytes.size()});
}

// Runs `action` of the file system; what it refuses is an OutputError.
void changing(const std::string& path, const std::function<void(std::error_code&)>& action) {
  std::error_code error;
  action(error);
  if (error)
    throw OutputError(path + " cannot be made (" + error.message() +
                      "): free space on that disk, or fly with checkpoint_every:=0");
}

// The manifest's own digest is that of its text without the digest.
std::string sealed(Json manifest) {
  manifest["sha256"] = sha256Hex(manifest.dump());
  return manifest.dump(2) + "\n";
}

Json unsealed(const std::string& path) {
  const std::vector<char> text = readWhole(path);
  Json manifest = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!manifest.is_object() || !manifest.contains("sha256") || !manifest["sha256"].is_string())
    throw CheckpointError(path + " is no manifest of a checkpoint");
  const std::string seal = manifest["sha256"];
  manifest.erase("sha256");
  if (sha256Hex(manifest.dump(-1, ' ', false, Json::error_handler_t::replace)) != seal)
    throw CheckpointError(path + " has changed since it was written (SHA-256)");
  if (manifest.value("format", 0) != kFormat)
    throw CheckpointError(path + " is of format " + std::to_string(manifest.value("format", 0)) +
                          ", this program reads format " + std::to_string(kFormat));
  return manifest;
}

/// The bytes of a file, if they are those of the manifest.
std::vector<char> verified(const std::string& path, const Json& entry) {
  std::vector<char> bytes = readWhole(path);
  const std::size_t size = entry.at("bytes");
  if (bytes.size() != size)
    throw CheckpointError(path + " has " + std::to_string(bytes.size()) + " bytes instead of " +
                          std::to_string(size));
  if (digest(bytes) != entry.at("sha256"))
    throw CheckpointError(path + " has changed since it was written (SHA-256)");
  return bytes;
}

// Every participant writes its part itself, a node perhaps on another machine.
void requirePart(const std::string& folder, const std::string& part,
                 const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (fs::path(file).stem() == part) return;
  }
  throw OutputError(folder + " lacks the part of " + part +
                    ": does its node write to another disk? Let the nodes of all machines share "
                    "this folder, or fly with checkpoint_every:=0");
}

// The step that a folder is named after; -1: it is no checkpoint that counts.
long stepOf(const std::string& name) {
  const std::string digits = name.rfind(kPrefix, 0) == 0 ? name.substr(sizeof kPrefix - 1) : "";
  const bool good = !digits.empty() && digits.size() <= 10 &&
                    digits.find_first_not_of("0123456789") == std::string::npos;
  return good ? std::stol(digits) : -1;
}

}  // namespace

std::string CheckpointFiles::path(std::uint32_t step) const {
  char name[32];
  std::snprintf(name, sizeof name, "%s%010u", kPrefix, step);
  return folder_ + "/" + name;
}

void CheckpointFiles::open(std::uint32_t step) const {
  const std::string active = path(step) + kActive;
  changing(active, [&](std::error_code& error) {
    fs::create_directories(folder_, error);
    for (auto entry = fs::directory_iterator(folder_, error); !error && entry != end(entry);
         entry.increment(error)) {
      if (entry->path().extension() == kActive) fs::remove_all(entry->path(), error);
    }
    if (!error) fs::create_directory(active, error);
  });
}

void CheckpointFiles::write(std::uint32_t step, const std::string& part,
                            const StateRecord& record) const {
  const std::vector<char> image = record.toHdf5();
  writeWhole(path(step) + kActive + "/" + part + ".h5", {image.data(), image.size()});
}

void CheckpointFiles::close(const CheckpointFacts& facts,
                            const std::vector<std::string>& parts) const {
  const std::string name = path(facts.step), active = name + kActive;
  Json manifest{{"format", kFormat},       {"version", facts.version},
                {"case", facts.case_name}, {"case_sha256", facts.case_sha256},
                {"step", facts.step},      {"ranks", facts.ranks},
                {"files", Json::object()}};
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(active)) files.push_back(entry.path().filename());
  std::sort(files.begin(), files.end());
  for (const std::string& part : parts) requirePart(active, part, files);
  for (const std::string& file : files) {
    const std::vector<char> bytes = readWhole(active + "/" + file);
    manifest["files"][file] = {{"bytes", bytes.size()}, {"sha256", digest(bytes)}};
  }
  writeWhole(active + kManifest, sealed(manifest));
  changing(name, [&](std::error_code& error) {
    fs::remove_all(name, error);
    if (!error) fs::rename(active, name, error);
  });
  syncFolderOf(name);
  const std::vector<std::uint32_t> all = steps();
  for (std::size_t i = kKept; i < all.size(); ++i) remove(all[i]);
}

std::vector<std::uint32_t> CheckpointFiles::steps() const {
  std::vector<std::uint32_t> found;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder_, error); !error && entry != end(entry);
       entry.increment(error)) {
    const long step = stepOf(entry->path().filename());
    if (step >= 0) found.push_back(static_cast<std::uint32_t>(step));
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

CheckpointFacts CheckpointFiles::verify(std::uint32_t step) const {
  const std::string where = path(step), file = where + kManifest;
  try {
    const Json manifest = unsealed(file);
    CheckpointFacts facts{manifest.at("step"), manifest.at("version"), manifest.at("case"),
                          manifest.at("case_sha256"), manifest.value("ranks", 0)};
    if (facts.step != step)
      throw CheckpointError(where + " is a checkpoint of step " + std::to_string(facts.step));
    for (const auto& [name, entry] : manifest.at("files").items())
      verified(where + "/" + name, entry);
    return facts;
  } catch (const Json::exception& e) {
    throw CheckpointError(file + " is no manifest of a checkpoint (" + e.what() + ")");
  }
}

StateRecord CheckpointFiles::read(std::uint32_t step, const std::string& part) const {
  const std::string where = path(step), file = part + ".h5";
  const Json files = unsealed(where + kManifest).at("files");
  if (!files.contains(file)) throw CheckpointError(where + " holds no " + file);
  return StateRecord::fromHdf5(verified(where + "/" + file, files.at(file)), where + "/" + file);
}

void CheckpointFiles::remove(std::uint32_t step) const noexcept {
  std::error_code ignored;
  fs::remove_all(path(step), ignored);
}

void CheckpointFiles::refuse(std::uint32_t step) const noexcept {
  std::error_code ignored;
  fs::remove_all(path(step) + kRefused, ignored);
  fs::rename(path(step), path(step) + kRefused, ignored);
}

}  // namespace monarch_flight
