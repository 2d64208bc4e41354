# The commands in README.md and docs/ work as they stand, and links lead somewhere.
add_program_test(docs ${PROJECT_SOURCE_DIR})
# Their commands are those of other tests, which run with sanitizers.
set_tests_properties(docs PROPERTIES LABELS "unit;sweep")
