# Unity builds: the sources of one folder below src are one translation unit, so that a compiler reads the headers of
# Eigen, OpenCV and ROS once for each folder. -DMEMS_STICTION_UNITY=OFF compiles each source alone, as clang-tidy
# reads them. CMake groups sources from 3.18 on; older ones compile each alone.
option(MEMS_STICTION_UNITY "Compile the sources of a folder together: the same bits in a third of the time" ON)

# mems_stiction_join_rooms(TARGET [ALONE SOURCE...]): a folder of more than 100 kB becomes several units, so that no processor
# is left alone with one at the end. ALONE: these are units of their own.
function(mems_stiction_join_rooms target)
  if(NOT MEMS_STICTION_UNITY OR CMAKE_VERSION VERSION_LESS 3.18)
    return()
  endif()
  cmake_parse_arguments(joined "" "" "ALONE" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # GCC takes the sources of a joined unit for headers, whose classes must not hold what only one unit sees.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  if(joined_ALONE)
    list(REMOVE_ITEM sources ${joined_ALONE})
  endif()
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER ${room} room)
    file(SIZE ${source} size)
    math(EXPR filled_${room} "${filled_${room}}0 / 10 + ${size}")
    math(EXPR part "${filled_${room}} / 100000")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${part})
  endforeach()
endfunction()
