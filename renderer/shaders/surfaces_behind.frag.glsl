// Where the mesh is not: the ray that goes on to the environment.
in vec3 world_ray;
layout(location = 0) out float stored_fragment;
layout(location = 2) out vec4 stored_view;

void main() {
    stored_fragment = 0.0;
    stored_view = vec4(world_ray, 0.0);
}
