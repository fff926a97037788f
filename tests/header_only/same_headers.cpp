// Includes what test_entry_points.cpp includes, and nothing else.
#include "entry_points.hpp"
