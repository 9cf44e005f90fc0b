# SPDX-License-Identifier: Apache-2.0
# Runs PROGRAM and compares what it prints with the table GOLDEN. A line that changes needs a reason in CHANGELOG.md;
# then: build/release/bin/incise_determinism > tests/determinism/golden.txt
execute_process(COMMAND ${PROGRAM} OUTPUT_VARIABLE printed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "incise_determinism ended with ${status}")
endif()
file(READ ${GOLDEN} golden)
if(NOT printed STREQUAL golden)
  message(FATAL_ERROR "the state hashes differ from ${GOLDEN}:\n${printed}")
endif()
