# Tests that are scripts. Sanitizers bring symbols and libraries of their own, so what looks at the
# built files runs without them.
function(add_script_test name label)
  add_test(NAME ${name} COMMAND bash ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS "${label}" TIMEOUT ${TEST_PATIENCE})
endfunction()

add_script_test(headers "unit;sweep" ${CMAKE_CURRENT_SOURCE_DIR}/project/test_headers.sh
  ${PROJECT_SOURCE_DIR} ${CMAKE_C_COMPILER})
add_script_test(copied_checkout "unit;sources" ${CMAKE_CURRENT_SOURCE_DIR}/project/copied_checkout.sh ${PROJECT_SOURCE_DIR})
add_script_test(stages "unit;sources" ${CMAKE_CURRENT_SOURCE_DIR}/project/stages.sh ${PROJECT_SOURCE_DIR})
add_script_test(changed_tests "unit;sources" ${CMAKE_CURRENT_SOURCE_DIR}/project/changed_tests.sh
  ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
add_script_test(gpu_kernel_tests "unit;sources" ${CMAKE_CURRENT_SOURCE_DIR}/project/gpu_kernel_tests.sh
  ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
# Pages and the reference of the header are made without a warning; skipped where there is no doxygen or mkdocs.
add_script_test(site "unit;sources" ${PROJECT_SOURCE_DIR}/scripts/site.sh ${PROJECT_BINARY_DIR}/site)
set_tests_properties(site PROPERTIES SKIP_RETURN_CODE 77)
add_script_test(no_blas unit ${CMAKE_CURRENT_SOURCE_DIR}/project/no_blas.sh
  $<TARGET_FILE:pointspec_program> $<TARGET_FILE:pointspec>)
add_script_test(packages "unit;sources" ${CMAKE_CURRENT_SOURCE_DIR}/project/packages.sh
  $<TARGET_FILE:pointspec_program> ${PROJECT_SOURCE_DIR})
set_tests_properties(packages PROPERTIES SKIP_RETURN_CODE 77)
set_kernels(packages)
if(NOT POINTSPEC_SANITIZE)
  add_script_test(symbols unit ${CMAKE_CURRENT_SOURCE_DIR}/project/test_symbols.sh
    $<TARGET_FILE:pointspec> $<TARGET_FILE:pointspec_static> ${PROJECT_BINARY_DIR}/pointspec_joined.o)
  add_script_test(install "unit;sweep" ${CMAKE_CURRENT_SOURCE_DIR}/project/test_install.sh
    ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR} ${CMAKE_C_COMPILER})
endif()
