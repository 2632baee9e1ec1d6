# Benchmarks: built only when asked for (`make bench_flow bench_kernels`; scripts/bench does).
function(add_bench name)
  add_executable(bench_${name} EXCLUDE_FROM_ALL bench/${name}.cpp)
  target_include_directories(bench_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_definitions(bench_${name} PRIVATE CONFIG_DIR="${CMAKE_CURRENT_SOURCE_DIR}/config")
  target_link_libraries(bench_${name} PRIVATE monarch_run nlohmann_json::nlohmann_json ${ARGN})
endfunction()

add_bench(flow)
