# The study of a controller in quasi-steady air: built only when asked for (monarch study-control does).
add_executable(study_control EXCLUDE_FROM_ALL bench/control/study.cpp bench/control/lateral.cpp)
target_include_directories(study_control PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src
  ${CMAKE_CURRENT_SOURCE_DIR}/bench)
target_compile_definitions(study_control PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config")
target_link_libraries(study_control PRIVATE monarch_trim)
