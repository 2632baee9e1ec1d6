// monarch inverse-dynamics without ROS: what a flown motion needs besides air and gravity.
#include "monarch_flight/run/inverse_dynamics.h"

#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/config_directory.h"

namespace {

using monarch_flight::InputError;

std::map<std::string, std::string> arguments(int argc, char** argv) {
  std::map<std::string, std::string> values = {{"from", "0"}, {"to", "-1"}};
  for (int i = 1; i < argc; ++i) {
    const std::string text = argv[i];
    const std::size_t at = text.find(":=");
    const std::string key = text.substr(0, at);
    if (at == std::string::npos || (key != "run" && key != "from" && key != "to")) {
      throw InputError("'" + text + "': must be run:=FOLDER, from:=FLAP or to:=FLAP");
    }
    values[key] = text.substr(at + 2);
  }
  if (values.count("run") == 0) throw InputError("run: is missing; give run:=flights/<run>");
  return values;
}

double number(const std::map<std::string, std::string>& values, const std::string& key) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(values.at(key), &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != values.at(key).size()) {
    throw InputError(key + ":=" + values.at(key) + ": must be a number of flaps");
  }
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto values = arguments(argc, argv);
    monarch_flight::runInverseDynamics(values.at("run"), number(values, "from"),
                                       number(values, "to"), monarch_flight::configDirectory(),
                                       std::cout);
    return 0;
  } catch (const InputError& e) {
    std::cerr << "inverse_dynamics: " << e.what() << std::endl;
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "inverse_dynamics: " << e.what() << std::endl;
    return 1;
  }
}
