# The Debian package of what is installed. The engine is in it: Debian's own LAMMPS is older than the plugin needs, or of
# another version than the plugin's headers.
set(CPACK_PACKAGE_NAME clusterdem)
set(CPACK_PACKAGE_CONTACT "Cluster DEM developers <maintainers@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_STRIP_FILES ON)
include(CPack)
