# Tests of the program: the parser as a unit, and scripts that run what was built.
target_link_libraries(test_arguments PRIVATE pointspec_cli)
target_link_libraries(test_scene PRIVATE pointspec_cli)

function(add_program_test name)
  file(GLOB_RECURSE script ${CMAKE_CURRENT_SOURCE_DIR}/${name}.sh)
  add_script_test(${name} "unit" ${script}
    $<TARGET_FILE:pointspec_program> ${ARGN})
  if(name IN_LIST SWEEP_TESTS)
    set_tests_properties(${name} PROPERTIES LABELS "unit;sweep")
  endif()
  set_kernels(${name})
endfunction()

# Sanitizers map address space without measure, and take several times as long.
if(NOT POINTSPEC_SANITIZE)
  add_program_test(cli_signals)   # every long command ends within a second of a signal, and leaves nothing
  add_program_test(cli_memory)    # limits of memory, streams without an end, records
endif()
add_program_test(cli_kept_sets) # sets that are kept: same points, --prefetch, damage, no room
add_program_test(cli_full)      # arrays of --full, DC and its standard error
add_program_test(cli_different_points) # sets of different N, normalizations, what was saved before
add_program_test(cli_empty_axis) # points of a smaller box
add_program_test(cli_errors)    # bad input: exit code, one sentence, nothing left behind
add_program_test(cli_counts)    # several numbers of points in one command
add_program_test(cli_sets)      # --set: files under a name beside samplers, in every command that has several
add_program_test(cli_streams)   # points that come but once are kept, and read again
add_program_test(cli_scatter)   # coefficients of sets at a frequency
add_program_test(cli_fit)       # power laws, plateaus and profiles of spectra
add_program_test(cli_program)   # streams, signals, formats, same bits
add_program_test(cli_convert)   # every format to every other, pipes, gzip, memory
add_program_test(cli_formats)   # files as other tools write them
add_program_test(cli_help)      # words of a command alone
add_program_test(cli_field ${CMAKE_CURRENT_SOURCE_DIR}/field) # what is known of such files
add_program_test(cli_angular)   # the sphere: formats, header, what is refused
add_program_test(cli_healpy ${PROJECT_SOURCE_DIR}/build/peers) # against healpy and ducc0, where installed
set_tests_properties(cli_healpy PROPERTIES SKIP_RETURN_CODE 77)
add_program_test(cli_truncation) # lobes, formats, what is refused
add_program_test(cli_quadrature) # golden values, engines, files, what is refused
add_program_test(cli_shade)     # columns, bits, scenes, plans, what is refused
add_program_test(cli_interpolation) # rows, bits, maps, arrays, scenes, plans, what is refused
add_program_test(cli_light)     # closed forms, maps, arrays, pictures, scenes, plans, what is refused
add_program_test(cli_occlusion) # columns, bits, images, scenes, plans, what is refused
add_program_test(cli_pairs)     # pair sums: closed forms, every route, what is refused
add_program_test(cli_variance_files) # halves, single sets, weights, streams, memory, saved results that are refused
add_program_test(cli_variance_integrands) # integrands from files: numbers, scenes, what is refused
add_program_test(cli_variance)  # columns, formats, the same bits beside other questions, scenes, what is refused
add_program_test(cli_variance_bounds)  # --bounds: profiles below and above, given and found
add_program_test(cli_variance_rates)  # --rates: exponents and crossings of samplers whose laws are known
add_program_test(cli_variance_rank)  # --rank: order, factors and their scores
add_program_test(cli_variance_cutoff)  # --tail, what does not matter, shells, the formula of the paper
add_program_test(cli_weights)   # weights at the ends of the range of doubles, sums that are 0
add_program_test(cli_terminal)  # tables on a terminal, in files and in pipes
add_program_test(cli_npz ${PROJECT_SOURCE_DIR}) # answers as NPZ, by NumPy where there is one
add_program_test(cli_check)     # verdicts against saved spectra, exit codes, what is refused
add_program_test(cli_homogeneous) # homogeneity of samplers, files and scenes
add_program_test(cli_units)     # the number of compute units chooses nothing
add_program_test(cli_bench)      # run time against error, figures per device: rows, files, what is refused
if(POINTSPEC_BUILD_BENCH)
  add_program_test(cli_plan $<TARGET_FILE:bench_plan>) # seconds against those that commands take, phases
  set_tests_properties(cli_plan PROPERTIES RUN_SERIAL TRUE)
endif()
add_program_test(cli_run)       # scenes: the folder, the cache, records, what is refused
add_program_test(cli_picture)   # --plot fails: numbers stay
add_program_test(cli_points_picture) # --plot of points: what is drawn, written and refused
add_program_test(cli_run_keys)  # the cache finds what is the same and nothing else
add_program_test(cli_run_files) # what scenes read and write
add_program_test(cli_run_counts) # numbers of points of scenes: lists, means where they vary
add_program_test(cli_run_pictures) # pictures of scenes: panels, failures, titles
add_program_test(cli_run_rates) # rates and ranks over all samplers and N of a result
add_program_test(cli_run_sets)  # files under names beside samplers in scenes
add_program_test(cli_run_points) # points as a result of a scene
add_program_test(cli_stress)    # the stability suite: rows, formats, what is refused
add_program_test(cli_stress_broken ${PROJECT_SOURCE_DIR}/kernels) # broken kernels fail by name
add_program_test(cli_tolerance) # --tol and --floor, torus and sphere: kept or refused; threads change no bit
add_program_test(cli_no_device) # why there is no device; plan and devices without one
add_program_test(cli_doctor)    # what works here, and what is said where something does not
add_program_test(cli_examples)  # the examples of every --help
add_program_test(cli_man ${PROJECT_SOURCE_DIR})   # man pages have the lists of --help
