# SPDX-License-Identifier: Apache-2.0
# Debian packages by CPack, one for each component of what is installed; script/package makes them. Version and
# descriptions stand here or come from project(), the changelog from CHANGELOG.md, manual pages from the programs.
set(INCISE_MAINTAINER "Incise maintainers <maintainers@incise.example>" CACHE STRING
    "Of the Debian packages: NAME <ADDRESS>")

install(DIRECTORY bindings/python/incise DESTINATION lib/python3/dist-packages COMPONENT python EXCLUDE_FROM_ALL
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME incise)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_COMPONENTS_ALL command view runtime dev python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${INCISE_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debs/finish.cmake)
set(INCISE_DEB_VERSION ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

# incise_deb(COMPONENT PACKAGE SECTION SUMMARY DESCRIPTION [DEPENDS]): lines of the description end where they are to.
macro(incise_deb component package section summary description)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${ARGN}")
  list(APPEND INCISE_DEB_OF_COMPONENT "${component}=${package}")
endmacro()

set(about "Incise cuts tetrahedral models, the solid meshes with which surgery
simulators, biomechanics codes and animation tools compute soft bodies. The
mesh that comes out is separated along the path of the blade, without cracks
and without inverted or empty elements, and fit to be simulated.")
incise_deb(command incise science "cutter of tetrahedral meshes (command line)" "${about}
.
This package has the command incise: it tells what is in a mesh and what is
wrong with it, cuts, improves and converts meshes, makes them of label images,
runs scenes in which a soft body is cut while it deforms, and batches of cuts.")
incise_deb(view incise-view science "cutter of tetrahedral meshes (window)" "${about}
.
This package has the window incise-view, in which a body is cut by hand.")
incise_deb(runtime libincise0 libs "cutter of tetrahedral meshes (shared library)" "${about}
.
This package has the shared library with the C interface.")
incise_deb(dev libincise-dev libdevel "cutter of tetrahedral meshes (development files)" "${about}
.
This package has the headers for C and C++, the static library for C++, and
files for CMake and pkg-config." "libincise0 (= ${INCISE_DEB_VERSION}), libeigen3-dev (>= 3.4), libtbb-dev, libpugixml-dev, zlib1g-dev")
incise_deb(python python3-incise python "cutter of tetrahedral meshes (Python 3)" "${about}
.
This package has the module incise for Python 3: meshes, cuts and simulations
as arrays of numpy." "python3:any (>= 3.9), python3-numpy, libincise0 (= ${INCISE_DEB_VERSION})")
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
# CPack would call ldconfig by scripts, where Debian has a trigger.
set(control ${PROJECT_BINARY_DIR}/generated/debs)
file(WRITE ${control}/shlibs "libincise 0 libincise0 (>= ${INCISE_DEB_VERSION})\n")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)

# For finish.cmake.
set(CPACK_INCISE_SOURCE_DIR ${PROJECT_SOURCE_DIR})
set(CPACK_INCISE_DEBS "${INCISE_DEB_OF_COMPONENT}")
set(CPACK_INCISE_VERSION ${INCISE_DEB_VERSION})
set(CPACK_INCISE_STRIP ${CMAKE_STRIP})
include(CPack)
