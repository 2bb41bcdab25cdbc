# Compiler settings shared by every target of the project.

add_library(azimuth_options INTERFACE)
target_compile_features(azimuth_options INTERFACE cxx_std_20)
target_include_directories(azimuth_options INTERFACE ${PROJECT_SOURCE_DIR})
# The compiler may not contract operations into fused multiply-adds, so that builds for other instruction sets round
# equally. The only exception is slam/ekf/rank_update*.cpp, which needs the speed.
target_compile_options(azimuth_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${AZIMUTH_WERROR}>:-Werror> -ffp-contract=off)
# CMake disables assertions in optimised builds. This option keeps them in tests and in users' builds.
if(AZIMUTH_ASSERTIONS)
  foreach(flags IN ITEMS C_FLAGS_RELEASE C_FLAGS_RELWITHDEBINFO C_FLAGS_MINSIZEREL
                         CXX_FLAGS_RELEASE CXX_FLAGS_RELWITHDEBINFO CXX_FLAGS_MINSIZEREL)
    string(REPLACE "-DNDEBUG" "" CMAKE_${flags} "${CMAKE_${flags}}")
  endforeach()
endif()
# Eigen may not use fused multiply-adds on arm64 either. Fixed cache sizes keep its block sizes for products of large
# matrices equal on all machines, and so the order of the sums.
target_compile_definitions(azimuth_options INTERFACE
  EIGEN_NO_CPUID EIGEN_DEFAULT_L1_CACHE_SIZE=32768 EIGEN_DEFAULT_L2_CACHE_SIZE=262144 EIGEN_DEFAULT_L3_CACHE_SIZE=2097152)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  target_compile_options(azimuth_options INTERFACE -U__ARM_FEATURE_FMA)
  target_compile_definitions(azimuth_options INTERFACE EIGEN_MATRIXBASE_PLUGIN="cmake/eigen_rounds_as_on_x86.hpp")
endif()
# Gives -Wconversion the meaning that it has in GCC. In Clang it includes sign conversions, which are frequent and
# harmless here (sizes as differences of iterators).
target_compile_options(azimuth_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
if(AZIMUTH_SANITIZE)
  # The instrumentation of sanitizers causes false warnings of GCC about optionals.
  target_compile_options(azimuth_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_options(azimuth_options INTERFACE
    -fsanitize=${AZIMUTH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(azimuth_options INTERFACE -fsanitize=${AZIMUTH_SANITIZE})
endif()
# The faults that these checks find crash anyway, or AddressSanitizer finds them. Without them the build is a fifth
# faster.
if(AZIMUTH_SANITIZE MATCHES undefined)
  target_compile_options(azimuth_options INTERFACE -fno-sanitize=null,object-size,vptr)
  # The path is relative to Ninja's working folder, so that a compiler cache works for every checkout.
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_LIST_DIR BASE_DIRECTORY ${CMAKE_BINARY_DIR} OUTPUT_VARIABLE from_build)
  target_compile_options(azimuth_options INTERFACE
    $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${from_build}/sanitizer_ignorelist.txt>)
endif()
# Most of the compile time is spent on headers, mainly Eigen's. Sources that are compiled together read them once. Tools
# that read single files need this off, as in scripts/tidy.
option(AZIMUTH_UNITS "Compile the sources of each target a few units at a time" ON)
set(AZIMUTH_UNIT_SOURCES 24 CACHE STRING "Sources of a unit, at most")

# azimuth_compile_together(target): compiles the sources of a target in a few units, except sources with their own
# compiler options. CMake's UNITY_BUILD uses absolute paths, with which a compiler cache would work for one checkout
# only.
function(azimuth_compile_together target)
  if(AZIMUTH_UNITS)
    # Runs at the end of the folder, when the options of single sources are known.
    cmake_language(EVAL CODE "cmake_language(DEFER CALL azimuth_make_units ${target})")
  endif()
endfunction()

function(azimuth_make_units target)
  get_target_property(sources ${target} SOURCES)
  set(alone)
  set(includes)
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    get_source_file_property(skip ${source} SKIP_UNITY_BUILD_INCLUSION)
    if(options OR definitions OR skip)
      list(APPEND alone ${source})
    else()
      cmake_path(ABSOLUTE_PATH source NORMALIZE)
      cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      list(APPEND includes "#include \"${source}\"\n")
    endif()
  endforeach()
  list(LENGTH includes count)
  if(count LESS 2)
    return()
  endif()
  math(EXPR units "(${count} + ${AZIMUTH_UNIT_SOURCES} - 1) / ${AZIMUTH_UNIT_SOURCES}")
  math(EXPR length "(${count} + ${units} - 1) / ${units}")
  foreach(unit RANGE 1 ${units})
    math(EXPR first "(${unit} - 1) * ${length}")
    list(SUBLIST includes ${first} ${length} part)
    string(JOIN "" text ${part})
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_${unit}.cpp)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    list(APPEND alone ${file})
  endforeach()
  set_property(TARGET ${target} PROPERTY SOURCES ${alone})
endfunction()

# Folders whose code the libFuzzer targets run. Only these have coverage instrumentation, because it would nearly double
# the time of the estimators' arithmetic.
set(AZIMUTH_FUZZED_FOLDERS "^(base|drivers|settings|slam/(camera|perception)|tools/(bag|calibrate|import|log_index|view))(/|$)")

option(AZIMUTH_OPTIMISE_INPUT_ONLY
  "Leave unoptimised what the libFuzzer targets do not drive: the build takes two thirds of the time, estimators several times theirs" OFF)

# azimuth_library(name SOURCES ... DEPENDS ...): adds the library of a folder.
function(azimuth_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  if(arg_SOURCES)
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC azimuth_options ${arg_DEPENDS})
    azimuth_compile_together(${name})
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
    if(folder MATCHES "${AZIMUTH_FUZZED_FOLDERS}")
      target_compile_options(${name} PRIVATE $<$<BOOL:${AZIMUTH_FUZZ}>:-fsanitize=fuzzer-no-link>)
    elseif(AZIMUTH_OPTIMISE_INPUT_ONLY)
      target_compile_options(${name} PRIVATE -O0)
    endif()
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE azimuth_options ${arg_DEPENDS})
  endif()
endfunction()

# Folders with tests of code that reads external bytes. Their tests have the additional label `input`, and the target
# azimuth_input_tests builds them; AddressSanitizer checks them with every change.
set(AZIMUTH_INPUT_TESTS "^tests/(base|camera|drivers|perception|settings|tools/(bag|calibrate|import|view))(/|$)")
add_custom_target(azimuth_input_tests)

# azimuth_discover_cases(program [TEST_FILTER patterns] PROPERTIES ...): ctest lists each case of a GoogleTest program
# by its GoogleTest name. Without NO_PRETTY_VALUES, the value of a parameter, which may be any text, would replace its
# name.
function(azimuth_discover_cases program)
  gtest_discover_tests(${program} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES ${ARGN})
endfunction()

# azimuth_discover_tests(program STATISTICS pattern... NIGHTLY pattern... PROPERTIES ...): lists all cases. Those of
# STATISTICS have only the label statistics; those of NIGHTLY have the label nightly in addition.
function(azimuth_discover_tests program)
  if(CMAKE_CROSSCOMPILING)
    azimuth_discover_emulated_tests(${program} ${ARGN})
    return()
  endif()
  cmake_parse_arguments(arg "" "" "STATISTICS;NIGHTLY;PROPERTIES" ${ARGN})
  set(others ${arg_STATISTICS} ${arg_NIGHTLY})
  if(arg_STATISTICS)
    list(JOIN arg_STATISTICS ":" patterns)
    azimuth_discover_cases(${program} TEST_FILTER ${patterns} PROPERTIES TIMEOUT 600 LABELS statistics)
  endif()
  if(arg_NIGHTLY) # labels add up
    list(JOIN arg_NIGHTLY ":" patterns)
    azimuth_discover_cases(${program} TEST_FILTER ${patterns} PROPERTIES ${arg_PROPERTIES} LABELS nightly)
  endif()
  if(others)
    list(JOIN others ":" patterns)
    set(others TEST_FILTER -${patterns})
  endif()
  azimuth_discover_cases(${program} ${others} PROPERTIES ${arg_PROPERTIES})
endfunction()

# azimuth_test(name SOURCES ... DEPENDS ...): adds a GoogleTest program whose cases ctest lists one by one. STATISTICS:
# patterns of the cases that judge statistics over many seeds or runs; they have only this label. RUNS_PROGRAMS: the
# cases start the programs, so they do not belong to azimuth_input_tests.
function(azimuth_test name)
  cmake_parse_arguments(arg "RUNS_PROGRAMS" "" "SOURCES;DEPENDS;LABELS;STATISTICS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE azimuth_options ${arg_DEPENDS} azimuth_test_places GTest::gmock GTest::gtest_main)
  azimuth_compile_together(${name})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
  if(folder MATCHES "${AZIMUTH_INPUT_TESTS}" AND NOT arg_RUNS_PROGRAMS)
    list(APPEND arg_LABELS input)
    add_dependencies(azimuth_input_tests ${name})
  endif()
  # An empty value would shift the properties after it.
  set(properties TIMEOUT 600)
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  azimuth_discover_tests(${name} STATISTICS ${arg_STATISTICS} PROPERTIES ${properties})
endfunction()
