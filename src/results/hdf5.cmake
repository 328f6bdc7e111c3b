# The target hdf5: HDF5's C library with its high level, static if that links. The shared one loads curl, TLS, LDAP and
# Kerberos for a driver that nothing here uses, which takes longer than a small sweep.
#
# CMake's FindHDF5 asks HDF5's compiler wrapper which libraries the static one needs. It is a shell script that fails
# in a folder with a blank in its name, so the few libraries that it may name are looked for here.
include(CheckCXXSourceCompiles)

set(hints HINTS ${HDF5_ROOT} ENV HDF5_ROOT PATH_SUFFIXES)
find_path(HDF5_INCLUDE_DIR hdf5_hl.h ${hints} include hdf5/serial include/hdf5/serial REQUIRED)
foreach(part hdf5_hl hdf5)
  find_library(${part}_static lib${part}.a ${hints} lib hdf5/serial lib/hdf5/serial)
  list(APPEND static_libraries ${${part}_static})
endforeach()
foreach(part sz aec z)  # of the filters that it was built with
  find_library(${part}_library ${part} ${hints} lib)
  if(${part}_library)
    list(APPEND static_libraries ${${part}_library})
  endif()
endforeach()

function(hdf5_links with variable)
  set(CMAKE_REQUIRED_INCLUDES ${HDF5_INCLUDE_DIR})
  set(CMAKE_REQUIRED_LIBRARIES ${with})
  check_cxx_source_compiles("#include <hdf5_hl.h>\nint main() { return H5open() < 0 || H5DSis_scale(0) < 0; }" ${variable})
endfunction()

add_library(hdf5 INTERFACE)
target_include_directories(hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIR})
hdf5_links("${static_libraries};${CMAKE_DL_LIBS}" HDF5_STATIC_LINKS)
if(HDF5_STATIC_LINKS)
  target_link_libraries(hdf5 INTERFACE ${static_libraries} ${CMAKE_DL_LIBS})
else()
  find_library(hdf5_hl_shared hdf5_hl ${hints} lib hdf5/serial lib/hdf5/serial REQUIRED)
  find_library(hdf5_shared hdf5 ${hints} lib hdf5/serial lib/hdf5/serial REQUIRED)
  target_link_libraries(hdf5 INTERFACE ${hdf5_hl_shared} ${hdf5_shared})
endif()
