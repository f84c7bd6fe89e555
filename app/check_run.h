#pragma once

#include "app/session.h"
#include "reports/report.h"

namespace rung {

/// What `lint` finds in the inputs of the session, each with its configuration.
Report lint_inputs(Session& session);

}  // namespace rung
