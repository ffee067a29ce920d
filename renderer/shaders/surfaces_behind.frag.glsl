// Where the mesh is not: the ray that goes on to the environment.
in vec3 world_ray;
layout(location = 2) out vec4 stored_view;

void main() {
    stored_view = vec4(world_ray, 0.0);
}
