# The commands in README.md and docs/ work as they stand: of the README in `docs`, which looks at links and lists, too;
# of every other page in a sweep of its own, docs_PAGE. Sanitizers see their commands in other tests.
function(add_docs_test name label) # PAGE...
  add_script_test(${name} "unit;${label}" ${CMAKE_CURRENT_SOURCE_DIR}/project/docs.sh
    $<TARGET_FILE:pointspec_program> ${PROJECT_SOURCE_DIR} ${ARGN})
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "POCL_CACHE_DIR=${POINTSPEC_TEST_CACHE}")
endfunction()

add_docs_test(docs sources)
add_docs_test(docs_changelog sweep CHANGELOG.md)
foreach(page user/examples user/tutorial user/recipes user/conventions user/formats user/quadrature user/occlusion user/measure user/report user/variance user/reproduction user/gate
    user/needs user/scenes user/samplers samplers/poisson_disks samplers/optimized samplers/forces)
  get_filename_component(name ${page} NAME)
  add_docs_test(docs_${name} sweep docs/${page}.md)
endforeach()
