// Includes what test_entry_points.cpp includes, and nothing else.
#include "all_headers.hpp"
