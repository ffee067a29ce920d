// The camera's ray through a point of the picture, in pixels from its lower left corner; not normalised.
vec3 camera_ray(vec2 pixel) { return ray_corner.xyz + pixel.x * ray_right.xyz + pixel.y * ray_up.xyz; }
