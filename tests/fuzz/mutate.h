// Damage to files as it happens: turned bits, cut and doubled pieces, numbers at their ends. A seed gives the
// same damage everywhere.
#pragma once

#include "app/stability.h"

#include <string>
#include <vector>

namespace patina::fuzz {

/// One of the originals, damaged one to six times.
std::string damaged(const std::vector<std::string>& originals, Random& random);

}  // namespace patina::fuzz
