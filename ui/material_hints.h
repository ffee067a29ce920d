// What a physicist would remark on a material's values: quiet hints, not errors. Pure.
#pragma once

#include "materials/material.h"

#include <string_view>

namespace patina::ui {

/// One sentence, or empty. Values that multiply a map are not judged.
std::string_view albedo_hint(const Material& material);
std::string_view metallic_hint(const Material& material);

}  // namespace patina::ui
