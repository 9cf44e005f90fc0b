# SPDX-License-Identifier: Apache-2.0
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "INCISE_BUILD_FUZZERS needs clang: use the preset 'fuzz'")
endif()

# incise_fuzzer(NAME MODULES module... SOURCES file...): one libFuzzer program `NAME`, its seeds in tests/fuzz/corpus.
# script/soak runs them: `fuzz_mesh`, `fuzz_labels`, `fuzz_blade`, `fuzz_recording`, `fuzz_plan`.
function(incise_fuzzer name)
  cmake_parse_arguments(ARG "" "" "MODULES;LIBRARIES;SOURCES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  foreach(module IN LISTS ARG_MODULES)
    target_link_libraries(${name} PRIVATE incise_${module})
  endforeach()
  target_link_libraries(${name} PRIVATE incise_warnings ${ARG_LIBRARIES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
endfunction()
