# find_package(Muslin), then link Muslin::muslin, or Muslin::muslin_static for the static library. The package
# folder may be moved as a whole.
include(CMakeFindDependencyMacro)
find_dependency(Threads)

get_filename_component(_muslin_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

if(NOT TARGET Muslin::muslin)
  add_library(Muslin::muslin SHARED IMPORTED)
  set_target_properties(Muslin::muslin PROPERTIES
    IMPORTED_LOCATION "${_muslin_prefix}/lib/libmuslin.so.@version@"
    IMPORTED_SONAME "libmuslin.so.@major@"
    INTERFACE_INCLUDE_DIRECTORIES "${_muslin_prefix}/include")

  add_library(Muslin::muslin_static STATIC IMPORTED)
  set_target_properties(Muslin::muslin_static PROPERTIES
    IMPORTED_LOCATION "${_muslin_prefix}/lib/libmuslin.a"
    IMPORTED_LINK_INTERFACE_LANGUAGES "C"
    INTERFACE_INCLUDE_DIRECTORIES "${_muslin_prefix}/include"
    INTERFACE_LINK_LIBRARIES "m;gcc_s;Threads::Threads;${CMAKE_DL_LIBS}")
endif()

unset(_muslin_prefix)
