// The mesh, which stands still at the origin: world space is its own space.
#include "blocks.h"

in vec3 vertex_position;
in vec3 vertex_normal;
in vec2 vertex_uv;
in vec4 vertex_tangent;

out vec3 world_position;
out vec3 world_normal;
out vec4 world_tangent;
out vec2 mesh_uv;
out vec2 map_uv;
invariant gl_Position;   // a depth pass and a shading pass must agree to the last bit

void main() {
    world_position = vertex_position;
    world_normal = vertex_normal;
    world_tangent = vertex_tangent;
    mesh_uv = vertex_uv;
    map_uv = uv_matrix.xy * vertex_uv.x + uv_matrix.zw * vertex_uv.y + uv_offset.xy;
    gl_Position = view_projection[0] * vertex_position.x + view_projection[1] * vertex_position.y +
                  view_projection[2] * vertex_position.z + view_projection[3];
}
