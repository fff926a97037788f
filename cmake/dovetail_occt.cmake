# The OpenCASCADE toolkits that the adapter needs, as one target with the headers as system headers. Used by the build
# and by dovetailConfig.cmake after find_package(OpenCASCADE). The toolkits are linked by file: the targets of Debian's
# configuration name files (libtbb.so, libfreetype.so) of development packages that it does not depend on.
if(NOT TARGET dovetail_occt_toolkits)
  # Open CASCADE 7.8 merged the toolkits of each format of files into one.
  if(OpenCASCADE_VERSION VERSION_LESS 7.8)
    set(toolkits TKXDEIGES TKXDESTEP TKIGES TKSTEP TKSTEP209 TKSTEPAttr TKSTEPBase)
  else()
    set(toolkits TKDEIGES TKDESTEP TKDE)
  endif()
  list(APPEND toolkits
    TKXCAF TKVCAF TKCAF TKLCAF TKCDF TKXSBase TKMesh TKFillet TKOffset TKFeat TKBool TKBO TKPrim TKShHealing TKTopAlgo
    TKBRep TKGeomAlgo TKGeomBase TKG3d TKG2d TKMath TKernel)
  set(toolkit_files "")
  foreach(toolkit IN LISTS toolkits)
    find_library(dovetail_occt_${toolkit} ${toolkit} HINTS "${OpenCASCADE_LIBRARY_DIR}" NO_CACHE REQUIRED)
    list(APPEND toolkit_files "${dovetail_occt_${toolkit}}")
  endforeach()
  add_library(dovetail_occt_toolkits INTERFACE IMPORTED GLOBAL)
  target_include_directories(dovetail_occt_toolkits SYSTEM INTERFACE "${OpenCASCADE_INCLUDE_DIR}")
  target_link_libraries(dovetail_occt_toolkits INTERFACE ${toolkit_files})
endif()
