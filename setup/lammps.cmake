# The target `lammps`: the headers of LAMMPS and how it was compiled. Nothing is linked:
# a plugin finds LAMMPS' functions in the executable that loads it.

if(NOT LAMMPS_SOURCE_DIR)
  message(FATAL_ERROR "Say where LAMMPS is: cmake … -DLAMMPS_SOURCE_DIR=/path/lammps   (or type ./run setup)")
endif()
set(lammps_src ${LAMMPS_SOURCE_DIR})
if(NOT EXISTS ${lammps_src}/version.h)
  set(lammps_src ${LAMMPS_SOURCE_DIR}/src)
endif()
if(NOT EXISTS ${lammps_src}/version.h)
  message(FATAL_ERROR "LAMMPS_SOURCE_DIR=${LAMMPS_SOURCE_DIR} holds neither version.h nor src/version.h")
endif()

# "4 Feb 2025" in version.h becomes CLUSTER_LAMMPS_VERSION=20250204, the one macro that gates API differences.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${lammps_src}/version.h)
file(STRINGS ${lammps_src}/version.h version_line REGEX "LAMMPS_VERSION")
if(NOT version_line MATCHES "\"([0-9]+) ([A-Z][a-z][a-z])[a-z]* ([0-9]+)")
  message(FATAL_ERROR "No version date in ${lammps_src}/version.h: ${version_line}")
endif()
set(day ${CMAKE_MATCH_1})
set(year ${CMAKE_MATCH_3})
set(months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)
list(FIND months ${CMAKE_MATCH_2} month)
math(EXPR CLUSTER_LAMMPS_VERSION "10000 * ${year} + 100 * (${month} + 1) + ${day}")
message(STATUS "LAMMPS ${CLUSTER_LAMMPS_VERSION} in ${lammps_src}")
if(CLUSTER_LAMMPS_VERSION LESS 20250204)
  message(FATAL_ERROR "LAMMPS of 4 Feb 2025 or later is needed; ${lammps_src} is of ${CLUSTER_LAMMPS_VERSION}")
endif()

set(MPI_CXX_SKIP_MPICXX ON)
find_package(MPI REQUIRED COMPONENTS CXX)
string(TOUPPER LAMMPS_${LAMMPS_SIZES} sizes_macro)

add_library(lammps INTERFACE)
target_include_directories(lammps SYSTEM INTERFACE ${lammps_src} ${lammps_src}/GRANULAR)
target_compile_definitions(lammps INTERFACE ${sizes_macro} CLUSTER_LAMMPS_VERSION=${CLUSTER_LAMMPS_VERSION}
  OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
target_link_libraries(lammps INTERFACE MPI::MPI_CXX)
