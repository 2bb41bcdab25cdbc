# Older processors must not run the loops for newer ones. The arm64 package is tested if it has been made.
add_executable(processors_needs_avx2 needs_avx2.cpp)
target_link_libraries(processors_needs_avx2 PRIVATE azimuth_options)
target_compile_options(processors_needs_avx2 PRIVATE -mavx2)

foreach(case IN ITEMS without_fma with_fma arm64 bites)
  add_test(NAME processors.${case}
    COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/processors_test.py ${case}
      $<TARGET_FILE:azimuthd> $<TARGET_FILE:azimuth> $<TARGET_FILE:azimuth-sim> $<TARGET_FILE:processors_needs_avx2>)
  set_tests_properties(processors.${case} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1200 LABELS processors)
endforeach()
