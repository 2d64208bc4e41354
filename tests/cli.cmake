# Tests of the program: the parser as a unit, and scripts that run what was built, cli_*.sh, each of which says in its
# head what it looks at.
target_link_libraries(test_arguments PRIVATE pointspec_cli)
target_link_libraries(test_scene PRIVATE pointspec_cli)

# What a script is told beside the program.
set(cli_completion_WORDS ${PROJECT_SOURCE_DIR})
set(cli_field_WORDS ${CMAKE_CURRENT_SOURCE_DIR}/field)
set(cli_healpy_WORDS ${PROJECT_SOURCE_DIR}/build/peers)
set(cli_npz_WORDS ${PROJECT_SOURCE_DIR})
set(cli_plan_WORDS $<TARGET_FILE:bench_plan>)
set(cli_stress_broken_WORDS ${PROJECT_SOURCE_DIR}/kernels)
set(cli_man_WORDS ${PROJECT_SOURCE_DIR})

file(GLOB_RECURSE scripts CONFIGURE_DEPENDS cli_*.sh)
# Sanitizers map address space without measure, and take several times as long.
if(POINTSPEC_SANITIZE)
  list(FILTER scripts EXCLUDE REGEX "cli_(signals|memory)\\.sh$")
endif()
if(NOT POINTSPEC_BUILD_BENCH)
  list(FILTER scripts EXCLUDE REGEX "cli_plan\\.sh$")
endif()
foreach(script IN LISTS scripts)
  get_filename_component(name ${script} NAME_WE)
  add_script_test(${name} "unit" ${script} $<TARGET_FILE:pointspec_program> ${${name}_WORDS})
  set_tests_properties(${name} PROPERTIES SKIP_RETURN_CODE 77) # what it needs may not be there, as mpirun
  if(name IN_LIST SWEEP_TESTS)
    set_tests_properties(${name} PROPERTIES LABELS "unit;sweep")
  endif()
  set_kernels(${name})
endforeach()
if(POINTSPEC_BUILD_BENCH)
  set_tests_properties(cli_plan PROPERTIES RUN_SERIAL TRUE)
endif()
