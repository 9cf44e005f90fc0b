# SPDX-License-Identifier: Apache-2.0
# What the tests of the installed library share: `run_step`, fresh folders below WORK_DIR, and the install itself.
cmake_minimum_required(VERSION 3.25)
set(prefix ${WORK_DIR}/prefix)
set(consumer_build ${WORK_DIR}/build)
file(REMOVE_RECURSE ${prefix} ${consumer_build})

function(run_step what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${what} failed (${status}):\n${output}")
  endif()
  message(STATUS "${what}: done\n${output}")
endfunction()

run_step("Install" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix})
