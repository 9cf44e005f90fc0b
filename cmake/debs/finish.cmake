# SPDX-License-Identifier: Apache-2.0
# What Debian asks of a package beside what is installed: a changelog, a copyright, compressed manual pages. CPack runs
# this when each component lies in a folder of its own, and before it packs them.
find_program(python python3 REQUIRED)
find_program(gzip gzip REQUIRED)
set(source ${CPACK_INCISE_SOURCE_DIR})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed (${status}): ${errors}")
  endif()
endfunction()

foreach(pair IN LISTS CPACK_INCISE_DEBS)
  string(REGEX MATCH "^([^=]+)=(.+)$" matched ${pair})
  set(package ${CMAKE_MATCH_2})
  set(usr ${CPACK_TEMPORARY_DIRECTORY}/${CMAKE_MATCH_1}/usr)
  set(doc ${usr}/share/doc/${package})
  file(MAKE_DIRECTORY ${doc})
  configure_file(${source}/cmake/debs/copyright ${doc}/copyright COPYONLY)
  run(${python} ${source}/script/lib/debian_changelog.py ${source} incise ${CPACK_INCISE_VERSION}
      "${CPACK_DEBIAN_PACKAGE_MAINTAINER}" ${doc}/changelog.Debian)
  file(GLOB pages ${usr}/share/man/man1/*.1)
  run(${gzip} -9n ${doc}/changelog.Debian ${pages})
  file(GLOB_RECURSE archives ${usr}/lib/*.a)
  if(archives)
    run(${CPACK_INCISE_STRIP} --strip-debug --enable-deterministic-archives ${archives})
  endif()
endforeach()

# What pip and importlib.metadata know the Python package by.
run(${python} ${source}/bindings/python/incise_build.py
    ${CPACK_TEMPORARY_DIRECTORY}/python/usr/lib/python3/dist-packages)
