# Tests for another machine run on an emulated processor (scripts/test --arch arm64): what computes does there what it will do on a real one,
# ten to twenty times slower. What is left out is named as skipped, with its reason, and not built.

# A pattern, which has to fit the whole of FOLDER/TEST or FOLDER/PROGRAM/SUITE.CASE, and the reason; the first that fits counts.
set(AZIMUTH_NOT_EMULATED
  "(documents|fleet|include_rules|scripts)/.*"
  "looks at the source tree, which is the same for every processor"
  "tools/page/(page_modules|live_page|page_load)"
  "looks at the source tree, which is the same for every processor"

  "(live|examples|packaging|tools/azimuth|wrong_uses)/.*"
  "starts the programs, which only an emulator can here: the tests arm64.* do"
  "(daemon/daemon_test|sim/azimuth_sim/azimuth_sim_process_test|tools/import/tools_import_bag_test)/.*"
  "starts the programs, which only an emulator can here: the tests arm64.* do"
  "(daemon/(end_to_end|field_log)|tools/ros2/ros2_[a-z_]*|tools/page/[a-z_]*_(page|in_browser))"
  "starts the programs, which only an emulator can here: the tests arm64.* do"

  "(drivers/lcm/lcm_network|daemon/lcm_source|daemon/record/full_disk)"
  "wants a namespace of its own, whose tools are not emulated"

  "(daemon/pipeline_test/PipelineMap.IsSavedWhileTheRobotDrives|tools/view_server/tools_view_server_test/ManyLookers.ThoseThatStoppedDelayNobodyElse)"
  "asks for more than an emulator does in the time"

  "hypotheses/test_nameless_runs/.*"
  "many seeds take hours under emulation"

  "(scenarios/.*|hindsight/test_long_drives/.*)"
  "takes many minutes under emulation"
  "tools/drive_fit/tools_drive_fit_test/RealDrives.CalibrateTheirOdometryWithoutTruth"
  "takes many minutes under emulation")
set(AZIMUTH_STATISTICS_NOT_EMULATED "many seeds take hours under emulation")

# All that runs emulated.
add_custom_target(azimuth_emulated_tests)

# azimuth_why_not_emulated(variable test): the reason, or nothing.
function(azimuth_why_not_emulated variable test)
  set(${variable} "" PARENT_SCOPE)
  set(rows ${AZIMUTH_NOT_EMULATED})
  while(rows)
    list(POP_FRONT rows pattern reason)
    if(test MATCHES "^(${pattern})$")
      set_property(GLOBAL APPEND PROPERTY AZIMUTH_PATTERNS_THAT_FIT "${pattern}")
      set(${variable} "${reason}" PARENT_SCOPE)
      return()
    endif()
  endwhile()
endfunction()

# Tests get other names: a pattern that fits nothing any more would leave out nothing, unnoticed.
function(azimuth_check_not_emulated)
  get_property(fit GLOBAL PROPERTY AZIMUTH_PATTERNS_THAT_FIT)
  set(rows ${AZIMUTH_NOT_EMULATED})
  while(rows)
    list(POP_FRONT rows pattern reason)
    if(NOT pattern IN_LIST fit)
      message(SEND_ERROR "tests/emulated.cmake leaves out what is not there: ${pattern}")
    endif()
  endwhile()
endfunction()

function(azimuth_folder_of_tests variable)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/tests OUTPUT_VARIABLE folder)
  set(${variable} ${folder} PARENT_SCOPE)
endfunction()

function(azimuth_skip_test name reason)
  _add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -E echo "skipped: ${reason}")
  set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped: ")
endfunction()

# In place of CMake's own, which goes by the other name then: a test that is no program of GoogleTest's.
function(add_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "COMMAND")
  azimuth_folder_of_tests(folder)
  azimuth_why_not_emulated(reason ${folder}/${arg_NAME})
  if(reason)
    azimuth_skip_test(${arg_NAME} "${reason}")
  else()
    _add_test(NAME ${arg_NAME} COMMAND ${arg_COMMAND})
  endif()
endfunction()

# azimuth_cases(variable program): SUITE.CASE of each case, as its sources have it, without building it; EACH/SUITE.CASE where it has parameters.
function(azimuth_cases variable program)
  get_target_property(sources ${program} SOURCES)
  set(cases)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source NORMALIZE)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(READ ${source} text)
    string(REGEX MATCHALL "\n(TEST|TEST_F|TEST_P|RC_GTEST_PROP)\\([A-Za-z0-9_]+,[ \n]*[A-Za-z0-9_]+" found "${text}")
    list(TRANSFORM found REPLACE "^\nTEST_P.([A-Za-z0-9_]+),[ \n]*" "EACH/\\1.")
    list(TRANSFORM found REPLACE "^\n[^(]*.([A-Za-z0-9_]+),[ \n]*" "\\1.")
    list(APPEND cases ${found})
  endforeach()
  if(NOT cases)
    message(SEND_ERROR "no cases found in ${sources}, as tests/emulated.cmake reads them")
  endif()
  list(REMOVE_DUPLICATES cases)
  set(${variable} ${cases} PARENT_SCOPE)
endfunction()

# Whether a case is meant by one of the patterns, which are GoogleTest's: those of STATISTICS.
function(azimuth_is_meant variable case)
  set(${variable} FALSE PARENT_SCOPE)
  foreach(pattern IN LISTS ARGN)
    string(REGEX REPLACE "^.*/" "EACH/" pattern ${pattern})
    string(REPLACE "." "\\." pattern ${pattern})
    string(REPLACE "*" ".*" pattern ${pattern})
    if(case MATCHES "^${pattern}$")
      set(${variable} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# azimuth_discover_emulated_tests(program STATISTICS pattern... PROPERTIES ...): those of its cases that run emulated; the others are skipped.
function(azimuth_discover_emulated_tests program)
  cmake_parse_arguments(arg "" "" "STATISTICS;NIGHTLY;PROPERTIES" ${ARGN})
  azimuth_folder_of_tests(folder)
  azimuth_cases(cases ${program})
  set(left_out)
  foreach(case IN LISTS cases)
    string(REPLACE "EACH/" "" name ${case})
    azimuth_is_meant(statistics ${case} ${arg_STATISTICS})
    if(statistics)
      set(reason "${AZIMUTH_STATISTICS_NOT_EMULATED}")
    else()
      azimuth_why_not_emulated(reason ${folder}/${program}/${name})
    endif()
    if(reason)
      azimuth_skip_test(${name} "${reason}")
      list(APPEND left_out ${case})
    endif()
  endforeach()
  if("${left_out}" STREQUAL "${cases}")
    return()
  endif()
  add_dependencies(azimuth_emulated_tests ${program})
  set(filter)
  if(left_out)
    list(TRANSFORM left_out REPLACE "EACH/(.+)" "*/\\1/*")
    list(JOIN left_out ":" filter)
    set(filter TEST_FILTER -${filter})
  endif()
  azimuth_discover_cases(${program} ${filter} PROPERTIES ${arg_PROPERTIES})
endfunction()
