# Prints which of the unpacked packages in the folder PACKAGES CMake takes in a build with the given variables.
# Run by cmake -P.
function(check file)
  include("${file}")
  if(PACKAGE_VERSION_COMPATIBLE AND NOT PACKAGE_VERSION_UNSUITABLE)
    file(RELATIVE_PATH name "${PACKAGES}" "${file}")
    string(REGEX REPLACE "/.*" "" name "${name}")
    message(STATUS "${name}")
  endif()
endfunction()

file(GLOB files "${PACKAGES}/*/lib/cmake/Muslin/MuslinConfigVersion.cmake")
foreach(file IN LISTS files)
  check("${file}")
endforeach()
