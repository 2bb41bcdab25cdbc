# Compiler settings shared by every target of the project.

add_library(azimuth_options INTERFACE)
target_compile_features(azimuth_options INTERFACE cxx_std_20)
target_include_directories(azimuth_options INTERFACE ${PROJECT_SOURCE_DIR})
# Contraction into fused multiply-adds is off, so that a build for another instruction set does not round differently;
# the one exception is slam/ekf/rank_update*.cpp, which needs their speed.
target_compile_options(azimuth_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${AZIMUTH_WERROR}>:-Werror> -ffp-contract=off)
# CMake takes assertions out of whatever it optimises. What is tested has them, and so has what people build.
if(AZIMUTH_ASSERTIONS)
  foreach(flags IN ITEMS C_FLAGS_RELEASE C_FLAGS_RELWITHDEBINFO C_FLAGS_MINSIZEREL
                         CXX_FLAGS_RELEASE CXX_FLAGS_RELWITHDEBINFO CXX_FLAGS_MINSIZEREL)
    string(REPLACE "-DNDEBUG" "" CMAKE_${flags} "${CMAKE_${flags}}")
  endforeach()
endif()
# Nor may Eigen, which fuses by itself where it is told that arm64 can, and cuts products of large matrices into pieces by the
# sizes of the processor's caches: their sums would come about in another order on every machine.
target_compile_definitions(azimuth_options INTERFACE
  EIGEN_NO_CPUID EIGEN_DEFAULT_L1_CACHE_SIZE=32768 EIGEN_DEFAULT_L2_CACHE_SIZE=262144 EIGEN_DEFAULT_L3_CACHE_SIZE=2097152)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  target_compile_options(azimuth_options INTERFACE -U__ARM_FEATURE_FMA)
  target_compile_definitions(azimuth_options INTERFACE EIGEN_MATRIXBASE_PLUGIN="cmake/eigen_rounds_as_on_x86.hpp")
endif()
# What GCC means by -Wconversion: Clang takes it to be about signs too, where sizes that are differences of iterators are
# many and harmless.
target_compile_options(azimuth_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
if(AZIMUTH_SANITIZE)
  # What a sanitizer puts in between keeps GCC from seeing that an optional is looked at only when it is there.
  target_compile_options(azimuth_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_options(azimuth_options INTERFACE
    -fsanitize=${AZIMUTH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(azimuth_options INTERFACE -fsanitize=${AZIMUTH_SANITIZE})
endif()
# What these find crashes anyway, or AddressSanitizer finds it; without them the build takes a fifth less time.
if(AZIMUTH_SANITIZE MATCHES undefined)
  target_compile_options(azimuth_options INTERFACE -fno-sanitize=null,object-size,vptr)
  # Named as Ninja's commands see it: a compiler cache would serve one checkout only, else.
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_LIST_DIR BASE_DIRECTORY ${CMAKE_BINARY_DIR} OUTPUT_VARIABLE from_build)
  target_compile_options(azimuth_options INTERFACE
    $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${from_build}/sanitizer_ignorelist.txt>)
endif()
# Headers are what compiling takes time for, Eigen's above all: sources that are compiled together read them once. Tools
# that look at one file at a time want this off; scripts/tidy does so.
option(AZIMUTH_UNITS "Compile the sources of each target a few units at a time" ON)
set(AZIMUTH_UNIT_SOURCES 24 CACHE STRING "Sources of a unit, at most")

# azimuth_compile_together(target): its sources but those with compiler options of their own. Not CMake's UNITY_BUILD:
# that names sources by absolute paths, and a compiler cache would serve one checkout only.
function(azimuth_compile_together target)
  if(AZIMUTH_UNITS)
    # At the end of the folder, when options of single sources are known.
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

# Folders whose code the libFuzzer targets drive. libFuzzer is told of every branch taken there; elsewhere that would be
# told to nobody, and the estimators' arithmetic takes nearly twice the time with it.
set(AZIMUTH_FUZZED_FOLDERS "^(base|drivers|picture|settings|slam/(camera|perception)|tools/(bag|calibrate|import|log_index|view))(/|$)")

option(AZIMUTH_OPTIMISE_INPUT_ONLY
  "Leave unoptimised what the libFuzzer targets do not drive: the build takes two thirds of the time, estimators several times theirs" OFF)

# azimuth_library(name SOURCES ... DEPENDS ...): the one library of a folder.
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

# Folders of tests of what takes in bytes from outside. Those have the label `input` too, and the target azimuth_input_tests
# is all of them: what AddressSanitizer looks at with every change.
set(AZIMUTH_INPUT_TESTS "^tests/(base|camera|drivers|perception|picture|ros|settings|tools/(bag|calibrate|import|view))(/|$)")
add_custom_target(azimuth_input_tests)

# azimuth_discover_cases(program [TEST_FILTER patterns] PROPERTIES ...): ctest lists the cases of a GoogleTest program one by one, each by the
# name that GoogleTest has for it. A parameter's value would take the place of its name otherwise, and may be anything.
function(azimuth_discover_cases program)
  gtest_discover_tests(${program} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES ${ARGN})
endfunction()

# azimuth_discover_tests(program STATISTICS pattern... NIGHTLY pattern... PROPERTIES ...): all its cases; those of STATISTICS
# have that label alone, those of NIGHTLY that one too.
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

# azimuth_test(name SOURCES ... DEPENDS ...): a GoogleTest program whose cases ctest lists one by one. STATISTICS: patterns of
# those that do what others do with many seeds or on many runs, and judge the numbers; they have that label alone.
# RUNS_PROGRAMS: its cases start the programs, which are all of the project.
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
  # A property with an empty value would shift those after it.
  set(properties TIMEOUT 600)
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  azimuth_discover_tests(${name} STATISTICS ${arg_STATISTICS} PROPERTIES ${properties})
endfunction()
