# Counts the instructions of the time-critical loops, because emulation cannot measure time. Both programs compile the
# sources of the loops, each with its own options.
set(slam ${PROJECT_SOURCE_DIR}/slam)
set(loops
  association/descriptor_block association/descriptor_loops_avx2 association/descriptor_loops_avx512 association/descriptor_loops_neon
  ekf/rank_update ekf/rank_update_avx2 ekf/rank_update_avx512
  perception/colour/scan perception/colour/scan_avx2
  perception/image/resample_kernels perception/image/resample_kernels_avx2
  perception/lamps/bright_runs perception/lamps/bright_runs_avx2
  perception/sift/scale_space_kernels perception/sift/scale_space_kernels_avx2)
list(TRANSFORM loops REPLACE "(.+)" "${slam}/\\1.cpp")
foreach(program IN ITEMS kernel_calls kernel_calls_without_vectors)
  add_executable(${program} kernel_calls.cpp ${loops})
  target_link_libraries(${program} PRIVATE azimuth_options Eigen3::Eigen)
  target_compile_options(${program} PRIVATE -O2) # as shipped; tests are compiled with less optimisation
endforeach()
target_compile_options(kernel_calls_without_vectors PRIVATE -march=armv8-a+nosimd)
if(TARGET azimuth_emulated_tests)
  add_dependencies(azimuth_emulated_tests kernel_calls kernel_calls_without_vectors)
endif()
# The same option as in slam/ekf.
set_source_files_properties(${slam}/ekf/rank_update.cpp PROPERTIES COMPILE_OPTIONS "-ffp-contract=fast")

# The interpreter is given by its path, because CMake would emulate the target Python3::Interpreter.
add_test(NAME processors.instructions
  COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/instructions_test.py $<TARGET_FILE:kernel_calls>
    $<TARGET_FILE:kernel_calls_without_vectors>)
set_tests_properties(processors.instructions PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600 LABELS processors)
