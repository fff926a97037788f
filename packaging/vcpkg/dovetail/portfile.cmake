# The clone that this port is in is what it installs: vcpkg install dovetail --overlay-ports=packaging/vcpkg --no-binarycaching
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

set(VCPKG_BUILD_TYPE release) # nothing is compiled

set(adapters "")
foreach(feature IN ITEMS boost-graph cgal eigen json occt zlib)
  if(feature IN_LIST FEATURES)
    string(REPLACE "-" "_" adapter "${feature}")
    list(APPEND adapters "${adapter}")
  endif()
endforeach()

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    "-DDOVETAIL_ADAPTERS=${adapters}"
    -DDOVETAIL_BUILD_APP=OFF
    -DDOVETAIL_BUILD_COMPILED=OFF
    -DDOVETAIL_BUILD_TESTS=OFF
    -DDOVETAIL_BUILD_EXAMPLES=OFF
    -DDOVETAIL_BUILD_BENCHMARKS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/dovetail)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/lib/cmake")

file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
