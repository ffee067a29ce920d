// The editor window, from opening to closing.
#pragma once

#include "app/args.h"
#include "app/registry.h"

namespace patina {

/// Returns the exit status. Throws std::runtime_error with one sentence where no window can be opened.
int run_editor(const EditArgs& args, const Registry& registry);

}  // namespace patina
