# find_package(Muslin), then link Muslin::muslin, or Muslin::muslin_static for the static library. The package
# folder may be moved as a whole. Where the package has no shared library, Muslin::muslin is the static one.
get_filename_component(_muslin_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

# Visual Studio links the DLL. The static library is for the compilers of MinGW.
if(EXISTS "${_muslin_prefix}/lib/libmuslin.a" AND NOT MSVC AND NOT TARGET Muslin::muslin_static)
  add_library(Muslin::muslin_static STATIC IMPORTED)
  set_target_properties(Muslin::muslin_static PROPERTIES
    IMPORTED_LOCATION "${_muslin_prefix}/lib/libmuslin.a"
    IMPORTED_LINK_INTERFACE_LANGUAGES "C"
    INTERFACE_INCLUDE_DIRECTORIES "${_muslin_prefix}/include"
    INTERFACE_LINK_LIBRARIES "@system_libraries@")
endif()

if(NOT TARGET Muslin::muslin)
  if(EXISTS "${_muslin_prefix}/bin/muslin.dll")
    add_library(Muslin::muslin SHARED IMPORTED)
    set_target_properties(Muslin::muslin PROPERTIES IMPORTED_LOCATION "${_muslin_prefix}/bin/muslin.dll")
    if(MSVC)
      set_target_properties(Muslin::muslin PROPERTIES IMPORTED_IMPLIB "${_muslin_prefix}/lib/muslin.lib")
    else()
      set_target_properties(Muslin::muslin PROPERTIES IMPORTED_IMPLIB "${_muslin_prefix}/lib/libmuslin.dll.a")
    endif()
  elseif(EXISTS "${_muslin_prefix}/lib/libmuslin.so.@version@")
    add_library(Muslin::muslin SHARED IMPORTED)
    set_target_properties(Muslin::muslin PROPERTIES
      IMPORTED_LOCATION "${_muslin_prefix}/lib/libmuslin.so.@version@"
      IMPORTED_SONAME "libmuslin.so.@major@")
  else()
    add_library(Muslin::muslin INTERFACE IMPORTED)
    set_target_properties(Muslin::muslin PROPERTIES INTERFACE_LINK_LIBRARIES Muslin::muslin_static)
  endif()
  set_target_properties(Muslin::muslin PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${_muslin_prefix}/include")
endif()

unset(_muslin_prefix)
