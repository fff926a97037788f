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
