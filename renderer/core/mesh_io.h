// Meshes from disk, the only door to OpenMesh.
#pragma once

#include "renderer/core/mesh.h"

#include <filesystem>
#include <stop_token>

namespace patina {

/// OBJ, PLY, OFF, STL. Normals and texture coordinates per corner kept, polygons triangulated, missing
/// normals computed (angle-weighted, creases above 60°), missing uvs projected (noted), degenerate and
/// duplicate faces dropped (counted), non-manifold input kept. Centred and scaled to the unit sphere. No
/// tangents yet. One file is read at a time, a second caller waits: OpenMesh's readers are global objects.
/// Throws std::runtime_error naming the file and the reason (missing, truncated, no faces, zero area, too
/// large), and when stopped.
Mesh load_mesh(const std::filesystem::path& file, const std::stop_token& stop = {});

}  // namespace patina
