#include "monarch_flight/ros_io/model_folder.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <vector>

#include "monarch_flight/ros_io/token_file.h"
#include "monarch_flight/run/sha256.h"
#include "monarch_flight/viz/urdf.h"

namespace monarch_flight {
namespace {

namespace fs = std::filesystem;

constexpr auto kKept = std::chrono::hours(24 * 30);
constexpr std::size_t kHash = 12;  // digits of it in a folder's name

bool isModel(const fs::path& folder) {
  static const std::regex name("model-.+-[0-9a-f]{" + std::to_string(kHash) + "}");
  return std::regex_match(folder.filename().string(), name);
}

/// Not one that a person has made.
bool isTokenOfOneRun(const fs::path& path) {
  if (path.filename().string().rfind("token_", 0) != 0) return false;
  std::ifstream file(path);
  std::string secret;
  std::getline(file, secret);
  return madeByACoordinator(secret);
}

bool isOld(const fs::path& path) {
  std::error_code failed;
  const auto used = fs::last_write_time(path, failed);
  return !failed && used < fs::file_time_type::clock::now() - kKept;
}

/// Nothing but what writeMeshes makes.
void removeModel(const fs::path& folder) {
  std::error_code failed;
  std::vector<fs::path> meshes;
  for (const auto& entry : fs::directory_iterator(folder, failed)) {
    const bool mesh = entry.symlink_status(failed).type() == fs::file_type::regular &&
                      entry.path().extension() == ".stl";
    if (failed || !mesh) return;
    meshes.push_back(entry.path());
  }
  for (const fs::path& mesh : meshes) fs::remove(mesh, failed);
  fs::remove(folder, failed);  // empty
}

/// Whatever cannot be removed stays.
void removeOld(const fs::path& place) {
  std::error_code failed;
  std::vector<fs::path> models, tokens;
  for (const auto& entry : fs::directory_iterator(place, failed)) {
    const fs::file_type type = entry.symlink_status(failed).type();
    if (failed || !isOld(entry.path())) continue;
    if (type == fs::file_type::directory && isModel(entry.path())) models.push_back(entry.path());
    if (type == fs::file_type::regular && isTokenOfOneRun(entry.path()))
      tokens.push_back(entry.path());
  }
  for (const fs::path& model : models) removeModel(model);
  for (const fs::path& token : tokens) fs::remove(token, failed);
}

}  // namespace

std::string rosHome() {
  if (const char* home = std::getenv("ROS_HOME")) return home;
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr ? home : ".") + "/.ros";
}

std::string keptModel(const Case& c, const std::string& home) {
  const fs::path place = fs::path(home) / "monarch_flight";
  // By what it looks like: two cases of one name may differ.
  const fs::path folder =
      place / ("model-" + c.name + "-" + sha256Hex(insectUrdf(c.insect, "")).substr(0, kHash));
  std::error_code failed;
  fs::create_directories(folder, failed);
  fs::last_write_time(folder, fs::file_time_type::clock::now(), failed);  // before others look
  writeMeshes(c.insect, folder.string());
  removeOld(place);
  return folder.string();
}

}  // namespace monarch_flight
