#pragma once

#include <pugixml.hpp>
#include <vector>

#include "backend/plcopen/rungs.h"
#include "backend/unit/comments.h"

namespace rung::backend::plcopen {

/// Draws rungs below each other into the `LD` of a body, comments above them.
void draw_rungs(pugi::xml_node body, const Unit& unit,
                const std::vector<Rung>& rungs, const RungComments& comments,
                const std::vector<std::string>& at_top);

}  // namespace rung::backend::plcopen
