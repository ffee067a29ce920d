// The preview object: a ball on a stand, with a groove and a bowl that holds a pearl.
#pragma once

#include "renderer/core/mesh.h"

namespace patina {

/// Convex and concave, wide and narrow curvature, contact and occlusion in one object; a few closed parts,
/// the texture once around each.
Mesh make_shaderball();

}  // namespace patina
