// One triangle over the whole picture, at the far plane: it is drawn after the mesh and only where the mesh is not.
#include "blocks.h"

out vec3 world_ray;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    world_ray = ray_center.xyz + corner.x * ray_right.xyz + corner.y * ray_up.xyz;
    gl_Position = vec4(corner, 1.0, 1.0);
}
