# Texts that become part of the program: `embed_text(FILE NAME)` makes a header NAME.hpp with the file's content as the
# string NAME, made again whenever it changes. To be included where the sources that include these headers are compiled;
# the headers are in ${embedded_texts}.
set(embedded_texts "${PROJECT_BINARY_DIR}/generated")
function(embed_text source name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
  file(READ "${source}" text)
  file(CONFIGURE OUTPUT "${embedded_texts}/${name}.hpp" @ONLY CONTENT
"#pragma once

inline constexpr const char* @name@ = R\"embedded(@text@)embedded\";
")
endfunction()
embed_text("${CMAKE_CURRENT_LIST_DIR}/compare_page.html" compare_page_template)
embed_text("${CMAKE_CURRENT_LIST_DIR}/paper_figures.json" paper_figures_text)
embed_text("${CMAKE_CURRENT_LIST_DIR}/experiment_plot.py" experiment_plot_script)
embed_text("${CMAKE_CURRENT_LIST_DIR}/view_page.html" view_page_template)
embed_text("${CMAKE_CURRENT_LIST_DIR}/view_model.js" view_model_script)

# The script that pages of `view` are drawn by, in pieces since compilers need take no longer strings. Where it is not
# found there are none.
find_file(DOVETAIL_THREE_JS three.min.js PATHS /usr/share/javascript/three /usr/share/javascript/three/build NO_DEFAULT_PATH)
mark_as_advanced(DOVETAIL_THREE_JS)
set(pieces "")
if(DOVETAIL_THREE_JS)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${DOVETAIL_THREE_JS}")
  file(READ "${DOVETAIL_THREE_JS}" text)
  string(LENGTH "${text}" length)
  foreach(begin RANGE 0 ${length} 30000)
    string(SUBSTRING "${text}" ${begin} 30000 piece)
    string(APPEND pieces "R\"embedded(${piece})embedded\",\n")
  endforeach()
endif()
file(CONFIGURE OUTPUT "${embedded_texts}/three_js_pieces.hpp" @ONLY CONTENT
"#pragma once

inline constexpr const char* three_js_pieces[] = {
@pieces@\"\"};
")
