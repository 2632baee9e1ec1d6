// monarch trim without ROS: finds a periodic flight of a case.
#include <exception>
#include <iostream>

#include "monarch_flight/math/errors.h"
#include "monarch_flight/run/config_directory.h"
#include "monarch_flight/trim/command.h"

int main(int argc, char** argv) {
  try {
    const std::string config_dir = monarch_flight::configDirectory();
    const auto command = monarch_flight::trimCommand({argv + 1, argv + argc});
    return command.control ? monarch_flight::runControl(command, config_dir, std::cout)
                           : monarch_flight::runTrim(command, config_dir, std::cout);
  } catch (const monarch_flight::InputError& e) {
    std::cerr << "trim: " << e.what() << std::endl;
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "trim: " << e.what() << std::endl;
    return 1;
  }
}
