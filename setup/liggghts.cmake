# The fixes for a stock LIGGGHTS 3.8, and a wrapper that runs it with them: src/LIGGGHTS/README.md

find_path(LIGGGHTS_INCLUDE_DIR contact_models.h PATH_SUFFIXES liggghts DOC "LIGGGHTS' headers (Debian: libliggghts-dev)" REQUIRED)
find_library(LIGGGHTS_LIBRARY liggghts DOC "LIGGGHTS' shared library (Debian: libliggghts-dev)" REQUIRED)
find_program(LIGGGHTS_EXE liggghts DOC "LIGGGHTS' executable (Debian: liggghts)" REQUIRED)
find_package(MPI REQUIRED COMPONENTS CXX)

# One source of the fixes for both engines (src/CLUSTER/engine.h); what is about the engine itself is in src/LIGGGHTS.
file(GLOB liggghts_sources CONFIGURE_DEPENDS src/LIGGGHTS/*.cpp src/CLUSTER/gas_*.cpp src/CLUSTER/vtk_*.cpp)
foreach(name arrivals breakmerge_settings carried_values census cluster_drag cluster_fix cluster_table cluster_walls contact_source contact_sums event_apply event_check event_plan
    fix_cluster_breakmerge fix_cluster_breakmerge_output fix_drag_cluster fix_halo held_drag largest_diameters local_voidage mean_velocity merge_partners newborn_tags
    prescribed_gas requirements scene_checks scene_checks_clusters scene_walls size_check)
  list(APPEND liggghts_sources src/CLUSTER/${name}.cpp)
endforeach()
add_library(liggghtscluster MODULE EXCLUDE_FROM_ALL ${liggghts_sources})
target_include_directories(liggghtscluster PRIVATE src/LIGGGHTS)
target_compile_definitions(liggghtscluster PRIVATE CLUSTER_FOR_LIGGGHTS)
target_include_directories(liggghtscluster SYSTEM PRIVATE ${LIGGGHTS_INCLUDE_DIR})
target_link_libraries(liggghtscluster PRIVATE cluster_flags ${LIGGGHTS_LIBRARY} MPI::MPI_CXX ${CMAKE_DL_LIBS})
set_target_properties(liggghtscluster PROPERTIES PREFIX "" SUFFIX ".so"
  LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/liggghts)

configure_file(setup/liggghts.in bin/liggghts-cluster @ONLY FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
