# Programs of the core: one target monarch_program_<name> per file of src/programs, named after it.
foreach(program trim inverse_dynamics)
  add_executable(monarch_program_${program} src/programs/${program}.cpp)
  set_target_properties(monarch_program_${program} PROPERTIES OUTPUT_NAME ${program})
  target_link_libraries(monarch_program_${program} PRIVATE monarch_trim)
  list(APPEND CORE_PROGRAMS monarch_program_${program})
endforeach()
add_custom_target(monarch_programs DEPENDS ${CORE_PROGRAMS})
