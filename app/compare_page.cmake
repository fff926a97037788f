# The page of `dovetail compare` becomes part of the program: a header with compare_page.html as a string, made again
# whenever it changes. To be included where compare_page.cpp is compiled.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/compare_page.html")
file(READ "${CMAKE_CURRENT_LIST_DIR}/compare_page.html" page)
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/compare_page_template.hpp" @ONLY CONTENT
"#pragma once

inline constexpr const char* page_template = R\"page(@page@)page\";
")
set(compare_page_directory "${PROJECT_BINARY_DIR}/generated")
