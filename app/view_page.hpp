/// @file
/// A mesh as one page that needs nothing else: its data, and the scripts of view_page.html and view_model.js
/// that show them by three.js.
#pragma once

#include "view_marks.hpp"
#include "view_scene.hpp"

#include <string>

namespace dovetail::app {

/// Whether three.js was there when the program was built; without it there are no pages.
bool has_three_js();

/// The page with a part of a scene. `name`: of the mesh, any bytes.
std::string page_of_view(const view_scene& scene, const view_part& part, const std::string& name,
                         const view_marks& marks = {});

} // namespace dovetail::app
