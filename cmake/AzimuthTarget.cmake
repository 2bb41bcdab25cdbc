# Compiler settings shared by every target of the project.

add_library(azimuth_options INTERFACE)
target_compile_features(azimuth_options INTERFACE cxx_std_20)
target_include_directories(azimuth_options INTERFACE ${PROJECT_SOURCE_DIR})
# Contraction into fused multiply-adds is off, so that a build for another instruction set does not round differently;
# the one exception is slam/ekf/rank_update_avx2.cpp, which needs their speed.
target_compile_options(azimuth_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Werror -ffp-contract=off)
if(AZIMUTH_SANITIZE)
  target_compile_options(azimuth_options INTERFACE
    -fsanitize=${AZIMUTH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(azimuth_options INTERFACE -fsanitize=${AZIMUTH_SANITIZE})
endif()
# What these find crashes anyway, or AddressSanitizer finds it; without them the build takes a fifth less time.
if(AZIMUTH_SANITIZE MATCHES undefined)
  target_compile_options(azimuth_options INTERFACE -fno-sanitize=null,object-size,vptr)
endif()
if(AZIMUTH_FUZZ)
  target_compile_options(azimuth_options INTERFACE -fsanitize=fuzzer-no-link,address,undefined)
  target_link_options(azimuth_options INTERFACE -fsanitize=address,undefined)
endif()

# azimuth_library(name SOURCES ... DEPENDS ...): the one library of a folder.
function(azimuth_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  if(arg_SOURCES)
    add_library(${name} STATIC ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC azimuth_options ${arg_DEPENDS})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE azimuth_options ${arg_DEPENDS})
  endif()
endfunction()

# azimuth_discover_tests(program PROPERTIES ...): ctest lists the cases of a GoogleTest program one by one, each by the name
# that GoogleTest has for it. A parameter's value would take the place of its name otherwise, and may be anything.
function(azimuth_discover_tests program)
  gtest_discover_tests(${program} DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES ${ARGN})
endfunction()

# azimuth_test(name SOURCES ... DEPENDS ...): a GoogleTest program whose cases ctest lists one by one.
function(azimuth_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE azimuth_options ${arg_DEPENDS} azimuth_test_places GTest::gmock GTest::gtest_main)
  # A property with an empty value would shift those after it.
  set(properties TIMEOUT 600)
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  azimuth_discover_tests(${name} PROPERTIES ${properties})
endfunction()
