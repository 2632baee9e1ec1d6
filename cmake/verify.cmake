# The verification of the flow solver: built only when asked for (`make verify`; monarch verify does).
file(GLOB verify_sources CONFIGURE_DEPENDS bench/verify/*.cpp)
add_executable(verify EXCLUDE_FROM_ALL ${verify_sources})
target_include_directories(verify PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR}/bench)
target_compile_definitions(verify PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config"
  VERIFY_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/bench/verify/data")
target_link_libraries(verify PRIVATE monarch_run nlohmann_json::nlohmann_json)
