# SPDX-License-Identifier: Apache-2.0
# Installs, then builds and runs programs in C++ that know only the prefix.
include(${CMAKE_CURRENT_LIST_DIR}/run_step.cmake)

# What is installed is what include/ holds, and the version.
file(GLOB_RECURSE wanted RELATIVE ${SOURCE_DIR}/include ${SOURCE_DIR}/include/*)
list(APPEND wanted incise/version.h)
file(GLOB_RECURSE installed RELATIVE ${prefix}/include ${prefix}/include/*)
foreach(header IN LISTS wanted)
  if(NOT header IN_LIST installed)
    message(FATAL_ERROR "include/${header} is not installed")
  endif()
endforeach()
foreach(header IN LISTS installed)
  if(NOT header IN_LIST wanted)
    message(FATAL_ERROR "${header} is installed, but not in include/")
  endif()
endforeach()

set(changed)
if(DEFINED ENV{INCISE_CHANGED_HEADERS})  # their paths in include/, with blanks between them
  set(changed "-DCHANGED_HEADERS=$ENV{INCISE_CHANGED_HEADERS}")
endif()
run_step("Configure the consumer" ${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${consumer_build} -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DINCLUDE_FOLDER=${prefix}/include -DWANTED_VERSION=${VERSION} -DEXAMPLE=${EXAMPLE} ${changed})
# ccache keeps what a header compiled in advance has a part in only where it is told that dates and macros do not matter.
run_step("Build the consumer" ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
  ${CMAKE_COMMAND} --build ${consumer_build})
run_step("Run the consumer" ${consumer_build}/consumer)
run_step("Cut a file" ${consumer_build}/cut_a_file ${consumer_build})
if(EXISTS ${consumer_build}/example)
  run_step("Run the example" ${CMAKE_COMMAND} -E chdir ${consumer_build} ${consumer_build}/example)
endif()
